//! The check by a code: from the fields of the page to the table `[check]`, and to its outcome.

use std::fmt::Write;

use check::CheckError;
use check::code::{Given, Subject, Verdict, read};
use report::plot::Plot;
use report::table::Cell;
use rocking_wall::scene::{Place, SceneError};
use rocking_wall::wall::Parameters;
use serde_json::{Value, json};

use crate::request::{Fields, fault_of, field_of};

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
        // points of a spectrum
        _ if text.starts_with('[') => text.to_owned(),
        // a string of JSON is one of TOML
        _ => Value::from(text).to_string(),
    }
}

/// Checks a wall: its verdict and its picture of a width \[px\], or what is wrong, field by field. There is
/// nothing where no code is chosen.
pub(crate) fn checked(fields: &Fields, parameters: &Parameters, width: f64) -> Value {
    let text = table(fields);
    let checked = || -> Result<Value, CheckError> {
        let Some(code) = read(&Place::new(NO_FIELD, &text), Given::default())? else {
            return Ok(Value::Null);
        };
        let subject = Subject { title: "", parameters, floors: None, is_tried: false };
        Ok(outcome(&code.check(&subject)?, code.plot(&subject)?, width))
    };
    checked().unwrap_or_else(|error| {
        let (field, message) = fault(fields, error);
        json!({ "faults": fault_of(field, message) })
    })
}

fn outcome(verdict: &Verdict, plot: Plot, width: f64) -> Value {
    let plot = Plot { size: [width, (0.5 * width).clamp(200.0, 270.0)], ..plot };
    json!({
        "state": if verdict.passed { "stands" } else { "falls" },
        "headline": verdict.headline,
        "detail": verdict.detail,
        "zeta_E": verdict.zeta,
        "side": verdict.side,
        "facts": facts(verdict),
        "notes": verdict.notes,
        "warnings": verdict.warnings,
        "svg": plot.svg(),
    })
}

/// The numbers of the side that governs, as names and values for people.
fn facts(verdict: &Verdict) -> Vec<[String; 2]> {
    let columns = &verdict.numbers.columns;
    let side = columns.iter().position(|column| column.name == verdict.side).unwrap_or(2);
    let fact = |row: &Vec<Cell<'_>>| {
        let [name, unit] = [0, 1].map(|place| columns[place].words(&row[place]));
        [name, format!("{} {}", columns[side].words(&row[side]), unit.replace('-', "")).trim().to_owned()]
    };
    verdict.numbers.rows.iter().map(fact).collect()
}

/// The field that an error is about, and its message.
fn fault(fields: &Fields, error: CheckError) -> (String, String) {
    let message = error.to_string();
    let field = match (error.keys(), error) {
        (Some(keys), _) => fields.contains_key(&keys.join(".")).then(|| keys.join(".")),
        (None, CheckError::Scene(SceneError::Line { line, message, .. })) => {
            let text = table(fields);
            let field = text.lines().nth(line - 1).and_then(|line| line.split(" = ").next());
            let field = field.filter(|field| fields.contains_key(*field)).unwrap_or(NO_FIELD);
            return (field.to_owned(), message);
        }
        (None, _) => Some(field_of(&message, fields.keys().map(String::as_str), NO_FIELD)),
    };
    (field.unwrap_or_else(|| NO_FIELD.to_owned()), message)
}
