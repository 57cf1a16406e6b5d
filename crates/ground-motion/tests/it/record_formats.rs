//! Every format: recognised by its content, read to the digit, and refused with one clear message when
//! damaged.

use ground_motion::{
    Format, GroundMotionError, Record, RecordOptions, STANDARD_GRAVITY, Unit, parse, parse_channels,
};
use proptest::prelude::*;

use crate::assert_mentions;
use crate::configuration::configuration;
use crate::specimen::{self, ALL, SAMPLES, STEP, Writer, csmip_channels, options, unit};

fn read(text: &str, options: &RecordOptions) -> Result<Record, String> {
    crate::read("x", text, options)
}

/// The samples come from at most ten digits, a mean and a division: a few roundings of the largest.
#[track_caller]
fn assert_holds(record: &Record, samples: &[f64]) {
    assert_eq!(record.motion.step(), STEP);
    assert_eq!(record.motion.samples().len(), samples.len());
    for (found, expected) in record.motion.samples().iter().zip(samples) {
        assert!((100.0 * found - expected).abs() < 1e-9, "{found} m/s² instead of {expected} cm/s²");
    }
}

#[test]
fn the_content_tells_the_format() {
    for (format, write) in ALL {
        for text in [write(&SAMPLES), write(&SAMPLES).replace('\n', "\r\n"), write(&SAMPLES) + "\u{1a}"] {
            // A file name without an extension, or with another one.
            for name in ["x", "x.txt", if format == Format::Csv { "x.csv" } else { "x.V2" }] {
                let record = parse(name, text.clone().into_bytes(), &options(format)).unwrap();
                assert_eq!(record.format, format);
                assert_eq!(record.unit, unit(format));
                assert_holds(&record, &SAMPLES);
            }
        }
        assert_eq!(format.name().parse::<Format>().unwrap(), format);
    }
}

#[test]
fn headers_state_their_peak_and_channel() {
    for (format, write) in ALL {
        let record = read(&write(&SAMPLES), &options(format)).unwrap();
        let expected = !matches!(format, Format::At2 | Format::Csv | Format::Fdsn | Format::KnetCsv)
            && !record.header.iter().any(|line| line.contains("VOL1DS"));
        assert_eq!(record.stated_peak.is_some(), expected, "{format:?}");
        if let Some(stated) = record.stated_peak {
            assert!((stated - 1.032_5).abs() < 1e-9, "{format:?}: {stated}");
        }
        let channels: &[Option<&str>] = match format {
            Format::Csmip => &[Some("1: 90 Deg")],
            Format::Cosmos => &[Some("2: 90 Deg")],
            Format::Geonet => &[Some("1: N10E")],
            Format::Afad | Format::KnetCsv => &[Some("1: N-S")],
            Format::Cwa => &[Some("1: N")],
            Format::Unam => &[Some("1: N00E")],
            Format::Volume1 => &[Some("1: L"), Some("1: L1")],
            _ => &[None],
        };
        assert!(channels.contains(&record.channel.as_deref()), "{format:?}: {:?}", record.channel);
        assert!(!record.header.is_empty(), "{format:?}");
    }
}

#[test]
fn line_ends_and_blank_lines_do_not_matter() {
    for (format, write) in ALL {
        for ending in ["\r\n", "\r\r\n", "\n\n", " \n", "\r\n\r\n"] {
            let text = write(&SAMPLES).replace('\n', ending);
            let record = read(&text, &options(format));
            assert_holds(
                &record.unwrap_or_else(|error| panic!("{format:?} with {ending:?}: {error}")),
                &SAMPLES,
            );
        }
    }
}

#[test]
fn a_stated_format_is_the_one_tried() {
    for (format, write) in ALL {
        for (other, _) in ALL {
            let options =
                RecordOptions { format: Some(other), unit: Some(unit(format)), ..RecordOptions::default() };
            let outcome = read(&write(&SAMPLES), &options);
            // with one component it is a table below comments
            let is_table = (format, other) == (Format::Cwa, Format::Csv);
            assert_eq!(outcome.is_ok(), format == other || is_table, "{format:?} read as {other:?}");
        }
    }
}

/// What may follow a parenthesis in a heading.
#[test]
fn a_stated_layout_is_used() {
    let wide = |a: &f64| format!("{a:12.4E}");
    let rows = |per_line: usize| -> String {
        let rows = SAMPLES.chunks(per_line).map(|row| row.iter().map(wide).collect::<String>() + "\n");
        rows.collect()
    };
    let text = specimen::csmip(&SAMPLES);
    let start = text.find("in cm/sec2.").unwrap();
    let end = text.find("    11 points of veloc").unwrap();
    for (format, per_line) in
        [("(6e12.4)", 6), ("(1P3E12.4)", 3), ("( 4 F 12.4 )", 4), ("(old style) (1E12.4)", 1)]
    {
        let text = format!("{}in cm/sec2. {format}\n{}{}", &text[..start], rows(per_line), &text[end..]);
        assert_holds(&read(&text, &RecordOptions::default()).unwrap(), &SAMPLES);
    }
}

