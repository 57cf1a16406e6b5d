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

mod breaks;
pub(crate) mod case;
pub(crate) mod hinge;
pub(super) mod ledger;
pub(crate) mod level;
mod pushed;
pub(crate) mod set_back;
mod sizes;
pub(crate) mod tie;

use std::f64::consts::{PI, TAU};

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Body, Parameters, Sides, Statics, Tie};

use super::statement::table::Activation;
use crate::error::CheckError;
pub use breaks::TieBreak;
use case::{Case, has_plateau};
use pushed::Pushed;
use set_back::SetBack;

/// κ of [C8.7.1.7], for a cantilever and for vertical bending \[-\].
fn factor_of_beam(mechanism: Mechanism) -> f64 {
    match mechanism {
        Mechanism::Parapet | Mechanism::RigidBody => 6.2,
        Mechanism::VerticalSpanning => 2.2,
    }
}

/// The curve of one side, with the hinge of a strip in one place.
#[derive(Clone, Debug)]
pub struct Curve {
    statics: Statics,
    sign: f64,
    activation: Activation,
    confidence_factor: f64,
    gravity: f64,
    /// `u_0`, where the force of the wall alone vanishes \[m\].
    pub zero: f64,
    /// How many anchors hold the width, of a tie that is given by its bar \[-\].
    pub anchors: Option<f64>,
    /// Where the hinge of a strip is, of h \[-\].
    pub hinge: Option<f64>,
    /// Angle of the crack of a wedge from the vertical, where it is searched \[°\].
    pub crack: Option<f64>,
    /// Set-backs of the hinges; 0 without a compressive strength.
    pub set_back: SetBack,
    /// F0'/F0 of hinges that are set back \[-\].
    pub a3: f64,
    /// The weights that are pushed.
    pushed: Pushed,
    /// Σ (P + Q) δ over the work of F per unit of u, the divisor of α0 \[N\].
    pub pushed_weight: f64,
    /// `F_act`, the force at u = 0 of the line from `a_0` to `d_0` \[N\].
    pub acting_force: f64,
    /// α0 [C8.7.1.1] \[-\].
    pub alpha0: f64,
    /// e* [C8.7.1.5] \[-\].
    pub e_star: f64,
    /// M* = e* Σ(P + Q)/g \[kg\].
    pub mass: f64,
    /// `a_0` = α0 g/e*, without FC \[m/s²\].
    pub a0: f64,
    /// `d_0` \[m\].
    pub d0: f64,
    /// d/u \[-\].
    pub d_per_u: f64,
    /// T0 of the elastic branch, C8.7.1.2.1.3; 0 where the wall is rigid \[s\].
    pub t0: f64,
    /// `d_y`, the end of the elastic branch \[m\].
    pub dy: f64,
    /// `a_y`, without FC: the largest acceleration before the wall rocks \[m/s²\].
    pub ay: f64,
}

impl Curve {
    /// Makes the curve of the side of `sign` with the hinge of a strip at `hinge` h.
    ///
    /// # Errors
    /// [`CheckError`] of a wall without strength, or of one whose force does not vanish.
    pub(super) fn new(case: &Case<'_>, sign: f64, hinge: Option<f64>) -> Result<Self, CheckError> {
        let mut parameters = level::on_side(&case.parameters, sign);
        if let Some(hinge) = hinge {
            parameters.hinge_ratio = hinge;
        }
        let mut statics = Statics::new(&parameters)?;
        let (mut set_back, mut a3) = (SetBack::default(), 1.0);
        if let Some(strength) = case.statement.masonry {
            let (found, force) = SetBack::new(statics.body(), &parameters, strength, sign)?;
            (set_back, a3) = (found, force / statics.body().strength.of(sign));
            parameters.a3_of_sides = Some(Sides { positive: a3, negative: a3 });
            statics = Statics::new(&parameters)?;
        }
        let body = statics.body();
        let gravity = body.weight / body.mass;
        let pushed = Pushed::new(body, &parameters, case.moved, case.statement.table.resultants)?;
        let Pushed { work: pushed_weight, e_star, d_per_u, .. } = pushed;
        let zero = statics.force_end().of(sign);
        if !(zero > 0.0 && zero.is_finite()) {
            let message = "the restoring force never falls to zero, so d_0 does not exist";
            return Err(CheckError::wall(message));
        }
        // the softening line at u = 0, at most F0; a law with a plateau has its largest force
        let acting_force = if has_plateau(&parameters) {
            statics.largest_own_force(sign)
        } else {
            statics.softening_force(sign, 0.0).min(body.strength.of(sign))
        };
        let mass = e_star * (pushed.weight / gravity);
        let alpha0 = acting_force / pushed_weight;
        let mut curve = Self {
            statics,
            sign,
            activation: case.activation,
            confidence_factor: case.statement.confidence_factor,
            gravity,
            zero,
            anchors: tie::anchors(&parameters, sign),
            hinge,
            crack: case.crack,
            set_back,
            a3,
            pushed,
            pushed_weight,
            acting_force,
            alpha0,
            e_star,
            mass,
            a0: alpha0 * gravity / e_star,
            d0: d_per_u * zero,
            d_per_u,
            t0: 0.0,
            dy: 0.0,
            ay: alpha0 * gravity / e_star,
        };
        curve.set_elastic_branch(&parameters, case.young_modulus);
        Ok(curve)
    }

    /// Whether the wall is held before it rocks.
    pub(super) fn is_rigid(&self) -> bool {
        self.activation == Activation::Rigid
    }

