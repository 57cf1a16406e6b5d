//! PEER AT2 records.
//!
//! Header lines, the last of which states the number of samples and the step, then the samples, several on a line:
//!
//! ```text
//! PEER NGA STRONG MOTION DATABASE RECORD
//! Event, date, station, component
//! ACCELERATION TIME SERIES IN UNITS OF G
//! NPTS=   7999, DT=   .0050 SEC,
//!    .4513077E-03   .4513354E-03   .4513591E-03   .4513582E-03   .4513451E-03
//! ```
//!
//! The oldest files write `3930 0.00500 NPTS, DT` instead.

use super::Unit;
use super::error::{Fault, excerpt};
use super::record::{Parsed, ReadOptions, lines, notes};

/// The line with NPTS is looked for among this many lines that are not blank.
const HEADER_LINES: usize = 50;

const COUNT_AND_STEP: &str = "the number of samples and the step, `NPTS= 7999, DT= .0050 SEC`";

/// Whether the text has the line that states NPTS.
pub(super) fn recognises(text: &str) -> bool {
    lines(text).take(HEADER_LINES).any(|(_, line)| find(line, "NPTS").is_some())
}

/// Reads the text of an AT2 file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let header_length = lines(text).take(HEADER_LINES).position(|(_, line)| find(line, "NPTS").is_some());
    let Some(header_length) = header_length else {
        let found = lines(text).next().map_or_else(|| "an empty file".to_owned(), |(_, line)| excerpt(line));
        let expected = format!("an AT2 header with {COUNT_AND_STEP}");
        return Err(Fault::new(1, expected, found, "check that this is a PEER AT2 file"));
    };
    let header = || lines(text).take(header_length);
    let mut rest = lines(text).skip(header_length);
    let (count_line, count_text) = rest.next().unwrap_or((1, ""));
    let (count, step) = count_and_step(count_text, count_line)?;
    check_stated_step(options.step, step, count_line)?;
    let unit = unit(header(), count_line, options.unit)?;

    let mut samples = Vec::new();
    let mut last_line = count_line;
    for (number, line) in rest {
        last_line = number;
        for word in line.split_ascii_whitespace().flat_map(|word| Touching { rest: word }) {
            samples.push(sample(word, number, unit)?);
        }
    }
    if samples.len() != count {
        let expected = format!("{count} samples, as NPTS on line {count_line} says");
        let remedy = "the file is cut short or damaged: fetch it again";
        return Err(Fault::new(last_line, expected, format!("{} up to the end", samples.len()), remedy));
    }
    let notes = notes(header().map(|(_, line)| line));
    Ok(Parsed { step, samples, unit, first_time: 0.0, notes, last_line })
}

/// Position of an upper-case ASCII word, in any case.
fn find(line: &str, word: &str) -> Option<usize> {
    line.as_bytes().windows(word.len()).position(|window| window.eq_ignore_ascii_case(word.as_bytes()))
}

/// NPTS and DT from their line.
fn count_and_step(line: &str, number: usize) -> Result<(usize, f64), Fault> {
    let fault = |remedy: &str| Fault::new(number, COUNT_AND_STEP, excerpt(line), remedy);
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
    let step_unit = step_unit.trim_start();
    let foreign =
        step_unit.starts_with(|c: char| c.is_ascii_alphabetic() && !matches!(c, 's' | 'S' | 'n' | 'N'));
    if foreign {
        return Err(fault("the step must be in seconds"));
    }
    let count = count.parse::<usize>().map_err(|_| unreadable())?;
    let step = real(step).filter(|step| *step > 0.0 && step.is_finite()).ok_or_else(unreadable)?;
    Ok((count, step))
}

/// The number a text starts with, after blanks, commas and an equals sign or colon, and what follows it.
fn leading_number(text: &str) -> (&str, &str) {
    let text = text.trim_start_matches(|c: char| c.is_ascii_whitespace() || matches!(c, '=' | ':' | ','));
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | 'E' | 'e' | 'D' | 'd');
    // A word such as `DT` also starts with such a letter, a number does not.
    if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return ("", text);
    }
    text.split_at(text.find(|c| !is_number(c)).unwrap_or(text.len()))
}

