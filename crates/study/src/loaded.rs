//! Studies read from files: a study file, and the scenes and records that it names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ground_motion::{GroundMotionError, read};
use rocking_wall::scene::{Scene, SceneError};
use rocking_wall::wall::{Wall, Warning};

use crate::document::{RecordsEntry, ReportOptions, StudyFile, WallEntry, WallSource};
use crate::ida::{NamedRecord, NamedWall, Study};

/// Largest study file that is read.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// A study ready to run, and what is to be made of it.
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
    /// What the walls and a quick check of the records warn of.
    pub warnings: Vec<String>,
}

impl LoadedStudy {
    /// Reads a study file. Scenes and records that it names are looked up beside it.
    ///
    /// # Errors
    /// [`SceneError`], with file, line, value and remedy.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = text(path, &name)?;
        let StudyFile { title, walls, records, models, measure, levels, tail, report } =
            StudyFile::parse(&name, &text)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut inputs, mut warnings) = (vec![path.to_owned()], Vec::new());
        let read = |entry| wall(entry, folder, &name, &mut inputs, &mut warnings);
        let walls = walls.into_iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let paths = record_files(&records, folder, &name)?;
        let records = all_records(&records, &paths, &name, &mut warnings)?;
        inputs.extend(paths);
        let in_file = |reason: String| SceneError::File { file: name.clone(), reason };
        check_unique("walls", walls.iter().map(|wall| &wall.name)).map_err(in_file)?;
        check_unique("records", records.iter().map(|record| &record.name)).map_err(in_file)?;
        let study = Study::new(walls, records, models, measure, levels)
            .and_then(|study| study.with_tail(tail))
            .map_err(|error| in_file(error.to_string()))?;
        Ok(Self { title, study, report, inputs, warnings })
    }
}

/// Reads the text of a study file. A pipe is refused before it is opened, which would wait for its writer.
fn text(path: &Path, name: &str) -> Result<String, SceneError> {
    let fail = |reason: String| SceneError::File { file: name.to_owned(), reason };
    let unreadable = |error: std::io::Error| fail(format!("cannot be read: {error}"));
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() || metadata.len() > MAX_FILE_BYTES {
        return Err(fail(format!("expected a study file (TOML) of at most {MAX_FILE_BYTES} bytes")));
    }
    std::fs::read_to_string(path).map_err(unreadable)
}

fn wall(
    entry: WallEntry,
    folder: &Path,
    study: &str,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<NamedWall, SceneError> {
    let mut is_shaken = false;
    let (parameters, own_name, own_floors) = match entry.source {
        WallSource::Inline(parameters) => (*parameters, String::new(), None),
        WallSource::Scene(path) => {
            inputs.push(folder.join(&path));
            let scene = Scene::read(&folder.join(&path)).map_err(|error| SceneError::Line {
                file: study.to_owned(),
                line: entry.line,
                message: format!("a wall's scene: {error}"),
            })?;
            is_shaken = scene.excitation.is_some();
            let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            (scene.parameters, stem, scene.floors)
        }
    };
    let name = entry.name.unwrap_or(own_name);
    if is_shaken {
        warnings
            .push(format!("wall {name:?}: the study ignores the motion of its scene and uses its records"));
    }
    let made = Wall::new(&parameters);
    let about_work = made.iter().flat_map(|wall| wall.warnings().to_vec()).filter(Warning::is_about_work);
    warnings.extend(about_work.map(|warning| format!("wall {name:?}: {warning}")));
    warnings.extend(Warning::unusual(&parameters).map(|warning| format!("wall {name:?}: {warning}")));
    let floors = entry.floors.or(own_floors);
    let heavy = made.ok().and_then(|wall| floors.as_ref()?.warning(&wall));
    warnings.extend(heavy.map(|warning| format!("wall {name:?}: {warning}")));
    Ok(NamedWall { name, parameters, floors })
}

/// Lists the record files of a study, in the order of its patterns.
fn record_files(entry: &RecordsEntry, folder: &Path, study: &str) -> Result<Vec<PathBuf>, SceneError> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for (pattern, line) in &entry.files {
        let found = files(&folder.join(pattern)).map_err(|reason| SceneError::Line {
            file: study.to_owned(),
            line: *line,
            message: format!("{pattern:?}: {reason}"),
        })?;
        // a file that two patterns match is one record
        paths.extend(found.into_iter().filter(|path| !paths.contains(path)).collect::<Vec<_>>());
    }
    Ok(paths)
}

fn all_records(
    entry: &RecordsEntry,
    paths: &[PathBuf],
    study: &str,
    warnings: &mut Vec<String>,
) -> Result<Vec<NamedRecord>, SceneError> {
    let short =
        |path: &Path| path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for path in paths {
        *uses.entry(short(path)).or_default() += 1;
    }
    let mut records = Vec::with_capacity(paths.len() + entry.synthetic.len());
    for path in paths {
        let refused = |error: GroundMotionError| SceneError::Value { message: error.to_string() };
        let record = read(path, &entry.options).map_err(refused)?;
        warnings.extend(record.check().warnings.iter().map(|w| format!("{}: {w}", path.display())));
        let motion = record.motion;
        let name = short(path);
        // files with equal names go by their whole paths
        let name = if uses[&name] > 1 { path.display().to_string() } else { name };
        records.push(NamedRecord { name, motion });
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
fn files(path: &Path) -> Result<Vec<PathBuf>, String> {
    let visible = |path: &Path| {
        path.is_file() && path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.'))
    };
    let told = |error: &dyn std::fmt::Display| error.to_string();
    let mut found: Vec<PathBuf> = if path.is_dir() {
        let entries = std::fs::read_dir(path).map_err(|error| told(&error))?;
        entries
            .map(|entry| Ok(entry?.path()))
            .collect::<std::io::Result<_>>()
            .map_err(|error| told(&error))?
    } else if path.is_file() {
        return Ok(vec![path.to_owned()]);
    } else {
        let pattern = path.to_str().ok_or("expected a name in UTF-8")?;
        let matches = glob::glob(pattern).map_err(|error| told(&error))?;
        matches.collect::<Result<_, _>>().map_err(|error| told(&error))?
    };
    found.retain(|path| visible(path));
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
