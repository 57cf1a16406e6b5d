//! The file with a table `[check]`: parsed once, with the lines of its keys.

pub(crate) mod project;
pub(crate) mod site;

use std::path::{Path, PathBuf};

use files::{Described, Fault, FileError, Place, parse_document, read_text, read_value};
use rocking_wall::scene::SceneError;
use run::records::{NamedRecord, RecordsTable, all_records, copies, record_files, records};
use run::walls::assumed;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::error::CheckError;
use project::ReportTable;
use project::SiteOfProject;
use site::Records;

/// Largest grid of the hazard that is read.
const MAX_GRID_BYTES: u64 = 64 << 20;

/// Returns the text of a file with assignments to its table `[check]`, such as `check.soil=C`, behind it: see
/// [`CheckFile::parse_with`].
///
/// # Errors
/// The assignment that is none.
pub fn with_assignments(text: &str, set: &[String]) -> Result<String, String> {
    let mut lines = vec![text.to_owned()];
    for assignment in set {
        let Some((key, value)) = assignment.split_once('=') else {
            return Err(format!("{assignment}: expected NAME=VALUE, such as check.soil=B"));
        };
        let [key, value] = [key, value].map(str::trim);
        let written = format!("{key} = {value}");
        // a text needs no quotes here; one of JSON is one of TOML
        let quoted = || format!("{key} = {}", serde_json::Value::from(value));
        let line = if written.parse::<toml::Table>().is_ok() { written } else { quoted() };
        if let Err(error) = line.parse::<toml::Table>() {
            return Err(format!("{assignment}: {}", error.message()));
        }
        lines.push(line);
    }
    Ok(lines.join("\n"))
}

/// Moves the places of a value by some bytes.
fn shift(value: &mut Spanned<DeValue<'_>>, by: usize) {
    let place = value.span();
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| shift(value, by)),
        DeValue::Array(array) => array.iter_mut().for_each(|value| shift(value, by)),
        _ => {}
    }
    let inner = std::mem::replace(value.get_mut(), DeValue::Boolean(false));
    *value = Spanned::new(place.start + by..place.end + by, inner);
}

/// Lays a table over another, key by key.
fn overlay<'a>(base: &mut DeTable<'a>, patch: &DeTable<'a>) {
    for (key, value) in patch {
        let below = base.get_mut(key).map(Spanned::get_mut);
        if let (Some(DeValue::Table(below)), DeValue::Table(patch)) = (below, value.get_ref()) {
            overlay(below, patch);
        } else {
            base.remove(key);
            base.insert(key.clone(), value.clone());
        }
    }
}

/// A scene, or a file of walls, with a table `[check]`.
pub struct CheckFile<'a> {
    place: Place<'a>,
    /// Bytes of the text that are the file's own; assignments follow.
    own: usize,
    document: DeTable<'a>,
    folder: PathBuf,
    records: Vec<NamedRecord>,
    /// Whether the records that the table names are read.
    reads_records: bool,
}

impl<'a> CheckFile<'a> {
    /// Parses a text; `name` stands for the file in messages. Files that it names are beside it.
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn parse(name: &'a str, text: &'a str) -> Result<Self, FileError> {
        Self::parse_with(name, text, text.len())
    }

    /// Parses a text that has `own` bytes of its own, and assignments behind them: see [`with_assignments`].
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn parse_with(name: &'a str, text: &'a str, own: usize) -> Result<Self, FileError> {
        let place = Place::new(name, text);
        let mut document = parse_document(&Place::new(name, &text[..own]))?;
        let folder = Path::new(name).parent().unwrap_or(Path::new(".")).to_owned();
        let mut from = own;
        for line in text[own..].split_inclusive('\n') {
            if let Ok(table) = DeTable::parse(line) {
                let mut table = table.into_inner();
                table.iter_mut().for_each(|(_, value)| shift(value, from));
                overlay(&mut document, &table);
            }
            from += line.len();
        }
        Ok(Self { place, own, document, folder, records: Vec::new(), reads_records: true })
    }

    /// Returns the file with what one of its walls states of the check laid over the file's own statements;
    /// `None` for a wall that states nothing. `allowed` are the keys that walls may state, such as
    /// `building.height_ratio`; of `a|b` one replaces the other.
    ///
    /// # Errors
    /// [`FileError`] of another key.
    pub(crate) fn of_wall(&self, entry: usize, allowed: &[&str]) -> Result<Option<Self>, FileError> {
        let walls = self.document.get("walls").and_then(|walls| walls.get_ref().as_array());
        let wall = walls.and_then(|walls| walls.get(entry)).and_then(|wall| wall.get_ref().as_table());
        let Some(own) = wall.and_then(|wall| wall.get("check")) else { return Ok(None) };
        let Some(own) = own.get_ref().as_table() else {
            let message = "check of a wall is a table, such as { hinge = \"worst\" }";
            return Err(self.place.error(own.span(), message));
        };
        let mut document = self.document.clone();
        let Some(DeValue::Table(check)) = document.get_mut("check").map(Spanned::get_mut) else {
            return Ok(None);
        };
        let has = |others: &str, path: &str| others.split('|').any(|other| other == path);
        let is_allowed = |path: &str| allowed.iter().any(|others| has(others, path));
        for (key, value) in own {
            let key = key.get_ref().as_ref();
            let inner = value.get_ref().as_table().into_iter().flat_map(DeTable::keys);
            let mut paths: Vec<_> = inner.map(|inner| format!("{key}.{}", inner.get_ref())).collect();
            if paths.is_empty() || is_allowed(key) {
                paths = vec![key.to_owned()];
            }
            if let Some(path) = paths.into_iter().find(|path| !is_allowed(path)) {
                let message = format!(
                    "check.{path} is that of the building, not of a wall alone; state it in the file's \
                     [check]"
                );
                return Err(self.place.error(value.span(), message));
            }
            for other in allowed.iter().filter(|others| has(others, key)).flat_map(|others| others.split('|'))
            {
                if other != key {
                    check.remove(other);
                }
            }
        }
        overlay(check, own);
        let place = Place::new(self.place.name(), self.place.text());
        let (folder, records) = (self.folder.clone(), self.records.clone());
        Ok(Some(Self { place, document, folder, records, ..*self }))
    }

