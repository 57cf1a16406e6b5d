//! What a user gives: one field per parameter of the model description.

use std::sync::Arc;

use super::bar::{Bar, TiePart};
use super::error::ParameterError;
use super::given::COMPUTED;
use super::part::Load;
use super::profile::Profile;
use super::ratio::Ratio;
use super::sides::Sides;
use super::tie_numbers::TieNumbers;
use crate::choices::{
    DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, RestitutionSource, Rocking, Softening,
    Solver, TieSide, start_values,
};

/// The parameters of a wall and of its solution, in SI units, named as in `modelDescription.xml`.
///
/// This is where the scene file and the FMI variables meet. The limits of one parameter come from the
/// description and are checked where it is set; relations between parameters are checked by
/// [`Wall::new`](super::Wall::new) and [`Method::new`](crate::solver::Method::new).
///
/// A new parameter is an entry in the description and a field here; start value, getter and setter are
/// generated.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each field is documented by the variable of the same name")]
pub struct Parameters {
    pub mechanism: Mechanism,
    pub height: f64,
    pub thickness: f64,
    pub width: f64,
    pub density: f64,
    pub gravity: f64,
    pub hinge_ratio: f64,
    pub overburden: f64,
    pub overburden_eccentricity: f64,
    pub eccentricity_mode: EccentricityMode,
    pub force_law: ForceLaw,
    pub a1: f64,
    pub a3: f64,
    pub d1: f64,
    pub softening: Softening,
    pub damping_model: DampingModel,
    pub xi: f64,
    pub c_bar: f64,
    pub impact: Impact,
    pub restitution_source: RestitutionSource,
    pub restitution: f64,
    pub rocking: Rocking,
    pub u_start: f64,
    pub u_dot_start: f64,
    pub solver: Solver,
    pub tolerance: f64,
    pub newmark_step: f64,
    pub tie_height: f64,
    pub tie_stiffness: f64,
    pub tie_slack: f64,
    pub tie_strength: f64,
    pub tie_ultimate: f64,
    pub tie_side: TieSide,
    pub body_mass: f64,
    pub centroid_height: f64,
    pub inertia: f64,
    pub arm: f64,
    pub arm_inner: f64,
    pub load_force: f64,
    pub load_height: f64,
    pub load_arm: f64,
    pub load_mass: f64,
    pub load_mass_height: f64,
    pub load_inertia: f64,
    pub thrust: f64,
    pub thrust_height: f64,
    /// A wall of parts, in place of the rectangle: [`Parameters::set_profile`]. Only scenes carry it.
    pub profile: Option<Arc<Profile>>,
    /// The loads of a body that is given by its integrals, as they are stated; the parameters `load_…` and
    /// `thrust…` have their sums. Only scenes carry it.
    pub loads: Option<Arc<[Load]>>,
    /// Small or full rotations. Only scenes carry it, and FMUs of a scene.
    pub kinematics: Kinematics,
    /// Corners `[u/u_ins, F/F0]` of a multilinear law without the origin, u rising. Those with u < 0 are of
    /// that side; without any, both sides have the same fractions. Replaces `force_law`, `a1`, `a3`, `d1` and
    /// `softening`. Only scenes carry it.
    pub multilinear: Option<Arc<[[f64; 2]]>>,
    /// The bar of the tie, which [`Parameters::apply_bars`] turns into the tie's own numbers. Only scenes
    /// carry it.
    pub bar: Option<Bar>,
    /// The ties after the first, which the parameters `tie_…` are. Only scenes carry them.
    pub further_ties: Arc<[TieNumbers]>,
    /// a₃ of each side in place of `a3`. No file carries it: a check sets it for hinges that are set back.
    pub a3_of_sides: Option<Sides>,
}

impl Default for Parameters {
    /// The start values of the model description.
    fn default() -> Self {
        start_values!(Self {
            profile: None,
            loads: None,
            kinematics: Kinematics::Linear,
            multilinear: None,
            bar: None,
            further_ties: Arc::default(),
            a3_of_sides: None
        })
    }
}

