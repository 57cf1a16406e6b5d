//! COSMOS volume 2 records (`.V2`, `.V2c`).
//!
//! Lines of text, then headers and data that state their own counts and Fortran formats:
//!
//! ```text
//! Corrected acceleration    (Format v01.20 with 13 text lines)
//! …
//!  100 Integer-header values follow on  10 lines, Format= (10I8)
//!  100 Real-header values follow on  20 lines, Format= (5F15.6)
//!    6 Comment line(s) follow, each starting with a "|":
//!    42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)
//! End-of-data for Chan … acceleration
//! ```
//!
//! Real header 62 is the sample interval in ms, 64 the peak. A file may hold several channels.

use std::iter::Peekable;

use super::error::{Fault, excerpt};
use super::fields::{CUT_SHORT, DAMAGED, Layout, Line, after, find, leading_number, leading_real};
use super::record::{Parsed, ReadOptions, check_stated_step, notes, untrimmed_lines};
use super::{Unit, index_as_f64};

/// Places of the sample interval (ms) and the peak among the real headers, from 0.
const INTERVAL: usize = 61;
const PEAK: usize = 63;

/// The value of what is not known.
const UNKNOWN: f64 = -999.0;

/// Whether the first line is that of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| find(line, "(FORMAT V").is_some())
        || head.iter().any(|line| find(line, "REAL-HEADER VALUES FOLLOW").is_some())
}

/// What is known when a channel's data begin.
#[derive(Default)]
struct Channel<'a> {
    text: Vec<&'a str>,
    name: Option<&'a str>,
    reals: Vec<f64>,
    reals_line: usize,
}

/// Reads every acceleration of a COSMOS file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Vec<Parsed>, Fault> {
    let mut rest = untrimmed_lines(text).peekable();
    let mut channels: Vec<Parsed> = Vec::new();
    let mut channel = Channel::default();
    let mut last = (1, "");
    let (mut other, mut open) = (None, false);
    while let Some((number, line)) = rest.next() {
        last = (number, line);
        if line.starts_with('|') {
            continue;
        }
        if find(line, "REAL-HEADER VALUES FOLLOW").is_some() {
            channel.read_reals((number, line), &mut rest)?;
        } else if find(line, " PTS,").is_some() && find(line, "FORMAT=").is_some() {
            open = true;
            match channel.read_data((number, line), &mut rest, options)? {
                Some(mut parsed) => {
                    parsed.channel = Some(channel.label(channels.len()));
                    channels.push(parsed);
                }
                None => other = Some((number, line)),
            }
        } else if find(line, "END-OF-DATA") == Some(0) {
            channel = Channel::default();
            open = false;
        } else {
            channel.take(line.trim());
        }
    }
    if channels.is_empty() {
        let (number, line) = other.unwrap_or(last);
        let found = match line.trim() {
            "" => "an empty file".to_owned(),
            line if number == 1 || other.is_some() => excerpt(line),
            _ => "none up to the end".to_owned(),
        };
        let expected =
            "acceleration data, `42000 acceleration pts, approx 210 secs, units=cm/sec2(04),Format=(1E15.6)`";
        return Err(Fault::new(number, expected, found, "use the whole acceleration file of this record"));
    }
    if open {
        let expected = "the closing line `End-of-data` of the last channel";
        return Err(Fault::new(last.0, expected, "the end of the file", CUT_SHORT));
    }
    Ok(channels)
}

impl<'a> Channel<'a> {
    fn take(&mut self, line: &'a str) {
        // As many as are ever kept, beside the one that names the channel.
        if self.text.len() < 8 {
            self.text.push(line);
        }
        if self.name.is_none() {
            self.name = after(line, "STA CHAN");
        }
    }

