//! The arguments of `wall`, and what they make of a scene.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, Parser, Subcommand};
use ground_motion::spectrum::{AVERAGE_PERIODS, DAMPING};
use ground_motion::{GroundMotion, RecordOptions, SyntheticMotion, read};
use rocking_wall::scene::{DEFAULT_TAIL, Scene, check_thresholds};
use rocking_wall::simulation::Excitation;

use crate::ida::{IdaArguments, MergeArguments};
use crate::output;
use crate::spectrum::SpectrumArguments;

/// Out-of-plane rocking of masonry walls under earthquakes.
#[derive(Debug, Parser)]
#[command(name = "wall", version, arg_required_else_help = true, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene, or the default wall, and write its history and its page
    #[command(allow_negative_numbers = true)]
    Simulate(SimulateArguments),
    /// Make an FMU of a scene, with only the variables it uses and its ground motion inside
    Package(PackageArguments),
    /// Make a system (SSP) of storeys and walls: each wall the FMU of its scene, connected
    Building(BuildingArguments),
    /// Print what follows from a wall's parameters: masses, F0, `u_ins`, omega1, e, xi ...
    Describe(DescribeArguments),
    /// Write a ground motion as CSV: a record in m/s2, or the synthetic one
    #[command(allow_negative_numbers = true)]
    Motion(MotionArguments),
    /// Measure the error of each solver against its run time
    #[command(allow_negative_numbers = true)]
    Accuracy(AccuracyArguments),
    /// Map the stability of each solver, and run the extremes
    Stability(StabilityArguments),
    /// Print what record files hold: format, points, step, duration, PGA, AvgSA, Sa, and a quick check
    Record(RecordFilesArguments),
    /// Run an incremental dynamic analysis: walls x records x damping models, with fragilities and a page
    Ida(IdaArguments),
    /// Put together the shards of an incremental dynamic analysis and write its results
    Merge(MergeArguments),
    /// Rocking spectra: `u_max/u_ins` of rocking walls over size and slenderness, or over pulses
    #[command(allow_negative_numbers = true)]
    Spectrum(SpectrumArguments),
    /// Match viscous damping to restitution, as section 5 of the paper does, for any wall
    Calibrate(crate::calibrate::CalibrateArguments),
    /// Compute every table and figure of the paper beside its print, on one page
    Reproduce(crate::reproduce::ReproduceArguments),
    /// Print the JSON schema of scene files
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// A scene and what replaces parts of it.
#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// Scene file (TOML); without one the defaults of the model description
    pub(crate) scene: Option<PathBuf>,
    /// Set a parameter, such as `xi=0.03` or `force_law=trilinear`; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
}

/// A record file and how to read it.
#[derive(Debug, Args)]
pub(crate) struct RecordArguments {
    /// Accelerogram that replaces the scene's motion, in any format `wall record` reads
    #[arg(long, value_name = "FILE")]
    pub(crate) record: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) options: RecordOptionsArguments,
    /// Shake with the project's synthetic motion
    #[arg(long, conflicts_with = "record")]
    pub(crate) synthetic: bool,
    /// Factor on the motion given here
    #[arg(long, conflicts_with = "pga", value_name = "FACTOR")]
    pub(crate) scale: Option<f64>,
    /// Peak acceleration in m/s2 to scale the motion given here to
    #[arg(long, value_name = "M_PER_S2")]
    pub(crate) pga: Option<f64>,
}

/// How to read a record; each of these needs the argument `record`.
#[derive(Debug, Args)]
pub(crate) struct RecordOptionsArguments {
    /// Unit of the record: m/s2, cm/s2, mm/s2 or g; needed where the file does not state its own
    #[arg(long, requires = "record")]
    unit: Option<String>,
    /// Time between samples in s, for a record that does not state it
    #[arg(long, requires = "record", value_name = "SECONDS")]
    record_step: Option<f64>,
    /// Column of a CSV table
    #[arg(long, requires = "record")]
    column: Option<String>,
    /// Channel of a record with several, by its number; `wall record` without it shows all
    #[arg(long, requires = "record")]
    channel: Option<String>,
    /// Format of the record (at2, esm, knet, cosmos, csmip, smc, csv), if its content does not tell
    #[arg(long, requires = "record")]
    format: Option<String>,
}

