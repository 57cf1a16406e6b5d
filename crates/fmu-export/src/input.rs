//! A continuous input of a co-simulation.

use crate::failure::Failure;
use crate::state::StateCodec;

/// A continuous input, which an importer may extrapolate over a step by its rate.
///
/// ```
/// use fmu_export::Input;
///
/// let mut ground = Input::default();
/// ground.set(1.0);
/// ground.rate = 20.0;
/// ground.extrapolate(0.1);
/// assert_eq!((ground.value, ground.rate, ground.last_rate), (3.0, 0.0, 20.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The value at the present, in the unit of the input.
    pub value: f64,
    /// Rate for the next step, in that unit per second; zero after it.
    pub rate: f64,
    /// Rate over the last step, for output derivatives.
    pub last_rate: f64,
}

impl Input {
    /// Sets the value, and both rates to zero.
    // as the next one, inlined into crates that are optimised in development: this one is not
    #[inline]
    pub fn set(&mut self, value: f64) {
        *self = Self { value, ..Self::default() };
    }

    /// Extrapolates the input to the end of a step of `duration` \[s\].
    #[inline]
    pub fn extrapolate(&mut self, duration: f64) {
        // An input that is held is not written again. The next step would have to wait until these numbers
        // are stored: a fifth of a step.
        if self.rate != 0.0 || self.last_rate != 0.0 {
            *self = Self { value: self.value + self.rate * duration, rate: 0.0, last_rate: self.rate };
        }
    }

    /// Writes or reads the input as part of a state.
    ///
    /// # Errors
    /// If the bytes end too early.
    pub fn transfer(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        codec.f64s([&mut self.value, &mut self.rate, &mut self.last_rate])
    }
}
