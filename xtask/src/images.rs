//! The pictures at the top of README and documents.

use crate::command::{Result, cargo, copy, make_folder, output, program, remove_folder, root};

/// Draws the pictures into `docs/images`.
pub(crate) fn run() -> Result<()> {
    make_folder(&root().join("docs/images"))?;
    page("wall", &["simulate"])?;
    page("building", &["building", "scenes/building/three_storeys.toml"])?;
    let map = ["--heights", "1:6:21", "--ratios", "5:14:19", "--svg", "docs/images/spectrum.svg"];
    wall(&[&["study", "spectrum", "--synthetic", "--pga", "2.5"], &map[..]].concat())?;
    let plot = ["--plot", "docs/images/work_precision.svg"];
    wall(&[&["verify", "accuracy", "scenes/parapet_on_a_roof.toml"], &plot[..]].concat())?;
    // the folder of a study by another build would be refused
    remove_folder(&root().join("target/images"))?;
    wall(&["study", "ida", "studies/stripes.toml", "-o", "target/images"])?;
    copy("target/images/fragilities.svg", "docs/images/fragilities.svg")?;
    println!("written docs/images");
    Ok(())
}

/// Takes a picture of the page of a command under the synthetic motion.
fn page(name: &str, command: &[&str]) -> Result<()> {
    let (page, picture) = (format!("target/{name}.html"), format!("docs/images/{name}.png"));
    wall(&[command, &["--synthetic", "--html", &page]].concat())?;
    let arguments = ["--headless", "--no-sandbox", "--hide-scrollbars", "--window-size=1000,640"];
    let mut browser = program("chromium");
    browser.args(arguments).arg(format!("--screenshot={}", root().join(picture).display()));
    output(browser.arg(root().join(page)), "the pictures of pages need it").map(drop)
}

/// Runs `wall` as released, from the root, and returns what it prints.
pub(crate) fn wall(arguments: &[&str]) -> Result<String> {
    let mut run = cargo();
    run.args(["run", "--profile", "dist", "--locked", "--quiet", "--bin", "wall", "--"]);
    output(run.args(arguments), "see its message above")
}
