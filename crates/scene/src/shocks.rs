//! Records of a motion: one, or several one after the other.

use std::path::{Path, PathBuf};

use files::{Described, Schema, Tables, list, tables, text, with};
use ground_motion::{
    Acceleration, Format, GroundMotion, GroundMotionError, Record, RecordOptions, Unit, read,
};
use toml::Value;

tables! {
    /// A record with options of its own.
    #[derive(Clone, Debug, Default)]
    pub struct RecordTable {
        /// Record file, beside the file that names it.
        pub record: PathBuf,
        /// Unit of the record: m/s2, cm/s2, mm/s2 or g (9.80665 m/s²); an AT2 file states its own.
        pub unit: Option<Unit>,
        /// Time between samples (s), for a record that does not state it.
        pub step: Option<f64>,
        /// Column of a table (CSV or text).
        pub column: Option<String>,
        /// Channel of a record with several, by its number.
        pub channel: Option<String>,
        /// Format of the record, found from its content if none is given.
        pub format: Option<Format>,
        /// Factor on the motion (-).
        pub scale: Option<f64>,
        /// Peak acceleration to scale to, in m/s² or as a text with its unit, such as "0.3g".
        pub pga: Option<Acceleration>,
        /// Fingerprint of the record file, FNV-1a-128 in hexadecimal; a file that differs is refused.
        pub fingerprint: Option<String>,
    }
}

/// What is wrong with a record: something in its table, or in the record itself.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum RecordProblem {
    #[error("{0}")]
    Table(String),
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
}

impl RecordTable {
    /// Returns what the table states of its part of the file and its size, in brackets; empty for nothing.
    pub fn options(&self) -> String {
        let texts = [("column", &self.column), ("channel", &self.channel)];
        let numbers = [("scale", self.scale), ("pga", self.pga.map(|pga| pga.0))];
        let texts = texts.into_iter().filter_map(|(key, text)| Some(format!("{key} {}", text.as_ref()?)));
        let numbers = numbers.into_iter().filter_map(|(key, number)| Some(format!("{key} {}", number?)));
        let stated: Vec<_> = texts.chain(numbers).collect();
        if stated.is_empty() { String::new() } else { format!(" ({})", stated.join(", ")) }
    }

    /// Reads the record, in `folder` and not scaled, with `common` options where it states none.
    pub(crate) fn read(&self, common: &RecordOptions, folder: &Path) -> Result<Record, RecordProblem> {
        let path = folder.join(&self.record);
        let options = RecordOptions {
            unit: self.unit.or(common.unit),
            step: self.step.or(common.step),
            column: self.column.clone().or_else(|| common.column.clone()),
            channel: self.channel.clone().or_else(|| common.channel.clone()),
            format: self.format.or(common.format),
        };
        let record = read(&path, &options)?;
        let Some(expected) = &self.fingerprint else { return Ok(record) };
        let file = path.display();
        let bytes = std::fs::read(&path).map_err(|error| RecordProblem::Table(format!("{file}: {error}")))?;
        let found = self::fingerprint(&bytes);
        if found == *expected {
            return Ok(record);
        }
        Err(RecordProblem::Table(format!(
            "{file} has the fingerprint {found}, not {expected}: it is not the record this scene was made \
             with"
        )))
    }
}

/// Returns the fingerprint of a record file in the form that a scene states.
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:032x}", fmu_export::fnv1a_128(bytes.iter().copied()))
}

/// Scales a motion by a factor or to a peak, if one of them is given.
pub(crate) fn scaled(
    motion: GroundMotion,
    factor: Option<f64>,
    pga: Option<Acceleration>,
) -> Result<GroundMotion, RecordProblem> {
    match (factor, pga) {
        (None, None) => Ok(motion),
        (Some(factor), None) => Ok(motion.checked_scaled(factor)?),
        (None, Some(pga)) => Ok(motion.scaled_to_peak(pga.0)?),
        (Some(_), Some(_)) => {
            Err(RecordProblem::Table("scale and pga exclude each other; give one of them".into()))
        }
    }
}

/// Records one after the other: a file, a table, or a list of these.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(try_from = "Value")]
pub struct Shocks(pub Vec<RecordTable>);

impl Shocks {
    /// Reads the records in `folder`, scales each, and joins them with a pause \[s\]. They have `common`
    /// options where they state none. `seen` sees each record as it is read.
    ///
    /// # Errors
    /// [`RecordProblem`].
    pub fn read(
        &self,
        common: &RecordOptions,
        pause: f64,
        folder: &Path,
        mut seen: impl FnMut(&RecordTable, &Record),
    ) -> Result<GroundMotion, RecordProblem> {
        let one = |table: &RecordTable| {
            let record = table.read(common, folder)?;
            seen(table, &record);
            scaled(record.motion, table.scale, table.pga)
        };
        let shocks = self.0.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        Ok(GroundMotion::sequence(&shocks, pause)?)
    }
}

/// What stands for anything else in the words of serde.
const EXPECTED: &str = "invalid type, expected a path in quotes, or a list such as [\"MAIN\", \"AFTER\"]";

impl TryFrom<Value> for Shocks {
    type Error = String;

    fn try_from(value: Value) -> Result<Self, String> {
        let one = |value: Value| match value {
            Value::String(file) => Ok(RecordTable { record: file.into(), ..RecordTable::default() }),
            Value::Table(_) => value.try_into().map_err(|error: toml::de::Error| error.message().to_owned()),
            _ => Err(EXPECTED.to_owned()),
        };
        match value {
            Value::Array(items) if !items.is_empty() => items.into_iter().map(one).collect(),
            value => one(value).map(|record| vec![record]),
        }
        .map(Self)
    }
}

impl Described for Shocks {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let one = [text("A record file."), RecordTable::describe(key, tables)].map(Value::Table).to_vec();
        let several = Value::Table(list(with(Schema::new(), "anyOf", one.clone())));
        with(Schema::new(), "anyOf", [one, vec![several]].concat())
    }
}
