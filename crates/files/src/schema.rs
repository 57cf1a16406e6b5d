//! JSON schemas of files, from the structs that read them: names, kinds, limits, defaults and descriptions of
//! their keys.
//!
//! A file's tables are declared with [`tables!`](crate::tables). Their descriptions are the comments of the
//! fields, and their names those that serde reads.

use std::path::PathBuf;

use ground_motion::{Acceleration, Format, Unit};
use serde::de::{DeserializeOwned, Deserializer, Error, IgnoredAny, Visitor};
use toml::{Spanned, Table, Value};

use crate::names::Groups;

/// What a schema says about a value, or about a whole file.
pub type Schema = Table;

/// What descriptions of values refer to.
#[derive(Default)]
pub struct Tables {
    /// The schemas of tables by their names.
    pub schemas: Schema,
    /// The groups of parameters of a file. Who applies them checks their values.
    pub groups: Groups,
}

/// A value of a file that a schema describes.
pub trait Described: 'static {
    /// Whether a table may leave the value out.
    const OPTIONAL: bool = false;

    /// Describes the value under `key`, and adds what it refers to.
    fn describe(key: &str, tables: &mut Tables) -> Schema;
}

/// Declares tables of a file: structs that serde reads, and whose schema [`Described`] tells.
///
/// Unknown keys are refused. `#[key(…)]` adds words of JSON Schema to a field.
///
/// ```
/// files::tables! {
///     /// A load.
///     #[derive(Debug)]
///     struct LoadTable {
///         /// Force \[N\].
///         #[key(minimum = 0.0)]
///         force: f64,
///         /// Where it acts.
///         #[serde(rename = "at")]
///         place: Option<String>,
///     }
/// }
/// let load: LoadTable = toml::from_str("force = 2.0").unwrap();
/// assert_eq!((load.force, load.place), (2.0, None));
/// let schema = files::file_schema::<LoadTable>("Load");
/// assert_eq!(schema["required"].as_array().unwrap()[0].as_str(), Some("force"));
/// assert_eq!(schema["properties"]["force"]["description"].as_str(), Some("Force [N]."));
/// assert_eq!(schema["properties"]["at"]["type"].as_str(), Some("string"));
/// ```
#[macro_export]
macro_rules! tables {
    ($(
        $(#[doc = $about:literal])+
        $(#[derive($($derive:ident),+)])?
        $visibility:vis struct $table:ident {$(
            $(#[doc = $text:literal])+
            $(#[serde($($serde:tt)+)])?
            $(#[key($($word:ident = $value:expr),+)])?
            $field_visibility:vis $field:ident: $type:ty,
        )+}
    )+) => {$(
        $(#[doc = $about])+
        $(#[derive($($derive),+)])?
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        $visibility struct $table {$(
            $(#[doc = $text])+
            $(#[serde($($serde)+)])?
            $field_visibility $field: $type,
        )+}

        impl $crate::Described for $table {
            fn describe(_key: &str, tables: &mut $crate::Tables) -> $crate::Schema {
                let fields: &[$crate::Field] = &[$($crate::Field {
                    text: concat!($($text),+),
                    optional: <$type as $crate::Described>::OPTIONAL
                        || stringify!($($($serde)+)?).contains("default"),
                    describe: <$type as $crate::Described>::describe,
                    words: || vec![$($((stringify!($word), $value.into())),+)?],
                }),+];
                let (keys, about) = ($crate::names::<Self>(), concat!($($about),+));
                $crate::describe_table(stringify!($table), about, keys, fields, tables)
            }
        }
    )+};
}

/// A field of a table of [`tables!`](crate::tables).
#[doc(hidden)]
#[allow(missing_docs, reason = "only the macro makes it")]
pub struct Field {
    pub text: &'static str,
    pub optional: bool,
    pub describe: fn(&str, &mut Tables) -> Schema,
    pub words: fn() -> Vec<(&'static str, Value)>,
}

/// Adds a table to `tables`, and refers to it.
#[doc(hidden)]
pub fn describe_table(
    name: &str,
    about: &str,
    keys: &[&str],
    fields: &[Field],
    tables: &mut Tables,
) -> Schema {
    if !tables.schemas.contains_key(name) {
        let mut properties = Schema::new();
        for (key, field) in keys.iter().zip(fields) {
            let mut property = with((field.describe)(key, tables), "description", plain(field.text));
            property.extend((field.words)().into_iter().map(|(word, value)| (word.to_owned(), value)));
            properties.insert((*key).to_owned(), property.into());
        }
        let mut table = with(object(properties), "description", plain(about));
        let required = keys.iter().zip(fields).filter(|(_, field)| !field.optional);
        let required: Vec<_> = required.map(|(key, _)| *key).collect();
        if !required.is_empty() {
            table.insert("required".into(), required.into());
        }
        tables.schemas.insert(name.into(), table.into());
    }
    one("$ref", format!("#/$defs/{name}"))
}

/// Returns the schema of the files that are read as `T`.
pub fn file_schema<T: Described>(title: &str) -> Schema {
    let mut tables = Tables::default();
    let file = T::describe("", &mut tables);
    let name = file["$ref"].as_str().and_then(|path| path.rsplit('/').next()).unwrap_or_default();
    let Some(Value::Table(mut schema)) = tables.schemas.remove(name) else { return file };
    schema.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
    schema.insert("title".into(), title.into());
    schema.insert("$defs".into(), tables.schemas.into());
    schema
}

/// Describes a table of these keys.
pub fn object(properties: Schema) -> Schema {
    with(with(one("type", "object"), "additionalProperties", false), "properties", properties)
}

/// Describes one of these names.
pub fn one_of<'a>(names: impl IntoIterator<Item = &'a str>) -> Schema {
    one("enum", names.into_iter().collect::<Vec<_>>())
}

/// Describes a number above 0.
pub fn positive() -> Schema {
    with(one("type", "number"), "exclusiveMinimum", 0)
}

/// Describes a fraction of something: above 0 and at most 1.
pub fn fraction() -> Schema {
    with(positive(), "maximum", 1)
}

/// Describes a text.
pub fn text(description: &str) -> Schema {
    with(one("type", "string"), "description", description)
}

/// Adds a word to a schema.
pub fn with(mut schema: Schema, word: &str, value: impl Into<Value>) -> Schema {
    schema.insert(word.to_owned(), value.into());
    schema
}

fn one(word: &str, value: impl Into<Value>) -> Schema {
    with(Schema::new(), word, value)
}

/// The text of a comment, without its marks.
fn plain(comment: &str) -> String {
    comment.trim().replace(['\\', '`'], "")
}

/// Returns the names that serde reads, in the order in which they are declared: the keys of a struct, or the
/// choices of an enumeration.
pub fn names<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut names: &[&str] = &[];
    let _ = T::deserialize(Names(&mut names));
    names
}

/// Takes the names that a type asks for, and has no value for them.
struct Names<'a>(&'a mut &'static [&'static str]);

impl<'de> Deserializer<'de> for Names<'_> {
    type Error = serde::de::value::Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        *self.0 = fields;
        self.deserialize_any(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Self::Error> {
        *self.0 = variants;
        self.deserialize_any(visitor)
    }

    fn deserialize_any<V: Visitor<'de>>(self, _visitor: V) -> Result<V::Value, Self::Error> {
        Err(Self::Error::custom("only the names are asked for"))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map identifier ignored_any
    }
}

/// Describes enumerations that serde reads: their names are the choices.
#[macro_export]
macro_rules! choices {
    ($($type:ty),+) => {$(
        impl $crate::Described for $type {
            fn describe(_key: &str, _tables: &mut $crate::Tables) -> $crate::Schema {
                $crate::one_of($crate::names::<Self>().iter().copied())
            }
        }
    )+};
}

/// Describes types by one expression each; `|key, tables|` names what the expression may use.
macro_rules! describe {
    (|$key:ident, $tables:ident| $(
        $(@$generic:ident)? $type:ty $(, $optional:literal)? => $schema:expr;
    )+) => {$(
        impl $(<$generic: Described>)? Described for $type {
            $(const OPTIONAL: bool = $optional;)?

            fn describe($key: &str, $tables: &mut Tables) -> Schema {
                let _ = (&$key, &$tables);
                $schema
            }
        }
    )+};
}

describe! { |key, tables|
    f64 => one("type", "number");
    u32 => natural();
    u64 => natural();
    usize => natural();
    bool => one("type", "boolean");
    String => one("type", "string");
    PathBuf => one("type", "string");
    Acceleration => one("type", vec!["number", "string"]);
    Unit => text_such_as(Unit::ALL.map(Unit::name).to_vec());
    Format => text_such_as(Format::ALL.map(Format::name).to_vec());
    Value => Schema::new();
    IgnoredAny, true => Schema::new();
    @T Option<T>, true => T::describe(key, tables);
    @T Spanned<T> => T::describe(key, tables);
    @T Vec<T> => list(T::describe(key, tables));
    @T [T; 2] => several(2, T::describe(key, tables));
    @T [T; 3] => several(3, T::describe(key, tables));
}

fn natural() -> Schema {
    with(one("type", "integer"), "minimum", 0)
}

/// A text that the reader takes in more spellings than these.
fn text_such_as(examples: Vec<&str>) -> Schema {
    with(one("type", "string"), "examples", examples)
}

/// Describes a list.
pub fn list(items: Schema) -> Schema {
    with(one("type", "array"), "items", items)
}

/// Describes a list of so many items.
pub fn several(count: i64, items: Schema) -> Schema {
    with(with(list(items), "minItems", count), "maxItems", count)
}
