//! Full rotations: Housner's block, a body of any shape, and the strip of two bodies.
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
//! # One body of any shape
//! A body of parts and loads turns by θ about its toe, from which a place of it is at the distance d inwards
//! and z upwards. A turn by δθ moves that place by (z cos θ + d sin θ) δθ outwards and by (d cos θ − z sin θ)
//! δθ upwards. By the virtual work of the weights P, the thrusts H and the inertia of the moving masses,
//! those of loads among them,
//!
//! ```text
//! I θ̈ + M₀ cos θ − K sin θ = −a_g (S cos θ + X sin θ)
//! I = ∫(z² + d²) dm     S = ∫z dm     X = ∫d dm     M₀ = Σ P d ∓ Σ H z     K = Σ P z ± Σ H d
//! ```
//!
//! u is the displacement of the centroid of the masonry, at `z_G` and with the arm d = x. With D² = `z_G`² +
//! x² and ψ = θ − α, tan α = x/`z_G`, the centroid is at s = D sin ψ = u − x, so that κ = 1 and b is x. By θ̇
//! = ṡ/c, cos θ = c (`z_G` − x t)/D² and sin θ = c (x + `z_G` t)/D², divided by `m_eff` of Eq. (12):
//!
//! ```text
//! μ ü + ½ μ̇ u̇ + f = p q      μ = I (1 + t²)/(D² m_eff)      f = g₀ − g₁ t
//! g₀ = (M₀ z_G − K x)/(D² m_eff)      g₁ = (M₀ x + K z_G)/(D² m_eff)
//! q = 1 + ρ (t − t(0))      ρ = (X z_G − S x) z_G/(D² S), 0 unless loads move along
//! ```
//!
//! λ `m_eff` q u̇ is the momentum of all moving masses, from which the reaction of the base follows. At u = 0
//! f is F₀/`m_eff`, and u̇ = `z_G` θ̇ about either toe: restitution acts on u̇ as on θ̇.
//!
//! # What is supported
//! Rectangles and bodies of parts; strips of uniform section with any hinge height. Overburden with either
//! eccentricity mode (a dead load on a point of the top section), both directions of rocking (u < 0 is the
//! mirror image), restitution at u = 0. The sum of the reactions follows from ü exactly; their split between
//! the supports of a strip is that of the small rotations. Supports that move differently, and drift, enter
//! with their weights for small rotations.

use oscillator::KinematicState;

use crate::choices::{DampingModel, ForceLaw, Mechanism, Solver};

use super::assembled::total;
use super::error::{Choice, ParameterError};
use super::mechanism::Body;
use super::parameters::Parameters;
use super::points::Point;
use super::profile::Profile;
use super::sides::Sides;
use super::turn::Turn;

/// A wall in full rotations; the equation and its letters are those of its module.
#[derive(Clone, Debug, PartialEq)]
pub struct FullRotations {
    /// As it leans to u > 0.
    positive: Turn,
    /// As it leans to u < 0, seen from there.
    negative: Turn,
}

/// Least arm of the centroid over its height. As the body lies down, D² − s² falls to the square of the arm;
/// a smaller arm leaves only rounding of it.
const LEAST_ARM: f64 = 1e-6;

// what is called from many places of small rotations, too, is cold: the library of an FMU is to be small
impl FullRotations {
    /// # Errors
    /// [`ParameterError::Conflict`] with what the model does not know, [`ParameterError::NoFall`],
    /// [`ParameterError::BeyondToe`].
    pub(super) fn new(parameters: &Parameters, body: &Body) -> Result<Self, ParameterError> {
        check(parameters, body)?;
        let own = |sign: f64| Turn::new(parameters, body, sign);
        let turn = |sign: f64| {
            let turn = own(sign).and_then(|turn| turn.falls(sign));
            // as a body has the numbers of its free side where transverse walls hold the other
            let is_held = !parameters.rocking.allows(sign);
            if is_held && (body.held.is_some() || turn.is_err()) { own(-sign) } else { turn }
        };
        Ok(Self { positive: turn(1.0)?, negative: turn(-1.0)? })
    }

    /// Returns the turn to the side of `sign`.
    pub(crate) fn side(&self, sign: f64) -> &Turn {
        if sign < 0.0 { &self.negative } else { &self.positive }
    }

    /// Returns whether both sides are alike.
    pub(super) fn has_equal_sides(&self) -> bool {
        self.positive == self.negative
    }

