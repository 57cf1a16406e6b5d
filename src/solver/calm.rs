//! Calm steps: samples of a record between which nothing happens.
//!
//! Most steps of a run reach no corner and raise no extreme. Ranges of u, u̇, ü and the reactions at the ends
//! of a step make sure of that (docs/record-path.md, §8): they are found once for many steps, so that
//! such a step costs its motion and some comparisons. The wall has the state that a step by itself gives it.

use oscillator::KinematicState;

use super::demand::{Demands, Extremes};
use super::memo::{Memo, Propagators};
use super::motion::Motion;
use super::state::{Phase, State};
use crate::wall::{Branch, Couple, Support, TieAction, Wall};

/// Accelerations of both supports \[m/s²\], one for each sample.
#[derive(Clone, Copy)]
pub(crate) struct Samples<'a> {
    pub(crate) accelerations: &'a [f64],
    /// The time from one to the next \[s\].
    pub(crate) step: f64,
}

/// Lowest and highest value.
type Bounds = [f64; 2];

fn holds([lowest, highest]: Bounds, value: f64) -> bool {
    lowest <= value && value <= highest
}

/// Returns the values that are `margin` or more within the extremes.
fn within(Extremes { highest, lowest }: &Extremes, margin: f64) -> Bounds {
    [lowest.value + margin, highest.value - margin]
}

/// Where a wall may be at the ends of its steps on a branch, so that these are calm.
struct Calm<'a> {
    wall: &'a Wall,
    displacement: Bounds,
    velocity: Bounds,
    acceleration: Bounds,
    couple: Couple,
    bottom: Bounds,
    top: Bounds,
}

impl<'a> Calm<'a> {
    /// Finds the ranges of steps on the branch of a state; `None` where each step has to be searched.
    fn new(wall: &'a Wall, state: &State, demands: &Demands, step: f64) -> Option<Self> {
        let branch = &wall.branches()[state.branch];
        let [lower, upper] = limits(branch, state, demands)?;
        let larger = |range: Bounds| range[0].abs().max(range[1].abs());
        let c = branch.damping.constant()?;
        let (force, stiffness) =
            (larger([lower, upper].map(|u| branch.restoring(u))), branch.stiffness.abs());
        let speed = larger(within(&demands.velocity, 0.0));
        // p = ü + c u̇ + f at the samples, and is linear between them
        let forcing = larger(within(&demands.acceleration, 0.0)) + c * speed + force;
        let most = (forcing + force + c * speed) / (1.0 - c * step);
        let speed = speed + most * step;
        let jerk = 2.0 * forcing / step + stiffness * speed + c * most;
        let snap = stiffness * most + c * jerk;
        // from the straight line u₀ + u̇₀ t
        let departure = 0.5 * step * step * most;
        let share = 0.125 * step * step;
        let by =
            |acceleration, couple| wall.body().reaction_changes(Support::default(), acceleration, couple);
        let [by_a, by_u] = [by(1.0, 0.0), by(0.0, branch.couple.slope)];
        let reaction =
            |extremes, a: f64, u: f64| within(extremes, share * snap * a.abs() + share * most * u.abs());
        (c * step < 1.0).then(|| Self {
            wall,
            displacement: [lower + departure, upper - departure],
            velocity: within(&demands.velocity, share * jerk),
            acceleration: within(&demands.acceleration, share * snap),
            couple: branch.couple,
            bottom: reaction(&demands.reaction_bottom, by_a.bottom, by_u.bottom),
            top: reaction(&demands.reaction_top, by_a.top, by_u.top),
        })
    }

    /// Returns whether a calm step may start or end so, under an acceleration of both supports \[m/s²\].
    #[inline]
    fn holds(&self, motion: &KinematicState, acceleration: f64) -> bool {
        let support = Support::rigid(acceleration);
        let couple = self.couple.at(motion.displacement);
        let reactions = self.wall.body().reactions(support, motion.acceleration, couple);
        holds(self.displacement, motion.displacement)
            && holds(self.velocity, motion.velocity)
            && holds(self.acceleration, motion.acceleration)
            && holds(self.bottom, reactions.bottom)
            && holds(self.top, reactions.top)
    }
}

