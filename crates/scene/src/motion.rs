//! The motion of a scene: a record, a pulse, a harmonic or the synthetic one, for both supports or one for
//! each.

use std::path::{Path, PathBuf};

use files::{Place, tables};
use ground_motion::{
    Acceleration, DEFAULT_PAUSE, Format, GroundMotion, GroundMotionError, Pulse, Record, RecordOptions,
    Shape, SyntheticMotion, Unit, file_name,
};
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::six_digits;
use toml::Spanned;

use crate::error::SceneError;
use crate::shocks::{RecordProblem as Problem, RecordTable, Shocks, scaled};

/// Free vibration after a scene's motion when it states no tail \[s\].
pub const DEFAULT_TAIL: f64 = 10.0;
/// Longest free vibration after a motion \[s\].
pub const LONGEST_TAIL: f64 = 1e6;

tables! {
    /// The motion: exactly one of `record`, `ricker`, `harmonic`, `sine_cycle`, `half_sine`, `synthetic`.
    #[derive(Debug, Default)]
    pub struct MotionTable {
        /// Record file, beside the scene file, in any format the library reads; or a sequence of records,
        /// each a file or a table with options of its own.
        pub record: Option<Shocks>,
        /// Time between the records of a sequence (s).
        #[key(minimum = 0, maximum = LONGEST_TAIL, default = DEFAULT_PAUSE)]
        pub pause: Option<f64>,
        /// Unit of the record: m/s2, cm/s2, mm/s2 or g (9.80665 m/s²); an AT2 file states its own.
        pub unit: Option<Unit>,
        /// Time between samples (s), for a record that does not state it.
        pub step: Option<f64>,
        /// Column of a table (CSV or text).
        pub column: Option<String>,
        /// Channel of a record with several, by its number.
        pub channel: Option<String>,
        /// Format of the record, found from its content if none is given.
        pub format: Option<Format>,
        /// Ricker pulse.
        pub ricker: Option<RickerTable>,
        /// Harmonic motion.
        pub harmonic: Option<HarmonicTable>,
        /// One cycle of a sine.
        pub sine_cycle: Option<SineTable>,
        /// Half a cycle of a sine.
        pub half_sine: Option<SineTable>,
        /// The project's synthetic motion.
        pub synthetic: Option<SyntheticTable>,
        /// Factor on the motion (-).
        pub scale: Option<f64>,
        /// Peak acceleration to scale to, in m/s² or as a text with its unit, such as "0.3g".
        pub pga: Option<Acceleration>,
        /// Start of the part to use (s).
        pub from: Option<f64>,
        /// End of the part to use (s).
        pub to: Option<f64>,
        /// Free vibration after the motion (s).
        #[key(minimum = 0, maximum = LONGEST_TAIL, default = DEFAULT_TAIL)]
        pub tail: Option<f64>,
        /// Fingerprint of the record file, FNV-1a-128 in hexadecimal; a file that differs is refused.
        pub fingerprint: Option<String>,
        /// Another record for the top support (a wall in an upper storey), trimmed like the bottom one.
        pub top: Option<RecordTable>,
    }

    /// Ricker pulse a = A (1 − 2z²) exp(−z²), z = π f (t − t₀).
    #[derive(Debug)]
    pub struct RickerTable {
        /// A (m/s²).
        pub amplitude: f64,
        /// f (Hz).
        pub frequency: f64,
        /// t₀ (s).
        pub centre: f64,
    }

    /// Harmonic motion a = A sin(2π f t + φ).
    #[derive(Debug)]
    pub struct HarmonicTable {
        /// A (m/s²).
        pub amplitude: f64,
        /// f (Hz).
        pub frequency: f64,
        /// φ (rad).
        #[serde(default)]
        #[key(default = 0)]
        pub phase: f64,
        /// Length (s).
        pub duration: f64,
    }

    /// One or half a cycle of a = A sin(2π f t).
    #[derive(Debug)]
    pub struct SineTable {
        /// A (m/s²).
        pub amplitude: f64,
        /// f (Hz).
        pub frequency: f64,
    }

    /// The project's synthetic motion; every key has a default.
    #[derive(Debug, Default)]
    pub struct SyntheticTable {
        /// Seed of the noise; each seed gives a different motion.
        pub seed: Option<u64>,
        /// Length (s).
        pub duration: Option<f64>,
        /// Step (s).
        pub step: Option<f64>,
    }
}

/// A motion ready to use.
pub(crate) struct Loaded {
    pub(crate) excitation: Excitation,
    pub(crate) tail: f64,
    pub(crate) notes: Vec<String>,
    /// Files of the records.
    pub(crate) records: Vec<PathBuf>,
}

pub(crate) fn load(
    table: &Spanned<MotionTable>,
    place: &Place<'_>,
    folder: &Path,
    has_floors: bool,
) -> Result<Loaded, SceneError> {
    loaded(table.get_ref(), folder, has_floors).map_err(|problem| match problem {
        Problem::Table(message) => place.error(table.span(), message).into(),
        Problem::Motion(source) => SceneError::Motion {
            file: place.name().to_owned(),
            line: place.line(table.span()),
            source: Box::new(source),
        },
    })
}

