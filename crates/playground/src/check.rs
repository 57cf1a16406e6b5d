//! The check by a code: the verdict and its report.

use check::{CheckError, CheckFile, Language, Origin, ReportTable, Sentence, Subject, page, read};
use report::plot::Plot;
use rocking_wall::wall::Parameters;
use serde_json::{Value, json};

use crate::check_table::{key, table};
use crate::request::{Faults, Inputs, fault_of};
use crate::scene::Prepared;

/// Where a message goes that is about no field.
const NO_FIELD: &str = "check";
/// What computes, as reports name it.
pub(crate) const PROGRAM: &str = concat!("playground ", env!("CARGO_PKG_VERSION"));

/// Checks a wall: its verdict and its picture, or what is wrong, field by field. There is nothing where no
/// code is chosen.
pub(crate) fn checked(inputs: &Inputs, parameters: &Parameters) -> Value {
    let text = table(&inputs.check);
    if text.is_empty() {
        return Value::Null;
    }
    outcome(&text, parameters, inputs).unwrap_or_else(|error| {
        let path = error.keys().map(|keys| keys.join("."));
        let field = inputs.check.keys().find(|field| Some(key(field)) == path.as_deref());
        json!({ "faults": fault_of(field.map_or(NO_FIELD, String::as_str), error.to_string()) })
    })
}

/// Makes the report of the check of a scene, as a page.
pub(crate) fn report(prepared: &Prepared, language: Language) -> Result<Value, Faults> {
    let page = || {
        let file = CheckFile::parse_alone("scene.toml", &prepared.toml)?;
        let code = read(&file)?;
        let verdict = code.check(Subject::new(&prepared.scene.parameters))?;
        let (title, report) = (&prepared.scene.title, &ReportTable { language, ..ReportTable::default() });
        page(&verdict, &Origin::new(title, &file, code.records(), report, PROGRAM))
    };
    page().map(Value::from).map_err(|error: CheckError| fault_of(NO_FIELD, error.to_string()))
}

fn outcome(text: &str, parameters: &Parameters, inputs: &Inputs) -> Result<Value, CheckError> {
    let (width, language) = (inputs.width, inputs.language);
    let code = read(&CheckFile::parse_alone(NO_FIELD, text)?)?;
    let verdict = code.check(Subject::new(parameters))?;
    let figure = verdict.details.figure(language)?;
    let plot = Plot { size: [width, (0.5 * width).clamp(200.0, 270.0)], ..figure.plot };
    let mut outcome = verdict.summary();
    let told = |all: &[Sentence]| all.iter().map(|one| one.of(language)).collect::<Value>();
    for (name, value) in [
        ("title", verdict.code.title.into()),
        ("headline", verdict.headline().of(language).into()),
        ("notes", told(&verdict.notes)),
        ("warnings", told(&verdict.warnings)),
        ("rows", verdict.html(language).into()),
        ("numbers", verdict.numbers(language).html().into()),
        ("caption", figure.caption.into()),
        ("svg", plot.svg().into()),
    ] {
        outcome[name] = value;
    }
    Ok(outcome)
}
