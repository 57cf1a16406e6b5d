//! Tests real records, if there are any: format, count, step, peak and AvgSA agree with their index.
//!
//! They cannot be copied into the project. The folder is the one `ROCKING_WALL_RECORDS` names, or
//! `../shared/records`.

use std::fs;

use ground_motion::spectrum::AVERAGE_PERIODS;
use ground_motion::{
    Format, Record, RecordOptions, STANDARD_GRAVITY, Spectrum, Unit, parse, parse_channels, read,
};

use crate::record_formats::assert_clear_of;
use crate::records::folder;

/// The cells of a line in which quotes may hold commas.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for character in line.chars() {
        match character {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("there is a first cell").push(character),
        }
    }
    cells
}

#[test]
fn real_records_match_their_index() {
    let Some(folder) = folder() else {
        eprintln!("not run: no real records (set ROCKING_WALL_RECORDS to their folder)");
        return;
    };
    let index = fs::read_to_string(folder.join("index.csv")).unwrap();
    let mut rows = index.lines().map(cells);
    let header = rows.next().unwrap();
    let column = |name: &str| header.iter().position(|cell| cell == name).unwrap();
    let (file, format) = (column("file"), column("format"));
    let (step, count, peak) = (column("dt_s"), column("npts"), column("pga_g"));
    let averages = ["avgsa_g_pyrotd", "avgsa_g_eqsig"].map(column);
    let mut read_files = 0;
    for row in rows {
        let name = &row[file];
        let options = options(&row[format]);
        let record = read(folder.join(name), &options).unwrap();
        assert_eq!(record.format, format_of(&row[format]), "{name}");
        let motion = record.motion;
        assert_eq!(motion.samples().len(), row[count].parse::<usize>().unwrap(), "{name}");
        assert_eq!(motion.step(), row[step].parse::<f64>().unwrap(), "{name}");
        // The index gives five decimals.
        let error = motion.peak() / STANDARD_GRAVITY - row[peak].parse::<f64>().unwrap();
        assert!(error.abs() <= 0.500_001e-5, "{name}: peak off by {error} g");
        let states_peak = !matches!(record.format, Format::At2 | Format::Csv);
        assert_eq!(record.stated_peak.is_some(), states_peak, "{name}");
        if let Some(stated) = record.stated_peak {
            // Headers have at least three digits.
            assert!(
                (motion.peak() / stated - 1.0).abs() < 5e-3,
                "{name}: {} and {stated} m/s²",
                motion.peak()
            );
        }
        let average = Spectrum::default().average(&motion, &AVERAGE_PERIODS).unwrap() / STANDARD_GRAVITY;
        for &column in &averages {
            let stated: f64 = row[column].parse().unwrap();
            // Six decimals; the index's maxima are taken at samples of at most 5 ms: (ω h)² / 8 = 0.3 % at
            // 0.2 s and a quarter of that on average at most, pyrotd's to 0.1 %.
            assert!(
                (average / stated - 1.0).abs() < 1e-3 + 0.5e-6 / stated,
                "{name}: AvgSA {average}, {stated} g"
            );
        }
        read_files += 1;
    }
    assert!(read_files > 0, "{} lists no record", folder.display());
    eprintln!("{read_files} real records match their index");
}

fn format_of(name: &str) -> Format {
    match name {
        "AT2" => Format::At2,
        "xlsx" => Format::Csv,
        "CSMIP-V2" => Format::Csmip,
        "SMC" => Format::Smc,
        "ESM-DYNA1.2" => Format::Esm,
        "K-NET" => Format::Knet,
        "COSMOS-V2c" => Format::Cosmos,
        other => panic!("the index has the unknown format {other}"),
    }
}

/// What has to be stated to read a file of the index.
fn options(format: &str) -> RecordOptions {
    match format {
        "xlsx" => RecordOptions { unit: Some(Unit::CentimetrePerSecondSquared), ..RecordOptions::default() },
        // The index describes the first channel.
        "CSMIP-V2" => RecordOptions { channel: Some("1".into()), ..RecordOptions::default() },
        _ => RecordOptions::default(),
    }
}

