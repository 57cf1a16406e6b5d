//! The demand of a limit state at the place of a wall.

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, Maxima, Spectrum};

use super::floor::FloorSpectrum;
use super::ground::GroundSpectrum;
use crate::error::CheckError;
use crate::file::site::interpolated;
use crate::words::names::LimitState;

/// Fewest records whose mean counts, NTC 7.3.5; of fewer it is the envelope.
pub const MEAN_COUNTS_FROM: usize = 7;

/// Longest period for which NTC 3.2.3.2 admits its spectra \[s\].
pub(crate) const LONGEST_PERIOD: f64 = 4.0;

/// Periods at which the largest `S_d` between T0 and `T_SLV` is searched.
const SEARCHED: u32 = 200;

/// What a limit state demands at the place of a wall.
#[derive(Clone, Debug)]
pub enum Demand {
    /// On the ground, NTC 3.2.3.2.
    Ground(GroundSpectrum),
    /// At a height, C7.2.3.
    Floor(FloorSpectrum),
    /// Points (T, `S_a`) of one damping \[s, m/s²\].
    Points(Vec<(f64, f64)>, f64),
    /// The mean spectrum of records at the wall's place, or their envelope.
    Records(Vec<GroundMotion>),
}

/// The demands of SLD, SLV and SLC; `None` for one that is not stated.
pub(crate) type Demands = [Option<Demand>; 3];

impl Demand {
    /// The spectrum of the ground by the code, where the demand comes from it.
    pub fn ground(&self) -> Option<&GroundSpectrum> {
        match self {
            Self::Ground(ground) => Some(ground),
            Self::Floor(floor) => Some(floor.ground()),
            Self::Points(..) | Self::Records(_) => None,
        }
    }

    /// The spectrum at a height of the building, if it is one.
    pub fn floor(&self) -> Option<&FloorSpectrum> {
        if let Self::Floor(floor) = self { Some(floor) } else { None }
    }

    /// The acceleration at T = 0: `a_g` S, or `a_Z` \[m/s²\].
    pub fn peak(&self) -> f64 {
        match self {
            Self::Ground(ground) => ground.acceleration(0.0, 0.05),
            Self::Floor(floor) => floor.peak_acceleration(),
            Self::Points(points, _) => points[0].1,
            Self::Records(records) => combined(records.iter().map(GroundMotion::peak).collect()),
        }
    }

    /// The longest period that it has a value for; infinite where there is no end \[s\].
    pub fn last_period(&self) -> f64 {
        match self {
            Self::Points(points, _) => points[points.len() - 1].0,
            Self::Ground(_) | Self::Floor(_) | Self::Records(_) => f64::INFINITY,
        }
    }

    /// Whether it has values of the damping ξ.
    pub(crate) fn has_damping(&self, xi: f64) -> bool {
        if let Self::Points(_, given) = self { (given - xi).abs() <= 1e-9 } else { true }
    }

    /// The acceleration at a period, of the damping ξ \[m/s²\].
    ///
    /// # Errors
    /// [`CheckError`] of points with another damping or without the period, and of records.
    pub fn acceleration(&self, state: LimitState, period: f64, xi: f64) -> Result<f64, CheckError> {
        match self {
            _ if period == 0.0 => Ok(self.peak()),
            Self::Ground(ground) => Ok(ground.acceleration(period, xi)),
            Self::Floor(floor) => Ok(floor.acceleration(period, xi)),
            Self::Points(points, given) => {
                if !self.has_damping(xi) {
                    let (needed, given) = (100.0 * xi, 100.0 * given);
                    let message = format!(
                        "{state} needs the spectrum at {needed} % damping; the given one is at {given} %"
                    );
                    return Err(CheckError::value(&[state.key(), "spectrum_damping"], message));
                }
                interpolated(points, period).map_err(|message| {
                    CheckError::value(&[state.key(), "spectrum"], format!("{state}: {message}"))
                })
            }
            Self::Records(records) => {
                let spectrum = Spectrum::new(xi, Maxima::Everywhere)?;
                let at = |motion| spectrum.acceleration(motion, period);
                Ok(combined(records.iter().map(at).collect::<Result<_, _>>()?))
            }
        }
    }

    /// `S_d` at a period, of the damping ξ, the larger of both terms of [C8.7.1.12] \[m\].
    ///
    /// # Errors
    /// Those of [`acceleration`](Self::acceleration).
    pub fn spectral_displacement(&self, state: LimitState, period: f64, xi: f64) -> Result<f64, CheckError> {
        let (first, second) = self.terms(state, period, xi)?;
        Ok(second.map_or(first, |second| first.max(second)))
    }

    /// Both terms of [C8.7.1.12] at a period; the second only at a height, behind b T₁ \[m\].
    fn terms(&self, state: LimitState, period: f64, xi: f64) -> Result<(f64, Option<f64>), CheckError> {
        match self {
            Self::Ground(ground) => Ok((ground.displacement(period, xi), None)),
            Self::Floor(floor) => Ok(floor.displacement(period, xi)),
            Self::Points(..) | Self::Records(_) => {
                Ok((self.acceleration(state, period, xi)? * (period / TAU).powi(2), None))
            }
        }
    }

    /// The displacement demand of a limit state of the period T and the damping ξ, of a wall whose elastic
    /// period is T0: `S_e` or `S_eZ` at T \[m/s²\], `S_d`, and both terms of [C8.7.1.12] \[m\].
    pub(crate) fn displacement(
        &self,
        state: LimitState,
        [t0, period]: [f64; 2],
        xi: f64,
    ) -> Result<(f64, f64, [Option<f64>; 2]), CheckError> {
        let (first, second) = self.terms(state, period, xi)?;
        let acceleration = first * (TAU / period).powi(2);
        if matches!(self, Self::Ground(_) | Self::Floor(_)) {
            let displacement = second.map_or(first, |second| first.max(second));
            return Ok((acceleration, displacement, [Some(first), second]));
        }
        // of points and records the largest S_d from T0 to T
        let mut largest = first;
        let equal = (0..=SEARCHED).map(|part| t0 + (period - t0) * f64::from(part) / f64::from(SEARCHED));
        // the peaks of given points are at points
        let points: &[(f64, f64)] = if let Self::Points(points, _) = self { points } else { &[] };
        let own = points.iter().map(|point| point.0).filter(|own| (t0..=period).contains(own));
        // S_d is 0 at T = 0; below 1 ms it is nothing
        for at in equal.chain(own).filter(|at| *at >= 1e-3) {
            largest = largest.max(self.spectral_displacement(state, at, xi)?);
        }
        Ok((acceleration, largest, [Some(largest), None]))
    }
}

/// The mean of 7 and more records, or the largest of fewer.
///
/// # Panics
/// Without a record.
pub(crate) fn combined(values: Vec<f64>) -> f64 {
    assert!(!values.is_empty(), "a demand of records has a record");
    if values.len() >= MEAN_COUNTS_FROM {
        values.iter().sum::<f64>() / values.len() as f64
    } else {
        values.into_iter().fold(0.0, f64::max)
    }
}
