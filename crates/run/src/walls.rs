//! Walls by their names: the tables `[[walls]]` of a study or a check, scenes, and tables of walls (CSV).

use std::fmt::Display;
use std::path::{Path, PathBuf};

use files::{Described, FileError, Schema, Tables, TomlFile, names, object, suggestion, tables};
use rocking_wall::wall::{Bar, OF_RECTANGLE, Parameters};
use scene::{
    BODIES, Curve, Floors, GROUPS, Group, Scene, SceneError, StoreyTable, SupportsTable, TieTables,
    apply_tables, parameters, read_floors,
};
use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;

pub use crate::named_wall::{DECIDING, NamedWall, assumed};
use crate::wall_parameters::{OF_MODELS, WALL_GROUPS, is_of_models};
use crate::wall_table;

/// Returns the parameters that a file states, by their groups, and the numbers of a bar, of the group `bar`.
/// Parts and given integrals state those of the rectangle.
fn stated(is_stated: impl Fn(&str, &str) -> bool) -> Vec<&'static str> {
    let has_body = BODIES.iter().any(|key| is_stated("geometry", key));
    let is_stated = |group: &str, key: &str| is_stated(group, key) || has_body && OF_RECTANGLE.contains(&key);
    let parameters = GROUPS.iter().flat_map(|(group, names)| names.iter().map(|name| (*group, *name, *name)));
    let of_bar = Bar::NUMBERS.map(|number| ("bar", number.key(), number.usual.name));
    let stated = parameters.chain(of_bar).filter(|(group, key, _)| is_stated(group, key));
    stated.map(|(.., name)| name).collect()
}

/// Reads a scene file, and returns with the scene those of [`DECIDING`] that the file does not state.
///
/// # Errors
/// [`SceneError`], with file, line, value and remedy.
pub fn read_scene(path: &Path) -> Result<(Scene, Vec<&'static str>), SceneError> {
    let (scene, stated) = scene_and_stated(path)?;
    Ok((scene, assumed(|_, name| stated.contains(&name))))
}

fn scene_and_stated(path: &Path) -> Result<(Scene, Vec<&'static str>), SceneError> {
    let (name, text) = (path.display().to_string(), Scene::text(path)?);
    let file = TomlFile::new(&name, &text)?;
    let scene = Scene::of(&file, path.parent().unwrap_or(Path::new(".")))?;
    let is_stated = |group: &str, key: &str| match group {
        "bar" => file.get(&["tie", "bar", key]).is_some(),
        group => file.get(&[group, key]).is_some(),
    };
    Ok((scene, stated(is_stated)))
}

/// A wall of a study.
#[derive(Clone, Debug)]
pub struct WallEntry {
    /// Name; if none is given, that of the scene file.
    pub name: Option<String>,
    /// Source of its parameters.
    pub source: WallSource,
    /// The capacity curve that is its force law.
    pub curve: Option<Curve>,
    /// Storeys between ground and wall; if there are none, those of its scene.
    pub floors: Option<Floors>,
}

/// Source of a wall.
#[derive(Clone, Debug)]
pub enum WallSource {
    /// Parameters in the study file itself, and the names of those that it states.
    Inline(Box<Parameters>, Vec<&'static str>),
    /// A scene file, relative to the study file, and the line that names it.
    Scene(PathBuf, usize),
    /// A table of many walls (CSV), relative to the study file, and the line that names it.
    Table(PathBuf, usize),
}

tables! {
    /// A wall: a scene, or a name and tables of parameters; or many walls in a table.
    #[derive(Debug)]
    pub struct WallTable {
        /// Name in tables; by default that of the scene file.
        name: Option<String>,
        /// Scene file, relative to the study file.
        scene: Option<PathBuf>,
        /// Table of walls (CSV), relative to the study file: a column name and parameters.
        table: Option<PathBuf>,
        /// The floors that support the wall.
        supports: Option<Spanned<SupportsTable>>,
        /// What a check states of this wall alone, over the file's `[check]`.
        #[serde(default)]
        check: Option<IgnoredAny>,
        /// Shape, mass and loads.
        #[serde(default)]
        geometry: Group,
        /// Restoring force.
        #[serde(default)]
        force_law: Group,
        /// ξ and c̄ for models that state none; the models of a study set the damping.
        #[serde(default)]
        #[key(properties = without_model("damping"))]
        damping: Group,
        /// Restitution; the models of a study set the impact.
        #[serde(default)]
        #[key(properties = without_model("impact"))]
        impact: Group,
        /// Tie of the wall, or a list of several.
        #[serde(default)]
        tie: TieTables,
        /// Solver and tolerance.
        #[serde(default)]
        solver: Group,
    }
}

/// Describes the parameters of a group that the models of a study do not set.
fn without_model(group: &str) -> Schema {
    let mut parameters = parameters(group);
    parameters.retain(|name, _| !is_of_models(name));
    parameters
}

/// What a study or a check says of its walls.
#[derive(Debug, Deserialize)]
struct WallsDocument {
    #[serde(default)]
    storeys: Vec<Spanned<StoreyTable>>,
    supports: Option<Spanned<SupportsTable>>,
    walls: Vec<Spanned<WallTable>>,
}

impl Described for WallsDocument {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let storeys = Vec::<StoreyTable>::describe(key, tables);
        let walls = Vec::<WallTable>::describe(key, tables);
        let keys = [("storeys", storeys), ("walls", walls)];
        object(keys.map(|(key, schema)| (key.to_owned(), schema.into())).into_iter().collect())
    }
}

