//! `wall check` of a scene with a table `[check]`: the Italian code.

use std::fmt::Write;
use std::path::Path;

use anyhow::Result;
use check::circolare::{
    CheckTable, DisplacementCheck, DynamicState, Method, Records, Side, SideVerdict, Statement, UseClass,
    Verdict, check, in_table,
};
use rocking_wall::scene::{Place, Scene};

use super::Arguments;
use crate::output::significant;
use crate::output::{self, Console};
use check::circolare::report::{Report, page};

/// A scene and what its table `[check]` states.
pub(super) struct Case {
    pub(super) scene: Scene,
    pub(super) statement: Statement,
    pub(super) records: Records,
    name: String,
    text: String,
}

impl Case {
    /// Reads the scene, the statements and the records.
    pub(super) fn read(
        console: &Console<'_>,
        arguments: &Arguments,
        table: &CheckTable,
        place: &Place<'_>,
    ) -> Result<Self> {
        let folder = arguments.scene.scene.as_deref().and_then(Path::parent).unwrap_or(Path::new("."));
        let mut scene = Scene::parse(place.name(), place.text(), folder)?;
        arguments.scene.apply(&mut scene)?;
        let statement = table.statement().map_err(|error| in_table(error, place))?;
        let records = Records::read(table, place, folder)?;
        records.warnings.iter().for_each(|warning| console.warn(warning));
        let inputs = arguments.scene.inputs(&scene).chain(&records.files);
        console
            .check_distinct(inputs, arguments.html.iter().chain(&arguments.plot).chain(&arguments.report))?;
        Ok(Self { scene, statement, records, name: place.name().into(), text: place.text().into() })
    }

    /// Adds to an error the line of the table that it is about.
    pub(super) fn located<T>(&self, outcome: Result<T, check::circolare::CheckError>) -> Result<T> {
        outcome.map_err(|error| in_table(error, &Place::new(&self.name, &self.text)).into())
    }
}

pub(super) fn run(console: &Console<'_>, arguments: &Arguments, case: &Case) -> Result<()> {
    let Case { scene, statement, records, .. } = case;
    let verdict = case.located(check(&scene.parameters, scene.floors.as_ref(), statement, records))?;
    if let Some(path) = &arguments.report {
        let report = Report {
            scene,
            file: (&case.name, &case.text),
            set: &arguments.scene.set,
            statement,
            records,
            verdict: &verdict,
            headline: &headline(&verdict),
            date: arguments.date.as_deref(),
        };
        console.write(path, page(&report)?.as_bytes())?;
    }
    if arguments.json {
        return console.print(&(serde_json::to_string_pretty(&verdict)? + "\n"));
    }
    verdict.warnings.iter().for_each(|warning| console.warn(warning));
    let text = text(&scene.title, statement, &verdict);
    console.print(&(text + &output::written("\nwritten ", &arguments.report)))
}

/// The verdict in one line.
pub(super) fn headline(verdict: &Verdict) -> String {
    let governs = verdict.governs;
    let side = if verdict.alike { "both sides alike" } else { governs.side.name() };
    let passed = if verdict.passed { "PASSED" } else { "NOT PASSED" };
    format!("{passed}: {} governs with zeta_E = {:.3} ({side})", governs.limit_state.name(), governs.zeta)
}

/// Names the checks that decide.
fn deciding(statement: &Statement) -> String {
    let method = match statement.method {
        Method::Nonlinear => "SLV and SLC by displacement",
        Method::Linear => "The checks of SLV with q",
        Method::Dynamic => "The runs under records",
    };
    let class = if statement.use_class == Some(UseClass::IV) { ", and SLD of use class IV," } else { "" };
    format!("{method}{class}")
}

/// A name, its unit, and the number of a side, if it has one.
type Line = (&'static str, &'static str, fn(&SideVerdict) -> Option<f64>);

const SIDE: [Line; 8] = [
    ("alpha0", "-", |side| Some(side.alpha0)),
    ("e*", "-", |side| Some(side.e_star)),
    ("M*", "kg", |side| Some(side.mass)),
    ("a0", "m/s2", |side| Some(side.a0)),
    ("d0", "m", |side| Some(side.d0)),
    ("T0", "s", |side| Some(side.t0)),
    ("d_y", "m", |side| Some(side.dy)),
    ("a_y", "m/s2", |side| Some(side.ay)),
];

