//! Eight numbers side by side, one for each lane: what `f64x8` of `fearless_simd` lacks.
//!
//! Every operation used here rounds as it does on one number, on every processor. `mul_add` does not: it is
//! fused on some processors only, so it is never used.

use fearless_simd::prelude::*;
use fearless_simd::{f64x2, f64x8, i64x8, mask64x8, u8x64};

/// Lanes of a vector.
pub(super) const WIDTH: usize = 8;

/// A number for each lane, or for each branch of a wall, in memory.
pub(super) type Row = [f64; WIDTH];

/// Loads the numbers of a row.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, row: &Row) -> f64x8<S> {
    f64x8::load_array_ref(simd, row)
}

/// Returns a mask as bits, one for each lane.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, reason = "eight bits")]
pub(super) fn bits<S: Simd>(mask: mask64x8<S>) -> u8 {
    mask.to_bitmask() as u8
}

/// Returns whole numbers, none negative, as indices.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers, none negative")]
pub(super) fn indices<S: Simd>(numbers: f64x8<S>) -> [usize; WIDTH] {
    let whole: i64x8<S> = numbers.to_int();
    whole.to_array().map(|number| number as usize)
}

/// Returns the first and the second numbers of eight pairs.
#[inline(always)]
pub(super) fn unzip<S: Simd>(simd: S, pairs: [&[f64; 2]; WIDTH]) -> [f64x8<S>; 2] {
    let [a, b, c, d, e, f, g, h] = pairs;
    let (first, second) = four(simd, [a, b, c, d]).deinterleave(four(simd, [e, f, g, h]));
    [first, second]
}

#[inline(always)]
fn four<S: Simd>(simd: S, [a, b, c, d]: [&[f64; 2]; 4]) -> f64x8<S> {
    let (a, b) = (f64x2::load_array_ref(simd, a), f64x2::load_array_ref(simd, b));
    let (c, d) = (f64x2::load_array_ref(simd, c), f64x2::load_array_ref(simd, d));
    a.combine(b).combine(c.combine(d))
}

/// The branch of each lane.
#[derive(Clone, Copy)]
pub(super) struct Branches<S: Simd> {
    simd: S,
    indices: [usize; WIDTH],
    /// The bytes of each lane's number in a row.
    bytes: u8x64<S>,
}

impl<S: Simd> Branches<S> {
    /// Takes whole numbers below eight.
    #[inline(always)]
    pub(super) fn new(branches: f64x8<S>) -> Self {
        let whole: i64x8<S> = branches.to_int();
        let bytes = (whole * 0x0808_0808_0808_0808 + 0x0706_0504_0302_0100).to_bytes();
        Self { simd: branches.simd, indices: indices(branches), bytes }
    }

    /// Looks up the number of a row that belongs to the branch of each lane.
    #[inline(always)]
    pub(super) fn of(&self, row: &Row) -> f64x8<S> {
        if S::f64s::LEN == WIDTH {
            f64x8::load_array_ref(self.simd, row).swizzle_dyn(self.bytes)
        } else {
            // the permutation of a row in several registers takes longer
            f64x8::from_fn(self.simd, |lane| row[self.indices[lane] % WIDTH])
        }
    }

    /// Looks up those of several rows.
    #[inline(always)]
    pub(super) fn of_each<const ROWS: usize>(&self, rows: &[Row; ROWS]) -> [f64x8<S>; ROWS] {
        let mut found = [f64x8::splat(self.simd, 0.0); ROWS];
        for (found, row) in found.iter_mut().zip(rows) {
            *found = self.of(row);
        }
        found
    }
}

#[cfg(target_arch = "x86_64")]
#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use super::*;

    #[inline(always)]
    fn outcome<S: Simd>(simd: S) -> [Row; 4] {
        let row: Row = std::array::from_fn(|i| 1.5 * i as f64);
        let branches: Row = [0.0, 3.0, 7.0, 7.0, 1.0, 2.0, 6.0, 5.0];
        let pairs: [[f64; 2]; WIDTH] = std::array::from_fn(|i| [i as f64, -0.5 * i as f64]);
        let branches = f64x8::load_array_ref(simd, &branches);
        let [first, second] = unzip(simd, pairs.each_ref());
        let found = Branches::new(branches).of(&row);
        [*first, *second, *found, indices(branches).map(|i| i as f64)]
    }

    #[test]
    fn every_processor_finds_the_same() {
        let Level::Sse2(narrow) = Level::baseline() else { unreachable!("the processors tested here") };
        let level = Level::new();
        let outcomes = [
            Some(narrow.vectorize(|| outcome(narrow))),
            level.as_avx2().map(|simd| simd.vectorize(|| outcome(simd))),
            level.as_avx512().map(|simd| simd.vectorize(|| outcome(simd))),
        ];
        for [first, second, found, whole] in outcomes.into_iter().flatten() {
            assert_eq!(first, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            assert_eq!(second, first.map(|i| -0.5 * i));
            assert_eq!(whole, [0.0, 3.0, 7.0, 7.0, 1.0, 2.0, 6.0, 5.0]);
            assert_eq!(found, whole.map(|i| 1.5 * i));
        }
    }
}
