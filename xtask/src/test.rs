//! `cargo xtask test`: every test, and a summary that names what did not run.

use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

use crate::command::{
    Result, cargo, children_seconds, find, make_folder, output, program, root, succeed, target,
};
use crate::fmu::{self, Fmi};
use crate::playground;
use crate::python::Environment;
use crate::wheel;

/// Folder of real accelerograms unless `ROCKING_WALL_RECORDS` names one.
const RECORDS: &str = "../shared/records";

/// One part of the tests.
type Part = fn() -> Result<()>;

/// Runs every test; all parts run even where one fails.
pub(crate) fn run() -> Result<()> {
    let parts: [(&str, Part); 6] = [
        ("Rust tests", rust),
        ("the examples", examples),
        ("the FMU through FMPy", python),
        ("the Python package", python_package),
        ("systems in other masters", masters),
        ("the C boundary", conformance),
    ];
    // the network and the linker work beside the Rust tests; a part that needs the result prepares it
    // again, and gets the errors
    let mut prepared = Some(std::thread::spawn(prepare));
    let (mut lines, mut failed) = (Vec::new(), 0);
    for (name, part) in parts {
        println!("\n== {name}");
        let (start, before) = (Instant::now(), children_seconds());
        let outcome = part();
        // only the Rust tests need none of what is prepared
        if let Some(prepared) = prepared.take() {
            let _ = prepared.join();
        }
        let cpu =
            children_seconds().zip(before).map(|(after, before)| format!(", CPU {:.0} s", after - before));
        let took = format!("{} s{}", start.elapsed().as_secs(), cpu.unwrap_or_default());
        failed += usize::from(outcome.is_err());
        lines.push(match outcome {
            Ok(()) => format!("passed  {name} ({took})"),
            Err(message) => format!("FAILED  {name} ({took}): {message}"),
        });
    }
    println!("\n== summary");
    for line in lines {
        println!("{line}");
    }
    for line in not_run() {
        println!("not run {line}");
    }
    println!("{} passed, {failed} failed", parts.len() - failed);
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} parts failed", parts.len())) }
}

/// Lists what the tests leave out on this machine, and the remedy.
fn not_run() -> Vec<String> {
    let of_records = "tests on real accelerograms: name their folder in ROCKING_WALL_RECORDS";
    let of_browser = "the page in a browser: install chromium and chromium-driver";
    let lines = [
        (!records().is_dir()).then(|| of_records.to_owned()),
        browser().is_none().then(|| of_browser.to_owned()),
        playground::check_target().err().map(|message| format!("the playground: {message}")),
        Some("the FMUs of other platforms, and what is published: `cargo xtask portable`".to_owned()),
    ];
    lines.into_iter().flatten().collect()
}

/// Returns the folder of real accelerograms.
pub(crate) fn records() -> PathBuf {
    std::env::var_os("ROCKING_WALL_RECORDS").map_or_else(|| root().join(RECORDS), PathBuf::from)
}

/// Finds a Chromium with its driver.
fn browser() -> Option<PathBuf> {
    find("chromedriver")?;
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find_map(find)
}

/// Installs and builds what the later parts need.
fn prepare() {
    for name in ["tests", "maturin", "wheel", "bare", "clang"] {
        let _ = Environment::of(name);
    }
    if playground::check_target().is_ok() {
        let _ = page();
    }
}

/// Prepares a build for the tests, without incremental compilation, whose files take a tenth of the time to
/// write.
fn build() -> Command {
    let mut build = cargo();
    build.env("CARGO_INCREMENTAL", "0");
    wheel::share_extension(&mut build);
    build
}

/// Prepares the Python tests in a folder. Two processes share them as `sharing` says; without it one runs
/// them all.
pub(crate) fn pytest(python: &Environment, folder: &str, sharing: Option<&str>) -> Command {
    let mut pytest = python.program("python");
    pytest.args(["-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", folder]);
    // threads of numpy's linear algebra wait for each other longer than small matrices take
    pytest.env("OPENBLAS_NUM_THREADS", "1");
    pytest.args(sharing.map(|sharing| ["-n", "2", "--dist", sharing]).into_iter().flatten());
    pytest
}

/// All packages but that of the component, which brings a generator of bindings.
const PACKAGES: [&str; 3] = ["--workspace", "--exclude", "fmu-component"];
/// One of these, which needs libclang: what it shares with the others is built with the same features.
const CONFORMANCE: &str = "conformance";

fn rust() -> Result<()> {
    // the libraries of the FMUs too, which `cargo test` does not build
    let targets = ["--lib", "--bins", "--examples", "--tests"];
    let packages = PACKAGES.iter().chain(&["--exclude", CONFORMANCE]);
    succeed(
        build().args(["build", "--locked"]).args(packages.clone()).args(targets),
        "see its message above",
    )?;
    run_tests(build().args(["test", "--locked", "--no-fail-fast"]).args(packages))
}

