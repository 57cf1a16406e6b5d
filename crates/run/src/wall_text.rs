//! A wall as tables of a study file: what a study's folder keeps of it, and what another process gets.

use std::path::Path;

use files::{FileError, TomlFile};
use rocking_wall::wall::{COMPUTED, Parameters, Ratio};
use scene::{Document, Scene, apply_tables, read_floors, to_toml};

use crate::named_wall::NamedWall;
use crate::wall_parameters::{WALL_GROUPS, is_of_models};

/// Writes the parameters and storeys of a wall as tables of a study file.
pub fn wall_text(wall: &NamedWall) -> String {
    // with a ratio of its own a scene leaves out e, which other models need
    let mut parameters = wall.parameters.clone();
    parameters.leave_out_ratios();
    let floors = wall.floors.clone();
    let text = to_toml(&Scene { parameters, floors, ..Scene::default() }, "");
    let mut is_wanted = false;
    let mut kept = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            let group = line.trim_matches(['[', ']']);
            is_wanted = WALL_GROUPS.contains(&group) || ["supports", "storeys"].contains(&group);
        }
        let name = line.split(" =").next().unwrap_or_default();
        if is_wanted && !line.is_empty() && !is_of_models(name) {
            kept.push_str(line);
            kept.push('\n');
            if line == "[damping]" {
                let numbers = Ratio::ALL.map(|ratio| (ratio.name(), wall.parameters.ratio(ratio)));
                let stated = numbers.into_iter().filter(|(_, number)| *number != COMPUTED);
                kept.extend(stated.map(|(name, number)| format!("{name} = {number:?}\n")));
            }
        }
    }
    kept
}

/// Reads a wall from its tables.
///
/// # Errors
/// [`FileError`] with line and value.
pub fn wall_of_text(name: String, text: &str) -> Result<NamedWall, FileError> {
    let file = &TomlFile::new(&name, text)?;
    let wall: Document = file.read()?;
    let mut parameters = Parameters::default();
    // the text has the points of a capacity curve, not its file
    apply_tables(&mut parameters, &wall.groups(), &wall.tie, file, Path::new(""))?;
    let floors = read_floors(&wall.storeys, wall.supports.as_ref(), file.place())?;
    Ok(NamedWall { floors, ..NamedWall::new(name, parameters) })
}
