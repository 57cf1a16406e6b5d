//! The rigid body behind Eq. (1): its constants, and those of a rectangle.

use crate::choices::{EccentricityMode, Mechanism};

use super::error::ParameterError;
use super::parameters::Parameters;
use super::profile::{OF_RECTANGLE, Profile};
use super::restitution;
use super::sides::Sides;

/// The rigid body behind the equation of motion: masses, the rigid restoring force and where it ends.
///
/// For a rectangle these are Tables 1 and 2 of Tomassetti et al., in the corrected form; for a wall of parts
/// and for a rigid body given by its integrals, see `assembled`.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Which mechanism.
    pub mechanism: Mechanism,
    /// Whether it is a rectangle: what is calibrated on rectangles is of it alone.
    pub is_rectangle: bool,
    /// Height h \[m\].
    pub height: f64,
    /// Height of the intermediate hinge above the base, h₁ \[m\]; h for one body, which has none.
    pub hinge_height: f64,
    /// Height of the centroid of the masonry `z_G`, at which u of one body is measured \[m\]; h/2 for a
    /// strip.
    pub centroid_height: f64,
    /// Slenderness angle of each side, α = atan(b/h), α₁ = atan(b/h₁) or atan(x/`z_G`) with the arm x of the
    /// weight \[rad\].
    pub slenderness: Sides,
    /// Weight of the masonry W = m g \[N\].
    pub weight: f64,
    /// Overburden O \[N\].
    pub overburden: f64,
    /// Mass of the masonry m \[kg\].
    pub mass: f64,
    /// Effective mass `m_eff` \[kg\].
    pub effective_mass: f64,
    /// Participation λ of the support acceleration \[-\].
    pub participation: f64,
    /// Rigid strength F₀ of each side \[N\]; positive on the sides to which the wall can rock.
    pub strength: Sides,
    /// Negative geometric stiffness k₀, as a positive number \[N/m\].
    pub geometric_stiffness: f64,
    /// Static instability displacement `u_ins` = F₀/k₀ of each side \[m\].
    pub instability: Sides,
    /// Displacement at which the wall lies down: `z_G` or h₁, never less than `u_ins` of the side \[m\].
    pub landing: Sides,
    /// Displacement from which the wall has left its supports: max(half the geometric end, `u_ins`) \[m\].
    pub departure: Sides,
    /// Share of the bottom and of the top support in the effective support acceleration, `w_b` and `w_t`
    /// \[-\].
    pub support_weights: [f64; 2],
    /// Weight whose component along a drift d pulls the wall, as W d/h for a rectangular strip \[N\]; 0 for
    /// one body.
    pub drift_weight: f64,
    /// What the reactions of the supports follow from.
    pub contact: Contact,
    /// F₀ of a side that transverse walls hold and that has none above 0 \[N\]: `strength` and what follows
    /// from it then have there the numbers of the other side, so that a law has two sides.
    pub held: Option<f64>,
    /// Coefficient of restitution by impulses \[-\]: from u > 0 to u < 0 (`positive`), and back. `None` for a
    /// body that is given without the place of its toes.
    pub impulses: Option<Sides>,
}

/// What the reactions of the supports follow from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Mass that moves, with that of loads \[kg\].
    pub mass: f64,
    /// Shares of that mass in the reaction of the bottom support.
    pub bottom: MassShares,
    /// Shares of that mass in the reaction of the top support.
    pub top: MassShares,
    /// Sum of the thrusts, positive outwards \[N\].
    pub thrust: f64,
    /// Moment of all weights and thrusts about the edge of the base on which a strip bears, of each side,
    /// against the motion \[N m\]: (W + O) b/2 − O c for a rectangle. 0 for one body.
    pub moments: Sides,
    /// Σ P φ/h, by which the couple falls with u \[N/m\]: W/(2h) for a rectangular strip.
    pub by_displacement: f64,
    /// Σ P z/h², by which the couple falls with the drift \[N/m\]: (W/2 + O)/h for a rectangular strip.
    pub by_drift: f64,
}

/// Shares of the moving mass with which a support feels three accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassShares {
    /// Of the bottom support.
    pub bottom: f64,
    /// Of the top support.
    pub top: f64,
    /// Of the wall, ü.
    pub wall: f64,
}

