//! The static checks of a side.

mod activation;
pub(crate) mod crack;
pub(super) mod ledger;
pub(crate) mod sides;
mod spectrum;
pub(crate) mod ties;

use report::apart;

use super::curve::Curve;
use super::curve::case::Case;
use super::curve::tie::{TieAtLimit, TieState};
use super::statement::states::StateStatement;
use super::statement::table::{AtActivation, Hinge, Method};
use super::statement::{Displacements, Statement};
use crate::error::CheckError;
use crate::ntc::demand::{Demand, Demands};
use crate::words::names::{Deciding, LimitState};
pub use activation::AtActivationNumbers;
use activation::{at_activation, required};

/// Share of the largest a that a curve loses where a tie breaks, above which that displacement is `d_SLV`,
/// C8.7.1.2.1.6 \[-\].
pub const LARGEST_LOSS: f64 = 0.5;

/// The checks of a side; `None` for one that is not made.
#[derive(Clone, Copy, Debug)]
pub struct Checks {
    /// SLD, activation.
    pub sld: Option<ActivationCheck>,
    /// SLV with q.
    pub slv_q: Option<ActivationCheck>,
    /// SLV by displacement.
    pub slv: Option<DisplacementCheck>,
    /// SLC by displacement.
    pub slc: Option<DisplacementCheck>,
}

/// What the hinge of a side gives.
pub(super) struct AtHinge {
    pub(super) curve: Curve,
    pub(super) checks: Checks,
}

/// The check that governs a side.
#[derive(Clone, Copy)]
pub(super) struct Governing {
    pub(super) check: Deciding,
    /// Its `ζ_E` \[-\]; infinite where none decides.
    pub(super) zeta: f64,
}

impl Checks {
    /// The curve and the checks of a side, with the hinge of a strip at `hinge` h.
    ///
    /// # Errors
    /// [`CheckError`] of a wall or a demand that has no check.
    pub(super) fn at(case: &Case<'_>, sign: f64, hinge: Option<f64>) -> Result<AtHinge, CheckError> {
        Self::of_these(case, sign, hinge, [true; 4])
    }

    /// The same with those of the checks that are wanted, in the order of
    /// [`Deciding::ALL`].
    pub(super) fn of_these(
        case: &Case<'_>,
        sign: f64,
        hinge: Option<f64>,
        wanted: [bool; 4],
    ) -> Result<AtHinge, CheckError> {
        let named = |error: CheckError| match hinge {
            Some(hinge) if case.rule != Some(Hinge::Given) => error.at_hinge(hinge),
            _ => error,
        };
        let found = || {
            let curve = Curve::new(case, sign, hinge)?;
            let demands = match &case.shared {
                Some(shared) => shared,
                None => &case.demands_at(curve.body())?,
            };
            let checks = Self::new(&curve, case.statement, demands, wanted)?;
            Ok(AtHinge { curve, checks })
        };
        found().map_err(named)
    }

    /// Makes those of the checks that are wanted, in the order of [`Deciding::ALL`]; SLD raises the last two.
    pub(super) fn new(
        curve: &Curve,
        statement: &Statement,
        demands: &Demands,
        [wants_sld, wants_slv_q, wants_slv, wants_slc]: [bool; 4],
    ) -> Result<Self, CheckError> {
        let of = |state: LimitState| statement.demanded(demands).find(|(given, _)| given.state == state);
        let sld = of(LimitState::Sld)
            .filter(|_| wants_sld || wants_slv || wants_slc)
            .map(|(given, demand)| activation(curve, statement, given, demand, given.damping, 1.0))
            .transpose()?;
        let q = statement.behaviour_factor;
        // a spectrum of another damping than that of the activation leaves this check out
        let slv_q = of(LimitState::Slv)
            .filter(|_| wants_slv_q)
            .filter(|(given, demand)| {
                statement.table.method == Method::Linear || demand.has_damping(given.activation_damping)
            })
            .map(|(given, demand)| activation(curve, statement, given, demand, given.activation_damping, q))
            .transpose()?;
        let floor = sld.map(|sld| sld.ag);
        let by_displacement = |state: LimitState, is_wanted: bool| {
            of(state)
                .filter(|_| is_wanted)
                .map(|(given, demand)| displacement(curve, statement, given, demand, floor))
                .transpose()
        };
        let slv = by_displacement(LimitState::Slv, wants_slv)?;
        let slc = by_displacement(LimitState::Slc, wants_slc)?;
        if let (Some(slv), Some(slc)) = (slv, slc)
            && slc.d < slv.d
        {
            let [slc, slv] = apart([slc.d, slv.d].map(|d| 1e3 * d), 4);
            let message = format!("SLC comes before SLV: d_SLC = {slc} mm is below d_SLV = {slv} mm");
            return Err(CheckError::value(&["SLC", "displacement"], message));
        }
        Ok(Self { sld, slv_q, slv, slc })
    }

