//! The pictures at the top of README and documents.

use crate::command::{Result, cargo, output, root};

/// Draws the pictures into `docs/images`.
pub(crate) fn run() -> Result<()> {
    let folder = root().join("docs/images");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    page("wall", &["simulate"])?;
    page("building", &["building", "scenes/building/three_storeys.toml"])?;
    let map = ["--heights", "1:6:21", "--ratios", "5:14:19", "--svg", "docs/images/spectrum.svg"];
    wall(&[&["spectrum", "--synthetic", "--pga", "2.5"], &map[..]].concat())?;
    let plot = ["--plot", "docs/images/work_precision.svg"];
    wall(&[&["verify", "accuracy", "scenes/parapet_on_a_roof.toml"], &plot[..]].concat())?;
    let results = root().join("target/images");
    if results.exists() {
        // the folder of a study by another build would be refused
        std::fs::remove_dir_all(&results).map_err(|error| format!("{}: {error}", results.display()))?;
    }
    wall(&["ida", "studies/stripes.toml", "-o", "target/images"])?;
    let fragilities = "fragilities.svg";
    std::fs::copy(results.join(fragilities), folder.join(fragilities))
        .map_err(|error| format!("{}: {error}", results.join(fragilities).display()))?;
    println!("written docs/images");
    Ok(())
}

/// Takes a picture of the page of a command under the synthetic motion.
fn page(name: &str, command: &[&str]) -> Result<()> {
    let (page, picture) = (format!("target/{name}.html"), format!("docs/images/{name}.png"));
    wall(&[command, &["--synthetic", "--html", &page]].concat())?;
    let arguments = ["--headless", "--no-sandbox", "--hide-scrollbars", "--window-size=1000,640"];
    let browser = std::process::Command::new("chromium")
        .args(arguments)
        .arg(format!("--screenshot={}", root().join(picture).display()))
        .arg(root().join(page))
        .output();
    match browser {
        Ok(output) if output.status.success() => Ok(()),
        Ok(output) => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
        Err(error) => Err(format!("chromium: {error}")),
    }
}

/// Runs `wall` as released, from the root, and returns what it prints.
pub(crate) fn wall(arguments: &[&str]) -> Result<String> {
    let mut run = cargo();
    run.current_dir(root()).args(["run", "--release", "--locked", "--quiet", "--bin", "wall", "--"]);
    output(run.args(arguments), "see its message above")
}
