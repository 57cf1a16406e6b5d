//! The sections of the report: every statement, number and check, with its clause and equations.

pub(super) mod capacity;
mod hinges;
mod inputs;
mod limit_states;
pub(super) mod overview;
pub(super) mod readings;
mod runs;
pub(super) mod site;
mod spectrum;
pub(super) mod symbols;
mod ties;

use super::side_verdict::SideVerdict;
use super::table::{Activation, Hinge};
use super::verdict::{Checked, Side};
use crate::error::CheckError;
use crate::report::markup::side_head;
use crate::report::{Origin, the_wall};

/// What is to be said of each side, under its name where they differ; nothing of one is left out.
fn by_side(case: &Checked<'_>, say: impl Fn(Side, &SideVerdict) -> String) -> String {
    let mut text = String::new();
    for (name, side, verdict) in case.sides() {
        let own = say(side, verdict);
        if !own.is_empty() && !case.outcome.alike {
            text += &side_head(name);
        }
        text += &own;
    }
    text
}

/// The groups of parameters that the static check uses, and those that only runs use.
const STATIC: [&str; 3] = ["geometry", "force_law", "tie"];
const DYNAMIC: [&str; 3] = ["damping", "impact", "solver"];

/// The sections, each with its heading.
pub(super) fn sections(case: &Checked<'_>, origin: &Origin<'_>) -> Result<Vec<(String, String)>, CheckError> {
    let is_dynamic = case.outcome.dynamic.is_some();
    let is_law = case.statement.table.before_activation == Some(Activation::Law);
    let is_used = |group: &str, name: &str| {
        // a wall that is rigid or a beam before it rocks has no elastic branch of its law
        let is_left_out = case.parameters.a3 == 1.0 && matches!(name, "force_law" | "a3" | "softening");
        let replaced = (name == "a1" || is_left_out) && !is_dynamic && !is_law;
        // a hinge that is searched has a section of its own
        let replaced =
            replaced || name == "hinge_ratio" && case.rule.is_some_and(|rule| rule != Hinge::Given);
        (STATIC.contains(&group) || is_dynamic && DYNAMIC.contains(&group)) && !replaced
    };
    let one = |heading: &str, markup: String| (heading.to_owned(), markup);
    let mut sections = vec![
        one("Statements of the engineer", inputs::statements(case, origin)),
        one("The wall", the_wall(&case.wall, &case.parameters, origin, &is_used)),
        one("Demand at the wall", site::at_wall(case)?),
    ];
    sections.extend(hinges::section(case).map(|markup| one("Hinges", markup)));
    sections.push(one("Capacity curve", capacity::section(case)?));
    sections.extend(ties::section(case).map(|markup| one("The tie", markup)));
    sections.extend(limit_states::sections(case));
    sections.extend(runs::section(case).map(|markup| one("Runs under records C8.7.1.2.1.9", markup)));
    Ok(sections)
}
