//! The check of local out-of-plane mechanisms by the Italian code: Circolare 7/2019, C8.7.1.2.1 and C7.2.3,
//! with the spectra of NTC 2018, 3.2.3.2. Numbers in brackets are equations of the code.
//!
//! docs/model.md states the rule and the readings taken where the code can be read in two ways.
//!
//! Folders import downwards only, from the ground:
//!
//! | floor | folder | holds |
//! |---|---|---|
//! | 1 | `statement` | the table `[check]`, as it is written and validated; its limit states and site |
//! | 2 | `curve` | a wall as the check takes it; a(d) of one of its sides, its hinges and its tie |
//! | 3 | `checks` | the static checks of a side with its hinge in one place; its hinge by the rule |
//! | 4 | `runs` | records at the level of a limit state; runs, judged |
//! | 5 | `outcome` | the orchestrator: what governs, and what to know |
//! | 6 | `report` | the outcome as the verdict that every code has; the sections of its report |
//!
//! `blocks` says why no tie passes. The hazard and the spectra are in `ntc`, beside this folder. What is said
//! of a number stands in `ledger` beside it.

mod blocks;
mod checks;
mod curve;
mod outcome;
mod report;
mod runs;
mod statement;

use rocking_wall::wall::Parameters;

use crate::code::sought::Sought;
use crate::code::verdict::Verdict;
use crate::code::{Code, InStudies, Rule, Subject};
use crate::error::CheckError;
use crate::file::site::{Level, Records};
use crate::words::entry::Entry;
use crate::words::names::{Deciding, LimitState};
use crate::words::{Sentence, say};

pub use crate::ntc::demand::{Demand, MEAN_COUNTS_FROM};
pub use crate::ntc::floor::{FloorSpectrum, Mode};
pub use crate::ntc::grid::GridUnit;
pub use crate::ntc::ground::{Category, G, GroundSpectrum, Hazard, Soil, Topography, damping_factor};
pub use checks::sides::{LeastAlpha0, Sensitivity, SideVerdict, SideVerdicts, Untied};
pub use checks::ties::{TieNumbers, TieVerdict};
pub use checks::{ActivationCheck, AtActivationNumbers, Checks, DisplacementCheck, LARGEST_LOSS};
pub use curve::set_back::SetBack;
pub use curve::tie::{TieAtLimit, TieState};
pub use curve::{Curve, TieBreak};
pub use outcome::{Checked, Governs, Outcome};
pub use runs::compatibility::{BAND, Compatibility};
pub use runs::dynamic::DynamicCheck;
pub use runs::{DynamicRun, DynamicState, Judged};
pub use statement::Statement;
pub use statement::states::{Source, StateStatement};
pub use statement::table::{
    Activation, AtActivation, BuildingTable, CheckTable, HeightDemand, Hinge, KnowledgeLevel,
    LARGEST_CONFIDENCE_FACTOR, LimitStateTable, Method, Polarities, RecordScale, Rocks, SiteTable, TieTable,
    UseClass,
};

/// This code among the others.
pub const ENTRY: Entry = Entry {
    name: statement::table::NAME,
    title: "Circolare 7/2019",
    source: || {
        say! {
            "Check of local out-of-plane mechanisms by Circolare C.S.LL.PP. 21.1.2019 n. 7, C8.7.1.2.1 and \
             C7.2.3, with the spectra of NTC 2018 (D.M. 17.1.2018)",
            "Verifica dei meccanismi locali fuori piano secondo Circolare C.S.LL.PP. 21.1.2019 n. 7, \
             C8.7.1.2.1 e C7.2.3, con gli spettri delle NTC 2018 (D.M. 17.1.2018)"
        }
    },
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
        "hinge_levels",
        "crack_angles",
        "resultants",
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
};

impl Code for Statement {
    fn entry(&self) -> Entry {
        ENTRY
    }

    fn check<'a>(&'a self, subject: Subject<'a>) -> Result<Verdict<'a>, CheckError> {
        Ok(self.checked(subject)?.verdict(ENTRY))
    }

    fn records(&self) -> &Records {
        &self.records
    }
}

impl InStudies for Statement {
    fn prepared(&self, parameters: &Parameters) -> Result<Parameters, CheckError> {
        self.with_bar(parameters)
    }

    fn blocks(&self, subject: Subject<'_>, check: &str, sought: Sought) -> Option<Sentence> {
        blocks::reason(self, subject, check, sought)
    }

    fn target(&self) -> f64 {
        self.target
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
        self.building().is_some()
    }

    fn level(&self, subject: Subject<'_>, state: &str) -> Result<Option<Level>, CheckError> {
        runs::level::level(self, subject, state).map(Some)
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
        let mut deciding = Self { informs: false, ..self.clone() };
        if !self.takes_runs() {
            deciding.records = Records::default();
        }
        Some(Box::new(deciding))
    }
}
