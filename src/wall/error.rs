//! What can be wrong about a choice of parameters.

use super::part::ProfileError;
use super::warning::Warning;

/// A parameter with the value that is chosen.
pub(crate) struct Choice {
    name: &'static str,
    value: String,
}

impl Choice {
    pub(crate) fn new(name: &'static str, value: impl Into<String>) -> Self {
        Self { name, value: value.into() }
    }
}

/// A relation between parameters that does not hold. Each message names the values, the limit and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum ParameterError {
    /// The overburden leaves no positive F₀ on a side.
    #[error(
        "no rocking strength for {side}: F0 = {force} N must be positive, but overburden = {overburden} N \
         acts at overburden_eccentricity = {eccentricity} m; bring the eccentricity closer to the axis or \
         reduce the overburden"
    )]
    NoStrength { side: &'static str, force: f64, eccentricity: f64, overburden: f64 },
    /// Loads and thrusts leave no positive F₀ on a side of a body that is no rectangle.
    #[error(
        "no rocking strength for {side}: F0 = {force} N must be positive, but {}",
        if *thrust_moment > 0.0 {
            format!(
                "thrusts with a moment of {thrust_moment} N m overturn it; reduce thrust, or add weight that \
                 holds it"
            )
        } else {
            "the weights overturn the wall by themselves; move its centroid, its loads and the overburden \
             between the toes"
                .to_owned()
        }
    )]
    Overturns { side: &'static str, force: f64, thrust_moment: f64 },
    /// Parts, openings or loads that make no wall.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A number of the rectangle that stands for parts, changed by itself.
    #[error("{name} = {value} does not go with the parts of the wall, which have {own}; change the parts")]
    OfParts { name: &'static str, value: f64, own: f64 },
    /// A strip whose hinge falls where two parts are not in contact.
    #[error(
        "the hinge at {height} m has no section to turn about: the wall reaches from {} m to {} m below it \
         and from {} m to {} m above; move parts or hinge_ratio so that they overlap",
        below[0], below[1], above[0], above[1]
    )]
    NoHinge { height: f64, below: [f64; 2], above: [f64; 2] },
    /// A rigid body whose inertia is too small.
    #[error(
        "{name} = {value} kg m2 must be at least {mass} times {height} squared = {} kg m2, that of a mass at \
         one height; it is the integral of z squared from the base",
        mass * height * height
    )]
    Inertia { name: &'static str, value: f64, mass: f64, height: f64 },
    /// a₁ ≥ a₃.
    #[error(
        "a1 = {a1} must be smaller than a3 = {a3}: the elastic branch ends before the force does; reduce \
         a1 or raise a3"
    )]
    ElasticBranchTooLong { a1: f64, a3: f64 },
    /// u₁ ≥ u₂.
    #[error(
        "d1 = {d1} must be smaller than {formula} = {limit:.6} (softening = {softening}): no plateau is \
         left; reduce d1 or a1"
    )]
    PlateauTooHigh { d1: f64, limit: f64, formula: &'static str, softening: &'static str },
    /// A point of a multilinear law.
    #[error("point {number} of the multilinear law, [u/u_ins, F/F0] = [{displacement}, {force}]: {reason}")]
    Points { number: usize, displacement: f64, force: f64, reason: &'static str },
    /// A squat wall.
    #[error(
        "restitution_source = {source} gives e = {value}, outside 0 to 1: {}; set restitution",
        if *value > 1.0 {
            "a load without moving mass holds a centroid beyond its toe"
        } else {
            "the wall is too squat for this formula"
        }
    )]
    Restitution {
        #[allow(missing_docs)]
        r#source: &'static str,
        value: f64,
    },
    /// e = 0 leaves no damping to compute.
    #[error(
        "{name} = -1 asks for damping computed from the coefficient of restitution, which has to be above 0 \
         but is {restitution}; set {name}"
    )]
    Computed { name: &'static str, restitution: f64 },
    /// A number that is neither given nor left out.
    #[error("{name} = {value} must be 0 or more, or -1 where it is not given")]
    NotGiven { name: &'static str, value: f64 },
    /// A tie that is not on the wall.
    #[error(
        "tie_height = {tie_height} m must be above 0 and at most height = {height} m; give the height of \
         the tie above the base"
    )]
    TieHeight { tie_height: f64, height: f64 },
    /// A tie holds a strip where its top support does.
    #[error(
        "tie_height = {tie_height} m is at the top support of a strip, where the wall does not move; give a \
         height below"
    )]
    TieAtTop { tie_height: f64 },
    /// A number that the bar of a tie lacks.
    #[error("the bar of the tie needs {name}: give it, or leave the other numbers of the bar out")]
    BarNeeds { name: &'static str },
    /// A number of the bar of a tie.
    #[error("{name} = {value}{}{unit} must be above 0", if unit.is_empty() { "" } else { " " })]
    Bar { name: &'static str, value: f64, unit: &'static str },
    /// Two choices that do not go together.
    #[error("{choice} = {chosen} does not go with {name} = {value}; set {remedy}")]
    Conflict { choice: &'static str, chosen: String, name: &'static str, value: String, remedy: String },
    /// A start behind the transverse walls.
    #[error(
        "u_start = {u_start} m is behind the transverse walls of rocking = {rocking}; start the wall on the \
         side to which it can rock, or at 0"
    )]
    StartsBehindWalls { u_start: f64, rocking: &'static str },
    /// A start at which the wall has overturned.
    #[error(
        "u_start = {u_start} m is beyond u_ins = {u_ins:.6} m: set u_start = 0 for a wall that is at rest \
         until a motion ([motion], --record) or the inputs of an FMU move it"
    )]
    StartsOverturned { u_start: f64, u_ins: f64 },
    /// No unstable equilibrium in full rotations.
    #[error(
        "kinematics = trigonometric: for {side} the wall lies flat at u = {end} m before it becomes \
         unstable; make it more slender, bring the overburden's eccentricity closer to the axis, or set \
         kinematics = linear"
    )]
    NoFall { side: &'static str, end: f64 },
    /// A centroid that is not between the toes, in full rotations.
    #[error(
        "kinematics = trigonometric: for {side} the arm of the masonry's centroid from the toe is {arm} m \
         and must be at least {least} m, since u does not describe the fall of a wall that leans beyond its \
         toe; move the parts so that the centroid is between the toes, or set kinematics = linear"
    )]
    BeyondToe { side: &'static str, arm: f64, least: f64 },
    /// A wall that is refused and has numbers that walls rarely have: they may be the cause.
    #[error("{}; as given, {error}", doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Improbable { doubts: Vec<Warning>, error: Box<ParameterError> },
}

