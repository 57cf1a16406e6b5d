//! The two mechanisms: Eq. (1) from geometry and loads.

use crate::choices::{EccentricityMode, Mechanism};

use super::error::ParameterError;
use super::parameters::Parameters;
use super::sides::Sides;

/// The rigid body behind the equation of motion: masses, the rigid restoring force and where it ends.
///
/// Tomassetti et al., Tables 1 and 2, in the corrected form.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Which mechanism.
    pub mechanism: Mechanism,
    /// Height h \[m\].
    pub height: f64,
    /// Height of the intermediate hinge above the base, h₁ \[m\]; h for a parapet, which has none.
    pub hinge_height: f64,
    /// Slenderness angle, α = atan(b/h) or α₁ = atan(b/h₁) \[rad\].
    pub slenderness: f64,
    /// Weight W = m g \[N\].
    pub weight: f64,
    /// Overburden O \[N\].
    pub overburden: f64,
    /// Mass m \[kg\].
    pub mass: f64,
    /// Effective mass `m_eff` \[kg\].
    pub effective_mass: f64,
    /// Participation λ of the support acceleration \[-\].
    pub participation: f64,
    /// Rigid strength F₀ of each side, both positive \[N\].
    pub strength: Sides,
    /// Negative geometric stiffness k₀, as a positive number \[N/m\].
    pub geometric_stiffness: f64,
    /// Static instability displacement `u_ins` = F₀/k₀ of each side, both positive \[m\].
    pub instability: Sides,
    /// Displacement at which the wall lies down: h/2 or h₁, never less than `u_ins` of the side \[m\].
    pub landing: Sides,
    /// Displacement from which the wall has left its supports: max(half the geometric end, `u_ins`) \[m\].
    pub departure: Sides,
    /// Moment of weight and overburden about the edge of the base on which a strip wall bears, of each side:
    /// (W + O) b/2 − O c with c of the side, against the motion \[N m\]. 0 for a parapet.
    pub contact_moments: Sides,
    /// Share of the bottom and of the top support in the effective support acceleration, `w_b` and `w_t`
    /// \[-\].
    pub support_weights: [f64; 2],
}

impl Body {
    /// # Errors
    /// [`ParameterError::NoStrength`] where the overburden's eccentricity leaves no positive F₀ on a side.
    pub(super) fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let Parameters { mechanism, height: h, thickness: b, overburden: o, .. } = *parameters;
        let mass = parameters.density * h * b * parameters.width;
        let weight = mass * parameters.gravity;
        let (hinge_height, effective_mass, participation, support_weights, end) = match mechanism {
            Mechanism::Parapet => (h, 4.0 / 3.0 * mass, 0.75, [1.0, 0.0], h / 2.0),
            Mechanism::VerticalSpanning => {
                let h1 = parameters.hinge_ratio * h;
                // w_b = (2h − h₁)/(3h), w_t = (h + h₁)/(3h)
                let weights = [(2.0 * h - h1) / (3.0 * h), (h + h1) / (3.0 * h)];
                (h1, 2.0 / 3.0 * mass, 1.5, weights, h1)
            }
        };
        let strength_with = |c: f64| match mechanism {
            // F₀ = (W + O) b/h − (2/h) O c
            Mechanism::Parapet => ((weight + o) * b - 2.0 * o * c) / h,
            // F₀ = (2/h₁)(W + O) b + O (b + 2c)/h₂
            Mechanism::VerticalSpanning => {
                2.0 / hinge_height * (weight + o) * b + o * (b + 2.0 * c) / (h - hinge_height)
            }
        };
        let geometric_stiffness = match mechanism {
            // k₀ = 2 (W + 2O)/h
            Mechanism::Parapet => 2.0 * (weight + 2.0 * o) / h,
            // k₀ = 2 (W + O)/h₁ + 2 O/h₂
            Mechanism::VerticalSpanning => 2.0 * (weight + o) / hinge_height + 2.0 * o / (h - hinge_height),
        };
        let c = parameters.overburden_eccentricity;
        let eccentricity = match parameters.eccentricity_mode {
            EccentricityMode::FixedToWall => Sides { positive: c, negative: -c },
            EccentricityMode::FollowsPivot => Sides { positive: c, negative: c },
        };
        let strength = eccentricity.map(strength_with);
        let contact_moments = eccentricity.map(|c| match mechanism {
            Mechanism::Parapet => 0.0,
            Mechanism::VerticalSpanning => 0.5 * (weight + o) * b - o * c,
        });
        for (side, force) in [("u > 0", strength.positive), ("u < 0", strength.negative)] {
            if force.is_nan() || force <= 0.0 {
                return Err(ParameterError::NoStrength { side, force, eccentricity: c, overburden: o });
            }
        }
        let instability = strength.map(|force| force / geometric_stiffness);
        Ok(Self {
            mechanism,
            height: h,
            hinge_height,
            slenderness: (b / hinge_height).atan(),
            weight,
            overburden: o,
            mass,
            effective_mass,
            participation,
            strength,
            geometric_stiffness,
            instability,
            landing: instability.map(|u_ins| end.max(u_ins)),
            departure: instability.map(|u_ins| (end / 2.0).max(u_ins)),
            contact_moments,
            support_weights,
        })
    }

    /// Returns the couple of the contacts where the wall alone bears the force F on the side of `sign`, from
    /// F at u = 0 \[N\]: [M̄ + F/F₀ (M₊ + M₋)/2]/h with M̄ = (M₊ − M₋)/2 of the contact moments \[N\].
    pub(super) fn contact_couple(&self, force: f64, sign: f64) -> f64 {
        let Sides { positive, negative } = self.contact_moments;
        0.5 * (positive - negative + (positive + negative) * force / self.strength.of(sign)) / self.height
    }

    /// Returns whether the couple of the contacts grows with the force at different rates on the two sides.
    pub(super) fn has_bent_couple(&self) -> bool {
        self.mechanism == Mechanism::VerticalSpanning && self.strength.positive != self.strength.negative
    }

    /// Returns the height of the hinge of a strip wall \[m\]; a parapet has none.
    pub fn hinge(&self) -> Option<f64> {
        (self.mechanism == Mechanism::VerticalSpanning).then_some(self.hinge_height)
    }
}
