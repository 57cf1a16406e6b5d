//! Model Exchange: time, states, derivatives and events.

use super::Instance;
use crate::access;
use crate::failure::Failure;
use crate::limits;
use crate::model::{Interface, ModelExchange, Update};
use crate::variable::{FIRST_INDICATOR_REFERENCE, TIME_REFERENCE, VariableId};

impl<M: ModelExchange> Instance<M> {
    /// In co-simulation the model handles its events inside the steps, and there is nothing to update.
    pub fn update(&mut self) -> Result<Update, Failure> {
        match self.purpose.interface {
            Interface::ModelExchange => self.now.model.update(&mut self.logger.log()),
            Interface::CoSimulation => Ok(Update::default()),
        }
    }

    /// Completes a step of the solver. Returns whether the model asks for Event Mode.
    pub fn complete_step(&mut self) -> Result<bool, Failure> {
        self.now.model.complete_step(&mut self.logger.log())
    }

    /// The stop time is no limit: solvers try times beyond it and come back.
    pub fn set_time(&mut self, time: f64) -> Result<(), Failure> {
        if !time.is_finite() {
            return Err(Failure(format!("time = {time:?} s is not finite")));
        }
        self.now.time = time;
        self.now.model.set_time(time);
        Ok(())
    }

    /// Sets the continuous states.
    pub fn set_states(&mut self, states: &[f64]) -> Result<(), Failure> {
        check_count("continuous states", states.len(), M::STATES.len())?;
        for (value, state) in states.iter().zip(M::STATES) {
            limits::finite(state.variable(), *value)?;
        }
        self.now.model.set_states(states);
        Ok(())
    }

    /// Writes the continuous states.
    pub fn states(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        self.read("continuous states", M::STATES, values)
    }

    /// Writes their time derivatives.
    pub fn derivatives(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        self.read("derivatives", M::DERIVATIVES, values)
    }

    /// Writes their nominal values.
    pub fn nominals(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("continuous states", values.len(), M::STATES.len())?;
        for (value, &state) in values.iter_mut().zip(M::STATES) {
            *value = self.now.model.nominal(state);
        }
        Ok(())
    }

    /// Writes the event indicators.
    pub fn event_indicators(&mut self, values: &mut [f64]) -> Result<(), Failure> {
        check_count("event indicators", values.len(), M::EVENT_INDICATORS)?;
        self.calculate()?;
        self.now.model.event_indicators(values);
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(Failure(format!("an event indicator, {value:?}, is not a finite number"))),
            None => Ok(()),
        }
    }

    /// The values of `get_real`, and of the variables that FMI 3.0 has besides those of the
    /// model.
    pub fn get_float64(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Failure> {
        self.calculate()?;
        for (&reference, value) in references.iter().zip(values) {
            *value = match self.number(reference)? {
                Some(value) => value,
                None if reference == TIME_REFERENCE => self.now.time,
                None => self.event_indicator(reference)?,
            };
        }
        Ok(())
    }

    fn event_indicator(&mut self, reference: u32) -> Result<f64, Failure> {
        let index = reference.checked_sub(FIRST_INDICATOR_REFERENCE).map(|index| index as usize);
        let mut indicators = vec![0.0; M::EVENT_INDICATORS];
        let index = index.filter(|&index| index < indicators.len());
        let index = index.ok_or_else(|| access::unknown::<M>(reference))?;
        self.event_indicators(&mut indicators)?;
        Ok(indicators[index])
    }

    fn read(&mut self, what: &str, variables: &[M::Real], values: &mut [f64]) -> Result<(), Failure> {
        check_count(what, values.len(), variables.len())?;
        self.calculate()?;
        for (value, &variable) in values.iter_mut().zip(variables) {
            *value = limits::finite(variable.variable(), self.now.model.real(variable))?;
        }
        Ok(())
    }
}

fn check_count(what: &str, given: usize, there: usize) -> Result<(), Failure> {
    if given == there {
        Ok(())
    } else {
        Err(Failure(format!("{given} {what} requested, but the model has {there}")))
    }
}
