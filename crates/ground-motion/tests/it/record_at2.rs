//! PEER AT2 files: the variants in use, and what is refused.

use ground_motion::{Format, Record, RecordOptions, STANDARD_GRAVITY, Unit, parse};
use proptest::prelude::*;

use crate::assert_mentions;

const HEADER: &str = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/1/2000, Station, 90\n";
const UNITS: &str = "ACCELERATION TIME SERIES IN UNITS OF G\n";
const COUNT: &str = "NPTS= 6, DT= .005 SEC";
/// Six samples over two lines, in g.
const SAMPLES: &str = "  -.8075668E-03   .1000000E+00   .2500000E-01   0.5  -1.\n   .3\n";
const VALUES: [f64; 6] = [-0.000_807_566_8, 0.1, 0.025, 0.5, -1.0, 0.3];

/// A file with a line of count and step, and with samples.
fn file(count: &str, samples: &str) -> String {
    format!("{HEADER}{UNITS}{count}\n{samples}")
}

fn read(text: &str) -> Result<Record, String> {
    read_with(text, &RecordOptions::default())
}

fn read_with(text: &str, options: &RecordOptions) -> Result<Record, String> {
    crate::read("x.AT2", text, options)
}

#[track_caller]
fn assert_holds_the_samples(record: &Record, step: f64) {
    assert_eq!(record.format, Format::At2);
    assert_eq!(record.unit, Unit::StandardGravity);
    assert_eq!(record.motion.step(), step);
    assert_eq!(record.motion.samples(), VALUES.map(|a| a * STANDARD_GRAVITY));
}

#[test]
fn reads_every_form_of_the_count_line() {
    for (line, step) in [
        ("NPTS=      6, DT=   .0050 SEC,   ", 0.005),
        ("NPTS=  6, DT= .0100 SEC,   0 POLE @    13.90000 HZ,  -5 POLE @     .10000", 0.01),
        ("NPTS=  6, DT= .01000 SEC", 0.01),
        ("NPTS=6,DT=0.00244SEC", 0.002_44),
        ("  6   0.00290   NPTS, DT", 0.0029),
        ("6 0.00500 NPTS, DT", 0.005),
        ("npts = 6, dt = 5.0e-3 sec", 0.005),
        ("NPTS: 6, DT: 5.0D-3", 0.005),
    ] {
        let record = read(&file(line, SAMPLES)).unwrap();
        assert_holds_the_samples(&record, step);
    }
}

#[test]
fn searches_for_the_count_line_between_blank_lines() {
    let text = format!("\u{feff}\n{HEADER}\n\n{UNITS}one more line\nNPTS= 6, DT= .005 SEC\n\n{SAMPLES}\n\n");
    let unix = read(&text).unwrap();
    assert_holds_the_samples(&unix, 0.005);
    assert_eq!(unix.header[0], "PEER NGA STRONG MOTION DATABASE RECORD");
    for ending in ["\r\n", "\r\r\n"] {
        assert_eq!(read(&text.replace('\n', ending)).unwrap(), unix, "{ending:?}");
    }
}

#[test]
fn separates_numbers_that_touch() {
    let touching = "-.8075668E-03+.1000000E+00 .2500000E-01 0.5-1.\n.3D+00\n";
    assert_holds_the_samples(&read(&file(COUNT, touching)).unwrap(), 0.005);
}

#[test]
fn reads_a_station_name_in_latin_1() {
    let mut bytes = b"Ca\xf1on, 1/1/1980\n".to_vec();
    bytes.extend_from_slice(format!("{UNITS}{COUNT}\n{SAMPLES}").as_bytes());
    let record = parse("x.AT2", bytes, &RecordOptions::default()).unwrap();
    assert_holds_the_samples(&record, 0.005);
    assert_eq!(record.header[0], "Cañon, 1/1/1980");
}

#[test]
fn takes_the_unit_from_the_text() {
    for (units, unit) in [
        (
            "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=33.0 Hz",
            Unit::StandardGravity,
        ),
        ("The units are (g)", Unit::StandardGravity),
        ("ACCELERATION TIME SERIES IN UNITS OF CM/SEC/SEC", Unit::CentimetrePerSecondSquared),
        ("Units: mm/s^2, corrected", Unit::MillimetrePerSecondSquared),
        ("units of m/s2", Unit::MetrePerSecondSquared),
    ] {
        let record = read(&format!("{HEADER}{units}\n{COUNT}\n{SAMPLES}")).unwrap();
        assert_eq!(record.unit, unit, "{units}");
        assert_eq!(record.motion.samples(), VALUES.map(|a| unit.to_si(a)));
    }
    // If the file states nothing, the user's value counts; a value that contradicts the file is an error.
    let gal = RecordOptions { unit: Some(Unit::CentimetrePerSecondSquared), ..RecordOptions::default() };
    for units in ["", "IN UNITS AS BEFORE\n"] {
        let text = format!("{HEADER}{units}{COUNT}\n{SAMPLES}");
        assert_eq!(read_with(&text, &gal).unwrap().unit, Unit::CentimetrePerSecondSquared);
        let error = read(&text).unwrap_err();
        assert!(error.contains("line 3: expected a unit") && error.contains("state the unit"), "{error}");
    }
    for options in [&RecordOptions::default(), &gal] {
        let text = format!("{HEADER}IN UNITS OF COUNTS\n{COUNT}\n{SAMPLES}");
        let error = read_with(&text, options).unwrap_err();
        assert!(error.contains("line 3: expected a unit") && error.contains("the instrument"), "{error}");
    }
    let error = read_with(&file(COUNT, SAMPLES), &gal).unwrap_err();
    assert!(error.contains("x.AT2, line 3: expected the stated unit cm/s2, found g"), "{error}");
}

