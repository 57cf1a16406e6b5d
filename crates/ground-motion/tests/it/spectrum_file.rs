//! Response spectra as people have them: what is read, and what is refused with a remedy.

use ground_motion::{SpectrumFile, Unit};

use crate::assert_mentions;

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
        ("t [s],Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("time [s],Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("# time [s], Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("# x, Sa [g]\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
        ("Period (T),Sa (g)\n0,0.25\n0.5,0.75\n2,0.125\n", None, None),
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
fn spectra_state_their_damping_and_are_warned_of() {
    for (name, damping) in [
        ("Sa (5 %) [g]", Some(0.05)),
        ("Sa_2.5% [g]", Some(0.025)),
        ("Sa(10%) [g]", Some(0.1)),
        ("Sa [g]", None),
        ("Sa NS (5 %) [g]", Some(0.05)),
        ("Sa (damping 50 %) [g]", Some(0.5)),
        ("Sa (ξ = 2,5 %) [g]", Some(0.025)),
        ("smorzamento 5% [g]", Some(0.05)),
        ("5%-damped Sa [g]", Some(0.05)),
        ("Sa (10% in 50 years) (xi 5%) [g]", Some(0.05)),
        // a probability, fractiles, and a percentage of g
        ("Sa 10% in 50 years [g]", None),
        ("Sa (84 % fractile) [g]", None),
        ("Sa 84% [g]", None),
        ("Sa 10% 5% [g]", None),
    ] {
        let read = spectrum(&format!("T [s];{name}\n0;0.25\n30;0.75\n"), None, None).unwrap();
        assert_eq!((read.damping, read.warning()), (damping, None), "{name}");
    }
    for (largest, others) in [("75", "Credible would be m/s2"), ("0.001", "is not credible")] {
        let read = spectrum(&format!("T [s],Sa [g]\n0,{largest}\n1,{largest}\n"), None, None).unwrap();
        assert_mentions(&read.warning().unwrap().to_string(), &["not credible", "in g?", others]);
    }
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
        ("T [ms],Sa [g]", &["periods in s", "name it `T [s]`"]),
        ("T_ms,Sa [g]", &["periods in s", "name it `T [s]`"]),
        ("T [min],Sa [g]", &["periods in s", "name it `T [s]`"]),
        ("# f [Hz], Sa [g]", &["periods in s", "T = 1/f"]),
        ("# f, Sa [g]", &["periods in s", "T = 1/f"]),
        ("# time [s], a [g]", &["line 1", "those of a record"]),
        ("Period (ms),Sa (g)", &["periods in s", "`Period (ms)`"]),
        ("x,Sa [g]", &["periods in s", "name it `T [s]`"]),
        ("Sa [g],T [s]", &["periods in s", "name it `T [s]`"]),
        ("T [s],Sa [m/s]", &["convert it to an acceleration"]),
        ("T [s],Sa [%g]", &["1 %g is 0.01 g"]),
        ("T [s],Sa [m/s2]", &["the stated unit g, found m/s2", "leave out --unit"]),
        ("t [s],a [g]", &["line 1", "periods in s", "`t [s]`", "those of a record"]),
        ("time [s],acc", &["line 1", "periods in s", "those of a record"]),
        ("T [s],Sv [g]", &["line 1", "convert it to an acceleration"]),
        ("T [s],Spectral velocity [g]", &["line 1", "convert it to an acceleration"]),
        ("T [s],PSV", &["line 1", "convert it to an acceleration"]),
        ("T [s],Sd (g)", &["line 1", "convert it to an acceleration"]),
        ("# T [s], Sa [m/s2]", &["line 1", "the stated unit g, found m/s2"]),
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
    let error = spectrum("T,Sa [g]\n0,0.25\n500,0.75\n", None, None).unwrap_err();
    assert_mentions(&error, &["line 3", "at most 20 s", "found 500 s", "milliseconds", "`T [s]`"]);
    let cp1252 = SpectrumFile::parse("s.csv", b"T [s];Sa [m/s\xb2]\n0;1\n1;1\n".to_vec(), None, None);
    let error = cp1252.unwrap_err().to_string();
    assert_mentions(&error, &["line 1", "0xb2", "Windows-1252", "save the file as UTF-8"]);
}