    /// Displacements of the unstable equilibrium on both sides, which without overburden are `u_ins` of Table
    /// 2 \[m\].
    pub fn instability(&self) -> Sides {
        Sides::each(|sign| self.side(sign).equilibrium())
    }

    /// Displacement of each side at which the first body lies flat, the end of the fall \[m\].
    pub fn landing(&self) -> Sides {
        Sides::each(|sign| self.side(sign).landing)
    }

    /// Rotation θ or θ₁ at a displacement, of its sign \[rad\].
    pub fn rotation(&self, displacement: f64) -> f64 {
        self.side(displacement).rotation(displacement.abs()).copysign(displacement)
    }

    /// Displacement at a rotation θ or θ₁, of its sign \[m\].
    pub fn displacement(&self, rotation: f64) -> f64 {
        self.side(rotation).displacement(rotation.abs()).copysign(rotation)
    }

    /// f, the restoring force over `m_eff`, on the side of `sign` \[m/s²\].
    pub fn restoring(&self, displacement: f64, sign: f64) -> f64 {
        sign * self.side(sign).restoring(sign * displacement)
    }

    /// ü under the forcing p, on the side of `sign` \[m/s²\].
    pub fn acceleration(&self, displacement: f64, velocity: f64, forcing: f64, sign: f64) -> f64 {
        sign * self.side(sign).acceleration(sign * displacement, sign * velocity, sign * forcing)
    }

    /// Change of ü \[m/s²\] along a change of u, of u̇ and of the forcing p, on the side of `sign`, from a
    /// motion under p.
    #[cold]
    pub(crate) fn acceleration_change(
        &self,
        sign: f64,
        motion: KinematicState,
        forcing: f64,
        change: [f64; 3],
    ) -> f64 {
        let change = change.map(|change| sign * change);
        sign * self.side(sign).acceleration_change(seen(sign, motion), sign * forcing, change)
    }

    /// Change of f along a change of u, on the side of `sign` \[m/s²\].
    #[cold]
    pub(crate) fn restoring_change(&self, sign: f64, displacement: f64, change: f64) -> f64 {
        self.side(sign).restoring_change(sign * displacement, change)
    }

    /// Returns q u̇: λ `m_eff` times this is the momentum of all moving masses along the ground \[m/s\].
    pub(crate) fn carried_velocity(&self, displacement: f64, velocity: f64) -> f64 {
        let turn = self.side(displacement);
        turn.share(turn.tangents(turn.place(displacement.abs()))[0]) * velocity
    }

    /// Returns the time derivative of q u̇ on the side of `sign` \[m/s²\].
    #[cold]
    pub(crate) fn carried(&self, sign: f64, motion: KinematicState) -> f64 {
        sign * self.side(sign).carried(seen(sign, motion))
    }

    /// Change of that along a change of u, of u̇ and of ü \[m/s²\].
    #[cold]
    pub(crate) fn carried_change(&self, sign: f64, motion: KinematicState, change: [f64; 3]) -> f64 {
        let change = change.map(|change| sign * change);
        sign * self.side(sign).carried_change(seen(sign, motion), change)
    }

    /// Bounds the second derivative of what [`carried`](Self::carried) gives between two displacements on the
    /// side of `sign`, from bounds on |u̇| and |ü|: shares of bounds on |ü|, on the jerk and on the second
    /// derivative of ü, and a number \[m/s⁴\].
    #[cold]
    pub(crate) fn carried_curvature(&self, sign: f64, range: [f64; 2], most: [f64; 2]) -> [f64; 4] {
        self.side(sign).carried_curvature(range.map(|u| sign * u), most)
    }

    /// Energy over `m_eff`, ½ μ u̇² + ∫f du from 0 \[m²/s²\]; for a strip twice the physical one, as Eq. (12)
    /// is.
    pub fn energy(&self, displacement: f64, velocity: f64) -> f64 {
        let ahead = if displacement == 0.0 { velocity } else { displacement };
        self.side(ahead).energy(displacement.abs(), velocity)
    }
}

impl Body {
    /// Takes from full rotations where the wall is unstable, leaves its supports and lies down.
    pub(super) fn turn_fully(&mut self, rotations: &FullRotations) {
        let end = rotations.landing();
        self.instability = rotations.instability();
        let later = |end: f64, sign: f64| end.max(self.instability.of(sign));
        self.landing = Sides::each(|sign| later(end.of(sign), sign));
        self.departure = Sides::each(|sign| later(end.of(sign) / 2.0, sign));
    }
}