#[test]
fn refuses_a_step_that_contradicts_the_file() {
    let text = file(COUNT, SAMPLES);
    let with_step = |step| read_with(&text, &RecordOptions { step: Some(step), ..RecordOptions::default() });
    assert!(with_step(0.005).is_ok());
    let error = with_step(0.01).unwrap_err();
    assert!(error.contains("line 4: expected the stated step of 0.01 s, found 0.005 s"), "{error}");
    assert!(with_step(f64::NAN).unwrap_err().contains("time step"));
}

#[test]
fn refuses_damaged_files() {
    for (text, fragments) in [
        (file("NPTS= 7, DT= .005 SEC", SAMPLES), &["line 6", "7 samples", "NPTS on line 4", "found 6"][..]),
        (file("NPTS= 5, DT= .005 SEC", SAMPLES), &["5 samples", "found 6"]),
        (file("NPTS= 99999999999999999999, DT= .005 SEC", SAMPLES), &["line 4", "NPTS"]),
        (file("NPTS= 6, DT= 0 SEC", SAMPLES), &["line 4", "DT= 0"]),
        (file("NPTS= 6, DT= nan SEC", SAMPLES), &["line 4"]),
        (file("NPTS= 6, DT= 5.0 MSEC", SAMPLES), &["line 4", "must be in seconds"]),
        (file("NPTS= 6", SAMPLES), &["line 4"]),
        (file("NPTS, DT", SAMPLES), &["line 4"]),
        (file("NPTS= 1, DT= .005 SEC", ".1\n"), &["line 5", "at least two samples", "found 1"]),
        (file("NPTS= 2, DT= 1e308 SEC", ".1 NaN\n"), &["line 5", "`NaN`"]),
        (file("NPTS= 3, DT= 1e308 SEC", ".1 .2 .3\n"), &["line 5", "time step"]),
        (file("NPTS= 2, DT= .005 SEC", ".1 inf\n"), &["line 5", "`inf`"]),
        (file("NPTS= 2, DT= .005 SEC", ".1 1e308\n"), &["line 5", "`1e308`"]),
        (file("NPTS= 2, DT= .005 SEC", ".1\n\n*******\n"), &["line 7", "`*******`"]),
        (file("NPTS= 2, DT= .005 SEC", ".123.456\n"), &["line 5", "`.123.456`"]),
        (
            format!("{HEADER}VELOCITY TIME SERIES IN UNITS OF CM/S\n{COUNT}\n{SAMPLES}"),
            &["line 3", "an acceleration record", "VELOCITY"],
        ),
        (format!("{HEADER}{UNITS}{SAMPLES}"), &["line 1", "NPTS", "PEER NGA"]),
        (String::new(), &["line 1", "an empty file"]),
    ] {
        let error = read(&text).unwrap_err();
        assert!(error.starts_with("x.AT2, line "), "{error}");
        assert_mentions(&error, fragments);
    }
}

proptest! {
    #![proptest_config(crate::configuration::configuration())]

    #[test]
    fn reads_what_was_written(samples in prop::collection::vec(-1.0..1.0, 2..100), width in 1_usize..9) {
        let mut text = format!("{HEADER}{UNITS}NPTS= {}, DT= .0050 SEC\n", samples.len());
        for line in samples.chunks(width) {
            // No blanks: each sign starts a number.
            let line: Vec<_> = line.iter().map(|a: &f64| format!("{a:+e}")).collect();
            text += &(line.concat() + "\r\r\n");
        }
        let expected: Vec<_> = samples.iter().map(|a| a * STANDARD_GRAVITY).collect();
        let motion = read(&text).unwrap().motion;
        prop_assert_eq!(motion.samples(), expected);
    }

    #[test]
    fn never_panics(head in "[ -~\n]{0,60}", count in "[0-9 .,=A-Z-]{0,20}", body in "[0-9 .+eED\n-]{0,80}") {
        let _ = read(&format!("{head}\nunits of g\nNPTS{count}\n{body}"));
        let _ = read(&format!("units {head}\n{count} NPTS, DT\n{body}"));
    }
}
