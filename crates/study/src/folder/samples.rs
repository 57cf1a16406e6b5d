//! The samples of uncertain parameters, and which of them explains θ: `samples.csv`, `sensitivity.csv`, and a
//! section of the page.

use std::fmt::Write as _;
use std::path::Path;

use crate::results::WallResults;
use crate::uncertain::{Samples, Sensitivity, sensitivities};
use report::table::{Digits, Table};
use report::{escaped, number};
use run::file;

use super::contents::Manifest;
use super::error::FolderError;
use super::finished::Finished;
use super::legend::looks;

/// Most walls and models of which coefficients are drawn.
const MOST_DRAWN: usize = 12;

/// What the samples show, wall by wall.
pub(crate) struct Sampled<'a> {
    manifest: &'a Manifest,
    samples: &'a Samples,
    /// ln θ and β² of each wall of the study, limit state by limit state, model by model; `None` without a
    /// curve.
    logarithms: Vec<Vec<Vec<Option<[f64; 2]>>>>,
}

/// A part of the variance of ln IM at a limit state.
struct Part<'a> {
    wall: &'a str,
    model: usize,
    state: usize,
    name: String,
    variance: f64,
    total: f64,
}

/// A wall of the file with a model at a limit state: what each parameter explains, how many samples have a
/// curve, and R².
struct Row<'a> {
    wall: &'a str,
    model: usize,
    state: usize,
    parameter: &'a str,
    is_logarithmic: bool,
    found: Sensitivity,
    fitted: usize,
    explained: Option<f64>,
    /// Mean of β² and variance of ln θ over the samples.
    variances: [f64; 2],
}

impl<'a> Sampled<'a> {
    /// Begins; `None` for a study without uncertain parameters.
    pub(crate) fn new(manifest: &'a Manifest) -> Option<Self> {
        let samples = manifest.report.samples.as_ref()?;
        Some(Self { manifest, samples, logarithms: Vec::new() })
    }

    /// Adds the next wall.
    pub(crate) fn add(&mut self, results: &WallResults) {
        let states = 0..self.manifest.report.fractions.len();
        let logarithm = |summary: &fragility::Summary| {
            summary.fitted.ok().map(|curve| [libm::log(curve.median), curve.dispersion.powi(2)])
        };
        let of_state = |state| results.summaries(state).map(logarithm).collect();
        self.logarithms.push(states.map(of_state).collect());
    }

    /// Writes the files.
    pub(crate) fn finish(self, folder: &Path) -> Result<Finished, FolderError> {
        let rows = self.rows();
        let [samples, sensitivity, variance] =
            ["samples.csv", "sensitivity.csv", "variance.csv"].map(|name| folder.join(name));
        let parts = self.parts(&rows);
        file::to_file(&variance, self.variance(&parts).csv().as_bytes())?;
        file::to_file(&samples, self.table().csv().as_bytes())?;
        file::to_file(&sensitivity, self.sensitivity(&rows).csv().as_bytes())?;
        let last = self.manifest.report.rising().pop();
        let shown: Vec<_> = parts.into_iter().filter(|part| Some(part.state) == last).collect();
        let variances = self.variance(&shown).html();
        let html = self.section(&rows)
            + "<section><h3>Parts of the variance of ln IM</h3><p>records: mean β² of the samples. \
               Parameters: their parts of the variance of ln θ (Pratt 1987).</p>"
            + &variances
            + "</section>\n";
        Ok(Finished { files: vec![samples, sensitivity, variance], words: String::new(), html })
    }

