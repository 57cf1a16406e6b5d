//! A wall as the static checks take it.

use std::borrow::Cow;

use rocking_wall::variables::{ForceLaw, Mechanism, Rocking, Softening, TieSide};
use rocking_wall::wall::{Body, Kinematics, Parameters, Statics};
use scene::Floors;

use super::{level, sizes};
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::{Source, StateStatement};
use crate::circolare::statement::table::{Activation, Hinge, Rocks};
use crate::code::Subject;
use crate::error::CheckError;
use crate::ntc::demand::{Demand, Demands};
use crate::ntc::floor::modes_of_storeys;
use crate::words::names::{Side, Sides};
use crate::words::{Sentence, side};

/// A wall as the static checks take it.
#[derive(Clone)]
pub(crate) struct Case<'a> {
    pub(crate) statement: &'a Statement,
    /// Its parameters, with the sides, the bar and the rupture of the tie that the check states.
    pub(crate) parameters: Parameters,
    /// The place of the level in `hinge_levels` above which the wall turns.
    pub(crate) level: usize,
    pub(crate) floors: Option<Cow<'a, Floors>>,
    pub(crate) activation: Activation,
    /// r O \[N\].
    pub(crate) moved: f64,
    /// E of the beam \[Pa\].
    pub(crate) young_modulus: Option<f64>,
    /// Where the hinge of a strip is; a parapet has none.
    pub(crate) rule: Option<Hinge>,
    /// Angle of the cracks of wedges, where it is searched \[°\].
    pub(crate) crack: Option<f64>,
    /// Whether both sides are alike.
    pub(crate) alike: bool,
    /// The demands, where they do not depend on the hinge.
    pub(crate) shared: Option<Demands>,
}

impl<'a> Case<'a> {
    /// # Errors
    /// [`CheckError`] of statements that are missing or do not fit the wall.
    pub(crate) fn new(
        statement: &'a Statement,
        subject: Subject<'a>,
        level: usize,
    ) -> Result<Self, CheckError> {
        let parameters = statement.with_bar(subject.parameters)?;
        sizes::check(&parameters)?;
        let mut parameters = level::above(&parameters, statement.hinge_levels[level])?;
        parameters.rocking = statement.table.rocking.map_or(parameters.rocking, Rocks::rocking);
        level::make_brittle(&mut parameters);
        level::check_body(&parameters)?;
        let activation = activation(&parameters, statement)?;
        stated(&parameters, activation, subject.assumed)?;
        set_back_once(&parameters, statement)?;
        let moved = moved_overburden(&parameters, statement)?;
        let is_strip = parameters.mechanism == Mechanism::VerticalSpanning;
        let rule = is_strip.then(|| statement.hinge_of(subject.assumed)).transpose()?;
        let floors = match subject.floors {
            Some(floors) if level > 0 => Some(Cow::Owned(floors.raised(level)?)),
            floors => floors.map(Cow::Borrowed),
        };
        let young_modulus = statement.table.young_modulus;
        // the bodies of a rectangle are alike on both sides with any hinge
        let is_given = rule == Some(Hinge::Given) && !parameters.is_rectangle();
        let hinge_ratio = if is_given { parameters.hinge_ratio } else { 0.5 };
        let statics = Statics::new(&Parameters { hinge_ratio, ..parameters.clone() })?;
        let body = statics.body();
        let one_tied = parameters.ties().any(|tie| tie.stiffness > 0.0 && tie.side != TieSide::Both);
        let alike = statics.has_equal_sides()
            && parameters.rocking == Rocking::TwoSided
            && !one_tied
            && [1.0, -1.0].iter().all(|sign| level::left_out(&parameters, *sign) == 0.0);
        let shared = None;
        let mut case = Self {
            statement,
            parameters,
            level,
            floors,
            activation,
            moved,
            young_modulus,
            rule,
            crack: None,
            alike,
            shared,
        };
        let by_hinge = |given: &StateStatement| match &given.source {
            Source::Code(_) => given.modes_at(level).is_none(),
            Source::Points(..) => false,
            Source::Records => true,
        };
        if !(is_strip && case.floors.is_some() && statement.states.iter().flatten().any(by_hinge)) {
            case.shared = Some(case.demands_at(body)?);
        }
        Ok(case)
    }

    /// The same wall with another a₁, or another E of the beam.
    pub(crate) fn with(&self, factor: f64) -> Self {
        let mut varied = self.clone();
        varied.parameters.a1 *= factor;
        varied.young_modulus = self.young_modulus.map(|modulus| factor * modulus);
        varied
    }

    /// The same wall without its ties.
    pub(crate) fn untied(&self) -> Self {
        let mut untied = self.clone();
        untied.parameters.set_ties(&[]);
        untied
    }

    /// What is said of a side.
    pub(crate) fn told(&self, of: Side) -> Sentence {
        side(Sides::of(of, self.alike))
    }

    /// The signs of u to which the wall rocks.
    pub(crate) fn sides(&self) -> impl Iterator<Item = f64> + use<> {
        let rocking = self.parameters.rocking;
        [(1.0, Rocking::OneSidedNegative), (-1.0, Rocking::OneSidedPositive)]
            .into_iter()
            .filter_map(move |(sign, without)| (rocking != without).then_some(sign))
    }

