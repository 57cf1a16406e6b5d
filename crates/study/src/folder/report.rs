//! All results of a complete folder, made wall by wall: memory does not grow with the runs.

use std::fmt::Write as _;
use std::path::PathBuf;

use fragility::{Dispersion, Interval};
use report::counted;
use report::table::{Cell, Table};
use run::file;

use crate::ida::{Curve, Exceedance, Layout, MOST_LISTED, SENSITIVE_ABOVE};
use crate::results::WallResults;

use super::comparison::Comparison;
use super::contents::Manifest;
use super::curves::each_wall;
use super::error::FolderError;
use super::given::GIVEN;
use super::legend;
use super::measures::Measures;
use super::page;
use super::plots::{SIZE, panel};
use super::population::Population;
use super::risk::Risk;
use super::rows::Rows;
use super::samples::Sampled;
use super::store::{Folder, OPTIONAL, PAGE};
use super::subject::MOST_WALLS;
use super::tables::{CLOUD, KINDS, Kind, OF_INTENSITY, OF_RATIO, TIES, records, with_ends};

/// Most fits that a warning names.
const NAMED: usize = 3;

/// What was made of a complete study.
#[derive(Clone, Debug)]
pub struct Report {
    /// The collapse of every wall and model, or of a large study its fractiles, as a table.
    pub summary: String,
    /// Warnings about the fits and the rates.
    pub warnings: Vec<String>,
    /// Files written.
    pub files: Vec<PathBuf>,
}

/// Writes the tables and the page of a folder whose parts are complete, on `threads` threads. Counts
/// each wall as [done](run::parallel::count_done).
///
/// # Errors
/// [`FolderError`] if parts are missing, or a file cannot be written.
pub fn finish(folder: &Folder, threads: usize) -> Result<Report, FolderError> {
    let runs = survey(folder)?;
    folder.sweep();
    // an earlier report may have had what this one lacks
    OPTIONAL.iter().try_for_each(|name| file::remove(&folder.path().join(name)))?;
    let (fitting, mut output) = (folder.manifest().fitting(), Output::new(folder, runs)?);
    let fitted = |_, curves: &[Curve]| fitting.results(curves.to_vec());
    each_wall(folder, threads, fitted, |wall, results| output.add(wall, &results))?;
    output.finish()
}

/// Checks that all parts are there, and counts their runs.
fn survey(folder: &Folder) -> Result<usize, FolderError> {
    let (mut runs, mut missing) = (0, Vec::new());
    for part in 0..folder.contents().parts() {
        match folder.part(part) {
            Some(curves) => runs += curves.iter().map(|curve| curve.runs().len()).sum::<usize>(),
            None => missing.push(part),
        }
    }
    if missing.is_empty() { Ok(runs) } else { Err(folder.incomplete(&missing, &[])) }
}

/// The results under construction.
struct Output<'a> {
    folder: &'a Folder,
    runs: usize,
    tables: Vec<(Kind, Rows)>,
    risk: Risk<'a>,
    sampled: Option<Sampled<'a>>,
    measures: Option<Measures<'a>>,
    sections: String,
    comparison: Comparison,
    panels: Vec<(String, String)>,
    population: Population,
    summary: Table,
    /// Walls and models whose curves contradict a common β or cross.
    doubts: Vec<[usize; 2]>,
    /// The most by which curves cross.
    excess: f64,
    resurrected: usize,
    /// Runs that exceed `u_ins` and come back.
    come_back: usize,
    /// Collapses with a sensitivity; of these the ones above [`SENSITIVE_ABOVE`].
    sensitive: [usize; 2],
    /// Runs of walls with ties that may yield; of these the runs in which one yielded, and broke.
    tied: [usize; 3],
}

