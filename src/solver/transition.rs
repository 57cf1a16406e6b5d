//! Transitions: how the motion determines branch, phase and marks of a state, at the start and at corners.
//!
//! | corner | transition |
//! |---|---|
//! | between two branches | branch i ↔ i + 1 |
//! | `u_ins`, outwards | the wall overturns, once |
//! | departure, outwards | the wall leaves its supports, once, and loses its ties; their p stays |
//! | fracture, outwards | the tie of this side breaks |
//! | landing | u̇ = 0, the end of the fall |
//! | u = 0 with impact | u̇ → e u̇; a rigid wall may come to rest; for e = 0 the wall follows the forcing |
//! | none: u̇ = 0 where a tie yields | the tie unloads: it remembers this displacement |
//! | u = 0 at transverse walls | u̇ → −e₁ u̇ on the same branch; any wall may come to rest |

use crate::wall::{Corner, Support};

use super::motion::Motion;
use super::state::{Peaks, Phase, State, Work};

/// What transitions did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "independent things that happened")]
pub struct Event {
    /// The wall overturned.
    pub overturned: bool,
    /// It left its supports.
    pub departed: bool,
    /// A tie broke.
    pub fractured: bool,
    /// It came to rest, or lies at the end of its fall.
    pub stopped: bool,
    /// Change of u̇ by impacts \[m/s\].
    pub velocity_jump: f64,
    /// Changes of branch and impacts.
    pub work: Work,
}

impl Event {
    /// Adds what a later transition did.
    pub(crate) fn add(&mut self, later: Self) {
        self.overturned |= later.overturned;
        self.departed |= later.departed;
        self.fractured |= later.fractured;
        self.stopped |= later.stopped;
        self.velocity_jump += later.velocity_jump;
        self.work.add(later.work);
    }
}

impl Motion {
    /// Returns the state at the start, under the supports' motion at that instant.
    pub fn start(&self, displacement: f64, velocity: f64, support: Support) -> State {
        self.start_under(displacement, velocity, self.wall.body().forcing(support))
    }

    /// Returns the state at the start, under a forcing p \[m/s²\]. A wall that starts far from upright has
    /// stretched its ties.
    pub fn start_under(&self, displacement: f64, velocity: f64, forcing: f64) -> State {
        let mut memory = self.wall.ties().memory_at(displacement);
        memory.lost = !self.wall.ties().is_empty() && self.is_beyond_departure(displacement);
        if memory != *self.wall.tie_memory() {
            return self.with_tie_memory(memory).start_under(displacement, velocity, forcing);
        }
        let mut state = self.located(displacement, velocity, forcing);
        let behind = self.wall.free_side().is_some_and(|side| displacement == 0.0 && velocity * side < 0.0);
        if behind {
            // the wall moves towards the transverse walls, so it starts with an impact
            state.velocity *= self.wall.passage_factor(velocity);
            if state.velocity.abs() < self.rest_speed {
                settle(self, &mut state, [forcing, 0.0]);
            }
        }
        state
    }

    /// Returns the state of a wall, with the branch and phase that belong to its motion.
    fn located(&self, displacement: f64, velocity: f64, forcing: f64) -> State {
        let wall = &self.wall;
        let overturned = displacement.abs() > wall.body().instability.of(displacement);
        let departed = self.is_beyond_departure(displacement);
        let mut state = State {
            displacement,
            velocity,
            branch: 0,
            phase: Phase::Moving,
            overturned,
            departed,
            peaks: Peaks::at(displacement),
            tie: *wall.tie_memory(),
        };
        if wall.can_rest() && displacement == 0.0 && velocity == 0.0 {
            settle(self, &mut state, [forcing, 0.0]);
        } else {
            // At a corner, the velocity or else the acceleration decides the side. The force is continuous
            // there, except for the jump of a rigid wall's force at u = 0.
            let outer = wall.branch_of(displacement, 0.0);
            let acceleration = wall.acceleration(outer, displacement, velocity, forcing);
            state.branch =
                wall.branch_of(displacement, if velocity == 0.0 { acceleration } else { velocity });
        }
        state
    }

    fn is_beyond_departure(&self, displacement: f64) -> bool {
        displacement.abs() > self.wall.body().departure.of(displacement)
    }

