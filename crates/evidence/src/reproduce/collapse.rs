//! Figure 15: the walls of Table 5 scaled to their collapse.

use std::num::NonZeroUsize;

use fragility::{Bootstrap, Dispersion, Estimator, Interval, Sample, Summary, compare};
use ground_motion::STANDARD_GRAVITY;
use report::counted;
use report::plot::{Axis, Plot, Series};
use report::table::{Digits, Table};
use rocking_wall::variables::RestitutionSource;
use rocking_wall::wall::Parameters;
use run::model::{Model, color};
use run::records::NamedRecord;
use run::sample::sorted;
use run::walls::NamedWall;
use study::ida::{Case, Crossing, Exceedance, IdaError, IntensityMeasure, Levels, Study};

use super::figure::Figure;
use super::printed::{TABLE_5, Table5};
use super::tables::{mechanism, table_5_wall};

/// Levels that find the collapse intensity of each record to 1 %.
const LEVELS: Levels =
    Levels::HuntAndFill { first: 0.2, increase: 0.05, top: 150.0, resolution: 0.01, gap: 1.0 };
/// Number of resamples of the records.
const RESAMPLES: usize = 1000;
const SEED: u64 = 15;
/// Index of CDR with Eq. (14) among the models of Figure 15.
const EQUATION_14: usize = 4;

/// Figure 15 and its medians.
#[derive(Clone, Debug)]
pub struct Collapses {
    /// Fragilities of each wall.
    pub figure: Figure,
    /// Medians of CR, and those of the other models over it.
    pub table: Table,
    /// What the table shows.
    pub note: String,
    /// Summaries of each wall, its models in the order of [`Model::figure_15`].
    pub walls: Vec<Vec<Summary>>,
}

/// Scales each record by `AvgSA` until each wall of Table 5 overturns, for CR, CDC, CDR, SDR and CDR with Eq.
/// (14).
///
/// # Errors
/// [`IdaError`] if there is no record, if one cannot be scaled, or if a run fails.
pub fn figure_15(records: Vec<NamedRecord>, threads: NonZeroUsize) -> Result<Collapses, IdaError> {
    let count = records.len();
    let walls = TABLE_5.iter().map(|row| {
        let restitution_source = RestitutionSource::Calibrated;
        let parameters = Parameters { restitution_source, ..table_5_wall(row) };
        NamedWall::new(format!("wall {}", row.number), parameters)
    });
    let models = Model::figure_15();
    let study = Study::new(walls.collect(), records, models, IntensityMeasure::default(), LEVELS)?;
    let curves = study.run(threads.get())?;
    let bootstrap = Bootstrap::new(count, RESAMPLES, SEED);
    let (mut charts, mut walls) = (Vec::new(), Vec::new());
    for (wall, row) in TABLE_5.iter().enumerate() {
        let collapses = |model| -> Vec<Exceedance> {
            let curve = |record| &curves[study.index(Case { wall, record, model })];
            (0..count).map(|record| curve(record).exceedance(1.0, Crossing::First, false)).collect()
        };
        let collapses: Vec<_> = (0..study.models().len()).map(collapses).collect();
        // overturning is the only limit state
        let states: Vec<_> = collapses.iter().map(|model| vec![Sample::of_records(model.clone())]).collect();
        let estimator = Estimator::new(Dispersion::Own, &[1.0]);
        let summaries = compare(&states, 0, &estimator, &bootstrap).concat();
        charts.push(chart(row, study.models(), &collapses));
        walls.push(summaries);
    }
    let note = format!(
        "In brackets 95 % of {RESAMPLES} resamples of {}. Collapse is the first overturning found while the \
         records are scaled up, to 1 % of its intensity.",
        counted(count, "record")
    );
    Ok(Collapses { figure: figure(count, charts, &walls), table: table(&walls), note, walls })
}

