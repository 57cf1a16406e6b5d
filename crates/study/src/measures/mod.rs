//! Which intensity measure to choose: efficiency, practicality and sufficiency of several, from runs that
//! were scaled by one of them.
//!
//! A run at a level of the study's measure is a factor on its record, so that the record's intensity in any
//! other measure follows. With D = `u_max`/`u_ins` of the runs in which a wall stands, θ the intensity at
//! which a record makes it collapse, and z the duration, magnitude or distance of the record:
//!
//! | quality | number |
//! |---|---|
//! | efficiency | σ of ln θ over the records, and σ of ln D about ln D = a + b ln IM |
//! | practicality | b |
//! | proficiency | σ/b |
//! | sufficiency | p of the slope over z of ln θ, and of the residuals of ln D |
//!
//! N. Luco, C. A. Cornell: Structure-specific scalar intensity measures for near-source and ordinary
//! earthquake ground motions. Earthquake Spectra 23(2), 2007, 357–392. J. E. Padgett, B. G. Nielson,
//! R. `DesRoches`: Selection of optimal intensity measures in probabilistic seismic demand models of highway
//! bridge portfolios. Earthquake Engineering & Structural Dynamics 37(5), 2008, 711–725.
//!
//! Several walls have each an own a, or mean ln θ, and share b and σ.

mod beta;
mod events;
mod moments;

use fragility::Weights;
use serde::{Deserialize, Serialize};

use crate::ida::{Crossing, Curve, Exceedance, IntensityMeasure, IntensityUnit, Study};

pub use events::Events;
pub use moments::Fit;

use moments::{Moments, Point};

/// Fewest records of a comparison: of fewer, no slope has a p-value.
pub const FEWEST: usize = 3;

/// The records of a study in the measures that it compares, and their features.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// The measures.
    pub measures: Vec<ComparedMeasure>,
    /// What may explain the residuals.
    pub features: Vec<Feature>,
}

/// A measure of the comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedMeasure {
    /// Name.
    pub name: String,
    /// Unit of results.
    pub(crate) unit: IntensityUnit,
    /// Power of the level by which it grows: 1, or of Arias intensity 2 where the study has another measure.
    exponent: f64,
    /// Intensity of each unscaled record over its intensity in the study's measure, this to the exponent; in
    /// SI units.
    at_one: Vec<f64>,
}

/// A feature of the records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Feature {
    /// Name, as columns of tables end: `duration`, `magnitude`, `distance`.
    pub name: String,
    /// Value of each record.
    pub values: Vec<f64>,
}

/// Which exceedance of a curve is its collapse.
#[derive(Clone, Copy, Debug)]
pub struct CollapseOf {
    /// The first or the last.
    pub crossing: Crossing,
    /// Whether it is known between two levels only.
    pub at_levels: bool,
}

/// What runs show of a measure: of a wall and model, or of all walls together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// Number of records, those of every wall.
    pub records: usize,
    /// Records of which no collapse lies between two levels: those that stand at the highest one, those that
    /// collapse at the lowest one, and all of a cloud. σ of ln θ is without them.
    pub censored: usize,
    /// Runs in which the wall overturned, or did not move. The regression is without them.
    pub left_out: usize,
    collapses: Moments,
    demands: Moments,
}

impl Compared {
    /// Takes the records of a study, with the events of a table, if there is one.
    ///
    /// # Errors
    /// The reason: fewer than [`FEWEST`] records, a record without an intensity above 0 in one of the
    /// measures, or one that the table does not have.
    pub fn of(study: &Study, measures: &[IntensityMeasure], events: Option<&Events>) -> Result<Self, String> {
        let given = study.given_records();
        if given.len() < FEWEST {
            let found = report::counted(given.len(), "record");
            return Err(format!(
                "compare needs at least {FEWEST} records, and the study has {found}; add some"
            ));
        }
        let names: Vec<_> = given.iter().map(|record| record.name.as_str()).collect();
        let signs = study.polarity().signs();
        let repeated = |values: Vec<f64>| values.into_iter().flat_map(|one| std::iter::repeat_n(one, signs));
        let feature = |(name, values)| Feature { name, values: repeated(values).collect() };
        let duration = given.iter().map(|record| record.motion.significant_duration()).collect();
        let mut features = vec![feature(("duration".to_owned(), duration))];
        features
            .extend(events.map(|events| events.of(&names)).transpose()?.into_iter().flatten().map(feature));
        let measures = measures.iter().map(|measure| ComparedMeasure::of(study, measure));
        Ok(Self { measures: measures.collect::<Result<_, _>>()?, features })
    }

