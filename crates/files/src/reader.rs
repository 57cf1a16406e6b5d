//! Reads TOML into tables. The words of the reader do not reach users: what is wrong is said here, with key,
//! line and what is expected.

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::error::FileError;
use crate::limits::{Fault, fault, schema_of};
use crate::names::{suggestion, unknown_key};
use crate::overlay::{overlay, shift};
use crate::place::Place;
use crate::schema::{Described, Tables};
use crate::syntax::{NUMBER, parse_document, shown};

/// A TOML text, parsed once: its tables, with the places of keys and values.
#[derive(Clone)]
pub struct TomlFile<'a> {
    place: Place<'a>,
    /// The table of the whole text.
    whole: Spanned<DeValue<'a>>,
}

impl<'a> TomlFile<'a> {
    /// Parses a text; `name` stands for its file in messages.
    ///
    /// # Errors
    /// [`FileError`] where the text is not TOML.
    pub fn new(name: &'a str, text: &'a str) -> Result<Self, FileError> {
        let place = Place::new(name, text);
        let table = DeValue::Table(parse_document(&place)?);
        Ok(Self { place, whole: Spanned::new(0..text.len(), table) })
    }

    /// Parses a text that has `own` bytes of its own, and behind them assignments, one a line, such as
    /// `check.soil = "C"`: each is laid over what stands before it.
    ///
    /// # Errors
    /// [`FileError`] where the own text is not TOML.
    pub fn with_assignments(name: &'a str, text: &'a str, own: usize) -> Result<Self, FileError> {
        let mut file = Self { place: Place::new(name, text), ..Self::new(name, &text[..own])? };
        let mut from = own;
        for line in text[own..].split_inclusive('\n') {
            if let Ok(table) = DeTable::parse(line) {
                let mut table = table.into_inner();
                table.iter_mut().for_each(|(_, value)| shift(value, from));
                overlay(file.table_mut(), &table);
            }
            from += line.len();
        }
        Ok(file)
    }

    /// Returns the text with its file's name.
    pub fn place(&self) -> &Place<'a> {
        &self.place
    }

    /// Returns the table of the whole text.
    pub fn table(&self) -> &DeTable<'a> {
        self.whole.get_ref().as_table().unwrap_or_else(|| unreachable!("a text is a table"))
    }

    /// Returns the table of the whole text, to change it.
    pub fn table_mut(&mut self) -> &mut DeTable<'a> {
        match self.whole.get_mut() {
            DeValue::Table(table) => table,
            _ => unreachable!("a text is a table"),
        }
    }

    /// Returns the value to which keys lead from the outermost table on.
    pub fn get(&self, keys: &[&str]) -> Option<&Spanned<DeValue<'a>>> {
        keys.iter().try_fold(&self.whole, |value, key| value.get_ref().get(*key))
    }

    /// Finds the value of a key by its place, whatever tables it stands in: one that was read without the
    /// places of what it holds.
    pub fn find(&self, key: &str, span: &Range<usize>) -> Option<&Spanned<DeValue<'a>>> {
        find(self.table(), key, span)
    }

    /// Reads the whole text.
    ///
    /// # Errors
    /// [`FileError`] of the first key that is not known, of a value of another kind, or outside its limits:
    /// key, line and what is expected.
    pub fn read<T: DeserializeOwned + Described>(&self) -> Result<T, FileError> {
        self.read_value(&self.whole).map_err(|fault| self.place.error(fault.span, fault.message))
    }

    /// Reads a value, such as a table.
    ///
    /// # Errors
    /// [`Fault`] as of [`Self::read`].
    pub fn read_value<T: DeserializeOwned + Described>(
        &self,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<T, Fault> {
        let refused = |error: toml::de::Error| {
            let span = error.span().unwrap_or(value.span());
            let found = Found::at(self.table(), self.place.text(), &span);
            let message = found.explained(error.message(), &schema_of::<T>().1);
            let mut keys = Vec::new();
            in_value(value.get_ref(), &span, &mut keys);
            Fault { keys, span, message }
        };
        let read = T::deserialize(ValueDeserializer::from(value.clone())).map_err(refused)?;
        fault::<T>(value).map_or(Ok(read), Err)
    }
}

/// Finds the value of a key below a table by its place.
fn find<'a, 'b>(table: &'a DeTable<'b>, key: &str, span: &Range<usize>) -> Option<&'a Spanned<DeValue<'b>>> {
    fn inside<'a, 'b>(
        value: &'a Spanned<DeValue<'b>>,
        key: &str,
        span: &Range<usize>,
    ) -> Option<&'a Spanned<DeValue<'b>>> {
        match value.get_ref() {
            DeValue::Table(table) => find(table, key, span),
            DeValue::Array(items) => items.iter().find_map(|item| inside(item, key, span)),
            _ => None,
        }
    }
    let own = table.iter().find(|(own, value)| own.get_ref() == key && value.span() == *span);
    own.map(|(_, value)| value).or_else(|| table.values().find_map(|value| inside(value, key, span)))
}

