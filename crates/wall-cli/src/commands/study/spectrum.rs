//! `wall study spectrum`: rocking spectra of a record over walls, or of pulses on one wall.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use clap::Args;
use ground_motion::GroundMotion;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::{DampingModel, Impact};
use rocking_wall::wall::{COMPUTED, Damping, Parameters, Wall};
use run::parallel;
use scene::{DEFAULT_TAIL, Scene};
use serde_json::json;
use study::spectrum::figure::{Shown, own_words, svg};
use study::spectrum::{
    PulseForm, RecordPulses, Size, Slenderness, common_motion, onset, over_pulses, over_walls, own_point,
};

use crate::args::{RecordArguments, SceneArguments, apply_set, refuse, svg_file};
use crate::output::{self, Console};
use study::spectrum::page::page;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    record: RecordArguments,
    /// Pulse instead of a record: ricker, `sine_cycle`, `cosine_cycle`, `half_sine`, rectangle, triangle or
    /// `falling_triangle`; by itself it gives the dimensionless spectrum over `omega_p/p` and `a_p/a_0`. All
    /// from `half_sine` on last half a period, 1/(2 f)
    #[arg(long, value_name = "FORM", conflicts_with_all = ["record", "synthetic"])]
    pulse: Option<String>,
    /// Find the record's own pulse in place of a spectrum: for a sine, a cosine and a Ricker pulse the period
    /// that fits the record best, and the amplitude with which the wall has the same peak
    #[arg(
        long,
        value_name = "RECORD",
        group = "recorded",
        conflicts_with_all = [
            "pulse", "frequency", "amplitude", "heights", "radii", "ratios", "angles", "frequency_ratios",
            "amplitude_ratios", "html"
        ]
    )]
    pulse_of: Option<PathBuf>,
    /// Print the pulses of a record as JSON
    #[arg(long, requires = "pulse_of")]
    json: bool,
    /// Frequency of the pulse in Hz, for a spectrum over walls
    #[arg(long, value_name = "HZ", requires_all = ["pulse", "amplitude"])]
    frequency: Option<f64>,
    /// Amplitude of the pulse in m/s2, for a spectrum over walls
    #[arg(long, value_name = "M_PER_S2", requires_all = ["pulse", "frequency"])]
    amplitude: Option<f64>,
    /// Heights in m [default: 0.5:8:31]
    #[arg(long, value_name = "FROM:TO:COUNT", conflicts_with = "radii")]
    heights: Option<String>,
    /// Semi-diagonals R of a parapet in m, instead of heights
    #[arg(long, value_name = "FROM:TO:COUNT")]
    radii: Option<String>,
    /// Slenderness h/b [default: 4:20:33]
    #[arg(long, value_name = "FROM:TO:COUNT", conflicts_with = "angles")]
    ratios: Option<String>,
    /// Slenderness angles alpha = atan(b/h) of a parapet in rad, instead of h/b
    #[arg(long, value_name = "FROM:TO:COUNT")]
    angles: Option<String>,
    /// `omega_p/p` of the dimensionless spectrum [default: 0.5:10:39]
    #[arg(long, value_name = "FROM:TO:COUNT", requires = "pulse")]
    frequency_ratios: Option<String>,
    /// `a_p/a_0` of the dimensionless spectrum, `a_0` = g tan alpha for a parapet without overburden
    /// [default: 0.5:10:39]
    #[arg(long, value_name = "FROM:TO:COUNT", requires = "pulse")]
    amplitude_ratios: Option<String>,
    /// Number of threads [default: one for each core]; the result does not depend on it
    #[arg(long, value_name = "COUNT")]
    threads: Option<std::num::NonZeroUsize>,
    /// Write the points as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page with the heat map
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the heat map as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    svg: Option<PathBuf>,
}

/// The most values along an axis.
const MOST_VALUES: usize = 500;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load(console)?;
    apply_set(&arguments.scene.set, &mut scene)?;
    let records = arguments.record.record.iter().chain(&arguments.pulse_of);
    let inputs = arguments.scene.inputs(&scene).chain(records);
    let outputs = [&arguments.csv, &arguments.html, &arguments.svg];
    console.check_distinct(inputs, outputs.into_iter().flatten())?;
    let threads = parallel::threads(arguments.threads).get();
    if let Some(path) = &arguments.pulse_of {
        return pulses_of(console, arguments, scene, path, threads);
    }
    let pulse = arguments.pulse.as_deref().map(Pulse::named).transpose()?;
    let mut shown = match (pulse, arguments.frequency, arguments.amplitude) {
        (Some(pulse), None, None) => pulses(console, arguments, &scene.parameters, &pulse, threads)?,
        (Some(Pulse { form, words }), Some(frequency), Some(amplitude)) => {
            let motion = form.motion(frequency)?.checked_scaled(amplitude)?;
            let note = format!("{words} of {amplitude} m/s² at {frequency} Hz");
            walls(arguments, &scene.parameters, &motion, vec![note], threads)?
        }
        _ => {
            let (motion, notes) = motion(console, arguments, &scene)?;
            walls(arguments, &scene.parameters, &motion, notes, threads)?
        }
    };
    shown.notes.push(law(&scene.parameters));
    console.save(arguments.csv.as_ref(), || shown.spectrum.table().csv())?;
    console.save(arguments.html.as_ref(), || page(&shown))?;
    console.save(arguments.svg.as_ref(), || svg(&shown))?;
    console.print(&(summary(&shown) + &output::written("written    ", outputs.into_iter().flatten())))
}

