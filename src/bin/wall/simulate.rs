//! `wall simulate`: run a scene, write its history and its page.

use std::fmt::Write;

use anyhow::Result;
use rocking_wall::response::{Response, Summary};
use rocking_wall::scene::Scene;
use rocking_wall::wall::Wall;

use crate::args::SimulateArguments;
use crate::{output, page};

pub(crate) fn run(arguments: &SimulateArguments) -> Result<()> {
    let scene = arguments.scene()?;
    let response = Response::of(&scene)?;
    for warning in &response.warnings {
        output::note(&warning.to_string());
    }
    if response.summary.stilled {
        output::note("impacts accumulated beyond their bound: the wall was put to rest");
    }
    if let Some(path) = &arguments.csv {
        output::to_file(path, history(&response).as_bytes())?;
    }
    if let Some(path) = &arguments.html {
        let page = page::render(&scene, &Wall::new(&scene.parameters)?, &response)?;
        output::to_file(path, page.as_bytes())?;
    }
    let text = if arguments.json {
        json(&scene, &response.summary)?
    } else {
        let mut text = table(&scene, &response.summary);
        for path in [&arguments.csv, &arguments.html].into_iter().flatten() {
            let _ = writeln!(text, "written        {}", path.display());
        }
        text
    };
    output::to_stdout(&text)
}

/// The columns of the history.
const COLUMNS: &str = "time,u,u_dot,u_ddot,u_ratio,restoring_force,damping_force,reaction_bottom,reaction_top,\
                       a_bottom,a_top";

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

fn json(scene: &Scene, summary: &Summary) -> Result<String> {
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
    });
    Ok(serde_json::to_string_pretty(&value)? + "\n")
}

fn table(scene: &Scene, summary: &Summary) -> String {
    let mut text = format!("{}\n", scene.title);
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<15}{value}");
    };
    if !scene.motion_notes.is_empty() {
        line("motion", scene.motion_notes.join(", "));
    }
    line("largest |u|", format!("{:.6} m, {:.4} u_ins", summary.u_max, summary.u_ratio_max));
    line(
        "overturned",
        summary.overturn_time.map_or_else(|| "no".to_owned(), |time| format!("at t = {time:.4} s")),
    );
    line("run", format!("{} s", summary.end_time));
    line(
        "work",
        format!(
            "{} pieces of motion, {} corners, {} impacts",
            summary.work.pieces, summary.work.corners, summary.work.impacts
        ),
    );
    text
}
