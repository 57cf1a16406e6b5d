//! What a wall's branches and a record give for all runs: the response of each branch to the record, taken
//! once.
//!
//! Over four steps a branch is an affine map of (u, u̇) and of the forcing. The forcing's part, for a run's
//! factor s, is s times that of the record itself: a table of it, from each sample on, leaves a run two
//! products for each of u and u̇.

use super::super::forcing::{AT_ONCE, BLOCK, Forcing};
use super::super::solver::RecordSolver;
use super::super::step_map::{Affine, AffineSteps, StepMap};
use super::table::BranchTable;
use super::vector::WIDTH;

/// Rows a lane may read on, from wherever it is: those of a block, and one.
pub(super) const ROWS_AHEAD: usize = BLOCK / AT_ONCE + 1;
/// (c + √|k|) h of the longest steps; beyond, runs reach corners too often for lanes to be worth it.
const LONGEST: f64 = 0.5;
/// Samples of a record up to which tables are made: 1 MB for each oscillator.
const MOST_SAMPLES: usize = 1 << 16;
/// Share of the leading term that may be left out of a series.
const NEGLIGIBLE: f64 = 1e-18;

/// For each branch its numbers, for each oscillator its response to a record.
#[derive(Debug)]
pub(super) struct Responses {
    pub(super) table: BranchTable,
    /// The response over four steps, of u and u̇: from samples 0, 4, 8, …, then from 1, 5, 9, …, and so on.
    rows: Vec<[f64; 2]>,
    /// Rows for each of these.
    stride: usize,
    /// Terms of the series of motion.
    pub(super) terms: usize,
    /// The largest of `growth4`.
    pub(super) growth: f64,
}

impl Responses {
    /// Prepares the responses of a wall to a record; `None` where runs do not go side by side: few or very
    /// many samples, many branches, steps without an affine map, or long beside the wall's period.
    pub(super) fn new(solver: &RecordSolver<'_>, forcing: Forcing<'_>) -> Option<Self> {
        let count = forcing.count();
        if !(4 * AT_ONCE..=MOST_SAMPLES).contains(&count) || solver.maps.len() > WIDTH {
            return None;
        }
        let maps = solver.maps.iter().map(|map| Some((map.as_ref()?, map.as_ref()?.affine_steps()?)));
        let maps: Vec<(&StepMap, &AffineSteps)> = maps.collect::<Option<_>>()?;
        let reach = |(_, steps): &(&StepMap, &AffineSteps)| {
            steps.oscillator.damping() + steps.oscillator.stiffness().abs().sqrt()
        };
        let longest = solver.step * maps.iter().map(reach).fold(0.0, f64::max);
        if longest > LONGEST {
            return None;
        }
        let mut responses = Self {
            table: BranchTable::default(),
            rows: Vec::new(),
            stride: count / AT_ONCE + 1 + ROWS_AHEAD,
            terms: terms(longest),
            growth: 0.0,
        };
        for (branch, &(map, steps)) in maps.iter().enumerate() {
            let known = maps[..branch].iter().position(|(_, known)| known.oscillator == steps.oscillator);
            let table = &mut responses.table;
            table.enter(branch, (map, steps), solver);
            table.response[branch] = known.map_or(responses.rows.len() as f64, |known| table.response[known]);
            // where it is infinite no four steps are plain
            if table.growth4[branch].is_finite() {
                responses.growth = responses.growth.max(table.growth4[branch]);
            }
            if known.is_none() {
                responses.respond(steps, forcing, solver.step);
            }
        }
        Some(responses)
    }

    /// Adds the response of an oscillator.
    fn respond(&mut self, steps: &AffineSteps, forcing: Forcing<'_>, step: f64) {
        let [_, _, first, second, third] = steps.double.terms;
        let [of_u, of_v, ..] = Affine::single(&steps.oscillator, 2.0 * step).terms;
        let start = self.rows.len();
        self.rows.resize(start + AT_ONCE * self.stride, [0.0; 2]);
        for (offset, rows) in self.rows[start..].chunks_exact_mut(self.stride).enumerate() {
            let count = (forcing.count() - 1 - offset) / AT_ONCE;
            for (n, row) in rows.iter_mut().enumerate().take(count) {
                let p = forcing.from(offset + n * AT_ONCE, AT_ONCE + 1);
                let pair =
                    |n: usize| [0, 1].map(|i| (first[i] * p[n] + second[i] * p[n + 1]) + third[i] * p[n + 2]);
                let ([u, v], then) = (pair(0), pair(2));
                *row = [0, 1].map(|i| [u, v][i] + (of_u[i] * u + of_v[i] * v) + then[i]);
            }
        }
    }

    /// Returns the rows from a sample on, of the response that starts at a row.
    #[inline(always)]
    pub(super) fn ahead(&self, start: usize, sample: usize) -> &[[f64; 2]] {
        &self.rows[start + (sample % AT_ONCE) * self.stride + sample / AT_ONCE..][..ROWS_AHEAD]
    }
}

/// Counts the terms of Σ Eₙ/(n+1)! with |Eₙ| ≤ `reach`ⁿ, the first left out being negligible.
fn terms(reach: f64) -> usize {
    let (mut terms, mut share) = (0, 1.0);
    while share > NEGLIGIBLE {
        terms += 1;
        share *= reach / (terms as f64 + 1.0);
    }
    terms.max(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first term left out is negligible, the last one kept is not.
    #[test]
    fn series_end_where_their_terms_are_negligible() {
        let left_out = |reach: f64, n: usize| (0..n).fold(1.0, |share, m| share * reach / (m as f64 + 2.0));
        for reach in [1e-6, 0.01, 0.06, 0.25, LONGEST] {
            let n = terms(reach);
            assert!(left_out(reach, n) <= NEGLIGIBLE, "{reach}: {n}");
            assert!(n == 2 || left_out(reach, n - 1) > NEGLIGIBLE, "{reach}: {n}");
        }
        assert_eq!([0.25, LONGEST].map(terms), [13, 16]);
    }
}
