//! The pictures at the top of README and documents.

use crate::command::{Result, cargo, output, root};

/// Draws the pictures into `docs/images`.
///
/// # Errors
/// If the program fails.
pub(crate) fn run() -> Result<()> {
    let folder = root().join("docs/images");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    wall(&["simulate", "--synthetic", "--svg", "docs/images/wall.svg"])?;
    let building = "scenes/building/three_storeys.toml";
    wall(&["building", building, "--synthetic", "--svg", "docs/images/building.svg"])?;
    println!("written docs/images");
    Ok(())
}

fn wall(arguments: &[&str]) -> Result<String> {
    let mut run = cargo();
    run.current_dir(root()).args(["run", "--release", "--locked", "--quiet", "--bin", "wall", "--"]);
    output(run.args(arguments), "see its message above")
}
