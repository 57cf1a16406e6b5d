//! Studies read from files: a study file, and the scenes and records that it names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ground_motion::{GroundMotion, GroundMotionError, is_listed, read};
use rocking_wall::scene::{Scene, SceneError, read_text};
use rocking_wall::wall::{COMPUTED, Parameters, Usual, Wall, Warning};

use crate::document::{
    RecordsEntry, ReportOptions, StudyFile, WallEntry, WallSource, wall_of_text, wall_text, walls_of,
};
use crate::ida::{IntensityMeasure, NamedRecord, NamedWall, Study};
use crate::model::Model;
use crate::wall_table;

/// Largest study file that is read.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// A study ready to run, and the options of its report.
#[derive(Clone, Debug)]
pub struct LoadedStudy {
    /// Title.
    pub title: String,
    /// The study.
    pub study: Study,
    /// Options of the report.
    pub report: ReportOptions,
    /// Files that it was read from.
    pub inputs: Vec<PathBuf>,
    /// Warnings of the walls and of a quick check of the records.
    pub warnings: Vec<String>,
    /// Text of the study file.
    text: String,
}

/// A study as plain values, to send it to a machine without its files.
#[derive(Clone, Debug)]
pub struct Sent {
    /// Text of the study file.
    pub text: String,
    /// Walls: names, and parameters as the tables of a study file.
    pub walls: Vec<(String, String)>,
    /// Records: names, steps \[s\] and samples \[m/s²\].
    pub records: Vec<(String, f64, Vec<f64>)>,
}

impl LoadedStudy {
    /// Reads a study file. Scenes and records that it names are looked up beside it.
    ///
    /// # Errors
    /// [`SceneError`], with file, line, value and remedy.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = read_text(path, "a study file (TOML)", MAX_FILE_BYTES)?;
        let mut file = StudyFile::parse(&name, &text)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut inputs, mut ignored, mut warnings) = (vec![path.to_owned()], Vec::new(), Vec::new());
        let mut walls = Vec::with_capacity(file.walls.len());
        for entry in std::mem::take(&mut file.walls) {
            walls.extend(wall(entry, folder, &name, &mut inputs, (&mut ignored, &mut warnings))?);
        }
        warn(&walls, &ignored, (&file.models, &file.measure), &mut warnings);
        let paths = record_files(&file.records, folder, &name)?;
        let records = all_records(&file.records, &paths, &name, &mut warnings)?;
        inputs.extend(paths.into_iter().map(|file| file.path));
        let study = Self::assemble(&name, text, file, walls, records)?;
        warnings.extend(study.study.warning().map(|warning| format!("{name}, levels: {warning}")));
        Ok(Self { inputs, warnings, ..study })
    }

    /// Makes a study of walls and records that no file names, and of the other keys of a study file.
    ///
    /// # Errors
    /// [`SceneError`] of a key, or where walls, records and models do not go together.
    pub fn of_parts(
        text: String,
        walls: Vec<NamedWall>,
        records: Vec<NamedRecord>,
    ) -> Result<Self, SceneError> {
        let name = "the study";
        let file = StudyFile::parse(name, &text)?;
        let mut warnings = Vec::new();
        warn(&walls, &[], (&file.models, &file.measure), &mut warnings);
        Self::assemble(name, text, file, walls, records).map(|study| Self { warnings, ..study })
    }

    /// Returns the study as plain values.
    pub fn sent(&self) -> Sent {
        let wall = |wall: &NamedWall| (wall.name.clone(), wall_text(wall));
        let record = |record: &NamedRecord| {
            (record.name.clone(), record.motion.step(), record.motion.samples().to_vec())
        };
        Sent {
            text: self.text.clone(),
            walls: self.study.walls().iter().map(wall).collect(),
            records: self.study.records().iter().map(record).collect(),
        }
    }

    /// Makes the study from plain values.
    ///
    /// # Errors
    /// [`SceneError`] if they are not those of [`Self::sent`].
    pub fn received(sent: Sent) -> Result<Self, SceneError> {
        let name = "a study that was sent";
        let file = StudyFile::parse(name, &sent.text)?;
        let wall = |(name, text): (String, String)| wall_of_text(name, &text);
        let walls = sent.walls.into_iter().map(wall).collect::<Result<_, _>>()?;
        let record = |(name, step, samples)| {
            let motion = GroundMotion::new(step, samples);
            let refused = |error: GroundMotionError| SceneError::Value { message: error.to_string() };
            Ok(NamedRecord { name, motion: motion.map_err(refused)? })
        };
        let records = sent.records.into_iter().map(record).collect::<Result<_, SceneError>>()?;
        Self::assemble(name, sent.text, file, walls, records)
    }

    fn assemble(
        name: &str,
        text: String,
        file: StudyFile,
        walls: Vec<NamedWall>,
        records: Vec<NamedRecord>,
    ) -> Result<Self, SceneError> {
        let StudyFile { title, models, measure, levels, tail, report, .. } = file;
        let in_file = |reason: String| SceneError::File { file: name.to_owned(), reason };
        check_unique("walls", walls.iter().map(|wall| &wall.name)).map_err(in_file)?;
        check_unique("records", records.iter().map(|record| &record.name)).map_err(in_file)?;
        for class in &report.classes {
            class.check(walls.iter().map(|wall| wall.name.as_str())).map_err(in_file)?;
        }
        let study = Study::new(walls, records, models, measure, levels)
            .and_then(|study| study.with_tail(tail))
            .map_err(|error| in_file(error.to_string()))?;
        Ok(Self { title, study, report, inputs: Vec::new(), warnings: Vec::new(), text })
    }
}

