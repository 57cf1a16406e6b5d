//! Error of small rotations: Eq. (1) beside full rotations, Figures 2 and 3 of the paper.
//!
//! Displacements are fractions of the unstable equilibrium: u/`u_ins` for small rotations, θ/`θ_ins` for full
//! ones, so that both start at the same θ₀/α of Eq. (5).
//!
//! ```
//! use evidence::accuracy::linearisation::{figure_2_wall, period};
//! use rocking_wall::variables::Mechanism;
//!
//! let period = period(&figure_2_wall(Mechanism::Parapet), 0.9)?;
//! assert!((period.ratio() - 0.9975).abs() < 1e-3);
//! # Ok::<(), evidence::accuracy::AccuracyError>(())
//! ```

pub(crate) mod page;

use rocking_wall::solver::{Memo, Motion, SolverError, State};
use rocking_wall::variables::{DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, Solver};
use rocking_wall::wall::{Kinematics, Parameters, Support, Wall, equivalence};
use study::free_motion::advance;
use study::halving::begins_at;

use super::AccuracyError;

/// Tolerance of full rotations here.
const TOLERANCE: f64 = 1e-12;
/// Halvings that locate an impact: 64 exhaust a double.
const HALVINGS: u32 = 64;
/// Output step of Figure 2 \[s\].
const STEP: f64 = 0.01;
/// Most output steps of a history.
const MOST_STEPS: usize = 10_000_000;

/// Default slenderness angles at which the period is compared \[rad\].
pub const SLENDERNESS: [f64; 15] =
    [0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16, 0.18, 0.2, 0.22, 0.24, 0.26, 0.28, 0.3];
/// Default initial rotations θ₀/α at which the period is compared; the last is that of Figure 2.
pub const STARTS: [f64; 3] = [0.1, 0.5, 0.9];

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

/// Free motions of one wall, released from one fraction of its unstable equilibrium, in small and in full
/// rotations.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Output step \[s\].
    pub step: f64,
    /// Small rotations, Eq. (1).
    pub linear: FreeMotion,
    /// Full rotations.
    pub trigonometric: FreeMotion,
}

impl Comparison {
    /// Returns the largest difference between the two histories \[-\].
    pub fn largest_difference(&self) -> f64 {
        largest_difference(&self.linear.history, &self.trigonometric.history)
    }

    /// Returns the largest difference between amplitudes of half cycles, which do not depend on phase \[-\].
    pub fn largest_amplitude_difference(&self) -> f64 {
        largest_difference(&self.linear.amplitudes, &self.trigonometric.amplitudes)
    }

