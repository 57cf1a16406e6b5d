//! All results of a complete folder, made wall by wall: memory does not grow with the runs.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::fmt::Write as _;
use std::path::PathBuf;

use crate::ida::{Curve, Exceedance};
use crate::results::{Fitting, WallResults};
use crate::tables::{Names, Table};
use ground_motion::STANDARD_GRAVITY;
use report::counted;
use run::parallel;

use super::comparison::Comparison;
use super::contents::{Contents, Manifest};
use super::error::FolderError;
use super::file::{self, Draft};
use super::legend;
use super::page;
use super::plots::{SIZE, panel};
use super::population::Population;
use super::risk::Risk;
use super::store::Folder;
use super::tables::{names, tables, write};

/// Most walls that the page and the summary show one by one.
const MOST_WALLS: usize = 40;
/// Walls that each thread fits before their rows are written.
const WALLS_AT_ONCE: usize = 4;
/// Most fits that a warning names.
const NAMED: usize = 3;

/// What was made of a complete study.
#[derive(Clone, Debug)]
pub struct Report {
    /// The collapse of every wall and model, or of a large study its fractiles, as a table.
    pub summary: String,
    /// Warnings about the fits.
    pub warning: Option<String>,
    /// Files written.
    pub files: Vec<PathBuf>,
}

/// Writes the tables and the page of a folder whose parts are complete, on `threads` threads. `done` is
/// called for each wall.
///
/// # Errors
/// [`FolderError`] if parts are missing, or a file cannot be written.
pub fn finish(folder: &Folder, threads: usize, done: impl Fn() + Sync) -> Result<Report, FolderError> {
    let (manifest, contents) = (folder.manifest(), folder.contents());
    let runs = survey(folder)?;
    folder.sweep();
    let models: Vec<_> = contents.models.iter().map(|model| model.name.as_str()).collect();
    let grid = contents.grid.clone();
    let fitting = Fitting::new(contents.records.len(), &models, grid, &manifest.report);
    let mut output = Output::new(folder, runs)?;
    let mut curves = Curves { folder, part: 0, read: VecDeque::new() };
    let of_wall = models.len() * contents.records.len();
    for start in (0..contents.walls.len()).step_by(threads * WALLS_AT_ONCE) {
        let end = (start + threads * WALLS_AT_ONCE).min(contents.walls.len());
        let walls = (start..end).map(|_| curves.next_curves(of_wall)).collect::<Result<Vec<_>, _>>()?;
        let fitted = parallel::map(walls.len(), threads, |place| {
            let results = fitting.results(walls[place].clone());
            done();
            Ok::<_, Infallible>(results)
        });
        let Ok(fitted) = fitted;
        for (wall, results) in (start..end).zip(&fitted) {
            output.add(wall, results)?;
        }
    }
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
    if missing.is_empty() { Ok(runs) } else { Err(folder.incomplete(&missing)) }
}

/// The curves of a folder in the order of their numbers.
struct Curves<'a> {
    folder: &'a Folder,
    /// The next part to read.
    part: usize,
    read: VecDeque<Curve>,
}

impl Curves<'_> {
    /// Returns the next `count` curves, and reads as many parts as this takes.
    fn next_curves(&mut self, count: usize) -> Result<Vec<Curve>, FolderError> {
        while self.read.len() < count {
            let curves = self.folder.part(self.part);
            // it was found complete when the report began, and has been removed or damaged since
            self.read.extend(curves.ok_or_else(|| self.folder.incomplete(&[self.part]))?);
            self.part += 1;
        }
        Ok(self.read.drain(..count).collect())
    }
}

/// The results under construction.
struct Output<'a> {
    folder: &'a Folder,
    runs: usize,
    tables: Vec<(Table, Draft)>,
    names: Names<'a>,
    risk: Risk<'a>,
    sections: String,
    comparison: Comparison,
    panels: Vec<(String, String)>,
    population: Population,
    rows: String,
    contradictions: Vec<String>,
    contradicted: usize,
    resurrected: usize,
}

impl<'a> Output<'a> {
    fn new(folder: &'a Folder, runs: usize) -> Result<Self, FolderError> {
        let draft = |table: Table| {
            let path = folder.path().join(format!("{}.csv", table.name));
            let draft = Draft::new(&path, format!("{}\n", table.columns).as_bytes())?;
            Ok::<_, FolderError>((table, draft))
        };
        Ok(Self {
            folder,
            runs,
            tables: tables(folder.contents()).into_iter().map(draft).collect::<Result<_, _>>()?,
            names: names(folder.manifest()),
            risk: Risk::new(folder.path(), folder.manifest())?,
            sections: String::new(),
            comparison: Comparison::default(),
            panels: Vec::new(),
            population: Population::new(folder.manifest()),
            rows: String::new(),
            contradictions: Vec::new(),
            contradicted: 0,
            resurrected: 0,
        })
    }

