//! The table `[hazard]`: annual rates of intensities, and what is asked of a limit state.

use std::path::{Path, PathBuf};

use files::{FileError, Place, read_text, tables};
use fragility::hazard::{Hazard, HazardCurve, YEARS};
use toml::Spanned;

use super::hazard_file::{read, unusual};
use crate::ida::IntensityMeasure;

use super::levels::to_si;

/// Largest file of a hazard curve that is read.
const MAX_FILE_BYTES: u64 = 64 << 20;

tables! {
    /// Annual rates at which intensities of the study's measure are exceeded, and what is asked of them.
    #[derive(Debug)]
    pub(super) struct HazardTable {
        /// Points: intensity and annual rate of exceedance \[1/year\]; intensities rise, rates fall.
        #[key(minItems = 2)]
        points: Option<Spanned<Vec<[f64; 2]>>>,
        /// A file instead of points: CSV with a measure and `annual_rate`, or hazard curves of `OpenQuake`.
        file: Option<Spanned<String>>,
        /// Number of the site in a file of `OpenQuake`, from 1.
        #[key(minimum = 1)]
        site: Option<Spanned<u32>>,
        /// Unit of points and of two columns, as that of levels; by default that of the results.
        unit: Option<Spanned<String>>,
        /// Years of the probabilities.
        #[key(exclusiveMinimum = 0, default = YEARS)]
        years: Option<f64>,
        /// Annual rate that each limit state should not exceed \[1/year\], such as 1/475.
        #[key(exclusiveMinimum = 0, maximum = 1)]
        target: Option<f64>,
    }
}

/// The hazard that a study names; its curve may be in a file.
#[derive(Clone, Debug)]
pub struct HazardEntry {
    curve: Source,
    years: f64,
    target: Option<f64>,
}

#[derive(Clone, Debug)]
enum Source {
    Points(HazardCurve),
    File { file: String, unit: Option<String>, site: Option<u32> },
}

impl HazardEntry {
    /// Returns the hazard of the study's measure, with warnings. A file is looked up in a folder, and added
    /// to the inputs.
    ///
    /// # Errors
    /// [`FileError`] if the file cannot be read, is of another measure, or holds no hazard curve.
    pub fn open(
        self,
        measure: &IntensityMeasure,
        folder: &Path,
        inputs: &mut Vec<PathBuf>,
    ) -> Result<(Hazard, Vec<String>), FileError> {
        let Self { curve, years, target } = self;
        let (name, (curve, warnings)) = match curve {
            Source::Points(curve) => {
                let warning = unusual(&curve, measure);
                ("hazard".to_owned(), (curve, warning.into_iter().collect()))
            }
            Source::File { file, unit, site } => {
                let path = folder.join(file);
                let name = path.display().to_string();
                let text = read_text(&path, "a hazard curve (CSV)", MAX_FILE_BYTES)?;
                inputs.push(path);
                let read = read(&Place::new(&name, &text), measure, unit.as_deref(), site)?;
                (name, read)
            }
        };
        let warnings = warnings.iter().map(|warning: &String| format!("{name}: {warning}")).collect();
        Ok((Hazard { curve, years, target }, warnings))
    }
}

/// Reads the hazard of a study.
pub(super) fn hazard(
    table: &Spanned<HazardTable>,
    measure: &IntensityMeasure,
    place: &Place<'_>,
) -> Result<HazardEntry, FileError> {
    let HazardTable { points, file, site, unit, years, target } = table.get_ref();
    let to_si = to_si(measure, unit.as_ref(), place)?;
    let curve = match (points, file) {
        (Some(points), None) => {
            if let Some(site) = site {
                return Err(place.error(site.span(), "site belongs to a file of OpenQuake; leave it out"));
            }
            let curve = HazardCurve::converted(points.get_ref().clone(), to_si);
            Source::Points(curve.map_err(|error| place.error(points.span(), error.to_string()))?)
        }
        (None, Some(file)) => Source::File {
            file: file.get_ref().clone(),
            unit: unit.as_ref().map(|unit| unit.get_ref().clone()),
            site: site.as_ref().map(|site| *site.get_ref()),
        },
        _ => return Err(place.error(table.span(), "hazard needs points, or a file with them, and not both")),
    };
    Ok(HazardEntry { curve, years: years.unwrap_or(YEARS), target: *target })
}
