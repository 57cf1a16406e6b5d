//! Formats of record files.

use std::str::FromStr;

use serde::Deserialize;

use crate::error::GroundMotionError;

/// Format of a record file, in the order in which a content is tried.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash, Deserialize)]
#[serde(try_from = "String")]
pub enum Format {
    /// ESM or ITACA ASCII.
    Esm,
    /// GeoNet of New Zealand, V1A or V2A.
    Geonet,
    /// Volume 1 of RENADIC (Chile) or BHRC (Iran).
    Volume1,
    /// K-NET or KiK-net.
    Knet,
    /// K-NET or KiK-net as CSV.
    KnetCsv,
    /// Text of AFAD, Türkiye.
    Afad,
    /// Taiwan's Central Weather Administration.
    Cwa,
    /// UNAM's standard file, Mexico.
    Unam,
    /// COSMOS volume 2.
    Cosmos,
    /// USGS SMC.
    Smc,
    /// CSMIP or CDMG volume 2.
    Csmip,
    /// SLIST, TSPAIR and `GeoCSV` of data centres.
    Fdsn,
    /// A text table: times and accelerations between commas, semicolons, tabs or blanks; or one column.
    Csv,
    /// PEER AT2.
    At2,
    /// Plain numbers, several a line, as OpenSees reads them.
    Numbers,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 15] = {
        use Format::{
            Afad, At2, Cosmos, Csmip, Csv, Cwa, Esm, Fdsn, Geonet, Knet, KnetCsv, Numbers, Smc, Unam, Volume1,
        };
        [At2, Esm, Knet, KnetCsv, Cosmos, Csmip, Smc, Geonet, Afad, Cwa, Unam, Volume1, Fdsn, Csv, Numbers]
    };

    /// Lists what people call the formats.
    ///
    /// ```
    /// assert!(ground_motion::Format::listed().starts_with("PEER AT2, ESM/ITACA, K-NET/KiK-net"));
    /// ```
    pub fn listed() -> String {
        Self::ALL.map(Self::description).join(", ")
    }
}

impl FromStr for Format {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|format| text.trim().eq_ignore_ascii_case(format.name()));
        known.ok_or_else(|| GroundMotionError::Format {
            found: text.chars().take(40).collect(),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}

impl TryFrom<String> for Format {
    type Error = GroundMotionError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}
