//! Reads the file of a building: storeys and walls, by their names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fmu_export::{Causality, Kind, VariableId};
use rocking_floor::variables::{IntegerVariable, RealVariable};
use rocking_wall::scene::in_toml_words;
use serde::Deserialize;
use toml::{Spanned, Value};

use crate::error::BuildingError;

/// The name that stands for the ground where a storey's would.
const GROUND: &str = "ground";
/// Largest file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// Bounds against mistyped numbers.
const MOST_MEMBERS: usize = 10_000;
const LONGEST_RUN: f64 = 1e7;

/// What something stands on or leans on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// The ground.
    Ground,
    /// Index of a storey.
    Floor(usize),
}

/// A storey.
#[derive(Debug)]
pub struct Floor {
    /// Name.
    pub name: String,
    /// What it stands on.
    pub base: Support,
    /// In the order of the floor's description.
    pub parameters: Vec<Parameter>,
}

/// A start value of a storey.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name of the variable.
    pub name: &'static str,
    /// As a TOML file has it: a number, or the name of a choice in quotes.
    pub text: String,
    /// As a model description has it: a number, or that of a choice.
    pub start: String,
}

/// A wall and its place.
#[derive(Debug)]
pub struct Member {
    /// Name.
    pub name: String,
    /// Its scene file.
    pub scene: PathBuf,
    /// What it stands on.
    pub bottom: Support,
    /// What a strip wall leans on.
    pub top: Option<Support>,
    /// The storey whose displacement is the drift between the supports.
    pub drift: Option<usize>,
}

/// Storeys, each on the ground or on one before it, and walls.
#[derive(Debug)]
pub struct Building {
    /// Title.
    pub title: String,
    /// End of the default experiment \[s\].
    pub stop_time: f64,
    /// Its communication step \[s\]; none if the file leaves it to
    /// [`Trial::step`](crate::trial::Trial::step).
    pub step: Option<f64>,
    /// The ground's acceleration is an input of the system.
    pub expose_ground: bool,
    /// Storeys.
    pub floors: Vec<Floor>,
    /// Walls.
    pub walls: Vec<Member>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    title: Option<String>,
    #[serde(default = "default_stop_time")]
    stop_time: f64,
    step: Option<f64>,
    /// By default off: not every tool knows inputs of a system.
    #[serde(default)]
    expose_ground: bool,
    #[serde(default)]
    floor: Vec<BTreeMap<Spanned<String>, Spanned<Value>>>,
    #[serde(default)]
    wall: Vec<WallTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WallTable {
    name: Spanned<String>,
    scene: PathBuf,
    bottom: Spanned<String>,
    top: Option<Spanned<String>>,
    /// By default wherever a storey's own displacement is the drift.
    drift: Option<Spanned<bool>>,
}

fn default_stop_time() -> f64 {
    10.0
}

type Result<T> = std::result::Result<T, BuildingError>;

/// A file's text, to name lines in messages.
struct Source<'a> {
    file: String,
    text: &'a str,
}

impl Source<'_> {
    /// An error of the whole file.
    fn whole(&self, reason: String) -> BuildingError {
        BuildingError::File { file: self.file.clone(), reason }
    }

    fn error(&self, span: std::ops::Range<usize>, message: impl Into<String>) -> BuildingError {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        let line = before.split(|&byte| byte == b'\n').count();
        BuildingError::Line { file: self.file.clone(), line, message: message.into() }
    }
}

impl Building {
    /// Reads the file of a building. A pipe is refused before it is opened, which would wait for its writer.
    ///
    /// # Errors
    /// [`BuildingError`] with file, line and remedy.
    pub fn read(path: &Path) -> Result<Self> {
        let file = path.display().to_string();
        let fail = |reason: String| BuildingError::File { file: file.clone(), reason };
        let unreadable = |error: std::io::Error| fail(format!("cannot be read: {error}"));
        let metadata = std::fs::metadata(path).map_err(unreadable)?;
        if !metadata.is_file() || metadata.len() > MAX_FILE_BYTES {
            return Err(fail(format!("expected a building (TOML) of at most {MAX_FILE_BYTES} bytes")));
        }
        Self::parse(path, &std::fs::read_to_string(path).map_err(unreadable)?)
    }

