//! What acts on a wall at its place: records of the ground, motions of floors, spectra given by points.

use std::path::{Path, PathBuf};

use files::Place;
use ground_motion::GroundMotion;
use rocking_wall::wall::Body;
use run::records::{NamedRecord, RecordsTable, all_records, inputs, record_files, records};
use run::shaking::felt;
use scene::{DEFAULT_TAIL, Floors};
use toml::Spanned;

use crate::error::CheckError;
use crate::words::Sentence;
use crate::words::of_record::of_record;

/// The records of a check: motions of the ground at the site.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Their names and motions.
    pub named: Vec<NamedRecord>,
    /// Files that they were read from.
    pub files: Vec<PathBuf>,
    /// Warnings of a quick check of the records and of a grid of the hazard.
    pub warnings: Vec<Sentence>,
}

/// Reads the records of a table; their files are in a folder.
pub(super) type RecordReader = fn(&Spanned<RecordsTable>, &Place<'_>, &Path) -> Result<Records, CheckError>;

/// Reads the records that a table names, or makes the synthetic ones.
///
/// # Errors
/// [`CheckError::File`] of what the table cannot state, [`CheckError::Scene`] of a record.
pub(super) fn read_records(
    table: &Spanned<RecordsTable>,
    place: &Place<'_>,
    folder: &Path,
) -> Result<Records, CheckError> {
    let (entry, mut warnings) = (records(table, Vec::new(), place)?, Vec::new());
    let found = record_files(&entry, folder, place.name())?;
    let named = all_records(&entry, &found, folder, place.name(), &mut warnings)?;
    let files = inputs(&entry, found, folder);
    if named.iter().any(|record| record.listed.weight != named[0].listed.weight) {
        let message = "the list of records has weights, and a code takes records alike; delete its column of \
                       weights";
        return Err(place.error(table.span(), message).into());
    }
    Ok(Records { named, files, warnings: warnings.iter().map(of_record).collect() })
}

/// The level of shaking of a limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Factors on the records of the code, in their order \[-\].
    pub factors: Vec<f64>,
    /// The storeys below the wall, as the limit state has them.
    pub floors: Option<Floors>,
    /// Whether the code runs each record with both signs.
    pub both_signs: bool,
    /// What is to be known of the factors.
    pub warnings: Vec<String>,
}

impl Records {
    /// Returns the motion that acts on a wall under each record: the record itself, or the motion of its
    /// floors, those of a strip wall by their weights.
    pub(crate) fn felt(&self, floors: Option<&Floors>, body: &Body) -> Result<Vec<GroundMotion>, CheckError> {
        let one = |NamedRecord { motion, .. }: &NamedRecord| {
            Ok(felt(floors, body, motion, DEFAULT_TAIL)?.into_owned())
        };
        self.named.iter().map(one).collect()
    }
}

/// Checks that points (T, `S_a`) are a spectrum, as they are given; `unit` is that of `S_a`, and `place`
/// names a point by its index.
///
/// # Errors
/// The first whose T does not rise from 0 on, or whose `S_a` is not above 0; or that there are too few.
pub(crate) fn check_points(
    points: &[(f64, f64)],
    unit: &str,
    place: impl Fn(usize) -> String,
) -> Result<(), String> {
    let is_usable = |index: usize| {
        let (period, acceleration) = points[index];
        let rises = if index == 0 { period == 0.0 } else { period > points[index - 1].0 };
        rises && period.is_finite() && acceleration > 0.0 && acceleration.is_finite()
    };
    let expected = "expected T from 0 on that rises, and Sa above 0";
    match (0..points.len()).find(|index| !is_usable(*index)) {
        Some(index) => {
            let ((period, acceleration), at) = (points[index], place(index));
            Err(format!("{expected}; found T = {period} s and Sa = {acceleration} {unit} at {at}"))
        }
        None if points.len() < 2 => Err(format!("{expected}, at two points or more; found {}", points.len())),
        None => Ok(()),
    }
}

/// Returns `S_a` at a period of a spectrum given by points (T, `S_a`), straight between them.
///
/// # Errors
/// A period beyond its ends.
pub(crate) fn interpolated(points: &[(f64, f64)], period: f64) -> Result<f64, String> {
    let after = points.partition_point(|point| point.0 < period);
    match (points.get(after), after.checked_sub(1).map(|before| points[before])) {
        (Some(&(at, found)), _) if at == period => Ok(found),
        (Some(&(t1, s1)), Some((t0, s0))) => Ok(s0 + (s1 - s0) * ((period - t0) / (t1 - t0))),
        _ => {
            let [from, to] = [points.first(), points.last()].map(|end| end.map_or(f64::NAN, |end| end.0));
            Err(format!(
                "the spectrum goes from {from} to {to} s and has no T = {period} s; give it with that period"
            ))
        }
    }
}

/// Returns `T_R` = −`V_R`/ln(1 − P) of NTC 2.4.3, in the unit of `V_R`.
pub(crate) fn return_period(reference: f64, exceeded: f64) -> f64 {
    -reference / libm::log1p(-exceeded)
}

/// Says why coordinates are no place; `None` where they are.
pub(crate) fn no_place([latitude, longitude]: [f64; 2]) -> Option<String> {
    let is_place = latitude.abs() <= 90.0 && longitude.abs() <= 180.0;
    (!is_place).then(|| {
        format!(
            "coordinates = [{latitude}, {longitude}] must be latitude and longitude in degrees, such as \
             [42.35, 13.40]"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::return_period;

    /// NTC 2.4.3: the years of ordinary buildings, `V_R` = 50 years, are printed as 50, 475 and 975.
    #[test]
    fn return_periods_are_those_of_the_code() {
        for (exceeded, years) in [(0.63, 50.0), (0.10, 475.0), (0.05, 975.0)] {
            // printed without decimals
            assert!((return_period(50.0, exceeded) - years).abs() < 0.5, "{exceeded}");
        }
    }
}
