//! Event indicators, for an importer's solver that moves the wall itself. Between events the branch stays.
//!
//! An indicator is positive while its branch holds, and zero a margin beyond the corner. After an event each
//! is at least half that margin. So no solver meets it at zero, and a wall that turns at a corner makes no
//! second event.

use super::motion::Motion;
use super::state::{Phase, State};
use super::transition::{self, Event, Reached, Rebound};

/// Event indicators: lower and upper end of the branch or of the band of rest, and the largest |u|.
pub const INDICATORS: usize = 3;

/// How far beyond its corner an indicator becomes zero, as a part of its scale.
///
/// The margin is far above rounding and far below any solver's tolerance. Where the force of a rigid wall
/// jumps, [`Motion::event`] takes back the energy gained on the way beyond the corner.
const MARGIN: f64 = 1e-12;

/// Bounces lower than this many margins count as rest: a solver with a tolerance of about 1e-9 cannot resolve
/// them.
const REST_MARGINS: f64 = 4.0;

impl Motion {
    /// Returns the event indicators under the forcing p \[m/s²\]; `rising` is the value that
    /// [`event`](Self::event) has set.
    pub fn indicators(&self, state: &State, rising: bool, forcing: f64) -> [f64; INDICATORS] {
        let State { displacement, velocity, branch, phase, .. } = *state;
        let scale = self.wall.displacement_scale();
        let peak = if rising {
            velocity * displacement.signum() / (scale * self.wall.rocking_rate())
        } else {
            (state.peaks.largest() - displacement.abs()) / scale
        };
        let [lower, upper] = match phase {
            Phase::Moving => {
                let corners = self.wall.corners();
                let relative = |corner: f64| (displacement - corner) / scale.max(corner.abs());
                let mut ends =
                    [relative(corners[branch].displacement), -relative(corners[branch + 1].displacement)];
                if let Some(side) = self.wall.branches()[branch].yielding_side() {
                    // it ends where the wall turns back, not at its inner corner
                    ends[usize::from(side < 0.0)] = side * velocity / (scale * self.wall.rocking_rate());
                }
                ends
            }
            Phase::Resting => {
                let [lowest, highest] = self.rest_band;
                let body = self.wall.body();
                let width = if (highest - lowest).is_finite() {
                    highest - lowest
                } else {
                    body.strength.of(self.wall.free_side().unwrap_or_default()) / body.effective_mass
                };
                // towards transverse walls no forcing ends the rest
                [forcing - lowest, highest - forcing]
                    .map(|gap| if gap.is_finite() { gap / width } else { 1.0 })
            }
            Phase::Landed => return [1.0; INDICATORS],
        };
        [lower + MARGIN, upper + MARGIN, peak + MARGIN]
    }

    /// Updates branch, phase and marks to the present displacement, velocity and forcing p \[m/s²\]. `rising`
    /// says whether |u| is beyond its largest so far and grows. Ends early where a tie changes: the rest is
    /// for the motion with the new memory.
    pub fn event(&self, state: &mut State, rising: &mut bool, forcing: f64) -> Event {
        let mut event = Event::default();
        self.break_overstretched(state, &mut event);
        // the wall passes each corner at most once, and once more where it turns back
        for _ in 0..2 * self.wall.corners().len() {
            if state.tie != *self.wall.tie_memory() {
                break;
            }
            match state.phase {
                Phase::Landed => break,
                Phase::Resting => {
                    let [lowest, highest] = self.rest_band;
                    if (lowest..=highest).contains(&forcing) {
                        break;
                    }
                    transition::settle(self, state, [forcing, 0.0]);
                }
                Phase::Moving if self.has_turned_back(state) => {
                    let side = self.wall.branches()[state.branch].side();
                    let reach = side * state.peaks.of(side).max(side * state.displacement);
                    event.fractured |= transition::unload(self, state, reach);
                    // from there inwards, as corners on the way back have still to be passed
                    state.branch = self.wall.branch_of(reach, -reach);
                }
                Phase::Moving => match self.exit(state) {
                    None => break,
                    Some(upwards) => {
                        let corner = Reached { corner: state.branch + usize::from(upwards), upwards };
                        let rebound = |state: &State| self.late_rebound(state, forcing);
                        event.add(transition::pass_corner(self, state, corner, [forcing, 0.0], rebound));
                    }
                },
            }
        }
        let outwards = state.velocity * state.displacement.signum();
        *rising |= state.displacement.abs() >= state.peaks.largest();
        if *rising {
            state.peaks.include(state.displacement);
        }
        *rising &= outwards > 0.0 && state.phase == Phase::Moving;
        event
    }

