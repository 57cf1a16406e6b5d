//! `wall check --find`: the smallest wall that passes.

use std::fmt::Write;

use anyhow::Result;
use check::circolare::figure::over_parameter;
use check::circolare::{Sought, find};

use super::Arguments;
use super::code::Case;
use crate::output::{self, Console};

pub(super) fn run(console: &Console<'_>, arguments: &Arguments, case: &Case, sought: Sought) -> Result<()> {
    let Case { scene, statement, records, .. } = case;
    let found = case.located(find(&scene.parameters, scene.floors.as_ref(), statement, records, sought))?;
    console.picture(arguments.plot.as_ref(), || Ok(over_parameter(&found, sought).picture()))?;
    let (name, unit) = (sought.name(), sought.unit());
    if arguments.json {
        let value = serde_json::json!({
            "parameter": name,
            "value": found.value,
            "range": found.range,
            "passes_everywhere": found.everywhere,
            "fails_beyond": found.fails_beyond,
            "curve": found.curve,
        });
        return console.print(&(serde_json::to_string_pretty(&value)? + "\n"));
    }
    let [from, to] = found.range.map(|end| format!("{end:.4}"));
    let extreme = if sought == Sought::Height { "largest" } else { "smallest" };
    let mut text = match found.value {
        None if sought.name().starts_with("tie") => {
            format!(
                "no {name} from {from} to {to} {unit} passes; a side without a tie may govern: see tie_side\n"
            )
        }
        None => format!("no {name} from {from} to {to} {unit} passes\n"),
        Some(_) if found.everywhere => format!("every {name} from {from} to {to} {unit} passes\n"),
        Some(value) => format!("{extreme} {name} that passes: {value:.6} {unit}\n"),
    };
    if found.fails_beyond {
        let beyond = if sought == Sought::Height { "smaller" } else { "larger" };
        let _ = writeln!(text, "some {beyond} values fail; look at the chart (--plot)");
    }
    text += &output::written("written  ", &arguments.plot);
    console.print(&text)
}
