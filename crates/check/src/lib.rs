#![doc = include_str!("../README.md")]

// the codes
pub mod circolare;
pub mod fractions;

mod baseline;
mod code;
mod codes;
mod error;
mod file;
mod find;
mod ntc;
mod report;
mod sections;
mod walls;
mod words;

pub use baseline::{baseline, baselines};
pub use code::at_level::{AtLevel, at_level};
pub use code::before::{Before, BeforeCheck};
pub use code::row::{Ends, Row};
pub use code::sought::Sought;
pub use code::verdict::{Details, Raise, Section, Verdict};
pub use code::{Code, InStudies, Rule, Subject};
pub use codes::{CODES, complete, how_to_write, read};
pub use error::CheckError;
pub use file::project::{ReportTable, report_schema};
pub use file::site::{Level, Records};
pub use file::{CheckFile, with_assignments};
pub use find::{Found, FoundCheck, find};
pub use report::{page, page_of_walls};
pub use sections::origin::{Figure, Origin};
pub use walls::{WallCodes, WallVerdicts, check_walls};
pub use words::entry::Entry;
pub use words::ledger::{Ledger, Quantity, Unit, numbers};
pub use words::names::{Deciding, LimitState, Side, Sides};
pub use words::{Language, Sentence};
