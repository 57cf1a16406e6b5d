//! A wall at rest: what its static force is.

use super::error::ParameterError;
use super::force_law::RestoringForce;
use super::mechanism::Body;
use super::parameters::Parameters;
use super::sides::Sides;
use super::ties::Ties;

/// Share of F₀ below which a force counts as 0: at the end of a softening line only rounding is left of it.
pub(super) const ROUNDING: f64 = 1e-12;

/// A wall at rest: its body, its restoring force and its ties. Damping and impacts have no part in it.
///
/// ```
/// use rocking_wall::wall::{Parameters, Statics};
///
/// let wall = Statics::new(&Parameters { height: 4.0, thickness: 0.4, ..Parameters::default() })?;
/// assert!((wall.force_end().positive - 0.2).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Statics {
    pub(super) body: Body,
    pub(super) force: RestoringForce,
    pub(super) ties: Ties,
}

impl Statics {
    /// Makes the body, the force and the ties that the parameters ask for.
    ///
    /// # Errors
    /// [`ParameterError`], with the values, the limit and the remedy.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let body = Body::new(parameters)?;
        let force = RestoringForce::new(parameters, &body)?;
        let ties = Ties::new(parameters, &body)?;
        Ok(Self { body, force, ties })
    }

    /// Masses, geometry and the rigid force.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The ties.
    pub fn ties(&self) -> &Ties {
        &self.ties
    }

    /// Displacements at which the force falls to zero, u₃ of each side \[m\].
    pub fn force_end(&self) -> Sides {
        Sides { positive: self.force.positive.end, negative: self.force.negative.end }
    }

    /// |u| of the corners of the wall's own force between 0 and u₃, on the side of `sign` \[m\].
    pub fn own_corners(&self, sign: f64) -> &[f64] {
        &self.force.side(sign).corners
    }

    /// |F| of the wall without its ties at |u| on the side of `sign` \[N\].
    pub fn own_force(&self, sign: f64, u: f64) -> f64 {
        let side = self.force.side(sign);
        let line = side.lines[side.corners.partition_point(|&corner| corner < u)];
        let direction = 1.0_f64.copysign(sign);
        let force = direction * line.at(direction * u);
        if force.abs() <= ROUNDING * self.body.strength.of(sign) { 0.0 } else { force }
    }

    /// |F| at |u| of the line along which the force falls to 0 on the side of `sign`, the last of the law
    /// \[N\].
    pub fn softening_force(&self, sign: f64, u: f64) -> f64 {
        let direction = 1.0_f64.copysign(sign);
        self.force.side(sign).lines.last().map_or(0.0, |line| direction * line.at(direction * u))
    }

    /// |u| at the end of the elastic branch on the side of `sign`; 0 for the rigid-linear law \[m\].
    pub fn elastic_end(&self, sign: f64) -> f64 {
        self.force.side(sign).corners.first().copied().unwrap_or(0.0)
    }

    /// Returns whether both sides are alike but for ties: the strength of the body, and the force.
    pub fn has_equal_sides(&self) -> bool {
        self.body.strength.positive == self.body.strength.negative && self.force.is_odd()
    }

    /// The largest |F| of the wall without its ties on the side of `sign` \[N\].
    pub fn largest_own_force(&self, sign: f64) -> f64 {
        self.largest_own_force_from(sign, 0.0)
    }

    /// The largest |F| of the wall without its ties from |u| on, on the side of `sign` \[N\].
    pub fn largest_own_force_from(&self, sign: f64, u: f64) -> f64 {
        let corners = self.force.side(sign).corners.iter().copied().filter(|corner| *corner > u);
        corners.map(|corner| self.own_force(sign, corner)).fold(self.own_force(sign, u), f64::max)
    }
}
