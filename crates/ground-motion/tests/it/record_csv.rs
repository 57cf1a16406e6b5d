//! Text tables: with and without a header line, one column with a step, and what is refused.

use ground_motion::{Format, Record, RecordOptions, Unit};
use proptest::prelude::*;

use crate::assert_mentions;

fn si() -> RecordOptions {
    RecordOptions { unit: Some(Unit::MetrePerSecondSquared), ..RecordOptions::default() }
}

fn with_step(step: f64) -> RecordOptions {
    RecordOptions { step: Some(step), ..si() }
}

fn with_column(column: &str) -> RecordOptions {
    RecordOptions { column: Some(column.to_owned()), ..si() }
}

fn read(text: &str, options: &RecordOptions) -> Result<Record, String> {
    crate::read("x.csv", text, options)
}

#[track_caller]
fn assert_refused(text: &str, options: &RecordOptions, fragments: &[&str]) {
    let error = read(text, options).expect_err(text);
    assert!(error.starts_with("x.csv, line "), "{error}");
    assert_mentions(&error, fragments);
}

#[test]
fn reads_a_table() {
    let expected = read("time,a_g\n0.000,0.5\n0.005,-1e-1\n0.010,.25\n", &si()).unwrap();
    assert_eq!(expected.format, Format::Csv);
    assert_eq!((expected.motion.step(), expected.first_time), (0.005, 0.0));
    assert_eq!(expected.motion.samples(), [0.5, -0.1, 0.25]);
    for text in [
        "\u{feff}time,a_g\r\n0.000,0.5\r\n0.005,-1e-1\r\n0.010,.25",
        "\n time , \"a_g\" \n\n 0.000 , 0.5\n0.005,\t-0.1\n0.010,2.5E-1\n\n",
        "Time,a_g\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
    ] {
        assert_eq!(read(text, &si()).unwrap().motion, expected.motion, "{text}");
    }
    let gal = RecordOptions { unit: Some(Unit::CentimetrePerSecondSquared), ..si() };
    let in_gal = read("time_s,acc_cm_s2\n0,50\n0.005,-10\n0.01,25\n", &gal).unwrap();
    assert_eq!(in_gal.motion, expected.motion);
    assert!(read("time,a_g\n0,1\n0.005,2\n", &with_step(0.005)).is_ok());
}

#[test]
fn chooses_a_column_by_name() {
    let table = "time,a_g,drift\n0,1,10\n0.1,2,20\n";
    assert_eq!(read(table, &with_column("a_g")).unwrap().motion.samples(), [1.0, 2.0]);
    assert_eq!(read(table, &with_column("drift")).unwrap().motion.samples(), [10.0, 20.0]);
    assert_refused(
        table,
        &si(),
        &["line 1", "one column beside `time`", "found 3 columns in `time,a_g,drift`"],
    );
    assert_refused(table, &with_column("a_x"), &["line 1", "one column `a_x`", "time,a_g,drift"]);
    assert_refused(
        table,
        &with_column("time"),
        &["line 1", "one column `time` beside the first", "one of these"],
    );
    assert_refused("time,a,a\n0,1,2\n1,2,3\n", &with_column("a"), &["line 1", "one column `a`"]);
    assert_refused(
        "a\n1\n2\n",
        &RecordOptions { step: Some(0.1), ..with_column("b") },
        &["line 1", "`b`", "`a`"],
    );
}

#[test]
fn keeps_the_time_of_the_first_sample_and_starts_at_zero() {
    let record = read("time,a_g\n12.5,1\n12.6,2\n12.7,3\n", &si()).unwrap();
    assert_eq!((record.first_time, record.motion.step(), record.motion.at(0.0)), (12.5, 0.1, 1.0));
}