    /// Reads a building from the text of a file; scenes are looked up beside `path`.
    ///
    /// # Errors
    /// [`BuildingError`] with file, line and remedy.
    pub fn parse(path: &Path, text: &str) -> Result<Self> {
        let source = Source { file: path.display().to_string(), text };
        let document: Document = toml::from_str(text).map_err(|error| {
            let message = in_toml_words(&error.message().replace('\n', " "));
            source.error(error.span().unwrap_or(0..0), message)
        })?;
        Self::from_document(document, &source, path)
    }

    fn from_document(document: Document, source: &Source<'_>, path: &Path) -> Result<Self> {
        let Document { title, stop_time, step, expose_ground, floor, wall } = document;
        if !(stop_time > 0.0 && stop_time <= LONGEST_RUN) {
            return Err(
                source.whole(format!("stop_time = {stop_time} s; expected 0 < stop_time <= {LONGEST_RUN} s"))
            );
        }
        if let Some(step) = step.filter(|&step| !(step > 0.0 && step <= stop_time)) {
            return Err(source.whole(format!(
                "step = {step} s; expected 0 < step <= stop_time = {stop_time} s, or leave it out"
            )));
        }
        if floor.is_empty() || floor.len() + wall.len() > MOST_MEMBERS {
            return Err(source
                .whole(format!("a building has at least one [[floor]] and at most {MOST_MEMBERS} members")));
        }
        let mut names = Vec::new();
        let mut floors: Vec<Floor> = Vec::new();
        for table in &floor {
            let (name, floor) = read_floor(table, &floors, source)?;
            check_name(&name, &mut names, source)?;
            floors.push(floor);
        }
        let mut walls = Vec::new();
        for table in wall {
            check_name(&table.name, &mut names, source)?;
            walls.push(read_wall(table, &floors, source)?);
        }
        let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new("."));
        for wall in &mut walls {
            wall.scene = folder.join(&wall.scene);
        }
        Ok(Self { title: title.unwrap_or(stem), stop_time, step, expose_ground, floors, walls })
    }
}

/// Where a member's FMU lies in the archive.
pub fn fmu_path(name: &str) -> String {
    format!("resources/{name}.fmu")
}

/// The most letters of a name, which becomes a file name.
const LONGEST_NAME: usize = 100;

/// Checks that FMUs, connectors and files can have a name, and that no other member has it.
fn check_name(name: &Spanned<String>, names: &mut Vec<String>, source: &Source<'_>) -> Result<()> {
    let text = name.get_ref();
    let plain = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !plain || !text.starts_with(|c: char| c.is_ascii_alphabetic()) || text == GROUND {
        let message = format!(
            "name = {text:?}: use letters, digits and _, a letter first, and not {GROUND:?}, which is taken"
        );
        return Err(source.error(name.span(), message));
    }
    if text.len() > LONGEST_NAME {
        let message = format!("name has {} letters; use at most {LONGEST_NAME}", text.len());
        return Err(source.error(name.span(), message));
    }
    // Strip.fmu and strip.fmu are one file on many machines
    if let Some(other) = names.iter().find(|other| other.eq_ignore_ascii_case(text)) {
        let message = format!("name = {text:?}: {other:?} exists already; choose another");
        return Err(source.error(name.span(), message));
    }
    names.push(text.clone());
    Ok(())
}

fn read_floor(
    table: &BTreeMap<Spanned<String>, Spanned<Value>>,
    before: &[Floor],
    source: &Source<'_>,
) -> Result<(Spanned<String>, Floor)> {
    let mut name = None;
    let mut base = Support::Ground;
    let mut parameters = Vec::new();
    for (key, value) in table {
        let text = || match value.get_ref() {
            Value::String(text) => Ok(Spanned::new(value.span(), text.clone())),
            _ => Err(source.error(value.span(), format!("{} is a name in quotes", key.get_ref()))),
        };
        match key.get_ref().as_str() {
            "name" => name = Some(text()?),
            "on" => base = support("on", &text()?, before, source)?,
            other => {
                let parameter =
                    parameter(other, value.get_ref()).map_err(|message| source.error(key.span(), message))?;
                parameters.push(parameter);
            }
        }
    }
    let Some(name) = name else {
        let span = table.keys().next().map_or(0..0, Spanned::span);
        return Err(source.error(span, "a [[floor]] needs a name"));
    };
    Ok((name.clone(), Floor { name: name.into_inner(), base, parameters }))
}

