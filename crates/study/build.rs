//! Makes the fingerprint of the sources that a run depends on.
//!
//! It is the same on every machine, and changes only with these files. A copy of this crate from a registry
//! lacks those of the other crates: their versions say which they are.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// The solvers and what they use, the levels and models of a study, and the versions of the crates of others.
/// A module or crate that a run comes to depend on belongs here.
const SOURCES: [&str; 14] = [
    "../../Cargo.lock",
    "../../modelDescription/modelDescription.xml",
    "../../src",
    "../files/src",
    "../fragility/src/curve.rs",
    "../ground-motion/src",
    "../oscillator/src",
    "../record/src",
    "../run/src/free_motion.rs",
    "../run/src/model.rs",
    "../run/src/parallel.rs",
    "../run/src/shaking.rs",
    "../scene/src",
    "src/ida",
];

fn main() -> io::Result<()> {
    let mut bytes = Vec::new();
    for source in SOURCES.iter().map(Path::new).filter(|source| source.exists()) {
        println!("cargo::rerun-if-changed={}", source.display());
        for file in files(source)? {
            bytes.extend(file.file_name().unwrap_or_default().to_string_lossy().bytes());
            // line ends depend on the checkout
            bytes.extend(fs::read(&file)?.into_iter().filter(|byte| *byte != b'\r'));
        }
    }
    println!("cargo::rustc-env=SOURCES={:032x}", fmu_export::fnv1a_128(bytes.into_iter()));
    Ok(())
}

/// Lists a file, or all files in a folder and its folders, in the order of their paths.
fn files(path: &Path) -> io::Result<Vec<PathBuf>> {
    if path.is_file() {
        return Ok(vec![path.to_owned()]);
    }
    let mut entries = fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    Ok(entries.iter().map(|entry| files(entry)).collect::<io::Result<Vec<_>>>()?.concat())
}
