//! The tables of a study, wall by wall, for CSV files and the Python package.

use fragility::{FitError, Interval, Lognormal, Summary};
use report::table::{Cell, Column, Digits, Growing, Table};
use run::sample::{fractile, sorted};

use crate::ida::{Crossing, Curve, Exceedance, TieDemand};
use crate::results::{StateResults, WallResults};

use super::contents::{Contents, Manifest};

/// Digits of an intensity for people: three that count, since its unit may be g, cm/s or m.
pub(crate) const OF_INTENSITY: Digits = Digits::Significant(3);
/// Digits of a ratio of intensities, which is about 1.
pub(crate) const OF_RATIO: Digits = Digits::Decimals(3);

/// A kind of table: its name, and what makes it of the number and the results of a wall. Thousands of walls
/// need not be in memory at once.
pub(crate) type Kind = (&'static str, fn(&Manifest, usize, &WallResults) -> Table);

/// The tables of a study.
pub(crate) const KINDS: [Kind; 3] = [
    ("levels", |manifest, wall, results| levels(manifest, wall, results.all_curves())),
    ("collapses", |manifest, wall, results| collapses(manifest, wall, results.all_curves())),
    ("fragilities", fragilities),
];

/// The table of the ties that may yield.
pub(crate) const TIES: Kind = ("ties", ties);

/// The table of a cloud.
pub(crate) const CLOUD: Kind = ("cloud", cloud);

/// The regression of every model: ln(`u_max`/`u_ins`) = a + b ln IM, with IM in the unit of results.
fn cloud(manifest: &Manifest, wall: usize, results: &WallResults) -> Table {
    let three = Digits::Significant(4);
    let unit = manifest.contents.unit.size();
    let rows = results.clouds().iter().map(|cloud| (cloud, cloud.fit().ok()));
    Table::over(rows.enumerate())
        .text("wall", "", |_| manifest.contents.walls[wall].name.clone())
        .text("model", "model", |(model, _)| manifest.contents.models[*model].name.clone())
        .number("records", "records", three, |(_, (cloud, _))| cloud.records())
        .number("collapsed", "collapsed", three, |(_, (cloud, _))| cloud.collapsed())
        .number("still", "without motion", three, |(_, (cloud, _))| cloud.still())
        .number("a", "a", three, move |(_, (_, fit))| {
            fit.map(|fit| fit.intercept + fit.slope * libm::log(unit))
        })
        .number("b", "b", three, |(_, (_, fit))| fit.map(|fit| fit.slope))
        .number("sigma", "σ", three, |(_, (_, fit))| fit.map(|fit| fit.deviation))
        .done()
}

/// The records that lists state factors or weights of, with these; `None` where there are none.
pub(super) fn records(manifest: &Manifest) -> Option<Table> {
    let (contents, weights, four) = (&manifest.contents, &manifest.report.weights, Digits::Significant(4));
    let is_listed = !weights.are_equal() || contents.records.iter().any(|record| record.factor.is_some());
    let heading = format!("{}\n[{}]", contents.measure, contents.unit.name());
    let table = Table::over(contents.records.iter().enumerate())
        .text("record", "record", |(_, record)| record.name.clone())
        .number("factor", "factor", four, |(_, record)| record.factor.unwrap_or(1.0))
        .number("weight", "weight", four, |(place, _)| weights.of_record(*place))
        .number(contents.in_unit("intensity"), heading, four, |(_, record)| {
            contents.unit.of(record.intensity)
        });
    is_listed.then(|| table.done())
}

/// Every run of a wall, from all its curves.
pub(crate) fn levels(manifest: &Manifest, wall: usize, curves: &[Curve]) -> Table {
    let runs =
        curves.iter().enumerate().flat_map(|(index, curve)| curve.runs().iter().map(move |run| (index, run)));
    let contents = &manifest.contents;
    let mut table = contents
        .with_curves(wall, runs, |(index, _)| *index)
        .value(manifest.contents.in_unit("intensity"), |(_, run)| manifest.contents.unit.of(run.intensity))
        .value("u_max_over_u_ins", |(_, run)| run.demand)
        .value("overturned", |(_, run)| run.overturning.is_some())
        .value("overturn_time_s", |(_, run)| run.overturning);
    if manifest.contents.has_yielding_ties() {
        table = table
            .value("tie_force_n", |(_, run)| run.tie.map(|tie| tie.force))
            .value("tie_elongation_m", |(_, run)| run.tie.map(|tie| tie.elongation))
            .value("tie_broken", |(_, run)| run.tie.map(|tie| tie.broken));
    }
    table.done()
}

/// Fractiles of a tie's demands over the runs at a level: the median, that of the mean and one standard
/// deviation of a normal sample, and the largest value. An anchor is not designed for less.
const FRACTILES: [(&str, &str, f64); 3] = [("50", "50 %", 0.5), ("84", "84 %", 0.84), ("max", "max", 1.0)];

/// The ties of a wall that may yield, with every model: in how many runs they yielded and broke, and
/// fractiles of their force and elongation, at each level where all records share these, or else over all
/// runs.
fn ties(manifest: &Manifest, wall: usize, results: &WallResults) -> Table {
    let three = Digits::AtMost(3);
    let mut table = Table::over(tie_rows(&manifest.contents, results))
        .text("wall", "", |_| manifest.contents.walls[wall].name.clone())
        .text("model", "model", |row| manifest.contents.models[row.model].name.clone())
        .number(
            manifest.contents.in_unit("intensity"),
            format!("level\n[{}]", manifest.contents.unit.name()),
            three,
            |row| row.level.map(|level| manifest.contents.unit.of(level)),
        )
        .number("runs", "runs", three, |row| row.demands.len())
        .number("yielded", "yielded", three, |row| row.count(|tie| tie.elongation > 0.0))
        .number("broken", "broken", three, |row| row.count(|tie| tie.broken));
    for (name, heading, part) in FRACTILES {
        let column = Column::number(format!("tie_force_{name}_n"), format!("N {heading}\n[kN]"), three);
        table = table.column(column.shown(1e-3), move |row| row.fractile(|tie| tie.force, part));
    }
    for (name, heading, part) in FRACTILES {
        let column = Column::number(format!("tie_elongation_{name}_m"), format!("p {heading}\n[mm]"), three);
        table = table.column(column.shown(1e3), move |row| row.fractile(|tie| tie.elongation, part));
    }
    table.done()
}

/// The runs of a wall with a model, at one level or all.
struct TieRow {
    model: usize,
    level: Option<f64>,
    demands: Vec<TieDemand>,
}

impl TieRow {
    fn count(&self, is: fn(&TieDemand) -> bool) -> usize {
        self.demands.iter().filter(|tie| is(tie)).count()
    }

    fn fractile(&self, of: fn(&TieDemand) -> f64, part: f64) -> Option<f64> {
        let values = sorted(self.demands.iter().map(of));
        fractile(&values, part)
    }
}

fn tie_rows(contents: &Contents, results: &WallResults) -> Vec<TieRow> {
    let mut rows: Vec<TieRow> = Vec::new();
    for model in 0..contents.models.len() {
        let runs = results.curves(model).iter().flat_map(Curve::runs);
        let mut runs: Vec<_> = runs.filter_map(|run| Some((run.intensity, run.tie?))).collect();
        runs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (intensity, demand) in runs {
            let level = contents.grid.is_some().then_some(intensity);
            match rows.last_mut() {
                Some(row) if (row.model, row.level) == (model, level) => row.demands.push(demand),
                _ => rows.push(TieRow { model, level, demands: vec![demand] }),
            }
        }
    }
    rows
}

/// The collapse with every model and record, from all curves of a wall.
pub(crate) fn collapses(manifest: &Manifest, wall: usize, curves: &[Curve]) -> Table {
    let contents = &manifest.contents;
    let collapse = |curve: &Curve| match curve.collapse() {
        Exceedance::Above(_) => None,
        exceedance => Some(manifest.contents.unit.of(exceedance.bounds()[1])),
    };
    let last = |curve: &Curve| match curve.exceedance(1.0, Crossing::Last, true).bounds() {
        [_, f64::INFINITY] => None,
        [_, level] => Some(manifest.contents.unit.of(level)),
    };
    let mut table = contents
        .with_curves(wall, curves.iter().enumerate(), |(index, _)| *index)
        .value(manifest.contents.in_unit("collapse"), |(_, curve)| collapse(curve))
        .value(manifest.contents.in_unit("standing_below"), |(_, curve)| {
            manifest.contents.unit.of(curve.level_below_collapse())
        })
        .value(manifest.contents.in_unit("highest_level"), |(_, curve)| {
            manifest.contents.unit.of(curve.top())
        })
        .value("runs", |(_, curve)| curve.runs().len())
        .value("resurrections", |(_, curve)| curve.resurrections())
        .value(manifest.contents.in_unit("last_collapse"), |(_, curve)| last(curve))
        .value("come_back", |(_, curve)| curve.runs().iter().filter(|run| run.comes_back()).count())
        // its error is up to 15 %
        .value("sensitivity", |(_, curve)| {
            curve.sensitivity().map(|s| format!("{s:.1e}").parse().unwrap_or(s))
        });
    if contents.scales_last {
        table = table
            .value("u_max_over_u_ins_before", |(_, curve)| curve.before().map(|before| before.demand))
            .value("tie_broken_before", |(_, curve)| curve.before()?.tie.map(|tie| tie.broken));
    }
    table.done()
}

/// The fragility of every model and limit state.
fn fragilities(manifest: &Manifest, wall: usize, results: &WallResults) -> Table {
    let states = manifest.report.fractions.iter().enumerate();
    let rows = (0..manifest.contents.models.len())
        .flat_map(|model| states.clone().map(move |(state, fraction)| (model, *fraction, state)))
        .map(|(model, fraction, state)| (model, fraction, &results.states(state)[model]));
    let beta = |fit: &Result<Lognormal, FitError>| fit.as_ref().ok().map(|fit| fit.dispersion);
    let mut table = Table::over(rows)
        .text("wall", "", |_| manifest.contents.walls[wall].name.clone())
        .text("model", "", |(model, ..)| manifest.contents.models[*model].name.clone())
        .value("u_max_over_u_ins", |(_, fraction, _)| *fraction)
        .value("records", |(.., one)| one.summary.records)
        .value("censored", |(.., one)| one.summary.censored);
    let intensities: [Estimate; 2] = [("median", |one| &one.median), ("theta", |one| &one.theta)];
    let ratios: [Estimate; 2] =
        [("median_ratio", |one| &one.median_ratio), ("theta_ratio", |one| &one.theta_ratio)];
    for estimate in intensities {
        table =
            with_interval(table, estimate, &manifest.contents.unit.ending(), manifest.contents.unit.size());
    }
    table = table
        .value("beta", |(.., one)| beta(&one.summary.fitted))
        .value("beta_alone", |(.., one)| beta(&one.summary.alone));
    for estimate in ratios {
        table = with_interval(table, estimate, "", 1.0);
    }
    let known = |value: f64| (!value.is_nan()).then_some(value);
    table = table
        .value("beta_low", move |(.., one)| known(one.summary.beta.range[0]))
        .value("beta_high", move |(.., one)| known(one.summary.beta.range[1]));
    for (part, name) in ["var_ln_theta", "cov_ln_theta_beta", "var_beta"].into_iter().enumerate() {
        table = table.value(name, |(.., one)| one.summary.covariance().map(|moments| moments[part]));
    }
    table = table
        .value("misfit", |(.., one)| one.summary.misfit)
        .value(manifest.contents.in_unit("crossing"), |(.., one)| {
            one.summary.crossing.map(|one| manifest.contents.unit.of(one.intensity))
        })
        .value("crossing_excess", |(.., one)| one.summary.crossing.map(|one| one.excess));
    for (place, (name, _)) in Crossing::ALL.into_iter().enumerate() {
        let theta = |curve: &Lognormal| manifest.contents.unit.of(curve.median);
        table = table
            .value(manifest.contents.in_unit(&format!("theta_{name}")), |(.., one)| {
                one.by_crossing[place].as_ref().ok().map(theta)
            })
            .value(format!("beta_{name}"), |(.., one)| beta(&one.by_crossing[place]));
    }
    table.done()
}

/// Writes an estimate with the ends of its interval, for people.
pub(super) fn with_ends(of: &Interval, unit: f64, digits: Digits) -> String {
    let [estimate, low, high] = of.texts(unit, digits);
    format!("{estimate} ({low} … {high})")
}

/// The name of an estimate, and what it is of a summary.
type Estimate = (&'static str, fn(&Summary) -> &Interval);

/// Adds an estimate and the ends of its interval, in a unit that ends the names of their columns.
fn with_interval<'a>(
    table: Growing<(usize, f64, &'a StateResults)>,
    (name, of): Estimate,
    ending: &str,
    unit: f64,
) -> Growing<(usize, f64, &'a StateResults)> {
    ["", "_low", "_high"].into_iter().enumerate().fold(table, |table, (part, end)| {
        let bounds = |row: &(usize, f64, &StateResults)| Cell::Between(of(&row.2.summary).bounds(unit)[part]);
        table.value(format!("{name}{end}{ending}"), bounds)
    })
}

impl Contents {
    /// Returns the name of a column of intensities, which ends with their unit.
    pub(super) fn in_unit(&self, name: &str) -> String {
        format!("{name}{}", self.unit.ending())
    }

    /// Begins a table whose items belong to curves of a wall, with the names of wall, model and record.
    fn with_curves<R>(
        &self,
        wall: usize,
        items: impl IntoIterator<Item = R>,
        curve: fn(&R) -> usize,
    ) -> Growing<R> {
        let records = self.records.len();
        Table::over(items)
            .text("wall", "", |_| self.walls[wall].name.clone())
            .text("model", "", |item| self.models[curve(item) / records].name.clone())
            .text("record", "", |item| self.records[curve(item) % records].name.clone())
    }
}
