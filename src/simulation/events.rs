//! A wall that an importer's solver moves: it sets the state, and events are handled here.

use super::Simulation;
use crate::solver::{Event, INDICATORS, State};
use crate::wall::{Ends, Support};

/// What an event did, and the impulses of the supports on the wall at it \[N s\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Handled {
    /// What happened.
    pub event: Event,
    /// Impulses of the impacts alone.
    pub impulses: Ends,
    /// The derivatives have jumped: branch, phase, displacement or velocity has changed.
    pub changed: bool,
}

impl Simulation {
    /// Sets displacement \[m\] and velocity \[m/s\]. The branch stays, and is continued beyond its ends.
    pub fn set_motion(&mut self, displacement: f64, velocity: f64) {
        (self.progress.state.displacement, self.progress.state.velocity) = (displacement, velocity);
    }

    /// Sets displacement \[m\] and velocity \[m/s\], and chooses the branch they belong to.
    pub fn place(&mut self, displacement: f64, velocity: f64, support: Support) {
        let forcing = self.wall().body().forcing(support);
        self.progress.state = self.motion().placed(&self.progress.state, displacement, velocity, forcing);
    }

    /// Returns the event indicators; `rising` is the value that [`handle_event`](Self::handle_event) has set.
    pub fn indicators(&self, rising: bool, support: Support) -> [f64; INDICATORS] {
        self.motion().indicators(&self.progress.state, rising, self.wall().body().forcing(support))
    }

    /// Updates branch, phase and marks to time, motion and supports.
    pub fn handle_event(&mut self, rising: &mut bool, support: Support) -> Handled {
        let forcing = self.wall().body().forcing(support);
        let before = self.progress.state;
        let mut state = before;
        let mut event = self.motion().event(&mut state, rising, forcing);
        while state.tie != *self.wall().tie_memory() {
            let [place, direction] = self.motion().tie_change(&state);
            self.prepare(&state);
            state.branch = self.wall().branch_of(place, direction);
            event.add(self.motion().event(&mut state, rising, forcing));
        }
        self.progress.state = state;
        let body = self.first.wall().body();
        if event.fractured {
            let of_side = &mut self.progress.tie_breaks[usize::from(state.displacement < 0.0)];
            *of_side = of_side.or(Some(self.progress.time));
        }
        self.progress.work.add(event.work);
        if event.overturned && self.progress.overturn_time.is_none() {
            self.progress.overturn_time = Some(self.progress.time);
        }
        let impulses = if before.departed {
            Ends::default()
        } else {
            body.reaction_changes(Support::default(), event.velocity_jump, 0.0)
        };
        let motion =
            |state: State| (state.branch, state.phase, state.displacement, state.velocity, state.tie);
        let changed = motion(before) != motion(state);
        Handled { event, impulses, changed }
    }

    /// Accepts the present time and motion as those of a completed step.
    pub fn complete_step(&mut self, rising: bool) {
        // what a tie that yields has reached is remembered even where the other side has gone farther
        let branch = &self.wall().branches()[self.progress.state.branch];
        if rising || branch.yielding_side().is_some() {
            let state = &mut self.progress.state;
            state.peaks.include(state.displacement);
        }
    }
}
