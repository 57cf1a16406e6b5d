//! The numbers of a branch that the steps of a run need, for all branches of a wall.

use std::ops::Range;

use oscillator::Oscillator;
use rocking_wall::solver::secant::{Secant, SecantBranch};
use rocking_wall::solver::{Method, Motion};
use rocking_wall::wall::Corner;

use crate::affine::{Affine, MOST_AT_ONCE};
use crate::number::{BranchRow, MOST_BRANCHES};
use crate::numbering::BranchExit;

/// c V over P + f̂, which fixes the largest speed V of a plain step: walls stay far below it, as they do
/// below the terminal speed (docs/record-path.md, §2).
const DAMPING_SHARE: f64 = 0.25;
/// Largest γ over plain steps taken at once: beyond, every block would have to be searched for extremes.
const MOST_GROWTH: f64 = 4.0;
/// Largest margin of four plain steps at once, over the width of their branch.
const MOST_MARGIN: f64 = 0.25;
/// Largest (c + √|k|) h of steps in which corners are passed here: beyond it, as measured, they are too many.
pub(crate) const LONGEST: f64 = 1.0;
/// Share of the leading term that may be left out of a series.
const NEGLIGIBLE: f64 = 1e-18;

/// How the steps on a branch are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stepping {
    /// As affine maps: damping is constant.
    Affine,
    /// As Taylor series: damping follows the secant stiffness.
    Curved,
    /// By the general search for events.
    General,
}

/// How damping follows the secant stiffness, on all branches alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Law {
    /// c = 2ξ ω.
    #[default]
    Ratio,
    /// c = (2ξ₁/ω₁) ω².
    Stiffness,
}

/// Returns γ(L) = 1/(1 − c L/2 − |k| L²/8), by which P + c V + f̂ is multiplied to bound |ü| over a length L;
/// infinite where L is too long for the bound (docs/record-path.md, §2).
fn growth(oscillator: &Oscillator, length: f64) -> f64 {
    let (c, k) = (oscillator.damping(), oscillator.stiffness());
    let slack = 1.0 - 0.5 * c * length - 0.125 * k.abs() * length * length;
    if slack > 0.0 { 1.0 / slack } else { f64::INFINITY }
}

/// (c + √|k|) h.
fn reach(oscillator: &Oscillator, step: f64) -> f64 {
    (oscillator.damping() + oscillator.stiffness().abs().sqrt()) * step
}

/// The numbers of each branch of a wall. p₀ and p₁ are the forcing at the ends of a step.
#[derive(Clone, Debug, Default)]
#[repr(align(64))]
pub(crate) struct BranchTable {
    /// The number of plain steps taken at once, four or two.
    pub(crate) at_once: usize,
    /// The change over them, of u by u, u̇ and the branch's force at u = 0, and of u̇.
    pub(crate) plain_steps: [[BranchRow; 3]; 2],
    /// Change over one step, of u by u, u̇, p₀ − f(0) and p₁ − f(0), and of u̇.
    pub(crate) one_step: [[BranchRow; 4]; 2],
    /// c, with secant damping the largest \[1/s\]; k \[1/s²\]; f(0) \[m/s²\].
    pub(crate) damping: BranchRow,
    pub(crate) stiffness: BranchRow,
    pub(crate) force_at_zero: BranchRow,
    /// The ends of the branch \[m\], and the numbers of its exits there ([`BranchExit`]).
    pub(crate) ends: [BranchRow; 2],
    pub(crate) exits: [BranchRow; 2],
    /// γ over one step and over plain steps at once.
    pub(crate) growth: BranchRow,
    pub(crate) plain_growth: BranchRow,
    /// V over P + f̂ \[s\], and c V over P + f̂.
    pub(crate) speed_share: BranchRow,
    pub(crate) damping_share: BranchRow,
    /// The law of a branch with secant damping.
    pub(crate) secant: SecantBranch<BranchRow>,
    pub(crate) law: Law,
    /// How steps are made, and the map of plain steps at once, branch by branch.
    pub(crate) steppings: Vec<Stepping>,
    pub(crate) maps: Vec<Affine>,
    /// The largest γ L²/h² and c V over P + f̂ of plain steps, and γ and c of curved branches.
    pub(crate) most_growth: f64,
    pub(crate) most_damping: f64,
    pub(crate) curved_growth: f64,
    pub(crate) curved_damping: f64,
    /// (c + √|k|) h of the longest steps with affine maps, and the terms of the series of motion.
    pub(crate) longest: f64,
    pub(crate) terms: usize,
}

