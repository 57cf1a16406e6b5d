//! Curve of demand over intensity, of one wall, record and model.

use files::choices;
use serde::{Deserialize, Serialize};

/// A run: one wall through one record scaled to one level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Run {
    /// Level: the intensity to which the record was scaled, in SI units.
    pub intensity: f64,
    /// Demand: largest |u|/`u_ins` \[-\]; 1 of a wall that overturned.
    pub demand: f64,
    /// Time of overturning from the start of the record \[s\]; of a wall that comes back only where this is a
    /// collapse.
    pub overturning: Option<f64>,
    /// Demand on ties that may yield; `None` where there are none.
    pub tie: Option<TieDemand>,
    /// Sensitivity \[-\] of a collapse: the change of u/`u_ins` over the relative change of the record that
    /// causes it, of the run at the collapse where the wall overturns, or of the largest |u| at the level
    /// below; the larger of the two. It is measured up to 1e12. `None` of other runs, and of a collapse
    /// without a level below it at which the wall stands.
    pub sensitivity: Option<f64>,
}

/// Sensitivity above which the level of a collapse is not a property of the wall and the record: a change of
/// 1e-10 of the record, far below what a recorder of 16 bits resolves, changes u by as much as `u_ins`.
pub const SENSITIVE_ABOVE: f64 = 1e10;

/// Demand of a run on ties that may yield, of the two sides the larger one, up to overturning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieDemand {
    /// Largest force of a tie \[N\].
    pub force: f64,
    /// Largest plastic elongation of a tie at the end \[m\]; above 0 where one has yielded.
    pub elongation: f64,
    /// A tie has broken.
    pub broken: bool,
}

/// Intensity at which the demand exceeds a limit state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exceedance {
    /// At this intensity.
    At(f64),
    /// Between these two levels: the wall does not exceed it at the lower one, which is 0 below the
    /// lowest level, and exceeds it at the upper one.
    Between([f64; 2]),
    /// Above this intensity, the highest level of the curve: the record is censored.
    Above(f64),
}

/// Which exceedance of a curve counts, where a wall stands again at a level above one that it exceeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Crossing {
    /// The lowest level that exceeds.
    First,
    /// The lowest level from which on all that were run exceed.
    Last,
    /// Each level for itself: the fraction of the records that exceed there.
    Fraction,
}

choices!(Crossing);

impl Crossing {
    /// Every variant, with the words of study files.
    pub const ALL: [(&str, Self); 3] =
        [("first", Self::First), ("last", Self::Last), ("fraction", Self::Fraction)];
}

impl Exceedance {
    /// Returns the least and the most that the intensity can be.
    pub fn bounds(self) -> [f64; 2] {
        match self {
            Self::At(intensity) => [intensity; 2],
            Self::Between(levels) => levels,
            Self::Above(intensity) => [intensity, f64::INFINITY],
        }
    }

    /// Returns the intensity: the geometric mean of two levels, the lowest level for one below it, infinite
    /// for a censored record.
    pub fn or_infinity(self) -> f64 {
        match self.bounds() {
            [least, most] if least == most || least == 0.0 => most,
            [least, most] => (least * most).sqrt(),
        }
    }
}

impl Run {
    /// Returns whether the wall exceeds `u_ins` and comes back, in a study whose collapse is to fall.
    pub fn comes_back(&self) -> bool {
        self.overturning.is_none() && self.demand > 1.0
    }

    /// Returns whether |u| exceeds a `fraction` of `u_ins`: whether the wall overturned for 1 and more.
    pub fn exceeds(&self, fraction: f64) -> bool {
        self.overturning.is_some() || (fraction < 1.0 && self.demand > fraction)
    }
}

/// Runs of one wall, record and model, in the order of their levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    runs: Vec<Run>,
    /// Number of runs below the collapse.
    below_collapse: usize,
    /// The run through the shocks before the last one, where that alone is scaled; its intensity is 0.
    before: Option<Run>,
}

impl Curve {
    /// Creates a curve from its runs in any order. One of intensity 0 goes through the shocks before the
    /// last.
    pub fn new(mut runs: Vec<Run>) -> Self {
        runs.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
        let before = runs.first().copied().filter(|run| run.intensity == 0.0);
        runs.drain(..usize::from(before.is_some()));
        let below_collapse = runs.iter().position(|run| run.overturning.is_some()).unwrap_or(runs.len());
        Self { runs, below_collapse, before }
    }

    /// Returns the run through the shocks before the last one, where that alone is scaled.
    pub fn before(&self) -> Option<&Run> {
        self.before.as_ref()
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

    /// Returns the sensitivity of the collapse, see [`Run::sensitivity`].
    pub fn sensitivity(&self) -> Option<f64> {
        self.runs.get(self.below_collapse)?.sensitivity
    }

    /// Returns the highest level below the collapse, or 0. The collapse lies between the two.
    pub fn level_below_collapse(&self) -> f64 {
        self.runs[..self.below_collapse].last().map_or(0.0, |run| run.intensity)
    }

    /// Counts the levels above the collapse at which the wall did not overturn: structural resurrections.
    pub fn resurrections(&self) -> usize {
        self.runs[self.below_collapse..].iter().filter(|run| run.overturning.is_none()).count()
    }

    /// Returns where |u| exceeds a `fraction` of `u_ins`, which is the collapse for a fraction of 1 and more;
    /// for the first time, or with [`Crossing::Last`] for the last.
    ///
    /// Between two levels without overturning the demand is interpolated linearly. Where the wall overturns
    /// at the upper one, or `at_levels` is set, only the two levels are known.
    pub fn exceedance(&self, fraction: f64, crossing: Crossing, at_levels: bool) -> Exceedance {
        let exceeds = |run: &Run| run.exceeds(fraction);
        let first = match crossing {
            Crossing::Last => self.runs.iter().rposition(|run| !exceeds(run)).map(|below| below + 1),
            Crossing::First | Crossing::Fraction => self.runs.iter().position(exceeds),
        };
        let first = first.unwrap_or(if crossing == Crossing::Last { 0 } else { self.runs.len() });
        let Some(run) = self.runs.get(first) else { return Exceedance::Above(self.top()) };
        let below = first.checked_sub(1).map(|below| self.runs[below]);
        let [intensity, demand] = below.map_or([0.0; 2], |run| [run.intensity, run.demand]);
        if at_levels || run.overturning.is_some() {
            return Exceedance::Between([intensity, run.intensity]);
        }
        let part = (fraction - demand) / (run.demand - demand);
        Exceedance::At(intensity + part * (run.intensity - intensity))
    }

    /// Returns whether |u| exceeds a `fraction` of `u_ins` at an intensity: as at the nearest level, by the
    /// ratio of intensities. Returns `None` above the levels, unless the highest one exceeds.
    pub fn exceeds(&self, fraction: f64, intensity: f64) -> Option<bool> {
        let above = self.runs.partition_point(|run| run.intensity < intensity);
        let at = |index: usize| self.runs.get(index).map(|run| (run.intensity, run.exceeds(fraction)));
        match (above.checked_sub(1).and_then(at), at(above)) {
            (Some((_, exceeds)), None) => exceeds.then_some(true),
            (None, upper) => upper.map(|(level, exceeds)| exceeds && level <= intensity),
            (Some((lower, below)), Some((upper, above))) => {
                Some(if lower * upper < intensity * intensity { above } else { below })
            }
        }
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

    /// Returns the highest level.
    pub fn top(&self) -> f64 {
        self.runs.last().map_or(0.0, |run| run.intensity)
    }
}
