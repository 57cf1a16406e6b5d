//! The first value at which a condition holds.

/// Returns the first value of an interval at which a condition holds, by `halvings` of the interval. The
/// condition fails at its first end and holds at its second; the value returned is one at which it holds.
/// Some 64 halvings exhaust a double.
///
/// ```
/// let root = run::bisection::first_true([1.0, 2.0], 52, |x| Ok::<_, ()>(x * x >= 2.0))?;
/// assert!((root - 2.0_f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), ()>(())
/// ```
///
/// # Errors
/// The error of `holds`, if it fails.
pub fn first_true<E>(
    [mut fails, mut found]: [f64; 2],
    halvings: u32,
    mut holds: impl FnMut(f64) -> Result<bool, E>,
) -> Result<f64, E> {
    for _ in 0..halvings {
        let middle = 0.5 * (fails + found);
        if holds(middle)? { found = middle } else { fails = middle }
    }
    Ok(found)
}
