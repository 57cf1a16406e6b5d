//! Names: the one that a mistyped one stands for, and where a key belongs.

use std::collections::BTreeMap;

use strsim::osa_distance;

/// Longest name that is compared.
const LONGEST: usize = 64;

/// Groups of parameters: the keys of each table.
pub type Groups = BTreeMap<&'static str, Vec<&'static str>>;

/// Says of a key that a table does not hold in which group it belongs, or what the table holds; `table` is
/// empty for the file itself.
pub fn unknown_key(name: &str, table: &str, known: &[&str], groups: &Groups) -> String {
    let own = format!("{table}_{name}");
    if known.contains(&own.as_str()) {
        return format!("unknown key {name:?} in [{table}] (did you mean {own:?}?)");
    }
    let group = groups.iter().find(|(_, names)| names.contains(&name));
    if let Some((group, _)) = group.filter(|_| table.is_empty() || groups.contains_key(table)) {
        return format!("{name:?} belongs in [{group}]");
    }
    let place = if table.is_empty() { String::new() } else { format!(" in [{table}]") };
    let meant = suggestion(name, known.iter().copied());
    format!("unknown key {name:?}{place}{meant}; it holds {}", known.join(", "))
}

/// Returns words that suggest the name nearest to a mistyped one, or none.
pub fn suggestion<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    nearest(mistyped, names).map_or_else(String::new, |name| format!(" (did you mean {name:?}?)"))
}

/// Returns the name that is the fewest letter changes away, if these are few for its length.
fn nearest<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = mistyped.chars().take(LONGEST + 1).count();
    let names = names.into_iter().filter(|_| length <= LONGEST);
    // Height is a slip for height, not another name
    let lower = mistyped.to_ascii_lowercase();
    let distances = names.map(|name| (osa_distance(&lower, &name.to_ascii_lowercase()), name));
    distances.filter(|(changes, _)| *changes <= (length / 3).max(1)).min().map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_of_the_keyboard_are_found_and_other_names_are_not() {
        let names = ["height", "thickness", "xi", "a1", "a3", "restitution", "u_start"];
        for (typed, name) in [
            ("hieght", "height"),
            ("tickness", "thickness"),
            ("resitution", "restitution"),
            ("u_strat", "u_start"),
            ("Xi", "xi"),
            ("HEIGHT", "height"),
        ] {
            assert_eq!(nearest(typed, names), Some(name), "{typed}");
        }
        for typed in ["colour", "mass", "", "an_altogether_different_name"] {
            assert_eq!(nearest(typed, names), None, "{typed}");
        }
    }
}
