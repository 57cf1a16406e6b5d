//! The sides of a check by fractions as the verdict that every code has.

use report::number;
use report::table::{Cell, Column, Digits, Table, significant};
use serde_json::{Value, json};

use super::inputs::{ByFractions, Checked};
use super::{CODE, SideCheck, governing};
use crate::circolare::Side;
use crate::code::{Subject, Verdict};

/// A name, its ratio, and what it says. They mean different things, and neither stands for the other; the
/// displacement decides.
type Ratio = (&'static str, fn(&SideCheck) -> f64, [&'static str; 2]);

const RATIOS: [Ratio; 2] = [
    ("onset", |side| side.acceleration_ratio, ["the wall does not rock", "the wall rocks"]),
    ("displacement", |side| side.displacement_ratio, ["within the capacity", "beyond the capacity"]),
];

/// A name, a unit, and the number of a side.
type Number = (&'static str, &'static str, fn(&SideCheck) -> f64);

const NUMBERS: [Number; 10] = [
    ("onset a0*", "m/s2", |side| side.onset_acceleration),
    ("zero of F d0*", "m", |side| side.zero_displacement),
    ("capacity d_u*", "m", |side| side.displacement_capacity),
    ("secant d_s*", "m", |side| side.secant[0]),
    ("secant a_s*", "m/s2", |side| side.secant[1]),
    ("secant period T_s", "s", |side| side.secant_period),
    ("demand Sa(0)", "m/s2", |side| side.peak_acceleration),
    ("demand Sd(T_s)", "m", |side| side.displacement_demand),
    ("a0*/Sa(0)", "-", |side| side.acceleration_ratio),
    ("d_u*/Sd(T_s)", "-", |side| side.displacement_ratio),
];

fn name(side: &SideCheck) -> &'static str {
    Side::of(side.sign).name()
}

/// Makes the verdict.
pub(super) fn verdict(code: &ByFractions, subject: &Subject<'_>, checked: &Checked) -> Verdict {
    let Checked { wall, sides, .. } = checked;
    let alike = wall.has_equal_sides();
    let [worst_onset, worst] = RATIOS.map(|(_, ratio, _)| governing(sides, ratio));
    let (passed, zeta) = (worst.displacement_ratio >= 1.0, worst.displacement_ratio);
    let side = if alike { "both sides alike" } else { name(worst) };
    let word = if passed { "PASSED" } else { "NOT PASSED" };
    let warnings = code.warnings_on(subject, wall);
    Verdict {
        code: CODE,
        passed,
        governs: "displacement",
        side: if alike { "both sides" } else { name(worst) },
        zeta,
        headline: format!("{word}: displacement governs with zeta_E = {zeta:.3} ({side})"),
        detail: format!(
            "{} times this spectrum brings the wall to its displacement capacity; it rocks from {} times on.",
            number(zeta, 3),
            number(worst_onset.acceleration_ratio, 3)
        ),
        ratios: vec![
            ("onset_ratio", Some(worst_onset.acceleration_ratio)),
            ("displacement_ratio", Some(worst.displacement_ratio)),
        ],
        rows: rows(sides),
        numbers: numbers(sides, alike),
        notes: notes(code, subject, checked, alike),
        values: values(code, subject, sides, (passed, &warnings)),
        warnings,
    }
}

fn rows(sides: &[SideCheck]) -> Table {
    let four = Digits::Significant(4);
    let mut table = Table::new([
        Column::text("side", "side"),
        Column::text("check", "check"),
        Column::number("zeta_E", "zeta_E", four),
        Column::number("capacity", "capacity", four),
        Column::number("demand", "demand", four),
    ]);
    for side in sides {
        let mut row = |check: &'static str, zeta: f64, capacity: f64, demand: f64| {
            table.row([name(side).into(), check.into(), zeta.into(), capacity.into(), demand.into()]);
        };
        row("onset", side.acceleration_ratio, side.onset_acceleration, side.peak_acceleration);
        row("displacement", side.displacement_ratio, side.displacement_capacity, side.displacement_demand);
    }
    table
}

fn numbers(sides: &[SideCheck], alike: bool) -> Table {
    let shown = if alike { &sides[..1] } else { sides };
    let heading = |side: &SideCheck| if alike { "both sides" } else { name(side) };
    let columns =
        shown.iter().map(|side| Column::number(heading(side), heading(side), Digits::Significant(6)));
    let heads = [Column::text("quantity", " "), Column::text("unit", " ")];
    let mut table = Table::new(heads.into_iter().chain(columns));
    for (name, unit, value) in NUMBERS {
        let values = shown.iter().map(|side| Cell::from(value(side)));
        table.row([name.into(), unit.into()].into_iter().chain(values));
    }
    table
}

fn notes(code: &ByFractions, subject: &Subject<'_>, checked: &Checked, alike: bool) -> Vec<String> {
    let (sides, fractions) = (&checked.sides, code.fractions);
    let mut notes = vec![
        format!("demand: {}, {} % damping", code.demand_name(subject), 100.0 * code.damping),
        format!(
            "fractions: d_u* at {} of the zero of F, secant at {} of d_u*",
            fractions.displacement, fractions.secant
        ),
    ];
    for (what, ratio, [holds, fails]) in RATIOS {
        let worst = governing(sides, ratio);
        let side = if alike { "both sides alike" } else { name(worst) };
        let said = if ratio(worst) >= 1.0 { holds } else { fails };
        notes.push(format!("{what}: {said}, ratio {} ({side})", significant(ratio(worst), 6)));
    }
    let limited = sides.iter().filter(|side| side.limited_by_tie);
    notes.extend(limited.map(|side| format!("{}: the strength of the tie limits d_u*", name(side))));
    notes
}

fn values(
    code: &ByFractions,
    subject: &Subject<'_>,
    sides: &[SideCheck],
    (passed, warnings): (bool, &[String]),
) -> Value {
    let side = |side: &SideCheck| {
        json!({
            "side": name(side),
            "onset_acceleration": side.onset_acceleration,
            "zero_displacement": side.zero_displacement,
            "displacement_capacity": side.displacement_capacity,
            "limited_by_tie": side.limited_by_tie,
            "secant_displacement": side.secant[0],
            "secant_acceleration": side.secant[1],
            "secant_period": side.secant_period,
            "peak_acceleration": side.peak_acceleration,
            "displacement_demand": side.displacement_demand,
            "acceleration_ratio": side.acceleration_ratio,
            "displacement_ratio": side.displacement_ratio,
        })
    };
    let governs = RATIOS.map(|(what, ratio, _)| {
        let worst = governing(sides, ratio);
        (what.to_owned(), json!({ "side": name(worst), "ratio": ratio(worst) }))
    });
    json!({
        "code": CODE,
        "passed": passed,
        "title": subject.title,
        "demand": code.demand_name(subject),
        "damping": code.damping,
        "displacement_fraction": code.fractions.displacement,
        "secant_fraction": code.fractions.secant,
        "sides": sides.iter().map(side).collect::<Vec<_>>(),
        "governs": governs.into_iter().collect::<serde_json::Map<_, _>>(),
        "warnings": warnings,
    })
}
