//! Records that were read as something else without a word: units, steps, counts and times that a file states
//! beside its samples, codes of missing values, and two records in one file.

use ground_motion::{RecordOptions, Unit};

use crate::assert_mentions;
use crate::inputs::{COUNT, assert_is_the_motion, at2, motion, si, table, with_step};
use crate::specimen::{SAMPLES, fdsn};

/// One sample a line, below a header.
fn column(header: &str) -> String {
    motion().iter().fold(header.to_owned(), |text, a| text + &format!("{a:.6}\n"))
}

#[track_caller]
fn refused(text: &str, options: &RecordOptions, words: &[&str]) {
    let error = crate::read("x.txt", text, options).expect_err(text.get(..60).unwrap_or(text));
    assert_mentions(&error, words);
}

#[track_caller]
fn warnings(text: &str, options: &RecordOptions) -> Vec<String> {
    let record = crate::read("x.txt", text, options).unwrap_or_else(|error| panic!("{error}"));
    record.check().warnings.iter().map(ToString::to_string).collect()
}

/// A unit that is not that of the user counts wherever it stands above the samples: in a comment, in a title,
/// in words, for one column and for many.
#[test]
fn the_unit_of_the_file_counts_wherever_it_stands() {
    for unit in [
        "%g",
        "mg",
        "g/10",
        "g*10",
        "10*g",
        "ft/s2",
        "in/s2",
        "dm/s2",
        "km/h/s",
        "m/s",
        "cm/s",
        "cm",
        "kN",
        "rad/s2",
        "°/s²",
        "deg/s2",
        "10^-2 m/s^2",
        "1e-3 m/s2",
        "x10-3 g",
        "mGal",
        "nm/s2",
        "m/min2",
        "counts",
    ] {
        for head in [format!("# units: {unit}\n"), format!("# Unit [{unit}]\ntime,a\n")] {
            refused(&table(&head, ",", "", "."), &si(), &["line 1", unit, "does not override"]);
        }
        refused(&column(&format!("# units: {unit}\n")), &with_step(0.01), &["line 1", unit]);
        let named = table(&format!("t [s],a ({unit})\n"), ",", "", ".");
        refused(&named, &si(), &["line 1", unit, "does not override"]);
    }
    // in words, and of several columns
    for head in
        ["# acceleration in g\n", "# ACC IN G, corrected\n", "# times in s and a in g\n", "# units: g\n"]
    {
        for names in ["", "time,a\n", "time,NS,EW\n"] {
            let behind = if names.contains("EW") { ",0.1" } else { "" };
            let text = table(&(head.to_owned() + names), ",", behind, ".");
            let column = (!behind.is_empty()).then(|| "NS".to_owned());
            let stated = RecordOptions { column: column.clone(), ..si() };
            refused(&text, &stated, &["line 1", "the stated unit m/s2, found g"]);
            let read = crate::read("x.txt", &text, &RecordOptions { column, ..Default::default() }).unwrap();
            assert_eq!((read.unit, read.motion.samples().len()), (Unit::StandardGravity, 401));
        }
    }
    for title in ["ACCELERATION TIME HISTORY IN G", "Acceleration time series (g)"] {
        refused(&at2(title, COUNT), &si(), &["line 3", "the stated unit m/s2, found g"]);
        assert_is_the_motion(&crate::read("x.AT2", &at2(title, COUNT), &RecordOptions::default()).unwrap());
    }
    let of_column = RecordOptions { column: Some("a".into()), ..RecordOptions::default() };
    let words = ["line 1", "the column `a`", "PEER AT2, a format without named columns", "--column"];
    refused(&at2("ACCELERATION (g)", COUNT), &of_column, &words);
    // what is no unit of the samples
    for head in ["# recorded in Grottaminarda\n", "# depth (m)\n", "# Units of depth: m\n", "# max. in 3 s\n"]
    {
        assert_is_the_motion(&crate::read("x.txt", &table(head, ",", "", "."), &si()).unwrap());
    }
}

/// Velocities and displacements in other languages.
#[test]
fn other_quantities_are_known_in_other_languages() {
    for name in [
        "velocità",
        "Geschwindigkeit",
        "vitesse",
        "spostamento",
        "déplacement",
        "DÉPLACEMENT",
        "Verschiebung",
    ] {
        refused(
            &table(&format!("time;{name}\n"), ";", "", "."),
            &si(),
            &["line 1", "use the file or column"],
        );
    }
}