#[test]
fn reads_one_column() {
    let expected = read("0.5\n-0.1\n0.25\n", &with_step(0.005)).unwrap();
    assert_eq!(expected.motion.samples(), [0.5, -0.1, 0.25]);
    assert_eq!(expected.motion.step(), 0.005);
    for text in [
        "# synthetic, dt=0.005 s, m/s2\n0.5\n-0.1\n0.25",
        "acceleration\r\n0.5\r\n\r\n-0.1\r\n0.25\r\n",
        "\u{feff}# one\n# two\n\"a_g\"\n0.5\n-0.1\n# a late remark\n0.25\n",
    ] {
        assert_eq!(read(text, &with_step(0.005)).unwrap().motion, expected.motion, "{text}");
    }
    assert_refused("0.5\n-0.1\n", &si(), &["a stated step", "state the step in seconds"]);
    assert_refused("a\nb\n0.5\n", &with_step(0.1), &["line 2", "a finite number", "`b`"]);
}

/// Decimals 0.5, −0.1, 0.25 at a step of 0.005 s, as people write them.
#[test]
fn reads_tables_as_people_have_them() {
    for text in [
        "0.000 0.5\n0.005 -0.1\n0.010 0.25\n",
        "   0.000   5.0E-01\r\n   0.005  -1.0E-01\r\n   0.010   2.5E-01\r\n",
        "0\t0.5\n0.005\t-0.1\n0.01\t0.25\n",
        "0,0.5\n0.005,-0.1\n0.01,0.25\n",
        "0.000, 0.5\n0.005, -0.1\n0.010, 0.25\n",
        "0,000 0,5\n0,005 -0,1\n0,010 0,25\n",
        "0,000\t0,5\n0,005\t-0,1\n0,010\t0,25\n",
        "0,000;0,5\n0,005;-0,1\n0,010;0,25\n",
        "0;0.5\n0.005;-0.1\n0.01;0.25\n",
        "time;a_g\n0,000;5,0e-1\n0,005;-0,1\n0,010;0,25\n",
        "sep=;\nt (s);a\n0;0,5\n0,005;-0,1\n0,01;0,25\n",
        "Time [sec]\tAcceleration [m/s2]\n0\t0.5\n0.005\t-0.1\n0.01\t0.25\n",
        "t [s]  a [m/s2]\n0  0.5\n0.005  -0.1\n0.01  0.25\n",
        "Time(s) Acc(m/sec^2)\n0 0.5\n0.005 -0.1\n0.01 0.25\n",
        "# El Centro, 1940\n% corrected\n0 0.5\n0.005 -0.1\n# late\n0.01 0.25\n",
        "# time a\ntime,a_g\n0,0.5\n0.005,-0.1\n# late\n0.01,0.25\n",
        "Time history, El Centro\ntime of arrival\nt,a\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
        "El Centro, 1940\ncorrected\nt,a\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
    ] {
        let record = read(text, &si()).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((record.format, record.first_time), (Format::Csv, 0.0), "{text}");
        assert_eq!(record.motion.step(), 0.005, "{text}");
        assert_eq!(record.motion.samples(), [0.5, -0.1, 0.25], "{text}");
    }
}

