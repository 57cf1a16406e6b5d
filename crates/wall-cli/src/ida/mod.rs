//! `wall ida` and `wall merge`: incremental dynamic analyses, on all cores, interruptible, in shards.

#[cfg(feature = "parquet")]
mod columns;
mod folder;
mod page;
mod results;

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

use anyhow::{Result, bail};
use clap::Args;
use ground_motion::STANDARD_GRAVITY;
use study::ida::{Exceedance, Study};
use study::loaded::LoadedStudy;
use study::parallel;

use crate::output;
use crate::progress::Progress;

use folder::Folder;
use results::Results;

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
    /// Run one of n parts, such as 2/8, for the array jobs of a cluster; `wall merge` merges them
    #[arg(long, value_name = "I/N")]
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

/// One of several parts of a study.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shard {
    /// From 1.
    pub(crate) number: usize,
    pub(crate) of: usize,
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err("expected I/N with I from 1 to N, such as 2/8".to_owned()),
        }
    }
}

/// Files of the results, beside one for each run.
const FILES: [&str; 6] =
    ["study.json", "levels.csv", "collapses.csv", "fragilities.csv", "study.html", "levels.parquet"];

/// Most missing combinations that a message names.
const NAMED: usize = 3;

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let loaded = LoadedStudy::read(&arguments.study)?;
    let path = match (&arguments.output, arguments.study.file_stem()) {
        (Some(path), _) => path.clone(),
        (None, Some(stem)) => PathBuf::from(format!("{}_results", stem.to_string_lossy())),
        (None, None) => bail!("{}: not a file", arguments.study.display()),
    };
    output::check_distinct(&loaded.inputs, &FILES.map(|name| path.join(name)))?;
    let folder = Folder::of_study(&path, &loaded.title, &loaded.study, &loaded.report)?;
    output::report_all(loaded.warnings.iter().map(|warning| format!("warning: {warning}")));
    let threads = parallel::threads(arguments.threads).get();
    let [shard, shards] = arguments.shard.map_or([0, 1], |shard| [shard.number - 1, shard.of]);
    let mine: Vec<usize> = (0..loaded.study.count()).filter(|index| index % shards == shard).collect();
    let missing: Vec<usize> = mine.iter().copied().filter(|&index| folder.curve(index).is_none()).collect();
    folder.warn_of_damage(&missing);
    let found = mine.len() - missing.len();
    if found > 0 {
        output::report(&format!("{found} of {} combinations are done already", mine.len()));
    }
    let words = work(&loaded.study, &folder, &missing, threads)?;
    // results are worth more than words
    let told = output::to_stdout(&words);
    if shards > 1 {
        let name = path.display();
        return output::to_stdout(&format!(
            "shard {} of {shards} is done; when all are: wall merge {name}\n",
            shard + 1
        ));
    }
    finish(&folder, threads).and(told)
}

pub(crate) fn merge(arguments: &MergeArguments) -> Result<()> {
    let mut folders = arguments.folders.iter().map(|path| Folder::open(path)).collect::<Result<Vec<_>>>()?;
    let first = folders[0].manifest.clone();
    for folder in &folders[1..] {
        folder.expect(&first.contents)?;
    }
    let target = match (&arguments.output, folders.len()) {
        (Some(path), _) => Folder::like(path, &first)?,
        (None, 1) => folders.remove(0),
        (None, _) => bail!("several folders are merged into another; give it with -o FOLDER"),
    };
    let mut missing = Vec::new();
    for index in 0..first.contents.count() {
        if target.curve(index).is_some() {
            continue;
        }
        match folders.iter().find_map(|folder| folder.curve(index)) {
            Some(curve) => target.keep(index, &curve)?,
            None => missing.push(index),
        }
    }
    if !missing.is_empty() {
        for folder in folders.iter().chain([&target]) {
            folder.warn_of_damage(&missing);
        }
        bail!("{}", missing_message(&target, &missing));
    }
    finish(&target, parallel::threads(None).get())
}

