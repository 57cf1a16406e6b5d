//! The outcome of the check as the verdict that every code has: its rows, its numbers, its notes.

use ::report::number;
use ::report::table::{Cell, Column, Digits, Table, significant};

use super::statement::Statement;
use super::table::{Method, UseClass};
use super::verdict::{DisplacementCheck, DynamicState, Outcome, SideVerdict};
use super::{CODE, Deciding, LimitState};
use crate::code::Verdict;

/// Makes the verdict.
pub(super) fn verdict(outcome: &Outcome, statement: &Statement) -> Verdict {
    let governs = outcome.governs;
    Verdict {
        code: CODE,
        passed: outcome.passed,
        governs: governs.limit_state.name(),
        side: if outcome.alike { "both sides" } else { governs.side.name() },
        zeta: governs.zeta,
        headline: outcome.headline(),
        detail: detail(outcome, statement),
        ratios: ratios(outcome),
        rows: rows(outcome),
        numbers: numbers(outcome),
        notes: notes(outcome, statement),
        warnings: outcome.warnings.clone(),
        values: serde_json::to_value(outcome).unwrap_or_default(),
    }
}

/// The ground acceleration that just passes, beside that of the site.
fn detail(outcome: &Outcome, statement: &Statement) -> String {
    let governs = outcome.governs;
    let state = match governs.limit_state {
        Deciding::Sld => LimitState::Sld,
        Deciding::SlvWithQ | Deciding::Slv => LimitState::Slv,
        Deciding::Slc => LimitState::Slc,
    };
    let site = statement.state(state).map_or(f64::NAN, |given| given.ag);
    let [held, site] = [governs.zeta * site, site].map(|ag| number(ag, 3));
    format!("It holds up to a_g = {held} g; the site has {site} g.")
}

/// The least `ζ_E` of SLD, SLV with q, SLV and SLC over the sides.
fn ratios(outcome: &Outcome) -> Vec<(&'static str, Option<f64>)> {
    let least = |pick: fn(&SideVerdict) -> Option<f64>| {
        outcome.sides.iter().filter_map(|(_, side)| pick(side)).min_by(f64::total_cmp)
    };
    vec![
        ("zeta_E_SLD", least(|side| side.sld.map(|check| check.ratio))),
        ("zeta_E_SLV_q", least(|side| side.slv_q.map(|check| check.ratio))),
        ("zeta_E_SLV", least(|side| side.slv.map(|check| check.zeta))),
        ("zeta_E_SLC", least(|side| side.slc.map(|check| check.zeta))),
    ]
}

/// A row for each check: capacity and demand are accelerations \[m/s²\] or displacements \[m\].
fn rows(outcome: &Outcome) -> Table {
    let four = Digits::Significant(4);
    let mut table = Table::new([
        Column::text("side", "side"),
        Column::text("check", "check"),
        Column::number("zeta_E", "zeta_E", four),
        Column::number("ag_g", "a_g [g]", four),
        Column::number("capacity", "capacity", four),
        Column::number("demand", "demand", four),
    ]);
    let mut row = |side: &'static str, check: &'static str, zeta: f64, ag: Cell<'static>, ends: [f64; 2]| {
        table.row([side.into(), check.into(), zeta.into(), ag, ends[0].into(), ends[1].into()]);
    };
    for (side, verdict) in outcome.sides.iter() {
        for (name, check) in [("SLD", verdict.sld), ("SLV_q", verdict.slv_q)] {
            let Some(check) = check else { continue };
            row(side.name(), name, check.ratio, check.ag.into(), [check.capacity, check.demand]);
        }
        for (name, check) in [("SLV", verdict.slv), ("SLC", verdict.slc)] {
            let Some(check) = check else { continue };
            row(side.name(), name, check.zeta, check.ag.into(), [check.d, check.demand]);
        }
    }
    let dynamic = outcome.dynamic.iter();
    for (name, check) in dynamic.flat_map(|runs| [("SLV dynamic", &runs.slv), ("SLC dynamic", &runs.slc)]) {
        let Some(check) = check else { continue };
        row(check.side.name(), name, check.zeta, Cell::Empty, [check.ratio * check.d, check.d]);
    }
    table
}

/// A name, its unit, and the number of a side, if it has one.
type Number = (&'static str, &'static str, fn(&SideVerdict) -> Option<f64>);

