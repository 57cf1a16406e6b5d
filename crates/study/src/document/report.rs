//! What the report of a study shows: limit states, models beside a reference, classes of walls.

use fragility::hazard::Hazard;
use fragility::{Dispersion, Weights};
use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::ida::{Crossing, Levels, Scaled};
use crate::measures::Compared;
use crate::uncertain::Samples;

use files::{FileError, Place, fraction, positive, suggestion, tables};
use report::counted;
use run::model::Model;
use scene::DEFAULT_THRESHOLDS;

/// Resamples of a bootstrap that states none.
const RESAMPLES: u32 = 1000;
/// Most resamples of the bootstrap.
const MOST_RESAMPLES: u32 = 100_000;
/// Largest β of modelling.
const MOST_UNCERTAINTY: f64 = 2.0;

/// Options of a study's report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReportOptions {
    /// Limit states to report: fractions of `u_ins`.
    pub fractions: Vec<f64>,
    /// Name of the model by whose medians those of the others are divided.
    pub reference: String,
    /// Dispersions of the limit states.
    pub beta: Dispersion,
    /// Which exceedance of a curve counts.
    pub collapse: Crossing,
    /// Number of resamples of the records.
    pub resamples: u32,
    /// Seed of the resamples.
    pub seed: u64,
    /// Whether β is corrected for the number of records.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub small_sample: bool,
    /// Standard deviation of the logarithm of the intensity, due to modelling \[-\].
    pub modelling_uncertainty: f64,
    /// Classes of walls.
    pub classes: Vec<WallClass>,
    /// Hazard of the site.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hazard: Option<Hazard>,
    /// Loss as a part of the value of a wall, for each of the fractions \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loss_ratios: Option<Vec<f64>>,
    /// Samples of uncertain parameters: what the walls of the study are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<Samples>,
    /// The records in the measures that the study compares.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compared: Option<Compared>,
    /// Fractions of `u_ins` that |u| has exceeded before the last shock, for fragilities of that shock.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given: Vec<f64>,
    /// Weights of the records.
    #[serde(default, skip_serializing_if = "Weights::are_equal")]
    pub weights: Weights,
}

/// A class of walls that risk engines see as one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallClass {
    /// Name.
    pub name: String,
    /// Names of its walls; all walls of the study where empty.
    pub walls: Vec<String>,
    /// Weight of each wall; they need not add up to 1. Equal weights where empty.
    pub weights: Vec<f64>,
}

#[cfg(not(target_arch = "wasm32"))]
impl ReportOptions {
    /// Returns the places of the limit states from the first to be exceeded to the last, each once.
    pub(crate) fn rising(&self) -> Vec<usize> {
        let mut places: Vec<usize> = (0..self.fractions.len()).collect();
        places.sort_by(|&a, &b| self.fractions[a].total_cmp(&self.fractions[b]));
        places.dedup_by_key(|place| self.fractions[*place]);
        places
    }
}

tables! {
    /// What the results show.
    #[derive(Debug, Default)]
    pub(super) struct ReportTable {
        /// Limit states as fractions of `u_ins`.
        #[key(items = fraction(), minItems = 1, default = DEFAULT_THRESHOLDS.to_vec())]
        fractions: Option<Vec<f64>>,
        /// Model by whose medians the others are divided; by default the first.
        reference: Option<Spanned<String>>,
        /// Dispersions: one for each limit state (own), one for all (common), or one for each with which
        /// curves do not cross (ordered).
        #[key(default = "own")]
        beta: Option<Spanned<Dispersion>>,
        /// Which exceedance of a record counts where a wall stands again above it: the first, the last, or at
        /// each level the fraction of the records; by default the fraction on a grid, else the first.
        collapse: Option<Spanned<Crossing>>,
        /// Number of resamples of the bootstrap.
        #[key(minimum = 100, maximum = MOST_RESAMPLES, default = RESAMPLES)]
        resamples: Option<u32>,
        /// Seed of the resamples.
        #[key(default = 1)]
        seed: Option<u64>,
        /// Whether β is multiplied by 4n/(4n − 3), n records, which removes its bias.
        #[key(default = false)]
        small_sample: Option<bool>,
        /// Dispersion due to modelling, in all probabilities that are taken from fragilities \[-\].
        #[key(minimum = 0, maximum = MOST_UNCERTAINTY, default = 0)]
        modelling_uncertainty: Option<f64>,
        /// Loss as a part of the value of a wall, for each of the fractions (-).
        #[key(minItems = 1)]
        loss_ratios: Option<Spanned<Vec<f64>>>,
        /// Fractions of `u_ins`: fragilities of the last shock are told for the walls whose |u| has exceeded
        /// each in the shocks before.
        #[key(items = fraction(), minItems = 1)]
        given: Option<Spanned<Vec<f64>>>,
    }

    /// A class of walls that risk engines see as one.
    #[derive(Debug)]
    pub(super) struct ClassTable {
        /// Name, of no wall.
        name: String,
        /// Names of its walls; by default all walls of the study.
        #[serde(default)]
        walls: Vec<String>,
        /// Weight of each wall, of any sum; by default equal.
        #[serde(default)]
        #[key(items = positive())]
        weights: Vec<f64>,
    }
}

