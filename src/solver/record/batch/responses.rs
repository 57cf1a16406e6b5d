//! What a wall's branches and a record give for all runs: the response of each branch to the record, taken once.
//!
//! Over four steps a branch is an affine map of (u, u̇) and of the forcing. The forcing's part, for a run's factor s, is s times
//! that of the record itself: a table of it, from each sample on, leaves a run two products for each of u and u̇.

use super::super::lane::BRAKING;
use super::super::stretches::{AT_ONCE, STRETCH};
use super::super::{Affine, Forcing, RecordSolver, StepMap, growth};
use super::vector::{Column, Row, Vector, WIDTH};

/// Rows a lane may read on, from wherever it is: those of a stretch, and one.
pub(super) const ROWS_AHEAD: usize = STRETCH / AT_ONCE + 1;
/// (c + √|k|) h of the longest steps; beyond, four at once reach a corner too often to be worth it.
const LONGEST: f64 = 0.25;
/// Samples of a record up to which tables are made: 1 MB for each oscillator.
const MOST_SAMPLES: usize = 1 << 16;
/// Share of the leading term that may be left out of a series.
const NEGLIGIBLE: f64 = 1e-18;

/// What is looked up by branch. A is the affine map of one step, B that of four; p₀ and p₁ are the forcing at the ends of a step.
#[derive(Clone, Copy)]
pub(super) enum By {
    /// Change of u by u and u̇, of u̇ by u and u̇, over four steps.
    UByU4,
    UByV4,
    VByU4,
    VByV4,
    /// Of u and u̇ by the branch's force at u = 0, over four steps.
    UByForce4,
    VByForce4,
    /// Change of u and u̇ by u, u̇, p₀ − f(0) and p₁ − f(0), over one step.
    UByU,
    UByV,
    UByP0,
    UByP1,
    VByU,
    VByV,
    VByP0,
    VByP1,
    /// c \[1/s\], k \[1/s²\], f(0) \[m/s²\].
    Damping,
    Stiffness,
    Force,
    /// The ends of the branch \[m\].
    Lower,
    Upper,
    /// The same where nothing but the stiffness changes there, else not a number.
    PlainLower,
    PlainUpper,
    /// A over P + c V + f̂ over one step and over four.
    Growth,
    Growth4,
    /// V over P + f̂ \[s\], and c V over P + f̂.
    Speed,
    Braking,
    /// The first row of the branch's response.
    Response,
}

/// Number of columns.
const COLUMNS: usize = By::Response as usize + 1;

/// For each branch its numbers, for each oscillator its response to a record.
#[derive(Debug)]
pub(super) struct Responses {
    columns: [Column; COLUMNS],
    /// The response over four steps, of u and u̇: from samples 0, 4, 8, …, then from 1, 5, 9, …, and so on.
    rows: Vec<[f64; 2]>,
    /// Rows for each of these.
    stride: usize,
    /// Terms of the series of motion.
    pub(super) terms: usize,
    /// The largest of `Growth4`.
    pub(super) growth: f64,
}

impl Responses {
    /// Of a wall to a record; `None` where that does not serve: few or very many samples, many branches, steps without an affine
    /// map, or long beside the wall's period.
    pub(super) fn new<F: Forcing>(solver: &RecordSolver<'_>, forcing: &F) -> Option<Self> {
        let count = forcing.count();
        if !(4 * AT_ONCE..=MOST_SAMPLES).contains(&count) || solver.maps.len() > WIDTH {
            return None;
        }
        let maps: Vec<&StepMap> = solver.maps.iter().map(Option::as_ref).collect::<Option<_>>()?;
        let step = solver.step;
        let reach =
            |map: &StepMap| (map.oscillator.damping() + map.oscillator.stiffness().abs().sqrt()) * step;
        let longest = maps.iter().map(|map| reach(map)).fold(0.0, f64::max);
        if longest > LONGEST {
            return None;
        }
        // at most 1/(1 − 2 · 0.25)
        let growths: Vec<f64> =
            maps.iter().map(|map| growth(&map.oscillator, AT_ONCE as f64 * step)).collect();
        let most_growth = growths.iter().copied().fold(0.0, f64::max);
        let mut responses = Self {
            columns: [Row::ZERO; COLUMNS],
            rows: Vec::new(),
            stride: count / AT_ONCE + 1 + ROWS_AHEAD,
            terms: terms(longest),
            growth: most_growth,
        };
        let first = |branch: usize| {
            maps.iter().position(|map| map.oscillator == maps[branch].oscillator).unwrap_or(branch)
        };
        for (branch, map) in maps.iter().enumerate() {
            responses.fill_in(branch, map, growths[branch], solver);
            let known = first(branch);
            let start = if known == branch {
                let start = responses.rows.len();
                responses.respond(map, forcing, step);
                start as f64
            } else {
                responses.columns[By::Response as usize].0[known]
            };
            responses.columns[By::Response as usize].0[branch] = start;
        }
        Some(responses)
    }

