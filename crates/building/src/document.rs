//! Reads the file of a building: storeys and walls, by their names.

use std::path::{Path, PathBuf};

use files::{FileError, Place, Schema, TomlFile, file_schema, number, object, read_text, tables, text, with};
use fmu_export::{Causality, Kind, Variable, VariableId};
use rocking_floor::variables::{IntegerVariable, RealVariable};
use scene::{self, Group, LONGEST_RUN};
use toml::{Spanned, Value};

/// The name that stands for the ground where a storey's would.
const GROUND: &str = "ground";
/// Largest file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// Bounds against mistyped numbers.
const MOST_MEMBERS: usize = 10_000;
/// Length of the run where the file states none [s].
const DEFAULT_STOP_TIME: f64 = 10.0;

/// What something stands on or leans on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// The ground.
    Ground,
    /// Index of a storey.
    Floor(usize),
}

impl Support {
    /// Returns the index of the storey; `None` for the ground.
    pub fn floor(self) -> Option<usize> {
        match self {
            Self::Ground => None,
            Self::Floor(index) => Some(index),
        }
    }
}

/// A storey.
#[derive(Debug)]
pub struct Floor {
    /// Name.
    pub name: String,
    /// What it stands on.
    pub base: Support,
    /// Start values, in the order of the floor's model description.
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

tables! {
    /// A building.
    #[derive(Debug)]
    struct Document {
        /// Title, for people; by default the file's name.
        title: Option<String>,
        /// End of the default experiment \[s\].
        #[key(exclusiveMinimum = 0, maximum = LONGEST_RUN, default = DEFAULT_STOP_TIME)]
        stop_time: Option<f64>,
        /// Communication step of the SSP \[s\]; by default the one that held inputs need for 1 %.
        #[key(exclusiveMinimum = 0)]
        step: Option<Spanned<f64>>,
        /// Whether the ground's acceleration `a_g` is an input of the system, which not every tool supports.
        #[serde(default)]
        #[key(default = false)]
        expose_ground: bool,
        /// Storeys, each on the ground or on one before it: name, on, and the parameters of a floor.
        #[serde(default)]
        #[key(items = floor_schema(), minItems = 1)]
        floor: Vec<Group>,
        /// Walls and their places.
        #[serde(default)]
        wall: Vec<WallTable>,
    }

    /// A wall and its place.
    #[derive(Debug)]
    struct WallTable {
        /// Name: letters, digits and _, a letter first.
        name: Spanned<String>,
        /// Scene file, relative to the building file.
        scene: PathBuf,
        /// Storey of the bottom support, or ground.
        bottom: Spanned<String>,
        /// Storey of the top support of a strip wall, or ground.
        top: Option<Spanned<String>>,
        /// Whether the drift between the supports acts; by default where it is a storey's own displacement.
        drift: Option<Spanned<bool>>,
    }
}

/// Describes a storey: its name and place, and the parameters of a floor.
fn floor_schema() -> Schema {
    let own = [
        ("name", text("Name: letters, digits and _, a letter first.")),
        ("on", with(text("Storey that it stands on."), "default", GROUND)),
    ];
    let mut keys: Schema = own.map(|(key, schema)| (key.to_owned(), schema.into())).into_iter().collect();
    keys.extend(
        parameters().filter_map(|variable| Some((variable.name.to_owned(), scene::parameter(variable)?))),
    );
    with(object(keys), "required", vec!["name"])
}

type Result<T> = std::result::Result<T, FileError>;

impl Building {
    /// Returns the JSON schema of building files.
    pub fn schema() -> Schema {
        with(file_schema::<Document>("Building of rocking-wall"), "required", vec!["floor"])
    }

    /// Reads the file of a building.
    ///
    /// # Errors
    /// [`FileError`] with file, line and remedy.
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(path, &read_text(path, "a building (TOML)", MAX_FILE_BYTES)?)
    }

    /// Reads a building from the text of a file; scenes are looked up beside `path`.
    ///
    /// # Errors
    /// [`FileError`] with file, line and remedy.
    pub fn parse(path: &Path, text: &str) -> Result<Self> {
        let name = path.display().to_string();
        let file = TomlFile::new(&name, text)?;
        Self::from_document(file.read()?, file.place(), path)
    }

    fn from_document(document: Document, place: &Place<'_>, path: &Path) -> Result<Self> {
        let Document { title, stop_time, step, expose_ground, floor, wall } = document;
        let stop_time = stop_time.unwrap_or(DEFAULT_STOP_TIME);
        if let Some(step) = step.as_ref().filter(|step| *step.get_ref() > stop_time) {
            let message = format!("step = {} must be at most stop_time = {stop_time} s", step.get_ref());
            return Err(place.error(step.span(), message));
        }
        let step = step.map(Spanned::into_inner);
        if floor.is_empty() || floor.len() + wall.len() > MOST_MEMBERS {
            let reason = format!("a building has at least one [[floor]] and at most {MOST_MEMBERS} members");
            return Err(FileError::whole(place.name(), reason));
        }
        let mut names = Vec::new();
        let mut floors: Vec<Floor> = Vec::new();
        for table in &floor {
            let (name, floor) = read_floor(table, &floors, place)?;
            check_name(&name, &mut names, place)?;
            floors.push(floor);
        }
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut walls = Vec::new();
        for table in wall {
            check_name(&table.name, &mut names, place)?;
            walls.push(read_wall(table, &floors, place, folder)?);
        }
        let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        Ok(Self { title: title.unwrap_or(stem), stop_time, step, expose_ground, floors, walls })
    }
}

