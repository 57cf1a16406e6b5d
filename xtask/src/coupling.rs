//! `cargo xtask coupling`: measures coupling error against communication step and run time; writes a
//! table and the figures of `docs/coupling.md`.

use crate::command::{Result, read, root, succeed};
use crate::figures;
use crate::fmu;
use crate::python::Environment;

const DOCUMENT: &str = "docs/coupling.md";

/// Measures, writes the CSV file and the figures of the document.
pub(crate) fn run() -> Result<()> {
    let wall = fmu::build(fmu::WALL)?;
    let floor = fmu::build(fmu::FLOOR)?;
    let python = Environment::of("tests")?;
    let folder = root().join("fmu_out");
    let mut measure = python.program("python");
    measure.arg("tests/coupling/measure.py").arg(wall).arg(floor).arg(&folder);
    succeed(&mut measure, "see its message above")?;
    figures::write_marked(DOCUMENT, &[("figures", read(folder.join("coupling.md"))?)])?;
    println!("written {DOCUMENT}, fmu_out/coupling.csv");
    Ok(())
}
