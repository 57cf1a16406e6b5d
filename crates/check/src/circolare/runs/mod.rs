//! Runs of a wall under records, judged by thresholds of d: of each record the worse of both signs.

pub(crate) mod compatibility;
pub(crate) mod dynamic;
pub(crate) mod level;

use record::RunEnd;
use rocking_wall::wall::{Tie, Wall};
use run::bisection::first_true;
use run::records::NamedRecord;
use run::shaking::Shaking;
use serde::Serialize;

use super::checks::sides::{SideVerdict, SideVerdicts};
use crate::error::CheckError;
use crate::file::site::Records;
use crate::ntc::demand::combined;
use crate::words::names::{LimitState, Side};
use compatibility::Compatibility;

/// Ratio of factors that follow each other. A failure between two factors at which the wall passes is not
/// found.
const RATIO: f64 = 1.01;
/// Powers of the ratio among which the lowest factor that fails is searched: 0.01 to 100, and 1.
const POWERS: std::ops::RangeInclusive<i32> = -463..=463;
/// Factors that are run at once.
const AT_ONCE: usize = 64;
/// Halvings of the step in which the first failure lies: to 1e-5 of the factor.
const HALVINGS: u32 = 10;

/// Thresholds of both sides; those of limit states are overturning on a side that is not checked \[m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Thresholds {
    pub(super) limit: [f64; 2],
    /// Overturning: `d_0`, or `u_ins` if the model ends earlier.
    end: [f64; 2],
    /// Where the tie has its strength.
    strength: [f64; 2],
    /// Whether a run that reaches the strength of the tie fails.
    tie_is_end: bool,
}

/// The maxima of |d| of a run, on both sides \[m\].
type Maxima = [f64; 2];

impl Thresholds {
    /// Those of a limit state; `stretch` is d/u.
    pub(super) fn of(wall: &Wall, sides: &SideVerdicts, state: LimitState, stretch: f64) -> Self {
        let of_side = |(sign, side): (f64, Option<&SideVerdict>)| {
            // runs rock as the scene does: where the static checks leave a side out, they may go up to
            // overturning
            let falls = stretch * wall.body().instability.of(sign);
            let end = side.map_or(falls, |side| side.curve.d0.min(falls));
            let limit = side.and_then(|side| side.displacement(state)).map_or(end, |check| check.d);
            // where a tie has no other end, its strength is one; otherwise the first yield is told
            let ties = wall.ties().of_side(sign).filter(|tie| side.is_some() && ends(tie) == is_end(wall));
            let yields = ties.filter_map(Tie::strength_displacement).map(|u| stretch * u);
            let strength = yields.fold(f64::INFINITY, f64::min);
            [limit, end, strength]
        };
        let sides = [(1.0, sides.positive.as_ref()), (-1.0, sides.negative.as_ref())].map(of_side);
        let [limit, end, strength] = [0, 1, 2].map(|of| sides.map(|side| side[of]));
        Self { limit, end, strength, tie_is_end: is_end(wall) }
    }

    fn is_beyond(&self, [positive, negative]: Maxima) -> bool {
        positive > self.end[0] || negative > self.end[1]
    }

    fn is_at_strength(&self, [positive, negative]: Maxima) -> bool {
        positive >= self.strength[0] || negative >= self.strength[1]
    }

    /// Judges the maxima of |d| of some records, each with its signs.
    fn judge(&self, records: &[Vec<Maxima>]) -> Judged {
        let share = |d: &Maxima, side: usize| d[side] / self.limit[side];
        let worst = |runs: &Vec<Maxima>, of: &dyn Fn(&Maxima) -> f64| runs.iter().map(of).fold(0.0, f64::max);
        let shares = records.iter().map(|runs| worst(runs, &|d| share(d, 0).max(share(d, 1))));
        let largest =
            |side: usize| records.iter().map(|runs| worst(runs, &|d| share(d, side))).fold(0.0, f64::max);
        let count = |such: &dyn Fn(Maxima) -> bool| records.iter().flatten().filter(|d| such(**d)).count();
        let ratio = 1.0 / combined(shares.collect());
        let beyond_d0 = count(&|d| self.is_beyond(d));
        let at_strength = count(&|d| self.is_at_strength(d));
        let failed = beyond_d0 + if self.tie_is_end { at_strength } else { 0 };
        Judged {
            d: combined(records.iter().map(|runs| worst(runs, &|d| d[0].max(d[1]))).collect()),
            ratio,
            beyond_d0,
            at_strength,
            side: if largest(1) > largest(0) { Side::Negative } else { Side::Positive },
            passed: failed == 0 && ratio >= 1.0,
        }
    }
}

