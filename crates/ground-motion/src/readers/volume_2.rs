//! What COSMOS and CSMIP volume 2 share: channels of text and headers, each with blocks of data that state
//! their own count and Fortran format, and a closing line.

use std::iter::Peekable;

use crate::error::{CUT_SHORT, DAMAGED, Fault, excerpt};
use crate::fields::{Layout, Numbered, after, find, leading_number, leading_real, untrimmed_lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;
use crate::warning::Warning;

/// Longest name of a channel: enough for every name, short enough for a list of them.
const NAME_CHARACTERS: usize = 40;

/// Lines of text that are kept: at least as many as a record keeps of its header.
const TEXT_LINES: usize = 8;

/// How one of the two formats writes a file.
pub(super) struct Dialect {
    /// Returns whether a line is the heading of a block of data.
    pub(super) is_heading: fn(&str) -> bool,
    /// The word in the heading of accelerations; other blocks are read only to check that they are complete.
    pub(super) acceleration: &'static str,
    /// Format of a block whose heading states none.
    pub(super) layout: Option<Layout>,
    /// Reads the scale of a number of accelerations from their heading and what precedes it.
    pub(super) scale: fn(&Channel<'_>, Numbered<'_>, usize, &RecordOptions) -> Result<Scale, Fault>,
    /// Finds the name of a channel in a line of text.
    pub(super) name: fn(&str) -> Option<&str>,
    /// Start of the line that closes a channel, and that line for messages.
    pub(super) closing: [&'static str; 2],
    /// Whether a file without that line is refused, although it has all stated numbers.
    pub(super) needs_closing: bool,
    /// What is missing from a file without accelerations, and the remedy.
    pub(super) data: [&'static str; 2],
}

/// Scale of a block of accelerations.
pub(super) struct Scale {
    /// Time between samples (s).
    pub(super) step: f64,
    pub(super) unit: Unit,
    /// Stated peak (m/s²), without its sign.
    pub(super) peak: Option<f64>,
}

/// What is known of a channel when its data begin.
#[derive(Default)]
pub(super) struct Channel<'a> {
    text: Vec<&'a str>,
    name: Option<&'a str>,
    /// Peak acceleration that the text states (m/s²), without its sign.
    pub(super) peak: Option<f64>,
    /// Real headers and the line that announces them; COSMOS has them.
    pub(super) reals: Vec<f64>,
    pub(super) reals_line: usize,
}

/// The line that announces the real headers.
pub(super) const REALS: &str = "REAL-HEADER VALUES FOLLOW";

/// Reads every acceleration of a file.
pub(super) fn parse(text: &str, options: &RecordOptions, dialect: &Dialect) -> Result<Vec<Parsed>, Fault> {
    let mut rest = untrimmed_lines(text).peekable();
    let mut channels: Vec<Parsed> = Vec::new();
    let mut channel = Channel::default();
    let mut last = (1, "");
    let (mut other, mut open) = (None, None);
    // version 1.20 of COSMOS may close a channel as CSMIP does
    let is_closing = |line| [dialect.closing[0], "/&"].iter().any(|start| find(line, start) == Some(0));
    while let Some((number, line)) = rest.next() {
        last = (number, line);
        if line.trim_start().starts_with('|') {
            // a comment
        } else if find(line, REALS).is_some() {
            channel.read_reals(last, &mut rest)?;
        } else if (dialect.is_heading)(line) {
            open = Some(layout_of(last, dialect)?.width);
            match channel.read_block(last, &mut rest, options, dialect)? {
                Some(mut parsed) => {
                    parsed.channel = Some(channel.label(channels.len()));
                    channels.push(parsed);
                }
                None => other = Some(last),
            }
        } else if is_closing(line) {
            channel = Channel::default();
            open = None;
        } else {
            channel.read_text(line.trim(), dialect);
        }
    }
    if channels.is_empty() {
        let (number, line) = other.unwrap_or(last);
        let is_quoted = number == 1 || other.is_some();
        let found = if is_quoted { excerpt(line.trim()) } else { "none up to the end".to_owned() };
        return Err(Fault::new(number, dialect.data[0], found, dialect.data[1]));
    }
    if let (Some(width), Some(channel)) = (open, channels.last_mut()) {
        // the count is stated, so that nothing but the end of the last number may be missing
        let is_whole = untrimmed_lines(text).last().is_some_and(|(_, line)| line.len() % width == 0);
        if dialect.needs_closing || !is_whole {
            let expected = format!("the closing line {} of the last channel", dialect.closing[1]);
            return Err(Fault::new(last.0, expected, "the end of the file", CUT_SHORT));
        }
        channel.warnings.push(Warning::Unclosed);
    }
    Ok(channels)
}

impl<'a> Channel<'a> {
    /// Keeps a line of the channel's text, and the name and the peak that it may state.
    fn read_text(&mut self, line: &'a str, dialect: &Dialect) {
        if self.text.len() < TEXT_LINES {
            self.text.push(line);
        }
        self.name = self.name.or_else(|| (dialect.name)(line));
        if self.peak.is_none() && find(line, "PEAK ACCELERATION") == Some(0) {
            self.peak = after(line, "=").and_then(peak);
        }
    }

    fn read_reals(
        &mut self,
        (number, line): Numbered<'a>,
        rest: &mut impl Iterator<Item = Numbered<'a>>,
    ) -> Result<(), Fault> {
        let (Ok(count), Some(layout)) = (leading_number(line).0.parse(), Layout::stated_in(line)) else {
            let expected = "`100 Real-header values follow on 20 lines, Format= (5F15.6)`";
            return Err(Fault::excerpt(number, expected, line.trim(), DAMAGED));
        };
        (self.reals, self.reals_line) = (layout.numbers(rest, count, number)?.0, number);
        Ok(())
    }

    /// Reads what follows a heading; `None` for a velocity or displacement.
    fn read_block(
        &self,
        heading: Numbered<'a>,
        rest: &mut Peekable<impl Iterator<Item = Numbered<'a>>>,
        options: &RecordOptions,
        dialect: &Dialect,
    ) -> Result<Option<Parsed>, Fault> {
        let (number, line) = heading;
        let count = leading_number(line).0.parse().map_err(|_| in_heading(heading, "a number of points"))?;
        let layout = layout_of(heading, dialect)?;
        if find(line, dialect.acceleration).is_none() {
            layout.numbers(rest, count, number)?;
            layout.check_ended(rest.peek().copied(), count, number)?;
            return Ok(None);
        }
        let Scale { step, unit, peak } = (dialect.scale)(self, heading, count, options)?;
        let mut parsed = Parsed::new(step, unit, number);
        parsed.read(layout, rest, count, number)?;
        parsed.stated_peak = peak;
        parsed.is_vertical = self.name.is_some_and(is_vertical);
        parsed.keep_header(self.text.iter().copied());
        Ok(Some(parsed))
    }

    /// Makes the label `1: 90 Deg` from `Chan   1:  90 Deg`; without a name or with an unknown number, from
    /// the position in the file.
    fn label(&self, index: usize) -> String {
        let words: Vec<_> = self.name.unwrap_or_default().split_ascii_whitespace().collect();
        let label: String = words.join(" ").chars().take(NAME_CHARACTERS).collect();
        match label.split_once(':') {
            Some(("?", direction)) => format!("{}:{direction}", index + 1),
            _ if label.is_empty() => (index + 1).to_string(),
            _ => label,
        }
    }
}

/// Finds the format of the numbers below a heading.
fn layout_of(heading: Numbered<'_>, dialect: &Dialect) -> Result<Layout, Fault> {
    let layout = Layout::stated_in(heading.1).or(dialect.layout);
    layout.ok_or_else(|| in_heading(heading, "a format such as `Format=(8F10.6)`"))
}

/// Makes a fault in a heading.
pub(super) fn in_heading((number, line): Numbered<'_>, expected: &str) -> Fault {
    Fault::excerpt(number, expected, line.trim(), DAMAGED)
}

/// Reads `-267.957 CM/SEC/SEC AT 10.940 SEC.` in m/s², without its sign.
fn peak(text: &str) -> Option<f64> {
    let unit: Unit = leading_number(text).1.split_ascii_whitespace().next()?.parse().ok()?;
    leading_real(text).map(|value| unit.to_si(value.abs()))
}
