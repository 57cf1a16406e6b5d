//! Study files: walls, records, damping models, intensity and levels, as TOML.
//!
//! Parameters of walls stand in the same tables as in a scene. The caller opens the files that a study names.
//!
//! ```
//! use study::codes::NoCodes;
//! use study::document::StudyFile;
//!
//! let text = r#"
//! models = ["CR", "CDC"]
//! levels = { method = "step", step = 0.1, top = 2 }
//! records = { synthetic = { count = 3 } }
//! walls = [{ name = "1", geometry = { height = 3, thickness = 0.3 } }]
//! "#;
//! assert_eq!(StudyFile::parse("study.toml", text, &NoCodes)?.models[1].name, "CDC");
//! # Ok::<(), scene::SceneError>(())
//! ```

mod compare;
mod hazard;
mod hazard_file;
mod levels;
mod model;
mod report;
mod uncertain;

use files::{Schema, TomlFile, file_schema, names, tables, with};
use run::model::Model;
use run::records::{RecordsEntry, RecordsTable, records};
use run::walls::{WallEntry, WallTable, entries};
use scene::{DEFAULT_TAIL, SceneError, StoreyTable, SupportsTable};
use serde::de::IgnoredAny;
use toml::{Spanned, Value};

use crate::codes::Codes;
use crate::ida::{Collapse, IdaError, IntensityMeasure, LONGEST_TAIL, Levels, Polarity, Scaled};
use crate::uncertain::Uncertain;

use compare::compare;
use hazard::{HazardTable, hazard};
use levels::{IntensityTable, LevelsTable, levels, measure, stripes};
use model::{model, model_schema};
use report::{ClassTable, ReliabilityTable, ReportTable, TARGET, report};
use uncertain::{UncertainTable, uncertain};

pub use compare::CompareEntry;
pub use hazard::HazardEntry;
pub use report::{ReportOptions, WallClass};

/// Content of a study file, in SI units.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// Title.
    pub title: String,
    /// Walls in order.
    pub walls: Vec<WallEntry>,
    /// Records.
    pub records: RecordsEntry,
    /// Damping models in order.
    pub models: Vec<Model>,
    /// Intensity measure.
    pub measure: IntensityMeasure,
    /// How many of the records are taken, those that fit the spectrum of the site best; all where `None`.
    pub select: Option<usize>,
    /// The measures that it compares.
    pub compare: Option<CompareEntry>,
    /// Levels, in the SI unit of the measure.
    pub levels: Levels,
    /// Free vibration after each record \[s\].
    pub tail: f64,
    /// Which runs have overturned.
    pub collapse: Collapse,
    /// The signs with which records are run.
    pub polarity: Polarity,
    /// What the levels scale of records that are sequences.
    pub scaled: Scaled,
    /// Options of the report, without the hazard.
    pub report: ReportOptions,
    /// Probability of a fall for which a study of reliability seeks the numbers of a code \[-\].
    pub target: f64,
    /// The hazard.
    pub hazard: Option<HazardEntry>,
    /// Uncertain parameters, and warnings about their distributions.
    pub uncertain: Option<(Uncertain, Vec<String>)>,
}

tables! {
    /// A study.
    #[derive(Debug)]
    struct Document {
        /// Title, for people.
        title: Option<String>,
        /// Damping models by their names, or with a given ratio.
        #[key(items = model_schema(), minItems = 1)]
        models: Vec<Spanned<Value>>,
        /// Free vibration after each record \[s\].
        #[key(minimum = 0, maximum = LONGEST_TAIL, default = DEFAULT_TAIL)]
        tail: Option<f64>,
        /// Which runs have collapsed: those that exceed `u_ins`, or those that fall and do not come back.
        #[key(default = "exceeds")]
        collapse_is: Option<Spanned<Collapse>>,
        /// The signs with which records are run: as they are, reversed, both as two records, or at each level
        /// the one that demands more of the wall.
        #[key(default = "as_recorded")]
        polarity: Option<Polarity>,
        /// What the levels scale of records that are sequences: all shocks, or the last one, the others being
        /// as they are.
        #[key(default = "all")]
        scaled_shocks: Option<Scaled>,
        /// Intensity measure by which records are scaled.
        intensity: Option<Spanned<IntensityTable>>,
        /// Levels of intensity.
        levels: Spanned<LevelsTable>,
        /// Records from files, and synthetic ones after them.
        records: Option<Spanned<RecordsTable>>,
        /// What the results show.
        report: Option<Spanned<ReportTable>>,
        /// What a study of reliability asks.
        reliability: Option<ReliabilityTable>,
        /// Annual rates of intensities.
        hazard: Option<Spanned<HazardTable>>,
        /// Parameters of the walls that are not known: each wall stands for samples of them.
        uncertain: Option<Spanned<UncertainTable>>,
        /// Classes of walls that risk engines see as one.
        #[serde(default)]
        classes: Vec<Spanned<ClassTable>>,
        /// Storeys between the ground and the walls, the lowest first; records shake the ground.
        #[serde(default)]
        storeys: Vec<Spanned<StoreyTable>>,
        /// The floors that support the walls.
        supports: Option<Spanned<SupportsTable>>,
        /// A check by a code, which `wall check` reads.
        #[serde(rename = "check")]
        _check: Option<IgnoredAny>,
        /// Walls.
        #[serde(default)]
        #[key(minItems = 1)]
        walls: Vec<Spanned<WallTable>>,
    }
}

