//! The linear oscillator under a load that is linear in time, in closed form.
//!
//! ```text
//! ü + c u̇ + k u = p₀ + p₁ t
//! ```
//!
//! Damping c and stiffness k are per unit mass. Stiffness may be positive, zero or negative, and damping may
//! be below, at or above the critical one. An [`Oscillator`] gives the motion exactly, whatever the duration:
//! [its Green's functions](Oscillator::green), [the motion after a time](Oscillator::propagate), [its Taylor
//! series](Oscillator::series_from), and [bounds on acceleration and jerk](Oscillator::bounds). All is plain
//! data; the crate has no dependencies.
//!
//! ```
//! use oscillator::{KinematicState, Oscillator};
//!
//! // one second in free vibration from u = 0.01 m at rest: T = 0.5 s, 5 % of critical damping
//! let omega = std::f64::consts::TAU / 0.5;
//! let oscillator = Oscillator::new(2.0 * 0.05 * omega, omega * omega);
//! // ü₀ = p₀ − c u̇₀ − k u₀
//! let start = KinematicState { displacement: 0.01, velocity: 0.0, acceleration: -omega * omega * 0.01 };
//! let end = oscillator.propagate(start, 0.0, 1.0);
//! // two cycles decay by e^{−2 · 2π ξ}
//! assert!((end.displacement / 0.01 - 0.5335).abs() < 2e-3);
//!
//! // two steps make one
//! let middle = oscillator.propagate(start, 0.0, 0.3);
//! let again = oscillator.propagate(middle, 0.0, 0.7);
//! assert!((again.displacement - end.displacement).abs() < 1e-15);
//! ```
//!
//! # Formulas
//! With G the response to a unit impulse, H = ∫G and J = ∫H, and ü₀ taken from the equation itself,
//! ```text
//! u(t) = u₀ + (G + cH) u̇₀ + H ü₀ + J p₁
//! u̇(t) = (1 − kH) u̇₀ + G ü₀ + H p₁
//! ü(t) = −kG u̇₀ + (1 − cG − kH) ü₀ + G p₁
//! ```
//! There is no particular solution to subtract, so rest stays rest bit for bit and k → 0 is no special case.
//! Between the samples of a load that is linear there, this is the exact recursion of N. C. Nigam and P. C.
//! Jennings (Calculation of response spectra from strong-motion earthquake records. Bulletin of the
//! Seismological Society of America 59(2), 1969, 909–922), without the cancellation of its printed
//! coefficients over short steps.
//!
//! Where the motion is a sum of two exponentials, e^{r₁t} and e^{r₂t}, products of large G and H would
//! cancel. There α = ü − r₂ u̇ and β = ü − r₁ u̇ obey α̇ = r₁ α + p₁ and β̇ = r₂ β + p₁, each on its own, and
//! ```text
//! u̇ = (α − β)/(r₁ − r₂),   ü = (r₁ α − r₂ β)/(r₁ − r₂)
//! ```
//! Their integrals are the functions φₙ of exponential integrators (M. Hochbruck, A. Ostermann: Exponential
//! integrators. Acta Numerica 19, 2010, 209–286, Section 2).

mod green;
mod kinematic_state;
mod oscillator;
mod polynomial;

pub use green::Green;
pub use kinematic_state::KinematicState;
pub use oscillator::{Oscillator, Regime};
pub use polynomial::{HIGHEST_ORDER, Polynomial};
