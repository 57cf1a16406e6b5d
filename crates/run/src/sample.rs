//! Medians and fractiles of a sample.

/// Returns a fractile of a sorted sample: its smallest value that at least a fraction `part` of it does not
/// exceed.
pub fn fractile(sorted: &[f64], part: f64) -> Option<f64> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to the length")]
    let number = (part * sorted.len() as f64 - 1e-9).ceil().max(1.0) as usize;
    sorted.get(number - 1).copied()
}

/// Returns the middle value, or the mean of the two in the middle; NaN of an empty sample.
pub fn sample_median(values: &mut [f64]) -> f64 {
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
