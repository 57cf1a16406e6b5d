//! The plots of a wall: fragilities and IDA curves or stripes.

use fragility::{Regression, Sample, Weights};
use report::palette::Mark;
use report::plot::{Axis, Look, Plot, Series};
use run::sample::{fractile, sorted};

use crate::ida::{Crossing, Curve, Exceedance, IntensityUnit, Layout, Run};
use crate::results::{StateResults, WallResults};

use super::contents::Manifest;
use super::legend::looks;

/// Size of every plot \[px\]; with one size, their letters have one size too.
pub(crate) const SIZE: [f64; 2] = [340.0, 260.0];
/// Demand at the right end of IDA curves, and that at which the runs of stripes that overturned are drawn.
const DEMAND_END: f64 = 1.08;
const OVERTURNED: f64 = 1.05;
/// Points of fractiles and of a fitted curve.
pub(crate) const POINTS: u32 = 100;
/// Probabilities at which a line has the mark of its model.
const MARKED: [f64; 3] = [0.16, 0.5, 0.84];

/// A wall and its results.
#[derive(Clone, Copy)]
pub(crate) struct Shown<'a> {
    pub(crate) manifest: &'a Manifest,
    pub(crate) wall: usize,
    pub(crate) results: &'a WallResults,
}

/// Intensity at the end of a wall's axes, in the unit of results: nearly all exceedances of a limit state,
/// given by its place.
pub(crate) fn top(shown: Shown<'_>, place: usize) -> f64 {
    let models = shown.manifest.contents.models.len();
    let largest = |model: usize| {
        let known = |exceedance: &Exceedance| match exceedance.bounds() {
            [least, f64::INFINITY] => least,
            [_, most] => most,
        };
        let intensities = sorted(shown.results.exceedances(place, model).iter().map(known));
        let (most, all) = (fractile(&intensities, 0.9), intensities.last().copied());
        // a single outlying record must not squeeze the others
        (1.5 * most.unwrap_or(1.0)).min(all.unwrap_or(1.0))
    };
    1.05 * shown.manifest.contents.unit.of((0..models).map(largest).fold(1e-6, f64::max))
}

/// Draws the observations, as steps or as marks at the levels of stripes, and the fit of each model.
pub(crate) fn fragility(shown: Shown<'_>, place: usize, top: f64) -> String {
    let Shown { manifest, results, .. } = shown;
    let unit = manifest.contents.unit;
    let mut series = Vec::new();
    for (StateResults { summary, sample, .. }, (color, mark)) in
        results.states(place).iter().zip(looks(manifest))
    {
        let counts = sample.counts();
        if counts.is_empty() && manifest.contents.layout != Layout::Cloud {
            let mut points = vec![(0.0, 0.0)];
            let mut before = 0.0;
            for (intensity, part) in sample.steps() {
                points.extend([(unit.of(intensity), before), (unit.of(intensity), part)]);
                before = part;
            }
            points.push((2.0 * top, before));
            series.push(Series::stroke(color, 1.0, points));
        } else if !counts.is_empty() {
            // a level without runs has no exceedance
            let part = |&(level, [runs, exceeded]): &(f64, [f64; 2])| {
                (unit.of(level), if runs > 0.0 { exceeded / runs } else { 0.0 })
            };
            series.push(marks(color, mark, counts.iter().map(part).collect()));
        }
        if let Ok(fit) = summary.fitted {
            let at = |k: u32| top * f64::from(k) / f64::from(POINTS);
            let probability = |x: f64| fit.probability(x * unit.size());
            let curve: Vec<_> = (1..=POINTS).map(|k| (at(k), probability(at(k)))).collect();
            if counts.is_empty() {
                series.extend(marked_line(curve, color, mark));
            } else {
                series.push(Series::stroke(color, 1.8, curve));
            }
        }
    }
    probabilities(Axis::over(&manifest.contents.axis(), [0.0, top]), "probability", series)
}

/// Draws probabilities, or shares, over a horizontal axis.
pub(crate) fn probabilities(across: Axis, label: &str, series: Vec<Series>) -> String {
    Plot::new(SIZE, [across, Axis::over(label, [0.0, 1.0])], series).svg()
}

/// Returns a line of a model, and its mark where the line first reaches some probabilities.
pub(crate) fn marked_line(line: Vec<(f64, f64)>, color: &'static str, mark: Mark) -> [Series; 2] {
    let first = |part: f64| line.iter().find(|point| point.1 >= part).copied();
    let marked = MARKED.into_iter().filter_map(first).collect();
    [Series::stroke(color, 1.8, line), marks(color, mark, marked)]
}

fn marks(color: &'static str, mark: Mark, points: Vec<(f64, f64)>) -> Series {
    Series { look: Look::Marks(mark), ..Series::stroke(color, 3.3, points) }
}

