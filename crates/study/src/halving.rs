//! Where something begins, found by halving.

/// Halves an interval a number of times, and keeps the half in which something begins. It has not begun at
/// the first end and has at the second; returns the second end of what is left.
pub(crate) fn begins_at<E>(
    [mut before, mut after]: [f64; 2],
    halvings: u32,
    mut has_begun: impl FnMut(f64) -> Result<bool, E>,
) -> Result<f64, E> {
    for _ in 0..halvings {
        let middle = 0.5 * (before + after);
        if has_begun(middle)? { after = middle } else { before = middle }
    }
    Ok(after)
}
