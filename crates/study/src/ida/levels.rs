//! Levels of intensity at which a curve is run.

use super::Run;
use super::error::IdaError;
use super::unit::IntensityUnit;
use record::LANES;
use serde::{Deserialize, Serialize};

/// Most levels of one curve.
const MOST_LEVELS: usize = 2000;
/// Bound on the rounds of bracketing and filling; each shortens the bracket or the gaps up to ninefold.
const MOST_ROUNDS: usize = 40;
/// Largest intensity, in SI units.
const HIGHEST: f64 = 1e4;

/// Levels of intensity at which a curve is run, in the SI unit of the measure: m/s² of an acceleration.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// Each record once, at its own intensity times a scale: a cloud.
    Cloud {
        /// Factor on every record \[-\].
        scale: f64,
    },
    /// Each of these, in rising order, also beyond overturning.
    Grid(Vec<f64>),
    /// These, in rising order, each with its own records, run once and as they are.
    Stripes(Vec<f64>),
    /// `step`, 2 `step` … up to the first level at which the wall overturns, at most up to `top`.
    ToOverturning {
        /// Distance between levels.
        step: f64,
        /// Highest level.
        top: f64,
    },
    /// Growing steps until the wall overturns, then a bracket of the collapse, then levels in the gaps below
    /// it.
    ///
    /// D. Vamvatsikos, C. A. Cornell: Applied incremental dynamic analysis. Earthquake Spectra 20(2), 2004,
    /// 523–553. The bracket is cut into up to nine parts at once, whose levels run side by side.
    HuntAndFill {
        /// First level and first step.
        first: f64,
        /// Increase of each step over the one before.
        increase: f64,
        /// Highest level.
        top: f64,
        /// Largest bracket of the collapse, as a part of the collapse intensity \[-\].
        resolution: f64,
        /// Largest gap between levels below the collapse, as a part of the collapse intensity \[-\].
        gap: f64,
    },
}

/// Formats a pure number.
fn number(value: f64) -> String {
    format!("{value:?}").trim_end_matches(".0").to_owned()
}

/// Checks that a value is within limits, which are formatted by `shown`.
fn check_range(
    name: &'static str,
    value: f64,
    shown: impl Fn(f64) -> String,
    [least, most]: [f64; 2],
) -> Result<(), IdaError> {
    if value >= least && value <= most {
        return Ok(());
    }
    let limit = if least == f64::MIN_POSITIVE {
        format!("above 0 and at most {}", shown(most))
    } else {
        format!("from {} to {}", shown(least), shown(most))
    };
    Err(IdaError::Levels { name, value: shown(value), limit })
}

/// How the runs of a study lie over the intensity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "LayoutKeys", into = "LayoutKeys")]
pub enum Layout {
    /// Curves: each record at several levels.
    #[default]
    Curves,
    /// A cloud: each record once, at its own level.
    Cloud,
    /// Stripes: each level with records of its own.
    Stripes,
}

/// The keys of a [`Layout`] in the description of a study.
#[derive(Serialize, Deserialize)]
struct LayoutKeys {
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    is_cloud: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    is_apart: bool,
}

impl From<Layout> for LayoutKeys {
    fn from(layout: Layout) -> Self {
        Self { is_cloud: layout == Layout::Cloud, is_apart: layout == Layout::Stripes }
    }
}

impl From<LayoutKeys> for Layout {
    fn from(keys: LayoutKeys) -> Self {
        match keys {
            LayoutKeys { is_cloud: true, .. } => Self::Cloud,
            LayoutKeys { is_apart: true, .. } => Self::Stripes,
            LayoutKeys { .. } => Self::Curves,
        }
    }
}

impl Levels {
    /// Returns how the runs lie over the intensity.
    pub fn layout(&self) -> Layout {
        match self {
            Self::Cloud { .. } => Layout::Cloud,
            Self::Stripes(_) => Layout::Stripes,
            Self::Grid(_) | Self::ToOverturning { .. } | Self::HuntAndFill { .. } => Layout::Curves,
        }
    }

    /// Returns the levels, in the SI unit of the measure, at which every record is run up to its collapse,
    /// and those of stripes;
    /// `None` where each record has its own levels.
    pub fn shared(&self) -> Option<Vec<f64>> {
        match self {
            Self::Grid(levels) | Self::Stripes(levels) => Some(levels.clone()),
            Self::ToOverturning { step, top } => Some(multiples(*step, *top).collect()),
            Self::HuntAndFill { .. } | Self::Cloud { .. } => None,
        }
    }

