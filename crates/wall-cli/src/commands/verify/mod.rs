//! `wall verify`: is the program right? Beside formulas, published tests, the paper and other solvers.

mod accuracy;
mod paper;

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, Subcommand, value_parser};
use evidence::stability::page as maps_page;
use evidence::stability::{RowQuantity, extremes, map, maps};
use evidence::validation::PublishedTest;
use evidence::verification::{page as manual, verify};

use crate::args::svg_file;
use crate::output::{self, Console};

#[derive(Debug, Subcommand)]
pub(crate) enum Subject {
    /// Check every formula against a reference of its own
    Formulas(Formulas),
    /// Compare the model with a published test: a slow push or a free decay
    Tests(Tests),
    /// Compute every table and figure of the paper and compare it with print, on one page
    Paper(paper::Arguments),
    /// Measure the error of each solver against its run time
    #[command(allow_negative_numbers = true)]
    Accuracy(Box<accuracy::Arguments>),
    /// Map the stability of each solver, and run the extremes
    Stability(Stability),
}

#[derive(Debug, Args)]
pub(crate) struct Formulas {
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the verification manual with the results as a page
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the formulas, references and bounds of the manual as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Tests {
    /// A test (TOML), such as those of `tests/data/validation`
    test: PathBuf,
    /// Write the points and the model as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    plot: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Stability {
    /// Values of a1 from 1e-6 to 0.1
    #[arg(long, value_name = "COUNT", default_value_t = 11, value_parser = value_parser!(u32).range(2..=101))]
    columns: u32,
    /// Write the cells as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with heat maps
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

/// Exit code where a number is outside its bound.
const FAILED: u8 = 1;

/// Runs a command; returns its exit code.
pub(crate) fn run(console: &Console<'_>, subject: &Subject) -> Result<u8> {
    match subject {
        Subject::Formulas(arguments) => return formulas(console, arguments),
        Subject::Tests(arguments) => tests(console, arguments),
        Subject::Paper(arguments) => paper::run(console, arguments),
        Subject::Accuracy(arguments) => accuracy::run(console, arguments),
        Subject::Stability(arguments) => stability(console, arguments),
    }
    .map(|()| 0)
}

fn formulas(console: &Console<'_>, arguments: &Formulas) -> Result<u8> {
    let outputs = || arguments.html.iter().chain(&arguments.markdown);
    console.check_distinct([], outputs())?;
    let subject = format!("wall {}", env!("CARGO_PKG_VERSION"));
    let formulas = verify()?;
    console.save(arguments.html.as_ref(), || manual::page(&subject, &formulas))?;
    console.save(arguments.markdown.as_ref(), || manual::markdown(&formulas))?;
    if arguments.json {
        console.json(&manual::json(&subject, &formulas))?;
    } else {
        let (text, written) = (manual::text(&formulas), output::written("written ", outputs()));
        console.print(&format!("{subject}\n\n{text}{written}"))?;
    }
    let [_, failed] = manual::counts(&formulas);
    Ok(if failed == 0 { 0 } else { FAILED })
}

fn tests(console: &Console<'_>, arguments: &Tests) -> Result<()> {
    let case = PublishedTest::read(&arguments.test)?;
    console.check_distinct(&case.inputs, &arguments.plot)?;
    let (text, chart) = case.shown()?;
    console.print(&text)?;
    console.save(arguments.plot.as_ref(), || chart.figure_file())
}

fn stability(console: &Console<'_>, arguments: &Stability) -> Result<()> {
    console.check_distinct([], arguments.csv.iter().chain(&arguments.html))?;
    let mut made = Vec::new();
    for quantity in [RowQuantity::Step, RowQuantity::DampingRatio] {
        for (solver, damping) in maps() {
            let map = map(solver, damping, quantity, arguments.columns)?;
            console.print(&maps_page::summary(&map))?;
            made.push(map);
        }
    }
    let extremes = extremes()?;
    console.print(&format!("\n{}", maps_page::of_extremes(&extremes).text()))?;
    console.save(arguments.csv.as_ref(), || maps_page::of_cells(&made).csv())?;
    console.save(arguments.html.as_ref(), || maps_page::page(&made, &extremes))
}
