//! Losses of walls and classes: `vulnerability.csv`, `vulnerability.xml`, with a hazard `losses.csv`, and
//! what the page and the terminal show of them.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::fragility::{CONFIDENCE, Interval, Lognormal, TAIL};
use crate::hazard::Hazard;
use crate::ida::IntensityUnit;
use report::escaped;
use report::many_lines::ManyLines;
use report::table::{Digits, Table};
use run::file::{self, Draft};

use super::contents::Manifest;
use super::error::FolderError;
use super::legend::looks;
use super::nrml::{self, limit_states};
use super::plots::SIZE;
use super::rates::{Fitted, between};
use super::report::MOST_WALLS;
use super::rows::Rows;

/// Names of the files.
const FILES: [&str; 3] = ["vulnerability.csv", "vulnerability.xml", "losses.csv"];
/// Intensities of a curve, equally spaced by their logarithms.
const POINTS: u32 = 41;
/// Most plots.
const MOST_PLOTS: usize = 12;

/// The files under construction.
pub(crate) struct Losses<'a> {
    manifest: &'a Manifest,
    /// Loss ratios of the limit states, which rise.
    ratios: Vec<f64>,
    curves: Rows,
    xml: Option<(Draft, nrml::Names)>,
    /// Average annual losses, of a study with a hazard.
    annual: Option<(&'a Hazard, Rows)>,
    /// Rows of the classes and of the walls that are shown.
    shown: [Table; 2],
    /// Plots of classes and of walls by names, and the lines of the one under construction, model by model.
    plots: [Vec<(String, String)>; 2],
    lines: Vec<(usize, Vec<[f64; 2]>)>,
}

/// The loss at an intensity \[g\]: its mean, its standard deviation, and the probability of each loss ratio,
/// that of none first.
struct Point {
    intensity: f64,
    mean: f64,
    deviation: f64,
    masses: Vec<f64>,
}

/// The average annual loss: its value from the points of the hazard curve, its interval and number of
/// resamples, and the most that it can be.
struct Annual {
    within: f64,
    range: [f64; 2],
    resamples: usize,
    most: f64,
}

