//! Incremental dynamic analysis: walls × records × damping models, each record scaled level by level.
//!
//! D. Vamvatsikos, C. A. Cornell: Incremental dynamic analysis. Earthquake Engineering & Structural Dynamics
//! 31(3), 2002, 491–514. A wall starts upright and at rest, and a run stops when it overturns. Several levels
//! of one wall, record and model run side by side.
//!
//! ```
//! use ground_motion::SyntheticMotion;
//! use rocking_wall::wall::Parameters;
//! use study::ida::{Exceedance, IntensityMeasure, Levels, Study};
//! use run::walls::NamedWall;
//! use run::records::NamedRecord;
//! use run::model::{EnergyLoss, Model};
//!
//! let walls = vec![NamedWall::new("parapet", Parameters::default())];
//! let motion = SyntheticMotion { duration: 10.0, ..SyntheticMotion::default() }.motion()?;
//! let records = vec![NamedRecord::new("synthetic", motion)];
//! let models = vec![Model::new(EnergyLoss::Restitution)];
//! let levels = Levels::ToOverturning { step: 2.0, top: 100.0 };
//! let study = Study::new(walls, records, models, IntensityMeasure::Pga, levels)?;
//! let curves = study.run(1)?;
//! assert!(matches!(curves[0].collapse(), Exceedance::At(_)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod group;
mod levels;
mod measure;
mod outcome;
mod parts;
mod polarity;
mod sequence;
mod unit;

use std::borrow::Cow;

use ground_motion::{GroundMotion, Warning};
use rocking_wall::solver::{Motion, SolverError};
use rocking_wall::wall::Wall;
use run::model::Model;
use run::parallel;
use run::records::NamedRecord;
use run::shaking::felt;
use run::walls::NamedWall;

pub use error::IdaError;
pub use fragility::{Crossing, Curve, Exceedance, Run, SENSITIVE_ABOVE, TieDemand};
pub use levels::{Layout, Levels};
pub use measure::{IntensityMeasure, Misfit, ToSi};
pub use outcome::Collapse;
pub use polarity::Polarity;
pub use scene::DEFAULT_TAIL;
pub use sequence::Scaled;
pub use unit::IntensityUnit;

/// Most combinations of a study whose runs and collapses are written as CSV too, with the sensitivity of each
/// collapse. Runs of larger studies are in the parts only.
pub(crate) const MOST_LISTED: usize = 10_000;

/// Longest free vibration after a record of a study \[s\].
pub const LONGEST_TAIL: f64 = 1000.0;

/// A study ready to run: each wall is valid with each damping model, and each record can be scaled.
#[derive(Clone, Debug)]
pub struct Study {
    walls: Vec<NamedWall>,
    records: Vec<NamedRecord>,
    models: Vec<Model>,
    measure: IntensityMeasure,
    levels: Levels,
    tail: f64,
    collapse: Collapse,
    polarity: Polarity,
    pub(crate) scaled: Scaled,
    /// Intensity of what the levels scale of each record, unscaled, in SI units.
    intensities: Vec<f64>,
}

/// A combination of one wall, record and model, by their indices in the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// Index of the wall.
    pub wall: usize,
    /// Index of the record.
    pub record: usize,
    /// Index of the model.
    pub model: usize,
}

