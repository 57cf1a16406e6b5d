//! Records as people have them: what is read, and what is refused with a remedy.

use std::fmt::Write;

use ground_motion::{Record, RecordOptions, Unit, Warning};

use crate::assert_mentions;

/// A Ricker motion in m/s²: 401 samples 0.01 s apart.
pub(crate) fn motion() -> Vec<f64> {
    let at = |i: i32| {
        let x = (std::f64::consts::PI * 1.5 * (0.01 * f64::from(i) - 2.0)).powi(2);
        1.5 * (1.0 - 2.0 * x) * (-x).exp()
    };
    (0..401).map(at).collect()
}

/// A table of times and samples: a header, what stands between the cells and behind the rows, and the decimal
/// mark.
pub(crate) fn table(header: &str, between: &str, behind: &str, mark: &str) -> String {
    let mut text = header.to_owned();
    for (i, a) in motion().iter().enumerate() {
        let (time, a) = (format!("{:.2}", 0.01 * i as f64), format!("{a:.6}"));
        let _ = writeln!(text, "{}{between}{}{behind}", time.replace('.', mark), a.replace('.', mark));
    }
    text
}

/// A PEER AT2 file in g.
pub(crate) fn at2(units: &str, count: &str) -> String {
    let mut text = format!("PEER NGA STRONG MOTION\nSomewhere, 1/1/2000, Station, 090\n{units}\n{count}\n");
    for line in motion().chunks(5) {
        for a in line {
            let _ = write!(text, "{:15.7E}", a / 9.806_65);
        }
        text.push('\n');
    }
    text
}

pub(crate) const IN_G: &str = "ACCELERATION TIME SERIES IN UNITS OF G";
pub(crate) const COUNT: &str = "NPTS=   401, DT=   .0100 SEC,";

pub(crate) fn si() -> RecordOptions {
    RecordOptions { unit: Some(Unit::MetrePerSecondSquared), ..RecordOptions::default() }
}

pub(crate) fn with_step(step: f64) -> RecordOptions {
    RecordOptions { step: Some(step), ..si() }
}

/// The samples have six digits or more after the point.
#[track_caller]
pub(crate) fn assert_is_the_motion(record: &Record) {
    assert_eq!((record.motion.samples().len(), record.motion.step()), (401, 0.01));
    for (read, a) in record.motion.samples().iter().zip(motion()) {
        assert!((read - a).abs() < 1e-6, "{read} for {a}");
    }
}

#[test]
fn tables_of_records_are_read() {
    let none = RecordOptions::default();
    let mac = |text: String| text.replace('\n', "\r");
    let header = "time [s],a [m/s2]\n";
    let quoted = table("\"time [s]\",\"a [m/s2]\"\n", "\",\"", "\"", ".").replace("\"\n", "\"\n\"");
    for (text, options) in [
        (table(header, ",", "", "."), &none),
        (mac(table("time,a_g\n", ",", "", ".")), &si()),
        (mac(at2(IN_G, COUNT)), &none),
        (table(header, ",", "", ".") + ",\n,\n , \n", &none),
        (table(header, ",", "", ".") + "\"\",\"\"\n", &none),
        (table("time [s],a [m/s2],\n", ",", ",", "."), &none),
        (table("t [s];a [m/s2];\n", ";", ";", ","), &none),
        (table("t [s];a [m/s2]\n", ";", ";;", ","), &none),
        (quoted.trim_end_matches('"').to_owned(), &none),
        (table("time [s] \t a [m/s2]\n", "\t", "", ","), &none),
        (table("t, a\n", " , ", "", "."), &si()),
        (table("time,acc\ns,m/s2\n", ",", "", "."), &none),
        (table("time acc\n(s) (m/s2)\n", "  ", "", "."), &none),
        (table("time;acc\n[s];[m/s²]\n", ";", "", ","), &none),
        (table("t [s],a [m\u{b7}s\u{207b}\u{b2}]\n", ",", "", "."), &none),
        (table("t [s],a [m.s-2]\n", ",", "", "."), &none),
        (table("Time (s),Acceleration (m / s ^ 2)\n", ",", "", "."), &none),
        (table("Time (s);Acceleration, m/s2\n", ";", "", "."), &none),
        (table("time_s,acc\n", ",", "", "."), &si()),
        (table("time_s,acc_m_s2\n", ",", "", "."), &none),
        (table("time_s,acc_mps2\n", ",", "", "."), &none),
        (table("time,m/s2\n", ",", "", "."), &none),
        (table("t [s],a (N/S)\n", ",", "", "."), &si()),
        (table("t [s],shake_0.3g\n", ",", "", "."), &si()),
        (table("% by MATLAB\n% t [s], a [m/s2]\n", ",", "", "."), &none),
        (table("# Tempo [s], acc [m/s2]\n", ",", "", "."), &none),
        (table("# x, acc [m/s2]\n", ",", "", "."), &none),
        (table("# Norcia, 2016\n", ",", "", "."), &si()),
        (table("% by MATLAB\n% t [s], a (raw)\n", ",", "", "."), &si()),
        (table("#Time [sec] \tAcceleration [m/s2]\n", "    ", "", "."), &si()),
        (table("sep=;\ntime;a_g\n", ";", "", ","), &si()),
        (table("", "  ", "", ".").replace('\n', "D+00\n"), &si()),
        (table("time [s],a [m/s2],v [m/s],d [m]\n", ",", ",1,2", "."), &none),
    ] {
        let start: String = text.chars().take(60).collect();
        let read = crate::read("x.csv", &text, options);
        assert_is_the_motion(&read.unwrap_or_else(|error| panic!("{start:?}: {error}")));
    }
    for count in
        ["NPTS= 401 DT=0.01sec", "NPTS=401\tDT=.01", "DT= .01 (s), NPTS= 401", "NPTS= 401, DT= .01 [SEC]"]
    {
        assert_is_the_motion(&crate::read("x.AT2", &at2(IN_G, count), &none).unwrap());
    }
    for units in ["G'S", "(G)"] {
        let units = IN_G.replace("OF G", "OF ") + units;
        assert_is_the_motion(&crate::read("x.AT2", &at2(&units, COUNT), &none).unwrap());
    }
}

