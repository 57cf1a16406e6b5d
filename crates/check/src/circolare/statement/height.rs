//! z/H of a wall in its building.

use files::{Described, Schema, Tables, list, with};
use serde::Deserialize;
use toml::Value;

/// z/H of a wall: one, or one for each level at which it may open \[-\].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected a number, or a list with a number for each of hinge_levels")]
pub enum HeightRatio {
    /// That of the wall.
    One(f64),
    /// Those of its levels.
    Each(Vec<f64>),
}

impl HeightRatio {
    /// Whether it is that of the ground at every level.
    pub(crate) fn is_ground(&self) -> bool {
        match self {
            Self::One(ratio) => *ratio == 0.0,
            Self::Each(ratios) => ratios.iter().all(|ratio| *ratio == 0.0),
        }
    }

    /// The ratio at a level, by its place in the list.
    pub(crate) fn at(&self, level: usize) -> Option<f64> {
        match self {
            Self::One(ratio) => Some(*ratio),
            Self::Each(ratios) => ratios.get(level).copied(),
        }
    }
}

impl Described for HeightRatio {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let one = with(with(f64::describe(key, tables), "minimum", 0), "maximum", 1);
        let forms = vec![Value::Table(one.clone()), Value::Table(list(one.clone()))];
        with(with(Schema::new(), "anyOf", forms), "items", one)
    }
}
