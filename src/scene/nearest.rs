//! The name that a mistyped one stands for.

/// Returns the name that takes the fewest changes of a letter, if these are few for its length.
pub fn nearest<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const LONGEST: usize = 64;
    let typed: Vec<char> = mistyped.chars().take(LONGEST + 1).collect();
    let most = (typed.len() / 3).max(1);
    let distances = names.into_iter().map(|name| (changes(&typed, name), name));
    distances.filter(|(changes, _)| typed.len() <= LONGEST && *changes <= most).min().map(|(_, name)| name)
}

/// Counts the letters inserted, removed, replaced or swapped with the next: the optimal string alignment
/// distance.
fn changes(typed: &[char], name: &str) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=typed.len()).collect();
    let mut previous = None;
    for (row, letter) in name.chars().enumerate() {
        let mut next = vec![row + 1];
        for (column, &own) in typed.iter().enumerate() {
            let mut best =
                (last[column] + usize::from(own != letter)).min(last[column + 1] + 1).min(next[column] + 1);
            if column > 0 && own != letter && previous == Some(own) && typed[column - 1] == letter {
                best = best.min(before[column - 1] + 1);
            }
            next.push(best);
        }
        (before, last, previous) = (last, next, Some(letter));
    }
    last[typed.len()]
}

/// Returns the words that suggest the nearest name, or none.
pub(super) fn suggestion<'a>(mistyped: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    nearest(mistyped, names).map_or_else(String::new, |name| format!("; did you mean {name:?}?"))
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
        ] {
            assert_eq!(nearest(typed, names), Some(name), "{typed}");
        }
        for typed in ["colour", "mass", "", "an_altogether_different_name"] {
            assert_eq!(nearest(typed, names), None, "{typed}");
        }
    }
}
