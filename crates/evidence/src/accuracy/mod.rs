//! Error against run time of every solver on a set of problems.
//!
//! Errors are taken at the samples of the record, over `u_ins`, until either wall overturns. The reference is
//! the exact solver where there is a closed form, otherwise the adaptive solver at its tightest tolerance.
//! The reference itself is measured against the other of the two.
//!
//! ```
//! use evidence::accuracy::{Problem, Setting, measure_at};
//!
//! let scene = scene::Scene { stop_time: 2.0, ..Default::default() };
//! let problem = Problem::from_scene(&scene)?;
//! let result = measure_at(&problem, &[Setting::Newmark(1), Setting::Newmark(10)], 0.0)?;
//! assert!(result.measurements[1].error_max < result.measurements[0].error_max);
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

pub mod figure;
pub mod page;
mod problem;
pub mod table;

use std::time::Instant;

pub use problem::{Problem, defaults};

use crate::EvidenceError;
use record::{Forcing, Outcome, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::{Method, Motion, SolverError, Work};
use rocking_wall::wall::Wall;

/// A solver and the setting of its accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// Exact, with this many steps for each sample of the record.
    Exact(u32),
    /// Adaptive, with the tolerance on u/`u_ins`.
    Adaptive(f64),
    /// Newmark, with this many steps for each sample of the record.
    Newmark(u32),
}

impl Setting {
    /// Returns the name of the solver, as the parameter `solver` spells it.
    pub fn solver(self) -> &'static str {
        match self {
            Self::Exact(_) => "exact",
            Self::Adaptive(_) => "adaptive",
            Self::Newmark(_) => "newmark",
        }
    }

    /// Describes the step or tolerance for a record of `step` \[s\].
    pub fn describe(self, step: f64) -> String {
        match self {
            Self::Exact(parts) | Self::Newmark(parts) => format!("step {:.3e} s", step / f64::from(parts)),
            Self::Adaptive(tolerance) => format!("tolerance {tolerance:.0e}"),
        }
    }
}

/// Settings measured by default.
const ADAPTIVE: [f64; 6] = [1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const NEWMARK_PARTS: [u32; 6] = [1, 3, 10, 30, 100, 300];
const EXACT_PARTS: [u32; 3] = [1, 4, 16];
/// Tightest tolerance of the adaptive solver.
const TIGHTEST: f64 = 1e-13;
/// Relative change of the motion by which the amplification is measured.
const PROBE: f64 = 1e-8;

/// Run time and error of one setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Setting.
    pub setting: Setting,
    /// Shortest run time of several runs after a warm-up \[s\].
    pub seconds: f64,
    /// Largest |Δu|/`u_ins` \[-\].
    pub error_max: f64,
    /// Root mean square of |Δu|/`u_ins` \[-\].
    pub error_rms: f64,
    /// Relative error of the largest |u|, where neither run overturned \[-\].
    pub error_peak: Option<f64>,
    /// Error of the time of overturning \[s\]; infinite where only one run overturned, `None` where neither
    /// did.
    pub error_overturning: Option<f64>,
    /// Pieces of motion, corners and impacts. No solver here rejects a step.
    pub work: Work,
}

/// Work-precision set: all measurements of one problem.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecision {
    /// Name of the problem.
    pub name: String,
    /// Length of a record step \[s\].
    pub step: f64,
    /// Largest |u|/`u_ins` of the reference \[-\].
    pub peak: f64,
    /// Time of overturning of the reference \[s\].
    pub overturning: Option<f64>,
    /// Change of u/`u_ins` over the relative change of the motion that causes it \[-\].
    pub amplification: f64,
    /// Whether the reference is the exact solver.
    pub exact: bool,
    /// A measurement for each setting. That of the reference shows how far the two best solvers differ.
    pub measurements: Vec<Measurement>,
}

impl WorkPrecision {
    /// Returns the error that rounding alone may cause, 100 ε times the amplification \[-\].
    pub fn rounding(&self) -> f64 {
        100.0 * f64::EPSILON * self.amplification
    }
}

/// Displacements at the samples, NaN after overturning, and the result of the run.
struct Displacements {
    displacements: Vec<f64>,
    outcome: Outcome,
}

/// Measures a problem at every setting of the default set; each is timed for about `budget` \[s\].
///
/// # Errors
/// [`EvidenceError`] if the parameters make no wall or a run fails.
pub fn measure(problem: &Problem, budget: f64) -> Result<WorkPrecision, EvidenceError> {
    let wall = Wall::new(&problem.parameters)?;
    let exact = EXACT_PARTS.map(Setting::Exact).into_iter().filter(|_| wall.has_closed_form());
    // full rotations are followed by the adaptive solver only
    let newmark = NEWMARK_PARTS.map(Setting::Newmark).into_iter().filter(|_| wall.rotations().is_none());
    let settings: Vec<Setting> = exact.chain(ADAPTIVE.map(Setting::Adaptive)).chain(newmark).collect();
    measure_at(problem, &settings, budget)
}

