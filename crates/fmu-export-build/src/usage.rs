//! What the conditions of variables mean for each other: their check, and their Rust.

use crate::condition::{Test, words};
use crate::error::Fault;
use crate::names::{camel, field, type_name};
use crate::variable::{Causality, EnumerationType, Kind, Variable};

/// Longest chain of conditions on conditions.
const MOST_LINKS: usize = 8;

/// Checks that every test names a parameter and values that it can have, and that no condition depends on
/// itself.
pub(crate) fn check(variables: &[Variable], enumerations: &[EnumerationType]) -> Result<(), Fault> {
    for variable in variables {
        let name = &variable.name;
        for alternative in &variable.conditions {
            let wrong = |why: &str| Fault::new(alternative.line, format!("<Where> of `{name}` {why}"));
            if alternative.tests.is_empty() {
                return Err(wrong("is empty"));
            }
            for Test { parameter, values, .. } in &alternative.tests {
                let of = parameter_called(variables, parameter)
                    .ok_or_else(|| wrong(&format!("names `{parameter}`, which is not a parameter")))?;
                let is_value = |value: &String| match of.kind {
                    Kind::Enumeration { .. } => of.items(enumerations).iter().any(|item| item.name == *value),
                    _ => value.parse::<f64>().is_ok_and(f64::is_finite),
                };
                if values.is_empty() || !values.iter().all(is_value) {
                    let given = values.join(" ");
                    return Err(wrong(&format!("gives {given:?}, which `{parameter}` cannot be")));
                }
            }
        }
        if links(variables, variable, MOST_LINKS).is_none() {
            return Err(variable.fault(format!("<Where> of `{name}` depends on itself, by way of others")));
        }
    }
    Ok(())
}

/// How many conditions stand behind that of `variable`; `None` for more than `most`.
fn links(variables: &[Variable], variable: &Variable, most: usize) -> Option<usize> {
    let tests = variable.conditions.iter().flat_map(|alternative| &alternative.tests);
    tests
        .filter_map(|test| parameter_called(variables, &test.parameter))
        .try_fold(0, |longest, of| Some(longest.max(1 + links(variables, of, most.checked_sub(1)?)?)))
}

fn parameter_called<'a>(variables: &'a [Variable], name: &str) -> Option<&'a Variable> {
    variables.iter().find(|other| other.name == name && other.causality == Causality::Parameter)
}

/// Where `variable` matters: at least one of the lists of tests has to hold completely. None for a variable
/// that always does.
///
/// The conditions of the parameters that it names are part of its own: where these do not matter, it does
/// not either.
pub(crate) fn alternatives<'a>(variable: &'a Variable, variables: &'a [Variable]) -> Vec<Vec<&'a Test>> {
    let of_test = |test: &'a Test| -> Vec<Vec<&'a Test>> {
        let behind = parameter_called(variables, &test.parameter).map(|of| alternatives(of, variables));
        match behind.unwrap_or_default() {
            none if none.is_empty() => vec![vec![test]],
            behind => behind.into_iter().map(|tests| [vec![test], tests].concat()).collect(),
        }
    };
    let all_of = |tests: &'a [Test]| {
        tests.iter().map(of_test).fold(vec![Vec::new()], |lists, more| {
            lists.iter().flat_map(|list| more.iter().map(|tests| [&list[..], tests].concat())).collect()
        })
    };
    variable.conditions.iter().flat_map(|alternative| all_of(&alternative.tests)).collect()
}

/// The condition of a variable in words; `None` for one that always matters.
pub(crate) fn condition(variable: &Variable, variables: &[Variable]) -> Option<String> {
    words(&alternatives(variable, variables))
}

/// The description of a variable with its condition, where it has one.
pub(crate) fn described(variable: &Variable, variables: &[Variable]) -> String {
    let description = &variable.description;
    match condition(variable, variables) {
        None => description.clone(),
        Some(words) if description.is_empty() => format!("where {words}"),
        Some(words) => format!("{description}; where {words}"),
    }
}

/// The text `xml` of a description, with the conditions at the end of the descriptions of its variables.
pub(crate) fn written(xml: &str, variables: &[Variable]) -> String {
    const OPEN: &str = "description=\"";
    let mut text = xml.to_owned();
    for (variable, words) in variables.iter().filter_map(|one| Some((one, condition(one, variables)?))) {
        let name = format!("<ScalarVariable name=\"{}\"", variable.name);
        let Some(name_end) = text.find(&name).map(|start| start + name.len()) else { continue };
        let tag = &text[name_end..];
        // a value may contain `>`, but no `<`
        let tag = &tag[..tag.find('<').unwrap_or(tag.len())];
        match tag.split_once(OPEN) {
            Some((before, after)) => {
                let end = name_end + before.len() + OPEN.len() + after.find('"').unwrap_or(after.len());
                text.insert_str(end, &format!("; where {words}"));
            }
            None => text.insert_str(name_end, &format!(" {OPEN}where {words}\"")),
        }
    }
    text
}

/// The condition as Rust, for the fields of `$parameters`.
pub(crate) fn code(variable: &Variable, variables: &[Variable]) -> String {
    let test = |test: &Test| Some(test_code(test, parameter_called(variables, &test.parameter)?));
    let all_of = |tests: &Vec<&Test>| tests.iter().copied().filter_map(test).collect::<Vec<_>>().join(" && ");
    let alternatives: Vec<_> = alternatives(variable, variables).iter().map(all_of).collect();
    if alternatives.is_empty() { "true".to_owned() } else { alternatives.join(" || ") }
}

/// The test of the value of the parameter `of` as Rust.
fn test_code(Test { is_not, values, .. }: &Test, of: &Variable) -> String {
    let place = format!("$parameters.{}", field(of));
    let (not, sign, join) = if *is_not { ("!", "!=", " && ") } else { ("", "==", " || ") };
    let number = |value: &String| match of.kind {
        Kind::Integer { .. } => format!("{place} {sign} {value}"),
        _ => format!("{place} {sign} {:?}", value.parse::<f64>().unwrap_or_default()),
    };
    if let Kind::Enumeration { .. } = of.kind {
        let items = values.iter().map(|value| format!("{}::{}", type_name(of), camel(value)));
        return format!("{not}matches!({place}, {})", items.collect::<Vec<_>>().join(" | "));
    }
    let numbers: Vec<_> = values.iter().map(number).collect();
    if numbers.len() > 1 { format!("({})", numbers.join(join)) } else { numbers.join(join) }
}