#[test]
fn units_and_steps_must_not_contradict_the_file() {
    for (format, write) in ALL {
        let text = write(&SAMPLES);
        if format != Format::Csv {
            let options =
                RecordOptions { unit: Some(Unit::MetrePerSecondSquared), ..RecordOptions::default() };
            let error = read(&text, &options).unwrap_err();
            let contradiction = format!("expected the stated unit m/s2, found {}", unit(format));
            assert!(error.contains(&contradiction), "{format:?}: {error}");
        }
        let error = read(&text, &RecordOptions { step: Some(0.02), ..options(format) }).unwrap_err();
        assert!(error.contains("expected the stated step of 0.02 s, found 0.01 s"), "{format:?}: {error}");
        assert!(read(&text, &RecordOptions { step: Some(0.01), ..options(format) }).is_ok(), "{format:?}");
    }
}

#[test]
fn other_units_are_read_where_the_file_states_them() {
    let in_g = |text: String, from: &str, to: &str| {
        assert!(text.contains(from), "{from} in {text}");
        read(&text.replace(from, to), &RecordOptions::default()).unwrap()
    };
    for record in [
        in_g(specimen::cosmos(&SAMPLES), "cm/sec2(04)", "g(02)"),
        in_g(specimen::csmip(&SAMPLES), "in cm/sec2.", "in g."),
        in_g(specimen::at2(&SAMPLES), "CM/S2", "G"),
    ] {
        assert_eq!(record.unit, Unit::StandardGravity);
        assert!((record.motion.peak() - 103.25 * STANDARD_GRAVITY).abs() < 1e-9);
    }
    // Counts are no acceleration, whatever the user states; where the text is not a unit, that counts.
    let stated = RecordOptions { unit: Some(Unit::MillimetrePerSecondSquared), ..RecordOptions::default() };
    let text = specimen::csmip(&SAMPLES).replace("in cm/sec2.", "in counts.");
    for options in [&RecordOptions::default(), &stated] {
        let error = read(&text, options).unwrap_err();
        assert_mentions(&error, &["a unit of acceleration, found `counts`", "response of the instrument"]);
    }
    let text = specimen::csmip(&SAMPLES).replace("in cm/sec2.", "in unknown.");
    assert_eq!(read(&text, &stated).unwrap().unit, Unit::MillimetrePerSecondSquared);
}

#[test]
fn a_channel_is_picked_by_number_or_name() {
    let other: Vec<f64> = SAMPLES.iter().map(|a| a / 2.0).map(|a| (1e3 * a).round() / 1e3).collect();
    let text = csmip_channels(&[(1, " 90 Deg", &SAMPLES), (2, " Up", &other[..7]), (3, " 360 Deg", &other)]);
    let with = |channel: &str| {
        read(&text, &RecordOptions { channel: Some(channel.to_owned()), ..RecordOptions::default() })
    };
    assert_holds(&with("1").unwrap(), &SAMPLES);
    assert_holds(&with("2").unwrap(), &other[..7]);
    assert_holds(&with("3: 360 deg").unwrap(), &other);
    let all = parse_channels("x", text.clone().into_bytes(), &RecordOptions::default()).unwrap();
    let names: Vec<_> = all.iter().map(|record| record.channel.clone().unwrap()).collect();
    assert_eq!(names, ["1: 90 Deg", "2: Up", "3: 360 Deg"]);
    for error in [read(&text, &RecordOptions::default()).unwrap_err(), with("4").unwrap_err()] {
        assert!(error.contains("expected one channel"), "{error}");
        assert!(error.contains("found `1: 90 Deg`, `2: Up`, `3: 360 Deg`; state"), "{error}");
    }
    for (format, write) in ALL {
        let options = RecordOptions { channel: Some("9".into()), ..options(format) };
        let error = parse("x", write(&SAMPLES).into_bytes(), &options).unwrap_err();
        assert!(matches!(error, GroundMotionError::Channel { .. }), "{error}");
    }
    // Two COSMOS records in one file, and two channels of the same number.
    let twice = specimen::cosmos(&SAMPLES) + &specimen::cosmos(&SAMPLES).replace("  2: 90", "  ?: Up");
    let options = RecordOptions { channel: Some("2".into()), ..RecordOptions::default() };
    let error = read(&twice, &options).unwrap_err();
    assert!(error.contains("found `2: 90 Deg`, `2: Up Deg`"), "{error}");
    assert_holds(
        &read(&twice, &RecordOptions { channel: Some("2: Up Deg".into()), ..options }).unwrap(),
        &SAMPLES,
    );
}