impl<'a> Output<'a> {
    fn new(folder: &'a Folder, runs: usize) -> Result<Self, FolderError> {
        let begun = |kind: Kind| {
            let path = folder.path().join(format!("{}.csv", kind.0));
            Ok::<_, FolderError>((kind, Rows::new(&path)?))
        };
        let ties = folder.contents().has_yielding_ties().then_some(&TIES);
        let cloud = (folder.contents().layout == Layout::Cloud).then_some(&CLOUD);
        let given = (!folder.manifest().report.given.is_empty()).then_some(&GIVEN);
        let kinds = if folder.contents().count() <= MOST_LISTED { &KINDS[..] } else { &KINDS[2..] };
        let kinds = kinds.iter().chain(ties).chain(cloud).chain(given).copied();
        Ok(Self {
            folder,
            runs,
            tables: kinds.map(begun).collect::<Result<_, _>>()?,
            risk: Risk::new(folder.path(), folder.manifest())?,
            sampled: Sampled::new(folder.manifest()),
            measures: Measures::new(folder.manifest()),
            sections: String::new(),
            comparison: Comparison::default(),
            panels: Vec::new(),
            population: Population::new(folder.manifest()),
            summary: Table::default(),
            doubts: Vec::new(),
            excess: 0.0,
            resurrected: 0,
            come_back: 0,
            sensitive: [0; 2],
            tied: [0; 3],
        })
    }

    /// Adds the results of a wall.
    fn add(&mut self, wall: usize, results: &WallResults) -> Result<(), FolderError> {
        let manifest = self.folder.manifest();
        for (kind, rows) in &mut self.tables {
            rows.add(&(kind.1)(manifest, wall, results))?;
        }
        self.risk.add(wall, results)?;
        self.sampled.iter_mut().for_each(|sampled| sampled.add(results));
        self.measures.iter_mut().for_each(|measures| measures.add(wall, results));
        for tie in results.all_curves().iter().flat_map(Curve::runs).filter_map(|run| run.tie) {
            self.tied[0] += 1;
            self.tied[1] += usize::from(tie.elongation > 0.0);
            self.tied[2] += usize::from(tie.broken);
        }
        if manifest.contents.walls.len() <= MOST_WALLS {
            self.sections.push_str(&page::section(manifest, wall, results, self.runs));
            let has_tie = manifest.contents.walls[wall].has_yielding_tie;
            let regression = "Regression ln(u<sub>max</sub>/u<sub>ins</sub>) = a + b ln IM";
            let before = "Fragilities of the last shock, given the largest |u|/u<sub>ins</sub> d before it";
            let tables = [
                (manifest.contents.layout == Layout::Cloud, regression, CLOUD),
                (has_tie, "Ties, up to overturning", TIES),
                (!manifest.report.given.is_empty(), before, GIVEN),
            ];
            for (_, title, (_, table)) in tables.into_iter().filter(|(is_there, ..)| *is_there) {
                let table = table(manifest, wall, results).html();
                let _ = writeln!(self.sections, "<section><h3>{title}</h3>{table}</section>");
            }
            self.comparison.add(manifest, results);
            self.panels.extend(panel(manifest, wall, results));
            self.add_to_summary(manifest, wall, results);
        } else {
            self.population.add(results);
        }
        let models = 0..manifest.contents.models.len();
        let doubted = models.filter(|model| is_doubted(manifest, *model, results));
        self.doubts.extend(doubted.map(|model| [wall, model]));
        let states = (0..manifest.report.fractions.len()).flat_map(|state| results.summaries(state));
        let crossings = states.filter_map(|summary| summary.crossing);
        self.excess = crossings.map(|crossing| crossing.excess).fold(self.excess, f64::max);
        let runs = results.all_curves().iter().flat_map(Curve::runs);
        self.come_back += runs.filter(|run| run.comes_back()).count();
        for sensitivity in results.all_curves().iter().filter_map(Curve::sensitivity) {
            self.sensitive[0] += 1;
            self.sensitive[1] += usize::from(sensitivity > SENSITIVE_ABOVE);
        }
        let stands_again =
            |curve: &&Curve| matches!(curve.collapse(), Exceedance::At(_)) && curve.resurrections() > 0;
        self.resurrected += results.all_curves().iter().filter(stands_again).count();
        Ok(())
    }

