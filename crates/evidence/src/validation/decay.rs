//! A wall released from a displacement, against restitution and equivalent damping.

use files::tables;
use rocking_wall::solver::{Memo, Motion, State};
use rocking_wall::variables::{ForceLaw, RestitutionSource};
use rocking_wall::wall::{COMPUTED, Parameters, Wall};
use run::model::{RATIO_MODELS, label};

use super::Difference;
use crate::EvidenceError;
use run::bisection::first_true;
use run::free_motion::{advance, with_damping, with_restitution};

/// Step of the search for e, and its least value \[-\].
const E_STEP: f64 = 0.001;
const LEAST_E: u32 = 500;
/// Time between the states that are searched for passages and peaks \[s\].
const STEP: f64 = 0.005;
/// Most steps of a run.
const MOST_STEPS: usize = 20_000;
/// Halvings of a step.
const HALVINGS: u32 = 50;

tables! {
    /// A free decay.
    #[derive(Clone, Debug)]
    pub struct Decay {
        /// Time of the peak from which the model is released \[s\].
        pub start: f64,
        /// a₁ of the bilinear laws with viscous damping \[-\].
        pub a1: f64,
        /// e \[-\]; fitted where it is not given.
        #[key(exclusiveMinimum = 0, maximum = 1)]
        pub restitution: Option<f64>,
        /// Time \[s\], and displacement over thickness of a peak \[-\], from a file of their own; 0 at a
        /// passage of the vertical.
        #[serde(skip)]
        pub points: Vec<[f64; 2]>,
    }
}

/// A decay beside the model.
#[derive(Clone, Debug)]
pub struct DecayComparison {
    /// |u|/t of the peaks from the start on \[-\].
    pub peaks: Vec<f64>,
    /// Time between the passages before and after each peak \[s\], where both were measured.
    pub half_cycles: Vec<Option<f64>>,
    /// Restitution from each peak to the next that the rigid law implies \[-\].
    pub implied: Vec<f64>,
    /// Times between passages of the rigid law about the measured peaks, whatever e is \[s\].
    pub rigid_half_cycles: Vec<f64>,
    /// Whether e is fitted to the peaks.
    pub is_fitted: bool,
    /// Models.
    pub models: Vec<DecayModel>,
}

/// A model beside the peaks.
#[derive(Clone, Debug)]
pub struct DecayModel {
    /// Name.
    pub name: String,
    /// Coefficient of restitution: the model's own, or the one to which its damping is equivalent \[-\].
    pub restitution: f64,
    /// Damping ratio of viscous damping \[-\].
    pub damping: Option<f64>,
    /// |u|/t of the peaks, that of the start first \[-\].
    pub peaks: Vec<f64>,
    /// Times between passages, one for each peak after the start \[s\].
    pub half_cycles: Vec<f64>,
    /// Differences of the peaks after the start, over the thickness.
    pub difference: Difference,
}

impl Decay {
    /// Compares the peaks with the rigid law and restitution, and with the viscous damping that is equivalent
    /// by Eqs. (20)–(22). Two more runs have the calibrated and the analytic e, which are not fitted.
    ///
    /// # Errors
    /// [`EvidenceError`]: a wall that is refused, a peak beyond `u_ins`, or rest before the last peak.
    ///
    /// # Panics
    /// If there are fewer than two peaks from the start on.
    pub fn compare(&self, parameters: &Parameters) -> Result<DecayComparison, EvidenceError> {
        let points = &self.points;
        let is_peak = |[time, displacement]: [f64; 2]| time >= self.start && displacement != 0.0;
        let places: Vec<_> = (0..points.len()).filter(|&place| is_peak(points[place])).collect();
        let measured: Vec<f64> = places.iter().map(|&place| points[place][1].abs()).collect();
        assert!(measured.len() >= 2, "fewer than two peaks from the start on");
        let rigid = Parameters { force_law: ForceLaw::RigidLinear, a3: 1.0, ..parameters.clone() };
        let with = |e: f64| with_restitution(&rigid, e);
        let instability = Wall::new(&with(1.0))?.body().instability.positive / parameters.thickness;
        if let Some(&peak) = measured.iter().find(|peak| **peak >= instability) {
            return Err(EvidenceError::Peak { peak, instability });
        }
        let e = match self.restitution {
            Some(e) => e,
            None => fitted(&with, &measured)?,
        };
        let mut models = vec![model("restitution", e, None, &with(e), &measured)?];
        for kind in RATIO_MODELS {
            let ratio = kind.predicted_ratio(self.a1, e);
            let bilinear =
                Parameters { force_law: ForceLaw::Bilinear, a1: self.a1, a3: 1.0, ..parameters.clone() };
            let damped = with_damping(&bilinear, kind, ratio);
            models.push(model(label(kind).name, e, Some(ratio), &damped, &measured)?);
        }
        for (name, source) in
            [("calibrated e", RestitutionSource::Calibrated), ("analytic e", RestitutionSource::Analytic)]
        {
            let wall = Wall::new(&Parameters { restitution_source: source, ..with(COMPUTED) })?;
            let e = wall.restitution().positive;
            models.push(model(name, e, None, &with(e), &measured)?);
        }
        let wall = Wall::new(&with(e))?;
        // 1 − (1 − A)² is the energy at a peak A of u/u_ins, over that at u_ins
        let energy = |peak: f64| 1.0 - (1.0 - peak / instability).powi(2);
        let half_cycle =
            |peak: f64| 2.0 * libm::acosh(1.0 / (1.0 - peak / instability)) / wall.rocking_rate();
        let passage = |place: usize| points.get(place).filter(|point| point[1] == 0.0).map(|point| point[0]);
        let between = |&place: &usize| Some(passage(place + 1)? - passage(place.checked_sub(1)?)?);
        Ok(DecayComparison {
            half_cycles: places.iter().map(between).collect(),
            rigid_half_cycles: measured.iter().map(|peak| half_cycle(*peak)).collect(),
            implied: measured.windows(2).map(|pair| (energy(pair[1]) / energy(pair[0])).sqrt()).collect(),
            peaks: measured,
            is_fitted: self.restitution.is_none(),
            models,
        })
    }
}