/// Damage to a file, and words that the message must contain.
#[test]
fn damage_is_named_with_its_line() {
    use specimen::{at2, cosmos, csmip, esm, knet, smc};
    let cases: [(Writer, &str, &str, &[&str]); 25] = [
        (at2, "NPTS=     11", "NPTS=     12", &["line 7", "12 samples", "found 11"]),
        (esm, "NDATA: 11", "NDATA: 12", &["line 75", "12 samples, as NDATA on line 6", "found 11"]),
        (esm, "NDATA: 11", "NDATA: many", &["line 6", "NDATA", "`many`"]),
        (esm, "NDATA: 11", "NDATA:", &["line 6", "a value for `NDATA` in the header, found none"]),
        (esm, "NDATA: 11\n", "", &["line 63", "a value for `NDATA` in the header, found none"]),
        (esm, "cm/s^2", "cm", &["line 8", "a unit of acceleration, found `cm`"]),
        (esm, "ACCELERATION", "VELOCITY", &["line 10", "an acceleration record", "`VELOCITY`"]),
        (esm, "S: 0.010000", "S: -0.01", &["line 5", "SAMPLING_INTERVAL_S", "`-0.01`"]),
        (esm, "\n22.750000", "\nNaN", &["line 67", "one finite number, found `NaN`"]),
        (knet, "0.11\n", "60\n", &["line 19", "6000 samples, as Duration", "line 12", "found 11"]),
        (knet, "2000(gal)/2000000", "2000/2000000", &["line 14", "a scale factor", "`2000/2000000`"]),
        (knet, "2000(gal)/2000000", "2000(gal)/0", &["line 14", "a scale factor"]),
        (knet, "100Hz", "fast", &["line 11", "a positive number", "`fast`"]),
        (knet, "-13500", "-13.5", &["line 18", "a whole number, found `-13.5`"]),
        (cosmos, "   11 acc", "   12 acc", &["line 41", "number (12 of 12, as line 38", "`End-of-dat`"]),
        (cosmos, "   11 acc", "    8 acc", &["line 40", "an end after 8 numbers, as line 38"]),
        (cosmos, "   11 acc", "    9 acc", &["line 40", "an end after 9 numbers", "`-1.250`"]),
        (cosmos, "      10.000000", "       0.000000", &["real header 62", "found none"]),
        (cosmos, "approx    0 secs", "approx   60 secs", &["line 38", "about 0.11 s", "approx 60 s"]),
        (cosmos, "(8F10.3)", "(as before)", &["line 38", "a format such as"]),
        (cosmos, "acceleration pts", "velocity pts", &["line 38", "expected acceleration data"]),
        (csmip, "    11 points of accel", "    10 points of accel", &["line 30", "an end after 10"]),
        (csmip, "   -60.500", " *********", &["line 29", "8 of 11, as line 28", "`*********`"]),
        (smc, "         2\n", "         3\n", &["line 30", "3 comment lines"]),
        (smc, "\n        11", "\n      1100", &["line 31", "1100 samples", "found 11"]),
    ];
    for (write, from, to, words) in cases {
        let text = write(&SAMPLES);
        assert!(text.contains(from), "{from:?} is not in\n{text}");
        let error = read(&text.replacen(from, to, 1), &RecordOptions::default()).unwrap_err();
        assert_mentions(&error, words);
    }
}

/// A peak that is not that of the samples is warned of.
#[test]
fn another_peak_is_warned_of() {
    let text = specimen::esm(&SAMPLES).replacen("-103.250000\nDATA", "-105.375\nDATA", 1);
    let record = read(&text, &RecordOptions::default()).unwrap();
    let warnings: Vec<String> = record.check().warnings.iter().map(ToString::to_string).collect();
    let words = "peak: the samples have 1.03250 m/s², the file states 1.05375 m/s²";
    assert!(warnings.iter().any(|warning| warning == words), "{warnings:?}");
}

/// Checks that a message is one short line with the file, the line if there is one, what was expected and
/// what was found.
#[track_caller]
pub(super) fn assert_clear(error: &str, what: &str) {
    assert_clear_of("x", error, what);
}

