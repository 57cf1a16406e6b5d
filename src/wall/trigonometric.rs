//! Full rotations: Housner's block and the two-body strip, the check on the small rotations of Eq. (12).
//!
//! # Kinematics
//! While the wall leans towards +x the lower body turns by θ₁ about its toe (b/2, 0) and carries the hinge B
//! at its far corner (−b/2, h₁). The upper body turns back by θ₂ about B; its corner (b/2, h) slides up along
//! the top support. With the diagonals Dᵢ² = hᵢ² + b² and ψᵢ = θᵢ − αᵢ, tan αᵢ = b/hᵢ, measured from the toe,
//!
//! ```text
//! B = D₁ (sin ψ₁, cos ψ₁)        top corner = B + D₂ (−sin ψ₂, cos ψ₂)
//! ```
//!
//! The top corner stays above the toe: D₁ sin ψ₁ = D₂ sin ψ₂ = s. So s, the place of the hinge, is a
//! coordinate of both bodies, both centres of mass lie at s/2, and u = s + b is the displacement of the
//! hinge. A parapet is the lower body alone with h₁ = h; its centre is at s/2 and moves by u = (s + b)/2.
//! Hence s = κ u − b with κ = 2 (parapet), 1 (strip).
//!
//! # Lagrange
//! With cᵢ = √(Dᵢ² − s²) and tᵢ = s/cᵢ = tan ψᵢ the heights are c₁/2 and c₁ + c₂/2, the angular velocities
//! ṡ/cᵢ, and
//!
//! ```text
//! T = ½ ṡ² [m₁ (1 + t₁²)/3 + m₂ (1/4 + (t₁ + t₂/2)² + (1 + t₂²)/12)]
//! V = W [m₁ c₁/2 + m₂ (c₁ + c₂/2)]/m + O y   y: height of the load point on the wall, linear in c₁, c₂, s
//! Q = −½ m a_g                                  of the supports' acceleration, exactly
//! ```
//!
//! Divided by `m_eff` on the scale of Eq. (12) (a strip's is twice Lagrange's), with p = −λ `a_g`:
//!
//! ```text
//! μ ü + ½ μ̇ u̇ + f = p
//! μ = (m₁/m)(1 + t₁²) + (m₂/m)(1 + 3 (t₁ + t₂/2)² + t₂²/4)
//! f = g₀ − g₁ t₁ − g₂ t₂ = 2 (dV/ds)/m_eff
//! ```
//!
//! A parapet has μ = 1/cos²ψ: with u̇ = ½ D cos ψ θ̇ this is Housner's θ̈ = −p² (sin(α − θ) + (`a_g`/g) cos(α
//! − θ)). At u = 0 f is F₀/`m_eff` of Table 2. For small rotations μ → 1 but for b²/h², which the paper
//! drops: 1 + b²/h² for a parapet, and 1 + 4 b²/h₁² for a strip with its hinge at mid-height.
//!
//! # What is supported
//! Any hinge height, overburden with either eccentricity mode (a dead load on a point of the top section),
//! both directions of rocking (u < 0 is the mirror image), restitution at u = 0, where u̇ is proportional to
//! θ̇. The sum of the reactions follows from ü exactly; their split between the supports of a strip is that
//! of the small rotations. Supports that move differently, and drift, enter with their weights for small
//! rotations.

use crate::choices::{DampingModel, EccentricityMode, ForceLaw, Mechanism, Solver};

use super::error::{Choice, ParameterError};
use super::mechanism::Body;
use super::parameters::Parameters;
use super::sides::Sides;

/// A wall in full rotations; the equation and its letters are those of its module.
#[derive(Clone, Debug, PartialEq)]
pub struct FullRotations {
    /// b \[m\].
    pub(crate) thickness: f64,
    /// κ = ds/du.
    pub(crate) lever: f64,
    /// Number of bodies, 1 or 2.
    pub(crate) bodies: usize,
    /// Dᵢ² \[m²\].
    pub(crate) diagonals: [f64; 2],
    /// mᵢ/m.
    pub(crate) masses: [f64; 2],
    /// g₀, g₁, g₂ for u > 0 and for u < 0 \[m/s²\].
    forces: [[f64; 3]; 2],
    /// min(h₁, h₂), or h \[m\].
    shorter: f64,
}

/// Halvings that find the unstable equilibrium: 64 exhaust a double.
const HALVINGS: u32 = 128;

