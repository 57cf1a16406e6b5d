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
        self.facts()[0]
    }

    /// Returns what people call the format.
    pub fn description(self) -> &'static str {
        self.facts()[1]
    }

    /// Returns by what people know its files: their ending, their origin.
    pub fn files(self) -> &'static str {
        self.facts()[2]
    }

    /// Lists what people call the formats.
    ///
    /// ```
    /// assert!(ground_motion::Format::listed().starts_with("PEER AT2, ESM/ITACA, K-NET/KiK-net"));
    /// ```
    pub fn listed() -> String {
        Self::ALL.map(Self::description).join(", ")
    }

    fn facts(self) -> [&'static str; 3] {
        match self {
            Self::At2 => ["at2", "PEER AT2", "NGA-West and older"],
            Self::Esm => ["esm", "ESM/ITACA", "`.ASC`; ITACA before DYNA 1.2; AFAD `.asc` (Türkiye)"],
            Self::Knet => ["knet", "K-NET/KiK-net", "`.EW`, `.NS` …"],
            Self::KnetCsv => ["knet-csv", "K-NET CSV", "NIED's CSV with `RelativeTime(s)`"],
            Self::Cosmos => ["cosmos", "COSMOS V2", "`.V2c`"],
            Self::Csmip => ["csmip", "CSMIP V2", "`.V2`, also of CDMG"],
            Self::Smc => ["smc", "USGS SMC", "`.smc`; not the unevenly spaced pairs of film"],
            Self::Geonet => ["geonet", "GeoNet", "`.V1A`, `.V2A` (New Zealand)"],
            Self::Afad => ["afad", "AFAD", "text with three columns (Türkiye)"],
            Self::Cwa => ["cwa", "CWA", "`.dat`, `.txt`, formerly of CWB (Taiwan)"],
            Self::Unam => ["unam", "UNAM", "`ARCHIVO ESTANDAR DE ACELERACION` 2.0 (Mexico)"],
            Self::Volume1 => ["volume1", "RENADIC/BHRC", "volume 1, `.v1` (Chile, Iran)"],
            Self::Csv => ["csv", "CSV", "or text: one column, or times and accelerations"],
            Self::Numbers => ["numbers", "numbers", "several a line, as for OpenSees"],
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
