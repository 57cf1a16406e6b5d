//! The outcome of one side: its numbers, and its checks.

use ::report::number;
use serde::Serialize;

use super::LimitState;
use super::checks::Checks;
use super::curve::Curve;
use super::tie::TieAtLimit;

/// The outcome of one side.
#[derive(Clone, Debug, Serialize)]
pub struct SideVerdict {
    /// The curve with the hinge of the check that governs, and its numbers.
    #[serde(flatten)]
    pub curve: Curve,
    /// The checks.
    #[serde(flatten)]
    pub checks: Checks,
    /// What the hinge of the least α0 gives, and the least favourable one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_alpha0: Option<LeastAlpha0>,
    /// The wall at its activation, with the tie where it counts there.
    pub activation: AtActivationNumbers,
    /// The tie, on a side that it holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tie: Option<TieNumbers>,
    /// `ζ_E` without the tie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub untied: Option<Untied>,
    /// `ζ_E` with half and twice a₁ or E.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sensitivity: Vec<Sensitivity>,
    /// The curves with the hinges of checks that have their own.
    #[serde(skip)]
    pub others: Vec<Curve>,
}

impl SideVerdict {
    /// The curve with a hinge that a check has.
    pub(super) fn at(&self, hinge: Option<f64>) -> &Curve {
        self.others.iter().find(|other| other.hinge == hinge).unwrap_or(&self.curve)
    }

    /// The check of a limit state by displacement.
    pub(super) fn displacement(&self, state: LimitState) -> Option<DisplacementCheck> {
        [None, self.checks.slv, self.checks.slc][state as usize]
    }

    /// The checks by displacement that are made.
    pub(super) fn by_displacement(&self) -> impl Iterator<Item = (LimitState, DisplacementCheck)> {
        LimitState::ALL.into_iter().filter_map(|state| Some((state, self.displacement(state)?)))
    }
}

/// What the hinge of the least α0 gives, and beside it the least favourable one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeastAlpha0 {
    /// The least α0 \[-\].
    pub alpha0: f64,
    /// Its hinge, of h \[-\].
    #[serde(rename = "hinge_ratio")]
    pub hinge: f64,
    /// The least `ζ_E` that decides with that hinge \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: Option<f64>,
    /// The least `ζ_E` that decides with any hinge of the range; `None` where it was not searched \[-\].
    #[serde(rename = "worst_zeta_E")]
    pub worst: Option<f64>,
    /// Its hinge, of h \[-\].
    #[serde(rename = "worst_hinge_ratio")]
    pub worst_hinge: Option<f64>,
}

/// A wall at its activation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct AtActivationNumbers {
    /// α0 with the tie \[-\].
    pub alpha0: f64,
    /// a with the tie, without FC \[m/s²\].
    #[serde(rename = "a")]
    pub acceleration: f64,
    /// T0 with the tie \[s\].
    #[serde(rename = "T0")]
    pub t0: f64,
    /// N of the tie \[N\].
    #[serde(rename = "tie_force")]
    pub force: f64,
}

/// Displacements u of a tie, and what its rupture takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TieNumbers {
    /// Where it begins to pull \[m\].
    #[serde(rename = "u_engaged")]
    pub engaged: f64,
    /// Where it has its strength \[m\].
    #[serde(rename = "u_yield")]
    pub yields: Option<f64>,
    /// Where it breaks \[m\].
    #[serde(rename = "u_break")]
    pub breaks: Option<f64>,
    /// What the curve loses there, over its largest a \[-\].
    pub loss: Option<f64>,
}

/// `ζ_E` of a side without its tie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Untied {
    /// SLV \[-\].
    #[serde(rename = "SLV")]
    pub slv: Option<f64>,
    /// SLC \[-\].
    #[serde(rename = "SLC")]
    pub slc: Option<f64>,
}

/// The verdict on a side with another a₁ or E; without numbers where the check is impossible.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sensitivity {
    /// `a1` or `young_modulus`.
    pub parameter: &'static str,
    /// Its value.
    pub value: f64,
    /// The least `ζ_E` that decides \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: Option<f64>,
    /// Whether the side passes.
    pub passed: Option<bool>,
    /// `ζ_E` of SLV \[-\].
    #[serde(rename = "SLV")]
    pub slv: Option<f64>,
    /// `ζ_E` of SLC \[-\].
    #[serde(rename = "SLC")]
    pub slc: Option<f64>,
    /// `ζ_E` of each check, in the order of [`Deciding::ALL`]; infinite for one that is not made \[-\].
    #[serde(skip)]
    pub(super) zetas: [f64; 4],
}

impl Sensitivity {
    /// Returns the parameter and its value for people: E in `MPa`.
    pub(super) fn assigned(&self) -> String {
        match self.parameter {
            "young_modulus" => format!("E = {} MPa", number(1e-6 * self.value, 4)),
            name => format!("{name} = {}", number(self.value, 4)),
        }
    }
}

/// What a curve loses where its tie breaks, C8.7.1.2.1.6; a with FC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieBreak {
    /// u there \[m\].
    pub u: f64,
    /// a with the tie there \[m/s²\].
    pub before: f64,
    /// The largest a that the wall alone reaches from there on \[m/s²\].
    pub after: f64,
    /// The largest a of the whole curve \[m/s²\].
    pub largest: f64,
    /// What is lost over the largest \[-\].
    pub loss: f64,
}

/// A check of accelerations, C8.7.1.2.1.5 and C8.7.1.2.1.7.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ActivationCheck {
    /// Where the hinge of a strip is, of h \[-\].
    #[serde(rename = "hinge_ratio", skip_serializing_if = "Option::is_none")]
    pub hinge: Option<f64>,
    /// Capacity, with FC and, in the linear check, times q \[m/s²\].
    pub capacity: f64,
    /// Demand \[m/s²\].
    pub demand: f64,
    /// `ζ_E` = capacity/demand \[-\].
    pub ratio: f64,
    /// `a_g` that just brings the wall there \[g\].
    pub ag: f64,
    /// Strength of the tie at which `ζ_E` is 1; `None` without a tie, and for one with slack \[N\].
    #[serde(rename = "tie_required")]
    pub required: Option<f64>,
    /// a of the activation, without FC and q \[m/s²\].
    #[serde(skip)]
    pub acceleration: f64,
    /// T0 of the demand \[s\].
    #[serde(skip)]
    pub t0: f64,
}

/// A check of displacements, C8.7.1.2.1.8.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DisplacementCheck {
    /// Where the hinge of a strip is, of h \[-\].
    #[serde(rename = "hinge_ratio", skip_serializing_if = "Option::is_none")]
    pub hinge: Option<f64>,
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
    /// The tie there and at the demand.
    #[serde(flatten)]
    pub tie: Option<TieAtLimit>,
}
