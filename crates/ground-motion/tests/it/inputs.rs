//! Records, tables and spectra as people have them: what is read, and what is refused with a remedy.

use std::fmt::Write;

use ground_motion::{Record, RecordOptions, SpectrumFile, Unit, Warning};

use crate::assert_mentions;

/// A Ricker motion in m/s²: 401 samples 0.01 s apart.
fn motion() -> Vec<f64> {
    let at = |i: i32| {
        let x = (std::f64::consts::PI * 1.5 * (0.01 * f64::from(i) - 2.0)).powi(2);
        1.5 * (1.0 - 2.0 * x) * (-x).exp()
    };
    (0..401).map(at).collect()
}

/// A table of times and samples: a header, what stands between the cells and behind the rows, and the decimal
/// mark.
fn table(header: &str, between: &str, behind: &str, mark: &str) -> String {
    let mut text = header.to_owned();
    for (i, a) in motion().iter().enumerate() {
        let (time, a) = (format!("{:.2}", 0.01 * i as f64), format!("{a:.6}"));
        let _ = writeln!(text, "{}{between}{}{behind}", time.replace('.', mark), a.replace('.', mark));
    }
    text
}

/// A PEER AT2 file in g.
fn at2(units: &str, count: &str) -> String {
    let mut text = format!("PEER NGA STRONG MOTION\nSomewhere, 1/1/2000, Station, 090\n{units}\n{count}\n");
    for line in motion().chunks(5) {
        for a in line {
            let _ = write!(text, "{:15.7E}", a / 9.806_65);
        }
        text.push('\n');
    }
    text
}

const IN_G: &str = "ACCELERATION TIME SERIES IN UNITS OF G";
const COUNT: &str = "NPTS=   401, DT=   .0100 SEC,";

fn si() -> RecordOptions {
    RecordOptions { unit: Some(Unit::MetrePerSecondSquared), ..RecordOptions::default() }
}

fn with_step(step: f64) -> RecordOptions {
    RecordOptions { step: Some(step), ..si() }
}

/// The samples have six digits or more after the point.
#[track_caller]
fn assert_is_the_motion(record: &Record) {
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
        (table("t [s],a [counts]\n", ",", "", "."), &si()),
        (table("t [s],a (N/S)\n", ",", "", "."), &si()),
        (table("t [s],shake_0.3g\n", ",", "", "."), &si()),
        (table("% by MATLAB\n% t [s], a [g]\n", ",", "", "."), &si()),
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
        (comma("time [ms],acc\n"), &["line 1", "times in s", "`ms`", "write the times in seconds"]),
        (comma("time (ms),acc\n"), &["line 1", "times in s", "`ms`"]),
        (comma("time_ms,acc\n"), &["line 1", "times in s", "`ms`"]),
        (comma("# t [ms], a [m/s2]\n"), &["times in s", "`ms`"]),
        (comma("time,acc\nms,m/s2\n"), &["times in s", "`ms`"]),
        (
            table("time,a_g\n", ".00,", "", ".").replace('\n', "\n2023/05/18 "),
            &["line 2", "a time of the day"],
        ),
        (table("time,a_g\n", ",", "", ".").replace('\n', "\n14:48:"), &["line 2", "a time of the day"]),
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
        ("m/s", "this is a velocity: convert it"),
        ("cm/sec", "this is a velocity: convert it"),
        ("in/s", "this is a velocity: convert it"),
        ("kine", "this is a velocity: convert it"),
        ("cm", "this is a displacement: convert it"),
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
        ("velocity", "this is a velocity"),
        ("a_ft/s2", "1 ft/s2 is 0.3048 m/s2"),
        ("acc_ft_s2", "1 ft_s2 is 0.3048 m/s2"),
        ("acc ft s-2", "1 ft s-2 is 0.3048 m/s2"),
        ("a_mg", "1 mg is 0.001 g"),
        ("mg", "1 mg is 0.001 g"),
        ("acc_cms", "this is a velocity"),
        ("vel_cm_s", "this is a velocity"),
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
    for step in [0.2, 1.0] {
        let warning = warns(&rows(step), &si()).unwrap();
        assert_mentions(&warning, &[&format!("{step} s"), "milliseconds", "numbers of samples"]);
    }
    let error = crate::read("x.txt", &rows(10.0), &si()).unwrap_err();
    assert_mentions(&error, &["x.txt", "at most 1 s", "found 10 s", "milliseconds", "--record-step"]);
    assert!(warns(&rows(10.0), &with_step(10.0)).is_some());
    assert!(warns("1\n2\n", &with_step(2.0)).is_some());
    let smc = crate::specimen::smc(&crate::specimen::SAMPLES);
    let slow = smc.replacen(" 1.0000000E2", "1.0000000E-1", 1);
    assert!(smc != slow);
    assert_mentions(&crate::read("x.smc", &slow, &RecordOptions::default()).unwrap_err(), &["found 10 s"]);
}

