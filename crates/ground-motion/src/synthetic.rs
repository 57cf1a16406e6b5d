//! Synthetic motions: filtered noise with an envelope.
//!
//! 1. White noise: independent standard normal numbers, one at each step, by the Box–Muller transform of
//!    `SplitMix64` (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014)
//!    started at the seed.
//! 2. Envelope of Jennings, Housner and Tsai ("Simulated earthquake motions", Caltech, 1968): it rises with
//!    the square of time to 0.1 of the duration, stays 1 to 0.35 and decays exponentially to 0.01 at 0.8;
//!    then it is zero, so that the ground comes to rest.
//! 3. Soil layer of Kanai and Tajimi (Tajimi, 2nd World Conference on Earthquake Engineering, 1960) with the
//!    values for firm ground, ω = 15.6 rad/s, ζ = 0.6. The noise w drives it, its surface has the
//!    acceleration s.
//! 4. High-pass filter of Clough and Penzien ("Dynamics of structures", 1975), ω = 1.5 rad/s, ζ = 0.6. The
//!    surface drives it; the ground's acceleration is ÿ, so its displacement is y.
//! 5. Scaled to the peak.
//!
//! ```text
//! ẍ + 2 ζ ω ẋ + ω² x = −w,   s = −2 ζ ω ẋ − ω² x        (3)
//! ÿ + 2 ζ ω ẏ + ω² y = s                                (4)
//! ```
//!
//! The filters advance by the linear acceleration method, which integrates an acceleration that is linear
//! between samples without error, as a [`GroundMotion`] is. Its displacement is therefore y itself, which the
//! filter draws back to zero: the motion needs no other baseline correction.
//!
//! Only IEEE basic operations, square roots and the software functions of `libm` are used, in a fixed order:
//! the motion is the same bit for bit on every platform.

use std::f64::consts::TAU;

use crate::error::{GroundMotionError, check_parameter};
use crate::motion::{GroundMotion, floor_index};

/// ω of the soil layer of Kanai and Tajimi, firm ground (rad/s).
const SOIL: f64 = 15.6;
/// ω of the high-pass filter of Clough and Penzien (rad/s).
const HIGH_PASS: f64 = 1.5;
/// ζ of both.
const ZETA: f64 = 0.6;

/// Parts of the duration at which the envelope is full, begins to decay, and ends.
const FULL_FROM: f64 = 0.1;
const FULL_TO: f64 = 0.35;
const END: f64 = 0.8;
/// Logarithm of the envelope's decay from `FULL_TO` to `END`, to 1 %.
const DECAY: f64 = std::f64::consts::LN_10 * 2.0;

/// Recipe of a synthetic motion.
///
/// ```
/// use ground_motion::SyntheticMotion;
///
/// let motion = SyntheticMotion { seed: 7, peak: 2.0, ..SyntheticMotion::default() }.motion()?;
/// assert_eq!((motion.step(), motion.duration(), motion.peak()), (0.005, 30.0, 2.0));
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SyntheticMotion {
    /// Seed of the random numbers: another seed gives another motion of the same kind.
    pub seed: u64,
    /// Duration (s), from 10 to 600; the nearest whole number of steps is taken.
    pub duration: f64,
    /// Step (s), from 0.0005 to 0.02. Another step gives another motion.
    pub step: f64,
    /// Peak ground acceleration (m/s²).
    pub peak: f64,
}

impl Default for SyntheticMotion {
    fn default() -> Self {
        Self { seed: 1, duration: 30.0, step: 0.005, peak: 3.5 }
    }
}

impl SyntheticMotion {
    /// Makes the motion.
    ///
    /// # Errors
    /// If the duration, the step or the peak is outside its limits.
    pub fn motion(&self) -> Result<GroundMotion, GroundMotionError> {
        let Self { duration, step, peak, .. } = *self;
        check_parameter((10.0..=600.0).contains(&duration), "duration [s]", duration, "from 10 to 600")?;
        check_parameter((0.0005..=0.02).contains(&step), "step [s]", step, "from 0.0005 to 0.02")?;
        let intervals = floor_index((duration / step).round());
        let mut noise = Noise::new(self.seed);
        let (mut soil, mut ground) = (Filter::at_rest(SOIL), Filter::at_rest(HIGH_PASS));
        let mut samples = Vec::with_capacity(intervals + 1);
        // At rest until the first sample; the envelope starts at zero.
        samples.push(0.0);
        for index in 1..=intervals {
            let rock = noise.next() * envelope(index as f64 / intervals as f64);
            soil.step_to_load(-rock, step);
            ground.step_to_load(soil.spring_and_damper(), step);
            samples.push(ground.acceleration);
        }
        GroundMotion::new(step, samples)?.scaled_to_peak(peak)
    }
}

/// Computes the envelope at a time, given as a part of the duration.
fn envelope(part: f64) -> f64 {
    if part < FULL_FROM {
        (part / FULL_FROM) * (part / FULL_FROM)
    } else if part <= FULL_TO {
        1.0
    } else if part <= END {
        libm::exp(-DECAY * (part - FULL_TO) / (END - FULL_TO))
    } else {
        0.0
    }
}

/// A filter ẍ + 2 ζ ω ẋ + ω² x = p, and its state.
struct Filter {
    /// ω (rad/s).
    omega: f64,
    displacement: f64,
    velocity: f64,
    acceleration: f64,
}

impl Filter {
    fn at_rest(omega: f64) -> Self {
        Self { omega, displacement: 0.0, velocity: 0.0, acceleration: 0.0 }
    }

    /// Advances the filter by one step, over which its acceleration is linear; `load` is p at the end.
    fn step_to_load(&mut self, load: f64, step: f64) {
        let (omega, zeta) = (self.omega, ZETA);
        // v₁ = v₀ + Δt/2 (a₀ + a₁), x₁ = x₀ + Δt v₀ + Δt²/6 (2 a₀ + a₁)
        let velocity = self.velocity + step / 2.0 * self.acceleration;
        let displacement = self.displacement + step * self.velocity + step * step / 3.0 * self.acceleration;
        self.acceleration = (load - 2.0 * zeta * omega * velocity - omega * omega * displacement)
            / (1.0 + zeta * omega * step + omega * omega * step * step / 6.0);
        self.velocity = velocity + step / 2.0 * self.acceleration;
        self.displacement = displacement + step * step / 6.0 * self.acceleration;
    }

    /// Returns −2 ζ ω ẋ − ω² x.
    fn spring_and_damper(&self) -> f64 {
        -2.0 * ZETA * self.omega * self.velocity - self.omega * self.omega * self.displacement
    }
}

/// Standard normal numbers.
struct Noise {
    state: u64,
    /// The second number of a Box–Muller pair.
    spare: Option<f64>,
}

impl Noise {
    fn new(seed: u64) -> Self {
        Self { state: seed, spare: None }
    }

    fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = libm::sqrt(-2.0 * libm::log(self.uniform()));
        let angle = TAU * self.uniform();
        self.spare = Some(radius * libm::sin(angle));
        radius * libm::cos(angle)
    }

    /// Draws a number uniform in (0, 1].
    fn uniform(&mut self) -> f64 {
        const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;
        ((self.bits() >> 11) + 1) as f64 * UNIT
    }

    /// Draws 64 bits by `SplitMix64`.
    fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}
