//! A building under a record: its units run together, in process.
//!
//! The units are those of the SSP. Accelerations and reactions depend on each other without delay: an
//! algebraic loop. At each communication point Newton's method closes it, by the directional derivatives of
//! the units (docs/coupling.md). Over a step, inputs are then linear, by the derivatives of the outputs.

use files::check_value;
use fmu_export::{Step, VariableId};
use ground_motion::GroundMotion;
use nalgebra::{DMatrix, DVector, Dyn, LU};
use rocking_floor::variables::RealVariable as FloorVariable;
use rocking_wall::variables::RealVariable as WallVariable;
use run::parallel::stop_if_asked;
use scene::MotionTable;

use crate::error::BuildingError;
use crate::histories::{FloorHistory, History, WallHistory};
use crate::parts::Parts;
use crate::units::{Plan, Unit};

/// Longest communication step \[s\].
const LONGEST_STEP: f64 = 2e-3;
/// Most steps of all units in one run.
const MOST_UNIT_STEPS: f64 = 1e8;
/// Most iterations of Newton's method. Usually one suffices; a wall that comes to rest takes a few.
const MOST_SWEEPS: usize = 60;
/// Mismatch of an input, over the largest input of its kind so far, below which the loop counts as closed.
const CLOSED: f64 = 1e-10;

/// End and tolerance of a building's run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// End of the run \[s\].
    pub end: f64,
    /// Change of a peak by halving the step, over the peak, at which the step is short enough (-).
    pub tolerance: f64,
}

impl Settings {
    /// Settings of a run through a motion of the ground and a tail \[s\] of free vibration.
    ///
    /// # Errors
    /// [`BuildingError::Value`] for a tail or a tolerance out of range.
    pub fn new(ground: &GroundMotion, tail: f64, tolerance: f64) -> Result<Self, BuildingError> {
        check_value::<MotionTable>("tail", tail).map_err(|message| BuildingError::Value { message })?;
        if !(1e-6..=1.0).contains(&tolerance) {
            let message = format!("tolerance = {tolerance} must be from 1e-6 to 1");
            return Err(BuildingError::Value { message });
        }
        Ok(Self { end: ground.duration() + tail, tolerance })
    }
}

/// A building in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// Communication step \[s\].
    pub step: f64,
    /// Largest change of a peak by the last halving, over the peak (-).
    pub change: f64,
    /// Times of the histories \[s\]: the samples of the record, and on at its step.
    pub times: Vec<f64>,
    /// Acceleration of the ground \[m/s²\].
    pub ground: History,
    /// Storeys in the order of the file.
    pub floors: Vec<FloorHistory>,
    /// Walls in the order of the file.
    pub walls: Vec<WallHistory>,
}

impl Coupled {
    /// Runs a building under a motion of the ground, with the step halved until that changes every peak by
    /// less than the tolerance. Work that is [watched](run::parallel::watched) can be stopped.
    ///
    /// # Errors
    /// [`BuildingError`] where a unit fails, the loop does not close, or the step would become too small.
    pub fn run(parts: &Parts, ground: &GroundMotion, settings: Settings) -> Result<Self, BuildingError> {
        let plan = &parts.plan;
        let mut parts = (ground.step() / LONGEST_STEP).ceil().max(1.0);
        let mut before: Option<Self> = None;
        loop {
            let unit_steps = settings.end / ground.step() * parts * plan.payloads.len() as f64;
            if unit_steps > MOST_UNIT_STEPS {
                let change = before.map_or(f64::INFINITY, |before| 100.0 * before.change);
                let reason = format!(
                    "halving the step to {} s still changes a peak by {change:.2} %; shorten the record, or \
                     raise the tolerance",
                    2.0 * ground.step() / parts
                );
                return Err(BuildingError::Run { time: settings.end, reason });
            }
            let mut run = Loop::new(plan, ground)?.run_to_end(parts, settings.end)?;
            if let Some(before) = &before {
                run.change = run.change_from(before);
                if run.change <= settings.tolerance {
                    return Ok(run);
                }
            }
            before = Some(run);
            parts *= 2.0;
        }
    }

