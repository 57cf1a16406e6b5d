//! Incremental dynamic analysis: walls × records × damping models, each record scaled level by level.
//!
//! D. Vamvatsikos, C. A. Cornell: Incremental dynamic analysis. Earthquake Engineering & Structural Dynamics 31(3), 2002,
//! 491–514. A wall starts upright and at rest; a run stops when it overturns. Several levels of one wall, record and model
//! run side by side.

mod curve;
mod levels;
mod measure;
mod model;

use crate::free_motion::has_peaked;
use crate::parallel;
use ground_motion::{GroundMotion, GroundMotionError};
use rocking_wall::solver::record::{Batch, Passage, RecordSolver, Samples, Start, Still};
use rocking_wall::solver::{Motion, SolverError, State};
use rocking_wall::wall::{ParameterError, Parameters, Support, Wall};

pub use curve::{Curve, Level, Occurrence};
pub use levels::Levels;
pub use measure::IntensityMeasure;
pub use model::{Damping, Model, Source};

/// Free vibration after a record unless stated otherwise \[s\].
pub const DEFAULT_TAIL: f64 = 10.0;

/// A wall of a study; its damping and impact are those of the study's models, its start is upright and at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedWall {
    /// Name, for people.
    pub name: String,
    /// Parameters; the coefficient of restitution they state or imply serves every model.
    pub parameters: Parameters,
}

/// A record of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedRecord {
    /// Name, for people.
    pub name: String,
    /// The motion, unscaled.
    pub motion: GroundMotion,
}

/// Why a study cannot be run.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum IdaError {
    /// A list is empty.
    #[error("a study needs at least one {what}")]
    Empty { what: &'static str },
    /// Wall and damping model do not go together.
    #[error("wall {wall:?} with the damping model {model:?}: {source}")]
    Parameters { wall: String, model: String, source: Box<ParameterError> },
    /// The intensity of a record.
    #[error("record {record:?}: {source}")]
    Record { record: String, source: Box<GroundMotionError> },
    /// A record that cannot be scaled.
    #[error("record {record:?} has the intensity {intensity} m/s² and cannot be scaled; leave it out")]
    Still { record: String, intensity: f64 },
    /// The levels.
    #[error("{name} of the levels is {value}; it must be {limit}")]
    Levels { name: &'static str, value: String, limit: String },
    /// The free vibration after a record.
    #[error("the tail is {value} s; it must be from 0 to 1000 s")]
    Tail { value: f64 },
    /// A run that could not be followed.
    #[error(
        "wall {wall:?}, record {record:?}, damping model {model:?}, from the level {level} m/s² on: {source}"
    )]
    Run { wall: String, record: String, model: String, level: f64, source: Box<SolverError> },
}

/// A study ready to run: every combination is valid.
#[derive(Clone, Debug)]
pub struct Study {
    walls: Vec<NamedWall>,
    records: Vec<NamedRecord>,
    models: Vec<Model>,
    measure: IntensityMeasure,
    levels: Levels,
    tail: f64,
    /// Wall by wall, model by model.
    motions: Vec<Motion>,
    /// Intensity of each record as it is \[m/s²\].
    intensities: Vec<f64>,
}

/// One wall, record and model of a study, by their places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// Place among the walls.
    pub wall: usize,
    /// Place among the records.
    pub record: usize,
    /// Place among the models.
    pub model: usize,
}

impl Study {
    /// Prepares a study with the default tail.
    ///
    /// # Errors
    /// [`IdaError`] if a wall does not go with a model, if a record has no intensity, if the levels are outside their limits,
    /// if there is nothing to run.
    pub fn new(
        walls: Vec<NamedWall>,
        records: Vec<NamedRecord>,
        models: Vec<Model>,
        measure: IntensityMeasure,
        levels: Levels,
    ) -> Result<Self, IdaError> {
        let lists = [("wall", walls.len()), ("record", records.len()), ("damping model", models.len())];
        if let Some(&(what, _)) = lists.iter().find(|(_, count)| *count == 0) {
            return Err(IdaError::Empty { what });
        }
        levels.check()?;
        let mut motions = Vec::with_capacity(walls.len() * models.len());
        for wall in &walls {
            for model in &models {
                motions.push(motion(wall, model)?);
            }
        }
        let intensity = |record: &NamedRecord| {
            let found = measure.of(&record.motion);
            let intensity = found.map_err(|source| IdaError::Record {
                record: record.name.clone(),
                source: Box::new(source),
            })?;
            if intensity > 0.0 && intensity.is_finite() {
                Ok(intensity)
            } else {
                Err(IdaError::Still { record: record.name.clone(), intensity })
            }
        };
        let intensities = records.iter().map(intensity).collect::<Result<_, _>>()?;
        Ok(Self { walls, records, models, measure, levels, tail: DEFAULT_TAIL, motions, intensities })
    }

    /// The same with another length of free vibration after each record \[s\].
    ///
    /// # Errors
    /// [`IdaError::Tail`] outside 0 to 1000 s.
    pub fn with_tail(mut self, tail: f64) -> Result<Self, IdaError> {
        if !(0.0..=1000.0).contains(&tail) {
            return Err(IdaError::Tail { value: tail });
        }
        self.tail = tail;
        Ok(self)
    }

    /// The walls.
    #[must_use]
    pub fn walls(&self) -> &[NamedWall] {
        &self.walls
    }

