//! Numbers and texts for axes.

use std::fmt::Write;

use crate::escaped;

/// What the axes count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Both count the values.
    Linear,
    /// x counts the values, spaced by their logarithms; y counts the values.
    LogarithmicAcross,
    /// x counts the values, spaced by their logarithms. y counts exponents of ten.
    Logarithmic,
}

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

/// Two numbers that are compared, with at most so many digits, or as many more as tell them apart.
///
/// ```
/// assert_eq!(report::apart([25.714, 25.7], 3), ["25.71", "25.7"]);
/// ```
pub fn apart(values: [f64; 2], digits: usize) -> [String; 2] {
    let written = |digits| values.map(|value| number(value, digits));
    // 17 digits tell all numbers apart
    (digits..17).map(written).find(|[a, b]| a != b).unwrap_or_else(|| written(17))
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

/// A label as markup: what follows the `_` of a single letter is its index, as in `S_e` and `u/u_ins`.
///
/// ```
/// assert!(report::label("d_0 of tie_side").starts_with("d<tspan dy=\"3\" font-size=\"75%\">0</tspan>"));
/// assert!(report::label("d_0 of tie_side").ends_with(" of tie_side"));
/// ```
pub fn label(text: &str) -> String {
    let mut markup = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('_') {
        let (before, after) = (&rest[..at], &rest[at + 1..]);
        let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
        let index = &after[..after.find(|letter| !is_word(letter)).unwrap_or(after.len())];
        let mut letters = before.chars().rev();
        let is_symbol =
            letters.next().is_some_and(char::is_alphabetic) && !letters.next().is_some_and(is_word);
        markup += &escaped(before);
        // the empty text goes back up to the line
        let (low, back) = ("<tspan dy=\"3\" font-size=\"75%\">", "</tspan><tspan dy=\"-3\">&#8203;</tspan>");
        let [opens, closes] = if is_symbol && !index.is_empty() { [low, back] } else { ["_", ""] };
        markup.extend([opens, index, closes]);
        rest = &after[index.len()..];
    }
    markup + &escaped(rest)
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