    /// Returns the state with another displacement \[m\] and velocity \[m/s\], on the branch they belong to
    /// under the forcing p \[m/s²\]. Marks and peaks stay.
    pub fn placed(&self, state: &State, displacement: f64, velocity: f64, forcing: f64) -> State {
        let anew = self.located(displacement, velocity, forcing);
        State { displacement, velocity, branch: anew.branch, phase: anew.phase, ..*state }
    }
}

/// The motion after an impact at u = 0.
#[derive(Clone, Copy)]
pub(super) struct Rebound {
    /// u̇ \[m/s\].
    pub(super) velocity: f64,
    /// Whether a wall that can rest comes to rest.
    pub(super) rests: bool,
}

/// A corner that the wall reaches, and the way on which it does.
#[derive(Clone, Copy)]
pub(super) struct Reached {
    /// Its number.
    pub(super) corner: usize,
    pub(super) upwards: bool,
}

/// Takes `state` through the corner it has reached, under the forcing p and its rate
/// \[m/s², m/s³\]. `rebound` gives the motion after an impact there.
pub(super) fn pass_corner(
    motion: &Motion,
    state: &mut State,
    Reached { corner, upwards }: Reached,
    forcing: [f64; 2],
    rebound: impl FnOnce(&State) -> Rebound,
) -> Event {
    let Corner { displacement, passage, stop, overturning, departure, fracture, landing } =
        motion.wall.corners()[corner];
    let outwards = upwards == (displacement > 0.0);
    let mut event = Event {
        overturned: overturning && outwards && !state.overturned,
        departed: departure && outwards && !state.departed,
        fractured: fracture && outwards && !state.departed,
        work: Work { corners: 1, ..Work::default() },
        ..Event::default()
    };
    state.overturned |= event.overturned;
    state.departed |= event.departed;
    if event.fractured || event.departed {
        event.fractured |= motion.wall.ties().stretch(&mut state.tie, displacement);
        state.tie.lost |= event.departed && !motion.wall.ties().is_empty();
    }
    if landing {
        (state.displacement, state.velocity, state.phase) = (displacement, 0.0, Phase::Landed);
        event.stopped = true;
        return event;
    }
    if stop {
        // an importer's solver meets the corner a little beyond it
        state.displacement = displacement;
    } else {
        // branch i lies between corners i and i + 1
        state.branch = if upwards { corner } else { corner - 1 };
    }
    if passage {
        let before = state.velocity;
        let rebound = rebound(state);
        rebound_from_zero(motion, state, rebound, forcing);
        event.stopped = state.phase == Phase::Resting;
        event.velocity_jump = state.velocity - before;
        event.work.impacts = 1;
    }
    event
}

/// Ends the yielding of ties that have reached `displacement` \[m\]; returns whether that has broken one.
pub(super) fn unload(motion: &Motion, state: &mut State, displacement: f64) -> bool {
    let has_broken = motion.wall.ties().stretch(&mut state.tie, displacement);
    // where that is all the ties remember anyway, branches keep their numbers
    motion.find_branch(state);
    has_broken
}

/// Sets the velocity after an impact at u = 0, and the branch or rest that follows from it.
fn rebound_from_zero(motion: &Motion, state: &mut State, rebound: Rebound, [forcing, rate]: [f64; 2]) {
    state.velocity = rebound.velocity;
    if motion.wall.can_rest() {
        if rebound.rests {
            settle(motion, state, [forcing, rate]);
        }
    } else if state.velocity == 0.0 {
        // e = 0 has stopped the wall; it now moves in the direction of the forcing
        let direction = if forcing == 0.0 { rate } else { forcing };
        state.displacement = 0.0;
        state.branch = motion.wall.branch_of(0.0, direction);
    }
}

/// Stops a wall that can rest at u = 0. It rests while the forcing stays within the band of rest, and
/// otherwise moves in the direction of the forcing.
pub(super) fn settle(motion: &Motion, state: &mut State, [forcing, rate]: [f64; 2]) {
    let [lowest, highest] = motion.rest_band;
    let leaves_up = forcing > highest || (forcing == highest && rate > 0.0);
    let leaves_down = forcing < lowest || (forcing == lowest && rate < 0.0);
    (state.displacement, state.velocity) = (0.0, 0.0);
    leave_rest(motion, state, !leaves_down);
    if !leaves_up && !leaves_down {
        state.phase = Phase::Resting;
    }
}

