//! What stands over the statements of a file: assignments, and those of one of its walls.

use files::{FileError, overlay};
use run::records::NamedRecord;
use run::walls::NamedWall;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::CheckFile;

/// Returns the text of a file with assignments to its table `[check]`, such as `check.soil=C`, behind it: see
/// [`CheckFile::parse_with`].
///
/// # Errors
/// The assignment that is not NAME=VALUE, or that TOML does not have.
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
        let refused = |error: toml::de::Error| format!("{assignment}: {}", error.message());
        lines.push(match written.parse::<toml::Table>() {
            Ok(_) => written,
            Err(_) => quoted().parse::<toml::Table>().map(|_| quoted()).map_err(refused)?,
        });
    }
    Ok(lines.join("\n"))
}

impl<'a> CheckFile<'a> {
    /// Returns the file with what one of its walls states of the check laid over the file's own statements;
    /// `None` for a wall that states nothing. `allowed` are the keys that walls may state, such as
    /// `building.height_ratio`; of `a|b` one replaces the other.
    ///
    /// # Errors
    /// [`FileError`] of another key.
    pub(crate) fn of_wall(&self, entry: usize, allowed: &[&str]) -> Result<Option<Self>, FileError> {
        let walls = self.file.get(&["walls"]).and_then(|walls| walls.get_ref().as_array());
        let wall = walls.and_then(|walls| walls.get(entry)).and_then(|wall| wall.get_ref().as_table());
        let Some(own) = wall.and_then(|wall| wall.get("check")) else { return Ok(None) };
        let Some(own) = own.get_ref().as_table() else {
            let message = "check of a wall is a table, such as { hinge = \"worst\" }";
            return Err(self.file.place().error(own.span(), message));
        };
        let mut file = self.clone();
        let Some(DeValue::Table(check)) = file.file.table_mut().get_mut("check").map(Spanned::get_mut) else {
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
                return Err(self.file.place().error(value.span(), message));
            }
            for other in allowed.iter().filter(|others| has(others, key)).flat_map(|others| others.split('|'))
            {
                if other != key {
                    check.remove(other);
                }
            }
        }
        overlay(check, own);
        Ok(Some(file))
    }

    /// The text of the file with what a row of a table of walls states of its check behind it.
    ///
    /// # Errors
    /// [`FileError`] of a value that TOML does not have.
    pub(crate) fn with_row(&self, wall: &NamedWall) -> Result<Option<String>, FileError> {
        if wall.check.is_empty() {
            return Ok(None);
        }
        let statements: Vec<_> =
            wall.check.iter().map(|(key, value)| format!("check.{key}={value}")).collect();
        let text = with_assignments(self.file.place().text(), &statements);
        let named =
            |message: String| FileError::whole(self.name(), format!("wall {:?}: {message}", wall.name));
        text.map(Some).map_err(named)
    }

    /// Parses such a text: the same file, with the same records.
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub(crate) fn of_row<'b>(
        &self,
        text: &'b str,
        records: Vec<NamedRecord>,
    ) -> Result<CheckFile<'b>, FileError>
    where
        'a: 'b,
    {
        Ok(CheckFile::parse_with(self.name(), text, self.own)?.with_records(records))
    }
}
