//! The file with a table `[check]`: parsed once, with the lines of its keys.

mod own;
pub(crate) mod project;
pub(crate) mod site;

use std::path::{Path, PathBuf};

use files::{Described, Fault, FileError, TomlFile, read_text};
use rocking_wall::wall::OF_RECTANGLE;
use run::records::{NamedRecord, RecordsTable, copies};
use run::walls::{NamedWall, assumed, read_walls};
use scene::{OF_BODY, Scene, SceneError};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeValue, ValueDeserializer};

use crate::error::CheckError;
use crate::words::Sentence;
pub use own::with_assignments;
use project::ReportTable;
use project::SiteOfProject;
use site::{RecordReader, Records, read_records};

/// What a file with a table `[check]` has beside its wall or walls.
const KEYS: &[&str] = &["title", "check", "report"];

/// Whether files can be read. The playground has none. It leaves their readers out, and with the reader of a
/// grid also that of its lines in the table.
pub(crate) const HAS_FILES: bool = cfg!(not(target_arch = "wasm32"));
/// Largest grid of the hazard that is read.
const MAX_GRID_BYTES: u64 = 64 << 20;

/// A scene, or a file of walls, with a table `[check]`.
#[derive(Clone)]
pub struct CheckFile<'a> {
    /// The file as it is parsed, with assignments over it.
    file: TomlFile<'a>,
    /// Bytes of the text that are the file's own; assignments follow.
    own: usize,
    folder: PathBuf,
    records: Vec<NamedRecord>,
    /// How the records that the table names are read; they are left unread without.
    reader: Option<RecordReader>,
}

impl<'a> CheckFile<'a> {
    /// Parses a text; `name` stands for the file in messages. Files that it names are beside it.
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn parse(name: &'a str, text: &'a str) -> Result<Self, FileError> {
        Ok(Self::new(TomlFile::new(name, text)?))
    }

    /// Takes a file that is parsed already.
    pub fn new(file: TomlFile<'a>) -> Self {
        let folder = Path::new(file.place().name()).parent().unwrap_or(Path::new(".")).to_owned();
        Self { folder, reader: Some(read_records), ..Self::alone(file) }
    }

    /// Parses a text that names no other files, as [`parse`](Self::parse) does.
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn parse_alone(name: &'a str, text: &'a str) -> Result<Self, FileError> {
        Ok(Self::alone(TomlFile::new(name, text)?))
    }

    fn alone(file: TomlFile<'a>) -> Self {
        let own = file.place().text().len();
        Self { file, own, folder: PathBuf::new(), records: Vec::new(), reader: None }
    }

    /// Parses a text that has `own` bytes of its own, and assignments behind them: see [`with_assignments`].
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn parse_with(name: &'a str, text: &'a str, own: usize) -> Result<Self, FileError> {
        Ok(Self { own, ..Self::new(TomlFile::with_assignments(name, text, own)?) })
    }