#[test]
fn tables_of_records_are_refused() {
    let header = "time [s],a [m/s2]\n";
    let comma = |header: &str| table(header, ",", "", ".");
    for (text, words) in [
        (comma("// t, a\n"), &["line 1", "`// t, a`", "comments start with # or %"][..]),
        (table("! t, a\n", " ", "", "."), &["line 1", "comments start with # or %"]),
        (comma(header).replace("\n1.00,", "\n// here\n1.00,"), &["line 102", "comments start with # or %"]),
        (comma("time [ms],acc\n"), &["line 1", "times in s", "`time [ms]`", "in seconds"]),
        (comma("time (ms),acc\n"), &["line 1", "times in s", "`time (ms)`"]),
        (comma("time (foo),acc\n"), &["line 1", "times in s", "`time (foo)`"]),
        (comma("# Tempo [ms], acc\n"), &["line 1", "times in s", "`Tempo [ms]`"]),
        (comma("# Tempo [s], acc [cm/s2]\n"), &["line 1", "the stated unit m/s2", "found cm/s2"]),
        (comma("# x, acc [cm/s2]\n"), &["line 1", "the stated unit m/s2", "found cm/s2"]),
        (comma("time_ms,acc\n"), &["line 1", "times in s", "`time_ms`"]),
        (comma("# t [ms], a [m/s2]\n"), &["line 1", "times in s", "`t [ms]`"]),
        (comma("t [s],a [m/s2]\n").replace(',', "|"), &["line 2", "`|` separates no columns"]),
        (comma("t [s],a\n").replace(",-", ",\u{2212}"), &["write minus signs as `-`"]),
        (comma("t [s],a\n").replace("\n1.00,", "\n1.00,it's \"\u{202f}"), &["found `it's \"U+202F-"]),
        (comma("T [s],Sa [m/s2]\n"), &["line 1", "this is a response spectrum"]),
        (comma("t,pSa\n"), &["line 1", "this is a response spectrum"]),
        (comma("time,SA(g)\n"), &["line 1", "`SA(g)`", "this is a response spectrum"]),
        (comma("Period (s),a [m/s2]\n"), &["line 1", "this is a response spectrum"]),
        (comma("T,a\n"), &["line 1", "this is a response spectrum", "`time`"]),
        (comma("t [s],vel [m/s2]\n"), &["line 1", "`vel [m/s2]`", "column of the acceleration"]),
        (comma("t [s],vg [m/s2]\n"), &["line 1", "column of the acceleration"]),
        (comma("t [s],Displacement (m/s2)\n"), &["line 1", "column of the acceleration"]),
        (comma("time,acc\nms,m/s2\n"), &["line 1", "times in s", "`time [ms]`"]),
        (
            table("time,a_g\n", ".00,", "", ".").replace('\n', "\n2023/05/18 "),
            &["line 2", "a finite number", "`2023/05/18"],
        ),
        (
            table("time,a_g\n", ",", "", ".").replace('\n', "\n14:48:"),
            &["line 2", "a finite number", "`14:48:"],
        ),
        (
            ",time,acc\n".to_owned() + &table("\n", ",", "", ".").replace('\n', "\n1,"),
            &["line 1", "delete the first column", "index=False"],
        ),
        (comma("time [s],a [m/s2],a [m/s2]\n"), &["line 1", "two columns `a [m/s2]`"]),
        (comma("t [s],a [m/s2]\n").replace("\n1.00,", "\n1.00,nan #"), &["line 102", "a finite number"]),
        (comma(header).replace("\n1.00", "\n1.005"), &["line 102", "step"]),
        (
            "t [s],a [mm/s2]\n0,-931\n0.01,1.053\n0.02,1.163\n0.03,12\n0.04,7\n".to_owned(),
            &["line 3", "`1.053`", "marks between thousands"],
        ),
    ] {
        let options = if text.contains("[mm/s2]") { RecordOptions::default() } else { si() };
        assert_mentions(&crate::read("x.csv", &text, &options).expect_err(&text[..40]), words);
    }
    for (count, words) in [
        ("NPTS= 401, DT= 10.0 (ms)", "must be in seconds"),
        ("NPTS= 401, DT= 10.0 [MSEC]", "must be in seconds"),
        ("NPTS= 401, DT= 10.0 MSEC", "must be in seconds"),
        ("NPTS= 401, DT= 100 Hz", "must be in seconds"),
        ("NPTS= 401, DT= 100 sps", "must be in seconds"),
        ("NPTS= 401, DT= 10.0", "a time step of at most 1 s"),
        ("NPTS= 401, DT= 0,0100 SEC", "the number of samples and the step"),
    ] {
        let error = crate::read("x.AT2", &at2(IN_G, count), &RecordOptions::default()).unwrap_err();
        assert_mentions(&error, &["x.AT2, line", words]);
    }
}