    /// Names the features that are the same in all records, which explain nothing.
    pub fn constant(&self) -> impl Iterator<Item = &str> {
        let is_constant = |feature: &&Feature| feature.values.windows(2).all(|pair| pair[0] == pair[1]);
        self.features.iter().filter(is_constant).map(|feature| feature.name.as_str())
    }

    /// Returns what the curves of a wall and model, one of each record, show of each measure.
    pub fn shown(&self, curves: &[Curve], weights: &Weights, collapse: CollapseOf) -> Vec<Shown> {
        let collapses: Vec<_> = curves.iter().map(|curve| collapse.of(curve)).collect();
        let features: Vec<Vec<f64>> = (0..curves.len())
            .map(|record| self.features.iter().map(|feature| feature.values[record]).collect())
            .collect();
        let runs = || {
            curves
                .iter()
                .enumerate()
                .flat_map(|(record, curve)| curve.runs().iter().map(move |run| (record, run)))
        };
        let stood: Vec<_> = runs()
            .filter(|(_, run)| run.overturning.is_none() && run.demand > 0.0)
            .map(|(record, run)| (record, run.intensity, libm::log(run.demand)))
            .collect();
        let of_measure = |measure: &ComparedMeasure| {
            let theta = |(record, level): (usize, &Option<f64>)| {
                level.map(|level| Point {
                    x: 0.0,
                    y: measure.log(record, level),
                    weight: weights.of_record(record),
                    features: &features[record],
                })
            };
            let thetas: Vec<_> = collapses.iter().enumerate().filter_map(theta).collect();
            let demand = |&(record, level, y): &(usize, f64, f64)| Point {
                x: measure.log(record, level),
                y,
                weight: weights.of_record(record),
                features: &features[record],
            };
            let demands: Vec<_> = stood.iter().map(demand).collect();
            Shown {
                records: curves.len(),
                censored: curves.len() - thetas.len(),
                left_out: runs().count() - demands.len(),
                collapses: Moments::of(&thetas),
                demands: Moments::of(&demands),
            }
        };
        self.measures.iter().map(of_measure).collect()
    }
}

impl CollapseOf {
    /// Returns the level of the collapse, between two levels their geometric mean; `None` where it has no
    /// level below or above it.
    fn of(self, curve: &Curve) -> Option<f64> {
        match curve.exceedance(1.0, self.crossing, self.at_levels) {
            Exceedance::Between([least, _]) if least <= 0.0 => None,
            exceedance => Some(exceedance.or_infinity()).filter(|level| level.is_finite()),
        }
    }
}

impl ComparedMeasure {
    fn of(study: &Study, measure: &IntensityMeasure) -> Result<Self, String> {
        // a factor multiplies an intensity by itself or by its square
        let name = measure.name();
        let exponent = 0.5 * libm::log2(measure.ratio(study.measure().factor(4.0)));
        let at_one = study.records().iter().enumerate().map(|(place, record)| {
            let own = libm::pow(study.intensity(place), exponent);
            match measure.of(&study.scaled_motion(place)) {
                Ok(found) if found > 0.0 && found.is_finite() => Ok(found / own),
                Ok(found) => Err(format!(
                    "record {:?} has a {name} of {found}, and no logarithm of it; leave out the record, or \
                     {name} in compare",
                    record.name
                )),
                Err(error) => Err(format!("record {:?}, {name}: {error}", record.name)),
            }
        });
        let at_one = at_one.collect::<Result<_, String>>()?;
        Ok(Self { name, unit: measure.unit(), exponent, at_one })
    }

    /// Returns ln of the intensity, in the unit of results, of a record at a level of the study's measure.
    fn log(&self, record: usize, level: f64) -> f64 {
        libm::log(self.unit.of(self.at_one[record])) + self.exponent * libm::log(level)
    }
}

impl Shown {
    /// Adds another wall.
    pub fn add(&mut self, other: &Self) {
        self.records += other.records;
        self.censored += other.censored;
        self.left_out += other.left_out;
        self.collapses.add(&other.collapses);
        self.demands.add(&other.demands);
    }

    /// Returns ln θ over the records: its standard deviation, and p of the features.
    pub fn collapses(&self) -> Fit {
        self.collapses.level()
    }

    /// Returns the regression ln D = a + b ln IM over the runs, IM in the unit of results.
    pub fn demands(&self) -> Fit {
        self.demands.line()
    }
}
