//! What the reader of a format returns.

use std::iter::Peekable;

use crate::error::Fault;
use crate::fields::{Layout, Numbered, leading_real, rounding};
use crate::unit::Unit;
use crate::warning::Warning;

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
    /// What rounding may have changed of the stated peak (m/s²).
    pub(crate) peak_rounding: f64,
    /// What the reader has to say about the file.
    pub(crate) warnings: Vec<Warning>,
    /// Whether the file states the direction as vertical.
    pub(crate) is_vertical: bool,
    pub(crate) header: Vec<String>,
}

impl Parsed {
    /// Makes a channel without a name that starts at time zero; its samples follow after line `last_line`.
    pub(crate) fn new(step: f64, unit: Unit, last_line: usize) -> Self {
        Self {
            step,
            unit,
            samples: Vec::new(),
            last_line,
            first_time: 0.0,
            channel: None,
            stated_peak: None,
            peak_rounding: 0.0,
            warnings: Vec::new(),
            is_vertical: false,
            header: Vec::new(),
        }
    }

    /// Takes the next sample, a number on a line; where it is none, or not finite in m/s², `fault` says so.
    pub(crate) fn push(
        &mut self,
        value: Option<f64>,
        line: usize,
        fault: impl FnOnce() -> Fault,
    ) -> Result<(), Fault> {
        let sample = value.map(|value| self.unit.to_si(value)).filter(|sample| sample.is_finite());
        self.samples.push(sample.ok_or_else(fault)?);
        self.last_line = line;
        Ok(())
    }

    /// Takes `count` samples in a Fortran format, and refuses more; line `stated` says how many.
    pub(crate) fn read<'a>(
        &mut self,
        layout: Layout,
        lines: &mut Peekable<impl Iterator<Item = Numbered<'a>>>,
        count: usize,
        stated: usize,
    ) -> Result<(), Fault> {
        let (numbers, last_line) = layout.numbers(lines, count, stated)?;
        self.samples = numbers.into_iter().map(|value| self.unit.to_si(value)).collect();
        self.last_line = self.last_line.max(last_line);
        layout.check_ended(lines.peek().copied(), count, stated)
    }

    /// Takes the peak that a header states, in the unit of the file and rounded as it is written there. A
    /// peak of 0 states nothing.
    pub(crate) fn state_peak(&mut self, text: &str) {
        if let Some(peak) = leading_real(text).filter(|peak| *peak != 0.0) {
            self.stated_peak = Some(self.unit.to_si(peak.abs()));
            self.peak_rounding = self.unit.to_si(rounding(text));
        }
    }

    /// Keeps the first lines of a header, shortened.
    pub(crate) fn keep_header<'a>(&mut self, header: impl Iterator<Item = &'a str>) {
        let shortened = |line: &str| line.chars().take(HEADER_CHARACTERS).collect();
        self.header = header.take(HEADER_LINES).map(shortened).collect();
    }
}
