//! How many random cases the tests of properties take, and which.

use std::cell::Cell;
use std::fmt::Debug;
use std::panic::Location;

use proptest::prelude::{ProptestConfig, Strategy};
use proptest::test_runner::{RngSeed, TestCaseError, TestRunner};

/// The same cases every time, unless PROPTEST_RNG_SEED names others (or `random` ones) and PROPTEST_CASES how
/// many.
pub(crate) fn configuration() -> ProptestConfig {
    of(200)
}

/// The same with a number of cases.
fn of(cases: u32) -> ProptestConfig {
    let mut configuration = ProptestConfig { cases, ..ProptestConfig::default() };
    match std::env::var("PROPTEST_RNG_SEED") {
        Ok(_) => configuration.cases = ProptestConfig::default().cases,
        Err(_) => configuration.rng_seed = RngSeed::Fixed(1),
    }
    configuration.max_global_rejects = 10 * configuration.cases;
    configuration
}

/// Tests a property that only part of each case can show: `compare` returns how much it compared, and of how
/// much. Prints the share of all cases together and fails if it is below `least`.
#[track_caller]
pub(crate) fn mostly<T: Debug>(
    least: f64,
    cases: impl Strategy<Value = T>,
    compare: impl Fn(T) -> Result<[usize; 2], TestCaseError>,
) {
    mostly_of(200, least, cases, compare);
}

/// Does the same with a number of cases, where each takes long. Of `count` cases at least one shows, with a
/// probability of 95 %, what goes wrong in 3/`count` of all.
#[track_caller]
#[allow(clippy::print_stdout, reason = "with --nocapture")]
pub(crate) fn mostly_of<T: Debug>(
    count: u32,
    least: f64,
    cases: impl Strategy<Value = T>,
    compare: impl Fn(T) -> Result<[usize; 2], TestCaseError>,
) {
    let source_file = Some(Location::caller().file());
    let configuration = ProptestConfig { source_file, ..of(count) };
    let (compared, all) = (Cell::new(0), Cell::new(0));
    let outcome = TestRunner::new(configuration).run(&cases, |case| {
        let [part, whole] = compare(case)?;
        compared.set(compared.get() + part);
        all.set(all.get() + whole);
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
    let share = compared.get() as f64 / all.get() as f64;
    println!("compared {} of {}: {share:.3}", compared.get(), all.get());
    assert!(share >= least, "compared {} of {}, a share below {least}", compared.get(), all.get());
}
