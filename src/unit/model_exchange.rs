//! The wall for an importer's solver: Model Exchange.

use fmu_export::{Failure, Log, ModelExchange, Update};

use crate::simulation::Excitation;
use crate::variables::{CONTINUOUS_STATES, DERIVATIVES, EVENT_INDICATORS, GROUPS, RealVariable};
use crate::wall::{Support, Usage, usage};

use super::Unit;

// the description says how many indicators the motion has
const _: () = assert!(EVENT_INDICATORS == crate::solver::INDICATORS);

/// What an instance for Model Exchange stores in addition.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Exchange {
    /// |u| is beyond its largest so far, and grows.
    pub(super) rising: bool,
    /// `a_g` at the last event \[m/s²\].
    pub(super) ground: f64,
    pub(super) own_motion: OwnMotion,
}

/// The scene's own motion between two samples, continued linearly beyond them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct OwnMotion {
    /// Seconds from the start of the simulation to its start.
    pub(super) from: f64,
    /// The supports there.
    pub(super) support: Support,
    /// Their rate \[1/s\].
    pub(super) rate: Support,
    /// Seconds from the start of the simulation to the next sample.
    pub(super) end: Option<f64>,
}

impl OwnMotion {
    /// Returns the motion from `elapsed` seconds after the start to the next sample.
    pub(super) fn new(motion: &Excitation, elapsed: f64) -> Self {
        let segment = motion.segment(elapsed, f64::INFINITY);
        let (from, to, duration) = (segment.from, segment.to, segment.duration);
        if !duration.is_finite() {
            return Self { from: elapsed, ..Self::default() };
        }
        let rate = from.with(to, |from, to| (to - from) / duration);
        Self { from: elapsed, support: from, rate, end: Some(elapsed + duration) }
    }

    pub(super) fn at(&self, elapsed: f64) -> Support {
        self.support.with(self.rate, |value, rate| value + rate * (elapsed - self.from))
    }
}

impl Unit {
    /// Seconds from the start of the simulation to now.
    pub(super) fn elapsed(&self) -> f64 {
        self.simulation.progress().time - self.experiment.start
    }

    /// Stores the scene's own motion from `elapsed` seconds after the start to the next sample.
    pub(super) fn begin_own_motion(&mut self, elapsed: f64) {
        let own_motion = self.excitation.as_ref().map(|motion| OwnMotion::new(motion, elapsed));
        self.exchange.get_or_insert_default().own_motion = own_motion.unwrap_or_default();
    }

    /// Sets one state as if it were an input, and the branch with it.
    pub(super) fn place(&mut self, variable: RealVariable, value: f64) {
        let state = self.simulation.progress().state;
        let (displacement, velocity) = match variable {
            RealVariable::U => (value, state.velocity),
            _ => (state.displacement, value),
        };
        let support = self.support();
        self.simulation.place(displacement, velocity, support);
    }

    /// Warns about parameters of the solver that are set: the importer's solver integrates.
    pub(super) fn warn_of_solver(&self, log: &mut Log<'_>) {
        let (_, names) = GROUPS.iter().find(|(group, _)| *group == "solver").unwrap_or(&("", &[]));
        // parameters without effect in either interface have had their warning already
        let is_set = |usage: &Usage| usage.matters && !usage.is_start && names.contains(&usage.name);
        for Usage { name, .. } in usage(&self.parameters).filter(is_set) {
            log.warning(format_args!(
                "{name} is set and has no effect: in Model Exchange the importer's solver integrates"
            ));
        }
    }

    fn indicators(&self) -> [f64; EVENT_INDICATORS] {
        let rising = self.exchange.is_some_and(|exchange| exchange.rising);
        self.simulation.indicators(rising, self.support())
    }
}

impl ModelExchange for Unit {
    const STATES: &'static [Self::Real] = CONTINUOUS_STATES;
    const DERIVATIVES: &'static [Self::Real] = DERIVATIVES;
    const EVENT_INDICATORS: usize = EVENT_INDICATORS;

    fn set_time(&mut self, time: f64) {
        self.simulation.set_time(time);
        self.refresh();
    }

    fn set_states(&mut self, states: &[f64]) {
        if let &[displacement, velocity] = states {
            self.simulation.set_motion(displacement, velocity);
            self.refresh();
        }
    }

    fn nominal(&self, state: RealVariable) -> f64 {
        let scale = self.wall().displacement_scale();
        if state == RealVariable::U { scale } else { scale * self.wall().rocking_rate() }
    }

    fn event_indicators(&self, indicators: &mut [f64]) {
        indicators.copy_from_slice(&self.indicators());
    }

    fn update(&mut self, log: &mut Log<'_>) -> Result<Update, Failure> {
        self.warn_of_inputs(log);
        let time = self.simulation.progress().time;
        let (elapsed, early) = (self.elapsed(), TIME_ROUNDING * time.abs().max(1.0));
        let sample = self.exchange.and_then(|exchange| exchange.own_motion.end);
        let reached = sample.filter(|sample| elapsed >= sample - early);
        if let Some(sample) = reached {
            // from the sample itself: from a rounding before it the same sample would come again
            self.begin_own_motion(sample.max(elapsed));
        }
        let support = self.support();
        let mut exchange = self.exchange.unwrap_or_default();
        let ground_changed = exchange.ground.to_bits() != self.inputs.ground.to_bits();
        exchange.ground = self.inputs.ground;
        let handled = self.simulation.handle_event(&mut exchange.rising, support);
        self.exchange = Some(exchange);
        self.impulses = handled.impulses;
        self.refresh();
        let event = handled.event;
        if event.overturned {
            log.event(format_args!("overturned at t = {time} s: |u| exceeded u_ins"));
        }
        if event.fractured {
            log.event(format_args!("a tie broke at t = {time} s"));
        }
        if event.departed {
            log.event(format_args!(
                "left the supports at t = {time} s: reactions and impulses are 0 from there on"
            ));
        }
        if event.stopped {
            let displacement = self.simulation.progress().state.displacement;
            log.event(format_args!("stands still from t = {time} s on, at u = {displacement} m"));
        }
        Ok(Update {
            // some solvers restart only where states are reported as changed
            states_changed: handled.changed || reached.is_some() || ground_changed,
            next_event: exchange.own_motion.end.map(|end| self.experiment.start + end),
            ..Update::default()
        })
    }

    fn complete_step(&mut self, log: &mut Log<'_>) -> Result<bool, Failure> {
        self.warn_of_inputs(log);
        self.simulation.complete_step(self.exchange.is_some_and(|exchange| exchange.rising));
        Ok(self.indicators().iter().any(|&indicator| indicator <= 0.0))
    }
}

/// How early an importer may stop at an event whose time it was given, relative to the larger of that time
/// and 1 s.
const TIME_ROUNDING: f64 = 1e-9;
