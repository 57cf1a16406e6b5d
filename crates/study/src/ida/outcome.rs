//! Runs from the outcomes of the solver.

use files::choices;
use record::{Outcome, RunEnd};
use rocking_wall::solver::{Motion, State};
use rocking_wall::wall::Wall;
use serde::{Deserialize, Serialize};

use super::{Run, TieDemand};

/// Returns the run at a level whose outcome is known.
pub(super) fn run_of(motion: &Motion, intensity: f64, outcome: &Outcome) -> Run {
    let (wall, Outcome { state, overturning, .. }) = (motion.wall(), outcome);
    let demand = state.reported_peak(wall.body().instability, overturning.is_some())[1];
    Run { intensity, demand, overturning: *overturning, tie: tie_demand(wall, state), sensitivity: None }
}

/// Returns |Δu|/`u_ins` between a run and the outcome of a run beside it: where both overturn u̇ times the
/// time between, else the difference of their demands.
pub(super) fn difference(run: &Run, motion: &Motion, other: &Outcome) -> f64 {
    match (run.overturning, other.overturning) {
        (Some(time), Some(later)) => {
            let (u, v) = (other.state.displacement, other.state.velocity);
            (v * (later - time) / motion.wall().body().instability.of(u)).abs()
        }
        _ => (run.demand - run_of(motion, run.intensity, other).demand).abs(),
    }
}

/// Returns the demand on ties that may yield of a run from upright, of its state at the end. All of it
/// follows from the peaks: N and p grow with the largest |u|.
fn tie_demand(wall: &Wall, state: &State) -> Option<TieDemand> {
    let yielding = || wall.ties().iter().filter(|tie| tie.ultimate.is_some());
    yielding().next()?;
    let mut demand = TieDemand { force: 0.0, elongation: 0.0, broken: false };
    for (tie, sign) in yielding().flat_map(|tie| [(tie, 1.0), (tie, -1.0)]) {
        let limits = [tie.strength_displacement(), tie.fracture_displacement()];
        let ([Some(yields), Some(breaks)], true) = (limits, tie.holds(sign)) else { continue };
        // a sequence may have stretched it before the shock whose peaks these are
        let reach =
            state.peaks.of(sign).max(state.tie.yielded.of(sign)).min(wall.body().instability.of(sign));
        let force = if reach < yields { tie.force(sign * reach) } else { tie.strength.unwrap_or_default() };
        demand.force = demand.force.max(force);
        demand.elongation = demand.elongation.max(tie.elongation(reach));
        demand.broken |= reach >= breaks;
    }
    Some(demand)
}

/// Which runs have overturned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Collapse {
    /// Those that exceed `u_ins`, where they stop.
    #[default]
    Exceeds,
    /// Those that end beyond `u_ins`; runs go on to the end of the tail.
    Falls,
}

choices!(Collapse);

impl Collapse {
    /// Returns where a run ends.
    pub(crate) fn end(self) -> RunEnd {
        match self {
            Self::Exceeds => RunEnd::AtPeaks,
            Self::Falls => RunEnd::OfRecord,
        }
    }
}
