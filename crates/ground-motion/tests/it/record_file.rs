//! Tests files of any kind: size limits, binary content, paths that are not files.

use std::fs::{self, File};
use std::path::PathBuf;

use ground_motion::{
    Format, MAX_FILE_BYTES, RecordOptions, SyntheticMotion, Unit, Warning, is_companion, parse, read,
};
use proptest::prelude::*;

use crate::assert_mentions;
use crate::specimen::{self, SAMPLES};

fn stated() -> RecordOptions {
    RecordOptions { unit: Some(Unit::StandardGravity), step: Some(0.01), ..RecordOptions::default() }
}

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Returns random bytes, from the noise of a synthetic record.
fn noise() -> Vec<u8> {
    let motion = SyntheticMotion::default().motion().expect("the default is valid");
    motion.samples().iter().flat_map(|a| a.to_bits().to_le_bytes()).collect()
}

#[track_caller]
fn assert_refused(path: &PathBuf, fragments: &[&str]) {
    let error = read(path, &stated()).expect_err("no record").to_string();
    assert!(error.starts_with(&path.display().to_string()), "{error}");
    assert_mentions(&error, fragments);
}

#[test]
fn reads_a_file() {
    let path = file("sound.csv");
    fs::write(&path, "# three samples\n0.1\n0.2\n-0.3\n").unwrap();
    let record = read(&path, &stated()).unwrap();
    assert_eq!(record.motion.samples().len(), 3);
    assert_eq!(record.header, ["three samples"]);
    // A stated format is the only one that is tried.
    let error =
        read(&path, &RecordOptions { format: Some(Format::At2), ..stated() }).unwrap_err().to_string();
    assert!(error.contains("NPTS"), "{error}");
    assert_eq!("CSV".parse::<Format>().unwrap(), Format::Csv);
    assert!("wav".parse::<Format>().unwrap_err().to_string().contains("`wav`"));
}

#[test]
fn refuses_what_is_no_file() {
    assert_refused(&file("there_is_none.AT2"), &["cannot be read"]);
    assert_refused(&file(""), &["expected a record of at most 67108864 bytes, found a folder"]);
    #[cfg(unix)]
    assert_refused(&PathBuf::from("/dev/zero"), &["bytes, found a pipe or device"]);
}

#[test]
fn refuses_noise_at_its_first_byte() {
    let path = file("noise.AT2");
    let mut bytes = b"time,a_g\n0,1\n".to_vec();
    bytes.extend(noise());
    fs::write(&path, bytes).unwrap();
    assert_refused(&path, &["line ", "expected text, found the byte 0x00", "plain text"]);
    let utf16: Vec<u8> = "time,a_g\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let error = parse("x.csv", utf16, &stated()).unwrap_err().to_string();
    assert!(error.contains("line 1") && error.contains("UTF-16") && error.contains("as UTF-8"), "{error}");
}

#[test]
fn refuses_two_gigabytes_without_reading_them() {
    // sparse files: they take no space and are not read
    for ending in ["csv", "AT2", "ASC", "EW", "V2c", "V2", "smc", "V1A", "V2A", "v1", "dat"] {
        let path = file(&format!("large.{ending}"));
        File::create(&path).unwrap().set_len(2 << 30).unwrap();
        assert_refused(&path, &["at most 67108864 bytes", "found 2147483648"]);
        fs::remove_file(&path).unwrap();
    }
    assert_eq!(MAX_FILE_BYTES, 67_108_864);
}

/// Half a megabyte of blanks is read, and refused with one message in each format: what looks at the rest of
/// the file again for each blank would take minutes.
#[test]
fn refuses_a_file_of_blanks() {
    for format in Format::ALL {
        for blank in [b' ', b'\n'] {
            let mut bytes = vec![blank; usize::try_from(MAX_FILE_BYTES).unwrap() / 128];
            let options = RecordOptions { format: Some(format), ..stated() };
            let error = parse("x", bytes.clone(), &options).unwrap_err().to_string();
            assert!(error.starts_with("x, line 1: expected") && error.len() < 300, "{error}");
            // followed by other text, so that they are not trimmed
            bytes.push(b'1');
            let error = parse("x", bytes, &options).unwrap_err().to_string();
            assert!(error.starts_with("x, line ") && error.len() < 300, "{format:?}: {error}");
        }
    }
}

#[test]
fn shortens_what_it_quotes() {
    let error = parse("x.csv", vec![b'7'; 100_000], &stated()).unwrap_err().to_string();
    assert!(error.contains("`7777") && error.len() < 300, "{error}");
}

proptest! {
    #![proptest_config(crate::configuration::configuration())]

    #[test]
    fn never_panics_on_any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..500)) {
        for format in [None, Some(Format::At2), Some(Format::Csv)] {
            let _ = parse("x", bytes.clone(), &RecordOptions { format, ..stated() });
        }
    }

    #[test]
    fn never_panics_on_any_text(text in "\\PC{0,200}") {
        for format in [None, Some(Format::At2), Some(Format::Csv)] {
            let _ = parse("x", text.clone().into_bytes(), &RecordOptions { format, ..stated() });
        }
    }
}

