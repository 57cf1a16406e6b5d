//! Histories, peaks and demands of a run.

use crate::scene::{Scene, SceneError};
use crate::simulation::{Excitation, Outputs, Simulation};
use crate::solver::{Demands, Segment, Work};
use crate::wall::{Support, Warning};

/// One line of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time \[s\].
    pub time: f64,
    /// Motion of the supports.
    pub support: Support,
    /// The wall.
    pub outputs: Outputs,
}

/// A run from start to end.
#[derive(Clone, Debug)]
pub struct Response {
    /// The history at the output step.
    pub samples: Vec<Sample>,
    /// Peaks and events.
    pub summary: Summary,
    /// What the motion asks of the wall and of its supports, up to overturning.
    pub demands: Demands,
    /// u at the end of the run \[m\].
    pub residual: f64,
    /// What the user should know about the parameters.
    pub warnings: Vec<Warning>,
}

/// Peaks and events of a run; peaks of u include turning points between the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Largest |u| \[m\].
    pub u_max: f64,
    /// Largest |u|/`u_ins` of its side \[-\].
    pub u_ratio_max: f64,
    /// Whether |u| exceeded `u_ins`.
    pub overturned: bool,
    /// When it did \[s\].
    pub overturn_time: Option<f64>,
    /// End of the run \[s\].
    pub end_time: f64,
    /// Work of the solver.
    pub work: Work,
    /// The bound on impacts was reached and the wall put to rest.
    pub stilled: bool,
}

impl Response {
    /// Runs a scene.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of(scene: &Scene) -> Result<Self, SceneError> {
        let count = scene.output_count()?;
        scene.check_supports()?;
        let excitation = scene.excitation.as_ref();
        let mut simulation = Simulation::new(&scene.parameters, None, 0.0, support_at(excitation, 0.0))?;
        let mut samples = Vec::with_capacity(count + 1);
        let record = |simulation: &Simulation, support: Support| Sample {
            time: simulation.progress().time,
            support,
            outputs: simulation.outputs(support),
        };
        samples.push(record(&simulation, support_at(excitation, 0.0)));
        let mut demands = simulation.demands(support_at(excitation, 0.0), &scene.thresholds);
        let mut stilled = false;
        for index in 1..=count {
            #[allow(clippy::cast_precision_loss, reason = "count ≤ 2e7")]
            let time = (index as f64 * scene.output_step).min(scene.stop_time);
            stilled |= advance_to(&mut simulation, excitation, time, &mut demands)?;
            samples.push(record(&simulation, support_at(excitation, time)));
        }
        let progress = simulation.progress();
        let (peaks, u_ins) = (progress.state.peaks, simulation.wall().body().instability);
        let summary = Summary {
            u_max: peaks.largest(),
            u_ratio_max: peaks.ratio(u_ins),
            overturned: progress.state.overturned,
            overturn_time: progress.overturn_time,
            end_time: progress.time,
            work: progress.work,
            stilled,
        };
        let residual = progress.state.displacement;
        Ok(Self { samples, summary, demands, residual, warnings: simulation.wall().warnings().to_vec() })
    }
}

/// Segments between two output points: more samples than that are refused by the output step's limit.
const MOST_SEGMENTS: usize = 100_000_000;

/// Moves a simulation to `time` through every sample of its excitation, taking up its demands; tells whether the wall was put
/// to rest.
///
/// # Errors
/// [`SceneError::Run`].
pub fn advance_to(
    simulation: &mut Simulation,
    excitation: Option<&Excitation>,
    time: f64,
    demands: &mut Demands,
) -> Result<bool, SceneError> {
    let mut stilled = false;
    for _ in 0..MOST_SEGMENTS {
        let now = simulation.progress().time;
        let remaining = time - now;
        if remaining <= 0.0 {
            break;
        }
        let segment = match excitation {
            Some(excitation) => excitation.stretch(now, remaining),
            None => Segment { duration: remaining, from: Support::default(), to: Support::default() },
        };
        let step = simulation
            .advance_watched(&segment, demands)
            .map_err(|source| SceneError::Run { time: now, source })?;
        stilled |= step.stilled;
        if segment.duration >= remaining {
            simulation.set_time(time);
        }
    }
    Ok(stilled)
}

/// The supports at one instant.
fn support_at(excitation: Option<&Excitation>, time: f64) -> Support {
    excitation.map_or_else(Support::default, |excitation| excitation.stretch(time, 0.0).from)
}
