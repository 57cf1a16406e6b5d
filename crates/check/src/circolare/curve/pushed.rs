//! The weights that a mechanism pushes, Σ (P + Q) of [C8.7.1.1] to [C8.7.1.5].
//!
//! With δ per unit of u, z/`z_G` of one body and φ of a strip, each resultant P + Q has its δ. Eq. (12) of a
//! strip is twice Lagrange's, so that its force counts twice, and with it Σ (P + Q) δ.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Body, Load, ParameterError, Parameters, Strip};

use crate::circolare::statement::resultants::Resultants;

/// The sums over the weights that a mechanism pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pushed {
    /// Σ (P + Q) \[N\].
    pub(crate) weight: f64,
    /// Σ (P + Q) δ over the work of F per unit of u, the divisor of α0 \[N\].
    pub(crate) work: f64,
    /// e* [C8.7.1.5] \[-\].
    pub(crate) e_star: f64,
    /// d/u [C8.7.1.4] \[-\].
    pub(crate) d_per_u: f64,
    /// e* of one resultant on each body and of each weight alone \[-\].
    pub(crate) e_stars: [f64; 2],
}

/// Weights that move together, with their moments of δ.
#[derive(Clone, Copy, Debug)]
struct Weights {
    /// Σ (P + Q) \[N\].
    weight: f64,
    /// Σ (P + Q) δ \[N\].
    first: f64,
    /// Σ (P + Q) δ² \[N\].
    second: f64,
}

impl Weights {
    /// A weight at a δ.
    fn at(weight: f64, delta: f64) -> Self {
        let first = weight * delta;
        Self { weight, first, second: first * delta }
    }

    fn sum(of: &[Self]) -> Self {
        let sum = |number: fn(&Self) -> f64| of.iter().map(number).sum::<f64>();
        Self { weight: sum(|own| own.weight), first: sum(|own| own.first), second: sum(|own| own.second) }
    }

    /// Their resultant, at the mean of their δ.
    fn resultant(self) -> Self {
        let delta = self.first / self.weight;
        Self { second: self.first * delta, ..self }
    }

    /// e*: the square of the mean of δ over the mean of its square.
    fn e_star(self) -> f64 {
        let mean = self.first / self.weight;
        // exactly 1 where every δ is the same
        1.0 / (1.0 + (self.second - self.first * mean).max(0.0) / (self.first * mean))
    }
}

impl Pushed {
    /// Returns the sums of a body; `moved` is the part of its overburden whose mass moves along \[N\].
    ///
    /// # Errors
    /// [`ParameterError`] of a strip whose bodies do not touch at the hinge.
    pub(crate) fn new(
        body: &Body,
        parameters: &Parameters,
        moved: f64,
        resultants: Resultants,
    ) -> Result<Self, ParameterError> {
        let bodies = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody => vec![one_body(body, parameters, moved)],
            Mechanism::VerticalSpanning => strip(body, parameters)?,
        };
        let of_bodies: Vec<_> = bodies.iter().map(|own| Weights::sum(own).resultant()).collect();
        let sums = [Weights::sum(&of_bodies), Weights::sum(&bodies.concat())];
        let e_stars = sums.map(Weights::e_star);
        let Weights { weight, first, .. } = sums[0];
        let e_star = e_stars[usize::from(resultants == Resultants::Each)];
        let scale = if body.is_strip() { 2.0 } else { 1.0 };
        Ok(Self { weight, work: scale * first, e_star, d_per_u: first / weight / e_star, e_stars })
    }
}

/// The own weight of one body, and each load that moves along.
fn one_body(body: &Body, parameters: &Parameters, moved: f64) -> Vec<Weights> {
    let (gravity, z) = (body.weight / body.mass, body.centroid_height);
    let mut all = vec![Weights::at(body.weight, 1.0)];
    let at = |load: &Load| Weights::at(gravity * load.moving(gravity), load.height / z);
    if let Some(profile) = &parameters.profile {
        all.extend(profile.loads().iter().map(at));
    } else if let Some(loads) = &parameters.loads {
        all.extend(loads.iter().map(at));
    } else if parameters.mechanism == Mechanism::RigidBody {
        let weight = gravity * parameters.load_mass;
        let first = weight * parameters.load_mass_height / z;
        all.push(Weights { weight, first, second: gravity * parameters.load_inertia / (z * z) });
    }
    all.push(Weights::at(moved, body.height / z));
    all
}

/// The own weight of the lower and of the upper body, with the loads on each; a load at the hinge rests on
/// the lower one.
fn strip(body: &Body, parameters: &Parameters) -> Result<Vec<Vec<Weights>>, ParameterError> {
    let Some(profile) = &parameters.profile else {
        // both bodies of a rectangle have δ = 1/2
        return Ok(vec![vec![Weights::at(body.weight, 0.5)]]);
    };
    let (gravity, h, h1) = (body.weight / body.mass, body.height, body.hinge_height);
    let strip = Strip::new(profile, h1)?;
    let (lower, upper): (Vec<&Load>, Vec<&Load>) =
        profile.loads().iter().partition(|load| strip.is_below(load.height));
    let of = |heights: [f64; 2], loads: &[&Load]| {
        let own = profile.centroid(heights);
        let own = Weights::at(gravity * own.mass, strip.share(own.z));
        let at = |load: &&Load| Weights::at(gravity * load.moving(gravity), strip.share(load.height));
        [own].into_iter().chain(loads.iter().map(at)).collect()
    };
    Ok(vec![of([0.0, h1], &lower), of([h1, h], &upper)])
}
