//! The record file that the user has dropped.

use std::str::FromStr;

use ground_motion::{Format, Record, RecordOptions, Unit, parse};
use scene::fingerprint;

use crate::request::{Faults, Fields, fault_of};

/// A record file, and how it was last read.
#[derive(Debug, Default)]
pub(crate) struct Upload {
    bytes: Vec<u8>,
    fingerprint: String,
    read: Option<(String, RecordOptions, Record)>,
}

impl Upload {
    pub(crate) fn new(bytes: Vec<u8>) -> Self {
        Self { fingerprint: fingerprint(&bytes), bytes, read: None }
    }

    /// Returns the fingerprint that a scene states.
    pub(crate) fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// Returns the record, read with the options of a request. It is read again only if they have changed.
    pub(crate) fn record(&mut self, motion: &Fields) -> Result<&Record, Faults> {
        let name = motion.get("record").cloned().unwrap_or_default();
        if self.bytes.is_empty() {
            let message = match name.as_str() {
                "" => "drop a record file here, or choose one".to_owned(),
                _ => format!("{name}: a link does not contain records; drop the file here, or choose it"),
            };
            return Err(fault_of("record", message));
        }
        let options = options(motion)?;
        let current = self.read.take().filter(|(of, with, _)| (of, with) == (&name, &options));
        let read = match current {
            Some(read) => read,
            None => match parse(&name, self.bytes.clone(), &options) {
                Ok(record) => (name, options, record),
                Err(error) => return Err(fault_of("record", error.to_string())),
            },
        };
        Ok(&self.read.insert(read).2)
    }
}

/// How to read the record, as the fields say.
fn options(motion: &Fields) -> Result<RecordOptions, Faults> {
    let text = |key: &str| motion.get(key).map(|text| text.trim()).filter(|text| !text.is_empty());
    Ok(RecordOptions {
        unit: parsed::<Unit>("unit", text("unit"))?,
        step: parsed::<f64>("step", text("step"))?,
        column: text("column").map(ToOwned::to_owned),
        channel: text("channel").map(ToOwned::to_owned),
        format: parsed::<Format>("format", text("format"))?,
    })
}

fn parsed<T: FromStr>(field: &str, text: Option<&str>) -> Result<Option<T>, Faults>
where
    T::Err: std::fmt::Display,
{
    let Some(text) = text else { return Ok(None) };
    text.parse().map(Some).map_err(|error| fault_of(field, format!("{field} = {text:?}: {error}")))
}
