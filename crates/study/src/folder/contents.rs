//! The description of a study in its folder. Two studies with equal contents have the same runs.

use std::ops::Range;

use crate::document::ReportOptions;
use crate::ida::{Case, Collapse, IntensityMeasure, IntensityUnit, Layout, Polarity, Scaled, Study};
use crate::results::Fitting;
use run::wall_text::wall_text;
use scene::fingerprint;
use serde::{Deserialize, Serialize};

/// What the runs of a study depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contents {
    /// The program and its version.
    pub program: String,
    /// The sources of the program, see [`crate::SOURCES`].
    pub sources: String,
    /// Name of the intensity measure.
    pub measure: String,
    pub(crate) measure_details: String,
    /// Unit in which results state intensities.
    pub(crate) unit: IntensityUnit,
    /// Periods of the spectrum of the site \[s\], and its shape, where it is the measure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<[Vec<f64>; 2]>,
    pub(crate) levels: String,
    #[serde(flatten)]
    pub(crate) layout: Layout,
    /// Levels where all records share them, in SI units.
    pub(crate) grid: Option<Vec<f64>>,
    pub(crate) tail_s: f64,
    /// Which runs have overturned.
    pub(crate) collapse_is: Collapse,
    /// The signs with which records are run.
    #[serde(default)]
    pub(crate) polarity: Polarity,
    /// Whether the levels scale the last shock of each record alone.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) scales_last: bool,
    /// Combinations of each part; the last part may have fewer.
    pub part_size: usize,
    /// Damping models.
    pub models: Vec<ModelNote>,
    /// Records.
    pub records: Vec<RecordNote>,
    /// Walls.
    pub walls: Vec<WallNote>,
}

/// A wall, as the contents describe it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallNote {
    /// Name.
    pub name: String,
    /// Tables of parameters and storeys, as in a study file.
    pub parameters: String,
    /// Coefficient of restitution \[-\].
    pub restitution: f64,
    /// Damping ratio with each model \[-\].
    pub xi: Vec<f64>,
    /// Whether it has ties that may yield.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_yielding_tie: bool,
}

/// A damping model, as the contents describe it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelNote {
    /// Name.
    pub name: String,
    /// The model and its values.
    pub damping: String,
}

/// A record, as the contents describe it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordNote {
    /// Name.
    pub name: String,
    /// Fingerprint of the samples.
    pub fingerprint: String,
    /// Number of samples.
    pub points: usize,
    /// Step \[s\].
    pub step_s: f64,
    /// Intensity, in the SI unit of the measure.
    pub intensity: f64,
    /// Factor of a list by which the samples have been multiplied \[-\], other than 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor: Option<f64>,
    /// Its spectrum over that of the site, at each period of the measure; empty for other measures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ratios: Vec<f64>,
}

/// The description of a study in its folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Title.
    pub title: String,
    /// Options of the report.
    pub report: ReportOptions,
    /// What the runs depend on.
    pub contents: Contents,
    /// Fingerprint of the other fields.
    pub(crate) checksum: String,
}

impl Manifest {
    pub(crate) fn new(title: String, report: ReportOptions, contents: Contents) -> Self {
        let mut manifest = Self { title, report, contents, checksum: String::new() };
        manifest.checksum = manifest.fingerprint();
        manifest
    }

    /// Returns what makes the results of its walls.
    pub fn fitting(&self) -> Fitting {
        let Contents { models, records, grid, polarity, layout, .. } = &self.contents;
        let models: Vec<_> = models.iter().map(|model| model.name.as_str()).collect();
        Fitting::new(records.len(), &models, grid.clone(), &self.report)
            .with_polarity(*polarity)
            .with_layout(*layout)
    }

    /// Returns the fingerprint of all fields except the checksum.
    pub(crate) fn fingerprint(&self) -> String {
        let head = json(&(&self.title, &self.report, self.contents.fingerprint()));
        fingerprint(head.as_bytes())
    }
}

