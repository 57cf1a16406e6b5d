//! The outcome of a check.

use rocking_wall::scene::Floors;
use rocking_wall::wall::{Parameters, Wall};
use serde::Serialize;

use super::LimitState;
use super::demand::Demand;
use super::statement::Statement;

/// A wall that was checked, with what it was checked by.
#[derive(Debug)]
pub struct Checked<'a> {
    pub(super) statement: &'a Statement,
    pub(super) parameters: &'a Parameters,
    pub(super) floors: Option<&'a Floors>,
    pub(super) wall: Wall,
    /// Of SLD, SLV and SLC; `None` for one that is not stated.
    pub(super) demands: [Option<Demand>; 3],
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
        let Outcome { sides, governs, .. } = &self.outcome;
        sides
            .iter()
            .find(|(side, _)| *side == governs.side)
            .or(sides.iter().next())
            .map(|(_, verdict)| verdict)
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

    /// Returns the name of the side in tables, `u > 0` or `u < 0`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Positive => "u > 0",
            Self::Negative => "u < 0",
        }
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
    /// Returns the name of the check.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sld => "SLD",
            Self::SlvWithQ => "SLV with q",
            Self::Slv => "SLV",
            Self::Slc => "SLC",
        }
    }

    /// Returns its limit state.
    pub(super) fn state(self) -> LimitState {
        match self {
            Self::Sld => LimitState::Sld,
            Self::SlvWithQ | Self::Slv => LimitState::Slv,
            Self::Slc => LimitState::Slc,
        }
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
    /// The sides there are.
    pub fn iter(&self) -> impl Iterator<Item = (Side, &SideVerdict)> {
        let sides = [(Side::Positive, &self.positive), (Side::Negative, &self.negative)];
        sides.into_iter().filter_map(|(side, verdict)| Some((side, verdict.as_ref()?)))
    }
}

/// The outcome of one side.
#[derive(Clone, Debug, Serialize)]
pub struct SideVerdict {
    /// α0 [C8.7.1.1] \[-\].
    pub alpha0: f64,
    /// e* [C8.7.1.5] \[-\].
    pub e_star: f64,
    /// M* = e* Σ(P + Q)/g \[kg\].
    #[serde(rename = "M_star")]
    pub mass: f64,
    /// `a_0` = α0 g/e*, without FC \[m/s²\].
    pub a0: f64,
    /// `d_0` \[m\].
    pub d0: f64,
    /// T0 of the elastic branch; 0 where the wall is rigid \[s\].
    #[serde(rename = "T0")]
    pub t0: f64,
    /// `d_y`, the end of the elastic branch \[m\].
    pub dy: f64,
    /// `a_y`, without FC \[m/s²\].
    pub ay: f64,
    /// d/u \[-\].
    pub d_per_u: f64,
    /// SLD, activation.
    #[serde(rename = "SLD", skip_serializing_if = "Option::is_none")]
    pub sld: Option<ActivationCheck>,
    /// SLV with q.
    #[serde(rename = "SLV_q", skip_serializing_if = "Option::is_none")]
    pub slv_q: Option<ActivationCheck>,
    /// SLV by displacement.
    #[serde(rename = "SLV", skip_serializing_if = "Option::is_none")]
    pub slv: Option<DisplacementCheck>,
    /// SLC by displacement.
    #[serde(rename = "SLC", skip_serializing_if = "Option::is_none")]
    pub slc: Option<DisplacementCheck>,
    /// `F_act`, the force that α0 takes \[N\].
    #[serde(skip)]
    pub acting_force: f64,
    /// Σ (P + Q) δ over the work of F per unit of u, the divisor of α0 \[N\].
    #[serde(skip)]
    pub pushed_weight: f64,
    /// Where the tie breaks, if it does.
    #[serde(skip)]
    pub tie_break: Option<TieBreak>,
    /// Corners (d, a) of the curve, with FC and the tie \[m, m/s²\].
    #[serde(skip)]
    pub corners: Vec<(f64, f64)>,
}