/// The judgement of the maxima of some records, each with its signs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Whether no run exceeds `d_0` or fails by its tie, and the mean of the shares of the threshold is at
    /// most 1.
    pub passed: bool,
    /// Mean of the maxima of |d|, or of fewer than 7 records the largest; of both signs the worse \[m\].
    pub d: f64,
    /// Threshold over it, each side by its own \[-\].
    pub ratio: f64,
    /// How many runs exceed `d_0`.
    pub beyond_d0: usize,
    /// How many runs reach the strength of the tie.
    pub at_strength: usize,
    /// The side of the largest |d| over its threshold.
    pub side: Side,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DynamicRun {
    /// Name of the record.
    pub record: String,
    /// Factor on the record \[-\].
    pub factor: f64,
    /// Sign with which it acts, 1 or −1.
    pub sign: f64,
    /// Largest d on the sides u > 0 and u < 0 \[m\].
    pub d: [f64; 2],
    /// Whether one of them exceeds `d_0`, or `u_ins` where the model ends before.
    pub beyond_d0: bool,
    /// Whether the tie reaches its strength.
    pub at_strength: bool,
}

/// Whether a run that reaches the strength of the tie fails: it does not break, and has no other end.
pub(super) fn is_end(wall: &Wall) -> bool {
    wall.ties().iter().any(ends)
}

/// Whether a tie has a strength and does not break.
fn ends(tie: &Tie) -> bool {
    tie.strength.is_some() && tie.fracture_displacement().is_none()
}

/// The dynamic check of a limit state.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicState {
    /// The judgement of its runs.
    #[serde(flatten)]
    pub judged: Judged,
    /// The lowest factor on all records that fails \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
    /// The records beside the spectrum of the ground, where the site has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compatibility: Option<Compatibility>,
    /// Thresholds of d on the sides u > 0 and u < 0; `None` on one to which the wall of the runs does not
    /// rock \[m\].
    #[serde(skip)]
    pub thresholds: [Option<f64>; 2],
    /// The runs: of each record, with each sign.
    pub runs: Vec<DynamicRun>,
}

/// Runs of one wall under what it feels of each record.
pub(super) struct Runs<'a> {
    pub(super) records: Vec<Shaking<'a>>,
    pub(super) stretch: f64,
    /// Signs with which each record acts.
    pub(super) signs: &'a [f64],
}