impl BranchTable {
    pub(crate) fn new(motion: &Motion, step: f64) -> Self {
        let wall = motion.wall();
        let steppings: Vec<Stepping> =
            (0..wall.branches().len()).map(|branch| stepping(motion, branch, step)).collect();
        let mut table = Self { at_once: MOST_AT_ONCE, steppings, ..Self::default() };
        if table.steppings.iter().all(|stepping| *stepping == Stepping::General) {
            // nothing is prepared: no step needs it
            return table;
        }
        table.at_once = table.count_at_once(motion, step);
        for branch in 0..table.steppings.len() {
            let oscillator = &motion.oscillators()[branch];
            let one = Affine::one_step(oscillator, step);
            table.maps.push(Affine::steps(&one, table.at_once, oscillator, step));
            match (table.steppings[branch], &motion.secants()[branch]) {
                (Stepping::Affine, _) => table.enter_affine(branch, motion, &one, step),
                (Stepping::Curved, Some(secant)) => table.enter_curved(branch, motion, secant, step),
                _ => {}
            }
        }
        table.open_exits(motion, step);
        table.terms = terms(table.longest.min(LONGEST));
        table
    }

    /// Returns how many plain steps are taken at once: four, or two where the margin of four is much of a
    /// branch.
    fn count_at_once(&self, motion: &Motion, step: f64) -> usize {
        let four = MOST_AT_ONCE as f64 * step;
        let is_wide = |branch: usize| {
            let (line, oscillator) = (&motion.wall().branches()[branch], &motion.oscillators()[branch]);
            // a forcing as large as the forces of the branch
            let driving = 2.0 * line.restoring(line.lower).abs().max(line.restoring(line.upper).abs());
            let margin = 0.125 * four * four * growth(oscillator, four) * driving;
            margin <= MOST_MARGIN * (line.upper - line.lower)
        };
        let affine = |branch: &usize| self.steppings[*branch] == Stepping::Affine;
        if (0..self.steppings.len()).filter(affine).all(is_wide) { MOST_AT_ONCE } else { 2 }
    }

    fn enter_line(&mut self, branch: usize, motion: &Motion, damping: f64) {
        let line = &motion.wall().branches()[branch];
        set(&mut self.damping, branch, damping);
        set(&mut self.stiffness, branch, line.stiffness);
        set(&mut self.force_at_zero, branch, line.restoring(0.0));
        set(&mut self.ends[0], branch, line.lower);
        set(&mut self.ends[1], branch, line.upper);
    }

    fn enter_affine(&mut self, branch: usize, motion: &Motion, one: &Affine, step: f64) {
        let oscillator = &motion.oscillators()[branch];
        let c = oscillator.damping();
        self.enter_line(branch, motion, c);
        let map = self.maps[branch];
        let force_at_zero = motion.wall().branches()[branch].restoring(0.0);
        for part in [0, 1] {
            let terms = [one.of_state[0], one.of_state[1], one.of_forcing[0], one.of_forcing[1]];
            for (row, term) in self.one_step[part].iter_mut().zip(terms) {
                set(row, branch, term[part]);
            }
            let by_force: f64 = map.of_forcing.iter().map(|term| term[part]).sum();
            let changes = [map.of_state[0][part], map.of_state[1][part], -by_force * force_at_zero];
            for (row, change) in self.plain_steps[part].iter_mut().zip(changes) {
                set(row, branch, change);
            }
        }
        let at_once = self.at_once as f64;
        let plain = growth(oscillator, at_once * step);
        let usable = plain <= MOST_GROWTH && !oscillator.is_spread(at_once * step);
        let single = growth(oscillator, step);
        set(&mut self.growth, branch, single);
        set(&mut self.plain_growth, branch, if usable { plain } else { f64::INFINITY });
        let damping_share = if c > 0.0 { DAMPING_SHARE } else { 0.0 };
        // finite: it is multiplied by P + f̂, which is 0 for a wall at rest without forcing
        set(&mut self.speed_share, branch, (DAMPING_SHARE * (1.0 / c)).min(f64::MAX));
        set(&mut self.damping_share, branch, damping_share);
        // no step is plain where its bound is infinite
        let bounds = [(single, single.is_finite()), (plain * at_once * at_once, usable)];
        for (growth, _) in bounds.iter().filter(|(_, taken)| *taken) {
            self.most_growth = self.most_growth.max(*growth);
        }
        self.most_damping = self.most_damping.max(damping_share);
        self.longest = self.longest.max(reach(oscillator, step));
    }

    fn enter_curved(&mut self, branch: usize, motion: &Motion, secant: &Secant, step: f64) {
        let damping = largest_damping(motion, branch);
        let growth = 1.0 / (1.0 - damping * step);
        self.enter_line(branch, motion, damping);
        set(&mut self.growth, branch, growth);
        self.curved_growth = self.curved_growth.max(growth);
        self.curved_damping = self.curved_damping.max(damping);
        self.law = match secant {
            Secant::Ratio(_) => Law::Ratio,
            Secant::Stiffness(_) => Law::Stiffness,
        };
        let (law, of) = (&mut self.secant, secant.branch());
        set(&mut law.anchor, branch, of.anchor);
        set(&mut law.force, branch, of.force);
        set(&mut law.stiffness, branch, of.stiffness);
        for (row, number) in law.own.iter_mut().zip(of.own) {
            set(row, branch, number);
        }
        set(&mut law.force_at_zero, branch, of.force_at_zero);
        set(&mut law.factor, branch, of.factor);
    }

