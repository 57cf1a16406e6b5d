//! Time and error of a run.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::problem::Problem;

/// Runs after the warm-up: at least so many and for [`SHORTEST`], but none begins after [`PATIENCE`].
const RUNS: usize = 25;
/// Disturbances of the machine last milliseconds.
const SHORTEST: Duration = Duration::from_millis(100);
const PATIENCE: Duration = Duration::from_millis(800);

/// The rows of the comparison, one for each tool and setting.
pub(crate) struct Rows(String);

impl Rows {
    pub(crate) fn new() -> Self {
        Self("scene,tool,setting,seconds,error_max,error_rms,error_peak,overturned\n".to_owned())
    }

    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Times `run`, which writes the displacement at each sample, and adds a row; a run that fails is named
    /// in it.
    pub(crate) fn measure(
        &mut self,
        problem: &Problem,
        tool: &str,
        setting: &str,
        run: impl FnMut(&mut Vec<f64>) -> Result<(), String>,
    ) {
        let mut timed_history = Vec::with_capacity(problem.reference.len());
        let run = std::cell::RefCell::new(run);
        let timed = || run.borrow_mut()(&mut timed_history);
        self.measure_many(problem, tool, setting, 1, |history| run.borrow_mut()(history), timed);
    }

    /// Like [`Rows::measure`], but times `timed`, which computes `count` runs together and records nothing.
    /// The row has the time of one run.
    pub(crate) fn measure_many(
        &mut self,
        problem: &Problem,
        tool: &str,
        setting: &str,
        count: usize,
        mut run: impl FnMut(&mut Vec<f64>) -> Result<(), String>,
        mut timed: impl FnMut() -> Result<(), String>,
    ) {
        let mut history = Vec::with_capacity(problem.reference.len());
        let mut row = |text: String| {
            // writing to a string does not fail
            let _ = writeln!(self.0, "{},{tool},{setting}{text}", problem.scene);
        };
        if let Err(reason) = run(&mut history) {
            row(format!(": failed: {},,,,,", reason.replace([',', '\n', '"'], ";")));
            return;
        }
        if history.len() != problem.reference.len() {
            row(format!(": failed: {} of {} samples,,,,,", history.len(), problem.reference.len()));
            return;
        }
        let Errors { max, rms, peak, overturned } = Errors::of(&history, problem);
        let began = Instant::now();
        let mut least = f64::INFINITY;
        for repetition in 0_usize.. {
            let spent = began.elapsed();
            let enough = repetition >= RUNS && spent > SHORTEST;
            if enough || spent > PATIENCE {
                break;
            }
            let start = Instant::now();
            let _ = black_box(timed());
            least = least.min(start.elapsed().as_secs_f64());
        }
        let least = least / count as f64;
        row(format!(",{least:.4e},{max:.4e},{rms:.4e},{peak:.4e},{overturned}"));
    }
}

/// Errors at the samples over `u_ins` \[-\].
struct Errors {
    max: f64,
    rms: f64,
    /// Of the largest |u|.
    peak: f64,
    overturned: bool,
}

impl Errors {
    fn of(history: &[f64], problem: &Problem) -> Self {
        let u_ins = problem.equation.u_ins;
        let (mut max, mut squares, mut peak, mut reference_peak) = (0.0_f64, 0.0, 0.0_f64, 0.0_f64);
        for (u, reference) in history.iter().zip(&problem.reference) {
            let error = (u - reference).abs() / u_ins;
            // f64::max would drop a NaN
            max = if error.is_nan() { f64::INFINITY } else { max.max(error) };
            squares += error * error;
            peak = peak.max(u.abs());
            reference_peak = reference_peak.max(reference.abs());
        }
        Self {
            max,
            rms: (squares / history.len() as f64).sqrt(),
            peak: (peak - reference_peak).abs() / u_ins,
            overturned: peak > u_ins,
        }
    }
}