impl ParameterError {
    /// Returns the parameters that the error is about, the first to change first.
    pub fn keys(&self) -> Vec<&'static str> {
        match self {
            Self::NoStrength { .. } => vec!["overburden_eccentricity", "overburden"],
            Self::Overturns { .. } => vec!["thrust", "load_force"],
            Self::Profile(_) => vec!["part"],
            Self::NoHinge { .. } => vec!["hinge_ratio", "part"],
            Self::ElasticBranchTooLong { .. } => vec!["a1", "a3"],
            Self::PlateauTooHigh { .. } => vec!["d1", "a1", "softening"],
            Self::Points { .. } => vec!["points"],
            Self::Restitution { .. } => vec!["restitution_source", "restitution"],
            Self::OfParts { name, .. }
            | Self::Inertia { name, .. }
            | Self::Computed { name, .. }
            | Self::NotGiven { name, .. }
            | Self::BarNeeds { name }
            | Self::Bar { name, .. } => vec![name],
            Self::TieHeight { .. } => vec!["tie_height", "height"],
            Self::TieAtTop { .. } => vec!["tie_height"],
            Self::Conflict { choice, name, .. } => vec![choice, name],
            Self::StartsBehindWalls { .. } => vec!["u_start", "rocking"],
            Self::StartsOverturned { .. } => vec!["u_start"],
            Self::NoFall { .. } | Self::BeyondToe { .. } => vec!["kinematics"],
            Self::Improbable { error, .. } => error.keys(),
        }
    }

    /// Refuses two choices that do not go together, each a parameter with its value; `remedy` says what to
    /// set.
    pub(crate) fn conflict([choice, other]: [Choice; 2], remedy: impl Into<String>) -> Self {
        let (Choice { name: choice, value: chosen }, Choice { name, value }) = (choice, other);
        Self::Conflict { choice, chosen, name, value, remedy: remedy.into() }
    }

    /// Adds the numbers that may be the cause.
    pub(crate) fn with_doubts(self, doubts: Vec<Warning>) -> Self {
        if doubts.is_empty() { self } else { Self::Improbable { doubts, error: Box::new(self) } }
    }
}
