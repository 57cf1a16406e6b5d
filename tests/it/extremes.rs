//! Every extreme keeps its limit.

use study::stability::extremes;

#[test]
fn every_extreme_keeps_its_limit() {
    let extremes = extremes().unwrap();
    assert!(extremes.len() >= 20, "the table has its rows");
    let broken: Vec<_> = extremes.iter().filter(|extreme| !extreme.holds()).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}