impl Study {
    /// Prepares a study with the default free vibration after each record.
    ///
    /// # Errors
    /// [`IdaError`] if a list is empty, if a wall does not go with a model, if a record cannot be scaled, or
    /// if the levels are outside their limits.
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
        levels.check(measure.unit())?;
        for wall in &walls {
            models.iter().try_for_each(|model| motion(wall, model).map(drop))?;
        }
        // a record of a stripe is worth its level: a list has scaled it
        let of = |record: &NamedRecord| match &levels {
            Levels::Stripes(levels) => record
                .listed
                .stripe
                .and_then(|stripe| levels.get(stripe).copied())
                .ok_or_else(|| IdaError::NoStripe { record: record.name.clone() }),
            _ => intensity(&measure, &record.name, &record.motion),
        };
        let intensities = records.iter().map(of).collect::<Result<_, _>>()?;
        let (tail, collapse, polarity) = (DEFAULT_TAIL, Collapse::Exceeds, Polarity::AsRecorded);
        let scaled = Scaled::All;
        Ok(Self { walls, records, models, measure, levels, tail, collapse, polarity, scaled, intensities })
    }

    /// Sets the free vibration after each record \[s\].
    ///
    /// # Errors
    /// [`IdaError::Tail`] outside 0 to [`LONGEST_TAIL`].
    pub fn with_tail(self, tail: f64) -> Result<Self, IdaError> {
        if (0.0..=LONGEST_TAIL).contains(&tail) {
            Ok(Self { tail, ..self })
        } else {
            Err(IdaError::Tail { value: tail })
        }
    }

    /// Sets which runs have overturned.
    #[must_use]
    pub fn with_collapse(self, collapse: Collapse) -> Self {
        Self { collapse, ..self }
    }

    /// Sets the signs with which the records are run.
    #[must_use]
    pub fn with_polarity(self, polarity: Polarity) -> Self {
        let (signs, given) = (self.polarity.signs(), self.given_records());
        // a reversed record has the intensity of the record
        let intensities = self.intensities.iter().step_by(signs);
        let of_signs = |intensity: &f64| std::iter::repeat_n(*intensity, polarity.signs());
        let intensities = intensities.flat_map(of_signs).collect();
        Self { records: polarity.records(given), intensities, polarity, ..self }
    }

    /// Returns the walls.
    pub fn walls(&self) -> &[NamedWall] {
        &self.walls
    }

    /// Returns the records that are run: with both signs, each record and its reverse.
    pub fn records(&self) -> &[NamedRecord] {
        &self.records
    }

    /// Returns the records as they were given.
    pub fn given_records(&self) -> Vec<NamedRecord> {
        self.polarity.given(&self.records)
    }

    /// Returns the signs with which the records are run.
    pub fn polarity(&self) -> Polarity {
        self.polarity
    }

    /// Returns the damping models.
    pub fn models(&self) -> &[Model] {
        &self.models
    }

    /// Returns the intensity measure.
    pub fn measure(&self) -> &IntensityMeasure {
        &self.measure
    }

    /// Returns the levels.
    pub fn levels(&self) -> &Levels {
        &self.levels
    }

    /// Returns the free vibration after each record \[s\].
    pub fn tail(&self) -> f64 {
        self.tail
    }

    /// Returns which runs have overturned.
    pub fn collapse(&self) -> Collapse {
        self.collapse
    }

    /// Returns the intensity of what the levels scale of a record, unscaled, in the SI unit of the measure.
    pub fn intensity(&self, record: usize) -> f64 {
        self.intensities[record]
    }

    /// Warns about accelerations that no record has. They are those of the strongest record at the highest
    /// level, or at the lowest one where levels go on to overturning.
    pub fn warning(&self) -> Option<Warning> {
        let peak = |index: usize| {
            let level = self.levels.certain(self.own_level(index));
            self.scaled_motion(index).peak() * self.measure.factor(level / self.intensities[index])
        };
        let peaks = (0..self.records.len()).map(peak);
        peaks.max_by(f64::total_cmp).and_then(Warning::of_peak)
    }

    /// Warns of stripes whose records have a median intensity beyond half or twice that of the stripe.
    pub fn unlike_stripes(&self) -> Vec<String> {
        let Levels::Stripes(levels) = &self.levels else { return Vec::new() };
        let warning = |(place, &level): (usize, &f64)| {
            let records = self.records.iter().filter(|record| record.listed.stripe == Some(place));
            let mut own: Vec<f64> =
                records.filter_map(|record| self.measure.of(&record.motion).ok()).collect();
            own.sort_by(f64::total_cmp);
            let median = (own.get(own.len().checked_sub(1)? / 2)? * own.get(own.len() / 2)?).sqrt();
            let unit = self.measure.unit();
            (!(0.5..=2.0).contains(&(median / level))).then(|| {
                format!(
                    "stripe {} states {}, but its records, with their factors, have a median of {}; check \
                     the factors, their unit and the measure",
                    place + 1,
                    unit.shown(level),
                    unit.shown(median)
                )
            })
        };
        levels.iter().enumerate().filter_map(warning).collect()
    }

    /// Returns a wall with the damping and impact of a model.
    pub fn wall(&self, wall: usize, model: usize) -> Wall {
        self.motion(wall, model).wall().clone()
    }

    /// Returns whether a wall has ties that may yield.
    pub fn has_yielding_tie(&self, wall: usize) -> bool {
        self.wall(wall, 0).ties().iter().any(|tie| tie.ultimate.is_some())
    }

    /// Makes the motion of a wall and model. It is not kept: the motions of all walls would take more memory
    /// than the curves of a part.
    fn motion(&self, wall: usize, model: usize) -> Motion {
        let made = motion(&self.walls[wall], &self.models[model]);
        made.unwrap_or_else(|error| unreachable!("`new` has made it: {error}"))
    }

    /// Counts the combinations.
    pub fn count(&self) -> usize {
        self.walls.len() * self.records.len() * self.models.len()
    }

    /// Returns the combination with a number. Numbers count records first, then models, then walls.
    pub fn case(&self, index: usize) -> Case {
        let (records, models) = (self.records.len(), self.models.len());
        Case { wall: index / (records * models), model: index / records % models, record: index % records }
    }

    /// Returns the number of a combination.
    pub fn index(&self, case: Case) -> usize {
        (case.wall * self.models.len() + case.model) * self.records.len() + case.record
    }

    /// Computes the curve of one combination.
    ///
    /// # Errors
    /// [`IdaError::Run`] if a run fails.
    pub fn curve(&self, case: Case) -> Result<Curve, IdaError> {
        let index = self.index(case);
        let mut curves = self.curves(index..index + 1)?;
        Ok(curves.remove(0))
    }

    /// Names the combination and the level of a run that failed.
    fn failed(&self, case: Case, level: f64, source: SolverError) -> IdaError {
        IdaError::Run {
            wall: self.walls[case.wall].name.clone(),
            record: self.records[case.record].name.clone(),
            model: self.models[case.model].name.clone(),
            level: self.measure.unit().shown(level),
            source: Box::new(source),
        }
    }

    /// Returns the level of a record in a cloud: its intensity times the scale.
    fn own_level(&self, record: usize) -> f64 {
        let scale = if let Levels::Cloud { scale } = self.levels { scale } else { 1.0 };
        self.intensities[record] * self.measure.ratio(scale)
    }

    /// Returns the motion of the supports of a wall under a record: that of the ground, or that of its floors
    /// until the tail ends.
    fn support_motion(&self, case: Case) -> Result<Cow<'_, GroundMotion>, IdaError> {
        let (wall, record) = (&self.walls[case.wall], &self.records[case.record]);
        // only on floors the body counts
        if wall.floors.is_none() {
            return Ok(self.scaled_motion(case.record));
        }
        let of_model = self.wall(case.wall, case.model);
        let motion = felt(wall.floors.as_ref(), of_model.body(), &record.motion, self.tail);
        motion.map_err(|source| IdaError::Floors {
            wall: wall.name.clone(),
            record: record.name.clone(),
            source: Box::new(source),
        })
    }

    /// Computes all curves, in the order of their numbers, on `threads` threads. The result does not depend
    /// on the number of threads. Counts each group of combinations as [done](parallel::count_done).
    ///
    /// # Errors
    /// The error of the first combination, in their order, whose run fails.
    pub fn run(&self, threads: usize) -> Result<Vec<Curve>, IdaError> {
        let groups: Vec<_> = self.groups(0..self.count(), threads).collect();
        let curves = parallel::map(groups.len(), threads, |group| {
            let curves = self.curves(groups[group].clone());
            parallel::count_done(groups.len());
            curves
        })?;
        Ok(curves.into_iter().flatten().collect())
    }

    /// Returns the factor on a record at a level.
    fn factor(&self, case: Case, level: f64) -> f64 {
        self.measure.factor(level / self.intensities[case.record])
    }

    /// Returns whether a run is the worse of those with both signs of the record.
    fn takes_the_worse(&self, motion: &Motion) -> bool {
        self.polarity == Polarity::Worst && !motion.wall().has_equal_sides()
    }
}

/// Computes the intensity of a record of a name.
fn intensity(measure: &IntensityMeasure, record: &str, motion: &GroundMotion) -> Result<f64, IdaError> {
    let record = || record.to_owned();
    match measure.of(motion) {
        Ok(intensity) if intensity > 0.0 && intensity.is_finite() => Ok(intensity),
        Ok(intensity) => {
            Err(IdaError::Unscalable { record: record(), intensity: measure.unit().shown(intensity) })
        }
        Err(source) => Err(IdaError::Record { record: record(), source: Box::new(source) }),
    }
}

/// Prepares the motion of a wall with a damping model.
fn motion(wall: &NamedWall, model: &Model) -> Result<Motion, IdaError> {
    let failed = |source| IdaError::Parameters {
        wall: wall.name.clone(),
        model: model.name.clone(),
        source: Box::new(source),
    };
    let parameters = model.applied_to(&wall.parameters).map_err(failed)?;
    Motion::of(&parameters, parameters.tolerance).map_err(failed)
}
