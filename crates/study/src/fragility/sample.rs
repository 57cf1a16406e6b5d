//! Medians and steps of exceedances.

use run::sample::sample_median;

use crate::ida::Exceedance;

/// Returns the median exceedance: the intensity that half of the records need, infinite where it is above the
/// levels.
pub fn median(exceedances: &[Exceedance]) -> f64 {
    let mut intensities: Vec<f64> = exceedances.iter().map(|exceedance| exceedance.or_infinity()).collect();
    sample_median(&mut intensities)
}

/// Returns the steps of the empirical fragility: intensities in rising order, each with the fraction of the
/// records that exceed the limit state from there on. Censored records count among all records.
pub fn steps(exceedances: &[Exceedance]) -> Vec<(f64, f64)> {
    let mut intensities: Vec<f64> = exceedances.iter().map(|exceedance| exceedance.or_infinity()).collect();
    intensities.retain(|intensity| intensity.is_finite());
    intensities.sort_by(f64::total_cmp);
    let all = exceedances.len() as f64;
    intensities.iter().enumerate().map(|(index, &intensity)| (intensity, (index + 1) as f64 / all)).collect()
}