    /// Returns where the ties of a state have become others than those of this motion, and the direction from
    /// there on which the wall is: an importer's solver may have gone past further corners since.
    pub(crate) fn tie_change(&self, state: &State) -> [f64; 2] {
        let (before, after) = (self.wall.tie_memory().yielded, state.tie.yielded);
        let changed = [1.0, -1.0].into_iter().find(|sign| before.of(*sign) != after.of(*sign));
        let Some(side) = changed.filter(|_| !state.tie.lost) else {
            // they are lost where the wall leaves its supports
            let side = self.wall.branches()[state.branch].side();
            return [side * self.wall.body().departure.of(side), side];
        };
        let breaks = self.wall.ties().break_at_memory(side, &state.tie);
        [side * after.of(side), if breaks { side } else { -side }]
    }

    /// Breaks ties beyond whose fracture the wall has been placed.
    fn break_overstretched(&self, state: &mut State, event: &mut Event) {
        let branch = &self.wall.branches()[state.branch];
        let inner = branch.lower.abs().min(branch.upper.abs());
        if self.wall.ties().holds(branch.side(), state.tie).any(|hold| inner >= hold.breaks) {
            event.fractured |= self.wall.ties().stretch(&mut state.tie, state.displacement);
        }
    }

    /// Returns whether the wall moves inwards on a branch on which a tie yields.
    fn has_turned_back(&self, state: &State) -> bool {
        let speed = self.wall.displacement_scale() * self.wall.rocking_rate();
        let side = self.wall.branches()[state.branch].yielding_side();
        side.is_some_and(|side| side * state.velocity < -0.5 * MARGIN * speed)
    }

    /// Returns the end at which the wall has left its branch: `true` for the upper one. `None` while it is on
    /// the branch.
    fn exit(&self, state: &State) -> Option<bool> {
        let corners = self.wall.corners();
        let beyond = |index: usize, direction: f64| {
            let corner = corners[index].displacement;
            let margin = 0.5 * MARGIN * self.wall.displacement_scale().max(corner.abs());
            let over = (state.displacement - corner) * direction;
            over > margin || (over >= 0.0 && state.velocity * direction > 0.0)
        };
        let inner = self.wall.branches()[state.branch].yielding_side().map(|side| side < 0.0);
        let upwards = inner != Some(true) && beyond(state.branch + 1, 1.0);
        (upwards || inner != Some(false) && beyond(state.branch, -1.0)).then_some(upwards)
    }

    /// Returns the motion after an impact that is met a margin or more beyond u = 0. A rigid wall comes to
    /// rest once its bounces are too low to follow.
    ///
    /// The force of the old side has acted on the way beyond u = 0. Where the force jumps, the velocity is
    /// corrected to that of an impact at u = 0. Without the correction each bounce would gain energy, and
    /// bounces would never become low.
    fn late_rebound(&self, state: &State, forcing: f64) -> Rebound {
        let factor = self.wall.passage_factor(state.velocity);
        if let Some(side) = self.wall.free_side() {
            return self.rebound_from_walls(state, side, forcing);
        }
        if !self.wall.is_rigid() {
            return Rebound { velocity: state.velocity * factor, rests: false };
        }
        let [lowest, highest] = self.rest_band;
        let in_band = (lowest..=highest).contains(&forcing);
        let late = state.displacement.abs();
        // accelerations in the direction of motion on the old side, and against it on the new one
        let (push, pull) = if state.velocity > 0.0 {
            (forcing - lowest, highest - forcing)
        } else {
            (highest - forcing, forcing - lowest)
        };
        let arriving = (state.velocity * state.velocity - 2.0 * push * late).max(0.0);
        let leaving = arriving * factor.powi(2);
        let now = leaving - 2.0 * pull * late;
        // height of the next bounce, u̇²/2 over the deceleration
        let lowest_bounce = REST_MARGINS * MARGIN * self.wall.displacement_scale();
        let low = in_band && (now <= 0.0 || 0.5 * leaving <= pull * lowest_bounce);
        Rebound {
            velocity: now.max(0.0).sqrt().copysign(state.velocity),
            rests: low || leaving.sqrt() < self.rest_speed,
        }
    }