#[test]
fn a_header_line_states_the_unit() {
    let none = RecordOptions::default();
    for (text, unit) in [
        ("t [s],a [g]\n0,1\n0.1,2\n", Unit::StandardGravity),
        ("Time (sec);Acc (cm/s²)\n0;1\n0,1;2\n", Unit::CentimetrePerSecondSquared),
        ("time [s]\ta_x [gal]\n0\t1\n0.1\t2\n", Unit::CentimetrePerSecondSquared),
        ("t(s) a(mm/s2)\n0 1\n0.1 2\n", Unit::MillimetrePerSecondSquared),
        ("time (a_g in m/s2),a_g\n0,1\n0.1,2\n", Unit::MetrePerSecondSquared),
    ] {
        let record = read(text, &none).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(record.unit, unit, "{text}");
        assert_eq!(record.motion.samples(), [unit.to_si(1.0), unit.to_si(2.0)], "{text}");
    }
    let two = "t [s],x [g],y [gal]\n0,1,3\n0.1,2,4\n";
    for column in ["y", "y [gal]"] {
        let options = RecordOptions { column: Some(column.to_owned()), ..RecordOptions::default() };
        assert_eq!(read(two, &options).unwrap().motion.samples(), [0.03, 0.04]);
    }
    assert_refused("t [s],a [g]\n0,1\n0.1,2\n", &si(), &["line 1", "the stated unit m/s2", "found g"]);
    assert_refused("t [ms],a [g]\n0,1\n5,2\n", &none, &["line 1", "times in s", "`t [ms]`"]);
    assert_refused("t [s],a [V]\n0,1\n0.1,2\n", &none, &["line 1", "a unit of acceleration", "`V`"]);
    // a name of one column may state it, too; what is in the brackets of a title need not be a unit
    let one = read("a [g]\n1\n2\n", &RecordOptions { unit: None, ..with_step(0.1) }).unwrap();
    assert_eq!(one.motion.samples(), [Unit::StandardGravity.to_si(1.0), Unit::StandardGravity.to_si(2.0)]);
    assert_refused("a [g]\n1\n2\n", &with_step(0.1), &["line 1", "the stated unit m/s2", "found g"]);
    assert_eq!(read("El Centro (1940)\n1\n2\n", &with_step(0.1)).unwrap().motion.samples(), [1.0, 2.0]);
    // a_g is the ground's acceleration, not one in g
    assert_refused("time,a_g\n0,1\n0.1,2\n", &none, &["a stated unit"]);
}

#[test]
fn only_a_count_and_a_step_make_an_at2() {
    let body = "0.5\n-0.1\n0.25\n";
    for text in [
        "# NPTS = 3, DT = 0.005 s\ntime,a_g\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
        "El Centro, NPTS = 3, DT = 0.005 s\ntime,a_g\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
        "time,a_g of npts 3 and dt 0.005\n0,0.5\n0.005,-0.1\n0.01,0.25\n",
        "# npts=3, dt=0.005\n0 0.5\n0.005 -0.1\n0.01 0.25\n",
        &format!("# npts=3, dt=0.005\n{body}"),
        &format!("El Centro (npts 3)\n{body}"),
    ] {
        let record = read(text, &with_step(0.005)).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(record.format, Format::Csv, "{text}");
        assert_eq!(record.motion.samples(), [0.5, -0.1, 0.25], "{text}");
    }
    for title in ["El Centro", "Time history", "Time series, in units of m/s2"] {
        for count in ["NPTS = 3, DT = 0.005 s", "3 0.005 NPTS, DT"] {
            let at2 = read(&format!("{title}\n{count}\n{body}"), &si()).unwrap();
            assert_eq!((at2.format, at2.motion.step()), (Format::At2, 0.005), "{title} {count}");
        }
    }
}

#[test]
fn a_column_t_beside_times_is_a_transverse_component() {
    for text in ["time [s],T [m/s2]\n0,1\n0.1,2\n", "time [s],L [m/s2],T [m/s2]\n0,3,1\n0.1,4,2\n"] {
        let options = if text.contains('L') { with_column("T") } else { si() };
        assert_eq!(read(text, &options).unwrap().motion.samples(), [1.0, 2.0], "{text}");
    }
}