/// Sets a wall at u = 0 moving.
pub(super) fn leave_rest(motion: &Motion, state: &mut State, upwards: bool) {
    state.phase = Phase::Moving;
    state.branch = motion.wall.branch_of(0.0, if upwards { 1.0 } else { -1.0 });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::{DampingModel, ForceLaw, Impact, Rocking};
    use crate::wall::Parameters;

    fn rigid(rocking: Rocking) -> Motion {
        let parameters = Parameters {
            rocking,
            force_law: ForceLaw::RigidLinear,
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            restitution: 0.8,
            ..Parameters::default()
        };
        Motion::of(&parameters, 1e-8).unwrap()
    }

    /// A start beyond the instability has overturned, and one beyond the departure has left the supports.
    #[test]
    fn starts_beyond_instability_and_departure_are_marked() {
        let motion = rigid(Rocking::TwoSided);
        let body = motion.wall.body();
        for side in [1.0, -1.0] {
            let marks = |place: f64| {
                let State { overturned, departed, .. } = motion.start_under(side * place, 0.0, 0.0);
                (overturned, departed)
            };
            let (u_ins, departure) = (body.instability.of(side), body.departure.of(side));
            for (place, expected) in [
                (0.0, (false, false)),
                (u_ins, (false, false)),
                (1.01 * u_ins, (true, false)),
                (departure, (true, false)),
                (1.01 * departure, (true, true)),
            ] {
                assert_eq!(marks(place), expected, "{place} m");
            }
        }
    }

    /// A wall that starts where it has left its supports has lost its tie, too.
    #[test]
    fn a_start_beyond_departure_has_lost_its_tie() {
        let parameters = Parameters { tie_height: 3.0, tie_stiffness: 1e5, ..Parameters::default() };
        let motion = Motion::of(&parameters, 1e-8).unwrap();
        let departure = motion.wall.body().departure.positive;
        let lost = |share: f64| motion.start_under(share * departure, 0.0, 0.0).tie.lost;
        assert!(lost(1.01) && !lost(0.99));
    }

    /// A wall that is stopped goes on only where the forcing leaves the band of rest.
    #[test]
    fn a_stopped_wall_rests_within_the_band() {
        let motion = rigid(Rocking::TwoSided);
        let [lowest, highest] = motion.rest_band;
        for (forcing, rate, moves) in [
            (0.0, 1.0, None),
            (0.99 * highest, 1.0, None),
            (highest, 0.0, None),
            (highest, -1.0, None),
            (highest, 1.0, Some(1.0)),
            (1.01 * highest, 0.0, Some(1.0)),
            (0.99 * lowest, -1.0, None),
            (lowest, 0.0, None),
            (lowest, 1.0, None),
            (lowest, -1.0, Some(-1.0)),
            (1.01 * lowest, 0.0, Some(-1.0)),
        ] {
            let mut state = motion.start_under(1e-3, 0.1, 0.0);
            settle(&motion, &mut state, [forcing, rate]);
            let phase = if moves.is_some() { Phase::Moving } else { Phase::Resting };
            assert_eq!((state.displacement, state.velocity, state.phase), (0.0, 0.0, phase), "{forcing}");
            if let Some(side) = moves {
                assert_eq!(state.branch, motion.wall.branch_of(0.0, side), "{forcing}");
            }
        }
    }

    /// A wall that starts at transverse walls and moves towards them starts with an impact.
    #[test]
    fn a_start_against_transverse_walls_is_an_impact() {
        for (rocking, side) in [(Rocking::OneSidedPositive, 1.0), (Rocking::OneSidedNegative, -1.0)] {
            let motion = rigid(rocking);
            let velocity =
                |place: f64, speed: f64| motion.start_under(place * side, speed * side, 0.0).velocity;
            // e₁ = 0.8, within a rounding
            assert!((velocity(0.0, -0.1) - 0.08 * side).abs() <= f64::EPSILON * 0.08);
            assert_eq!(velocity(0.0, 0.1), 0.1 * side);
            assert_eq!(velocity(0.01, -0.1), -0.1 * side);
        }
    }
}
