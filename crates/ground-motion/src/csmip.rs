//! CSMIP and CDMG volume 2 records (`.V2`).
//!
//! For each channel 25 lines of text, 100 integers, 100 reals, then acceleration, velocity and displacement in columns
//! of ten characters that may touch, and a closing line:
//!
//! ```text
//! Corrected accelerogram   …
//! Chan  1: 360 Deg
//! Peak acceleration =    77.280    cm/sec/sec  at   30.585   sec.
//!  12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)
//!   -.000010  -.000009  -.000010  -.000009  -.000008  -.000008  -.000007  -.000010
//!  12000 points of veloc data equally spaced at  .005 sec, in cm/sec.  (8f10.7)
//! /&  ----------  End of data for channel  1  ----------
//! ```
//!
//! The headings tell all that is needed, so the integers and reals are passed over. Velocity and displacement are read
//! only to see that they are whole.

use std::iter::Peekable;

use super::Unit;
use super::error::{Fault, excerpt};
use super::fields::{CUT_SHORT, DAMAGED, Layout, Line, after, find, leading_number, leading_real, real};
use super::record::{Parsed, ReadOptions, check_stated_step, notes, untrimmed_lines};
use super::unit::unit_word;

const HEADING: &str =
    "a heading `12000 points of accel data equally spaced at .005 sec, in cm/sec2. (8f10.6)`";

/// Files older than their statement of it have this form.
const LAYOUT: Layout = Layout { per_line: 8, width: 10 };

/// Whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| find(line, "CORRECTED ACCELEROGRAM").is_some())
        || head.iter().any(|line| is_heading(line))
}

fn is_heading(line: &str) -> bool {
    find(line, "POINTS OF").is_some()
        && find(line, "EQUALLY SPACED").is_some()
        && find(line, " DATA ").is_some()
}

/// Reads every channel of a CSMIP file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Vec<Parsed>, Fault> {
    let mut rest = untrimmed_lines(text).peekable();
    let mut channels = Vec::new();
    let mut preamble = Preamble::default();
    let mut last = (1, "");
    let mut open = false;
    while let Some((number, line)) = rest.next() {
        last = (number, line);
        if is_heading(line) {
            open = true;
            let block = Block::read((number, line), &mut rest, options)?;
            if let Some(mut parsed) = block {
                let label = preamble.label(channels.len());
                parsed.channel = Some(label);
                parsed.notes = preamble.notes();
                parsed.stated_peak = preamble.peak;
                channels.push(parsed);
            }
        } else if line.starts_with("/&") {
            preamble = Preamble::default();
            open = false;
        } else {
            preamble.take(line.trim());
        }
    }
    if channels.is_empty() {
        let (line, text) = last;
        let found = match text.trim() {
            "" => "an empty file".to_owned(),
            text if line == 1 => excerpt(text),
            _ => "none up to the end".to_owned(),
        };
        return Err(Fault::new(line, HEADING, found, "use the corrected data (volume 2) of this record"));
    }
    if open {
        let expected = "the closing line `/& End of data for channel` of the last channel";
        return Err(Fault::new(last.0, expected, "the end of the file", CUT_SHORT));
    }
    Ok(channels)
}

/// What the text before a channel's data says.
#[derive(Default)]
struct Preamble<'a> {
    first_lines: Vec<&'a str>,
    channel: Option<&'a str>,
    /// Peak acceleration in m/s², whatever its sign.
    peak: Option<f64>,
}

impl<'a> Preamble<'a> {
    fn take(&mut self, line: &'a str) {
        // As many as are ever kept.
        if self.first_lines.len() < 8 {
            self.first_lines.push(line);
        }
        let starts = |word: &str| find(line, word) == Some(0);
        if self.channel.is_none() && starts("CHAN") {
            self.channel = after(line, "CHAN");
        }
        if self.peak.is_none() && starts("PEAK ACCELERATION") {
            self.peak = after(line, "=").and_then(peak);
        }
    }

    /// `1: 90 DEG` of `CHAN  1:  90 DEG`; without such a line, the position in the file.
    fn label(&self, index: usize) -> String {
        let words = self.channel.unwrap_or_default().split_ascii_whitespace();
        // Long enough for every name, short enough for a list of them.
        let label: String = words.collect::<Vec<_>>().join(" ").chars().take(40).collect();
        if label.is_empty() { (index + 1).to_string() } else { label }
    }

    fn notes(&self) -> Vec<String> {
        notes(self.first_lines.iter().copied())
    }
}

/// The number and unit of `-267.957 CM/SEC/SEC AT 10.940 SEC.` in m/s², without its sign.
fn peak(text: &str) -> Option<f64> {
    let unit: Unit = leading_number(text).1.split_ascii_whitespace().next()?.parse().ok()?;
    leading_real(text).map(|value| unit.to_si(value.abs()))
}

/// One quantity of one channel.
struct Block;

impl Block {
    /// Reads what follows a heading; `None` for a velocity or displacement.
    fn read<'a>(
        (number, heading): Line<'a>,
        rest: &mut Peekable<impl Iterator<Item = Line<'a>>>,
        options: &ReadOptions,
    ) -> Result<Option<Parsed>, Fault> {
        let fault = |expected: &str| Fault::new(number, expected, excerpt(heading.trim()), DAMAGED);
        let count = leading_number(heading).0.parse().map_err(|_| fault("a number of points"))?;
        let layout = Layout::stated_in(heading).unwrap_or(LAYOUT);
        let acceleration = find(heading, "ACCEL").is_some();
        let mut samples = Vec::new();
        let (mut unit, mut step) = (None, 0.0);
        if acceleration {
            let spacing = after(heading, "SPACED AT").map(|text| leading_number(text).0).and_then(real);
            step = spacing
                .filter(|step| *step > 0.0 && step.is_finite())
                .ok_or_else(|| fault("a step in sec"))?;
            check_stated_step(options.step, step, number)?;
            let word =
                unit_word(heading).or_else(|| after(heading, ", IN ")?.split_ascii_whitespace().next());
            let word = word.ok_or_else(|| fault("a unit, `in cm/sec2`"))?;
            unit = Some(Unit::settled(word.trim_end_matches(['.', ',', ')']), number, options.unit)?);
        }
        let last_line = layout.read(rest, count, number, |value, line, field| {
            if let Some(unit) = unit {
                samples.push(unit.checked_to_si(value, line, field)?);
            }
            Ok(())
        })?;
        layout.check_ended(rest.peek().copied(), count, number)?;
        Ok(unit.map(|unit| Parsed::new(step, samples, unit, last_line, Vec::new())))
    }
}
