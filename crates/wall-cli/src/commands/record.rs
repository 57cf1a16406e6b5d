//! `wall record`: what record files hold, their intensity, and a quick check.

mod listing;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use ground_motion::spectrum::{AVERAGE_PERIODS, DAMPING};
use ground_motion::{Check, Format, Maxima, Record, RecordOptions, STANDARD_GRAVITY, Spectrum};
use report::plot::Picture;
use run::records_figure;
use serde_json::{Value, json};

use crate::args::{self, RecordOptionsArguments};
use crate::output::{self, Console};
use report::table::quoted;

fn files_help() -> String {
    let formats = Format::listed();
    format!("Records: {formats} or text; a folder is listed, one row a file; `-` is standard input")
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[arg(group = "recorded", required = true, value_name = "FILES", help = files_help())]
    files: Vec<PathBuf>,
    #[command(flatten)]
    options: RecordOptionsArguments,
    /// Periods in s to show Sa at, separated by commas
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values_t = [0.2, 0.5, 1.0, 2.0])]
    periods: Vec<f64>,
    /// Periods in s whose geometric mean of Sa is AvgSA, separated by commas
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values_t = AVERAGE_PERIODS)]
    average: Vec<f64>,
    /// Damping ratio of the oscillators
    #[arg(long, value_name = "RATIO", default_value_t = DAMPING)]
    damping: f64,
    /// Take the maxima at the samples only, as many programs do, instead of wherever they lie
    #[arg(long)]
    at_samples: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the table as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw the histories and the spectra, as SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// One channel of a file, and what is printed about it.
struct Row {
    path: PathBuf,
    file: String,
    record: Record,
    /// AvgSA (g).
    average: f64,
    /// Sa (g) at the periods asked for.
    accelerations: Vec<f64>,
    check: Check,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let maxima = if arguments.at_samples { Maxima::AtSamples } else { Maxima::Everywhere };
    let spectrum = Spectrum::new(arguments.damping, maxima)?;
    let options = arguments.options.options()?;
    let is_listing = arguments.files.iter().any(|path| path.is_dir());
    let files = args::record_files(&arguments.files)?;
    console.check_distinct(&files, arguments.csv.iter().chain(&arguments.plot))?;
    let mut rows = Vec::new();
    let (mut failures, mut missing) = (Vec::new(), 0);
    for path in &files {
        match read(path, &options, arguments, spectrum) {
            Ok(found) => rows.extend(found),
            Err(error) => {
                failures.push(output::message(&error));
                missing += usize::from(arguments.files.contains(path));
            }
        }
    }
    if let ([failure], true) = (&failures[..], rows.is_empty()) {
        bail!("{failure}");
    }
    if is_listing && !rows.is_empty() {
        show(console, &rows, &failures, arguments, spectrum)?;
        // a folder may have files that are no records
        if missing > 0 {
            bail!("{missing} of the files that are named could not be read; they are listed as not read");
        }
        return Ok(());
    }
    if files.is_empty() {
        bail!("{}: a folder without files; name a folder with records", arguments.files[0].display());
    }
    let count = failures.len();
    console.report_all(failures);
    if !rows.is_empty() {
        show(console, &rows, &[], arguments, spectrum)?;
    }
    if count > 0 {
        bail!("{} of {} files could not be read", count, files.len());
    }
    Ok(())
}

fn read(path: &Path, options: &RecordOptions, arguments: &Arguments, spectrum: Spectrum) -> Result<Vec<Row>> {
    let in_g = |acceleration: f64| acceleration / STANDARD_GRAVITY;
    let mut rows = Vec::new();
    for record in args::read_channels(path, options)? {
        let in_file = || path.display().to_string();
        let average = spectrum.average(&record.motion, &arguments.average).with_context(in_file)?;
        let accelerations =
            spectrum.accelerations(&record.motion, &arguments.periods).with_context(in_file)?;
        let check = record.check();
        rows.push(Row {
            path: path.to_owned(),
            file: args::short_name(path),
            average: in_g(average),
            accelerations: accelerations.into_iter().map(in_g).collect(),
            check,
            record,
        });
    }
    Ok(rows)
}

/// Shows what was read; of a folder, also the `unread` files.
fn show(
    console: &Console<'_>,
    rows: &[Row],
    unread: &[String],
    arguments: &Arguments,
    spectrum: Spectrum,
) -> Result<()> {
    console.picture(arguments.plot.as_ref(), || picture(rows, spectrum, arguments.damping))?;
    console.save(arguments.csv.as_ref(), || csv(rows, &arguments.periods))?;
    if arguments.json {
        let value = json!({
            "damping": arguments.damping,
            "maxima": if arguments.at_samples { "at_samples" } else { "everywhere" },
            "average_periods_s": arguments.average,
            "periods_s": arguments.periods,
            "records": rows.iter().map(Row::json).collect::<Vec<_>>(),
            "unread": unread,
        });
        return console.print(&(serde_json::to_string_pretty(&value)? + "\n"));
    }
    let written = output::written("written  ", arguments.plot.iter().chain(&arguments.csv));
    let is_listing = arguments.files.iter().any(|path| path.is_dir());
    let table = if is_listing { listing::table(rows, unread) } else { table(rows, arguments) };
    console.print(&(table + &written))
}

