//! Values in the header of a record, by their keys.

use crate::error::Fault;
use crate::fields::{Numbered, leading_number, positive};
use crate::options::RecordOptions;

/// Finds the value of a key in header lines `KEY : value`, and its line.
pub(super) fn value<'a>(header: &[Numbered<'a>], key: &str) -> Result<Numbered<'a>, Fault> {
    let of_key = |&(number, line): &Numbered<'a>| {
        let (name, value) = line.trim_start_matches('#').split_once(':')?;
        name.trim().eq_ignore_ascii_case(key).then_some((number, value.trim()))
    };
    required(header, key, header.iter().find_map(of_key))
}

/// Refuses a header without a value for a key, or with an empty one.
pub(super) fn required<'a>(
    header: &[Numbered<'a>],
    key: &str,
    found: Option<Numbered<'a>>,
) -> Result<Numbered<'a>, Fault> {
    found.filter(|(_, value)| !value.is_empty()).ok_or_else(|| {
        let line = found.or(header.last().copied()).map_or(1, |(number, _)| number);
        Fault::missing(line, format!("a value for `{key}` in the header"))
    })
}

/// Reads the positive number that a value starts with; a unit may follow.
pub(super) fn number((line, text): Numbered<'_>, key: &str) -> Result<(usize, f64), Fault> {
    let number = positive(leading_number(text).0);
    number
        .map(|number| (line, number))
        .ok_or_else(|| Fault::in_header(line, format!("a positive number for `{key}`"), text))
}

/// Reads the value of a key as a whole number, and its line.
pub(super) fn count(header: &[Numbered<'_>], key: &str) -> Result<(usize, usize), Fault> {
    let (line, text) = value(header, key)?;
    text.parse()
        .map(|count| (line, count))
        .map_err(|_| Fault::in_header(line, format!("{key} as a whole number"), text))
}

/// Reads the step from the value of a key, and compares it with the one that the user states.
pub(super) fn step(
    header: &[Numbered<'_>],
    key: &str,
    to_step: impl Fn(f64) -> f64,
    options: &RecordOptions,
) -> Result<f64, Fault> {
    let (line, value) = number(value(header, key)?, key)?;
    let step = to_step(value);
    options.check_step(step, line)?;
    Ok(step)
}