/// Reads the walls of a study's text, or of a text with walls only. Scenes and tables that it names are
/// looked up beside its file. Adds the files that are read, and warnings about tables.
///
/// # Errors
/// [`SceneError`], with file, line, value and remedy.
pub(crate) fn read_walls(
    text: &str,
    path: &Path,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<NamedWall>, SceneError> {
    let name = path.display().to_string();
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut walls = Vec::new();
    inputs.push(path.to_owned());
    for entry in walls_of(&name, text)? {
        // a check uses neither the motion nor the damping of a scene
        walls.extend(wall(entry, folder, &name, inputs, (&mut Vec::new(), warnings))?);
    }
    check_unique("walls", walls.iter().map(|wall| &wall.name))
        .map_err(|reason| SceneError::File { file: name, reason })?;
    Ok(walls)
}

/// The name of a wall, and what the study ignores of its scene.
type Ignored = (String, &'static str);

/// Reads the walls of an entry. Adds what the study ignores of scenes, and warnings about tables.
fn wall(
    entry: WallEntry,
    folder: &Path,
    study: &str,
    inputs: &mut Vec<PathBuf>,
    (ignored, warnings): (&mut Vec<Ignored>, &mut Vec<String>),
) -> Result<Vec<NamedWall>, SceneError> {
    let at = |line, what: &str, error: SceneError| SceneError::Line {
        file: study.to_owned(),
        line,
        message: format!("{what}: {error}"),
    };
    match entry.source {
        WallSource::Inline(parameters) => {
            let name = entry.name.unwrap_or_default();
            Ok(vec![NamedWall { name, parameters: *parameters, floors: entry.floors }])
        }
        WallSource::Table(path, line) => {
            let path = folder.join(path);
            let (walls, found) =
                wall_table::read(&path).map_err(|error| at(line, "a table of walls", error))?;
            warnings.extend(found);
            inputs.push(path);
            Ok(walls.into_iter().map(|wall| NamedWall { floors: entry.floors.clone(), ..wall }).collect())
        }
        WallSource::Scene(path, line) => {
            inputs.push(folder.join(&path));
            let scene =
                Scene::read(&folder.join(&path)).map_err(|error| at(line, "a wall's scene", error))?;
            let stem = || path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
            let name = entry.name.or_else(stem).unwrap_or_default();
            if scene.excitation.is_some() {
                let warning = "the study ignores the motion of its scene and uses its records";
                ignored.push((name.clone(), warning));
            }
            let Parameters { xi, c_bar, .. } = scene.parameters;
            if xi != COMPUTED || c_bar != COMPUTED {
                let warning = "the study ignores the damping of its scene and uses its models";
                ignored.push((name.clone(), warning));
            }
            let floors = entry.floors.or(scene.floors);
            Ok(vec![NamedWall { name, parameters: scene.parameters, floors }])
        }
    }
}

/// Returns the parameters of a wall that are set and have no effect with any of the models.
fn unused(parameters: &Parameters, models: &[Model]) -> Vec<Warning> {
    let of_model = |model: &Model| {
        let wall = Wall::new(&model.applied_to(parameters).ok()?).ok()?;
        Some(wall.warnings().iter().filter(|w| matches!(w, Warning::NoEffect { .. })).cloned().collect())
    };
    let common =
        |left: Vec<Warning>, right: Vec<Warning>| left.into_iter().filter(|w| right.contains(w)).collect();
    models.iter().filter_map(of_model).reduce(common).unwrap_or_default()
}

/// Adds the warnings of each wall, by its name: what is ignored of its scene, improbable numbers, parameters
/// without effect. Then those of the intensity measure and the models.
fn warn(
    walls: &[NamedWall],
    ignored: &[Ignored],
    (models, measure): (&[Model], &IntensityMeasure),
    warnings: &mut Vec<String>,
) {
    for NamedWall { name, parameters, floors } in walls {
        let made = Wall::new(parameters).ok();
        let about_work =
            made.iter().flat_map(Wall::warnings).filter(|warning| warning.is_about_work()).cloned();
        let found =
            unused(parameters, models).into_iter().chain(about_work).chain(Warning::unusual(parameters));
        let of_floors = floors.as_ref().zip(made.as_ref());
        let of_floors = of_floors.into_iter().flat_map(|(floors, wall)| floors.warnings(wall));
        let own = ignored.iter().filter(|(wall, _)| wall == name).map(|(_, warning)| (*warning).to_owned());
        let all = own.chain(found.map(|warning| warning.to_string())).chain(of_floors);
        warnings.extend(all.map(|warning| format!("wall {name:?}: {warning}")));
    }
    let periods: &[f64] = match measure {
        IntensityMeasure::Pga => &[],
        IntensityMeasure::Sa { period } => std::slice::from_ref(period),
        IntensityMeasure::AvgSa { periods } => periods,
    };
    let unusual =
        periods.iter().filter_map(|period| Usual::period("period of the intensity").warning(*period));
    warnings.extend(unusual.map(|warning| warning.to_string()));
    for model in models {
        warnings.extend(model.unusual().map(|warning| format!("model {:?}: {warning}", model.name)));
    }
}

/// A record file of a study.
pub(crate) struct RecordFile {
    pub(crate) path: PathBuf,
    /// Whether the study names the file itself, and not its folder or a pattern.
    is_named: bool,
}

/// Lists the record files of a study, in the order of its patterns.
pub(crate) fn record_files(
    entry: &RecordsEntry,
    folder: &Path,
    study: &str,
) -> Result<Vec<RecordFile>, SceneError> {
    let mut listed: Vec<RecordFile> = Vec::new();
    for (pattern, line) in &entry.files {
        let place = folder.join(pattern);
        let is_named = place.is_file();
        let found = files(&place).map_err(|reason| SceneError::Line {
            file: study.to_owned(),
            line: *line,
            message: format!("{pattern:?}: {reason}"),
        })?;
        for path in found {
            // a file that two patterns match is one record
            match listed.iter_mut().find(|file| file.path == path) {
                Some(file) => file.is_named |= is_named,
                None => listed.push(RecordFile { path, is_named }),
            }
        }
    }
    Ok(listed)
}

/// Reads the records of a study. Vertical ones of a folder or a pattern are left out, with a warning.
pub(crate) fn all_records(
    entry: &RecordsEntry,
    files: &[RecordFile],
    study: &str,
    warnings: &mut Vec<String>,
) -> Result<Vec<NamedRecord>, SceneError> {
    let short =
        |path: &Path| path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for RecordFile { path, .. } in files {
        *uses.entry(short(path)).or_default() += 1;
    }
    let mut records = Vec::with_capacity(files.len() + entry.synthetic.len());
    for RecordFile { path, is_named } in files {
        let refused = |error: GroundMotionError| SceneError::Value { message: error.to_string() };
        let record = read(path, &entry.options).map_err(refused)?;
        if record.is_vertical && !is_named {
            let path = path.display();
            warnings.push(format!("{path}: vertical, left out; name the file itself to use it"));
            continue;
        }
        warnings.extend(record.check().warnings.iter().map(|w| format!("{}: {w}", path.display())));
        let motion = record.motion;
        let name = short(path);
        // files with equal names go by their whole paths
        let name = if uses[&name] > 1 { path.display().to_string() } else { name };
        records.push(NamedRecord { name, motion });
    }
    if records.is_empty() && !files.is_empty() && entry.synthetic.is_empty() {
        let reason =
            "records: all are vertical, and records shake walls sideways; name horizontal ones".into();
        return Err(SceneError::File { file: study.to_owned(), reason });
    }
    for recipe in &entry.synthetic {
        let motion = recipe.motion().map_err(|error| SceneError::File {
            file: study.to_owned(),
            reason: format!("synthetic records: {error}"),
        })?;
        records.push(NamedRecord { name: format!("synthetic {}", recipe.seed), motion });
    }
    Ok(records)
}

/// Lists the files of a folder, of a pattern, or the one file, in order of their names.
fn files(path: &Path) -> Result<Vec<PathBuf>, Box<dyn std::error::Error>> {
    let mut found: Vec<PathBuf> = if path.is_dir() {
        std::fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?
    } else if path.is_file() {
        return Ok(vec![path.to_owned()]);
    } else {
        let pattern = path.to_str().ok_or("expected a name in UTF-8")?;
        glob::glob(pattern)?.collect::<Result<_, _>>()?
    };
    found.retain(|path| is_listed(path));
    found.sort();
    if found.is_empty() {
        return Err(
            "no such file, no match, or a folder without files; name records beside the study file, \
                    such as records/*.AT2"
                .into(),
        );
    }
    Ok(found)
}

fn check_unique<'a>(what: &str, names: impl Iterator<Item = &'a String>) -> Result<(), String> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(format!("{what}: the name {name:?} occurs twice; give each its own"));
        }
    }
    Ok(())
}