impl Contents {
    /// Says how the intervals of medians are made; those of a cloud are its θ.
    pub(crate) fn interval_of_medians(&self) -> &'static str {
        if self.layout == Layout::Curves { "by percentiles" } else { "studentised" }
    }

    /// Collects the contents of a study.
    pub fn of(study: &Study) -> Self {
        let models = study.models();
        let walls = study.walls().iter().enumerate().map(|(index, wall)| {
            let made: Vec<_> = (0..models.len()).map(|model| study.wall(index, model)).collect();
            WallNote {
                name: wall.name.clone(),
                parameters: wall_text(wall),
                restitution: made[0].restitution().positive,
                xi: made.iter().map(rocking_wall::wall::Wall::damping_ratio).collect(),
                has_yielding_tie: study.has_yielding_tie(index),
            }
        });
        let records = study.records().iter().enumerate().map(|(index, record)| {
            let samples = record.motion.samples();
            let bytes: Vec<u8> = samples.iter().flat_map(|sample| sample.to_bits().to_le_bytes()).collect();
            RecordNote {
                name: record.name.clone(),
                fingerprint: fingerprint(&bytes),
                points: samples.len(),
                step_s: record.motion.step(),
                intensity: study.intensity(index),
                factor: Some(record.listed.factor).filter(|factor| *factor != 1.0),
                ratios: study
                    .measure()
                    .ratios(&study.scaled_motion(index))
                    .ok()
                    .flatten()
                    .unwrap_or_default(),
            }
        });
        Self {
            program: format!("rocking-wall {}", env!("CARGO_PKG_VERSION")),
            sources: crate::SOURCES.to_owned(),
            measure: study.measure().name(),
            measure_details: study.measure().description(),
            unit: study.measure().unit(),
            spectrum: match study.measure() {
                IntensityMeasure::Code { periods, shape } => Some([periods.clone(), shape.clone()]),
                _ => None,
            },
            levels: study.levels().description(study.measure().unit().si()),
            layout: study.levels().layout(),
            grid: study.levels().shared(),
            tail_s: study.tail(),
            collapse_is: study.collapse(),
            polarity: study.polarity(),
            scales_last: study.scaled == Scaled::Last,
            part_size: study.part_size(),
            walls: walls.collect(),
            models: models
                .iter()
                .map(|model| ModelNote { name: model.name.clone(), damping: model.loss.name() })
                .collect(),
            records: records.collect(),
        }
    }

    /// Returns the measure and its unit, for axes: `PGA (g)`.
    pub(crate) fn axis(&self) -> String {
        format!("{} ({})", self.measure, self.unit.name())
    }

    /// Counts the combinations.
    pub fn count(&self) -> usize {
        self.walls.len() * self.models.len() * self.records.len()
    }

    /// Returns whether a wall has ties that may yield: its runs have a demand on them.
    pub fn has_yielding_ties(&self) -> bool {
        self.walls.iter().any(|wall| wall.has_yielding_tie)
    }

    /// Counts the parts.
    pub fn parts(&self) -> usize {
        self.count().div_ceil(self.part_size)
    }

    /// Returns the parts of a share of several: `number` is from 1 to `of`.
    pub fn shard(&self, number: usize, of: usize) -> impl Iterator<Item = usize> + use<> {
        (number - 1..self.parts()).step_by(of)
    }

    /// Returns the numbers of the combinations of a part.
    pub fn part(&self, part: usize) -> Range<usize> {
        part * self.part_size..((part + 1) * self.part_size).min(self.count())
    }

    /// Returns the combination of a number, as [`Study::case`] counts.
    pub fn case(&self, index: usize) -> Case {
        let (records, models) = (self.records.len(), self.models.len());
        Case { wall: index / (records * models), model: index / records % models, record: index % records }
    }

    /// Returns the fingerprint of the contents.
    pub fn fingerprint(&self) -> String {
        // wall by wall: the text of thousands of walls at once would be the largest thing in memory
        let fingerprints: Vec<_> = self.walls.iter().map(|wall| fingerprint(json(wall).as_bytes())).collect();
        fingerprint((self.head() + &fingerprints.concat()).as_bytes())
    }

    /// Writes everything except the walls.
    fn head(&self) -> String {
        let Self { program, sources, measure, measure_details, levels, grid, collapse_is, .. } = self;
        let how = (self.tail_s, collapse_is, self.polarity, self.scales_last, self.part_size);
        let runs = (program, sources, measure, measure_details, levels, grid, how);
        format!("{}\n{}\n{}", json(&runs), json(&self.models), json(&self.records))
    }

    /// Describes the first line in which two contents differ.
    pub(crate) fn difference(&self, other: &Self) -> String {
        // a table of parameters is one text with many lines
        let [mine, theirs] = [self, other].map(|contents| {
            let text = serde_json::to_string_pretty(contents);
            text.unwrap_or_else(|error| unreachable!("plain data: {error}")).replace("\\n", "\n")
        });
        let pair = mine.lines().zip(theirs.lines()).find(|(mine, theirs)| mine != theirs);
        pair.map_or_else(
            || "one has more lines than the other".to_owned(),
            |(mine, theirs)| format!("found {}, expected {}", trimmed(mine), trimmed(theirs)),
        )
    }
}

/// Writes plain data as JSON; with plain data this cannot fail.
fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|error| unreachable!("plain data: {error}"))
}

/// Shortens a line.
fn trimmed(line: &str) -> String {
    const LONGEST: usize = 160;
    line.trim().trim_end_matches(',').chars().take(LONGEST).collect()
}
