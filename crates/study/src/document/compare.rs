//! Which measures a study compares: the keys `compare` and `records_table` of `[intensity]`.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;

use crate::codes::Codes;
use crate::ida::{IntensityMeasure, Study};
use crate::measures::{Compared, Events};
use files::{FileError, Place, TomlFile, read_text, suggestion};
use scene::SceneError;

use super::levels::{IntensityTable, MEASURES, of_code, without_periods};

/// Largest table of records that is read.
const MAX_FILE_BYTES: u64 = 64 << 20;

/// The measures that a study compares; magnitudes and distances of its records may be in a table.
#[derive(Clone, Debug)]
pub struct CompareEntry {
    measures: Vec<IntensityMeasure>,
    table: Option<String>,
    /// Where the measures stand in the study file.
    span: Range<usize>,
}

impl CompareEntry {
    /// Returns the records of a study in these measures, with warnings. The table is looked up in a folder,
    /// and added to the inputs; `place` is that of the study file.
    ///
    /// # Errors
    /// [`FileError`] if the table cannot be read or lacks a record, if there are too few records, or one has
    /// no intensity in a measure.
    pub fn open(
        self,
        study: &Study,
        place: &Place<'_>,
        folder: &Path,
        inputs: &mut Vec<PathBuf>,
    ) -> Result<(Compared, Vec<String>), FileError> {
        let events = self.table.map(|table| {
            let path = folder.join(table);
            let text = read_text(&path, "a table of records (CSV)", MAX_FILE_BYTES)?;
            let events = Events::read(&Place::new(&path.display().to_string(), &text))?;
            inputs.push(path);
            Ok::<_, FileError>(events)
        });
        let compared = Compared::of(study, &self.measures, events.transpose()?.as_ref());
        let compared = compared.map_err(|reason| place.error(self.span, reason))?;
        let alike = |name: &str| {
            format!(
                "{}, compare: the {name} is the same in all records; it explains nothing, and has no p-value",
                place.name()
            )
        };
        let warnings = compared.constant().map(alike).collect();
        Ok((compared, warnings))
    }
}

/// Reads the measures that a study compares.
pub(super) fn compare(
    table: Option<&Spanned<IntensityTable>>,
    own: &IntensityMeasure,
    codes: &dyn Codes,
    file: &TomlFile<'_>,
) -> Result<Option<CompareEntry>, SceneError> {
    let Some(spec) = table.map(Spanned::get_ref) else { return Ok(None) };
    let refuse = |span: Range<usize>, message: String| Err(file.place().error(span, message).into());
    let Some(names) = &spec.compare else {
        let Some(records) = &spec.records_table else { return Ok(None) };
        let message = "records_table belongs to compare, the measures that the study compares; add \
                       compare = [\"PGA\", \"PGV\"], or leave it out";
        return refuse(records.span(), message.to_owned());
    };
    let mut measures: Vec<IntensityMeasure> = Vec::new();
    for name in names.get_ref() {
        let text = name.get_ref().as_str();
        let measure = if text == spec.measure.get_ref() {
            own.clone()
        } else if text == "code" {
            of_code(None, name.span(), codes, file)?
        } else {
            named(text).map_err(|message| file.place().error(name.span(), message))?
        };
        if measures.contains(&measure) {
            return refuse(name.span(), format!("compare lists {text:?} twice; leave one out"));
        }
        measures.push(measure);
    }
    let table = spec.records_table.as_ref().map(|name| name.get_ref().clone());
    Ok(Some(CompareEntry { measures, table, span: names.span() }))
}

/// Returns the measure of a name; Sa has its period in brackets.
fn named(text: &str) -> Result<IntensityMeasure, String> {
    if let Some(measure) = without_periods(text) {
        return Ok(measure);
    }
    if text == "AvgSA" {
        return Ok(IntensityMeasure::default());
    }
    if text == "Sa" {
        return Err("\"Sa\" in compare needs its period in s, such as \"Sa(0.5)\"".to_owned());
    }
    if let Some(period) = text.strip_prefix("Sa(").and_then(|rest| rest.strip_suffix(')')) {
        let number = period.trim().trim_end_matches('s').trim_end().parse().ok();
        let period = number.filter(|period: &f64| *period > 0.0 && period.is_finite());
        let wrong =
            || format!("{text:?} in compare: the period must be a number of s above 0, as in \"Sa(0.5)\"");
        return Ok(IntensityMeasure::Sa { period: period.ok_or_else(wrong)? });
    }
    let meant = suggestion(text, MEASURES);
    Err(format!("compare: {text:?} is not one of {}{meant}; Sa has its period, as in \"Sa(0.5)\"", {
        MEASURES.join(", ")
    }))
}
