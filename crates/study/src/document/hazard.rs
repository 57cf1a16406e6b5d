//! The table `[hazard]`: annual rates of intensities, and what is asked of a limit state.

use std::path::{Path, PathBuf};

use toml::Spanned;

use crate::hazard::{Hazard, HazardCurve, YEARS, is_open_quake, read};
use crate::ida::IntensityMeasure;
use rocking_wall::scene::{Place, SceneError, read_text};
use rocking_wall::tables;

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
        /// Annual rate that each limit state should not exceed \[1/year\].
        #[key(exclusiveMinimum = 0)]
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
    /// A file, and where the study states a unit and a site.
    File {
        file: String,
        unit: Option<(String, Stated)>,
        site: Option<(u32, Stated)>,
    },
}

/// Where a study states a key.
#[derive(Clone, Debug)]
struct Stated {
    file: String,
    line: usize,
}

impl Stated {
    fn at<T>(value: &Spanned<T>, place: &Place<'_>) -> Self {
        Self { file: place.name().to_owned(), line: place.line(value.span()) }
    }

    fn error(self, key: &str, message: &str) -> SceneError {
        let Self { file, line } = self;
        SceneError::Line { file, line, key: Some(key.to_owned()), message: message.to_owned() }
    }
}

impl HazardEntry {
    /// Returns the hazard of the study's measure, with warnings. A file is looked up in a folder, and added
    /// to the inputs.
    ///
    /// # Errors
    /// [`SceneError`] if the file cannot be read, is of another measure, or holds no hazard curve.
    pub fn open(
        self,
        measure: &IntensityMeasure,
        folder: &Path,
        inputs: &mut Vec<PathBuf>,
    ) -> Result<(Hazard, Vec<String>), SceneError> {
        let Self { curve, years, target } = self;
        let (curve, warnings) = match curve {
            Source::Points(curve) => {
                let warning = unusual(&curve, measure).map(|warning| format!("hazard: {warning}"));
                (curve, warning.into_iter().collect())
            }
            Source::File { file, unit, site } => {
                let path = folder.join(file);
                let name = path.display().to_string();
                let text = read_text(&path, "a hazard curve (CSV)", MAX_FILE_BYTES)?;
                let is_open_quake = is_open_quake(&text);
                match (is_open_quake, &unit, &site) {
                    (true, Some((_, unit)), _) => {
                        let message = "a table of OpenQuake has units of its own; leave out unit";
                        return Err(unit.clone().error("unit", message));
                    }
                    (false, _, Some((_, site))) => {
                        let message = "site belongs to a table of OpenQuake; leave it out";
                        return Err(site.clone().error("site", message));
                    }
                    _ => {}
                }
                let site = site.map(|(number, _)| number);
                let unit = unit.as_ref().map(|(unit, _)| unit.as_str());
                let (curve, mut warnings) = read(&Place::new(&name, &text), measure, unit, site)?;
                warnings.extend(unusual(&curve, measure).filter(|_| !is_open_quake));
                inputs.push(path);
                (curve, warnings.iter().map(|warning| format!("{name}: {warning}")).collect())
            }
        };
        Ok((Hazard { curve, years, target }, warnings))
    }
}

/// Reads the hazard of a study.
pub(super) fn hazard(
    table: &Spanned<HazardTable>,
    measure: &IntensityMeasure,
    place: &Place<'_>,
) -> Result<HazardEntry, SceneError> {
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
            unit: unit.as_ref().map(|unit| (unit.get_ref().clone(), Stated::at(unit, place))),
            site: site.as_ref().map(|site| (*site.get_ref(), Stated::at(site, place))),
        },
        _ => return Err(place.error(table.span(), "hazard needs points, or a file with them")),
    };
    Ok(HazardEntry { curve, years: years.unwrap_or(YEARS), target: *target })
}

/// Return period at which the intensities of sites are compared \[years\].
const PERIOD: f64 = 2475.0;

/// Warns of a curve in another unit than the study states.
fn unusual(curve: &HazardCurve, measure: &IntensityMeasure) -> Option<String> {
    let warning = measure.usual().warning(measure.unit().of(curve.intensity(1.0 / PERIOD)))?;
    Some(format!("at a return period of {PERIOD} years, {warning}; state unit beside it"))
}
