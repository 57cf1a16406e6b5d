//! Communication steps.

use super::Instance;
use crate::call::Call;
use crate::failure::Failure;
use crate::log::{Category, Status};
use crate::model::{Model, Step};

/// Communication points are sums of rounded steps: they may differ from the own time by this much of it.
const TIME_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Importers that count time in nanoseconds round it to them \[s\].
const CLOCK_ROUNDING: f64 = 1e-9;

impl<M: Model> Instance<M> {
    pub(crate) fn do_step(&mut self, point: f64, size: f64) -> Result<(), Failure> {
        let stepped = self.try_step(point, size);
        self.last_step = if stepped.is_ok() { Status::Ok } else { Status::Error };
        stepped
    }

    fn try_step(&mut self, point: f64, size: f64) -> Result<(), Failure> {
        // Times are shown as Debug does: Display spells 1e300 out.
        let time = self.now.time;
        if !(size.is_finite() && size > 0.0) {
            return Err(Failure(format!(
                "communicationStepSize = {size:?} s is not finite and above 0 (time {time:?} s)"
            )));
        }
        if !point.is_finite() {
            return Err(Failure(format!(
                "currentCommunicationPoint = {point:?} s is not finite (time {time:?} s)"
            )));
        }
        if (point - time).abs() > tolerance_at(point) {
            return Err(Failure(format!(
                "currentCommunicationPoint = {point:?} s, but the last step ended at {time:?} s"
            )));
        }
        let end = point + size;
        if let Some(stop) = self.now.experiment.stop.filter(|&stop| end > stop + tolerance_at(stop)) {
            return Err(Failure(format!(
                "the step from {point:?} s by {size:?} s ends after the stopTime {stop:?} s given to \
                 fmi2SetupExperiment"
            )));
        }
        if !end.is_finite() {
            return Err(Failure(format!("the step from {point:?} s by {size:?} s has no finite end")));
        }
        // From the own time, so that no step is computed twice or left out.
        let duration = (point - time) + size;
        if duration > 0.0 {
            self.now.model.do_step(Step { from: time, duration }, &mut self.logger.log())?;
            self.now.time = end.max(time);
        }
        Ok(())
    }

    /// How the last step ended.
    pub(crate) fn last_step(&self) -> Status {
        self.last_step
    }

    /// Where the last successful step ended [s].
    pub(crate) fn time(&self) -> f64 {
        self.now.time
    }

    /// Logs that there is no such status.
    pub(crate) fn no_status(&mut self, call: Call, kind: u32) {
        let text = format_args!("{}: there is no status of kind {kind}", call.name());
        self.logger.log().write(Status::Discard, Category::Discard, text);
    }
}

/// By how much a communication point may be off near `time` [s].
fn tolerance_at(time: f64) -> f64 {
    (TIME_ROUNDING * time.abs()).max(CLOCK_ROUNDING)
}
