//! The damping that matches one free vibration.

use rocking_wall::variables::{DampingModel, DampingSource, Impact, RestitutionSource, Solver};
use rocking_wall::wall::{Parameters, Wall, equivalence};

use super::decay::Decay;
use super::minimum::minimum;
use super::{CalibrationError, Fit, own_a1};

/// The scan for the basin of the least: so many octaves to each side of the prediction of Eqs. (20)–(23), so many steps in each.
const SCAN_OCTAVES: f64 = 1.25;
const SCAN_STEPS: f64 = 8.0;
/// Below this −ln e the steps shrink in proportion: the more cycles a decay has, the closer together lie the dampings with
/// which the two motions get out of step, each with a least of its own.
const SCAN_FEW_CYCLES: f64 = 0.06;
/// How far they may shrink.
const SCAN_FINEST: f64 = 1.0 / 32.0;
/// Most further steps when the least of a scan lies at its end.
const MOST_FURTHER: u32 = 400;
/// Relative tolerance of the minimiser. Ripples of Eq. (18), whose samples meet the decay at different phases, move the least by
/// more: 1e-4 as a rule, 5e-3 at times, and 2e-2 near e = 1.
const TOLERANCE: f64 = 1e-5;

/// One free vibration to be matched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) a1: f64,
    pub(super) start: f64,
    pub(super) restitution: f64,
}

impl Case {
    pub(super) fn fit(
        &self,
        parameters: &Parameters,
        model: DampingModel,
        step: f64,
    ) -> Result<Fit, CalibrationError> {
        let failed = |source| {
            let Self { a1, start, restitution } = *self;
            CalibrationError::Run { a1, start, restitution, source }
        };
        let rocking = self.rocking(parameters)?;
        let Self { a1, start, restitution } = *self;
        let reference = Decay::new(&rocking)?
            .samples(step)
            .map_err(failed)?
            .ok_or(CalibrationError::NoDecay { restitution, start, step })?;
        let damped = |damping: f64| Parameters {
            damping_model: model,
            damping_source: DampingSource::Given,
            xi: damping,
            c_bar: damping,
            impact: Impact::None,
            ..rocking.clone()
        };
        let error = |damping: f64| -> Result<f64, CalibrationError> {
            let decay = Decay::new(&damped(damping))?;
            decay.difference(&reference, step).map_err(failed)
        };
        let expected = equivalence::predicted(model, self.a1, self.restitution);
        let bracket = self.bracket(expected, error)?;
        let (damping, error) = minimum(error, bracket, TOLERANCE)?;
        Ok(Fit { a1, start, restitution, damping, error, samples: reference.len() })
    }

    /// The wall with restitution and no damping.
    fn rocking(&self, parameters: &Parameters) -> Result<Parameters, CalibrationError> {
        let mut rocking = Parameters {
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            restitution_source: RestitutionSource::Given,
            restitution: self.restitution,
            u_start: 0.0,
            u_dot_start: 0.0,
            solver: Solver::Automatic,
            ..parameters.clone()
        };
        if own_a1(parameters).is_none() {
            rocking.a1 = self.a1;
        }
        rocking.u_start = self.start * Wall::new(&rocking)?.body().instability.positive;
        Ok(rocking)
    }

    /// The damping on both sides of the least error of a scan around `expected`.
    fn bracket(
        &self,
        expected: f64,
        error: impl Fn(f64) -> Result<f64, CalibrationError>,
    ) -> Result<[f64; 2], CalibrationError> {
        let shrunk = (-self.restitution.ln() / SCAN_FEW_CYCLES).clamp(SCAN_FINEST, 1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "10 to 320")]
        let reach = (SCAN_OCTAVES * SCAN_STEPS / shrunk).ceil() as u32;
        let step = (shrunk / SCAN_STEPS).exp2();
        let mut scan = Vec::new();
        let mut damping = expected * step.powf(-f64::from(reach));
        for _ in 0..=2 * reach {
            scan.push((damping, error(damping)?));
            damping *= step;
        }
        for _ in 0..MOST_FURTHER {
            let least = (0..scan.len()).min_by(|&a, &b| scan[a].1.total_cmp(&scan[b].1)).unwrap_or(0);
            if least == 0 {
                let damping = scan[0].0 / step;
                scan.insert(0, (damping, error(damping)?));
            } else if least + 1 == scan.len() {
                let damping = scan[least].0 * step;
                scan.push((damping, error(damping)?));
            } else {
                return Ok([scan[least - 1].0, scan[least + 1].0]);
            }
        }
        let (low, high) = (scan[0].0, scan[scan.len() - 1].0);
        Err(CalibrationError::NoMinimum { restitution: self.restitution, a1: self.a1, low, high })
    }
}
