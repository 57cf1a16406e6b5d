//! `cargo xtask book`: builds the book of docs/ with mdBook.

use std::path::PathBuf;

use crate::command::{Result, cargo, copy, output, program, read, succeed, target};
use crate::fmu;

/// The mdBook that builds the book.
const MDBOOK: &str = "0.5.4";

/// Prepares the sources, builds the book and prints where it is.
pub(crate) fn run() -> Result<()> {
    let programs = fmu::programs("demo", &["--package", "rocking-wall-cli", "--bin", "wall"])?;
    let folder = target().join("book");
    let mut prepare = program("python3");
    prepare.arg("xtask/book/prepare.py").arg(programs.join("wall"));
    succeed(prepare.arg(repository()?).arg(folder.join("src")), "see its message above")?;
    for name in ["book.toml", "book.css"] {
        copy(format!("xtask/book/{name}"), folder.join(name))?;
    }
    succeed(program(mdbook()?).arg("build").arg(&folder), "see its message above")?;
    println!("{}", folder.join("book/index.html").display());
    Ok(())
}

/// Installs mdBook under the target folder, once, and returns its path.
fn mdbook() -> Result<PathBuf> {
    let folder = target().join("mdbook");
    let path = folder.join("bin/mdbook");
    let is_there = path.is_file()
        && output(program(&path).arg("--version"), "delete it").is_ok_and(|text| text.contains(MDBOOK));
    if !is_there {
        let mut install = cargo();
        install.args(["install", "mdbook", "--locked", "--version", MDBOOK, "--root"]).arg(&folder);
        install.args(["--no-default-features", "--features", "search"]);
        succeed(&mut install, "the book needs mdBook; see its message above")?;
    }
    Ok(path)
}

/// The repository that the manifest names, for links to files that are not in the book.
fn repository() -> Result<String> {
    let manifest = read("Cargo.toml")?;
    let line = manifest.lines().find_map(|line| line.strip_prefix("repository = "));
    line.map(|url| url.trim_matches('"').to_owned())
        .ok_or_else(|| "Cargo.toml names no repository".to_owned())
}
