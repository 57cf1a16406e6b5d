//! Curve of demand over intensity, of one wall, record and model.

use rocking_wall::solver::State;
use rocking_wall::wall::Wall;

/// A run: one wall through one record scaled to one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Level: the intensity to which the record was scaled \[m/s²\].
    pub intensity: f64,
    /// Demand: largest |u|/`u_ins` \[-\]; 1 of a wall that overturned, where its run stops.
    pub demand: f64,
    /// Time of overturning from the start of the record \[s\].
    pub overturning: Option<f64>,
    /// Demand on ties that may yield; `None` where there are none.
    pub tie: Option<TieDemand>,
}

/// Demand of a run on ties that may yield, of the two sides the larger one, up to overturning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieDemand {
    /// Largest force \[N\].
    pub force: f64,
    /// Plastic elongation at the end \[m\]; above 0 where a tie has yielded.
    pub elongation: f64,
    /// A tie has broken.
    pub broken: bool,
}

impl TieDemand {
    /// Returns the demand of a run from upright, of its state at the end. All of it follows from the peaks: N
    /// and p grow with the largest |u|.
    pub(super) fn of(wall: &Wall, state: &State) -> Option<Self> {
        let tie = wall.tie().filter(|tie| tie.ultimate.is_some())?;
        let (strength, yields, breaks) =
            (tie.strength?, tie.strength_displacement()?, tie.fracture_displacement()?);
        let mut demand = Self { force: 0.0, elongation: 0.0, broken: false };
        for sign in [1.0, -1.0].into_iter().filter(|sign| tie.holds(*sign)) {
            let reach = state.peaks.of(sign).min(wall.body().instability.of(sign));
            let force = if reach < yields { tie.force(sign * reach) } else { strength };
            demand.force = demand.force.max(force);
            demand.elongation = demand.elongation.max(tie.elongation(reach));
            demand.broken |= reach >= breaks;
        }
        Some(demand)
    }
}

/// Intensity at which the demand first exceeds a limit state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exceedance {
    /// At this intensity \[m/s²\].
    At(f64),
    /// Above this intensity, the highest level of the curve \[m/s²\]: the record is censored.
    Above(f64),
}

impl Exceedance {
    /// Returns the intensity, infinite for a censored record.
    pub fn or_infinity(self) -> f64 {
        match self {
            Self::At(intensity) => intensity,
            Self::Above(_) => f64::INFINITY,
        }
    }
}

/// Runs of one wall, record and model, in the order of their levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    runs: Vec<Run>,
    /// Number of runs below the collapse.
    below_collapse: usize,
}

impl Curve {
    /// Creates a curve from its runs in any order.
    pub fn new(mut runs: Vec<Run>) -> Self {
        runs.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
        let below_collapse = runs.iter().position(|run| run.overturning.is_some()).unwrap_or(runs.len());
        Self { runs, below_collapse }
    }

    /// Returns the runs in the order of their levels.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// Returns the collapse intensity: the lowest level at which the wall overturned.
    pub fn collapse(&self) -> Exceedance {
        match self.runs.get(self.below_collapse) {
            Some(run) => Exceedance::At(run.intensity),
            None => Exceedance::Above(self.top()),
        }
    }

    /// Returns the highest level below the collapse, or 0 \[m/s²\]. The collapse lies between the two.
    pub fn level_below_collapse(&self) -> f64 {
        self.runs[..self.below_collapse].last().map_or(0.0, |run| run.intensity)
    }

    /// Counts the levels above the collapse at which the wall did not overturn: structural resurrections.
    pub fn resurrections(&self) -> usize {
        self.runs[self.below_collapse..].iter().filter(|run| run.overturning.is_none()).count()
    }

    /// Returns where |u| first exceeds a `fraction` of `u_ins`, which is the collapse for a fraction of 1 and
    /// more.
    ///
    /// Between two levels without overturning the demand is interpolated linearly. The intensity is that of a
    /// level where the wall overturns at it, or where `at_levels` is set.
    pub fn exceedance(&self, fraction: f64, at_levels: bool) -> Exceedance {
        let mut before = [0.0, 0.0];
        for run in &self.runs {
            let exceeded = run.overturning.is_some() || (fraction < 1.0 && run.demand > fraction);
            if exceeded && (at_levels || run.overturning.is_some()) {
                return Exceedance::At(run.intensity);
            }
            if exceeded {
                let [intensity, demand] = before;
                let part = (fraction - demand) / (run.demand - demand);
                return Exceedance::At(intensity + part * (run.intensity - intensity));
            }
            before = [run.intensity, run.demand];
        }
        Exceedance::Above(self.top())
    }

    /// Returns |u|/`u_ins` at an intensity, interpolated linearly from the origin on, and infinite from the
    /// collapse on. Returns `None` above the levels of a wall that never overturned.
    pub fn demand(&self, intensity: f64) -> Option<f64> {
        let mut before = [0.0, 0.0];
        for run in &self.runs {
            if run.overturning.is_some() {
                return Some(if intensity <= before[0] { before[1] } else { f64::INFINITY });
            }
            if intensity <= run.intensity {
                let part = (intensity - before[0]) / (run.intensity - before[0]);
                return Some(before[1] + part * (run.demand - before[1]));
            }
            before = [run.intensity, run.demand];
        }
        None
    }

    /// Returns the highest level \[m/s²\].
    pub fn top(&self) -> f64 {
        self.runs.last().map_or(0.0, |run| run.intensity)
    }
}