    /// Reads the scene of the file.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn scene(&self) -> Result<Scene, SceneError> {
        Scene::of(&self.file, &self.folder)
    }

    /// Reads the walls of the file, which may have `others` among its keys, those of a study. Adds the files
    /// that are read, and warnings about defaults.
    ///
    /// # Errors
    /// [`FileError`] with file, line, value and remedy.
    pub fn walls(
        &self,
        others: &[&str],
        inputs: &mut Vec<PathBuf>,
        warnings: &mut Vec<String>,
    ) -> Result<Vec<NamedWall>, FileError> {
        read_walls(&self.file, &[KEYS, others].concat(), inputs, warnings)
    }

    /// Takes these records in place of those that the table names.
    #[must_use]
    pub fn with_records(self, records: Vec<NamedRecord>) -> Self {
        Self { records, ..self }
    }

    /// Leaves the records that the table names unread, where only its other statements count.
    #[must_use]
    pub fn without_records(self) -> Self {
        Self { reader: None, ..self }
    }

    /// The name of the file.
    pub fn name(&self) -> &'a str {
        self.file.place().name()
    }

    /// The text of the file.
    pub fn text(&self) -> &'a str {
        &self.file.place().text()[..self.own]
    }

    /// Returns the text of the file with the lines of the grid of `[check.site]` in place of the name of its
    /// file, for a machine without that file.
    ///
    /// # Errors
    /// [`FileError`] of a grid that cannot be read.
    pub fn self_contained(&self) -> Result<String, FileError> {
        let grid = self.file.get(&["check", "site", "grid"]);
        let named = grid.and_then(|grid| Some((grid.span(), grid.get_ref().as_str()?)));
        let Some((span, grid)) = named else { return Ok(self.text().to_owned()) };
        let lines = lines_of_grid(grid, &self.folder)?;
        let mut text = self.text().to_owned();
        // a text of JSON is one of TOML
        text.replace_range(span, &serde_json::Value::from(lines).to_string());
        Ok(text)
    }

    /// The folder of the file.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The scene of the state before an intervention, which the table `[check]` names.
    pub fn baseline(&self) -> Option<PathBuf> {
        let named = self.file.get(&["check", "baseline"])?.get_ref().as_str()?;
        Some(self.folder.join(named))
    }

    /// Returns whether the file is one of walls, as a study is.
    pub fn has_walls(&self) -> bool {
        self.file.table().contains_key("walls")
    }

    /// Returns whether the file states a value.
    pub(crate) fn states(&self, keys: &[&str]) -> bool {
        let of_list = || match self.file.get(&keys[..1]).map(Spanned::get_ref) {
            // of several ties, any
            Some(DeValue::Array(tables)) => tables.iter().any(|table| {
                keys[1..].iter().try_fold(table, |value, key| value.get_ref().get(*key)).is_some()
            }),
            _ => false,
        };
        self.file.get(keys).is_some() || of_list()
    }

    /// Returns the parameters that decide verdicts, and that the file leaves to their start values; `set`
    /// holds assignments that state them, too.
    pub fn assumed(&self, set: &[String]) -> Vec<&'static str> {
        let is_set =
            |name: &str| set.iter().any(|set| set.split('=').next().is_some_and(|key| key.trim() == name));
        assumed(|group, name| self.states(&[group, name]) || self.body_states(name) || is_set(name))
    }

    /// Returns whether the body of the scene states a parameter: its integrals, or of a rectangle its shape,
    /// and its density where every part states it.
    pub(crate) fn body_states(&self, name: &str) -> bool {
        if !OF_RECTANGLE.contains(&name) {
            return OF_BODY.contains(&name) && self.states(&["geometry", "body"]);
        }
        match self.file.get(&["geometry", "part"]).map(Spanned::get_ref) {
            Some(DeValue::Array(parts)) if name == "density" => {
                parts.iter().all(|part| part.get_ref().get(name).is_some())
            }
            Some(_) => true,
            None => self.states(&["geometry", "body"]),
        }
    }

    fn check(&self) -> Option<&Spanned<DeValue<'a>>> {
        self.file.get(&["check"])
    }

    /// Returns the name of the code; `None` without a table `[check]`, and an empty one where it has none.
    pub(crate) fn code(&self) -> Option<&str> {
        Some(self.check()?.get_ref().get("code").and_then(|code| code.get_ref().as_str()).unwrap_or_default())
    }

    /// Reads the table `[check]`.
    ///
    /// # Errors
    /// [`CheckError::Value`] of the first key that is not known, or has another kind of value, and of a
    /// number outside the limits that its schema states.
    pub(crate) fn table<T: DeserializeOwned + Described>(&self) -> Result<T, CheckError> {
        let Some(check) = self.check() else { return Err(CheckError::wall("the table [check] is missing")) };
        self.file.read_value(check).map_err(|Fault { keys, message, .. }| CheckError::Value { keys, message })
    }

    /// Reads the table `[report]`; that of a study says what the study shows. Coordinates, `V_N` and `C_U`
    /// that it leaves out are those of `[check.site]`.
    ///
    /// # Errors
    /// [`FileError`] of the first key that is not known, or whose value cannot be used, or differs
    /// from that of the site.
    pub fn report(&self) -> Result<ReportTable, FileError> {
        let is_study = self.states(&["levels"]) || self.states(&["models"]);
        // what is wrong with the site is told where the check is read
        let site = self.file.get(&["check", "site"]).cloned();
        let site = site.and_then(|site| SiteOfProject::deserialize(ValueDeserializer::from(site)).ok());
        let site = site.unwrap_or_default();
        let Some(given) = self.file.get(&["report"]).filter(|_| !is_study) else {
            return Ok(ReportTable::of_site(&site));
        };
        let place = self.file.place();
        let mut table: ReportTable =
            self.file.read_value(given).map_err(|fault| place.error(fault.span, fault.message))?;
        table.complete(&site).map_err(|(key, message)| {
            let value = given.get_ref().get(key);
            place.error(value.map_or(given.span(), Spanned::span), format!("[report] {message}"))
        })?;
        Ok(table)
    }

    /// Reads the records that a table names, or takes those that were handed over.
    ///
    /// # Errors
    /// [`CheckError::File`] of what the table cannot state, [`CheckError::Scene`] of a record.
    pub(crate) fn records(&self, table: Option<&Spanned<RecordsTable>>) -> Result<Records, CheckError> {
        let mut found = match (table, self.reader) {
            (Some(table), Some(read)) if self.records.is_empty() => {
                read(table, self.file.place(), &self.folder)?
            }
            _ => Records { named: self.records.clone(), ..Records::default() },
        };
        found.warnings.extend(copies(&found.named).into_iter().map(Sentence::same));
        Ok(found)
    }

    /// Adds the file to an error, and the line of the key that it is about.
    pub fn located(&self, error: CheckError) -> SceneError {
        let reason = if error.keys().is_some() { format!("[check] {error}") } else { error.to_string() };
        let span = error.keys().filter(|_| self.check().is_some()).map(|keys| self.span(keys));
        match (span, error) {
            (_, CheckError::File(error)) => error.into(),
            (_, CheckError::Scene(error)) => error,
            (Some(span), _) if span.start >= self.own && self.own < self.file.place().text().len() => {
                let after = &self.file.place().text()[self.own..];
                let line = after.get(..span.start - self.own).unwrap_or_default().matches('\n').count();
                let line = after.lines().nth(line).unwrap_or_default();
                FileError::whole(self.name(), format!("--set {line}: {reason}")).into()
            }
            (Some(span), _) => self.file.place().error(span, reason).into(),
            (None, _) => FileError::whole(self.name(), reason).into(),
        }
    }

    /// The span of the last of the keys below `[check]` that is there.
    fn span(&self, keys: &[String]) -> std::ops::Range<usize> {
        let Some(mut at) = self.check() else { return 0..0 };
        for key in keys {
            match at.get_ref().get(key.as_str()) {
                Some(value) => at = value,
                None => break,
            }
        }
        at.span()
    }
}

/// Returns the lines of a grid of the hazard: those of a file in a folder, or those that stand in its place.
pub(crate) fn lines_of_grid(grid: &str, folder: &Path) -> Result<String, FileError> {
    if grid.contains('\n') {
        return Ok(grid.to_owned());
    }
    read_text(&folder.join(grid), "a grid of the hazard (CSV)", MAX_GRID_BYTES)
}
