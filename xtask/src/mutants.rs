//! `cargo xtask mutants`: changes the code in one place at a time, and counts the changes that no Rust test
//! notices.

use crate::command::{Result, find, output, program, root, succeed, target};

/// What is mutated unless paths are given: the rooms of the unit in which motion is computed.
const ROOMS: [&str; 4] = ["src/wall", "src/solver", "src/simulation", "src/unit"];
/// Whose tests are run.
const TESTED: [&str; 2] = ["rocking-wall", "rocking-wall-cli"];
const COUNT: usize = 20;
const SEED: u64 = 1;

/// A sample of mutants.
#[derive(Debug, PartialEq)]
struct Sample<'a> {
    count: usize,
    seed: u64,
    paths: Vec<&'a str>,
}

/// Tests a sample of mutants by cargo-mutants. Those without effect are left out in `.cargo/mutants.toml`.
///
/// # Errors
/// If cargo-mutants is not installed, the paths have no mutants, or a mutant is missed or runs out of time.
pub(crate) fn run(arguments: &[&str]) -> Result<()> {
    let Sample { count, seed, paths } = parse(arguments)?;
    if find("cargo-mutants").is_none() {
        return Err("cargo-mutants is not installed; `cargo install cargo-mutants --locked`".into());
    }
    let mut list = program("cargo");
    list.args(["mutants", "--workspace", "--list"]);
    for path in &paths {
        let folder = root().join(path).is_dir();
        list.arg("--file").arg(if folder { format!("{path}/**/*.rs") } else { (*path).to_owned() });
    }
    let list = output(&mut list, "see its message")?;
    let mutants: Vec<&str> = list.lines().collect();
    if mutants.is_empty() {
        return Err(format!("{} have no mutants; give files or folders of Rust code", paths.join(", ")));
    }
    let sample = sampled(mutants.clone(), count, seed);
    println!("{} of {} mutants of {}, seed {seed}", sample.len(), mutants.len(), paths.join(", "));
    let folder = target().join("mutants");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut tests = program("cargo");
    // dependencies are then built once, not for each copy of the sources
    tests.env("CARGO_TARGET_DIR", folder.join("build"));
    tests.args(["mutants", "--workspace", "--output"]).arg(&folder);
    tests.args(TESTED.iter().flat_map(|name| ["--test-package", name]));
    tests.args(sample.iter().flat_map(|name| ["--re".to_owned(), format!("^{}$", escaped(name))]));
    succeed(&mut tests, &format!("{} names the mutants", folder.join("mutants.out").display()))
}

fn parse<'a>(arguments: &[&'a str]) -> Result<Sample<'a>> {
    let mut sample = Sample { count: COUNT, seed: SEED, paths: vec![] };
    let mut arguments = arguments.iter();
    while let Some(&argument) = arguments.next() {
        match argument {
            "--count" | "--seed" => {
                let number = arguments.next().and_then(|text| text.parse().ok());
                let number: u32 = number.ok_or_else(|| format!("{argument} needs a whole number"))?;
                if argument == "--seed" {
                    sample.seed = number.into();
                } else {
                    sample.count = number as usize;
                }
            }
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

/// Takes `count` items at random, in their order.
fn sampled<T>(items: Vec<T>, count: usize, seed: u64) -> Vec<T> {
    let (mut left, mut wanted) = (items.len() as u64, count as u64);
    let mut state = seed;
    let mut is_taken = |_: &T| {
        // splitmix64 (Steele, Lea and Flood, OOPSLA 2014)
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let taken = (bits ^ (bits >> 31)) % left < wanted;
        (left, wanted) = (left - 1, wanted - u64::from(taken));
        taken
    };
    items.into_iter().filter(|item| is_taken(item)).collect()
}

/// A name as a regular expression.
fn escaped(name: &str) -> String {
    let special = |letter: char| r"\.+*?()|[]{}^$#&-~".contains(letter);
    name.chars().flat_map(|letter| special(letter).then_some('\\').into_iter().chain([letter])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_a_sample() {
        let sample = |count, seed| sampled((0..1000).collect::<Vec<_>>(), count, seed);
        let some = sample(30, 1);
        assert_eq!(some, sample(30, 1));
        assert!(some.len() == 30 && some.is_sorted() && some != sample(30, 2));
        // from all of the list
        assert!(some[0] < 200 && some[29] > 800, "{some:?}");
        assert_eq!((sample(2000, 1).len(), sample(0, 1).len()), (1000, 0));
    }

    #[test]
    fn arguments_are_checked() {
        let sample = Sample { count: COUNT, seed: SEED, paths: ROOMS.to_vec() };
        assert_eq!(parse(&[]), Ok(sample));
        let sample = Sample { count: 3, seed: 7, paths: vec!["src/scene", "src/lib.rs"] };
        assert_eq!(parse(&["--count", "3", "src/scene", "--seed", "7", "src/lib.rs"]), Ok(sample));
        for (bad, words) in [(["--count", "few"], "whole number"), (["--seeds", "1"], "--seeds")] {
            assert!(parse(&bad).is_err_and(|message| message.contains(words)));
        }
        assert!(parse(&["src/none"]).is_err_and(|message| message.contains("does not exist")));
        assert_eq!(escaped("a.rs:1:2: replace |= with &="), r"a\.rs:1:2: replace \|= with \&=");
    }
}
