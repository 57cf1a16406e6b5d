//! Eight numbers side by side, in vectors.

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f64x2, f64x8, i64x8, mask64x8, u8x64};
use rocking_wall::solver::secant;

use crate::number::{BranchRow, LaneRow, Number, WIDTH, index};

/// Eight numbers side by side.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S: Simd, const ONE_TABLE: bool>(f64x8<S>);

macro_rules! operators {
    ($($name:ident $function:ident)*) => { $(
        impl<S: Simd, const ONE_TABLE: bool> $name for Eight<S, ONE_TABLE> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )* };
}

operators!(Add add Sub sub Mul mul Div div);

impl<S: Simd, const ONE_TABLE: bool> Add<f64> for Eight<S, ONE_TABLE> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self(self.0 + other)
    }
}

impl<S: Simd, const ONE_TABLE: bool> Mul<f64> for Eight<S, ONE_TABLE> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self(self.0 * other)
    }
}

impl<S: Simd, const ONE_TABLE: bool> Neg for Eight<S, ONE_TABLE> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd, const ONE_TABLE: bool> secant::Number for Eight<S, ONE_TABLE> {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self(f64x8::splat(self.0.simd, value))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
}

/// The branch of each lane, and the bytes of its number in a row.
#[derive(Clone, Copy)]
pub(crate) struct Places<S: Simd> {
    indices: [usize; WIDTH],
    bytes: u8x64<S>,
}

impl<S: Simd, const ONE_TABLE: bool> Number for Eight<S, ONE_TABLE> {
    const LANES: usize = WIDTH;
    const ONE_TABLE: bool = ONE_TABLE;
    type Token = S;
    type Mask = mask64x8<S>;
    type Branches = Places<S>;

    #[inline(always)]
    fn splat(simd: S, value: f64) -> Self {
        Self(f64x8::splat(simd, value))
    }

    #[inline(always)]
    fn load(simd: S, row: &LaneRow, _: usize) -> Self {
        Self(f64x8::load_array_ref(simd, row))
    }

    #[inline(always)]
    fn store(self, row: &mut LaneRow, _: usize) {
        self.0.store_array(row);
    }

    #[inline(always)]
    fn of_lanes(simd: S, value: impl Fn(usize) -> f64) -> Self {
        Self(f64x8::from_fn(simd, value))
    }

    #[inline(always)]
    fn unzip(simd: S, pair: impl Fn(usize) -> [f64; 2]) -> [Self; 2] {
        let two = |i: usize| f64x2::load_array(simd, pair(i));
        let four = |i: usize| two(i).combine(two(i + 1)).combine(two(i + 2).combine(two(i + 3)));
        let (first, second) = four(0).deinterleave(four(4));
        [Self(first), Self(second)]
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0.to_array()[lane % WIDTH]
    }

    #[inline(always)]
    fn below(self, other: Self) -> mask64x8<S> {
        self.0.simd_lt(other.0)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> mask64x8<S> {
        self.0.simd_le(other.0)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn select(mask: mask64x8<S>, yes: Self, no: Self) -> Self {
        Self(mask.select(yes.0, no.0))
    }

    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "eight bits")]
    fn bits(mask: mask64x8<S>) -> u8 {
        mask.to_bitmask() as u8
    }

    #[inline(always)]
    fn mask(simd: S, bits: u8) -> mask64x8<S> {
        mask64x8::from_bitmask(simd, bits.into())
    }

    #[inline(always)]
    fn branches(self) -> Places<S> {
        let whole: i64x8<S> = self.0.to_int();
        let bytes = (whole * 0x0808_0808_0808_0808 + 0x0706_0504_0302_0100).to_bytes();
        Places { indices: self.0.to_array().map(index), bytes }
    }

    #[inline(always)]
    fn branch(Places { indices, .. }: Places<S>, lane: usize) -> usize {
        indices[lane % WIDTH]
    }

    #[inline(always)]
    fn look_up(simd: S, [row, _]: &BranchRow, Places { indices, bytes }: Places<S>) -> Self {
        if S::f64s::LEN == WIDTH {
            Self(f64x8::load_array_ref(simd, row).swizzle_dyn(bytes))
        } else {
            // the permutation of a row in several registers takes longer
            Self(f64x8::from_fn(simd, |lane| row[indices[lane] % WIDTH]))
        }
    }
}

#[cfg(test)]
mod tests;
