//! Where a variable matters: `<Where>` in its annotation.
//!
//! ```text
//! <Where solver="adaptive"/>
//! <Where solver="automatic" damping_model="constant_ratio stiffness_proportional"/>
//! ```
//!
//! At least one `<Where>` has to hold, with all its attributes. An attribute names a parameter and its
//! values, or `not` and the values that it must not have; a parameter that does not matter itself has none
//! of them, so that its own condition is part of this one.

use crate::element::Element;

/// One attribute of a `<Where>`.
#[derive(Clone, Debug)]
pub(crate) struct Test {
    pub(crate) parameter: String,
    pub(crate) is_not: bool,
    pub(crate) values: Vec<String>,
}

/// One `<Where>`.
#[derive(Clone, Debug)]
pub(crate) struct Alternative {
    pub(crate) line: usize,
    pub(crate) tests: Vec<Test>,
}

/// Reads the `<Where>` of an annotation.
pub(crate) fn read<'a>(tools: impl Iterator<Item = &'a Element>) -> Vec<Alternative> {
    let places = tools.flat_map(|tool| &tool.children).filter(|child| child.name == "Where");
    let alternative = |place: &Element| {
        let test = |(parameter, text): &(String, String)| {
            let rest = text.strip_prefix("not ");
            let values = rest.unwrap_or(text).split_whitespace().map(str::to_owned).collect();
            Test { parameter: parameter.clone(), is_not: rest.is_some(), values }
        };
        Alternative { line: place.line, tests: place.attributes.iter().map(test).collect() }
    };
    places.map(alternative).collect()
}

/// The condition in words, as in `solver = adaptive, or solver = automatic and a = 1`; `None` for a variable
/// that always matters.
pub(crate) fn words(alternatives: &[Vec<&Test>]) -> Option<String> {
    let test = |Test { parameter, is_not, values }: &Test| {
        let (last, others) = values.split_last()?;
        let listed =
            if others.is_empty() { last.clone() } else { format!("{} or {last}", others.join(", ")) };
        Some(format!("{parameter} {} {listed}", if *is_not { "is not" } else { "=" }))
    };
    let alternative = |tests: &Vec<&Test>| {
        let tests: Vec<_> = tests.iter().copied().filter_map(test).collect();
        tests.join(" and ")
    };
    let alternatives: Vec<_> = alternatives.iter().map(alternative).collect();
    (!alternatives.is_empty()).then(|| alternatives.join(", or "))
}
