//! What the page and the terminal show of walls and classes: a table, and a plot of each, classes first.

use std::fmt::Write as _;

use report::plot::Axis;
use report::points::Points;
use report::table::Table;
use report::{counted, escaped};

use super::contents::Manifest;
use super::legend::looks;
use super::plots::{marked_line, probabilities};
use super::subject::Subject;

/// Most plots of a page.
const MOST_PLOTS: usize = 12;

/// Rows and plots of classes, and of walls.
pub(crate) struct Shown<'a> {
    manifest: &'a Manifest,
    /// The name of the ordinate of the plots.
    label: &'static str,
    tables: [Table; 2],
    figures: [Vec<String>; 2],
}

impl<'a> Shown<'a> {
    pub(crate) fn new(manifest: &'a Manifest, label: &'static str) -> Self {
        Self { manifest, label, tables: Default::default(), figures: Default::default() }
    }

    /// Adds a subject: its rows, and a plot between two intensities with a line for each model that has one.
    pub(crate) fn add(&mut self, subject: &Subject<'_>, rows: Table, ends: [f64; 2], lines: Vec<Points>) {
        let Self { manifest, label, .. } = *self;
        let place = usize::from(subject.class.is_none());
        self.tables[0].columns = rows.columns;
        self.tables[place].rows.extend(rows.rows);
        if lines.iter().all(Vec::is_empty) {
            return;
        }
        let lines = lines.into_iter().zip(looks(manifest));
        let series = lines.flat_map(|(line, (color, mark))| marked_line(line, color, mark));
        let walls = subject.class.map_or_else(String::new, |walls| format!(", {}", counted(walls, "wall")));
        self.figures[place].push(format!(
            "<figure><figcaption>{}{walls}</figcaption>{}</figure>",
            escaped(subject.name),
            probabilities(Axis::over(&manifest.contents.axis(), ends), label, series.collect())
        ));
    }

    /// Takes the table; it has no columns if nothing was added.
    pub(crate) fn table(&mut self) -> Table {
        let [mut table, walls] = std::mem::take(&mut self.tables);
        table.rows.extend(walls.rows);
        table
    }

    /// Returns a row of plots.
    pub(crate) fn plots(&self) -> String {
        let all: Vec<_> = self.figures.iter().flatten().map(String::as_str).collect();
        let mut html = format!("<div class=\"row\">{}</div>", all[..all.len().min(MOST_PLOTS)].concat());
        if all.len() > MOST_PLOTS {
            // writing to a String cannot fail
            let _ = write!(html, "<p>These are {MOST_PLOTS} of {}, classes first.</p>", all.len());
        }
        html
    }
}