    /// Splits the variance of ln IM of each wall, model and limit state: E β² of the records, Var ln θ by the
    /// parameters and what their regression leaves, and β² of modelling.
    fn parts(&self, rows: &[Row<'a>]) -> Vec<Part<'a>> {
        let modelling = self.manifest.report.modelling_uncertainty.powi(2);
        let of_curves = |rows: &[Row<'a>]| -> Vec<Part<'a>> {
            let Row { wall, model, state, variances: [records, walls], explained, .. } = rows[0];
            let total = records + walls + modelling;
            let own =
                rows.iter().map(|row| (row.parameter.to_owned(), row.found.part.unwrap_or(0.0) * walls));
            let left = (1.0 - explained.unwrap_or(0.0)) * walls;
            let others = [("not explained by parameters", left), ("modelling", modelling), ("total", total)];
            let names = others.map(|(name, variance)| (name.to_owned(), variance));
            let all = [("records".to_owned(), records)].into_iter().chain(own).chain(names);
            all.map(|(name, variance)| Part { wall, model, state, name, variance, total }).collect()
        };
        rows.chunks(self.samples.parameters.len()).flat_map(of_curves).collect()
    }

    fn variance(&self, parts: &[Part<'_>]) -> Table {
        let Manifest { contents, report, .. } = self.manifest;
        let (four, known) = (Digits::Decimals(4), |value: f64| value.is_finite().then_some(value));
        Table::over(parts)
            .text("wall", "wall", |part| part.wall.to_owned())
            .text("model", "model", |part| contents.models[part.model].name.clone())
            .value("u_max_over_u_ins", |part| report.fractions[part.state])
            .text("part", "part", |part| part.name.clone())
            .number("variance", "variance", four, |part| known(part.variance))
            .number("share", "share", four, |part| known(part.variance / part.total))
            .number("beta", "β", four, |part| (part.variance > 0.0).then(|| part.variance.sqrt()))
            .done()
    }

    /// The value of each parameter in each wall of the study.
    fn table(&self) -> Table {
        let Samples { parameters, walls, rows, .. } = self.samples;
        let items = walls.iter().flat_map(|wall| rows.iter().enumerate().map(move |(k, row)| (wall, k, row)));
        let mut table = Table::over(items)
            .text("wall", "", |(wall, sample, _)| self.samples.name(wall, *sample))
            .text("of", "", |(wall, ..)| (*wall).clone())
            .value("sample", |(_, sample, _)| sample + 1);
        for (place, name) in parameters.iter().enumerate() {
            table = table.value(name.clone(), move |(.., row)| row[place]);
        }
        table.done()
    }

    fn rows(&self) -> Vec<Row<'a>> {
        let Samples { parameters, is_logarithmic, walls, rows } = self.samples;
        let count = rows.len();
        let mut all = Vec::new();
        for (wall, of_wall) in walls.iter().zip(self.logarithms.chunks(count)) {
            for (model, _) in self.manifest.contents.models.iter().enumerate() {
                for (state, _) in self.manifest.report.fractions.iter().enumerate() {
                    let known = |sample: &usize| Some((*sample, of_wall[*sample][state][model]?));
                    let (places, curves): (Vec<usize>, Vec<[f64; 2]>) =
                        (0..count).filter_map(|sample| known(&sample)).unzip();
                    let numbers: Vec<f64> = curves.iter().map(|[theta, _]| *theta).collect();
                    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| {
                        curves.iter().map(of).sum::<f64>() / curves.len() as f64
                    };
                    let centre = mean(&|[theta, _]| *theta);
                    let variances =
                        [mean(&|[_, square]| *square), mean(&|[theta, _]| (theta - centre).powi(2))];
                    let column = |place| places.iter().map(|&sample| rows[sample][place]).collect();
                    let columns: Vec<Vec<f64>> = (0..parameters.len()).map(column).collect();
                    let (found, explained) = sensitivities(&columns, is_logarithmic, &numbers);
                    let fitted = numbers.len();
                    let of_parameters = parameters.iter().zip(is_logarithmic).zip(found);
                    all.extend(of_parameters.map(|((parameter, &is_logarithmic), found)| Row {
                        wall,
                        model,
                        state,
                        parameter,
                        is_logarithmic,
                        found,
                        fitted,
                        explained,
                        variances,
                    }));
                }
            }
        }
        all
    }

    fn sensitivity(&self, rows: &[Row<'_>]) -> Table {
        let Manifest { contents, report, .. } = self.manifest;
        Table::over(rows)
            .text("wall", "", |row| row.wall.to_owned())
            .text("model", "", |row| contents.models[row.model].name.clone())
            .value("u_max_over_u_ins", |row| report.fractions[row.state])
            .value("samples", |_| self.samples.rows.len())
            .value("with_curve", |row| row.fitted)
            .text("parameter", "", |row| row.parameter.to_owned())
            .value("rank_correlation", |row| row.found.rank_correlation)
            .value("logarithm", |row| row.is_logarithmic)
            .value("coefficient", |row| row.found.coefficient)
            .value("standardised_coefficient", |row| row.found.standardised)
            .value("r_squared", |row| row.explained)
            .done()
    }

    /// Shows the last limit state to be exceeded.
    fn section(&self, rows: &[Row<'_>]) -> String {
        let Manifest { contents, report, .. } = self.manifest;
        let fractions = &report.fractions;
        let last = report.rising().pop().unwrap_or(0);
        let two = Digits::Decimals(2);
        let table = Table::over(rows.iter().filter(|row| row.state == last))
            .text("", "wall", |row| row.wall.to_owned())
            .text("", "model", |row| contents.models[row.model].name.clone())
            .text("", "parameter", |row| row.parameter.to_owned())
            .number("", "rank correlation", two, |row| row.found.rank_correlation)
            .text("", "taken as", |row| if row.is_logarithmic { "logarithm" } else { "itself" }.to_owned())
            .number("", "standardised coefficient", two, |row| row.found.standardised)
            .number("", "coefficient", two, |row| row.found.coefficient)
            .number("", "R²", two, |row| row.explained)
            .number("", "samples with a curve", Digits::AtMost(6), |row| row.fitted)
            .done();
        let mut html = String::new();
        let _ = writeln!(
            html,
            "<section><h2>Which parameter explains θ</h2><p class=\"subtitle\">Each wall stands for {} \
             samples of {}; samples.csv has their values. For u<sub>max</sub>/u<sub>ins</sub> = {}: \
             Spearman’s correlation of each parameter with θ, and a linear regression of ln θ on the \
             logarithms of the parameters; a parameter whose distribution reaches near 0 is taken itself. A \
             standardised coefficient is in standard deviations. Other limit states are in sensitivity.csv.\
             </p>{}{}</section>",
            self.samples.rows.len(),
            escaped(&self.samples.parameters.join(", ")),
            fractions[last],
            self.drawn(rows.iter().filter(|row| row.state == last)),
            table.html()
        );
        html
    }

    /// Draws the standardised coefficients as bars, those of a wall and model by their size.
    fn drawn<'r>(&self, rows: impl Iterator<Item = &'r Row<'r>>) -> String {
        let rows: Vec<_> = rows.filter_map(|row| Some((row, row.found.standardised?))).collect();
        let end = rows.iter().map(|(_, coefficient)| coefficient.abs()).fold(1.0, f64::max);
        let colors = looks(self.manifest);
        let mut html = String::new();
        for of_model in
            rows.chunk_by(|(a, _), (b, _)| (a.wall, a.model) == (b.wall, b.model)).take(MOST_DRAWN)
        {
            let mut sorted = of_model.to_vec();
            sorted.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
            let (first, _) = sorted[0];
            let model = &self.manifest.contents.models[first.model].name;
            let _ = write!(
                html,
                "<h3>{}, {}</h3><div class=\"forest\" style=\"--step:25%;--high:13px;\
                 margin-right:.8em\">",
                escaped(first.wall),
                escaped(model)
            );
            for (row, coefficient) in sorted {
                let width = 50.0 * coefficient.abs() / end;
                let _ = write!(
                    html,
                    "<span>{}</span><div class=\"track\"><div title=\"{coefficient:.3}\"><i class=\"chip\" \
                     style=\"left:{:.2}%;width:{width:.2}%;height:9px;top:2px;background:{}\"></i></div>\
                     </div>",
                    escaped(row.parameter),
                    if coefficient < 0.0 { 50.0 - width } else { 50.0 },
                    colors[first.model].0
                );
            }
            html.push_str("<span></span><div class=\"axis\">");
            for place in [0.0, 25.0, 50.0, 75.0, 100.0] {
                let value = end * (place / 50.0 - 1.0);
                let _ = write!(html, "<small style=\"left:{place}%\">{}</small>", number(value, 2));
            }
            html.push_str("</div></div>\n");
        }
        html
    }
}
