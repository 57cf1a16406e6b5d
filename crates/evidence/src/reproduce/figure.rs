//! Figures as data, and what several of them need.

use report::plot::Plot;
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::Parameters;
use scene::response::{Response, Sample};
use scene::{Scene, SceneError};

/// A figure of the paper, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Number.
    pub number: u8,
    /// Title.
    pub title: &'static str,
    /// Assumptions, and what does not match print; a paragraph a line.
    pub notes: String,
    /// Panels.
    pub charts: Vec<Plot>,
}

/// Runs a wall, free or excited, at `step` up to `end` \[s\]; returns a point for each sample.
pub(super) fn run(
    parameters: &Parameters,
    excitation: Option<Excitation>,
    [step, end]: [f64; 2],
    point: impl Fn(&Sample) -> (f64, f64),
) -> Result<Vec<(f64, f64)>, SceneError> {
    let parameters = parameters.clone();
    let scene = Scene { parameters, excitation, stop_time: end, output_step: step, ..Scene::default() };
    Ok(Response::of(&scene)?.samples.iter().map(point).collect())
}

/// Time \[s\] and u/`u_ins` of a sample.
pub(super) fn history(sample: &Sample) -> (f64, f64) {
    (sample.time, sample.outputs.ratio)
}

/// Returns `count` + 1 equally spaced values.
pub(super) fn spaced([from, to]: [f64; 2], count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |index| from + (to - from) * f64::from(index) / f64::from(count))
}