/// Finds the pulses of a record.
fn pulses_of(
    console: &Console<'_>,
    arguments: &Arguments,
    mut scene: Scene,
    path: &Path,
    threads: usize,
) -> Result<()> {
    let (motion, note) = arguments.record.read(console, path)?;
    let motion = arguments.record.motion.scaled(console, motion)?;
    scene.shake(Excitation::new(motion, None), DEFAULT_TAIL, Vec::new());
    let found = RecordPulses::new(&scene.parameters, common_motion(&scene)?, threads)?;
    let (table, point) = (found.table(), found.point);
    console.save(arguments.csv.as_ref(), || table.csv())?;
    console.save(arguments.svg.as_ref(), || found.plot().picture())?;
    if arguments.json {
        return console.json(&json!({
            "u_ratio_max": point.ratio, "overturn_time_s": point.overturning, "pulses": table.json()
        }));
    }
    let peak = match point.overturning {
        Some(time) => format!("the wall overturns at {time:.3} s"),
        None => format!("largest |u| {:.4} u_ins", point.ratio),
    };
    let written = output::written("\nwritten ", arguments.csv.iter().chain(&arguments.svg));
    console.print(&format!("{note}, {peak}; amplitudes with the same peak\n\n{}{written}", table.text()))
}

fn pulses(
    console: &Console<'_>,
    arguments: &Arguments,
    parameters: &Parameters,
    Pulse { form, words }: &Pulse,
    threads: usize,
) -> Result<Shown> {
    let Arguments { heights, radii, ratios, angles, .. } = arguments;
    let given = [("--heights", heights), ("--radii", radii), ("--ratios", ratios), ("--angles", angles)];
    refuse(
        given.map(|(option, value)| (option, value.is_some())),
        "belongs to a spectrum over walls: give the pulse a --frequency and an --amplitude too",
    )?;
    // refuses --scale and --pga, which need a record
    arguments.record.load(console)?;
    let columns = values("--frequency-ratios", arguments.frequency_ratios.as_deref(), [0.5, 10.0], 39)?;
    let rows = values("--amplitude-ratios", arguments.amplitude_ratios.as_deref(), [0.5, 10.0], 39)?;
    let wall = arguments.scene.named(Wall::new(parameters))?;
    Ok(Shown {
        spectrum: over_pulses(parameters, *form, &columns, &rows, threads)?,
        title: format!("Rocking spectrum of a {words}"),
        notes: vec![format!(
            "{} of {} m × {} m, p = {:.4} rad/s, a₀ = {:.4} m/s²",
            parameters.mechanism.name().replace('_', " "),
            parameters.height,
            parameters.thickness,
            wall.rocking_rate(),
            onset(&wall)
        )],
        axes: "Across the frequency of the pulse over p = √(k₀/m_eff), up its amplitude over a₀ = F₀/(λ \
               m_eff), which is g tan α for a parapet without overburden; walls of any size with the same \
               damping and restitution have this spectrum."
            .into(),
        own: None,
    })
}

fn walls(
    arguments: &Arguments,
    parameters: &Parameters,
    motion: &GroundMotion,
    notes: Vec<String>,
    threads: usize,
) -> Result<Shown> {
    let Arguments { frequency_ratios, amplitude_ratios, .. } = arguments;
    let given = [("--frequency-ratios", frequency_ratios), ("--amplitude-ratios", amplitude_ratios)];
    refuse(
        given.map(|(option, value)| (option, value.is_some())),
        "belongs to the dimensionless spectrum of a pulse: leave out --frequency and --amplitude",
    )?;
    let (size, sizes) = match &arguments.radii {
        Some(radii) => (Size::SemiDiagonal, values("--radii", Some(radii), [0.0; 2], 2)?),
        None => (Size::Height, values("--heights", arguments.heights.as_deref(), [0.5, 8.0], 31)?),
    };
    let (slenderness, rows) = match &arguments.angles {
        Some(angles) => (Slenderness::Angle, values("--angles", Some(angles), [0.0; 2], 2)?),
        None => (Slenderness::Ratio, values("--ratios", arguments.ratios.as_deref(), [4.0, 20.0], 33)?),
    };
    Ok(Shown {
        spectrum: over_walls(parameters, motion, size, &sizes, slenderness, &rows, threads)?,
        own: own_point(parameters, motion, size, slenderness),
        title: format!("Rocking spectrum, {}", parameters.mechanism.name().replace('_', " ")),
        notes,
        axes: "Each cell is one wall under the whole motion, followed until its peak has come.".into(),
    })
}

