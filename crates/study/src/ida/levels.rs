//! Which intensities a curve is run at.

use super::{IdaError, Level};
use ground_motion::STANDARD_GRAVITY;
use rocking_wall::solver::record::LANES;

/// Most levels of one curve.
const MOST_LEVELS: usize = 2000;
/// Bound on the rounds of bracketing and filling; each shortens the bracket or the gaps up to ninefold.
const MOST_ROUNDS: usize = 40;
/// Largest intensity \[m/s²\].
const HIGHEST: f64 = 1e4;

/// Which intensities a curve is run at, in m/s².
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// At each of these, in rising order, also beyond overturning.
    Grid(Vec<f64>),
    /// At `step`, 2 `step` … up to the first at which the wall overturns, at most up to `top`.
    ToOverturning {
        /// Distance of the levels \[m/s²\].
        step: f64,
        /// Highest level \[m/s²\].
        top: f64,
    },
    /// Steps that grow until the wall overturns, then a bracket of the collapse, then levels in the gaps below it.
    ///
    /// D. Vamvatsikos, C. A. Cornell: Applied incremental dynamic analysis. Earthquake Spectra 20(2), 2004, 523–553. The
    /// bracket is cut into up to nine parts at once, whose levels run side by side.
    HuntAndFill {
        /// First level and first step \[m/s²\].
        first: f64,
        /// By how much each step is longer than the one before \[m/s²\].
        increase: f64,
        /// Highest level \[m/s²\].
        top: f64,
        /// Largest bracket of the collapse, as part of the collapse intensity \[-\].
        resolution: f64,
        /// Largest gap between levels below the collapse, as part of the collapse intensity \[-\].
        gap: f64,
    },
}

/// In both units: a study may state either.
fn acceleration(value: f64) -> String {
    let rounded = |value: f64| format!("{value:.5e}").parse().unwrap_or(value);
    format!("{} m/s² ({} g)", rounded(value), rounded(value / STANDARD_GRAVITY))
}

impl Levels {
    /// The levels \[m/s²\] that every record sees, up to its collapse at least; `None` where each record has its own.
    #[must_use]
    pub fn shared(&self) -> Option<Vec<f64>> {
        match self {
            Self::Grid(levels) => Some(levels.clone()),
            Self::ToOverturning { step, top } => Some(multiples(*step, *top).collect()),
            Self::HuntAndFill { .. } => None,
        }
    }

    /// # Errors
    /// [`IdaError::Levels`] outside the limits.
    pub(super) fn check(&self) -> Result<(), IdaError> {
        let within = |name, value: f64, shown: &dyn Fn(f64) -> String, [least, most]: [f64; 2]| {
            if value >= least && value <= most {
                return Ok(());
            }
            let limit = if least == f64::MIN_POSITIVE {
                format!("above 0 and at most {}", shown(most))
            } else {
                format!("from {} to {}", shown(least), shown(most))
            };
            Err(IdaError::Levels { name, value: shown(value), limit })
        };
        let plain = |value: f64| format!("{value:?}").trim_end_matches(".0").to_owned();
        let count = |value: f64| within("number", value, &plain, [1.0, MOST_LEVELS as f64]);
        let top = |top| within("top", top, &acceleration, [1e-6, HIGHEST]);
        match self {
            Self::Grid(levels) => {
                count(levels.len() as f64)?;
                top(levels.iter().copied().fold(0.0, f64::max))?;
                let mut before = 0.0;
                for &level in levels {
                    // NaN is not above anything either
                    let rises = level > before;
                    if !rises {
                        let limit = "above 0 and above the level before it".to_owned();
                        return Err(IdaError::Levels { name: "a value", value: acceleration(level), limit });
                    }
                    before = level;
                }
                Ok(())
            }
            Self::ToOverturning { step, top: highest } => {
                top(*highest)?;
                within("step", *step, &acceleration, [f64::MIN_POSITIVE, *highest])?;
                count(highest / step)
            }
            Self::HuntAndFill { first, increase, top: highest, resolution, gap } => {
                top(*highest)?;
                within("first", *first, &acceleration, [f64::MIN_POSITIVE, *highest])?;
                within("increase", *increase, &acceleration, [0.0, *highest])?;
                within("resolution", *resolution, &plain, [1e-6, 1.0])?;
                within("gap", *gap, &plain, [0.01, 1.0])?;
                count(hunt([*first, *increase, *highest]).count() as f64)
            }
        }
    }

