//! The check by a code: the verdict and its report.

use check::{CheckError, CheckFile, Language, Origin, ReportTable, Subject, page, read};
use report::plot::Plot;
use rocking_wall::wall::Parameters;
use serde_json::{Value, json};

use crate::check_table::{key, table};
use crate::request::{Faults, Fields, fault_of};
use crate::scene::Prepared;

/// Where a message goes that is about no field.
const NO_FIELD: &str = "check";

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
        page(
            &verdict,
            &Origin {
                title,
                wall: None,
                file: &file,
                set: &[],
                records: code.records(),
                report,
                program: concat!("playground ", env!("CARGO_PKG_VERSION")),
            },
        )
    };
    page().map(Value::from).map_err(|error: CheckError| fault_of(NO_FIELD, error.to_string()))
}

fn outcome(text: &str, parameters: &Parameters, width: f64) -> Result<Value, CheckError> {
    let code = read(&CheckFile::parse(NO_FIELD, text)?)?;
    let verdict = code.check(Subject::new(parameters))?;
    let figure = verdict.details.figure(Language::En)?;
    let plot = Plot { size: [width, (0.5 * width).clamp(200.0, 270.0)], ..figure.plot };
    let mut outcome = verdict.summary();
    for (name, value) in [
        ("title", verdict.code.title),
        ("rows", &verdict.html()),
        ("numbers", &verdict.numbers().html()),
        ("caption", &figure.caption),
        ("svg", &plot.svg()),
    ] {
        outcome[name] = value.into();
    }
    Ok(outcome)
}
