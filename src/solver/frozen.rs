//! The motion for a solver that is not ours: between events the branch is frozen, and an event changes it.
//!
//! An indicator is positive while its branch holds, and zero a margin beyond the corner. After an event each is at least half
//! that margin, so that no solver meets it at zero, and a wall that turns at a corner makes no second event.

use super::{Motion, Phase, State, Work};

/// Event indicators: lower and upper end of the branch or of the band of rest, and the largest |u|.
pub const INDICATORS: usize = 3;

/// Part of the scale of an indicator by which it goes beyond its corner.
///
/// Far above rounding, and far below any solver's tolerance. Where the force of a rigid wall jumps, [`Motion::event`] takes
/// back what the way beyond the corner adds to the energy.
const MARGIN: f64 = 1e-12;

/// Bounces lower than this many margins are rest: a solver of tolerance 1e-9 or so tells them from nothing no more.
const REST_MARGINS: f64 = 4.0;

/// What an event did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Event {
    /// The wall overturned.
    pub overturned: bool,
    /// It left its supports.
    pub departed: bool,
    /// It came to rest, or lies at the end of its fall.
    pub stopped: bool,
    /// Change of u̇ by impacts \[m/s\].
    pub velocity_jump: f64,
    /// Changes of branch and impacts.
    pub work: Work,
}

impl Motion {
    /// The state with another displacement \[m\] and velocity \[m/s\], on the branch they belong to under the forcing p
    /// \[m/s²\]; its memories stay.
    #[must_use]
    pub fn placed(&self, state: &State, displacement: f64, velocity: f64, forcing: f64) -> State {
        let anew = self.start_under(displacement, velocity, forcing);
        State { displacement, velocity, branch: anew.branch, phase: anew.phase, ..*state }
    }

    /// The event indicators under the forcing p \[m/s²\]. `rising` is what [`event`](Self::event) left it at.
    #[must_use]
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
                [relative(corners[branch].displacement), -relative(corners[branch + 1].displacement)]
            }
            Phase::Resting => {
                let [lowest, highest] = self.rest_band;
                [(forcing - lowest) / (highest - lowest), (highest - forcing) / (highest - lowest)]
            }
            Phase::Landed => return [1.0; INDICATORS],
        };
        [lower + MARGIN, upper + MARGIN, peak + MARGIN]
    }

    /// Brings the discrete state up to what displacement, velocity and forcing p \[m/s²\] have become. `rising` says
    /// whether |u| is beyond its largest so far and grows.
    pub fn event(&self, state: &mut State, rising: &mut bool, forcing: f64) -> Event {
        let mut event = Event::default();
        // each corner once, and once more for those at which the wall turns back
        for _ in 0..2 * self.wall.corners().len() {
            match state.phase {
                Phase::Landed => break,
                Phase::Resting => {
                    let [lowest, highest] = self.rest_band;
                    if (lowest..=highest).contains(&forcing) {
                        break;
                    }
                    self.settle(state, forcing, 0.0);
                }
                Phase::Moving => match self.left(state) {
                    None => break,
                    Some(upwards) => self.cross(state, upwards, forcing, &mut event),
                },
            }
        }
        follow_peak(state, rising);
        event
    }

    /// Whether the wall has left its branch: upwards or downwards.
    fn left(&self, state: &State) -> Option<bool> {
        let corners = self.wall.corners();
        let beyond = |index: usize, direction: f64| {
            let corner = corners[index].displacement;
            let margin = 0.5 * MARGIN * self.wall.displacement_scale().max(corner.abs());
            let over = (state.displacement - corner) * direction;
            over > margin || (over >= 0.0 && state.velocity * direction > 0.0)
        };
        if beyond(state.branch + 1, 1.0) {
            Some(true)
        } else if beyond(state.branch, -1.0) {
            Some(false)
        } else {
            None
        }
    }

    /// Goes through the corner at the upper or lower end of the branch.
    fn cross(&self, state: &mut State, upwards: bool, forcing: f64, event: &mut Event) {
        let corner = self.wall.corners()[state.branch + usize::from(upwards)];
        let outwards = upwards == (corner.displacement > 0.0);
        event.work.corners += 1;
        if corner.overturning && outwards && !state.overturned {
            state.overturned = true;
            event.overturned = true;
        }
        if corner.departure && outwards && !state.departed {
            state.departed = true;
            event.departed = true;
        }
        if corner.landing {
            (state.displacement, state.velocity) = (corner.displacement, 0.0);
            state.phase = Phase::Landed;
            event.stopped = true;
            return;
        }
        state.branch = if upwards { state.branch + 1 } else { state.branch - 1 };
        if corner.passage {
            self.pass(state, forcing, event);
        }
    }

    /// A passage of u = 0: restitution, and rest for a rigid wall whose bounces have become too low to follow.
    fn pass(&self, state: &mut State, forcing: f64, event: &mut Event) {
        let before = state.velocity;
        event.work.impacts += 1;
        if self.wall.is_rigid() {
            self.pass_jump(state, forcing, event);
        } else {
            state.velocity *= self.wall.passage_factor();
            if state.velocity == 0.0 && forcing != 0.0 {
                // e = 0: it stops here and leaves with the forcing
                state.branch = self.wall.branch_of(0.0, forcing);
                state.displacement = 0.0;
            }
        }
        event.velocity_jump += state.velocity - before;
    }

    /// The passage where the force jumps.
    ///
    /// The solver comes here a margin or more late, and the force of the old side has acted all that way. The velocity is
    /// corrected to what an impact at u = 0 makes of it: else each bounce would gain energy, and never become low.
    fn pass_jump(&self, state: &mut State, forcing: f64, event: &mut Event) {
        let [lowest, highest] = self.rest_band;
        let in_band = (lowest..=highest).contains(&forcing);
        let late = state.displacement.abs();
        // accelerations towards the way it goes on the old side, and against it on the new one
        let (push, pull) = if state.velocity > 0.0 {
            (forcing - lowest, highest - forcing)
        } else {
            (highest - forcing, forcing - lowest)
        };
        let arriving = (state.velocity * state.velocity - 2.0 * push * late).max(0.0);
        let leaving = arriving * self.wall.passage_factor().powi(2);
        let now = leaving - 2.0 * pull * late;
        // height of the next bounce, u̇²/2 over the deceleration
        let lowest_bounce = REST_MARGINS * MARGIN * self.wall.displacement_scale();
        let low = in_band && (now <= 0.0 || 0.5 * leaving <= pull * lowest_bounce);
        if low || leaving.sqrt() < self.rest_speed {
            self.settle(state, forcing, 0.0);
            event.stopped = state.phase == Phase::Resting;
        } else {
            state.velocity = now.max(0.0).sqrt().copysign(state.velocity);
        }
    }
}

impl State {
    /// Counts the displacement that a solver has reached among the peaks.
    pub fn include_peak(&mut self) {
        self.peaks.include(self.displacement);
    }
}

fn follow_peak(state: &mut State, rising: &mut bool) {
    let outwards = state.velocity * state.displacement.signum();
    let new = state.displacement.abs() >= state.peaks.largest();
    if *rising || new {
        state.include_peak();
    }
    *rising = (*rising || new) && outwards > 0.0 && state.phase == Phase::Moving;
}