/// Probability of a fall that is not stated.
pub(super) const TARGET: f64 = 0.10;

tables! {
    /// What a study of reliability asks.
    #[derive(Debug)]
    pub(super) struct ReliabilityTable {
        /// Probability of a fall, of a wall that just passes, for which the numbers of the code are sought.
        #[key(exclusiveMinimum = 0, exclusiveMaximum = 1, default = TARGET)]
        pub(super) probability: Option<f64>,
    }
}

impl WallClass {
    /// Returns the weights of all its `count` walls, scaled to the sum 1.
    pub fn shares(&self, count: usize) -> Vec<f64> {
        let weights = if self.weights.is_empty() { &vec![1.0; count] } else { &self.weights };
        let sum: f64 = weights.iter().sum();
        weights.iter().map(|weight| weight / sum).collect()
    }

    /// Returns the class of the samples of its walls. Samples of a wall share its weight.
    pub(crate) fn of_samples(&self, samples: &Samples) -> Self {
        let count = samples.rows.len();
        let shares = |weight: &f64| std::iter::repeat_n(*weight, count);
        Self {
            name: self.name.clone(),
            walls: self.walls.iter().flat_map(|wall| samples.names(wall)).collect(),
            weights: self.weights.iter().flat_map(shares).collect(),
        }
    }

    /// Checks the class against the names of the study's walls.
    ///
    /// # Errors
    /// The reason: the study does not have one of the walls, the weights are not as many as the walls, or the
    /// class has the name of a wall.
    pub(crate) fn check<'a>(&self, walls: impl Iterator<Item = &'a str> + Clone) -> Result<(), String> {
        let Self { name, walls: own, weights } = self;
        let count = if own.is_empty() { walls.clone().count() } else { own.len() };
        if !weights.is_empty() && weights.len() != count {
            let weights = counted(weights.len(), "weight");
            return Err(format!("class {name:?}: {weights} for {}", counted(count, "wall")));
        }
        let known: std::collections::BTreeSet<_> = walls.clone().collect();
        if known.contains(name.as_str()) {
            return Err(format!("class {name:?}: has the name of a wall; give it its own"));
        }
        own.iter().find(|wall| !known.contains(wall.as_str())).map_or(Ok(()), |wall| {
            Err(format!("class {name:?}: the study has no wall {wall:?}{}", suggestion(wall, walls)))
        })
    }
}