impl FullRotations {
    /// # Errors
    /// [`ParameterError::Conflict`] with what the model does not know, [`ParameterError::NoFall`].
    pub(super) fn new(parameters: &Parameters, body: &Body) -> Result<Self, ParameterError> {
        check(parameters, body)?;
        let (b, h, h1) = (parameters.thickness, body.height, body.hinge_height);
        let (lever, bodies, h2) = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody => (2.0, 1, h),
            Mechanism::VerticalSpanning => (1.0, 2, h - h1),
        };
        let masses = if bodies == 1 { [1.0, 0.0] } else { [h1 / h, h2 / h] };
        let c = parameters.overburden_eccentricity;
        let mirrored = match parameters.eccentricity_mode {
            EccentricityMode::FixedToWall => -c,
            EccentricityMode::FollowsPivot => c,
        };
        let forces = [c, mirrored].map(|c| forces(b, [h1, h2], masses, body, c));
        let shorter = h1.min(h2);
        let diagonals = [h1, h2].map(|h| h * h + b * b);
        let rotations = Self { thickness: b, lever, bodies, diagonals, masses, forces, shorter };
        for (sign, side) in [(1.0, "u > 0"), (-1.0, "u < 0")] {
            let (u_ins, end) = (rotations.equilibrium(sign), rotations.landing());
            if u_ins.is_nan() || u_ins >= end {
                return Err(ParameterError::NoFall { side, end });
            }
        }
        Ok(rotations)
    }

    /// Displacements of the unstable equilibrium on both sides, which without overburden are `u_ins` of Table
    /// 2 \[m\].
    pub fn instability(&self) -> Sides {
        Sides { positive: self.equilibrium(1.0), negative: self.equilibrium(-1.0) }
    }

    /// Displacement at which the first body lies flat, the end of the fall \[m\].
    pub fn landing(&self) -> f64 {
        (self.shorter + self.thickness) / self.lever
    }

    /// Rotation θ or θ₁ at a displacement, of its sign \[rad\].
    pub fn rotation(&self, displacement: f64) -> f64 {
        let diagonal = self.diagonals[0].sqrt();
        let turn = |s: f64| libm::asin(s / diagonal);
        (turn(self.place(displacement)) - turn(-self.thickness)).copysign(displacement)
    }

    /// Displacement at a rotation θ or θ₁, of its sign \[m\].
    pub fn displacement(&self, rotation: f64) -> f64 {
        let slenderness = libm::asin(self.thickness / self.diagonals[0].sqrt());
        let s = self.diagonals[0].sqrt() * libm::sin(rotation.abs() - slenderness);
        ((s + self.thickness) / self.lever).copysign(rotation)
    }

    /// f, the restoring force over `m_eff`, on the side of `sign` \[m/s²\].
    pub fn restoring(&self, displacement: f64, sign: f64) -> f64 {
        sign * self.force(self.tangents(self.place(displacement)), sign)
    }

    /// ü under the forcing p, on the side of `sign` \[m/s²\].
    pub fn acceleration(&self, displacement: f64, velocity: f64, forcing: f64, sign: f64) -> f64 {
        let t = self.tangents(self.place(displacement));
        // u̇ and p as seen on the positive side
        let [speed, push] = [sign * velocity, sign * forcing];
        // ṫ = (1 + t²) ṡ/c, and c = D/√(1 + t²)
        let rate = |body: usize| {
            let e = 1.0 + t[body] * t[body];
            e * (e / self.diagonals[body]).sqrt() * self.lever * speed
        };
        let [m1, m2] = self.masses;
        let (t1, t2, r1, r2) = (t[0], t[1], rate(0), rate(1));
        let half_mass_rate = m1 * t1 * r1 + m2 * (3.0 * (t1 + 0.5 * t2) * (r1 + 0.5 * r2) + 0.25 * t2 * r2);
        sign * (push - self.force(t, sign) - half_mass_rate * speed) / self.mass(t)
    }

    /// Energy over `m_eff`, ½ μ u̇² + ∫f du from 0 \[m²/s²\]; for a strip twice the physical one, as Eq. (12)
    /// is.
    pub fn energy(&self, displacement: f64, velocity: f64) -> f64 {
        let s = self.place(displacement);
        let [g0, g1, g2] = self.forces_of(displacement);
        // c(s) − c(−b) = (b² − s²)/(c(s) + c(−b)), which does not cancel
        let rise = |body: usize| {
            let [here, there] = [s, self.thickness].map(|s| (self.diagonals[body] - s * s).sqrt());
            (self.thickness - s) * (self.thickness + s) / (here + there)
        };
        let potential = (g0 * (s + self.thickness) + g1 * rise(0) + g2 * rise(1)) / self.lever;
        0.5 * self.mass(self.tangents(s)) * velocity * velocity + potential
    }

    /// g₀, g₁, g₂ of the side of a displacement.
    pub(crate) fn forces_of(&self, sign: f64) -> [f64; 3] {
        self.forces[usize::from(sign < 0.0)]
    }

    /// s \[m\].
    pub(crate) fn place(&self, displacement: f64) -> f64 {
        self.lever * displacement.abs() - self.thickness
    }

    /// t₁ and t₂.
    pub(crate) fn tangents(&self, s: f64) -> [f64; 2] {
        self.diagonals.map(|diagonal| s / (diagonal - s * s).sqrt())
    }

    /// f of the side of `sign`, as if it were u > 0.
    pub(crate) fn force(&self, [t1, t2]: [f64; 2], sign: f64) -> f64 {
        let [g0, g1, g2] = self.forces_of(sign);
        g0 - g1 * t1 - g2 * t2
    }

    /// μ.
    fn mass(&self, [t1, t2]: [f64; 2]) -> f64 {
        let [m1, m2] = self.masses;
        let q = t1 + 0.5 * t2;
        m1 * (1.0 + t1 * t1) + m2 * (1.0 + 3.0 * q * q + 0.25 * t2 * t2)
    }

    /// |u| at which f = 0 on a side; beyond the landing where there is none.
    fn equilibrium(&self, sign: f64) -> f64 {
        let [g0, ..] = self.forces_of(sign);
        if g0 == 0.0 {
            return self.thickness / self.lever;
        }
        let (mut low, mut high) = (0.0, self.landing());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.force(self.tangents(self.place(middle)), sign) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

impl Body {
    /// Takes from full rotations where the wall is unstable, leaves its supports and lies down.
    pub(super) fn turn_fully(&mut self, rotations: &FullRotations) {
        let end = rotations.landing();
        self.instability = rotations.instability();
        self.landing = self.instability.map(|u_ins| end.max(u_ins));
        self.departure = self.instability.map(|u_ins| (end / 2.0).max(u_ins));
    }
}

/// g₀, g₁, g₂ for the load point at the eccentricity `c` towards the side.
fn forces(b: f64, [h1, h2]: [f64; 2], [m1, m2]: [f64; 2], body: &Body, c: f64) -> [f64; 3] {
    let (w, o) = (body.weight, body.overburden);
    // height of the load point: that of the corner on its body's diagonal, and the distance from there along
    // the section
    let (load, sine) = match body.mechanism {
        // y = c₁ − (b/2 + c) sin θ₁,  sin θ₁ = (s h + c₁ b)/D²
        Mechanism::Parapet | Mechanism::RigidBody => {
            let along = (b / 2.0 + c) / (h1 * h1 + b * b);
            ([1.0 - along * b, 0.0], -along * h1)
        }
        // y = c₁ + c₂ − (b/2 − c) sin θ₂,  sin θ₂ = (s h₂ + c₂ b)/D₂²
        Mechanism::VerticalSpanning => {
            let along = (b / 2.0 - c) / (h2 * h2 + b * b);
            ([1.0, 1.0 - along * b], -along * h2)
        }
    };
    // dV/ds, as dcᵢ/ds = −tᵢ
    [o * sine, w * (m1 / 2.0 + m2) + o * load[0], w * m2 / 2.0 + o * load[1]]
        .map(|force| 2.0 * force / body.effective_mass)
}

/// Says what does not go with full rotations, and what to set.
pub(super) fn conflict(name: &'static str, value: &dyn ToString, remedy: &str) -> ParameterError {
    let remedy = format!("{remedy}, or kinematics = linear");
    let choices = [Choice::new("kinematics", "trigonometric"), Choice::new(name, value.to_string())];
    ParameterError::conflict(choices, remedy)
}

/// # Errors
/// [`ParameterError::Conflict`] with a law, a damping or a solver that goes with small rotations only.
fn check(parameters: &Parameters, body: &Body) -> Result<(), ParameterError> {
    if !body.is_rectangle {
        let (name, value) = match parameters.profile {
            Some(_) => ("part", "[...]"),
            None => ("mechanism", parameters.mechanism.name()),
        };
        return Err(conflict(name, &value, "height and thickness of a rectangle in place of it"));
    }
    let law = parameters.multilinear.as_ref().map_or(parameters.force_law.name(), |_| "multilinear");
    let refused = if law != ForceLaw::RigidLinear.name() {
        conflict("force_law", &law, "force_law = rigid_linear")
    } else if parameters.a3 != 1.0 {
        conflict("a3", &parameters.a3, "a3 = 1")
    } else if parameters.damping_model != DampingModel::None {
        let remedy = "damping_model = none and impact = restitution";
        conflict("damping_model", &parameters.damping_model.name(), remedy)
    } else if let solver @ (Solver::Exact | Solver::Newmark) = parameters.solver {
        conflict("solver", &solver.name(), "solver = automatic or adaptive")
    } else {
        return Ok(());
    };
    Err(refused)
}
