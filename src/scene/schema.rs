//! JSON schemas of files, from the structs that read them: names, kinds, limits, defaults and descriptions of
//! their keys.
//!
//! A file's tables are declared with [`tables!`](crate::tables). Their descriptions are the comments of the
//! fields, and their names those that serde reads.

use std::path::PathBuf;

use fmu_export::{Kind, Variable, VariableId};
use ground_motion::{Acceleration, Format, Unit};
use serde::de::{DeserializeOwned, IgnoredAny};
use toml::{Spanned, Table, Value};

use crate::variables::{GROUPS, IntegerVariable, RealVariable};
use crate::wall::{Bar, BarNumber, Kinematics};

use super::keys::{BAR, Group, KINEMATICS, KINEMATICS_GROUP, MULTILINEAR, POINTS, TIE_GROUP};

/// What a schema says about a value, or about a whole file.
pub type Schema = Table;

/// A value of a file that a schema describes.
pub trait Described: 'static {
    /// Whether a table may leave the value out.
    const OPTIONAL: bool = false;

    /// Describes the value under `key`, and adds the tables that it refers to.
    fn describe(key: &str, tables: &mut Schema) -> Schema;
}

/// Declares tables of a file: structs that serde reads, and whose schema [`Described`] tells.
///
/// Unknown keys are refused. `#[key(…)]` adds words of JSON Schema to a field.
///
/// ```
/// rocking_wall::tables! {
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
/// let schema = rocking_wall::scene::file_schema::<LoadTable>("Load");
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

        impl $crate::scene::Described for $table {
            fn describe(_key: &str, tables: &mut $crate::scene::Schema) -> $crate::scene::Schema {
                let fields: &[$crate::scene::Field] = &[$($crate::scene::Field {
                    text: concat!($($text),+),
                    optional: <$type as $crate::scene::Described>::OPTIONAL
                        || stringify!($($($serde)+)?).contains("default"),
                    describe: <$type as $crate::scene::Described>::describe,
                    words: || vec![$($((stringify!($word), $value.into())),+)?],
                }),+];
                let about = concat!($($about),+);
                $crate::scene::describe_table::<Self>(stringify!($table), about, fields, tables)
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
    pub describe: fn(&str, &mut Schema) -> Schema,
    pub words: fn() -> Vec<(&'static str, Value)>,
}

/// Adds a table to `tables`, and refers to it.
#[doc(hidden)]
pub fn describe_table<T: DeserializeOwned>(
    name: &str,
    about: &str,
    fields: &[Field],
    tables: &mut Schema,
) -> Schema {
    if !tables.contains_key(name) {
        let keys = names::<T>();
        let mut properties = Schema::new();
        for (key, field) in keys.iter().zip(fields) {
            let mut property = with((field.describe)(key, tables), "description", plain(field.text));
            property.extend((field.words)().into_iter().map(|(word, value)| (word.to_owned(), value)));
            properties.insert(key.clone(), property.into());
        }
        let mut table = with(object(properties), "description", plain(about));
        let required = keys.iter().zip(fields).filter(|(_, field)| !field.optional);
        let required: Vec<_> = required.map(|(key, _)| key.as_str()).collect();
        if !required.is_empty() {
            table.insert("required".into(), required.into());
        }
        tables.insert(name.into(), table.into());
    }
    one("$ref", format!("#/$defs/{name}"))
}

/// Returns the schema of the files that are read as `T`.
pub fn file_schema<T: Described>(title: &str) -> Schema {
    let mut tables = Schema::new();
    let file = T::describe("", &mut tables);
    let name = file["$ref"].as_str().and_then(|path| path.rsplit('/').next()).unwrap_or_default();
    let Some(Value::Table(mut schema)) = tables.remove(name) else { return file };
    schema.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
    schema.insert("title".into(), title.into());
    schema.insert("$defs".into(), tables.into());
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

/// Returns the names that serde reads: the keys of a struct, or the choices of an enumeration. Its refusal of
/// another name lists them.
pub fn names<T: DeserializeOwned>() -> Vec<String> {
    let refusal = toml::from_str::<T>("'' = 0").err().map(|error| error.message().to_owned());
    // unknown field ``, expected one of `a`, `b`
    refusal.iter().flat_map(|text| text.split('`').skip(3).step_by(2)).map(str::to_owned).collect()
}

/// Describes enumerations that serde reads: their names are the choices.
#[macro_export]
macro_rules! choices {
    ($($type:ty),+) => {$(
        impl $crate::scene::Described for $type {
            fn describe(_key: &str, _tables: &mut $crate::scene::Schema) -> $crate::scene::Schema {
                $crate::scene::one_of($crate::scene::names::<Self>().iter().map(String::as_str))
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

            fn describe($key: &str, $tables: &mut Schema) -> Schema {
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
    Bar => bar();
    Group, true => object(parameters(key));
}

fn natural() -> Schema {
    with(one("type", "integer"), "minimum", 0)
}

/// A text that the reader takes in more spellings than these.
fn text_such_as(examples: Vec<&str>) -> Schema {
    with(one("type", "string"), "examples", examples)
}

fn list(items: Schema) -> Schema {
    with(one("type", "array"), "items", items)
}

fn several(count: i64, items: Schema) -> Schema {
    with(with(list(items), "minItems", count), "maxItems", count)
}

/// Describes the parameters of a group, and what only scenes know: kinematics, and a law of points.
pub fn parameters(group: &str) -> Schema {
    let names = GROUPS.iter().find(|(name, _)| *name == group).map_or(&[][..], |(_, names)| *names);
    let mut members: Schema =
        names.iter().filter_map(|name| Some(((*name).to_owned(), parameter(variable(name)?)?))).collect();
    if group == TIE_GROUP {
        members.insert(BAR.into(), bar().into());
    }
    if group == KINEMATICS_GROUP {
        let text = "Small rotations, or full ones (rigid_linear without damping, not in an FMU).";
        let choice = with(one_of(Kinematics::ALL.map(Kinematics::name)), "description", text);
        members.insert(KINEMATICS.into(), with(choice, "default", Kinematics::default().name()).into());
    }
    let laws = members.get_mut("force_law").and_then(|law| law.get_mut("enum")?.as_array_mut());
    if let Some(laws) = laws {
        laws.push(MULTILINEAR.into());
        let text = "Corners [u/u_ins, F/F0] of a multilinear law after the origin.";
        let points = with(list(several(2, one("type", "number"))), "minItems", 2);
        members.insert(POINTS.into(), with(points, "description", text).into());
    }
    members
}

/// Describes the bar of a tie.
fn bar() -> Schema {
    let describe = |number: BarNumber| {
        let unit = Some(number.usual.unit).filter(|unit| !unit.is_empty());
        let text = format!("{}{}", number.text, unit.map_or(String::new(), |unit| format!(" [{unit}]")));
        (number.key().to_owned(), with(positive(), "description", text).into())
    };
    let required = Bar::NUMBERS.iter().filter(|number| number.is_required).map(BarNumber::key);
    let bar = with(
        object(Bar::NUMBERS.map(describe).into_iter().collect()),
        "required",
        required.collect::<Vec<_>>(),
    );
    with(
        bar,
        "description",
        "The tie as it is built, in place of tie_stiffness, tie_strength and tie_ultimate.",
    )
}

/// Returns the variable of the model description with a name: a number, or a choice.
pub fn variable(name: &str) -> Option<&'static Variable> {
    let real = RealVariable::from_name(name).map(VariableId::variable);
    real.or_else(|| IntegerVariable::from_name(name).map(VariableId::variable))
}

/// Describes a parameter of a model description; `None` for what has no number or choice.
pub fn parameter(variable: &Variable) -> Option<Value> {
    let unit = variable.unit.map_or(String::new(), |unit| format!(" [{unit}]"));
    let schema = match variable.kind {
        Kind::Real { start, min, max } => {
            let mut number = one("type", "number");
            let limits = [("default", start), ("minimum", min), ("maximum", max)];
            number.extend(limits.into_iter().filter_map(|(word, x)| Some((word.to_owned(), x?.into()))));
            number
        }
        Kind::Enumeration { start, items } => {
            let mut choice = one_of(items.iter().map(|item| item.name));
            let default = items.iter().find(|item| Some(item.value) == start);
            choice.extend(default.map(|item| ("default".to_owned(), item.name.into())));
            choice
        }
        _ => return None,
    };
    Some(with(schema, "description", format!("{}{unit}", variable.description)).into())
}
