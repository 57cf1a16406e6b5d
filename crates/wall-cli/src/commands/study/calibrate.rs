//! `wall study calibrate`: the damping that matches restitution, section 5 of the paper for any wall.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use report::{chart, escaped};
use run::model::{Label, damping_models, label};
use run::parallel::threads;
use study::calibration::figure::{charts, printed};
use study::calibration::{
    Calibration, Coefficient, Fit, Grid, REGRESSIONS, STEP, calibrate, calibrated_models, model_named,
};

use crate::args::SceneArguments;
use crate::output::Console;
use report::template;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[arg(long, value_delimiter = ',', help = help_of_models())]
    models: Vec<String>,
    /// Coefficients of restitution, separated by commas
    #[arg(long, value_name = "E", value_delimiter = ',', default_values_t = Grid::default().restitution)]
    restitution: Vec<f64>,
    /// Ends of the elastic branch over `u_ins`, separated by commas; a multilinear or rigid-linear law
    /// has its own
    #[arg(long, value_name = "A1", value_delimiter = ',', default_values_t = Grid::default().a1)]
    a1: Vec<f64>,
    /// Initial displacements over `u_ins`, separated by commas
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

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load(console)?;
    arguments.scene.apply(&mut scene)?;
    console.check_distinct(arguments.scene.inputs(&scene), arguments.csv.iter().chain(&arguments.html))?;
    let grid = Grid {
        restitution: arguments.restitution.clone(),
        a1: arguments.a1.clone(),
        start: arguments.start.clone(),
        step: arguments.step,
    };
    let models = match &*arguments.models {
        [] => calibrated_models(&scene.parameters),
        names => names.iter().map(|name| model_named(name)).collect::<Result<_, _>>().context("--models")?,
    };
    let mut found = Vec::with_capacity(models.len());
    for model in models {
        let calibration =
            arguments.scene.named(calibrate(&scene.parameters, model, &grid, threads(arguments.threads)))?;
        console.print(&table(&calibration))?;
        found.push(calibration);
    }
    console.save(arguments.csv.as_ref(), || csv(&found))?;
    console.save(arguments.html.as_ref(), || page(&scene.title, &found))
}

fn help_of_models() -> String {
    let names: Vec<_> = damping_models().map(|model| format!("`{}`", model.name())).collect();
    let names = names.join(", ");
    format!("Damping models, separated by commas: {names} [default: all that the force law allows]")
}

fn table(found: &Calibration) -> String {
    let Label { name: short, symbol, .. } = label(found.model);
    let mut text = format!(
        "{} ({short}): {symbol} = -x ln e\n         a1  u0/u_ins         x       paper   deviation\n",
        found.model.name()
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
    let figures: String = charts(found).iter().map(chart::figure).collect();
    let text: String = found.iter().map(table).collect();
    template::page(
        include_str!("../../../../study/src/calibration/page.html"),
        &[
            ("title", &format!("Calibration: {}", escaped(title))),
            ("table", &escaped(&text)),
            ("figures", &figures),
        ],
    )
}
