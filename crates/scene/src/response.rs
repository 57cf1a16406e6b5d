//! Histories, peaks and demands of a run.

mod shock;

use std::borrow::Cow;
use std::fmt::Write;

use rocking_wall::simulation::{Outputs, Simulation, segment_of};
use rocking_wall::solver::{Demands, Work};
use rocking_wall::wall::{Sides, Support, Wall, Warning};
use serde::{Serialize, Serializer};

use crate::{Scene, SceneError};

pub use shock::Shock;

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

/// A tie at a line of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieSample {
    /// Force N \[N\].
    pub force: f64,
    /// Plastic elongations p of the tie of each side \[m\].
    pub elongation: Sides,
}

/// A run from start to end.
#[derive(Clone, Debug)]
pub struct Response {
    /// The history at the output step.
    pub samples: Vec<Sample>,
    /// Peaks and events.
    pub summary: Summary,
    /// Demands of the motion on the wall and on its supports, up to overturning.
    pub demands: Demands,
    /// The shocks of a sequence of records; none of a single motion.
    pub shocks: Vec<Shock>,
    /// What each tie does at each sample.
    pub ties: Vec<Vec<TieSample>>,
    /// u at the end of the run \[m\].
    pub residual: f64,
    /// What the user should know about the parameters.
    pub warnings: Vec<Warning>,
}

/// The peaks, events and demands by their names in `wall simulate --json`.
impl Serialize for Response {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct AndResidual<'a> {
            #[serde(flatten)]
            demands: &'a Demands,
            residual: f64,
        }
        #[derive(Serialize)]
        struct Named<'a> {
            #[serde(flatten)]
            summary: &'a Summary,
            demands: AndResidual<'a>,
            #[serde(skip_serializing_if = "<[Shock]>::is_empty")]
            shocks: &'a [Shock],
        }
        let Self { summary, demands, residual, shocks, .. } = self;
        Named { summary, demands: AndResidual { demands, residual: *residual }, shocks }.serialize(serializer)
    }
}

/// What becomes of a wall in a run (docs/model.md, Overturning); times in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate {
    /// |u| stays within `u_ins`.
    Stands,
    /// |u| exceeds `u_ins` and is below it at the end of the run.
    ComesBack {
        /// When |u| first exceeds `u_ins`.
        exceeds: f64,
    },
    /// |u| exceeds `u_ins` and is not below it at the end of the run.
    Falls {
        /// When |u| first exceeds `u_ins`.
        exceeds: f64,
        /// When |u| exceeds `u_ins` for the last time.
        falls: f64,
    },
}

impl Fate {
    /// Returns the fate of a wall from the time of its overturning and its history of u/`u_ins`. The time of
    /// a fall after a return is interpolated in the history.
    pub fn of(overturning: Option<f64>, history: impl DoubleEndedIterator<Item = (f64, f64)>) -> Self {
        let Some(exceeds) = overturning else { return Self::Stands };
        let mut history = history.rev().peekable();
        if history.peek().is_none_or(|(_, ratio)| ratio.abs() < 1.0) {
            return Self::ComesBack { exceeds };
        }
        let mut beyond = [0.0; 2];
        for (time, ratio) in history.take_while(|(time, _)| *time > exceeds) {
            if ratio.abs() < 1.0 {
                let part = (1.0 - ratio.abs()) / (beyond[1] - ratio.abs());
                return Self::Falls { exceeds, falls: time + part * (beyond[0] - time) };
            }
            beyond = [time, ratio.abs()];
        }
        Self::Falls { exceeds, falls: exceeds }
    }

    /// Returns when the wall falls \[s\]; `None` for a wall that does not.
    pub fn falling(&self) -> Option<f64> {
        match *self {
            Self::Falls { falls, .. } => Some(falls),
            Self::Stands | Self::ComesBack { .. } => None,
        }
    }

    /// Describes a fate beyond `u_ins`, its times to a number of decimals; `None` for a wall that stands.
    ///
    /// ```
    /// use scene::response::Fate;
    ///
    /// let fate = Fate::Falls { exceeds: 2.0, falls: 3.5 };
    /// assert_eq!(fate.words(1).unwrap(), "exceeds u_ins at 2.0 s, comes back and falls at 3.5 s");
    /// ```
    pub fn words(&self, decimals: usize) -> Option<String> {
        match *self {
            Self::Stands => None,
            Self::ComesBack { exceeds } => {
                Some(format!("exceeds u_ins at {exceeds:.decimals$} s and comes back"))
            }
            Self::Falls { exceeds, falls } if falls > exceeds => Some(format!(
                "exceeds u_ins at {exceeds:.decimals$} s, comes back and falls at {falls:.decimals$} s"
            )),
            Self::Falls { falls, .. } => Some(format!("falls at {falls:.decimals$} s")),
        }
    }

