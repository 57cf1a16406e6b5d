//! Free rocking of a rigid wall in small and in full rotations.
//!
//! Displacements are fractions of the unstable equilibrium: u/`u_ins` for small rotations, θ/`θ_ins` for full
//! ones.
//!
//! ```
//! use rocking_wall::wall::Parameters;
//! use run::rotations::period;
//!
//! let period = period(&Parameters { height: 4.0, thickness: 0.4, ..Parameters::default() }, 0.9)?;
//! assert!((period.ratio() - 0.9975).abs() < 1e-3);
//! # Ok::<(), run::rotations::RotationsError>(())
//! ```

use rocking_wall::solver::{Memo, Motion, SolverError, State};
use rocking_wall::variables::{DampingModel, EccentricityMode, ForceLaw, Impact, Solver};
use rocking_wall::wall::{Kinematics, ParameterError, Parameters, Support, Wall, equivalence};

use crate::bisection::first_true;
use crate::free_motion::advance;

/// Tolerance of full rotations here.
const TOLERANCE: f64 = 1e-12;
/// Halvings that locate an impact: 64 exhaust a double.
const HALVINGS: u32 = 64;
/// Most output steps of a history.
const MOST_STEPS: usize = 10_000_000;

/// Default slenderness angles at which the period is compared \[rad\].
pub const SLENDERNESS: [f64; 15] =
    [0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2, 0.22, 0.24, 0.26, 0.28, 0.3];

/// Why a wall cannot be compared in both kinematics.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum RotationsError {
    /// The parameters make no rigid wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A run failed.
    #[error("{name}: {source}")]
    Run { name: String, source: SolverError },
}

/// A free motion in fractions of the unstable equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Displacement at each output step, the start included \[-\].
    pub history: Vec<f64>,
    /// Times of the impacts \[s\].
    pub impacts: Vec<f64>,
    /// Largest |displacement| of each half cycle, the start first \[-\].
    pub amplitudes: Vec<f64>,
}

/// Periods of free rocking from one rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period {
    /// α or α₁ \[rad\].
    pub slenderness: f64,
    /// θ₀/α \[-\].
    pub start: f64,
    /// Period of Eq. (1) \[s\].
    pub linear: f64,
    /// Period of full rotations \[s\].
    pub trigonometric: f64,
    /// Period of Eq. (5), for a parapet without overburden \[s\].
    pub housner: Option<f64>,
}

impl Period {
    /// Returns the period of Eq. (1) over that of full rotations \[-\].
    pub fn ratio(&self) -> f64 {
        self.linear / self.trigonometric
    }

    /// Returns the period of Eq. (1) over that of Eq. (5), which is √cos α \[-\]: Figure 3.
    pub fn over_housner(&self) -> Option<f64> {
        self.housner.map(|housner| self.linear / housner)
    }
}

/// Computes four times the time to the first impact of a wall released at rest from the fraction `start` of
/// its unstable equilibrium on the side u > 0: its period, where both sides are alike.
///
/// # Errors
/// [`RotationsError`] if the parameters make no rigid wall or a run fails.
pub fn period(parameters: &Parameters, start: f64) -> Result<Period, RotationsError> {
    let [linear, trigonometric] = both(parameters, |release| release.first_impact(start))?;
    let wall = Wall::new(&rigid(parameters, Kinematics::Linear))?;
    let body = wall.body();
    let plain = body.is_rectangle && !body.is_strip() && body.overburden == 0.0;
    let housner = plain.then(|| {
        // R = h/(2 cos α), p = √(3g/(4R))
        let radius = 0.5 * body.height / body.slenderness.positive.cos();
        let frequency = (0.75 * parameters.gravity / radius).sqrt();
        equivalence::housner_period(frequency, start)
    });
    let (linear, trigonometric) = (4.0 * linear, 4.0 * trigonometric);
    Ok(Period { slenderness: body.slenderness.positive, start, linear, trigonometric, housner })
}