/// What stands where a value cannot be used.
struct Found<'a> {
    /// The keys that lead there, the value's own last; none for the whole document.
    keys: Vec<String>,
    /// The value as it is written.
    value: &'a str,
}

impl<'a> Found<'a> {
    fn at(document: &DeTable<'_>, text: &'a str, span: &Range<usize>) -> Self {
        let mut keys = Vec::new();
        in_table(document, span, &mut keys);
        Self { keys, value: text.get(span.clone()).unwrap_or_default() }
    }

    /// Translates a message of the reader. Those of this project's own types pass.
    fn explained(&self, message: &str, tables: &Tables) -> String {
        let names: Vec<_> = message.split('`').skip(1).step_by(2).collect();
        let is = |start: &str| message.starts_with(start);
        if is("unknown field") {
            // the last key is the unknown one
            let table = self.keys[..self.keys.len().saturating_sub(1)].join(".");
            return unknown_key(names[0], &table, &names[1..], &tables.groups);
        }
        if is("missing field") {
            return match self.keys.join(".").as_str() {
                "" => format!("{} is missing; add it", names.concat()),
                table => format!("{} is missing in [{table}]; add it", names.concat()),
            };
        }
        if is("unknown variant") {
            let quoted: Vec<_> = names[1..].iter().map(|name| format!("{name:?}")).collect();
            let meant = suggestion(names[0], names[1..].iter().copied());
            return format!("{} is not one of {}{meant}", self.given(), quoted.join(", "));
        }
        let overflows = message.contains("overflowed") || message.contains("too large");
        let expected = message.strip_prefix("invalid ").and_then(|rest| rest.rsplit_once(", expected "));
        let expected = if let Some((_, expected)) = expected {
            in_toml_words(expected)
        } else if is("wanted string or table") {
            "a name in quotes".to_owned()
        } else if overflows {
            "a smaller number".to_owned()
        } else if is("wanted") || is("data did not match") {
            "another value".to_owned()
        } else {
            return format!("{}: {message}", self.given());
        };
        format!("{}: expected {expected}", self.given())
    }

    /// The value with its key.
    fn given(&self) -> String {
        // the name of a table in brackets says no more
        let value = shown(self.value.lines().next().unwrap_or_default());
        match self.keys.last() {
            Some(key) if value.is_empty() || is_header(&value) => key.clone(),
            Some(key) => format!("{key} = {value}"),
            None => format!("`{value}`"),
        }
    }
}

fn is_header(value: &str) -> bool {
    value.starts_with('[') && value.trim_start_matches('[').starts_with(|c: char| c.is_alphabetic())
}

/// Adds the keys that lead to a span, and returns whether there is such a key or value. Of tables that begin
/// at one place, such as those of `[check.building]`, it is the innermost.
fn in_table(table: &DeTable<'_>, span: &Range<usize>, keys: &mut Vec<String>) -> bool {
    for (key, value) in table {
        keys.push(key.get_ref().to_string());
        let inside = in_value(value.get_ref(), span, keys);
        if inside || key.span() == *span || value.span() == *span {
            return true;
        }
        keys.pop();
    }
    false
}

fn in_value(value: &DeValue<'_>, span: &Range<usize>, keys: &mut Vec<String>) -> bool {
    match value {
        DeValue::Table(table) => in_table(table, span, keys),
        DeValue::Array(items) => {
            items.iter().any(|item| in_value(item.get_ref(), span, keys) || item.span() == *span)
        }
        _ => false,
    }
}

/// Replaces the Rust type that the reader expects with TOML's own word.
fn in_toml_words(expected: &str) -> String {
    let counted = |rest: &str| rest.split(' ').find_map(|word| word.parse::<usize>().ok());
    match expected {
        // of a number that no type holds
        "any valid TOML value" => "a smaller number".to_owned(),
        "a map" => "a table".to_owned(),
        "a sequence" => "a list".to_owned(),
        "path string" => "a path in quotes".to_owned(),
        "a string" | "str" | "string" => "a text in quotes".to_owned(),
        "f64" => NUMBER.to_owned(),
        "u32" | "u64" | "usize" => "a whole number from 0 on".to_owned(),
        "a boolean" | "bool" => "true or false".to_owned(),
        name if name.starts_with("struct ") => "a table".to_owned(),
        name if name.starts_with("an array of ") || name.starts_with("a tuple of ") => {
            counted(name).map_or_else(|| "a list".to_owned(), |count| format!("a list of {count} values"))
        }
        other => other.to_owned(),
    }
}