    /// `ζ_E` of the checks, in the order of [`Deciding::ALL`]; infinite for one that is not made.
    pub(super) fn zetas(&self) -> [f64; 4] {
        let of = |zeta: Option<f64>| zeta.unwrap_or(f64::INFINITY);
        [
            of(self.sld.map(|check| check.ratio)),
            of(self.slv_q.map(|check| check.ratio)),
            of(self.slv.map(|check| check.zeta)),
            of(self.slc.map(|check| check.zeta)),
        ]
    }

    /// Where the hinge is in a check, of h \[-\].
    pub(super) fn hinge(&self, check: Deciding) -> Option<f64> {
        match check {
            Deciding::Sld => self.sld?.hinge,
            Deciding::SlvWithQ => self.slv_q?.hinge,
            Deciding::Slv => self.slv?.hinge,
            Deciding::Slc => self.slc?.hinge,
        }
    }

    /// The check that governs this side.
    pub(super) fn governing(&self, statement: &Statement) -> Governing {
        let all = Deciding::ALL.into_iter().zip(self.zetas());
        let deciding = all.filter(|(check, _)| statement.decides(*check));
        let all = deciding.map(|(check, zeta)| Governing { check, zeta });
        let least = all.min_by(|a, b| a.zeta.total_cmp(&b.zeta));
        least.unwrap_or(Governing { check: Deciding::Slv, zeta: f64::INFINITY })
    }
}

/// A check of accelerations, C8.7.1.2.1.5 and C8.7.1.2.1.7.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActivationCheck {
    /// Where the hinge of a strip is, of h \[-\].
    pub hinge: Option<f64>,
    /// Capacity, with FC and, in the linear check, times q \[m/s²\].
    pub capacity: f64,
    /// Demand \[m/s²\].
    pub demand: f64,
    /// `ζ_E` = capacity/demand \[-\].
    pub ratio: f64,
    /// `a_g` that just brings the wall there \[g\].
    pub ag: f64,
    /// Strength of the tie at which `ζ_E` is the target; `None` without a tie, and for one with slack \[N\].
    pub required: Option<f64>,
    /// a of the activation, without FC and q \[m/s²\].
    pub acceleration: f64,
    /// T0 of the demand \[s\].
    pub t0: f64,
}

/// A check of displacements, C8.7.1.2.1.8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplacementCheck {
    /// Where the hinge of a strip is, of h \[-\].
    pub hinge: Option<f64>,
    /// `d_SLV` or `d_SLC` \[m\].
    pub d: f64,
    /// a there, with FC \[m/s²\].
    pub a: f64,
    /// `T_SLV` or `T_SLC` \[s\].
    pub period: f64,
    /// `S_e` or `S_eZ` at that period \[m/s²\].
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
    pub zeta: f64,
    /// Whether the tie breaks there.
    pub limited_by_tie: bool,
    /// Whether `a_g` is that of SLD, which is larger, C8.7.1.2.1.8.
    pub raised: bool,
    /// The tie there and at the demand, of a side that one tie holds.
    pub tie: Option<TieAtLimit>,
    /// Whether a tie is broken there.
    pub has_broken_tie: bool,
}