/// Says which combinations are missing.
fn missing_message(folder: &Folder, missing: &[usize]) -> String {
    let contents = &folder.manifest.contents;
    let name = |&index: &usize| {
        let case = contents.case(index);
        format!(
            "wall {:?} with {} under {:?}",
            contents.walls[case.wall].name,
            contents.models[case.model].name,
            contents.records[case.record].name
        )
    };
    let names: Vec<_> = missing.iter().take(NAMED).map(name).collect();
    let more = if missing.len() > NAMED { " …" } else { "" };
    format!(
        "{} of {} combinations are missing: {}{more}; run their shards again, or name the folders that hold \
         them too",
        missing.len(),
        contents.count(),
        names.join(", ")
    )
}

/// Time and amount of work of one model.
#[derive(Clone, Copy, Default)]
struct Share {
    seconds: f64,
    runs: usize,
    samples: f64,
}

/// Runs what is missing; returns the throughput of each model.
fn work(study: &Study, folder: &Folder, missing: &[usize], threads: usize) -> Result<String> {
    if missing.is_empty() {
        return Ok(String::new());
    }
    let progress = Progress::new();
    let shares = Mutex::new(vec![Share::default(); study.models().len()]);
    let start = Instant::now();
    let outcome = parallel::map(missing.len(), threads, |place| -> Result<()> {
        let index = missing[place];
        let case = study.case(index);
        let begun = Instant::now();
        let curve = study.curve(case)?;
        let seconds = begun.elapsed().as_secs_f64();
        folder.keep(index, &curve)?;
        let runs = curve.runs().len();
        if let Ok(mut shares) = shares.lock() {
            let share = &mut shares[case.model];
            share.seconds += seconds;
            share.runs += runs;
            share.samples += (runs * study.records()[case.record].motion.samples().len()) as f64;
        }
        progress.add(missing.len(), runs);
        Ok(())
    });
    progress.finish();
    outcome?;
    let shares = shares.into_inner().unwrap_or_default();
    let runs: usize = shares.iter().map(|share| share.runs).sum();
    let mut text = format!("{runs} runs in {:.1} s on {threads} threads\n", start.elapsed().as_secs_f64());
    let _ =
        writeln!(text, "{:<16}{:>10}{:>18}{:>22}", "model", "runs", "runs/s a core", "ns a sample and run");
    for (model, share) in study.models().iter().zip(&shares).filter(|(_, share)| share.runs > 0) {
        let (rate, each) = (share.runs as f64 / share.seconds, 1e9 * share.seconds / share.samples);
        let _ = writeln!(text, "{:<16}{:>10}{rate:>18.0}{each:>22.1}", model.name, share.runs);
    }
    Ok(text)
}

/// Makes the final results of a folder whose runs are complete.
fn finish(folder: &Folder, threads: usize) -> Result<()> {
    let contents = &folder.manifest.contents;
    let mut curves = Vec::with_capacity(contents.count());
    let mut missing = Vec::new();
    for index in 0..contents.count() {
        match folder.curve(index) {
            Some(curve) => curves.push(curve),
            None => missing.push(index),
        }
    }
    if !missing.is_empty() {
        bail!("{}", missing_message(folder, &missing));
    }
    folder.sweep();
    let results = Results::new(folder.manifest.clone(), curves, threads);
    let mut files = vec![
        ("levels.csv", results.levels_csv().into_bytes()),
        ("collapses.csv", results.collapses_csv().into_bytes()),
        ("fragilities.csv", results.fragilities_csv().into_bytes()),
        ("study.html", page::page(&results).into_bytes()),
    ];
    #[cfg(feature = "parquet")]
    files.push(("levels.parquet", columns::levels(&results)?));
    if let Some(warning) = contradictions(&results) {
        output::warn(&warning);
    }
    let mut text = summary(&results);
    for (name, bytes) in &mut files {
        let path = folder.path().join(*name);
        output::to_file(&path, bytes)?;
        let _ = writeln!(text, "written  {}", path.display());
    }
    output::to_stdout(&text)
}

