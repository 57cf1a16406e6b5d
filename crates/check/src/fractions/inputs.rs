//! The table `[check]` of the code `fractions`, and the code that it gives.

use std::path::{Path, PathBuf};

use ground_motion::spectrum::DAMPING;
use ground_motion::{GroundMotion, SpectrumFile, Unit};
use report::plot::Plot;
use rocking_wall::scene::{Place, parse_toml};
use rocking_wall::wall::Wall;
use run::records::{RecordsTable, all_records, record_files, records};
use serde::Deserialize;
use toml::Spanned;

use super::{CapacityOverDemand, Demand, Fractions, SideCheck, check, over_demand, rows};
use crate::code::{Code, Given, Subject, Verdict};
use crate::error::CheckError;

/// What is stated, as it is written.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FractionsTable {
    /// The code; [`CODE`](super::CODE).
    pub code: String,
    /// Displacement capacity over the displacement at which the force of the wall vanishes \[-\].
    pub displacement_fraction: Option<f64>,
    /// Displacement of the secant period over the displacement capacity \[-\].
    pub secant_fraction: Option<f64>,
    /// The demand: a response spectrum of the ground or of the wall's floor.
    pub spectrum: Option<SpectrumTable>,
    /// Unit of a spectrum that does not state its own.
    pub unit: Option<Unit>,
    /// Name of the column with Sa, for a file with several.
    pub column: Option<String>,
    /// Damping ratio of the spectrum \[-\].
    pub damping: Option<f64>,
    /// The demand: the median spectrum of these records, felt on the floor of a wall on storeys.
    pub records: Option<Spanned<RecordsTable>>,
}

/// A response spectrum, from T = 0 on.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "expected a file in quotes, or a list of points [T, Sa]")]
pub enum SpectrumTable {
    /// A file (CSV or text), relative to the scene.
    File(PathBuf),
    /// Points [T, Sa] \[s, m/s²\], or Sa in the unit.
    Points(Vec<[f64; 2]>),
}

/// A check by fractions, ready for walls.
#[derive(Debug)]
pub(super) struct ByFractions {
    pub(super) fractions: Fractions,
    /// What the demand is called.
    pub(super) name: String,
    pub(super) damping: f64,
    demand: Source,
    files: Vec<PathBuf>,
    warnings: Vec<String>,
}

#[derive(Debug)]
enum Source {
    Spectrum(Demand),
    Records(Vec<GroundMotion>),
}

/// Reads the table `[check]` of this code.
///
/// # Errors
/// [`CheckError`] of a value, with its keys, or of a file.
pub fn read(place: &Place<'_>, given: Given<'_>) -> Result<Box<dyn Code>, CheckError> {
    #[derive(Deserialize)]
    struct WithCheck {
        check: Option<FractionsTable>,
    }
    let WithCheck { check } = parse_toml(place)?;
    check.unwrap_or_default().code(place, given)
}

impl FractionsTable {
    /// Reads the spectrum or the records, and makes the code.
    ///
    /// # Errors
    /// [`CheckError`] of a value, with its keys, or of a file.
    pub fn code(&self, place: &Place<'_>, given: Given<'_>) -> Result<Box<dyn Code>, CheckError> {
        let Fractions { displacement, secant } = Fractions::default();
        let mut code = ByFractions {
            fractions: Fractions {
                displacement: self.displacement_fraction.unwrap_or(displacement),
                secant: self.secant_fraction.unwrap_or(secant),
            },
            name: String::new(),
            damping: self.damping.unwrap_or(DAMPING),
            demand: Source::Records(Vec::new()),
            files: Vec::new(),
            warnings: Vec::new(),
        };
        match &self.spectrum {
            Some(spectrum) if self.records.is_none() && given.records.is_empty() => {
                self.take_spectrum(&mut code, spectrum, given.folder)?;
            }
            None => self.take_records(&mut code, place, given)?,
            Some(_) => {
                let message = "a spectrum and records state the same; leave one out";
                return Err(CheckError::value(&["spectrum"], message));
            }
        }
        Ok(Box::new(code))
    }

