//! `wall stability`: maps over stiffness, step and damping, and the table of extremes.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, value_parser};
use evidence::stability::page::{axis_words, page, scientific};
use evidence::stability::{Extreme, Map, RowQuantity, extremes, map, maps};

use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
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

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    console.check_distinct([], arguments.csv.iter().chain(&arguments.html))?;
    let mut made = Vec::new();
    for quantity in [RowQuantity::Step, RowQuantity::DampingRatio] {
        for (solver, damping) in maps() {
            let map = map(solver, damping, quantity, arguments.columns)?;
            console.print(&summary(&map))?;
            made.push(map);
        }
    }
    let extremes = extremes()?;
    console.print(&table(&extremes))?;
    console.save(arguments.csv.as_ref(), || csv(&made))?;
    console.save(arguments.html.as_ref(), || page(&made, &extremes))
}

fn summary(map: &Map) -> String {
    let cells = || map.cells.iter().flatten();
    let unstable = cells().filter(|cell| !cell.stable).count();
    let worst = cells().map(|cell| cell.error).fold(0.0, f64::max);
    format!(
        "{:<10}{:<24} a1 x {:<5} {:>4} cells, {unstable:>3} unstable, largest error {worst:.1e}\n",
        map.solver.name(),
        map.damping.name(),
        axis_words(map.quantity),
        cells().count()
    )
}

fn table(extremes: &[Extreme]) -> String {
    let mut text = String::from("\n");
    for extreme in extremes {
        let Extreme { name, criterion, value, limit } = extreme;
        let (value, limit) = (scientific(*value, 1), scientific(*limit, 0));
        let verdict = if extreme.holds() { "holds" } else { "BROKEN" };
        let _ = writeln!(text, "{verdict:<7}{name:<33}{value:>9} of {limit}: {criterion}");
    }
    text
}

/// Columns of the CSV; the error is over `u_ins`, the growth over the energy at the start.
const COLUMNS: &str = "solver,damping_model,axis,a1,value,stable,error,growth";

/// The quantity of a row of a map, with its unit.
fn axis(quantity: RowQuantity) -> &'static str {
    match quantity {
        RowQuantity::Step => "step_s",
        RowQuantity::DampingRatio => "xi",
    }
}

fn csv(maps: &[Map]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for map in maps {
        for (row, cells) in map.rows.iter().zip(&map.cells) {
            for (a1, cell) in map.columns.iter().zip(cells) {
                let _ = writeln!(
                    text,
                    "{},{},{},{a1:e},{row:e},{},{:e},{:e}",
                    map.solver.name(),
                    map.damping.name(),
                    axis(map.quantity),
                    cell.stable,
                    cell.error,
                    cell.growth
                );
            }
        }
    }
    text
}
