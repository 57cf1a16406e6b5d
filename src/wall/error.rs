//! What can be wrong, or doubtful, about a choice of parameters.

use super::{Body, DampingModel, DampingSource, Mechanism, Parameters, RestoringForce, equivalence};

/// A relation between parameters that does not hold. Each message names the values, the limit and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum ParameterError {
    /// The overburden leaves no positive F₀ on a side.
    #[error(
        "no rocking strength for {side}: F0 = {force} N must be positive, but overburden = {overburden} N acts at \
         overburden_eccentricity = {eccentricity} m; bring the eccentricity closer to the axis or reduce the overburden"
    )]
    NoStrength { side: &'static str, force: f64, eccentricity: f64, overburden: f64 },
    /// a₁ ≥ a₃.
    #[error(
        "a1 = {a1} must be smaller than a3 = {a3}: the elastic branch ends before the force does; reduce a1 or raise a3"
    )]
    ElasticBranchTooLong { a1: f64, a3: f64 },
    /// u₁ ≥ u₂.
    #[error(
        "d1 = {d1} must be smaller than {formula} = {limit:.6} (softening = {softening}): no plateau is left; reduce d1 or a1"
    )]
    PlateauTooHigh { d1: f64, limit: f64, formula: &'static str, softening: &'static str },
    /// A point of a multilinear law.
    #[error("point {number} of the multilinear law, [u/u_ins, F/F0] = [{displacement}, {force}]: {reason}")]
    Points { number: usize, displacement: f64, force: f64, reason: &'static str },
    /// A squat wall.
    #[error(
        "restitution_source = {source} gives e = {value}, outside 0 to 1: the wall is too squat for this formula; \
         set restitution_source = given and restitution"
    )]
    Restitution {
        #[allow(missing_docs)]
        r#source: &'static str,
        value: f64,
    },
    /// Damping on the elastic branch, and no elastic branch.
    #[error(
        "damping_model = {model} needs an elastic branch, and force_law = rigid_linear has none; use \
         damping_model = free_standing_block, impact = restitution, or force_law = bilinear"
    )]
    NoElasticBranch { model: &'static str },
    /// ln e at e = 0.
    #[error(
        "damping_source = predicted needs a coefficient of restitution above 0, but it is {restitution}; give xi or c_bar instead"
    )]
    Prediction { restitution: f64 },
    /// The start lies where the wall has landed.
    #[error(
        "u_start = {u_start} m is beyond the end of the fall at {limit} m; start the wall nearer to upright"
    )]
    StartBeyondLanding { u_start: f64, limit: f64 },
    /// Full rotations know rigid bodies with impacts only.
    #[error(
        "kinematics = trigonometric does not go with {name} = {value}; set {name} = {remedy}, or kinematics = linear"
    )]
    Trigonometric { name: &'static str, value: String, remedy: &'static str },
    /// No unstable equilibrium in full rotations.
    #[error(
        "kinematics = trigonometric: for {side} the wall lies flat at u = {end} m before it becomes unstable; make it more \
         slender, bring the overburden's eccentricity closer to the axis, or set kinematics = linear"
    )]
    NoFall { side: &'static str, end: f64 },
    /// The closed form does not hold.
    #[error(
        "solver = exact needs damping that is constant on each branch, and damping_model = {model} is not; use \
         solver = automatic or adaptive"
    )]
    NotExact { model: &'static str },
}

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
                "predicted damping already stands for the impacts: with impact = restitution the loss counts twice; \
                 set damping_model = none or impact = none",
            ),
            Self::OutsideFit { a1 } => write!(
                f,
                "a1 = {a1} is outside the range {} to {} in which predicted damping (Eqs. 20 to 22) was fitted",
                equivalence::FITTED_A1.start(),
                equivalence::FITTED_A1.end()
            ),
            Self::NeverRests => {
                f.write_str("restitution = 1 without damping: the wall loses no energy and never comes to rest")
            }
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
