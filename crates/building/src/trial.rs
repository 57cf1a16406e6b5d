//! The communication step that a building needs, found by running it.
//!
//! Units step in parallel with the outputs of the others at the start of the step (Jacobi), as most masters
//! do: inputs are held over the step, or linear by the derivatives of the outputs.

use fmu_export::Step;
use rocking_floor::variables::RealVariable as FloorVariable;
use rocking_wall::variables::RealVariable as WallVariable;

use crate::document::Building;
use crate::parts::Parts;
use crate::units::{Plan, at};

/// Steps that are tried \[s\], each a part of [`GRID`].
const STEPS: [f64; 10] = [0.01, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5];
/// Histories are compared at multiples of this \[s\].
const GRID: f64 = 0.01;
/// Longest run \[s\].
const LONGEST: f64 = 5.0;
/// Most steps of all units in one run.
const MOST_STEPS: f64 = 1e7;
/// The error that is asked for, and that of the reference.
const ERROR: f64 = 0.01;
const REFERENCE_ERROR: f64 = 0.002;
/// Amplitude of the pulse that shakes a building at rest \[m/s²\].
const PULSE: f64 = 3.0;

/// The largest steps with an error of at most 1 %.
#[derive(Debug)]
pub struct Trial {
    /// Of a run with held inputs \[s\].
    pub held: Option<f64>,
    /// Of a run with linear inputs \[s\].
    pub linear: Option<f64>,
    /// The smallest step that was tried \[s\].
    pub least: f64,
    /// Length of the run \[s\].
    pub duration: f64,
    /// Whether a pulse of the ground moves the building, which would otherwise stay at rest.
    pub is_shaken: bool,
}

impl Trial {
    /// Returns the communication step that the building's SSP states \[s\].
    ///
    /// It is the file's own, or else the one for masters that hold their inputs, as most do. If no step that
    /// was tried suffices, it is the smallest.
    pub fn step(&self, building: &Building) -> f64 {
        building.step.unwrap_or_else(|| self.held.unwrap_or(self.least).min(building.stop_time))
    }
}

/// A building, and the outputs that are compared.
struct Trials<'a> {
    plan: &'a Plan,
    /// Outputs that are compared.
    watched: Vec<(usize, u32)>,
    duration: f64,
    is_shaken: bool,
}

/// Finds the steps that a building needs.
pub fn trial(building: &Building, parts: &Parts) -> Trial {
    let plan = Trials::new(building, &parts.plan);
    let Trials { duration, is_shaken, .. } = plan;
    let steps: Vec<f64> = STEPS.into_iter().filter(|step| plan.count(*step) <= MOST_STEPS).collect();
    let mut linear: Vec<(f64, Option<History>)> = Vec::new();
    // the reference is the first run that agrees with the one before it
    let mut reference = None;
    for &step in &steps {
        let history = plan.run(step, true).ok();
        let before = linear.last().and_then(|(_, history)| history.as_ref());
        let pair = before.zip(history.as_ref());
        let is_settled = pair.is_some_and(|(before, now)| error(before, now) <= REFERENCE_ERROR);
        linear.push((step, history));
        if is_settled {
            reference = linear.last().and_then(|(_, history)| history.clone());
            break;
        }
    }
    let least = steps.last().copied().unwrap_or(GRID);
    let Some(reference) = reference else {
        return Trial { held: None, linear: None, least, duration, is_shaken };
    };
    let suits = |history: &Option<History>| history.as_ref().is_some_and(|h| error(h, &reference) <= ERROR);
    // the largest step such that it and every smaller one suffice
    let good = linear.iter().rev().take_while(|(_, history)| suits(history)).last();
    let good = good.map(|(step, _)| *step);
    let held = steps.iter().copied().find(|&step| suits(&plan.run(step, false).ok()));
    Trial { held, linear: good, least, duration, is_shaken }
}

/// The watched outputs at multiples of [`GRID`].
type History = Vec<Vec<f64>>;

/// Computes the largest error of an output over the largest value of its reference; infinite for no number.
fn error(history: &History, reference: &History) -> f64 {
    let mut largest: f64 = 0.0;
    for (index, _) in reference.first().into_iter().flatten().enumerate() {
        let peak = reference.iter().map(|row| row[index].abs()).fold(0.0, f64::max);
        let apart = |(row, other): (&Vec<f64>, &Vec<f64>)| (row[index] - other[index]).abs();
        let apart = history.iter().zip(reference).map(apart);
        let apart = apart.fold(0.0, |most: f64, apart| if apart <= most { most } else { apart });
        // an output that stays 0 has no error
        if peak > 0.0 {
            largest = if apart / peak <= largest { largest } else { apart / peak };
        }
    }
    if largest.is_nan() { f64::INFINITY } else { largest }
}

/// The ground's acceleration: two periods of 0.5 s that grow and decay within a second \[m/s²\].
fn pulse(time: f64) -> f64 {
    use std::f64::consts::PI;
    if time < 1.0 { PULSE * libm::sin(PI * time).powi(2) * libm::sin(4.0 * PI * time) } else { 0.0 }
}

impl<'a> Trials<'a> {
    fn new(building: &Building, plan: &'a Plan) -> Self {
        let floors = building.floors.len();
        let of_floor =
            |unit| [FloorVariable::Displacement, FloorVariable::AccelerationAbsolute].map(|id| at(unit, id));
        let of_walls = (floors..floors + building.walls.len()).map(|unit| at(unit, WallVariable::U));
        let watched = (0..floors).flat_map(of_floor).chain(of_walls).collect();
        let duration = (building.stop_time.min(LONGEST) / GRID).round().max(1.0) * GRID;
        let mut trials = Self { plan, watched, duration, is_shaken: false };
        let first = trials.run(GRID, false).unwrap_or_default();
        trials.is_shaken = first.iter().flatten().all(|value| *value == 0.0);
        trials
    }

    /// Counts the steps of all units in a run.
    fn count(&self, step: f64) -> f64 {
        self.duration / step * self.plan.payloads.len() as f64
    }

    fn run(&self, step: f64, linear: bool) -> Result<History, String> {
        let Plan { connections, ground, .. } = self.plan;
        let mut units = self.plan.start()?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to MOST_STEPS")]
        let [often, rows] = [GRID / step, self.duration / GRID].map(|count| count.round() as usize);
        let mut history = Vec::with_capacity(rows);
        let mut passed = Vec::with_capacity(connections.len());
        for index in 0..often * rows {
            let time = index as f64 * step;
            passed.clear();
            passed.extend(connections.iter().map(|&[(from, output), _]| {
                let rate = linear.then(|| units[from].rate(output));
                (units[from].get(output), rate)
            }));
            for (&[_, (to, input)], &(value, rate)) in connections.iter().zip(&passed) {
                units[to].set(input, value, rate);
            }
            for &(to, input) in ground.iter().filter(|_| self.is_shaken) {
                let rate = linear.then(|| (pulse(time + step) - pulse(time)) / step);
                units[to].set(input, pulse(time), rate);
            }
            for unit in &mut units {
                unit.step(Step { from: time, duration: step, may_end_early: false })?;
            }
            if (index + 1).is_multiple_of(often) {
                history.push(self.watched.iter().map(|&(of, output)| units[of].get(output)).collect());
            }
        }
        Ok(history)
    }
}