/// A parameter of a storey, within the limits of the floor's description.
fn parameter(name: &str, value: &Value) -> std::result::Result<Parameter, String> {
    let real = RealVariable::from_name(name).map(VariableId::variable);
    let choice = IntegerVariable::from_name(name).map(VariableId::variable);
    let known = real.or(choice).filter(|variable| variable.causality == Causality::Parameter);
    let Some(variable) = known.filter(|variable| variable.name != "coupling") else {
        let all = RealVariable::ALL.iter().map(|id| id.variable());
        let all = all.filter(|variable| variable.causality == Causality::Parameter);
        let names: Vec<_> = all.map(|variable| variable.name).collect();
        return Err(format!(
            "{name:?} is not a key of [[floor]]; its keys are name, on, hysteresis, {}",
            names.join(", ")
        ));
    };
    let (text, start) = match (variable.kind, value) {
        (Kind::Real { min, max, .. }, Value::Float(_) | Value::Integer(_)) => {
            #[allow(
                clippy::cast_precision_loss,
                reason = "a whole number beyond 2⁵³ is beyond every limit too"
            )]
            let number = value.as_float().unwrap_or_else(|| value.as_integer().unwrap_or_default() as f64);
            if !number.is_finite()
                || min.is_some_and(|min| number < min)
                || max.is_some_and(|max| number > max)
            {
                let limit = |limit: Option<f64>| limit.map_or("any".to_owned(), |limit| limit.to_string());
                return Err(format!(
                    "{name} = {number} is outside its limits, {} to {}",
                    limit(min),
                    limit(max)
                ));
            }
            let text = format!("{number:?}");
            (text.clone(), text)
        }
        (Kind::Enumeration { items, .. }, Value::String(text)) => {
            let item = items.iter().find(|item| item.name == text);
            let names: Vec<_> = items.iter().map(|item| item.name).collect();
            let item = item.ok_or_else(|| format!("{name} = {text:?} is not one of {}", names.join(", ")))?;
            (format!("{text:?}"), item.value.to_string())
        }
        (Kind::Real { .. }, _) => return Err(format!("{name} must be a number")),
        _ => return Err(format!("{name} must be the name of a choice in quotes")),
    };
    Ok(Parameter { name: variable.name, text, start })
}

fn support(key: &str, name: &Spanned<String>, floors: &[Floor], source: &Source<'_>) -> Result<Support> {
    if name.get_ref() == GROUND {
        return Ok(Support::Ground);
    }
    let found = floors.iter().position(|floor| floor.name == *name.get_ref());
    found.map(Support::Floor).ok_or_else(|| {
        let mut known: Vec<_> = vec![GROUND];
        known.extend(floors.iter().map(|floor| floor.name.as_str()));
        let message = format!(
            "{key} = {:?} is not one of {}; a storey comes after the one it stands on",
            name.get_ref(),
            known.join(", ")
        );
        source.error(name.span(), message)
    })
}

fn read_wall(table: WallTable, floors: &[Floor], source: &Source<'_>) -> Result<Member> {
    let bottom = support("bottom", &table.bottom, floors, source)?;
    let top = table.top.as_ref().map(|top| support("top", top, floors, source)).transpose()?;
    // a storey's displacement is relative to its base
    let drift = match top {
        Some(Support::Floor(index)) if floors[index].base == bottom => Some(index),
        _ => None,
    };
    let wanted = table.drift.as_ref().is_none_or(|wanted| *wanted.get_ref());
    if let (Some(wanted), None) = (&table.drift, drift)
        && *wanted.get_ref()
    {
        let message = "drift = true needs a top on the storey just above the bottom: only its displacement \
                       is the drift";
        return Err(source.error(wanted.span(), message));
    }
    let drift = drift.filter(|_| wanted);
    Ok(Member { name: table.name.into_inner(), scene: table.scene, bottom, top, drift })
}
