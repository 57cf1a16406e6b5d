//! `wall calibrate`: the damping that matches restitution, section 5 of the paper for any wall.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use figures::{chart, escaped};
use rocking_wall::variables::{DampingModel, ForceLaw};
use rocking_wall::wall::Parameters;
use study::calibration::{Calibration, Coefficient, Fit, Grid, STEP, calibrate};
use study::chart::{Axis, Chart, Series, model_color};
use study::parallel::threads;
use study::reproduce::printed::{FREE_STANDING, REGRESSIONS};
use study::reproduce::tables::abbreviation;

use crate::args::SceneArguments;
use crate::output;
use figures::template;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Damping models: `constant_coefficient`, `free_standing_block`, `constant_ratio`,
    /// `stiffness_proportional` [default: all that the force law allows]
    #[arg(long, value_delimiter = ',')]
    models: Vec<String>,
    /// Coefficients of restitution
    #[arg(long, value_name = "E", value_delimiter = ',', default_values_t = Grid::default().restitution)]
    restitution: Vec<f64>,
    /// Ends of the elastic branch over `u_ins`; a multilinear or rigid-linear law has its own
    #[arg(long, value_name = "A1", value_delimiter = ',', default_values_t = Grid::default().a1)]
    a1: Vec<f64>,
    /// Initial displacements over `u_ins`
    #[arg(long, value_name = "RATIO", value_delimiter = ',', default_values_t = Grid::default().start)]
    start: Vec<f64>,
    /// Time between the samples compared in s
    #[arg(long, value_name = "SECONDS", default_value_t = STEP)]
    step: f64,
    /// Write every fit as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with charts
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "COUNT")]
    threads: Option<NonZeroUsize>,
}

/// Series that a chart holds without repeating a colour.
const MOST_SERIES: usize = 6;

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.scene.apply(&mut scene)?;
    output::check_distinct(arguments.scene.inputs(&scene), arguments.csv.iter().chain(&arguments.html))?;
    let grid = Grid {
        restitution: arguments.restitution.clone(),
        a1: arguments.a1.clone(),
        start: arguments.start.clone(),
        step: arguments.step,
    };
    let models = models(&arguments.models, &scene.parameters)?;
    let mut found = Vec::with_capacity(models.len());
    for model in models {
        let calibration =
            arguments.scene.named(calibrate(&scene.parameters, model, &grid, threads(arguments.threads)))?;
        output::to_stdout(&table(&calibration))?;
        found.push(calibration);
    }
    output::save(arguments.csv.as_ref(), || csv(&found))?;
    output::save(arguments.html.as_ref(), || page(&scene.title, &found))
}

/// The models named, or all that the wall can have.
fn models(names: &[String], parameters: &Parameters) -> Result<Vec<DampingModel>> {
    let rigid = parameters.multilinear.is_none() && parameters.force_law == ForceLaw::RigidLinear;
    if names.is_empty() {
        return Ok(if rigid {
            vec![DampingModel::FreeStandingBlock]
        } else {
            REGRESSIONS.map(|(model, ..)| model).to_vec()
        });
    }
    let model = |name: &String| match DampingModel::from_name(name) {
        Some(model) => Ok(model),
        None => bail!(
            "--models {name}: expected constant_coefficient, free_standing_block, constant_ratio or \
             stiffness_proportional"
        ),
    };
    names.iter().map(model).collect()
}

/// What the paper prints for x at a₁.
fn printed(model: DampingModel, a1: f64) -> Option<f64> {
    let regression = REGRESSIONS.iter().find(|(of, ..)| *of == model);
    match regression {
        Some((.., [q, r])) if a1 > 0.0 => Some(q * a1.powf(*r)),
        _ => (model == DampingModel::FreeStandingBlock).then_some(FREE_STANDING),
    }
}

/// The symbol of what is calibrated.
fn symbol(model: DampingModel) -> &'static str {
    match model {
        DampingModel::FreeStandingBlock => "c_bar",
        DampingModel::StiffnessProportional => "xi_1",
        _ => "xi",
    }
}

