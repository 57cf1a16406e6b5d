//! Where something begins, found by halving.

/// Halves an interval a number of times, and keeps the half in which something begins. It has not begun at
/// the first end and has at the second; returns the second end of what is left.
///
/// ```
/// let root = run::bisection::begins_at([1.0, 2.0], 52, |x| Ok::<_, ()>(x * x >= 2.0))?;
/// assert!((root - 2.0_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), ()>(())
/// ```
///
/// # Errors
/// The error of `has_begun`, if it fails.
pub fn begins_at<E>(
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
