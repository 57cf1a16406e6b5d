//! `wall study ida`, `reliability` and `merge`: incremental dynamic analyses, on all cores, interruptible, in
//! shards.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use clap::Args;
use reliability::{Codes, Reliability};
use report::counted;
use run::parallel;
use study::folder::{Folder, Report, compute};
use study::loaded::LoadedStudy;

use crate::output::{self, Console, progress};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Study file (TOML): walls, records, damping models, intensity, levels
    study: PathBuf,
    /// Folder of the results [default: the study's name and `_results`]; a study that is started again
    /// continues where it stopped
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Number of threads [default: one for each core]
    #[arg(long, value_name = "COUNT")]
    threads: Option<NonZeroUsize>,
    /// Run one of n shards, such as 2/8, for the array jobs of a cluster; `wall study merge` merges them
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArguments {
    /// Folders of the shards, or the one they share
    #[arg(required = true, value_name = "FOLDER")]
    pub(crate) folders: Vec<PathBuf>,
    /// Folder of the merged study
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

/// The number of one of several shares of the parts of a study, from 1, and how many there are.
type Shard = (usize, usize);

fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    let valid = numbers.filter(|(number, of)| (1..=*of).contains(number));
    valid.ok_or_else(|| "expected I/N with I from 1 to N, such as 2/8".to_owned())
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    analyse(console, arguments, LoadedStudy::read(&arguments.study, &Codes)?, None)
}

/// The same analysis, and after it how safe its walls are where they just pass a check.
pub(crate) fn reliability(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let loaded = LoadedStudy::read(&arguments.study, &Codes)?;
    let reliability = Reliability::of(&loaded)?;
    analyse(console, arguments, loaded, Some(reliability))
}

fn analyse(
    console: &Console<'_>,
    arguments: &Arguments,
    loaded: LoadedStudy,
    reliability: Option<Reliability>,
) -> Result<()> {
    let path = match (&arguments.output, arguments.study.file_stem()) {
        (Some(path), _) => checked(path)?.clone(),
        (None, Some(stem)) => PathBuf::from(format!("{}_results", stem.to_string_lossy())),
        (None, None) => bail!("{}: not a file", arguments.study.display()),
    };
    let of_reliability = reliability.is_some().then_some(&reliability::FILES).into_iter().flatten();
    let files = study::folder::FILES.iter().chain(of_reliability);
    console.check_distinct(&loaded.inputs, &files.map(|name| path.join(name)).collect::<Vec<_>>())?;
    let folder = Folder::of_study(&path, &loaded)?;
    console.report_all(loaded.warnings.iter().map(|warning| format!("warning: {warning}")));
    let threads = parallel::threads(arguments.threads).get();
    let (number, shards) = arguments.shard.unwrap_or((1, 1));
    let contents = folder.contents();
    let mine: Vec<usize> = contents.shard(number, shards).collect();
    let missing = folder.missing(mine.iter().copied());
    // files of damaged parts exist, but count as missing
    console.warn(folder.damage(&missing));
    let cases = |parts: &[usize]| parts.iter().map(|&part| contents.part(part).len()).sum::<usize>();
    let found = cases(&mine) - cases(&missing);
    if found > 0 {
        console.report(&format!("{found} of {} combinations are done already", cases(&mine)));
    }
    tell_of_resuming()?;
    let start = Instant::now();
    let runs = progress::shown(|| compute(&loaded.study, &folder, &missing, threads))??;
    drop(loaded);
    let told = if missing.is_empty() {
        Ok(())
    } else {
        let (runs, seconds) = (counted(runs, "run"), start.elapsed().as_secs_f64());
        // a summary that cannot be printed must not prevent the results from being written
        console.print(&format!("{runs} in {seconds:.1} s on {}\n", counted(threads, "thread")))
    };
    if shards > 1 {
        let name = path.display();
        // merging makes the tables of the analysis alone
        let then = match reliability {
            Some(_) => format!("wall study reliability {} -o {name}", arguments.study.display()),
            None => format!("wall study merge {name}"),
        };
        return console.print(&format!("shard {number} of {shards} is done; when all are: {then}\n"));
    }
    finish(console, &folder, threads).and(told)?;
    let Some(reliability) = reliability else { return Ok(()) };
    told_of(console, &progress::shown(|| reliability::finish(&folder, &reliability, threads))??)
}

pub(crate) fn merge(console: &Console<'_>, arguments: &MergeArguments) -> Result<()> {
    let folders = arguments.folders.iter().map(|path| Folder::open(path)).collect::<Result<Vec<_>, _>>()?;
    let into = arguments.output.as_ref().map(checked).transpose()?;
    let target = study::folder::merge(folders, into.map(PathBuf::as_path))?;
    finish(console, &target, parallel::threads(None).get())
}

/// Refuses standard output as a folder.
fn checked(path: &PathBuf) -> Result<&PathBuf> {
    if path.as_os_str() == "-" {
        bail!("-o -: the results are a folder of files, which standard output cannot take; give a folder");
    }
    Ok(path)
}

/// Exit code of a program that Ctrl-C has ended, 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// Makes Ctrl-C print that the same command resumes the study. Nothing has to be saved then: each finished
/// part is a complete file.
fn tell_of_resuming() -> Result<()> {
    ctrlc::set_handler(|| {
        let (mut sink, mut stderr) = (std::io::sink(), std::io::stderr());
        let console = Console::new(&mut sink, &mut stderr);
        // ends the line of progress
        console.to_stderr("\n");
        console.report("interrupted; finished parts are kept, and the same command resumes");
        std::process::exit(INTERRUPTED);
    })
    // a second study of the same process has one already
    .or_else(|error| if matches!(error, ctrlc::Error::MultipleHandlers) { Ok(()) } else { Err(error) })
    .context("Ctrl-C")
}

/// Makes the final results of a folder whose parts are complete.
fn finish(console: &Console<'_>, folder: &Folder, threads: usize) -> Result<()> {
    told_of(console, &progress::shown(|| study::folder::finish(folder, threads))??)
}

fn told_of(console: &Console<'_>, report: &Report) -> Result<()> {
    console.warn(&report.warnings);
    console.print(&(report.summary.clone() + &output::written("written  ", &report.files)))
}
