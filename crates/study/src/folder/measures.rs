//! Which intensity measure to choose: `measures.csv`, and what the page and the terminal show of it.

use std::fmt::Write as _;
use std::path::Path;

use crate::measures::{CollapseOf, Compared, Fit, Shown};
use crate::results::WallResults;
use report::escaped;
use report::palette::sign;
use report::table::{Digits, Table};
use run::file;

use super::contents::Manifest;
use super::error::FolderError;
use super::finished::Finished;
use super::legend::looks;
use super::subject::MOST_WALLS;

/// Height of the lane of a model \[px\].
const LANE: usize = 13;
/// Round steps of the axis, about this many along it.
const STEPS: f64 = 6.0;
/// What stands for the name of a wall where all are taken together.
const ALL: &str = "all walls";

/// What the runs show of the measures, wall by wall.
pub(crate) struct Measures<'a> {
    manifest: &'a Manifest,
    compared: &'a Compared,
    rows: Vec<Row>,
    /// All walls together, models outermost, measures innermost.
    together: Vec<Shown>,
}

/// A wall or all together, with a model, in a measure.
struct Row {
    /// `None` of all walls together.
    wall: Option<usize>,
    model: usize,
    measure: usize,
    shown: Shown,
    collapses: Fit,
    demands: Fit,
}

impl<'a> Measures<'a> {
    /// Begins; `None` for a study that compares none.
    pub(crate) fn new(manifest: &'a Manifest) -> Option<Self> {
        let compared = manifest.report.compared.as_ref()?;
        let together = vec![Shown::default(); manifest.contents.models.len() * compared.measures.len()];
        Some(Self { manifest, compared, rows: Vec::new(), together })
    }

    /// Adds a wall.
    pub(crate) fn add(&mut self, wall: usize, results: &WallResults) {
        let Manifest { contents, report, .. } = self.manifest;
        let collapse = CollapseOf { crossing: report.collapse, at_levels: contents.grid.is_some() };
        for model in 0..contents.models.len() {
            for (measure, shown) in
                self.compared.shown(results.curves(model), &report.weights, collapse).into_iter().enumerate()
            {
                self.together[model * self.compared.measures.len() + measure].add(&shown);
                self.rows.push(Row::of(Some(wall), model, measure, shown));
            }
        }
    }

    /// Writes the file.
    pub(crate) fn finish(mut self, folder: &Path) -> Result<Finished, FolderError> {
        let count = self.compared.measures.len();
        let is_one = self.manifest.contents.walls.len() == 1;
        let own = self.rows.len();
        for (place, shown) in std::mem::take(&mut self.together).into_iter().enumerate() {
            self.rows.extend((!is_one).then(|| Row::of(None, place / count, place % count, shown)));
        }
        let path = folder.join("measures.csv");
        file::to_file(&path, self.table(&self.rows).csv().as_bytes())?;
        let (walls, together) = self.rows.split_at(if is_one { 0 } else { own });
        let table = self.table(together);
        let words = self.words();
        let mut html = format!(
            "<section><h2>Which intensity measure?</h2><p class=\"subtitle\">{}</p>{}{}",
            escaped(&words.join(". ")),
            self.dots(together),
            table.html()
        );
        if (1..=MOST_WALLS).contains(&self.manifest.contents.walls.len()) && !is_one {
            let table = self.table(walls).html();
            let _ = write!(html, "<details><summary>Wall by wall</summary>{table}</details>");
        }
        html.push_str("</section>\n");
        let words = format!("intensity measures: {}\n{}", words.join("\n"), table.text());
        Ok(Finished { files: vec![path], words, html })
    }

    /// Explains the numbers, in lines for the terminal.
    fn words(&self) -> [String; 3] {
        let names: Vec<_> = self.compared.features.iter().map(|feature| feature.name.as_str()).collect();
        let squares = self.compared.measures.iter().any(|measure| measure.name == "Arias");
        [
            "σ of ln θ at collapse, without censored records; b and σ of ln D = a + b ln IM over runs that \
             stand, D = u_max/u_ins"
                .to_owned(),
            format!(
                "p: of the slope of ln θ, and of the residuals of ln D, over {}; a small p says that the \
                 measure is not sufficient",
                names.join(", ")
            ),
            format!(
                "p of ln D is too small where a record has several runs, which are not independent{}",
                if squares { "; halve σ of ln θ by Arias, a square, to compare it" } else { "" }
            ),
        ]
    }

