//! The outcome of a check.

use rocking_wall::scene::Floors;
use rocking_wall::wall::{Parameters, Wall};
use serde::Serialize;

use super::LimitState;
use super::case::Demands;
use super::compatibility::Compatibility;
use super::side_verdict::SideVerdict;
use super::statement::Statement;
use super::table::Hinge;

/// A wall that was checked, with what it was checked by.
#[derive(Debug)]
pub struct Checked<'a> {
    pub(super) statement: &'a Statement,
    /// Its parameters as the check takes them, with the hinge of the side that governs.
    pub(super) parameters: Parameters,
    pub(super) floors: Option<&'a Floors>,
    pub(super) wall: Wall,
    /// Where the hinge of a strip is.
    pub(super) rule: Option<Hinge>,
    /// Of SLD, SLV and SLC; `None` for one that is not stated.
    pub(super) demands: Demands,
    /// The outcome.
    pub outcome: Outcome,
}

impl Checked<'_> {
    /// The sides that differ, with their names.
    pub(super) fn sides(&self) -> impl Iterator<Item = (&'static str, Side, &SideVerdict)> {
        let alike = self.outcome.alike;
        let shown = self.outcome.sides.iter().take(if alike { 1 } else { 2 });
        shown.map(move |(side, verdict)| (if alike { "both sides" } else { side.name() }, side, verdict))
    }

    /// The side that governs.
    pub(super) fn governing(&self) -> Option<&SideVerdict> {
        self.outcome.sides.shown(self.outcome.governs.side)
    }
}

/// The outcome of a check. Serialized it is what `wall check --json` prints: SI units, `a_g` in g.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Name of the code.
    pub code: &'static str,
    /// Whether every limit state that decides holds on every side.
    pub passed: bool,
    /// What governs: the smallest `ζ_E` of those that decide.
    pub governs: Governs,
    /// Whether both sides are alike.
    #[serde(skip)]
    pub alike: bool,
    /// The sides to which the wall can rock.
    pub sides: SideVerdicts,
    /// The dynamic check, where there are records for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dynamic: Option<DynamicCheck>,
    /// What the engineer should know; none of it stops the check.
    pub warnings: Vec<String>,
}

/// What governs a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Governs {
    /// `positive` or `negative`; in the dynamic check the side of the largest response.
    pub side: Side,
    /// The limit state, and `SLV_q` for the linear check.
    pub limit_state: Deciding,
    /// `ζ_E` \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
}

/// A side of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// u > 0.
    Positive,
    /// u < 0.
    Negative,
}

impl Side {
    /// The side of a sign of u.
    pub fn of(sign: f64) -> Self {
        if sign < 0.0 { Self::Negative } else { Self::Positive }
    }

    /// The sign of u.
    pub(super) fn sign(self) -> f64 {
        [1.0, -1.0][self as usize]
    }

    /// Returns the name of the side in tables, `u > 0` or `u < 0`.
    pub fn name(self) -> &'static str {
        ["u > 0", "u < 0"][self as usize]
    }
}

/// Which of the checks governs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Deciding {
    /// Activation.
    #[serde(rename = "SLD")]
    Sld,
    /// SLV with q.
    #[serde(rename = "SLV_q")]
    SlvWithQ,
    /// SLV by displacement, or dynamic.
    #[serde(rename = "SLV")]
    Slv,
    /// SLC by displacement, or dynamic.
    #[serde(rename = "SLC")]
    Slc,
}

impl Deciding {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Sld, Self::SlvWithQ, Self::Slv, Self::Slc];

    /// Returns the name of the check.
    pub fn name(self) -> &'static str {
        ["SLD", "SLV with q", "SLV", "SLC"][self as usize]
    }

    /// Returns its limit state.
    pub(super) fn state(self) -> LimitState {
        [LimitState::Sld, LimitState::Slv, LimitState::Slv, LimitState::Slc][self as usize]
    }
}

/// The outcomes of both sides; `None` for one to which the wall cannot rock.
#[derive(Clone, Debug, Serialize)]
pub struct SideVerdicts {
    /// u > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub positive: Option<SideVerdict>,
    /// u < 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub negative: Option<SideVerdict>,
}

