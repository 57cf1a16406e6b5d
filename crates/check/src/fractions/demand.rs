//! The demand: a spectrum given by points, or the median of records.

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, Maxima, Spectrum};
use run::sample::sample_median;

use crate::error::CheckError;
use crate::file::site::{check_points, interpolated};

/// The demand of a check.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand(Of);

#[derive(Clone, Debug, PartialEq)]
enum Of {
    /// Points (T, `S_a`) \[s, m/s²\].
    Points(Vec<(f64, f64)>),
    Records(Spectrum, Vec<GroundMotion>),
}

impl Demand {
    /// Makes the demand of points (T, `S_a`) \[s, m/s²\].
    ///
    /// # Errors
    /// [`CheckError`] of fewer than two, and of the first whose period does not rise from 0 on, or whose
    /// `S_a` is not above 0; `place` names a point by its index.
    pub fn of_points(points: Vec<(f64, f64)>, place: impl Fn(usize) -> String) -> Result<Self, CheckError> {
        let refused = |message| CheckError::value(&["spectrum"], message);
        check_points(&points, "m/s²", place).map_err(refused)?;
        Ok(Self(Of::Points(points)))
    }

    /// Makes the demand of what acts on a wall: the median spectrum of motions with a damping ratio.
    ///
    /// # Errors
    /// [`CheckError`] without motions, or of a damping ratio outside its limits.
    pub fn of_motions(motions: Vec<GroundMotion>, damping: f64) -> Result<Self, CheckError> {
        if motions.is_empty() {
            return Err(CheckError::value(&["records"], "the demand needs at least one record"));
        }
        Ok(Self(Of::Records(Spectrum::new(damping, Maxima::Everywhere)?, motions)))
    }

    /// Returns `S_a` at a period \[m/s²\].
    ///
    /// # Errors
    /// [`CheckError`] for a period that the demand does not have.
    pub fn at(&self, period: f64) -> Result<f64, CheckError> {
        match &self.0 {
            Of::Points(points) => {
                interpolated(points, period).map_err(|message| CheckError::value(&["spectrum"], message))
            }
            Of::Records(spectrum, motions) => {
                let at = |motion| spectrum.acceleration(motion, period);
                let mut values = motions.iter().map(at).collect::<Result<Vec<f64>, _>>()?;
                Ok(sample_median(&mut values))
            }
        }
    }

    /// Points (`S_d`, `S_a`) up to twice a period, to draw \[m, m/s²\].
    pub(super) fn drawn(&self, period: f64) -> Result<Vec<(f64, f64)>, CheckError> {
        let longest = match &self.0 {
            Of::Points(points) => points.last().map_or(0.0, |point| point.0).min(2.0 * period),
            Of::Records(..) => 2.0 * period,
        };
        let at = |part: u32| {
            let period = longest * f64::from(part) / 200.0;
            let acceleration = self.at(if part < 3 { 0.0 } else { period })?;
            Ok((acceleration * (period / TAU).powi(2), acceleration))
        };
        (0..=200).map(at).collect()
    }
}