impl Body {
    /// # Errors
    /// [`ParameterError::NoStrength`] where loads leave no positive F₀ on a side to which the wall can rock;
    /// [`ParameterError`] of parts that make no body.
    pub(super) fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let mut body = match (&parameters.profile, parameters.mechanism) {
            (None, Mechanism::RigidBody) => Self::of_integrals(parameters)?,
            (None, _) => Self::rectangle(parameters),
            (Some(profile), mechanism) => {
                check_stated(parameters, profile)?;
                match mechanism {
                    Mechanism::VerticalSpanning => Self::strip_of_parts(parameters, profile)?,
                    Mechanism::Parapet | Mechanism::RigidBody => Self::of_parts(parameters, profile),
                }
            }
        };
        for (sign, side) in [(1.0, "u > 0"), (-1.0, "u < 0")] {
            let force = body.strength.of(sign);
            if force > 0.0 {
                continue;
            }
            if parameters.rocking.allows(sign) {
                return Err(body.without_strength(parameters, side, force));
            }
            body.held = Some(force);
            for sides in [&mut body.strength, &mut body.instability, &mut body.landing, &mut body.departure] {
                *sides = Sides::both(sides.of(-sign));
            }
        }
        Ok(body)
    }

    fn without_strength(&self, parameters: &Parameters, side: &'static str, force: f64) -> ParameterError {
        let Parameters { overburden, overburden_eccentricity: eccentricity, .. } = *parameters;
        if self.is_rectangle {
            return ParameterError::NoStrength { side, force, eccentricity, overburden };
        }
        let moment = parameters.thrust_moment();
        let thrust_moment = if side == "u > 0" { moment } else { -moment };
        ParameterError::Overturns { side, force, thrust_moment }
    }

    fn rectangle(parameters: &Parameters) -> Self {
        let Parameters { mechanism, height: h, thickness: b, overburden: o, .. } = *parameters;
        let mass = parameters.density * h * b * parameters.width;
        let weight = mass * parameters.gravity;
        let is_strip = mechanism == Mechanism::VerticalSpanning;
        let (hinge_height, effective_mass, participation, support_weights, end) = if is_strip {
            let h1 = parameters.hinge_ratio * h;
            // w_b = (2h − h₁)/(3h), w_t = (h + h₁)/(3h)
            let weights = [(2.0 * h - h1) / (3.0 * h), (h + h1) / (3.0 * h)];
            (h1, 2.0 / 3.0 * mass, 1.5, weights, h1)
        } else {
            (h, 4.0 / 3.0 * mass, 0.75, [1.0, 0.0], h / 2.0)
        };
        let strength_with = |c: f64| {
            if is_strip {
                // F₀ = (2/h₁)(W + O) b + O (b + 2c)/h₂
                2.0 / hinge_height * (weight + o) * b + o * (b + 2.0 * c) / (h - hinge_height)
            } else {
                // F₀ = (W + O) b/h − (2/h) O c
                ((weight + o) * b - 2.0 * o * c) / h
            }
        };
        let geometric_stiffness = if is_strip {
            // k₀ = 2 (W + O)/h₁ + 2 O/h₂
            2.0 * (weight + o) / hinge_height + 2.0 * o / (h - hinge_height)
        } else {
            // k₀ = 2 (W + 2O)/h
            2.0 * (weight + 2.0 * o) / h
        };
        let eccentricity = parameters.eccentricity_of_sides();
        let contact = if is_strip {
            let [w_b, w_t] = support_weights;
            Contact {
                mass,
                bottom: MassShares { bottom: 1.0 / 3.0, top: 1.0 / 6.0, wall: w_b / 2.0 },
                top: MassShares { bottom: 1.0 / 6.0, top: 1.0 / 3.0, wall: w_t / 2.0 },
                thrust: 0.0,
                moments: eccentricity.map(|c| 0.5 * (weight + o) * b - o * c),
                by_displacement: 0.5 * weight / h,
                by_drift: (weight / 2.0 + o) / h,
            }
        } else {
            Contact::of_one_body(mass, 1.0, 0.0)
        };
        let slenderness = (b / hinge_height).atan();
        let impulses = if is_strip {
            restitution::impulses_of_strip(h, hinge_height, b)
        } else {
            restitution::analytic_parapet(slenderness)
        };
        Self {
            mechanism,
            is_rectangle: true,
            height: h,
            hinge_height,
            centroid_height: h / 2.0,
            slenderness: Sides::both(slenderness),
            weight,
            overburden: o,
            mass,
            effective_mass,
            participation,
            strength: eccentricity.map(strength_with),
            geometric_stiffness,
            support_weights,
            drift_weight: if is_strip { weight } else { 0.0 },
            contact,
            impulses: Some(Sides::both(impulses)),
            instability: Sides::default(),
            landing: Sides::default(),
            departure: Sides::default(),
            held: None,
        }
        .ending_at(end)
    }

    /// Returns the body with its instability, departure and landing; `end` is where it lies down by its
    /// geometry \[m\].
    pub(super) fn ending_at(self, end: f64) -> Self {
        let instability = self.strength.map(|force| force / self.geometric_stiffness);
        Self {
            instability,
            landing: instability.map(|u_ins| end.max(u_ins)),
            departure: instability.map(|u_ins| (end / 2.0).max(u_ins)),
            ..self
        }
    }

    /// Returns the couple of the contacts where the wall alone bears the force F on the side of `sign`, from
    /// F at u = 0 \[N\]: [M̄ + F/F₀ (M₊ + M₋)/2]/h with M̄ = (M₊ − M₋)/2 of the contact moments \[N\].
    pub(super) fn contact_couple(&self, force: f64, sign: f64) -> f64 {
        let Sides { positive, negative } = self.contact.moments;
        0.5 * (positive - negative + (positive + negative) * force / self.strength.of(sign)) / self.height
    }

    /// Returns whether the couple of the contacts grows with the force at different rates on the two sides.
    pub(super) fn has_bent_couple(&self) -> bool {
        self.is_strip() && self.strength.positive != self.strength.negative
    }

    /// Returns how far a height moves for u = 1 \[-\]: z/`z_G`, and φ(z) of a strip.
    pub fn lever(&self, height: f64) -> f64 {
        match self.hinge() {
            None => height / self.centroid_height,
            Some(hinge) if height <= hinge => height / hinge,
            Some(hinge) => (self.height - height) / (self.height - hinge),
        }
    }

    /// Returns whether the wall is a strip of two bodies between two supports.
    pub fn is_strip(&self) -> bool {
        self.mechanism == Mechanism::VerticalSpanning
    }

    /// Returns the height of the hinge of a strip wall \[m\]; one body has none.
    pub fn hinge(&self) -> Option<f64> {
        self.is_strip().then_some(self.hinge_height)
    }
}

