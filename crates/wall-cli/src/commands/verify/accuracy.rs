//! `wall verify accuracy`: error against run time.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use evidence::accuracy::page::{Peers, page, picture, read_peers};
use evidence::accuracy::table::{table, text};
use evidence::accuracy::{Problem, defaults, measure};
use evidence::reproduce::rotations::{self, Rotations};
use scene::Scene;

use crate::args::{RecordArguments, svg_file};
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Scene files (TOML); without any a set from mild to very stiff
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    record: RecordArguments,
    /// Write the measurements as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with work-precision plots
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the work-precision plots as SVG; with --peers the plots of the
    /// other tools instead
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    plot: Option<PathBuf>,
    /// Measurements of other tools for the page or the plot, the CSV of `cargo xtask bench --peers`
    #[arg(long, value_name = "FILE")]
    peers: Option<PathBuf>,
    /// Write the periods of small and of full rotations against slenderness as CSV
    #[arg(long, value_name = "FILE")]
    linearisation: Option<PathBuf>,
    /// Time to spend on timing each setting in s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.05)]
    budget: f64,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    if !(0.0..=3600.0).contains(&arguments.budget) {
        bail!("--budget {}: must be between 0 and 3600 s", arguments.budget);
    }
    if !arguments.scenes.is_empty()
        && (arguments.record.record.is_some() || arguments.record.motion.synthetic)
    {
        bail!(
            "--record and --synthetic replace the motion of the built-in scenes; a scene file states its own \
             in [motion]"
        );
    }
    if arguments.peers.is_some() && arguments.html.is_none() && arguments.plot.is_none() {
        bail!("--peers adds measurements to a page or a plot: add --html FILE or --plot FILE");
    }
    let scenes = arguments.scenes.iter().map(|path| Scene::read(path)).collect::<Result<Vec<_>, _>>()?;
    let records = scenes.iter().flat_map(|scene| &scene.files).chain(&arguments.record.record);
    console.check_distinct(
        arguments.scenes.iter().chain(records).chain(&arguments.peers),
        [&arguments.csv, &arguments.linearisation, &arguments.html, &arguments.plot].into_iter().flatten(),
    )?;
    let problems = if scenes.is_empty() {
        let record = arguments.record.load(console)?;
        defaults(record.as_ref().map(|(motion, _)| motion))?
    } else {
        scenes.iter().map(Problem::from_scene).collect::<Result<_, _>>()?
    };
    let peers = arguments.peers.as_deref().map(peers).transpose()?;
    let mut studies = Vec::with_capacity(problems.len());
    for problem in &problems {
        let study = measure(problem, arguments.budget)?;
        console.print(&text(&study))?;
        studies.push(study);
    }
    let both = Rotations::of_both()?;
    // its walls are not those of the scenes given
    if arguments.scenes.is_empty() || arguments.linearisation.is_some() {
        console.print(&rotations::text(&both))?;
    }
    console.save(arguments.csv.as_ref(), || table(&studies).csv())?;
    console.save(arguments.linearisation.as_ref(), || rotations::table(&both).csv())?;
    console.save(arguments.plot.as_ref(), || picture(&studies, peers.as_ref()))?;
    if arguments.html.is_some() {
        let figures = rotations::figures(&both)?;
        console.save(arguments.html.as_ref(), || page(&studies, &figures, peers.as_ref()))?;
    }
    Ok(())
}

fn peers(path: &Path) -> Result<Peers> {
    let text =
        std::fs::read_to_string(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    let peers = read_peers(&text);
    if peers.is_empty() {
        bail!("{}: no measurement; give the CSV that `cargo xtask bench --peers` writes", path.display());
    }
    Ok(peers)
}
