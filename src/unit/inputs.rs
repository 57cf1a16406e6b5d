//! The inputs of the unit.

use fmu_export::Input;

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