    /// Describes the levels in words, to all digits; `unit` is the SI unit of the measure.
    pub fn description(&self, unit: &str) -> String {
        match self {
            Self::Grid(levels) => {
                let levels: Vec<_> = levels.iter().map(f64::to_string).collect();
                format!("grid of {} {unit}", levels.join(", "))
            }
            Self::Cloud { scale } => format!("cloud of the records times {scale}"),
            Self::Stripes(levels) => format!("stripes of their own records at {levels:?} {unit}"),
            Self::ToOverturning { step, top } => format!("steps of {step} up to {top} {unit}"),
            Self::HuntAndFill { first, increase, top, resolution, gap } => format!(
                "hunt from {first} with {increase} more at each step up to {top} {unit}, resolution \
                 {resolution}, gap {gap}"
            ),
        }
    }

    /// Returns the highest level at which a record is run, even if the wall overturns below it. `own` is its
    /// level in a cloud.
    pub(super) fn certain(&self, own: f64) -> f64 {
        match *self {
            Self::Grid(ref levels) => levels.iter().copied().fold(0.0, f64::max),
            Self::ToOverturning { step, .. } => step,
            Self::HuntAndFill { first, .. } => first,
            Self::Cloud { .. } | Self::Stripes(_) => own,
        }
    }

    /// Estimates the number of runs of one curve. It is a guess where that depends on the collapse.
    pub(super) fn expected_runs(&self) -> f64 {
        match *self {
            Self::Cloud { .. } | Self::Stripes(_) => 1.0,
            Self::Grid(ref levels) => levels.len() as f64,
            Self::ToOverturning { step, top } => (0.5 * top / step).max(1.0),
            // the hunt and the bracket take about twenty
            Self::HuntAndFill { gap, .. } => 20.0 + 1.0 / gap,
        }
    }

    /// Checks every value.
    ///
    /// # Errors
    /// [`IdaError::Levels`] for a value outside its limits.
    pub(crate) fn check(&self, unit: IntensityUnit) -> Result<(), IdaError> {
        let intensity = |value| unit.shown(value);
        let count = |count: f64| check_range("number", count, number, [1.0, MOST_LEVELS as f64]);
        let top = |top| check_range("top", top, intensity, [1e-6, HIGHEST]);
        match *self {
            Self::Cloud { scale } => check_range("scale", scale, number, [f64::MIN_POSITIVE, HIGHEST]),
            Self::Grid(ref levels) | Self::Stripes(ref levels) => {
                count(levels.len() as f64)?;
                top(levels.iter().copied().fold(0.0, f64::max))?;
                let mut before = 0.0;
                for &level in levels {
                    // refuses NaN too
                    let rises = level > before;
                    if !rises {
                        let limit = "above 0 and above the level before it".to_owned();
                        return Err(IdaError::Levels { name: "a value", value: intensity(level), limit });
                    }
                    before = level;
                }
                Ok(())
            }
            Self::ToOverturning { step, top: highest } => {
                top(highest)?;
                check_range("step", step, intensity, [f64::MIN_POSITIVE, highest])?;
                count(highest / step)
            }
            Self::HuntAndFill { first, increase, top: highest, resolution, gap } => {
                top(highest)?;
                check_range("first", first, intensity, [f64::MIN_POSITIVE, highest])?;
                check_range("increase", increase, intensity, [0.0, highest])?;
                check_range("resolution", resolution, number, [1e-12, 1.0])?;
                check_range("gap", gap, number, [0.01, 1.0])?;
                count(hunt([first, increase, highest]).count() as f64)
            }
        }
    }
}

/// The runs of one curve so far, which decide on the levels of the next ones.
pub(super) struct Trace<'a> {
    levels: &'a Levels,
    /// Level of the record in a cloud.
    own: f64,
    /// Runs, by rising intensity.
    runs: Vec<Run>,
    /// Rounds of bracketing and filling.
    rounds: usize,
}

impl<'a> Trace<'a> {
    pub(super) fn new(levels: &'a Levels, own: f64) -> Self {
        Self { levels, own, runs: Vec::new(), rounds: 0 }
    }

