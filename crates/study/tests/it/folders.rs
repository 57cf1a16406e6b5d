//! Studies in folders, as tests run and read them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use study::codes::Codes;
use study::folder::{Folder, compute};
use study::loaded::LoadedStudy;

pub(crate) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    drop(fs::remove_dir_all(&path));
    path
}

/// Runs an analysis, and returns its folder.
pub(crate) fn run_analysis(name: &str, loaded: &LoadedStudy) -> PathBuf {
    let path = folder(name);
    let folder = Folder::of_study(&path, loaded).unwrap();
    let missing = folder.missing(0..folder.contents().parts());
    compute(&loaded.study, &folder, &missing, 2).unwrap();
    study::folder::finish(&folder, 2).unwrap();
    path
}

/// The rows of a table by the names of its columns.
pub(crate) fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    lines.map(|cells| names.iter().cloned().zip(cells).collect()).collect()
}

pub(crate) fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name} = {:?}", row[name]))
}

pub(crate) fn load(name: &str, text: &str, codes: &dyn Codes) -> Result<LoadedStudy, String> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.toml"));
    fs::write(&path, text).unwrap();
    LoadedStudy::read(&path, codes).map_err(|error| error.to_string())
}