/// Every file of the folder is in the index: none is left unread.
#[test]
fn the_index_lists_every_real_record() {
    let Some(folder) = folder() else {
        eprintln!("not run: no real records (set ROCKING_WALL_RECORDS to their folder)");
        return;
    };
    let index = fs::read_to_string(folder.join("index.csv")).unwrap();
    let listed: Vec<_> = index.lines().skip(1).map(|line| cells(line).swap_remove(0)).collect();
    let mut count = 0;
    for inner in ["", "formats/"] {
        for entry in fs::read_dir(folder.join(inner)).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{inner}{}", entry.file_name().to_string_lossy());
            if entry.path().is_file() && !matches!(name.as_str(), "index.csv" | "PROVENANCE.md") {
                assert!(listed.contains(&name), "{name} is not in the index");
                count += 1;
            }
        }
    }
    assert_eq!(count, listed.len());
}

/// What a file says when it is damaged in one of the ways files are.
#[track_caller]
fn assert_refused(name: &str, bytes: Vec<u8>, options: &RecordOptions, what: &str) {
    match parse_channels(name, bytes, options) {
        Ok(records) => {
            let found: Vec<_> = records.iter().map(|record| record.motion.samples().len()).collect();
            panic!("{name}, {what}: read {found:?} samples")
        }
        Err(error) => assert_clear_of(name, &error.to_string(), &format!("{name}, {what}")),
    }
}

#[test]
fn damaged_real_records_give_one_clear_message() {
    let Some(folder) = folder() else {
        eprintln!("not run: no real records (set ROCKING_WALL_RECORDS to their folder)");
        return;
    };
    let index = fs::read_to_string(folder.join("index.csv")).unwrap();
    for line in index.lines().skip(1) {
        let row = cells(line);
        let (name, options) = (&row[0], options(&row[1]));
        let bytes = fs::read(folder.join(name)).unwrap();
        let whole: Record = parse(name, bytes.clone(), &options).unwrap();
        // all of them are ASCII but for names of places
        let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
        let lines: Vec<&str> = text.lines().map(|line| line.trim_end_matches('\r')).collect();
        for ending in ["\n", "\r\n", "\r\r\n"] {
            let other = parse(name, lines.join(ending).into_bytes(), &options).unwrap();
            assert_eq!(other.motion, whole.motion, "{name} with {ending:?}");
        }
        for part in [0.0, 0.002, 0.2, 0.5, 0.9] {
            let mut cut = bytes.clone();
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a part of the length"
            )]
            cut.truncate((bytes.len() as f64 * part) as usize);
            if whole.format == Format::Csv && part > 0.0 {
                // a table does not state its length; the check of `wall record` looks at its end
                match parse(name, cut, &options) {
                    Ok(record) => {
                        assert!(record.motion.samples().len() < whole.motion.samples().len(), "{name}");
                    }
                    Err(error) => assert_clear_of(name, &error.to_string(), name),
                }
                continue;
            }
            assert_refused(name, cut, &options, &format!("cut at {part}"));
        }
        // a line of samples: of the first channel's acceleration where other quantities follow
        let place = if whole.format == Format::Csmip { lines.len() / 16 } else { lines.len() * 7 / 10 };
        let with = |line: Option<String>| -> Vec<u8> {
            let before = lines[..place].iter().map(|line| (*line).to_owned());
            let after = lines[place + 1..].iter().map(|line| (*line).to_owned());
            before.chain(line).chain(after).collect::<Vec<_>>().join("\n").into_bytes()
        };
        let victim = lines[place];
        let replaced = |digits: char| victim.replace(|c: char| c.is_ascii_digit(), &digits.to_string());
        let short = victim.len().saturating_sub(3);
        for (what, line) in [
            ("a line missing", None),
            ("a line twice", Some(format!("{victim}\n{victim}"))),
            ("stars", Some(replaced('*'))),
            ("dots", Some(replaced('.'))),
            ("NaN", Some(format!("{}NaN", &victim[..short]))),
            ("inf", Some(format!("{}inf", &victim[..short]))),
        ] {
            assert_refused(name, with(line), &options, what);
        }
    }
}
