//! Plain numbers, any number of them on a line and nothing else: the samples of one record in their order, as
//! OpenSees reads them (`timeSeries Path -dt … -filePath …`). Step and unit have to be stated.
//!
//! ```text
//! 0.00012 0.00034 -0.00021 0.00056 0.00103
//! 0.00110 0.00098
//! ```
//!
//! One number on every line is a column; where the first numbers of the lines rise, they are the times of a
//! table.

use crate::columns::{COMMENTS, is_comment, is_comment_above, refuse_unclear};
use crate::error::{DAMAGED, Fault};
use crate::fields::{Numbered, after, all_lines, find, leading_number, lines, positive, real, touching};
use crate::options::{RecordOptions, is_close, no_unit};
use crate::parsed::Parsed;
use crate::warning::Warning;

/// Returns whether the first lines are numbers only, several on some of them, and not a table that starts
/// with times. Two numbers a line are taken for times and accelerations unless a step is stated.
pub(super) fn recognises(head: &[&str], has_step: bool) -> bool {
    let rows = head.iter().map(|line| line.trim()).filter(|line| !line.starts_with(COMMENTS));
    let rows: Option<Vec<Vec<f64>>> = rows.map(values).collect();
    let fewest = if has_step { 2 } else { 3 };
    rows.is_some_and(|rows| rows.iter().any(|row| row.len() >= fewest) && !starts_with_times(&rows))
}

/// Reads the numbers of a line; `None` if there is something else, or a comma that may stand before decimals.
fn values(line: &str) -> Option<Vec<f64>> {
    let has_points = !line.contains(',') || words(line).all(|word| word.contains('.'));
    // an error of a spreadsheet and the asterisks of Fortran stand for a number
    let stands_for_one = |word: &str| (word.starts_with('#') || word.contains("**")).then_some(f64::NAN);
    let value = |word| real(word).filter(|value| value.is_finite()).or_else(|| stands_for_one(word));
    if has_points { words(line).map(value).collect() } else { None }
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    let separated = line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    separated.flat_map(touching)
}

/// Returns whether the first column of a table never falls, as times do not, even if they are rounded.
fn starts_with_times(rows: &[Vec<f64>]) -> bool {
    const FEWEST: usize = 3;
    let is_table = |rows: &[Vec<f64>]| {
        let columns = rows.first().map_or(0, Vec::len);
        let rises = rows.windows(2).all(|pair| pair[0].first() <= pair[1].first());
        let moves = rows.first().and_then(|row| row.first()) < rows.last().and_then(|row| row.first());
        rows.len() >= FEWEST && columns > 1 && rises && moves && rows.iter().all(|row| row.len() == columns)
    };
    // what precedes a table, such as its number of rows, does not count
    is_table(rows) || rows.get(1..).is_some_and(is_table)
}

/// Reads the text of such a file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let rows = || lines(text).skip_while(|(_, line)| is_comment_above(line));
    let Some((first_line, first)) = rows().next() else {
        return Err(Fault::new(1, "numbers", "none", "check that this is the right file"));
    };
    let Some(step) = options.step else {
        let expected = "two columns, times and accelerations, or a stated step";
        let remedy = "if these are the samples of one record in their order, state the step in seconds as \
                      `step` (on the command line --record-step, in Python dt); otherwise name the columns \
                      in a header line that starts with `time`, or write one sample a line";
        let found = format!("{} numbers a line and no step", words(first).count());
        return Err(Fault::new(first_line, expected, found, remedy));
    };
    let unit = options.unit.ok_or_else(|| no_unit(first_line))?;
    let mut parsed = Parsed::new(step, unit, first_line);
    parsed.keep_header(lines(text).map(|(_, line)| line));
    for (number, line) in rows() {
        if line.starts_with(COMMENTS) {
            refuse_unclear((number, line))?;
            continue;
        }
        for word in words(line) {
            parsed.push(real(word), number, || Fault::no_number(number, "a finite number", word, DAMAGED))?;
        }
    }
    let header = lines(text).take_while(|(line, _)| *line < first_line).map(|(_, line)| line);
    warn(&mut parsed, step, header, all_lines(text).skip_while(|(line, _)| *line < first_line));
    // the last line may be shorter
    let columns = words(first).count();
    let is_table = parsed.warnings.is_empty() && parsed.samples.len().div_ceil(columns) == rows().count();
    check_order(&parsed, if is_table { columns } else { 0 }, first_line)?;
    Ok(vec![parsed])
}