impl Runs<'_> {
    pub(super) fn check(
        &self,
        thresholds: &Thresholds,
        factors: &[f64],
        records: &Records,
    ) -> Result<DynamicState, CheckError> {
        let maxima = self.maxima(factors, &[1.0])?.remove(0);
        let of_record = |((record, factor), runs): ((&NamedRecord, &f64), &Vec<Maxima>)| {
            let run = |(sign, d): (&f64, &Maxima)| DynamicRun {
                record: record.name.clone(),
                factor: *factor,
                sign: *sign,
                d: *d,
                beyond_d0: thresholds.is_beyond(*d),
                at_strength: thresholds.is_at_strength(*d),
            };
            self.signs.iter().zip(runs).map(run).collect::<Vec<_>>()
        };
        let runs = records.named.iter().zip(factors).zip(&maxima).flat_map(of_record);
        Ok(DynamicState {
            judged: thresholds.judge(&maxima),
            zeta: self.lowest_failure(thresholds, factors)?,
            compatibility: None,
            thresholds: [None; 2],
            runs: runs.collect(),
        })
    }

    /// Returns the lowest factor on all records that fails, searched upwards, for the response is neither
    /// linear nor monotonic.
    fn lowest_failure(&self, thresholds: &Thresholds, factors: &[f64]) -> Result<f64, CheckError> {
        let fails = |factor: f64| {
            let maxima = self.maxima(factors, &[factor])?.remove(0);
            Ok(!thresholds.judge(&maxima).passed)
        };
        let powers: Vec<i32> = POWERS.collect();
        let mut below = RATIO.powi(powers[0]);
        for powers in powers.chunks(AT_ONCE) {
            let levels: Vec<f64> = powers.iter().map(|power| RATIO.powi(*power)).collect();
            for (level, maxima) in levels.iter().zip(self.maxima(factors, &levels)?) {
                if !thresholds.judge(&maxima).passed {
                    return first_true([below, *level], HALVINGS, fails);
                }
                below = *level;
            }
        }
        Ok(below)
    }

    /// Returns the maxima of |d| on both sides: for each level, of each record, with each sign.
    fn maxima(&self, factors: &[f64], levels: &[f64]) -> Result<Vec<Vec<Vec<Maxima>>>, CheckError> {
        let mut maxima = vec![Vec::with_capacity(self.records.len()); levels.len()];
        for (record, factor) in self.records.iter().zip(factors) {
            let signed = levels.iter().flat_map(|level| self.signs.iter().map(move |sign| sign * level));
            let scaled: Vec<f64> = signed.map(|signed| signed * factor).collect();
            let outcomes = record.runs([0.0, 0.0], &scaled, RunEnd::AtOverturning);
            let outcomes = outcomes.map_err(|error| CheckError::wall(error.to_string()))?;
            for (at_level, outcomes) in maxima.iter_mut().zip(outcomes.chunks(self.signs.len())) {
                let peaks = |outcome: &record::Outcome| {
                    let peaks = outcome.state.peaks;
                    [self.stretch * peaks.positive, self.stretch * peaks.negative]
                };
                at_level.push(outcomes.iter().map(peaks).collect());
            }
        }
        Ok(maxima)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Example (e) of the worked examples: eight maxima of a parapet with `d_SLV` = 0.08 m and `d_0` = 0.2 m.
    #[test]
    fn maxima_of_eight_records() {
        let none = [f64::INFINITY; 2];
        let thresholds = Thresholds { limit: [0.08; 2], end: [0.2; 2], strength: none, tie_is_end: true };
        let maxima = [0.031, 0.052, 0.066, 0.048, 0.090, 0.075, 0.058, 0.101];
        let runs = maxima.map(|d| vec![[0.5 * d, d]]);
        let judged = thresholds.judge(&runs);
        assert!((judged.d - 0.065_125).abs() < 1e-15 && (judged.ratio - 1.228_41).abs() < 5e-6);
        assert!(judged.passed && judged.side == Side::Negative);
        // one run beyond d_0 fails, whatever the mean
        let beyond = Thresholds { end: [0.2, 0.1], ..thresholds }.judge(&runs);
        assert!(!beyond.passed && beyond.beyond_d0 == 1);
        // so does one at the strength of a tie, unless the tie yields
        let strong = Thresholds { strength: [1.0, 0.09], ..thresholds };
        assert!(!strong.judge(&runs).passed && strong.judge(&runs).at_strength == 2);
        assert!(Thresholds { tie_is_end: false, ..strong }.judge(&runs).passed);
        // each side by its own threshold
        let sides = Thresholds { limit: [0.04, 0.12], ..thresholds }.judge(&vec![vec![[0.06, 0.06]]; 7]);
        assert!((sides.ratio - 0.04 / 0.06).abs() < 1e-15 && sides.side == Side::Positive);
        // of both signs of a record the worse counts
        let signs = thresholds.judge(&vec![vec![[0.01, 0.02], [0.04, 0.03]]; 7]);
        assert!((signs.ratio - 2.0).abs() < 1e-15 && (signs.d - 0.04).abs() < 1e-15);
    }
}
