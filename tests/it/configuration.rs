//! How many random cases the tests of properties take, and which.

use std::cell::Cell;
use std::fmt::Debug;
use std::panic::Location;

use proptest::prelude::{ProptestConfig, Strategy};
use proptest::test_runner::{RngSeed, TestCaseError, TestRunner};

/// The same cases every time, unless PROPTEST_RNG_SEED names others (or `random` ones) and PROPTEST_CASES how
/// many.
pub(crate) fn configuration() -> ProptestConfig {
    let mut configuration = ProptestConfig { cases: 200, ..ProptestConfig::default() };
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
    mostly_of(1, least, cases, compare);
}

/// Does the same with one case of so many, where each takes long. Of n cases at least one shows, with a
/// probability of 95 %, what goes wrong in 3/n of all.
#[track_caller]
#[allow(clippy::print_stdout, reason = "with --nocapture")]
pub(crate) fn mostly_of<T: Debug>(
    one_of: u32,
    least: f64,
    cases: impl Strategy<Value = T>,
    compare: impl Fn(T) -> Result<[usize; 2], TestCaseError>,
) {
    let source_file = Some(Location::caller().file());
    let every = configuration();
    let configuration = ProptestConfig { source_file, cases: every.cases / one_of, ..every };
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
