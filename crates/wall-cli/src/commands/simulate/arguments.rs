//! The arguments of `wall simulate`, and the scene that they make.

use std::path::PathBuf;

use anyhow::{Context, Error, Result, bail};
use clap::Args;
use files::check_value;
use ground_motion::GroundMotion;
use rocking_wall::simulation::Excitation;
use scene::{DEFAULT_TAIL, Floors, MotionTable, Scene, StoreyTable, SupportsTable};

use crate::args::{RecordArguments, SceneArguments, apply_set};
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(super) scene: SceneArguments,
    #[command(flatten)]
    pub(super) record: RecordArguments,
    /// Several accelerograms, run one after the other: a table instead of a history
    #[arg(long, value_name = "FILES", num_args = 1.., group = "recorded")]
    pub(super) records: Vec<PathBuf>,
    /// Run each record with both signs, as a table
    #[arg(long, requires = "recorded")]
    pub(super) both_polarities: bool,
    /// Floor that the wall stands on, by period, damping ratio and mass, such as T=0.3,xi=0.05 or
    /// T=0.3,xi=0.05,mass=2e4; a strip wall leans on it. The motion shakes the ground
    #[arg(long, value_name = "T=S,xi=RATIO", value_parser = floor)]
    pub(super) floor: Option<Floors>,
    /// Free vibration in s after a motion given here
    #[arg(long, value_name = "SECONDS")]
    pub(super) tail: Option<f64>,
    /// Hold each sample until the next, as most importers do with an input, instead of interpolating
    #[arg(long)]
    pub(super) hold: bool,
    /// End of the run in s
    #[arg(long, value_name = "SECONDS")]
    pub(super) stop_time: Option<f64>,
    /// Step of the output in s
    #[arg(long, value_name = "SECONDS")]
    pub(super) output_step: Option<f64>,
    /// Write the history as CSV
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
    /// Write a page with the rocking wall and its history
    #[arg(long, value_name = "FILE")]
    pub(super) html: Option<PathBuf>,
    /// Limit states as fractions of `u_ins` whose first crossings are reported, instead of the scene's
    /// [default: 0.1,0.4,0.6,1]
    #[arg(long, value_name = "FRACTIONS", value_delimiter = ',')]
    pub(super) thresholds: Option<Vec<f64>>,
    /// Print the summary and the demands as JSON
    #[arg(long)]
    pub(super) json: bool,
}

impl Arguments {
    /// The records to run as a table; none for a single run.
    pub(super) fn listed(&self) -> &[PathBuf] {
        match &self.record.record {
            Some(record) if self.both_polarities => std::slice::from_ref(record),
            _ => &self.records,
        }
    }

    /// The scene to run.
    pub(super) fn scene(&self, console: &Console<'_>) -> Result<Scene> {
        self.shaken(self.scene.load(console)?, self.record.load(console)?)
    }

    /// The scene to run, under a motion with a note on it.
    pub(super) fn shaken(&self, mut scene: Scene, motion: Option<(GroundMotion, String)>) -> Result<Scene> {
        if let Some(floor) = &self.floor {
            scene.floors = Some(floor.clone());
        }
        if let Some((motion, note)) = motion {
            let of = if scene.floors.is_some() { "ground " } else { "" };
            let peak = format!("peak {of}acceleration {:.4} m/s²", motion.peak());
            let tail = self.tail.unwrap_or(DEFAULT_TAIL);
            check_value::<MotionTable>("tail", tail).map_err(Error::msg).context("--tail")?;
            scene.shake(Excitation::new(motion, None), tail, vec![note, peak]);
            if self.scene.scene.is_none() {
                scene.title = "The default parapet, shaken".into();
            }
        } else if self.tail.is_some() {
            bail!(
                "--tail belongs to a motion given with --record or --synthetic; a scene states its own tail"
            );
        }
        apply_set(&self.scene.set, &mut scene)?;
        if self.hold {
            let Some(excitation) = scene.excitation.take() else {
                bail!("--hold needs a motion; give --record or --synthetic, or a scene with one");
            };
            scene.excitation = Some(excitation.held());
            scene.motion_notes.push("each sample held until the next".into());
        }
        scene.set_output(self.stop_time, None, None).context("--stop-time")?;
        scene.set_output(None, self.output_step, None).context("--output-step")?;
        scene.set_output(None, None, self.thresholds.clone()).context("--thresholds")?;
        Ok(scene)
    }
}

/// Reads a floor: its period, and if stated its damping ratio and its mass.
fn floor(text: &str) -> Result<Floors, String> {
    let expected = || format!("{text:?} is not a floor; expected T=0.3,xi=0.05 or T=0.3,xi=0.05,mass=2e4");
    let mut storey = StoreyTable::default();
    for part in text.split(',') {
        let (name, value) = part.split_once('=').ok_or_else(expected)?;
        let value: f64 = value.trim().parse().map_err(|_| expected())?;
        match name.trim() {
            "T" => storey.period = Some(value),
            "xi" => storey.damping_ratio = Some(value),
            "mass" => storey.mass = Some(value),
            _ => return Err(expected()),
        }
    }
    Floors::new(&[storey], SupportsTable::default()).map_err(|(_, message)| message)
}
