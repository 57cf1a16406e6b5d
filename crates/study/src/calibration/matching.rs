//! Damping that matches one free vibration.

use rocking_wall::variables::{DampingModel, ForceLaw, Solver};
use rocking_wall::wall::{Parameters, Wall};
use run::free_motion::{with_damping, with_restitution};

use super::decay::Decay;
use super::error::CalibrationError;
use super::minimum::minimum;

/// Octaves that the scan for the least error goes to each side of the damping that Eqs. (20)–(23) predict.
const SCAN_OCTAVES: f64 = 1.25;
/// Steps of the scan in each octave.
const SCAN_STEPS: f64 = 8.0;
/// Value of −ln e below which the steps shrink in proportion. A decay of more cycles has more local minima,
/// which lie closer together: each is a damping with which the two motions stay in step for another while.
const SCAN_FEW_CYCLES: f64 = 0.06;
/// Smallest factor by which the steps shrink.
const SCAN_FINEST: f64 = 1.0 / 32.0;
/// Most further steps when the least error of a scan lies at its end.
const MOST_FURTHER: u32 = 400;
/// Relative tolerance of the minimiser. The samples of Eq. (18) meet the decay at different phases, and the
/// ripples that follow from it move the minimum by more: 1e-4 as a rule, 5e-3 at times, and 2e-2 near e = 1.
const TOLERANCE: f64 = 1e-5;

/// Damping that matches one decay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// End of the elastic branch a₁ \[-\]; 0 for the rigid-linear law.
    pub a1: f64,
    /// Initial displacement u₀/`u_ins` \[-\].
    pub start: f64,
    /// Coefficient of restitution e \[-\].
    pub restitution: f64,
    /// ξ, ξ₁ or c̄ \[-\].
    pub damping: f64,
    /// Err of Eq. (18) with it \[-\].
    pub error: f64,
    /// Number of samples compared.
    pub samples: usize,
}

/// One free vibration to match.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreeVibration {
    pub(super) a1: f64,
    pub(super) start: f64,
    pub(super) restitution: f64,
}

/// Returns a₁ of a law that has only its own: a multilinear law's first corner, 0 for the rigid-linear law.
pub(super) fn own_a1(parameters: &Parameters) -> Option<f64> {
    match &parameters.multilinear {
        Some(points) => points.iter().map(|point| point[0]).find(|&fraction| fraction > 0.0),
        None => (parameters.force_law == ForceLaw::RigidLinear).then_some(0.0),
    }
}

impl FreeVibration {
    /// Fits the damping of a model, comparing samples `step` \[s\] apart.
    pub(super) fn fit(
        &self,
        parameters: &Parameters,
        model: DampingModel,
        step: f64,
    ) -> Result<Fit, CalibrationError> {
        let Self { a1, start, restitution } = *self;
        let failed = |source| CalibrationError::Run { a1, start, restitution, source };
        let rocking = self.rocking(parameters)?;
        let reference = Decay::new(&rocking)?
            .samples(step)
            .map_err(failed)?
            .ok_or(CalibrationError::NoDecay { restitution, start, step })?;
        let error = |damping: f64, most: f64| -> Result<f64, CalibrationError> {
            let decay = Decay::new(&with_damping(&rocking, model, damping))?;
            decay.error(&reference, step, most).map_err(failed)
        };
        let bracket = self.bracket(model.predicted_ratio(a1, restitution), error)?;
        let (damping, error) = minimum(|damping| error(damping, f64::INFINITY), bracket, TOLERANCE)?;
        Ok(Fit { a1, start, restitution, damping, error, samples: reference.len() })
    }

    /// Returns the wall with restitution and no damping.
    fn rocking(&self, parameters: &Parameters) -> Result<Parameters, CalibrationError> {
        let a1 = if own_a1(parameters).is_none() { self.a1 } else { parameters.a1 };
        let rocking = Parameters {
            u_start: 0.0,
            u_dot_start: 0.0,
            solver: Solver::Automatic,
            a1,
            ..with_restitution(parameters, self.restitution)
        };
        let u_start = self.start * Wall::new(&rocking)?.body().instability.positive;
        Ok(Parameters { u_start, ..rocking })
    }

    /// Scans around the damping `expected` and returns the dampings on both sides of the least error. An
    /// error above the least so far is not computed to its end: it cannot be the least.
    fn bracket(
        &self,
        expected: f64,
        error: impl Fn(f64, f64) -> Result<f64, CalibrationError>,
    ) -> Result<[f64; 2], CalibrationError> {
        let shrunk = (-self.restitution.ln() / SCAN_FEW_CYCLES).clamp(SCAN_FINEST, 1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "10 to 320")]
        let reach = (SCAN_OCTAVES * SCAN_STEPS / shrunk).ceil() as u32;
        let step = (shrunk / SCAN_STEPS).exp2();
        // first the middle of the scan, beside whose error those at its ends are large
        let middle = error(expected, f64::INFINITY)?;
        let (mut scan, mut least_error) = (Vec::new(), middle);
        for n in 0..=2 * reach {
            let damping = expected * step.powf(f64::from(n) - f64::from(reach));
            let found = if n == reach { middle } else { error(damping, least_error)? };
            least_error = least_error.min(found);
            scan.push((damping, found));
        }
        for _ in 0..MOST_FURTHER {
            let least = (0..scan.len()).min_by(|&a, &b| scan[a].1.total_cmp(&scan[b].1)).unwrap_or(0);
            if least == 0 {
                let damping = scan[0].0 / step;
                scan.insert(0, (damping, error(damping, f64::INFINITY)?));
            } else if least + 1 == scan.len() {
                let damping = scan[least].0 * step;
                scan.push((damping, error(damping, f64::INFINITY)?));
            } else {
                return Ok([scan[least - 1].0, scan[least + 1].0]);
            }
        }
        let (low, high) = (scan[0].0, scan[scan.len() - 1].0);
        Err(CalibrationError::NoMinimum { restitution: self.restitution, a1: self.a1, low, high })
    }
}
