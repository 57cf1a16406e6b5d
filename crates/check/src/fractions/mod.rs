//! Capacity against demand: the wall's own capacity curve, read at fractions of the displacement at which its
//! force vanishes, against a response spectrum. docs/model.md states the rule.
//!
//! | file | holds |
//! |---|---|
//! | `demand` | the spectrum: points, or the median of records |
//! | `sides` | the check of each side |
//! | `figure` | the capacity curve over the demand |

mod demand;
mod figure;
mod sides;

use std::path::PathBuf;

use files::{Described, Schema, Tables, with};
use ground_motion::spectrum::DAMPING;
use ground_motion::{SpectrumFile, Unit};
use rocking_wall::wall::{Parameters, Wall};
use run::records::RecordsTable;
use serde::Deserialize;
use serde_json::{Value, json};
use toml::Spanned;

use crate::code::row::{Ends, Row};
use crate::code::verdict::{Details, Verdict};
use crate::code::{Code, InStudies, Subject};
use crate::error::CheckError;
use crate::file::site::{Records, check_points};
use crate::file::{CheckFile, HAS_FILES};
use crate::sections::origin::Figure;
use crate::words::entry::Entry;
use crate::words::ledger::Ledger;
use crate::words::names::{Side, Sides};
use crate::words::others::{heavy, improbable, storeys};
use crate::words::{Language, Sentence, Written, governing as told_governing, say, side};
use ::report::table::significant;
use sides::{Outcome, governing, outcomes};

pub use demand::Demand;
pub use sides::{Fractions, SideCheck, check};

/// This code among the others.
pub const ENTRY: Entry = Entry {
    name: "fractions",
    title: "Capacity at fractions",
    source: || {
        say! {
            "Static capacity of a wall, read at fractions of the displacement at which its force vanishes, \
             against a response spectrum",
            "Capacità statica della parete, letta a frazioni dello spostamento di annullamento della forza, \
             a confronto con uno spettro di risposta"
        }
    },
    symbol: "ratio",
    gravity: ground_motion::STANDARD_GRAVITY,
    checks: &["onset", "displacement"],
    example: "check = { code = \"fractions\", spectrum = [[0, 2.0], [0.5, 5.0], [4, 0.6]], unit = \"m/s2\" }",
    of_wall: &[],
};

files::tables! {
    /// Check of the wall's capacity curve over a spectrum, which `wall check` reads.
    #[derive(Clone, Debug)]
    pub struct FractionsTable {
        /// The code: capacity at fractions.
        #[key(enum = vec![ENTRY.name])]
        pub code: String,
        /// Displacement capacity over the displacement at which the force of the wall vanishes (-).
        #[key(exclusiveMinimum = 0, maximum = 1, default = 0.4)]
        pub displacement_fraction: Option<f64>,
        /// Displacement of the secant period over the displacement capacity (-).
        #[key(exclusiveMinimum = 0, maximum = 1, default = 0.4)]
        pub secant_fraction: Option<f64>,
        /// The demand: a file with columns T and Sa, or points [T, Sa], T in s from 0 on.
        pub spectrum: Option<SpectrumTable>,
        /// Unit of Sa, where the file does not state its own.
        pub unit: Option<Unit>,
        /// Name of the column with Sa, for a file with several.
        pub column: Option<String>,
        /// Damping ratio of the spectrum (-): that of the column's name, or 0.05 unless given.
        #[key(exclusiveMinimum = 0)]
        pub damping: Option<f64>,
        /// The demand: the median spectrum of these records, felt on the floor of a wall on storeys.
        pub records: Option<Spanned<RecordsTable>>,
    }
}

/// A spectrum: a file, or points.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "expected a file, or points [T, Sa]")]
#[allow(missing_docs, reason = "the names say it")]
pub enum SpectrumTable {
    File(PathBuf),
    Points(Vec<[f64; 2]>),
}

impl Described for SpectrumTable {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let forms = [PathBuf::describe(key, tables), Vec::<[f64; 2]>::describe(key, tables)];
        with(Schema::new(), "anyOf", forms.to_vec())
    }
}

/// The table `[check]`, validated.
#[derive(Clone, Debug)]
pub struct Statement {
    fractions: Fractions,
    /// The spectrum that is given; otherwise the demand is that of the records.
    spectrum: Option<Demand>,
    /// Where the spectrum comes from.
    source: Sentence,
    damping: f64,
    records: Records,
}

