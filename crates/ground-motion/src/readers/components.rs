//! What formats with one column for each component share.

use crate::error::{DAMAGED, Fault};
use crate::fields::{check_count, real, rounding};
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;

/// Most components of a file.
pub(super) const MOST: usize = 24;

/// Makes components without samples, of a name each; these follow after a line. `U` is vertical, too.
///
/// Refuses more components than any recorder has: the header is damaged.
pub(super) fn components<'a>(
    [step, first_time]: [f64; 2],
    unit: Unit,
    names: impl Iterator<Item = &'a str>,
    line: usize,
) -> Result<Vec<Parsed>, Fault> {
    let component = |(index, name): (usize, &str)| {
        let mut parsed = Parsed::new(step, unit, line);
        parsed.first_time = first_time;
        parsed.channel = Some(format!("{}: {name}", index + 1));
        parsed.is_vertical = is_vertical(name) || name.eq_ignore_ascii_case("U");
        parsed
    };
    let channels: Vec<_> = names.enumerate().take(MOST + 1).map(component).collect();
    if (1..=MOST).contains(&channels.len()) {
        return Ok(channels);
    }
    let expected = format!("the names of 1 to {MOST} components");
    let found = if channels.is_empty() { "none" } else { "more" };
    Err(Fault::new(line, expected, found, "correct the header"))
}

/// Takes the next row, one field for each component.
pub(super) fn push_row<'a>(
    channels: &mut [Parsed],
    fields: impl Iterator<Item = &'a str>,
    line: usize,
) -> Result<(), Fault> {
    let columns = channels.len();
    let mut fields = fields.fuse();
    for (index, channel) in channels.iter_mut().enumerate() {
        let field = fields.next().unwrap_or_default();
        channel.push(real(field), line, || {
            let expected = format!("a finite number ({} of {columns})", index + 1);
            Fault::no_number(line, expected, field, DAMAGED)
        })?;
    }
    match fields.next() {
        Some(more) => {
            let expected = format!("{columns} samples, one for each component");
            Err(Fault::excerpt(line, expected, more, DAMAGED))
        }
        None => Ok(()),
    }
}

/// Takes the next row, which starts with its time (s): the one that is due, but for its last decimal.
pub(super) fn push_timed_row<'a>(
    channels: &mut [Parsed],
    mut fields: impl Iterator<Item = &'a str>,
    line: usize,
    due: f64,
) -> Result<(), Fault> {
    let field = fields.next().unwrap_or_default();
    if real(field).is_some_and(|time| (time - due).abs() <= rounding(field) + 1e-9 * due.abs()) {
        return push_row(channels, fields, line);
    }
    Err(Fault::excerpt(line, format!("the time {due:.3} s"), field, DAMAGED))
}

/// Returns the components, with the first lines of their header; refuses another number of rows than the
/// one that `stated_by` says.
pub(super) fn finish<'a>(
    mut channels: Vec<Parsed>,
    stated: usize,
    stated_by: &str,
    header: &(impl Iterator<Item = &'a str> + Clone),
) -> Result<Vec<Parsed>, Fault> {
    for channel in &mut channels {
        check_count(channel.samples.len(), stated, stated_by, channel.last_line)?;
        channel.keep_header(header.clone());
    }
    Ok(channels)
}
