//! Studies read from files: a study file, and the scenes and records that it names.

use std::path::{Path, PathBuf};

use files::{FileError, Place, read_text};
use fragility::{FEWEST_RECORDS, Weights};
use ground_motion::GroundMotionError;
use report::counted;
use rocking_wall::wall::{Parameters, Usual, Wall, Warning};
use run::model::Model;
use run::records::{NamedRecord, all_records, copies, inputs as record_inputs, record_files};
use run::wall_text::{wall_of_text, wall_text};
use run::walls::{NamedWall, assumed, check_unique, defaults, walls};
use scene::SceneError;

use crate::codes::Codes;
use crate::document::{CompareEntry, ReportOptions, StudyFile, WallClass};
use crate::ida::{IntensityMeasure, Misfit, Polarity, Study};
use crate::uncertain::Uncertain;

/// Largest study file that is read.
const MAX_FILE_BYTES: u64 = 4 << 20;

/// Most walls that samples make.
const MOST_WALLS: usize = 1_000_000;

/// A study ready to run, and the options of its report.
#[derive(Clone, Debug)]
pub struct LoadedStudy {
    /// Title.
    pub title: String,
    /// The study.
    pub study: Study,
    /// Options of the report.
    pub report: ReportOptions,
    /// Files that it was read from.
    pub inputs: Vec<PathBuf>,
    /// Warnings of the walls and of a quick check of the records.
    pub warnings: Vec<String>,
    /// Text of the study file.
    pub text: String,
    /// Its walls where each of them stands for samples; empty of other studies.
    sampled: Vec<NamedWall>,
    /// Probability of a fall for which a study of reliability seeks the numbers of a code \[-\].
    pub target: f64,
}

/// A study as plain values, to send it to a machine without its files.
#[derive(Clone, Debug)]
pub struct Sent {
    /// Text of the study file.
    pub text: String,
    /// Walls: names, parameters as the tables of a study file, and those that decide and nobody stated.
    pub walls: Vec<(String, String, Vec<String>)>,
    /// Records.
    pub records: Vec<NamedRecord>,
}

