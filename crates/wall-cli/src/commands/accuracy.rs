//! `wall accuracy`: error against run time, as a table, as CSV and as a page.

mod linearisation;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use evidence::accuracy::linearisation::both_rotations;
use evidence::accuracy::page::{Peers, page, picture, read_peers};
use evidence::accuracy::{Measurement, Problem, WorkPrecision, defaults, measure};
use rocking_wall::scene::Scene;

use crate::args::RecordArguments;
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
    #[arg(long, value_name = "FILE")]
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
    let records = scenes.iter().flat_map(|scene| &scene.records).chain(&arguments.record.record);
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
        console.print(&table(&study))?;
        studies.push(study);
    }
    let rotations = both_rotations()?;
    // its walls are not those of the scenes given
    if arguments.scenes.is_empty() || arguments.linearisation.is_some() {
        console.print(&linearisation::table(&rotations))?;
    }
    console.save(arguments.csv.as_ref(), || csv(&studies))?;
    console.save(arguments.linearisation.as_ref(), || linearisation::csv(&rotations))?;
    console.picture(arguments.plot.as_ref(), || Ok(picture(&studies, peers.as_ref())))?;
    console.save(arguments.html.as_ref(), || page(&studies, &rotations, peers.as_ref()))
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

fn table(study: &WorkPrecision) -> String {
    let mut text = format!("{}\n", study.name);
    let fate = match study.overturning {
        Some(time) => format!("overturns at {time:.6} s"),
        None => format!("u_max/u_ins {:.4}", study.peak),
    };
    let reference = if study.exact { "exact" } else { "adaptive at 1e-13" };
    let _ = writeln!(
        text,
        "  {fate}; reference {reference}; a change of the motion is amplified {:.1e} times, rounding alone \
         may cause {:.0e}",
        study.amplification,
        study.rounding()
    );
    text += "  solver    setting             max error  rms error       peak t overt. s    time ms    \
             pieces  corners  impacts\n";
    for row in &study.measurements {
        let optional = |error: Option<f64>| error.map_or_else(|| "-".into(), |error| format!("{error:.1e}"));
        let (peak, overturning) = (optional(row.error_peak), optional(row.error_overturning));
        let _ = writeln!(
            text,
            "  {:<10}{:<18}{:>11.1e}{:>11.1e}{peak:>11}{overturning:>11}{:>11.3}{:>10}{:>9}{:>9}",
            row.setting.solver(),
            row.setting.describe(study.step),
            row.error_max,
            row.error_rms,
            row.seconds * 1e3,
            row.work.pieces,
            row.work.corners,
            row.work.impacts
        );
    }
    text.push('\n');
    text
}

/// Columns of the CSV. An error without a unit is relative to `u_ins`, except that of the peak, which is
/// relative to the peak.
const COLUMNS: &str = "scene,solver,setting,run_time_s,error_max,error_rms,error_peak,error_overturn_time_s,\
                       pieces,corners,impacts,amplification";

fn csv(studies: &[WorkPrecision]) -> String {
    let mut text = format!("{COLUMNS}\n");
    let optional = |error: Option<f64>| error.map_or_else(String::new, |error| format!("{error:e}"));
    for study in studies {
        for Measurement { setting, seconds, error_max, error_rms, error_peak, error_overturning, work } in
            &study.measurements
        {
            let _ = writeln!(
                text,
                "\"{}\",{},{},{seconds:e},{error_max:e},{error_rms:e},{},{},{},{},{},{:e}",
                study.name.replace('"', "\"\""),
                setting.solver(),
                setting.describe(study.step),
                optional(*error_peak),
                optional(*error_overturning),
                work.pieces,
                work.corners,
                work.impacts,
                study.amplification
            );
        }
    }
    text
}