    /// Adds the results of a wall.
    fn add(&mut self, wall: usize, results: &WallResults) -> Result<(), FolderError> {
        let manifest = self.folder.manifest();
        for (table, draft) in &mut self.tables {
            draft.write(|file| write(file, table, &self.names, wall, results))?;
        }
        self.risk.add(wall, results)?;
        if manifest.contents.walls.len() <= MOST_WALLS {
            self.sections.push_str(&page::section(manifest, wall, results, self.runs));
            self.comparison.add(manifest, results);
            self.panels.extend(panel(manifest, wall, results));
            self.rows.push_str(&rows(manifest, wall, results));
        } else {
            self.population.add(results);
        }
        for model in (0..manifest.contents.models.len()).filter(|&model| results.is_contradicted(model)) {
            self.contradicted += 1;
            if self.contradictions.len() < NAMED {
                self.contradictions.push(contradiction(manifest, wall, model, results));
            }
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
        let (summary, warning) = (self.summary(manifest, is_large), self.warning(&manifest.contents));
        let (mut files, about_risk) = self.risk.finish()?;
        for (_, draft) in self.tables {
            files.push(draft.commit(true)?);
        }
        let path = self.folder.path().join("fragilities.svg");
        if self.panels.is_empty() {
            // one that an earlier report has left
            file::remove(&path)?;
        } else {
            let title = format!("{}: collapse fragilities", manifest.title);
            let sheet = legend::file(manifest, &title, &self.panels, SIZE);
            file::to_file(&path, sheet.as_bytes())?;
            files.push(path);
        }
        let path = self.folder.path().join("study.html");
        file::to_file(&path, page::page(manifest, self.runs, &self.sections).as_bytes())?;
        files.push(path);
        Ok(Report { summary: summary + &about_risk, warning, files })
    }

    fn summary(&self, manifest: &Manifest, is_large: bool) -> String {
        let (contents, report) = (&manifest.contents, &manifest.report);
        let Some(collapse) = report.fractions.iter().position(|fraction| *fraction == 1.0) else {
            return String::new();
        };
        let mut text = format!(
            "{}; collapse {} in g, 95 % intervals of {} resamples of {}\n",
            counted(self.runs, "run"),
            contents.measure,
            report.resamples,
            counted(contents.records.len(), "record")
        );
        if is_large {
            text.push_str(&self.population.text(manifest, collapse));
        } else {
            let [wall_width, model_width] = widths(contents);
            let _ = writeln!(
                text,
                "{:<wall_width$}{:<model_width$}{:>12}{:>26}{:>14}{:>7}{:>10}{:>36}",
                "wall",
                "model",
                "median",
                "",
                "theta",
                "beta",
                "censored",
                format!("median/{}", report.reference)
            );
            text.push_str(&self.rows);
        }
        if self.resurrected > 0 {
            let _ = writeln!(
                text,
                "{} of {} stand again above their first overturning, which counts as the collapse",
                self.resurrected,
                counted(contents.count(), "curve")
            );
        }
        text
    }

    /// Warns of walls and models whose limit states contradict a common β.
    fn warning(&self, contents: &Contents) -> Option<String> {
        let more = if self.contradicted > NAMED { " …" } else { "" };
        (self.contradicted > 0).then(|| {
            format!(
                "limit states contradict a common beta in {} of {} fits: {}{more}; their fitted curves are \
                 rough, see the steps on the page and beta_alone in fragilities.csv",
                self.contradicted,
                contents.walls.len() * contents.models.len(),
                self.contradictions.join(", ")
            )
        })
    }
}

/// Returns the widths of the columns of names.
fn widths(contents: &Contents) -> [usize; 2] {
    let width = |names: &mut dyn Iterator<Item = &String>| {
        names.map(|name| name.chars().count()).max().unwrap_or(0).max("model".len()) + 2
    };
    let walls = width(&mut contents.walls.iter().map(|wall| &wall.name));
    [walls, width(&mut contents.models.iter().map(|model| &model.name))]
}

/// Writes the rows of a wall in the summary.
fn rows(manifest: &Manifest, wall: usize, results: &WallResults) -> String {
    let (contents, mut text) = (&manifest.contents, String::new());
    let Some(collapse) = manifest.report.fractions.iter().position(|fraction| *fraction == 1.0) else {
        return text;
    };
    let [wall_width, model_width] = widths(contents);
    for (model, summary) in contents.models.iter().zip(results.summaries(collapse)) {
        let beta = summary.fitted.map_or("–".to_owned(), |fit| format!("{:.3}", fit.dispersion));
        let [median, low, high] = summary.median.texts(STANDARD_GRAVITY, Some(3));
        let [theta, ..] = summary.theta.texts(STANDARD_GRAVITY, Some(3));
        let [ratio, ratio_low, ratio_high] = summary.median_ratio.texts(1.0, Some(3));
        let _ = writeln!(
            text,
            "{:<wall_width$}{:<model_width$}  {median:>10}  {:>24}  {theta:>12}{beta:>7}{:>10}{:>36}",
            contents.walls[wall].name,
            model.name,
            format!("{low} … {high}"),
            summary.censored,
            format!("{ratio} ({ratio_low} … {ratio_high})")
        );
    }
    text
}

/// Names a wall and model whose limit states contradict a common β, with the β of each.
fn contradiction(manifest: &Manifest, wall: usize, model: usize, results: &WallResults) -> String {
    let states = manifest.report.fractions.len();
    let alone = (0..states).filter_map(|state| results.summaries(state)[model].alone.ok());
    let alone: Vec<_> = alone.map(|fit| format!("{:.2}", fit.dispersion)).collect();
    let (wall, model) = (&manifest.contents.walls[wall].name, &manifest.contents.models[model].name);
    format!("wall {wall:?} with {model} ({})", alone.join(", "))
}
