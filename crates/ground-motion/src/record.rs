//! Record files: reads them within bounds and picks channels.

use std::path::Path;

use crate::companion::Companion;
use crate::error::{Fault, GroundMotionError, excerpt};
use crate::file::{check_is_text, read_bounded, shown_path};
use crate::format::Format;
use crate::motion::GroundMotion;
use crate::options::{RecordOptions, is_close};
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical;
use crate::warning::Warning;

/// Longest time step of a file that is read without being stated too (s).
const LONGEST_STEP: f64 = 1.0;

/// A motion as read from a file.
#[derive(Clone, PartialEq, Debug)]
pub struct Record {
    /// The motion, in m/s².
    pub motion: GroundMotion,
    /// Format it was read in.
    pub format: Format,
    /// Unit of the file.
    pub unit: Unit,
    /// Time of the first sample in the file (s); the motion itself starts at zero.
    pub first_time: f64,
    /// Number and name of the channel, in formats that have several in a file.
    pub channel: Option<String>,
    /// Peak acceleration the file itself states (m/s²).
    pub stated_peak: Option<f64>,
    /// What rounding may have changed of the stated peak (m/s²).
    pub peak_rounding: f64,
    /// What the reader has to say about the file; [`Record::check`] has it among its warnings.
    pub warnings: Vec<Warning>,
    /// Whether the file, or its name, states the direction as vertical.
    pub is_vertical: bool,
    /// First lines of the header.
    pub header: Vec<String>,
}

impl Parsed {
    fn into_record(self, format: Format, stated_step: Option<f64>) -> Result<Record, Fault> {
        let Self { step, samples, last_line, .. } = self;
        if step > LONGEST_STEP && stated_step.is_none() {
            let remedy = "the times may be in milliseconds, or numbers of samples: write seconds; if the \
                          step is right, state it, as `step` (on the command line --record-step, in Python \
                          dt)";
            let expected = format!("a time step of at most {LONGEST_STEP} s");
            return Err(Fault::new(last_line, expected, format!("{step} s"), remedy));
        }
        if has_times(&samples) {
            let found = "pairs of times and accelerations, or times above accelerations";
            let remedy = "write times and accelerations in two columns; uneven times are not read";
            return Err(Fault::new(last_line, "samples of the acceleration alone", found, remedy));
        }
        let motion = GroundMotion::new(step, samples).map_err(|error| {
            Fault::new(
                last_line,
                "a sound motion",
                format!("that {error}"),
                "check that the file is complete, and correct it",
            )
        })?;
        Ok(Record {
            motion,
            format,
            unit: self.unit,
            first_time: self.first_time,
            channel: self.channel,
            stated_peak: self.stated_peak,
            peak_rounding: self.peak_rounding,
            warnings: self.warnings,
            is_vertical: self.is_vertical,
            header: self.header,
        })
    }
}

/// Reads a record file: its only channel, or the one that is asked for.
///
/// Only regular files of at most [`MAX_FILE_BYTES`](crate::MAX_FILE_BYTES) are read; memory stays within a
/// small multiple of the file.
///
/// # Errors
/// If the file cannot be read or is not a record, or if it has several channels and none of them is asked
/// for; the message names the file, the line, what was expected, what was found and the remedy.
pub fn read(path: impl AsRef<Path>, options: &RecordOptions) -> Result<Record, GroundMotionError> {
    let path = path.as_ref();
    only(read_channels(path, options)?, &shown_path(path))
}

/// Reads every channel of a record file, or the one that is asked for.
///
/// # Errors
/// As [`read`], except that several channels are no error.
pub fn read_channels(
    path: impl AsRef<Path>,
    options: &RecordOptions,
) -> Result<Vec<Record>, GroundMotionError> {
    let path = path.as_ref();
    let name = shown_path(path);
    let bytes = read_bounded(path, &name)?;
    let Some(times) = Companion::beside(path, options)? else { return parse_channels(&name, bytes, options) };
    let options = RecordOptions { step: Some(times.step), ..options.clone() };
    let records = parse_channels(&name, bytes, &options)?;
    records.iter().try_for_each(|record| times.check_count(record.motion.samples().len()))?;
    Ok(records)
}

/// Reads a record from the bytes of a file; `name` stands for the file in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(name: &str, bytes: Vec<u8>, options: &RecordOptions) -> Result<Record, GroundMotionError> {
    only(parse_channels(name, bytes, options)?, name)
}

