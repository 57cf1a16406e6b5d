//! The weights of a strip of two bodies, with what each moves and rises by.

use rocking_wall::wall::{Body, Load, Strip};

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
    let Ok(strip) = Strip::new(profile, h1) else { return Vec::new() };
    let gravity = body.weight / body.mass;
    let term = |load: &Load, moving: f64| Term {
        force: 1e-3 * load.force,
        moving: 1e-3 * gravity * moving,
        thrust: 1e-3 * sign * load.thrust,
        height: load.height,
        phi: strip.share(load.height),
        rho: strip.rise(sign, load.inside, load.height),
        is_lower: strip.is_below(load.height),
    };
    let bodies = [[0.0, h1], [h1, h]].map(|heights| {
        let own = profile.centroid(heights);
        term(&Load::resting(gravity * own.mass, own.z, own.x), own.mass)
    });
    let loads = profile.loads().iter().map(|load| term(load, load.moving(gravity)));
    bodies.into_iter().chain(loads).collect()
}