impl LoadedStudy {
    /// Reads a study file. Scenes and records that it names are looked up beside it; `codes` answer what it
    /// asks of building codes.
    ///
    /// # Errors
    /// [`SceneError`], with file, line, value and remedy.
    pub fn read(path: &Path, codes: &dyn Codes) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = read_text(path, "a study file (TOML)", MAX_FILE_BYTES)?;
        let mut file = StudyFile::parse(&name, &text, codes)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut inputs, mut warnings) = (vec![path.to_owned()], Vec::new());
        let mut all = Vec::with_capacity(file.walls.len());
        for (place, entry) in std::mem::take(&mut file.walls).into_iter().enumerate() {
            let found = walls(entry, folder, &name, &mut inputs, &mut warnings)?;
            all.extend(found.into_iter().map(|wall| NamedWall { entry: place, ..wall }));
        }
        let files = record_files(&file.records, folder, &name)?;
        let mut of_records = Vec::new();
        let records = all_records(&file.records, &files, folder, &name, &mut of_records)?;
        warnings.extend(of_records.iter().map(ToString::to_string));
        inputs.extend(record_inputs(&file.records, files, folder));
        warnings.extend(open_hazard(&mut file, folder, &mut inputs)?);
        let compare = file.compare.take();
        let study = Self::assemble(&name, text, file, all, records)?;
        let study = study.comparing(compare, &name, folder, &mut inputs)?;
        warnings.extend(study.study.warning().map(|warning| format!("{name}, levels: {warning}")));
        Ok(Self { inputs, warnings: [study.warnings, warnings].concat(), ..study })
    }

    /// Makes a study of walls and records that no file names, and of the other keys of a study file.
    ///
    /// # Errors
    /// [`SceneError`] of a key, or where walls, records and models do not go together.
    pub fn of_parts(
        text: String,
        walls: Vec<NamedWall>,
        records: Vec<NamedRecord>,
        codes: &dyn Codes,
    ) -> Result<Self, SceneError> {
        let name = "the study";
        let mut file = StudyFile::parse(name, &text, codes)?;
        let warnings = open_hazard(&mut file, Path::new(""), &mut Vec::new())?;
        let compare = file.compare.take();
        let study = Self::assemble(name, text, file, walls, records)?;
        let study = study.comparing(compare, name, Path::new(""), &mut Vec::new())?;
        Ok(Self { warnings: [warnings, study.warnings].concat(), ..study })
    }

    /// Returns the study as plain values, with the files that its table `[check]` names.
    pub fn sent(&self, codes: &dyn Codes) -> Sent {
        let wall = |wall: &NamedWall| {
            let assumed = wall.assumed.iter().map(|&name| name.to_owned()).collect();
            (wall.name.clone(), wall_text(wall), assumed)
        };
        let name = self.inputs.first().map_or_else(String::new, |path| path.display().to_string());
        // the samples follow from the text
        let walls = if self.sampled.is_empty() { self.study.walls() } else { &self.sampled };
        Sent {
            // a grid that has vanished since is named where the text is read
            text: codes.self_contained(&name, &self.text).unwrap_or_else(|_| self.text.clone()),
            walls: walls.iter().map(wall).collect(),
            records: self.study.given_records(),
        }
    }

    /// Makes the study from plain values.
    ///
    /// # Errors
    /// [`SceneError`] if they are not those of [`Self::sent`].
    pub fn received(sent: Sent, codes: &dyn Codes) -> Result<Self, SceneError> {
        let name = "a study that was sent";
        let file = StudyFile::parse(name, &sent.text, codes)?;
        let wall = |(name, text, unstated): (String, String, Vec<String>)| {
            let assumed = assumed(|_, name| unstated.iter().all(|other| other != name));
            Ok::<_, SceneError>(NamedWall { assumed, ..wall_of_text(name, &text)? })
        };
        let walls = sent.walls.into_iter().map(wall).collect::<Result<_, _>>()?;
        // they were told where it was sent
        let study = Self::assemble(name, sent.text, file, walls, sent.records)?;
        Ok(Self { warnings: Vec::new(), ..study })
    }

    /// Takes the records in the measures that the study compares, for its report.
    fn comparing(
        self,
        entry: Option<CompareEntry>,
        name: &str,
        folder: &Path,
        inputs: &mut Vec<PathBuf>,
    ) -> Result<Self, FileError> {
        let Some(entry) = entry else { return Ok(self) };
        let (compared, told) = entry.open(&self.study, &Place::new(name, &self.text), folder, inputs)?;
        let report = ReportOptions { compared: Some(compared), ..self.report };
        Ok(Self { report, warnings: [self.warnings, told].concat(), ..self })
    }

    fn assemble(
        name: &str,
        text: String,
        mut file: StudyFile,
        given: Vec<NamedWall>,
        records: Vec<NamedRecord>,
    ) -> Result<Self, FileError> {
        let in_file = |reason: String| FileError::whole(name, reason);
        for class in &file.report.classes {
            class.check(given.iter().map(|wall| wall.name.as_str())).map_err(in_file)?;
        }
        check_unique("walls", given.iter().map(|wall| &wall.name)).map_err(in_file)?;
        let mut warnings = Vec::new();
        let (walls, sampled) = match file.uncertain.take() {
            Some((uncertain, told)) => {
                warnings.extend(told.iter().map(|warning| format!("{name}: {warning}")));
                (sampled(&uncertain, &given, &mut file.report).map_err(in_file)?, given)
            }
            None => (given, Vec::new()),
        };
        // of samples the first of each wall
        let every = walls.len().checked_div(sampled.len()).unwrap_or(1).max(1);
        warnings.extend(defaults(name, walls.iter().step_by(every)));
        warn(walls.iter().step_by(every), &file.models, &file.measure, &mut warnings);
        let StudyFile { title, models, measure, select, levels, mut report, target, .. } = file;
        let records = match select {
            Some(count) => best(records, count, &measure).map_err(in_file)?,
            None => records,
        };
        let study = Study::new(walls, records, models, measure, levels)
            .and_then(|study| study.with_tail(file.tail))
            .map(|study| study.with_collapse(file.collapse).with_polarity(file.polarity))
            .and_then(|study| study.with_scaled(file.scaled))
            .map_err(|error| in_file(error.to_string()))?;
        let weights: Vec<_> = study.records().iter().map(|record| record.listed.weight).collect();
        report.weights = Weights::of(&weights);
        check_unique("records", study.records().iter().map(|record| &record.name)).map_err(in_file)?;
        warnings.extend(alike(&study));
        warnings.extend(study.unlike_stripes());
        let given = study.given_records();
        warnings.extend(copies(&given));
        let effective = report.weights.effective(study.records().len()) / study.polarity().signs() as f64;
        let few = format!(
            "{}{}: studentised intervals need {FEWEST_RECORDS}; those of θ, β and what follows from them are \
             not determined",
            counted(given.len(), "record"),
            if report.weights.are_equal() { String::new() } else { format!(", by weights {effective:.1}") }
        );
        // one record has no dispersion to bound
        warnings.extend((given.len() > 1 && effective < FEWEST_RECORDS as f64).then_some(few));
        Ok(Self { title, study, report, inputs: Vec::new(), warnings, text, target, sampled })
    }
}

