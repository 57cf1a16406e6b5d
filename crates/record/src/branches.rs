//! The branch that each lane is on, in the table of its wall.

use rocking_wall::solver::secant::{SecantBranch, Tolerances};

use crate::lanes::Lanes;
use crate::number::{BranchRow, Number, WIDTH};
use crate::numbering::LaneBranch;
use crate::solver::RecordSolver;
use crate::table::{BranchTable, get};

/// The branch of each lane from `first` on.
#[derive(Clone, Copy)]
pub(crate) struct Branches<'a, N: Number> {
    solvers: &'a [&'a RecordSolver<'a>; WIDTH],
    first: usize,
    places: N::Branches,
}

impl<N: Number> Branches<'_, N> {
    /// Looks up the number of each lane's branch in a row of its table.
    #[inline(always)]
    pub(crate) fn look_up(&self, token: N::Token, row: impl Fn(&BranchTable) -> &BranchRow) -> N {
        let Self { solvers, first, places } = *self;
        if N::ONE_TABLE {
            // one row for all lanes, which a vector permutes
            return N::look_up(token, row(&solvers[first % WIDTH].table), places);
        }
        N::of_lanes(token, |lane| get(row(&solvers[lane % WIDTH].table), N::branch(places, lane)))
    }

    /// Looks up the numbers of several rows.
    #[inline(always)]
    pub(crate) fn look_up_all<const ROWS: usize>(
        &self,
        token: N::Token,
        rows: impl Fn(&BranchTable) -> &[BranchRow; ROWS],
    ) -> [N; ROWS] {
        let mut found = [N::splat(token, 0.0); ROWS];
        for (row, found) in found.iter_mut().enumerate() {
            *found = self.look_up(token, |table| &rows(table)[row]);
        }
        found
    }
}

/// Returns the law of the branch of each lane, looked up by `look_up`.
#[inline(always)]
pub(crate) fn law<N>(look_up: impl Fn(fn(&BranchTable) -> &BranchRow) -> N) -> SecantBranch<N> {
    SecantBranch {
        anchor: look_up(|table| &table.secant.anchor),
        force: look_up(|table| &table.secant.force),
        stiffness: look_up(|table| &table.secant.stiffness),
        own: [
            look_up(|table| &table.secant.own[0]),
            look_up(|table| &table.secant.own[1]),
            look_up(|table| &table.secant.own[2]),
        ],
        force_at_zero: look_up(|table| &table.secant.force_at_zero),
        factor: look_up(|table| &table.secant.factor),
    }
}

impl<O> Lanes<'_, O> {
    /// Returns the branch of each lane from `first` on.
    #[inline(always)]
    pub(crate) fn branches<N: Number>(&self, first: usize, branch: LaneBranch<N>) -> Branches<'_, N> {
        Branches { solvers: &self.solvers, first, places: branch.places() }
    }

    /// Returns what a Taylor series may leave out of the motion of each lane.
    #[inline(always)]
    pub(crate) fn tolerances<N: Number>(&self, token: N::Token, first: usize) -> Tolerances<N> {
        let of = |lane: usize| self.solvers[(first + lane) % WIDTH].motion.tolerances();
        Tolerances {
            displacement: N::of_lanes(token, |lane| of(lane).displacement),
            velocity: N::of_lanes(token, |lane| of(lane).velocity),
        }
    }
}
