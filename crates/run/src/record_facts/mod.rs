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
use report::table::{Column, Digits, Table};
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
    let mut columns = vec![
        Column::text("", "file"),
        Column::text("file", ""),
        Column::text("channel", ""),
        Column::text("", "format"),
        Column::text("format", ""),
        Column::count("points", "points"),
        Column::number("step_s", "step [s]", Digits::AtMost(6)),
        Column::number("duration_s", "length [s]", Digits::Decimals(3)),
        Column::number("pga_g", "PGA [g]", five),
        Column::number("average_sa_g", "AvgSA[g]", five),
    ];
    let acceleration = |period| Column::number(format!("sa_{period}s_g"), format!("Sa({period} s)"), five);
    columns.extend(periods.iter().map(acceleration));
    columns.push(Column::text("findings", ""));
    let mut table = Table::new(columns);
    for facts in channels {
        let Record { motion, format, channel, .. } = &facts.record;
        let mut row = vec![
            facts.name().into(),
            facts.file().into(),
            channel.clone().into(),
            format.description().into(),
            format.name().into(),
            motion.samples().len().into(),
            motion.step().into(),
            motion.duration().into(),
            facts.peak().into(),
            facts.average.into(),
        ];
        row.extend(facts.accelerations.iter().map(|&acceleration| acceleration.into()));
        row.push(facts.findings().join(" | ").into());
        table.row(row);
    }
    table
}

/// Returns a row for each file: the longest, coarsest and strongest of its channels.
pub fn listing(channels: &[Facts]) -> Table {
    let mut table = Table::new([
        Column::text("", "file"),
        Column::text("", "format"),
        Column::count("", "channels"),
        Column::count("", "points"),
        Column::number("", "step [s]", Digits::AtMost(6)),
        Column::number("", "PGA [g]", Digits::Decimals(5)),
        Column::text("", "findings"),
    ]);
    for channels in channels.chunk_by(|a, b| a.path == b.path) {
        let motions = || channels.iter().map(|facts| &facts.record.motion);
        table.row([
            channels[0].file().into(),
            channels[0].record.format.description().into(),
            channels.len().into(),
            motions().map(|motion| motion.samples().len()).max().into(),
            motions().map(GroundMotion::step).fold(0.0, f64::max).into(),
            channels.iter().map(Facts::peak).fold(0.0, f64::max).into(),
            subjects(channels).into(),
        ]);
    }
    table
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
