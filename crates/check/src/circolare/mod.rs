//! The check of local out-of-plane mechanisms by the Italian code: Circolare 7/2019, C8.7.1.2.1 and C7.2.3,
//! with the spectra of NTC 2018, 3.2.3.2. Numbers in brackets are equations of the code.
//!
//! docs/model.md states the rule and the readings taken where the code can be read in two ways.
//!
//! | file | holds |
//! |---|---|
//! | `table` | the table `[check]` as it is written |
//! | `statement` | the table `[check]`, validated |
//! | `ground`, `floor` | spectra on the ground and at a height |
//! | `curve` | a(d) of one side of a wall |
//! | `demand` | what a limit state demands |
//! | `records` | the records of a check |
//! | `checks` | the static checks and what governs |
//! | `verdict` | the outcome |
//! | `dynamic` | runs under records |
//! | `warnings` | what the engineer should know |
//! | `rows` | the outcome as the verdict that every code has |
//! | `figure`, `report` | spectra and curves; the page for a calculation file |

mod checks;
mod curve;
mod demand;
mod dynamic;
pub mod figure;
mod floor;
mod ground;
mod records;
mod report;
mod rows;
mod statement;
mod table;
mod verdict;
mod warnings;

use std::path::PathBuf;

use ::report::plot::Plot;
use rocking_wall::scene::{Place, SceneError};
use rocking_wall::wall::Wall;

use crate::code::{Code, Document, Given, Subject, Verdict};
use crate::error::CheckError;

pub use checks::{LARGEST_LOSS, check, demands};
pub use demand::{Demand, MEAN_COUNTS_FROM};
pub use floor::{FloorSpectrum, Mode};
pub use ground::{G, GroundSpectrum, Hazard, Soil, damping_factor};
pub use records::Records;
pub use statement::{LARGEST_CONFIDENCE_FACTOR, Source, StateStatement, Statement};
pub use table::{
    Activation, BuildingTable, CheckTable, KnowledgeLevel, LimitStateTable, Method, RecordScale, Topography,
    UseClass, read_table,
};
pub use verdict::{
    ActivationCheck, Deciding, DisplacementCheck, DynamicCheck, DynamicRun, DynamicState, Governs, Outcome,
    Side, SideVerdict, SideVerdicts, TieBreak,
};

/// What the engineer states, and the records.
#[derive(Clone, Debug)]
struct Circolare {
    statement: Statement,
    records: Records,
}

/// Reads the table `[check]` of this code.
///
/// # Errors
/// [`CheckError`] of a value, with its keys, or of a record.
pub fn read(place: &Place<'_>, given: Given<'_>) -> Result<Box<dyn Code>, CheckError> {
    let missing = || SceneError::Value { message: "there is no table [check]".into() };
    let table = read_table(place)?.ok_or_else(missing)?;
    let statement = table.statement()?;
    let records = if given.records.is_empty() {
        Records::read(&table, place, given.folder)?
    } else {
        Records::new(given.records)?
    };
    Ok(Box::new(Circolare { statement, records }))
}

impl Circolare {
    fn outcome(&self, subject: &Subject<'_>) -> Result<Outcome, CheckError> {
        let none = Records::default();
        let records = if subject.is_tried && !self.takes_runs() { &none } else { &self.records };
        check(subject.parameters, subject.floors, &self.statement, records)
    }
}

impl Code for Circolare {
    fn check(&self, subject: &Subject<'_>) -> Result<Verdict, CheckError> {
        Ok(rows::verdict(&self.outcome(subject)?, &self.statement))
    }

    fn plot(&self, subject: &Subject<'_>) -> Result<Plot, CheckError> {
        let wall = Wall::new(subject.parameters)?;
        let demands = demands(&wall, subject.floors, &self.statement, &self.records)?;
        figure::governing_over_demand(&self.statement, &demands, &self.outcome(subject)?)
    }

    fn report(&self, subject: &Subject<'_>, document: &Document<'_>) -> Result<String, CheckError> {
        let Self { statement, records } = self;
        let verdict = &self.outcome(subject)?;
        report::page(&report::Report { subject, document, statement, records, verdict })
    }

    fn files(&self) -> &[PathBuf] {
        &self.records.files
    }

    fn warnings(&self) -> &[String] {
        &self.records.warnings
    }

    fn takes_runs(&self) -> bool {
        let mut states = self.statement.states.iter().flatten();
        self.statement.method == Method::Dynamic || states.any(|given| given.source == Source::Records)
    }
}

/// The code, in `[check]`.
pub const CODE: &str = "circolare-2019";

/// A limit state of NTC 2018, 3.2.1, in the order in which they are reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum LimitState {
    /// Damage.
    #[serde(rename = "SLD")]
    Sld,
    /// Life safety.
    #[serde(rename = "SLV")]
    Slv,
    /// Collapse.
    #[serde(rename = "SLC")]
    Slc,
}

impl LimitState {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sld, Self::Slv, Self::Slc];

    /// The key of its table.
    pub fn key(self) -> &'static str {
        ["SLD", "SLV", "SLC"][self as usize]
    }

    /// ξ of the mechanism where nothing better is known, C8.7.1.2.1.5 and C8.7.1.2.1.8 \[-\].
    pub fn damping(self) -> f64 {
        [0.05, 0.08, 0.10][self as usize]
    }
}

impl std::fmt::Display for LimitState {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.key())
    }
}
