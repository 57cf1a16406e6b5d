//! `wall simulate`: run a scene, write its history and its page.

mod arguments;
mod records;

use anyhow::Result;
use rocking_wall::wall::{Parameters, Wall};
use scene::response::Response;

use run::demands;

use crate::output::{self, Console};

pub(crate) use arguments::Arguments;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    if !arguments.listed().is_empty() {
        return records::run(console, arguments);
    }
    let scene = arguments.scene(console)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.record.record);
    let outputs = [&arguments.csv, &arguments.html];
    console.check_distinct(inputs, outputs.into_iter().flatten())?;
    let wall = arguments.scene.named(Wall::new(&scene.parameters))?;
    console.warn(scene.warnings_of(&wall));
    console.warn(wall.start_warning(scene.parameters.u_start));
    let Parameters { u_start, u_dot_start, .. } = scene.parameters;
    if scene.excitation.is_none() && [u_start, u_dot_start] == [0.0; 2] {
        console.warn(["nothing moves the wall, which starts upright: give --record, --synthetic or u_start"]);
    }
    let response = arguments.scene.named(Response::of(&scene))?;
    console.warn(scene.floors.iter().flat_map(|floors| floors.warnings(&wall)));
    if response.summary.put_to_rest {
        console.warn(["the limit on impacts in one step was reached: the wall was put to rest"]);
    }
    console.save(arguments.csv.as_ref(), || response.csv())?;
    if let Some(path) = &arguments.html {
        console.write(path, run::page::render(&scene, &wall, &response)?.as_bytes())?;
    }
    if arguments.json {
        let mut value = serde_json::to_value(&response)?;
        value["title"] = scene.title.clone().into();
        return console.json(&value);
    }
    let written = output::written("written        ", outputs.into_iter().flatten());
    console.print(&(demands::summary(&scene, &response) + &written))
}