impl StudyFile {
    /// Returns the JSON schema of study files.
    pub fn schema() -> Schema {
        // a program may supply walls and records itself, a file has both
        let required = vec!["models", "levels", "records", "walls"];
        with(file_schema::<Document>("Study of rocking-wall"), "required", required)
    }

    /// Returns the keys of study files.
    pub fn keys() -> &'static [&'static str] {
        names::<Document>()
    }

    /// Reads a study from its text; `name` stands for the file in messages, and `codes` answer what
    /// `measure = "code"` asks. Walls and records may be missing,
    /// since a program can supply them itself.
    ///
    /// # Errors
    /// [`SceneError`] with file, line, value and remedy.
    pub fn parse(name: &str, text: &str, codes: &dyn Codes) -> Result<Self, SceneError> {
        let file = &TomlFile::new(name, text)?;
        let (document, place): (Document, _) = (file.read()?, file.place());
        let models: Vec<Model> =
            document.models.iter().map(|value| model(value, place)).collect::<Result<_, _>>()?;
        for (index, model) in models.iter().enumerate() {
            if models[..index].iter().any(|other| other.name == model.name) {
                let message = format!("the model {:?} is listed twice; give one another name", model.name);
                return Err(place.error(document.models[index].span(), message).into());
            }
        }
        let walls = entries(&document.walls, &document.storeys, document.supports.as_ref(), file)?;
        let measure = measure(document.intensity.as_ref(), codes, file)?;
        let levels = levels(&document.levels, &measure, place)?;
        let outside = |error: IdaError| place.error(document.levels.span(), error.to_string());
        levels.check(measure.unit()).map_err(outside)?;
        let stripes = stripes(&document.levels, place);
        if let (Some(word), Levels::Cloud { .. }) = (&document.collapse_is, &levels)
            && *word.get_ref() == Collapse::Falls
        {
            let message = "collapse_is = \"falls\" has no part in a cloud: its regression takes a demand of \
                           u_ins and more as a collapse; leave it out, or give levels of another method, \
                           such as \"hunt\"";
            return Err(place.error(word.span(), message).into());
        }
        let scaled = document.scaled_shocks.unwrap_or_default();
        Ok(Self {
            title: document.title.unwrap_or_else(|| "Incremental dynamic analysis".into()),
            walls,
            records: document
                .records
                .as_ref()
                .map(|table| records(table, stripes.clone(), place))
                .transpose()?
                .unwrap_or(RecordsEntry { selections: stripes, ..RecordsEntry::default() }),
            compare: compare(document.intensity.as_ref(), &measure, codes, file)?,
            select: document.intensity.and_then(|table| table.into_inner().select).map(Spanned::into_inner),
            tail: document.tail.unwrap_or(DEFAULT_TAIL),
            collapse: document.collapse_is.map(Spanned::into_inner).unwrap_or_default(),
            polarity: document.polarity.unwrap_or_default(),
            hazard: document.hazard.as_ref().map(|table| hazard(table, &measure, place)).transpose()?,
            uncertain: document.uncertain.as_ref().map(|table| uncertain(table, place)).transpose()?,
            scaled,
            report: report(document.report.as_ref(), &document.classes, &models, &levels, scaled, place)?,
            target: document.reliability.and_then(|table| table.probability).unwrap_or(TARGET),
            levels,
            models,
            measure,
        })
    }
}