    /// Returns the motion after an impact against transverse walls that is met a margin or more beyond u = 0,
    /// as if it were met there. A wall comes to rest once its bounces are too low to follow.
    fn rebound_from_walls(&self, state: &State, side: f64, forcing: f64) -> Rebound {
        let late = state.displacement.abs();
        // acceleration towards the transverse walls at u = 0
        let pull = side * (self.wall.restoring(state.branch, 0.0) - forcing);
        let arriving = (state.velocity * state.velocity - 2.0 * pull * late).max(0.0);
        let leaving = arriving * self.wall.passage_factor(state.velocity).powi(2);
        let lowest_bounce = REST_MARGINS * MARGIN * self.wall.displacement_scale();
        let stiffness = self.wall.branches()[state.branch].stiffness.max(0.0);
        let low = pull >= 0.0 && 0.5 * leaving <= (pull + 0.5 * stiffness * lowest_bounce) * lowest_bounce;
        Rebound { velocity: leaving.sqrt().copysign(side), rests: low || leaving.sqrt() < self.rest_speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::{DampingModel, ForceLaw, Impact, Rocking};
    use crate::wall::{Parameters, Support};

    /// A rigid wall rests where its next bounce is lower than four margins of its own scale.
    #[test]
    fn bounces_of_less_than_four_margins_are_rest() {
        for thickness in [0.1, 2.0] {
            let parameters = Parameters {
                thickness,
                force_law: ForceLaw::RigidLinear,
                damping_model: DampingModel::None,
                impact: Impact::Restitution,
                restitution: 0.9,
                ..Parameters::default()
            };
            let motion = Motion::of(&parameters, 1e-8).unwrap();
            let scale = motion.wall().displacement_scale();
            let [_, pull] = motion.rest_band();
            for (margins, rests) in [(3.9, true), (4.1, false), (100.0, false)] {
                // as high as that after an impact at u = 0: u̇²/2 = p h
                let leaving = (2.0 * pull * margins * MARGIN * scale).sqrt();
                let mut state = motion.start(1e-3, 0.0, Support::default());
                for side in [1.0, -1.0] {
                    (state.displacement, state.velocity) =
                        (0.0, side * leaving / motion.wall().passage_factor(side));
                    let rebound = motion.late_rebound(&state, 0.0);
                    assert_eq!(rebound.rests, rests, "{thickness} m, {margins} margins");
                    assert!((rebound.velocity - side * leaving).abs() <= 1e-15 * leaving.max(1e-3));
                }
            }
        }
    }

    /// A wall at transverse walls rests where its next bounce, with an energy of p h + ½ k h², is lower than
    /// four margins. What it has gained on the way beyond u = 0 does not count.
    #[test]
    fn low_bounces_from_transverse_walls_are_rest() {
        for (rocking, side) in [(Rocking::OneSidedPositive, 1.0), (Rocking::OneSidedNegative, -1.0)] {
            for force_law in [ForceLaw::RigidLinear, ForceLaw::Bilinear] {
                let (damping_model, impact) = (DampingModel::None, Impact::Restitution);
                let parameters = Parameters {
                    rocking,
                    force_law,
                    damping_model,
                    u_start: 0.0,
                    restitution: 0.8,
                    impact,
                    ..Parameters::default()
                };
                let motion = Motion::of(&parameters, 1e-8).unwrap();
                let wall = motion.wall();
                let mut state = motion.start(0.0, side * 0.1, Support::default());
                let stiffness = wall.branches()[state.branch].stiffness.max(0.0);
                let height = MARGIN * wall.displacement_scale();
                let at_rest = side * wall.restoring(state.branch, 0.0);
                // no forcing, and one towards the transverse walls
                for forcing in [0.0, -0.3 * side] {
                    let pull = at_rest - side * forcing;
                    for (margins, rests) in [(3.9, true), (4.1, false)] {
                        let height = margins * height;
                        let leaving = (2.0 * (pull + 0.5 * stiffness * height) * height).sqrt();
                        let arriving = leaving / wall.passage_factor(-side);
                        let late = 0.5 * MARGIN;
                        state.displacement = -side * late;
                        state.velocity = -side * (arriving * arriving + 2.0 * pull * late).sqrt();
                        let rebound = motion.late_rebound(&state, forcing);
                        assert_eq!(
                            rebound.rests, rests,
                            "{rocking:?}, {force_law:?}, p = {forcing}: {margins}"
                        );
                        assert!((rebound.velocity / (side * leaving) - 1.0).abs() < 1e-12);
                    }
                }
            }
        }
    }
}
