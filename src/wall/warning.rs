//! What a user should know about valid parameters.

use super::equivalence;

/// A usual step of records and importers \[s\].
pub(super) const USUAL_STEP: f64 = 0.01;

/// Something a user should know about valid parameters.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum Warning {
    /// A parameter that is set and has no effect.
    #[error("{name} is set and has no effect: it counts where {condition}")]
    NoEffect { name: &'static str, condition: &'static str },
    /// Eq. (23) outside an unloaded parapet.
    #[error("computed c_bar (Eq. 23) is valid only for a parapet without overburden; set c_bar")]
    ComputedFreeStanding,
    /// A formula of rectangles, for a body that is none.
    #[error(
        "restitution_source = {name} has formulas of rectangles: the restitution of this body is by \
         impulses{}; set restitution_source = impulses, or restitution",
        if *name == "calibrated" { ", times the ratio measured on rectangles" } else { "" }
    )]
    ByImpulses { name: &'static str },
    /// A body whose rotations are taken as small and are not \[rad\].
    #[error(
        "the slenderness angle of this body is {slenderness:.3} rad: small rotations are off by some per \
         cent from 0.25 rad on, 3 % in the time of a swing up to 0.9 u_ins at 0.33 rad{}",
        if *has_full_ones {
            "; kinematics = trigonometric has full ones, for force_law = rigid_linear without damping"
        } else {
            ""
        }
    )]
    LargeRotations { slenderness: f64, has_full_ones: bool },
    /// Viscous damping computed from e, and e applied at impacts as well.
    #[error(
        "computed damping already represents the impacts: with impact = restitution the energy loss is \
         counted twice; set damping_model = none or impact = none"
    )]
    CountedTwice,
    /// a₁ outside the fit of Eqs. (20)–(22).
    #[error(
        "a1 = {} is outside the range {} to {} in which computed damping (Eqs. 20 to 22) was fitted",
        six_digits(*a1),
        equivalence::FITTED_A1.start(),
        equivalence::FITTED_A1.end()
    )]
    OutsideFit { a1: f64 },
    /// e = 1 and no damping.
    #[error("restitution = 1 without damping: the wall loses no energy and never comes to rest")]
    NeverRests,
    /// An elastic frequency that makes steps expensive \[rad/s\].
    #[error(
        "omega1 = {omega1:.3e} rad/s: the wall vibrates {:.0} times in {USUAL_STEP} s, and computing takes \
         as much longer than usual; check a1, thickness, density and overburden",
        omega1 * USUAL_STEP / std::f64::consts::TAU
    )]
    Fast { omega1: f64 },
    /// A tie that holds the wall beyond its instability.
    #[error(
        "the tie{} pulls the wall back even beyond u_ins = {u_ins:.6} m: overturned means |u| > u_ins of the \
         wall without its tie, not a collapse; compare tie_force with what the tie resists",
        at_height(*height)
    )]
    TieHolds { u_ins: f64, height: Option<f64> },
    /// A start that has stretched a tie, or broken it, and the plastic elongation that it has then \[m\].
    #[error(
        "u_start = {u_start} m is beyond {} m, where the tie{} {}: it starts {} by {} m",
        six_digits(*limit),
        at_height(*height),
        if *broken { "breaks" } else { "yields" },
        if *broken { "broken, stretched" } else { "stretched" },
        six_digits(*elongation)
    )]
    StretchedStart { u_start: f64, limit: f64, elongation: f64, broken: bool, height: Option<f64> },
    /// A tie that never pulls, since its side never moves away.
    #[error(
        "the tie{} has no effect: it holds u {side} 0, and the wall rocks to the other side only; check \
         rocking and tie_side",
        at_height(*height)
    )]
    NeverPulls { side: &'static str, height: Option<f64> },
    /// A number that walls rarely have: probably a typing error or another unit.
    #[error("{}", unusual(name, *value, unit, *usual, *meant))]
    Unusual {
        name: &'static str,
        value: f64,
        unit: &'static str,
        usual: [f64; 2],
        /// How it was perhaps meant, such as "in cm", and the number in its own unit then.
        meant: Option<(&'static str, f64)>,
    },
}

/// The height of one of several ties \[m\].
fn at_height(height: Option<f64>) -> String {
    height.map_or_else(String::new, |height| format!(" at {} m", six_digits(height)))
}

fn unusual(name: &str, value: f64, unit: &str, usual: [f64; 2], meant: Option<(&str, f64)>) -> String {
    let [value, least, most] = [value, usual[0], usual[1]].map(six_digits);
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let remedy = match meant {
        Some((other, own)) => format!("if it is {other}, give {}{unit}", six_digits(own)),
        None => "check value and unit".to_owned(),
    };
    format!("{name} = {value}{unit} is unusual: {least} to {most}{unit} is usual; {remedy}")
}

/// Writes a number to six digits, in powers of ten where it is very large or small.
pub fn six_digits(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    if value == 0.0 || (1e-4..1e9).contains(&value.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

impl Warning {
    /// Returns whether the warning says that runs take long.
    pub fn is_about_work(&self) -> bool {
        matches!(self, Self::Fast { .. })
    }
}
