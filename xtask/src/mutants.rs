//! `cargo xtask mutants`: changes the code in one place at a time, and counts the changes that no Rust test
//! notices.

use crate::command::{Result, find, make_folder, output, program, root, succeed, target};

/// What is mutated unless paths are given: the rooms in which motion is computed.
const ROOMS: [&str; 6] =
    ["src/wall", "src/solver", "src/simulation", "src/unit", "crates/oscillator", "crates/record"];
/// Whose tests are run, beside those of the crate that is mutated: tests stand with what they test, and a
/// program that is linked anew takes longer than they do.
const TESTED: [&str; 3] = ["rocking-wall", "rocking-record", "rocking-oscillator"];
const COUNT: usize = 20;
const SEED: usize = 1;

/// A sample of mutants.
#[derive(Debug, PartialEq)]
struct Sample<'a> {
    count: usize,
    seed: usize,
    paths: Vec<&'a str>,
}

/// Tests a sample of mutants by cargo-mutants: every n-th from a place that the seed gives, so that samples
/// of the first n seeds have none in common. `.cargo/mutants.toml` leaves out those without effect. A mutant
/// that is missed or runs out of time is an error.
pub(crate) fn run(arguments: &[&str]) -> Result<()> {
    let Sample { count, seed, paths } = parse(arguments)?;
    if find("cargo-mutants").is_none() {
        return Err("cargo-mutants is not installed; `cargo install cargo-mutants --locked`".into());
    }
    let mut chosen = vec!["mutants".to_owned(), "--workspace".to_owned()];
    for path in &paths {
        let folder = root().join(path).is_dir();
        chosen.extend(["--file".to_owned(), format!("{path}{}", if folder { "/**/*.rs" } else { "" })]);
    }
    let all = output(program("cargo").args(&chosen).arg("--list"), "see its message")?.lines().count();
    if all == 0 {
        return Err(format!("{} have no mutants; give files or folders of Rust code", paths.join(", ")));
    }
    let samples = (all / count).max(1);
    println!("one mutant in {samples} of {all} in {}", paths.join(", "));
    let folder = target().join("mutants");
    let mut tests = program("cargo");
    // built once, not for each run
    tests.env("CARGO_TARGET_DIR", folder.join("build"));
    let shard = format!("{}/{samples}", seed % samples);
    tests.args(chosen).args(["--sharding", "round-robin", "--shard", &shard]);
    // some tests ask git for the files of the project
    tests.args(["--copy-vcs", "true"]);
    // neither examples nor documentation, which are built and linked each by itself
    tests.arg("--cargo-arg=--tests").args(TESTED.map(|name| format!("--cargo-arg=--package={name}")));
    make_folder(&folder)?;
    succeed(tests.arg("--output").arg(&folder), &format!("see {}", folder.join("mutants.out").display()))
}

fn parse<'a>(arguments: &[&'a str]) -> Result<Sample<'a>> {
    let mut sample = Sample { count: COUNT, seed: SEED, paths: vec![] };
    let mut arguments = arguments.iter();
    while let Some(&argument) = arguments.next() {
        let number = |least: usize, value: Option<&&str>| {
            let value = value.and_then(|text| text.parse().ok()).filter(|value| *value >= least);
            value.ok_or_else(|| format!("{argument} needs a whole number from {least} on"))
        };
        match argument {
            "--count" => sample.count = number(1, arguments.next())?,
            "--seed" => sample.seed = number(0, arguments.next())?,
            option if option.starts_with('-') => {
                return Err(format!("{option} is not one of --count, --seed"));
            }
            path if root().join(path).exists() => sample.paths.push(path),
            path => return Err(format!("{path} does not exist; give files or folders of Rust code")),
        }
    }
    if sample.paths.is_empty() {
        sample.paths = ROOMS.to_vec();
    }
    Ok(sample)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_checked() {
        let sample = Sample { count: COUNT, seed: SEED, paths: ROOMS.to_vec() };
        assert_eq!(parse(&[]), Ok(sample));
        let sample = Sample { count: 3, seed: 0, paths: vec!["src/scene", "src/lib.rs"] };
        assert_eq!(parse(&["--count", "3", "src/scene", "--seed", "0", "src/lib.rs"]), Ok(sample));
        for (bad, words) in [
            (vec!["--count", "few"], "--count needs a whole number"),
            (vec!["--count", "0"], "from 1 on"),
            (vec!["--seed"], "--seed needs a whole number"),
            (vec!["--seeds", "1"], "--seeds is not one of"),
            (vec!["src/none"], "does not exist"),
        ] {
            let message = parse(&bad).unwrap_err();
            assert!(message.contains(words), "{message}");
        }
    }
}
