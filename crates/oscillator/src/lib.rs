#![doc = include_str!("../README.md")]
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
mod oscillator;
mod polynomial;

pub use green::Green;
pub use oscillator::{Oscillator, Regime};
pub use polynomial::{Bounds, HIGHEST_ORDER, KinematicState, Polynomial};
