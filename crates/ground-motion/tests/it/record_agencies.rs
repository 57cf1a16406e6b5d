//! What the formats of single agencies have of their own: several components, steps, peaks, old headers,
//! padding; and formats that are known and not read.

use ground_motion::{Format, Record, RecordOptions, STANDARD_GRAVITY, Unit, Warning, parse_channels};

use crate::specimen::{self, SAMPLES};
use crate::{assert_mentions, read};

fn plain(text: &str) -> Result<Record, String> {
    read("x", text, &RecordOptions::default())
}

#[track_caller]
fn all(text: &str) -> Vec<Record> {
    parse_channels("x", text.as_bytes().to_vec(), &RecordOptions::default()).unwrap()
}

/// Three components: their names, peaks (cm/s²), and which of them is vertical.
#[track_caller]
fn assert_components(text: &str, expected: [(&str, f64, bool); 3]) {
    let records = all(text);
    assert_eq!(records.len(), 3);
    for (record, (name, peak, is_vertical)) in records.iter().zip(expected) {
        assert_eq!(record.channel.as_deref(), Some(name));
        assert!((100.0 * record.motion.peak() - peak).abs() < 1e-9, "{name}: {}", record.motion.peak());
        let warnings = record.check().warnings;
        assert_eq!(warnings.contains(&Warning::Vertical), is_vertical, "{name}");
        assert!(
            !warnings.iter().any(|warning| matches!(warning, Warning::StatedPeak { .. })),
            "{warnings:?}"
        );
    }
    assert_mentions(&plain(text).unwrap_err(), &["expected one channel", expected[2].0]);
}

#[test]
fn components_stand_side_by_side() {
    let afad = "STRONG GROUND MOTION RECORDS OF TURKEY\nNUMBER OF DATA : 2\nSAMPLING INTERVAL (sec) : 0.01\n\
                RAW PGA VALUES (gal)    : (N-S) 3.5 (E-W) 2.5 (U-D) 1.5\nCopyright\n  N-S E-W U-D\n\
                1.0 2.5 -1.5\n-3.5 0.5 1.0\n";
    assert_components(afad, [("1: N-S", 3.5, false), ("2: E-W", 2.5, false), ("3: U-D", 1.5, true)]);
    // fields of ten characters that touch
    let cwa = "#RecordLength(sec): 0.04\n#SampleRate(Hz): 50\n#AmplitudeUnit:  gal. DCoffset(corr)\n\
               #AmplitudeMAX. U:  1.500~  -0.500\n#AmplitudeMAX. E:  0.500~  -12345.678\n\
               #DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n\
               \x20    5.000    -0.500     1.000     0.500\n     5.020     1.500     2.000-12345.678\n";
    assert_components(cwa, [("1: U", 1.5, true), ("2: N", 2.0, false), ("3: E", 12345.678, false)]);
    assert_eq!((all(cwa)[0].first_time, all(cwa)[0].motion.step()), (5.0, 0.02));
    let late = cwa.replace("     5.020", "     5.040");
    assert_mentions(&plain(&late).unwrap_err(), &["line 9", "the time 5.020 s", "found `5.040`"]);
    let short = cwa.replace("(sec): 0.04", "(sec): 120");
    assert_mentions(&plain(&short).unwrap_err(), &["6000 samples, as RecordLength", "found 2", "cut short"]);
    let nied = "#SamplingFrequency(Hz)\n#100\n#DurationTime(s)\n#0.02\n\
                #Time,RelativeTime(s),N-S(gal),E-W(gal),U-D(gal)\n\
                2011/03/11 14:48:19.00,0.00,1,2,3\n2011/03/11 14:48:19.01,0.01,-4,-5,-6\n";
    assert_components(nied, [("1: N-S", 4.0, false), ("2: E-W", 5.0, false), ("3: U-D", 6.0, true)]);
    let row = "2011/03/11 14:48:19.02,0.02,0,0,0\n";
    assert_eq!(all(&(nied.to_owned() + row))[0].motion.samples().len(), 3);
    let bare = &nied[nied.find("#Time").unwrap()..];
    for text in [bare, &bare[1..]] {
        assert_eq!((all(text).len(), all(text)[2].motion.step()), (3, 0.01));
    }
    let gap = nied.replace(",0.01,", ",0.02,");
    assert_mentions(&plain(&gap).unwrap_err(), &["line 7", "the time 0.010 s", "found `0.02`"]);
    for text in [afad, cwa, nied] {
        let damaged = text.replace("0.5", "0.x").replace("-5,", "-5.x,").replace("0.x00", "0.x0");
        assert_mentions(&plain(&damaged).unwrap_err(), &["a finite number", "3), found `"]);
    }
}

