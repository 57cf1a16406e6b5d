//! Numbers side by side beside single ones.

use fearless_simd::Level;

use super::*;
use crate::number::Vectors;

/// Numbers of lanes, ordinary and not, and their branches.
const ROWS: [LaneRow; 3] = [
    [1.5, -2.25, 1e-300, -7e200, 0.1, f64::INFINITY, -3.0, 1.0 / 3.0],
    [0.3, -2.25, 3e-310, 9e150, -0.7, 2.0, f64::NEG_INFINITY, 1e17],
    [0.0, 7.0, 3.0, 3.0, 1.0, 6.0, 2.0, 5.0],
];

/// Applies each operation of a number to the lanes from `first` on; returns the bits of the results, lane by
/// lane.
fn operations<N: Number>(token: N::Token, first: usize) -> Vec<Vec<u64>> {
    let [a, b, branch] = ROWS.map(|row| N::load(token, &row, first));
    let branches: BranchRow = [[0.1, 1.2, 2.3, 3.4, 4.5, 5.6, 6.7, 7.8], [0.0; WIDTH]];
    let (below, at_most) = (a.below(b), a.at_most(b));
    let given = N::mask(token, 0b1011_0101 >> first);
    let [zipped, other] = N::unzip(token, |lane| [ROWS[0][first + lane], ROWS[1][first + lane]]);
    let mut stored = [0.0; WIDTH];
    (a - b).store(&mut stored, first);
    let masks = [below, at_most, given, !below, given & at_most, given | below];
    let numbers = [a + b, a - b, a * b, a / b, a + 0.3, a * 0.3, -a, a.abs(), a.abs().sqrt()];
    let more = [a.max(b), a.min(b), a.like(0.7), N::splat(token, -0.2), zipped, other];
    let of_lanes = N::of_lanes(token, |lane| stored[first + lane]);
    let found = N::look_up(token, &branches, branch.branches());
    let chosen = masks.map(|mask| N::select(mask, a, b));
    let lanes = |number: N| (0..N::LANES).map(|lane| number.lane(lane).to_bits()).collect();
    let bits = |mask| (0..N::LANES).map(|lane| u64::from(N::bits(mask) >> lane & 1)).collect();
    let numbers = numbers.into_iter().chain(more).chain([of_lanes, found]).chain(chosen);
    numbers.map(lanes).chain(masks.map(bits)).collect()
}

/// Operations on eight numbers give, lane by lane, the bits of those on single ones.
fn check_lanes<S: Simd>(simd: S) {
    let eight = operations::<Eight<S, true>>(simd, 0);
    for lane in 0..WIDTH {
        for (n, (eight, single)) in eight.iter().zip(operations::<f64>((), lane)).enumerate() {
            assert_eq!(eight[lane], single[0], "operation {n} in lane {lane}");
        }
    }
}

#[test]
fn numbers_side_by_side_are_single_numbers() {
    let Level::Sse2(simd) = Level::baseline() else { unreachable!("the processors tested here") };
    check_lanes(simd);
    for vectors in Vectors::all() {
        match vectors {
            Vectors::Avx2(simd) => check_lanes(simd),
            Vectors::Avx512(simd) => check_lanes(simd),
        }
    }
}
