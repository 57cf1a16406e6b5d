//! The jobs of the project: `cargo xtask fmu | playground | wheel | demo | test | portable | fuzz …`.
//!
//! This program has no dependencies and builds in a second on a fresh machine. It installs the Python
//! packages that a job needs under the target folder, pinned by hash.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks to its user")]

mod bench;
mod book;
mod command;
mod coupling;
mod demo;
mod figures;
mod fmu;
mod fuzz;
mod generate;
mod images;
mod platform;
mod playground;
mod portable;
mod python;
mod release;
mod test;
mod wheel;

use std::process::ExitCode;

const HELP: &str = "\
The jobs of the project: cargo xtask JOB [OPTIONS]

  fmu         build the libraries, zip wall.fmu and floor.fmu into fmu_out/ (FMI 2.0) and fmu_out/fmi3/
              --portable: for Linux as old as glibc 2.17, Windows and macOS, with zig;
              --platforms linux64,win64: for some of them
  playground  write fmu_out/playground.html: one file that computes in the browser, by WebAssembly
  wheel       build the Python package into target/wheels/release, with wall.fmu inside
              --fmu FILE: with this wall.fmu; --portable: for Linux as old as glibc 2.17 and macOS, each with
              the FMU of all platforms; --platforms as for fmu
  demo        [RECORD [UNIT]] build the FMU, run it in FMPy under the synthetic motion and, if given, a record
              (UNIT if the file states none); write histories and pages to fmu_out/
  test        run every test: Rust, the FMU through FMPy, the Python package, the C interface against fmi-sys
  portable    build the FMUs for Linux, Windows, macOS and WebAssembly, and the playground, as published, and
              test them: in FMPy, the Windows library under wine, the component in wasmtime
  costs       [JOB ...] [--against COMMIT] measure the CPU time of demo, test, install and wheel from nothing;
              write docs/costs.md and docs/costs.csv; --check JOB=SECONDS ...: compare with the last month
  package     pack the crates as a registry gets them into target/package, and build each from its archive
  release     [TAG] build the files of a release into target/release-files/: FMUs, `wall` and wheels for each
              platform, the source distribution, components, notices, checksums; and
              target/fmi-compatibility/; TAG is checked; --platforms as for fmu, to compare a part
  workflows   check .github with zizmor, and with actionlint where it is installed
  generate    [PART] write what is derived: documents (their marked parts), python (the parameters in the
              package); or one of these; --check: say what is stale instead
  fuzz        feed mutated inputs to five readers for a minute each, and call the FMI functions 10^6 times at
              random, and 50,000 times under AddressSanitizer (nightly)
  figures     [RECORD.AT2] measure accuracy, stability and other tools, compare with published tests; write
              docs/accuracy.md, docs/validation.md, docs/verification.md, the pages, and docs/images
              --peers [RECORD.AT2]: only the other tools; or only --images, --validation, --verification
  book        build the book of docs/ with mdBook into target/book/book
  coupling    measure walls on floors: schemes, steps, run time; write docs/coupling.md and
              fmu_out/coupling.csv
  bench       [RECORD.AT2] measure the time per sample of each path, and count instructions where valgrind is
              installed
              --peers [RECORD.AT2]: measure error against run time beside OpenSeesPy, SciPy, numba, JAX,
              diffrax, diffsol and ode_solvers (Python 3.12 or newer), under the first 30 s of a record or a
              synthetic motion; write fmu_out/peers.csv
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words.as_slice() {
        ["fmu"] => fmu::build_all(None).map(drop),
        ["fmu", "--portable"] => fmu::build_all(Some(fmu::PORTABLE)).map(drop),
        ["fmu", "--platforms", names] => fmu::build_all(Some(names)).map(drop),
        ["playground"] => playground::build().map(drop),
        ["book"] => book::run(),
        ["wheel"] => wheel::run(None),
        ["wheel", "--fmu", unit] => wheel::run(Some(unit)),
        ["wheel", "--portable"] => wheel::portable(fmu::PORTABLE),
        ["wheel", "--platforms", names] => wheel::portable(names),
        ["demo", record @ ..] if record.len() <= 2 => demo::run(record),
        ["figures"] => figures::run(None),
        ["figures", "--peers", record @ ..] if record.len() <= 1 => figures::peers(record.first().copied()),
        ["figures", "--images"] => images::run(),
        ["figures", "--validation"] => figures::validation(),
        ["figures", "--verification"] => figures::verification(),
        ["figures", record] => figures::run(Some(record)),
        ["coupling"] => coupling::run(),
        ["test"] => test::run(),
        ["costs", arguments @ ..] => {
            let mut costs = command::program("python3");
            command::succeed(costs.arg("xtask/costs.py").args(arguments), "see its message above")
        }
        ["portable"] => portable::run(),
        ["package"] => release::package(),
        ["release"] => release::run(None, fmu::PORTABLE),
        ["release", "--platforms", names] => release::run(None, names),
        ["release", tag] => release::run(Some(tag), fmu::PORTABLE),
        ["fuzz"] => fuzz::run(),
        ["workflows"] => release::check_workflows(),
        ["generate", "--check", parts @ ..] => generate::run(parts, true),
        ["generate", parts @ ..] => generate::run(parts, false),
        ["bench"] => bench::paths(None),
        ["bench", record] if !record.starts_with('-') => bench::paths(Some(record)),
        ["bench", "--peers", record @ ..] if record.len() <= 1 => {
            bench::peers(record.first().copied()).map(drop)
        }
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
