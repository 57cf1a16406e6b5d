//! `cargo xtask generate`: what is derived from the code and its descriptions.

use crate::command::{Result, cargo, succeed};
use crate::python::Environment;
use crate::{fmu, wheel};

/// Writes parts of what is derived, or all of it. With `check` they are compared instead: a stale one is an
/// error.
pub(crate) fn run(parts: &[&str], check: bool) -> Result<()> {
    let parts = if parts.is_empty() { &["documents", "python"] } else { parts };
    parts.iter().try_for_each(|part| match *part {
        "documents" => documents(check),
        "python" => python(check),
        other => Err(format!("`{other}` is not one of documents, python")),
    })
}

/// The test that compares also writes: what it derives from is linked into it.
fn documents(check: bool) -> Result<()> {
    let mut test = cargo();
    test.args(["test", "--quiet", "--locked", "--package", "xtask", "--test", "it", "generated"]);
    if !check {
        test.env("ROCKING_WALL_GENERATE", "1");
    }
    succeed(&mut test, "see its message above")
}

fn python(check: bool) -> Result<()> {
    let python = Environment::of("wheel")?;
    wheel::install(&wheel::build("dev", &fmu::build(fmu::WALL)?, None)?, &python)?;
    let mut parameters = python.program("python");
    parameters.arg("tests/wheel/parameters.py").args(check.then_some("--check"));
    succeed(&mut parameters, "see its message above")
}