/// C8.7.1.2.1.5 with the capacity times `factor`: `a_0` of a wall that is held, or `a_y`, over FC, with the
/// tie at its strength where it counts at the activation.
fn activation(
    curve: &Curve,
    statement: &Statement,
    given: &StateStatement,
    demand: &Demand,
    xi: f64,
    factor: f64,
) -> Result<ActivationCheck, CheckError> {
    let AtActivationNumbers { acceleration, t0, .. } = at_activation(curve, statement)?;
    let capacity = factor * acceleration / statement.confidence_factor;
    // several ties share what is required: each is told it alone
    let required = match curve.tie().filter(|_| !curve.has_several_ties()) {
        Some(tie) => required(curve, statement, given, demand, tie, [xi, factor])?,
        None => None,
    };
    let demand = demand.acceleration(given.state, t0, xi)?;
    let ratio = capacity / demand;
    Ok(ActivationCheck {
        hinge: curve.hinge,
        capacity,
        demand,
        ratio,
        ag: ratio * given.ag,
        required,
        acceleration,
        t0,
    })
}

/// Returns the displacement u of a limit state, and whether the tie breaks there, C8.7.1.2.1.6 \[m\].
fn limit(curve: &Curve, given: &StateStatement, fraction: f64) -> Result<(f64, bool), CheckError> {
    let of_curve = fraction * curve.zero;
    if given.state == LimitState::Slc {
        let Some(local) = given.displacement else { return Ok((of_curve, false)) };
        if !(local > 0.0 && local < curve.zero) {
            let [_, zero] = apart([local, curve.zero], 4);
            let message = format!("SLC.displacement = {local} m must be above 0 and below u_0 = {zero} m");
            return Err(CheckError::value(&["SLC", "displacement"], message));
        }
        return Ok((of_curve.min(local), false));
    }
    Ok(curve.lost_before(of_curve, LARGEST_LOSS).map_or((of_curve, false), |u| (u, true)))
}

/// Whether the acceleration of activation at SLD is the least one of a limit state, C8.7.1.2.1.8: always of
/// SLV; of SLC where that is stated, and not by a tie that SLD counts and that is broken at `d_SLC`.
fn is_raised(statement: &Statement, state: LimitState, has_broken_tie: bool) -> bool {
    let is_broken = statement.at_activation() == AtActivation::Yield && has_broken_tie;
    state == LimitState::Slv || statement.table.raise_slc && !is_broken
}

fn displacement(
    curve: &Curve,
    statement: &Statement,
    given: &StateStatement,
    demand: &Demand,
    floor: Option<f64>,
) -> Result<DisplacementCheck, CheckError> {
    let state = given.state;
    let Displacements { fraction, period_factor } = statement.rules(state);
    let (u, limited_by_tie) = limit(curve, given, fraction)?;
    let (d, a) = (curve.d_per_u * u, curve.tied(u));
    if a <= 0.0 {
        return Err(CheckError::wall(format!("{state}: a is not positive at d = {d} m")));
    }
    let (elastic, end) = (curve.dy, fraction * curve.d0);
    if end <= elastic {
        let [elastic, end] = apart([elastic, end].map(|d| 1e3 * d), 4);
        return Err(CheckError::wall(format!(
            "{state}: the elastic branch ends at d_y = {elastic} mm, beyond {fraction:.2} d_0 = {end} mm: \
             lower a1 or raise E"
        )));
    }
    let period = Curve::period(period_factor, d, a);
    let t0 = curve.tied_period().min(period);
    let (acceleration, demand, demand_terms) = demand.displacement(state, [t0, period], given.damping)?;
    let ratio = d / demand;
    let alone = curve.tie().filter(|_| !curve.has_several_ties());
    let tie = alone.map(|tie| TieAtLimit::new(tie, [u, demand / curve.d_per_u]));
    let has_broken_tie = curve.ties().any(|tie| TieState::at(tie, u) == TieState::Broken);
    let least = floor.filter(|_| is_raised(statement, state, has_broken_tie)).unwrap_or(0.0);
    let raised = least > ratio * given.ag;
    let ag = if raised { least } else { ratio * given.ag };
    let zeta = if raised { least / given.ag } else { ratio };
    Ok(DisplacementCheck {
        hinge: curve.hinge,
        d,
        a,
        period,
        acceleration,
        demand,
        demand_terms,
        ratio,
        ag,
        zeta,
        limited_by_tie,
        raised,
        tie,
        has_broken_tie,
    })
}