    /// Runs the levels of one curve; `run` takes some and gives as many.
    pub(super) fn trace<E>(
        &self,
        mut run: impl FnMut(&[f64]) -> Result<Vec<Level>, E>,
    ) -> Result<Vec<Level>, E> {
        match self {
            Self::Grid(levels) => run(levels),
            Self::ToOverturning { step, top } => {
                let mut runs = ascend(multiples(*step, *top), &mut run)?;
                let end = runs.iter().position(|level| level.overturning.is_some());
                runs.truncate(end.map_or(runs.len(), |end| end + 1));
                Ok(runs)
            }
            Self::HuntAndFill { first, increase, top, resolution, gap } => {
                let mut runs = ascend(hunt([*first, *increase, *top]), &mut run)?;
                for _ in 0..MOST_ROUNDS {
                    runs.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
                    let mut wanted = bracket(&runs, *resolution);
                    if wanted.is_empty() {
                        wanted = gaps(&runs, *gap);
                    }
                    if wanted.is_empty() {
                        break;
                    }
                    runs.extend(run(&wanted)?);
                }
                Ok(runs)
            }
        }
    }
}

/// Multiples of a step up to a top, with half a rounding's room, so that a top of so many steps is among them.
fn multiples(step: f64, top: f64) -> impl Iterator<Item = f64> {
    (1..=MOST_LEVELS).map(move |k| k as f64 * step).take_while(move |level| *level <= top * (1.0 + 1e-12))
}

/// The levels of the hunt, the last one the top.
fn hunt([first, increase, top]: [f64; 3]) -> impl Iterator<Item = f64> {
    let (mut level, mut step) = (0.0, first);
    // one more than is allowed, so that too many are found out
    (0..=MOST_LEVELS).map_while(move |_| {
        if level >= top {
            return None;
        }
        level = f64::min(level + step, top);
        step += increase;
        Some(level)
    })
}

/// Runs levels, several at once, up to those among which the wall first overturns.
fn ascend<E>(
    levels: impl Iterator<Item = f64>,
    run: &mut impl FnMut(&[f64]) -> Result<Vec<Level>, E>,
) -> Result<Vec<Level>, E> {
    let levels: Vec<f64> = levels.collect();
    let mut runs: Vec<Level> = Vec::new();
    for part in levels.chunks(LANES) {
        runs.extend(run(part)?);
        if runs.iter().any(|level| level.overturning.is_some()) {
            break;
        }
    }
    Ok(runs)
}

/// Levels that cut the bracket of the collapse, none where it is as short as `resolution` or there is no collapse.
fn bracket(runs: &[Level], resolution: f64) -> Vec<f64> {
    let Some(first) = runs.iter().position(|level| level.overturning.is_some()) else { return Vec::new() };
    let upper = runs[first].intensity;
    let lower = first.checked_sub(1).map_or(0.0, |below| runs[below].intensity);
    parts(lower, upper, resolution * upper)
}

/// Levels that cut each gap below the collapse, or below the top, that is wider than `gap` of it.
fn gaps(runs: &[Level], gap: f64) -> Vec<f64> {
    let end = runs.iter().position(|level| level.overturning.is_some()).unwrap_or(runs.len() - 1);
    let widest = gap * runs[end].intensity;
    let lower = std::iter::once(0.0).chain(runs.iter().map(|level| level.intensity));
    let pairs = lower.zip(runs[..=end].iter().map(|level| level.intensity));
    pairs.flat_map(|(lower, upper)| parts(lower, upper, widest)).collect()
}

/// Inner ends of the fewest equal parts of an interval that are no longer than `longest`, at most nine.
fn parts(lower: f64, upper: f64, longest: f64) -> Vec<f64> {
    // a part that is too long by its rounding is not cut again
    let count = ((upper - lower) / longest - 1e-9).ceil().min(LANES as f64 + 1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let count = count.max(1.0) as u32;
    (1..count).map(|k| lower + (upper - lower) * f64::from(k) / f64::from(count)).collect()
}
