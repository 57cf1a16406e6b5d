//! Records with errors of spreadsheets, missing samples, units of other quantities, times in other units,
//! quoted cells and the formats of other programs: none is read as something else without a word.

use std::fmt::Write;

use ground_motion::{RecordOptions, Unit, parse, utf8_text};

use crate::assert_mentions;
use crate::inputs::{COUNT, IN_G, assert_is_the_motion, at2, motion, si, table, with_step};

/// One sample a line, below a header.
fn column(header: &str) -> String {
    motion().iter().fold(header.to_owned(), |text, a| text + &format!("{a:.6}\n"))
}

/// Eight samples a line, in fields of twelve characters.
fn numbers() -> String {
    let row = |row: &[f64]| row.iter().fold(String::new(), |line, a| line + &format!("{a:12.6}")) + "\n";
    motion().chunks(8).map(row).collect()
}

/// Replaces the content of a line, from 1, without its end.
fn with_line(text: &str, line: usize, change: impl Fn(&str) -> String) -> String {
    let lines = text.lines().zip(1..).map(|(old, n)| if n == line { change(old) } else { old.to_owned() });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[track_caller]
fn refused(text: &str, options: &RecordOptions, words: &[&str]) {
    let error = crate::read("x.csv", text, options).expect_err(text.get(..60).unwrap_or(text));
    assert_mentions(&error, words);
}

/// The warnings of a record that is read.
#[track_caller]
fn warnings(text: &str, options: &RecordOptions) -> Vec<String> {
    let record = crate::read("x.csv", text, options).unwrap_or_else(|error| panic!("{error}"));
    record.check().warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn errors_of_spreadsheets_are_no_comments() {
    let with_times = table("time acc[m/s2]\n", " ", "", ".");
    for error in [
        "#N/A",
        "#VALUE!",
        "#DIV/0!",
        "#REF!",
        "#NAME?",
        "#NUM!",
        "#NULL!",
        "#N/D",
        "#RIF!",
        "#VALORE!",
        "#NV",
        "#WERT!",
        "#BEZUG!",
        "#¡VALOR!",
        "#ЗНАЧ!",
        "#N/A N/A",
        "########",
    ] {
        let words = |line: &str| [line.to_owned(), format!("`{error}")];
        for (text, line) in [
            (with_line(&column("acc [m/s2]\n"), 152, |_| error.to_owned()), "line 152"),
            (with_line(&column(""), 152, |_| error.to_owned()), "line 152"),
            (with_line(&column("# Norcia\n"), 152, |_| format!("\t{error}")), "line 152"),
            (with_line(&numbers(), 20, |old| format!("{error}{}", &old[12..])), "line 20"),
            (with_line(&with_times, 30, |_| format!("{error} -0.3")), "line 30"),
            (with_line(&with_times.replace(' ', ","), 30, |_| format!("{error},-0.3")), "line 30"),
        ] {
            let words = words(line);
            let options = RecordOptions { step: (!text.starts_with("time")).then_some(0.01), ..si() };
            refused(&text, &options, &[&words[0], &words[1]]);
        }
    }
    // within a row, and as the first sample
    let inside = with_line(&numbers(), 20, |old| old.replacen(&old[24..36], "       #N/A ", 1));
    refused(&inside, &with_step(0.01), &["line 20", "`#N/A`", "an error of a spreadsheet"]);
    refused(&column("#N/A\n"), &with_step(0.01), &["line 1", "an error of a spreadsheet"]);
    refused(&column("#NV\n"), &with_step(0.01), &["line 1", "an error of a spreadsheet"]);
    refused(&column("acc [m/s2]\n#N/A\n"), &with_step(0.01), &["line 2", "an error of a spreadsheet"]);
    refused(&column("a\n#late\n"), &with_step(0.01), &["line 2", "a blank behind the mark of a comment"]);
    refused(&column("a\n%1.5\n"), &with_step(0.01), &["line 2", "a blank behind the mark of a comment"]);
    // comments
    for header in ["#corrected\n", "#1\n", "####\n# a\n####\n", "#TIME, A\n", "# N/A\n", "#\n##\n%\n"] {
        assert_is_the_motion(&crate::read("x.csv", &column(header), &with_step(0.01)).unwrap());
    }
    for comment in ["# N/A", "#", "##", "%", "# #N/A", "#\tlate"] {
        let text = with_line(&column("a\n"), 152, |old| format!("{comment}\n{old}"));
        assert_is_the_motion(&crate::read("x.csv", &text, &with_step(0.01)).unwrap());
    }
}

#[test]
fn missing_samples_are_warned_of_with_their_lines() {
    let empty = |line: usize| move |old: &str| if line == 0 { String::new() } else { old.to_owned() };
    let ten = (152..162).fold(column(""), |text, line| with_line(&text, line, empty(0)));
    let found = warnings(&ten, &with_step(0.01));
    assert!(
        found.iter().any(|w| w.contains("line 152 has 0 numbers, the others 1, and 9 more lines")),
        "{found:?}"
    );
    let one = with_line(&column("").replace('\n', ",\n"), 152, |_| " ,".to_owned());
    let found = warnings(&one, &with_step(0.01));
    assert!(
        found.iter().any(|w| w.contains("line 152 has 0 numbers, the others 1, and 0 more")),
        "{found:?}"
    );
    let short = with_line(&numbers(), 20, |old| old.replacen(&old[24..36], "            ", 1));
    let found = warnings(&short, &with_step(0.01));
    assert!(found.iter().any(|w| w.contains("line 20 has 7 numbers, the others 8, and 0 more")), "{found:?}");
    let blank = with_line(&numbers(), 20, |old| format!("\n{old}"));
    let found = warnings(&blank, &with_step(0.01));
    assert!(found.iter().any(|w| w.contains("line 20 has 0 numbers, the others 8")), "{found:?}");
    // a file with a blank line behind every line, blank lines at the ends, and a short last line
    for text in [
        column("").replace('\n', "\n\n"),
        "\n\n".to_owned() + &column("a\n\n\n") + "\n\n",
        numbers(),
        column("# a\n").replace('\n', "\r\n"),
    ] {
        let found = warnings(&text, &with_step(0.01));
        assert!(!found.iter().any(|warning| warning.starts_with("samples")), "{found:?}");
    }
    for (text, line) in [
        (with_line(&numbers(), 20, |old| old.replacen(&old[24..36], "  **********", 1)), "line 20"),
        (with_line(&column(""), 20, |_| "**********".to_owned()), "line 20"),
        (with_line(&at2(IN_G, COUNT), 20, |old| old.replacen(&old[15..30], &"*".repeat(15), 1)), "line 20"),
    ] {
        let options = if text.contains("NPTS") { RecordOptions::default() } else { with_step(0.01) };
        refused(&text, &options, &[line, "****", "asterisks", "too wide for its field"]);
    }
    refused(&table("time,a\n", ",", "", ".").replace("\n1.00,", "\n1.00, #"), &si(), &["line 102"]);
    refused(
        &with_line(&table("time,a\n", ",", "", "."), 9, |_| "0.07,".into()),
        &si(),
        &["the cell is empty"],
    );
}

#[test]
fn times_in_other_units_are_warned_of() {
    let rows = |unit: f64, start: f64, digits: usize| {
        let row = |(i, a): (usize, &f64)| format!("{:.digits$},{a:.6}\n", start + 0.01 * i as f64 / unit);
        "time,acc [m/s2]\n".to_owned() + &motion().iter().enumerate().map(row).collect::<String>()
    };
    for (text, unit) in [
        (rows(86_400.0, 45_212.5, 10), "days (a step of 1.00e-2 s)"),
        (rows(3600.0, 0.0, 9), "hours (a step of 1.00e-2 s)"),
        (rows(60.0, 0.0, 9), "minutes (a step of 1.00e-2 s)"),
        (rows(1e9, 0.0, 14), "another unit"),
    ] {
        let found = warnings(&text, &RecordOptions::default());
        assert!(found.iter().any(|w| w.starts_with("step: ") && w.contains(unit)), "{unit}: {found:?}");
    }
    let text = rows(60.0, 0.0, 9);
    for (name, step) in [("time [min]", None), ("t (days)", None), ("time [h]", Some(0.01))] {
        let options = RecordOptions { step, ..RecordOptions::default() };
        refused(&text.replacen("time", name, 1), &options, &["line 1", "times in s"]);
    }
    let found = warnings(&column("a [m/s2]\n"), &RecordOptions { step: Some(1e-5), ..Default::default() });
    assert!(found.iter().any(|warning| warning.starts_with("step: 1.000e-5 s")), "{found:?}");
}

#[test]
fn units_of_other_quantities_are_not_overridden() {
    for unit in [
        "V",
        "mV",
        "counts",
        "Counts",
        "count",
        "digits",
        "LSB",
        "V/g",
        "mV/(m/s2)",
        "µV",
        "cts",
        "volts",
        "microstrain",
        "µε",
        "foo",
        "N",
        "bar",
        "%",
        "kN",
        "raw",
        "au",
        "mm/s3",
    ] {
        let reason = match unit {
            "microstrain" | "µε" | "foo" | "N" | "bar" | "%" | "kN" | "raw" | "au" | "mm/s3" => {
                "correct the unit"
            }
            _ => "the response of the instrument",
        };
        for text in [
            table(&format!("t [s],a [{unit}]\n"), ",", "", "."),
            table(&format!("t [s];\"a [{unit}]\"\n"), ";", "", ","),
            table(&format!("# t [s], a [{unit}]\n"), ",", "", "."),
            column(&format!("acc [{unit}]\n")),
        ] {
            let step = text.starts_with("acc").then_some(0.01);
            for options in [RecordOptions { step, ..si() }, RecordOptions { step, ..Default::default() }] {
                refused(&text, &options, &["line 1", &format!("`{unit}`"), reason, "does not override"]);
            }
        }
    }
    for name in ["a (V)", "a (counts)", "a_mV", "acc_counts", "acc, counts", "acc (volts)"] {
        refused(&table(&format!("t [s];{name}\n"), ";", "", "."), &si(), &["line 1", "the instrument"]);
    }
    refused(&table("time,acc\ns,counts\n", ",", "", "."), &si(), &["line 1", "the instrument"]);
    // above the columns
    for header in ["# unit: counts\ntime,a\n", "NS (counts)\ntime,a\n", "# Units of mV\n"] {
        refused(&table(header, ",", "", "."), &si(), &["line 1", "the instrument"]);
    }
    for header in ["# units: m/s2\n", "Acceleration (m/s2)\ntime,a\n", "# Unit = m/s^2 of the ground\n"] {
        let text = table(header, ",", "", ".");
        assert_is_the_motion(&crate::read("x.csv", &text, &RecordOptions::default()).unwrap());
        let gal = RecordOptions { unit: Some(Unit::CentimetrePerSecondSquared), ..Default::default() };
        refused(&text, &gal, &["line 1", "the stated unit cm/s2, found m/s2"]);
    }
    for header in ["# United States, 2016\n", "# scaled to 0.3g\n", "# x (0.3g)\n", "# t [s] a [g]\nx y\n"] {
        let text = table(header, " ", "", ".").replace("x y", "time y");
        assert_is_the_motion(&crate::read("x.csv", &text, &si()).unwrap());
    }
    // directions and remarks in round brackets
    for name in ["a (N/S)", "a (EW)", "a (corrected)", "a_raw"] {
        let text = table(&format!("t [s],{name}\n"), ",", "", ".");
        assert_is_the_motion(&crate::read("x.csv", &text, &si()).unwrap());
    }
}

#[test]
fn quoted_cells_may_have_separators_and_line_breaks() {
    for header in [
        "time,\"acc; NS [m/s2]\"\n",
        "\"time, of the day\",acc [m/s2]\n",
        "\"time\n[s]\",\"acc\n[m/s2]\"\n",
        "\"time\r\n[s]\",\"acc\r\n\r\n[m/s2]\"\r\n",
        "time,\"acc \"\"NS\"\" [m/s2]\"\n",
        "\"El Centro;\n1940\"\ntime,acc [m/s2]\n",
        "Pipe 12\", \"\ntime,acc [m/s2]\n",
    ] {
        // the first name is one that is known
        let text = table(header, ",", "", ".").replacen("\"time, of the day\"", "time", 1);
        let record = crate::read("x.csv", &text, &RecordOptions::default());
        assert_is_the_motion(&record.unwrap_or_else(|error| panic!("{header}: {error}")));
    }
    let tabs = table("\"time\n[s]\"\t\"acc, NS\n[m/s2]\"\n", "\t", "", ".");
    assert_is_the_motion(&crate::read("x.csv", &tabs, &RecordOptions::default()).unwrap());
    let semicolons = table("\"time\";\"acc, NS [m/s2]\"\n", ";", "", ",");
    assert_is_the_motion(&crate::read("x.csv", &semicolons, &RecordOptions::default()).unwrap());
    let one = column("\"acc\n[m/s2]\"\n");
    assert_is_the_motion(
        &crate::read("x.csv", &one, &RecordOptions { step: Some(0.01), ..Default::default() }).unwrap(),
    );
    let broken = table("time,a\n", ",", "", ".").replace("\n1.00,", "\n1.00,\"\n");
    refused(&broken, &si(), &["line 102"]);
}

#[test]
fn files_of_other_programs_are_read_or_named() {
    // a title, the number of samples and the step, then the samples, as eqsig has them
    for head in ["Some record\n401 0.01\n", "# Some record\n401 0.01\n", "401 0.01\n", "401\t1.0E-02\n"] {
        for text in [column(head), head.to_owned() + &numbers()] {
            assert_is_the_motion(&crate::read("x.txt", &text, &si()).unwrap());
            assert_mentions(
                &crate::read("x.txt", &text, &RecordOptions::default()).unwrap_err(),
                &["expected a unit", "--unit"],
            );
        }
    }
    refused(&column("Some record\n400 0.01\n"), &si(), &["400 samples", "found 401"]);
    let slist = crate::specimen::fdsn::slist(&crate::specimen::SAMPLES);
    let counts = slist.replace("FLOAT, CM/S**2", "INTEGER, COUNTS");
    refused(&counts, &with_step(0.01), &["line 1", "`COUNTS`", "the response of the instrument"]);
    refused(
        &slist.replace("11 samples", "12 samples"),
        &RecordOptions::default(),
        &["12 samples", "found 11"],
    );
    let without = slist.replace(", CM/S**2", "");
    refused(&without, &RecordOptions::default(), &["line 1", "a unit of acceleration", "--unit"]);
    assert_eq!(crate::read("x.txt", &without, &si()).unwrap().unit, Unit::MetrePerSecondSquared);
    // a gap starts a new segment
    refused(&(slist.clone() + &slist), &RecordOptions::default(), &["line 4", "found `TIMESERIES`"]);
    // pairs in one sequence of numbers
    let pair = |(i, a): (usize, &f64)| format!("{:.4} {a:.5} ", 0.01 * i as f64 + 0.001 * (i as f64).sin());
    let pairs: Vec<String> = motion().iter().enumerate().map(pair).collect();
    let words: Vec<String> = pairs.concat().split_whitespace().map(str::to_owned).collect();
    let text = words.chunks(3).map(|row| row.join(" ") + "\n").collect::<String>();
    refused(&text, &with_step(0.01), &["pairs of times and accelerations", "two columns"]);
}

/// USGS SMC with pairs, also where the header states the samples a second.
#[test]
fn pairs_of_smc_are_refused() {
    let mut samples = Vec::new();
    for (i, a) in motion().iter().enumerate() {
        samples.extend([0.01 * i as f64, (1e5 * a).round() / 1e3]);
    }
    let text = crate::specimen::smc(&samples).replace("2 CORRECTED", "1 UNCORRECTED");
    let error = crate::read("x.smc", &text, &RecordOptions::default()).unwrap_err();
    assert_mentions(&error, &["x.smc, line ", "pairs of times and accelerations"]);
}

#[test]
fn binary_files_and_pages_are_named() {
    let mut sac = vec![0; 700];
    sac[304] = 6;
    let mut mseed = b"000001D STA1   HNEXX".to_vec();
    mseed.resize(512, 0);
    let mut texts = vec![
        (b"\x1f\x8b\x08\0\0".to_vec(), ["a compressed file", "decompress"]),
        (b"BZh91AY&SY\0".to_vec(), ["a compressed file", "decompress"]),
        (b"PK\x03\x04\x14\0\0\0".to_vec(), ["an archive or a workbook", "CSV UTF-8"]),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1".to_vec(), ["or a workbook", "CSV UTF-8"]),
        (sac, ["SAC", "rw.Record.from_trace"]),
        (mseed, ["miniSEED", "rw.Record.from_trace"]),
        (b"MS\x03\x00abc".to_vec(), ["miniSEED", "rw.Record.from_trace"]),
    ];
    for page in ["<!DOCTYPE html>\n<html>", "\u{feff}\n<HTML><body>", "<?xml version=\"1.0\"?>"] {
        texts.push((page.into(), ["a web page", "fetch the file again"]));
    }
    for (bytes, words) in texts {
        for name in ["x.AT2", "x.csv", "x"] {
            let error = parse(name, bytes.clone(), &with_step(0.01)).unwrap_err().to_string();
            assert_mentions(&error, &[name, "line 1", words[0], words[1]]);
        }
        let error = utf8_text(bytes, "a table").unwrap_err().to_string();
        assert_mentions(&error, &words);
    }
}

/// Line breaks and tabs in a path come from escapes of TOML.
#[test]
fn escapes_in_paths_are_named() {
    let mut message = String::new();
    let _ = write!(message, "{}", ground_motion::read("records\new\test.AT2", &si()).unwrap_err());
    assert_mentions(&message, &["records\\new\\test.AT2", "cannot be read", "single quotes"]);
    assert!(!message.contains(['\n', '\t']), "{message}");
}
