//! `wall simulate`: run a scene, write its history and its page.

mod arguments;
mod records;

use std::fmt::Write;

use anyhow::Result;
use report::counted;
use rocking_wall::response::Response;
use rocking_wall::scene::Scene;
use rocking_wall::solver::Work;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Wall;

use run::demands;

use crate::output::{self, Console};

pub(crate) use arguments::Arguments;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    if !arguments.table().is_empty() {
        return records::run(console, arguments);
    }
    let scene = arguments.scene(console)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.record.record);
    let outputs = [&arguments.csv, &arguments.html];
    console.check_distinct(inputs, outputs.into_iter().flatten())?;
    let wall = arguments.scene.named(Wall::new(&scene.parameters))?;
    wall.warnings().iter().for_each(|warning| console.warn(&warning.to_string()));
    let response = arguments.scene.named(Response::of(&scene))?;
    for warning in scene.floors.iter().flat_map(|floors| floors.warnings(&wall)) {
        console.warn(&warning);
    }
    if response.summary.put_to_rest {
        console.warn("the limit on impacts in one step was reached: the wall was put to rest");
    }
    console.save(arguments.csv.as_ref(), || response.csv())?;
    if let Some(path) = &arguments.html {
        let page = run::page::render(&scene, &wall, &response)?;
        console.write(path, page.as_bytes())?;
    }
    let text = if arguments.json {
        json(&scene, &response)?
    } else {
        table(&scene, &response) + &output::written("written        ", outputs.into_iter().flatten())
    };
    console.print(&text)
}

fn json(scene: &Scene, response: &Response) -> Result<String> {
    let mut value = serde_json::to_value(response)?;
    value["title"] = scene.title.clone().into();
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
    line("largest |u|", demands::largest(summary, "m", 6));
    line("overturned", demands::overturned(summary.fate, 4));
    line("run", format!("{} s", report::number(summary.end_time, 6)));
    let Work { pieces, corners, impacts } = summary.work;
    let [pieces, corners, impacts] = [(pieces, "piece"), (corners, "corner"), (impacts, "impact")]
        .map(|(count, noun)| counted(count, noun));
    line("work", format!("{pieces} of motion, {corners}, {impacts}"));
    if let Some(until) = demands::until(response) {
        line("demands", until.to_owned());
    }
    let has_top = scene.parameters.mechanism == Mechanism::VerticalSpanning;
    for (name, value) in demands::lines(response, has_top) {
        let _ = writeln!(text, "{name:<15}{value}");
    }
    text
}
