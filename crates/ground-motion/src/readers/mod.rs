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

/// A format: its short name, what people call it, the endings of its files, whether these say which direction
/// a component has, and its reader.
type Known = (Format, &'static str, &'static str, &'static [&'static str], bool, Recognises, Parse);

const KNET: &[&str] = &["ew", "ns", "ud", "ew1", "ns1", "ud1", "ew2", "ns2", "ud2"];

/// The formats in the order of the enumeration, in which they are tried. CSMIP comes after GeoNet, volume 1,
/// COSMOS and SMC, whose first lines may have the same words; AT2, known by two words anywhere in its header,
/// comes after tables, whose title may have them too.
const KNOWN: [Known; Format::ALL.len()] = [
    (Format::Esm, "esm", "ESM/ITACA", &["asc"], true, esm::recognises, esm::parse),
    (Format::Geonet, "geonet", "GeoNet", &["v1a", "v2a"], true, geonet::recognises, geonet::parse),
    (Format::Volume1, "volume1", "RENADIC/BHRC", &[], true, volume_1::recognises, volume_1::parse),
    (Format::Knet, "knet", "K-NET/KiK-net", KNET, true, knet::recognises, knet::parse),
    (Format::KnetCsv, "knet-csv", "K-NET CSV", &[], true, knet_csv::recognises, knet_csv::parse),
    (Format::Afad, "afad", "AFAD", &[], true, afad::recognises, afad::parse),
    (Format::Cwa, "cwa", "CWA", &[], true, cwb::recognises, cwb::parse),
    (Format::Unam, "unam", "UNAM", &[], true, unam::recognises, unam::parse),
    (Format::Cosmos, "cosmos", "COSMOS V2", &["v2c"], true, cosmos::recognises, cosmos::parse),
    (Format::Smc, "smc", "USGS SMC", &["smc"], true, smc::recognises, smc::parse),
    (Format::Csmip, "csmip", "CSMIP V2", &["v2"], true, csmip::recognises, csmip::parse),
    (Format::Fdsn, "fdsn", "FDSN text", &["slist", "tspair"], true, fdsn::recognises, fdsn::parse),
    (Format::Csv, "csv", "CSV", &[], false, csv::recognises, csv::parse),
    (Format::At2, "at2", "PEER AT2", &["at2"], false, at2::recognises, at2::parse),
    // whether these are numbers depends on the step that is stated: see below
    (Format::Numbers, "numbers", "numbers", &[], false, |_| false, numbers::parse),
];

// each format stands at its place in the enumeration
const _: () = {
    let mut place = 0;
    while place < KNOWN.len() {
        assert!(KNOWN[place].0 as usize == place);
        place += 1;
    }
};

impl Format {
    /// Returns the format's short name, such as `at2`.
    pub fn name(self) -> &'static str {
        let (_, name, ..) = KNOWN[self as usize];
        name
    }

    /// Returns what people call the format.
    pub fn description(self) -> &'static str {
        let (_, _, description, ..) = KNOWN[self as usize];
        description
    }

    /// Returns whether its files say which direction a component has; otherwise their names may.
    pub(crate) fn states_direction(self) -> bool {
        let (.., states_direction, _, _) = KNOWN[self as usize];
        states_direction
    }

    /// Finds the format of a text by its content, or else by the ending of the file's name; refuses one that
    /// is known and not read.
    pub(crate) fn of(name: &str, text: &str, options: &RecordOptions) -> Result<Self, Fault> {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        refuse_unread(&head)?;
        let by_content = KNOWN.iter().find(|(.., recognises, _)| recognises(&head));
        if by_content.is_none() && numbers::recognises(&head, options.step.is_some()) {
            return Ok(Self::Numbers);
        }
        let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let has_ending = |endings: &[&str]| endings.iter().any(|known| ending.as_deref() == Some(known));
        let known = by_content.or_else(|| KNOWN.iter().find(|(_, _, _, endings, ..)| has_ending(endings)));
        Ok(known.map_or(Self::Csv, |(format, ..)| *format))
    }

    /// Reads every channel of a text in this format.
    pub(crate) fn parse(self, text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
        let (.., parse) = KNOWN[self as usize];
        if let Some(column) = options.column.as_ref().filter(|_| self != Self::Csv) {
            let expected = format!("a table with the column {}", excerpt(column));
            let found = format!("{}, a format without named columns", self.description());
            return Err(Fault::new(1, expected, found, "state no column (on the command line --column)"));
        }
        parse(text, options)
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
