//! Equivalence of restitution and viscous damping, section 5 of the paper, for any wall.
//!
//! A wall rocks freely from u₀ and loses energy at impacts. The same wall, on the same force law, loses it by
//! a damping ratio ξ instead. The ratio sought minimises
//!
//! ```text
//! Err = Σ (|u_CR|/u_ins − |u_EVD|/u_ins)²                                                Eq. (18)
//! ```
//!
//! over the samples of the decay. Over e the ratios follow ξ = −x ln e (Eq. 19), and over a₁ the coefficients
//! follow x = q a₁^r (Eqs. 20–22). For a free-standing block ξ stands for c̄ (Eq. 23).
//!
//! ```
//! use rocking_wall::{variables::DampingModel, wall::Parameters};
//! use run::parallel::threads;
//! use study::calibration::{Grid, calibrate};
//!
//! let grid = Grid { restitution: vec![0.85], a1: vec![0.03], ..Grid::default() };
//! let found = calibrate(&Parameters::default(), DampingModel::ConstantRatio, &grid, threads(None))?;
//! assert!((found.fits[0].damping - 0.04).abs() < 0.01);
//! # Ok::<(), study::calibration::CalibrationError>(())
//! ```

mod decay;
mod error;
pub mod figure;
mod matching;
mod minimum;
pub mod page;
pub mod table;

use std::num::NonZeroUsize;

use rocking_wall::variables::ForceLaw;
use rocking_wall::wall::Parameters;
use run::model::damping_models;
use run::parallel;

// a chart of a calibration names its model
pub use rocking_wall::variables::DampingModel;

pub use error::CalibrationError;
pub use matching::Fit;

use decay::DECAYED;
use matching::{FreeVibration, own_a1};
use minimum::minimum;

/// Default time between the samples that Eq. (18) compares \[s\].
pub const STEP: f64 = 0.01;

/// What the paper prints for x = q a₁^r in Eqs. (20)–(22): damping model, number of the equation, q and r.
pub const REGRESSIONS: [(DampingModel, u8, [f64; 2]); 3] = [
    (DampingModel::ConstantCoefficient, 20, [0.667, 0.450]),
    (DampingModel::ConstantRatio, 21, [0.350, 0.074]),
    (DampingModel::StiffnessProportional, 22, [0.218, -0.195]),
];
/// What the paper prints for x of a free-standing block, Eq. (23): c̄ = −1.55 ln e.
pub const FREE_STANDING: f64 = 1.55;

/// Values over which a wall is calibrated.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Coefficients of restitution e \[-\].
    pub restitution: Vec<f64>,
    /// Ends of the elastic branch a₁ \[-\]; unused for a multilinear or rigid-linear law, which has its own.
    pub a1: Vec<f64>,
    /// Initial displacements u₀/`u_ins` \[-\].
    pub start: Vec<f64>,
    /// Time between samples \[s\].
    pub step: f64,
}

impl Default for Grid {
    /// e = 0.80, 0.82 … 0.98; a₁ = 0.01 … 0.10; u₀ = 0.9 `u_ins`.
    fn default() -> Self {
        Self {
            restitution: (0..10).map(|index| f64::from(80 + 2 * index) / 100.0).collect(),
            a1: vec![0.01, 0.015, 0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.10],
            start: vec![0.9],
            step: STEP,
        }
    }
}

impl Grid {
    /// Checks the values for a damping model.
    ///
    /// # Errors
    /// [`CalibrationError`] of a list that is empty, or of a value out of range.
    pub fn check(&self, model: DampingModel) -> Result<(), CalibrationError> {
        if model == DampingModel::None {
            return Err(CalibrationError::NoDamping);
        }
        let lists = [
            ("e", &self.restitution, [0.0, 1.0]),
            ("a1", &self.a1, [0.0, 1.0]),
            ("u0/u_ins", &self.start, [DECAYED, 1.0]),
            ("step", &vec![self.step], [0.0, 10.0]),
        ];
        for (name, values, [low, high]) in lists {
            if values.is_empty() && name != "a1" {
                return Err(CalibrationError::Empty { name });
            }
            if let Some(&value) = values.iter().find(|&&value| !(value > low && value < high)) {
                return Err(CalibrationError::Range { name, value, low, high });
            }
        }
        Ok(())
    }
}

/// x of Eq. (19) at one a₁ and one initial displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    /// a₁ \[-\].
    pub a1: f64,
    /// u₀/`u_ins` \[-\].
    pub start: f64,
    /// x by least squares through the origin \[-\].
    pub x: f64,
}

/// Power law x = q a₁^r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// q \[-\].
    pub q: f64,
    /// r \[-\].
    pub r: f64,
}