/// Reads the walls of a file with walls, storeys and supports; it may have other keys.
///
/// # Errors
/// [`FileError`] with file, line, value and remedy.
fn walls_of(file: &TomlFile<'_>, others: &[&str]) -> Result<Vec<WallEntry>, FileError> {
    let known = || names::<WallsDocument>().iter().chain(others).copied();
    if let Some(key) = file.table().keys().find(|key| known().all(|name| name != key.get_ref())) {
        let meant = suggestion(key.get_ref(), known());
        let message = format!("{:?} is not a key of a file of walls{meant}; leave it out", key.get_ref());
        return Err(file.place().error(key.span(), message));
    }
    let WallsDocument { storeys, supports, walls } = file.read()?;
    entries(&walls, &storeys, supports.as_ref(), file)
}

/// Reads the walls of a file, each with its storeys.
///
/// # Errors
/// [`FileError`] with file, line, value and remedy.
pub fn entries(
    walls: &[Spanned<WallTable>],
    storeys: &[Spanned<StoreyTable>],
    supports: Option<&Spanned<SupportsTable>>,
    file: &TomlFile<'_>,
) -> Result<Vec<WallEntry>, FileError> {
    let entry = |table: &Spanned<WallTable>| {
        let supports = table.get_ref().supports.as_ref().or(supports);
        Ok(WallEntry { floors: read_floors(storeys, supports, file.place())?, ..wall(table, file)? })
    };
    walls.iter().map(entry).collect()
}

fn wall(table: &Spanned<WallTable>, file: &TomlFile<'_>) -> Result<WallEntry, FileError> {
    let (spec, place) = (table.get_ref(), file.place());
    // crates/check reads it
    let _ = spec.check;
    let [geometry, force_law, damping, impact, tie, solver] = WALL_GROUPS;
    let groups = [
        (geometry, &spec.geometry),
        (force_law, &spec.force_law),
        (damping, &spec.damping),
        (impact, &spec.impact),
        (solver, &spec.solver),
    ];
    let ties = spec.tie.iter().map(|group| (tie, group));
    let with_ties = || groups.into_iter().chain(ties.clone());
    let given = [("scene", &spec.scene), ("table", &spec.table)];
    if let Some((kind, path)) = given.into_iter().find_map(|(kind, path)| Some((kind, path.as_ref()?))) {
        let is_other = kind == "scene" && spec.table.is_some();
        let own = with_ties().find(|(_, group)| !group.is_empty()).map(|(name, _)| name);
        if let Some(name) = is_other.then_some("table").or(own) {
            let message =
                format!("a wall is either a {kind} or has its own tables; leave out {kind} or {name}");
            return Err(place.error(table.span(), message));
        }
        let line = place.line(table.span());
        let source = if kind == "scene" { WallSource::Scene } else { WallSource::Table };
        return Ok(WallEntry {
            name: spec.name.clone(),
            source: source(path.clone(), line),
            curve: None,
            floors: None,
        });
    }
    for (name, message) in OF_MODELS {
        let keys = groups.iter().flat_map(|(_, group)| group.keys());
        if let Some(key) = keys.into_iter().find(|key| key.get_ref() == name) {
            return Err(place.error(key.span(), message));
        }
    }
    if spec.name.is_none() {
        return Err(place.error(table.span(), "a wall needs a name, such as name = \"1\""));
    }
    let mut parameters = Parameters::default();
    let folder = Path::new(place.name()).parent().unwrap_or(Path::new("."));
    let curve = apply_tables(&mut parameters, &groups, &spec.tie, file, folder)?;
    let first = spec.tie.first();
    let bar = first.and_then(|tie| tie.iter().find(|(key, _)| key.get_ref() == "bar"));
    let bar = bar.and_then(|(_, bar)| bar.get_ref().as_table());
    let is_stated = |group: &str, name: &str| {
        let mut stated = with_ties().filter(|(own, _)| *own == group).flat_map(|(_, keys)| keys.keys());
        stated.any(|key| key.get_ref() == name)
            || group == "bar" && bar.is_some_and(|bar| bar.contains_key(name))
    };
    let source = WallSource::Inline(Box::new(parameters), stated(is_stated));
    Ok(WallEntry { name: spec.name.clone(), source, curve, floors: None })
}

