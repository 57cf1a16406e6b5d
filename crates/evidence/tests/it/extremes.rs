//! Every extreme keeps its limit.

use evidence::stability::extremes;

#[test]
fn every_extreme_keeps_its_limit() {
    let extremes = extremes().unwrap();
    assert!(extremes.len() >= 20, "the table has its rows");
    let broken: Vec<_> = extremes.iter().filter(|extreme| !extreme.passes()).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

/// A value that equals its limit would suggest that it was copied and not measured. Only a plastic impact may
/// equal it: it leaves a velocity of exactly 0.
#[test]
fn every_extreme_is_measured() {
    for extreme in extremes().unwrap() {
        let at_its_limit = extreme.computed == extreme.allowed;
        assert_eq!(at_its_limit, extreme.case == "e = 0", "{extreme:?}");
    }
}