/// Reads the options of the report, and the classes.
pub(super) fn report(
    table: Option<&Spanned<ReportTable>>,
    classes: &[Spanned<ClassTable>],
    models: &[Model],
    levels: &Levels,
    scaled: Scaled,
    place: &Place<'_>,
) -> Result<ReportOptions, FileError> {
    let usual = ReportTable::default();
    let spec = table.map_or(&usual, Spanned::get_ref);
    let fractions = spec.fractions.clone().unwrap_or(DEFAULT_THRESHOLDS.to_vec());
    if let Some(given) = &spec.reference
        && !models.iter().any(|model| model.name == *given.get_ref())
    {
        let message = format!("reference = {:?} is not among the models", given.get_ref());
        return Err(place.error(given.span(), message));
    }
    let reference = spec.reference.as_ref().map(|own| own.get_ref().clone());
    let first = || models.first().map(|model| model.name.clone()).unwrap_or_default();
    let is_cloud = matches!(levels, Levels::Cloud { .. });
    if is_cloud {
        let beta = spec.beta.as_ref().map(|word| ("beta", word.span()));
        if let Some((key, span)) = beta.or(spec.collapse.as_ref().map(|word| ("collapse", word.span()))) {
            let message =
                format!("{key} has no part in a cloud, whose regression has one beta; leave it out");
            return Err(place.error(span, message));
        }
    }
    if let (Levels::Stripes(_), Some(word)) = (levels, &spec.collapse) {
        let message = "collapse has no part in stripes, of which no record is run twice; leave it out";
        return Err(place.error(word.span(), message));
    }
    if let Some(given) = spec.given.as_ref().filter(|_| scaled == Scaled::All || is_cloud) {
        let message = "given needs scaled_shocks = \"last\", and levels of another method than a cloud";
        return Err(place.error(given.span(), message));
    }
    let is_fraction = matches!(levels, Levels::Grid(_) | Levels::Stripes(_));
    let own_crossing = if is_fraction { Crossing::Fraction } else { Crossing::First };
    if let Some(ratios) = &spec.loss_ratios {
        check_losses(&fractions, ratios.get_ref()).map_err(|fault| place.error(ratios.span(), fault))?;
    }
    Ok(ReportOptions {
        fractions,
        reference: reference.unwrap_or_else(first),
        beta: spec.beta.as_ref().map_or(Dispersion::Own, |word| *word.get_ref()),
        collapse: spec.collapse.as_ref().map_or(own_crossing, |word| *word.get_ref()),
        resamples: spec.resamples.unwrap_or(RESAMPLES),
        seed: spec.seed.unwrap_or(1),
        small_sample: spec.small_sample.unwrap_or(false),
        modelling_uncertainty: spec.modelling_uncertainty.unwrap_or(0.0),
        classes: read_classes(classes, place)?,
        hazard: None,
        loss_ratios: spec.loss_ratios.as_ref().map(|ratios| ratios.get_ref().clone()),
        samples: None,
        compared: None,
        given: spec.given.as_ref().map_or_else(Vec::new, |given| given.get_ref().clone()),
        weights: Weights::default(),
    })
}

/// Says what is wrong with the loss ratios of limit states.
fn check_losses(fractions: &[f64], ratios: &[f64]) -> Result<(), String> {
    if ratios.len() != fractions.len() {
        let (count, states) = (counted(ratios.len(), "loss ratio"), counted(fractions.len(), "limit state"));
        return Err(format!("loss_ratios: {count} for {states}; give one for each of the fractions"));
    }
    if let Some(ratio) = ratios.iter().find(|ratio| !(0.0..=1.0).contains(*ratio)) {
        return Err(format!("loss_ratios: {ratio} must be from 0 to 1, a part of the value"));
    }
    let mut states: Vec<_> = fractions.iter().zip(ratios).collect();
    states.sort_by(|a, b| a.0.total_cmp(b.0));
    let falls = states.windows(2).find(|pair| pair[1].1 < pair[0].1);
    falls.map_or(Ok(()), |pair| {
        let [(low, less), (high, more)] = [pair[0], pair[1]];
        Err(format!("loss_ratios: {more} at {high} u_ins must not be below {less} at {low} u_ins"))
    })
}

fn read_classes(tables: &[Spanned<ClassTable>], place: &Place<'_>) -> Result<Vec<WallClass>, FileError> {
    let mut classes: Vec<WallClass> = Vec::new();
    for table in tables {
        let ClassTable { name, walls, weights } = table.get_ref();
        let repeated = walls.iter().enumerate().find(|(index, wall)| walls[..*index].contains(wall));
        let message = if classes.iter().any(|class| class.name == *name) {
            Some(format!("the class {name:?} is listed twice; give one another name"))
        } else {
            let wall = repeated.map(|(_, wall)| wall);
            wall.map(|wall| {
                format!("class {name:?}: the wall {wall:?} is listed twice; give it one larger weight")
            })
        };
        if let Some(message) = message {
            return Err(place.error(table.span(), message));
        }
        classes.push(WallClass { name: name.clone(), walls: walls.clone(), weights: weights.clone() });
    }
    Ok(classes)
}
