#![doc = include_str!("../README.md")]
//!
//! # Fragilities
//! A fragility is empirical, in steps, or a lognormal curve fitted by maximum likelihood:
//!
//! ```text
//! P(exceeded | IM = x) = Φ(ln(x/θ)/β)
//! ```
//! J. W. Baker: Efficient analytical fragility function fitting using dynamic structural analysis. Earthquake
//! Spectra 31(1), 2015, 579–599.
//!
//! Limit states of the same runs have each their own β, or one for all, or dispersions with which their
//! curves do not cross: see [`Dispersion`]. Those of a [`Cloud`] follow from a regression.
//!
//! ```
//! use fragility::Exceedance::{Above, At};
//! use fragility::{Sample, fit};
//!
//! // two records exceed the limit state at 2 and at 4 m/s², a third one does not up to 5 m/s²
//! let curve = fit(&Sample::of_records(vec![At(2.0), At(4.0), Above(5.0)]))?;
//! assert!(curve.median > 3.0 && curve.probability(curve.median) == 0.5);
//! # Ok::<(), fragility::FitError>(())
//! ```

mod bootstrap;
mod class;
mod cloud;
mod compare;
mod curve;
mod dispersion;
mod fit;
pub mod hazard;
pub mod linear;
mod normal;
mod sample;
mod term;
mod weights;

pub use bootstrap::{Bootstrap, FEWEST_RECORDS, Interval, Resampled};
pub use class::{ClassResamples, FragilityFunction, StateCurve};
pub use cloud::{Cloud, Regression};
pub use compare::{CONFIDENCE, Summary, compare, compare_clouds, covariance};
pub use curve::{Crossing, Curve, Exceedance, Run, SENSITIVE_ABOVE, TieDemand};
pub use dispersion::{CurveCrossing, Dispersion, Estimator, TAIL};
pub use fit::{FitError, Lognormal, fit, fit_jointly};
pub use normal::{cumulative, quantile};
pub use sample::{Sample, median};
pub use weights::Weights;