impl<'a> Losses<'a> {
    /// Begins the files in a folder; `None` for a study without loss ratios.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest) -> Result<Option<Self>, FolderError> {
        let paths = FILES.map(|name| folder.join(name));
        let report = &manifest.report;
        // those that an earlier study has left
        let is_written = [true, nrml::measure(&manifest.contents.measure).is_some(), report.hazard.is_some()];
        for (path, is_written) in paths.iter().zip(is_written) {
            if !(is_written && report.loss_ratios.is_some()) {
                file::remove(path)?;
            }
        }
        let Some(ratios) = &report.loss_ratios else { return Ok(None) };
        let [curves, xml, annual] = paths;
        let xml = nrml::vulnerability(manifest)
            .map(|(names, text)| Ok::<_, FolderError>((Draft::new(&xml, text.as_bytes())?, names)));
        let annual = report.hazard.as_ref().map(|hazard| Ok::<_, FolderError>((hazard, Rows::new(&annual)?)));
        Ok(Some(Self {
            manifest,
            ratios: limit_states(report).into_iter().map(|(place, _)| ratios[place]).collect(),
            curves: Rows::new(&curves)?,
            xml: xml.transpose()?,
            annual: annual.transpose()?,
            shown: [const { Table { columns: Vec::new(), rows: Vec::new() } }; 2],
            plots: Default::default(),
            lines: Vec::new(),
        }))
    }

    /// Adds a wall or a class with one model; limit states rise. One without all curves has no losses.
    pub(crate) fn add(
        &mut self,
        name: &str,
        is_class: bool,
        model: usize,
        states: &[Fitted],
    ) -> Result<(), FolderError> {
        let unit = self.manifest.contents.unit;
        let curves: Option<Vec<_>> = states.iter().map(|state| state.curve).collect();
        let points = curves.map_or_else(Vec::new, |curves| points(&self.ratios, &curves, unit));
        let model_name = &self.manifest.contents.models[model].name;
        self.curves.add(&of_points(name, model_name, unit, &points))?;
        if let Some((draft, names)) = self.xml.as_mut().filter(|_| !points.is_empty()) {
            let id = names.id(name, model_name);
            let function = self.manifest.function(&id, &self.ratios, &points);
            draft.write(|file| file.write_all(function.as_bytes()))?;
        }
        let mut rows = Vec::new();
        if let Some((hazard, file)) = &mut self.annual {
            rows.extend(annual(hazard, &self.ratios, states));
            file.add(&of_year(name, model_name, &rows))?;
        }
        if is_class || self.manifest.contents.walls.len() <= MOST_WALLS {
            let table = shown(name, model_name, &rows);
            self.shown[0].columns = table.columns;
            self.shown[usize::from(!is_class)].rows.extend(table.rows);
            self.draw(name, is_class, model, &points);
        }
        Ok(())
    }

    /// Adds a curve to the plot of a wall or class.
    fn draw(&mut self, name: &str, is_class: bool, model: usize, points: &[Point]) {
        let line: Vec<_> = points.iter().map(|point| [point.intensity, point.mean]).collect();
        self.lines.push((model, line));
        if model + 1 < self.manifest.contents.models.len() {
            return;
        }
        let lines: Vec<_> = self.lines.drain(..).filter(|(_, line)| !line.is_empty()).collect();
        let ends = lines.iter().flat_map(|(_, line)| [line[0][0], line[line.len() - 1][0]]);
        let ends = ends.fold([f64::INFINITY, 0.0], |[low, high], x| [low.min(x), high.max(x)]);
        if lines.is_empty() {
            return;
        }
        let mut plot = ManyLines::new(SIZE, ends, [0.0, 1.0]);
        let looks = looks(self.manifest);
        for (model, line) in lines {
            plot.line(&line, "fit", looks[model].0);
        }
        let axis = self.manifest.contents.axis();
        let svg = plot.svg([&axis, "mean loss ratio"]);
        self.plots[usize::from(!is_class)].push((name.to_owned(), svg));
    }

    /// Completes the files; returns their paths, what is to be said, and the section of the page.
    pub(crate) fn finish(self) -> Result<(Vec<PathBuf>, String, String), FolderError> {
        let Self { curves, xml, annual, shown: [mut shown, walls], plots, .. } = self;
        shown.rows.extend(walls.rows);
        let mut paths = vec![curves.commit()?];
        if let Some((mut draft, _)) = xml {
            draft.write(|file| file.write_all(nrml::VULNERABILITY_END.as_bytes()))?;
            paths.push(draft.commit(true)?);
        }
        let has_hazard = annual.is_some();
        if let Some((_, file)) = annual {
            paths.push(file.commit()?);
        }
        let (mut told, mut html) = (String::new(), "<section><h2>Losses</h2>".to_owned());
        if has_hazard && !shown.rows.is_empty() {
            let words = format!(
                "average annual loss, of the value of the wall, with {:.0} % intervals of the records; \"at \
                 most\" adds what may lie outside the hazard curve",
                100.0 * CONFIDENCE
            );
            told = format!("{words}\n{}", shown.text());
            let _ = write!(
                html,
                "<p class=\"subtitle\">{words}.</p><div class=\"scroll\">{}</div>",
                shown.html()
            );
        }
        html.push_str("<h3>Mean loss ratio by intensity</h3><div class=\"row\">");
        let all = plots.iter().map(Vec::len).sum::<usize>();
        for (name, svg) in plots.iter().flatten().take(MOST_PLOTS) {
            let _ = write!(html, "<figure><figcaption>{}</figcaption>{svg}</figure>", escaped(name));
        }
        html.push_str("</div>");
        if all > MOST_PLOTS {
            let [file, ..] = FILES;
            let _ = write!(html, "<p>These are {MOST_PLOTS} of {all}, classes first; {file} has all.</p>");
        }
        html.push_str("</section>\n");
        Ok((paths, told, html))
    }
}

