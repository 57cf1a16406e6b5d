//! The curve a(d) of one side of a wall, C8.7.1.2.1.1, with one resultant of the forces per body.
//!
//! The displacement u of the restoring force F(u) is `d_C` of the code. With δ per unit of u, 1 at the
//! mid-height and 2 at the top of a parapet, 1/2 for both bodies of a strip wall, the sums are
//!
//! | | parapet | strip wall |
//! |---|---|---|
//! | α(u) [C8.7.1.1] | F/(W + 2 r O) | F/W |
//! | e* [C8.7.1.5] | 1 | 1 |
//! | M* | (W + r O)/g | W/g |
//! | d/u [C8.7.1.4] | (W + 2 r O)/(W + r O) | 1/2 |
//!
//! r is the share of the overburden O whose mass moves with a parapet. A strip wall is held at its top, where
//! its overburden rests: O is in F alone.

use std::f64::consts::{PI, TAU};

use rocking_wall::variables::{ForceLaw, Mechanism};
use rocking_wall::wall::{Kinematics, Parameters, Tie, Wall};

use super::statement::Statement;
use super::table::Activation;
use super::verdict::TieBreak;
use crate::error::CheckError;

/// κ of [C8.7.1.7] for a cantilever and for vertical bending \[-\].
const CANTILEVER: f64 = 6.2;
const BENDING: f64 = 2.2;

/// The elastic branch before the wall rocks, C8.7.1.2.1.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Elastic {
    /// T0; 0 where the wall is rigid \[s\].
    pub(super) period: f64,
    /// `d_y`, where the branch ends; 0 where the wall is rigid \[m\].
    pub(super) displacement: f64,
    /// `a_y` without FC: the largest acceleration before the wall rocks \[m/s²\].
    pub(super) acceleration: f64,
}

/// The curve of one side.
pub(super) struct Curve<'a> {
    wall: &'a Wall,
    sign: f64,
    activation: Activation,
    confidence_factor: f64,
    /// Σ (P + Q) δ over the work of F per unit of u \[N\].
    pub(super) pushed_weight: f64,
    gravity: f64,
    /// `F_act`, the force at u = 0 of the line from `a_0` to `d_0` \[N\].
    pub(super) acting: f64,
    /// d/u \[-\].
    pub(super) stretch: f64,
    /// M* \[kg\].
    pub(super) mass: f64,
    /// α0 \[-\].
    pub(super) alpha0: f64,
    /// `u_0`, where the force of the wall alone vanishes \[m\].
    pub(super) zero: f64,
    pub(super) elastic: Elastic,
}

impl<'a> Curve<'a> {
    /// Makes the curve of the side of `sign`.
    ///
    /// # Errors
    /// [`CheckError`] of a wall that the code does not cover, or of a statement that is missing.
    pub(super) fn new(
        wall: &'a Wall,
        parameters: &Parameters,
        statement: &Statement,
        sign: f64,
    ) -> Result<Self, CheckError> {
        let activation = activation(wall, parameters, statement)?;
        let moved = moved_overburden(parameters, statement)?;
        let body = wall.body();
        let gravity = body.weight / body.mass;
        let (pushed_weight, stretch) = match body.mechanism {
            Mechanism::Parapet => {
                let pushed = body.weight + 2.0 * moved;
                (pushed, pushed / (body.weight + moved))
            }
            Mechanism::VerticalSpanning => (body.weight, 0.5),
        };
        let zero = wall.force_end().of(sign);
        if !(zero > 0.0 && zero.is_finite()) {
            return Err(CheckError::NoZero);
        }
        // F_act: the softening line at u = 0, at most F0; a law with a plateau has its largest force
        let acting = match activation {
            _ if has_plateau(parameters) => wall.largest_own_force(sign),
            _ => wall.softening_force(sign, 0.0).min(body.strength.of(sign)),
        };
        let mut curve = Self {
            wall,
            sign,
            activation,
            confidence_factor: statement.confidence_factor,
            pushed_weight,
            gravity,
            acting,
            stretch,
            mass: (body.weight + moved) / gravity,
            alpha0: acting / pushed_weight,
            zero,
            elastic: Elastic { period: 0.0, displacement: 0.0, acceleration: 0.0 },
        };
        curve.elastic = curve.elastic_branch(parameters, statement.young_modulus);
        Ok(curve)
    }

