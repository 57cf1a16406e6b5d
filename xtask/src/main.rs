//! The jobs of the project: `cargo xtask fmu | demo | test | bench`.
//!
//! No dependencies: this program builds in a second on a fresh machine. The Python packages a job needs it installs
//! itself under the target folder, pinned by hash.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks to its user")]

mod bench;
mod command;
mod coupling;
mod demo;
mod figures;
mod fmu;
mod python;
mod test;

use std::path::PathBuf;
use std::process::ExitCode;

/// What went wrong, with the remedy.
pub(crate) type Result<T> = std::result::Result<T, String>;

const HELP: &str = "\
The jobs of the project.

  cargo xtask fmu [--portable]     build the libraries, zip fmu_out/wall.fmu and floor.fmu
                                   --portable: with zig, for Linux machines as old as glibc 2.17
  cargo xtask demo [RECORD [UNIT]] build the FMU, shake it with the embedded motion and, if given, with a record
                                   (with its unit, if it states none), write histories and pages to fmu_out/
  cargo xtask figures [RECORD.AT2] measure accuracy, stability and the peers; write docs/accuracy.md and the pages
  cargo xtask coupling             measure walls on floors: schemes, steps, run time; write docs/coupling.md and its page
  cargo xtask test                 every test: Rust, the FMU through FMPy, the C boundary against fmi-sys
  cargo xtask bench [RECORD.AT2]   ns a sample of each path, and instructions where valgrind is installed
  cargo xtask bench --peers [RECORD.AT2]
                                   error against run time beside OpenSeesPy, SciPy, numba, diffsol and ode_solvers, under
                                   the first 30 s of a record or a synthetic motion; fmu_out/peers.csv
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words.as_slice() {
        ["fmu"] => fmu::build_all(fmu::Linker::System),
        ["fmu", "--portable"] => fmu::build_all(fmu::Linker::Zig),
        ["demo", record @ ..] if record.len() <= 2 => demo::run(record),
        ["figures"] => figures::run(None),
        ["figures", record] => figures::run(Some(record)),
        ["coupling"] => coupling::run(),
        ["test"] => test::run(),
        ["bench"] => bench::paths(None),
        ["bench", record] if !record.starts_with('-') => bench::paths(Some(record)),
        ["bench", "--peers"] => bench::peers(None).map(drop),
        ["bench", "--peers", record] => bench::peers(Some(record)).map(drop),
        [] | ["help" | "-h" | "--help", ..] => {
            print!("{HELP}");
            Ok(())
        }
        other => {
            eprintln!("xtask: unknown job `{}`\n\n{HELP}", other.join(" "));
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// The root of the workspace.
pub(crate) fn root() -> PathBuf {
    let mut path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    path.pop();
    path
}

/// The target folder, wherever the environment puts it.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}