impl Statement {
    pub(crate) fn read(file: &CheckFile<'_>) -> Result<Self, CheckError> {
        let table: FractionsTable = file.table()?;
        let Fractions { displacement, secant } = Fractions::default();
        let mut statement = Self {
            fractions: Fractions {
                displacement: table.displacement_fraction.unwrap_or(displacement),
                secant: table.secant_fraction.unwrap_or(secant),
            },
            spectrum: None,
            source: Sentence::default(),
            damping: table.damping.unwrap_or(DAMPING),
            records: file.records(table.records.as_ref())?,
        };
        let of_spectrum = table.unit.is_some() || table.column.is_some();
        match (&table.spectrum, &table.records) {
            (None, Some(_)) if !of_spectrum => {}
            (Some(SpectrumTable::Points(points)), None) => {
                let Some(unit) = table.unit else {
                    let message = "unit is missing: state the unit of Sa, m/s2, cm/s2, mm/s2 or g";
                    return Err(CheckError::value(&["unit"], message));
                };
                let points: Vec<_> = points.iter().map(|[period, sa]| (*period, *sa)).collect();
                statement.source = say! {
                    "{count} points, Sa in {unit}",
                    "{count} punti, Sa in {unit}", count = points.len(), unit = unit.name()
                };
                let place = |index| format!("point {} of the spectrum", index + 1);
                check_points(&points, unit.name(), place)
                    .map_err(|message| CheckError::value(&["spectrum"], message))?;
                let in_si = points.into_iter().map(|(period, sa)| (period, unit.to_si(sa)));
                statement.spectrum = Some(Demand::of_points(in_si.collect(), place)?);
            }
            (Some(SpectrumTable::File(_)), None) if !HAS_FILES => {
                let message = "the playground reads no file of a spectrum; give points [T, Sa]";
                return Err(CheckError::value(&["spectrum"], message));
            }
            (Some(SpectrumTable::File(name)), None) => {
                statement.read_spectrum(file.folder().join(name), &table)?;
            }
            _ => {
                let message = "the demand is spectrum = \"FILE\" with its unit and column, or records = { \
                               files = [...] }, which have theirs in records.unit and records.column; give \
                               one of both";
                return Err(CheckError::value(&["spectrum"], message));
            }
        }
        Ok(statement)
    }

    /// Reads the spectrum of a file.
    fn read_spectrum(&mut self, path: PathBuf, table: &FractionsTable) -> Result<(), CheckError> {
        let read = SpectrumFile::read(&path, table.unit, table.column.as_deref())
            .map_err(|error| CheckError::value(&["spectrum"], error.to_string()))?;
        let name = path.display();
        self.records
            .warnings
            .extend(read.warning().map(|warning| Sentence::same(format!("{name}: {warning}"))));
        if let Some(stated) = read.damping {
            // a file may round it: 0.9 % for 0.0087
            if let Some(given) = table.damping.filter(|given| (given - stated).abs() > 0.05 * stated) {
                let message = format!(
                    "{name}: expected the damping ratio that the column of Sa states, {stated}, found \
                     damping {given}; leave out damping, or use the spectrum of that damping"
                );
                return Err(CheckError::value(&["damping"], message));
            }
            self.damping = table.damping.unwrap_or(stated);
        }
        let SpectrumFile { points, lines, unit, column, .. } = read;
        let column = column
            .map_or_else(Sentence::default, |column| say!("column {column}, ", "colonna {column}, ", column));
        let (file, unit) = (name.to_string(), unit.to_string());
        self.source =
            say!("{file}, {column}Sa in {unit}", "{file}, {column}Sa in {unit}", file, column, unit);
        self.spectrum = Some(Demand::of_points(points, |index| format!("{name}, line {}", lines[index]))?);
        self.records.files.push(path);
        Ok(())
    }

    fn checked<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        let Subject { parameters, floors, .. } = subject;
        subject.check_shape()?;
        let wall = Wall::new(parameters)?;
        let mut source = self.source.clone();
        let mut warnings: Vec<_> = parameters.unusual().map(|one| improbable(&one)).collect();
        let demand = if let Some(spectrum) = &self.spectrum {
            if floors.is_some() {
                warnings.push(say! {
                    "the storeys are not applied to the spectrum; it must be that of the wall's floor",
                    "i piani non si applicano allo spettro, che deve essere quello del piano della parete"
                });
            }
            spectrum.clone()
        } else {
            let count = self.records.named.len();
            source = if count == 1 {
                say!("median of 1 record", "mediana di 1 accelerogramma")
            } else {
                say!("median of {count} records", "mediana di {count} accelerogrammi", count)
            };
            if let Some(floors) = floors {
                warnings.extend(floors.improbable().map(|one| improbable(&one)));
                warnings.extend(floors.heavy(&wall).map(heavy));
                let felt = storeys(floors);
                source = say!("{source} {felt}", "{source} {felt}", source, felt);
            }
            Demand::of_motions(self.records.felt(floors, wall.body())?, self.damping)?
        };
        let sides = check(&wall, self.fractions, |period| demand.at(period))?;
        Ok(Checked { statement: self, parameters, wall, demand, source, sides, warnings })
    }
}

impl InStudies for Statement {}

impl Code for Statement {
    fn entry(&self) -> Entry {
        ENTRY
    }

