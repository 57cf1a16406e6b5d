//! Communication steps.

use super::{Instance, IntermediateUpdate};
use crate::access;
use crate::call::{Call, Phase};
use crate::failure::Failure;
use crate::limits;
use crate::log::{Category, Status};
use crate::model::{Model, Step};
use crate::variable::VariableId;

/// Largest relative difference between a communication point and the instance's own time: communication
/// points are sums of rounded steps.
const TIME_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Largest absolute difference \[s\]: some importers round time to nanoseconds.
const CLOCK_ROUNDING: f64 = 1e-9;
/// Shortest step that is computed \[s\]: over a shorter one nothing moves, but rates overflow.
const SHORTEST: f64 = 1e-30;

impl<M: Model> Instance<M> {
    /// Computes a step. Returns `true` where it ended early, at an event.
    pub fn do_step(&mut self, point: f64, size: f64) -> Result<bool, Failure> {
        self.begin_step(point, size)?;
        self.finish_step()
    }

    /// Checks a step. Returns the importer's callback that sets the inputs at the end of the step, and that
    /// time [s]; `None` without a callback.
    pub(crate) fn begin_step(
        &mut self,
        point: f64,
        size: f64,
    ) -> Result<Option<(IntermediateUpdate, f64)>, Failure> {
        self.pending = self.checked_step(point, size).inspect_err(|_| self.last_step = Status::Error)?;
        let asked = self.intermediate_update.clone().zip(self.pending.map(|(_, end)| end));
        if asked.is_some() {
            self.now.phase = Phase::IntermediateUpdateMode;
        }
        Ok(asked)
    }

    /// Computes the step that has begun. Returns `true` where it ended early, at an event.
    pub(crate) fn finish_step(&mut self) -> Result<bool, Failure> {
        self.now.phase = Phase::StepMode;
        let Some((step, end)) = self.pending.take() else {
            self.last_step = Status::Ok;
            return Ok(false);
        };
        let stepped = self.now.model.do_step(step, &mut self.logger.log());
        self.last_step = if stepped.is_ok() { Status::Ok } else { Status::Error };
        let event = stepped?;
        self.now.time = event.unwrap_or(end).max(step.from);
        Ok(event.is_some())
    }

    /// Sets inputs in Intermediate Update Mode: they change linearly to `values` at the end of the step.
    pub(super) fn set_at_end(&mut self, references: &[u32], values: &[f64]) -> Result<(), Failure> {
        let Some((step, _)) = self.pending else { return Ok(()) };
        for (&reference, &value) in references.iter().zip(values) {
            let variable: M::Real = access::find::<M, _>(reference)?;
            access::check_derivable_input(variable.variable())?;
            limits::check_real(variable.variable(), value)?;
            let rate = (value - self.now.model.real(variable)) / step.duration;
            if !(rate.is_finite() && self.now.model.set_input_derivative(variable, rate)) {
                let name = variable.variable().name;
                return Err(Failure(format!("{name} cannot change to {value:?} inside the step")));
            }
        }
        Ok(())
    }

    /// Returns the step and its end. `None` for a step too small to reach the instance's own time, or shorter
    /// than [`SHORTEST`]; some importers make steps of length 0 to evaluate outputs.
    fn checked_step(&self, point: f64, size: f64) -> Result<Option<(Step, f64)>, Failure> {
        // Times are shown as Debug does: Display spells 1e300 out.
        let time = self.now.time;
        let end = point + size;
        let why_not = if !(size.is_finite() && size >= 0.0) {
            format!("communicationStepSize = {size:?} s is not finite and at least 0 (time {time:?} s)")
        } else if !point.is_finite() {
            format!("currentCommunicationPoint = {point:?} s is not finite (time {time:?} s)")
        } else if (point - time).abs() > tolerance_at(point) {
            format!("currentCommunicationPoint = {point:?} s, but the last step ended at {time:?} s")
        } else if let Some(stop) = self.now.experiment.stop.filter(|&stop| end > stop + tolerance_at(stop)) {
            format!(
                "the step from {point:?} s by {size:?} s ends after the stopTime {stop:?} s of the experiment"
            )
        } else if !end.is_finite() {
            format!("the step from {point:?} s by {size:?} s has no finite end")
        } else {
            // The step starts at the instance's own time, so that no time is computed twice or left out.
            let duration = (point - time) + size;
            let step = Step { from: time, duration, may_end_early: self.purpose.early_return };
            return Ok((size >= SHORTEST && duration >= SHORTEST).then_some((step, end)));
        };
        Err(Failure(why_not))
    }

    /// Returns the time at which the last successful step ended \[s\].
    pub fn time(&self) -> f64 {
        self.now.time
    }

    /// Logs that there is no such status.
    pub(crate) fn no_status(&mut self, call: Call, kind: u32) {
        let text = format_args!("{}: there is no status of kind {kind}", call.name(self.purpose.version));
        self.logger.log().write(Status::Discard, Category::Discard, text);
    }
}

/// By how much a communication point may be off near `time` [s].
fn tolerance_at(time: f64) -> f64 {
    (TIME_ROUNDING * time.abs()).max(CLOCK_ROUNDING)
}
