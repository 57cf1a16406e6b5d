//! `wall verify paper`: the paper's tables and figures, computed now, on one page.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use evidence::reproduce::collapse::{MEDIANS, figure_15};
use evidence::reproduce::page::{page, summary};
use evidence::reproduce::reproduce;
use ground_motion::{RecordOptions, read};
use run::parallel::threads;
use run::records::{NamedRecord, folder_files};

use crate::args::short_name;
use crate::output::{Console, progress};

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
    let reproduction = progress::shown(|| reproduce(threads))??;
    console.print(&summary(&reproduction))?;
    let collapses = records.map(|records| progress::shown(|| figure_15(records, threads))).transpose()?;
    let collapses = collapses.transpose()?;
    if let Some(collapses) = &collapses {
        console.print(&format!("{MEDIANS}\n{}", collapses.table.text()))?;
    }
    console.write(&arguments.output, page(&reproduction, collapses.as_ref()).as_bytes())
}

/// Reads the records of a folder in the order of their names; warns of the files it leaves out. The page must
/// not replace one of them.
fn records(console: &Console<'_>, folder: &Path, page: &PathBuf) -> Result<Vec<NamedRecord>> {
    let paths = folder_files(folder).with_context(|| format!("{}: cannot be read", folder.display()))?;
    console.check_distinct(&paths, [page])?;
    let (mut records, mut left_out) = (Vec::new(), Vec::new());
    for path in paths {
        match read(&path, &RecordOptions::default()) {
            Ok(record) => records.push(NamedRecord::new(short_name(&path), record.motion)),
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
