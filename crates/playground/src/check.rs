//! The check by a code: from the fields of the page to the table `[check]`, and to its verdict.

use std::fmt::Write;

use check::{CheckError, CheckFile, Language, Origin, ReportTable, Subject, page, read};
use report::plot::Plot;
use rocking_wall::wall::Parameters;
use serde_json::{Value, json};

use crate::request::{Faults, Fields, fault_of};
use crate::scene::Prepared;

/// Where a message goes that is about no field.
const NO_FIELD: &str = "check";

/// Returns the table `[check]` of the fields, one key in a line; nothing where no code is chosen.
pub(crate) fn table(fields: &Fields) -> String {
    let given = || fields.iter().filter(|(_, text)| !text.trim().is_empty());
    if !given().any(|(name, _)| name == "code") {
        return String::new();
    }
    given().fold("\n[check]\n".to_owned(), |mut table, (name, text)| {
        let _ = writeln!(table, "{} = {}", key(name), value(text.trim()));
        table
    })
}

/// The key of a field; one that the motion has too is told from it by its name.
fn key(field: &str) -> &str {
    field.strip_prefix("check.").unwrap_or(field)
}

/// A text of a field as a value of TOML: a number, true or false, a list, or a text.
fn value(text: &str) -> String {
    match text.parse::<f64>() {
        // a number of storeys is whole
        Ok(number) if number.fract() == 0.0 && number.abs() < 1e15 => format!("{number:.0}"),
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ if text == "true" || text == "false" => text.to_owned(),
        _ if serde_json::from_str::<Vec<Value>>(text).is_ok() => text.to_owned(),
        // a string of JSON is one of TOML
        _ => Value::from(text).to_string(),
    }
}

/// Checks a wall: its verdict and its picture of a width \[px\], or what is wrong, field by field. There is
/// nothing where no code is chosen.
pub(crate) fn checked(fields: &Fields, parameters: &Parameters, width: f64) -> Value {
    let text = table(fields);
    if text.is_empty() {
        return Value::Null;
    }
    outcome(&text, parameters, width).unwrap_or_else(|error| {
        let path = error.keys().map(|keys| keys.join("."));
        let field = fields.keys().find(|field| Some(key(field)) == path.as_deref());
        json!({ "faults": fault_of(field.map_or(NO_FIELD, String::as_str), error.to_string()) })
    })
}

/// Makes the report of the check of a scene, as a page.
pub(crate) fn report(prepared: &Prepared, language: Language) -> Result<Value, Faults> {
    let page = || {
        let file = CheckFile::parse("scene.toml", &prepared.toml)?;
        let code = read(&file)?;
        let verdict = code.check(Subject::new(&prepared.scene.parameters))?;
        let (title, report) = (&prepared.scene.title, &ReportTable { language, ..ReportTable::default() });
        page(&verdict, &Origin { title, wall: None, file: &file, set: &[], records: code.records(), report })
    };
    page().map(Value::from).map_err(|error: CheckError| fault_of(NO_FIELD, error.to_string()))
}

fn outcome(text: &str, parameters: &Parameters, width: f64) -> Result<Value, CheckError> {
    let code = read(&CheckFile::parse(NO_FIELD, text)?)?;
    let verdict = code.check(Subject::new(parameters))?;
    let figure = verdict.details.figure()?;
    let plot = Plot { size: [width, (0.5 * width).clamp(200.0, 270.0)], ..figure.plot };
    let mut outcome = verdict.summary();
    for (name, value) in [
        ("title", verdict.code.title),
        ("rows", &verdict.html()),
        ("numbers", &verdict.details.numbers().html()),
        ("caption", &figure.caption),
        ("svg", &plot.svg()),
    ] {
        outcome[name] = value.into();
    }
    Ok(outcome)
}
