//! The check of local out-of-plane mechanisms by the Italian code: Circolare 7/2019, C8.7.1.2.1 and C7.2.3,
//! with the spectra of NTC 2018, 3.2.3.2. Numbers in brackets are equations of the code.
//!
//! docs/model.md states the rule and the readings taken where the code can be read in two ways.
//!
//! | file | holds |
//! |---|---|
//! | `table` | the table `[check]` as it is written |
//! | `statement`, `states` | the table `[check]`, validated |
//! | `grid`, `site` | the hazard of a site from a grid, and what limit states take from it |
//! | `ground`, `floor` | spectra on the ground and at a height |
//! | `case` | a wall as the check takes it, and its checks with the hinge in one place |
//! | `curve`, `set_back`, `tie` | a(d) of one side of a wall, its hinges and its tie |
//! | `hinge` | the search of the hinge |
//! | `sides` | a side by the rule on its hinge |
//! | `demand` | what a limit state demands |
//! | `checks` | the static checks and what governs |
//! | `verdict`, `side_verdict` | the outcome |
//! | `level`, `compatibility` | records at the level of a limit state, and their spectra |
//! | `dynamic` | runs under records |
//! | `blocks` | why no tie of a search passes |
//! | `warnings` | what the engineer should know |
//! | `rows` | the outcome as the verdict that every code has |
//! | `figure`, `report` | spectra, curves, and the sections of the report |

mod blocks;
mod case;
mod checks;
mod compatibility;
mod curve;
mod demand;
mod dynamic;
mod figure;
mod floor;
mod grid;
mod ground;
mod hinge;
mod level;
mod lines;
mod report;
mod rows;
mod set_back;
mod side_verdict;
mod sides;
mod site;
mod statement;
mod states;
mod table;
mod tie;
mod verdict;
mod warnings;

use rocking_wall::scene::Described;
use rocking_wall::wall::Parameters;

use crate::code::{Code, Entry, Rule, Subject};
use crate::error::CheckError;
use crate::find::Sought;
use crate::site::{Level, Records};
use crate::verdict::Verdict;

pub use checks::{Checks, LARGEST_LOSS};
pub use compatibility::{BAND, Compatibility};
pub use curve::Curve;
pub use demand::{Demand, MEAN_COUNTS_FROM};
pub use floor::{FloorSpectrum, Mode};
pub use grid::GridUnit;
pub use ground::{Category, G, GroundSpectrum, Hazard, Soil, Topography, damping_factor};
pub use set_back::SetBack;
pub use side_verdict::{
    ActivationCheck, AtActivationNumbers, DisplacementCheck, LeastAlpha0, Sensitivity, SideVerdict, TieBreak,
    TieNumbers, Untied,
};
pub use statement::{LARGEST_CONFIDENCE_FACTOR, Statement};
pub use states::{Source, StateStatement};
pub use table::{
    Activation, AtActivation, BuildingTable, CheckTable, HeightDemand, Hinge, KnowledgeLevel,
    LimitStateTable, Method, Polarities, RecordScale, Rocks, SiteTable, TieTable, UseClass,
};
pub use tie::{TieAtLimit, TieState};
pub use verdict::{
    Checked, Deciding, DynamicCheck, DynamicRun, DynamicState, Governs, Judged, Outcome, Side, SideVerdicts,
};

/// Fewest records, NTC 7.3.5.
const FEWEST_RECORDS: usize = 3;

/// This code among the others.
pub const ENTRY: Entry = Entry {
    name: "circolare-2019",
    title: "Circolare 7/2019",
    source: "Check of local out-of-plane mechanisms by Circolare C.S.LL.PP. 21.1.2019 n. 7, C8.7.1.2.1 and \
             C7.2.3, with the spectra of NTC 2018 (D.M. 17.1.2018)",
    symbol: "zeta_E",
    gravity: G,
    checks: &["SLD", "SLV with q", "SLV", "SLC"],
    example: "check = { code = \"circolare-2019\", before_activation = \"rigid\", soil = \"B\", \
              SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 } }",
    of_wall: &[
        "building.height_ratio",
        "before_activation",
        "young_modulus",
        "overburden_mass",
        "hinge",
        "hinge_range",
        "masonry_strength",
        "masonry_gamma",
        "masonry_over_fc",
        "stress_block",
        "confidence_factor|knowledge_level",
        "compression_considered",
        "rocking",
        "tie",
        "SLC.displacement",
    ],
    describe: CheckTable::describe,
    read: |file| Ok(Box::new(Statement::read(file)?)),
};

impl Code for Statement {
    fn entry(&self) -> Entry {
        ENTRY
    }

    fn check<'a>(&'a self, subject: Subject<'a>) -> Result<Verdict<'a>, CheckError> {
        Ok(self.checked(subject)?.verdict())
    }

    fn records(&self) -> &Records {
        &self.records
    }

    fn prepared(&self, parameters: &Parameters) -> Result<Parameters, CheckError> {
        self.with_bar(parameters)
    }

    fn blocks(&self, subject: Subject<'_>, check: &str, sought: Sought) -> Option<String> {
        blocks::reason(self, subject, check, sought)
    }

    fn takes_runs(&self) -> bool {
        let mut states = self.states.iter().flatten();
        self.table.method == Method::Dynamic || states.any(|given| given.source == Source::Records)
    }

    fn spectral_shape(&self, periods: &[f64]) -> Option<Vec<f64>> {
        let given = self.state(LimitState::Slv).or(self.state(LimitState::Slc))?;
        let Source::Code(ground) = &given.source else { return None };
        let at = |period: &f64| ground.acceleration(*period, LimitState::Sld.damping()) / (given.ag * G);
        Some(periods.iter().map(at).collect())
    }

    fn states_building(&self) -> bool {
        self.table.building.is_some()
    }

    fn level(&self, subject: Subject<'_>, state: &str) -> Result<Option<Level>, CheckError> {
        level::level(self, subject, state).map(Some)
    }

    fn rule(&self, check: &str, rule: Rule) -> Option<f64> {
        let state = Deciding::ALL.into_iter().find(|own| own.name() == check)?;
        match (state, rule) {
            (Deciding::SlvWithQ, Rule::BehaviourFactor) => Some(self.behaviour_factor),
            (Deciding::Slv | Deciding::Slc, Rule::Fraction) => Some(self.rules(state.state()).fraction),
            (Deciding::Slv | Deciding::Slc, Rule::PeriodFactor) => {
                Some(self.rules(state.state()).period_factor)
            }
            _ => None,
        }
    }

    fn with_rule(&self, check: &str, rule: Rule, value: f64) -> Option<Box<dyn Code>> {
        self.rule(check, rule)?;
        let mut varied = Self { records: Records::default(), ..self.clone() };
        let rules = &mut varied.displacements[usize::from(check == LimitState::Slc.key())];
        match rule {
            Rule::Fraction => rules.fraction = value,
            Rule::PeriodFactor => rules.period_factor = value,
            Rule::BehaviourFactor => varied.behaviour_factor = value,
        }
        Some(Box::new(varied))
    }

    fn deciding(&self) -> Option<Box<dyn Code>> {
        let informs = !self.records.named.is_empty() && !self.takes_runs();
        informs.then(|| -> Box<dyn Code> { Box::new(Self { records: Records::default(), ..self.clone() }) })
    }
}

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

    /// P of being exceeded in `V_R`, NTC Tab. 3.2.I \[-\].
    pub fn exceeded(self) -> f64 {
        crate::report::EXCEEDED[self as usize].1
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