/// The collapse of every wall and model as a table.
fn summary(results: &Results) -> String {
    let contents = results.contents();
    let report = &results.manifest.report;
    let Some(collapse) = report.fractions.iter().position(|fraction| *fraction == 1.0) else {
        return String::new();
    };
    let width = |names: &mut dyn Iterator<Item = &String>| {
        names.map(|name| name.chars().count()).max().unwrap_or(0).max("model".len()) + 2
    };
    let wall_width = width(&mut contents.walls.iter().map(|wall| &wall.name));
    let model_width = width(&mut contents.models.iter().map(|model| &model.name));
    let mut text = format!(
        "{} runs; collapse {} in g, 95 % intervals of {} resamples of {} records\n",
        results.data.runs(),
        contents.measure,
        report.resamples,
        contents.records.len()
    );
    let ratio_name = format!("median/{}", report.reference);
    let _ = writeln!(
        text,
        "{:<wall_width$}{:<model_width$}{:>12}{:>26}{:>14}{:>7}{:>10}{ratio_name:>36}",
        "wall", "model", "median", "", "theta", "beta", "censored"
    );
    for (w, wall) in contents.walls.iter().enumerate() {
        for (model, summary) in contents.models.iter().zip(results.data.summaries(w, collapse)) {
            let beta = summary.fitted.map_or("–".to_owned(), |fit| format!("{:.3}", fit.dispersion));
            let [median, low, high] = summary.median.texts(STANDARD_GRAVITY, Some(3));
            let [theta, ..] = summary.theta.texts(STANDARD_GRAVITY, Some(3));
            let [ratio, ratio_low, ratio_high] = summary.median_ratio.texts(1.0, Some(3));
            let _ = writeln!(
                text,
                "{:<wall_width$}{:<model_width$}{median:>12}{:>26}{theta:>14}{beta:>7}{:>10}{:>36}",
                wall.name,
                model.name,
                format!("{low} … {high}"),
                summary.censored,
                format!("{ratio} ({ratio_low} … {ratio_high})")
            );
        }
    }
    text + &resurrections(results)
}

/// Warns of walls and models whose limit states contradict a common β.
fn contradictions(results: &Results) -> Option<String> {
    let contents = results.contents();
    let found = results.data.contradicted();
    let name = |&[w, m]: &[usize; 2]| {
        let states = results.manifest.report.fractions.len();
        let alone = (0..states).filter_map(|state| results.data.summaries(w, state)[m].alone.ok());
        let alone: Vec<_> = alone.map(|fit| format!("{:.2}", fit.dispersion)).collect();
        let (wall, model) = (&contents.walls[w].name, &contents.models[m].name);
        format!("wall {wall:?} with {model} ({})", alone.join(", "))
    };
    let names: Vec<_> = found.iter().take(NAMED).map(name).collect();
    let more = if found.len() > NAMED { " …" } else { "" };
    (!found.is_empty()).then(|| {
        format!(
            "limit states contradict a common beta in {} of {} fits: {}{more}; their fitted curves are \
             rough, see the steps on the page and beta_alone in fragilities.csv",
            found.len(),
            contents.walls.len() * contents.models.len(),
            names.join(", ")
        )
    })
}

/// How many curves are not monotonic, if any.
fn resurrections(results: &Results) -> String {
    let contents = results.contents();
    let resurrected = (0..contents.walls.len() * contents.models.len())
        .flat_map(|pair| results.data.curves(pair / contents.models.len(), pair % contents.models.len()))
        .filter(|curve| matches!(curve.collapse(), Exceedance::At(_)) && curve.resurrections() > 0)
        .count();
    if resurrected == 0 {
        return String::new();
    }
    format!(
        "{resurrected} of {} curves stand again above their first overturning, which counts as the \
         collapse\n",
        contents.count()
    )
}