/// A step stated beside the file's own must be the same.
pub(super) fn check_stated_step(stated: Option<f64>, step: f64, line: usize) -> Result<(), Fault> {
    // Either may be rounded in the fourth digit: 0.0029 for 1/350.
    const TOLERANCE: f64 = 1e-3;
    match stated {
        Some(stated) if (stated - step).abs() > TOLERANCE * step => {
            let expected = format!("the stated step of {stated} s");
            Err(Fault::new(line, expected, format!("{step} s"), "state no step: the file has its own"))
        }
        _ => Ok(()),
    }
}

/// The unit the header states, or the one the user states; never a guess.
fn unit<'a>(
    header: impl Iterator<Item = (usize, &'a str)>,
    count_line: usize,
    given: Option<Unit>,
) -> Result<Unit, Fault> {
    let mut stated = None;
    for (number, line) in header {
        for quantity in ["VELOCITY TIME", "DISPLACEMENT TIME"] {
            if find(line, quantity).is_some() {
                let remedy = "use the acceleration file (.AT2) of this record";
                return Err(Fault::new(number, "an acceleration record", excerpt(line), remedy));
            }
        }
        if stated.is_none() {
            stated = unit_word(line).map(|word| (number, word));
        }
    }
    let remedy = "state the unit of the record (m/s2, cm/s2, mm/s2 or g)";
    match (stated, given) {
        (None, None) => {
            let expected = "a unit in the header, `IN UNITS OF G`";
            Err(Fault::new(count_line, expected, "none before this line", remedy))
        }
        (None, Some(given)) => Ok(given),
        (Some((number, word)), given) => match (word.parse::<Unit>(), given) {
            (Ok(unit), Some(given)) if unit != given => {
                let expected = format!("the stated unit {given}");
                Err(Fault::new(number, expected, unit.name(), "state no unit: the file has its own"))
            }
            (Ok(unit), _) => Ok(unit),
            (Err(_), Some(given)) => Ok(given),
            (Err(_), None) => Err(Fault::new(number, "a unit of acceleration", excerpt(word), remedy)),
        },
    }
}

/// The word after `UNITS OF`, `UNITS ARE`, `UNITS:` …
fn unit_word(line: &str) -> Option<&str> {
    let after = find(line, "UNITS")? + "UNITS".len();
    let is_edge = |c: char| matches!(c, '(' | ')' | '[' | ']' | ',' | '.' | ';' | ':' | '=');
    let words = line[after..].split_ascii_whitespace().map(|word| word.trim_matches(is_edge));
    let is_filler =
        |word: &str| ["of", "are", "is", "in", ""].iter().any(|filler| word.eq_ignore_ascii_case(filler));
    words.into_iter().find(|word| !is_filler(word))
}

/// Splits numbers that touch: fixed-width fields leave no blank before a sign, `.1234567E-03-.7654321E-03`.
struct Touching<'a> {
    rest: &'a str,
}

impl<'a> Iterator for Touching<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        let bytes = self.rest.as_bytes();
        let is_start = |at: &usize| {
            matches!(bytes[*at], b'+' | b'-') && !matches!(bytes[*at - 1], b'E' | b'e' | b'D' | b'd')
        };
        let (number, rest) = self.rest.split_at((1..bytes.len()).find(is_start).unwrap_or(bytes.len()));
        self.rest = rest;
        Some(number)
    }
}

/// A number as Fortran writes it: the exponent's letter may be D.
fn real(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| word.replace(['D', 'd'], "E").parse().ok())
}

/// One sample in m/s².
fn sample(word: &str, line: usize, unit: Unit) -> Result<f64, Fault> {
    let value = real(word).map(|value| unit.to_si(value)).filter(|value| value.is_finite());
    value.ok_or_else(|| {
        Fault::new(line, "a finite number", excerpt(word), "correct the file or fetch it again")
    })
}
