//! The coefficient of restitution: Eqs. (2)–(4), and by impulses.
//!
//! Eq. (3) and [`momentum_vertical_spanning`] take moments of both bodies of a strip about its new base hinge
//! *without the horizontal impulse of the top support*, which is not 0: they are true of a top that gives
//! none. By impulses, an impact projects the old field of velocities on the new one; for a strip that includes
//! the top support, for a rectangular parapet it is Eq. (2).

use crate::choices::{Impact, Mechanism, RestitutionSource, Rocking};

use super::damping::Damping;
use super::error::{Choice, ParameterError};
use super::given::{COMPUTED, given};
use super::mechanism::Body;
use super::parameters::Parameters;
use super::sides::Sides;

/// Analytic coefficient of restitution of a parapet, `e_an` = 1 − (3/2) sin²α. Eq. (2).
pub fn analytic_parapet(slenderness: f64) -> f64 {
    1.0 - 1.5 * slenderness.sin().powi(2)
}

/// Analytic coefficient of restitution of a vertical spanning wall, `e_an` = 1 − 2 sin²α₁. Eq. (3).
pub fn analytic_vertical_spanning(slenderness: f64) -> f64 {
    1.0 - 2.0 * slenderness.sin().powi(2)
}

/// Moments about the new bottom hinge of a vertical spanning wall whose top support gives no horizontal
/// impulse, for any hinge height: e = (h h₁ + h₁² − 3b²)/(h h₁ + h₁² + 3b²). Equals Eq. (3) at h₁ = h/2.
pub fn momentum_vertical_spanning(body: &Body) -> f64 {
    let h1 = body.hinge_height;
    // b = h₁ tan α₁
    let b = h1 * body.slenderness.positive.tan();
    let (sum, loss) = (body.height * h1 + h1 * h1, 3.0 * b * b);
    (sum - loss) / (sum + loss)
}

/// Coefficient of restitution by impulses of a rectangular strip of height h and thickness b with its hinge at
/// h₁ \[m\]: [2h h₁² − 2h₁³ + b²(5h₁ − 6h)]/[2(h h₁² − h₁³ + b²(3h − 2h₁))], at mid-height (h² − 14b²)/(h² +
/// 16b²). Below 0 for squat walls.
///
/// ```
/// let e = rocking_wall::wall::restitution::impulses_of_strip(3.0, 1.5, 0.25);
/// assert!((e - (144.0 - 14.0) / (144.0 + 16.0)).abs() < 1e-15);
/// ```
pub fn impulses_of_strip(height: f64, hinge_height: f64, thickness: f64) -> f64 {
    let (h, h1, b2) = (height, hinge_height, thickness * thickness);
    let common = (h - h1) * h1 * h1;
    (2.0 * common + b2 * (5.0 * h1 - 6.0 * h)) / (2.0 * (common + b2 * (3.0 * h - 2.0 * h1)))
}

/// Ratio `e_exp`/`e_an` of restitution measured on masonry: 0.95 for a parapet, 0.90 for a vertical spanning
/// wall. Tomassetti et al., section 3.2.
pub fn calibration(mechanism: Mechanism) -> f64 {
    match mechanism {
        Mechanism::Parapet | Mechanism::RigidBody => 0.95,
        Mechanism::VerticalSpanning => 0.90,
    }
}

/// Factor on the angular velocity of a homogeneous block that turned about one edge of its base or top and
/// goes on about the back face's edge at the other end: 1 − (3/2) cos²α, negative for slender ones.
pub fn toe_to_top(slenderness: f64) -> f64 {
    1.0 - 1.5 * slenderness.cos().powi(2)
}

/// Coefficient of a parapet against transverse walls, e₁ = −(1 − (3/2) sin²α)² (1 − (3/2) cos²α), as u̇⁺ =
/// −e₁ u̇⁻.
///
/// Conventional, after Sorrentino, Al Shawa and Decanini 2011. The block changes its pivot from the outer toe
/// to the inner one ([`analytic_parapet`]), from there to the back face at the top ([`toe_to_top`]), and once
/// more by the first factor, *assuming* that it keeps its angular velocity and turns about the inner toe
/// again. The strict change from the top back to the outer toe has the factor −1/2 and gives no rebound.
pub fn analytic_one_sided(slenderness: f64) -> f64 {
    -analytic_parapet(slenderness).powi(2) * toe_to_top(slenderness)
}

