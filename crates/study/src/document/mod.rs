//! Study files: walls, records, damping models, intensity and levels, as TOML.
//!
//! Parameters of walls stand in the same tables as in a scene. The caller opens the files that a study names.
//!
//! ```
//! use study::document::StudyFile;
//!
//! let text = r#"
//! models = ["CR", "CDC"]
//! levels = { method = "step", step = 0.1, top = 2 }
//! records = { synthetic = { count = 3 } }
//! walls = [{ name = "1", geometry = { height = 3, thickness = 0.3 } }]
//! "#;
//! assert_eq!(StudyFile::parse("study.toml", text)?.models[1].name, "CDC");
//! # Ok::<(), rocking_wall::scene::SceneError>(())
//! ```

mod levels;
mod model;
mod report;

use std::path::PathBuf;

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::{Spanned, Value};

use ground_motion::{Format, RecordOptions, SyntheticMotion, Unit};
use rocking_wall::scene::{
    DEFAULT_TAIL, Floors, GROUPS, Group, Place, Scene, SceneError, StoreyTable, SupportsTable, apply_group,
    parse_toml, read_floors, to_toml,
};
use rocking_wall::wall::Parameters;

use crate::ida::{IntensityMeasure, LONGEST_TAIL, Levels, NamedWall};
use crate::model::Model;

use levels::{IntensityTable, LevelsTable, levels, measure};
use model::model;
use report::{ClassTable, ReportTable, report};

pub use report::{ReportOptions, WallClass};

/// Groups of parameters that a wall of a study may state.
const WALL_GROUPS: [&str; 5] = ["geometry", "force_law", "impact", "tie", "solver"];
/// Most synthetic records of a study.
const MOST_RECORDS: u64 = 10_000;

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
    /// Levels \[m/s²\].
    pub levels: Levels,
    /// Free vibration after each record \[s\].
    pub tail: f64,
    /// Options of the report.
    pub report: ReportOptions,
}

/// A wall of a study.
#[derive(Clone, Debug)]
pub struct WallEntry {
    /// Name; if none is given, that of the scene file.
    pub name: Option<String>,
    /// Source of its parameters.
    pub source: WallSource,
    /// Storeys between ground and wall; if there are none, those of its scene.
    pub floors: Option<Floors>,
}

/// Source of a wall.
#[derive(Clone, Debug)]
pub enum WallSource {
    /// Parameters in the study file itself.
    Inline(Box<Parameters>),
    /// A scene file, relative to the study file, and the line that names it.
    Scene(PathBuf, usize),
    /// A table of many walls (CSV), relative to the study file, and the line that names it.
    Table(PathBuf, usize),
}

/// Records of a study.
#[derive(Clone, Debug, Default)]
pub struct RecordsEntry {
    /// Files, folders and patterns with `*` and `?`, relative to the study file, each with its line.
    pub files: Vec<(String, usize)>,
    /// Options for reading them.
    pub options: RecordOptions,
    /// Synthetic records after them.
    pub synthetic: Vec<SyntheticMotion>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    title: Option<String>,
    models: Vec<Spanned<Value>>,
    tail: Option<Spanned<f64>>,
    #[serde(default)]
    intensity: Option<Spanned<IntensityTable>>,
    levels: Spanned<LevelsTable>,
    records: Option<Spanned<RecordsTable>>,
    report: Option<Spanned<ReportTable>>,
    #[serde(default)]
    classes: Vec<Spanned<ClassTable>>,
    #[serde(default)]
    storeys: Vec<Spanned<StoreyTable>>,
    supports: Option<Spanned<SupportsTable>>,
    /// Read by [`crate::circolare`].
    #[serde(rename = "check")]
    _check: Option<IgnoredAny>,
    #[serde(default)]
    walls: Vec<Spanned<WallTable>>,
}

/// Records of a study or a check, as they are written.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordsTable {
    #[serde(default)]
    files: Vec<Spanned<String>>,
    unit: Option<Unit>,
    step: Option<f64>,
    column: Option<String>,
    channel: Option<String>,
    format: Option<Format>,
    synthetic: Option<Spanned<SyntheticRecords>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SyntheticRecords {
    count: u64,
    seed: Option<u64>,
    duration: Option<f64>,
    step: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WallTable {
    name: Option<String>,
    scene: Option<PathBuf>,
    table: Option<PathBuf>,
    supports: Option<Spanned<SupportsTable>>,
    #[serde(default)]
    geometry: Group,
    #[serde(default)]
    force_law: Group,
    #[serde(default)]
    impact: Group,
    #[serde(default)]
    tie: Group,
    #[serde(default)]
    solver: Group,
}

/// A wall as [`wall_text`] writes it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WallText {
    geometry: Group,
    force_law: Group,
    impact: Group,
    #[serde(default)]
    tie: Group,
    solver: Group,
    #[serde(default)]
    storeys: Vec<Spanned<StoreyTable>>,
    supports: Option<Spanned<SupportsTable>>,
}

