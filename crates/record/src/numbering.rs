//! What a vector holds as a number though it is none: the branch that a lane is on, and how it is left.

use rocking_wall::solver::secant;

use crate::number::{LaneRow, Number, WIDTH, index};

/// How a branch is left at one of its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BranchExit {
    /// By the general search for events.
    Search,
    /// At an ordinary corner, to another branch with affine maps.
    Ordinary,
    /// At an ordinary corner, to a branch with secant damping.
    Curved,
    /// At u = 0, with an impact, to another branch with affine maps.
    Impact,
}

impl BranchExit {
    /// All exits, each at the number that stands for it in a row.
    const ALL: [Self; 4] = [Self::Search, Self::Ordinary, Self::Curved, Self::Impact];

    /// Returns the number that stands for an exit in a row. `Exits` compares these numbers.
    pub(crate) fn number(self) -> f64 {
        f64::from(self as u8)
    }

    /// Returns the exit that a number stands for.
    pub(crate) fn of(number: f64) -> Self {
        Self::ALL[index(number)]
    }
}

/// How each lane leaves its branch at the corner ahead.
#[derive(Clone, Copy)]
pub(crate) struct Exits<N>(N);

impl<N: Number> Exits<N> {
    /// Takes the numbers of exits, as rows have them.
    #[inline(always)]
    pub(crate) fn of(numbers: N) -> Self {
        Self(numbers)
    }

    #[inline(always)]
    fn is_after(self, exit: BranchExit) -> N::Mask {
        self.0.like(exit.number()).below(self.0)
    }

    /// Returns the lanes that leave by an impact.
    #[inline(always)]
    pub(crate) fn by_impact(self) -> N::Mask {
        self.is_after(BranchExit::Curved)
    }

    /// Returns the lanes that leave at an ordinary corner, to whichever branch.
    #[inline(always)]
    pub(crate) fn at_ordinary_corner(self) -> N::Mask {
        self.is_after(BranchExit::Search) & !self.by_impact()
    }

    /// Returns the lanes that leave to a branch with secant damping.
    #[inline(always)]
    pub(crate) fn to_curved(self) -> N::Mask {
        self.is_after(BranchExit::Ordinary) & !self.by_impact()
    }
}

/// The branch that each lane is on.
#[derive(Clone, Copy)]
pub(crate) struct LaneBranch<N>(N);

impl<N: Number> LaneBranch<N> {
    /// Returns the next branch upwards, or downwards where `upwards` is false.
    #[inline(always)]
    pub(crate) fn next(self, upwards: N::Mask) -> Self {
        let Self(number) = self;
        // lanes on the lowest branch do not leave it downwards
        let below = secant::Number::max(number + -1.0, number.like(0.0));
        Self(N::select(upwards, number + 1.0, below))
    }

    #[inline(always)]
    pub(crate) fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self(N::select(mask, yes.0, no.0))
    }

    /// Returns the places of the branches in rows.
    #[inline(always)]
    pub(crate) fn places(self) -> N::Branches {
        self.0.branches()
    }
}

/// The branch of each lane, one after the other. Stored as f64, so that a vector loads it as it does u.
#[derive(Default)]
pub(crate) struct LaneBranches(LaneRow);

impl LaneBranches {
    /// Returns the branch of a lane.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> usize {
        index(self.0[lane % WIDTH])
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, branch: usize) {
        self.0[lane % WIDTH] = branch as f64;
    }

    /// Loads the branches from lane `first` on.
    #[inline(always)]
    pub(crate) fn load<N: Number>(&self, token: N::Token, first: usize) -> LaneBranch<N> {
        LaneBranch(N::load(token, &self.0, first))
    }

    #[inline(always)]
    pub(crate) fn store<N: Number>(&mut self, LaneBranch(number): LaneBranch<N>, first: usize) {
        number.store(&mut self.0, first);
    }
}