/// Returns whether every second sample rises as times do, while those between do not; or whether the first
/// half rises uniformly, as a row of times above a row of samples.
fn has_times(samples: &[f64]) -> bool {
    const FEWEST: usize = 20;
    let rise = |start: usize| samples[start..].iter().step_by(2).is_sorted_by(|before, after| before < after);
    let (times, rest) = samples.split_at(samples.len() / 2);
    let is_step = |pair: &[f64]| is_close(times[1] - times[0], pair[1] - pair[0]);
    let is_row = || times[1] > times[0] && times.windows(2).all(is_step) && !rest.windows(2).all(is_step);
    samples.len() >= FEWEST && (rise(0) && !rise(1) || is_row())
}

/// Returns the only record of a file.
fn only(mut records: Vec<Record>, name: &str) -> Result<Record, GroundMotionError> {
    let channels: Vec<_> = records.iter().map(|record| record.channel.clone().unwrap_or_default()).collect();
    match records.pop() {
        Some(record) if records.is_empty() => Ok(record),
        _ => Err(not_one(name, "", &channels)),
    }
}

/// Reads every channel from the bytes of a file, or the one that is asked for; `name` stands for the file in
/// messages.
///
/// # Errors
/// As [`read_channels`].
pub fn parse_channels(
    name: &str,
    bytes: Vec<u8>,
    options: &RecordOptions,
) -> Result<Vec<Record>, GroundMotionError> {
    if let Some(step) = options.step.filter(|step| !(*step > 0.0 && step.is_finite())) {
        return Err(GroundMotionError::Step { step });
    }
    let (format, mut parsed) = parsed(name, bytes, options).map_err(|fault| fault.in_file(name))?;
    if let Some(wanted) = &options.channel {
        parsed = vec![chosen(parsed, wanted, name)?];
    }
    let records = parsed.into_iter().map(|parsed| parsed.into_record(format, options.step));
    records.map(|record| record.map_err(|fault| fault.in_file(name))).collect()
}

/// Finds the format of a text and reads its channels.
fn parsed(name: &str, mut bytes: Vec<u8>, options: &RecordOptions) -> Result<(Format, Vec<Parsed>), Fault> {
    let remedy = "binary files are not read: save the record as plain text (UTF-8)";
    // the end mark of DOS, and blanks
    let is_content = |byte: &u8| !matches!(byte, 0x1a | b'\t' | b'\n' | b'\r' | b' ');
    bytes.truncate(bytes.iter().rposition(is_content).map_or(0, |last| last + 1));
    check_is_text(&bytes, "text", remedy)?;
    let decoded = decode(bytes);
    let text = decoded.trim_start_matches('\u{feff}');
    if text.trim().is_empty() {
        return Err(Fault::new(1, "a record", "an empty file", "check that this is the right file"));
    }
    let format = options.format.map_or_else(|| Format::of(name, text, options), Ok)?;
    let mut parsed = format.parse(text, options)?;
    if vertical::by_name(name, format, options) {
        for channel in &mut parsed {
            channel.is_vertical = true;
        }
    }
    Ok((format, parsed))
}

/// Picks the channel with a number or name.
fn chosen(parsed: Vec<Parsed>, wanted: &str, name: &str) -> Result<Parsed, GroundMotionError> {
    let wanted = wanted.trim();
    let is_wanted = |label: &str| {
        let number = label.split_once(':').map_or(label, |(number, _)| number);
        number.trim() == wanted || label.eq_ignore_ascii_case(wanted)
    };
    let channels: Vec<_> = parsed.iter().map(|parsed| parsed.channel.clone().unwrap_or_default()).collect();
    let mut matches = parsed.into_iter().filter(|parsed| parsed.channel.as_deref().is_some_and(is_wanted));
    match (matches.next(), matches.next()) {
        (Some(parsed), None) => Ok(parsed),
        _ => Err(not_one(name, &format!(" {}", excerpt(wanted)), &channels)),
    }
}

/// Makes the error of a file that does not have one channel, or one with the name that is wanted.
fn not_one(file: &str, wanted: &str, channels: &[String]) -> GroundMotionError {
    const MOST: usize = 12;
    let named = channels.iter().filter(|label| !label.is_empty());
    let names: Vec<_> = named.take(MOST).map(|label| excerpt(label)).collect();
    let more = if channels.len() > MOST { ", …" } else { "" };
    let found = if names.is_empty() { "one without a name".to_owned() } else { names.join(", ") + more };
    GroundMotionError::Channel { file: file.to_owned(), wanted: wanted.to_owned(), found }
}

/// Decodes UTF-8, or else Latin-1, in which old headers name stations.
fn decode(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes)
        .unwrap_or_else(|error| error.as_bytes().iter().map(|&byte| char::from(byte)).collect())
}
