#![doc = include_str!("../README.md")]

// the codes
pub mod circolare;
pub mod fractions;

mod at_level;
mod code;
mod codes;
mod entry;
mod error;
mod file;
mod find;
mod formulas;
mod ledger;
mod names;
mod others;
mod report;
mod site;
mod verdict;
mod walls;
mod words;

pub use at_level::{AtLevel, at_level};
pub use code::{Code, InStudies, Rule, Subject};
pub use codes::{CODES, complete, how_to_write, read};
pub use entry::Entry;
pub use error::CheckError;
pub use file::{CheckFile, with_assignments};
pub use find::{Found, FoundCheck, Sought, find};
pub use ledger::{Ledger, Quantity, Unit, numbers};
pub use names::{Deciding, LimitState, Side, Sides};
pub use report::{Figure, Origin, ReportTable, page, page_of_walls, report_schema};
pub use site::{Level, Records};
pub use verdict::{Details, Ends, Raise, Row, Section, Verdict};
pub use walls::{WallCodes, WallVerdicts, check_walls};
pub use words::{Language, Sentence};