/// Checks that nobody has changed the rectangle that stands for parts.
///
/// # Errors
/// [`ParameterError::OfParts`].
fn check_stated(parameters: &Parameters, profile: &Profile) -> Result<(), ParameterError> {
    let Parameters { height, thickness, width, density, .. } = *parameters;
    let stated =
        OF_RECTANGLE.into_iter().zip([height, thickness, width, density]).zip(profile.as_rectangle());
    let changed = stated.into_iter().find(|((_, value), own)| value != own);
    changed.map_or(Ok(()), |((name, value), own)| Err(ParameterError::OfParts { name, value, own }))
}

impl Contact {
    /// Those of one body: it stands on one support. `share` is ∫z dm/`z_G` over the moving mass.
    pub(super) fn of_one_body(mass: f64, share: f64, thrust: f64) -> Self {
        let bottom = MassShares { bottom: 1.0, top: 0.0, wall: share };
        Self { mass, bottom, thrust, ..Self::default() }
    }
}

impl Parameters {
    /// Returns the moment of the thrusts about the base, outwards \[N m\].
    fn thrust_moment(&self) -> f64 {
        let of_body = self.thrust * self.thrust_height;
        let of_parts = |profile: &Profile| profile.loads().iter().map(|load| load.thrust * load.height).sum();
        self.profile.as_deref().map_or(of_body, of_parts)
    }

    /// Returns the eccentricity of the overburden towards each side \[m\].
    pub(super) fn eccentricity_of_sides(&self) -> Sides {
        let c = self.overburden_eccentricity;
        match self.eccentricity_mode {
            EccentricityMode::FixedToWall => Sides { positive: c, negative: -c },
            EccentricityMode::FollowsPivot => Sides::both(c),
        }
    }
}