/// Reads the walls of a file, which may have `others` among its keys, those of a study or a check. Scenes and
/// tables that it names are looked up beside it. Adds the files that are read, and warnings about defaults.
///
/// # Errors
/// [`FileError`], with file, line, value and remedy.
pub fn read_walls(
    file: &TomlFile<'_>,
    others: &[&str],
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<NamedWall>, FileError> {
    let name = file.place().name();
    let path = Path::new(name);
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut walls = Vec::new();
    inputs.push(path.to_owned());
    for (place, entry) in walls_of(file, others)?.into_iter().enumerate() {
        // a check uses neither the motion nor the damping of a scene
        let found = self::walls(entry, folder, name, inputs, &mut Vec::new())?;
        walls.extend(found.into_iter().map(|wall| NamedWall { entry: place, ..wall }));
    }
    warnings.extend(defaults(name, walls.iter()));
    check_unique("walls", walls.iter().map(|wall| &wall.name))
        .map_err(|reason| FileError::whole(name, reason))?;
    Ok(walls)
}

/// Reads the walls of an entry. Adds the files that it names to `inputs`, and warnings about what a study
/// ignores of a scene.
///
/// # Errors
/// [`FileError`], with file, line, value and remedy.
pub fn walls(
    entry: WallEntry,
    folder: &Path,
    study: &str,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> Result<Vec<NamedWall>, FileError> {
    let at =
        |line, what: &str, error: &dyn Display| FileError::on_line(study, line, format!("{what}: {error}"));
    match entry.source {
        WallSource::Inline(parameters, stated) => {
            let name = entry.name.unwrap_or_default();
            let wall =
                NamedWall { floors: entry.floors, ..NamedWall::new(name, *parameters).stating(stated) };
            Ok(vec![with_curve(wall, entry.curve, inputs, warnings)])
        }
        WallSource::Table(path, line) => {
            let path = folder.join(path);
            inputs.push(path.clone());
            let mut scene_of = |scene: &Path| {
                inputs.push(scene.to_owned());
                let found = scene_and_stated(scene)?;
                inputs.extend(found.0.files.iter().cloned());
                Ok(found)
            };
            let walls = wall_table::read(&path, &mut scene_of)
                .map_err(|error| at(line, "a table of walls", &error))?;
            let wall = |(wall, curve): (NamedWall, _)| {
                let floors = entry.floors.clone().or(wall.floors.clone());
                with_curve(NamedWall { floors, ..wall }, curve, inputs, warnings)
            };
            Ok(walls.into_iter().map(wall).collect())
        }
        WallSource::Scene(path, line) => {
            let file = folder.join(&path);
            inputs.push(file.clone());
            let (scene, stated) =
                scene_and_stated(&file).map_err(|error| at(line, "a wall's scene", &error))?;
            let stem = || path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
            let name = entry.name.or_else(stem).unwrap_or_default();
            if scene.excitation.is_some() {
                let warning = "the study ignores the motion of its scene and uses its records";
                warnings.push(format!("wall {name:?}: {warning}"));
            }
            let floors = entry.floors.or(scene.floors);
            let wall = NamedWall { floors, ..NamedWall::new(name, scene.parameters).stating(stated) };
            Ok(vec![with_curve(wall, scene.curve, inputs, warnings)])
        }
    }
}

/// Tells what the capacity curve of a wall says of it. Adds its file, and what is improbable.
pub fn with_curve(
    wall: NamedWall,
    curve: Option<Curve>,
    inputs: &mut Vec<PathBuf>,
    warnings: &mut Vec<String>,
) -> NamedWall {
    let Some(curve) = curve else { return wall };
    inputs.extend(curve.file);
    warnings.extend(curve.doubts.iter().map(|doubt| format!("wall {:?}: {doubt}", wall.name)));
    NamedWall { is_oscillator: curve.is_of_oscillator, ..wall }
}

/// Warns of walls of a file whose height or thickness nobody stated.
pub fn defaults<'a>(file: &str, walls: impl Iterator<Item = &'a NamedWall>) -> Vec<String> {
    let (walls, Parameters { height, thickness, .. }) = (walls.collect::<Vec<_>>(), Parameters::default());
    let warning = |(size, default): (&str, f64)| {
        let is_default = |wall: &&&NamedWall| !wall.is_oscillator && wall.assumed.contains(&size);
        let (count, all) = (walls.iter().filter(is_default).count(), walls.len());
        let told =
            format!("{file}: {count} of {all} walls have no {size}; the default of {default} m counts");
        (count > 0).then_some(told)
    };
    [("height", height), ("thickness", thickness)].into_iter().filter_map(warning).collect()
}

/// Refuses a name that occurs twice.
///
/// # Errors
/// The message.
pub fn check_unique<'a>(what: &str, names: impl Iterator<Item = &'a String>) -> Result<(), String> {
    let mut seen = std::collections::BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(format!("{what}: the name {name:?} occurs twice; give each its own"));
        }
    }
    Ok(())
}