    fn take_spectrum(
        &self,
        code: &mut ByFractions,
        spectrum: &SpectrumTable,
        folder: &Path,
    ) -> Result<(), CheckError> {
        let (demand, name) = match spectrum {
            SpectrumTable::Points(points) => {
                let unit = self.unit.map_or(1.0, |unit| unit.to_si(1.0));
                let points = points.iter().map(|[period, sa]| (*period, unit * sa)).collect();
                let place = |index| format!("point {} of the spectrum", index + 1);
                (Demand::of_points(points, place)?, "a spectrum by points".to_owned())
            }
            SpectrumTable::File(path) => {
                let path = folder.join(path);
                let file = SpectrumFile::read(&path, self.unit, self.column.as_deref())?;
                code.warnings.extend(file.warning().map(|warning| format!("{}: {warning}", path.display())));
                code.damping = match (self.damping, file.damping) {
                    // a file may round it: 0.9 % for 0.0087
                    (Some(given), Some(stated)) if (given - stated).abs() > 0.05 * stated => {
                        let message = format!(
                            "{}: expected the damping ratio that the column of Sa states, {stated}, found \
                             {given}; leave damping out, or use the spectrum of that damping",
                            path.display()
                        );
                        return Err(CheckError::value(&["damping"], message));
                    }
                    (given, stated) => given.or(stated).unwrap_or(DAMPING),
                };
                let SpectrumFile { points, lines, unit, column, .. } = file;
                let place = |index: usize| format!("{}, line {}", path.display(), lines[index]);
                let column = column.map_or_else(String::new, |column| format!("column {column}, "));
                let name = format!("{}, {column}Sa in {unit}", path.display());
                let demand = Demand::of_points(points, place)?;
                code.files.push(path.clone());
                (demand, name)
            }
        };
        (code.demand, code.name) = (Source::Spectrum(demand), name);
        Ok(())
    }

    fn take_records(
        &self,
        code: &mut ByFractions,
        place: &Place<'_>,
        given: Given<'_>,
    ) -> Result<(), CheckError> {
        let mut named = given.records;
        if let Some(table) = &self.records {
            let entry = records(table, place)?;
            let files = record_files(&entry, given.folder, place.name())?;
            named.extend(all_records(&entry, &files, place.name(), &mut code.warnings)?);
            code.files.extend(files.into_iter().map(|file| file.path));
        }
        if named.is_empty() {
            let message = "there is no demand; give a spectrum, or records";
            return Err(CheckError::value(&["spectrum"], message));
        }
        code.name = format!("median of {}", report::counted(named.len(), "record"));
        code.demand = Source::Records(named.into_iter().map(|record| record.motion).collect());
        Ok(())
    }
}

/// A wall, its demand, and what was found.
pub(super) struct Checked {
    pub(super) wall: Wall,
    pub(super) demand: Demand,
    pub(super) sides: Vec<SideCheck>,
}

impl ByFractions {
    fn checked(&self, subject: &Subject<'_>) -> Result<Checked, CheckError> {
        let wall = Wall::new(subject.parameters)?;
        let demand = match &self.demand {
            Source::Spectrum(demand) => demand.clone(),
            Source::Records(motions) => {
                Demand::of_records(motions.clone(), subject.floors, &wall, self.damping)?
            }
        };
        let sides = check(&wall, self.fractions, |period| demand.at(period))?;
        Ok(Checked { wall, demand, sides })
    }

    /// What is said of the storeys of a wall.
    pub(super) fn warnings_on(&self, subject: &Subject<'_>, wall: &Wall) -> Vec<String> {
        let Some(floors) = subject.floors else { return Vec::new() };
        match self.demand {
            Source::Spectrum(_) => {
                let words =
                    "the storeys are not applied to the spectrum; it must be that of the wall's floor";
                vec![words.to_owned()]
            }
            Source::Records(_) => floors.warnings(wall).collect(),
        }
    }

    /// What the demand is called, with the floors that a wall stands on.
    pub(super) fn demand_name(&self, subject: &Subject<'_>) -> String {
        match (&self.demand, subject.floors) {
            (Source::Records(_), Some(floors)) => format!("{} {}", self.name, floors.note()),
            _ => self.name.clone(),
        }
    }
}

impl Code for ByFractions {
    fn check(&self, subject: &Subject<'_>) -> Result<Verdict, CheckError> {
        Ok(rows::verdict(self, subject, &self.checked(subject)?))
    }

    fn plot(&self, subject: &Subject<'_>) -> Result<Plot, CheckError> {
        let Checked { wall, demand, sides } = self.checked(subject)?;
        Ok(over_demand(&CapacityOverDemand::new(&wall, &demand, &sides)?))
    }

    fn files(&self) -> &[PathBuf] {
        &self.files
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}
