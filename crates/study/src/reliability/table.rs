//! The tables of a study of reliability.

use ground_motion::STANDARD_GRAVITY;
use report::table::{Cell, Column, Digits, Table};

use super::class::{Class, FRACTILES, fractiles};
use super::wall::{Event, WallReliability};
use crate::fragility::Interval;
use crate::hazard::HazardCurve;
use crate::tables::in_g;

const THREE: Digits = Digits::AtMost(3);
/// Digits of a probability.
const OF_PROBABILITY: Digits = Digits::Decimals(4);
/// Fractiles that tables for people have; files have all.
const SHOWN: [usize; 3] = [0, 2, 4];

/// The checks and events of a wall, with every model; accelerations in g as of records, 9.80665 m/s².
pub(super) fn wall(
    name: &str,
    models: &[&str],
    found: &WallReliability,
    hazard: Option<&HazardCurve>,
) -> Table {
    let rows = (0..models.len()).flat_map(|model| {
        let of_check = move |check| found.events.iter().map(move |event| (model, check, event));
        found.checks.iter().flat_map(of_check)
    });
    let interval = |of: Option<Interval>, part: usize| -> Cell<'static> {
        of.map(|of| [of.estimate, of.range[0], of.range[1]][part]).into()
    };
    let mut table = Table::over(rows)
        .text("wall", "wall", |_| name.to_owned())
        .text("model", "model", |(model, ..)| models[*model].to_owned())
        .text("check", "check", |(_, check, _)| check.check)
        .value("decides", |(_, check, _)| check.decides)
        .number("zeta", "ζ", THREE, |(_, check, _)| check.zeta)
        .number("ag_code_g", "a_g,code\n[g]", THREE, |(_, check, _)| in_g(check.code))
        .text("event", "event", |(.., event)| event.name.clone())
        .number("u_over_u_ins", "u/u_ins", THREE, |(.., event)| event.fraction)
        .column(Column::number("theta_g", "θ\n[g]", THREE), |(model, _, event): &(usize, _, &Event)| {
            Cell::Between(event.fragilities[*model].theta.bounds(STANDARD_GRAVITY)[0])
        })
        .number("beta", "β", THREE, |(model, _, event)| {
            event.fragilities[*model].fitted.ok().map(|curve| curve.dispersion)
        });
    for (part, end) in ["", "_low", "_high"].into_iter().enumerate() {
        let heading = ["θ/a_g,code", "from", "to"][part];
        table = table.number(format!("margin{end}"), heading, THREE, move |(model, check, event)| {
            interval(event.margin(*model, check.code), part)
        });
    }
    for (part, end) in ["", "_low", "_high"].into_iter().enumerate() {
        let heading = ["P", "from", "to"][part];
        let name = format!("probability{end}");
        table = table.number(name, heading, OF_PROBABILITY, move |(model, check, event)| {
            interval(event.probability(*model, check.code), part)
        });
    }
    if let Some(hazard) = hazard {
        // the wall has ζ = 1 at the site: its θ is as far above a_g of the site as here above a_g,code
        table = table.number("annual_rate", "rate\n[1/year]", THREE, |(model, check, event)| {
            let curve = event.fragilities[*model].fitted.ok()?;
            Some(hazard.rate(curve.median * check.site / check.code, curve.dispersion).within())
        });
    }
    table
        .number("records", "records", THREE, |(model, check, event)| event.records(*model, check.code))
        .number("dynamic_zeta", "ζ of the records", THREE, |(model, check, event)| {
            let known = event.check == Some(check.check) && event.dynamic[*model].is_finite();
            known.then(|| event.dynamic[*model] / check.site)
        })
        .done()
}

/// The numbers of the code that give the target, of a wall with every model.
pub(super) fn rules(name: &str, models: &[&str], found: &WallReliability, target: f64) -> Table {
    let rows = found.turned.iter().enumerate();
    Table::over(rows.flat_map(|(model, all)| all.iter().map(move |one| (model, one))))
        .text("wall", "wall", |_| name.to_owned())
        .text("model", "model", |(model, _)| models[*model].to_owned())
        .text("check", "check", |(_, one)| one.check)
        .text("number", "number", |(_, one)| one.rule.name())
        .number("code", "code", THREE, |(_, one)| one.code)
        .number("probability", "P of a fall", THREE, |_| target)
        .number("value", "value", THREE, |(_, one)| one.value)
        .done()
}

/// Fractiles over the walls of margins and probabilities, and how many walls are above the target.
pub(super) fn summary(class: &Class, models: &[&str], target: f64) -> Table {
    let mut table = Table::over(class.kinds())
        .text("model", "model", |(model, ..)| models[*model].to_owned())
        .text("check", "check with ζ = 1", |(_, check, _)| *check)
        .text("event", "event", |(.., event)| (*event).to_owned())
        .number("walls", "walls", THREE, |kind| class.sorted(*kind, |found| found.margin).len());
    for (place, part) in FRACTILES.into_iter().enumerate() {
        let percent = format!("{:.0}", 100.0 * part);
        let heading = heading(place, format!("θ/a_g,code\n{percent} %"));
        table = table.number(format!("margin_{percent}"), heading, THREE, move |kind| {
            fractiles(&class.sorted(*kind, |found| found.margin))[place]
        });
    }
    for (place, part) in FRACTILES.into_iter().enumerate() {
        let percent = format!("{:.0}", 100.0 * part);
        let heading = heading(place, format!("P\n{percent} %"));
        table = table.number(format!("probability_{percent}"), heading, OF_PROBABILITY, move |kind| {
            fractiles(&class.sorted(*kind, |found| found.probability))[place]
        });
    }
    table
        .number("above", format!("walls with\nP > {target}"), THREE, |kind| {
            class.sorted(*kind, |found| found.probability).iter().filter(|found| **found > target).count()
        })
        .done()
}

/// The heading of a fractile, empty for one that people are not shown.
fn heading(place: usize, heading: String) -> String {
    if SHOWN.contains(&place) { heading } else { String::new() }
}

/// Fractiles over the walls of the numbers of the code that give the target.
pub(super) fn rule_summary(class: &Class, models: &[&str], target: f64) -> Table {
    let all = class.members.iter().flat_map(|member| member.turned.iter().enumerate());
    let all: Vec<_> = all.flat_map(|(model, all)| all.iter().map(move |one| (model, *one))).collect();
    let mut kinds = Vec::new();
    for (model, one) in &all {
        let kind = (*model, one.check, one.rule, one.code);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds.sort_by_key(|kind| kind.0);
    let values = |kind: &(usize, &'static str, check::Rule, f64)| -> Vec<f64> {
        let is = |(model, one): &&(usize, super::Turned)| (*model, one.check, one.rule, one.code) == *kind;
        let mut values: Vec<f64> = all.iter().filter(is).filter_map(|(_, one)| one.value).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let mut table = Table::over(kinds)
        .text("", "model", |(model, ..)| models[*model].to_owned())
        .text("", "check", |(_, check, ..)| *check)
        .text("", format!("number for P(fall) = {target}"), |(_, _, rule, _)| rule.name())
        .number("", "code", THREE, |(.., code)| *code)
        .number("", "walls", THREE, |kind| values(kind).len());
    for (place, part) in FRACTILES.into_iter().enumerate() {
        let heading = format!("{:.0} %", 100.0 * part);
        table = table.number("", heading, THREE, |kind| fractiles(&values(kind))[place]);
    }
    table.done()
}
