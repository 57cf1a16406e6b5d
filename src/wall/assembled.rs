//! Bodies that are no rectangle: of parts and loads, and of given integrals.
//!
//! With a fixed hinge the restoring force of any rigid body is linear in u, so that these walls have Eq. (12)
//! with constants of their own. They follow from Lagrange's equations for small rotations.
//!
//! # One body
//! It turns by θ about its outer toe (u > 0) or its inner toe, at the distance b₀; u = θ `z_G` with the
//! height `z_G` of the centroid of the masonry. Loads P at (x, z) have arms x and b₀ − x, a moving mass r
//! P/g and a thrust H outwards:
//!
//! ```text
//! I = Σ∫z² dm + Σ r (P/g) z²     S = Σ∫z dm + Σ r (P/g) z     K = W z_G + Σ P z
//! M₀± = W x± + Σ P d± ∓ Σ H z
//! m_eff = I/z_G²     λ = S z_G/I     F₀± = M₀±/z_G     k₀ = K/z_G²
//! ```
//!
//! # A strip of two bodies
//! The hinge at h₁ moves by u, φ = z/h₁ below it and (h − z)/h₂ above. The base bears at the toe A, the hinge
//! where both sections reach, at B: their inner edges for u > 0. A place x rises by
//!
//! ```text
//! ρ = (x − x_A)/h₁ below     ρ = (x_B − x_A)/h₁ + (x_B − x)/h₂ above     for u > 0, mirrored for u < 0
//! ```
//!
//! for each unit of |u|. On the scale of Eq. (12), which is twice Lagrange's:
//!
//! ```text
//! m_eff = 2 ∫φ² dm     λ m_eff = 2 ∫φ dm     F₀± = 2 [Σ P ρ ∓ Σ H φ]     k₀ = 2 (K₁/h₁² + K₂/h₂²)
//! K₁ = Σ P z below + h₁ Σ P above     K₂ = Σ P (z − h₁) above
//! ```
//!
//! # Impacts
//! An impact projects the old field of velocities on the new one, since its impulses act where the new field
//! does not move; ρ and ρ′ are those of the old and the new side:
//!
//! ```text
//! e = ∫[φ² − ρ ρ′] dm / ∫[φ² + ρ′²] dm
//! ```

use super::error::{Choice, ParameterError};
use super::given::given;
use super::mechanism::{Body, Contact, MassShares};
use super::parameters::Parameters;
use super::points::Point;
use super::profile::{Profile, SAME};
use super::sides::Sides;
use super::strip::Strip;

/// What one body has of each point, summed: with moments about the base and about each toe.
struct OneBody {
    height: f64,
    /// Of the masonry alone: m, W, `z_G` and the arms of the weight.
    mass: f64,
    weight: f64,
    centroid_height: f64,
    arms: Sides,
    overburden: f64,
    /// With loads: the moving mass, I, S, K, M₀ and the thrust.
    moving_mass: f64,
    inertia: f64,
    first_moment: f64,
    overturning: f64,
    moments: Sides,
    thrust: f64,
    impulses: Option<Sides>,
}

impl OneBody {
    fn body(self, parameters: &Parameters) -> Body {
        let z = self.centroid_height;
        Body {
            mechanism: parameters.mechanism,
            is_rectangle: false,
            height: self.height,
            hinge_height: self.height,
            centroid_height: z,
            slenderness: self.arms.map(|arm| (arm / z).atan()),
            weight: self.weight,
            overburden: self.overburden,
            mass: self.mass,
            effective_mass: self.inertia / (z * z),
            participation: self.first_moment * z / self.inertia,
            strength: self.moments.map(|moment| moment / z),
            geometric_stiffness: self.overturning / (z * z),
            support_weights: [1.0, 0.0],
            drift_weight: 0.0,
            contact: Contact::of_one_body(
                self.moving_mass,
                self.first_moment / (z * self.moving_mass),
                self.thrust,
            ),
            impulses: self.impulses,
            instability: Sides::default(),
            landing: Sides::default(),
            departure: Sides::default(),
            held: None,
        }
        .ending_at(z)
    }
}