/// Where a member's FMU lies in the archive.
pub fn fmu_path(name: &str) -> String {
    format!("resources/{name}.fmu")
}

/// The most letters of a name, which becomes a file name.
const LONGEST_NAME: usize = 100;

/// Checks that FMUs, connectors and files can have a name, and that no other member has it. Strip.fmu and
/// strip.fmu are one file on many machines.
fn check_name(name: &Spanned<String>, names: &mut Vec<String>, place: &Place<'_>) -> Result<()> {
    let text = name.get_ref();
    let plain = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let plain = plain && text.starts_with(|c: char| c.is_ascii_alphabetic());
    let taken = names.iter().find(|other| other.eq_ignore_ascii_case(text));
    let fault = match taken {
        _ if !plain => "use letters, digits and _, a letter first".to_owned(),
        _ if text.len() > LONGEST_NAME => {
            format!("{} characters are too many; use at most {LONGEST_NAME}", text.len())
        }
        _ if text == GROUND => format!("{GROUND:?} stands for the ground; give another name"),
        Some(other) => format!(
            "{other:?} is taken, in small or capital letters; give each storey and wall a name of its own"
        ),
        None => {
            names.push(text.clone());
            return Ok(());
        }
    };
    Err(place.error(name.span(), format!("name = {text:?}: {fault}")))
}

fn read_floor(table: &Group, before: &[Floor], place: &Place<'_>) -> Result<(Spanned<String>, Floor)> {
    let mut name = None;
    let mut base = Support::Ground;
    let mut parameters = Vec::new();
    for (key, value) in table.iter() {
        let text = || match value.get_ref() {
            Value::String(text) => Ok(Spanned::new(value.span(), text.clone())),
            _ => Err(place.error(value.span(), format!("{} is a name in quotes", key.get_ref()))),
        };
        match key.get_ref().as_str() {
            "name" => name = Some(text()?),
            "on" => base = support("on", &text()?, before, place)?,
            other => {
                let parameter =
                    parameter(other, value.get_ref()).map_err(|message| place.error(key.span(), message))?;
                parameters.push(parameter);
            }
        }
    }
    let Some(name) = name else {
        let span = table.keys().next().map_or(0..0, Spanned::span);
        return Err(place.error(span, "a [[floor]] needs a name"));
    };
    Ok((name.clone(), Floor { name: name.into_inner(), base, parameters }))
}

/// The parameters of a floor that a storey may state; reactions couple the members of a building.
fn parameters() -> impl Iterator<Item = &'static Variable> {
    let choices = IntegerVariable::ALL.iter().map(|id| id.variable());
    let all = choices.chain(RealVariable::ALL.iter().map(|id| id.variable()));
    all.filter(|variable| variable.causality == Causality::Parameter && variable.name != "coupling")
}

/// A parameter of a storey, within the limits of the floor's description.
fn parameter(name: &str, value: &Value) -> std::result::Result<Parameter, String> {
    let Some(variable) = parameters().find(|variable| variable.name == name) else {
        let names: Vec<_> = parameters().map(|variable| variable.name).collect();
        return Err(format!(
            "{name:?} is not a key of [[floor]]; its keys are name, on, {}",
            names.join(", ")
        ));
    };
    let (text, start) = match (variable.kind, value) {
        (Kind::Real { .. }, value) => {
            let number = number(value).ok_or_else(|| format!("{name} must be a number"))?;
            let text = format!("{number:?}");
            (text.clone(), text)
        }
        (Kind::Enumeration { items, .. }, Value::String(text)) => {
            let item = items.iter().find(|item| item.name == text);
            let names: Vec<_> = items.iter().map(|item| item.name).collect();
            let item = item.ok_or_else(|| format!("{name} = {text:?} is not one of {}", names.join(", ")))?;
            (format!("{text:?}"), item.value.to_string())
        }
        _ => return Err(format!("{name} must be the name of a choice in quotes")),
    };
    Ok(Parameter { name: variable.name, text, start })
}

fn support(key: &str, name: &Spanned<String>, floors: &[Floor], place: &Place<'_>) -> Result<Support> {
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
        place.error(name.span(), message)
    })
}

fn read_wall(table: WallTable, floors: &[Floor], place: &Place<'_>, folder: &Path) -> Result<Member> {
    let bottom = support("bottom", &table.bottom, floors, place)?;
    let top = table.top.as_ref().map(|top| support("top", top, floors, place)).transpose()?;
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
        return Err(place.error(wanted.span(), message));
    }
    let drift = drift.filter(|_| wanted);
    Ok(Member { name: table.name.into_inner(), scene: folder.join(table.scene), bottom, top, drift })
}
