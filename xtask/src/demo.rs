//! `cargo xtask demo`: builds the FMU and runs it under a ground motion.

use std::path::{Path, PathBuf};

use crate::command::{Result, output, read};
use crate::fmu::{self, Fmi};
use crate::python::Environment;

/// The library of the FMU, the program that packs it, and one that runs the wall without an FMU. They share
/// every crate.
const TARGETS: [&str; 7] = [
    "--package=rocking-wall-fmu",
    "--lib",
    "--package=fmu-export-build",
    "--features=fmu-export-build/archive",
    "--bin=fmu-pack",
    "--package=rocking-run",
    "--example=shaken_parapet",
];

/// Runs the demo with the embedded motion, then with the user's record if there is one.
pub(crate) fn run(record: &[&str]) -> Result<()> {
    // side by side: one of the two waits for the network
    let (built, python) = std::thread::scope(|scope| {
        let python = scope.spawn(|| Environment::of("demo"));
        let built = fmu::programs("demo", &TARGETS);
        (built, python.join().unwrap_or_else(|_| Err("a thread of the demo panicked".to_owned())))
    });
    let (programs, python) = (built?, python?);
    let library = programs.join(fmu::file_name(fmu::WALL, fmu::SYSTEM));
    let unit = fmu::pack_version(fmu::WALL, &[library], &programs, Fmi::Two, &fmu::out())?;
    let out = fmu::out();
    let shake = |base: PathBuf, record: &[&str]| shake(&unit, &python, &programs, &base, record);
    shake(out.join("demo"), &[])?;
    if let [file, ..] = record {
        let name = Path::new(file).file_stem().map_or_else(|| "record".into(), |stem| stem.to_string_lossy());
        shake(out.join(format!("demo_{name}")), record)?;
    }
    Ok(())
}

/// Shakes the FMU in FMPy with a motion, and the same wall in a program.
fn shake(unit: &Path, python: &Environment, programs: &Path, base: &Path, record: &[&str]) -> Result<()> {
    let file = |suffix: &str| PathBuf::from(format!("{}{suffix}", base.display()));
    let (input, history, page) = (file("_input.csv"), file(".csv"), file(".html"));
    let mut parapet = crate::command::program(programs.join("examples/shaken_parapet"));
    let in_program = output(parapet.arg(base).args(record), "see its message")?;
    let text = read(&input)?;
    let stop = text.lines().last().and_then(|line| line.split(',').next()).unwrap_or("30");
    let mut fmpy = python.program("python");
    fmpy.arg("tests/python/shake.py").arg(unit).arg(&input).arg(stop).arg(&history);
    let in_fmpy = output(&mut fmpy, "see its message")?;
    println!("largest |u| of the FMU in FMPy:   {} m", in_fmpy.lines().last().unwrap_or("?"));
    println!("the same without an FMU:          {} m", in_program.trim());
    for path in [&history, &page] {
        println!("written {}", path.display());
    }
    Ok(())
}