    /// Finds how branches are left at their ends.
    fn open_exits(&mut self, motion: &Motion, step: f64) {
        let wall = motion.wall();
        let short = |branch: usize| {
            self.steppings[branch] != Stepping::Affine
                || reach(&motion.oscillators()[branch], step) <= LONGEST
        };
        let find = |branch: usize, upwards: bool| {
            let corner = wall.corners().get(branch + usize::from(upwards));
            let next = if upwards { branch + 1 } else { branch.wrapping_sub(1) };
            let (Some(corner), Some(next_stepping)) = (corner, self.steppings.get(next)) else {
                return BranchExit::Search;
            };
            let Corner { passage, stop, overturning, departure, fracture, landing, .. } = *corner;
            let changes = overturning || departure || fracture || landing;
            if stop || changes || !short(branch) || !short(next) {
                return BranchExit::Search;
            }
            match next_stepping {
                Stepping::General => BranchExit::Search,
                Stepping::Affine if passage => BranchExit::Impact,
                Stepping::Affine => BranchExit::Ordinary,
                Stepping::Curved if passage => BranchExit::Search,
                Stepping::Curved => BranchExit::Curved,
            }
        };
        let exits = [false, true].map(|upwards| {
            let mut row = BranchRow::default();
            for branch in (0..self.steppings.len()).filter(|&at| self.steppings[at] != Stepping::General) {
                set(&mut row, branch, find(branch, upwards).number());
            }
            row
        });
        self.exits = exits;
    }

    /// Returns how a branch is left at its lower end or, with `side` = 1, at its upper one.
    pub(crate) fn exit(&self, branch: usize, side: usize) -> BranchExit {
        BranchExit::of(get(&self.exits[side], branch))
    }

    /// Returns the largest |f| between the corners of the branches whose steps are prepared, for |u| up to
    /// `reach` \[m/s²\].
    pub(crate) fn largest_force(&self, reach: f64) -> f64 {
        let mut largest = 0.0_f64;
        for branch in (0..self.steppings.len()).filter(|&branch| self.steppings[branch] != Stepping::General)
        {
            let [lower, upper] =
                [get(&self.ends[0], branch).max(-reach), get(&self.ends[1], branch).min(reach)];
            if lower <= upper {
                let force = |u: f64| get(&self.force_at_zero, branch) + get(&self.stiffness, branch) * u;
                largest = largest.max(force(lower).abs()).max(force(upper).abs());
            }
        }
        largest
    }
}

/// Returns the number of a branch.
#[inline(always)]
pub(crate) fn get(row: &BranchRow, branch: usize) -> f64 {
    row.as_flattened()[branch % MOST_BRANCHES]
}

/// Sets the number of a branch.
pub(crate) fn set(row: &mut BranchRow, branch: usize, number: f64) {
    row.as_flattened_mut()[branch % MOST_BRANCHES] = number;
}

/// Returns the largest c of a branch with secant damping, which is monotone in u \[1/s\].
fn largest_damping(motion: &Motion, branch: usize) -> f64 {
    let branch = &motion.wall().branches()[branch];
    branch.damping_at(branch.lower).max(branch.damping_at(branch.upper))
}

/// Returns the branches whose steps may be prepared: of many those in the middle, about u = 0. Each has its
/// place in rows at the remainder of its number by their length.
fn preparable(count: usize) -> Range<usize> {
    let first = count.saturating_sub(MOST_BRANCHES) / 2;
    first..first + MOST_BRANCHES
}

/// Decides how the steps on a branch are made.
fn stepping(motion: &Motion, branch: usize, step: f64) -> Stepping {
    let wall = motion.wall();
    let adaptive = matches!(motion.method(), Method::Adaptive { .. });
    let is_preparable = preparable(wall.branches().len()).contains(&branch);
    if !is_preparable || matches!(motion.method(), Method::Newmark { .. }) {
        Stepping::General
    } else if wall.branches()[branch].yielding_side().is_some() {
        // it ends where the wall turns back
        Stepping::General
    } else if motion.secants()[branch].is_some() {
        if largest_damping(motion, branch) * step < 1.0 { Stepping::Curved } else { Stepping::General }
    } else if wall.branches()[branch].damping.constant().is_none() {
        // a law of damping without a fast series
        Stepping::General
    } else if adaptive && wall.has_constant_damping() && !wall.branches()[branch].is_elastic() {
        // the motion has a closed form, but the method asks for series on all but the elastic branch.
        // Where other branches have secant damping, those with constant damping are followed in closed form.
        Stepping::General
    } else if motion.oscillators()[branch].is_spread(step) {
        Stepping::General
    } else {
        Stepping::Affine
    }
}

/// Counts the terms of Σ Eₙ/(n+1)! with |Eₙ| ≤ `reach`ⁿ, the first left out being negligible.
pub(crate) fn terms(reach: f64) -> usize {
    let (mut terms, mut share) = (0, 1.0);
    while share > NEGLIGIBLE {
        terms += 1;
        share *= reach / (terms as f64 + 1.0);
    }
    terms.max(2)
}

#[cfg(test)]
mod tests;