impl Row {
    /// The file and its channel.
    fn name(&self) -> String {
        match &self.record.channel {
            Some(channel) => format!("{} [{channel}]", self.file),
            None => self.file.clone(),
        }
    }

    fn peak(&self) -> f64 {
        self.record.motion.peak() / STANDARD_GRAVITY
    }

    fn json(&self) -> Value {
        let motion = &self.record.motion;
        json!({
            "file": self.file,
            "channel": self.record.channel,
            "format": self.record.format.name(),
            "unit": self.record.unit.name(),
            "points": motion.samples().len(),
            "step_s": motion.step(),
            "duration_s": motion.duration(),
            "pga_g": self.peak(),
            "average_sa_g": self.average,
            "sa_g": self.accelerations,
            "mean_m_s2": self.check.mean,
            "peak_velocity_m_s": self.check.peak_velocity,
            "final_velocity_m_s": self.check.final_velocity,
            "findings": self.check.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "notes": self.record.header,
        })
    }
}

fn table(rows: &[Row], arguments: &Arguments) -> String {
    let width = rows.iter().map(|row| row.name().chars().count()).max().unwrap_or(0).max("file".len());
    let mut text = format!(
        "{:width$}  {:13}  {:>7}  {:>8}  {:>10}  {:>8}  {:>8}",
        "file", "format", "points", "step [s]", "length [s]", "PGA [g]", "AvgSA[g]"
    );
    for period in &arguments.periods {
        let _ = write!(text, "  {:>9}", format!("Sa({period} s)"));
    }
    text.push('\n');
    for row in rows {
        let motion = &row.record.motion;
        let _ = write!(
            text,
            "{:width$}  {:13}  {:>7}  {:>8}  {:>10.3}  {:>8.5}  {:>8.5}",
            row.name(),
            row.record.format.description(),
            motion.samples().len(),
            report::number(motion.step(), 6),
            motion.duration(),
            row.peak(),
            row.average
        );
        for acceleration in &row.accelerations {
            let _ = write!(text, "  {acceleration:>9.5}");
        }
        text.push('\n');
    }
    let periods = arguments.average.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    let percent = report::number(100.0 * arguments.damping, 6);
    let _ = writeln!(text, "Sa in g at {percent} % damping; AvgSA: geometric mean at {periods} s");
    for row in rows {
        for warning in &row.check.warnings {
            let _ = writeln!(text, "check    {}: {warning}", row.name());
        }
    }
    text
}

/// Periods of the spectra drawn: up to 4 s, denser where they are short.
const PERIODS: u32 = 200;
const SHORTEST: f64 = 0.01;
const LONGEST: f64 = 4.0;

/// The histories and the spectra.
fn picture(rows: &[Row], spectrum: Spectrum, damping: f64) -> Result<Picture> {
    let drawn = |row: &Row| -> Result<records_figure::Record> {
        let motion = &row.record.motion;
        let samples = motion.samples().iter().enumerate();
        let history =
            samples.map(|(index, a)| (index as f64 * motion.step(), a / STANDARD_GRAVITY)).collect();
        // the peak ground acceleration at 0
        let mut points = vec![(0.0, row.peak())];
        for index in 0..=PERIODS {
            let part = f64::from(index) / f64::from(PERIODS);
            let period = SHORTEST + (LONGEST - SHORTEST) * part * part;
            let acceleration = spectrum.acceleration(motion, period).with_context(|| row.name())?;
            points.push((period, acceleration / STANDARD_GRAVITY));
        }
        let is_vertical = row.record.is_vertical;
        Ok(records_figure::Record { name: row.name(), history, spectrum: points, is_vertical })
    };
    Ok(records_figure::picture(&rows.iter().map(drawn).collect::<Result<Vec<_>>>()?, damping))
}

fn csv(rows: &[Row], periods: &[f64]) -> String {
    let mut text = String::from("file,channel,format,points,step_s,duration_s,pga_g,average_sa_g");
    for period in periods {
        let _ = write!(text, ",sa_{period}s_g");
    }
    text.push_str(",findings\n");
    for row in rows {
        let motion = &row.record.motion;
        let _ = write!(
            text,
            "{},{},{},{},{},{},{},{}",
            quoted(&row.file),
            quoted(row.record.channel.as_deref().unwrap_or_default()),
            row.record.format.name(),
            motion.samples().len(),
            motion.step(),
            motion.duration(),
            row.peak(),
            row.average
        );
        for acceleration in &row.accelerations {
            let _ = write!(text, ",{acceleration}");
        }
        let warnings: Vec<_> = row.check.warnings.iter().map(ToString::to_string).collect();
        let _ = writeln!(text, ",{}", quoted(&warnings.join(" | ")));
    }
    text
}
