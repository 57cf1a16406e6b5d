//! A wall at its activation, with the ties that count there.

use report::apart;
use rocking_wall::wall::Tie;

use crate::circolare::curve::Curve;
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::StateStatement;
use crate::circolare::statement::table::AtActivation;
use crate::error::CheckError;
use crate::ntc::demand::Demand;

/// Largest `u_y`/`u_0` of a tie that acts at the activation \[-\].
const SOFTEST: f64 = 0.10;

/// A wall at its activation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtActivationNumbers {
    /// α0 with the tie \[-\].
    pub alpha0: f64,
    /// a with the tie, without FC \[m/s²\].
    pub acceleration: f64,
    /// T0 with the tie \[s\].
    pub t0: f64,
    /// N of the tie \[N\].
    pub force: f64,
}

/// The strength of a tie at which a check of accelerations with the capacity times a factor has its target,
/// with the demand of the wall beside this tie alone; `None` for one with slack \[N\].
pub(super) fn required(
    curve: &Curve,
    statement: &Statement,
    given: &StateStatement,
    demand: &Demand,
    tie: &Tie,
    [xi, factor]: [f64; 2],
) -> Result<Option<f64>, CheckError> {
    if tie.slack > 0.0 {
        return Ok(None);
    }
    // N = max(0, [ζ FC S_L/C_L − a_y] s1 e*/(g A))
    let demand = demand.acceleration(given.state, curve.period_beside(std::iter::once(tie)), xi)?;
    let lacking = statement.target * statement.confidence_factor * demand / factor - curve.ay;
    Ok(Some((lacking / curve.of_force(tie.pull)).max(0.0)))
}

/// The wall at its activation, with the tie where it counts there.
pub(super) fn at_activation(curve: &Curve, statement: &Statement) -> Result<AtActivationNumbers, CheckError> {
    let pull = tie_at_activation(curve, statement)?;
    Ok(AtActivationNumbers {
        alpha0: curve.alpha0 + pull / curve.pushed_weight,
        acceleration: curve.ay + curve.of_force(pull),
        t0: if pull > 0.0 { curve.tied_period() } else { curve.t0 },
        force: if pull > 0.0 { curve.ties().filter_map(|tie| tie.strength).sum() } else { 0.0 },
    })
}

/// A `N_y`, the force of the tie at the place of F at the activation; 0 where it does not count \[N\].
///
/// # Errors
/// [`CheckError`] of a tie that does not act there.
pub(super) fn tie_at_activation(curve: &Curve, statement: &Statement) -> Result<f64, CheckError> {
    if statement.at_activation() == AtActivation::None {
        return Ok(0.0);
    }
    let mut pull = 0.0;
    for (index, tie) in curve.ties().enumerate() {
        pull += strength_at_activation(curve, index, tie)?;
    }
    hold_together(curve)?;
    Ok(pull)
}

/// Refuses what `at_activation = "yield"` cannot count.
fn not_at_activation(which: &str, message: &str) -> CheckError {
    CheckError::value(&["tie", "at_activation"], format!("at_activation = \"yield\" {which}{message}"))
}

/// The name of a tie of a side before a message; empty where it is the only one.
fn named_tie(curve: &Curve, index: usize) -> String {
    if curve.has_several_ties() { format!("with tie {} of the side: ", index + 1) } else { String::new() }
}

/// What else helps where the hinge of a strip is the reason: a tie far from it is stretched little.
fn elsewhere(curve: &Curve) -> &'static str {
    if curve.hinge.is_some() {
        ", or, where the hinge is searched, a hinge_range without this place"
    } else {
        ""
    }
}

/// Ties that are counted together have to hold until the last of them has its strength.
fn hold_together(curve: &Curve) -> Result<(), CheckError> {
    let last = curve.ties().filter_map(Tie::strength_displacement).fold(0.0, f64::max);
    let breaks = |tie: &Tie| tie.fracture_displacement().is_some_and(|u| u < last);
    let Some((index, tie)) = curve.ties().enumerate().find(|(_, tie)| breaks(tie)) else { return Ok(()) };
    let [breaks, last] = apart([tie.fracture_displacement().unwrap_or(0.0), last].map(|u| 1e3 * u), 4);
    let message = format!(
        "cannot count it: it is broken at u_r = {breaks} mm, before the last tie has its strength, at u_y = \
         {last} mm; give it tie_ultimate or ultimate_strain, stiffen the last, or state \"none\"{}",
        elsewhere(curve)
    );
    Err(not_at_activation(&named_tie(curve, index), &message))
}

/// A `N_y` of a tie at the activation \[N\].
fn strength_at_activation(curve: &Curve, index: usize, tie: &Tie) -> Result<f64, CheckError> {
    let refused = |message: String| Err(not_at_activation(&named_tie(curve, index), &message));
    let Some(strength) = tie.strength else {
        return refused("needs a tie with tie_strength, N_y in N, or a bar".into());
    };
    if tie.slack > 0.0 {
        return refused(format!(
            "needs a tight tie: with tie_slack = {} m the wall rocks before the tie pulls; state \"none\", \
             or leave tie_slack out",
            tie.slack
        ));
    }
    let (yields, limit) = (strength / tie.stiffness / tie.lever, SOFTEST * curve.zero);
    if yields > limit {
        let [yields, limit] = apart([yields, limit].map(|u| 1e3 * u), 4);
        return refused(format!(
            "needs a stiff tie: this one has its strength at u_y = {yields} mm, beyond {SOFTEST} u_0 = \
             {limit} mm; state \"none\", or a tie with less N_y/K: a bar with less length or yield_stress, \
             for its diameter does not change it{}",
            elsewhere(curve)
        ));
    }
    Ok(tie.pull * strength)
}