fn figure(count: usize, charts: Vec<Plot>, walls: &[Vec<Summary>]) -> Figure {
    let ratios = |model: usize| walls.iter().map(move |models| models[model].median_ratio);
    let extremes = |models: std::ops::Range<usize>| {
        let estimates = models.flat_map(ratios).map(|ratio| ratio.estimate);
        let [low, high] =
            estimates.fold([f64::INFINITY, 0.0], |[low, high], r| [f64::min(low, r), f64::max(high, r)]);
        format!("{low:.2} to {high:.2}")
    };
    let clear = ratios(EQUATION_14).filter(|ratio| ratio.range[0] > 1.0).count();
    Figure {
        number: 15,
        title: "Collapse fragilities of the walls of Table 5",
        notes: format!(
            "{}, scaled by AvgSA, the geometric mean of Sa at 0.2, 0.4 … 1.4 s. The forty of RINTC for \
             L'Aquila are not public: medians cannot be compared with print, only how the models compare \
             with each other.\n\
             Over that of CR the median collapse AvgSA is {} for CDC, CDR and SDR, and {} for CDR with Eq. \
             (14): above 1, the probability of overturning underestimated, with its whole 95 % interval for \
             {clear} of {} walls.",
            counted(count, "record"),
            extremes(1..EQUATION_14),
            extremes(EQUATION_14..EQUATION_14 + 1),
            walls.len()
        ),
        charts,
    }
}

/// Draws the empirical fragilities of one wall.
fn chart(row: &Table5, models: &[Model], collapses: &[Vec<Exceedance>]) -> Plot {
    let series = models.iter().zip(collapses).map(|(model, collapses)| {
        let mut points = vec![(0.0, 0.0)];
        let mut below = 0.0;
        for (intensity, part) in Sample::of_records(collapses.clone()).steps() {
            let intensity = intensity / STANDARD_GRAVITY;
            points.extend([(intensity, below), (intensity, part)]);
            below = part;
        }
        let look = if model.name.ends_with("14") { Series::dashed } else { Series::line };
        look(&model.name, color(&model.name), points)
    });
    let series: Vec<_> = series.collect();
    // a single record far above the rest would squeeze all others
    let widest = series[0].points.iter().map(|point| point.0);
    let widest = sorted(widest.filter(|intensity| *intensity > 0.0));
    let nine_tenths = widest.get(widest.len() * 9 / 10).copied().unwrap_or(1.0);
    let title = format!("{}: {} {:.2} m × {:.2} m", row.number, mechanism(row), row.size[0], row.size[1]);
    let x = Axis::over("AvgSA (g)", [0.0, 1.6 * nine_tenths]);
    Plot::titled(title, x, Axis::over("probability of overturning", [0.0, 1.02]), series)
}

fn interval(value: &Interval, unit: f64) -> String {
    let [estimate, low, high] = value.texts(unit, Digits::Decimals(3));
    format!("{estimate} [{low}, {high}]")
}

/// What the table of medians is called.
pub const MEDIANS: &str = "Medians: Median collapse AvgSA of CR, and that of each damping model over it";

fn table(walls: &[Vec<Summary>]) -> Table {
    let ratio = |model: usize| {
        move |(_, models): &(&Table5, &Vec<Summary>)| interval(&models[model].median_ratio, 1.0)
    };
    Table::over(TABLE_5.iter().zip(walls))
        .text("", "wall", |(row, _)| usize::from(row.number))
        .text("", "type", |(row, _)| mechanism(row))
        .text("", "CR: median (g)", |(_, models)| interval(&models[0].median, STANDARD_GRAVITY))
        .text("", "CDC / CR", ratio(1))
        .text("", "CDR / CR", ratio(2))
        .text("", "SDR / CR", ratio(3))
        .text("", "CDR with Eq. (14) / CR", ratio(EQUATION_14))
        .text("", "runs that stood at 150 m/s²", |(_, models)| {
            models.iter().map(|summary| summary.censored).sum::<usize>()
        })
        .done()
}