/// Returns the range of u on the branch of a state in which no extreme is raised and no half cycle begins or
/// ends; `None` where each step has to be searched.
fn limits(branch: &Branch, state: &State, demands: &Demands) -> Option<Bounds> {
    if state.overturned || !demands.ties.is_empty() && branch.tie != TieAction::None {
        return None;
    }
    let reached = within(&demands.displacement, 0.0);
    let lower = branch.lower.max(reached[0]).max(-state.peaks.negative);
    let upper = branch.upper.min(reached[1]).min(state.peaks.positive);
    match (demands.excursion, branch.is_elastic()) {
        (None, true) => Some([lower, upper]),
        (Some(side), true) => {
            Some(if side > 0.0 { [lower.max(0.0), upper] } else { [lower, upper.min(0.0)] })
        }
        (Some(side), false) => (side == branch.side()).then_some([lower, upper]),
        (None, false) => None,
    }
}

impl Motion {
    /// Moves `state` through the first steps of a record that are calm, with demands so far of which they
    /// change none; `see` is shown u and u̇ at the end of each. Returns the number of these steps.
    pub(crate) fn pass_calm_steps(
        &self,
        state: &mut State,
        samples: Samples<'_>,
        memo: &mut Memo,
        demands: &Demands,
        mut see: impl FnMut([f64; 2]),
    ) -> usize {
        let (motion, propagators) = memo.prepare(self, &state.tie);
        let stays = match state.phase {
            Phase::Landed => samples.accelerations.len() - 1,
            Phase::Resting => motion.count_calm_rests(state, samples, demands),
            Phase::Moving => {
                return motion.move_calmly(state, samples, propagators, demands, see).unwrap_or(0);
            }
        };
        for _ in 0..stays {
            see([state.displacement, state.velocity]);
        }
        stays
    }

    /// Counts the first steps of a record through which a wall rests with known reactions.
    fn count_calm_rests(&self, state: &State, samples: Samples<'_>, demands: &Demands) -> usize {
        let [lowest, highest] = self.rest_band;
        let (wall, body) = (&self.wall, self.wall.body());
        let [bottom, top] = [&demands.reaction_bottom, &demands.reaction_top].map(|of| within(of, 0.0));
        let forcing = |acceleration: f64| body.forcing(Support::rigid(acceleration));
        let starts_below = samples.accelerations.first().is_some_and(|first| forcing(*first) < 0.0);
        let is_calm = |acceleration: &&f64| {
            let (support, p) = (Support::rigid(**acceleration), forcing(**acceleration));
            let reactions = body.reactions(support, 0.0, wall.couple_at_rest(p).at(p));
            // between the samples the reactions bend where p = 0
            let is_straight = !wall.bends_at_rest() || (p < 0.0) == starts_below;
            let is_inside = lowest < p && p < highest && is_straight;
            is_inside && holds(bottom, reactions.bottom) && holds(top, reactions.top)
        };
        let is_known = !state.overturned && holds(within(&demands.acceleration, 0.0), 0.0);
        let calm = if is_known { samples.accelerations.iter().take_while(is_calm).count() } else { 0 };
        calm.saturating_sub(1)
    }

    fn move_calmly(
        &self,
        state: &mut State,
        samples: Samples<'_>,
        propagators: &mut Propagators,
        demands: &Demands,
        mut see: impl FnMut([f64; 2]),
    ) -> Option<usize> {
        let (Samples { accelerations, step }, index) = (samples, state.branch);
        let (branch, oscillator) = (&self.wall.branches()[index], &self.oscillators[index]);
        let is_one_piece = step <= oscillator.longest_piece() && !oscillator.is_spread(step);
        if !self.takes_closed_form(index) || !is_one_piece {
            return None;
        }
        let calm = Calm::new(&self.wall, state, demands, step)?;
        let forcing = |acceleration: f64| self.wall.body().forcing(Support::rigid(acceleration));
        let State { displacement, velocity, .. } = *state;
        let mut from = forcing(accelerations[0]);
        let acceleration = branch.acceleration(displacement, velocity, from);
        let mut now = KinematicState { displacement, velocity, acceleration };
        if !calm.holds(&now, accelerations[0]) {
            return None;
        }
        let mut passed = 0;
        for &of_support in &accelerations[1..] {
            let to = forcing(of_support);
            if !holds(calm.displacement, now.displacement + step * now.velocity) {
                break;
            }
            now.acceleration = branch.acceleration(now.displacement, now.velocity, from);
            let end = propagators.end(index, oscillator, now, (to - from) / step, step);
            if !calm.holds(&end, of_support) {
                break;
            }
            (now, from, passed) = (end, to, passed + 1);
            see([now.displacement, now.velocity]);
        }
        (state.displacement, state.velocity) = (now.displacement, now.velocity);
        Some(passed)
    }
}