    /// `a_0` = α0 g/e*, without FC \[m/s²\].
    pub(super) fn a0(&self) -> f64 {
        self.alpha0 * self.gravity
    }

    /// `d_0` \[m\].
    pub(super) fn d0(&self) -> f64 {
        self.stretch * self.zero
    }

    /// The tie that holds this side.
    pub(super) fn tie(&self) -> Option<&'a Tie> {
        self.wall.tie().filter(|tie| tie.holds(self.sign))
    }

    /// a at u of the wall without its tie, with FC [C8.7.1.3] \[m/s²\].
    pub(super) fn own(&self, u: f64) -> f64 {
        self.over_weight(self.own_force(u))
    }

    /// a at u with the tie up to where it breaks, with FC \[m/s²\].
    pub(super) fn tied(&self, u: f64) -> f64 {
        let holds = |tie: &&Tie| tie.strength_displacement().is_none_or(|breaks| u <= breaks);
        let tie = self.tie().filter(holds).map_or(0.0, |tie| tie.lever * tie.force(u.copysign(self.sign)));
        self.over_weight(self.own_force(u) + tie)
    }

    /// Corners (d, a) of the curve up to `d_0`, with FC, to draw \[m, m/s²\].
    pub(super) fn corners(&self) -> Vec<(f64, f64)> {
        let first = self.elastic.displacement / self.stretch;
        let mut at: Vec<f64> = match self.activation {
            Activation::Rigid | Activation::Beam => vec![0.0, first],
            Activation::Law => {
                self.wall.capacity_corners(self.sign).iter().map(|corner| corner.displacement).collect()
            }
        };
        at.extend(self.tie().map(Tie::onset));
        let breaks = self.tie().and_then(Tie::strength_displacement);
        at.extend(breaks.into_iter().flat_map(|u| [u, u * (1.0 + 1e-12)]));
        at.push(self.zero);
        at.retain(|u| *u <= self.zero);
        at.sort_by(f64::total_cmp);
        at.dedup();
        at.into_iter().map(|u| (self.stretch * u, self.tied(u))).collect()
    }

    /// Returns what the curve loses where its tie breaks, over its largest a from the end of the elastic
    /// branch to there; `None` without a tie that breaks.
    pub(super) fn tie_break(&self) -> Option<TieBreak> {
        let tie = self.tie()?;
        let breaks = tie.strength_displacement()?;
        // a tie that breaks on the elastic branch leaves that displacement alone
        let from = (self.elastic.displacement / self.stretch).min(breaks);
        let corners = self.wall.capacity_corners(self.sign).into_iter().map(|corner| corner.displacement);
        let reached = corners.chain([from, tie.onset(), breaks]).filter(|u| (from..=breaks).contains(u));
        let largest = reached.map(|u| self.tied(u)).fold(0.0, f64::max);
        let [before, after] = [self.tied(breaks), self.own(breaks)];
        Some(TieBreak { u: breaks, before, after, largest, loss: (before - after) / largest })
    }

    fn own_force(&self, u: f64) -> f64 {
        let elastic = self.elastic.displacement / self.stretch;
        match self.activation {
            Activation::Law => self.wall.own_force(self.sign, u),
            Activation::Beam if u < elastic => self.softening(elastic) * (u / elastic),
            Activation::Rigid | Activation::Beam => self.softening(u),
        }
    }

    /// The line from `a_0` at u = 0 to 0 at `u_0` \[N\].
    fn softening(&self, u: f64) -> f64 {
        self.wall.softening_force(self.sign, u).min(self.wall.body().strength.of(self.sign))
    }

    fn over_weight(&self, force: f64) -> f64 {
        self.gravity * force / (self.pushed_weight * self.confidence_factor)
    }

    fn elastic_branch(&self, parameters: &Parameters, young_modulus: Option<f64>) -> Elastic {
        match (self.activation, young_modulus) {
            (Activation::Law, _) => {
                let u1 = self.wall.elastic_end(self.sign);
                let acceleration = |force: f64| self.gravity * force / self.pushed_weight;
                let (d1, a1) = (self.stretch * u1, acceleration(self.wall.own_force(self.sign, u1)));
                let largest = acceleration(self.wall.largest_own_force(self.sign));
                // [C8.7.1.6]: a = 4π²/T0² d
                Elastic { period: TAU * (d1 / a1).sqrt(), displacement: d1, acceleration: largest }
            }
            (Activation::Beam, Some(young_modulus)) => {
                let body = self.wall.body();
                let factor = match body.mechanism {
                    Mechanism::Parapet => CANTILEVER,
                    Mechanism::VerticalSpanning => BENDING,
                };
                let Parameters { height, thickness, density, .. } = *parameters;
                // [C8.7.1.7]: T0 = κ λ L √(W_s/(E g)), W_s/g the density
                let period = factor * (height / thickness) * height * (density / young_modulus).sqrt();
                let stiffness = (TAU / period).powi(2);
                let displacement = self.a0() / (stiffness + self.a0() / self.d0());
                Elastic { period, displacement, acceleration: stiffness * displacement }
            }
            (Activation::Rigid, _) | (Activation::Beam, None) => {
                Elastic { period: 0.0, displacement: 0.0, acceleration: self.a0() }
            }
        }
    }

    /// Period of a limit state, `factor` π √(d/a), [C8.7.1.10] and [C8.7.1.11] \[s\].
    pub(super) fn period(factor: f64, displacement: f64, acceleration: f64) -> f64 {
        factor * PI * (displacement / acceleration).sqrt()
    }
}

