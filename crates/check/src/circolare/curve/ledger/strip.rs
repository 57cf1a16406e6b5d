//! The weights of a strip of two bodies, with what each moves and rises by.

use rocking_wall::wall::{Body, Load};

use super::OfSide;
use crate::circolare::curve::level;

/// A weight of a strip: forces in kN, places in m, per unit of u at the hinge.
pub(super) struct Term {
    pub(super) force: f64,
    /// The weight that is pushed.
    pub(super) moving: f64,
    /// The thrust, positive where it takes from the side.
    pub(super) thrust: f64,
    pub(super) height: f64,
    /// Its displacement.
    pub(super) phi: f64,
    /// Its rise.
    pub(super) rho: f64,
    /// Whether it rests on the lower body.
    pub(super) is_lower: bool,
}

/// The own weights of both bodies and the loads on them; none of a rectangle, or beside an overburden.
pub(super) fn terms(body: &Body, of: OfSide<'_>) -> Vec<Term> {
    let (h, h1, sign) = (body.height, body.hinge_height, of.side.sign());
    let own = level::on_side(of.parameters, sign);
    let Some(profile) = own.profile.as_ref().filter(|_| body.overburden == 0.0) else { return Vec::new() };
    let Ok([outer, inner]) = profile.hinge_edges(h1) else { return Vec::new() };
    let toes = profile.toes();
    let [base, hinge] = if sign > 0.0 { [toes[0], inner] } else { [toes[1], outer] };
    let (gravity, h2) = (body.weight / body.mass, h - h1);
    let term = |load: &Load, moving: f64, is_lower: bool| {
        let (x, z) = (load.inside, load.height);
        let [phi, rise] = if is_lower {
            [z / h1, (x - base) / h1]
        } else {
            [(h - z) / h2, (hinge - base) / h1 + (hinge - x) / h2]
        };
        Term {
            force: 1e-3 * load.force,
            moving: 1e-3 * gravity * moving,
            thrust: 1e-3 * sign * load.thrust,
            height: z,
            phi,
            rho: sign * rise,
            is_lower,
        }
    };
    let bodies = [([0.0, h1], true), ([h1, h], false)].map(|(heights, is_lower)| {
        let own = profile.centroid(heights);
        term(&Load::resting(gravity * own.mass, own.z, own.x), own.mass, is_lower)
    });
    let loads = profile.loads().iter();
    let loads = loads.map(|load| term(load, load.moving(gravity), load.height <= h1 + 1e-9 * h));
    bodies.into_iter().chain(loads).collect()
}
