//! Keys of scenes: those that the model description does not have, and what to say of one that is unknown.

use std::collections::BTreeMap;

use toml::{Spanned, Value};

use crate::variables::GROUPS;

use super::nearest::suggestion;

/// A table of parameters: names and values with their places.
pub type Group = BTreeMap<Spanned<String>, Spanned<Value>>;

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

/// Says of a key that a table does not hold where it belongs, or what the table holds; `table` is empty for
/// the file itself.
pub(super) fn unknown_key(name: &str, table: &str, known: &[&str]) -> String {
    let is_of_wall = table.is_empty() || GROUPS.iter().any(|(group, _)| *group == table);
    let group = GROUPS.iter().find(|(_, names)| names.contains(&name)).map(|(group, _)| *group);
    let group = group.or((name == KINEMATICS).then_some(KINEMATICS_GROUP));
    if let Some(group) = group.filter(|_| is_of_wall) {
        return format!("{name:?} belongs in [{group}]");
    }
    let place = if table.is_empty() { String::new() } else { format!(" in [{table}]") };
    let meant = suggestion(name, known.iter().copied());
    format!("unknown key {name:?}{place}{meant}; it holds {}", known.join(", "))
}
