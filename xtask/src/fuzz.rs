//! `cargo xtask fuzz`: mutated inputs for readers, and random calls of the FMI functions.

use std::path::PathBuf;
use std::process::Command;

use crate::command::{Result, cargo, make_folder, output, program, succeed, target};

/// The readers that are fuzzed, and folders of texts to start from.
const READERS: [(&str, &[&str]); 5] = [
    ("records", &["crates/ground-motion/tests/it"]),
    ("scenes", &["scenes", "tests/data/cases"]),
    ("studies", &["studies", "scenes/building"]),
    ("descriptions", &["modelDescription", "crates/floor/modelDescription"]),
    ("states", &[]),
];
/// Time for each reader \[s\].
const SECONDS: u32 = 60;
/// Calls of each unit: as FMUs are built, and with assertions and `AddressSanitizer`, which make them slow.
const CALLS: &str = "1000000";
const CHECKED_CALLS: &str = "50000";
const SEED: &str = "1";

/// What libFuzzer needs to see which code an input reaches; on any toolchain.
const COVERAGE: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
                        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
                        -Cllvm-args=-sanitizer-coverage-pc-table \
                        -Cllvm-args=-sanitizer-coverage-trace-compares";
const ADDRESS: &str = "-Zsanitizer=address";

/// Runs all of it, with fixed seeds.
pub(crate) fn run() -> Result<()> {
    let host = host()?;
    println!("== calls, as FMUs are built");
    succeed(build(&mut cargo(), "plain", "").args(["--bin", "calls"]), "see the compiler's message")?;
    calls("plain", "plain", CALLS)?;
    println!("== calls, with assertions and AddressSanitizer");
    let nightly = output(program("rustup").args(["run", "nightly", "rustc", "--version"]), "").is_ok();
    let (mut compiler, folder, flags) = if nightly {
        let mut compiler = program("rustup");
        compiler.args(["run", "nightly", "cargo"]);
        (compiler, "address", ADDRESS)
    } else {
        println!("not run: AddressSanitizer needs the nightly toolchain; `rustup toolchain install nightly`");
        (cargo(), "assertions", "")
    };
    let compiler = build(&mut compiler, folder, flags);
    compiler.args(["--release", "--target", &host, "--bin", "calls"]);
    succeed(compiler, "see the compiler's message")?;
    calls(folder, &format!("{host}/release"), CHECKED_CALLS)?;
    let mut compiler = cargo();
    let compiler = build(&mut compiler, "readers", COVERAGE);
    compiler.args(["--release", "--target", &host]);
    compiler.args(READERS.iter().flat_map(|(name, _)| ["--bin", name]));
    succeed(compiler, "see the compiler's message")?;
    for (name, folders) in READERS {
        println!("== {name}: {SECONDS} s");
        read(name, folders, &format!("{host}/release"))?;
    }
    Ok(())
}

/// Prepares a build of the fuzz crate into a folder of its own.
fn build<'a>(compiler: &'a mut Command, folder: &str, flags: &str) -> &'a mut Command {
    compiler.args(["build", "--quiet", "--locked", "--manifest-path", "fuzz/Cargo.toml"]);
    if folder == "plain" {
        compiler.args(["--profile", "plain"]);
    }
    compiler.env("CARGO_TARGET_DIR", built(folder)).env("RUSTFLAGS", flags)
}

fn built(folder: &str) -> PathBuf {
    target().join("fuzz").join(folder)
}

fn calls(folder: &str, profile: &str, count: &str) -> Result<()> {
    let driver = built(folder).join(profile).join("calls");
    succeed(program(driver).args([count, SEED]), "the figures above name the fault; the seed repeats it")
}

fn read(name: &str, folders: &[&str], profile: &str) -> Result<()> {
    let corpus = target().join("fuzz/corpus").join(name);
    make_folder(&corpus)?;
    let mut fuzzer = program(built("readers").join(profile).join(name));
    fuzzer.arg(format!("-max_total_time={SECONDS}")).arg(format!("-seed={SEED}"));
    fuzzer.args(["-timeout=10", "-rss_limit_mb=4096", "-verbosity=0", "-print_final_stats=1"]);
    fuzzer.arg(format!("-artifact_prefix={}/", corpus.display())).arg(&corpus).args(folders);
    succeed(&mut fuzzer, "the input at fault is in the file named above")
}

/// Returns the name of this machine's platform.
fn host() -> Result<String> {
    let text = output(program("rustc").arg("-vV"), "install Rust")?;
    let line = text.lines().find_map(|line| line.strip_prefix("host: "));
    line.map(str::to_owned).ok_or_else(|| "rustc -vV names no host".to_owned())
}
