//! `wall record`: what record files hold, their intensity, and a quick check; a motion as CSV.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use ground_motion::spectrum::{AVERAGE_PERIODS, DAMPING};
use ground_motion::{Format, Maxima, Spectrum};
use run::record_facts::figure::{self, Drawn};
use run::record_facts::{Facts, Intensities, listing, samples, table};
use serde_json::json;

use crate::args::{MotionArguments, SYNTHETIC, named, record_files, svg_file};
use crate::output::{self, Console};

fn files_help() -> String {
    let formats = Format::listed();
    format!("Records: {formats} or text; a folder is listed, one row a file; `-` is standard input")
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[arg(group = "recorded", required_unless_present = "synthetic")]
    #[arg(value_name = "FILES", help = files_help())]
    files: Vec<PathBuf>,
    #[command(flatten)]
    motion: MotionArguments,
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
    /// Write the samples of one motion as CSV, scaled, with the columns time (s) and `a_g` (m/s2)
    #[arg(long, value_name = "FILE")]
    samples: Option<PathBuf>,
    /// Draw the histories and the spectra, as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    plot: Option<PathBuf>,
}

impl Arguments {
    fn outputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.plot.iter().chain(&self.csv).chain(&self.samples)
    }
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let maxima = if arguments.at_samples { Maxima::AtSamples } else { Maxima::Everywhere };
    let of = Intensities {
        spectrum: Spectrum::new(arguments.damping, maxima)?,
        average: arguments.average.clone(),
        periods: arguments.periods.clone(),
    };
    let is_listing = arguments.files.iter().any(|path| path.is_dir());
    let files = record_files(&arguments.files)?;
    console.check_distinct(&files, arguments.outputs())?;
    let sources: Vec<_> =
        if arguments.motion.synthetic { vec![None] } else { files.iter().map(Some).collect() };
    let mut channels = Vec::new();
    let (mut failures, mut missing) = (Vec::new(), 0);
    for source in sources {
        match read(console, source.map(PathBuf::as_path), arguments, &of) {
            Ok(found) => channels.extend(found),
            Err(error) => {
                failures.push(output::message(&error));
                missing += usize::from(source.is_some_and(|path| arguments.files.contains(path)));
            }
        }
    }
    match (&channels[..], &failures[..]) {
        ([], []) => {
            let folder = arguments.files[0].display();
            bail!("{folder}: a folder without files; name a folder with records");
        }
        ([], [failure]) => bail!("{failure}"),
        _ => {}
    }
    let lists = is_listing && !channels.is_empty();
    if !lists {
        // first, since to show the others may fail
        console.report_all(failures.iter().cloned());
    }
    if !channels.is_empty() {
        show(console, &channels, if lists { &failures } else { &[] }, arguments, &of)?;
    }
    match (failures.len(), lists) {
        // a folder may have files that are no records
        (0, _) => {}
        (_, true) if missing == 0 => {}
        (_, true) => {
            bail!("{missing} of the files that are named could not be read; they are listed as not read");
        }
        (count, false) => bail!("{count} of {} files could not be read", files.len()),
    }
    Ok(())
}

/// Reads the channels of a file, or the synthetic motion.
fn read(
    console: &Console<'_>,
    path: Option<&Path>,
    arguments: &Arguments,
    of: &Intensities,
) -> Result<Vec<Facts>> {
    let name = path.map_or(Path::new(SYNTHETIC), named);
    let facts = |record| Facts::new(name, record, of).with_context(|| name.display().to_string());
    arguments.motion.channels(console, path)?.into_iter().map(facts).collect()
}

/// Shows what was read; of a folder, also the `unread` files.
fn show(
    console: &Console<'_>,
    channels: &[Facts],
    unread: &[String],
    arguments: &Arguments,
    of: &Intensities,
) -> Result<()> {
    if let Some(path) = &arguments.samples {
        let [one] = channels else {
            let names: Vec<_> = channels.iter().map(Facts::name).collect();
            let names = names.join(", ");
            bail!("--samples writes one motion, found {names}; name one file, and its --channel");
        };
        console.write(path, samples(&one.record.motion).as_bytes())?;
    }
    if let Some(path) = &arguments.plot {
        console.write(path, picture(channels, of, arguments.damping)?.as_bytes())?;
    }
    let table = table(channels, &of.periods);
    console.save(arguments.csv.as_ref(), || table.csv())?;
    if arguments.json {
        return console.json(&json!({
            "damping": arguments.damping,
            "maxima": if arguments.at_samples { "at_samples" } else { "everywhere" },
            "average_periods_s": of.average,
            "periods_s": of.periods,
            "records": channels.iter().map(Facts::json).collect::<Vec<_>>(),
            "unread": unread,
        }));
    }
    let mut text = String::new();
    if arguments.files.iter().any(|path| path.is_dir()) {
        text += &listing(channels).text();
        for reason in unread {
            // writing to a String cannot fail
            let _ = writeln!(text, "not read  {reason}");
        }
    } else {
        let periods = of.average.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let percent = report::number(100.0 * arguments.damping, 6);
        text += &table.text();
        let _ = writeln!(text, "Sa in g at {percent} % damping; AvgSA: geometric mean at {periods} s");
        for facts in channels {
            for warning in &facts.check.warnings {
                let _ = writeln!(text, "check    {}: {warning}", facts.name());
            }
        }
    }
    console.print(&(text + &output::written("written  ", arguments.outputs())))
}

/// Draws the histories and the spectra.
fn picture(channels: &[Facts], of: &Intensities, damping: f64) -> Result<String> {
    let drawn = |facts: &Facts| -> Result<Drawn> {
        let drawn = Drawn::new(facts.name(), &facts.record.motion, &of.spectrum);
        let mut drawn = drawn.with_context(|| facts.name())?;
        drawn.is_vertical = facts.record.is_vertical;
        Ok(drawn)
    };
    Ok(figure::picture(&channels.iter().map(drawn).collect::<Result<Vec<_>>>()?, damping))
}