impl RecordOptionsArguments {
    /// The options that they state.
    pub(crate) fn options(&self) -> Result<RecordOptions> {
        Ok(RecordOptions {
            unit: self.unit.as_deref().map(str::parse).transpose()?,
            step: self.record_step,
            column: self.column.clone(),
            channel: self.channel.clone(),
            format: self.format.as_deref().map(str::parse).transpose()?,
        })
    }
}

#[derive(Debug, Args)]
pub(crate) struct SimulateArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    #[command(flatten)]
    pub(crate) record: RecordArguments,
    /// Free vibration in s after a motion given here
    #[arg(long, value_name = "SECONDS")]
    pub(crate) tail: Option<f64>,
    /// Hold each sample until the next, as most importers do with an input, instead of a straight line between
    #[arg(long)]
    pub(crate) hold: bool,
    /// End of the run in s
    #[arg(long, value_name = "SECONDS")]
    pub(crate) stop_time: Option<f64>,
    /// Step of the output in s
    #[arg(long, value_name = "SECONDS")]
    pub(crate) output_step: Option<f64>,
    /// Write the history as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a page with the rocking wall and its history
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Limit states as fractions of `u_ins` whose first crossings are reported, instead of the scene's [default: 0.1,0.4,0.6,1]
    #[arg(long, value_name = "FRACTIONS", value_delimiter = ',')]
    pub(crate) thresholds: Option<Vec<f64>>,
    /// Print the summary and the demands as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct PackageArguments {
    /// Scene file (TOML)
    pub(crate) scene: PathBuf,
    /// The FMU to write
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// The general FMU to start from
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    pub(crate) base: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct BuildingArguments {
    /// The building (TOML): its storeys, and its walls with their scenes
    pub(crate) building: PathBuf,
    /// The SSP to write
    #[arg(short, long, value_name = "FILE", default_value = "fmu_out/building.ssp")]
    pub(crate) output: PathBuf,
    /// The general FMU of walls
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    pub(crate) wall_fmu: PathBuf,
    /// The FMU of floors
    #[arg(long, value_name = "FILE", default_value = "fmu_out/floor.fmu")]
    pub(crate) floor_fmu: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct DescribeArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Limit states as fractions of `u_ins` to show secant periods at, instead of the scene's [default: 0.1,0.4,0.6,1]
    #[arg(long, value_name = "FRACTIONS", value_delimiter = ',')]
    pub(crate) thresholds: Option<Vec<f64>>,
    /// Write the corners and limit states of the capacity curve as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Draw the capacity curve with its secants, as SVG or PNG by the file's ending
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct MotionArguments {
    #[command(flatten)]
    pub(crate) record: RecordArguments,
    /// The CSV file to write, with the columns time (s) and `a_g` (m/s2)
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct AccuracyArguments {
    /// Scene files (TOML); without any a set from mild to very stiff
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) record: RecordArguments,
    /// Write the measurements as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a page with work-precision plots
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
    /// Measurements of other tools to show on the page, the CSV of `cargo xtask bench --peers`
    #[arg(long, value_name = "FILE", requires = "html")]
    pub(crate) peers: Option<PathBuf>,
    /// Write the periods of small and of full rotations against slenderness as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) linearisation: Option<PathBuf>,
    /// Time to spend on timing each setting in s
    #[arg(long, value_name = "SECONDS", default_value_t = 0.05)]
    pub(crate) budget: f64,
}

#[derive(Debug, Args)]
pub(crate) struct StabilityArguments {
    /// Values of a1 from 1e-6 to 0.1
    #[arg(long, value_name = "COUNT", default_value_t = 11, value_parser = clap::value_parser!(u32).range(2..=101))]
    pub(crate) columns: u32,
    /// Write the cells as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a page with heat maps
    #[arg(long, value_name = "FILE")]
    pub(crate) html: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct RecordFilesArguments {
    /// Records: PEER AT2, ESM/ITACA, K-NET/KiK-net, COSMOS V2, CSMIP V2, USGS SMC, CSV
    #[arg(id = "record", required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) options: RecordOptionsArguments,
    /// Periods in s to show Sa at
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values_t = [0.2, 0.5, 1.0, 2.0])]
    pub(crate) periods: Vec<f64>,
    /// Periods in s whose geometric mean of Sa is AvgSA
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values_t = AVERAGE_PERIODS)]
    pub(crate) average: Vec<f64>,
    /// Damping ratio of the oscillators
    #[arg(long, value_name = "RATIO", default_value_t = DAMPING)]
    pub(crate) damping: f64,
    /// Take the maxima at the samples only, as many programs do, instead of wherever they lie
    #[arg(long)]
    pub(crate) at_samples: bool,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Write the table as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Draw the histories and the spectra, as SVG or PNG by the file's ending
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