#[cfg(test)]
mod tests {
    use super::super::state::Segment;
    use super::*;
    use crate::choices::{DampingModel, ForceLaw, Impact, Mechanism};
    use crate::wall::{Ends, Parameters};

    /// Calm steps have the state and the work of steps one by one, which change no demand, bit for bit. They
    /// are most steps of all walls, moving or at rest.
    #[test]
    fn calm_steps_have_the_bits_of_a_search() {
        let damped = |damping_model| Parameters {
            damping_model,
            height: 3.0,
            thickness: 0.25,
            u_start: 0.0,
            ..Parameters::default()
        };
        let constant = damped(DampingModel::ConstantCoefficient);
        let rigid = Parameters {
            damping_model: DampingModel::None,
            force_law: ForceLaw::RigidLinear,
            impact: Impact::Restitution,
            ..constant.clone()
        };
        let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..constant.clone() };
        let tied = Parameters { tie_height: 2.0, tie_stiffness: 3e5, tie_slack: 5e-3, ..constant.clone() };
        let ratio = damped(DampingModel::ConstantRatio);
        let stiffness = damped(DampingModel::StiffnessProportional);
        let (step, count) = (5e-3, 4000);
        let acceleration = |index: usize| {
            let t = index as f64 * step;
            let [slow, fast] = [5.0, 43.0].map(|omega: f64| libm::sin(omega * t));
            0.4 * t.min(3.0) * libm::exp(-0.2 * t) * (slow + 0.4 * fast)
        };
        let accelerations: Vec<f64> = (0..=count).map(acceleration).collect();
        for (parameters, fewest) in
            [(constant, 0.8), (rigid, 0.5), (strip, 0.8), (tied, 0.5), (ratio, 0.8), (stiffness, 0.8)]
        {
            let motion = Motion::of(&parameters, 1e-8).unwrap();
            let mut state = motion.start(0.0, 0.0, Support::default());
            let mut demands =
                Demands::new(motion.wall(), 0.0, [0.0; 3], Ends::default(), |_| 0.0, &[0.01, 0.05, 0.3]);
            let (mut memo, mut calm, mut index) = (Memo::default(), 0, 0);
            let search = |state: &mut State, demands: &mut Demands, index: usize| {
                let [from, to] = [index, index + 1].map(|n| Support::rigid(accelerations[n]));
                let segment = Segment { duration: step, from, to };
                let watch = Some((demands, index as f64 * step));
                motion.advance_watched(state, &segment, false, &mut Memo::default(), watch).unwrap().work
            };
            while index < count {
                let samples = Samples { accelerations: &accelerations[index..], step };
                let mut searched = state;
                let passed = motion.pass_calm_steps(&mut state, samples, &mut memo, &demands, |_| ());
                for n in index..index + passed {
                    let mut after = demands.clone();
                    let work = search(&mut searched, &mut after, n);
                    assert_eq!(work.pieces, u64::from(state.phase == Phase::Moving));
                    assert_eq!((work.corners, &after), (0, &demands), "sample {n}");
                }
                assert_eq!(state, searched, "sample {index}, {passed} steps");
                (calm, index) = (calm + passed, index + passed);
                if index < count {
                    search(&mut state, &mut demands, index);
                    index += 1;
                }
            }
            assert!(calm as f64 >= fewest * count as f64, "{calm} of {count} steps were calm");
        }
    }
}
