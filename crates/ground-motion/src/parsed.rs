//! What the reader of a format returns.

use std::iter::Peekable;

use crate::error::{DAMAGED, Fault};
use crate::fields::{Layout, Line, check_count};
use crate::unit::Unit;

/// How many lines of a header are kept, and how many characters of each.
const HEADER_LINES: usize = 4;
const HEADER_CHARACTERS: usize = 200;

/// One channel of a record file, not yet a motion.
pub(crate) struct Parsed {
    /// Time between samples (s).
    pub(crate) step: f64,
    pub(crate) unit: Unit,
    /// Samples (m/s²).
    pub(crate) samples: Vec<f64>,
    /// Line of the last sample.
    pub(crate) last_line: usize,
    pub(crate) first_time: f64,
    pub(crate) channel: Option<String>,
    pub(crate) stated_peak: Option<f64>,
    /// Whether the file states the direction as vertical.
    pub(crate) is_vertical: bool,
    pub(crate) header: Vec<String>,
}

/// Returns whether one of the words of a direction, as files state it, means vertical.
pub(crate) fn is_vertical(direction: &str) -> bool {
    const VERTICAL: [&str; 11] =
        ["UP", "DOWN", "DN", "DWN", "UD", "U-D", "V", "VER", "VERT", "VERTICAL", "Z"];
    let mut words = direction.split(|c: char| !(c.is_alphanumeric() || c == '-'));
    words.any(|word| VERTICAL.iter().any(|vertical| word.eq_ignore_ascii_case(vertical)))
}

impl Parsed {
    /// Makes a channel without a name that starts at time zero; its samples follow after line `last_line`.
    pub(crate) fn new(step: f64, unit: Unit, last_line: usize) -> Self {
        let (samples, header) = (Vec::new(), Vec::new());
        let (first_time, channel, stated_peak, is_vertical) = (0.0, None, None, false);
        Self { step, unit, samples, last_line, first_time, channel, stated_peak, is_vertical, header }
    }

    /// Takes the next sample, the value of a field on a line; refuses one that is not finite.
    pub(crate) fn push(
        &mut self,
        value: Option<f64>,
        line: usize,
        field: &str,
        expected: &str,
    ) -> Result<(), Fault> {
        let sample = value.map(|value| self.unit.to_si(value)).filter(|sample| sample.is_finite());
        self.samples.push(sample.ok_or_else(|| Fault::excerpt(line, expected, field, DAMAGED))?);
        self.last_line = line;
        Ok(())
    }

    /// Takes `count` samples in a Fortran format, and refuses more; line `stated` says how many.
    pub(crate) fn read<'a>(
        &mut self,
        layout: Layout,
        lines: &mut Peekable<impl Iterator<Item = Line<'a>>>,
        count: usize,
        stated: usize,
    ) -> Result<(), Fault> {
        let (numbers, last_line) = layout.numbers(lines, count, stated)?;
        self.samples = numbers.into_iter().map(|value| self.unit.to_si(value)).collect();
        self.last_line = self.last_line.max(last_line);
        layout.check_ended(lines.peek().copied(), count, stated)
    }

    /// Refuses a number of samples other than the one that `stated_by` says.
    pub(crate) fn check_count(&self, stated: usize, stated_by: &str) -> Result<(), Fault> {
        check_count(self.samples.len(), stated, stated_by, self.last_line)
    }

    /// Keeps the first lines of a header, shortened.
    pub(crate) fn keep_header<'a>(&mut self, header: impl Iterator<Item = &'a str>) {
        let shortened = |line: &str| line.chars().take(HEADER_CHARACTERS).collect();
        self.header = header.take(HEADER_LINES).map(shortened).collect();
    }
}