    /// The symbol of its largest acceleration before the wall rocks.
    pub(super) fn own_symbol(&self) -> &'static str {
        if self.t0 > 0.0 { "a_y" } else { "a_0" }
    }

    /// The body, with the hinge where it is.
    pub(super) fn body(&self) -> &Body {
        self.statics.body()
    }

    /// The ties that hold this side.
    pub fn ties(&self) -> impl Iterator<Item = &Tie> + Clone {
        self.statics.ties().of_side(self.sign)
    }

    /// The first tie that holds this side.
    pub fn tie(&self) -> Option<&Tie> {
        self.ties().next()
    }

    /// Whether more than one tie holds this side.
    pub(super) fn has_several_ties(&self) -> bool {
        self.ties().count() > 1
    }

    /// The acceleration of a force at the place of F, without FC: g F/(s1 e*) \[m/s²\].
    pub(super) fn of_force(&self, force: f64) -> f64 {
        self.gravity * force / (self.pushed_weight * self.e_star)
    }

    /// T0 of the wall beside ties that are tight from the start \[s\].
    pub(super) fn tied_period(&self) -> f64 {
        self.period_beside(self.ties())
    }

    /// T0 of the wall beside those of some ties that are tight from the start \[s\].
    pub(super) fn period_beside<'a>(&self, ties: impl Iterator<Item = &'a Tie> + Clone) -> f64 {
        let tight = ties.filter(|tie| tie.slack == 0.0);
        if self.is_rigid() || tight.clone().next().is_none() {
            return self.t0;
        }
        let slope = tight.map(Tie::slope).fold(0.0, |sum, slope| sum + slope);
        let stiffness = self.of_force(slope) / self.d_per_u;
        TAU / ((TAU / self.t0).powi(2) + stiffness).sqrt()
    }

    /// a at u with the tie up to and including where it breaks, with FC \[m/s²\].
    pub(super) fn tied(&self, u: f64) -> f64 {
        let pulls = self.ties().map(|tie| tie.pull * tie::force(tie, u));
        let pull = pulls.fold(0.0, |sum, pull| sum + pull);
        self.of_force(self.own_force(u) + pull) / self.confidence_factor
    }

    /// |u| up to `u_0` at which the curve may have a corner, in order \[m\].
    fn places(&self) -> Vec<f64> {
        let mut at = vec![0.0, self.dy / self.d_per_u, self.zero];
        if self.activation == Activation::Law {
            at.extend(self.statics.own_corners(self.sign));
        }
        for tie in self.ties() {
            at.push(tie.onset());
            at.extend(tie.strength_displacement());
            at.extend(tie.fracture_displacement());
        }
        at.retain(|u| *u <= self.zero);
        at.sort_by(f64::total_cmp);
        at.dedup();
        at
    }

    /// Corners (d, a) of the curve up to `d_0`, with FC, to draw \[m, m/s²\].
    pub(super) fn corners(&self) -> Vec<(f64, f64)> {
        let mut corners = Vec::new();
        for u in self.places() {
            corners.push((self.d_per_u * u, self.tied(u)));
            if self.ties().any(|tie| tie.fracture_displacement() == Some(u)) {
                corners.push((self.d_per_u * u, self.beyond(u)));
            }
        }
        corners
    }

    /// The largest a of the wall without its tie from u on, with FC \[m/s²\].
    fn largest_own_from(&self, u: f64) -> f64 {
        let force = match self.activation {
            Activation::Law => self.statics.largest_own_force_from(self.sign, u),
            Activation::Rigid | Activation::Beam => self.softening(u.max(self.dy / self.d_per_u)),
        };
        self.of_force(force) / self.confidence_factor
    }

    fn own_force(&self, u: f64) -> f64 {
        let elastic = self.dy / self.d_per_u;
        match self.activation {
            Activation::Law => self.statics.own_force(self.sign, u),
            Activation::Beam if u < elastic => self.softening(elastic) * (u / elastic),
            Activation::Rigid | Activation::Beam => self.softening(u),
        }
    }

    /// The line from `a_0` at u = 0 to 0 at `u_0` \[N\].
    fn softening(&self, u: f64) -> f64 {
        self.statics.softening_force(self.sign, u).min(self.statics.body().strength.of(self.sign))
    }

    /// Sets T0, `d_y` and `a_y` of a wall that is not rigid.
    fn set_elastic_branch(&mut self, parameters: &Parameters, young_modulus: Option<f64>) {
        match (self.activation, young_modulus) {
            (Activation::Law, _) => {
                let u1 = self.statics.elastic_end(self.sign);
                let a1 = self.of_force(self.statics.own_force(self.sign, u1));
                self.dy = self.d_per_u * u1;
                self.ay = self.of_force(self.statics.largest_own_force(self.sign));
                // [C8.7.1.6]: a = 4π²/T0² d
                self.t0 = TAU * (self.dy / a1).sqrt();
            }
            (Activation::Beam, Some(young_modulus)) => {
                let factor = factor_of_beam(self.body().mechanism);
                let Parameters { height, thickness, density, .. } = *parameters;
                // [C8.7.1.7]: T0 = κ λ L √(W_s/(E g)), W_s/g the density
                self.t0 = factor * (height / thickness) * height * (density / young_modulus).sqrt();
                let stiffness = (TAU / self.t0).powi(2);
                self.dy = self.a0 / (stiffness + self.a0 / self.d0);
                self.ay = stiffness * self.dy;
            }
            (Activation::Rigid, _) | (Activation::Beam, None) => {}
        }
    }

    /// Period of a limit state, `factor` π √(d/a), [C8.7.1.10] and [C8.7.1.11] \[s\].
    pub(super) fn period(factor: f64, displacement: f64, acceleration: f64) -> f64 {
        factor * PI * (displacement / acceleration).sqrt()
    }
}