impl Body {
    /// Returns the body of parts that turns about its toes.
    #[cold]
    pub(super) fn of_parts(parameters: &Parameters, profile: &Profile) -> Self {
        let h = profile.height();
        let [outer, inner] = profile.toes();
        let mut points = profile.masonry([0.0, h], parameters.gravity);
        let own = points.len();
        points.extend(profile.load_points(parameters.gravity));
        let masonry = |of: &dyn Fn(&Point) -> f64| total(&points[..own], of);
        let all = |of: &dyn Fn(&Point) -> f64| total(&points, of);
        let (mass, weight) = (masonry(&|p| p.mass), masonry(&|p| p.weight));
        let (x, z) = (masonry(&|p| p.mass * p.x) / mass, masonry(&|p| p.mass * p.z) / mass);
        let arm = |sign: f64, x: f64| if sign > 0.0 { x - outer } else { inner - x };
        let (o, c) = (parameters.overburden, parameters.overburden_on(profile));
        let moment = |sign: f64| {
            all(&|p| p.weight * arm(sign, p.x) - sign * p.thrust * p.z) + o * arm(sign, c.of(sign))
        };
        let rise = |sign: f64, p: &Point| arm(sign, p.x);
        let impulses =
            Sides::each(|sign| impulses(&points, &|p| p.z, &|p| rise(sign, p), &|p| rise(-sign, p)));
        OneBody {
            height: h,
            mass,
            weight,
            centroid_height: z,
            arms: Sides::each(|sign| arm(sign, x)),
            overburden: o,
            moving_mass: all(&|p| p.mass),
            inertia: all(&|p| p.mass * p.z * p.z),
            first_moment: all(&|p| p.mass * p.z),
            overturning: all(&|p| p.weight * p.z) + o * h,
            moments: Sides::each(moment),
            thrust: all(&|p| p.thrust),
            impulses: Some(impulses),
        }
        .body(parameters)
    }

    /// Returns the rigid body whose integrals are given.
    #[cold]
    pub(super) fn of_integrals(parameters: &Parameters) -> Result<Self, ParameterError> {
        let Parameters { body_mass: mass, centroid_height: z, gravity, height, .. } = *parameters;
        let Parameters { load_force: load, load_height, load_mass, load_mass_height, thrust, .. } =
            *parameters;
        if z >= height {
            return Err(ParameterError::conflict(
                [Choice::new("centroid_height", z.to_string()), Choice::new("height", height.to_string())],
                "height to that of the top of the body, above its centroid",
            ));
        }
        if parameters.overburden > 0.0 {
            return Err(ParameterError::conflict(
                [
                    Choice::new("overburden", parameters.overburden.to_string()),
                    Choice::new("mechanism", parameters.mechanism.name()),
                ],
                "load_force, load_height and load_arm for the loads of a rigid body, and overburden = 0",
            ));
        }
        for (name, value, mass, height) in [
            ("inertia", parameters.inertia, mass, z),
            ("load_inertia", parameters.load_inertia, load_mass, load_mass_height),
        ] {
            // the numbers may be rounded
            if value < (1.0 - 1e-6) * mass * height * height {
                return Err(ParameterError::Inertia { name, value, mass, height });
            }
        }
        let weight = mass * gravity;
        let inner = given("arm_inner", parameters.arm_inner)?.unwrap_or(parameters.arm);
        let arms = Sides { positive: parameters.arm, negative: inner };
        let load_arms =
            Sides { positive: parameters.load_arm, negative: parameters.arm + inner - parameters.load_arm };
        let thrust_moment = thrust * parameters.thrust_height;
        Ok(OneBody {
            height,
            mass,
            weight,
            centroid_height: z,
            arms,
            overburden: 0.0,
            moving_mass: mass + load_mass,
            inertia: parameters.inertia + parameters.load_inertia,
            first_moment: mass * z + load_mass * load_mass_height,
            overturning: weight * z + load * load_height,
            moments: Sides::each(|sign| {
                weight * arms.of(sign) + load * load_arms.of(sign) - sign * thrust_moment
            }),
            thrust,
            impulses: None,
        }
        .body(parameters))
    }

