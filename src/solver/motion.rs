//! A wall and the method that moves it.

use std::fmt;

use oscillator::Oscillator;

use crate::choices::Solver;
use crate::wall::{Branch, Choice, ParameterError, Parameters, TieMemory, Wall};

use super::secant::Secant;
use super::tolerances::Tolerances;

/// Share of the tolerance that the truncation of one Taylor step may use. A run of 10⁴ steps then stays
/// within the tolerance.
const LOCAL_SHARE: f64 = 1e-4;

/// Most pieces of motion in one step. An ordinary computer evaluates them in about half a second.
const MOST_PIECES: u64 = 200_000;
/// Bound on Newmark sub-steps per step; one costs a tenth of a closed-form piece.
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
    /// [`ParameterError::Conflict`] where the exact solver is asked for damping that varies on a branch.
    pub fn new(parameters: &Parameters, wall: &Wall, tolerance: f64) -> Result<Self, ParameterError> {
        let exact = wall.has_closed_form();
        match parameters.solver {
            Solver::Automatic | Solver::Exact if exact => Ok(Self::Exact),
            Solver::Exact => Err(ParameterError::conflict(
                [
                    Choice::new("solver", "exact"),
                    Choice::new("damping_model", parameters.damping_model.name()),
                ],
                "solver = automatic or adaptive: exact needs damping that is constant on each branch",
            )),
            Solver::Automatic | Solver::Adaptive => Ok(Self::Adaptive { tolerance }),
            Solver::Newmark => Ok(Self::Newmark { step: parameters.newmark_step }),
        }
    }
}

/// A wall and the method that moves it, with the quantities that are computed once from both.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub(super) wall: Wall,
    pub(super) method: Method,
    pub(super) oscillators: Vec<Oscillator>,
    /// Branches with secant damping.
    pub(super) secants: Vec<Option<Secant>>,
    pub(super) tolerances: Tolerances,
    pub(super) rest_band: [f64; 2],
    pub(super) rest_speed: f64,
}

impl Motion {
    /// Prepares the motion that the parameters ask for: their wall, moved by their method. `tolerance` is
    /// that of the parameters or a tighter one.
    ///
    /// # Errors
    /// [`ParameterError`], of [`Wall::new`] or [`Method::new`].
    pub fn of(parameters: &Parameters, tolerance: f64) -> Result<Self, ParameterError> {
        let wall = Wall::new(parameters)?;
        let method = Method::new(parameters, &wall, tolerance)?;
        Ok(Self::new(wall, method))
    }

    /// Returns the most pieces of motion that one step may have.
    pub(crate) fn most_pieces(&self) -> u64 {
        if let Method::Newmark { .. } = self.method { MOST_NEWMARK_STEPS } else { MOST_PIECES }
    }

    /// Returns whether the method computes the motion on a branch in closed form.
    #[inline]
    pub(super) fn takes_closed_form(&self, branch: usize) -> bool {
        match self.method {
            Method::Exact => true,
            Method::Adaptive { .. } => self.wall.branches()[branch].is_elastic(),
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
        // a branch with varying damping has no closed form and does not use its oscillator
        let constant = |branch: &Branch| branch.damping.constant().unwrap_or(0.0);
        let oscillators = wall.branches().iter().map(|b| Oscillator::new(constant(b), b.stiffness)).collect();
        let fully = wall.rotations().is_some();
        let secant = |branch| if fully { None } else { Secant::new(branch) };
        let secants = wall.branches().iter().map(secant).collect();
        let local = match method {
            Method::Adaptive { tolerance } => LOCAL_SHARE * tolerance * wall.displacement_scale(),
            _ => 0.0,
        };
        let tolerances = Tolerances { displacement: local, velocity: local * wall.rocking_rate() };
        let (rest_band, rest_speed) = (wall.rest_band(), wall.rest_speed());
        Self { wall, method, oscillators, secants, tolerances, rest_band, rest_speed }
    }

    /// Returns the motion of the wall with its ties as they are with a memory.
    #[must_use]
    pub fn with_tie_memory(&self, memory: TieMemory) -> Self {
        Self::new(self.wall.clone().with_tie_memory(memory), self.method.clone())
    }

    /// Returns the oscillator of each branch with constant damping.
    pub fn oscillators(&self) -> &[Oscillator] {
        &self.oscillators
    }

    /// Returns the secant damping law of each branch; `None` where its damping is constant.
    pub fn secants(&self) -> &[Option<Secant>] {
        &self.secants
    }

    /// Returns the largest truncation error of one Taylor series.
    pub fn tolerances(&self) -> Tolerances {
        self.tolerances
    }

    /// Returns the lower and upper forcing between which a wall at rest stays at rest \[m/s²\].
    pub fn rest_band(&self) -> [f64; 2] {
        self.rest_band
    }

    /// Returns the |u̇| after an impact below which a wall that can rest comes to rest \[m/s\].
    pub fn rest_speed(&self) -> f64 {
        self.rest_speed
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The adaptive method follows the elastic branch alone in closed form, though others rise too.
    #[test]
    fn the_elastic_branch_has_a_closed_form() {
        let multilinear = Some([[0.05, 0.5], [0.1, 0.9], [1.0, 0.0]].into());
        let wall = Wall::new(&Parameters { multilinear, ..Parameters::default() }).unwrap();
        let exact = Motion::new(wall.clone(), Method::Exact);
        let adaptive = Motion::new(wall, Method::Adaptive { tolerance: 1e-8 });
        let elastic = exact.wall().branch_of(0.0, 1.0);
        for (index, branch) in exact.wall().branches().iter().enumerate() {
            assert!(exact.takes_closed_form(index));
            assert_eq!(adaptive.takes_closed_form(index), index == elastic, "{branch:?}");
        }
        assert!(exact.wall().branches()[elastic + 1].stiffness > 0.0);
    }
}
