//! Reads a study file, and the scenes and records that it names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use ground_motion::read;
use rocking_wall::scene::Scene;
use rocking_wall::wall::{Wall, Warning};
use study::document::{RecordsEntry, ReportOptions, StudyFile, WallEntry, WallSource};
use study::ida::{NamedRecord, NamedWall, Study};

use crate::input;

/// Largest study file that is read.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// A study ready to run, and what is to be made of it.
pub(super) struct Loaded {
    pub(super) title: String,
    pub(super) study: Study,
    pub(super) report: ReportOptions,
    /// Files that it was read from.
    pub(super) inputs: Vec<PathBuf>,
    /// What the walls and a quick check of the records warn of.
    pub(super) warnings: Vec<String>,
}

pub(super) fn load(path: &Path) -> Result<Loaded> {
    let name = path.display().to_string();
    let text = input::read(path, "a study file (TOML)", MAX_FILE_BYTES)?;
    let StudyFile { title, walls, records, models, measure, levels, tail, report } =
        StudyFile::parse(&name, &text)?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let (mut inputs, mut warnings) = (vec![path.to_owned()], Vec::new());
    let read = |entry| wall(entry, folder, &name, &mut inputs, &mut warnings);
    let walls = walls.into_iter().map(read).collect::<Result<Vec<_>>>()?;
    let paths = record_files(&records, folder, &name)?;
    let records = all_records(&records, &paths, &name, &mut warnings)?;
    inputs.extend(paths);
    check_unique(walls.iter().map(|wall| &wall.name)).with_context(|| format!("{name}: walls"))?;
    check_unique(records.iter().map(|record| &record.name)).with_context(|| format!("{name}: records"))?;
    let study = Study::new(walls, records, models, measure, levels)
        .and_then(|study| study.with_tail(tail))
        .with_context(|| name.clone())?;
    Ok(Loaded { title, study, report, inputs, warnings })
}

fn wall(
    entry: WallEntry,
    folder: &Path,
    study: &str,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<NamedWall> {
    let mut is_shaken = false;
    let (parameters, own_name) = match entry.source {
        WallSource::Inline(parameters) => (*parameters, String::new()),
        WallSource::Scene(path) => {
            inputs.push(folder.join(&path));
            let scene = Scene::read(&folder.join(&path))
                .with_context(|| format!("{study}, line {}: a wall's scene", entry.line))?;
            is_shaken = scene.excitation.is_some();
            let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            (scene.parameters, stem)
        }
    };
    let name = entry.name.unwrap_or(own_name);
    if is_shaken {
        warnings
            .push(format!("wall {name:?}: the study ignores the motion of its scene and uses its records"));
    }
    let made = Wall::new(&parameters).into_iter();
    let about_work = made.flat_map(|wall| wall.warnings().to_vec()).filter(Warning::is_about_work);
    warnings.extend(about_work.map(|warning| format!("wall {name:?}: {warning}")));
    warnings.extend(Warning::unusual(&parameters).map(|warning| format!("wall {name:?}: {warning}")));
    Ok(NamedWall { name, parameters })
}

/// Lists the record files of a study, in the order of its patterns.
fn record_files(entry: &RecordsEntry, folder: &Path, study: &str) -> Result<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for (pattern, line) in &entry.files {
        let found =
            files(&folder.join(pattern)).with_context(|| format!("{study}, line {line}: {pattern:?}"))?;
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
) -> Result<Vec<NamedRecord>> {
    let short =
        |path: &Path| path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for path in paths {
        *uses.entry(short(path)).or_default() += 1;
    }
    let mut records = Vec::with_capacity(paths.len() + entry.synthetic.len());
    for path in paths {
        let record = read(path, &entry.options)?;
        warnings.extend(record.check().warnings.iter().map(|w| format!("{}: {w}", path.display())));
        let motion = record.motion;
        let name = short(path);
        // files with equal names go by their whole paths
        let name = if uses[&name] > 1 { path.display().to_string() } else { name };
        records.push(NamedRecord { name, motion });
    }
    for recipe in &entry.synthetic {
        let motion = recipe.motion().with_context(|| format!("{study}: synthetic records"))?;
        records.push(NamedRecord { name: format!("synthetic {}", recipe.seed), motion });
    }
    Ok(records)
}

/// Lists the files of a folder, of a pattern, or the one file, in order of their names.
fn files(path: &Path) -> Result<Vec<PathBuf>> {
    let visible = |path: &Path| {
        path.is_file() && path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.'))
    };
    let mut found: Vec<PathBuf> = if path.is_dir() {
        std::fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?
    } else if path.is_file() {
        return Ok(vec![path.to_owned()]);
    } else {
        let pattern = path.to_str().context("expected a name in UTF-8")?;
        glob::glob(pattern)?.collect::<Result<_, _>>()?
    };
    found.retain(|path| visible(path));
    found.sort();
    if found.is_empty() {
        bail!(
            "no such file, no match, or a folder without files; name records beside the study file, such as \
             records/*.AT2"
        );
    }
    Ok(found)
}

fn check_unique<'a>(names: impl Iterator<Item = &'a String>) -> Result<()> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            bail!("the name {name:?} occurs twice; give each its own");
        }
    }
    Ok(())
}
