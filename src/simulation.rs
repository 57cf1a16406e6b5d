//! A wall in time: the state, the supports' motion, the outputs.

mod events;
mod outputs;

use std::sync::Arc;

use crate::solver::{Demands, Memo, Method, Motion, Segment, SolverError, Start, State, Work};
use crate::variables::Mechanism;
use crate::wall::{Ends, ParameterError, Parameters, Support, Wall};
use ground_motion::GroundMotion;

pub use events::Handled;
pub use outputs::{Outputs, Sensitivity};

/// A wall under way.
#[derive(Clone, Debug)]
pub struct Simulation {
    motion: Arc<Motion>,
    record: Progress,
    memo: Memo,
}

/// All that changes during a simulation: plain data, copied to save it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time \[s\].
    pub time: f64,
    /// State of the wall.
    pub state: State,
    /// Time of overturning \[s\]; `None` before.
    pub overturn_time: Option<f64>,
    /// A drift has been given, so that its couple acts on the supports.
    pub drift: bool,
    /// Work so far.
    pub work: Work,
}

/// What one step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// Impulses of the supports on the wall \[N s\].
    pub impulses: Ends,
    /// The wall overturned in this step.
    pub overturned: bool,
    /// The wall left its supports in this step.
    pub departed: bool,
    /// The bound on impacts was reached and the wall put to rest.
    pub stilled: bool,
}

impl Simulation {
    /// A wall at its start, at `time` \[s\], with the supports moving as `support` says; `tolerance` is the importer's, of
    /// which and the parameter the tighter applies.
    ///
    /// # Errors
    /// [`ParameterError`].
    pub fn new(
        parameters: &Parameters,
        tolerance: Option<f64>,
        time: f64,
        support: Support,
    ) -> Result<Self, ParameterError> {
        let wall = Wall::new(parameters)?;
        let tolerance = tolerance.map_or(parameters.tolerance, |given| given.min(parameters.tolerance));
        let method = Method::new(parameters, &wall, tolerance)?;
        let motion = Motion::new(wall, method);
        let state = motion.start(parameters.u_start, parameters.u_dot_start, support);
        let overturn_time = state.overturned.then_some(time);
        let drift = support.drift != 0.0;
        let record = Progress { time, state, overturn_time, drift, work: Work::default() };
        Ok(Self { motion: Arc::new(motion), record, memo: Memo::default() })
    }

    /// The wall.
    #[must_use]
    pub fn wall(&self) -> &Wall {
        self.motion.wall()
    }

    /// The method in use.
    #[must_use]
    pub fn method(&self) -> &Method {
        self.motion.method()
    }

    /// Where the simulation stands.
    #[must_use]
    pub fn progress(&self) -> &Progress {
        &self.record
    }

    /// Goes back, or on, to where a simulation of the same wall stood.
    ///
    /// # Panics
    /// If the branch is not one of the wall's.
    pub fn restore(&mut self, progress: Progress) {
        assert!(progress.state.branch < self.wall().branches().len(), "a branch of this wall");
        self.record = progress;
    }

    /// Moves the wall through a segment.
    ///
    /// # Errors
    /// [`SolverError`]; the simulation then stands where it stood.
    pub fn advance(&mut self, segment: &Segment) -> Result<Step, SolverError> {
        self.step(segment, None)
    }

    /// The demands of a motion that starts now, under the supports' present motion: `fractions` of `u_ins`, each above 0 and
    /// at most 1, are the limit states whose first crossings are wanted.
    #[must_use]
    pub fn demands(&self, support: Support, fractions: &[f64]) -> Demands {
        let Outputs { displacement, velocity, acceleration, reactions, .. } = self.outputs(support);
        let motion = [displacement, velocity, acceleration];
        Demands::new(self.wall(), &Start { time: self.record.time, motion, reactions }, fractions)
    }

    /// [`Self::advance`] with the demands of the segment taken up in `demands`.
    ///
    /// # Errors
    /// [`SolverError`]; the simulation then stands where it stood, and `demands` may know of the motion up to the failure.
    pub fn advance_watched(&mut self, segment: &Segment, demands: &mut Demands) -> Result<Step, SolverError> {
        self.step(segment, Some(demands))
    }

