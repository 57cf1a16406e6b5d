//! The pictures at the top of README and documents.

use crate::command::{Result, cargo, output, root};

/// Draws the pictures into `docs/images`.
pub(crate) fn run() -> Result<()> {
    let folder = root().join("docs/images");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    wall(&["simulate", "--synthetic", "--svg", "docs/images/wall.svg"])?;
    let building = "scenes/building/three_storeys.toml";
    wall(&["building", building, "--synthetic", "--svg", "docs/images/building.svg"])?;
    let map = ["--heights", "1:6:21", "--ratios", "5:14:19", "--svg", "docs/images/spectrum.svg"];
    wall(&[&["study", "spectrum", "--synthetic", "--pga", "2.5"], &map[..]].concat())?;
    let plot = ["--plot", "docs/images/work_precision.svg"];
    wall(&[&["accuracy", "scenes/parapet_on_a_roof.toml"], &plot[..]].concat())?;
    let results = root().join("target/images");
    if results.exists() {
        // the folder of a study by another build would be refused
        std::fs::remove_dir_all(&results).map_err(|error| format!("{}: {error}", results.display()))?;
    }
    wall(&["study", "ida", "studies/stripes.toml", "-o", "target/images"])?;
    let fragilities = "fragilities.svg";
    std::fs::copy(results.join(fragilities), folder.join(fragilities))
        .map_err(|error| format!("{}: {error}", results.join(fragilities).display()))?;
    println!("written docs/images");
    Ok(())
}

/// Runs `wall` as released, from the root, and returns what it prints.
pub(crate) fn wall(arguments: &[&str]) -> Result<String> {
    let mut run = cargo();
    run.current_dir(root()).args(["run", "--release", "--locked", "--quiet", "--bin", "wall", "--"]);
    output(run.args(arguments), "see its message above")
}
