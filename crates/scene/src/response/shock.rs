//! The shocks of a sequence of records, each with its demands.

use rocking_wall::simulation::{Excitation, Progress, RunError, Simulation, segment_of};
use rocking_wall::solver::{Demands, Peaks, State, TieDemands};
use serde::Serialize;

use crate::Scene;

/// A shock of a sequence, from its first sample to that of the next one, or to the end of the run. The wall,
/// its ties and what they remember go on from one to the next.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shock {
    /// When it begins \[s\].
    pub start: f64,
    /// When it ends \[s\].
    pub end: f64,
    /// The wall had fallen before it began, and moves no more.
    pub fallen_before: bool,
    /// Largest |u| of this shock; `u_ins` of its side for a wall that falls \[m\].
    pub u_max: f64,
    /// Largest |u|/`u_ins` of its side; 1 for a wall that falls \[-\].
    pub u_ratio_max: f64,
    /// |u| has exceeded `u_ins` by the end of this shock.
    pub overturned: bool,
    /// |u| has exceeded `u_ins`, and is not below it at the end of this shock.
    pub falls: bool,
    /// u at the end of this shock \[m\].
    pub residual: f64,
    /// Demands of this shock up to overturning. The elongation of a tie is that of all shocks so far, and
    /// a tie that had broken before keeps its time.
    pub demands: Demands,
}

/// Runs a scene once more, shock by shock of its sequence; returns none of a single motion. `simulation` is
/// at the start, `motion` that of the supports, and `falling` when the wall falls \[s\].
pub(super) fn shocks(
    scene: &Scene,
    mut simulation: Simulation,
    motion: Option<&Excitation>,
    falling: Option<f64>,
) -> Result<Vec<Shock>, RunError> {
    let Some(record) = scene.excitation.as_ref().map(Excitation::bottom) else { return Ok(Vec::new()) };
    let later = record.shocks().into_iter().skip(1).map(|shock| shock.start as f64 * record.step());
    let mut ends: Vec<f64> = later.filter(|start| *start < scene.stop_time).collect();
    ends.extend((!ends.is_empty()).then_some(scene.stop_time));
    let mut before: Vec<TieDemands> = Vec::new();
    let next = |end: f64| {
        let Progress { time: start, state, .. } = *simulation.progress();
        let state = State { peaks: Peaks::at(state.displacement), ..state };
        simulation.restore(Progress { state, ..*simulation.progress() });
        let mut demands = simulation.demands(segment_of(motion, start, 0.0).from, &scene.thresholds);
        for (tie, before) in demands.ties.iter_mut().zip(&before) {
            tie.yielding = before.yielding;
        }
        simulation.advance_to(end, motion, Some(&mut demands))?;
        before.clone_from(&demands.ties);
        let (state, u_ins) = (simulation.progress().state, simulation.wall().body().instability);
        let (residual, overturned) = (state.displacement, state.overturned);
        let falls = overturned && residual.abs() >= u_ins.of(residual);
        let [u_max, u_ratio_max] = state.reported_peak(u_ins, falls);
        let fallen_before = falling.is_some_and(|time| time <= start);
        Ok(Shock { start, end, fallen_before, u_max, u_ratio_max, overturned, falls, residual, demands })
    };
    ends.into_iter().map(next).collect()
}
