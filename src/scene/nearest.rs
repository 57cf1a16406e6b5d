//! The name that a mistyped one stands for.

use strsim::osa_distance;

/// Longest name that is compared.
const LONGEST: usize = 64;

/// Returns words that suggest the name nearest to a mistyped one, or none.
pub fn suggestion<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    nearest(mistyped, names).map_or_else(String::new, |name| format!(" (did you mean {name:?}?)"))
}

/// Returns the name that is the fewest letter changes away, if these are few for its length.
fn nearest<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = mistyped.chars().take(LONGEST + 1).count();
    let names = names.into_iter().filter(|_| length <= LONGEST);
    // Height is a slip for height, not another name
    let lower = mistyped.to_lowercase();
    let distances = names.map(|name| (osa_distance(&lower, &name.to_lowercase()), name));
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
