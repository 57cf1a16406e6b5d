//! The tie in the check: its force as the wall is pushed over for the first time, and the bar of its table.

use std::f64::consts::PI;

use rocking_wall::wall::{Parameters, Tie, TiePart};
use serde::Serialize;
use serde_json::json;

use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::{Sentence, say};

/// N of a tie at u, up to and including where it breaks \[N\].
pub(crate) fn force(tie: &Tie, u: f64) -> f64 {
    if tie.fracture_displacement().is_some_and(|breaks| u > breaks) {
        return 0.0;
    }
    let pull = (tie.stiffness * (tie.lever * u - tie.slack)).max(0.0);
    tie.strength.map_or(pull, |strength| pull.min(strength))
}

/// What a tie does at a displacement that is reached for the first time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TieState {
    /// It does not pull yet.
    Slack,
    /// It is elastic.
    Elastic,
    /// It has its strength.
    AtStrength,
    /// It is broken.
    Broken,
}

impl TieState {
    /// Returns the state of a tie at u \[m\].
    pub(crate) fn at(tie: &Tie, u: f64) -> Self {
        if tie.fracture_displacement().is_some_and(|breaks| u > breaks) {
            Self::Broken
        } else if tie.strength_displacement().is_some_and(|yields| u >= yields) {
            Self::AtStrength
        } else if u <= tie.onset() {
            Self::Slack
        } else {
            Self::Elastic
        }
    }
}

/// What the tie does at a limit state and at its demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieAtLimit {
    /// N at the limit state \[N\].
    pub force: f64,
    /// Its state there.
    pub state: TieState,
    /// N at the demand \[N\].
    pub force_at_demand: f64,
    /// Its state there.
    pub state_at_demand: TieState,
}

impl TieAtLimit {
    pub(crate) fn new(tie: &Tie, [u, demand]: [f64; 2]) -> Self {
        Self {
            force: force(tie, u),
            state: TieState::at(tie, u),
            force_at_demand: force(tie, demand),
            state_at_demand: TieState::at(tie, demand),
        }
    }
}

/// How many bars, each with its anchors, hold the width of the wall, of the first tie on the side of `sign`
/// where that is given by its bar \[-\].
pub(crate) fn anchors(parameters: &Parameters, sign: f64) -> Option<f64> {
    let tie = parameters.ties().find(|tie| tie.stiffness > 0.0 && tie.holds(sign))?;
    let bar = tie.bar.filter(|_| tie.weaker_part(parameters.width).is_some())?;
    Some(bar.spacing.map_or(1.0, |spacing| parameters.width / spacing))
}

impl TieState {
    /// Returns the state in words.
    pub(crate) fn words(self) -> Sentence {
        match self {
            Self::Slack => say!("slack", "lasca"),
            Self::Elastic => say!("elastic", "elastica"),
            Self::AtStrength => say!("at its strength", "alla resistenza"),
            Self::Broken => say!("broken", "rotta"),
        }
    }
}

impl TieAtLimit {
    /// Adds the forces; a table of a report has them, with those of each anchor.
    pub(crate) fn add_to(&self, anchors: Option<f64>, ledger: &mut Ledger) {
        let unit = Unit::KILONEWTONS;
        let words = say!("Force of the tie", "Tiro della catena");
        ledger.add(Quantity::new("tie_force", "N", unit, self.force, words).unlisted());
        let words = say!("Force of the tie at the demand", "Tiro della catena alla domanda");
        ledger.add(Quantity::new("tie_force_at_demand", "N", unit, self.force_at_demand, words).unlisted());
        ledger.fact("tie_state", json!(self.state));
        ledger.fact("tie_state_at_demand", json!(self.state_at_demand));
        let Some(anchors) = anchors else { return };
        let words = say!("Force of one anchor", "Tiro di un ancoraggio");
        let of_anchor = |name, force, words| {
            Quantity::new("", "", unit, force / anchors, words).unlisted().on_terminal(name)
        };
        ledger.add(of_anchor("one anchor", self.force, words));
        let words = say!("Force of one anchor at the demand", "Tiro di un ancoraggio alla domanda");
        ledger.add(of_anchor("one anchor at the demand", self.force_at_demand, words));
    }
}

/// Adds what the bar and its anchor make of the tie, for the width of the wall.
pub(crate) fn add_bar(parameters: &Parameters, ledger: &mut Ledger) {
    let Some((bar, weaker)) = parameters.bar.zip(parameters.weaker_part()) else { return };
    let area = PI * bar.diameter * bar.diameter / 4.0;
    let (kilonewtons, of_width) = (Unit::KILONEWTONS, if bar.spacing.is_some() { " l/i" } else { "" });
    ledger.know(&[
        ("φ", 1e3 * bar.diameter),
        ("E", 1e-6 * bar.young_modulus),
        ("L", 1e3 * bar.length),
        ("f_y", 1e-6 * bar.yield_stress),
        ("l", parameters.width),
        ("i", bar.spacing.unwrap_or(f64::NAN)),
        ("N_a", 1e-3 * bar.anchor_capacity.unwrap_or(f64::NAN)),
        ("ε_u", bar.ultimate_strain.unwrap_or(f64::NAN)),
    ]);
    let words = say!("Cross-section of the bar", "Area della sezione della barra");
    ledger.add(Quantity::new("", "A_s = π φ²/4", Unit::SQUARE_MILLIMETRES, area, words));
    let words = say!("Axial stiffness, for the width l", "Rigidezza assiale, per la larghezza l");
    let (unit, equation) = (Unit::KILONEWTONS_PER_METRE, format!("K = (E A_s/L){of_width}"));
    ledger.add(Quantity::new("", equation, unit, parameters.tie_stiffness, words));
    let words = say!("Yield force of one bar", "Forza di snervamento di una barra");
    ledger.add(Quantity::new("", "N_s = A_s f_y {10⁻³}", kilonewtons, area * bar.yield_stress, words));
    let words = say!("Capacity of one anchor", "Resistenza di un ancoraggio");
    ledger.add(Quantity::new("", "N_a", kilonewtons, bar.anchor_capacity, words));
    let least = if bar.anchor_capacity.is_some() { "min(N_s; N_a)" } else { "N_s" };
    let words = say!("Strength of the tie, for the width l", "Resistenza della catena, per la larghezza l");
    let equation = format!("N_y = {least}{of_width}");
    ledger.add(Quantity::new("", equation, kilonewtons, parameters.tie_strength, words));
    let elongates = bar.ultimate_strain.is_some() && weaker == TiePart::Bar;
    let equation = if elongates { "e_p = max(0; ε_u L − N_y/K {10³})" } else { "e_p" };
    let words =
        say!("Plastic elongation at which the tie breaks", "Allungamento plastico a rottura della catena");
    ledger.add(Quantity::new("", equation, Unit::MILLIMETRES, parameters.tie_ultimate, words));
    let first = match weaker {
        TiePart::Anchor => say!("the anchor (brittle)", "l'ancoraggio (fragile)"),
        TiePart::Bar if parameters.tie_ultimate == 0.0 => say!("the bar (brittle)", "la barra (fragile)"),
        TiePart::Bar => say!("the bar", "la barra"),
    };
    ledger.say(say!("Part that gives way first", "Parte che cede per prima"), first);
}