/// Measures a problem at some settings.
///
/// # Errors
/// [`EvidenceError`] if the parameters make no wall or a run fails.
///
/// # Panics
/// If full rotations are measured at other settings than adaptive ones.
pub fn measure_at(
    problem: &Problem,
    settings: &[Setting],
    budget: f64,
) -> Result<WorkPrecision, EvidenceError> {
    let wall = Wall::new(&problem.parameters)?;
    let exact = wall.has_closed_form();
    let failed = |source| EvidenceError::Run { name: problem.name.clone(), source };
    let tightest = Setting::Adaptive(TIGHTEST);
    let best = Trial::new(problem, &wall, if exact { Setting::Exact(1) } else { tightest });
    let reference = best.history(1.0).map_err(failed)?;
    let adaptive = Trial::new(problem, &wall, tightest);
    let other = exact.then(|| adaptive.history(1.0)).transpose().map_err(failed)?;
    let probed = best.history(1.0 + PROBE).map_err(failed)?;
    let scale = wall.displacement_scale();
    let amplification = 1.0 + differences(&reference, &probed, scale).fold(0.0, f64::max) / PROBE;
    let measurement = |&setting: &Setting| {
        let trial = Trial::new(problem, &wall, setting);
        let history = trial.history(1.0)?;
        let against = match (setting, &other) {
            (Setting::Exact(_), Some(other)) => other,
            _ => &reference,
        };
        Ok(compare(setting, trial.time(budget)?, &history, against, scale))
    };
    let measurements = settings.iter().map(measurement).collect::<Result<_, _>>().map_err(failed)?;
    Ok(WorkPrecision {
        name: problem.name.clone(),
        step: problem.step,
        peak: reference.outcome.state.peaks.largest() / scale,
        overturning: reference.outcome.overturning,
        amplification,
        exact,
        measurements,
    })
}

/// Returns |Δu|/`u_ins` at the samples before either run overturned.
fn differences(a: &Displacements, b: &Displacements, scale: f64) -> impl Iterator<Item = f64> {
    let pairs = a.displacements.iter().zip(&b.displacements);
    pairs.map(move |(a, b)| (a - b).abs() / scale).take_while(|difference| !difference.is_nan())
}

fn compare(
    setting: Setting,
    seconds: f64,
    history: &Displacements,
    reference: &Displacements,
    scale: f64,
) -> Measurement {
    let differences = || differences(history, reference, scale);
    let squares: f64 = differences().map(|difference| difference.powi(2)).sum();
    let peak = reference.outcome.state.peaks.largest();
    let stands = history.outcome.overturning.or(reference.outcome.overturning).is_none();
    let error_overturning = match (history.outcome.overturning, reference.outcome.overturning) {
        (Some(a), Some(b)) => Some((a - b).abs()),
        (None, None) => None,
        _ => Some(f64::INFINITY),
    };
    Measurement {
        setting,
        seconds,
        error_max: differences().fold(0.0, f64::max),
        error_rms: (squares / differences().count().max(1) as f64).sqrt(),
        error_peak: stands.then(|| (history.outcome.state.peaks.largest() - peak).abs() / peak),
        error_overturning,
        work: history.outcome.work,
    }
}

/// One problem at one setting.
struct Trial<'a> {
    problem: &'a Problem,
    motion: Motion,
    /// Forcing at the ends of the steps, of which each sample of the record has `parts`.
    forcing: Vec<f64>,
    parts: usize,
}

impl<'a> Trial<'a> {
    fn new(problem: &'a Problem, wall: &Wall, setting: Setting) -> Self {
        let (method, parts) = match setting {
            Setting::Exact(parts) => (Method::Exact, parts),
            Setting::Adaptive(tolerance) => (Method::Adaptive { tolerance }, 1),
            Setting::Newmark(parts) => (Method::Newmark { step: problem.step / f64::from(parts) }, 1),
        };
        let (motion, forcing) = (Motion::new(wall.clone(), method), refined(&problem.forcing, parts));
        Self { problem, motion, forcing, parts: parts as usize }
    }

    fn solver(&self) -> RecordSolver<'_> {
        RecordSolver::new(&self.motion, self.problem.step / self.parts as f64)
    }

    /// Returns the start of a run under `factor` times the forcing.
    fn run_start(&self, factor: f64) -> RunStart {
        let parameters = &self.problem.parameters;
        let first = factor * self.forcing[0];
        let state = self.motion.start_under(parameters.u_start, parameters.u_dot_start, first);
        RunStart { state, factor }
    }

    fn history(&self, factor: f64) -> Result<Displacements, SolverError> {
        let mut displacements = vec![f64::NAN; self.problem.forcing.len()];
        displacements[0] = factor * self.problem.parameters.u_start;
        let mut observe = |index, u, _| {
            if index % self.parts == 0 {
                displacements[index / self.parts] = u;
            }
        };
        let forcing = Forcing::Samples(&self.forcing);
        let outcome = self.solver().run_observed(
            self.run_start(factor),
            forcing,
            RunEnd::AtOverturning,
            &mut observe,
        )?;
        if let Some(time) = outcome.overturning {
            for (index, displacement) in displacements.iter_mut().enumerate() {
                if index as f64 * self.problem.step > time {
                    *displacement = f64::NAN;
                }
            }
        }
        Ok(Displacements { displacements, outcome })
    }

    /// Returns the shortest run time of at least three runs \[s\].
    fn time(&self, budget: f64) -> Result<f64, SolverError> {
        let begun = Instant::now();
        let mut least = f64::INFINITY;
        for run in 0..10_000 {
            let start = Instant::now();
            let outcome = self.solver().run(
                self.run_start(1.0),
                Forcing::Samples(&self.forcing),
                RunEnd::AtOverturning,
            )?;
            std::hint::black_box(outcome);
            least = least.min(start.elapsed().as_secs_f64());
            if run >= 2 && begun.elapsed().as_secs_f64() > budget {
                break;
            }
        }
        Ok(least)
    }
}

/// Cuts each interval of a piecewise linear motion into `parts`.
pub(crate) fn refined(samples: &[f64], parts: u32) -> Vec<f64> {
    let mut refined = Vec::with_capacity(samples.len() * parts as usize);
    for ends in samples.windows(2) {
        let part = |part: u32| ends[0] + (ends[1] - ends[0]) * (f64::from(part) / f64::from(parts));
        refined.extend((0..parts).map(part));
    }
    refined.extend(samples.last());
    refined
}