    /// Completes the files.
    fn finish(mut self) -> Result<Report, FolderError> {
        let manifest = self.folder.manifest();
        let is_large = manifest.contents.walls.len() > MOST_WALLS;
        let together =
            if is_large { self.population.sections(manifest) } else { self.comparison.section(manifest) };
        self.sections.insert_str(0, &together);
        let mut summary = self.summary(manifest, is_large);
        let warnings: Vec<_> = self.warning(manifest).into_iter().chain(self.risk.warnings()).collect();
        let risk = self.risk.finish()?;
        let mut files = risk.files;
        if let Some(sampled) = self.sampled {
            let sampled = sampled.finish(self.folder.path())?;
            files.extend(sampled.files);
            self.sections.insert_str(0, &sampled.html);
        }
        if let Some(measures) = self.measures {
            let measures = measures.finish(self.folder.path())?;
            files.extend(measures.files);
            self.sections.insert_str(0, &measures.html);
            summary.push_str(&measures.words);
        }
        self.sections.insert_str(0, &risk.html);
        if let Some(table) = records(manifest) {
            let path = self.folder.path().join("records.csv");
            file::to_file(&path, table.csv().as_bytes())?;
            files.push(path);
            let title = "Records: factors, which are in samples and intensities, and weights, of the mean 1";
            let section = format!("<details><summary>{title}</summary>{}</details>", table.html());
            let _ = writeln!(self.sections, "<section>{section}</section>");
        }
        for (_, rows) in self.tables {
            files.push(rows.commit()?);
        }
        if !self.panels.is_empty() {
            let path = self.folder.path().join("fragilities.svg");
            let title = format!("{}: collapse fragilities", manifest.title);
            let sheet = legend::file(manifest, &title, &self.panels, SIZE);
            file::to_file(&path, sheet.as_bytes())?;
            files.push(path);
        }
        let path = self.folder.path().join(PAGE);
        file::to_file(&path, page::page(manifest, self.runs, self.sensitive, &self.sections).as_bytes())?;
        files.push(path);
        Ok(Report { summary: summary + &risk.words, warnings, files })
    }

    fn summary(&self, manifest: &Manifest, is_large: bool) -> String {
        let (contents, report) = (&manifest.contents, &manifest.report);
        let Some(collapse) = collapse(manifest) else { return String::new() };
        let mut text = format!(
            "{}; collapse {} in {}, 95 % intervals {} of {} resamples of {}\n",
            counted(self.runs, "run"),
            contents.measure,
            contents.unit.name(),
            contents.interval_of_medians(),
            report.resamples,
            counted(contents.records.len(), "record")
        );
        if is_large {
            text.push_str("fractiles: so many of the walls have a lower median\n");
            text.push_str(&self.population.fractiles(manifest, &[collapse]).text());
        } else {
            text.push_str(&self.summary.text());
        }
        let [tied, yielded, broken] = self.tied;
        if tied > 0 {
            let runs = counted(tied, "run");
            let _ = writeln!(text, "ties yielded in {yielded} and broke in {broken} of {runs}; see ties.csv");
        }
        if self.come_back > 0 {
            let runs = counted(self.come_back, "run");
            let _ = writeln!(text, "{runs} exceed u_ins and come back, which is no collapse");
        }
        if self.sensitive[1] > 0 {
            let _ = writeln!(text, "{}", page::sensitive_words(self.sensitive));
        }
        if self.resurrected > 0 {
            let _ = writeln!(
                text,
                "{} of {} stand again above their first overturning; collapse in [report] says which counts",
                self.resurrected,
                counted(contents.count(), "curve")
            );
        }
        text
    }