/// Warns about what samples alone give reason to: gaps among their `rows`, another step in the header than
/// the one that the user states, and a count or a step that stands as the first sample.
pub(super) fn warn<'a>(
    parsed: &mut Parsed,
    step: f64,
    header: impl IntoIterator<Item = &'a str>,
    rows: impl Iterator<Item = Numbered<'a>> + Clone,
) {
    const FEWEST: usize = 20;
    parsed.warnings.extend(gap(rows));
    // a header in milliseconds agrees, too
    let agrees = |of_file: &f64| is_close(step, *of_file) || is_close(1e3 * step, *of_file);
    let other = header.into_iter().find_map(step_in).filter(|of_file| !agrees(of_file));
    parsed.warnings.extend(other.map(|of_file| Warning::StatedStep { step: of_file, stated: step }));
    let (first, all) = (parsed.samples[0] / parsed.unit.to_si(1.0), parsed.samples.len());
    let is_meant = [all as f64 - 1.0, all as f64 - 2.0, step].iter().any(|of| (first - of).abs() < 1e-9 * of);
    parsed.warnings.extend((all >= FEWEST && is_meant).then_some(Warning::FirstNumber { first }));
}

/// Finds the step in a line of a header: `dt = 0.01 s`, `time step: 10 ms`, `sampling rate: 100 Hz`.
fn step_in(line: &str) -> Option<f64> {
    let is_edge = |c: char| c.is_whitespace() || "=:,([s])".contains(c);
    let number = |word| positive(leading_number(after(line, word)?.trim_start_matches(is_edge)).0);
    let rate = || find(line, "SAMPL").and_then(|_| ["RATE", "FREQUENCY"].into_iter().find_map(number));
    ["DT", "STEP", "INTERVAL"].into_iter().find_map(number).or_else(|| rate().map(|rate| 1.0 / rate))
}

/// Warns about the first of the lines from the first sample on that has another number of samples than most
/// have, or none, as a comment has. Empty lines behind every line do not count, nor does the last line.
fn gap<'a>(lines: impl Iterator<Item = Numbered<'a>> + Clone) -> Option<Warning> {
    let is_edge = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"');
    let length = |line: &str| line.split(is_edge).flat_map(touching).count();
    let length = |line: &str| if is_comment(line.trim_start()) { 0 } else { length(line) };
    let rows = lines.map(|(line, text)| (line, length(text))).skip_while(|(_, length)| *length == 0);
    let (last, _) = rows.clone().filter(|(_, length)| *length > 0).last()?;
    let rows = rows.take_while(|(line, _)| *line < last);
    let (_, usual) = rows.clone().next()?;
    let all_with = |wanted: usize| rows.clone().filter(|(_, length)| *length == wanted).count();
    let (same, empty, all) = (all_with(usual), all_with(0), rows.clone().count());
    let is_gap = |length: usize| match length {
        0 => 2 * empty < all,
        _ => 2 * same > all - empty && length != usual,
    };
    let mut gaps = rows.filter(|(_, length)| is_gap(*length));
    let (line, found) = gaps.next()?;
    Some(Warning::Gap { line, found, usual, more: gaps.count() })
}

/// Refuses columns that are records of their own: neighbours in a column are then much closer than
/// neighbours in a row.
fn check_order(parsed: &Parsed, columns: usize, line: usize) -> Result<(), Fault> {
    const CLOSER: f64 = 0.25;
    let samples = &parsed.samples;
    let change = |lag: usize| -> f64 {
        let squares = samples.iter().zip(samples.iter().skip(lag)).map(|(a, b)| (b - a) * (b - a));
        squares.sum::<f64>() / samples.len().saturating_sub(lag).max(1) as f64
    };
    // few rows say nothing
    if columns < 2 || samples.len() < 20 * columns || change(columns) >= CLOSER * change(1) {
        return Ok(());
    }
    let found = format!("{columns} columns that change more slowly than the rows, as components do");
    let remedy = "name the columns in a header line that starts with `time` and state one, or write one \
                  sample a line";
    Err(Fault::new(line, "the samples of one record in their order", found, remedy))
}