impl SceneArguments {
    /// The scene with its parameters set.
    pub(crate) fn load(&self) -> Result<Scene> {
        match &self.scene {
            Some(path) => Scene::read(path).map_err(|error| {
                if path.is_file() && path.extension().is_none_or(|ending| ending != "toml") {
                    anyhow!("{error}; a scene is a TOML file, and a record goes after --record")
                } else {
                    error.into()
                }
            }),
            None => Ok(Scene::default()),
        }
    }

    /// Puts the scene's file before what is wrong with its parameters together.
    pub(crate) fn named<T, E: Into<anyhow::Error>>(&self, outcome: Result<T, E>) -> Result<T> {
        outcome.map_err(|error| match &self.scene {
            Some(path) => error.into().context(path.display().to_string()),
            None => error.into(),
        })
    }

    /// Applies `--set`, after a motion may have changed the start.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<()> {
        for assignment in &self.set {
            let Some((name, value)) = assignment.split_once('=') else {
                bail!("--set {assignment}: expected NAME=VALUE, such as --set xi=0.03");
            };
            scene.set(name.trim(), value).with_context(|| format!("--set {assignment}"))?;
        }
        Ok(())
    }
}

impl RecordArguments {
    /// The motion given, scaled, and a note on it.
    pub(crate) fn load(&self) -> Result<Option<(GroundMotion, String)>> {
        let (motion, note) = match &self.record {
            Some(path) => self.read(path)?,
            None if self.synthetic => (SyntheticMotion::default().motion()?, "synthetic motion".to_owned()),
            None if self.scale.is_some() || self.pga.is_some() => {
                bail!(
                    "--scale and --pga act on a motion given with --record or --synthetic; give one of them"
                );
            }
            None => return Ok(None),
        };
        let motion = match (self.scale, self.pga) {
            (Some(factor), _) => motion.checked_scaled(factor)?,
            (None, Some(pga)) => motion.scaled_to_peak(pga)?,
            (None, None) => motion,
        };
        Ok(Some((motion, note)))
    }

    fn read(&self, path: &Path) -> Result<(GroundMotion, String)> {
        let record = read(path, &self.options.options()?)?;
        for warning in &record.check().warnings {
            output::note(&format!("{}: {warning}", path.display()));
        }
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        Ok((record.motion, format!("record {name} ({})", record.format.description())))
    }
}

impl SimulateArguments {
    /// The scene to run.
    pub(crate) fn scene(&self) -> Result<Scene> {
        let mut scene = self.scene.load()?;
        if let Some((motion, note)) = self.record.load()? {
            let peak = format!("peak acceleration {:.4} m/s²", motion.peak());
            let tail = self.tail.unwrap_or(DEFAULT_TAIL);
            if !(0.0..=1e6).contains(&tail) {
                bail!("--tail {tail}: must be between 0 and 1e6 s");
            }
            scene.shake(Excitation::new(motion, None), tail, vec![note, peak]);
            if self.scene.scene.is_none() {
                scene.title = "The default parapet, shaken".into();
            }
        } else if self.tail.is_some() {
            bail!(
                "--tail belongs to a motion given with --record or --synthetic; a scene states its own tail"
            );
        }
        self.scene.apply(&mut scene)?;
        if self.hold {
            let Some(excitation) = scene.excitation.take() else {
                bail!("--hold needs a motion; give --record or --synthetic, or a scene with one");
            };
            scene.excitation = Some(excitation.held());
            scene.motion_notes.push("each sample held until the next".into());
        }
        for (name, given, value) in [
            ("--stop-time", self.stop_time, &mut scene.stop_time),
            ("--output-step", self.output_step, &mut scene.output_step),
        ] {
            if let Some(given) = given {
                if !(given > 0.0 && given <= 1e7) {
                    bail!("{name} {given}: must be above 0 and at most 1e7 s");
                }
                *value = given;
            }
        }
        if let Some(thresholds) = &self.thresholds {
            check_thresholds(thresholds)?;
            scene.thresholds.clone_from(thresholds);
        }
        Ok(scene)
    }
}
