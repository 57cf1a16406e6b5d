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

use crate::error::{Fault, UNEVEN};
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
    format: Format,
    /// Short name.
    name: &'static str,
    /// What people call it.
    description: &'static str,
    /// Endings of its files.
    endings: &'static [&'static str],
    /// Whether its files say which direction a component has; otherwise their names may.
    states_direction: bool,
    recognises: Recognises,
    parse: Parse,
}

const KNET: &[&str] = &["ew", "ns", "ud", "ew1", "ns1", "ud1", "ew2", "ns2", "ud2"];

/// The formats in the order of the enumeration, in which they are tried. CSMIP comes after GeoNet, volume 1,
/// COSMOS and SMC, whose first lines may have the same words; AT2, known by two words anywhere in its header,
/// comes after tables, whose title may have them too.
const KNOWN: [Known; Format::ALL.len()] = [
    Known {
        format: Format::Esm,
        name: "esm",
        description: "ESM/ITACA",
        endings: &["asc"],
        states_direction: true,
        recognises: esm::recognises,
        parse: esm::parse,
    },
    Known {
        format: Format::Geonet,
        name: "geonet",
        description: "GeoNet",
        endings: &["v1a", "v2a"],
        states_direction: true,
        recognises: geonet::recognises,
        parse: geonet::parse,
    },
    Known {
        format: Format::Volume1,
        name: "volume1",
        description: "RENADIC/BHRC",
        endings: &[],
        states_direction: true,
        recognises: volume_1::recognises,
        parse: volume_1::parse,
    },
    Known {
        format: Format::Knet,
        name: "knet",
        description: "K-NET/KiK-net",
        endings: KNET,
        states_direction: true,
        recognises: knet::recognises,
        parse: knet::parse,
    },
    Known {
        format: Format::KnetCsv,
        name: "knet-csv",
        description: "K-NET CSV",
        endings: &[],
        states_direction: true,
        recognises: knet_csv::recognises,
        parse: knet_csv::parse,
    },
    Known {
        format: Format::Afad,
        name: "afad",
        description: "AFAD",
        endings: &[],
        states_direction: true,
        recognises: afad::recognises,
        parse: afad::parse,
    },
    Known {
        format: Format::Cwa,
        name: "cwa",
        description: "CWA",
        endings: &[],
        states_direction: true,
        recognises: cwb::recognises,
        parse: cwb::parse,
    },
    Known {
        format: Format::Unam,
        name: "unam",
        description: "UNAM",
        endings: &[],
        states_direction: true,
        recognises: unam::recognises,
        parse: unam::parse,
    },
    Known {
        format: Format::Cosmos,
        name: "cosmos",
        description: "COSMOS V2",
        endings: &["v2c"],
        states_direction: true,
        recognises: cosmos::recognises,
        parse: cosmos::parse,
    },
    Known {
        format: Format::Smc,
        name: "smc",
        description: "USGS SMC",
        endings: &["smc"],
        states_direction: true,
        recognises: smc::recognises,
        parse: smc::parse,
    },
    Known {
        format: Format::Csmip,
        name: "csmip",
        description: "CSMIP V2",
        endings: &["v2"],
        states_direction: true,
        recognises: csmip::recognises,
        parse: csmip::parse,
    },
    Known {
        format: Format::Csv,
        name: "csv",
        description: "CSV",
        endings: &[],
        states_direction: false,
        recognises: csv::recognises,
        parse: csv::parse,
    },
    Known {
        format: Format::At2,
        name: "at2",
        description: "PEER AT2",
        endings: &["at2"],
        states_direction: false,
        recognises: at2::recognises,
        parse: at2::parse,
    },
    // whether these are numbers depends on the step that is stated: see below
    Known {
        format: Format::Numbers,
        name: "numbers",
        description: "numbers",
        endings: &[],
        states_direction: false,
        recognises: |_| false,
        parse: numbers::parse,
    },
];

const _: () = {
    let mut place = 0;
    while place < KNOWN.len() {
        assert!(KNOWN[place].format as usize == place, "each format stands at its place in the enumeration");
        place += 1;
    }
};

impl Format {
    /// Returns the format's short name, such as `at2`.
    pub fn name(self) -> &'static str {
        KNOWN[self as usize].name
    }

    /// Returns what people call the format.
    pub fn description(self) -> &'static str {
        KNOWN[self as usize].description
    }

    /// Returns whether its files say which direction a component has; otherwise their names may.
    pub(crate) fn states_direction(self) -> bool {
        KNOWN[self as usize].states_direction
    }

    /// Finds the format of a text by its content, or else by the ending of the file's name; refuses one that
    /// is known and not read.
    pub(crate) fn of(name: &str, text: &str, options: &RecordOptions) -> Result<Self, Fault> {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        refuse_unread(&head)?;
        let by_content = KNOWN.iter().find(|known| (known.recognises)(&head));
        if by_content.is_none() && numbers::recognises(&head, options.step.is_some()) {
            return Ok(Self::Numbers);
        }
        let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let has_ending = |endings: &[&str]| endings.iter().any(|known| ending.as_deref() == Some(known));
        let known = by_content.or_else(|| KNOWN.iter().find(|known| has_ending(known.endings)));
        Ok(known.map_or(Self::Csv, |known| known.format))
    }

    /// Reads every channel of a text in this format.
    pub(crate) fn parse(self, text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
        (KNOWN[self as usize].parse)(text, options)
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