/// The direction as each format states it; specimens are horizontal.
#[test]
fn headers_state_vertical_directions() {
    let is_vertical =
        |text: &str| parse("x", text.as_bytes().to_vec(), &RecordOptions::default()).unwrap().is_vertical;
    for (format, write, level, vertical) in [
        (Format::At2, specimen::at2 as fn(&[f64]) -> String, "hill, 90\n", "hill, UP\n"),
        (Format::At2, specimen::at2, "hill, 90\n", "hill, DWN (STATION 5)\n"),
        (Format::Esm, specimen::esm, "STREAM: HNE", "STREAM: HNZ"),
        (Format::Knet, specimen::knet, "E-W", "U-D"),
        (Format::Knet, specimen::knet, "E-W", "6"),
        (Format::Cosmos, specimen::cosmos, "90 Deg", "Up"),
        (Format::Csmip, specimen::csmip, "90 Deg", "Down"),
        (Format::Smc, specimen::smc, "*\n", "a hill component=   UP\n"),
        (Format::Esm, specimen::itaca, "COMPONENT: WE", "COMPONENT: UP"),
        (Format::Geonet, specimen::geonet, "Component N10E", "Component Up"),
        (Format::Afad, specimen::afad, "       N-S\n", "       U-D\n"),
        (Format::Cwa, specimen::cwa, "Time N(+)", "Time U(+)"),
        (Format::Unam, specimen::unam, ": /N00E", ": /V"),
        (Format::Volume1, specimen::renadic, "1: L  ", "1: V  "),
        (Format::Volume1, specimen::bhrc, "COMP L1", "COMP V2"),
        (Format::KnetCsv, specimen::knet_csv, "N-S(gal)", "U-D(gal)"),
        (Format::Fdsn, specimen::fdsn::slist, "HNE", "HNZ"),
        (Format::Fdsn, specimen::fdsn::geocsv, "H_N_E", "H_N_Z"),
    ] {
        let text = write(&SAMPLES);
        assert!(!is_vertical(&text), "{format:?}");
        let text = text.replacen(level, vertical, 1);
        assert!(is_vertical(&text), "{format:?}: {text:.300}");
    }
}

/// AT2, tables and plain numbers may leave the direction to the name of the file or of the column.
#[test]
fn names_state_vertical_directions() {
    let named = |name: &str, text: &str, column: Option<&str>| {
        let options = RecordOptions { column: column.map(str::to_owned), ..stated() };
        let record = parse(name, text.as_bytes().to_vec(), &options).unwrap();
        let is_found = record.check().warnings.contains(&Warning::Vertical);
        assert_eq!(record.is_vertical, is_found, "{name}");
        is_found
    };
    let at2 = "UNITS OF G\nNPTS= 2, DT= .01 SEC\n0.1 0.2\n";
    for name in ["a/RSN6_IMPVALL.I_I-ELC-UP.AT2", "CHY035-V.at2", "NAS_DWN.AT2", "X.ABC..HNZ.AT2", "U-D.AT2"]
    {
        assert!(named(name, at2, None), "{name}");
    }
    for name in ["UP/RSN6_IMPVALL.I_I-ELC180.AT2", "GROUP.AT2", "HNE.AT2", "CHAZ.AT2", "x"] {
        assert!(!named(name, at2, None), "{name}");
    }
    let column = "0.1\n0.2\n";
    assert!(named("station_UD.csv", column, None) && named("IV.X.HNZ.txt", column, None));
    // a scaled record, a velocity
    assert!(!named("scaled-up.csv", column, None) && !named("record_v.csv", column, None));
    let table = "time,N-S,U-D\n0,0.1,0.2\n0.01,0.3,0.4\n";
    assert!(named("x.csv", table, Some("U-D")) && !named("x.csv", table, Some("N-S")));
}

/// The folders of OQ-VMTK have the times of `acc_3.csv` in `dts_3.csv`, beside it or in a folder beside.
#[test]
fn times_beside_a_record_give_its_step() {
    let folder = file("oq_vmtk");
    for inner in ["acc", "dts", "both"] {
        fs::create_dir_all(folder.join(inner)).unwrap();
    }
    let stated = RecordOptions { unit: Some(Unit::StandardGravity), ..RecordOptions::default() };
    let times = "0.02\n0.039999999999999994\n0.06\n0.07999999999999999\n";
    for [record, step] in [["acc/acc_3.csv", "dts/dts_3.csv"], ["both/acc_3.csv", "both/dts_3.csv"]] {
        let [record, step] = [record, step].map(|name| folder.join(name));
        fs::write(&record, "0.1\n-0.2\n0.3\n0.1\n").unwrap();
        fs::write(&step, times).unwrap();
        assert!(is_companion(&step) && !is_companion(&record));
        assert_eq!(read(&record, &stated).unwrap().motion.step(), 0.02);
        // a stated step counts
        let other = RecordOptions { step: Some(0.01), ..stated.clone() };
        assert_eq!(read(&record, &other).unwrap().motion.step(), 0.01);
        fs::write(&step, "0.005\n").unwrap();
        assert_eq!(read(&record, &stated).unwrap().motion.step(), 0.005);
        for (times, words) in [
            ("0.00\n0.01\n0.04\n", ["line 3", "the first step of 0.01 s, found a step of 0.03 s"]),
            ("\n0.00\n\n0.01\n0.04\n", ["line 5", "the first step of 0.01 s, found a step of 0.03 s"]),
            ("0.03\n0.02\n0.01\n0.00\n", ["line 2", "expected a time after 0.03 s, found 0.02 s"]),
            ("0\n0.01\n\n0.01\n", ["line 4", "expected a time after 0.01 s, found 0.01 s"]),
            ("\n-0.01\n", ["line 2", "expected a step above 0 s, found -0.01 s"]),
            ("\n", ["line 1", "found an empty file"]),
            ("0\n0.01\n0.02\n\n", ["line 3", "expected 4 times, one for each sample of the record, found 3"]),
            ("0\n1\n2\n3\n4\n", ["line 5", "expected 4 times, one for each sample of the record, found 5"]),
        ] {
            fs::write(&step, times).unwrap();
            let error = read(&record, &stated).unwrap_err().to_string();
            assert_mentions(&error, &["dts_3.csv", words[0], words[1], "--record-step"]);
        }
    }
    assert!(!is_companion(&folder.join("dts/dts_4.csv")));
}