/// The coefficients of restitution the parameters ask for, positive numbers: from u > 0 to u < 0 (`positive`),
/// and back \[-\]. −1 of a body without formula whose impacts do not count.
///
/// # Errors
/// [`ParameterError::Restitution`] where a formula leaves 0…1, [`ParameterError::Conflict`] with what does not
/// go with one-sided rocking or with the body, [`ParameterError::NotGiven`].
pub(super) fn coefficient(
    parameters: &Parameters,
    damping: Damping,
    body: &Body,
) -> Result<Sides, ParameterError> {
    let number = given("restitution", parameters.restitution)?;
    if parameters.rocking != Rocking::TwoSided {
        return one_sided(parameters, damping, body, number).map(Sides::both);
    }
    if let Some(number) = number {
        return Ok(Sides::both(number));
    }
    let source = parameters.restitution_source;
    let counts = parameters.impact == Impact::Restitution || damping.computed_name().is_some();
    let value = if body.is_rectangle { Some(of_rectangle(source, body)) } else { of_body(source, body) };
    match value {
        Some(e) if [e.least(), e.most()].iter().all(|e| (0.0..=1.0).contains(e)) => Ok(e),
        _ if !(counts || body.is_rectangle) => Ok(Sides::both(COMPUTED)),
        Some(e) => {
            let value = if e.least() < 0.0 { e.least() } else { e.most() };
            Err(ParameterError::Restitution { source: source.name(), value })
        }
        None => {
            let choices = [
                Choice::new("restitution_source", source.name()),
                Choice::new(if body.is_strip() { "parts" } else { "mechanism" }, body.mechanism.name()),
            ];
            Err(ParameterError::conflict(
                choices,
                if body.is_strip() { "restitution_source = impulses, or restitution" } else { "restitution" },
            ))
        }
    }
}

/// That of a rectangle by a source \[-\].
pub(super) fn of_rectangle(source: RestitutionSource, body: &Body) -> Sides {
    let alpha = body.slenderness.positive;
    let (analytic, momentum) = if body.is_strip() {
        (analytic_vertical_spanning(alpha), momentum_vertical_spanning(body))
    } else {
        // Eq. (2) is the conservation of angular momentum about the new toe
        (analytic_parapet(alpha), analytic_parapet(alpha))
    };
    match source {
        RestitutionSource::Analytic => Sides::both(analytic),
        RestitutionSource::Calibrated => Sides::both(calibration(body.mechanism) * analytic),
        RestitutionSource::Momentum => Sides::both(momentum),
        RestitutionSource::Impulses => body.impulses.unwrap_or(Sides::both(analytic)),
    }
}

/// That of a body that is no rectangle: by impulses in place of Eqs. (2) and (3), which are those of rectangles.
/// `None` where the body has none, and for the moments of a strip without impulse at its top.
fn of_body(source: RestitutionSource, body: &Body) -> Option<Sides> {
    let impulses = body.impulses?;
    match source {
        RestitutionSource::Analytic | RestitutionSource::Impulses => Some(impulses),
        RestitutionSource::Calibrated => Some(impulses.map(|e| calibration(body.mechanism) * e)),
        RestitutionSource::Momentum => (!body.is_strip()).then_some(impulses),
    }
}

/// e₁ of one-sided rocking \[-\].
fn one_sided(
    parameters: &Parameters,
    damping: Damping,
    body: &Body,
    number: Option<f64>,
) -> Result<f64, ParameterError> {
    let conflict = |name, value: &dyn ToString, remedy: &str| {
        let (rocking, remedy) = (parameters.rocking.name(), format!("{remedy}, or rocking = two_sided"));
        let choices = [Choice::new("rocking", rocking), Choice::new(name, value.to_string())];
        Err(ParameterError::conflict(choices, remedy))
    };
    if parameters.impact != Impact::Restitution {
        return conflict("impact", &parameters.impact.name(), "impact = restitution");
    }
    if let Some(name) = damping.computed_name() {
        return conflict(name, &"-1 (computed)", "it, damping_model = none");
    }
    let source = parameters.restitution_source;
    let value = match (number, source) {
        (Some(number), _) if number >= 1.0 => {
            return conflict("restitution", &number, "restitution below 1");
        }
        (Some(number), _) => number,
        // the formula is that of a rectangular block
        (None, _) if body.is_strip() || !body.is_rectangle => {
            return conflict("restitution_source", &source.name(), "restitution");
        }
        (None, RestitutionSource::Analytic) => analytic_one_sided(body.slenderness.positive),
        (None, _) => {
            let remedy = "restitution, or restitution_source = analytic";
            return conflict("restitution_source", &source.name(), remedy);
        }
    };
    if (0.0..1.0).contains(&value) {
        Ok(value)
    } else {
        Err(ParameterError::Restitution { source: source.name(), value })
    }
}
