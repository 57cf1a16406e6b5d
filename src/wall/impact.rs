//! The coefficient of restitution of a wall, by its parameters and its body.

use crate::choices::{Impact, RestitutionSource, Rocking};

use super::damping::Damping;
use super::error::{Choice, ParameterError};
use super::given::{COMPUTED, given};
use super::mechanism::Body;
use super::parameters::Parameters;
use super::restitution::{
    analytic_one_sided, analytic_parapet, analytic_vertical_spanning, calibration, momentum_vertical_spanning,
};
use super::sides::Sides;

/// The coefficients of restitution the parameters ask for, positive numbers: from u > 0 to u < 0
/// (`positive`), and back \[-\]. −1 of a body without formula whose impacts do not count.
///
/// # Errors
/// [`ParameterError::Restitution`] where a formula leaves 0…1, [`ParameterError::Conflict`] with what does
/// not go with one-sided rocking or with the body, [`ParameterError::NotGiven`].
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
                Choice::new("mechanism", body.mechanism.name()),
            ];
            Err(ParameterError::conflict(
                choices,
                if body.is_strip() {
                    "restitution_source = impulses, or restitution"
                } else {
                    "restitution, or xi and impact = none: a rigid body states no toes to compute it from"
                },
            ))
        }
    }
}

/// That of a rectangle by a source \[-\].
pub(super) fn of_rectangle(source: RestitutionSource, body: &Body) -> Sides {
    let alpha = body.slenderness.positive;
    // b = h₁ tan α₁
    let b = body.hinge_height * alpha.tan();
    let (analytic, momentum) = if body.is_strip() {
        (analytic_vertical_spanning(alpha), momentum_vertical_spanning(body.height, body.hinge_height, b))
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

/// That of a body that is no rectangle: by impulses in place of Eqs. (2) and (3), which are those of
/// rectangles. `None` where the body has none, and for the moments of a strip without impulse at its top.
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
