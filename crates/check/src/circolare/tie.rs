//! The tie in the check: its force as the wall is pushed over for the first time, and the bar of its table.

use rocking_wall::wall::{Parameters, Tie};
use serde::Serialize;

/// N of a tie at u, up to and including where it breaks \[N\].
pub(super) fn force(tie: &Tie, u: f64) -> f64 {
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
    pub(super) fn at(tie: &Tie, u: f64) -> Self {
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

    /// Returns the state in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Slack => "slack",
            Self::Elastic => "elastic",
            Self::AtStrength => "at its strength",
            Self::Broken => "broken",
        }
    }
}

/// What the tie does at a limit state and at its demand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TieAtLimit {
    /// N at the limit state \[N\].
    #[serde(rename = "tie_force")]
    pub force: f64,
    /// Its state there.
    #[serde(rename = "tie_state")]
    pub state: TieState,
    /// N at the demand \[N\].
    #[serde(rename = "tie_force_at_demand")]
    pub force_at_demand: f64,
    /// Its state there.
    #[serde(rename = "tie_state_at_demand")]
    pub state_at_demand: TieState,
}

impl TieAtLimit {
    pub(super) fn new(tie: &Tie, [u, demand]: [f64; 2]) -> Self {
        Self {
            force: force(tie, u),
            state: TieState::at(tie, u),
            force_at_demand: force(tie, demand),
            state_at_demand: TieState::at(tie, demand),
        }
    }
}

/// How many bars, each with its anchors, hold the width of the wall, of a tie that is given by its bar \[-\].
pub(super) fn anchors(parameters: &Parameters) -> Option<f64> {
    let bar = parameters.bar.filter(|_| parameters.weaker_part().is_some())?;
    Some(bar.spacing.map_or(1.0, |spacing| parameters.width / spacing))
}
