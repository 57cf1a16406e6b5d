//! A number of each lane: one `f64` for a run by itself, a vector of eight for runs side by side.
//!
//! Every operation rounds alike for both, on every processor. `mul_add` does not: it is fused on some
//! processors only, so it is never used.

use std::ops::{BitAnd, BitOr, Not};

#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Avx512, Level};
use rocking_wall::solver::secant;

/// Lanes of a vector.
pub(crate) const WIDTH: usize = 8;
/// Most branches of a wall whose steps are prepared.
pub const MOST_BRANCHES: usize = 2 * WIDTH;

/// A number for each lane.
pub(crate) type LaneRow = [f64; WIDTH];
/// A number for each branch of a wall.
pub(crate) type BranchRow = [LaneRow; MOST_BRANCHES / WIDTH];

/// Vectors with which runs are faster side by side than one by one. With narrower vectors they would be
/// slower, and the code for these would take long to build.
#[derive(Clone, Copy, Debug)]
pub enum Vectors {
    /// Four numbers in a register.
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    /// Eight numbers in a register.
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl Vectors {
    /// Returns the widest of these vectors that the processor has; `None` if it has none.
    pub fn widest() -> Option<Self> {
        Self::all().last()
    }

    /// Returns all of these vectors that the processor has, the widest last.
    pub fn all() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let all = {
            let level = Level::new();
            [level.as_avx2().map(Self::Avx2), level.as_avx512().map(Self::Avx512)]
        };
        #[cfg(not(target_arch = "x86_64"))]
        let all: [Option<Self>; 0] = [];
        all.into_iter().flatten()
    }
}

/// A number of each lane.
pub(crate) trait Number: secant::Number {
    const LANES: usize;
    /// Whether the branches of all lanes stand in one table.
    const ONE_TABLE: bool;
    /// A proof that the processor has these vectors.
    type Token: Copy;
    /// True or false for each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;
    /// The branch of each lane.
    type Branches: Copy;

    fn splat(token: Self::Token, value: f64) -> Self;
    /// Loads the numbers of a row from lane `first` on.
    fn load(token: Self::Token, row: &LaneRow, first: usize) -> Self;
    fn store(self, row: &mut LaneRow, first: usize);
    fn of_lanes(token: Self::Token, value: impl Fn(usize) -> f64) -> Self;
    /// Returns the first and the second numbers of pairs.
    fn unzip(token: Self::Token, pair: impl Fn(usize) -> [f64; 2]) -> [Self; 2];
    fn lane(self, lane: usize) -> f64;

    fn below(self, other: Self) -> Self::Mask;
    fn at_most(self, other: Self) -> Self::Mask;
    fn min(self, other: Self) -> Self;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Returns a mask as bits, one for each lane.
    fn bits(mask: Self::Mask) -> u8;
    fn mask(token: Self::Token, bits: u8) -> Self::Mask;

    /// Converts whole numbers of branches, which are below [`MOST_BRANCHES`], in a vector below [`WIDTH`].
    fn branches(self) -> Self::Branches;
    /// Returns the branch of a lane.
    fn branch(branches: Self::Branches, lane: usize) -> usize;
    /// Looks up the number that belongs to the branch of each lane.
    fn look_up(token: Self::Token, row: &BranchRow, branches: Self::Branches) -> Self;
}

impl Number for f64 {
    const LANES: usize = 1;
    const ONE_TABLE: bool = true;
    type Token = ();
    type Mask = bool;
    type Branches = usize;

    #[inline(always)]
    fn splat((): (), value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn load((): (), row: &LaneRow, first: usize) -> Self {
        row[first % WIDTH]
    }

    #[inline(always)]
    fn store(self, row: &mut LaneRow, first: usize) {
        row[first % WIDTH] = self;
    }

    #[inline(always)]
    fn of_lanes((): (), value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }

    #[inline(always)]
    fn unzip((): (), pair: impl Fn(usize) -> [f64; 2]) -> [Self; 2] {
        pair(0)
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn bits(mask: bool) -> u8 {
        u8::from(mask)
    }

    #[inline(always)]
    fn mask((): (), bits: u8) -> bool {
        bits & 1 == 1
    }

    #[inline(always)]
    fn branches(self) -> usize {
        index(self) % MOST_BRANCHES
    }

    #[inline(always)]
    fn branch(branch: usize, _: usize) -> usize {
        branch
    }

    #[inline(always)]
    fn look_up((): (), row: &BranchRow, branch: usize) -> Self {
        row.as_flattened()[branch]
    }
}

/// Converts a whole number that is not negative to an index.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers, none negative")]
pub(crate) fn index(number: f64) -> usize {
    number as i64 as usize
}