    /// Returns the levels to run next; none once the curve is complete.
    pub(super) fn wanted(&mut self) -> Vec<f64> {
        match *self.levels {
            Levels::Cloud { .. } | Levels::Stripes(_) if self.runs.is_empty() => vec![self.own],
            Levels::Grid(ref levels) if self.runs.is_empty() => levels.clone(),
            Levels::Cloud { .. } | Levels::Grid(_) | Levels::Stripes(_) => Vec::new(),
            Levels::ToOverturning { step, top } => self.ascend(multiples(step, top)),
            Levels::HuntAndFill { first, increase, top, resolution, gap } => {
                let mut wanted = self.ascend(hunt([first, increase, top]));
                if wanted.is_empty() && self.rounds < MOST_ROUNDS {
                    self.rounds += 1;
                    wanted = bracket(&self.runs, resolution);
                    if wanted.is_empty() {
                        wanted = gaps(&self.runs, gap);
                    }
                }
                wanted
            }
        }
    }

    /// Returns the next of some levels, so many as go side by side; none once the wall has overturned.
    fn ascend(&self, levels: impl Iterator<Item = f64>) -> Vec<f64> {
        let more = if first_overturning(&self.runs).is_some() { 0 } else { LANES };
        levels.skip(self.runs.len()).take(more).collect()
    }

    /// Adds the run at a level that was wanted.
    pub(super) fn add(&mut self, run: Run) {
        let place = self.runs.partition_point(|other| other.intensity <= run.intensity);
        self.runs.insert(place, run);
    }

    /// Returns the runs of the complete curve.
    pub(super) fn finish(mut self) -> Vec<Run> {
        if let (Levels::ToOverturning { .. }, Some(first)) = (self.levels, first_overturning(&self.runs)) {
            self.runs.truncate(first + 1);
        }
        self.runs
    }
}

/// Returns the multiples of a step up to a top. A tolerance for rounding includes a top that is a multiple.
fn multiples(step: f64, top: f64) -> impl Iterator<Item = f64> {
    (1..=MOST_LEVELS).map(move |k| k as f64 * step).take_while(move |level| *level <= top * (1.0 + 1e-12))
}

/// Returns the levels of the hunt; the last one is the top.
fn hunt([first, increase, top]: [f64; 3]) -> impl Iterator<Item = f64> {
    let (mut level, mut step) = (0.0, first);
    // one more than is allowed, so that `check` notices too many
    (0..=MOST_LEVELS).map_while(move |_| {
        if level >= top {
            return None;
        }
        level = f64::min(level + step, top);
        step += increase;
        Some(level)
    })
}

fn first_overturning(runs: &[Run]) -> Option<usize> {
    runs.iter().position(|run| run.overturning.is_some())
}

/// Returns levels that cut the bracket of the collapse; none where it is within `resolution` or nothing
/// collapsed.
fn bracket(runs: &[Run], resolution: f64) -> Vec<f64> {
    let Some(first) = first_overturning(runs) else { return Vec::new() };
    let upper = runs[first].intensity;
    let lower = first.checked_sub(1).map_or(0.0, |below| runs[below].intensity);
    cuts(lower, upper, resolution * upper)
}

/// Returns levels that cut each gap wider than `gap` times the collapse intensity, or times the top.
fn gaps(runs: &[Run], gap: f64) -> Vec<f64> {
    let end = first_overturning(runs).unwrap_or(runs.len() - 1);
    let widest = gap * runs[end].intensity;
    let lower = std::iter::once(0.0).chain(runs.iter().map(|run| run.intensity));
    let pairs = lower.zip(runs[..=end].iter().map(|run| run.intensity));
    pairs.flat_map(|(lower, upper)| cuts(lower, upper, widest)).collect()
}

/// Returns the inner ends of the fewest equal parts of an interval no longer than `longest`, at most nine
/// parts.
fn cuts(lower: f64, upper: f64, longest: f64) -> Vec<f64> {
    // a part that is too long only by its rounding is not cut again
    let count = ((upper - lower) / longest - 1e-9).ceil().min(LANES as f64 + 1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 9")]
    let count = count.max(1.0) as u32;
    (1..count).map(|k| lower + (upper - lower) * f64::from(k) / f64::from(count)).collect()
}