    /// Returns the time of an impact in small rotations over that in full ones; `None` where either has
    /// fewer.
    pub fn time_ratio(&self, impact: usize) -> Option<f64> {
        Some(self.linear.impacts.get(impact)? / self.trigonometric.impacts.get(impact)?)
    }
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the walls of Figure 2: b = 0.4 m, h = 4 m, no overburden, e = 0.985 (parapet) or 0.955 (strip,
/// hinge at mid-height).
pub fn figure_2_wall(mechanism: Mechanism) -> Parameters {
    let restitution = match mechanism {
        Mechanism::Parapet => 0.985,
        Mechanism::VerticalSpanning => 0.955,
    };
    Parameters {
        mechanism,
        height: 4.0,
        thickness: 0.4,
        hinge_ratio: 0.5,
        restitution,
        ..Parameters::default()
    }
}

/// Computes Figure 2: the wall released at rest from 0.9 of its unstable equilibrium, over `duration` in
/// steps of `step` \[s\].
///
/// # Errors
/// [`AccuracyError::Run`] if a run fails.
pub fn figure_2(mechanism: Mechanism, duration: f64, step: f64) -> Result<Comparison, AccuracyError> {
    compare(&figure_2_wall(mechanism), 0.9, duration, step)
}

/// Releases a wall at rest from the fraction `start` of its unstable equilibrium and follows it in both
/// kinematics over `duration` in steps of `step` \[s\]. The wall is rigid and has restitution, whatever its
/// force law and damping.
///
/// # Errors
/// [`AccuracyError`] if the parameters make no such wall or a run fails.
pub fn compare(
    parameters: &Parameters,
    start: f64,
    duration: f64,
    step: f64,
) -> Result<Comparison, AccuracyError> {
    let [linear, trigonometric] = both(parameters, |release| release.run(start, duration, step))?;
    Ok(Comparison { step, linear, trigonometric })
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
/// its unstable equilibrium.
///
/// # Errors
/// [`AccuracyError`] if the parameters make no rigid wall or a run fails.
pub fn period(parameters: &Parameters, start: f64) -> Result<Period, AccuracyError> {
    let [linear, trigonometric] = both(parameters, |release| release.first_impact(start))?;
    let wall = Wall::new(&rigid(parameters, Kinematics::Linear))?;
    let body = wall.body();
    let plain = body.mechanism == Mechanism::Parapet && body.overburden == 0.0;
    let housner = plain.then(|| {
        // R = h/(2 cos α), p = √(3g/(4R))
        let radius = 0.5 * body.height / body.slenderness.cos();
        let frequency = (0.75 * parameters.gravity / radius).sqrt();
        equivalence::housner_period(frequency, start)
    });
    let (linear, trigonometric) = (4.0 * linear, 4.0 * trigonometric);
    Ok(Period { slenderness: body.slenderness, start, linear, trigonometric, housner })
}

/// Computes Figure 3: periods at each of `slenderness` \[rad\], which sets the thickness of a wall of 4 m
/// with its hinge at mid-height. Ratios of periods depend only on the slenderness, the hinge ratio and the
/// start.
///
/// # Errors
/// [`AccuracyError`] if a slenderness makes no wall or a run fails.
pub fn figure_3(mechanism: Mechanism, slenderness: &[f64], start: f64) -> Result<Vec<Period>, AccuracyError> {
    let wall = figure_2_wall(mechanism);
    let lower = match mechanism {
        Mechanism::Parapet => wall.height,
        Mechanism::VerticalSpanning => wall.hinge_ratio * wall.height,
    };
    let at =
        |alpha: &f64| period(&Parameters { thickness: lower * libm::tan(*alpha), ..wall.clone() }, start);
    slenderness.iter().map(at).collect()
}

/// Figures 2 and 3 for the wall of one mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct BothRotations {
    /// What tables call the wall.
    pub name: &'static str,
    /// How long Figure 2 follows it \[s\].
    pub duration: f64,
    /// Its coefficient of restitution \[-\].
    pub restitution: f64,
    /// Figure 2.
    pub history: Comparison,
    /// Figure 3: for each of [`STARTS`] one period for each of [`SLENDERNESS`].
    pub periods: Vec<Vec<Period>>,
}

/// Computes Figures 2 and 3 for both mechanisms, the parapet first.
///
/// # Errors
/// [`AccuracyError::Run`] if a run fails.
pub fn both_rotations() -> Result<Vec<BothRotations>, AccuracyError> {
    let mechanisms = [(Mechanism::Parapet, "parapet", 20.0), (Mechanism::VerticalSpanning, "strip", 12.0)];
    let measured = |(mechanism, name, duration)| {
        let periods = STARTS.iter().map(|&start| figure_3(mechanism, &SLENDERNESS, start));
        Ok(BothRotations {
            name,
            duration,
            restitution: figure_2_wall(mechanism).restitution,
            history: figure_2(mechanism, duration, STEP)?,
            periods: periods.collect::<Result<_, _>>()?,
        })
    };
    mechanisms.into_iter().map(measured).collect()
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
fn both<T>(
    parameters: &Parameters,
    run: impl Fn(&Release) -> Result<T, SolverError>,
) -> Result<[T; 2], AccuracyError> {
    let one = |kinematics: Kinematics| {
        let failed = |source| AccuracyError::Run { name: format!("{} rotations", kinematics.name()), source };
        let motion = Motion::of(&rigid(parameters, kinematics), TOLERANCE)?;
        run(&Release { motion }).map_err(failed)
    };
    Ok([one(Kinematics::Linear)?, one(Kinematics::Trigonometric)?])
}

/// A rigid wall to release.
struct Release {
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
        begins_at([0.0, longest], HALVINGS, |time| Ok(self.advance(&mut state.clone(), time)? > 0))
    }

    fn first_impact(&self, start: f64) -> Result<f64, SolverError> {
        // the time of small rotations is a quarter of it, however slow they are near the equilibrium
        let rate = self.motion.wall().rocking_rate();
        let longest = 4.0 * (1.0 / (1.0 - start)).acosh() / rate;
        self.time_to_impact(self.released(start), longest)
    }

    fn run(&self, start: f64, duration: f64, step: f64) -> Result<FreeMotion, SolverError> {
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
