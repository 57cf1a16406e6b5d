//! The file with a table `[check]`: parsed once, with the lines of its keys.

use std::path::{Path, PathBuf};

use rocking_wall::scene::{Place, SceneError, parse_document, refusal};
use run::records::{NamedRecord, RecordsTable, all_records, record_files, records};
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::error::CheckError;
use crate::site::Records;

/// A scene, or a file of walls, with a table `[check]`.
pub struct CheckFile<'a> {
    place: Place<'a>,
    document: DeTable<'a>,
    folder: PathBuf,
    records: Vec<NamedRecord>,
}

impl<'a> CheckFile<'a> {
    /// Parses a text; `name` stands for the file in messages. Files that it names are beside it.
    ///
    /// # Errors
    /// [`SceneError::Line`] where the text is not TOML.
    pub fn parse(name: &'a str, text: &'a str) -> Result<Self, SceneError> {
        let place = Place::new(name, text);
        let document = parse_document(&place)?;
        let folder = Path::new(name).parent().unwrap_or(Path::new(".")).to_owned();
        Ok(Self { place, document, folder, records: Vec::new() })
    }

    /// Takes these records in place of those that the table names.
    #[must_use]
    pub fn with_records(self, records: Vec<NamedRecord>) -> Self {
        Self { records, ..self }
    }

    /// The name of the file.
    pub fn name(&self) -> &'a str {
        self.place.name()
    }

    /// The text of the file.
    pub fn text(&self) -> &'a str {
        self.place.text()
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
    /// [`CheckError::Unread`] of the first key that is not known, or has another kind of value.
    pub(crate) fn table<T: DeserializeOwned>(&self) -> Result<T, CheckError> {
        let Some(check) = self.check() else { return Err(CheckError::wall("the table [check] is missing")) };
        T::deserialize(ValueDeserializer::from(check.clone())).map_err(|error| {
            let (mut keys, message) = refusal(&self.place, &self.document, &error);
            keys.drain(..keys.len().min(1));
            CheckError::Unread { keys, message }
        })
    }

    /// Reads the records that a table names, or takes those that were handed over.
    ///
    /// # Errors
    /// [`CheckError::Scene`] of a file that cannot be read.
    pub(crate) fn records(&self, table: Option<&Spanned<RecordsTable>>) -> Result<Records, CheckError> {
        let (mut files, mut warnings, mut named) = (Vec::new(), Vec::new(), self.records.clone());
        if let (Some(table), true) = (table, named.is_empty()) {
            let entry = records(table, &self.place)?;
            let found = record_files(&entry, &self.folder, self.name())?;
            named = all_records(&entry, &found, self.name(), &mut warnings)?;
            files = found.into_iter().map(|file| file.path).collect();
        }
        Ok(Records { named, files, warnings })
    }

    /// Adds the file to an error, and the line of the key that it is about.
    pub fn located(&self, error: CheckError) -> SceneError {
        let reason = match (&error, error.keys()) {
            (CheckError::Unread { .. }, _) | (_, None) => error.to_string(),
            _ => format!("[check] {error}"),
        };
        let span = error.keys().filter(|_| self.check().is_some()).map(|keys| self.span(keys));
        match (span, error) {
            (_, CheckError::Scene(error)) => error,
            (Some(span), _) => self.place.error(span, reason),
            (None, _) => SceneError::File { file: self.name().to_owned(), reason },
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
