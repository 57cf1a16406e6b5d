//! The check by a code: from the fields of the page to the table `[check]`, and to its outcome.

use std::fmt::Write;

use check::circolare::figure::governing_over_demand;
use check::circolare::{
    ActivationCheck, CheckError, Deciding, DisplacementCheck, LimitState, Records, SideVerdict, Statement,
    Verdict, check, demands, read_table,
};
use report::number;
use report::plot::Plot;
use rocking_wall::scene::{Place, SceneError};
use rocking_wall::wall::{Parameters, Wall};
use serde_json::{Value, json};

use crate::request::{Fields, fault_of};

/// Where a message goes that is about no field.
const NO_FIELD: &str = "check";

/// Returns the table `[check]` of the fields, one key in a line; nothing where no code is chosen.
pub(crate) fn table(fields: &Fields) -> String {
    let given = || fields.iter().filter(|(_, text)| !text.trim().is_empty());
    if !given().any(|(name, _)| name == "code") {
        return String::new();
    }
    given().fold("\n[check]\n".to_owned(), |mut table, (name, text)| {
        let _ = writeln!(table, "{name} = {}", value(text.trim()));
        table
    })
}

/// A text of a field as a value of TOML: a number, true or false, or a text.
fn value(text: &str) -> String {
    match text.parse::<f64>() {
        // a number of storeys is whole
        Ok(number) if number.fract() == 0.0 && number.abs() < 1e15 => format!("{number:.0}"),
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ if text == "true" || text == "false" => text.to_owned(),
        // a string of JSON is one of TOML
        _ => Value::from(text).to_string(),
    }
}

/// Checks a wall: its verdict and its picture of a width \[px\], or what is wrong, field by field. There is
/// nothing where no code is chosen.
pub(crate) fn checked(fields: &Fields, wall: &Wall, parameters: &Parameters, width: f64) -> Value {
    let text = table(fields);
    if text.is_empty() {
        return Value::Null;
    }
    match outcome(&text, wall, parameters, width) {
        Ok(outcome) => outcome,
        Err(error) => {
            let (field, message) = fault(fields, error);
            json!({ "faults": fault_of(field, message) })
        }
    }
}

fn outcome(text: &str, wall: &Wall, parameters: &Parameters, width: f64) -> Result<Value, CheckError> {
    let Some(table) = read_table(&Place::new(NO_FIELD, text))? else { return Ok(Value::Null) };
    let (statement, records) = (table.statement()?, Records::default());
    let verdict = check(parameters, None, &statement, &records)?;
    let plot = governing_over_demand(&statement, &demands(wall, None, &statement, &records)?, &verdict)?;
    let plot = Plot { size: [width, (0.5 * width).clamp(200.0, 270.0)], ..plot };
    let sides = &verdict.sides;
    let governing = sides.iter().find(|(side, _)| *side == verdict.governs.side);
    let (state, passed) = if verdict.passed { ("stands", "passed") } else { ("falls", "not passed") };
    let (zeta, limit_state) = (number(verdict.governs.zeta, 3), verdict.governs.limit_state.name());
    Ok(json!({
        "state": state,
        "headline": format!("Circolare 7/2019: {passed}, ζ_E = {zeta} ({limit_state})"),
        "detail": detail(&statement, &verdict),
        "zeta_E": verdict.governs.zeta,
        "side": verdict.governs.side.name(),
        "facts": governing.map(|(_, side)| facts(side)),
        "warnings": verdict.warnings,
        "svg": plot.svg(),
    }))
}

/// The ground acceleration that just passes, beside that of the site.
fn detail(statement: &Statement, verdict: &Verdict) -> String {
    let governs = verdict.governs;
    let state = match governs.limit_state {
        Deciding::Sld => LimitState::Sld,
        Deciding::SlvWithQ | Deciding::Slv => LimitState::Slv,
        Deciding::Slc => LimitState::Slc,
    };
    let site = statement.state(state).map_or(f64::NAN, |given| given.ag);
    let held = format!(
        "It holds up to a_g = {} g; the site has {} g.",
        number(governs.zeta * site, 3),
        number(site, 3)
    );
    let breaks = verdict.sides.iter().any(|(side, verdict)| {
        side == governs.side && state == LimitState::Slv && verdict.slv.is_some_and(|slv| slv.limited_by_tie)
    });
    held + if breaks { " The tie breaks at d_SLV." } else { "" }
}

/// The numbers of a side, as names and values for people.
fn facts(side: &SideVerdict) -> Vec<[String; 2]> {
    let mut rows = vec![
        ["activation α0".to_owned(), number(side.alpha0, 3)],
        ["elastic period T0".to_owned(), format!("{} s", number(side.t0, 3))],
    ];
    let mut row = |name: &str, [capacity, demand, zeta]: [f64; 3], unit: &str| {
        let [capacity, demand, zeta] = [capacity, demand, zeta].map(|value| number(value, 3));
        rows.push([name.to_owned(), format!("{capacity} / {demand} {unit}: ζ_E {zeta}")]);
    };
    let activation = |check: ActivationCheck| [check.capacity, check.demand, check.ratio];
    let displacement = |check: DisplacementCheck| [1000.0 * check.d, 1000.0 * check.demand, check.zeta];
    if let Some(check) = side.sld {
        row("SLD, a / S_e", activation(check), "m/s²");
    }
    if let Some(check) = side.slv_q {
        row("SLV with q, a / S_e", activation(check), "m/s²");
    }
    for (state, check) in [("SLV", side.slv), ("SLC", side.slc)] {
        if let Some(check) = check {
            row(&format!("{state}, d / S_d"), displacement(check), "mm");
        }
    }
    for (state, check) in [("SLV", side.slv), ("SLC", side.slc)] {
        rows.extend(
            check.map(|check| [format!("period T_{state}"), format!("{} s", number(check.period, 3))]),
        );
    }
    rows
}

/// The field that an error is about, and its message.
fn fault(fields: &Fields, error: CheckError) -> (String, String) {
    let names = || fields.keys().map(String::as_str);
    match error {
        CheckError::Value { keys, message } => {
            let path = keys.join(".");
            if fields.contains_key(&path) {
                return (path, message);
            }
            // a key that is missing below the one that is named
            let last = |name: &&str| name.rsplit('.').next().is_some_and(|last| message.contains(last));
            let below = names().filter(|name| name.starts_with(&path) && name.contains('.')).find(last);
            (below.unwrap_or(NO_FIELD).to_owned(), message)
        }
        CheckError::Scene(SceneError::Line { key, message, .. }) => {
            (key.filter(|key| fields.contains_key(key)).unwrap_or_else(|| NO_FIELD.to_owned()), message)
        }
        CheckError::Improbable { doubts, error } => {
            let (field, message) = fault(fields, *error);
            let doubts: Vec<_> = doubts.iter().map(ToString::to_string).collect();
            (field, format!("{}; as given, {message}", doubts.join("; ")))
        }
        other => {
            let path = other.keys().unwrap_or_default().join(".");
            let field = names().find(|name| *name == path).unwrap_or(NO_FIELD).to_owned();
            (field, other.to_string())
        }
    }
}
