//! `wall simulate --records` and `--both-polarities`: one wall under several motions, as a table.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use ground_motion::GroundMotion;
use rocking_wall::wall::Wall;
use run::motions::{self, MotionRow};
use run::parallel;
use scene::response::Response;
use serde_json::json;

use super::arguments::Arguments;
use crate::args::short_name;
use crate::output::{self, Console, progress};
use run::polarity::Polarities;

/// A record, scaled: its name, a note on it, and its motion.
type Shaking = (String, String, GroundMotion);

pub(super) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    if arguments.html.is_some() {
        bail!("--html shows one run; give its record with --record, without --both-polarities");
    }
    let scene = arguments.scene.load(console)?;
    let inputs = arguments.scene.inputs(&scene).chain(arguments.listed());
    console.check_distinct(inputs, &arguments.csv)?;
    let motions = read(console, arguments)?;
    let first = motions.first().map(|(_, note, motion)| (motion.clone(), note.clone()));
    let first = arguments.shaken(scene.clone(), first)?;
    let wall = arguments.scene.named(Wall::new(&first.parameters))?;
    let polarities = Polarities::of(arguments.both_polarities, &first.parameters, &wall);
    let signs = polarities.signs();
    console.warn(first.warnings_of(&wall));
    console.warn(first.floors.iter().flat_map(|floors| floors.warnings(&wall)));
    let runs = signs.len() * motions.len();
    let row = |index: usize| {
        let ((name, note, motion), (sign, factor)) =
            (&motions[index / signs.len()], signs[index % signs.len()]);
        let motion = motion.checked_scaled(factor)?;
        let peak_acceleration = motion.peak();
        let mut scene = arguments.shaken(scene.clone(), Some((motion, note.clone())))?;
        // peaks and times come from the motion itself, not from samples
        scene.output_step = scene.stop_time;
        let response = Response::of(&scene).with_context(|| name.clone())?;
        parallel::count_done(runs);
        anyhow::Ok(MotionRow { name: name.clone(), sign, peak_acceleration, summary: response.summary })
    };
    let threads = parallel::threads(None).get();
    let rows = progress::shown(|| parallel::map(runs, threads, row))??;
    let table = motions::table(&rows);
    console.save(arguments.csv.as_ref(), || table.csv())?;
    if arguments.json {
        return console.json(&json!({
            "title": first.title,
            "alike_on_both_sides": polarities == Polarities::Alike,
            "runs": motions::json(&rows),
        }));
    }
    let counts = motions::overturned(&rows);
    let text = format!("{}\n{}{counts}{}", first.title, table.text(), polarities.note());
    console.print(&(text + &output::written("written  ", &arguments.csv)))
}

/// Reads the records and scales them.
fn read(console: &Console<'_>, arguments: &Arguments) -> Result<Vec<Shaking>> {
    let shaking = |path: &PathBuf| {
        let (motion, note) = arguments.record.read(console, path)?;
        Ok((short_name(path), note, arguments.record.motion.scaled(console, motion)?))
    };
    arguments.listed().iter().map(shaking).collect()
}
