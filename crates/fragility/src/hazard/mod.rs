//! Seismic hazard, and the annual rate at which a wall exceeds a limit state.
//!
//! A [`HazardCurve`] has the annual rates λ at which intensities are exceeded. With a lognormal fragility the
//! annual rate of the limit state is
//!
//! ```text
//! ∫ Φ(ln(x/θ)/β) |dλ(x)|
//! ```
//! On each segment λ is a power of x, and the integral has a closed form: see [`HazardCurve::rate`].
//!
//! ```
//! use fragility::hazard::HazardCurve;
//!
//! let points = vec![[0.05, 1.0 / 30.0], [0.1, 1.0 / 101.0], [0.2, 1.0 / 475.0], [0.4, 1.0 / 2475.0]];
//! let rate = HazardCurve::new(points)?.rate(0.4, 0.45);
//! assert!((rate.within() - 4.029_883_102_90e-4).abs() < 1e-14);
//! // what lies beyond the last point is known by its bounds alone
//! assert_eq!(rate.beyond[1], 1.0 / 2475.0);
//! # Ok::<(), fragility::hazard::HazardError>(())
//! ```

mod curve;
mod rate;

pub use curve::{HazardCurve, HazardError, SWAPPED};
pub use rate::{AgainstTarget, Rate, probability};

use serde::{Deserialize, Serialize};

/// Years of a probability where none are stated.
pub const YEARS: f64 = 50.0;

/// The hazard of a study, and what is asked of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hazard {
    /// Intensities, in SI units, and annual rates of exceedance \[1/year\].
    pub curve: HazardCurve,
    /// Years of the probabilities.
    pub years: f64,
    /// Annual rate that each limit state should not exceed \[1/year\].
    pub target: Option<f64>,
}