    /// The records.
    #[must_use]
    pub fn records(&self) -> &[NamedRecord] {
        &self.records
    }

    /// The damping models.
    #[must_use]
    pub fn models(&self) -> &[Model] {
        &self.models
    }

    /// The intensity measure.
    #[must_use]
    pub fn measure(&self) -> &IntensityMeasure {
        &self.measure
    }

    /// The levels.
    #[must_use]
    pub fn levels(&self) -> &Levels {
        &self.levels
    }

    /// Free vibration after each record \[s\].
    #[must_use]
    pub fn tail(&self) -> f64 {
        self.tail
    }

    /// Intensity of a record as it is \[m/s²\].
    #[must_use]
    pub fn intensity(&self, record: usize) -> f64 {
        self.intensities[record]
    }

    /// The wall of a combination, its damping and impact those of the model.
    #[must_use]
    pub fn wall(&self, wall: usize, model: usize) -> &Wall {
        self.motions[wall * self.models.len() + model].wall()
    }

    /// Number of combinations.
    #[must_use]
    pub fn count(&self) -> usize {
        self.walls.len() * self.records.len() * self.models.len()
    }

    /// The combination of a number: walls outermost, then models, records innermost.
    #[must_use]
    pub fn case(&self, index: usize) -> Case {
        let (records, models) = (self.records.len(), self.models.len());
        Case { wall: index / (records * models), model: index / records % models, record: index % records }
    }

    /// The number of a combination.
    #[must_use]
    pub fn index(&self, case: Case) -> usize {
        (case.wall * self.models.len() + case.model) * self.records.len() + case.record
    }

    /// The curve of one combination.
    ///
    /// # Errors
    /// [`IdaError::Run`] if a run could not be followed.
    pub fn curve(&self, case: Case) -> Result<Curve, IdaError> {
        let motion = &self.motions[case.wall * self.models.len() + case.model];
        let record = &self.records[case.record].motion;
        let solver = RecordSolver::new(motion, record.step());
        let samples = Samples(record.samples());
        let runs = Runs {
            motion,
            record,
            solver: &solver,
            batch: solver.batch(&samples),
            intensity: self.intensities[case.record],
            tail: self.tail,
        };
        let levels = self.levels.trace(|levels| {
            runs.at(levels).map_err(|source| IdaError::Run {
                wall: self.walls[case.wall].name.clone(),
                record: self.records[case.record].name.clone(),
                model: self.models[case.model].name.clone(),
                level: levels[0],
                source: Box::new(source),
            })
        })?;
        Ok(Curve::new(levels))
    }

    /// All curves, in the order of their numbers, on `threads` threads; the same whatever their number.
    ///
    /// # Errors
    /// The error of the first combination, in their order, whose runs could not be followed.
    pub fn run(&self, threads: usize) -> Result<Vec<Curve>, IdaError> {
        parallel::map(self.count(), threads, |index| self.curve(self.case(index)))
    }
}

fn motion(wall: &NamedWall, model: &Model) -> Result<Motion, IdaError> {
    let fail = |source| IdaError::Parameters {
        wall: wall.name.clone(),
        model: model.name.clone(),
        source: Box::new(source),
    };
    let parameters = model.applied_to(&wall.parameters).map_err(fail)?;
    Motion::of(&parameters, parameters.tolerance).map_err(fail)
}

/// Runs of one wall under one record.
struct Runs<'a> {
    motion: &'a Motion,
    record: &'a GroundMotion,
    solver: &'a RecordSolver<'a>,
    batch: Batch<'a, Samples<'a>>,
    /// Intensity of the record as it is \[m/s²\].
    intensity: f64,
    tail: f64,
}

impl Runs<'_> {
    /// The record scaled to each of some intensities \[m/s²\].
    fn at(&self, levels: &[f64]) -> Result<Vec<Level>, SolverError> {
        // p = −λ a_g
        let participation = self.motion.wall().body().forcing(Support::rigid(1.0));
        let u_ins = self.motion.wall().body().instability;
        let samples = self.record.samples();
        let start = |level: &f64| {
            let factor = level / self.intensity * participation;
            Start { state: self.motion.start_under(0.0, 0.0, factor * samples[0]), factor }
        };
        let starts: Vec<_> = levels.iter().map(start).collect();
        let passages = self.batch.run(&starts, true)?;
        let level = |(&intensity, passage): (&f64, &Passage)| {
            let (state, overturning) = match passage.overturning {
                Some(time) => (passage.state, Some(time)),
                None => self.free(passage.state)?,
            };
            Ok(Level { intensity, demand: state.peaks.ratio(u_ins), overturning })
        };
        levels.iter().zip(&passages).map(level).collect()
    }

    /// The state after the free vibration that follows the record, and the time of overturning; what cannot go beyond the
    /// peak it has already seen, for lack of energy, is not followed.
    fn free(&self, state: State) -> Result<(State, Option<f64>), SolverError> {
        if has_peaked(self.motion.wall(), &state) {
            return Ok((state, None));
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to 1000 s of steps")]
        let count = (self.tail / self.record.step()).ceil() as usize + 1;
        let passage = self.solver.run(Start { state, factor: 1.0 }, &Still(count), true, |_, _, _| {})?;
        Ok((passage.state, passage.overturning.map(|time| self.record.duration() + time)))
    }
}
