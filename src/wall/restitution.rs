//! The coefficient of restitution, Eqs. (2)–(4).

use crate::choices::{Mechanism, RestitutionSource};

use super::error::ParameterError;
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

/// The coefficient of restitution the parameters ask for \[-\].
///
/// # Errors
/// [`ParameterError::Restitution`] where a squat wall makes the formula leave 0…1.
pub(super) fn coefficient(parameters: &Parameters, body: &Body) -> Result<f64, ParameterError> {
    let analytic = match body.mechanism {
        Mechanism::Parapet => analytic_parapet(body.slenderness),
        Mechanism::VerticalSpanning => analytic_vertical_spanning(body.slenderness),
    };
    let source = parameters.restitution_source;
    let value = match source {
        RestitutionSource::Given => parameters.restitution,
        RestitutionSource::Analytic => analytic,
        RestitutionSource::Calibrated => calibration(body.mechanism) * analytic,
        RestitutionSource::Momentum => match body.mechanism {
            // Eq. (2) is the conservation of angular momentum about the new toe.
            Mechanism::Parapet => analytic,
            Mechanism::VerticalSpanning => momentum_vertical_spanning(body),
        },
    };
    if (0.0..=1.0).contains(&value) {
        Ok(value)
    } else {
        Err(ParameterError::Restitution { source: source.name(), value })
    }
}