impl Manifest {
    /// Returns a function of NRML: the probability of each loss ratio at each intensity.
    fn function(&self, id: &str, ratios: &[f64], points: &[Point]) -> String {
        let list = |values: &mut dyn Iterator<Item = f64>| {
            values.map(|value| format!("{value:?}")).collect::<Vec<_>>().join(" ")
        };
        let measure = nrml::measure(&self.contents.measure).unwrap_or_default();
        let imls = list(&mut points.iter().map(|point| point.intensity));
        let mut text = format!(
            "    <vulnerabilityFunction id=\"{}\" dist=\"PM\">\n      \
             <imls imt=\"{measure}\">{imls}</imls>\n",
            escaped(id)
        );
        for (place, ratio) in [0.0].iter().chain(ratios).enumerate() {
            let masses = list(&mut points.iter().map(|point| point.masses[place]));
            let _ = writeln!(text, "      <probabilities lr=\"{ratio:?}\">{masses}</probabilities>");
        }
        text + "    </vulnerabilityFunction>\n"
    }
}

/// Returns the loss from where the first curve rises to where the last one ends. Where curves cross, a limit
/// state is at most as probable as those before it.
fn points(ratios: &[f64], curves: &[[f64; 2]], unit: IntensityUnit) -> Vec<Point> {
    let end = |sign: f64| curves.iter().map(move |[theta, beta]| theta * libm::exp(sign * TAIL * beta));
    let (low, high) = (end(-1.0).fold(f64::INFINITY, f64::min), end(1.0).fold(0.0, f64::max));
    let at = |k: u32| {
        let x = low * libm::exp(libm::log(high / low) * f64::from(k) / f64::from(POINTS - 1));
        let mut before = 1.0;
        let exceeded = curves.iter().map(|&[median, dispersion]| {
            before = Lognormal { median, dispersion }.probability(x).min(before);
            before
        });
        let exceeded: Vec<f64> = exceeded.collect();
        let from = [1.0].into_iter().chain(exceeded.iter().copied());
        let masses = from.zip(exceeded.iter().copied().chain([0.0])).map(|(this, next)| this - next);
        let masses: Vec<f64> = masses.collect();
        let moment = |power: i32| -> f64 {
            masses[1..].iter().zip(ratios).map(|(mass, ratio)| mass * ratio.powi(power)).sum()
        };
        let mean = moment(1);
        let deviation = libm::sqrt((moment(2) - mean * mean).max(0.0));
        Point { intensity: unit.of(x), mean, deviation, masses }
    };
    (0..POINTS).map(at).collect()
}

/// Returns Σ (`r_k` − `r_k−1`) `λ_k`, with the rates of the limit states; `None` without all curves.
fn annual(hazard: &Hazard, ratios: &[f64], states: &[Fitted]) -> Option<Annual> {
    let before = [0.0].into_iter().chain(ratios.iter().copied());
    let steps: Vec<f64> = ratios.iter().zip(before).map(|(ratio, before)| ratio - before).collect();
    let curves = states.iter().map(|state| state.curve).collect::<Option<Vec<_>>>()?;
    let rates = curves.iter().map(|[theta, beta]| hazard.curve.rate(*theta, *beta));
    let (within, most): (Vec<f64>, Vec<f64>) = rates.map(|rate| (rate.within(), rate.most())).unzip();
    let sum = |rates: &[f64]| -> f64 { rates.iter().zip(&steps).map(|(rate, step)| rate * step).sum() };
    let count = states.iter().map(|state| state.resamples.len()).min().unwrap_or(0);
    let resample = |index: usize| {
        let rates = states.iter().map(|state| {
            let [theta, beta] = state.resamples[index];
            hazard.curve.rate(theta, beta).within()
        });
        sum(&rates.collect::<Vec<_>>())
    };
    let resamples: Vec<f64> = (0..count).map(resample).filter(|loss| loss.is_finite()).collect();
    let (within, most, count) = (sum(&within), sum(&most), resamples.len());
    let range = Interval::new(within, resamples, CONFIDENCE).range;
    Some(Annual { within, range, resamples: count, most })
}

fn of_points(name: &str, model: &str, unit: IntensityUnit, points: &[Point]) -> Table {
    Table::over(points)
        .text("wall", "", |_| name.to_owned())
        .text("model", "", |_| model.to_owned())
        .value(format!("intensity{}", unit.ending()), |point| point.intensity)
        .value("mean_loss_ratio", |point| point.mean)
        .value("deviation_of_loss_ratio", |point| point.deviation)
        .done()
}