    /// Returns whether the wall falls.
    pub fn falls(&self) -> bool {
        self.falling().is_some()
    }
}

/// Peaks and events of a run; peaks of u include turning points between the samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Largest |u|; `u_ins` of its side for a wall that falls \[m\].
    pub u_max: f64,
    /// Largest |u|/`u_ins` of its side; 1 for a wall that falls \[-\].
    pub u_ratio_max: f64,
    /// Fate of the wall; serialised as whether it falls.
    #[serde(rename = "falls", serialize_with = "falls")]
    pub fate: Fate,
    /// |u| has exceeded `u_ins`.
    pub overturned: bool,
    /// When |u| first exceeded `u_ins` \[s\].
    pub overturn_time: Option<f64>,
    /// End of the run \[s\].
    pub end_time: f64,
    /// Work of the solver.
    #[serde(flatten)]
    pub work: Work,
    /// The limit on impacts was reached, and the wall was put to rest.
    pub put_to_rest: bool,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn falls<S: Serializer>(fate: &Fate, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bool(fate.falls())
}

/// Lines that are computed one by one before calm steps are looked for again. That costs as much as a few
/// steps.
const LINES_BETWEEN_TRIES: usize = 4;

impl Response {
    /// Runs a scene.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of(scene: &Scene) -> Result<Self, SceneError> {
        let count = scene.output_count()?;
        let motion = scene.support_motion()?;
        let excitation = motion.as_deref();
        let support_at = |time: f64| segment_of(excitation, time, 0.0).from;
        let mut simulation = Simulation::new(&scene.parameters, None, 0.0, support_at(0.0))?;
        #[allow(clippy::cast_precision_loss, reason = "count ≤ 2e7")]
        let time_of = |index: usize| (index as f64 * scene.output_step).min(scene.stop_time);
        let mut history = History::new(simulation.wall(), count + 1);
        history.add(&simulation, 0.0, support_at(0.0), motion_of(&simulation));
        let start = simulation.clone();
        let mut demands = simulation.demands(support_at(0.0), &scene.thresholds);
        let mut put_to_rest = false;
        // where there is an output at each sample of a record, calm steps are passed together
        let record = excitation.filter(|motion| motion.step() == scene.output_step);
        let (mut calm, mut next_try) = (Vec::new(), 0);
        while history.samples.len() <= count {
            if let Some(record) = record.filter(|_| history.samples.len() >= next_try) {
                simulation.pass_calm_steps(scene.stop_time, record, &demands, &mut calm);
                next_try = history.samples.len() + calm.len() + LINES_BETWEEN_TRIES;
                for end in calm.drain(..) {
                    let time = time_of(history.samples.len());
                    history.add(&simulation, time, support_at(time), end);
                }
            }
            let time = time_of(history.samples.len());
            put_to_rest |= simulation.advance_to(time, excitation, Some(&mut demands))?;
            history.add(&simulation, time, support_at(time), motion_of(&simulation));
        }
        let History { samples, ties } = history;
        let progress = simulation.progress();
        let u_ins = simulation.wall().body().instability;
        let fate = Fate::of(
            progress.overturn_time,
            samples.iter().map(|sample| (sample.time, sample.outputs.ratio)),
        );
        let shocks = shock::shocks(scene, start, excitation, fate.falling())?;
        let [u_max, u_ratio_max] = progress.state.reported_peak(u_ins, fate.falls());
        let summary = Summary {
            u_max,
            u_ratio_max,
            fate,
            overturned: progress.state.overturned,
            overturn_time: progress.overturn_time,
            end_time: progress.time,
            work: progress.work,
            put_to_rest,
        };
        let residual = progress.state.displacement;
        let wall = simulation.wall();
        let of_start = wall.start_warning(scene.parameters.u_start);
        let warnings = scene.warnings_of(wall).cloned().chain(of_start).collect();
        Ok(Self { samples, summary, demands, shocks, ties, residual, warnings })
    }

    /// Returns the columns of the history. Those of ties follow where there are some: their force, and the
    /// elongations of those that yield; of several, the force of each.
    pub fn columns(&self) -> Vec<Column<'_>> {
        let of_ties = match &self.demands.ties[..] {
            [] => 0,
            ties if ties.iter().any(|tie| tie.yielding.is_some()) => 3,
            _ => 1,
        };
        let common = COLUMNS[..COLUMNS.len() - 3 + of_ties].iter().map(|&(name, unit, value)| Column {
            name: name.into(),
            unit,
            value: Box::new(move |index| value(&self.samples[index])),
        });
        let several = if self.ties.len() > 1 { &self.ties[..] } else { &[] };
        let of_each = several.iter().zip(1..).map(|(samples, number)| Column {
            name: format!("tie_{number}_force").into(),
            unit: "_n",
            value: Box::new(move |index: usize| samples[index].force),
        });
        common.chain(of_each).collect()
    }

    /// Writes the history as CSV, numbers to their last digit; the header names the columns with their units.
    pub fn csv(&self) -> String {
        let columns = self.columns();
        let mut csv = "time_s".to_owned();
        for Column { name, unit, .. } in &columns {
            csv.extend([",", name, unit]);
        }
        csv.push('\n');
        for (index, sample) in self.samples.iter().enumerate() {
            // writing to a String cannot fail
            let _ = write!(csv, "{:.9}", sample.time);
            for column in &columns {
                let _ = write!(csv, ",{:?}", (column.value)(index));
            }
            csv.push('\n');
        }
        csv
    }
}