impl SideVerdicts {
    /// The verdict of a side.
    pub(super) fn of(&self, side: Side) -> Option<&SideVerdict> {
        [&self.positive, &self.negative][side as usize].as_ref()
    }

    /// The verdict of a side; where the wall is not checked to that, of the other.
    pub(super) fn shown(&self, side: Side) -> Option<&SideVerdict> {
        self.of(side).or(self.positive.as_ref()).or(self.negative.as_ref())
    }

    /// The sides there are.
    pub fn iter(&self) -> impl Iterator<Item = (Side, &SideVerdict)> {
        let sides = [(Side::Positive, &self.positive), (Side::Negative, &self.negative)];
        sides.into_iter().filter_map(|(side, verdict)| Some((side, verdict.as_ref()?)))
    }
}

/// The dynamic check of a wall.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicCheck {
    /// Where the hinge of a strip is in the runs, of h \[-\].
    #[serde(rename = "hinge_ratio", skip_serializing_if = "Option::is_none")]
    pub hinge: Option<f64>,
    /// Whether a run that reaches the strength of the tie fails.
    #[serde(skip)]
    pub tie_is_end: bool,
    /// SLV.
    #[serde(rename = "SLV", skip_serializing_if = "Option::is_none")]
    pub slv: Option<DynamicState>,
    /// SLC.
    #[serde(rename = "SLC", skip_serializing_if = "Option::is_none")]
    pub slc: Option<DynamicState>,
}

/// The judgement of the maxima of some records, each with its signs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Whether no run exceeds `d_0` or fails by its tie, and the mean of the shares of the threshold is at
    /// most 1.
    pub passed: bool,
    /// Mean of the maxima of |d|, or of fewer than 7 records the largest; of both signs the worse \[m\].
    pub d: f64,
    /// Threshold over it, each side by its own \[-\].
    pub ratio: f64,
    /// How many runs exceed `d_0`.
    pub beyond_d0: usize,
    /// How many runs reach the strength of the tie.
    pub at_strength: usize,
    /// The side of the largest |d| over its threshold.
    pub side: Side,
}

/// The dynamic check of a limit state.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicState {
    /// The judgement of its runs.
    #[serde(flatten)]
    pub judged: Judged,
    /// The lowest factor on all records that fails \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
    /// The records beside the spectrum of the ground, where the site has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compatibility: Option<Compatibility>,
    /// Thresholds of d on the sides u > 0 and u < 0; `None` on one to which the wall of the runs does not
    /// rock \[m\].
    #[serde(skip)]
    pub thresholds: [Option<f64>; 2],
    /// The runs: of each record, with each sign.
    pub runs: Vec<DynamicRun>,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DynamicRun {
    /// Name of the record.
    pub record: String,
    /// Factor on the record \[-\].
    pub factor: f64,
    /// Sign with which it acts, 1 or −1.
    pub sign: f64,
    /// Largest d on the sides u > 0 and u < 0 \[m\].
    pub d: [f64; 2],
    /// Whether one of them exceeds `d_0`, or `u_ins` where the model ends before.
    pub beyond_d0: bool,
    /// Whether the tie reaches its strength.
    pub at_strength: bool,
}

impl DynamicCheck {
    pub(super) fn states(&self) -> impl Iterator<Item = (LimitState, &DynamicState)> {
        let states = [(LimitState::Slv, &self.slv), (LimitState::Slc, &self.slc)];
        states.into_iter().filter_map(|(state, found)| Some((state, found.as_ref()?)))
    }

    /// Returns whether every limit state holds.
    pub fn passed(&self) -> bool {
        self.states().all(|(_, state)| state.judged.passed)
    }

    pub(super) fn governs(&self) -> impl Iterator<Item = Governs> {
        self.states().map(|(state, found)| Governs {
            side: found.judged.side,
            limit_state: if state == LimitState::Slc { Deciding::Slc } else { Deciding::Slv },
            zeta: found.zeta,
        })
    }
}
