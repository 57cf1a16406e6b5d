//! Numbers and texts for axes.

use std::fmt::Write;

/// Writes a number as people do, with at most `digits` digits. Far from 1 it has a power of ten.
///
/// ```
/// assert_eq!(report::number(100.0 * 0.07, 6), "7");
/// assert_eq!(report::number(1.0 / 3.0, 3), "0.333");
/// assert_eq!(report::number(2.5e-9, 6), "2.5e-9");
/// ```
pub fn number(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let is_near = rounded == 0.0 || (1e-6..1e9).contains(&rounded.abs());
    if is_near { rounded.to_string() } else { format!("{rounded:e}") }
}

/// Adds a text at a place \[px\]: its start, middle or end, as `anchor` says.
pub(crate) fn write_text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, text: &str) {
    let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
}

/// Adds a text at a place \[px\], turned to read upwards.
pub(crate) fn write_upwards(svg: &mut String, [x, y]: [f64; 2], text: &str) {
    let place = format!("translate({x:.1} {y:.1}) rotate(-90)");
    let _ = write!(svg, "<text transform=\"{place}\" text-anchor=\"middle\">{text}</text>");
}

/// Returns round numbers within a range, about `count` of them, with their text.
///
/// ```
/// assert_eq!(report::ticks([0.0, 1.2], 3.0)[1], (0.5, "0.5".to_owned()));
/// ```
pub fn ticks([low, high]: [f64; 2], count: f64) -> Vec<(f64, String)> {
    let step = round_step((high - low) / count);
    let first = (low / step - 1e-9).ceil();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 12 decimals")]
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    (0..20)
        .map(|k| (first + f64::from(k)) * step)
        .take_while(|tick| *tick <= high + 1e-9 * step)
        .map(|tick| (tick, format!("{tick:.decimals$}")))
        .collect()
}

/// 1, 2 or 5 times a power of ten, at least `least`.
fn round_step(least: f64) -> f64 {
    let power = 10.0_f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    steps.into_iter().find(|step| *step >= least).unwrap_or(least)
}