fn loaded(spec: &MotionTable, folder: &Path, has_floors: bool) -> Result<Loaded, Problem> {
    let tail = spec.tail.unwrap_or(DEFAULT_TAIL);
    let mut notes = Vec::new();
    let bottom = scaled(trim(source(spec, folder, &mut notes)?, spec)?, spec.scale, spec.pga)?;
    let top = spec.top.as_ref().map(|top| {
        let record = top.read(&RecordOptions::default(), folder)?;
        note(&mut notes, top, &record);
        scaled(trim(record.motion, spec)?, top.scale, top.pga)
    });
    let top = top.transpose()?;
    let peak = match &top {
        Some(top) => {
            format!("peak accelerations {:.4} m/s² (bottom), {:.4} m/s² (top)", bottom.peak(), top.peak())
        }
        None if has_floors => format!("peak ground acceleration {:.4} m/s²", bottom.peak()),
        None => format!("peak acceleration {:.4} m/s²", bottom.peak()),
    };
    let excitation = Excitation::new(bottom, top);
    notes.push(format!("{peak}, {} s", (1e4 * excitation.duration()).round() / 1e4));
    let files = spec.record.iter().flat_map(|shocks| &shocks.0).chain(&spec.top);
    let records = files.map(|file| folder.join(&file.record)).collect();
    Ok(Loaded { excitation, tail, notes, records })
}

fn source(spec: &MotionTable, folder: &Path, notes: &mut Vec<String>) -> Result<GroundMotion, Problem> {
    let mut found: Vec<(&str, Result<GroundMotion, Problem>)> = Vec::new();
    let MotionTable { unit, step, format, .. } = *spec;
    let (column, channel) = (spec.column.clone(), spec.channel.clone());
    let options = RecordOptions { unit, step, column, channel, format };
    if spec.pause.is_some() && spec.record.as_ref().is_none_or(|shocks| shocks.0.len() < 2) {
        let message = "pause is the time between the records of a sequence; give record = [\"MAIN\", \
                       \"AFTER\"] or leave it out";
        return Err(Problem::Table(message.into()));
    }
    if let Some(shocks) = &spec.record {
        found.push(("record", sequence(spec, shocks, &options, folder, notes)));
    } else if options != RecordOptions::default() {
        let message = "unit, step, column, channel and format belong to a record; \
                       add record = \"FILE\" or leave them out";
        return Err(Problem::Table(message.into()));
    }
    let mut pulse = |name, words: &str, shape, amplitude, frequency| {
        notes.push(format!("{words}, {amplitude} m/s² at {frequency} Hz"));
        let motion = Pulse { shape, amplitude, frequency }.motion(None);
        found.push((name, motion.map_err(Problem::from)));
    };
    if let Some(&RickerTable { amplitude, frequency, centre }) = spec.ricker.as_ref() {
        pulse("ricker", "Ricker pulse", Shape::Ricker { centre }, amplitude, frequency);
    }
    if let Some(&HarmonicTable { amplitude, frequency, phase, duration }) = spec.harmonic.as_ref() {
        let shape = Shape::Harmonic { phase, end: Some(duration) };
        pulse("harmonic", "harmonic", shape, amplitude, frequency);
    }
    if let Some(&SineTable { amplitude, frequency }) = spec.sine_cycle.as_ref() {
        pulse("sine_cycle", "sine cycle", Shape::SineCycle, amplitude, frequency);
    }
    if let Some(&SineTable { amplitude, frequency }) = spec.half_sine.as_ref() {
        pulse("half_sine", "half sine", Shape::HalfSine, amplitude, frequency);
    }
    if let Some(table) = &spec.synthetic {
        let default = SyntheticMotion::default();
        let recipe = SyntheticMotion {
            seed: table.seed.unwrap_or(default.seed),
            duration: table.duration.unwrap_or(default.duration),
            step: table.step.unwrap_or(default.step),
            ..default
        };
        notes.push(format!("synthetic motion, seed {}", recipe.seed));
        found.push(("synthetic", recipe.motion().map_err(Into::into)));
    }
    let names: Vec<_> = found.iter().map(|(name, _)| *name).collect();
    let listed = if names.is_empty() { "none".to_owned() } else { names.join(" and ") };
    let (Some((_, motion)), true) = (found.pop(), names.len() == 1) else {
        let message = format!(
            "[motion] needs exactly one of record, ricker, harmonic, sine_cycle, half_sine and synthetic; \
             found {listed}"
        );
        return Err(Problem::Table(message));
    };
    motion
}

/// Reads the record of a scene, or its sequence of several.
fn sequence(
    spec: &MotionTable,
    shocks: &Shocks,
    options: &RecordOptions,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<GroundMotion, Problem> {
    if spec.fingerprint.is_some() && shocks.0.len() > 1 {
        let message = "fingerprint is that of one record; state it in the table of each, such as record = \
                       [{ record = \"MAIN\", fingerprint = \"…\" }, \"AFTER\"]";
        return Err(Problem::Table(message.into()));
    }
    let mut shocks = shocks.clone();
    for own in &mut shocks.0 {
        own.fingerprint = own.fingerprint.take().or_else(|| spec.fingerprint.clone());
    }
    let pause = spec.pause.unwrap_or(DEFAULT_PAUSE);
    let motion = shocks.read(options, pause, folder, |table, record| note(notes, table, record))?;
    let joined = || format!("{pause} s between them, in steps of {} s", six_digits(motion.step()));
    notes.extend((shocks.0.len() > 1).then(joined));
    Ok(motion)
}

/// Notes what a record is.
fn note(notes: &mut Vec<String>, table: &RecordTable, record: &Record) {
    notes.push(format!("record {} ({})", file_name(&table.record), record.format.description()));
    notes.extend(record.check().warnings.iter().map(ToString::to_string));
}

fn trim(motion: GroundMotion, spec: &MotionTable) -> Result<GroundMotion, GroundMotionError> {
    if spec.from.is_none() && spec.to.is_none() {
        return Ok(motion);
    }
    let to = spec.to.unwrap_or_else(|| motion.duration());
    motion.trimmed(spec.from.unwrap_or(0.0), to)
}
