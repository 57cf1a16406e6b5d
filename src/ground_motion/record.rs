//! Record files: finding the format, reading within bounds.
//!
//! A format is one module with `parse(text, options) -> Result<Parsed, Fault>`, a variant of [`Format`] and, if its
//! content gives it away, a line in [`Format::of`].

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::str::FromStr;

use super::error::Fault;
use super::{GroundMotion, GroundMotionError, Unit, at2, csv};

/// Largest file that is read: about four million samples in AT2, hours of shaking.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// How many lines of a header are kept as notes, and how many characters of each.
const NOTE_LINES: usize = 4;
const NOTE_CHARACTERS: usize = 200;

/// Format of a record file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
pub enum Format {
    /// PEER AT2.
    At2,
    /// Comma-separated values: `time,…` with a header line, or one column.
    Csv,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 2] = [Self::At2, Self::Csv];

    /// The format's short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::At2 => "at2",
            Self::Csv => "csv",
        }
    }

    /// What the format is, in words.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::At2 => "PEER AT2",
            Self::Csv => "CSV",
        }
    }

    /// The format of a text: by its content, and where that says nothing by the ending of the file's name.
    fn of(name: &str, text: &str) -> Self {
        let ending = Path::new(name).extension().unwrap_or_default();
        if at2::recognises(text) || ending.eq_ignore_ascii_case("at2") { Self::At2 } else { Self::Csv }
    }
}

impl FromStr for Format {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|format| text.trim().eq_ignore_ascii_case(format.name()));
        known.ok_or_else(|| GroundMotionError::Format { found: text.chars().take(40).collect() })
    }
}

/// What the user states about a record file.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ReadOptions {
    /// Unit of the samples. Needed where the file does not state it; must not contradict a file that does.
    pub unit: Option<Unit>,
    /// Time between samples (s). Needed where the file does not state it; must not contradict a file that does.
    pub step: Option<f64>,
    /// Name of the column to read, for tables with several.
    pub column: Option<String>,
    /// Format of the file; found from its content if none is given.
    pub format: Option<Format>,
}

/// A motion as read from a file.
#[derive(Clone, PartialEq, Debug)]
pub struct Record {
    /// The motion, in m/s².
    pub motion: GroundMotion,
    /// Format it was read in.
    pub format: Format,
    /// Unit of the file.
    pub unit: Unit,
    /// Time the file gives its first sample (s); the motion itself starts at zero.
    pub first_time: f64,
    /// First lines of the header.
    pub notes: Vec<String>,
}

/// What a format's reader returns: samples in m/s².
pub(super) struct Parsed {
    pub(super) step: f64,
    pub(super) samples: Vec<f64>,
    pub(super) unit: Unit,
    pub(super) first_time: f64,
    pub(super) notes: Vec<String>,
    pub(super) last_line: usize,
}

/// Reads a record file.
///
/// Only regular files of at most [`MAX_FILE_BYTES`] are read; reading stops at the first byte that no text has, and
/// memory stays within a small multiple of the file.
///
/// # Errors
/// If the file cannot be read or is not a record; the message names the file, the line, what was expected, what was
/// found and the remedy.
pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Record, GroundMotionError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let bytes = read_bounded(path, &name)?;
    parse(&name, bytes, options)
}

/// Reads a record from the bytes of a file; `name` stands for the file in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(name: &str, bytes: Vec<u8>, options: &ReadOptions) -> Result<Record, GroundMotionError> {
    if let Some(step) = options.step.filter(|step| !(*step > 0.0 && step.is_finite())) {
        return Err(GroundMotionError::Step { step });
    }
    check_is_text(&bytes, 1).map_err(|fault| fault.in_file(name))?;
    let decoded = decode(bytes);
    let text = decoded.trim_start_matches('\u{feff}');
    let format = options.format.unwrap_or_else(|| Format::of(name, text));
    let parsed = match format {
        Format::At2 => at2::parse(text, options),
        Format::Csv => csv::parse(text, options),
    };
    let parsed = parsed.map_err(|fault| fault.in_file(name))?;
    if parsed.samples.len() < 2 {
        let found = parsed.samples.len().to_string();
        let fault =
            Fault::new(parsed.last_line, "at least two samples", found, "check that the file is complete");
        return Err(fault.in_file(name));
    }
    let Parsed { step, samples, unit, first_time, notes, last_line } = parsed;
    let motion = GroundMotion::new(step, samples).map_err(|error| {
        Fault::new(last_line, "a sound motion", format!("that {error}"), "correct the file").in_file(name)
    })?;
    Ok(Record { motion, format, unit, first_time, notes })
}

/// The lines that are not blank, trimmed, with their numbers from 1. Line ends may be `\n`, `\r\n` or `\r\r\n`.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> + Clone {
    let numbered = text.split('\n').enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty())
}

/// The first lines of a header, shortened.
pub(super) fn notes<'a>(header: impl Iterator<Item = &'a str>) -> Vec<String> {
    header.take(NOTE_LINES).map(|line| line.chars().take(NOTE_CHARACTERS).collect()).collect()
}

fn read_bounded(path: &Path, name: &str) -> Result<Vec<u8>, GroundMotionError> {
    let failed = |reason: io::Error| GroundMotionError::Io { file: name.to_owned(), reason };
    let too_large =
        |found: String| GroundMotionError::TooLarge { file: name.to_owned(), found, limit: MAX_FILE_BYTES };
    let metadata = fs::metadata(path).map_err(failed)?;
    // Asked before opening: opening a pipe waits for its other end, and a device never ends.
    if !metadata.is_file() {
        let found = if metadata.is_dir() { "a folder" } else { "a pipe or device" };
        return Err(GroundMotionError::NotAFile { file: name.to_owned(), found });
    }
    if metadata.len() > MAX_FILE_BYTES {
        return Err(too_large(metadata.len().to_string()));
    }
    // The limit holds while reading too: a file may grow, or state no length.
    let mut file = File::open(path).map_err(failed)?.take(MAX_FILE_BYTES + 1);
    let mut bytes = Vec::new();
    let mut chunk = vec![0; 1 << 16];
    let mut line = 1;
    loop {
        let count = match file.read(&mut chunk) {
            Ok(0) => break,
            Ok(count) => count,
            Err(reason) if reason.kind() == io::ErrorKind::Interrupted => continue,
            Err(reason) => return Err(failed(reason)),
        };
        line = check_is_text(&chunk[..count], line).map_err(|fault| fault.in_file(name))?;
        bytes.extend_from_slice(&chunk[..count]);
    }
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(too_large("more".to_owned()));
    }
    Ok(bytes)
}

/// Refuses bytes that no text file has; counts lines on from `line`.
fn check_is_text(bytes: &[u8], mut line: usize) -> Result<usize, Fault> {
    for &byte in bytes {
        match byte {
            b'\n' => line += 1,
            b'\t' | b'\r' | 0x0c | 0x20..=0x7e | 0x80.. => {}
            _ => {
                let found = format!("the byte 0x{byte:02x}");
                let remedy = "binary and UTF-16 files are not read: save the record as plain text (UTF-8)";
                return Err(Fault::new(line, "text", found, remedy));
            }
        }
    }
    Ok(line)
}

/// UTF-8, or else Latin-1: old headers name stations in it.
fn decode(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes)
        .unwrap_or_else(|error| error.as_bytes().iter().map(|&byte| char::from(byte)).collect())
}
