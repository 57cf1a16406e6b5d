//! The coefficient of restitution, Eqs. (2)–(4).

use crate::choices::{Impact, Mechanism, RestitutionSource, Rocking};

use super::damping::Damping;
use super::error::{Choice, ParameterError};
use super::given::given;
use super::mechanism::Body;
use super::parameters::Parameters;

/// Analytic coefficient of restitution of a parapet, `e_an` = 1 − (3/2) sin²α. Eq. (2).
pub fn analytic_parapet(slenderness: f64) -> f64 {
    1.0 - 1.5 * slenderness.sin().powi(2)
}

/// Analytic coefficient of restitution of a vertical spanning wall, `e_an` = 1 − 2 sin²α₁. Eq. (3).
pub fn analytic_vertical_spanning(slenderness: f64) -> f64 {
    1.0 - 2.0 * slenderness.sin().powi(2)
}

/// Conservation of angular momentum about the new bottom hinge of a vertical spanning wall, for any hinge
/// height: e = (h h₁ + h₁² − 3b²)/(h h₁ + h₁² + 3b²). Equals Eq. (3) at h₁ = h/2.
pub fn momentum_vertical_spanning(body: &Body) -> f64 {
    let h1 = body.hinge_height;
    // b = h₁ tan α₁
    let b = h1 * body.slenderness.tan();
    let (sum, loss) = (body.height * h1 + h1 * h1, 3.0 * b * b);
    (sum - loss) / (sum + loss)
}

/// Ratio `e_exp`/`e_an` of restitution measured on masonry: 0.95 for a parapet, 0.90 for a vertical spanning
/// wall. Tomassetti et al., section 3.2.
pub fn calibration(mechanism: Mechanism) -> f64 {
    match mechanism {
        Mechanism::Parapet => 0.95,
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

/// The coefficient of restitution the parameters ask for, a positive number \[-\].
///
/// # Errors
/// [`ParameterError::Restitution`] where a squat wall makes the formula leave 0…1,
/// [`ParameterError::Conflict`] with what does not go with one-sided rocking, [`ParameterError::NotGiven`].
pub(super) fn coefficient(
    parameters: &Parameters,
    damping: Damping,
    body: &Body,
) -> Result<f64, ParameterError> {
    let number = given("restitution", parameters.restitution)?;
    if parameters.rocking != Rocking::TwoSided {
        return one_sided(parameters, damping, body, number);
    }
    if let Some(number) = number {
        return Ok(number);
    }
    let analytic = match body.mechanism {
        Mechanism::Parapet => analytic_parapet(body.slenderness),
        Mechanism::VerticalSpanning => analytic_vertical_spanning(body.slenderness),
    };
    let source = parameters.restitution_source;
    let value = match (source, body.mechanism) {
        // Eq. (2) is the conservation of angular momentum about the new toe.
        (RestitutionSource::Analytic, _) | (RestitutionSource::Momentum, Mechanism::Parapet) => analytic,
        (RestitutionSource::Calibrated, mechanism) => calibration(mechanism) * analytic,
        (RestitutionSource::Momentum, Mechanism::VerticalSpanning) => momentum_vertical_spanning(body),
    };
    if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err(ParameterError::Restitution { source: source.name(), value })
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
    let value = match (number, source, body.mechanism) {
        (Some(number), ..) if number >= 1.0 => {
            return conflict("restitution", &number, "restitution below 1");
        }
        (Some(number), ..) => number,
        (None, RestitutionSource::Analytic, Mechanism::Parapet) => analytic_one_sided(body.slenderness),
        (None, _, Mechanism::Parapet) => {
            let remedy = "restitution, or restitution_source = analytic";
            return conflict("restitution_source", &source.name(), remedy);
        }
        (None, _, Mechanism::VerticalSpanning) => {
            return conflict("restitution_source", &source.name(), "restitution");
        }
    };
    if (0.0..1.0).contains(&value) {
        Ok(value)
    } else {
        Err(ParameterError::Restitution { source: source.name(), value })
    }
}