/// A step in the header of samples alone, and a count or a step as the first sample.
#[test]
fn what_the_header_says_of_samples_alone_is_compared() {
    let other = "step: the file has 0.01 s between samples; the 0.02 s that you state count";
    for head in [
        "dt=0.01\n",
        "# dt = 0.01 s\n",
        "# time step (s): 0.01\n",
        "Sampling interval: 0.01\n",
        "# sampling rate: 100 Hz\n",
    ] {
        assert!(warnings(&column(head), &with_step(0.02)).contains(&other.to_owned()), "{head}");
        assert_is_the_motion(&crate::read("x.txt", &column(head), &with_step(0.01)).unwrap());
        let none = warnings(&column(head), &with_step(0.01));
        assert!(!none.iter().any(|warning| warning.starts_with("step")), "{none:?}");
    }
    let eight = |row: &[f64]| row.iter().map(|a| format!("{a:.6} ")).collect::<Vec<_>>().concat() + "\n";
    let numbers = "# dt 0.01\n".to_owned() + &motion().chunks(8).map(eight).collect::<String>();
    assert!(warnings(&numbers, &with_step(0.02)).contains(&other.to_owned()));
    for (head, filter) in [("# filter 0.1-25 Hz\n", 0.01), ("# time step: 10 ms\n", 0.01)] {
        assert!(!warnings(&column(head), &with_step(filter)).iter().any(|w| w.starts_with("step")));
    }
    for (head, first) in [("401\n", "401"), ("401\n0.01\n", "401"), ("0.01\n", "0.01")] {
        let found = warnings(&column(head), &with_step(0.01));
        let words = format!("samples: the first, {first}, is the number of those that follow, or their step");
        assert!(found.iter().any(|warning| warning.starts_with(&words)), "{found:?}");
    }
    assert!(warnings(&column(""), &with_step(0.01)).is_empty());
}

/// A row of times above a row of samples, two records one below the other, and a code of a missing value.
#[test]
fn times_records_and_codes_among_samples_are_noticed() {
    let times = (0..401).map(|i| format!("{:.2} ", 0.01 * f64::from(i))).collect::<Vec<_>>().concat();
    let samples = motion().iter().map(|a| format!("{a:.5} ")).collect::<Vec<_>>().concat();
    refused(
        &format!("{times}\n{samples}\n"),
        &with_step(0.01),
        &["times above accelerations", "two columns"],
    );
    let two = column("# NS\n") + &column("# EW\n");
    let found = warnings(&two, &with_step(0.01));
    assert!(found.iter().any(|w| w.contains("line 403 has 0 numbers") && w.contains("another record")));
    // the 101st sample
    let code = |code: &str| {
        let mut lines: Vec<String> = motion().iter().map(|a| format!("{:.4}\n", 100.0 * a)).collect();
        lines[100] = format!("{code}\n");
        let unit = Some(Unit::CentimetrePerSecondSquared);
        warnings(&lines.concat(), &RecordOptions { unit, step: Some(0.01), ..Default::default() })
    };
    for (value, size) in [("-999", "1.019"), ("9999.9", "10.197")] {
        let words = format!("spike: sample 101 has {size} g, all others at most 0.153 g");
        assert!(code(value).iter().any(|warning| warning.starts_with(&words)), "{:?}", code(value));
    }
    assert!(!code("140").iter().any(|warning| warning.starts_with("spike")));
}

/// An exponent without its letter, as Fortran writes those of three digits, is no second sample.
#[test]
fn exponents_without_a_letter_are_refused() {
    let text = motion().iter().map(|a| format!("{a:.6}\n")).collect::<Vec<_>>().concat();
    for number in ["0.1234567-103", "-.1234567+103"] {
        let text = text.replacen(&format!("{:.6}", motion()[200]), number, 1);
        refused(&text, &with_step(0.01), &["line 201", number]);
    }
    let touching = "1.5-1.25-.125 0.5\n".repeat(10);
    assert_eq!(crate::read("x.txt", &touching, &with_step(0.01)).unwrap().motion.samples().len(), 40);
}

/// The times of FDSN text agree with its header; a gap is none.
#[test]
fn times_of_data_centres_are_compared() {
    for text in [fdsn::tspair(&SAMPLES), fdsn::geocsv(&SAMPLES)] {
        crate::read("x.txt", &text, &RecordOptions::default()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let last = lines.len() - 1;
        let late = lines[last].replacen(":00.1", ":00.6", 1);
        assert_ne!(late, lines[last]);
        let gap = lines[..last].join("\n") + "\n" + &late + "\n";
        let line = format!("line {}", last + 1);
        refused(&gap, &RecordOptions::default(), &[&line, "a sample 0.100 s after the first", "has a gap"]);
        let rate = text.replacen("100 sps", "200 sps", 1).replacen("rate_hz: 100", "rate_hz: 200", 1);
        refused(&rate, &RecordOptions::default(), &["a sample 0.005 s after the first"]);
        // a clock that begins anew
        let night = text.replace("01:36:00.0", "23:59:59.9").replace("01:36:00.1", "00:00:00.0");
        assert_ne!(night, text);
        crate::read("x.txt", &night, &RecordOptions::default()).unwrap();
    }
}

/// What stands below or between the samples is named for what it is.
#[test]
fn lines_of_words_and_other_comments_have_their_remedy() {
    let table = table("time,a\n", ",", "", ".");
    refused(&(table.clone() + "PGA,1.5\n"), &si(), &["line 403", "`PGA`", "a title or a summary"]);
    refused(&(table.clone() + &table), &si(), &["line 403", "`time`", "delete this line"]);
    for mark in ["; acc\n", "/* acc */\n"] {
        refused(&(mark.to_owned() + &table), &si(), &["line 1", "comments start with # or %"]);
    }
    for (path, words) in [
        ("https://example.org/a.AT2", "web addresses are not read"),
        ("~/a.AT2", "are not replaced"),
        ("a.AT2 ", "a blank at an end"),
        ("", "the path is empty"),
    ] {
        let error = ground_motion::read(path, &RecordOptions::default()).unwrap_err().to_string();
        assert_mentions(&error, &["cannot be read", words]);
    }
}