/// The lines of a history so far, and what each tie does at each.
struct History {
    samples: Vec<Sample>,
    ties: Vec<Vec<TieSample>>,
}

impl History {
    /// Makes an empty history of a wall, with room for a number of lines.
    fn new(wall: &Wall, count: usize) -> Self {
        let ties = wall.ties().iter().map(|_| Vec::with_capacity(count)).collect();
        Self { samples: Vec::with_capacity(count), ties }
    }

    /// Adds the line of a time \[s\] at which u \[m\] and u̇ \[m/s\] are `motion`. Branch and ties are those
    /// of the simulation now.
    fn add(&mut self, simulation: &Simulation, time: f64, support: Support, motion: [f64; 2]) {
        self.samples.push(Sample { time, support, outputs: simulation.outputs_at(motion, support) });
        if !self.ties.is_empty() {
            let (wall, branch, [u, _]) = (simulation.wall(), simulation.progress().state.branch, motion);
            let memory = wall.tie_memory_at(branch, u);
            for (samples, tie) in self.ties.iter_mut().zip(wall.ties().iter()) {
                let force = wall.force_of(tie, branch, u);
                samples.push(TieSample { force, elongation: tie.elongations(&memory) });
            }
        }
    }
}

/// Returns u \[m\] and u̇ \[m/s\] now.
fn motion_of(simulation: &Simulation) -> [f64; 2] {
    let state = simulation.progress().state;
    [state.displacement, state.velocity]
}

/// A column of the history beside the time.
pub struct Column<'a> {
    /// Its name.
    pub name: Cow<'static, str>,
    /// The unit that ends its name in a file.
    pub unit: &'static str,
    /// Its value at the sample of a number.
    pub value: Box<dyn Fn(usize) -> f64 + 'a>,
}

/// Name, unit and value at a sample of a column that any history may have.
type CommonColumn = (&'static str, &'static str, fn(&Sample) -> f64);

/// All columns, the three of a tie last.
pub const COLUMNS: [CommonColumn; 13] = [
    ("u", "_m", |sample| sample.outputs.displacement),
    ("u_dot", "_m_s", |sample| sample.outputs.velocity),
    ("u_ddot", "_m_s2", |sample| sample.outputs.acceleration),
    ("u_ratio", "", |sample| sample.outputs.ratio),
    ("restoring_force", "_n", |sample| sample.outputs.restoring_force),
    ("damping_force", "_n", |sample| sample.outputs.damping_force),
    ("reaction_bottom", "_n", |sample| sample.outputs.reactions.bottom),
    ("reaction_top", "_n", |sample| sample.outputs.reactions.top),
    ("a_bottom", "_m_s2", |sample| sample.support.bottom),
    ("a_top", "_m_s2", |sample| sample.support.top),
    ("tie_force", "_n", |sample| sample.outputs.tie_force),
    ("tie_elongation", "_m", |sample| sample.outputs.tie_elongation.positive),
    ("tie_elongation_negative", "_m", |sample| sample.outputs.tie_elongation.negative),
];
