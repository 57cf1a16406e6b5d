//! What record files hold: the intensity of each channel, and what a quick check finds.
//!
//! ```
//! use ground_motion::{RecordOptions, Spectrum, parse};
//! use run::record_facts::{Facts, Intensities, table};
//!
//! let file = "time (a_g in m/s2),a_g\n0,0\n0.01,2\n0.02,-1\n";
//! let record = parse("r.csv", file.as_bytes().to_vec(), &RecordOptions::default())?;
//! let of = Intensities { spectrum: Spectrum::default(), average: vec![0.2, 0.4], periods: vec![0.5] };
//! let facts = Facts::new("r.csv".as_ref(), record, &of)?;
//! assert!(table(&[facts], &of.periods).csv().starts_with("file,channel,format,points,step_s,"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod figure;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use ground_motion::{CSV_HEADER, Check, GroundMotion, GroundMotionError, Record, STANDARD_GRAVITY, Spectrum};
use report::table::{Digits, Table};
use serde_json::{Value, json};

/// What is computed of each record.
#[derive(Clone, Debug)]
pub struct Intensities {
    /// How Sa is computed.
    pub spectrum: Spectrum,
    /// Periods whose geometric mean of Sa is `AvgSA` \[s\].
    pub average: Vec<f64>,
    /// Periods at which Sa is listed \[s\].
    pub periods: Vec<f64>,
}

/// What is known of one channel of a file.
#[derive(Clone, Debug)]
pub struct Facts {
    /// Path of the file, or its name where it has none.
    pub path: PathBuf,
    /// The channel.
    pub record: Record,
    /// `AvgSA` \[g\].
    pub average: f64,
    /// Sa at the periods asked for \[g\].
    pub accelerations: Vec<f64>,
    /// The quick check.
    pub check: Check,
}

fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}

impl Facts {
    /// Computes the intensities of a channel and checks it.
    ///
    /// # Errors
    /// [`GroundMotionError`] for periods that are out of range for the record.
    pub fn new(path: &Path, record: Record, of: &Intensities) -> Result<Self, GroundMotionError> {
        let average = in_g(of.spectrum.average(&record.motion, &of.average)?);
        let accelerations = of.spectrum.accelerations(&record.motion, &of.periods)?;
        let accelerations = accelerations.into_iter().map(in_g).collect();
        let check = record.check();
        Ok(Self { path: path.to_owned(), record, average, accelerations, check })
    }

    /// Returns the name of the file without its folder.
    fn file(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Returns the file and its channel.
    pub fn name(&self) -> String {
        match &self.record.channel {
            Some(channel) => format!("{} [{channel}]", self.file()),
            None => self.file(),
        }
    }

    /// Returns the peak acceleration \[g\].
    fn peak(&self) -> f64 {
        in_g(self.record.motion.peak())
    }

    fn findings(&self) -> Vec<String> {
        self.check.warnings.iter().map(ToString::to_string).collect()
    }

    /// Returns everything, with the notes of the file.
    pub fn json(&self) -> Value {
        let motion = &self.record.motion;
        json!({
            "file": self.file(),
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
            "peak_displacement_m": motion.peak_displacement(),
            "arias_m_s": motion.arias_intensity(),
            "cav_m_s": motion.cumulative_absolute_velocity(),
            "findings": self.findings(),
            "notes": self.record.header,
        })
    }
}

/// Returns the samples of a motion as CSV, which every command reads, and FMPy with `--input-file`.
pub fn samples(motion: &GroundMotion) -> String {
    let mut csv = format!("{CSV_HEADER}\n");
    for (index, sample) in motion.samples().iter().enumerate() {
        // writing to a String cannot fail
        let _ = writeln!(csv, "{:.9},{sample:?}", index as f64 * motion.step());
    }
    csv
}

/// Returns a row for each channel; `periods` are those of the listed Sa \[s\].
pub fn table(channels: &[Facts], periods: &[f64]) -> Table {
    let five = Digits::Decimals(5);
    let mut table = Table::over(channels)
        .text("", "file", |facts| facts.name())
        .text("file", "", |facts| facts.file())
        .text("channel", "", |facts| facts.record.channel.clone())
        .text("", "format", |facts| facts.record.format.description())
        .text("format", "", |facts| facts.record.format.name())
        .number("points", "points", five, |facts| facts.record.motion.samples().len())
        .number("step_s", "step [s]", Digits::AtMost(6), |facts| facts.record.motion.step())
        .number("duration_s", "length [s]", Digits::Decimals(3), |facts| facts.record.motion.duration())
        .number("pga_g", "PGA [g]", five, |facts| facts.peak())
        .number("average_sa_g", "AvgSA[g]", five, |facts| facts.average);
    for (k, period) in periods.iter().enumerate() {
        let (name, heading) = (format!("sa_{period}s_g"), format!("Sa({period} s)"));
        table = table.number(name, heading, five, |facts| facts.accelerations[k]);
    }
    table = table
        .value("peak_velocity_m_s", |facts| facts.check.peak_velocity)
        .value("peak_displacement_m", |facts| facts.record.motion.peak_displacement())
        .value("arias_m_s", |facts| facts.record.motion.arias_intensity())
        .value("cav_m_s", |facts| facts.record.motion.cumulative_absolute_velocity());
    table.text("findings", "", |facts| facts.findings().join(" | ")).done()
}

/// Returns a row for each file: the longest, coarsest and strongest of its channels.
pub fn listing(channels: &[Facts]) -> Table {
    Table::over(channels.chunk_by(|a, b| a.path == b.path))
        .text("", "file", |channels| channels[0].file())
        .text("", "format", |channels| channels[0].record.format.description())
        .number("", "channels", Digits::AtMost(6), |channels| channels.len())
        .number("", "points", Digits::AtMost(6), |channels| {
            channels.iter().map(|facts| facts.record.motion.samples().len()).max()
        })
        .number("", "step [s]", Digits::AtMost(6), |channels| {
            channels.iter().map(|facts| facts.record.motion.step()).fold(0.0, f64::max)
        })
        .number("", "PGA [g]", Digits::Decimals(5), |channels| {
            channels.iter().map(Facts::peak).fold(0.0, f64::max)
        })
        .text("", "findings", |channels| subjects(channels))
        .done()
}

/// The subjects of the findings, each once, with the number of channels where these are several.
fn subjects(channels: &[Facts]) -> String {
    let mut subjects: Vec<(String, usize)> = Vec::new();
    for finding in channels.iter().flat_map(Facts::findings) {
        let subject = finding.split(": ").next().unwrap_or(&finding);
        match subjects.iter_mut().find(|(known, _)| known == subject) {
            Some((_, count)) => *count += 1,
            None => subjects.push((subject.to_owned(), 1)),
        }
    }
    let shown = subjects.into_iter().map(|(subject, count)| match (count, channels.len()) {
        (_, 1) => subject,
        (count, _) => format!("{subject} ({count})"),
    });
    shown.collect::<Vec<_>>().join(", ")
}
