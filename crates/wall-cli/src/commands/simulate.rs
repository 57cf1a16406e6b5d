//! `wall simulate`: run a scene, write its history and its page.

mod arguments;
mod records;

use anyhow::Result;
use rocking_wall::response::Response;
use rocking_wall::wall::Wall;

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
        let mut value = serde_json::to_value(&response)?;
        value["title"] = scene.title.clone().into();
        serde_json::to_string_pretty(&value)? + "\n"
    } else {
        demands::summary(&scene, &response)
            + &output::written("written        ", outputs.into_iter().flatten())
    };
    console.print(&text)
}
