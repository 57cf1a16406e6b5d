//! Intermediate numbers of a side, in the order in which a terminal has them.

use super::checks::DisplacementCheck;
use super::sides::SideVerdict;

/// A name, its unit, the number in that unit of a number in SI units, and that number of a side.
pub(super) type Line = (&'static str, &'static str, f64, fn(&SideVerdict) -> Option<f64>);

/// The numbers of a side.
pub(super) const SIDE: [Line; 36] = [
    ("hinge_ratio", "-", 1.0, |side| side.curve.hinge),
    ("least alpha0", "-", 1.0, |side| Some(side.least_alpha0?.alpha0)),
    ("its hinge_ratio", "-", 1.0, |side| Some(side.least_alpha0?.hinge)),
    ("its zeta_E", "-", 1.0, |side| side.least_alpha0?.zeta),
    ("least favourable hinge_ratio", "-", 1.0, |side| side.least_alpha0?.worst_hinge),
    ("its zeta_E, least favourable", "-", 1.0, |side| side.least_alpha0?.worst),
    ("set-back at the base", "mm", 1e3, |side| set_back(side, side.curve.set_back.base)),
    ("set-back in the middle", "mm", 1e3, |side| set_back(side, side.curve.set_back.middle)),
    ("set-back at the top", "mm", 1e3, |side| set_back(side, side.curve.set_back.top)),
    ("alpha0 (without FC)", "-", 1.0, |side| Some(side.curve.alpha0)),
    ("e*", "-", 1.0, |side| Some(side.curve.e_star)),
    ("M*", "kg", 1.0, |side| Some(side.curve.mass)),
    ("a0 (without FC)", "m/s2", 1.0, |side| Some(side.curve.a0)),
    ("d0", "mm", 1e3, |side| Some(side.curve.d0)),
    ("T0", "s", 1.0, |side| Some(side.curve.t0)),
    ("d_y", "mm", 1e3, |side| Some(side.curve.dy)),
    ("a_y (without FC)", "m/s2", 1.0, |side| Some(side.curve.ay)),
    ("tie engaged at u", "mm", 1e3, |side| Some(side.tie?.engaged)),
    ("tie at its strength at u", "mm", 1e3, |side| side.tie?.yields),
    ("tie broken at u", "mm", 1e3, |side| side.tie?.breaks),
    ("tie strength", "kN", 1e-3, |side| side.curve.tie()?.strength),
    ("strength of one anchor", "kN", 1e-3, |side| of_anchor(side, side.curve.tie()?.strength)),
    ("alpha0 with the tie", "-", 1.0, |side| (side.activation.force > 0.0).then_some(side.activation.alpha0)),
    ("T0 with the tie", "s", 1.0, |side| (side.activation.force > 0.0).then_some(side.activation.t0)),
    ("SLD capacity", "m/s2", 1.0, |side| Some(side.checks.sld?.capacity)),
    ("SLD demand", "m/s2", 1.0, |side| Some(side.checks.sld?.demand)),
    ("SLD zeta_E", "-", 1.0, |side| Some(side.checks.sld?.ratio)),
    ("SLD a_g", "g", 1.0, |side| Some(side.checks.sld?.ag)),
    ("SLD, tie needs", "kN", 1e-3, |side| side.checks.sld?.required),
    ("SLD, one anchor needs", "kN", 1e-3, |side| of_anchor(side, side.checks.sld?.required)),
    ("SLV with q, hinge_ratio", "-", 1.0, |side| side.checks.slv_q?.hinge),
    ("SLV with q, demand", "m/s2", 1.0, |side| Some(side.checks.slv_q?.demand)),
    ("SLV with q, zeta_E", "-", 1.0, |side| Some(side.checks.slv_q?.ratio)),
    ("SLV with q, a_g", "g", 1.0, |side| Some(side.checks.slv_q?.ag)),
    ("SLV with q, tie needs", "kN", 1e-3, |side| side.checks.slv_q?.required),
    ("SLV with q, one anchor needs", "kN", 1e-3, |side| of_anchor(side, side.checks.slv_q?.required)),
];

/// The part of a force of the tie that one anchor has, where the bar is known \[N\].
fn of_anchor(side: &SideVerdict, force: Option<f64>) -> Option<f64> {
    Some(force? / side.curve.anchors?)
}

fn set_back(side: &SideVerdict, depth: f64) -> Option<f64> {
    (side.curve.set_back.base > 0.0).then_some(depth)
}

/// The same of a check by displacement.
pub(super) type DisplacementLine =
    (&'static str, &'static str, f64, fn(&SideVerdict, &DisplacementCheck) -> Option<f64>);

/// The numbers of a check by displacement.
pub(super) const DISPLACEMENT: [DisplacementLine; 12] = [
    ("hinge_ratio", "-", 1.0, |_, check| check.hinge),
    ("d", "mm", 1e3, |_, check| Some(check.d)),
    ("a (with FC)", "m/s2", 1.0, |_, check| Some(check.a)),
    ("T", "s", 1.0, |_, check| Some(check.period)),
    ("demand S_d", "mm", 1e3, |_, check| Some(check.demand)),
    ("tie force", "kN", 1e-3, |_, check| Some(check.tie?.force)),
    ("tie force at the demand", "kN", 1e-3, |_, check| Some(check.tie?.force_at_demand)),
    ("force of one anchor", "kN", 1e-3, |side, check| of_anchor(side, Some(check.tie?.force))),
    ("force of one anchor at the demand", "kN", 1e-3, |side, check| {
        of_anchor(side, Some(check.tie?.force_at_demand))
    }),
    ("by displacement", "-", 1.0, |_, check| Some(check.ratio)),
    ("zeta_E", "-", 1.0, |_, check| Some(check.zeta)),
    ("a_g", "g", 1.0, |_, check| Some(check.ag)),
];