/// Where the times are in another unit, a stated step counts, and is compared with them.
#[test]
fn the_stated_step_counts_beside_times_in_other_units() {
    let text = "time [ms],a [m/s2]\n20,1\n30,2\n40,1\n";
    let of = |step: f64| {
        let record = crate::read("x.csv", text, &with_step(step)).unwrap();
        assert_eq!((record.motion.step(), record.first_time), (step, 2.0 * step));
        record.warnings.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert!(of(0.01).is_empty());
    let warning = "step: the file has 0.01 s between samples; the 0.005 s that you state count";
    assert_eq!(of(0.005), [warning]);
    let error = crate::read("x.csv", text, &RecordOptions::default()).unwrap_err();
    assert_mentions(&error, &["times in s", "`time [ms]`", "--record-step"]);
}

/// Decimals beside whole numbers are no thousands if one of them is below 1, or has another number of digits.
#[test]
fn whole_numbers_beside_decimals_are_read() {
    for samples in ["931\n0.125\n1.053\n", "931\n1.05\n1.053\n", "31\n3\n1.053\n", "931\n1.053\n"] {
        assert!(crate::read("x.txt", samples, &with_step(0.01)).is_ok(), "{samples}");
    }
    let error = crate::read("x.txt", "931\n1.053\n12\n7\n", &with_step(0.01)).unwrap_err();
    assert_mentions(&error, &["line 2", "`1.053`", "marks between thousands"]);
}

/// An unknown unit that the file states is not overridden.
#[test]
fn units_that_are_not_read_are_refused_with_their_factor() {
    for (unit, words) in [
        ("ft/s2", "1 ft/s2 is 0.3048 m/s2"),
        ("ft/s/s", "1 ft/s/s is 0.3048 m/s2"),
        ("FT/SEC^2", "1 FT/SEC^2 is 0.3048 m/s2"),
        ("in/s²", "1 in/s² is 0.0254 m/s2"),
        ("dm/s2", "1 dm/s2 is 0.1 m/s2"),
        ("g/10", "1 g/10 is 0.1 g"),
        ("G/100", "1 G/100 is 0.01 g"),
        ("%g", "1 %g is 0.01 g"),
        ("% g", "1 % g is 0.01 g"),
        ("mg", "1 mg is 0.001 g"),
        ("milli-g", "1 milli-g is 0.001 g"),
        ("0.1g", "1 0.1g is 0.1 g"),
        ("mGal", "1 mGal is 0.001 cm/s2"),
        ("m/s", "convert it to an acceleration"),
        ("cm/sec", "convert it to an acceleration"),
        ("in/s", "convert it to an acceleration"),
        ("kine", "convert it to an acceleration"),
        ("cm", "convert it to an acceleration"),
        ("m/s3", "correct the unit"),
        ("m/s^3", "correct the unit"),
        ("kg", "correct the unit"),
        ("-", "correct the unit"),
        ("10^-3 m/s2", "correct the unit"),
        ("x 10^-2 g", "correct the unit"),
    ] {
        for options in [RecordOptions::default(), si()] {
            let text = table(&format!("t [s],x [{unit}]\n"), ",", "", ".");
            let error = crate::read("x.csv", &text, &options).unwrap_err();
            assert_mentions(&error, &["x.csv, line 1", words, "does not override"]);
            if !unit.contains([' ', '-']) {
                let text = at2(&IN_G.replace("OF G", &format!("OF {unit}")), COUNT);
                let error = crate::read("x.AT2", &text, &options).unwrap_err();
                assert_mentions(&error, &["x.AT2, line 3", words]);
            }
        }
    }
    for (name, words) in [
        ("velocity", "convert it to an acceleration"),
        ("a_ft/s2", "1 ft/s2 is 0.3048 m/s2"),
        ("acc_ft_s2", "1 ft_s2 is 0.3048 m/s2"),
        ("acc ft s-2", "1 ft s-2 is 0.3048 m/s2"),
        ("a_mg", "1 mg is 0.001 g"),
        ("mg", "1 mg is 0.001 g"),
        ("acc_cms", "convert it to an acceleration"),
        ("vel_cm_s", "convert it to an acceleration"),
        ("acc_cm_s2", "the stated unit m/s2, found cm/s2"),
        ("acc_cms2", "the stated unit m/s2, found cm/s2"),
        ("acc_mm_s_2", "the stated unit m/s2, found mm/s2"),
        ("acc_gal", "the stated unit m/s2, found cm/s2"),
        ("Acceleration, ft/s2", "1 ft/s2 is 0.3048 m/s2"),
        ("Acceleration, cm/s2", "the stated unit m/s2, found cm/s2"),
    ] {
        let error = crate::read("x.csv", &table(&format!("time;{name}\n"), ";", "", "."), &si()).unwrap_err();
        assert_mentions(&error, &["line 1", words]);
    }
    for (unit, words) in [
        ("% G", "1 % G is 0.01 g"),
        ("FT / SEC / SEC", "1 FT / SEC / SEC is 0.3048 m/s2"),
        ("FEET PER SECOND SQUARED", "is 0.3048 m/s2"),
    ] {
        let text = at2(&IN_G.replace("OF G", &format!("OF ({unit}), CORRECTED")), COUNT);
        assert_mentions(&crate::read("x.AT2", &text, &si()).unwrap_err(), &["line 3", words]);
    }
    let text = at2(&IN_G.replace("OF G", "OF CM / SEC / SEC"), COUNT);
    assert_eq!(crate::read("x.AT2", &text, &RecordOptions::default()).unwrap().unit.name(), "cm/s2");
}

#[test]
fn vertical_columns_and_files_are_known() {
    let none = RecordOptions::default();
    for (header, is_vertical) in [
        ("t [s],DOWN [m/s2]", true),
        ("t [s],a [m/s2] vertical", true),
        ("t [s],acc_UP [m/s2]", true),
        ("t [s],HNZ [m/s2]", true),
        ("t [s],a [m/s2]", false),
        ("t [s],N-S [m/s2]", false),
    ] {
        let record = crate::read("x.csv", &table(&format!("{header}\n"), ",", "", "."), &none).unwrap();
        assert_eq!(record.is_vertical, is_vertical, "{header}");
    }
    assert!(crate::read("RSN1_ABCDWN.AT2", &at2(IN_G, COUNT), &none).unwrap().is_vertical);
    let knet = crate::specimen::knet(&crate::specimen::SAMPLES);
    for (direction, is_vertical) in [("UD", true), ("U-D", true), ("Down", true), ("N-S", false)] {
        let line = knet.lines().find(|line| line.starts_with("Dir.")).unwrap();
        let text = knet.replace(line, &format!("Dir.              {direction}"));
        assert_eq!(crate::read("x", &text, &none).unwrap().is_vertical, is_vertical, "{direction}");
    }
}

#[test]
fn long_time_steps_are_warned_of_and_refused() {
    let rows =
        |step: f64| (0..50).fold(String::new(), |rows, i| rows + &format!("{} 0.5\n", f64::from(i) * step));
    let warns = |text: &str, options: &RecordOptions| {
        let record = crate::read("x.txt", text, options).unwrap();
        let warnings = record.check().warnings;
        let step = warnings.iter().find(|warning| matches!(warning, Warning::Step { .. }));
        step.map(ToString::to_string)
    };
    assert_eq!(warns(&rows(0.1), &si()), None);
    // numbers of samples, and tenths of seconds
    let warning = warns(&rows(4e-4), &si()).unwrap();
    assert_mentions(&warning, &["4.000e-4 s", "shorter", "minutes (a step of 2.40e-2 s)"]);
    assert_eq!(warns(&rows(5e-4), &si()), None);
    for step in [0.2, 1.0] {
        let warning = warns(&rows(step), &si()).unwrap();
        assert_mentions(&warning, &[&format!("{step} s"), "milliseconds", "numbers of samples"]);
    }
    let error = crate::read("x.txt", &rows(10.0), &si()).unwrap_err();
    assert_mentions(&error, &["x.txt", "at most 1 s", "found 10 s", "milliseconds", "--record-step"]);
    // the stated step counts beside milliseconds and numbers of samples, and no other
    for (rows, step) in [(rows(5.0), 0.005), (rows(1.0), 0.01)] {
        assert_eq!(crate::read("x.txt", &rows, &with_step(step)).unwrap().motion.step(), step);
    }
    let error = crate::read("x.txt", &rows(5.0), &with_step(0.01)).unwrap_err();
    assert_mentions(&error, &["the stated step of 0.01 s, found 5 s"]);
    assert!(warns(&rows(10.0), &with_step(10.0)).is_some());
    assert!(warns("1\n2\n", &with_step(2.0)).is_some());
    let smc = crate::specimen::smc(&crate::specimen::SAMPLES);
    let slow = smc.replacen(" 1.0000000E2", "1.0000000E-1", 1);
    assert!(smc != slow);
    assert_mentions(&crate::read("x.smc", &slow, &RecordOptions::default()).unwrap_err(), &["found 10 s"]);
}

#[test]
fn encodings_are_named() {
    let text = table("time [s],a [m/s2]\n", "\t", "", ".");
    for marked in [format!("\u{feff}{text}"), text.clone()] {
        for to_bytes in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = marked.encode_utf16().flat_map(to_bytes).collect();
            let error = ground_motion::parse("x.csv", bytes.clone(), &si()).unwrap_err().to_string();
            assert_mentions(&error, &["x.csv, line 1", "found UTF-16", "save the file as UTF-8"]);
            let error = ground_motion::utf8_text(bytes, "a table").unwrap_err();
            assert_mentions(&error.to_string(), &["found UTF-16", "save the file as UTF-8"]);
        }
    }
    let error = ground_motion::utf8_text(b"\x89PNG\r\n\x1a\n\0\0\0".to_vec(), "a table").unwrap_err();
    assert_mentions(&error.to_string(), &["a binary file", "give a table"]);
}

/// A comment that names the columns states the unit as a header line does.
#[test]
fn a_comment_may_name_the_columns() {
    let text = table("% t [s], a [g]\n", ",", "", ".");
    let record = crate::read("x.csv", &text, &RecordOptions::default()).unwrap();
    assert_eq!(record.unit, Unit::StandardGravity);
    let error = crate::read("x.csv", &text, &si()).unwrap_err();
    assert_mentions(&error, &["line 1", "the stated unit m/s2, found g"]);
    let several = "# t [s] x [g] y [g]\n0 1 3\n0.1 2 4\n";
    let options = RecordOptions { column: Some("y".to_owned()), ..RecordOptions::default() };
    let record = crate::read("x.txt", several, &options).unwrap();
    assert_eq!(record.motion.samples(), [3.0, 4.0].map(|a| Unit::StandardGravity.to_si(a)));
}
