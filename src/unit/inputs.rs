//! The inputs of the unit.

use crate::wall::Support;

/// The present inputs, and their rates for the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Inputs {
    /// Ground acceleration, held over a step \[m/s²\].
    pub(super) ground: f64,
    pub(super) bottom: Input,
    pub(super) top: Input,
    pub(super) drift: Input,
}

/// A continuous input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Input {
    pub(super) value: f64,
    /// Rate for the next step; zero after it.
    pub(super) rate: f64,
    /// Rate over the last step, for output derivatives.
    pub(super) last_rate: f64,
}

impl Input {
    pub(super) fn set(&mut self, value: f64) {
        *self = Self { value, ..Self::default() };
    }

    /// Extrapolates the input to the end of a step of `duration` \[s\].
    pub(super) fn extrapolate(&mut self, duration: f64) {
        *self = Self { value: self.value + self.rate * duration, rate: 0.0, last_rate: self.rate };
    }
}

impl Inputs {
    /// Returns the supports' motion `ahead` seconds after the present, on top of the scene's `own`.
    pub(super) fn support(&self, own: Support, ahead: f64) -> Support {
        let at = |input: &Input| input.value + input.rate * ahead;
        Support {
            bottom: own.bottom + self.ground + at(&self.bottom),
            top: own.top + self.ground + at(&self.top),
            drift: own.drift + at(&self.drift),
        }
    }

    pub(super) fn rate(&self, pick: fn(&Input) -> f64) -> Support {
        Support { bottom: pick(&self.bottom), top: pick(&self.top), drift: pick(&self.drift) }
    }
}
