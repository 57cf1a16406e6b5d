//! Records of a motion: one, or several one after the other.

use std::fmt;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use files::{Described, Schema, Tables, list, tables, text, with};
use ground_motion::{
    Acceleration, Format, GroundMotion, GroundMotionError, Record, RecordOptions, Unit, read,
};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
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
    /// Returns the name of the file.
    pub fn name(&self) -> String {
        self.record.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    }

    /// Reads the record, in `folder` and not scaled, with `common` options where it states none.
    ///
    /// # Errors
    /// [`RecordProblem`] of a file that cannot be read, or whose fingerprint is not the one stated.
    pub fn read(
        &self,
        common: &RecordOptions,
        fingerprint: Option<&str>,
        folder: &Path,
    ) -> Result<Record, RecordProblem> {
        let path = folder.join(&self.record);
        let options = RecordOptions {
            unit: self.unit.or(common.unit),
            step: self.step.or(common.step),
            column: self.column.clone().or_else(|| common.column.clone()),
            channel: self.channel.clone().or_else(|| common.channel.clone()),
            format: self.format.or(common.format),
        };
        let record = read(&path, &options)?;
        let Some(expected) = self.fingerprint.as_deref().or(fingerprint) else { return Ok(record) };
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

    /// Scales a motion as the table states.
    ///
    /// # Errors
    /// [`RecordProblem`] if it states both ways, or the motion cannot be scaled so.
    pub fn scaled(&self, motion: GroundMotion) -> Result<GroundMotion, RecordProblem> {
        scaled(motion, self.scale, self.pga)
    }
}

/// Returns the fingerprint of a record file in the form that a scene states.
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:032x}", fmu_export::fnv1a_128(bytes.iter().copied()))
}

/// Scales a motion by a factor or to a peak, if one of them is given.
pub(super) fn scaled(
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
#[derive(Clone, Debug)]
pub struct Shocks {
    records: Vec<RecordTable>,
    is_list: bool,
}

impl Deref for Shocks {
    type Target = [RecordTable];

    fn deref(&self) -> &[RecordTable] {
        &self.records
    }
}

impl<'de> Deserialize<'de> for Shocks {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrMany;

        impl<'de> Visitor<'de> for OneOrMany {
            type Value = Shocks;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a path in quotes, or a list such as [\"MAIN\", \"AFTER\"]")
            }

            fn visit_str<E: Error>(self, file: &str) -> Result<Shocks, E> {
                let record = RecordTable { record: file.into(), ..RecordTable::default() };
                Ok(Shocks { records: vec![record], is_list: false })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Shocks, A::Error> {
                let record = RecordTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Shocks { records: vec![record], is_list: false })
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Shocks, A::Error> {
                let mut records = Vec::new();
                while let Some(Shocks { records: own, is_list }) = seq.next_element()? {
                    if is_list {
                        return Err(A::Error::custom(
                            "a list within a list; expected a record file or a table",
                        ));
                    }
                    records.extend(own);
                }
                if records.is_empty() {
                    return Err(A::Error::custom("an empty list; expected at least one record file"));
                }
                Ok(Shocks { records, is_list: true })
            }
        }

        deserializer.deserialize_any(OneOrMany)
    }
}

impl Described for Shocks {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let one =
            vec![Value::Table(text("A record file.")), Value::Table(RecordTable::describe(key, tables))];
        let several = with(list(with(Schema::new(), "anyOf", one.clone())), "minItems", 1);
        with(Schema::new(), "anyOf", [one, vec![Value::Table(several)]].concat())
    }
}
