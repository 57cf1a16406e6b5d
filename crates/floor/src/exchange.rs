//! The floor for an importer's solver: Model Exchange.

use fmu_export::{Failure, Log, ModelExchange, Update};

use crate::event::INDICATORS;
use crate::floor::Branch;
use crate::unit::Unit;
use crate::variables::{CONTINUOUS_STATES, DERIVATIVES, EVENT_INDICATORS, RealVariable};

// the description says how many indicators the motion has
const _: () = assert!(EVENT_INDICATORS == INDICATORS);

impl ModelExchange for Unit {
    const STATES: &'static [Self::Real] = CONTINUOUS_STATES;
    const DERIVATIVES: &'static [Self::Real] = DERIVATIVES;
    const EVENT_INDICATORS: usize = EVENT_INDICATORS;

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn set_states(&mut self, states: &[f64]) {
        for (&state, &value) in CONTINUOUS_STATES.iter().zip(states) {
            if let Some(own) = self.continuous_state(state) {
                *own = value;
            }
        }
    }

    fn nominal(&self, state: RealVariable) -> f64 {
        use RealVariable as V;
        match state {
            V::Displacement | V::BaseDisplacement => 0.01,
            V::Velocity | V::BaseVelocity => 0.1,
            _ => 1000.0,
        }
    }

    fn event_indicators(&self, indicators: &mut [f64]) {
        indicators.copy_from_slice(&self.state.indicators(&self.floor));
    }

    fn update(&mut self, log: &mut Log<'_>) -> Result<Update, Failure> {
        self.tell_about_ignored_inputs(log);
        let load = self.load();
        let changed = self.state.event(&self.floor, load);
        if changed {
            let what = if self.state.branch == Branch::Elastic { "unloads" } else { "yields" };
            log.event(format_args!("{what} at t = {} s", self.time));
        }
        // some solvers restart only where states are reported as changed
        Ok(Update { states_changed: changed, ..Update::default() })
    }

    fn complete_step(&mut self, _log: &mut Log<'_>) -> Result<bool, Failure> {
        Ok(self.state.indicators(&self.floor).iter().any(|&indicator| indicator <= 0.0))
    }
}