fn spectrum(text: &str, unit: Option<Unit>, column: Option<&str>) -> Result<SpectrumFile, String> {
    SpectrumFile::parse("s.csv", text.as_bytes().to_vec(), unit, column).map_err(|error| error.to_string())
}

#[test]
fn spectra_are_read() {
    let g = Some(Unit::StandardGravity);
    for (text, unit, column) in [
        ("T [s],Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("0,0.25\n0.5,0.75\n2,0.125\n", g, None),
        ("# a site\n# of mine\nT [s],Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("T [s];Sa [g]\n0;0,25\n0,5;0,75\n2;0,125\n", None, None),
        ("T[s] Se[g]\n0 0.25\n0.5 0.75\n2 0.125\n", None, None),
        ("Period (s)\tSa (g)\n0\t0.25\n0.5\t0.75\n2\t0.125\n", None, None),
        ("\"T\",\"Sa (5 %) [g]\"\r\"0\",\"0.25\"\r\"0.5\",\"0.75\"\r\"2\",\"0.125\"\r", None, None),
        ("Period,Sa\nsec,g\n0,0.25\n0.5,0.75\n2,0.125\n,\n", None, None),
        ("T,Sa (5 %)\n0,2.5D-1\n0.5,0.75\n2,0.125\n", g, None),
        (
            "Period (sec),Acceleration (g),Velocity (cm/sec),Displacement (cm)\n0,0.25,1,1\n0.5,0.75,1,1\n\
          2,0.125,1,1\n",
            None,
            Some("Acceleration (g)"),
        ),
        ("T [s],Sd [m],Sa [g]\n0,1,0.25\n0.5,1,0.75\n2,1,0.125\n", None, Some("Sa [g]")),
    ] {
        let read = spectrum(text, unit, None).unwrap_or_else(|error| panic!("{text}: {error}"));
        let points: Vec<_> = read.points.iter().map(|(period, sa)| (*period, sa / 9.806_65)).collect();
        assert_eq!(points, [(0.0, 0.25), (0.5, 0.75), (2.0, 0.125)], "{text}");
        assert_eq!((read.unit, read.column.as_deref()), (Unit::StandardGravity, column), "{text}");
    }
    let several = "T [s],Sa 2% [g],Sa 5% [g]\n0,1,0.25\n0.5,1,0.75\n";
    let read = spectrum(several, None, Some("Sa 5%")).unwrap();
    assert_eq!((read.points[1].1, &*read.lines), (0.75 * 9.806_65, &[2, 3][..]));
    assert_mentions(
        &spectrum(several, None, None).unwrap_err(),
        &["line 1", "one column beside T", "--column"],
    );
}

#[test]
fn spectra_are_refused() {
    let body = "0,0.25\n0.5,0.75\n2,0.125\n";
    for (header, words) in [
        ("f [Hz],Sa [g]", &["line 1", "periods in s", "`f [Hz]`", "T = 1/f"][..]),
        ("f,Sa [g]", &["periods in s", "T = 1/f"]),
        ("Frequency (Hz),Sa [g]", &["periods in s", "T = 1/f"]),
        ("x [Hz],Sa [g]", &["periods in s", "T = 1/f"]),
        ("omega [rad/s],Sa [g]", &["periods in s", "T = 2π/ω"]),
        ("ω,Sa [g]", &["periods in s", "T = 2π/ω"]),
        ("T [ms],Sa [g]", &["periods in s", "1 ms is 0.001 s"]),
        ("T_ms,Sa [g]", &["periods in s", "1 ms is 0.001 s"]),
        ("T [min],Sa [g]", &["periods in s", "1 min is 60 s"]),
        ("# f [Hz], Sa [g]", &["periods in s", "T = 1/f"]),
        ("x,Sa [g]", &["periods in s", "name it `T [s]`"]),
        ("Sa [g],T [s]", &["periods in s", "name it `T [s]`"]),
        ("T [s],Sa [m/s]", &["this is a velocity: convert"]),
        ("T [s],Sa [%g]", &["1 %g is 0.01 g"]),
        ("T [s],Sa [m/s2]", &["the stated unit g, found m/s2", "leave out --unit"]),
        ("// T, Sa", &["comments start with # or %"]),
    ] {
        let error =
            spectrum(&format!("{header}\n{body}"), Some(Unit::StandardGravity), None).expect_err(header);
        assert_mentions(&error, words);
    }
    assert_mentions(&spectrum(body, None, None).unwrap_err(), &["line 1", "a unit of Sa", "--unit"]);
    let index = ",T [s],Sa [g]\n0,0,0.25\n1,0.5,0.75\n";
    assert_mentions(
        &spectrum(index, None, None).unwrap_err(),
        &["line 1", "delete the first column", "`,T [s],Sa [g]`"],
    );
    let cp1252 = SpectrumFile::parse("s.csv", b"T [s];Sa [m/s\xb2]\n0;1\n1;1\n".to_vec(), None, None);
    let error = cp1252.unwrap_err().to_string();
    assert_mentions(&error, &["line 1", "0xb2", "Windows-1252", "save the file as UTF-8"]);
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
