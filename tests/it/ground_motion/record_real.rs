//! Real records, where there are any: count, step and peak as in their index.
//!
//! They cannot be copied into the project. The folder is the one `ROCKING_WALL_RECORDS` names, or `../shared/records`.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use rocking_wall::ground_motion::{ReadOptions, STANDARD_GRAVITY, Unit, read};

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
    let mut read_files = 0;
    for row in rows {
        let unit = match row[format].as_str() {
            "AT2" => None,
            "xlsx" => Some(Unit::CentimetrePerSecondSquared),
            _ => continue,
        };
        let record = read(folder.join(&row[file]), &ReadOptions { unit, ..ReadOptions::default() }).unwrap();
        let motion = record.motion;
        assert_eq!(motion.samples().len(), row[count].parse::<usize>().unwrap(), "{}", row[file]);
        assert_eq!(motion.step(), row[step].parse::<f64>().unwrap(), "{}", row[file]);
        // The index gives five decimals.
        let error = motion.peak() / STANDARD_GRAVITY - row[peak].parse::<f64>().unwrap();
        assert!(error.abs() <= 0.500_001e-5, "{}: peak off by {error} g", row[file]);
        read_files += 1;
    }
    assert!(read_files > 0, "{} lists no AT2 or CSV record", folder.display());
    eprintln!("{read_files} real records match their index");
}
