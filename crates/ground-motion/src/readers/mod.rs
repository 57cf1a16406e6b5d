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
mod knet;
mod knet_csv;
mod numbers;
mod smc;
mod unam;
mod volume_1;
mod volume_2;

pub use csv::CSV_HEADER;

use crate::error::{Fault, UNEVEN};
use crate::fields::{find, untrimmed_lines};
use crate::format::Format;
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Number of lines, blank ones aside, by which a format is recognised.
const HEAD_LINES: usize = 80;

/// Returns whether the first lines that are not blank are those of a format.
type Recognises = fn(&[&str]) -> bool;

impl Format {
    /// Finds the format of a text by its content, or else by the ending of the file's name; refuses one that
    /// is known and not read.
    pub(crate) fn of(name: &str, text: &str, options: &RecordOptions) -> Result<Self, Fault> {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        refuse_unread(&head)?;
        // CSMIP comes after GeoNet, volume 1, COSMOS and SMC, whose first lines may have the same words; AT2,
        // known by two words anywhere in its header, comes after tables, whose title may have them too.
        let known: [(Self, Recognises); 13] = [
            (Self::Esm, esm::recognises),
            (Self::Geonet, geonet::recognises),
            (Self::Volume1, volume_1::recognises),
            (Self::Knet, knet::recognises),
            (Self::KnetCsv, knet_csv::recognises),
            (Self::Afad, afad::recognises),
            (Self::Cwa, cwb::recognises),
            (Self::Unam, unam::recognises),
            (Self::Cosmos, cosmos::recognises),
            (Self::Smc, smc::recognises),
            (Self::Csmip, csmip::recognises),
            (Self::Csv, csv::recognises),
            (Self::At2, at2::recognises),
        ];
        let by_content =
            known.into_iter().find(|(_, recognises)| recognises(&head)).map(|(format, _)| format);
        let has_step = options.step.is_some();
        let numbers = || numbers::recognises(&head, has_step).then_some(Self::Numbers);
        Ok(by_content.or_else(numbers).or_else(|| Self::by_ending(name)).unwrap_or(Self::Csv))
    }

    /// Reads every channel of a text in this format.
    pub(crate) fn parse(self, text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
        let one = match self {
            Self::At2 => at2::parse,
            Self::Esm => esm::parse,
            Self::Knet => knet::parse,
            Self::Smc => smc::parse,
            Self::Csv => csv::parse,
            Self::Numbers => numbers::parse,
            Self::Geonet => return geonet::parse(text, options),
            Self::Volume1 => return volume_1::parse(text, options),
            Self::KnetCsv => return knet_csv::parse(text, options),
            Self::Afad => return afad::parse(text, options),
            Self::Cwa => return cwb::parse(text, options),
            Self::Unam => return unam::parse(text, options),
            Self::Cosmos => return cosmos::parse(text, options),
            Self::Csmip => return csmip::parse(text, options),
        };
        Ok(vec![one(text, options)?])
    }
}

/// Refuses a text in a format that is known by name and not read, so that it is not taken for another.
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