/// Returns whether the law has a plateau or points of its own, not only a line from `a_0`.
fn has_plateau(parameters: &Parameters) -> bool {
    parameters.multilinear.is_some() || parameters.force_law == ForceLaw::Trilinear
}

fn activation(wall: &Wall, parameters: &Parameters, statement: &Statement) -> Result<Activation, CheckError> {
    if parameters.kinematics == Kinematics::Trigonometric {
        let message = "the curve of the code has small rotations; set kinematics = \"linear\"";
        return Err(CheckError::wall(message));
    }
    let refused = |message: &str| Err(CheckError::value(&["before_activation"], message));
    match statement.before_activation {
        // transverse walls hold it
        None if wall.free_side().is_some() && !has_plateau(parameters) => Ok(Activation::Rigid),
        None => refused(
            "before_activation is missing: state \"rigid\" (held by transverse walls), \"law\" or \"beam\"",
        ),
        Some(Activation::Law) if wall.is_rigid() => {
            refused("law: force_law = rigid_linear has no elastic branch; state \"rigid\" or \"beam\"")
        }
        Some(Activation::Rigid | Activation::Beam) if has_plateau(parameters) => {
            refused("a trilinear or multilinear law has its own elastic branch; state \"law\"")
        }
        Some(activation) => Ok(activation),
    }
}

/// r O \[N\].
fn moved_overburden(parameters: &Parameters, statement: &Statement) -> Result<f64, CheckError> {
    let refused = |message: &str| Err(CheckError::value(&["overburden_mass"], message));
    match (parameters.mechanism, statement.overburden_mass) {
        (Mechanism::VerticalSpanning, Some(r)) if r > 0.0 => refused(
            "overburden_mass: the top of a strip wall is held, its overburden does not move; leave it out",
        ),
        (Mechanism::VerticalSpanning, _) => Ok(0.0),
        (Mechanism::Parapet, None) if parameters.overburden > 0.0 => refused(
            "overburden_mass is missing: state whether the overburden's mass moves along, 0 (its inertia \
             goes elsewhere) to 1 (it moves with the wall), more for a mass that only \
             pushes the wall",
        ),
        (Mechanism::Parapet, r) => Ok(r.unwrap_or(0.0) * parameters.overburden),
    }
}