/// Returns the rigid wall that is released.
fn rigid(parameters: &Parameters, kinematics: Kinematics) -> Parameters {
    Parameters {
        kinematics,
        force_law: ForceLaw::RigidLinear,
        multilinear: None,
        a3: 1.0,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        // both sides are alike, so that a quarter of the motion gives the period
        eccentricity_mode: EccentricityMode::FollowsPivot,
        solver: Solver::Automatic,
        u_start: 0.0,
        u_dot_start: 0.0,
        ..parameters.clone()
    }
}

/// Runs a wall in small and in full rotations.
///
/// # Errors
/// [`RotationsError`] if the parameters make no rigid wall or a run fails.
pub fn both<T>(
    parameters: &Parameters,
    run: impl Fn(&Release) -> Result<T, SolverError>,
) -> Result<[T; 2], RotationsError> {
    let one = |kinematics: Kinematics| {
        let failed =
            |source| RotationsError::Run { name: format!("{} rotations", kinematics.name()), source };
        let motion = Motion::of(&rigid(parameters, kinematics), TOLERANCE)?;
        run(&Release { motion }).map_err(failed)
    };
    Ok([one(Kinematics::Linear)?, one(Kinematics::Trigonometric)?])
}

/// A rigid wall to release.
#[derive(Debug)]
pub struct Release {
    motion: Motion,
}

impl Release {
    /// Returns the displacement at a fraction of the unstable equilibrium \[m\].
    fn displacement(&self, fraction: f64) -> f64 {
        let wall = self.motion.wall();
        let u_ins = wall.body().instability.positive;
        wall.rotations().map_or(fraction * u_ins, |full| full.displacement(fraction * full.rotation(u_ins)))
    }

    fn fraction(&self, displacement: f64) -> f64 {
        let wall = self.motion.wall();
        let u_ins = wall.body().instability.positive;
        wall.rotations()
            .map_or(displacement / u_ins, |full| full.rotation(displacement) / full.rotation(u_ins))
    }

    fn released(&self, start: f64) -> State {
        self.motion.start(self.displacement(start), 0.0, Support::default())
    }

    /// Advances `state` by `duration` \[s\]; returns the number of impacts.
    fn advance(&self, state: &mut State, duration: f64) -> Result<u64, SolverError> {
        Ok(advance(&self.motion, state, duration, &mut Memo::default())?.work.impacts)
    }

    /// Returns the time from `state` to the first impact, which comes within `longest` \[s\].
    fn time_to_impact(&self, state: State, longest: f64) -> Result<f64, SolverError> {
        first_true([0.0, longest], HALVINGS, |time| Ok(self.advance(&mut state.clone(), time)? > 0))
    }

    fn first_impact(&self, start: f64) -> Result<f64, SolverError> {
        // the time of small rotations is a quarter of it, however slow they are near the equilibrium
        let rate = self.motion.wall().rocking_rate();
        let longest = 4.0 * (1.0 / (1.0 - start)).acosh() / rate;
        self.time_to_impact(self.released(start), longest)
    }

    /// Releases the wall at rest from a fraction of its unstable equilibrium and follows it over `duration`,
    /// in steps of `step` \[s\].
    ///
    /// # Errors
    /// [`SolverError`] if the motion cannot be followed.
    pub fn run(&self, start: f64, duration: f64, step: f64) -> Result<FreeMotion, SolverError> {
        let mut state = self.released(start);
        let mut motion = FreeMotion { history: vec![start], impacts: Vec::new(), amplitudes: Vec::new() };
        let count = (duration / step).round().clamp(1.0, MOST_STEPS as f64);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 1e7")]
        for index in 0..count as usize {
            let before = state;
            let time = index as f64 * step;
            if self.advance(&mut state, step)? > 0 {
                motion.impacts.push(time + self.time_to_impact(before, step)?);
                motion.amplitudes.push(self.fraction(before.peaks.largest()).abs());
                // the next half cycle has its own peaks
                state.peaks = self.motion.start(state.displacement, 0.0, Support::default()).peaks;
            }
            motion.history.push(self.fraction(state.displacement));
        }
        Ok(motion)
    }
}