/// Draws the collapse fragility of a wall for a file, with the wall's name.
pub(crate) fn panel(manifest: &Manifest, wall: usize, results: &WallResults) -> Option<(String, String)> {
    let collapse = manifest.report.fractions.iter().position(|fraction| *fraction == 1.0)?;
    let shown = Shown { manifest, wall, results };
    let name = &manifest.contents.walls[wall].name;
    Some((format!("Wall {name}"), fragility(shown, collapse, top(shown, collapse))))
}

/// Draws the runs of one model, intensity over demand: a curve for each record, or the points of stripes.
pub(crate) fn curves(shown: Shown<'_>, model: usize, every: usize, top: f64) -> String {
    let Shown { manifest, results, .. } = shown;
    let (all, unit) = (results.curves(model), manifest.contents.unit);
    let (color, _) = looks(manifest)[model];
    let mut series = Vec::new();
    for (curve, record) in all.iter().zip(&manifest.contents.records).step_by(every) {
        if manifest.contents.grid.is_some() || manifest.contents.layout == Layout::Cloud {
            let demand = |run: &Run| if run.overturning.is_some() { OVERTURNED } else { run.demand };
            let runs = curve.runs().iter().map(|run| (demand(run), unit.of(run.intensity))).collect();
            series.push(Series { look: Look::Marks(Mark::Dot), ..Series::stroke(color, 4.0, runs) });
        } else {
            let line = Series::stroke(color, 0.6, path(curve, unit));
            series.push(Series { look: Look::Faint, titles: vec![record.name.clone()], ..line });
        }
    }
    if let Some(cloud) = results.clouds().get(model) {
        let at = |k: u32| top * f64::from(k) / f64::from(POINTS);
        let line = |fit: Regression| (1..=POINTS).map(|k| (fit.demand(at(k) * unit.size()), at(k))).collect();
        series.push(Series::stroke(color, 2.6, cloud.fit().map(line).unwrap_or_default()));
    } else if manifest.contents.layout == Layout::Curves {
        let looks = [(Look::Dashed, 2.0), (Look::Dashed, 2.0), (Look::Solid, 2.6)];
        let paths = fractile_paths(all, &manifest.report.weights, unit).into_iter().zip(looks);
        series
            .extend(paths.map(|(path, (look, width))| Series { look, ..Series::stroke(color, width, path) }));
    }
    let x = Axis::over("u_max / u_ins", [0.0, DEMAND_END]);
    Plot::new(SIZE, [x, Axis::over(&manifest.contents.axis(), [0.0, top])], series).svg()
}

/// Returns the points of a curve up to its collapse, where it becomes flat.
fn path(curve: &Curve, unit: IntensityUnit) -> Vec<(f64, f64)> {
    let mut points = vec![(0.0, 0.0)];
    for run in curve.runs() {
        if run.overturning.is_some() {
            let standing = points.last().map_or(0.0, |point| point.0);
            points.extend([(standing, unit.of(run.intensity)), (2.0 * DEMAND_END, unit.of(run.intensity))]);
            break;
        }
        points.push((run.demand, unit.of(run.intensity)));
    }
    points
}

/// The 16, 84 and 50 % fractiles of the intensity at which a record first exceeds a demand, over the demand.
/// They rise with the demand, and go flat at the collapse.
fn fractile_paths(curves: &[Curve], weights: &Weights, unit: IntensityUnit) -> [Vec<(f64, f64)>; 3] {
    let mut paths = [(); 3].map(|()| vec![(0.0, 0.0)]);
    for k in 1..=POINTS {
        let demand = f64::from(k) / f64::from(POINTS);
        let first = |curve: &Curve| curve.exceedance(demand, Crossing::First, false);
        let sample = Sample::of_records(curves.iter().map(first).collect()).weighted(weights);
        for (path, part) in paths.iter_mut().zip([0.16, 0.84, 0.5]) {
            // unknown above the levels
            let known = sample.fractile(part).filter(|intensity| intensity.is_finite());
            path.extend(known.map(|intensity| (demand, unit.of(intensity))));
            if k == POINTS {
                path.extend(known.map(|intensity| (2.0 * DEMAND_END, unit.of(intensity))));
            }
        }
    }
    paths
}

#[cfg(test)]
mod tests {
    use crate::ida::{Curve, IntensityUnit, Run};
    use fragility::Weights;

    use super::fractile_paths;

    #[test]
    fn fractiles_of_curves_that_weave_do_not_fold_back() {
        let run = |(intensity, demand)| Run { intensity, demand, overturning: None, ..Run::default() };
        let demands = [[0.5, 0.1, 0.9], [0.2, 0.6, 0.3], [0.4, 0.2, 1.0]];
        let curves =
            demands.map(|demands| Curve::new([1.0, 2.0, 3.0].into_iter().zip(demands).map(run).collect()));
        for path in fractile_paths(&curves, &Weights::default(), IntensityUnit::Gravity) {
            assert!(path.is_sorted_by(|a, b| a.0 < b.0 && a.1 <= b.1) && path.len() > 20, "{path:?}");
        }
    }
}