/// The same for a file of any name.
#[track_caller]
pub(super) fn assert_clear_of(file: &str, error: &str, what: &str) {
    let rest = error.strip_prefix(file).unwrap_or_else(|| panic!("{what}: {error}"));
    assert!(rest.starts_with(", line ") || rest.starts_with(": expected"), "{what}: {error}");
    assert!(error.contains("expected ") && error.contains("found "), "{what}: {error}");
    assert!(error.len() < 700 && !error.contains('\n'), "{what}: {error}");
}

#[test]
fn a_file_cut_short_is_refused_wherever_it_is_cut() {
    for (format, write) in ALL {
        let text = write(&SAMPLES);
        let options = RecordOptions { format: Some(format), ..options(format) };
        // Cuts beyond this place lose only blanks or the closing line.
        let ends: &[&str] = match format {
            Format::Csmip | Format::Volume1 => &["/&"],
            Format::Cosmos => &["End-of-data"],
            _ => &[],
        };
        let end = ends.iter().find_map(|end| text.rfind(end)).unwrap_or(text.len());
        let whole = text[..end].trim_end().len();
        for at in 0..whole {
            match read(&text[..at], &options) {
                Err(error) => assert_clear(&error, &format!("{format:?} cut at {at}")),
                // A CSV file states no count and misses rows unnoticed.
                Ok(_) if format == Format::Csv => {}
                // The last number may have lost digits: a fixed width or a stated peak cannot show that.
                Ok(record) => {
                    assert_eq!(record.motion.samples().len(), SAMPLES.len(), "{format:?} cut at {at}");
                    assert!(whole - at < 15, "{format:?} cut at {at} of {whole} was read");
                }
            }
        }
    }
}

#[test]
fn hostile_numbers_and_blanks_give_one_clear_message() {
    for (format, write) in ALL {
        let options = options(format);
        let text = write(&SAMPLES);
        // The third sample, as each format writes it.
        let third = match format {
            Format::At2 => "   2.275000E1",
            Format::Knet => "   10750",
            Format::Smc => " 2.2750E1",
            Format::Csv if text.contains("22,75") => "22,75",
            Format::Csv => "22.75",
            Format::Esm => "22.750000",
            Format::Geonet => "  227.50",
            Format::Afad => "      22.750000",
            Format::Unam => "   22.7500",
            Format::Fdsn | Format::KnetCsv => "22.750",
            Format::Volume1 if text.contains("RENADIC") => "   0.231985438452",
            Format::Volume1 => "  2.319854384525E-1",
            _ => "   22.750",
        };
        assert!(text.contains(third), "{format:?}: {text}");
        for hostile in ["NaN", "inf", "*", ".", "-", "1e999", "..", "1.2.3", "é", "0x10", "--1"] {
            let hostile = format!("{hostile:>width$}", width = third.len());
            let error = read(&text.replacen(third, &hostile, 1), &options).unwrap_err();
            assert_clear(&error, &format!("{format:?} with {hostile:?}"));
        }
        let stars = "*".repeat(third.len());
        assert_clear(&read(&text.replacen(third, &stars, 1), &options).unwrap_err(), "stars");
        for blanks in
            [" ".repeat(1 << 20), "\n".repeat(1 << 20), "\t".repeat(1 << 20), " \r\r\n".repeat(1 << 18)]
        {
            let forced = RecordOptions { format: Some(format), ..options.clone() };
            assert_clear(&read(&blanks, &forced).unwrap_err(), &format!("{format:?} of blanks"));
            // Any number of blanks at the end is accepted.
            assert_holds(&read(&(text.clone() + &blanks), &options).unwrap(), &SAMPLES);
        }
    }
}

proptest! {
    #![proptest_config(configuration())]

    /// Samples written in a format come back.
    #[test]
    fn reads_what_was_written(thousandths in prop::collection::vec(-900_000_i32..900_000, 2..60)) {
        let mut samples: Vec<_> = thousandths.iter().map(|&value| f64::from(value) / 1000.0).collect();
        for (format, write) in ALL {
            if format == Format::Knet {
                // Without a mean, which the reader takes off.
                let mirrored: Vec<_> = samples.iter().map(|a| -a).collect();
                samples.extend(mirrored);
            }
            let record = read(&write(&samples), &options(format)).map_err(TestCaseError::fail)?;
            prop_assert_eq!(record.format, format);
            prop_assert_eq!(record.motion.samples().len(), samples.len());
            // SMC has five digits.
            let tolerance = if format == Format::Smc { 0.1 } else { 1e-8 };
            for (found, expected) in record.motion.samples().iter().zip(&samples) {
                prop_assert!((100.0 * found - expected).abs() < tolerance, "{format:?}: {found}, {expected}");
            }
        }
    }
}