    /// The demands at the place of the wall with this body.
    pub(crate) fn demands_at(&self, body: &Body) -> Result<Demands, CheckError> {
        let floors = self.floors.as_deref();
        let mut demands = [const { None }; 3];
        for given in self.statement.states.iter().flatten() {
            let demand = match &given.source {
                Source::Code(ground) => {
                    let modes = match given.modes_at(self.level) {
                        None => modes_of_storeys(floors, given.building_period, body)?,
                        Some(modes) => modes.to_vec(),
                    };
                    let bounded = self.statement.bounds_heights();
                    given.floor(*ground, modes, bounded)?.map_or(Demand::Ground(*ground), Demand::Floor)
                }
                Source::Points(points, damping) => Demand::Points(points.clone(), *damping),
                Source::Records => Demand::Records(self.statement.records.felt(floors, body)?),
            };
            demands[given.state as usize] = Some(demand);
        }
        Ok(demands)
    }
}

/// Refuses what decides a verdict and was left to a default.
fn stated(parameters: &Parameters, activation: Activation, assumed: &[&str]) -> Result<(), CheckError> {
    let is_of_law = activation == Activation::Law && parameters.multilinear.is_none();
    let needed = ["height", "thickness", "density", "a1"];
    let missing = needed.into_iter().filter(|name| assumed.contains(name) && (*name != "a1" || is_of_law));
    let missing: Vec<_> = missing.collect();
    if missing.is_empty() {
        return Ok(());
    }
    if parameters.mechanism == Mechanism::RigidBody && parameters.multilinear.is_some() {
        return Err(CheckError::wall(format!(
            "{} not stated: a check needs a wall with a geometry, and an oscillator has none; state \
             [geometry] in place of `oscillator`",
            missing.join(", ")
        )));
    }
    Err(CheckError::wall(format!(
        "{} not stated: no default decides a verdict; state the geometry in [geometry], and a1, which makes \
         T0 and SLD of before_activation = \"law\", in [force_law]",
        missing.join(", ")
    )))
}

/// Refuses hinges that are set back by the check and by the law of the wall.
fn set_back_once(parameters: &Parameters, statement: &Statement) -> Result<(), CheckError> {
    let has_own =
        has_plateau(parameters) || parameters.a3 < 1.0 || parameters.softening != Softening::Parallel;
    if statement.masonry.is_none() || !has_own {
        return Ok(());
    }
    let message = "masonry_strength sets the hinges of a straight law back, parallel: leave out a3 and \
                   softening of [force_law]; a trilinear or multilinear law has its own";
    Err(CheckError::value(&["masonry_strength"], message))
}

fn activation(parameters: &Parameters, statement: &Statement) -> Result<Activation, CheckError> {
    if parameters.kinematics == Kinematics::Trigonometric {
        let message = "the curve of the code has small rotations; set kinematics = \"linear\"";
        return Err(CheckError::wall(message));
    }
    let is_rigid = parameters.multilinear.is_none() && parameters.force_law == ForceLaw::RigidLinear;
    match statement.table.before_activation {
        // transverse walls hold it
        None if parameters.rocking != Rocking::TwoSided && !has_plateau(parameters) => Ok(Activation::Rigid),
        Some(Activation::Law) if !is_rigid => Ok(Activation::Law),
        Some(Activation::Beam) if !level::is_uniform(parameters) => {
            let message = "before_activation = \"beam\" has T0 of a uniform beam [C8.7.1.7]: of one part \
                           without openings, and of loads whose mass does not move; state \"rigid\" or \
                           \"law\"";
            Err(CheckError::value(&["before_activation"], message))
        }
        Some(given @ (Activation::Rigid | Activation::Beam)) if !has_plateau(parameters) => Ok(given),
        _ => {
            let message = "before_activation is missing, or does not go with the law of the wall: state \
                           \"rigid\" (held by transverse walls) or \"beam\"; \"law\" of a law with an \
                           elastic branch, not rigid_linear, and of a trilinear or multilinear one";
            Err(CheckError::value(&["before_activation"], message))
        }
    }
}

/// r O \[N\].
fn moved_overburden(parameters: &Parameters, statement: &Statement) -> Result<f64, CheckError> {
    let refused = |message: &str| Err(CheckError::value(&["overburden_mass"], message));
    match (parameters.mechanism, statement.table.overburden_mass) {
        (Mechanism::VerticalSpanning, Some(r)) if r > 0.0 => refused(
            "overburden_mass: the top of a strip wall is held, its overburden does not move; leave it out",
        ),
        (Mechanism::VerticalSpanning, _) => Ok(0.0),
        (Mechanism::Parapet | Mechanism::RigidBody, None) if parameters.overburden > 0.0 => refused(
            "overburden_mass is missing: state whether the overburden's mass moves along, 0 (its inertia \
             goes elsewhere) to 1 (it moves with the wall), more for a mass that only \
             pushes the wall",
        ),
        (Mechanism::Parapet | Mechanism::RigidBody, r) => Ok(r.unwrap_or(0.0) * parameters.overburden),
    }
}

/// Returns whether the law has a plateau or points of its own, not only a line from `a_0`.
pub(crate) fn has_plateau(parameters: &Parameters) -> bool {
    parameters.multilinear.is_some() || parameters.force_law == ForceLaw::Trilinear
}