    fn check<'a>(&'a self, subject: Subject<'a>) -> Result<Verdict<'a>, CheckError> {
        let doubts = |error: CheckError| error.with_doubts(subject.parameters.unusual().collect());
        let mut checked = self.checked(subject).map_err(doubts)?;
        let worst = *governing(&checked.sides, |side| side.displacement_ratio);
        Ok(Verdict {
            code: ENTRY,
            passed: worst.displacement_ratio >= 1.0,
            governs: "displacement",
            side: checked.of(&worst),
            level: None,
            zeta: worst.displacement_ratio,
            target: 1.0,
            raise: None,
            rows: checked.rows(),
            notes: checked.notes(),
            warnings: std::mem::take(&mut checked.warnings),
            before: None,
            details: Box::new(checked),
        })
    }

    fn records(&self) -> &Records {
        &self.records
    }
}

/// A wall that was checked.
struct Checked<'a> {
    statement: &'a Statement,
    parameters: &'a Parameters,
    wall: Wall,
    demand: Demand,
    source: Sentence,
    sides: Vec<SideCheck>,
    warnings: Vec<Sentence>,
}

impl Checked<'_> {
    /// What a side is of.
    fn of(&self, side: &SideCheck) -> Sides {
        Sides::of(Side::of(side.sign), self.wall.has_equal_sides())
    }

    /// The sides that differ.
    fn shown(&self) -> impl Iterator<Item = (Sides, &SideCheck)> {
        let shown = self.sides.iter().take(if self.wall.has_equal_sides() { 1 } else { 2 });
        shown.map(|side| (self.of(side), side))
    }

    fn rows(&self) -> Vec<Row> {
        let of_side = |(side, found): (Sides, &SideCheck)| {
            let onset = Ends::Accelerations([found.onset_acceleration, found.peak_acceleration]);
            let ends = Ends::Displacements([found.displacement_capacity, found.displacement_demand]);
            let displacement = Some(self.wall.body().participation * found.displacement_capacity);
            let [first, second] = outcomes().map(|outcome| outcome.title);
            [
                Row {
                    clause: "a0*/Sa(0)",
                    ..Row::new("onset", first, side, found.acceleration_ratio, onset)
                },
                Row {
                    decides: true,
                    displacement,
                    clause: "d_u*/Sd(T_s)",
                    ..Row::new("displacement", second, side, found.displacement_ratio, ends)
                },
            ]
        };
        self.shown().flat_map(of_side).collect()
    }

    fn notes(&self) -> Vec<Sentence> {
        let Statement { fractions: Fractions { displacement, secant }, damping, .. } = *self.statement;
        let mut notes = vec![
            say! {
                "demand: {source}, {percent} % damping",
                "domanda: {source}, smorzamento {percent} %", source = self.source, percent = 100.0 * damping
            },
            say! {
                "fractions: d_u* at {displacement} of the zero of F, secant at {secant} of d_u*",
                "frazioni: d_u* a {displacement} dello zero di F, secante a {secant} di d_u*",
                displacement, secant
            },
        ];
        for Outcome { ratio, title, says: [holds, fails], .. } in outcomes() {
            let worst = governing(&self.sides, ratio);
            let of = told_governing(self.of(worst));
            notes.push(say! {
                "{title}: {verdict}, ratio {ratio} ({of})",
                "{title}: {verdict}, rapporto {ratio} ({of})",
                title, verdict = if ratio(worst) >= 1.0 { holds } else { fails },
                ratio = Written(significant(ratio(worst), 4)), of
            });
        }
        notes.extend(self.shown().filter(|(_, found)| found.limited_by_tie).map(|(of, _)| {
            let side = side(of);
            say! {
                "{side}: the strength of the tie limits d_u*",
                "{side}: la resistenza della catena limita d_u*", side
            }
        }));
        notes
    }
}

impl Details for Checked<'_> {
    fn wall(&self) -> &Wall {
        &self.wall
    }

    fn parameters(&self) -> &Parameters {
        self.parameters
    }

    fn json(&self, verdict: &Verdict<'_>) -> Value {
        let governs = outcomes().map(|Outcome { name: result, ratio, .. }| {
            let worst = governing(&self.sides, ratio);
            (result.to_owned(), json!({ "side": Side::of(worst.sign).name(), "ratio": ratio(worst) }))
        });
        let sides: Vec<_> = self.sides.iter().map(|side| side.ledger().json()).collect();
        json!({
            "code": ENTRY.name,
            "passed": verdict.passed,
            "demand": self.source,
            "damping": self.statement.damping,
            "displacement_fraction": self.statement.fractions.displacement,
            "secant_fraction": self.statement.fractions.secant,
            "sides": sides,
            "governs": governs.into_iter().collect::<serde_json::Map<_, _>>(),
            "warnings": verdict.warnings,
        })
    }

    fn figure(&self, language: Language) -> Result<Figure, CheckError> {
        let worst = governing(&self.sides, |side| side.displacement_ratio);
        figure::figure(&self.wall, &self.demand, worst, language)
    }

    fn ledgers(&self) -> Vec<(Sides, Ledger)> {
        self.shown().map(|(of, side)| (of, side.ledger())).collect()
    }
}