/// Returns the e of least squares of the peaks, to 0.001.
fn fitted(with: &impl Fn(f64) -> Parameters, measured: &[f64]) -> Result<f64, EvidenceError> {
    let mut best = Err(EvidenceError::Rest { found: 0, expected: measured.len() - 1 });
    for step in LEAST_E..1000 {
        let e = E_STEP * f64::from(step);
        match model("", e, None, &with(e), measured) {
            Ok(model) if best.as_ref().is_ok_and(|(least, _)| *least <= model.difference.rms) => {}
            Ok(model) => best = Ok((model.difference.rms, e)),
            // a small e leaves no motion before the last peak
            Err(EvidenceError::Rest { .. }) if best.is_ok() => {}
            Err(error @ EvidenceError::Rest { .. }) => best = Err(error),
            Err(error) => return Err(error),
        }
    }
    best.map(|(_, e)| e)
}

/// Runs a model from the first of the measured peaks.
fn model(
    name: &str,
    restitution: f64,
    damping: Option<f64>,
    parameters: &Parameters,
    measured: &[f64],
) -> Result<DecayModel, EvidenceError> {
    let thickness = parameters.thickness;
    let first = measured.first().copied().unwrap_or_default();
    let (turns, passages) = released(parameters, first * thickness, measured.len().saturating_sub(1))?;
    let peaks: Vec<f64> = std::iter::once(first).chain(turns.iter().map(|turn| turn / thickness)).collect();
    let differences = peaks.iter().zip(measured).skip(1).map(|(peak, measured)| peak - measured);
    Ok(DecayModel {
        name: name.to_owned(),
        restitution,
        damping,
        difference: Difference::of(differences),
        peaks,
        half_cycles: passages.windows(2).map(|pair| pair[1] - pair[0]).collect(),
    })
}

/// Releases a wall; returns |u| at its next `count` turning points \[m\], and the times of its passages up to
/// the one after the last of them \[s\].
fn released(
    parameters: &Parameters,
    start: f64,
    count: usize,
) -> Result<(Vec<f64>, Vec<f64>), EvidenceError> {
    let motion = Motion::of(parameters, parameters.tolerance)?;
    let mut state = motion.start_under(start, 0.0, 0.0);
    let (mut peaks, mut passages, mut memo) = (Vec::new(), Vec::new(), Memo::default());
    for step in 0..MOST_STEPS {
        let before = state;
        advance(&motion, &mut state, STEP, &mut memo)?;
        let has_passed = |state: &State| before.displacement * state.displacement < 0.0;
        let has_turned = |state: &State| before.velocity * state.velocity < 0.0;
        if has_passed(&state) {
            passages.push(STEP * step as f64 + located(&motion, before, has_passed)?.0);
            if peaks.len() == count {
                return Ok((peaks, passages));
            }
        } else if has_turned(&state) {
            peaks.push(located(&motion, before, has_turned)?.1.displacement.abs());
        }
    }
    Err(EvidenceError::Rest { found: peaks.len(), expected: count })
}

/// Halves a step to the time at which something has happened; returns it and the state there.
fn located(
    motion: &Motion,
    before: State,
    has_happened: impl Fn(&State) -> bool,
) -> Result<(f64, State), EvidenceError> {
    let mut state = before;
    let time = first_true([0.0, STEP], HALVINGS, |time| {
        state = before;
        advance(motion, &mut state, time, &mut Memo::default()).map(|_| has_happened(&state))
    })?;
    Ok((time, state))
}