    fn step(&mut self, segment: &Segment, demands: Option<&mut Demands>) -> Result<Step, SolverError> {
        let body = self.motion.wall().body();
        let before = self.record;
        let drift = before.drift || segment.from.drift != 0.0 || segment.to.drift != 0.0;
        let integral = drift && body.mechanism == Mechanism::VerticalSpanning;
        let mut state = before.state;
        let watch = demands.map(|demands| (demands, before.time, drift));
        let report = self.motion.advance_watched(&mut state, segment, integral, &mut self.memo, watch)?;
        let mut step = Step {
            overturned: report.overturning.is_some(),
            departed: report.departure.is_some(),
            stilled: report.stilled,
            ..Step::default()
        };
        if !before.state.departed {
            let [length, velocity] = report.departure.unwrap_or([segment.duration, state.velocity]);
            // ∫ of a quantity linear over the segment, up to `length`
            let integrate = |from: f64, to: f64| {
                let fraction = if segment.duration > 0.0 { length / segment.duration } else { 0.0 };
                length * (from + 0.5 * (to - from) * fraction)
            };
            let (from, to) = (segment.from, segment.to);
            let supports = [integrate(from.bottom, to.bottom), integrate(from.top, to.top)];
            let couple = if integral {
                body.couple(report.displacement_integral, integrate(from.drift, to.drift))
            } else {
                0.0
            };
            step.impulses = body.impulses(supports, velocity - before.state.velocity, couple);
        }
        self.record.time += segment.duration;
        self.record.state = state;
        self.record.drift = drift;
        self.record.work.add(report.work);
        if let (None, Some(offset)) = (before.overturn_time, report.overturning) {
            self.record.overturn_time = Some(before.time + offset);
        }
        Ok(step)
    }

    /// Sets the clock, where the importer's and the sum of steps differ by rounding \[s\].
    pub fn set_time(&mut self, time: f64) {
        self.record.time = time;
    }
}

/// Recorded motion of the supports: one record for both, or one for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    bottom: GroundMotion,
    top: Option<GroundMotion>,
    held: bool,
}

impl Excitation {
    /// One motion for both supports, or `top` for the top support (a wall in an upper storey).
    #[must_use]
    pub fn new(bottom: GroundMotion, top: Option<GroundMotion>) -> Self {
        Self { bottom, top, held: false }
    }

    /// The same motion, but each sample held until the next as most importers do with an input, not linear between.
    #[must_use]
    pub fn held(self) -> Self {
        Self { held: true, ..self }
    }

    /// Motion of the bottom support, or of both.
    #[must_use]
    pub fn bottom(&self) -> &GroundMotion {
        &self.bottom
    }

    /// Motion of the top support where it has its own.
    #[must_use]
    pub fn top(&self) -> Option<&GroundMotion> {
        self.top.as_ref()
    }

    /// Length of the longer record \[s\].
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.top.as_ref().map_or(0.0, GroundMotion::duration).max(self.bottom.duration())
    }

    /// The piece of motion from `elapsed` seconds after the start, linear in time, that lasts `remaining` or to the next
    /// sample: its length \[s\] and the supports at both ends.
    #[must_use]
    pub fn stretch(&self, elapsed: f64, remaining: f64) -> Segment {
        let mut duration = remaining;
        for record in [Some(&self.bottom), self.top.as_ref()].into_iter().flatten() {
            if let Some(next) = next_sample(record, elapsed) {
                duration = duration.min(next - elapsed);
            }
        }
        let ends = |record| {
            let [from, to] = ends(record, elapsed, duration);
            if self.held { [sample_at(record, elapsed); 2] } else { [from, to] }
        };
        let [from, to] = ends(&self.bottom);
        let [from_top, to_top] = self.top.as_ref().map_or([from, to], ends);
        Segment {
            duration,
            from: Support { bottom: from, top: from_top, drift: 0.0 },
            to: Support { bottom: to, top: to_top, drift: 0.0 },
        }
    }
}

/// Part of a sample within which a time counts as that of the sample: sums of rounded steps come this close.
const SAMPLE_ROUNDING: f64 = 1e-6;

/// Number of the sample at or before a time, a time a rounding short of a sample being at it.
fn sample_before(record: &GroundMotion, elapsed: f64) -> f64 {
    (elapsed / record.step() + SAMPLE_ROUNDING).floor()
}

/// Time of the next sample; `None` after the last.
fn next_sample(record: &GroundMotion, elapsed: f64) -> Option<f64> {
    let next = sample_before(record, elapsed) + 1.0;
    (next < record.samples().len() as f64).then(|| next * record.step())
}

/// The sample at or before a time; zero after the record.
fn sample_at(record: &GroundMotion, elapsed: f64) -> f64 {
    let before = sample_before(record, elapsed);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a saturated cast is out of range"
    )]
    let sample = record.samples().get(before.max(0.0) as usize);
    sample.copied().unwrap_or(0.0)
}

/// Accelerations at both ends of a stretch within one sample interval; zero after the record.
fn ends(record: &GroundMotion, elapsed: f64, duration: f64) -> [f64; 2] {
    let samples = record.samples();
    let before = sample_before(record, elapsed);
    if before < 0.0 || before + 1.0 >= samples.len() as f64 {
        return [0.0, 0.0];
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ before < samples.len()")]
    let index = before as usize;
    let (low, high) = (samples[index], samples[index + 1]);
    let value = |time: f64| {
        let fraction = (time / record.step() - before).clamp(0.0, 1.0);
        if fraction > 1.0 - SAMPLE_ROUNDING { high } else { low + (high - low) * fraction }
    };
    [value(elapsed), value(elapsed + duration)]
}
