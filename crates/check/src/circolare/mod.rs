//! The check of local out-of-plane mechanisms by the Italian code: Circolare 7/2019, C8.7.1.2.1 and C7.2.3,
//! with the spectra of NTC 2018, 3.2.3.2. Numbers in brackets are equations of the code.
//!
//! docs/model.md states the rule and the readings taken where the code can be read in two ways.
//!
//! | file | holds |
//! |---|---|
//! | `table` | the table `[check]` as it is written |
//! | `statement` | the same, in its limits |
//! | `ground`, `floor` | spectra on the ground and at a height |
//! | `curve` | a(d) of one side of a wall |
//! | `demand` | what a limit state demands |
//! | `records` | the records of a check |
//! | `checks` | the static checks and what governs |
//! | `verdict` | the outcome |
//! | `dynamic` | runs under records |
//! | `warnings` | what the engineer should know |
//! | `find` | the smallest wall that passes |
//! | `walls` | many walls |

mod checks;
mod curve;
mod demand;
mod dynamic;
mod error;
pub mod figure;
mod find;
mod floor;
mod ground;
mod records;
pub mod report;
mod statement;
mod table;
mod verdict;
mod walls;
mod warnings;

pub use checks::{LARGEST_LOSS, check, demands};
pub use demand::{Demand, MEAN_COUNTS_FROM};
pub use error::CheckError;
pub use find::{Found, Sought, find};
pub use floor::{FloorSpectrum, Mode};
pub use ground::{G, GroundSpectrum, Hazard, Soil, damping_factor};
pub use records::Records;
pub use statement::{LARGEST_CONFIDENCE_FACTOR, Source, StateStatement, Statement};
pub use table::{
    Activation, BuildingTable, CheckTable, KnowledgeLevel, LimitStateTable, Method, RecordScale, Topography,
    UseClass, in_table, read_table,
};
pub use verdict::{
    ActivationCheck, Deciding, DisplacementCheck, DynamicCheck, DynamicRun, DynamicState, Governs, Side,
    SideVerdict, SideVerdicts, TieBreak, Verdict,
};
pub use walls::{WallVerdict, Walls};

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
