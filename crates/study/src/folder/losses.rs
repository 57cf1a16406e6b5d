//! Losses of walls and classes: `vulnerability.csv`, `vulnerability.xml`, with a hazard `losses.csv`, and
//! what the page and the terminal show of them.

use std::fmt::Write as _;
use std::path::Path;

use fragility::hazard::Hazard;
use fragility::{CONFIDENCE, Interval, Lognormal, TAIL};
use report::escaped;
use report::table::{Digits, Table};

use crate::ida::IntensityUnit;

use super::contents::Manifest;
use super::error::FolderError;
use super::finished::Finished;
use super::nrml::Nrml;
use super::rates::between;
use super::rows::Rows;
use super::shown::Shown;
use super::subject::{State, Subject};

/// Intensities of a curve, equally spaced by their logarithms.
const POINTS: u32 = 41;

/// The files under construction.
pub(crate) struct Losses<'a> {
    manifest: &'a Manifest,
    /// Loss ratios of the limit states, which rise.
    ratios: Vec<f64>,
    curves: Rows,
    xml: Option<Nrml>,
    /// Average annual losses, of a study with a hazard.
    annual: Option<(&'a Hazard, Rows)>,
    shown: Shown<'a>,
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
    /// Begins the files in a folder, with the loss ratios of the limit states.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest, ratios: &[f64]) -> Result<Self, FolderError> {
        let more = "loss ratios of limit states, which are fractions of the static instability displacement";
        let annual = manifest.report.hazard.as_ref();
        let annual =
            annual.map(|hazard| Ok::<_, FolderError>((hazard, Rows::new(&folder.join("losses.csv"))?)));
        Ok(Self {
            manifest,
            ratios: manifest.report.rising().into_iter().map(|place| ratios[place]).collect(),
            curves: Rows::new(&folder.join("vulnerability.csv"))?,
            xml: Nrml::new(&folder.join("vulnerability.xml"), manifest, "vulnerabilityModel", more)?,
            annual: annual.transpose()?,
            shown: Shown::new(manifest, "mean loss ratio"),
        })
    }

    /// Adds a wall or a class. With a model without all curves it has no losses.
    pub(crate) fn add(&mut self, subject: &Subject<'_>) -> Result<(), FolderError> {
        let contents = &self.manifest.contents;
        let (mut lines, mut annuals) = (Vec::new(), Vec::new());
        for (of_model, model) in subject.models.iter().zip(&contents.models) {
            let curves: Option<Vec<_>> = of_model.states.iter().map(|state| state.curve).collect();
            let points = curves.map_or_else(Vec::new, |curves| points(&self.ratios, &curves, contents.unit));
            self.curves.add(&of_points([subject.name, &model.name], contents.unit, &points))?;
            if let Some(xml) = self.xml.as_mut().filter(|_| !points.is_empty()) {
                let head = format!("id=\"{}\" dist=\"PM\"", escaped(&xml.id(subject.name, &model.name)));
                xml.write(&format!(
                    "    <vulnerabilityFunction {head}>\n{}    </vulnerabilityFunction>\n",
                    function(&xml.measure, &self.ratios, &points)
                ))?;
            }
            lines.push(points.iter().map(|point| (point.intensity, point.mean)).collect::<Vec<_>>());
            let annual = self.annual.as_ref();
            let annual = annual.and_then(|(hazard, _)| annual_loss(hazard, &self.ratios, &of_model.states));
            annuals.extend(annual.map(|annual| (&*model.name, annual)));
        }
        let table = of_year(subject.name, &annuals);
        if let Some((_, file)) = &mut self.annual {
            file.add(&table)?;
        }
        if subject.is_shown(self.manifest) {
            let ends = lines.iter().flatten().map(|point| point.0);
            let ends = ends.fold([f64::INFINITY, 0.0], |[low, high], x| [low.min(x), high.max(x)]);
            self.shown.add(subject, table, ends, lines);
        }
        Ok(())
    }

    /// Completes the files.
    pub(crate) fn finish(self) -> Result<Finished, FolderError> {
        let Self { curves, xml, annual, mut shown, .. } = self;
        let mut files = vec![curves.commit()?];
        files.extend(xml.map(Nrml::finish).transpose()?);
        files.extend(annual.map(|(_, file)| file.commit()).transpose()?);
        let (mut said, mut html) = (String::new(), "<section><h2>Losses</h2>".to_owned());
        let table = shown.table();
        if !table.rows.is_empty() {
            let words = format!(
                "average annual loss, of the value of the wall, with {:.0} % intervals of the records, \
                 studentised; \"at most\" adds what may lie outside the hazard curve",
                100.0 * CONFIDENCE
            );
            said = format!("{words}\n{}", table.text());
            let _ = write!(html, "<p class=\"subtitle\">{words}.</p>{}", table.html());
        }
        let _ = writeln!(html, "<h3>Mean loss ratio by intensity</h3>{}</section>", shown.plots());
        Ok(Finished { files, words: said, html })
    }
}

/// Returns a function of NRML: the probability of each loss ratio at each intensity.
fn function(measure: &str, ratios: &[f64], points: &[Point]) -> String {
    let list = |value: &dyn Fn(&Point) -> f64| {
        points.iter().map(|point| format!("{:?}", value(point))).collect::<Vec<_>>().join(" ")
    };
    let mut text = format!("      <imls imt=\"{measure}\">{}</imls>\n", list(&|point| point.intensity));
    for (place, ratio) in [0.0].iter().chain(ratios).enumerate() {
        let masses = list(&|point| point.masses[place]);
        let _ = writeln!(text, "      <probabilities lr=\"{ratio:?}\">{masses}</probabilities>");
    }
    text
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
fn annual_loss(hazard: &Hazard, ratios: &[f64], states: &[State]) -> Option<Annual> {
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

fn of_points([name, model]: [&str; 2], unit: IntensityUnit, points: &[Point]) -> Table {
    Table::over(points)
        .text("wall", "", |_| name.to_owned())
        .text("model", "", |_| model.to_owned())
        .value(format!("intensity{}", unit.ending()), |point| point.intensity)
        .value("mean_loss_ratio", |point| point.mean)
        .value("deviation_of_loss_ratio", |point| point.deviation)
        .done()
}

fn of_year(name: &str, rows: &[(&str, Annual)]) -> Table {
    let two = Digits::Exponent(2);
    let finite = |loss: f64| Some(loss).filter(|loss| loss.is_finite());
    Table::over(rows)
        .text("wall", "wall or class", |_| name.to_owned())
        .text("model", "model", |(model, _)| (*model).to_owned())
        .number("average_annual_loss", "annual loss", two, |(_, row)| row.within)
        .value("average_annual_loss_low", |(_, row)| finite(row.range[0]))
        .value("average_annual_loss_high", |(_, row)| finite(row.range[1]))
        .number("", "interval", two, |(_, row)| between(row.range))
        .value("resamples", |(_, row)| row.resamples)
        .number("average_annual_loss_most", "at most", two, |(_, row)| row.most)
        .done()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fragility::hazard::HazardCurve;

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
        let known = Interval::new(0.0, [], CONFIDENCE);
        let states = curves.map(|curve| State {
            fraction: 1.0,
            curve: Some(curve),
            resamples: vec![curve; 3],
            theta: known,
            beta: known,
            covariance: None,
            misfit: None,
        });
        let found = annual_loss(&hazard, &ratios, &states).unwrap();
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
