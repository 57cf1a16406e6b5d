//! Medians, fractiles and steps of a sample.

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

/// Returns a fractile of a sorted sample: its smallest value that at least a fraction `part` of it does not
/// exceed.
pub fn fractile(sorted: &[f64], part: f64) -> Option<f64> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to the length")]
    let number = (part * sorted.len() as f64 - 1e-9).ceil().max(1.0) as usize;
    sorted.get(number - 1).copied()
}

/// Returns the middle value, or the mean of the two in the middle; NaN of an empty sample.
pub(crate) fn sample_median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if !even {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (lower + upper)
}