fn run_tests(command: &mut Command) -> Result<()> {
    succeed(command, "see the failures above")
}

fn examples() -> Result<()> {
    for name in ["wall_under_record", "step_by_step", "incremental_dynamic_analysis"] {
        succeed(&mut program(programs().join("examples").join(name)), "see its message above")?;
    }
    Ok(())
}

/// Returns the folder of the programs, examples and libraries that the Rust tests have built.
fn programs() -> PathBuf {
    target().join("debug")
}

/// Packs an FMU of the library that was built with the tests; `cargo xtask portable` tests the published one.
fn packed(unit: fmu::Unit) -> Result<PathBuf> {
    fmu::pack(unit, &[library(unit)], &[], &programs(), &folder())
}

/// Returns the path of the library of an FMU that was built with the tests.
fn library(unit: fmu::Unit) -> PathBuf {
    programs().join(fmu::file_name(unit, fmu::SYSTEM))
}

/// Builds the playground that is tested; `cargo xtask portable` tests the published one.
fn page() -> Result<PathBuf> {
    let page = folder().join("playground.html");
    make_folder(&folder())?;
    playground::pack("demo", &page)?;
    Ok(page)
}

/// The folder of the FMUs and the page that are tested.
fn folder() -> PathBuf {
    target().join("tested")
}

/// Packs the FMU of the example, and returns its path.
fn example() -> Result<PathBuf> {
    let library = library(fmu::BALL);
    fmu::pack_version(fmu::BALL, std::slice::from_ref(&library), &programs(), Fmi::Three, &folder())?;
    fmu::pack_version(fmu::BALL, &[library], &programs(), Fmi::Two, &folder())
}

fn python() -> Result<()> {
    let (unit, floor, wall) = (packed(fmu::WALL)?, packed(fmu::FLOOR)?, programs().join("wall"));
    let python = Environment::of("tests")?;
    // whole files, and those of pages together: tests/python/conftest.py
    let mut pytest = pytest(&python, "tests/python", Some("loadfile"));
    pytest.env("ROCKING_WALL_FMU", unit).env("ROCKING_FLOOR_FMU", floor);
    pytest.env("ROCKING_WALL_BIN", wall).env("ROCKING_WALL_RECORDS", records());
    pytest.env("ROCKING_WALL_BALL", example()?);
    if playground::check_target().is_ok() {
        pytest.env("ROCKING_WALL_PLAYGROUND", page()?);
    }
    succeed(&mut pytest, "see the failures above")
}

/// Tests the wheel; it is also installed where there is nothing but numpy, and beside `FMPy`.
fn python_package() -> Result<()> {
    let unit = packed(fmu::WALL)?;
    let package = wheel::build("dev", &unit, None)?;
    let [python, bare, fmpy] = ["wheel", "bare", "tests"].map(Environment::of);
    let (python, bare, fmpy) = (python?, bare?, fmpy?);
    for environment in [&python, &bare, &fmpy] {
        wheel::install(&package, environment)?;
    }
    // whole files: what a file makes is made once
    let mut pytest = pytest(&python, "tests/wheel", Some("loadfile"));
    pytest.env("ROCKING_WALL_FMU", unit).env("ROCKING_WALL_BIN", programs().join("wall"));
    pytest.env("ROCKING_WALL_BARE_PYTHON", bare.programs().join("python"));
    pytest.env("ROCKING_WALL_FMPY_PYTHON", fmpy.programs().join("python"));
    succeed(&mut pytest, "see the failures above")
}

/// Tests wall and floor in masters from `PyPI`.
fn masters() -> Result<()> {
    let (unit, floor, wall) = (packed(fmu::WALL)?, packed(fmu::FLOOR)?, programs().join("wall"));
    let mut pytest = pytest(&Environment::of("tests")?, "tests/masters", None);
    pytest.env("ROCKING_WALL_FMU", unit).env("ROCKING_FLOOR_FMU", floor).env("ROCKING_WALL_BIN", wall);
    succeed(&mut pytest, "see the failures above")
}

/// Compares the functions that the crates export with those of the standard's headers.
fn conformance() -> Result<()> {
    let mut test = build();
    test.args(["test", "--locked", "--no-fail-fast"]).args(PACKAGES);
    test.args(["--test", "signatures", "--test", "signatures3"]);
    run_tests(with_libclang(&mut test)?)
}

/// Lets a job of cargo find libclang, with which fmi-sys reads the standard's headers.
pub(crate) fn with_libclang(job: &mut Command) -> Result<&mut Command> {
    let clang = Environment::of("clang")?;
    let libclang = clang.package("clang")?.join("native");
    let include = output(program("cc").arg("-print-file-name=include"), "install a C compiler")?;
    job.env("LIBCLANG_PATH", libclang);
    Ok(job.env("BINDGEN_EXTRA_CLANG_ARGS", format!("-I{}", include.trim())))
}
