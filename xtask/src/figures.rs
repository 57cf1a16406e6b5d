//! `cargo xtask figures`: measures accuracy, stability and the peers, compares the model with published
//! tests and each formula with its reference, and writes the figures into `docs/accuracy.md`,
//! `docs/validation.md` and `docs/verification.md`.

use std::fmt::Write as _;

use crate::bench;
use crate::command::{Result, at, cargo, output, read, root, target, write};
use crate::images::{self, wall};

const DOCUMENT: &str = "docs/accuracy.md";
const VALIDATION: &str = "docs/validation.md";
const VERIFICATION: &str = "docs/verification.md";
/// Published tests, a TOML file and a mark of the document each.
const TESTS: &str = "tests/data/validation";
/// The scene of the peers in the README: `OpenSeesPy` offers its damping.
const SHOWN: &str = "wall 5 CDC,";
/// First words of the last table of `wall verify accuracy`.
const ROTATIONS: &str = "small rotations: their period";

/// Measures and writes everything; `record` is the motion of the walls of Table 5.
pub(crate) fn run(record: Option<&str>) -> Result<()> {
    peers(record)?;
    let mut accuracy = vec!["verify", "accuracy", "--csv", "fmu_out/accuracy.csv"];
    accuracy.extend(["--html", "fmu_out/accuracy.html", "--peers", bench::PEERS]);
    let path = record.map(std::path::absolute).transpose().map_err(|error| format!("the record: {error}"))?;
    let path = path.map(|path| path.display().to_string());
    if let Some(path) = &path {
        accuracy.extend(["--record", path]);
    }
    let accuracy = wall(&accuracy)?;
    let rotations = accuracy.find(ROTATIONS).map_or("", |start| &accuracy[start..]);
    let stability =
        wall(&["verify", "stability", "--csv", "fmu_out/stability.csv", "--html", "fmu_out/stability.html"])?;
    let mut noise = cargo();
    noise.args(["run", "--profile", "dist", "--locked", "--quiet", "--package", "rocking-study"]);
    noise.args(["--example", "record_noise"]);
    let figures = [
        ("accuracy", condensed(&read("fmu_out/accuracy.csv")?)),
        ("stability", fenced(&stability)),
        ("rotations", fenced(rotations)),
        ("noise", fenced(&output(&mut noise, "see its message above")?)),
    ];
    write_marked(DOCUMENT, &figures)?;
    println!("written {DOCUMENT}, fmu_out/accuracy.html, fmu_out/stability.html");
    validation()?;
    verification()?;
    images::run()
}

/// Measures the peers, and writes their table and their picture.
pub(crate) fn peers(record: Option<&str>) -> Result<()> {
    let peers = bench::peers(record)?;
    write_marked(DOCUMENT, &[("peers", fenced(&peers))])?;
    beside_other_tools()
}

/// Draws one wall of the peers for the README: single runs, and not the reference beside itself.
fn beside_other_tools() -> Result<()> {
    let text = read(bench::PEERS)?;
    if let Some(missing) = text.lines().find(|line| line.starts_with("all,")) {
        println!("docs/images/peers.svg stays as it is: {missing}");
        return Ok(());
    }
    let shown =
        |line: &&str| line.starts_with(SHOWN) && !["by step", "at once"].iter().any(|w| line.contains(w));
    let lines = text.lines().filter(shown);
    let path = target().join("shown_peers.csv");
    write(&path, lines.collect::<Vec<_>>().join("\n"))?;
    let path = path.display().to_string();
    let scene = ["verify", "accuracy", "scenes/parapet_on_a_roof.toml", "--budget", "0"];
    wall(&[&scene[..], &["--peers", &path, "--plot", "docs/images/peers.svg"]].concat()).map(drop)
}

/// Compares the model with each published test: its numbers and its picture.
pub(crate) fn validation() -> Result<()> {
    let mut figures = Vec::new();
    for entry in std::fs::read_dir(root().join(TESTS)).map_err(at(TESTS.as_ref()))? {
        let file = entry.map_err(at(TESTS.as_ref()))?.file_name().to_string_lossy().into_owned();
        let Some(name) = file.strip_suffix(".toml") else { continue };
        let plot = format!("docs/images/{name}.svg");
        let table = wall(&["verify", "tests", &format!("{TESTS}/{file}"), "--plot", &plot])?;
        figures.push((name.to_owned(), fenced(&table)));
    }
    write_marked(VALIDATION, &figures)?;
    println!("written {VALIDATION} and its pictures");
    Ok(())
}

/// Writes the formulas that `wall verify formulas` checks, with references and bounds.
///
/// # Errors
/// As [`run`].
pub(crate) fn verification() -> Result<()> {
    let formulas = wall(&["verify", "formulas", "--markdown", "-"])?;
    write_marked(VERIFICATION, &[("formulas", format!("\n{formulas}"))])?;
    println!("written {VERIFICATION}");
    Ok(())
}

fn fenced(text: &str) -> String {
    format!("```text\n{}\n```\n", text.trim_matches('\n'))
}

/// Writes figures between the marks `<!-- mark -->` and `<!-- end mark -->` of a document.
pub(crate) fn write_marked(document: &str, figures: &[(impl AsRef<str>, String)]) -> Result<()> {
    let mut text = read(document)?;
    for (mark, figures) in figures {
        text = replaced(document, &text, mark.as_ref(), figures)?;
    }
    write(document, text)
}

fn replaced(document: &str, text: &str, mark: &str, figures: &str) -> Result<String> {
    let (begin, end) = (format!("<!-- {mark} -->\n"), format!("<!-- end {mark} -->"));
    let missing = || format!("{document}: expected the marks `{}` and `{end}`", begin.trim_end());
    let (before, rest) = text.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}{figures}{end}{after}"))
}

/// Makes one row for each scene: the solver that `automatic` selects, Newmark at the record's step and at its
/// finest.
fn condensed(csv: &str) -> String {
    let mut table = String::from(
        "| scene | solver | time [ms] | error | Newmark: error | time [ms] | fine: error | time [ms] |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).filter_map(fields).collect();
    for scene in rows.chunk_by(|a, b| a[0] == b[0]) {
        let of = |solver: &'static str| scene.iter().filter(move |row| row[1] == solver);
        let own = of("exact").next().or_else(|| of("adaptive").find(|row| row[2] == "tolerance 1e-8"));
        let (Some(own), Some(coarse), Some(fine)) = (own, of("newmark").next(), of("newmark").next_back())
        else {
            continue;
        };
        let milliseconds = |row: &[&str]| row[3].parse::<f64>().map_or(f64::NAN, |seconds| seconds * 1e3);
        let error = |row: &[&str]| row[4].parse::<f64>().unwrap_or(f64::NAN);
        let setting = if own[1] == "exact" { "exact" } else { "adaptive, 1e-8" };
        let _ = writeln!(
            table,
            "| {} | {setting} | {:.3} | {:.0e} | {:.0e} | {:.2} | {:.0e} | {:.0} |",
            scene[0][0],
            milliseconds(own),
            error(own),
            error(coarse),
            milliseconds(coarse),
            error(fine),
            milliseconds(fine)
        );
    }
    table
}

/// Splits a line whose first field may be quoted.
fn fields(line: &str) -> Option<Vec<&str>> {
    let quoted = line.strip_prefix('"').and_then(|rest| rest.split_once("\","));
    let (scene, rest) = quoted.or_else(|| line.split_once(','))?;
    Some(std::iter::once(scene).chain(rest.split(',')).collect())
}
