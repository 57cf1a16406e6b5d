//! What the steps of a lane need of the branch it is on, to be looked up for all lanes at once.

use super::super::forcing::AT_ONCE;
use super::super::solver::RecordSolver;
use super::super::step_map::{Affine, AffineSteps, StepMap, growth};
use super::vector::Row;
use crate::wall::Corner;

/// Largest γ over four plain steps: beyond, every block would have to be searched for extremes.
const MOST_GROWTH: f64 = 4.0;

/// For each branch of a wall its numbers. p₀ and p₁ are the forcing at the ends of a step.
#[derive(Debug, Default)]
#[repr(align(64))]
pub(super) struct BranchTable {
    /// Change over four steps, of u by u, u̇ and the branch's force at u = 0, and of u̇.
    pub(super) four_steps: [[Row; 3]; 2],
    /// Change over one step, of u by u, u̇, p₀ − f(0) and p₁ − f(0), and of u̇.
    pub(super) one_step: [[Row; 4]; 2],
    /// c \[1/s\], k \[1/s²\], f(0) \[m/s²\].
    pub(super) damping: Row,
    pub(super) stiffness: Row,
    pub(super) force_at_zero: Row,
    /// The ends of the branch \[m\].
    pub(super) lower: Row,
    pub(super) upper: Row,
    /// The same where the wall goes on beyond, else not a number.
    pub(super) ordinary_lower: Row,
    pub(super) ordinary_upper: Row,
    /// The factor on u̇ at u = 0 where that end is a passage, else not a number.
    pub(super) rebound_lower: Row,
    pub(super) rebound_upper: Row,
    /// A over P + c V + f̂, over one step and over four.
    pub(super) growth: Row,
    pub(super) growth4: Row,
    /// V over P + f̂ \[s\], and c V over P + f̂.
    pub(super) speed_share: Row,
    pub(super) damping_share: Row,
    /// The first row of the branch's response.
    pub(super) response: Row,
}

impl BranchTable {
    /// Enters what belongs to a branch, but for its response.
    pub(super) fn enter(
        &mut self,
        branch: usize,
        (map, steps): (&StepMap, &AffineSteps),
        solver: &RecordSolver<'_>,
    ) {
        let (c, k) = (steps.oscillator.damping(), steps.oscillator.stiffness());
        let four_steps = AT_ONCE as f64 * solver.step;
        let one = steps.single.terms;
        let four = Affine::single(&steps.oscillator, four_steps).terms;
        // the response to a constant forcing of −1, step by step
        let force = (0..AT_ONCE).fold([0.0; 2], |[u, v], _| {
            [0, 1].map(|part| {
                [u, v][part] + (one[0][part] * u + one[1][part] * v) - (one[2][part] + one[3][part])
            })
        });
        for part in [0, 1] {
            for (row, term) in self.one_step[part].iter_mut().zip(one) {
                row[branch] = term[part];
            }
            let by_force = force[part] * map.force_at_zero;
            for (row, change) in
                self.four_steps[part].iter_mut().zip([four[0][part], four[1][part], by_force])
            {
                row[branch] = change;
            }
        }
        self.damping[branch] = c;
        self.stiffness[branch] = k;
        self.force_at_zero[branch] = map.force_at_zero;
        [self.lower[branch], self.upper[branch]] = map.corners;
        let wall = &solver.motion.wall;
        let ordinary = |corner: usize, next: Option<usize>| {
            let Corner { displacement, overturning, departure, landing, .. } = *wall.corners().get(corner)?;
            let ahead = solver.maps.get(next?)?.as_ref()?.affine_steps()?;
            (!(overturning || departure || landing) && ahead.oscillator.damping() == c)
                .then_some(displacement)
        };
        let rebound = |corner: usize| {
            // lanes leave to the run itself what turns back there
            let passage = wall.corners().get(corner).is_some_and(|corner| corner.passage && !corner.stop);
            if passage { wall.passage_factor() } else { f64::NAN }
        };
        self.ordinary_lower[branch] = ordinary(branch, branch.checked_sub(1)).unwrap_or(f64::NAN);
        self.ordinary_upper[branch] = ordinary(branch + 1, Some(branch + 1)).unwrap_or(f64::NAN);
        (self.rebound_lower[branch], self.rebound_upper[branch]) = (rebound(branch), rebound(branch + 1));
        self.growth[branch] = map.growth[0];
        let growth4 = growth(&steps.oscillator, four_steps);
        self.growth4[branch] = if growth4 > MOST_GROWTH { f64::INFINITY } else { growth4 };
        self.speed_share[branch] = map.speed_share;
        self.damping_share[branch] = map.damping_share();
    }
}