/// Result of a calibration for one damping model.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Damping model.
    pub model: DampingModel,
    /// One fit for each a₁, u₀ and e, in this order.
    pub fits: Vec<Fit>,
    /// One coefficient for each a₁ and u₀.
    pub coefficients: Vec<Coefficient>,
    /// u₀/`u_ins` and law of each u₀ that has at least two values of a₁.
    pub laws: Vec<(f64, PowerLaw)>,
}

/// Calibrates a damping model of a wall over a grid on `threads` threads. The result does not depend on their
/// number.
///
/// # Errors
/// [`CalibrationError`] if the grid or the wall is invalid, a run fails, or a decay or a minimum is not
/// found.
pub fn calibrate(
    parameters: &Parameters,
    model: DampingModel,
    grid: &Grid,
    threads: NonZeroUsize,
) -> Result<Calibration, CalibrationError> {
    grid.check(model)?;
    let own = own_a1(parameters);
    let a1 = own.as_ref().map_or(grid.a1.as_slice(), std::slice::from_ref);
    if a1.is_empty() {
        return Err(CalibrationError::Empty { name: "a1" });
    }
    let mut cases = Vec::new();
    for &a1 in a1 {
        for &start in &grid.start {
            let case = |&restitution| FreeVibration { a1, start, restitution };
            cases.extend(grid.restitution.iter().map(case));
        }
    }
    let fit = |index: usize| cases[index].fit(parameters, model, grid.step);
    let fits = parallel::map(cases.len(), threads.get(), fit)?;
    Ok(Calibration::new(model, fits))
}

/// Returns the damping models that a wall can be calibrated for: with the rigid-linear law only that of a
/// free-standing block.
pub fn calibrated_models(parameters: &Parameters) -> Vec<DampingModel> {
    let is_rigid = parameters.multilinear.is_none() && parameters.force_law == ForceLaw::RigidLinear;
    damping_models().filter(|model| model.needs_elastic_branch() != is_rigid).collect()
}

/// Returns the damping model with a name of the model description.
///
/// # Errors
/// [`CalibrationError::UnknownModel`].
pub fn model_named(name: &str) -> Result<DampingModel, CalibrationError> {
    DampingModel::from_name(name).ok_or_else(|| CalibrationError::UnknownModel {
        name: name.to_owned(),
        models: damping_models().map(DampingModel::name).collect::<Vec<_>>().join(", "),
    })
}

impl Calibration {
    /// Makes a calibration from its fits, one for each a₁, u₀ and e, in this order.
    pub fn new(model: DampingModel, fits: Vec<Fit>) -> Self {
        let coefficients: Vec<Coefficient> = fits
            .chunk_by(|a, b| (a.a1, a.start) == (b.a1, b.start))
            .map(|fits| Coefficient { a1: fits[0].a1, start: fits[0].start, x: coefficient(fits) })
            .collect();
        let law = |first: &Coefficient| {
            let same = coefficients.iter().filter(|c| c.start == first.start);
            let points: Vec<_> = same.map(|c| (c.a1, c.x)).collect();
            PowerLaw::fit(&points).map(|law| (first.start, law))
        };
        let starts = coefficients.iter().take_while(|c| c.a1 == coefficients[0].a1);
        let laws = starts.filter_map(law).collect();
        Self { model, fits, coefficients, laws }
    }
}

/// Returns x of ξ = −x ln e, Eq. (19), by least squares through the origin: Σ ξ (−ln e)/Σ (ln e)².
pub fn coefficient(fits: &[Fit]) -> f64 {
    let (products, squares) = fits.iter().fold((0.0, 0.0), |(products, squares), fit| {
        let logarithm = -fit.restitution.ln();
        (products + fit.damping * logarithm, squares + logarithm * logarithm)
    });
    products / squares
}

impl PowerLaw {
    /// Fits points (a₁, x) by least squares of x itself, as the paper's nonlinear regression does. Since q is
    /// linear for any r, a scalar minimiser finds r. Returns `None` for fewer than two different a₁, or for
    /// values that are not positive.
    pub fn fit(points: &[(f64, f64)]) -> Option<Self> {
        let positive = |&(a1, x): &(f64, f64)| a1 > 0.0 && x > 0.0 && a1.is_finite() && x.is_finite();
        if !points.iter().any(|point| point.0 != points[0].0) || !points.iter().all(positive) {
            return None;
        }
        let factor = |r: f64| {
            let (products, squares) = points.iter().fold((0.0, 0.0), |(products, squares), &(a1, x)| {
                (products + x * a1.powf(r), squares + a1.powf(2.0 * r))
            });
            products / squares
        };
        let residual = |r: f64| {
            let q = factor(r);
            Ok(points.iter().map(|&(a1, x)| (x - q * a1.powf(r)).powi(2)).sum())
        };
        let r = minimum(residual, [-3.0, 3.0], 1e-9).ok()?.0;
        Some(Self { q: factor(r), r })
    }

    /// Returns x at a₁.
    pub fn at(&self, a1: f64) -> f64 {
        self.q * a1.powf(self.r)
    }
}
