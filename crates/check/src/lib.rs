#![doc = include_str!("../README.md")]

// the codes
pub mod circolare;
pub mod fractions;

mod code;
mod error;
mod file;
mod find;
mod report;
mod site;
mod verdict;
mod walls;

pub use code::{Code, Entry, Rule, Subject};
pub use error::CheckError;
pub use file::{CheckFile, complete, how_to_write, read, with_assignments};
pub use find::{Found, FoundCheck, Sought, find};
pub use report::{Figure, Language, Origin, ReportTable, page, page_of_walls, report_schema, terms};
pub use site::{Level, Records};
pub use verdict::{Details, Ends, Raise, Row, Verdict};
pub use walls::{WallCodes, WallVerdicts, check_walls};

/// The codes: a new one is a module above and an entry here.
pub const CODES: [Entry; 2] = [circolare::ENTRY, fractions::ENTRY];