const NUMBERS: [Number; 15] = [
    ("alpha0", "-", |side| Some(side.alpha0)),
    ("e*", "-", |side| Some(side.e_star)),
    ("M*", "kg", |side| Some(side.mass)),
    ("a0", "m/s2", |side| Some(side.a0)),
    ("d0", "m", |side| Some(side.d0)),
    ("T0", "s", |side| Some(side.t0)),
    ("d_y", "m", |side| Some(side.dy)),
    ("a_y", "m/s2", |side| Some(side.ay)),
    ("SLD capacity", "m/s2", |side| side.sld.map(|check| check.capacity)),
    ("SLD demand", "m/s2", |side| side.sld.map(|check| check.demand)),
    ("SLD zeta_E", "-", |side| side.sld.map(|check| check.ratio)),
    ("SLD a_g", "g", |side| side.sld.map(|check| check.ag)),
    ("SLV with q, demand", "m/s2", |side| side.slv_q.map(|check| check.demand)),
    ("SLV with q, zeta_E", "-", |side| side.slv_q.map(|check| check.ratio)),
    ("SLV with q, a_g", "g", |side| side.slv_q.map(|check| check.ag)),
];

/// A name, its unit, and the number of a check by displacement.
type OfDisplacement = (&'static str, &'static str, fn(&DisplacementCheck) -> f64);

const DISPLACEMENT: [OfDisplacement; 6] = [
    ("d", "m", |check| check.d),
    ("a", "m/s2", |check| check.a),
    ("T", "s", |check| check.period),
    ("demand S_d", "m", |check| check.demand),
    ("zeta_E", "-", |check| check.zeta),
    ("a_g", "g", |check| check.ag),
];

/// A limit state and its check by displacement.
type State = (&'static str, fn(&SideVerdict) -> Option<DisplacementCheck>);

const STATES: [State; 2] = [("SLV", |side| side.slv), ("SLC", |side| side.slc)];

fn numbers(outcome: &Outcome) -> Table {
    let sides = outcome.shown().map(|(name, _)| Column::number(name, name, Digits::Significant(6)));
    let mut table =
        Table::new([Column::text("quantity", ""), Column::text("unit", "")].into_iter().chain(sides));
    for column in &mut table.columns[..2] {
        // no heading, and yet shown
        column.heading = " ".into();
    }
    let mut row = |name: String, unit: &'static str, value: &dyn Fn(&SideVerdict) -> Option<f64>| {
        let values: Vec<Cell<'static>> = outcome.shown().map(|(_, side)| value(side).into()).collect();
        if values.iter().any(|value| *value != Cell::Empty) {
            table.row([name.into(), unit.into()].into_iter().chain(values));
        }
    };
    for (name, unit, value) in NUMBERS {
        row(name.to_owned(), unit, &value);
    }
    for (state, pick) in STATES {
        for (name, unit, value) in DISPLACEMENT {
            row(format!("{state} {name}"), unit, &|side| pick(side).map(|check| value(&check)));
        }
    }
    table
}

/// What decides, what limits and raises, and the runs.
fn notes(outcome: &Outcome, statement: &Statement) -> Vec<String> {
    let method = match statement.method {
        Method::Nonlinear => "SLV and SLC by displacement",
        Method::Linear => "The checks of SLV with q",
        Method::Dynamic => "The runs under records",
    };
    let class = if statement.use_class == Some(UseClass::IV) { ", and SLD of use class IV," } else { "" };
    let mut notes = vec![
        format!(
            "Circolare 7/2019, C8.7.1.2.1; FC = {}; one resultant per body (C8.7.1.1), e* = 1",
            statement.confidence_factor
        ),
        format!("{method}{class} decide; the other checks are for information"),
    ];
    for (side, verdict) in outcome.shown() {
        for (state, check) in STATES.into_iter().filter_map(|(state, pick)| Some((state, pick(verdict)?))) {
            if check.limited_by_tie {
                notes.push(format!("{side}: the tie breaks at d_{state}"));
            }
            if check.raised {
                notes.push(format!("{side}: a_g of SLD is larger than that of {state} and replaces it"));
            }
        }
    }
    let dynamic = outcome.dynamic.iter().flat_map(|runs| [("SLV", &runs.slv), ("SLC", &runs.slc)]);
    for (state, check) in dynamic.filter_map(|(state, check)| Some((state, check.as_ref()?))) {
        notes.extend(runs(state, check));
    }
    notes
}

/// The dynamic check of a limit state.
fn runs(state: &str, check: &DynamicState) -> Vec<String> {
    let mut lines = vec![format!(
        "{state} under {} records: {}; d = {} m, threshold over it {:.3}, zeta_E = {:.3}",
        check.runs.len(),
        if check.passed { "passed" } else { "not passed" },
        significant(check.d, 6),
        check.ratio,
        check.zeta
    )];
    lines.extend(check.runs.iter().map(|run| {
        let [positive, negative] = [run.d[0], -run.d[1]].map(|d| significant(d, 6));
        let beyond = if run.beyond_d0 { "  beyond d0" } else { "" };
        format!("  {:<30} x {:<8.4} d = {positive} / {negative} m{beyond}", run.record, run.factor)
    }));
    lines
}
