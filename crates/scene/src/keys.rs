//! Keys of scenes that the model description does not have.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Deref;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use toml::{Spanned, Value};

/// A table of parameters: names and values with their places.
#[derive(Clone, Debug, Default, serde::Deserialize)]
#[serde(transparent)]
pub struct Group(BTreeMap<Spanned<String>, Spanned<Value>>);

impl Deref for Group {
    type Target = BTreeMap<Spanned<String>, Spanned<Value>>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

/// The ties of a wall: one table `[tie]`, or a list `[[tie]]`.
#[derive(Clone, Debug, Default)]
pub struct TieTables {
    tables: Vec<Group>,
    /// Whether they are a list.
    pub(crate) is_list: bool,
}

impl Deref for TieTables {
    type Target = [Group];

    fn deref(&self) -> &[Group] {
        &self.tables
    }
}

impl<'de> Deserialize<'de> for TieTables {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrMany;

        impl<'de> Visitor<'de> for OneOrMany {
            type Value = TieTables;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a table [tie], or several [[tie]]")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TieTables, A::Error> {
                let table = Group::deserialize(MapAccessDeserializer::new(map))?;
                Ok(TieTables { tables: vec![table], is_list: false })
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<TieTables, A::Error> {
                let tables = Vec::deserialize(SeqAccessDeserializer::new(seq))?;
                Ok(TieTables { tables, is_list: true })
            }
        }

        deserializer.deserialize_any(OneOrMany)
    }
}

/// The key of a multilinear law's points, in `[force_law]` beside `force_law = "multilinear"`.
pub const POINTS: &str = "points";
/// The key in `[geometry]` that chooses small or full rotations.
pub const KINEMATICS: &str = "kinematics";

/// The key in `[tie]` of the bar, a table of its own.
pub(crate) const BAR: &str = "bar";
/// The table that holds a tie.
pub(crate) const TIE_GROUP: &str = "tie";
/// Most ties of a wall.
pub(crate) const MOST_TIES: usize = 100;
/// The parameters that follow from the bar of a tie.
pub(crate) const OF_BAR: [&str; 3] = ["tie_stiffness", "tie_strength", "tie_ultimate"];

/// The name in `force_law` that stands for a law of points.
pub(crate) const MULTILINEAR: &str = "multilinear";
/// The table that holds the kinematics.
pub(crate) const KINEMATICS_GROUP: &str = "geometry";