/// The stated number counts, and peaks are compared to the digits that the header has.
#[test]
fn unam_may_have_more_rows_than_it_states() {
    let text = specimen::unam(&SAMPLES);
    let more = plain(&(text.clone() + "    0.0010\n    0.0020\n")).unwrap();
    assert_eq!(more.motion.samples().len(), SAMPLES.len());
    let surplus = Warning::Surplus { found: SAMPLES.len() + 2, stated: SAMPLES.len() };
    assert_eq!(surplus.to_string(), "samples: the file states 11 and has 13; the first 11 are used");
    assert!(more.check().warnings.contains(&surplus));
    let states_other = |peak: &str| {
        let record = plain(&text.replacen("-103.25", peak, 1)).unwrap();
        record.check().warnings.iter().any(|warning| matches!(warning, Warning::StatedPeak { .. }))
    };
    assert!(!states_other("-103") && states_other("-110"));
    // 0.47 of 0.474 differs by 0.9 %, 0.04 of 0.044 by 10 %: both are rounded
    let small: Vec<f64> = SAMPLES.iter().map(|a| a * 0.044 / 103.25).collect();
    let record = plain(&specimen::unam(&small)).unwrap();
    assert!((record.stated_peak.unwrap() - 0.000_4).abs() < 1e-12, "{:?}", record.stated_peak);
    assert!(!record.check().warnings.iter().any(|warning| matches!(warning, Warning::StatedPeak { .. })));
}

#[test]
fn geonet_components_follow_one_another() {
    let corrected = specimen::geonet(&SAMPLES);
    let text = corrected.clone() + &corrected.replace("N10E", "N80W") + &corrected.replace("N10E", "Up");
    assert_components(
        &text,
        [("1: N10E", 103.25, false), ("2: N80W", 103.25, false), ("3: Up", 103.25, true)],
    );
    let error = plain(&corrected.replacen("      11", "      12", 1)).unwrap_err();
    assert_mentions(&error, &["line 17", "an end after 12 numbers"]);
    let error = plain(&(corrected + "    1.25\n")).unwrap_err();
    assert_mentions(&error, &["an end after 11 numbers"]);
}

/// The length is that of the points, not of the intervals between; times count, where there are any.
#[test]
fn volume_1_divides_the_length_by_the_points() {
    for (write, channel) in [(specimen::renadic as specimen::Writer, "1: L"), (specimen::bhrc, "1: L1")] {
        let text = write(&SAMPLES);
        let record = plain(&text).unwrap();
        assert_eq!((record.motion.step(), record.unit), (0.01, Unit::StandardGravity));
        assert_eq!(record.channel.as_deref(), Some(channel));
        // a tenth of 9.80665 m/s²
        assert!((record.motion.peak() - 103.25 / 98.0665 * 0.1 * STANDARD_GRAVITY).abs() < 1e-9);
        // the closing line of the last channel may be missing, but no digit
        let end = text.rfind("/&").unwrap();
        assert!(plain(&text[..end]).unwrap().check().warnings.contains(&Warning::Unclosed));
        let cut = plain(&text[..end - 2]).unwrap_err();
        assert!(channel == "1: L1" || cut.contains("the line `/&`") && cut.contains("cut short"), "{cut}");
        let error = plain(&text.replace("G/10", "COUNTS")).unwrap_err();
        assert_mentions(&error, &["G/10", "found `UNITS"]);
    }
    let bent = specimen::renadic(&SAMPLES).replacen("   0.050000000000", "   0.054000000000", 1);
    assert_mentions(&plain(&bent).unwrap_err(), &["uniform times", "found 0.054 s", "unevenly spaced film"]);
}

