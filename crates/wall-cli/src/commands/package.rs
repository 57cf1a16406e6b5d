//! `wall package`: an FMU of one scene.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use scene::Scene;
use scene_fmu::{General, of_scene};

use crate::args::warn_of_motion;
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Scene file (TOML)
    scene: PathBuf,
    /// The FMU to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Version of FMI
    #[arg(long, value_name = "VERSION", default_value = "2", value_parser = ["2", "3"])]
    fmi: String,
    /// The general FMU to start from, whose version counts (`fmu_out/wall.fmu`, `fmu_out/fmi3/wall.fmu`)
    #[arg(long, value_name = "FILE", conflicts_with = "fmi")]
    base: Option<PathBuf>,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let scene = Scene::read(&arguments.scene)?;
    let made = if arguments.fmi == "3" { "fmu_out/fmi3/wall.fmu" } else { "fmu_out/wall.fmu" };
    let base = arguments.base.clone().unwrap_or_else(|| made.into());
    console.check_distinct([&arguments.scene, &base].into_iter().chain(&scene.files), [&arguments.output])?;
    let named = || arguments.scene.display().to_string();
    let wall = scene_fmu::check(&scene).with_context(named)?;
    warn_of_motion(console, &arguments.scene, &scene);
    console.warn(scene.warnings_of(&wall));
    console.warn(wall.start_warning(scene.parameters.u_start));
    let general = General::open(&base)
        .context("expected a general FMU; make it with `cargo xtask fmu`, or name it with --base")?;
    let unit = of_scene(&scene, general).with_context(named)?;
    console.write(&arguments.output, &unit.archive.to_bytes()?)?;
    console.print(&format!(
        "{}: {}, {} of {} variables\n",
        arguments.output.display(),
        scene.title,
        unit.variables,
        unit.general_variables
    ))
}