    /// Returns the largest difference between the peaks of two runs, each over the peak.
    fn change_from(&self, other: &Self) -> f64 {
        self.peaks().zip(other.peaks()).fold(0.0, |most: f64, (own, other)| {
            let apart = (own - other).abs();
            if apart > 0.0 { most.max(apart / own.abs().max(other.abs())) } else { most }
        })
    }

    /// Returns the peaks of floors and walls. That of a wall that overturns is taken as 1, since any
    /// difference grows once the wall falls.
    fn peaks(&self) -> impl Iterator<Item = f64> {
        let floors = self.floors.iter().flat_map(|floor| [&floor.acceleration, &floor.drift]);
        let floors = floors.map(|history| history.peak.value.abs());
        let walls = self.walls.iter().map(|wall| match wall.overturn_time {
            Some(_) => 1.0,
            None => wall.ratio.peak.value.abs(),
        });
        floors.chain(walls)
    }
}

/// The units of a building during a run.
struct Loop<'a> {
    plan: &'a Plan,
    ground: &'a GroundMotion,
    units: Vec<Box<dyn Unit>>,
    /// Present inputs, one for each connection, and the largest of each so far.
    values: DVector<f64>,
    largest: DVector<f64>,
    /// I − ∂outputs/∂inputs, factorised, as long as it is valid.
    factors: Option<LU<f64, Dyn, Dyn>>,
}

impl<'a> Loop<'a> {
    fn new(plan: &'a Plan, ground: &'a GroundMotion) -> Result<Self, BuildingError> {
        let units = plan.start().map_err(|reason| BuildingError::Run { time: 0.0, reason })?;
        let values = DVector::zeros(plan.connections.len());
        Ok(Self { plan, ground, units, largest: values.clone(), values, factors: None })
    }

    /// Runs to the end, with `parts` communication steps for each step of the record.
    fn run_to_end(mut self, parts: f64, end: f64) -> Result<Coupled, BuildingError> {
        let step = self.ground.step() / parts;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to MOST_UNIT_STEPS")]
        let [parts, samples] = [parts, (end / self.ground.step()).round()].map(|count| count as usize);
        let mut run = Coupled {
            step,
            change: f64::INFINITY,
            times: Vec::with_capacity(samples + 1),
            ground: History::default(),
            floors: vec![FloorHistory::default(); self.plan.floors],
            walls: vec![WallHistory::default(); self.units.len() - self.plan.floors],
        };
        for sample in 0..=samples {
            stop_if_asked();
            let ends =
                self.ground.samples().get(sample..sample + 2).map_or([0.0; 2], |ends| [ends[0], ends[1]]);
            let rate = (ends[1] - ends[0]) / self.ground.step();
            for part in 0..parts {
                let time = sample as f64 * self.ground.step() + part as f64 * step;
                let fail = |reason| BuildingError::Run { time, reason };
                let ground = ends[0] + rate * part as f64 * step;
                self.drive(ground, 0.0);
                self.close().map_err(fail)?;
                self.show(&mut run, ground, time, part == 0);
                if sample == samples {
                    return Ok(run);
                }
                let rates = self.rates(rate).map_err(fail)?;
                self.drive(ground, rate);
                for (connection, &[_, (to, input)]) in self.plan.connections.iter().enumerate() {
                    self.units[to].set(input, self.values[connection], Some(rates[connection]));
                }
                let step = Step { from: time, duration: step, may_end_early: false };
                for unit in &mut self.units {
                    unit.step(step).map_err(fail)?;
                }
                self.values += rates * step.duration;
            }
        }
        Ok(run)
    }

    fn drive(&mut self, value: f64, rate: f64) {
        for &(unit, input) in &self.plan.ground {
            self.units[unit].set(input, value, Some(rate));
        }
    }

