//! `wall study calibrate`: the damping that matches restitution, section 5 of the paper for any wall.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use run::model::damping_models;
use run::parallel::threads;
use study::calibration::page::page;
use study::calibration::{Grid, STEP, calibrate, calibrated_models, model_named, table};

use crate::args::{SceneArguments, apply_set};
use crate::output::Console;

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
    apply_set(&arguments.scene.set, &mut scene)?;
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
        console.print(&table::text(&calibration))?;
        found.push(calibration);
    }
    console.save(arguments.csv.as_ref(), || table::fits(&found).csv())?;
    console.save(arguments.html.as_ref(), || page(&scene.title, &found))
}

fn help_of_models() -> String {
    let names: Vec<_> = damping_models().map(|model| format!("`{}`", model.name())).collect();
    let names = names.join(", ");
    format!("Damping models, separated by commas: {names} [default: all that the force law allows]")
}