/// ESM has 64 header lines, AFAD 63 or a title, ITACA 55 or 43.
#[test]
fn esm_headers_have_any_length() {
    let esm = specimen::esm(&SAMPLES);
    let without = |lines: usize| -> String {
        let kept = esm.lines().enumerate().filter(|(index, _)| !(10..10 + lines).contains(index));
        kept.map(|(_, line)| line.to_owned() + "\n").collect()
    };
    let titled = "AFAD-TADAS\n".to_owned() + &esm;
    let upper = esm.replace("DATA_TYPE: ACCELERATION", "DATA_TYPE: Acceleration");
    for text in [without(1), without(9), without(21), titled, upper, specimen::itaca(&SAMPLES)] {
        let record = plain(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!((record.format, record.motion.samples().len()), (Format::Esm, SAMPLES.len()));
    }
    for quantity in ["VELOCITY", "PROCESSED VELOCITY", "ACCELERATION RESPONSE SPECTRUM"] {
        let error = plain(&esm.replace("DATA_TYPE: ACCELERATION", &format!("DATA_TYPE: {quantity}")));
        assert_mentions(&error.unwrap_err(), &["line 10", "an acceleration record", quantity]);
    }
}

#[test]
fn cosmos_may_indent_comments_and_leave_its_last_channel_open() {
    let text = specimen::cosmos(&SAMPLES);
    assert!(plain(&text.replace("\n|", "\n  |")).is_ok());
    let (open, closing) = text.split_at(text.find("End-of-data").unwrap());
    assert!(!plain(&text).unwrap().check().warnings.contains(&Warning::Unclosed));
    assert!(plain(open).unwrap().check().warnings.contains(&Warning::Unclosed));
    let error = plain(&open.trim_end()[..open.trim_end().len() - 1]).unwrap_err();
    assert_mentions(&error, &["the closing line `End-of-data`", "cut short"]);
    // as CSMIP closes it
    let closed = open.to_owned() + "/&  ----------  End of data for channel  1  ----------\n";
    assert!(!plain(&closed).unwrap().check().warnings.contains(&Warning::Unclosed));
    assert_eq!(all(&(closed.clone() + &closed)).len(), 2);
    assert!(closing.starts_with("End"));
}

#[test]
fn film_pairs_of_smc_are_refused_for_what_they_are() {
    let text = specimen::smc(&SAMPLES).replacen("2 CORRECTED", "1 UNCORRECTED", 1);
    assert!(plain(&text).is_ok(), "evenly spaced");
    let error = plain(&text.replacen("  1.0000000E2", " 1.7000000E38", 1)).unwrap_err();
    assert_mentions(&error, &["evenly spaced samples", "found pairs of times", "use the corrected record"]);
}

/// Zeros that fill the last line are left out; anything else is more than the file states, and no cut.
#[test]
fn zeros_may_fill_the_last_line() {
    for (write, zero) in
        [(specimen::at2 as specimen::Writer, "   0.000000E0"), (specimen::csmip, "     0.000")]
    {
        let text = write(&SAMPLES);
        let last = if zero.contains('E') { "  -1.240000E-1" } else { "    -0.124" };
        assert!(text.contains(last), "{text}");
        for count in [1, 3] {
            let record = plain(&text.replace(last, &(last.to_owned() + &zero.repeat(count)))).unwrap();
            assert_eq!(record.motion.samples().len(), SAMPLES.len());
        }
        let error = plain(&text.replace(last, &(last.to_owned() + &zero.replace("0.0", "9.0")))).unwrap_err();
        assert!(error.contains("11") && !error.contains("cut short"), "{error}");
    }
    let text = specimen::at2(&SAMPLES);
    let error = plain(&(text + "0 0 0 0 0\n")).unwrap_err();
    assert_mentions(&error, &["11 samples, as NPTS", "found 16", "more samples than it states"]);
}

/// They are not taken for CSMIP, K-NET or a table.
#[test]
fn known_formats_that_are_not_read_are_named() {
    let csmnc = "051XXX1304\nCOMP. EW\nUNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC\n\
                 NO. OF POINTS:  2  EQUALLY SPACED INTERVALS OF:  0.01  SEC\n 0.1 0.2\n";
    let usc = "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\nUNITS ARE SEC AND G/10\n";
    let simbad = "SIMBAD v05, a record\nNPTS= 2, DT= 0.01\n1 2\n";
    for (text, name, remedy) in [
        (csmnc, "a record of CSMNC, China", "--record-step"),
        (simbad, "a record of SIMBAD, Italy", "--record-step"),
        (usc, "volume 1 of USC or USGS", "unevenly spaced film data"),
    ] {
        assert_mentions(&plain(text).unwrap_err(), &["line 1", "a format that is read", name, remedy]);
    }
}

#[test]
fn plain_numbers_are_the_samples_in_their_order() {
    let stated = RecordOptions {
        unit: Some(Unit::CentimetrePerSecondSquared),
        step: Some(0.01),
        ..RecordOptions::default()
    };
    let long: Vec<f64> = (0..203).map(|i| (0.3 * f64::from(i)).sin()).collect();
    for text in [
        specimen::numbers(&long),
        specimen::numbers(&long).replace(' ', ",").replace("\n,", "\n"),
        "# a comment\n".to_owned() + &specimen::numbers(&long),
    ] {
        let record = read("x.txt", &text, &stated).unwrap();
        assert_eq!((record.format, record.motion.step()), (Format::Numbers, 0.01));
        for (found, expected) in record.motion.samples().iter().zip(&long) {
            // three decimals are written
            assert!((100.0 * found - expected).abs() < 0.000_501, "{found}");
        }
        let error = read("x.txt", &text, &RecordOptions { step: None, ..stated.clone() }).unwrap_err();
        assert_mentions(&error, &["found 5 numbers a line and no step", "--record-step", "header line"]);
        let error = read("x.txt", &text, &RecordOptions { unit: None, ..stated.clone() }).unwrap_err();
        assert_mentions(&error, &["a stated unit", "no unit"]);
        let error = read("x.txt", &text.replacen("0.", "0.x", 1), &stated).unwrap_err();
        assert_mentions(&error, &["x.txt, line"]);
    }
    // two numbers a line are such only with a stated step, and if the first are no times
    let row = |row: &[f64]| format!("{:.3} {:.3}", row[0], row[row.len() - 1]);
    let pairs = long.chunks(2).map(row).collect::<Vec<_>>().join("\n");
    let record = read("x.txt", &pairs, &stated).unwrap();
    assert_eq!((record.format, record.motion.samples().len()), (Format::Numbers, 204));
    let error = read("x.txt", &pairs, &RecordOptions { step: None, ..stated.clone() }).unwrap_err();
    assert_mentions(&error, &["line 3", "the first step of"]);
    let rounded = "0.00 0.1\n0.01 0.2\n0.01 0.3\n0.02 0.1\n";
    assert_mentions(&read("x.txt", rounded, &stated).unwrap_err(), &["line 3", "a time after 0.01 s"]);
    // three components side by side, and a table of times
    let rows = |row: fn(f64) -> String| -> String { (0..60).map(|i| row(f64::from(i))).collect() };
    let side =
        rows(|i| format!("{:.4} {:.4} {:.4}\n", (0.1 * i).sin(), 5.0 + (0.1 * i).cos(), 0.01 * i - 3.0));
    let error = read("x.txt", &side, &stated).unwrap_err();
    assert_mentions(
        &error,
        &["one record in their order", "3 columns that change more slowly", "one sample"],
    );
    let table = rows(|i| format!("{:.2} {:.4} {:.4}\n", 0.01 * i, (0.9 * i).sin(), (0.7 * i).cos()));
    assert_mentions(&read("x.txt", &table, &stated).unwrap_err(), &["one column beside", "found 3"]);
}
