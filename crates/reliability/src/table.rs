//! The tables of a study of reliability.

use std::fmt::Write as _;

use fragility::Interval;
use fragility::hazard::HazardCurve;
use ground_motion::STANDARD_GRAVITY;
use report::counted;
use report::table::{Cell, Digits, Table};
use run::sample::{fractile, sorted};

use crate::class::{Class, FRACTILES, grouped};
use crate::wall::WallReliability;

const THREE: Digits = Digits::Significant(3);
/// Digits of the numbers that the code or the user gives.
const GIVEN: Digits = Digits::AtMost(3);
/// Fractiles that tables for people have; files have all.
const SHOWN: [usize; 3] = [0, 2, 4];

/// The checks and events of a wall, with every model; accelerations in g as of records, 9.80665 m/s².
pub(crate) fn wall(
    name: &str,
    models: &[&str],
    found: &WallReliability,
    hazard: Option<&HazardCurve>,
) -> Table {
    let rows = found.answers.iter().map(|one| (one, &found.checks[one.check], &found.events[one.event]));
    let interval = |of: Option<Interval>, part: usize| -> Cell<'static> { determined(of, part).into() };
    let mut table = Table::over(rows)
        .text("wall", "wall", |_| name.to_owned())
        .text("model", "model", |(one, ..)| models[one.model].to_owned())
        .text("check", "check", |(_, check, _)| check.check)
        .value("decides", |(_, check, _)| check.decides)
        .number("zeta", "ζ", THREE, |(_, check, _)| check.zeta)
        .number("ag_code_g", "a_g,code\n[g]", THREE, |(_, check, _)| check.code / STANDARD_GRAVITY)
        .text("event", "event", |(.., event)| event.name.clone())
        .number("u_over_u_ins", "u/u_ins", THREE, |(.., event)| event.fraction)
        .number("theta_g", "θ\n[g]", THREE, |(one, _, event)| {
            Cell::Between(event.fragilities[one.model].theta.bounds(STANDARD_GRAVITY)[0])
        })
        .number("beta", "β", THREE, |(one, _, event)| {
            event.fragilities[one.model].fitted.ok().map(|curve| curve.dispersion)
        });
    for (part, end) in ["", "_low", "_high"].into_iter().enumerate() {
        let heading = ["θ/a_g,code", "from", "to"][part];
        table =
            table.number(format!("margin{end}"), heading, THREE, move |(one, ..)| interval(one.margin, part));
    }
    for (part, end) in ["", "_low", "_high"].into_iter().enumerate() {
        let heading = ["P", "from", "to"][part];
        table = table
            .value(format!("probability{end}"), move |(one, ..)| interval(one.probability, part))
            .number("", heading, THREE, |(one, ..)| {
                determined(one.probability, part).map(|value| probability(value, found.least))
            });
    }
    if let Some(hazard) = hazard {
        // the wall has ζ = 1 at the site: its θ is as far above a_g of the site as here above a_g,code
        table = table.number("annual_rate", "rate\n[1/year]", THREE, |(one, check, event)| {
            let curve = event.fragilities[one.model].fitted.ok()?;
            Some(hazard.rate(curve.median * check.site / check.code, curve.dispersion).within())
        });
    }
    table
        .number("records", "records", THREE, |(one, check, event)| event.records(one.model, check.code))
        .number("dynamic_zeta", "ζ of the\nrecords", THREE, |(one, check, event)| {
            let dynamic = event.dynamic[one.model];
            (event.check == Some(check.check) && dynamic.is_finite()).then(|| dynamic / check.site)
        })
        .done()
}

/// The estimate of an interval, its lower or its upper end; `None` of what is not determined.
fn determined(of: Option<Interval>, part: usize) -> Option<f64> {
    of.map(|of| [of.estimate, of.range[0], of.range[1]][part]).filter(|value| !value.is_nan())
}

/// The numbers of the code that give the target, of a wall with every model.
pub(crate) fn rules(name: &str, models: &[&str], found: &WallReliability, target: f64) -> Table {
    let rows = found.turned.iter().enumerate();
    Table::over(rows.flat_map(|(model, all)| all.iter().map(move |one| (model, one))))
        .text("wall", "wall", |_| name.to_owned())
        .text("model", "model", |(model, _)| models[*model].to_owned())
        .text("check", "check", |(_, one)| one.check)
        .text("number", "number", |(_, one)| one.rule.name())
        .number("code", "code", GIVEN, |(_, one)| one.code)
        .number("probability", "P of a fall", GIVEN, |_| target)
        .number("value", "value", THREE, |(_, one)| one.value)
        .done()
}

