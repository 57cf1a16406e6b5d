//! One reader for each format, and the recognition of formats.
//!
//! A reader is a module with `parse(text, options)` and, if its format can be recognised by the content,
//! `recognises(head)`.

mod at2;
mod cosmos;
mod csmip;
mod csv;
mod esm;
mod knet;
mod smc;
mod volume_2;

pub use csv::CSV_HEADER;

use crate::error::Fault;
use crate::fields::untrimmed_lines;
use crate::format::Format;
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Number of lines, blank ones aside, by which a format is recognised.
const HEAD_LINES: usize = 80;

/// Returns whether the first lines that are not blank are those of a format.
type Recognises = fn(&[&str]) -> bool;

impl Format {
    /// Finds the format of a text by its content, or else by the ending of the file's name.
    pub(crate) fn of(name: &str, text: &str) -> Self {
        let head: Vec<&str> = untrimmed_lines(text).take(HEAD_LINES).map(|(_, line)| line).collect();
        // CSMIP comes after COSMOS and SMC, whose first lines may have the same words; AT2, known by two
        // words anywhere in its header, comes last: the title of a table may have them too.
        let known: [(Self, Recognises); 7] = [
            (Self::Esm, esm::recognises),
            (Self::Knet, knet::recognises),
            (Self::Cosmos, cosmos::recognises),
            (Self::Smc, smc::recognises),
            (Self::Csmip, csmip::recognises),
            (Self::Csv, csv::recognises),
            (Self::At2, at2::recognises),
        ];
        let by_content =
            known.into_iter().find(|(_, recognises)| recognises(&head)).map(|(format, _)| format);
        by_content.or_else(|| Self::by_ending(name)).unwrap_or(Self::Csv)
    }

    /// Reads every channel of a text in this format.
    pub(crate) fn parse(self, text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
        let one = match self {
            Self::At2 => at2::parse,
            Self::Esm => esm::parse,
            Self::Knet => knet::parse,
            Self::Smc => smc::parse,
            Self::Csv => csv::parse,
            Self::Cosmos => return cosmos::parse(text, options),
            Self::Csmip => return csmip::parse(text, options),
        };
        Ok(vec![one(text, options)?])
    }
}
