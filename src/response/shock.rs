//! The shocks of a sequence of records, each with its demands.

use serde::Serialize;

use crate::simulation::Simulation;
use crate::solver::{Demands, reported_peak};
use crate::wall::Support;

/// A shock of a sequence, from its first sample to that of the next one, or to the end of the run. The wall,
/// its ties and what they remember go on from one to the next.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shock {
    /// When it begins \[s\].
    pub start: f64,
    /// When it ends \[s\].
    pub end: f64,
    /// Largest |u| of this shock up to overturning; `u_ins` of its side for a wall that falls \[m\].
    pub u_max: f64,
    /// Largest |u|/`u_ins` of its side; 1 for a wall that falls \[-\].
    pub u_ratio_max: f64,
    /// |u| has exceeded `u_ins` by the end of this shock.
    pub overturned: bool,
    /// |u| has exceeded `u_ins`, and is not below it at the end of this shock.
    pub falls: bool,
    /// u at the end of this shock \[m\].
    pub residual: f64,
    /// Demands of this shock; `None` after the one in which the wall overturns. The elongation of a tie, and
    /// that it has broken, are those of all shocks so far.
    pub demands: Option<Demands>,
}

/// Demands shock by shock, during a run.
pub(super) struct Shocks {
    ended: Vec<Shock>,
    start: f64,
    /// Whether the wall had overturned before this shock.
    had_overturned: bool,
    /// Demands of the shocks before this one.
    before: Option<Demands>,
    /// Demands of this shock, or of the last one before overturning and all that follow.
    pub(super) demands: Demands,
}

impl Shocks {
    /// Begins with the demands of the start.
    pub(super) fn new(demands: Demands) -> Self {
        Self { ended: Vec::new(), start: 0.0, had_overturned: false, before: None, demands }
    }

    /// Ends a shock, and begins the next one now.
    pub(super) fn begin_next(&mut self, simulation: &Simulation, support: Support, fractions: &[f64]) {
        self.end(simulation);
        self.start = simulation.progress().time;
        self.had_overturned = simulation.progress().state.overturned;
        if !self.had_overturned {
            let mut next = simulation.demands(support, fractions);
            next.go_on(&self.demands);
            self.before = Some(self.so_far());
            self.demands = next;
        }
    }

    /// Returns the shocks of a sequence, none of a single record, and the demands of all.
    pub(super) fn finish(mut self, simulation: &Simulation) -> (Vec<Shock>, Demands) {
        if !self.ended.is_empty() {
            self.end(simulation);
        }
        let demands = self.so_far();
        (self.ended, demands)
    }

    /// Returns the demands of this shock and of all before.
    fn so_far(&self) -> Demands {
        let Some(mut all) = self.before.clone() else { return self.demands.clone() };
        all.add(&self.demands);
        all
    }

    fn end(&mut self, simulation: &Simulation) {
        let (progress, u_ins) = (simulation.progress(), simulation.wall().body().instability);
        let residual = progress.state.displacement;
        let overturned = progress.state.overturned;
        let falls = overturned && residual.abs() >= u_ins.of(residual);
        let ratio = |u: f64| u.abs() / u_ins.of(u);
        let extremes = self.demands.displacement;
        let [highest, lowest] = [extremes.highest.value, extremes.lowest.value];
        let peak = [extremes.largest().value.abs(), ratio(highest).max(ratio(lowest))];
        let [u_max, u_ratio_max] = reported_peak(peak, u_ins.of(residual), falls);
        let demands = (!self.had_overturned).then(|| self.demands.clone());
        let (start, end) = (self.start, progress.time);
        self.ended.push(Shock { start, end, u_max, u_ratio_max, overturned, falls, residual, demands });
    }
}