/// Fractiles over the walls of margins and probabilities, and how many walls are above the target.
pub(crate) fn summary(class: &Class, models: &[&str], target: f64) -> Table {
    let found = class.members.iter().flat_map(|member| &member.found);
    let found = found.map(|one| ((one.model, one.check, &*one.event), [one.margin, one.probability]));
    let rows = grouped(found, |kind| kind.0).into_iter().map(|(kind, found)| {
        (kind, [0, 1].map(|which| sorted(found.iter().map(|values: &[f64; 2]| values[which]))))
    });
    let mut table = Table::over(rows)
        .text("model", "model", |((model, ..), _)| models[*model].to_owned())
        .text("check", "check with ζ = 1", |((_, check, _), _)| *check)
        .text("event", "event", |((.., event), _)| (*event).to_owned())
        .number("walls", "walls", THREE, |(_, [margins, _])| margins.len());
    for (which, (name, symbol)) in [("margin", "θ/a_g,code"), ("probability", "P")].into_iter().enumerate() {
        for (place, part) in FRACTILES.into_iter().enumerate() {
            let percent = format!("{:.0}", 100.0 * part);
            let heading = heading(place, format!("{symbol}\n{percent} %"));
            let of = move |sorted: &[Vec<f64>; 2]| fractile(&sorted[which], part);
            table = table.value(format!("{name}_{percent}"), move |(_, sorted)| of(sorted)).number(
                "",
                heading,
                THREE,
                move |(_, sorted)| -> Cell<'static> {
                    let told = |value| Cell::from(probability(value, class.least));
                    if which == 0 { of(sorted).into() } else { of(sorted).map_or(Cell::Empty, told) }
                },
            );
        }
    }
    table
        .number("above", format!("walls with\nP > {target}"), THREE, |(_, [_, probabilities])| {
            probabilities.iter().filter(|found| **found > target).count()
        })
        .done()
}

/// Writes a probability, as a bound where the records cannot say more.
pub(crate) fn probability(value: f64, least: f64) -> String {
    if value < least { format!("< {least:.0e}") } else { format!("{value:.4}") }
}

/// The heading of a fractile, empty for one that people are not shown.
fn heading(place: usize, heading: String) -> String {
    if SHOWN.contains(&place) { heading } else { String::new() }
}

/// Fractiles over the walls of the numbers of the code that give the target.
pub(crate) fn rule_summary(class: &Class, models: &[&str], target: f64) -> Table {
    let all = class.members.iter().flat_map(|member| member.turned.iter().enumerate());
    let all = all.flat_map(|(model, all)| all.iter().map(move |one| (model, one)));
    let all = all.map(|(model, one)| ((model, one.check, one.rule, one.code), one.value));
    let rows = grouped(all, |kind| kind.0);
    let rows = rows.into_iter().map(|(kind, values)| (kind, sorted(values.into_iter().flatten())));
    let mut table = Table::over(rows)
        .text("", "model", |((model, ..), _)| models[*model].to_owned())
        .text("", "check", |((_, check, ..), _)| *check)
        .text("", format!("number for P(fall) = {target}"), |((_, _, rule, _), _)| rule.name())
        .number("", "code", GIVEN, |((.., code), _)| *code)
        .number("", "walls", THREE, |(_, values)| values.len());
    for part in FRACTILES {
        let heading = format!("{:.0} %", 100.0 * part);
        table = table.number("", heading, THREE, move |(_, values)| fractile(values, part));
    }
    table.done()
}

/// Says how safe the walls are, model by model.
pub(crate) fn words(class: &Class, models: &[&str], target: f64) -> String {
    let mut text = String::new();
    for (model, name) in models.iter().enumerate() {
        let falls = sorted(class.falls(model).map(|(_, found)| found.probability));
        let fractile = |part: f64| fractile(&falls, part);
        let (Some(least), Some(median), Some(most)) = (fractile(0.05), fractile(0.5), fractile(0.95)) else {
            continue;
        };
        let above = falls.iter().filter(|probability| **probability > target).count();
        // writing to a String cannot fail
        let _ = writeln!(
            text,
            "{name}: {} that just pass{} fall with a probability of {} in the median ({} to {} from 5 to \
             95 %); P > {target} for {above}",
            counted(falls.len(), "wall"),
            if falls.len() == 1 { "es" } else { "" },
            probability(median, class.least),
            probability(least, class.least),
            probability(most, class.least),
        );
    }
    text
}