/// The motion that the supports get from the one given, or from the scene's own.
fn motion(
    console: &Console<'_>,
    arguments: &Arguments,
    scene: &Scene,
) -> Result<(GroundMotion, Vec<String>)> {
    let mut scene = scene.clone();
    if let Some((motion, note)) = arguments.record.load(console)? {
        let peak = format!("peak acceleration {:.4} m/s²", motion.peak());
        scene.shake(Excitation::new(motion, None), DEFAULT_TAIL, vec![note, peak]);
    }
    if scene.excitation.is_none() {
        bail!("a rocking spectrum needs a motion; give --record, --synthetic, --pulse, or a scene with one");
    }
    Ok((common_motion(&scene)?, scene.motion_notes))
}

/// The form of a pulse, and its name in words.
struct Pulse {
    form: PulseForm,
    words: String,
}

impl Pulse {
    fn named(name: &str) -> Result<Self> {
        let form = PulseForm::from_name(name).map_err(|message| anyhow!("--pulse: {message}"))?;
        Ok(Self { form, words: name.replace('_', " ").replace("ricker", "Ricker pulse") })
    }
}

/// Evenly spaced values of `FROM:TO:COUNT`.
fn values(option: &str, given: Option<&str>, default: [f64; 2], count: usize) -> Result<Vec<f64>> {
    let ([from, to], count) = match given {
        None => (default, count),
        Some(text) => {
            let parts: Vec<_> = text.split(':').collect();
            let range = match parts[..] {
                [from, to, count] => from.parse().ok().zip(to.parse().ok()).zip(count.parse().ok()),
                _ => None,
            };
            let Some(((from, to), count)) = range else {
                bail!("{option} {text}: expected FROM:TO:COUNT, such as 1:8:29");
            };
            ([from, to], count)
        }
    };
    if !(from > 0.0 && from < to && to.is_finite() && (2..=MOST_VALUES).contains(&count)) {
        bail!(
            "{option}: expected 0 < FROM < TO and a COUNT from 2 to {MOST_VALUES}, found {from}:{to}:{count}"
        );
    }
    let value = |index: usize| {
        let part = index as f64 / (count - 1) as f64;
        // to the digits of a decimal fraction: 0.1, not 0.1 and a rounding
        format!("{:.12e}", from + (to - from) * part).parse().unwrap_or(from)
    };
    Ok((0..count).map(value).collect())
}

/// The force law, damping and impact in words.
fn law(parameters: &Parameters) -> String {
    let law = if parameters.multilinear.is_some() { "multilinear" } else { parameters.force_law.name() };
    let damping = match parameters.damping() {
        Damping { model: DampingModel::None, .. } => "no damping".to_owned(),
        Damping { model, ratio: Some(ratio) } => format!("{} damping ({ratio})", model.name()),
        Damping { model, ratio: None } => format!("{} damping (computed)", model.name()),
    };
    let impact = match parameters.impact {
        Impact::None => "no impact".to_owned(),
        Impact::Restitution if parameters.restitution == COMPUTED => {
            format!("restitution ({})", parameters.restitution_source.name())
        }
        Impact::Restitution => format!("restitution ({})", parameters.restitution),
    };
    format!("{law} law, {damping}, {impact}").replace('_', " ")
}

fn summary(shown: &Shown) -> String {
    let points = || shown.spectrum.points.iter().flatten();
    let (rocked, overturned) = (
        points().filter(|point| point.rocked && point.overturning.is_none()).count(),
        points().filter(|point| point.overturning.is_some()).count(),
    );
    let standing = points().filter(|point| point.overturning.is_none());
    let largest = standing.map(|point| point.ratio).fold(0.0, f64::max);
    let range = |values: &[f64]| match values {
        [first, .., last] => format!("{first} to {last}, {} values", values.len()),
        _ => String::new(),
    };
    let [across, up] = shown.spectrum.quantities.map(|quantity| quantity.label);
    let own =
        shown.own.as_ref().map_or_else(String::new, |own| format!("your wall  {}\n", own_words(shown, own)));
    format!(
        "{}\nmotion     {}\nacross     {}: {}\nup         {}: {}\npoints     {}: {} do not rock, {rocked} \
         rock up to {largest:.3} u_ins, {overturned} overturn\n{own}",
        shown.title,
        shown.notes.join("; "),
        across,
        range(&shown.spectrum.columns),
        up,
        range(&shown.spectrum.rows),
        points().count(),
        points().count() - rocked - overturned,
    )
}
