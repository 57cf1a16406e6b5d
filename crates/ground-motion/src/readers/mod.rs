//! One reader for each format, and the recognition of formats.
//!
//! A reader is a module with `parse(text, options)` and, if its format can be recognised by the content,
//! `recognises(head)`.

mod afad;
mod at2;
mod components;
mod cosmos;
mod csmip;
mod csv;
mod cwb;
mod esm;
mod fdsn;
mod geonet;
mod header;
mod knet;
mod knet_csv;
mod numbers;
mod smc;
mod unam;
mod volume_1;
mod volume_2;

pub use csv::CSV_HEADER;

use std::iter::Peekable;
use std::path::Path;

use crate::error::{Fault, UNEVEN, excerpt};
use crate::fields::{Numbered, find, untrimmed_lines};
use crate::format::Format;
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Number of lines, blank ones aside, by which a format is recognised.
const HEAD_LINES: usize = 80;

/// Returns whether the first lines that are not blank are those of a format.
type Recognises = fn(&[&str]) -> bool;

/// Reads every channel of a text.
type Parse = fn(&str, &RecordOptions) -> Result<Vec<Parsed>, Fault>;

/// What is known of a format.
struct Known {
    /// Its short name.
    name: &'static str,
    /// What people call it.
    description: &'static str,
    /// Endings of the names of its files.
    endings: &'static [&'static str],
    /// Whether its files say which direction a component has.
    states_direction: bool,
    recognises: Recognises,
    parse: Parse,
}

const KNET: &[&str] = &["ew", "ns", "ud", "ew1", "ns1", "ud1", "ew2", "ns2", "ud2"];

/// The formats in the order in which they are tried. CSMIP comes after GeoNet, volume 1, COSMOS and SMC,
/// whose first lines may have the same words; AT2, known by two words anywhere in its header, comes after
/// tables, whose title may have them too.
const TRIED: [Format; Format::ALL.len()] = {
    use Format::{
        Afad, At2, Cosmos, Csmip, Csv, Cwa, Esm, Fdsn, Geonet, Knet, KnetCsv, Numbers, Smc, Unam, Volume1,
    };
    [Esm, Geonet, Volume1, Knet, KnetCsv, Afad, Cwa, Unam, Cosmos, Smc, Csmip, Fdsn, Csv, At2, Numbers]
};

impl Format {
    fn known(self) -> Known {
        let known = |name, description, endings, states_direction, recognises, parse| Known {
            name,
            description,
            endings,
            states_direction,
            recognises,
            parse,
        };
        match self {
            Self::Esm => known("esm", "ESM/ITACA", &["asc"], true, esm::recognises, esm::parse),
            Self::Geonet => {
                known("geonet", "GeoNet", &["v1a", "v2a"], true, geonet::recognises, geonet::parse)
            }
            Self::Volume1 => {
                known("volume1", "RENADIC/BHRC", &[], true, volume_1::recognises, volume_1::parse)
            }
            Self::Knet => known("knet", "K-NET/KiK-net", KNET, true, knet::recognises, knet::parse),
            Self::KnetCsv => known("knet-csv", "K-NET CSV", &[], true, knet_csv::recognises, knet_csv::parse),
            Self::Afad => known("afad", "AFAD", &[], true, afad::recognises, afad::parse),
            Self::Cwa => known("cwa", "CWA", &[], true, cwb::recognises, cwb::parse),
            Self::Unam => known("unam", "UNAM", &[], true, unam::recognises, unam::parse),
            Self::Cosmos => known("cosmos", "COSMOS V2", &["v2c"], true, cosmos::recognises, cosmos::parse),
            Self::Smc => known("smc", "USGS SMC", &["smc"], true, smc::recognises, smc::parse),
            Self::Csmip => known("csmip", "CSMIP V2", &["v2"], true, csmip::recognises, csmip::parse),
            Self::Fdsn => {
                known("fdsn", "FDSN text", &["slist", "tspair"], true, fdsn::recognises, fdsn::parse)
            }
            Self::Csv => known("csv", "CSV", &[], false, csv::recognises, csv::parse),
            Self::At2 => known("at2", "PEER AT2", &["at2"], false, at2::recognises, at2::parse),
            // whether these are numbers depends on the step that is stated: see below
            Self::Numbers => known("numbers", "numbers", &[], false, |_| false, numbers::parse),
        }
    }

    /// Returns the format's short name, such as `at2`.
    pub fn name(self) -> &'static str {
        self.known().name
    }

    /// Returns what people call the format.
    pub fn description(self) -> &'static str {
        self.known().description
    }

    /// Returns whether its files say which direction a component has; otherwise their names may.
    pub(crate) fn states_direction(self) -> bool {
        self.known().states_direction
    }

    /// Finds the format of a text by its content, or else by the ending of the file's name; refuses one that
    /// is known and not read.
    pub(crate) fn of(name: &str, text: &str, options: &RecordOptions) -> Result<Self, Fault> {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        refuse_unread(&head)?;
        let by_content = TRIED.into_iter().find(|format| (format.known().recognises)(&head));
        if by_content.is_none() && numbers::recognises(&head, options.step.is_some()) {
            return Ok(Self::Numbers);
        }
        let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let has_ending = |endings: &[&str]| endings.iter().any(|known| ending.as_deref() == Some(known));
        let by_ending = || TRIED.into_iter().find(|format| has_ending(format.known().endings));
        Ok(by_content.or_else(by_ending).unwrap_or(Self::Csv))
    }

    /// Reads every channel of a text in this format.
    pub(crate) fn parse(self, text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
        if let Some(column) = options.column.as_ref().filter(|_| self != Self::Csv) {
            let expected = format!("a table with the column {}", excerpt(column));
            let found = format!("{}, a format without named columns", self.description());
            return Err(Fault::new(1, expected, found, "state no column (on the command line --column)"));
        }
        (self.known().parse)(text, options)
    }
}

/// Reads channels that follow one another, each by `read`, and numbers them.
fn one_by_one<'a, Lines: Iterator<Item = Numbered<'a>>>(
    mut lines: Peekable<Lines>,
    read: impl Fn(&mut Peekable<Lines>) -> Result<Parsed, Fault>,
) -> Result<Vec<Parsed>, Fault> {
    let mut channels = Vec::new();
    while lines.peek().is_some() {
        let mut channel = read(&mut lines)?;
        let name = channel.channel.unwrap_or_default();
        channel.channel = Some(format!("{}: {name}", channels.len() + 1));
        channels.push(channel);
    }
    Ok(channels)
}

/// Refuses a text in a format that is known by name and not read, so that none of them is taken for another.
fn refuse_unread(head: &[&str]) -> Result<(), Fault> {
    let has = |lines: usize, word: &str| head.iter().take(lines).any(|line| find(line, word).is_some());
    let csmnc = has(20, "EQUALLY SPACED INTERVALS OF") && (has(20, "OBSERVING POINT") || has(20, "COMP."));
    let by_hand = "this format is not read: write its samples one a line and state their step and unit (on \
                   the command line --record-step and --unit), or make a table, `t [s],a [cm/s2]`";
    let (found, remedy) = match () {
        () if csmnc => ("a record of CSMNC, China", by_hand),
        () if has(1, "SIMBAD") => ("a record of SIMBAD, Italy", by_hand),
        // its times are those at which the film was read
        () if has(1, "OF UNCORRECTED ACCELEROGRAM DATA OF") => ("volume 1 of USC or USGS", UNEVEN),
        () => return Ok(()),
    };
    Err(Fault::new(1, "a record in a format that is read", found, remedy))
}
