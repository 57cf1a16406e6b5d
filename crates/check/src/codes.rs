//! The codes, and which of them a file names.

use files::{Described, Schema, Tables, suggestion};

use crate::code::Code;
use crate::error::CheckError;
use crate::file::CheckFile;
use crate::words::entry::Entry;
use crate::{circolare, fractions};

/// A code, and how its table `[check]` is read.
#[derive(Clone, Copy)]
struct Listed {
    entry: Entry,
    /// Describes the keys of the table for a JSON schema.
    describe: fn(&str, &mut Tables) -> Schema,
    read: fn(&CheckFile<'_>) -> Result<Box<dyn Code>, CheckError>,
}

/// The codes: a new one is a module beside this one and a line here.
const LISTED: [Listed; 2] = [
    Listed {
        entry: circolare::ENTRY,
        describe: circolare::CheckTable::describe,
        read: |file| Ok(Box::new(circolare::Statement::read(file)?)),
    },
    Listed {
        entry: fractions::ENTRY,
        describe: fractions::FractionsTable::describe,
        read: |file| Ok(Box::new(fractions::Statement::read(file)?)),
    },
];

/// What the codes are called.
pub const CODES: [Entry; LISTED.len()] = {
    let mut entries = [LISTED[0].entry; LISTED.len()];
    let mut at = 1;
    while at < LISTED.len() {
        entries[at] = LISTED[at].entry;
        at += 1;
    }
    entries
};

/// Says how to write a table `[check]`.
pub fn how_to_write() -> String {
    let names = CODES.map(|code| format!("{:?}", code.name)).join(", ");
    let example = CODES[0].example;
    format!("the codes are {names}; in one line above all tables: {example}")
}

/// Reads the table `[check]` of a file.
///
/// # Errors
/// [`CheckError`] without a table, of an unknown code, or of the first value that cannot be used.
pub fn read(file: &CheckFile<'_>) -> Result<Box<dyn Code>, CheckError> {
    let names = CODES.map(|code| format!("{:?}", code.name));
    let Some(name) = file.code() else {
        return Err(CheckError::wall(format!("the table [check] is missing; {}", how_to_write())));
    };
    if let Some(code) = LISTED.iter().find(|code| code.entry.name == name) {
        return (code.read)(file);
    }
    let given = if name.is_empty() { "code is missing".to_owned() } else { format!("code = {name:?}") };
    let meant = suggestion(name, CODES.iter().map(|code| code.name));
    let message = format!("{given}{meant}; state one of {}", names.join(", "));
    Err(CheckError::value(&["code"], message))
}

/// Describes the table `[check]`, that of any code, in the schema of a file, which leaves it to who checks.
pub fn complete(schema: &mut Schema) {
    let Some(toml::Value::Table(check)) = schema["properties"].get_mut("check") else { return };
    let mut tables = Tables::default();
    let codes = LISTED.map(|code| (code.describe)("check", &mut tables)).to_vec();
    check.insert("anyOf".to_owned(), codes.into());
    if let Some(all) = schema["$defs"].as_table_mut() {
        all.extend(tables.schemas);
    }
}