    fn read_reals(
        &mut self,
        (number, line): Line<'a>,
        rest: &mut impl Iterator<Item = Line<'a>>,
    ) -> Result<(), Fault> {
        let (Ok(count), Some(layout)) = (leading_number(line).0.parse(), Layout::stated_in(line)) else {
            let expected = "`100 Real-header values follow on 20 lines, Format= (5F15.6)`";
            return Err(Fault::new(number, expected, excerpt(line.trim()), DAMAGED));
        };
        self.reals.clear();
        self.reals_line = number;
        layout.read(rest, count, number, |value, _, _| {
            self.reals.push(value);
            Ok(())
        })?;
        Ok(())
    }

    fn real(&self, place: usize) -> Option<f64> {
        self.reals.get(place).copied().filter(|value| *value != UNKNOWN)
    }

    /// The interval between samples (s) of `count` samples over about `approximate` seconds.
    fn step(&self, heading: Line<'_>, count: usize, options: &ReadOptions) -> Result<f64, Fault> {
        let place = INTERVAL + 1;
        let Some(interval) = self.real(INTERVAL).filter(|interval| *interval > 0.0) else {
            let expected = format!("the sample interval in ms as real header {place}");
            return Err(Fault::new(self.reals_line.max(1), expected, "none", "complete the header"));
        };
        let step = interval / 1000.0;
        check_stated_step(options.step, step, self.reals_line)?;
        let (number, line) = heading;
        if let Some(approximate) = after(line, "APPROX").and_then(leading_real) {
            let duration = index_as_f64(count) * step;
            // The heading rounds to whole seconds, up or down.
            if (duration - approximate).abs() > 1.0 + 0.01 * approximate {
                let expected = format!(
                    "about {duration} s, {count} points at the {interval} ms of real header {place} after line {}",
                    self.reals_line
                );
                let found = format!("approx {approximate} s");
                return Err(Fault::new(
                    number,
                    expected,
                    found,
                    "the headers disagree: fetch the file again",
                ));
            }
        }
        Ok(step)
    }

    /// Reads what follows a data heading; `None` for a velocity or displacement.
    fn read_data(
        &self,
        (number, line): Line<'a>,
        rest: &mut Peekable<impl Iterator<Item = Line<'a>>>,
        options: &ReadOptions,
    ) -> Result<Option<Parsed>, Fault> {
        let fault = |expected: &str| Fault::new(number, expected, excerpt(line.trim()), DAMAGED);
        let count = leading_number(line).0.parse().map_err(|_| fault("a number of points"))?;
        let layout = Layout::stated_in(line).ok_or_else(|| fault("a format such as `Format=(8F10.6)`"))?;
        let (mut unit, mut step) = (None, 0.0);
        if find(line, "ACCELERATION PTS").is_some() {
            let word = after(line, "UNITS=").and_then(|text| text.split(['(', ',']).next());
            let word = word.ok_or_else(|| fault("a unit, `units=cm/sec2(04)`"))?;
            unit = Some(Unit::settled(word, number, options.unit)?);
            step = self.step((number, line), count, options)?;
        }
        let mut samples = Vec::new();
        let last_line = layout.read(rest, count, number, |value, line, field| {
            if let Some(unit) = unit {
                samples.push(unit.checked_to_si(value, line, field)?);
            }
            Ok(())
        })?;
        layout.check_ended(rest.peek().copied(), count, number)?;
        Ok(unit.map(|unit| {
            let mut parsed = Parsed::new(step, samples, unit, last_line, notes(self.text.iter().copied()));
            parsed.stated_peak = self.real(PEAK).map(|peak| unit.to_si(peak.abs()));
            parsed
        }))
    }

    /// `1: 90 Deg` of `Sta Chan   1: 90 Deg (Rcrdr Chan  1) Location: …`; an unknown number becomes the position in
    /// the file.
    fn label(&self, index: usize) -> String {
        let name = self.name.unwrap_or_default();
        let name = name.split(['(']).next().unwrap_or_default();
        let label: String =
            name.split_ascii_whitespace().collect::<Vec<_>>().join(" ").chars().take(40).collect();
        match label.split_once(':') {
            Some(("?", direction)) => format!("{}:{direction}", index + 1),
            _ if label.is_empty() => (index + 1).to_string(),
            _ => label,
        }
    }
}