/// What a curve loses where its tie breaks, C8.7.1.2.1.6; a with FC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieBreak {
    /// u there \[m\].
    pub u: f64,
    /// a with the tie there \[m/s²\].
    pub before: f64,
    /// a without it \[m/s²\].
    pub after: f64,
    /// The largest a from the end of the elastic branch to there \[m/s²\].
    pub largest: f64,
    /// What is lost over the largest \[-\].
    pub loss: f64,
}

/// A check of accelerations, C8.7.1.2.1.5 and C8.7.1.2.1.7.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ActivationCheck {
    /// Capacity, with FC and, in the linear check, times q \[m/s²\].
    pub capacity: f64,
    /// Demand \[m/s²\].
    pub demand: f64,
    /// `ζ_E` = capacity/demand \[-\].
    pub ratio: f64,
    /// `a_g` that just brings the wall there \[g\].
    pub ag: f64,
}

/// A check of displacements, C8.7.1.2.1.8.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DisplacementCheck {
    /// `d_SLV` or `d_SLC` \[m\].
    pub d: f64,
    /// a there, with FC \[m/s²\].
    pub a: f64,
    /// `T_SLV` or `T_SLC` \[s\].
    #[serde(rename = "T")]
    pub period: f64,
    /// `S_e` or `S_eZ` at that period \[m/s²\].
    #[serde(rename = "S_e")]
    pub acceleration: f64,
    /// `S_d` \[m\].
    pub demand: f64,
    /// Both terms of [C8.7.1.12]; the second only behind b T₁ \[m\].
    pub demand_terms: [Option<f64>; 2],
    /// d/`S_d` \[-\].
    pub ratio: f64,
    /// `a_g` that just brings the wall there: `ζ_E` times that of the limit state \[g\].
    pub ag: f64,
    /// `ζ_E` \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
    /// Whether the tie breaks there.
    pub limited_by_tie: bool,
    /// Whether `a_g` is that of SLD, which is larger, C8.7.1.2.1.8.
    #[serde(rename = "raised_to_SLD")]
    pub raised: bool,
}

/// The dynamic check of a wall.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicCheck {
    /// SLV.
    #[serde(rename = "SLV", skip_serializing_if = "Option::is_none")]
    pub slv: Option<DynamicState>,
    /// SLC.
    #[serde(rename = "SLC", skip_serializing_if = "Option::is_none")]
    pub slc: Option<DynamicState>,
}

/// The dynamic check of a limit state.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicState {
    /// Whether no run exceeds `d_0` and the mean of the maxima is within the threshold.
    pub passed: bool,
    /// Mean of the maxima of |d|, or of fewer than 7 records the largest \[m\].
    pub d: f64,
    /// Threshold over it, each side by its own \[-\].
    pub ratio: f64,
    /// How many runs exceed `d_0`.
    pub beyond_d0: usize,
    /// The lowest factor on all records that fails \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
    /// The side of the largest |d| over its threshold.
    pub side: Side,
    /// The runs.
    pub runs: Vec<DynamicRun>,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DynamicRun {
    /// Name of the record.
    pub record: String,
    /// Factor on the record \[-\].
    pub factor: f64,
    /// Largest d on the sides u > 0 and u < 0 \[m\].
    pub d: [f64; 2],
    /// Whether one of them exceeds `d_0`, or the displacement at which the model ends before: that of the
    /// strength of the tie, or `u_ins`.
    pub beyond_d0: bool,
}

impl DynamicCheck {
    pub(super) fn states(&self) -> impl Iterator<Item = (Deciding, &DynamicState)> {
        let states = [(Deciding::Slv, &self.slv), (Deciding::Slc, &self.slc)];
        states.into_iter().filter_map(|(name, state)| Some((name, state.as_ref()?)))
    }

    /// Returns whether every limit state holds.
    pub fn passed(&self) -> bool {
        self.states().all(|(_, state)| state.passed)
    }

    pub(super) fn governs(&self) -> impl Iterator<Item = Governs> {
        self.states().map(|(limit_state, state)| Governs { side: state.side, limit_state, zeta: state.zeta })
    }
}