fn table(found: &Calibration) -> String {
    let symbol = symbol(found.model);
    let mut text = format!(
        "{} ({}): {symbol} = -x ln e\n  {:>9}{:>10}{:>10}{:>12}{:>12}\n",
        found.model.name(),
        abbreviation(found.model),
        "a1",
        "u0/u_ins",
        "x",
        "paper",
        "deviation"
    );
    for Coefficient { a1, start, x } in &found.coefficients {
        let _ = write!(text, "  {a1:>9}{start:>10}{x:>10.4}");
        if let Some(printed) = printed(found.model, *a1) {
            let _ = write!(text, "{printed:>12.4}{:>11.1}%", 100.0 * (x / printed - 1.0));
        }
        text.push('\n');
    }
    for (start, law) in &found.laws {
        let _ = write!(text, "  u0 = {start} u_ins: x = {:.4} a1^{:.4}", law.q, law.r);
        if let Some((.., [q, r])) = REGRESSIONS.iter().find(|(of, ..)| *of == found.model) {
            let _ = write!(text, "   (paper: {q} a1^{r})");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// Columns of the CSV.
const COLUMNS: &str = "damping_model,a1,u0_over_u_ins,restitution,damping,error,samples";

fn csv(found: &[Calibration]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for calibration in found {
        for Fit { a1, start, restitution, damping, error, samples } in &calibration.fits {
            let name = calibration.model.name();
            let _ = writeln!(text, "{name},{a1},{start},{restitution},{damping:e},{error:e},{samples}");
        }
    }
    text
}

fn page(title: &str, found: &[Calibration]) -> String {
    let mut charts: Vec<_> = found.iter().map(over_restitution).collect();
    charts.push(least_errors(found));
    if found.iter().any(|calibration| !calibration.laws.is_empty()) {
        charts.push(over_stiffness(found));
    }
    let figures: String = charts.iter().map(chart::figure).collect();
    let text: String = found.iter().map(table).collect();
    template::page(
        include_str!("calibrate.html"),
        &[
            ("title", &format!("Calibration: {}", escaped(title))),
            ("table", &escaped(&text)),
            ("figures", &figures),
        ],
    )
}

/// The number of the colour that a model has in all figures.
fn color(model: DampingModel) -> usize {
    model_color(if model == DampingModel::FreeStandingBlock { "block" } else { abbreviation(model) })
}

/// Draws ξ over e for some of the a₁ and u₀.
fn over_restitution(found: &Calibration) -> Chart {
    let every = found.coefficients.len().div_ceil(MOST_SERIES);
    let mut series = Vec::new();
    for (color, Coefficient { a1, start, x }) in found.coefficients.iter().step_by(every).enumerate() {
        let fits: Vec<&Fit> = found.fits.iter().filter(|fit| (fit.a1, fit.start) == (*a1, *start)).collect();
        let ends = fits
            .iter()
            .fold([1.0_f64, 0.0], |[low, high], fit| [low.min(fit.restitution), high.max(fit.restitution)]);
        let line = (0..=50).map(|part| {
            let e = ends[0] + (ends[1] - ends[0]) * f64::from(part) / 50.0;
            (e, -x * e.ln())
        });
        series.push(Series::line("", color, line.collect()));
        let points = fits.iter().map(|fit| (fit.restitution, fit.damping)).collect();
        series.push(Series::marks(&format!("a₁ = {a1}, u₀ = {start} u_ins"), color, points));
    }
    Chart {
        title: format!("{}: best fits and −x ln e", abbreviation(found.model)),
        x: Axis::new("e"),
        y: Axis::new(if found.model == DampingModel::FreeStandingBlock { "c_bar" } else { "damping ratio" }),
        series,
    }
}

/// Draws √Err over e at the middle a₁ and u₀.
fn least_errors(found: &[Calibration]) -> Chart {
    let mut title = String::new();
    let mut series = Vec::new();
    for calibration in found {
        let middle = calibration.coefficients[calibration.coefficients.len() / 2];
        title = format!("least error, a₁ = {}, u₀ = {} u_ins", middle.a1, middle.start);
        let fits = calibration.fits.iter().filter(|fit| (fit.a1, fit.start) == (middle.a1, middle.start));
        let points = fits.map(|fit| (fit.restitution, fit.error.sqrt())).collect();
        let color = color(calibration.model);
        series.push(Series::marks(abbreviation(calibration.model), color, points));
    }
    Chart { title, x: Axis::new("e"), y: Axis::new("√Err"), series }
}

/// Draws x over a₁, fitted and as printed.
fn over_stiffness(found: &[Calibration]) -> Chart {
    let mut series = Vec::new();
    let with_laws = found.iter().filter(|calibration| !calibration.laws.is_empty());
    for calibration in with_laws {
        let (start, law) = calibration.laws[calibration.laws.len() - 1];
        let points: Vec<_> =
            calibration.coefficients.iter().filter(|c| c.start == start).map(|c| (c.a1, c.x)).collect();
        let [low, high] =
            points.iter().fold([1.0_f64, 0.0], |[low, high], point| [low.min(point.0), high.max(point.0)]);
        let a1 = |part: i32| low + (high - low) * f64::from(part) / 100.0;
        let (name, color) = (abbreviation(calibration.model), color(calibration.model));
        let paper: Vec<_> = (0..=100)
            .filter_map(|part| printed(calibration.model, a1(part)).map(|x| (a1(part), x)))
            .collect();
        series.push(Series::dashed(&format!("{name}, paper"), color, paper));
        let fitted = (0..=100).map(|part| (a1(part), law.at(a1(part)))).collect();
        series.push(Series::line("", color, fitted));
        let name = format!("{name}: {:.3} a₁^{:.3}", law.q, law.r);
        series.push(Series::marks(&name, color, points));
    }
    Chart { title: "x over a₁".into(), x: Axis::new("a₁"), y: Axis::new("x"), series }
}
