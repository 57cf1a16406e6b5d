//! `wall check` of many walls.

use std::fmt::Write;
use std::path::Path;

use anyhow::{Result, bail};
use check::circolare::{Verdict, WallVerdict, Walls};
use report::table::quoted;
use report::{escaped, template};
use run::parallel;
use serde_json::{Value, json};

use super::Arguments;
use crate::output::{self, Console};

pub(super) fn run(console: &Console<'_>, arguments: &Arguments, path: &Path, text: &str) -> Result<()> {
    arguments.spectrum.refuse(&path.display().to_string())?;
    if arguments.find.is_some() || arguments.report.is_some() || !arguments.scene.set.is_empty() {
        bail!("{}: --find, --report and --set take one wall; give a scene", path.display());
    }
    let walls = Walls::parse(path, text)?;
    console.check_distinct(&walls.inputs, arguments.html.iter().chain(&arguments.csv))?;
    let verdicts = walls.check(parallel::threads(None).get());
    console.save(arguments.csv.as_ref(), || csv(&verdicts))?;
    console.save(arguments.html.as_ref(), || page(path, &verdicts))?;
    if !arguments.json {
        console.report_all(warnings(&verdicts));
    }
    walls.warnings.iter().for_each(|warning| console.warn(warning));
    let text = if arguments.json {
        serde_json::to_string_pretty(&verdicts.iter().map(row).collect::<Vec<_>>())? + "\n"
    } else {
        table(&verdicts) + &output::written("written  ", arguments.csv.iter().chain(&arguments.html))
    };
    console.print(&text)?;
    let refused = verdicts.iter().filter(|wall| wall.verdict.is_err()).count();
    if refused > 0 {
        bail!("{refused} of {} walls could not be checked; the first rows say why", verdicts.len());
    }
    Ok(())
}

/// The warnings of each wall in a line with its name, in the order of the table.
fn warnings(verdicts: &[WallVerdict]) -> impl Iterator<Item = String> {
    verdicts.iter().filter_map(|wall| {
        let own = &wall.verdict.as_ref().ok()?.warnings;
        (!own.is_empty()).then(|| format!("warning: wall {:?}: {}", wall.name, own.join("; ")))
    })
}

/// The smallest `ζ_E` of each limit state: SLD, SLV with q, SLV, SLC.
fn zetas(verdict: &Verdict) -> [Option<f64>; 4] {
    let least = |pick: &dyn Fn(&check::circolare::SideVerdict) -> Option<f64>| {
        verdict.sides.iter().filter_map(|(_, side)| pick(side)).min_by(f64::total_cmp)
    };
    [
        least(&|side| side.sld.map(|check| check.ratio)),
        least(&|side| side.slv_q.map(|check| check.ratio)),
        least(&|side| side.slv.map(|check| check.zeta)),
        least(&|side| side.slc.map(|check| check.zeta)),
    ]
}

const COLUMNS: [&str; 9] =
    ["name", "passed", "zeta_E", "governs", "side", "zeta_E_SLD", "zeta_E_SLV_q", "zeta_E_SLV", "zeta_E_SLC"];

/// The cells of a wall; of one without a verdict its name and the reason.
fn cells(wall: &WallVerdict) -> Result<[String; 9], [String; 2]> {
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.4}"));
    match &wall.verdict {
        Ok(verdict) => {
            let governs = verdict.governs;
            let [sld, slv_q, slv, slc] = zetas(verdict).map(number);
            let passed = if verdict.passed { "yes" } else { "no" };
            let side = if verdict.alike { "both" } else { governs.side.name() };
            let state = governs.limit_state.name();
            let zeta = number(Some(governs.zeta));
            Ok([wall.name.clone(), passed.into(), zeta, state.into(), side.into(), sld, slv_q, slv, slc])
        }
        Err(error) => Err([wall.name.clone(), error.to_string()]),
    }
}

fn table(verdicts: &[WallVerdict]) -> String {
    let width = verdicts.iter().map(|wall| wall.name.chars().count()).max().unwrap_or(0).max(4);
    let (mut refused, mut text) = (String::new(), String::new());
    let mut line = |cells: [&str; 9]| {
        let _ = write!(text, "{:<width$}", cells[0]);
        for (cell, width) in cells[1..].iter().zip([8, 9, 12, 7, 9, 9, 9, 9]) {
            let _ = write!(text, "{cell:>width$}");
        }
        text.push('\n');
    };
    line(["wall", "passed", "zeta_E", "governs", "side", "SLD", "SLV, q", "SLV", "SLC"]);
    for wall in verdicts {
        match cells(wall) {
            Ok(cells) => line(cells.each_ref().map(String::as_str)),
            Err([name, reason]) => {
                let _ = writeln!(refused, "{name:<width$}  not checked: {reason}");
            }
        }
    }
    refused + &text
}

fn csv(verdicts: &[WallVerdict]) -> String {
    let mut text = COLUMNS.join(",") + ",not_checked,warnings\n";
    for wall in verdicts {
        let row = match cells(wall) {
            Ok(cells) => {
                let warnings =
                    wall.verdict.as_ref().map_or_else(|_| String::new(), |v| v.warnings.join("; "));
                cells.map(|cell| quoted(&cell).into_owned()).join(",") + ",," + &quoted(&warnings)
            }
            Err([name, reason]) => format!("{}{}{},", quoted(&name), ",".repeat(9), quoted(&reason)),
        };
        text.push_str(&row);
        text.push('\n');
    }
    text
}

fn row(wall: &WallVerdict) -> Value {
    match &wall.verdict {
        Ok(verdict) => json!({ "name": wall.name, "verdict": verdict }),
        Err(error) => json!({ "name": wall.name, "not_checked": error.to_string() }),
    }
}

fn page(path: &Path, verdicts: &[WallVerdict]) -> String {
    let passed =
        verdicts.iter().filter(|wall| wall.verdict.as_ref().is_ok_and(|verdict| verdict.passed)).count();
    let mut rows = String::new();
    for wall in verdicts {
        let class = match &wall.verdict {
            Ok(verdict) if verdict.passed => "holds",
            _ => "fails",
        };
        let cells = match cells(wall) {
            Ok(cells) => format!("<td>{}</td>", cells.map(|cell| escaped(&cell)).join("</td><td>")),
            Err([name, reason]) => {
                format!("<td>{}</td><td colspan=\"8\">not checked: {}</td>", escaped(&name), escaped(&reason))
            }
        };
        let _ = writeln!(rows, "<tr class=\"{class}\">{cells}</tr>");
    }
    let title =
        format!("{}: {passed} of {} walls pass", escaped(&path.display().to_string()), verdicts.len());
    let parts = [("title", &*title), ("rows", &rows)];
    template::page(include_str!("../../../../check/src/circolare/walls.html"), &parts)
}
