//! Formats of record files, and how the content of a file gives its format away.

use std::path::Path;
use std::str::FromStr;

use super::error::Fault;
use super::record::{Parsed, ReadOptions, untrimmed_lines};
use super::{GroundMotionError, at2, cosmos, csmip, csv, esm, knet, smc};

/// A format is looked for in this many lines that are not blank.
const HEAD_LINES: usize = 80;

/// Format of a record file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
pub enum Format {
    /// PEER AT2.
    At2,
    /// ESM or ITACA ASCII.
    Esm,
    /// K-NET or KiK-net.
    Knet,
    /// COSMOS volume 2.
    Cosmos,
    /// CSMIP or CDMG volume 2.
    Csmip,
    /// USGS SMC.
    Smc,
    /// Comma-separated values: `time,…` with a header line, or one column.
    Csv,
}

/// Whether the first lines that are not blank are those of a format.
type Recognises = fn(&[&str]) -> bool;

impl Format {
    /// Every format.
    pub const ALL: [Self; 7] =
        [Self::At2, Self::Esm, Self::Knet, Self::Cosmos, Self::Csmip, Self::Smc, Self::Csv];

    /// The format's short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::At2 => "at2",
            Self::Esm => "esm",
            Self::Knet => "knet",
            Self::Cosmos => "cosmos",
            Self::Csmip => "csmip",
            Self::Smc => "smc",
            Self::Csv => "csv",
        }
    }

    /// What the format is, in words.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::At2 => "PEER AT2",
            Self::Esm => "ESM/ITACA",
            Self::Knet => "K-NET/KiK-net",
            Self::Cosmos => "COSMOS V2",
            Self::Csmip => "CSMIP V2",
            Self::Smc => "USGS SMC",
            Self::Csv => "CSV",
        }
    }

    /// The format of a text: by its content, and where that says nothing by the ending of the file's name.
    pub(super) fn of(name: &str, text: &str) -> Self {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        // CSMIP comes after COSMOS and SMC, whose first lines may have the same words; AT2, known by one word
        // anywhere in its header, comes last.
        let known: [(Self, Recognises); 6] = [
            (Self::Esm, esm::recognises),
            (Self::Knet, knet::recognises),
            (Self::Cosmos, cosmos::recognises),
            (Self::Smc, smc::recognises),
            (Self::Csmip, csmip::recognises),
            (Self::At2, at2::recognises),
        ];
        let by_content =
            known.into_iter().find(|(_, recognises)| recognises(&head)).map(|(format, _)| format);
        by_content.or_else(|| Self::by_ending(name)).unwrap_or(Self::Csv)
    }

    fn by_ending(name: &str) -> Option<Self> {
        let ending = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "at2" => Some(Self::At2),
            "asc" => Some(Self::Esm),
            "ew" | "ns" | "ud" | "ew1" | "ns1" | "ud1" | "ew2" | "ns2" | "ud2" => Some(Self::Knet),
            "v2c" => Some(Self::Cosmos),
            "v2" => Some(Self::Csmip),
            "smc" => Some(Self::Smc),
            _ => None,
        }
    }

    /// Reads every channel of a text in this format.
    pub(super) fn parse(self, text: &str, options: &ReadOptions) -> Result<Vec<Parsed>, Fault> {
        let one = |parsed: Result<Parsed, Fault>| parsed.map(|parsed| vec![parsed]);
        match self {
            Self::At2 => one(at2::parse(text, options)),
            Self::Esm => one(esm::parse(text, options)),
            Self::Knet => one(knet::parse(text, options)),
            Self::Cosmos => cosmos::parse(text, options),
            Self::Csmip => csmip::parse(text, options),
            Self::Smc => one(smc::parse(text, options)),
            Self::Csv => one(csv::parse(text, options)),
        }
    }
}

impl FromStr for Format {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|format| text.trim().eq_ignore_ascii_case(format.name()));
        known.ok_or_else(|| GroundMotionError::Format { found: text.chars().take(40).collect() })
    }
}
