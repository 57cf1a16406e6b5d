//! What a user should know about valid parameters.

use crate::choices::{DampingModel, DampingSource, Mechanism};

use super::equivalence;
use super::force_law::RestoringForce;
use super::mechanism::Body;
use super::parameters::Parameters;

/// Something a user should know about valid parameters.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum Warning {
    /// Eq. (23) outside an unloaded parapet.
    PredictedFreeStanding,
    /// Viscous damping predicted from e, and e applied at impacts as well.
    CountedTwice,
    /// a₁ outside the fit of Eqs. (20)–(22).
    OutsideFit { a1: f64 },
    /// e = 1 and no damping.
    NeverRests,
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::PredictedFreeStanding => f.write_str(
                "predicted c_bar (Eq. 23) holds for a parapet without overburden only; give c_bar instead",
            ),
            Self::CountedTwice => f.write_str(
                "predicted damping already stands for the impacts: with impact = restitution the loss counts \
                 twice; set damping_model = none or impact = none",
            ),
            Self::OutsideFit { a1 } => write!(
                f,
                "a1 = {a1} is outside the range {} to {} in which predicted damping (Eqs. 20 to 22) was \
                 fitted",
                equivalence::FITTED_A1.start(),
                equivalence::FITTED_A1.end()
            ),
            Self::NeverRests => f.write_str(
                "restitution = 1 without damping: the wall loses no energy and never comes to rest",
            ),
        }
    }
}

impl Warning {
    pub(super) fn collect(
        parameters: &Parameters,
        body: &Body,
        force: &RestoringForce,
        impact: bool,
    ) -> Vec<Self> {
        let mut warnings = Vec::new();
        let model = parameters.damping_model;
        let predicted = model != DampingModel::None && parameters.damping_source == DampingSource::Predicted;
        let free_standing = model == DampingModel::FreeStandingBlock;
        if predicted && free_standing && (body.mechanism != Mechanism::Parapet || body.overburden > 0.0) {
            warnings.push(Self::PredictedFreeStanding);
        }
        if predicted && impact {
            warnings.push(Self::CountedTwice);
        }
        if predicted && !free_standing && !equivalence::FITTED_A1.contains(&force.elastic_fraction) {
            warnings.push(Self::OutsideFit { a1: force.elastic_fraction });
        }
        let undamped = match model {
            DampingModel::None => true,
            DampingModel::FreeStandingBlock => parameters.c_bar == 0.0 && !predicted,
            _ => parameters.xi == 0.0 && !predicted,
        };
        if impact && undamped && parameters.restitution == 1.0 {
            warnings.push(Self::NeverRests);
        }
        warnings
    }
}
