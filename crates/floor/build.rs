//! Turns the model description into Rust variables; the library includes them as `variables`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "cargo and the user are spoken to this way")]

use std::path::PathBuf;
use std::process::ExitCode;

const DESCRIPTION: &str = "modelDescription/modelDescription.xml";

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed={DESCRIPTION}");
    let Some(out_dir) = std::env::var_os("OUT_DIR") else {
        eprintln!("OUT_DIR is not set: this program is run by cargo");
        return ExitCode::FAILURE;
    };
    match fmi2_export_build::generate(DESCRIPTION.as_ref(), &PathBuf::from(out_dir)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("cargo::error={error}");
            ExitCode::FAILURE
        }
    }
}