/// What could be read in two ways is not read.
#[test]
fn ambiguous_tables_are_refused_with_the_remedy() {
    for (text, fragments) in [
        ("0,5\n-0,1\n0,25\n", &["line 1", "commas that either", "`0,5`", "semicolons"][..]),
        ("0,1\n1,2\n2,4\n", &["line 1", "commas that either", "decimal points"]),
        ("acc. [m/s2]\n0,5\n-0,1\n0,25\n", &["line 2", "commas that either", "`0,5`", "decimal points"]),
        ("acc EW\n0,5\n-0,1\n0,25\n", &["line 2", "commas that either", "`0,5`", "decimal points"]),
        ("El Centro, 1940\nacc\n0,5\n-0,1\n0,25\n", &["line 3", "commas that either", "`0,5`"]),
        ("time,a_g\n0,000,0,5\n0,005,0,1\n", &["line 2", "2 in all", "found 4", "semicolons"]),
        ("0,000,0,5\n0,005,0,1\n", &["line 1", "one column beside", "found 4", "semicolons"]),
        ("0,000, 0,5\n0,005, 0,1\n", &["line 1", "one column beside", "found 4", "semicolons"]),
        ("time;a_g\n0,0;0,5\n0,1;0.25\n", &["line 3", "`,` before the decimals, as on line 2", "`0.25`"]),
        ("0.0 0.5\n0.1 0,25\n", &["line 2", "`.` before the decimals, as on line 1", "alike"]),
        ("t;a\n0;1.234,5\n1;2\n", &["line 2", "`1.234,5`", "thousands"]),
        ("t;a\n0;1,234.5\n1;2\n", &["line 2", "`1,234.5`", "thousands"]),
        ("0.1 0.2 0.3\n0.4 0.5 0.6\n", &["line 1", "two columns", "found 3", "header line", "one sample"]),
        ("0.3 0.2\n0.1 0.5\n", &["line 2", "after 0.3 s", "in the first column, must increase"]),
        ("El Centro\n0.0 0.1\n0.1 0.2\n", &["line 1", "times in s", "found `El`", "titles with #"]),
        ("Time (s) Ground acc (g)\n0 1\n1 2\n", &["line 1", "one column beside", "one word each"]),
        ("t (s) acc (m/s2)\n0 1 2\n1 2 3\n", &["line 2", "2 in all", "found 3", "one word"]),
        ("0.0 0.1\ntime,a_g\n0,1\n", &["line 2", "2 in all", "found 1 in `time,a_g`"]),
    ] {
        assert_refused(text, &si(), fragments);
    }
    assert_refused("0 1\n1 2\n", &with_column("a"), &["line 1", "one column `a`", "header line"]);
    assert_refused("0.5\n-0.1\n", &si(), &["--record-step", "in Python dt", "a first column `time`"]);
}

#[test]
fn the_unit_must_be_stated() {
    let no_unit = RecordOptions { unit: None, ..with_step(0.1) };
    for text in ["time,a_g\n0,1\n0.1,2\n", "1\n2\n"] {
        assert_refused(text, &no_unit, &["a stated unit", "found no unit", "m/s2, cm/s2, mm/s2 or g"]);
    }
    // What is wrong with the file itself comes first.
    assert_refused("time,a_g\n0,1\n0.1,x\n", &no_unit, &["line 3", "`x`"]);
}

#[test]
fn times_must_be_uniform() {
    let lines = |times: &[&str]| times.iter().fold("time,a\n".to_owned(), |text, time| text + time + ",0\n");
    assert_refused(
        &lines(&["0", "0.005", "0.010", "0.020"]),
        &si(),
        &["line 5", "the first step of 0.005 s", "found a step of 0.01 s", "resample"],
    );
    assert_refused(&lines(&["0", "0.005", "0.005"]), &si(), &["line 4", "after 0.005 s", "must increase"]);
    assert_refused(&lines(&["0", "-0.005"]), &si(), &["line 3", "after 0 s", "found -0.005 s"]);
    assert_refused(&lines(&["-1e308", "1e308", "1.1e308"]), &si(), &["line 3"]);
    assert_refused("time,a\n0,0\n0.01,0\n", &with_step(0.02), &["the stated step of 0.02 s", "found 0.01 s"]);
    // Each step is within 1 % of the first, their sum is not.
    let slow: Vec<_> = (0..200).map(|i| format!("{}", f64::from(i) * (1.0 + 2e-5 * f64::from(i)))).collect();
    let slow: Vec<_> = slow.iter().map(String::as_str).collect();
    assert_refused(&lines(&slow), &si(), &["at the mean step", "resample"]);
    // Times written in single precision are uniform enough.
    let single: Vec<_> = (0..20_000_i16).map(|i| (f32::from(i) * 0.005_f32).to_string()).collect();
    let single: Vec<_> = single.iter().map(String::as_str).collect();
    let step = read(&lines(&single), &si()).unwrap().motion.step();
    // Half a unit in the last of 24 bits at 100 s, over 20 000 steps, twice.
    assert!((step - 0.005).abs() <= 2.0 * 4e-6 / 2e4, "{step}");
}