    /// The numbers of some rows.
    fn table(&self, rows: &[Row]) -> Table {
        let (contents, compared) = (&self.manifest.contents, self.compared);
        let (three, count) = (Digits::Decimals(3), Digits::AtMost(6));
        let wall = |row: &&Row| row.wall.map_or(ALL.to_owned(), |wall| contents.walls[wall].name.clone());
        let mut table = Table::over(rows)
            .text("wall", "wall", wall)
            .value("walls", |row| row.wall.map_or(contents.walls.len(), |_| 1))
            .text("model", "model", |row| contents.models[row.model].name.clone())
            .text("measure", "measure", |row| compared.measures[row.measure].name.clone())
            .text("unit", "", |row| compared.measures[row.measure].unit.name())
            .number("records", "records", count, |row| row.shown.records)
            .number("censored", "censored", count, |row| row.shown.censored)
            .number("sigma_ln_theta", "σ\nln θ", three, |row| row.collapses.deviation);
        for (place, feature) in compared.features.iter().enumerate() {
            let name = &feature.name;
            table = table.number(format!("p_theta_{name}"), format!("p θ\n{name}"), three, move |row| {
                row.collapses.p_values.get(place).copied().flatten()
            });
        }
        table = table
            .number("runs", "runs", count, |row| row.demands.points)
            .value("left_out", |row| row.shown.left_out)
            .value("a", |row| row.demands.intercept)
            .number("b", "b", three, |row| row.demands.slope)
            .number("sigma_ln_d", "σ\nln D", three, |row| row.demands.deviation)
            .number("proficiency", "σ/b", three, |row| row.proficiency());
        for (place, feature) in compared.features.iter().enumerate() {
            let name = &feature.name;
            table = table.number(format!("p_d_{name}"), format!("p D\n{name}"), three, move |row| {
                row.demands.p_values.get(place).copied().flatten()
            });
        }
        table.done()
    }

    /// Draws σ of ln θ, or where no collapse is known that of ln D, as a mark of each model.
    fn dots(&self, rows: &[Row]) -> String {
        let is_collapse = rows.iter().any(|row| row.collapses.deviation.is_some());
        let drawn = |row: &Row| if is_collapse { row.collapses.deviation } else { row.demands.deviation };
        let end = 1.06 * rows.iter().filter_map(drawn).fold(1e-6, f64::max);
        let ticks = report::ticks([0.0, end], STEPS);
        let step = 100.0 * ticks.get(1).map_or(end, |tick| tick.0) / end;
        let looks = looks(self.manifest);
        let mut html = format!(
            "<h3>σ of {}</h3><div class=\"forest\" style=\"--step:{step:.3}%;--high:{}px\">",
            if is_collapse { "ln θ at collapse" } else { "ln D" },
            LANE * looks.len()
        );
        for (measure, compared) in self.compared.measures.iter().enumerate() {
            let _ = write!(html, "<span>{}</span><div class=\"track\">", escaped(&compared.name));
            for row in rows.iter().filter(|row| row.measure == measure) {
                let Some(deviation) = drawn(row) else { continue };
                let (color, mark) = looks[row.model];
                let _ = write!(
                    html,
                    "<div style=\"top:{}px\" title=\"{}: {deviation:.3}\">\
                     <span style=\"left:{:.2}%\">{}</span></div>",
                    LANE * row.model,
                    escaped(&self.manifest.contents.models[row.model].name),
                    100.0 * deviation / end,
                    sign(color, mark)
                );
            }
            html.push_str("</div>\n");
        }
        html.push_str("<span></span><div class=\"axis\">");
        for (tick, text) in ticks {
            let _ = write!(html, "<small style=\"left:{:.2}%\">{text}</small>", 100.0 * tick / end);
        }
        html + "</div></div>\n"
    }
}

impl Row {
    fn of(wall: Option<usize>, model: usize, measure: usize, shown: Shown) -> Self {
        let (collapses, demands) = (shown.collapses(), shown.demands());
        Self { wall, model, measure, shown, collapses, demands }
    }

    /// σ/b of ln D, where D rises with the measure.
    fn proficiency(&self) -> Option<f64> {
        let slope = self.demands.slope.filter(|slope| *slope > 0.0)?;
        Some(self.demands.deviation? / slope)
    }
}