/// A file of walls for a check, which needs nothing else of a study.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WallsDocument {
    #[serde(rename = "title")]
    _title: Option<IgnoredAny>,
    #[serde(rename = "check")]
    _check: Option<IgnoredAny>,
    #[serde(default)]
    storeys: Vec<Spanned<StoreyTable>>,
    supports: Option<Spanned<SupportsTable>>,
    walls: Vec<Spanned<WallTable>>,
}

/// Reads the walls of a study's text, or of a text with walls, storeys and `[check]` only.
///
/// # Errors
/// [`SceneError`] with file, line, value and remedy.
pub(crate) fn walls_of(name: &str, text: &str) -> Result<Vec<WallEntry>, SceneError> {
    let place = &Place::new(name, text);
    let keys: toml::Table = parse_toml(place)?;
    if keys.contains_key("models") || keys.contains_key("levels") {
        return Ok(StudyFile::parse(name, text)?.walls);
    }
    let WallsDocument { storeys, supports, walls, .. } = parse_toml(place)?;
    entries(&walls, &storeys, supports.as_ref(), place)
}

fn entries(
    walls: &[Spanned<WallTable>],
    storeys: &[Spanned<StoreyTable>],
    supports: Option<&Spanned<SupportsTable>>,
    place: &Place<'_>,
) -> Result<Vec<WallEntry>, SceneError> {
    let entry = |table: &Spanned<WallTable>| {
        let supports = table.get_ref().supports.as_ref().or(supports);
        Ok(WallEntry { floors: read_floors(storeys, supports, place)?, ..wall(table, place)? })
    };
    walls.iter().map(entry).collect()
}

impl StudyFile {
    /// Reads a study from its text; `name` stands for the file in messages. Walls and records may be missing,
    /// since a program can supply them itself.
    ///
    /// # Errors
    /// [`SceneError`] with file, line, value and remedy.
    pub fn parse(name: &str, text: &str) -> Result<Self, SceneError> {
        let place = &Place::new(name, text);
        let document: Document = parse_toml(place)?;
        let models: Vec<Model> =
            document.models.iter().map(|value| model(value, place)).collect::<Result<_, _>>()?;
        for (index, model) in models.iter().enumerate() {
            if models[..index].iter().any(|other| other.name == model.name) {
                let message = format!("the model {:?} is listed twice; give one another name", model.name);
                return Err(place.error(document.models[index].span(), message));
            }
        }
        let walls = entries(&document.walls, &document.storeys, document.supports.as_ref(), place)?;
        let tail = document.tail.as_ref().map_or(DEFAULT_TAIL, |tail| *tail.get_ref());
        if let Some(given) = document.tail.as_ref().filter(|_| !(0.0..=LONGEST_TAIL).contains(&tail)) {
            return Err(
                place.error(given.span(), format!("tail = {tail} s must be from 0 to {LONGEST_TAIL} s"))
            );
        }
        Ok(Self {
            title: document.title.unwrap_or_else(|| "Incremental dynamic analysis".into()),
            walls,
            records: document
                .records
                .as_ref()
                .map(|table| records(table, place))
                .transpose()?
                .unwrap_or_default(),
            measure: measure(document.intensity.as_ref(), place)?,
            levels: levels(&document.levels, place)?,
            tail,
            report: report(document.report.as_ref(), &document.classes, &models, place)?,
            models,
        })
    }
}