impl Parameters {
    /// Returns a ratio: a number from 0 on, or [`COMPUTED`].
    pub fn ratio(&self, ratio: Ratio) -> f64 {
        match ratio {
            Ratio::Xi => self.xi,
            Ratio::CBar => self.c_bar,
        }
    }

    pub(super) fn ratio_mut(&mut self, ratio: Ratio) -> &mut f64 {
        match ratio {
            Ratio::Xi => &mut self.xi,
            Ratio::CBar => &mut self.c_bar,
        }
    }

    /// Sets every ratio to [`COMPUTED`].
    pub fn leave_out_ratios(&mut self) {
        for ratio in Ratio::ALL {
            *self.ratio_mut(ratio) = COMPUTED;
        }
    }

    /// Returns whether the wall is a rectangle, neither of parts nor given by its integrals.
    pub fn is_rectangle(&self) -> bool {
        self.profile.is_none() && self.mechanism != Mechanism::RigidBody
    }

    /// Makes the wall one of parts. Its height and its thickness at the base are theirs from there on; width
    /// and density are those of the lowest part. One prism without openings and loads is a rectangle.
    pub fn set_profile(&mut self, profile: Profile) {
        [self.height, self.thickness, self.width, self.density] = profile.as_rectangle();
        self.profile = (!profile.is_rectangle()).then(|| Arc::new(profile));
    }

    /// Returns the ties: the first, which the parameters `tie_…` and the bar are, and the further ones. Their
    /// stiffness may be 0.
    pub fn ties(&self) -> impl Iterator<Item = TieNumbers> {
        let first = TieNumbers {
            height: self.tie_height,
            stiffness: self.tie_stiffness,
            slack: self.tie_slack,
            strength: self.tie_strength,
            ultimate: self.tie_ultimate,
            side: self.tie_side,
            bar: self.bar,
        };
        std::iter::once(first).chain(self.further_ties.iter().copied())
    }

    /// Returns which part of the first tie gives way first; `None` for one that is given by its own numbers.
    pub fn weaker_part(&self) -> Option<TiePart> {
        self.ties().next()?.weaker_part(self.width)
    }

    /// Replaces the ties. Without one the first has no stiffness.
    pub fn set_ties(&mut self, ties: &[TieNumbers]) {
        let Some((tie, further)) = ties.split_first() else {
            (self.tie_stiffness, self.bar, self.further_ties) = (0.0, None, Arc::default());
            return;
        };
        self.tie_height = tie.height;
        self.tie_stiffness = tie.stiffness;
        self.tie_slack = tie.slack;
        self.tie_strength = tie.strength;
        self.tie_ultimate = tie.ultimate;
        self.tie_side = tie.side;
        self.bar = tie.bar;
        self.further_ties = further.into();
    }

    /// Returns the wall with this tie alone.
    #[must_use]
    pub fn tied_by(&self, tie: TieNumbers) -> Self {
        let mut alone = self.clone();
        alone.set_ties(&[tie]);
        alone
    }

    /// Gives each tie the stiffness, strength and ultimate elongation of its bar; leaves those without a bar
    /// as they are.
    ///
    /// # Errors
    /// Those of [`Bar::tie`].
    pub fn apply_bars(&mut self) -> Result<(), ParameterError> {
        let ties = self.ties().map(|tie| tie.with_bar(self.width)).collect::<Result<Vec<_>, _>>()?;
        self.set_ties(&ties);
        Ok(())
    }
}

/// Small or full rotations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kinematics {
    /// Small rotations, Eq. (12).
    #[default]
    Linear,
    /// Full rotations.
    Trigonometric,
}

impl Kinematics {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Linear, Self::Trigonometric];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Trigonometric => "trigonometric",
        }
    }
}
