//! A wall and the method that moves it.

use std::fmt;

use oscillator::Oscillator;

use crate::choices::Solver;
use crate::wall::{BranchDamping, ParameterError, Parameters, Wall};

use super::secant::SecantBranch;
use super::tolerances::Tolerances;

/// Part of the tolerance for the terms that a Taylor step leaves out. A run of 10⁴ steps then stays within
/// it.
const LOCAL_SHARE: f64 = 1e-4;

/// Pieces of motion in one step: those of a usual computer in half a second.
const MOST_PIECES: u64 = 200_000;
/// Steps of Newmark in one step. They cost a tenth of other pieces.
const MOST_NEWMARK_STEPS: u64 = 2_000_000;

/// How the motion between events is found.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Closed form on each branch.
    Exact,
    /// Closed form on the elastic branch, Taylor series elsewhere and for full rotations.
    Adaptive {
        /// Largest error of u/`u_ins` to aim at \[-\].
        tolerance: f64,
    },
    /// Newmark linear acceleration.
    Newmark {
        /// Step \[s\].
        step: f64,
    },
}

impl fmt::Display for Method {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact => formatter.write_str("exact"),
            Self::Adaptive { tolerance } => write!(formatter, "adaptive, tolerance {tolerance:e}"),
            Self::Newmark { step } => write!(formatter, "newmark, step {step} s"),
        }
    }
}

impl Method {
    /// Returns the method that the parameters ask for; `tolerance` is the tighter of theirs and the
    /// importer's.
    ///
    /// # Errors
    /// [`ParameterError::NotExact`] where the exact solver is asked for damping that varies on a branch.
    pub fn new(parameters: &Parameters, wall: &Wall, tolerance: f64) -> Result<Self, ParameterError> {
        let exact = wall.has_closed_form();
        match parameters.solver {
            Solver::Automatic | Solver::Exact if exact => Ok(Self::Exact),
            Solver::Exact => Err(ParameterError::NotExact { model: parameters.damping_model.name() }),
            Solver::Automatic | Solver::Adaptive => Ok(Self::Adaptive { tolerance }),
            Solver::Newmark => Ok(Self::Newmark { step: parameters.newmark_step }),
        }
    }
}

/// A wall and the method that moves it, with what they prepare once.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub(super) wall: Wall,
    pub(super) method: Method,
    pub(super) oscillators: Vec<Oscillator>,
    /// Branches with secant damping.
    pub(super) secants: Vec<Option<SecantBranch>>,
    pub(super) tolerances: Tolerances,
    pub(super) rest_band: [f64; 2],
    pub(super) rest_speed: f64,
}

impl Motion {
    /// Prepares the motion of the wall and by the method that the parameters ask for. `tolerance` is theirs
    /// or a tighter one.
    ///
    /// # Errors
    /// [`ParameterError`], of [`Wall::new`] or [`Method::new`].
    pub fn of(parameters: &Parameters, tolerance: f64) -> Result<Self, ParameterError> {
        let wall = Wall::new(parameters)?;
        let method = Method::new(parameters, &wall, tolerance)?;
        Ok(Self::new(wall, method))
    }

    /// Pieces of motion that one step may have.
    pub(crate) fn most_pieces(&self) -> u64 {
        if let Method::Newmark { .. } = self.method { MOST_NEWMARK_STEPS } else { MOST_PIECES }
    }

    /// Whether the method takes the motion on a branch in closed form.
    #[inline]
    pub(super) fn takes_closed_form(&self, branch: usize) -> bool {
        match self.method {
            Method::Exact => true,
            Method::Adaptive { .. } => {
                let linear = self.wall.rotations().is_none() && self.secants[branch].is_none();
                linear && self.wall.branches()[branch].stiffness > 0.0
            }
            Method::Newmark { .. } => false,
        }
    }

    /// Prepares the motion of a wall.
    ///
    /// # Panics
    /// If a wall in full rotations is to move by another method than the adaptive one.
    pub fn new(wall: Wall, method: Method) -> Self {
        let adaptive = matches!(method, Method::Adaptive { .. });
        assert!(adaptive || wall.rotations().is_none(), "full rotations need the adaptive method");
        let constant = |damping| match damping {
            BranchDamping::Constant(c) => c,
            // unused: a curved branch has no closed form
            BranchDamping::SecantRatio(_) | BranchDamping::SecantStiffness(_) => 0.0,
        };
        let oscillators =
            wall.branches().iter().map(|b| Oscillator::new(constant(b.damping), b.stiffness)).collect();
        let fully = wall.rotations().is_some();
        let secant = |branch| if fully { None } else { SecantBranch::new(branch) };
        let secants = wall.branches().iter().map(secant).collect();
        let local = match method {
            Method::Adaptive { tolerance } => LOCAL_SHARE * tolerance * wall.displacement_scale(),
            _ => 0.0,
        };
        let tolerances = Tolerances { displacement: local, velocity: local * wall.rocking_rate() };
        let (rest_band, rest_speed) = (wall.rest_band(), wall.rest_speed());
        Self { wall, method, oscillators, secants, tolerances, rest_band, rest_speed }
    }

    /// The wall.
    pub fn wall(&self) -> &Wall {
        &self.wall
    }

    /// The method.
    pub fn method(&self) -> &Method {
        &self.method
    }
}