    /// Makes inputs and outputs agree. Between events outputs are linear in the inputs, so one step suffices.
    fn close(&mut self) -> Result<(), String> {
        for sweep in 0..MOST_SWEEPS {
            for (connection, &[_, (to, input)]) in self.plan.connections.iter().enumerate() {
                self.units[to].set(input, self.values[connection], None);
            }
            let shown = |&[(from, output), _]: &[(usize, u32); 2]| self.units[from].get(output);
            let outputs = DVector::from_iterator(self.values.len(), self.plan.connections.iter().map(shown));
            self.largest.zip_apply(&outputs, |largest, output| *largest = largest.max(output.abs()));
            let mismatch = outputs - &self.values;
            if mismatch.iter().zip(&self.largest).all(|(apart, largest)| apart.abs() <= CLOSED * largest) {
                return Ok(());
            }
            // the factors of the last point are still valid, unless a wall has changed its phase
            if sweep > 0 {
                self.factors = None;
            }
            let change = self.solve(&mismatch)?;
            self.values += change;
        }
        Err("accelerations and reactions do not agree; a wall changes between rest and motion".into())
    }

    /// Computes output derivatives that agree with the input derivatives, while the ground changes at `rate`.
    fn rates(&mut self, rate: f64) -> Result<DVector<f64>, String> {
        let shown = |&[(from, output), _]: &[(usize, u32); 2]| {
            let by_ground = self.plan.ground.iter().filter(|(unit, _)| *unit == from);
            let by_ground = by_ground.map(|&(_, input)| self.units[from].derivative(output, input) * rate);
            self.units[from].rate(output) + by_ground.sum::<f64>()
        };
        let rates = DVector::from_iterator(self.values.len(), self.plan.connections.iter().map(shown));
        self.solve(&rates)
    }

    /// Solves (I − F) x = right.
    fn solve(&mut self, right: &DVector<f64>) -> Result<DVector<f64>, String> {
        let factors = self.factors.take().unwrap_or_else(|| {
            let count = self.values.len();
            let mut matrix = DMatrix::identity(count, count);
            for (row, &[(from, output), _]) in self.plan.connections.iter().enumerate() {
                for (column, &[_, (to, input)]) in self.plan.connections.iter().enumerate() {
                    if from == to {
                        matrix[(row, column)] -= self.units[from].derivative(output, input);
                    }
                }
            }
            LU::new(matrix)
        });
        let found = factors.solve(right);
        self.factors = Some(factors);
        found.ok_or_else(|| "the loop of accelerations and reactions has no solution".into())
    }

    fn show(&self, run: &mut Coupled, ground: f64, time: f64, is_shown: bool) {
        use WallVariable as V;
        if is_shown {
            run.times.push(time);
        }
        run.ground.add(ground, time, is_shown);
        let (floors, walls) = self.units.split_at(self.plan.floors);
        for (floor, unit) in run.floors.iter_mut().zip(floors) {
            let get = |id: FloorVariable| unit.get(id.variable().reference);
            floor.acceleration.add(get(FloorVariable::AccelerationAbsolute), time, is_shown);
            floor.drift.add(get(FloorVariable::Displacement), time, is_shown);
        }
        for (wall, unit) in run.walls.iter_mut().zip(walls) {
            let get = |id: V| unit.get(id.variable().reference);
            wall.displacement.add(get(V::U), time, is_shown);
            wall.ratio.add(get(V::URatio), time, is_shown);
            wall.reaction_bottom.add(get(V::ReactionBottom), time, is_shown);
            wall.reaction_top.add(get(V::ReactionTop), time, is_shown);
            wall.largest = get(V::UMax);
            // -1 before
            [wall.overturn_time, wall.tie_break_time] =
                [V::OverturnTime, V::TieBreakTime].map(|id| Some(get(id)).filter(|time| *time >= 0.0));
            wall.tie_elongation = get(V::TieElongation).max(get(V::TieElongationNegative));
        }
    }
}