    /// Returns the strip of parts, cut by its hinge into two bodies.
    #[cold]
    pub(super) fn strip_of_parts(parameters: &Parameters, profile: &Profile) -> Result<Self, ParameterError> {
        let h = profile.height();
        let h1 = profile.snapped(parameters.hinge_ratio * h);
        let strip = Strip::new(profile, h1)?;
        let mut points = profile.masonry([0.0, h1], parameters.gravity);
        points.extend(profile.masonry([h1, h], parameters.gravity));
        let own = points.len();
        points.extend(profile.load_points(parameters.gravity));
        let masonry = |of: &dyn Fn(&Point) -> f64| total(&points[..own], of);
        let all = |of: &dyn Fn(&Point) -> f64| total(&points, of);
        let (mass, weight, o) = (masonry(&|p| p.mass), masonry(&|p| p.weight), parameters.overburden);
        let c = parameters.overburden_on(profile);
        let phi = |p: &Point| strip.share(p.z);
        let strength = |sign: f64| {
            let of_points = all(&|p| p.weight * strip.rise(sign, p.x, p.z) - sign * p.thrust * phi(p));
            2.0 * (of_points + o * strip.rise(sign, c.of(sign), h))
        };
        let k1 = all(&|p| p.weight * p.z.min(h1)) + o * h1;
        let k2 = all(&|p| p.weight * (p.z - h1).max(0.0)) + o * (h - h1);
        let h2 = h - h1;
        let [moving, by_z, by_z2] = [0, 1, 2].map(|power| all(&|p| p.mass * (p.z / h).powi(power)));
        let [by_phi, by_phi_z] = [0, 1].map(|power| all(&|p| p.mass * phi(p) * (p.z / h).powi(power)));
        let effective_mass = 2.0 * all(&|p| p.mass * phi(p) * phi(p));
        let moment = |sign: f64| {
            let arm = |x: f64| sign * (x - strip.toe(sign));
            all(&|p| p.weight * arm(p.x) - sign * p.thrust * p.z) + o * arm(c.of(sign))
        };
        let contact = Contact {
            mass: moving,
            bottom: MassShares {
                bottom: (moving - 2.0 * by_z + by_z2) / moving,
                top: (by_z - by_z2) / moving,
                wall: (by_phi - by_phi_z) / moving,
            },
            top: MassShares { bottom: (by_z - by_z2) / moving, top: by_z2 / moving, wall: by_phi_z / moving },
            thrust: all(&|p| p.thrust),
            moments: Sides::each(moment),
            by_displacement: all(&|p| p.weight * phi(p)) / h,
            by_drift: (all(&|p| p.weight * p.z / h) + o) / h,
        };
        let impulses = Sides::each(|sign| {
            let rise = |sign: f64| move |p: &Point| strip.rise(sign, p.x, p.z);
            impulses(&points, &phi, &rise(sign), &rise(-sign))
        });
        Ok(Self {
            mechanism: parameters.mechanism,
            is_rectangle: false,
            height: h,
            hinge_height: h1,
            centroid_height: h / 2.0,
            slenderness: Sides::each(|sign| ((strip.edge(sign) - strip.toe(sign)).abs() / h1).atan()),
            weight,
            overburden: o,
            mass,
            effective_mass,
            participation: 2.0 * by_phi / effective_mass,
            strength: Sides::each(strength),
            geometric_stiffness: 2.0 * (k1 / (h1 * h1) + k2 / (h2 * h2)),
            support_weights: [1.0 - by_phi_z / by_phi, by_phi_z / by_phi],
            drift_weight: 2.0 * (k1 / h1 - k2 / h2),
            contact,
            impulses: Some(impulses),
            instability: Sides::default(),
            landing: Sides::default(),
            departure: Sides::default(),
            held: None,
        }
        .ending_at(h1))
    }
}

/// Returns the sum over points.
// one loop for all sums: they are made once a wall, and the library of an FMU is to be small
#[inline(never)]
pub(super) fn total(points: &[Point], of: &dyn Fn(&Point) -> f64) -> f64 {
    // the sum of none is -0
    points.iter().map(of).sum::<f64>() + 0.0
}

/// Returns the coefficient of restitution by impulses of points that move by φ and have risen by `old`, and
/// rise by `new` after the impact.
fn impulses(
    points: &[Point],
    share: &dyn Fn(&Point) -> f64,
    old: &dyn Fn(&Point) -> f64,
    new: &dyn Fn(&Point) -> f64,
) -> f64 {
    let common = total(points, &|p| p.mass * (share(p).powi(2) - old(p) * new(p)));
    common / total(points, &|p| p.mass * (share(p).powi(2) + new(p).powi(2)))
}

impl Profile {
    /// Returns a height, or that of an end of a part that is the same but for rounding \[m\].
    pub(super) fn snapped(&self, z: f64) -> f64 {
        let ends = self.parts().iter().flat_map(|part| [part.base, part.top()]);
        let same = SAME * self.height();
        ends.into_iter().find(|end| (end - z).abs() <= same).unwrap_or(z)
    }

    /// Returns the outer and the inner edge of the sections in contact at the hinge \[m\].
    ///
    /// # Errors
    /// [`ParameterError::NoHinge`] where nothing stands on the section below.
    pub fn hinge_edges(&self, height: f64) -> Result<[f64; 2], ParameterError> {
        let [below, above] = [false, true].map(|above| self.faces_beside(height, above));
        let [outer, inner] = [below[0].max(above[0]), below[1].min(above[1])];
        if outer < inner { Ok([outer, inner]) } else { Err(ParameterError::NoHinge { height, below, above }) }
    }
}

impl Parameters {
    /// Returns the place x of the overburden on each side \[m\]: from the centre of the top section.
    pub(super) fn overburden_on(&self, profile: &Profile) -> Sides {
        let [outer, inner] = profile.faces_beside(profile.height(), false);
        let centre = 0.5 * (outer + inner);
        let eccentricity = self.eccentricity_of_sides();
        Sides { positive: centre - eccentricity.positive, negative: centre + eccentricity.negative }
    }
}