    /// Enters what is looked up by a branch, but for its response.
    fn fill_in(&mut self, branch: usize, map: &StepMap, growth: f64, solver: &RecordSolver<'_>) {
        let step = solver.step;
        let (c, k) = (map.oscillator.damping(), map.oscillator.stiffness());
        let [[uu, vu], [uv, vv], [u0, v0], [u1, v1], _] = map.single.terms;
        let [[uu4, vu4], [uv4, vv4], ..] = Affine::single(&map.oscillator, AT_ONCE as f64 * step).terms;
        // the response to a constant forcing of −1, step by step
        let force = (0..AT_ONCE).fold([0.0; 2], |[u, v], _| {
            [u + (uu * u + uv * v) - (u0 + u1), v + (vu * u + vv * v) - (v0 + v1)]
        });
        let corners = solver.motion.wall.corners();
        let plain = |index: Option<usize>, next: Option<usize>| {
            let corner = corners.get(index?)?;
            let ahead = solver.maps.get(next?)?.as_ref()?;
            let plain = !corner.is_marked() && ahead.oscillator.damping() == c;
            plain.then_some(corner.displacement)
        };
        for (by, value) in [
            (By::UByU4, uu4),
            (By::UByV4, uv4),
            (By::VByU4, vu4),
            (By::VByV4, vv4),
            (By::UByForce4, force[0] * map.force_at_zero),
            (By::VByForce4, force[1] * map.force_at_zero),
            (By::UByU, uu),
            (By::UByV, uv),
            (By::UByP0, u0),
            (By::UByP1, u1),
            (By::VByU, vu),
            (By::VByV, vv),
            (By::VByP0, v0),
            (By::VByP1, v1),
            (By::Damping, c),
            (By::Stiffness, k),
            (By::Force, map.force_at_zero),
            (By::Lower, map.corners[0]),
            (By::Upper, map.corners[1]),
            (By::PlainLower, plain(Some(branch), branch.checked_sub(1)).unwrap_or(f64::NAN)),
            (By::PlainUpper, plain(Some(branch + 1), Some(branch + 1)).unwrap_or(f64::NAN)),
            (By::Growth, map.growth[0]),
            (By::Growth4, growth),
            (By::Speed, BRAKING * map.inverse_damping),
            (By::Braking, if c > 0.0 { BRAKING } else { 0.0 }),
        ] {
            self.columns[by as usize].0[branch] = value;
        }
    }

    /// Adds the response of an oscillator.
    fn respond<F: Forcing>(&mut self, map: &StepMap, forcing: &F, step: f64) {
        let [_, _, first, second, third] = map.double.terms;
        let [of_u, of_v, ..] = Affine::single(&map.oscillator, 2.0 * step).terms;
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

    /// The rows from a sample on, of the response that starts at a row.
    #[inline(always)]
    pub(super) fn ahead(&self, start: usize, sample: usize) -> &[[f64; 2]] {
        &self.rows[start + (sample % AT_ONCE) * self.stride + sample / AT_ONCE..][..ROWS_AHEAD]
    }

    /// What belongs to each lane's branch.
    #[inline(always)]
    pub(super) fn of<V: Vector>(&self, branches: V) -> Found<'_, V> {
        Found { places: branches.places(), columns: &self.columns }
    }
}

/// Terms of Σ Eₙ/(n+1)! with |Eₙ| ≤ `reach`ⁿ, the first left out being negligible.
fn terms(reach: f64) -> usize {
    let (mut terms, mut share) = (0, 1.0);
    while share > NEGLIGIBLE {
        terms += 1;
        share *= reach / (terms as f64 + 1.0);
    }
    terms.max(2)
}

/// Numbers of the lanes' branches.
#[derive(Clone, Copy)]
pub(super) struct Found<'a, V: Vector> {
    places: V::Places,
    columns: &'a [Column; COLUMNS],
}

impl<V: Vector> Found<'_, V> {
    #[inline(always)]
    pub(super) fn by(&self, by: By) -> V {
        V::look_up(self.places, &self.columns[by as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first term left out is negligible, the last one kept is not.
    #[test]
    fn series_end_where_their_terms_are_negligible() {
        let left_out = |reach: f64, n: usize| (0..n).fold(1.0, |share, m| share * reach / (m as f64 + 2.0));
        for reach in [1e-6, 0.01, 0.06, 0.25] {
            let n = terms(reach);
            assert!(left_out(reach, n) <= NEGLIGIBLE, "{reach}: {n}");
            assert!(n == 2 || left_out(reach, n - 1) > NEGLIGIBLE, "{reach}: {n}");
        }
        assert_eq!(terms(0.25), 13);
    }
}