    /// Takes these records in place of those that the table names.
    #[must_use]
    pub fn with_records(self, records: Vec<NamedRecord>) -> Self {
        Self { records, ..self }
    }

    /// Leaves the records that the table names unread, where only its other statements count.
    #[must_use]
    pub fn without_records(self) -> Self {
        Self { reads_records: false, ..self }
    }

    /// The name of the file.
    pub fn name(&self) -> &'a str {
        self.place.name()
    }

    /// The text of the file.
    pub fn text(&self) -> &'a str {
        &self.place.text()[..self.own]
    }

    /// Returns the text of the file with the lines of the grid of `[check.site]` in place of the name of its
    /// file, for a machine without that file.
    ///
    /// # Errors
    /// [`FileError`] of a grid that cannot be read.
    pub fn self_contained(&self) -> Result<String, FileError> {
        let grid = self.check().and_then(|check| check.get_ref().get("site")?.get_ref().get("grid"));
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

    /// Returns whether the file is one of walls, as a study is.
    pub fn has_walls(&self) -> bool {
        self.document.contains_key("walls")
    }

    /// Returns whether the file states a value.
    pub(crate) fn states(&self, keys: &[&str]) -> bool {
        let mut table = Some(&self.document);
        keys.iter().all(|key| {
            let value = table.and_then(|table| table.get(*key));
            table = value.and_then(|value| value.get_ref().as_table());
            value.is_some()
        })
    }

    /// Returns the parameters that decide verdicts, and that the file leaves to their start values; `set`
    /// holds assignments that state them, too.
    pub fn assumed(&self, set: &[String]) -> Vec<&'static str> {
        let is_set =
            |name: &str| set.iter().any(|set| set.split('=').next().is_some_and(|key| key.trim() == name));
        assumed(|group, name| self.states(&[group, name]) || is_set(name))
    }

    fn check(&self) -> Option<&Spanned<DeValue<'a>>> {
        self.document.get("check")
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
        read_value(&self.place, &self.document, check)
            .map_err(|Fault { keys, message, .. }| CheckError::Value { keys, message })
    }

    /// Reads the table `[report]`; that of a study says what the study shows. Coordinates, `V_N` and `C_U`
    /// that it leaves out are those of `[check.site]`.
    ///
    /// # Errors
    /// [`FileError`] of the first key that is not known, or whose value cannot be used, or differs
    /// from that of the site.
    pub fn report(&self) -> Result<ReportTable, FileError> {
        let is_study = self.document.contains_key("levels") || self.document.contains_key("models");
        // what is wrong with the site is told where the check is read
        let site = self.check().and_then(|check| check.get_ref().get("site")).cloned();
        let site = site.and_then(|site| SiteOfProject::deserialize(ValueDeserializer::from(site)).ok());
        let site = site.unwrap_or_default();
        let Some(given) = self.document.get("report").filter(|_| !is_study) else {
            return Ok(ReportTable::of_site(&site));
        };
        let mut table: ReportTable = read_value(&self.place, &self.document, given)
            .map_err(|fault| self.place.error(fault.span, fault.message))?;
        table.complete(&site).map_err(|(key, message)| {
            let value = given.get_ref().get(key);
            self.place.error(value.map_or(given.span(), Spanned::span), format!("[report] {message}"))
        })?;
        Ok(table)
    }

    /// Reads the records that a table names, or takes those that were handed over.
    ///
    /// # Errors
    /// [`CheckError::File`] of what the table cannot state, [`CheckError::Scene`] of a record.
    pub(crate) fn records(&self, table: Option<&Spanned<RecordsTable>>) -> Result<Records, CheckError> {
        let (mut files, mut warnings, mut named) = (Vec::new(), Vec::new(), self.records.clone());
        if let (Some(table), true) = (table, self.reads_records && named.is_empty()) {
            let entry = records(table, &self.place)?;
            let found = record_files(&entry, &self.folder, self.name())?;
            named = all_records(&entry, &found, self.name(), &mut warnings)?;
            files = found.into_iter().map(|file| file.path).collect();
        }
        warnings.extend(copies(&named));
        Ok(Records { named, files, warnings })
    }

    /// Adds the file to an error, and the line of the key that it is about.
    pub fn located(&self, error: CheckError) -> SceneError {
        let reason = if error.keys().is_some() { format!("[check] {error}") } else { error.to_string() };
        let span = error.keys().filter(|_| self.check().is_some()).map(|keys| self.span(keys));
        match (span, error) {
            (_, CheckError::File(error)) => error.into(),
            (_, CheckError::Scene(error)) => error,
            (Some(span), _) if span.start >= self.own && self.own < self.place.text().len() => {
                let after = &self.place.text()[self.own..];
                let line = after.get(..span.start - self.own).unwrap_or_default().matches('\n').count();
                let line = after.lines().nth(line).unwrap_or_default();
                FileError::whole(self.name(), format!("--set {line}: {reason}")).into()
            }
            (Some(span), _) => self.place.error(span, reason).into(),
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