const ACTIVATION: [Line; 7] = [
    ("SLD capacity", "m/s2", |side| side.sld.map(|check| check.capacity)),
    ("SLD demand", "m/s2", |side| side.sld.map(|check| check.demand)),
    ("SLD zeta_E", "-", |side| side.sld.map(|check| check.ratio)),
    ("SLD a_g", "g", |side| side.sld.map(|check| check.ag)),
    ("SLV with q, demand", "m/s2", |side| side.slv_q.map(|check| check.demand)),
    ("SLV with q, zeta_E", "-", |side| side.slv_q.map(|check| check.ratio)),
    ("SLV with q, a_g", "g", |side| side.slv_q.map(|check| check.ag)),
];

/// A name, its unit, and the number of a check by displacement.
type DisplacementLine = (&'static str, &'static str, fn(&DisplacementCheck) -> f64);

const DISPLACEMENT: [DisplacementLine; 6] = [
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

fn text(title: &str, statement: &Statement, verdict: &Verdict) -> String {
    let shown: Vec<(Side, &SideVerdict)> =
        verdict.sides.iter().take(if verdict.alike { 1 } else { 2 }).collect();
    let mut text = format!("{title}\n{}\n\n", headline(verdict));
    let _ = writeln!(
        text,
        "Circolare 7/2019, C8.7.1.2.1; FC = {}; one resultant per body (C8.7.1.1), e* = 1",
        statement.confidence_factor
    );
    let name = |side: Side| if verdict.alike { "both sides" } else { side.name() };
    let heads = shown.iter().fold(String::new(), |heads, (side, _)| heads + &format!("{:>13} ", name(*side)));
    let _ = writeln!(text, "{:<22}{:>6}{heads}", "", "");
    let mut row = |name: &str, unit: &str, value: &dyn Fn(&SideVerdict) -> Option<f64>| {
        let values: Vec<Option<f64>> = shown.iter().map(|(_, side)| value(side)).collect();
        if values.iter().all(Option::is_none) {
            return;
        }
        let cells = values.into_iter().map(|value| value.map_or_else(|| format!("{:>13}", "-"), significant));
        let _ = writeln!(text, "{name:<22}{unit:>6}{}", cells.collect::<Vec<_>>().join(" "));
    };
    for (name, unit, value) in SIDE.into_iter().chain(ACTIVATION) {
        row(name, unit, &value);
    }
    for (state, pick) in STATES {
        for (name, unit, value) in DISPLACEMENT {
            row(&format!("{state} {name}"), unit, &|side| pick(side).map(|check| value(&check)));
        }
    }
    let _ = writeln!(text, "\n{} decide; the other checks are for information", deciding(statement));
    for (side, verdict) in &shown {
        for (state, check) in STATES.map(|(state, pick)| (state, pick(verdict))) {
            if check.is_some_and(|check| check.limited_by_tie) {
                let _ = writeln!(text, "{}: the tie breaks at d_{state}", name(*side));
            }
            if check.is_some_and(|check| check.raised) {
                let _ = writeln!(
                    text,
                    "{}: a_g of SLD is larger than that of {state} and replaces it",
                    name(*side)
                );
            }
        }
    }
    if let Some(dynamic) = &verdict.dynamic {
        for (state, check) in [("SLV", &dynamic.slv), ("SLC", &dynamic.slc)] {
            text.extend(check.as_ref().map(|check| dynamic_text(state, check)));
        }
    }
    text
}

/// The dynamic check of a limit state.
fn dynamic_text(state: &str, check: &DynamicState) -> String {
    let mut text = format!(
        "\n{state} under {} records: {}; d = {} m, threshold over it {:.3}, zeta_E = {:.3}\n",
        check.runs.len(),
        if check.passed { "passed" } else { "not passed" },
        significant(check.d).trim(),
        check.ratio,
        check.zeta
    );
    for run in &check.runs {
        let beyond = if run.beyond_d0 { "  beyond d0" } else { "" };
        let _ = writeln!(
            text,
            "  {:<30} x {:<8.4} d = {} / {} m{beyond}",
            run.record,
            run.factor,
            significant(run.d[0]).trim(),
            significant(-run.d[1]).trim()
        );
    }
    text
}