    /// Adds the collapse of a wall to the summary.
    fn add_to_summary(&mut self, manifest: &Manifest, wall: usize, results: &WallResults) {
        let Some(collapse) = collapse(manifest) else { return };
        let unit = manifest.contents.unit;
        let estimate = |of: &Interval| Cell::Between(of.bounds(unit.size())[0]);
        let ends = |of: &Interval| {
            let [_, low, high] = of.texts(unit.size(), OF_INTENSITY);
            format!("{low} … {high}")
        };
        let table = Table::over(manifest.contents.models.iter().zip(results.summaries(collapse)))
            .text("", "wall", |_| manifest.contents.walls[wall].name.clone())
            .text("", "model", |(model, _)| model.name.clone())
            .number("", "median", OF_INTENSITY, |(_, one)| estimate(&one.median))
            .number("", "interval", OF_INTENSITY, |(_, one)| ends(&one.median))
            .number("", "theta", OF_INTENSITY, |(_, one)| estimate(&one.theta))
            .number("", "beta", OF_INTENSITY, |(_, one)| one.fitted.ok().map(|fit| fit.dispersion))
            .number("", "censored", OF_INTENSITY, |(_, one)| one.censored)
            .number("", format!("median/{}", manifest.report.reference), OF_INTENSITY, |(_, one)| {
                with_ends(&one.median_ratio, 1.0, OF_RATIO)
            })
            .done();
        self.summary.columns = table.columns;
        self.summary.rows.extend(table.rows);
    }

    /// Warns of walls and models whose limit states contradict a common β, or whose curves cross.
    fn warning(&self, manifest: &Manifest) -> Option<String> {
        let contents = &manifest.contents;
        let name = |&[wall, model]: &[usize; 2]| {
            format!("wall {:?} with {}", contents.walls[wall].name, contents.models[model].name)
        };
        let named: Vec<_> = self.doubts.iter().take(NAMED).map(name).collect();
        let more = if self.doubts.len() > NAMED { " …" } else { "" };
        let fits = contents.walls.len() * contents.models.len();
        let named = format!("{} of {fits} fits: {}{more}", self.doubts.len(), named.join(", "));
        let told = match manifest.report.beta {
            _ if contents.layout == Layout::Cloud => format!(
                "theta of the collapse is not among the runs in {named}; scale the records, or add others"
            ),
            Dispersion::Common => format!(
                "limit states contradict a common beta in {named}; their fitted curves are rough, see the \
                 steps on the page and beta_alone in fragilities.csv"
            ),
            Dispersion::Own | Dispersion::Ordered => format!(
                "curves of limit states cross by up to {:.2} of P in {named}, see crossing_excess in \
                 fragilities.csv; in [report], beta = \"ordered\" fits curves that do not cross",
                self.excess
            ),
        };
        (!self.doubts.is_empty()).then_some(told)
    }
}

/// Returns the place of the collapse among the limit states.
fn collapse(manifest: &Manifest) -> Option<usize> {
    manifest.report.fractions.iter().position(|fraction| *fraction == 1.0)
}

/// Returns whether the limit states of a model contradict a common β, or their curves cross; of a cloud,
/// whether θ of the collapse lies outside the runs, or there is no regression.
fn is_doubted(manifest: &Manifest, model: usize, results: &WallResults) -> bool {
    let Manifest { report, contents, .. } = manifest;
    if contents.layout == Layout::Cloud {
        let runs = || results.curves(model).iter().flat_map(Curve::runs).map(|run| run.intensity);
        let is_among = |theta: f64| runs().any(|x| x <= theta) && runs().any(|x| x >= theta);
        let theta = |state| results.summary(state, model).fitted.map(|curve| curve.median);
        return collapse(manifest).is_some_and(|state| !theta(state).is_ok_and(is_among));
    }
    (0..report.fractions.len()).map(|state| results.summary(state, model)).any(|one| match report.beta {
        Dispersion::Common => one.contradicted,
        Dispersion::Own | Dispersion::Ordered => one.crossing.is_some_and(|one| one.matters()),
    })
}
