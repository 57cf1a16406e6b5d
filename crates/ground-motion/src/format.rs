//! Formats of record files.

use std::path::Path;
use std::str::FromStr;

use serde::Deserialize;

use crate::error::GroundMotionError;

/// Format of a record file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash, Deserialize)]
#[serde(try_from = "String")]
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
    /// GeoNet of New Zealand, V1A or V2A.
    Geonet,
    /// Text of AFAD, Türkiye.
    Afad,
    /// Taiwan's Central Weather Administration.
    Cwa,
    /// UNAM's standard file, Mexico.
    Unam,
    /// Volume 1 of RENADIC (Chile) or BHRC (Iran).
    Volume1,
    /// K-NET or KiK-net as CSV.
    KnetCsv,
    /// Plain numbers, several a line, as OpenSees reads them.
    Numbers,
    /// A text table: times and accelerations between commas, semicolons, tabs or blanks; or one column.
    Csv,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 14] = [
        Self::At2,
        Self::Esm,
        Self::Knet,
        Self::KnetCsv,
        Self::Cosmos,
        Self::Csmip,
        Self::Smc,
        Self::Geonet,
        Self::Afad,
        Self::Cwa,
        Self::Unam,
        Self::Volume1,
        Self::Csv,
        Self::Numbers,
    ];

    /// Returns the format's short name, such as `at2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::At2 => "at2",
            Self::Esm => "esm",
            Self::Knet => "knet",
            Self::Cosmos => "cosmos",
            Self::Csmip => "csmip",
            Self::Smc => "smc",
            Self::Geonet => "geonet",
            Self::Afad => "afad",
            Self::Cwa => "cwa",
            Self::Unam => "unam",
            Self::Volume1 => "volume1",
            Self::KnetCsv => "knet-csv",
            Self::Numbers => "numbers",
            Self::Csv => "csv",
        }
    }

    /// Returns what people call the format.
    pub fn description(self) -> &'static str {
        match self {
            Self::At2 => "PEER AT2",
            Self::Esm => "ESM/ITACA",
            Self::Knet => "K-NET/KiK-net",
            Self::Cosmos => "COSMOS V2",
            Self::Csmip => "CSMIP V2",
            Self::Smc => "USGS SMC",
            Self::Geonet => "GeoNet",
            Self::Afad => "AFAD",
            Self::Cwa => "CWA",
            Self::Unam => "UNAM",
            Self::Volume1 => "RENADIC/BHRC",
            Self::KnetCsv => "K-NET CSV",
            Self::Numbers => "numbers",
            Self::Csv => "CSV",
        }
    }

    /// Finds the format by the ending of a file's name.
    pub(crate) fn by_ending(name: &str) -> Option<Self> {
        let ending = Path::new(name).extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "at2" => Some(Self::At2),
            "asc" => Some(Self::Esm),
            "ew" | "ns" | "ud" | "ew1" | "ns1" | "ud1" | "ew2" | "ns2" | "ud2" => Some(Self::Knet),
            "v2c" => Some(Self::Cosmos),
            "v2" => Some(Self::Csmip),
            "smc" => Some(Self::Smc),
            "v1a" | "v2a" => Some(Self::Geonet),
            _ => None,
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

impl TryFrom<String> for Format {
    type Error = GroundMotionError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}
