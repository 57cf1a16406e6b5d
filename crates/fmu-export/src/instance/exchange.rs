//! Model Exchange: time, states, derivatives and events.

use super::Instance;
use crate::call::Phase;
use crate::failure::Failure;
use crate::limits;
use crate::model::{ModelExchange, Update};
use crate::variable::VariableId;

impl<M: ModelExchange> Instance<M> {
    pub(crate) fn enter_event_mode(&mut self) {
        self.now.phase = Phase::EventMode;
    }

    pub(crate) fn update(&mut self) -> Result<Update, Failure> {
        self.now.model.update(&mut self.logger.log())
    }

    pub(crate) fn enter_continuous_time_mode(&mut self) {
        self.now.phase = Phase::ContinuousTimeMode;
    }

    /// True asks for Event Mode.
    pub(crate) fn complete_step(&mut self) -> Result<bool, Failure> {
        self.now.model.complete_step(&mut self.logger.log())
    }

    /// The stop time is no limit: solvers try times beyond it and come back.
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), Failure> {
        if !time.is_finite() {
            return Err(Failure(format!("time = {time:?} s is not finite")));
        }
        self.now.time = time;
        self.now.model.set_time(time);
        Ok(())
    }

    pub(crate) fn set_states(&mut self, states: &[f64]) -> Result<(), Failure> {
        check_count("continuous states", states.len(), M::STATES.len())?;
        for (value, state) in states.iter().zip(M::STATES) {
            limits::finite(state.variable(), *value)?;
        }
        self.now.model.set_states(states);
        Ok(())
    }

    pub(crate) fn states(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("continuous states", values.len(), M::STATES.len())?;
        self.read(M::STATES, values)
    }

    pub(crate) fn derivatives(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("derivatives", values.len(), M::DERIVATIVES.len())?;
        self.read(M::DERIVATIVES, values)
    }

    pub(crate) fn nominals(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("continuous states", values.len(), M::STATES.len())?;
        for (value, &state) in values.iter_mut().zip(M::STATES) {
            *value = self.now.model.nominal(state);
        }
        Ok(())
    }

    pub(crate) fn event_indicators(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("event indicators", values.len(), M::EVENT_INDICATORS)?;
        self.calculate()?;
        self.now.model.event_indicators(values);
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(Failure(format!("an event indicator, {value:?}, is not a finite number"))),
            None => Ok(()),
        }
    }

    fn read(&mut self, variables: &[M::Real], values: &mut [f64]) -> Result<(), Failure> {
        self.calculate()?;
        for (value, &variable) in values.iter_mut().zip(variables) {
            *value = limits::finite(variable.variable(), self.now.model.real(variable))?;
        }
        Ok(())
    }
}

fn check_count(what: &str, given: usize, there: usize) -> Result<(), Failure> {
    if given == there { Ok(()) } else { Err(Failure(format!("{given} {what} asked for: there are {there}"))) }
}
