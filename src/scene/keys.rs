//! Keys of scenes that the model description does not have.

use std::collections::BTreeMap;
use std::ops::Deref;

use serde::Deserialize;
use toml::{Spanned, Value};

/// A table of parameters: names and values with their places.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(transparent)]
pub struct Group(BTreeMap<Spanned<String>, Spanned<Value>>);

impl Deref for Group {
    type Target = BTreeMap<Spanned<String>, Spanned<Value>>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

/// The key of a multilinear law's points, in `[force_law]` beside `force_law = "multilinear"`.
pub const POINTS: &str = "points";
/// The key in `[geometry]` that chooses small or full rotations.
pub const KINEMATICS: &str = "kinematics";

/// The key in `[tie]` of the bar, a table of its own.
pub(super) const BAR: &str = "bar";
/// The table that holds the tie.
pub(super) const TIE_GROUP: &str = "tie";
/// The parameters that follow from the bar of a tie.
pub(super) const OF_BAR: [&str; 3] = ["tie_stiffness", "tie_strength", "tie_ultimate"];

/// The name in `force_law` that stands for a law of points.
pub(super) const MULTILINEAR: &str = "multilinear";
/// The table that holds the kinematics.
pub(super) const KINEMATICS_GROUP: &str = "geometry";