fn wall(table: &Spanned<WallTable>, place: &Place<'_>) -> Result<WallEntry, SceneError> {
    let spec = table.get_ref();
    let [geometry, force_law, impact, tie, solver] = WALL_GROUPS;
    let groups = [
        (geometry, &spec.geometry),
        (force_law, &spec.force_law),
        (impact, &spec.impact),
        (tie, &spec.tie),
        (solver, &spec.solver),
    ];
    let given = [("scene", &spec.scene), ("table", &spec.table)];
    if let Some((kind, path)) = given.into_iter().find_map(|(kind, path)| Some((kind, path.as_ref()?))) {
        let is_other = kind == "scene" && spec.table.is_some();
        let own = groups.iter().find(|(_, group)| !group.is_empty()).map(|(name, _)| *name);
        if let Some(name) = is_other.then_some("table").or(own) {
            let message =
                format!("a wall is either a {kind} or has its own tables; leave out {kind} or {name}");
            return Err(place.error(table.span(), message));
        }
        let line = place.line(table.span());
        let source = if kind == "scene" { WallSource::Scene } else { WallSource::Table };
        return Ok(WallEntry { name: spec.name.clone(), source: source(path.clone(), line), floors: None });
    }
    if let Some(key) = spec.impact.keys().find(|key| key.get_ref() == "impact") {
        let message = "impact is set by the study's models; state restitution_source and restitution only";
        return Err(place.error(key.span(), message));
    }
    if spec.name.is_none() {
        return Err(place.error(table.span(), "a wall needs a name, such as name = \"1\""));
    }
    let mut parameters = Parameters::default();
    for (name, group) in groups {
        apply_group(&mut parameters, name, group, place)?;
    }
    let source = WallSource::Inline(Box::new(parameters));
    Ok(WallEntry { name: spec.name.clone(), source, floors: None })
}

/// Returns the names of the parameters that a wall of a study may state.
pub fn wall_parameters() -> impl Iterator<Item = &'static str> {
    let groups = GROUPS.iter().filter(|(group, _)| WALL_GROUPS.contains(group));
    // the impact is that of the models
    groups.flat_map(|(_, names)| names.iter().copied()).filter(|name| *name != "impact")
}

/// Writes the parameters and storeys of a wall as tables of a study file.
pub fn wall_text(wall: &NamedWall) -> String {
    let (parameters, floors) = (wall.parameters.clone(), wall.floors.clone());
    let text = to_toml(&Scene { parameters, floors, ..Scene::default() }, "");
    let mut is_wanted = false;
    let mut kept = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            let group = line.trim_matches(['[', ']']);
            is_wanted = WALL_GROUPS.contains(&group) || ["supports", "storeys"].contains(&group);
        }
        if is_wanted && !line.is_empty() && !line.starts_with("impact =") {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
}

/// Reads a wall from its tables.
///
/// # Errors
/// [`SceneError`] with line and value.
pub fn wall_of_text(name: String, text: &str) -> Result<NamedWall, SceneError> {
    let place = &Place::new(&name, text);
    let wall: WallText = parse_toml(place)?;
    let mut parameters = Parameters::default();
    for (group, entries) in
        WALL_GROUPS.iter().zip([wall.geometry, wall.force_law, wall.impact, wall.tie, wall.solver])
    {
        apply_group(&mut parameters, group, &entries, place)?;
    }
    let floors = read_floors(&wall.storeys, wall.supports.as_ref(), place)?;
    Ok(NamedWall { name, parameters, floors })
}

pub(crate) fn records(table: &Spanned<RecordsTable>, place: &Place<'_>) -> Result<RecordsEntry, SceneError> {
    let spec = table.get_ref();
    if spec.files.is_empty() && spec.synthetic.is_none() {
        return Err(place.error(table.span(), "[records] needs files = [...] or synthetic = { count = ... }"));
    }
    let RecordsTable { unit, step, format, .. } = *spec;
    let (column, channel) = (spec.column.clone(), spec.channel.clone());
    let options = RecordOptions { unit, step, column, channel, format };
    let files = spec.files.iter().map(|file| (file.get_ref().clone(), place.line(file.span()))).collect();
    let mut synthetic = Vec::new();
    if let Some(recipe) = &spec.synthetic {
        let SyntheticRecords { count, seed, duration, step } = *recipe.get_ref();
        if !(1..=MOST_RECORDS).contains(&count) {
            let message = format!("count = {count} must be from 1 to {MOST_RECORDS}");
            return Err(place.error(recipe.span(), message));
        }
        let default = SyntheticMotion::default();
        let first = seed.unwrap_or(default.seed);
        synthetic.extend((0..count).map(|k| SyntheticMotion {
            seed: first.wrapping_add(k),
            duration: duration.unwrap_or(default.duration),
            step: step.unwrap_or(default.step),
            ..default
        }));
    }
    Ok(RecordsEntry { files, options, synthetic })
}