/// Makes the samples of the uncertain parameters of walls: the samples of a wall are the walls of its
/// classes, and a class of its name.
fn sampled(
    uncertain: &Uncertain,
    walls: &[NamedWall],
    report: &mut ReportOptions,
) -> Result<Vec<NamedWall>, String> {
    let count = walls.len() * uncertain.samples;
    if count > MOST_WALLS {
        return Err(format!(
            "[uncertain] samples = {} of {} are {count} walls; at most {MOST_WALLS} are taken",
            uncertain.samples,
            counted(walls.len(), "wall")
        ));
    }
    let samples = uncertain.samples(walls)?;
    let of_wall = |NamedWall { name, .. }: &NamedWall| WallClass {
        name: name.clone(),
        walls: vec![name.clone()],
        weights: Vec::new(),
    };
    report.classes.extend(walls.iter().map(of_wall));
    report.classes.iter_mut().for_each(|class| *class = class.of_samples(&samples));
    let all = samples.of_walls(walls).map_err(|error| error.to_string())?;
    let names = all.iter().map(|wall| &wall.name).chain(report.classes.iter().map(|class| &class.name));
    check_unique("samples and classes", names)?;
    report.samples = Some(samples);
    Ok(all)
}

/// Returns the `count` records whose spectra fit that of the site best, in their order; of two that fit alike
/// the first.
fn best(
    records: Vec<NamedRecord>,
    count: usize,
    measure: &IntensityMeasure,
) -> Result<Vec<NamedRecord>, String> {
    if !(1..=records.len()).contains(&count) {
        let found = counted(records.len(), "record");
        return Err(format!("[intensity] select = {count}: found {found}; select from 1 to that many"));
    }
    let rms = |record: &NamedRecord| {
        let ratios = measure.ratios(&record.motion);
        let named = |error: GroundMotionError| format!("record {:?}: {error}", record.name);
        Ok::<_, String>(Misfit::of(&ratios.map_err(named)?.unwrap_or_default()).rms)
    };
    let misfits = records.iter().map(rms).collect::<Result<Vec<_>, _>>()?;
    let mut order: Vec<usize> = (0..records.len()).collect();
    order.sort_by(|&a, &b| misfits[a].total_cmp(&misfits[b]));
    order.truncate(count);
    let chosen = records.into_iter().enumerate().filter(|(index, _)| order.contains(index));
    Ok(chosen.map(|(_, record)| record).collect())
}

/// Warns of signs that have no effect.
fn alike(study: &Study) -> Option<String> {
    let polarity = study.polarity();
    let is_alike = |wall: usize| study.wall(wall, 0).has_equal_sides();
    (polarity != Polarity::AsRecorded && (0..study.walls().len()).all(is_alike)).then(|| {
        let word = polarity.name();
        format!("polarity = {word:?}: both sides of every wall are alike, so that both signs give the same")
    })
}

/// Opens the hazard of a study for its report, and returns what is to be known of it.
fn open_hazard(
    file: &mut StudyFile,
    folder: &Path,
    inputs: &mut Vec<PathBuf>,
) -> Result<Vec<String>, FileError> {
    let Some(entry) = file.hazard.take() else { return Ok(Vec::new()) };
    let (hazard, warnings) = entry.open(&file.measure, folder, inputs)?;
    file.report.hazard = Some(hazard);
    Ok(warnings)
}

/// Returns the parameters of a wall that are set and have no effect with any of the models.
fn unused(parameters: &Parameters, models: &[Model]) -> Vec<Warning> {
    let of_model = |model: &Model| {
        let wall = Wall::new(&model.applied_to(parameters).ok()?).ok()?;
        Some(wall.warnings().iter().filter(|w| matches!(w, Warning::NoEffect { .. })).cloned().collect())
    };
    let common =
        |left: Vec<Warning>, right: Vec<Warning>| left.into_iter().filter(|w| right.contains(w)).collect();
    models.iter().filter_map(of_model).reduce(common).unwrap_or_default()
}

/// Adds the warnings of each wall, by its name: improbable numbers, parameters without effect. Then those of
/// the intensity measure and the models.
fn warn<'a>(
    walls: impl Iterator<Item = &'a NamedWall>,
    models: &[Model],
    measure: &IntensityMeasure,
    warnings: &mut Vec<String>,
) {
    for NamedWall { name, parameters, floors, .. } in walls {
        let made = Wall::new(parameters).ok();
        let about_work =
            made.iter().flat_map(Wall::warnings).filter(|warning| warning.is_about_work()).cloned();
        let found = unused(parameters, models).into_iter().chain(about_work).chain(parameters.unusual());
        let of_floors = floors.as_ref().zip(made.as_ref());
        let of_floors = of_floors.into_iter().flat_map(|(floors, wall)| floors.warnings(wall));
        let all = found.map(|warning| warning.to_string()).chain(of_floors);
        warnings.extend(all.map(|warning| format!("wall {name:?}: {warning}")));
    }
    let unusual = measure
        .periods()
        .iter()
        .filter_map(|period| Usual::period("period of the intensity").warning(*period));
    warnings.extend(unusual.map(|warning| warning.to_string()));
    for model in models {
        warnings.extend(model.unusual().map(|warning| format!("model {:?}: {warning}", model.name)));
    }
}
