//! `wall check`: a wall against a code, or its capacity curve against a response spectrum.

mod code;
mod find;
mod spectrum;
mod walls;

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use check::circolare::{Sought, read_table};
use clap::Args;
use rocking_wall::scene::{Place, read_text};

use crate::args::{SceneArguments, refuse};
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    spectrum: spectrum::SpectrumArguments,
    /// With `[check]`: find the smallest thickness, tie strength or stiffness, or the largest height, that
    /// passes
    #[arg(long, value_name = "PARAMETER", value_parser = sought)]
    find: Option<Sought>,
    /// With --find: write `zeta_E` over the parameter as a chart (SVG)
    #[arg(long, value_name = "FILE", requires = "find")]
    plot: Option<PathBuf>,
    /// With a study: write one row for each wall, the worst first, as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write a page: the capacity curve over the demand, or the walls of a study
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// With `[check]`: write the report for a calculation file as a page
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// With --report: the date to print in it, in any form
    #[arg(long, value_name = "TEXT", requires = "report")]
    date: Option<String>,
}

/// Largest file that is looked into for its tables.
const MAX_FILE_BYTES: u64 = 4 << 20;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let Some(path) = &arguments.scene.scene else {
        arguments.refuse_those_of_the_code("the default wall")?;
        return spectrum::run(console, arguments);
    };
    let (name, text) = (path.display().to_string(), read_text(path, "a scene file (TOML)", MAX_FILE_BYTES)?);
    if is_study(&text) {
        return walls::run(console, arguments, path, &text);
    }
    let place = Place::new(&name, &text);
    let Some(table) = read_table(&place)? else {
        arguments.refuse_those_of_the_code(&name)?;
        return spectrum::run(console, arguments);
    };
    arguments.spectrum.refuse(&name)?;
    if arguments.csv.is_some() {
        bail!("{name}: --csv lists the walls of a study; this is a scene");
    }
    if arguments.html.is_some() {
        bail!("{name}: --html draws a spectrum, or the walls of a study; --report is the page of a check");
    }
    let case = code::Case::read(console, arguments, &table, &place)?;
    match arguments.find {
        Some(_) if arguments.report.is_some() => {
            bail!("{name}: --report covers the wall as given; leave out --find")
        }
        Some(sought) => find::run(console, arguments, &case, sought),
        None => code::run(console, arguments, &case),
    }
}

impl Arguments {
    /// Refuses the options that need a table `[check]`.
    fn refuse_those_of_the_code(&self, name: &str) -> Result<()> {
        let given = [
            ("--find", self.find.is_some()),
            ("--csv", self.csv.is_some()),
            ("--report", self.report.is_some()),
        ];
        let why = "needs a table [check] with code = \"circolare-2019\"";
        refuse(given, why).with_context(|| name.to_owned())
    }
}

/// Returns whether a text has walls, as a study has.
fn is_study(text: &str) -> bool {
    text.parse::<toml::Table>().is_ok_and(|keys| keys.contains_key("walls"))
}

fn sought(name: &str) -> Result<Sought, String> {
    Sought::ALL
        .into_iter()
        .find(|sought| sought.name() == name)
        .ok_or_else(|| format!("expected {}", Sought::ALL.map(Sought::name).join(", ")))
}
