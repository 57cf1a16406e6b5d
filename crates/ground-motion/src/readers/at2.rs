//! PEER AT2 records.
//!
//! Header lines, the last of which states the number of samples and the step, then the samples, several on a
//! line:
//!
//! ```text
//! PEER NGA STRONG MOTION DATABASE RECORD
//! Event, date, station, component
//! ACCELERATION TIME SERIES IN UNITS OF G
//! NPTS=   7999, DT=   .0050 SEC,
//!    .4513077E-03   .4513354E-03   .4513591E-03   .4513582E-03   .4513451E-03
//! ```
//!
//! The oldest files write `3930 0.00500 NPTS, DT` instead, and eqsig `401 0.01` below a title.

use crate::columns::unit_of_title;
use crate::error::{DAMAGED, Fault};
use crate::fields::{
    Numbered, check_count, find, leading_number, lines, positive, real, touching, unit_word,
};
use crate::options::{RecordOptions, STATE_THE_UNIT};
use crate::parsed::Parsed;
use crate::quantity::Quantity;
use crate::unit::Unit;
use crate::vertical::is_vertical;

/// The line with NPTS is searched among this many lines that are not blank.
const HEADER_LINES: usize = 50;

const COUNT_AND_STEP: &str = "the number of samples and the step, `NPTS= 7999, DT= .0050 SEC`";

/// Returns whether one of the first lines states NPTS and DT.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.iter().take(HEADER_LINES).any(|line| states_count_and_step(line)) || bare(head).is_some()
}

/// Finds a line with the number of samples and the step alone, `401 0.01`, among the first ones and above
/// samples.
fn bare(head: &[&str]) -> Option<usize> {
    let numbers = |line: &str| line.split_ascii_whitespace().map(real).collect::<Option<Vec<f64>>>();
    let place = head.iter().take(4).position(|line| numbers(line).is_some())?;
    let [count, step] = numbers(head[place])?[..] else { return None };
    let samples = numbers(head.get(place + 1)?)?.len();
    (count > 2.0 && count.fract() == 0.0 && step > 0.0 && step < 1.0 && samples != 2).then_some(place)
}

/// Returns whether a line has the words NPTS and DT and is not a comment of a table.
fn states_count_and_step(line: &str) -> bool {
    let has = |word: &str| {
        line.split(|c: char| !c.is_ascii_alphabetic()).any(|found| found.eq_ignore_ascii_case(word))
    };
    !line.trim_start().starts_with(['#', '%']) && has("NPTS") && has("DT")
}

/// Reads the text of an AT2 file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let first = |states: fn(&str) -> bool| lines(text).take(HEADER_LINES).position(|(_, line)| states(line));
    let header_length = first(states_count_and_step).or_else(|| first(|line| find(line, "NPTS").is_some()));
    let head: Vec<&str> = lines(text).take(5).map(|(_, line)| line).collect();
    let header_length = header_length.or_else(|| bare(&head));
    let Some(header_length) = header_length else {
        let found = lines(text).next().unwrap_or_default().1;
        let expected = format!("an AT2 header with {COUNT_AND_STEP}");
        return Err(Fault::excerpt(1, expected, found, "check that this is a PEER AT2 file"));
    };
    let header = || lines(text).take(header_length);
    let mut rest = lines(text).skip(header_length);
    let (count_line, count_text) = rest.next().unwrap_or((1, ""));
    let (count, step) = count_and_step(count_text, count_line)?;
    options.check_step(step, count_line)?;
    let unit = unit(header(), count_line, options)?;

    let mut parsed = Parsed::new(step, unit, count_line);
    let mut line_start = 0;
    for (number, line) in rest {
        line_start = parsed.samples.len();
        for word in line.split_ascii_whitespace().flat_map(touching) {
            parsed.push(real(word), number, || Fault::no_number(number, "a finite number", word, DAMAGED))?;
        }
    }
    // the last line may be filled up with zeros
    let surplus = parsed.samples.get(count..).filter(|_| line_start < count);
    if surplus.is_some_and(|rest| rest.iter().all(|a| *a == 0.0)) {
        parsed.samples.truncate(count);
    }
    check_count(parsed.samples.len(), count, &format!("NPTS on line {count_line}"), parsed.last_line)?;
    // event, date, station, component, and in old files the station's number in brackets
    let place = header().nth(1).and_then(|(_, line)| line.rsplit_once(", "));
    let direction = place.and_then(|(_, component)| component.split_whitespace().next());
    parsed.is_vertical = direction.is_some_and(is_vertical);
    parsed.keep_header(header().map(|(_, line)| line));
    Ok(vec![parsed])
}

/// Reads NPTS and DT from their line.
fn count_and_step(line: &str, number: usize) -> Result<(usize, f64), Fault> {
    let fault = |remedy: &str| Fault::excerpt(number, COUNT_AND_STEP, line, remedy);
    let unreadable = || fault("correct this line of the header");
    let after = |word: &str| find(line, word).map(|at| leading_number(&line[at + word.len()..]));
    let (count, (step, step_unit)) = match (after("NPTS"), after("DT")) {
        (Some((count, _)), Some(step)) if !count.is_empty() => (count, step),
        // The oldest form has the numbers first, `3930 0.00500 NPTS, DT`.
        _ => {
            let (count, rest) = leading_number(line);
            (count, leading_number(rest))
        }
    };
    let step_unit = step_unit.trim_start_matches(|c: char| c.is_whitespace() || matches!(c, '(' | '['));
    let step_unit = step_unit.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    let is_second = matches!(Quantity::of(step_unit), Some(Quantity::Time(1.0)));
    // in the oldest form the word is NPTS
    if !(step_unit.is_empty() || is_second || step_unit.starts_with(['n', 'N'])) {
        return Err(fault("the step must be in seconds: convert it, and write SEC behind it"));
    }
    let count = count.parse::<usize>().map_err(|_| unreadable())?;
    Ok((count, positive(step).ok_or_else(unreadable)?))
}

/// Finds the unit that the header states, or else the one that the user states. It is never guessed.
fn unit<'a>(
    header: impl Iterator<Item = Numbered<'a>> + Clone,
    count_line: usize,
    options: &RecordOptions,
) -> Result<Unit, Fault> {
    let is_other =
        |line: &str| ["VELOCITY TIME", "DISPLACEMENT TIME"].iter().any(|of| find(line, of).is_some());
    if let Some((number, line)) = header.clone().find(|(_, line)| is_other(line)) {
        let remedy = "use the acceleration file (.AT2) of this record";
        return Err(Fault::excerpt(number, "an acceleration record", line, remedy));
    }
    let of_title = |line| find(line, "ACCELERATION").and_then(|_| unit_of_title(line, true));
    let stated =
        header.into_iter().find_map(|(at, line)| Some((at, unit_word(line).or_else(|| of_title(line))?)));
    match (stated, options.unit) {
        (Some((number, word)), _) => options.unit_of(&word, number),
        (None, Some(given)) => Ok(given),
        (None, None) => {
            let expected = "a unit in the header, `IN UNITS OF G`";
            Err(Fault::new(count_line, expected, "none before this line", STATE_THE_UNIT))
        }
    }
}