#[test]
fn refuses_what_is_no_csv() {
    let one_column = with_step(0.01);
    for (text, options, fragments) in [
        ("", si(), &["line 1", "found an empty file"][..]),
        ("\n \r\n", si(), &["line 1", "found an empty file"]),
        ("# only\n# comments\n", si(), &["line 1", "comments only"]),
        ("time,a_g\n", si(), &["line 1", "at least two samples", "found 0"]),
        ("time,a_g\n0,1\n", si(), &["line 2", "at least two samples", "found 1"]),
        ("1\n", one_column.clone(), &["line 1", "at least two samples", "found 1"]),
        ("a_g,time\n1,0\n2,0.1\n", si(), &["line 1", "times in s in the first column", "`a_g`"]),
        ("time,a_g\n0,1\n0.1\n", si(), &["line 3", "2 in all", "found 1 in `0.1`"]),
        ("time,a_g\n0,1\n0,1,2\n", si(), &["line 3", "2 in all", "found 3"]),
        ("time,a_g\n0,1\n0.1,\n", si(), &["line 3", "a finite number", "``"]),
        ("time,a_g\n0,nan\n0.1,1\n", si(), &["line 2", "`nan`"]),
        ("time,a_g\n0,1\ninf,1\n", si(), &["line 3", "`inf`"]),
        ("time,a_g\n0,1e999\n0.1,1\n", si(), &["line 2", "`1e999`"]),
        ("nan\n1\n", one_column.clone(), &["line 1", "`nan`"]),
        ("1\n-Infinity\n", one_column.clone(), &["line 2", "`-Infinity`"]),
        ("1\n2\n3,4\n", one_column, &["line 3", "`3,4`"]),
    ] {
        assert_refused(text, &options, fragments);
    }
    let in_g = RecordOptions { unit: Some(Unit::StandardGravity), ..si() };
    assert_refused("time,a_g\n0,1e308\n0.1,1\n", &in_g, &["line 2", "`1e308`"]);
}

proptest! {
    #![proptest_config(crate::configuration::configuration())]

    #[test]
    fn reads_what_was_written(step in 1_u32..50, samples in prop::collection::vec(-30.0..30.0, 2..300)) {
        let step = f64::from(step) / 1000.0;
        let column = samples.iter().fold(String::new(), |text, a: &f64| text + &format!("{a}\n"));
        let rows = samples.iter().zip(0_u32..).map(|(a, i)| format!("{},{a}\n", f64::from(i) * step));
        let table = rows.fold("time,a_g\n".to_owned(), |text, row| text + &row);
        for record in [read(&table, &si()).unwrap(), read(&column, &with_step(step)).unwrap()] {
            prop_assert_eq!(record.motion.step(), step);
            prop_assert_eq!(record.motion.samples(), &samples[..]);
        }
    }

    #[test]
    fn never_panics(body in "[0-9 .,+e\n#a-]{0,80}") {
        let _ = read(&body, &with_step(0.01));
        let _ = read(&format!("time,a\n{body}"), &si());
        let _ = read(&format!("t [s];a\n{}", body.replace(' ', ";")), &si());
    }
}
