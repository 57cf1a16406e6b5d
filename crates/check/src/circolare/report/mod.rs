//! The sections of the report: every statement, number and check, with its clause and equations.

pub(super) mod capacity;
pub(crate) mod figure;
mod hinges;
mod inputs;
mod levels;
mod loads;
mod notes;
pub(super) mod overview;
pub(super) mod readings;
pub(crate) mod rows;
mod runs;
pub(super) mod site;
pub(super) mod symbols;
mod ties;

use rocking_wall::wall::COMPUTED;

use super::checks::sides::SideVerdict;
use super::outcome::Checked;
use super::statement::table::{Activation, Hinge};
use crate::code::verdict::Section;
use crate::error::CheckError;
use crate::sections::inputs::{keys, of_wall};
use crate::sections::origin::Origin;
use crate::words::ledger::Ledger;
use crate::words::markup::{as_paragraph, heads, side_head, table};
use crate::words::names::{Deciding, Side, Sides};
use crate::words::{Language, Sentence, say};

/// A side that differs, with its numbers.
struct SideLedger<'a> {
    /// The body above the level whose side it is.
    level: &'a Checked<'a>,
    of: Sides,
    side: Side,
    verdict: &'a SideVerdict,
    ledger: Ledger,
}

impl SideLedger<'_> {
    /// The name of the side and of the level, as a heading.
    fn head(&self, language: Language) -> String {
        side_head(self.of, self.level.stated_level(), language)
    }
}

/// The sides that differ, of each level.
fn ledgers<'a>(case: &'a Checked<'a>) -> Vec<SideLedger<'a>> {
    let of_level = |level: &'a Checked<'a>| {
        level.sides().map(move |(side, verdict)| SideLedger {
            level,
            of: level.which(side),
            side,
            verdict,
            ledger: level.ledger(side, verdict),
        })
    };
    case.levels().into_iter().flat_map(of_level).collect()
}

/// What is to be said of each side, under its name where they differ; nothing of one is left out.
fn by_side(
    case: &Checked<'_>,
    sides: &[SideLedger<'_>],
    language: Language,
    say: impl Fn(&SideLedger<'_>) -> String,
) -> String {
    let mut text = String::new();
    for one in sides {
        let own = say(one);
        if !own.is_empty() && !case.is_one() {
            text += &one.head(language);
        }
        text += &own;
    }
    text
}

/// The groups of parameters that the static check uses, and those that only runs use.
const STATIC: [&str; 3] = ["geometry", "force_law", "tie"];
const DYNAMIC: [&str; 3] = ["damping", "impact", "solver"];

/// The sections of a wall.
pub(super) fn sections(case: &Checked<'_>, origin: &Origin<'_>) -> Result<Vec<Section>, CheckError> {
    let (language, lowest) = (origin.report.language, case.lowest());
    let is_dynamic = case.outcome.dynamic.is_some();
    let is_law = case.statement.table.before_activation == Some(Activation::Law);
    let is_used = |group: &str, name: &str| {
        // a wall that is rigid or a beam before it rocks has no elastic branch of its law
        let is_left_out = case.parameters.a3 == 1.0 && matches!(name, "force_law" | "a3" | "softening");
        let replaced = (name == "a1" || is_left_out) && !is_dynamic && !is_law;
        // the loads have their section
        let is_sum = name.starts_with("load_") || name.starts_with("thrust");
        let replaced = replaced || is_sum || name == "arm_inner" && case.parameters.arm_inner == COMPUTED;
        // a hinge that is searched has a section of its own
        let replaced =
            replaced || name == "hinge_ratio" && case.rule.is_some_and(|rule| rule != Hinge::Given);
        (STATIC.contains(&group) || is_dynamic && DYNAMIC.contains(&group)) && !replaced
    };
    let sides = ledgers(case);
    let text = |text: Option<&String>| text.map_or_else(String::new, |text| as_paragraph(text));
    let mut sections = vec![
        Section::new(
            say!("Statements of the engineer", "Dichiarazioni del progettista"),
            inputs::statements(case, origin),
        ),
        Section::new(
            say!("Materials and level of knowledge", "Materiali e livello di conoscenza"),
            loads::materials(case, language) + &text(origin.report.materials.as_ref()),
        ),
        Section::new(
            say!("Loads", "Analisi dei carichi"),
            loads::loads(case, language) + &text(origin.report.loads.as_ref()),
        ),
        Section::new(
            say!("The wall", "La parete"),
            case.drawn(language) + &of_wall(&lowest.wall, &lowest.parameters, origin, &is_used),
        ),
        Section::new(say!("Demand at the wall", "Domanda alla parete"), site::at_wall(case, language)?),
    ];
    let mut add = |heading: Sentence, markup: String| {
        if !markup.is_empty() {
            sections.push(Section::new(heading, markup));
        }
    };
    add(say!("Hinges", "Cerniere"), hinges::section(case, &sides, language));
    add(say!("Capacity curve", "Curva di capacità"), capacity::section(case, &sides, language)?);
    add(say!("The tie", "La catena"), ties::section(case, &sides, language));
    for check in Deciding::ALL {
        let heading = match check {
            Deciding::Sld => say!("SLD: activation C8.7.1.2.1.5", "SLD: attivazione C8.7.1.2.1.5"),
            Deciding::SlvWithQ => say!("SLV with q C8.7.1.2.1.7", "SLV con q C8.7.1.2.1.7"),
            Deciding::Slv => {
                say!("SLV by displacement C8.7.1.2.1.8", "SLV in spostamento C8.7.1.2.1.8")
            }
            Deciding::Slc => {
                say!("SLC by displacement C8.7.1.2.1.8", "SLC in spostamento C8.7.1.2.1.8")
            }
        };
        let mut text = String::new();
        for one in &sides {
            let lines = one.ledger.markup(check.name(), language);
            if !lines.is_empty() {
                let head = if case.is_one() { String::new() } else { one.head(language) };
                text.extend(["<div class=\"together\">", &head, &lines, "</div>\n"]);
            }
        }
        add(heading, text);
    }
    let heading = say!("Runs under records C8.7.1.2.1.9", "Analisi con accelerogrammi C8.7.1.2.1.9");
    add(heading, runs::section(case, language));
    let all = [inputs::keys(case, origin), keys(&lowest.wall, &lowest.parameters, origin, &is_used)].concat();
    let parts =
        [say!("datum", "dato"), say!("key in the file", "chiave nel file"), say!("from", "provenienza")];
    let heading = say!("Origin of the data", "Provenienza dei dati");
    add(heading, format!("<div class=\"from\">{}</div>", table(&heads(parts, language), &all)));
    Ok(sections)
}
