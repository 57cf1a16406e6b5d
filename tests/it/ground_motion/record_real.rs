//! Real records, where there are any: format, count, step, peak and AvgSA as in their index.
//!
//! They cannot be copied into the project. The folder is the one `ROCKING_WALL_RECORDS` names, or `../shared/records`.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use rocking_wall::ground_motion::spectrum::AVERAGE_PERIODS;
use rocking_wall::ground_motion::{Format, ReadOptions, STANDARD_GRAVITY, Spectrum, Unit, read};

/// The folder of records; a folder that was asked for must be there.
fn folder() -> Option<PathBuf> {
    if let Some(folder) = env::var_os("ROCKING_WALL_RECORDS").map(PathBuf::from) {
        assert!(
            folder.join("index.csv").is_file(),
            "ROCKING_WALL_RECORDS={} has no index.csv",
            folder.display()
        );
        return Some(folder);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/records");
    folder.join("index.csv").is_file().then_some(folder)
}

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
        let options = match row[format].as_str() {
            "xlsx" => ReadOptions { unit: Some(Unit::CentimetrePerSecondSquared), ..ReadOptions::default() },
            // The index describes the first channel.
            "CSMIP-V2" => ReadOptions { channel: Some("1".into()), ..ReadOptions::default() },
            _ => ReadOptions::default(),
        };
        let record = read(folder.join(name), &options).unwrap();
        assert_eq!(record.format, format_of(&row[format]), "{name}");
        let motion = record.motion;
        assert_eq!(motion.samples().len(), row[count].parse::<usize>().unwrap(), "{name}");
        assert_eq!(motion.step(), row[step].parse::<f64>().unwrap(), "{name}");
        // The index gives five decimals.
        let error = motion.peak() / STANDARD_GRAVITY - row[peak].parse::<f64>().unwrap();
        assert!(error.abs() <= 0.500_001e-5, "{name}: peak off by {error} g");
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
            // Six decimals; the index's maxima are taken at samples of at most 5 ms: (ω h)² / 8 = 0.3 % at 0.2 s and a
            // quarter of that on average at most, pyrotd's to 0.1 %.
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
