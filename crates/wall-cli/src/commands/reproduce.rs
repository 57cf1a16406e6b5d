//! `wall reproduce`: the paper's tables and figures, computed now, on one page.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use evidence::reproduce::collapse::figure_15;
use evidence::reproduce::page::page;
use evidence::reproduce::{Cell, Reproduction, Table, Value, reproduce};
use ground_motion::{RecordOptions, read};
use run::parallel::threads;
use run::records::NamedRecord;

use crate::output::{self, Console, progress};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Records to scale for Figure 15: every file of this folder that can be read without unit or channel
    #[arg(long, value_name = "FOLDER")]
    records: Option<PathBuf>,
    /// The page to write
    #[arg(short, long, value_name = "FILE", default_value = "reproduction.html")]
    output: PathBuf,
    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "COUNT")]
    threads: Option<NonZeroUsize>,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    // before anything is computed: a wrong folder should not cost a minute
    let records =
        arguments.records.as_deref().map(|folder| records(console, folder, &arguments.output)).transpose()?;
    let threads = threads(arguments.threads);
    let reproduction = progress::shown(|progress| reproduce(threads, |all| progress.add(all, 0)))?;
    console.print(&summary(&reproduction))?;
    let collapses = records
        .map(|records| progress::shown(|progress| figure_15(records, threads, |all| progress.add(all, 0))));
    let collapses = collapses.transpose()?;
    if let Some(collapses) = &collapses {
        console.print(&plain(&collapses.table))?;
    }
    console.write(&arguments.output, page(&reproduction, collapses.as_ref()).as_bytes())
}

/// Reads the records of a folder in the order of their names; warns of the files it leaves out. The page must
/// not replace one of them.
fn records(console: &Console<'_>, folder: &Path, page: &PathBuf) -> Result<Vec<NamedRecord>> {
    let entries =
        std::fs::read_dir(folder).with_context(|| format!("{}: cannot be read", folder.display()))?;
    let mut paths = entries.map(|entry| Ok(entry?.path())).collect::<std::io::Result<Vec<_>>>()?;
    paths.retain(|path| path.is_file());
    paths.sort();
    console.check_distinct(&paths, [page])?;
    let (mut records, mut left_out) = (Vec::new(), Vec::new());
    for path in paths {
        match read(&path, &RecordOptions::default()) {
            Ok(record) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                records.push(NamedRecord { name, motion: record.motion });
            }
            Err(error) => left_out.push(format!("warning: left out: {error}")),
        }
    }
    console.report_all(left_out);
    if records.is_empty() {
        bail!(
            "{}: no record to read; give a folder with records that state their unit, such as AT2",
            folder.display()
        );
    }
    Ok(records)
}

fn summary(reproduction: &Reproduction) -> String {
    let mut text = String::new();
    for table in &reproduction.tables {
        let [agree, all] = table.counts();
        let _ = write!(text, "{:<24}{agree:>4} of {all:>3} numbers round to print", table.name);
        if let Some((deviation, place)) = worst(table) {
            let _ = write!(text, "; largest deviation {:.1} %, {place}", 100.0 * deviation);
        }
        text.push('\n');
        for line in table.notes.iter().flat_map(|note| output::wrapped(note, 96)) {
            let _ = writeln!(text, "    {line}");
        }
    }
    let numbers: Vec<String> = reproduction.figures.iter().map(|figure| figure.number.to_string()).collect();
    let _ = writeln!(text, "Figures {}", numbers.join(", "));
    text
}

/// Finds the largest relative deviation of a table, and where it is.
fn worst(table: &Table) -> Option<(f64, String)> {
    let cells = table.rows.iter().flat_map(|row| row.iter().zip(&table.columns).map(move |cell| (row, cell)));
    let deviations = cells.filter_map(|(row, (cell, column))| match cell {
        Cell::Value(value) if value.printed != 0.0 => {
            Some(((value.computed / value.printed - 1.0).abs(), row, column, value))
        }
        Cell::Value(_) | Cell::Text(_) => None,
    });
    let (deviation, row, column, value) = deviations.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let Value { computed, printed, decimals } = *value;
    let (name, finer) = (row.first().map_or_else(String::new, words), decimals + 1);
    Some((deviation, format!("{name}, {column}: printed {printed:.decimals$}, computed {computed:.finer$}")))
}

/// Formats a table that has no printed numbers.
fn plain(table: &Table) -> String {
    let mut text = format!("{}: {}\n", table.name, table.title);
    let columns: Vec<String> = table.columns.iter().map(ToString::to_string).collect();
    let rows = table.rows.iter().map(|row| row.iter().map(words).collect());
    for row in std::iter::once(columns).chain(rows) {
        for (index, cell) in row.iter().enumerate() {
            let width = if index < 2 { 6 } else { 24 };
            let _ = write!(text, "{cell:<width$}");
        }
        text = text.trim_end().to_owned() + "\n";
    }
    text
}

fn words(cell: &Cell) -> String {
    match cell {
        Cell::Text(words) => words.clone(),
        Cell::Value(Value { computed, decimals, .. }) => format!("{computed:.decimals$}"),
    }
}