fn of_year(name: &str, model: &str, rows: &[Annual]) -> Table {
    Table::over(rows)
        .text("wall", "", |_| name.to_owned())
        .text("model", "", |_| model.to_owned())
        .value("average_annual_loss", |row| row.within)
        .value("average_annual_loss_low", |row| Some(row.range[0]).filter(|loss| loss.is_finite()))
        .value("average_annual_loss_high", |row| Some(row.range[1]).filter(|loss| loss.is_finite()))
        .value("resamples", |row| row.resamples)
        .value("average_annual_loss_most", |row| row.most)
        .done()
}

fn shown(name: &str, model: &str, rows: &[Annual]) -> Table {
    let two = Digits::Exponent(2);
    Table::over(rows)
        .text("", "wall or class", |_| name.to_owned())
        .text("", "model", |_| model.to_owned())
        .number("", "annual loss", two, |row| row.within)
        .number("", "interval", two, |row| between(row.range))
        .number("", "at most", two, |row| row.most)
        .done()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hazard::HazardCurve;

    /// Two limit states that cost 0.2 and all: at the median of both, half of the walls are gone.
    #[test]
    fn losses_are_those_by_hand() {
        let curves = [[2.0, 0.4], [2.0, 0.4]];
        let middle = &points(&[0.2, 1.0], &curves, IntensityUnit::Gravity)[20];
        assert!((middle.intensity - IntensityUnit::Gravity.of(2.0)).abs() < 1e-12);
        let wanted = [0.5, 0.0, 0.5];
        assert!(middle.masses.iter().zip(wanted).all(|(mass, wanted)| (mass - wanted).abs() < 1e-12));
        assert!((middle.mean - 0.5).abs() < 1e-12 && (middle.deviation - 0.5).abs() < 1e-12);
        // curves that cross keep masses from 0 on, with the sum 1
        for point in points(&[0.2, 0.5, 1.0], &[[2.0, 0.4], [1.8, 0.3], [4.0, 0.9]], IntensityUnit::Gravity) {
            assert!(point.masses.iter().all(|mass| *mass >= 0.0));
            assert!((point.masses.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!((0.0..=1.0).contains(&point.mean));
        }
    }

    /// ∫ mean(x) |dλ(x)| over the segment by Simpson's rule in 4,000 steps is the annual loss.
    #[test]
    fn the_annual_loss_is_that_of_quadrature() {
        let points = [[0.5, 1e-2], [8.0, 1e-5]];
        let hazard = Hazard { curve: HazardCurve::new(points.to_vec()).unwrap(), years: 50.0, target: None };
        let (ratios, curves) = ([0.1, 0.4, 1.0], [[1.0, 0.4], [2.0, 0.4], [3.0, 0.4]]);
        let states = curves.map(|curve| Fitted { curve: Some(curve), resamples: vec![curve; 3] });
        let found = annual(&hazard, &ratios, &states).unwrap();
        let (width, k) = ((16.0_f64).ln(), (1e3_f64).ln() / (16.0_f64).ln());
        let step = width / 4000.0;
        let at = |index: i32| {
            let y = step * f64::from(index);
            let x = 0.5 * y.exp();
            let exceeded = curves.map(|[median, dispersion]| Lognormal { median, dispersion }.probability(x));
            let mean = 0.1 * exceeded[0] + 0.3 * exceeded[1] + 0.6 * exceeded[2];
            let weight =
                if [0, 4000].contains(&index) { 1.0 } else { [2.0, 4.0][usize::from(index % 2 == 1)] };
            weight * k * 1e-2 * (-k * y).exp() * mean
        };
        let wanted = (0..=4000).map(at).sum::<f64>() * step / 3.0;
        // the fourth power of a step of 0.002 of β and 1/k, over 180
        assert!((found.within / wanted - 1.0).abs() < 1e-9, "{} {wanted}", found.within);
        assert_eq!((found.range, found.resamples), ([found.within; 2], 3));
        assert!(found.most > found.within);
    }
}
