//! `wall simulate`: run a scene, write its history and its page.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use rocking_wall::response::Response;
use rocking_wall::scene::{DEFAULT_TAIL, Scene, check_thresholds};
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Wall;

use crate::args::{RecordArguments, SceneArguments};
use crate::{demands, output, page};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    record: RecordArguments,
    /// Free vibration in s after a motion given here
    #[arg(long, value_name = "SECONDS")]
    tail: Option<f64>,
    /// Hold each sample until the next, as most importers do with an input, instead of interpolating
    #[arg(long)]
    hold: bool,
    /// End of the run in s
    #[arg(long, value_name = "SECONDS")]
    stop_time: Option<f64>,
    /// Step of the output in s
    #[arg(long, value_name = "SECONDS")]
    output_step: Option<f64>,
    /// Write the history as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with the rocking wall and its history
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Limit states as fractions of `u_ins` whose first crossings are reported, instead of the scene's
    /// [default: 0.1,0.4,0.6,1]
    #[arg(long, value_name = "FRACTIONS", value_delimiter = ',')]
    thresholds: Option<Vec<f64>>,
    /// Print the summary and the demands as JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let scene = arguments.scene()?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.record.record);
    output::check_distinct(inputs, arguments.csv.iter().chain(&arguments.html))?;
    // before the run, which may take long
    let wall = arguments.scene.named(Wall::new(&scene.parameters))?;
    for warning in wall.warnings() {
        output::warn(&warning.to_string());
    }
    let response = arguments.scene.named(Response::of(&scene))?;
    if response.summary.put_to_rest {
        output::warn("impacts accumulated beyond their bound: the wall was put to rest");
    }
    output::save(arguments.csv.as_ref(), || history(&response))?;
    if let Some(path) = &arguments.html {
        let page = page::render(&scene, &wall, &response)?;
        output::to_file(path, page.as_bytes())?;
    }
    let text = if arguments.json {
        json(&scene, &response)?
    } else {
        let mut text = table(&scene, &response);
        for path in [&arguments.csv, &arguments.html].into_iter().flatten() {
            let _ = writeln!(text, "written        {}", path.display());
        }
        text
    };
    output::to_stdout(&text)
}

impl Arguments {
    /// The scene to run.
    fn scene(&self) -> Result<Scene> {
        let mut scene = self.scene.load()?;
        if let Some((motion, note)) = self.record.load()? {
            let peak = format!("peak acceleration {:.4} m/s²", motion.peak());
            let tail = self.tail.unwrap_or(DEFAULT_TAIL);
            if !(0.0..=1e6).contains(&tail) {
                bail!("--tail {tail}: must be between 0 and 1e6 s");
            }
            scene.shake(Excitation::new(motion, None), tail, vec![note, peak]);
            if self.scene.scene.is_none() {
                scene.title = "The default parapet, shaken".into();
            }
        } else if self.tail.is_some() {
            bail!(
                "--tail belongs to a motion given with --record or --synthetic; a scene states its own tail"
            );
        }
        self.scene.apply(&mut scene)?;
        if self.hold {
            let Some(excitation) = scene.excitation.take() else {
                bail!("--hold needs a motion; give --record or --synthetic, or a scene with one");
            };
            scene.excitation = Some(excitation.held());
            scene.motion_notes.push("each sample held until the next".into());
        }
        for (name, given, value) in [
            ("--stop-time", self.stop_time, &mut scene.stop_time),
            ("--output-step", self.output_step, &mut scene.output_step),
        ] {
            if let Some(given) = given {
                if !(given > 0.0 && given <= 1e7) {
                    bail!("{name} {given}: must be above 0 and at most 1e7 s");
                }
                *value = given;
            }
        }
        if let Some(thresholds) = &self.thresholds {
            check_thresholds(thresholds)?;
            scene.thresholds.clone_from(thresholds);
        }
        Ok(scene)
    }
}

/// The columns of the history.
const COLUMNS: &str = "time,u,u_dot,u_ddot,u_ratio,restoring_force,damping_force,reaction_bottom,\
                       reaction_top,a_bottom,a_top";

fn history(response: &Response) -> String {
    let mut csv = format!("{COLUMNS}\n");
    for sample in &response.samples {
        let outputs = &sample.outputs;
        let _ = write!(csv, "{:.9}", sample.time);
        for value in [
            outputs.displacement,
            outputs.velocity,
            outputs.acceleration,
            outputs.ratio,
            outputs.restoring_force,
            outputs.damping_force,
            outputs.reactions.bottom,
            outputs.reactions.top,
            sample.support.bottom,
            sample.support.top,
        ] {
            let _ = write!(csv, ",{value:?}");
        }
        csv.push('\n');
    }
    csv
}

fn json(scene: &Scene, response: &Response) -> Result<String> {
    let summary = &response.summary;
    let value = serde_json::json!({
        "title": scene.title,
        "u_max": summary.u_max,
        "u_ratio_max": summary.u_ratio_max,
        "overturned": summary.overturned,
        "overturn_time": summary.overturn_time,
        "end_time": summary.end_time,
        "pieces": summary.work.pieces,
        "corners": summary.work.corners,
        "impacts": summary.work.impacts,
        "demands": demands::json(response),
    });
    Ok(serde_json::to_string_pretty(&value)? + "\n")
}

fn table(scene: &Scene, response: &Response) -> String {
    let summary = &response.summary;
    let mut text = format!("{}\n", scene.title);
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<15}{value}");
    };
    if !scene.motion_notes.is_empty() {
        line("motion", scene.motion_notes.join(", "));
    }
    let fallen = if summary.overturned { ", in the fall" } else { "" };
    line("largest |u|", format!("{:.6} m, {:.4} u_ins{fallen}", summary.u_max, summary.u_ratio_max));
    line(
        "overturned",
        summary.overturn_time.map_or_else(|| "no".to_owned(), |time| format!("at t = {time:.4} s")),
    );
    line("run", format!("{} s", figures::number(summary.end_time, 6)));
    line(
        "work",
        format!(
            "{} pieces of motion, {} corners, {} impacts",
            summary.work.pieces, summary.work.corners, summary.work.impacts
        ),
    );
    if summary.overturned {
        line("demands", "up to overturning".to_owned());
    }
    let has_top = scene.parameters.mechanism == Mechanism::VerticalSpanning;
    for (name, value) in demands::lines(response, has_top) {
        let _ = writeln!(text, "{name:<15}{value}");
    }
    text
}
