//! The ties of a side: where each pulls, yields and breaks, and what each does at the limit states.

use rocking_wall::wall::Tie;

use super::activation::{required, tie_at_activation};
use super::{Checks, DisplacementCheck};
use crate::circolare::curve::Curve;
use crate::circolare::curve::case::Case;
use crate::circolare::curve::tie::TieAtLimit;
use crate::error::CheckError;
use crate::ntc::demand::Demands;
use crate::words::names::LimitState;

/// Displacements u of a tie, and what its rupture takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieNumbers {
    /// Where it begins to pull \[m\].
    pub engaged: f64,
    /// Where it has its strength \[m\].
    pub yields: Option<f64>,
    /// Where it breaks \[m\].
    pub breaks: Option<f64>,
    /// What the curve loses there, over its largest a \[-\].
    pub loss: Option<f64>,
}

impl TieNumbers {
    /// Those of a tie, by its place among those of the side.
    pub(super) fn new(curve: &Curve, index: usize, tie: &Tie) -> Self {
        let broken = curve.breaks().into_iter().find(|broken| broken.tie == index);
        Self {
            engaged: tie.onset(),
            yields: tie.strength_displacement(),
            breaks: tie.fracture_displacement(),
            loss: broken.map(|broken| broken.loss),
        }
    }
}

/// One of several ties of a side.
#[derive(Clone, Debug, PartialEq)]
pub struct TieVerdict {
    /// Its place in the list of the ties.
    pub place: usize,
    /// Height above the base about which the wall turns \[m\].
    pub height: f64,
    /// The tie.
    pub tie: Tie,
    /// Where it pulls, yields and breaks.
    pub numbers: TieNumbers,
    /// N at the activation, where it counts there \[N\].
    pub at_activation: f64,
    /// The tie at the limit states by displacement.
    pub limits: Vec<(LimitState, TieAtLimit)>,
    /// Strength at which `ζ_E` is the target with this tie alone, of SLD and of SLV with q \[N\].
    pub required: [Option<f64>; 2],
}

/// The ties of a side, with what its checks make of each.
pub(super) fn of_ties(
    case: &Case<'_>,
    sign: f64,
    curve: &Curve,
    checks: &Checks,
) -> Result<Vec<TieVerdict>, CheckError> {
    let counts = tie_at_activation(curve, case.statement)? > 0.0;
    let demands = match &case.shared {
        Some(shared) => shared,
        None => &case.demands_at(curve.body())?,
    };
    let given = case.parameters.ties().enumerate();
    let held = given.filter(|(_, tie)| tie.stiffness > 0.0 && tie.holds(sign));
    let mut ties = Vec::new();
    for (index, ((place, numbers), tie)) in held.zip(curve.ties()).enumerate() {
        let limit = |state, check: Option<DisplacementCheck>| {
            let check = check?;
            Some((state, TieAtLimit::new(tie, [check.d, check.demand].map(|d| d / curve.d_per_u))))
        };
        let limits = [(LimitState::Slv, checks.slv), (LimitState::Slc, checks.slc)];
        ties.push(TieVerdict {
            place,
            height: numbers.height,
            tie: tie.clone(),
            numbers: TieNumbers::new(curve, index, tie),
            at_activation: tie.strength.filter(|_| counts).unwrap_or(0.0),
            limits: limits.into_iter().filter_map(|(state, check)| limit(state, check)).collect(),
            required: alone(case, curve, tie, demands)?,
        });
    }
    Ok(ties)
}

/// What SLD and SLV with q require of a tie alone.
fn alone(
    case: &Case<'_>,
    curve: &Curve,
    tie: &Tie,
    demands: &Demands,
) -> Result<[Option<f64>; 2], CheckError> {
    let mut all = [None; 2];
    for (given, demand) in case.statement.demanded(demands) {
        let (place, xi, factor) = match given.state {
            LimitState::Sld => (0, given.damping, 1.0),
            LimitState::Slv => (1, given.activation_damping, case.statement.behaviour_factor),
            LimitState::Slc => continue,
        };
        if demand.has_damping(xi) {
            all[place] = required(curve, case.statement, given, demand, tie, [xi, factor])?;
        }
    }
    Ok(all)
}