impl Turn {
    /// # Errors
    /// [`ParameterError::BeyondToe`].
    #[inline(never)]
    fn new(parameters: &Parameters, body: &Body, sign: f64) -> Result<Self, ParameterError> {
        match &parameters.profile {
            Some(profile) => Self::of_parts(parameters, profile, body, sign),
            None => Ok(Self::of_rectangle(parameters, body, sign)),
        }
    }

    /// # Errors
    /// [`ParameterError::NoFall`] where the wall lies flat before it becomes unstable.
    fn falls(self, sign: f64) -> Result<Self, ParameterError> {
        let (u_ins, end) = (self.equilibrium(), self.landing);
        if u_ins.is_nan() || u_ins >= end {
            return Err(ParameterError::NoFall { side: side_name(sign), end });
        }
        Ok(self)
    }

    /// Returns the turn of a rectangle, or of a strip of uniform section.
    fn of_rectangle(parameters: &Parameters, body: &Body, sign: f64) -> Self {
        let (b, h, h1) = (parameters.thickness, body.height, body.hinge_height);
        let (lever, bodies, h2) = if body.is_strip() { (1.0, 2, h - h1) } else { (2.0, 1, h) };
        let masses = if bodies == 1 { [1.0, 0.0] } else { [h1 / h, h2 / h] };
        let c = parameters.eccentricity_of_sides().of(sign);
        Self {
            lever,
            offset: b,
            bodies,
            diagonals: [h1, h2].map(|h| h * h + b * b),
            masses,
            forces: forces(b, [h1, h2], masses, body, c),
            drag: 0.0,
            landing: (h1.min(h2) + b) / lever,
        }
    }

    /// Returns the turn of a body of parts about the toe of a side.
    ///
    /// # Errors
    /// [`ParameterError::BeyondToe`] where u does not describe the fall.
    #[cold]
    fn of_parts(
        parameters: &Parameters,
        profile: &Profile,
        body: &Body,
        sign: f64,
    ) -> Result<Self, ParameterError> {
        let ([outer, inner], h) = (profile.toes(), profile.height());
        let arm = |x: f64| if sign > 0.0 { x - outer } else { inner - x };
        let mut points = profile.masonry([0.0, h], parameters.gravity);
        let own = points.len();
        points.extend(profile.load_points(parameters.gravity));
        let (o, at) = (parameters.overburden, parameters.overburden_on(profile).of(sign));
        points.push(Point { mass: 0.0, weight: o, thrust: 0.0, x: at, z: h });
        let (x, z) = (total(&points[..own], &|p| p.mass * arm(p.x)) / body.mass, body.centroid_height);
        let least = LEAST_ARM * z;
        if x < least {
            return Err(ParameterError::BeyondToe { side: side_name(sign), arm: x, least });
        }
        let squared = x * x + z * z;
        let inertia = total(&points, &|p| p.mass * (p.z * p.z + arm(p.x).powi(2)));
        let moment = total(&points, &|p| p.weight * arm(p.x) - sign * p.thrust * p.z);
        let overturning = total(&points, &|p| p.weight * p.z + sign * p.thrust * arm(p.x));
        // of the masonry, X z_G − S x is 0
        let dragged = total(&points[own..], &|p| p.mass * (arm(p.x) * z - p.z * x));
        let first_moment = total(&points, &|p| p.mass * p.z);
        let scale = squared * body.effective_mass;
        Ok(Self {
            lever: 1.0,
            offset: x,
            bodies: 1,
            diagonals: [squared; 2],
            masses: [inertia / scale, 0.0],
            forces: [(moment * z - overturning * x) / scale, (moment * x + overturning * z) / scale, 0.0],
            drag: dragged * z / (squared * first_moment),
            landing: z + x,
        })
    }
}

/// Returns a motion as it is seen from the side of `sign`.
fn seen(sign: f64, motion: KinematicState) -> KinematicState {
    let KinematicState { displacement, velocity, acceleration } = motion;
    KinematicState {
        displacement: sign * displacement,
        velocity: sign * velocity,
        acceleration: sign * acceleration,
    }
}

fn side_name(sign: f64) -> &'static str {
    if sign > 0.0 { "u > 0" } else { "u < 0" }
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
    if parameters.profile.is_some() && body.is_strip() {
        let remedy = "mechanism = parapet, or height and thickness of a rectangle in place of the parts";
        return Err(conflict("part", &"[...]", remedy));
    }
    if parameters.profile.is_none() && !body.is_rectangle {
        let remedy = "its parts in place of its integrals, which leave out the squares of the thickness";
        return Err(conflict("mechanism", &parameters.mechanism.name(), remedy));
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
