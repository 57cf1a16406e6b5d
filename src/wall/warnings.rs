//! What the parameters of a wall give reason to warn about.

use crate::choices::RestitutionSource;

use super::damping::DampingLaw;
use super::equivalence;
use super::force_law::RestoringForce;
use super::mechanism::Body;
use super::parameters::{Kinematics, Parameters};
use super::ties::Ties;
use super::usage::{Usage, usage};
use super::usual::{FORCES, LENGTHS, Usual};
use super::warning::{USUAL_STEP, Warning};

/// Largest usual ω₁ times that step: 16 vibrations.
const MOST_USUAL_ANGLE: f64 = 100.0;

/// Slenderness angle from which small rotations are off by some per cent \[rad\]. Of rectangles
/// `docs/accuracy.md` says how far they are off.
const LARGE_ROTATIONS: f64 = 0.25;

/// Collects the warnings of a wall; `restitution` is that of impacts, where it has them.
pub(super) fn collect(
    parameters: &Parameters,
    body: &Body,
    force: &RestoringForce,
    ties: &Ties,
    damping: &DampingLaw,
    restitution: Option<f64>,
) -> Vec<Warning> {
    let of_further = parameters
        .further_ties
        .iter()
        .flat_map(|tie| usage(&parameters.tied_by(*tie)).filter(|usage| usage.name.starts_with("tie_")));
    let unused = usage(parameters).chain(of_further).filter(|usage| !usage.is_start && !usage.matters);
    let mut warnings: Vec<_> =
        unused.map(|Usage { name, condition, .. }| Warning::NoEffect { name, condition }).collect();
    let computed = damping.asked.computed_name();
    let is_plain_parapet = body.is_rectangle && !body.is_strip() && body.overburden <= 0.0;
    if computed == Some("c_bar") && !is_plain_parapet {
        warnings.push(Warning::ComputedFreeStanding);
    }
    if computed.is_some() && restitution.is_some() {
        warnings.push(Warning::CountedTwice);
    }
    let source = parameters.restitution_source;
    let is_of_rectangles = matches!(source, RestitutionSource::Analytic | RestitutionSource::Calibrated);
    let is_computed = parameters.restitution < 0.0 && (computed.is_some() || restitution.is_some());
    if !body.is_rectangle && is_of_rectangles && is_computed {
        warnings.push(Warning::ByImpulses { name: source.name() });
    }
    let is_small = parameters.kinematics == Kinematics::Linear;
    if !body.is_rectangle && is_small && body.slenderness.most() >= LARGE_ROTATIONS {
        let has_full_ones = parameters.profile.is_some() && !body.is_strip();
        warnings.push(Warning::LargeRotations { slenderness: body.slenderness.most(), has_full_ones });
    }
    if computed == Some("xi") && !equivalence::FITTED_A1.contains(&force.elastic_fraction) {
        warnings.push(Warning::OutsideFit { a1: force.elastic_fraction });
    }
    if damping.elastic == 0.0 && restitution == Some(1.0) {
        warnings.push(Warning::NeverRests);
    }
    let held = |sign: f64| ties.steady(force, body, sign);
    if let Some(sign) = [1.0, -1.0].into_iter().find(|sign| held(*sign)) {
        // of several, the highest
        let height = ties.of_side(sign).map(|tie| tie.height).reduce(f64::max).and_then(|z| ties.told(z));
        warnings.push(Warning::TieHolds { u_ins: body.instability.of(sign), height });
    }
    if let Some(free) = parameters.rocking.free_side() {
        let never = parameters.ties().filter(|tie| tie.stiffness > 0.0 && !tie.holds(free));
        let side = if free > 0.0 { "below" } else { "above" };
        warnings.extend(never.map(|tie| Warning::NeverPulls { side, height: ties.told(tie.height) }));
    }
    let omega1 = force.omega1(body.effective_mass);
    if omega1 * USUAL_STEP > MOST_USUAL_ANGLE {
        warnings.push(Warning::Fast { omega1 });
    }
    warnings.extend(parameters.unusual());
    warnings
}

impl Parameters {
    /// Finds the parameters of a wall whose values are improbable.
    pub fn unusual(&self) -> impl Iterator<Item = Warning> + use<> {
        let Parameters { height, thickness, width, overburden, .. } = *self;
        let half = thickness / 2.0;
        let is_rectangle = self.is_rectangle();
        let usual = |name, unit, range, others| Usual { name, unit, range, others };
        let of_shape = [
            (height, usual("height", "m", [0.2, 30.0], LENGTHS)),
            (thickness, usual("thickness", "m", [0.03, 3.0], LENGTHS)),
        ];
        // the ratio of a height or thickness in another unit says nothing more
        let slender = is_rectangle && of_shape.iter().all(|(value, usual)| usual.warning(*value).is_none());
        let density =
            usual("density", "kg/m3", [400.0, 3000.0], &[("in t/m3", 1e3), ("in kN/m3", 1e3 / 9.80665)]);
        let of_wall = [
            (is_rectangle, self.density, density),
            (slender, height / thickness, usual("height/thickness", "", [1.0, 100.0], &[])),
            (true, self.gravity, usual("gravity", "m/s2", [9.7, 9.9], &[("in cm/s2", 0.01)])),
            // below 0 it is computed
            (self.xi >= 0.0, self.xi, usual("xi", "", [0.0, 0.5], &[("in per cent", 0.01)])),
            // 0.1 to 1000 kN per metre of width; without a load its eccentricity does not matter
            (overburden > 0.0, overburden, usual("overburden", "N", [100.0, 1e6].map(|o| o * width), FORCES)),
            (
                overburden > 0.0,
                self.overburden_eccentricity,
                usual("overburden_eccentricity", "m", [-half, half], LENGTHS),
            ),
        ];
        let of_shape = of_shape.map(|(value, usual)| (is_rectangle, value, usual));
        let parts = self.profile.iter().flat_map(|profile| profile.parts());
        let of_parts = parts.flat_map(|part| {
            let thickest = part.thickness[0].max(part.thickness[1]);
            [
                (true, part.height, usual("height", "m", [0.02, 30.0], LENGTHS)),
                (true, thickest, usual("thickness", "m", [0.03, 3.0], LENGTHS)),
                (true, part.density, density),
            ]
        });
        let loads = self.profile.iter().flat_map(|profile| profile.loads());
        let of_loads = loads.flat_map(|load| {
            let range = [100.0, 1e6].map(|force| force * width);
            let thrust = load.thrust.abs();
            [
                (load.force > 0.0, load.force, usual("force", "N", range, FORCES)),
                (thrust > 0.0, thrust, usual("thrust", "N", range.map(|force| 0.1 * force), FORCES)),
            ]
        });
        let of_profile: Vec<_> = of_parts.chain(of_loads).collect();
        let all = of_shape.into_iter().chain(of_profile).chain(of_wall);
        let of_ties: Vec<_> = self.ties().flat_map(|tie| tie.unusual()).collect();
        all.filter(|(counts, ..)| *counts).filter_map(|(_, value, usual)| usual.warning(value)).chain(of_ties)
    }
}
