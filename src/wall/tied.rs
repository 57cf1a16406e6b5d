//! What the ties of a wall do on its branches.

use std::ops::Add;

use super::branch::Branch;
use super::equation::Wall;
use super::sides::Sides;
use super::tie::{Tie, TieAction, TieMemory};
use super::warning::Warning;

impl Wall {
    /// Returns the warning of a start that has stretched or broken a tie: whoever pulls the wall to `u_start`
    /// \[m\] pulls the tie with it.
    pub fn start_warning(&self, u_start: f64) -> Option<Warning> {
        let memory = self.ties().memory_at(u_start);
        let yielded = memory.yielded.of(u_start);
        let of_tie = |tie: &Tie| {
            let broken = tie.is_broken(u_start, &memory);
            let limit = if broken { tie.fracture_displacement() } else { tie.strength_displacement() }?;
            let (limit, elongation) = (limit.copysign(u_start), tie.elongation(yielded));
            let is_stretched = tie.ultimate.is_some() && yielded >= limit.abs();
            let height = self.ties().told(tie.height);
            is_stretched.then_some(Warning::StretchedStart { u_start, limit, elongation, broken, height })
        };
        // a broken tie is worse than one that has got longer
        let warnings = || self.ties().of_side(u_start).filter_map(of_tie);
        let is_broken = |warning: &Warning| matches!(warning, Warning::StretchedStart { broken: true, .. });
        warnings().find(is_broken).or_else(|| warnings().next())
    }

    /// What a tie does on a branch.
    pub(crate) fn tie_action(&self, tie: &Tie, branch: usize) -> TieAction {
        let Branch { lower, upper, .. } = self.branches()[branch];
        tie.action(lower, upper, self.tie_memory())
    }

    /// Force N of one of the ties on a branch \[N\].
    pub fn force_of(&self, tie: &Tie, branch: usize, displacement: f64) -> f64 {
        let Branch { lower, upper, .. } = self.branches()[branch];
        match self.tie_action(tie, branch) {
            TieAction::None => 0.0,
            TieAction::Pulls => tie
                .hold(0.5 * (lower + upper), self.tie_memory())
                .map_or(0.0, |hold| tie.tension(&hold, displacement)),
            TieAction::Yields => tie.strength.unwrap_or_default(),
        }
    }

    /// dN/d|u| of one of the ties on a branch, K y/`z_G` where it pulls \[N/m\].
    pub fn slope_of(&self, tie: &Tie, branch: usize) -> f64 {
        let pulls = self.tie_action(tie, branch) == TieAction::Pulls;
        if pulls { tie.stiffness * tie.lever } else { 0.0 }
    }

    /// Sum of the forces N of the ties on a branch \[N\]; 0 without one.
    pub fn tie_force(&self, branch: usize, displacement: f64) -> f64 {
        if self.branches()[branch].tie == TieAction::None {
            return 0.0;
        }
        self.ties().iter().map(|tie| self.force_of(tie, branch, displacement)).fold(0.0, Add::add)
    }

    /// Sum of dN/d|u| of the ties on a branch \[N/m\].
    pub fn tie_slope(&self, branch: usize) -> f64 {
        self.ties().iter().map(|tie| self.slope_of(tie, branch)).fold(0.0, Add::add)
    }

    /// The memory of the ties at a displacement on a branch: those that yield get longer up to there.
    pub fn tie_memory_at(&self, branch: usize, displacement: f64) -> TieMemory {
        let mut memory = *self.tie_memory();
        if let Some(side) = self.branches()[branch].yielding_side() {
            let of_side = memory.yielded.of_mut(side);
            *of_side = of_side.max(side * displacement);
        }
        memory
    }

    /// Plastic elongations p of the ties of a wall at a displacement on a branch, the largest of each side
    /// \[m\].
    pub fn tie_elongation(&self, branch: usize, displacement: f64) -> Sides {
        self.ties().elongation(&self.tie_memory_at(branch, displacement))
    }

    /// Returns dp/d|u| of the longest tie on a branch on which one yields, its lever; 0 where another one has
    /// got longer before \[-\].
    pub(crate) fn elongating_lever(&self, branch: usize, displacement: f64) -> f64 {
        let side = self.branches()[branch].side();
        let memory = self.tie_memory_at(branch, displacement);
        let elongation = |tie: &&Tie| tie.elongations(&memory).of(side);
        let longest = self.ties().of_side(side).max_by(|a, b| elongation(a).total_cmp(&elongation(b)));
        let yields = |tie: &&Tie| self.tie_action(tie, branch) == TieAction::Yields;
        longest.filter(yields).map_or(0.0, |tie| tie.lever)
    }
}
