//! The dynamic check, C8.7.1.2.1.9: runs of the wall under records.
//!
//! The skeleton of the model is the capacity curve, which FC divides: gravity, the overburden, the stiffness
//! and the strength of a tie are divided by FC, masses stay. The result of a record is the larger of
//! |d|/threshold on the two sides. The tie of the model does not break: a run that reaches its strength
//! fails, and so does one that reaches `u_ins`.

use record::RecordSolver;
use rocking_wall::scene::{DEFAULT_TAIL, Floors};
use rocking_wall::solver::Motion;
use rocking_wall::wall::{Parameters, Tie, Wall};

use super::demand::{MEAN_COUNTS_FROM, combined};
use super::statement::{Source, StateStatement, Statement};
use super::table::{Method, RecordScale};
use super::verdict::{DynamicCheck, DynamicRun, DynamicState, Side, SideVerdict, SideVerdicts};
use super::{G, LimitState};
use crate::error::CheckError;
use crate::site::Records;
use run::bisection::first_true;
use run::shaking::Shaking;

/// Ratio of factors that follow each other. A failure between two factors at which the wall passes is not
/// found.
const RATIO: f64 = 1.01;
/// Powers of the ratio among which the lowest factor that fails is searched: 0.01 to 100, and 1.
const POWERS: std::ops::RangeInclusive<i32> = -463..=463;
/// Factors that are run at once.
const AT_ONCE: usize = 64;
/// Halvings of the step in which the first failure lies: to 1e-5 of the factor.
const HALVINGS: u32 = 10;

/// Thresholds of both sides; infinite on one to which the wall cannot rock \[m\].
#[derive(Clone, Copy, Debug)]
struct Thresholds {
    limit: [f64; 2],
    /// Overturning: `d_0`, or `u_ins` if the model ends earlier.
    end: [f64; 2],
}

/// The judgement of the maxima of some runs.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Judged {
    d: f64,
    ratio: f64,
    beyond_d0: usize,
    side: Side,
}

impl Judged {
    fn passed(self) -> bool {
        self.beyond_d0 == 0 && self.ratio >= 1.0
    }
}

impl Thresholds {
    fn of(wall: &Wall, sides: &SideVerdicts, limit: impl Fn(&SideVerdict) -> Option<f64>) -> Self {
        let each = |value: &dyn Fn(f64, &SideVerdict) -> Option<f64>| {
            [(1.0, &sides.positive), (-1.0, &sides.negative)]
                .map(|(sign, side)| side.as_ref().and_then(|side| value(sign, side)).unwrap_or(f64::INFINITY))
        };
        let end = |sign: f64, side: &SideVerdict| {
            let tie = wall.tie().filter(|tie| tie.holds(sign)).and_then(Tie::strength_displacement);
            let u = tie.unwrap_or(f64::INFINITY).min(wall.body().instability.of(sign));
            Some(side.d0.min(side.d_per_u * u))
        };
        Self { limit: each(&|_, side| limit(side)), end: each(&end) }
    }

    /// Judges the maxima of |d| of some runs, both sides of each.
    fn judge(&self, maxima: &[[f64; 2]]) -> Judged {
        let share = |d: &[f64; 2], side: usize| d[side] / self.limit[side];
        let used = maxima.iter().map(|d| share(d, 0).max(share(d, 1))).collect();
        let largest = |side: usize| maxima.iter().map(|d| share(d, side)).fold(0.0, f64::max);
        let beyond = |d: &&[f64; 2]| d[0] > self.end[0] || d[1] > self.end[1];
        Judged {
            d: combined(maxima.iter().map(|d| d[0].max(d[1])).collect()),
            ratio: 1.0 / combined(used),
            beyond_d0: maxima.iter().filter(beyond).count(),
            side: if largest(1) > largest(0) { Side::Negative } else { Side::Positive },
        }
    }
}

impl DynamicCheck {
    pub(super) fn warnings(&self, parameters: &Parameters, statement: &Statement) -> Vec<String> {
        let mut warnings = Vec::new();
        let count = self.states().next().map_or(0, |(_, state)| state.runs.len());
        if count <= MEAN_COUNTS_FROM {
            let what =
                if count < MEAN_COUNTS_FROM { "the least favourable one counts" } else { "the mean counts" };
            warnings.push(format!(
                "{count} records: {what} (NTC 7.3.5); the dynamic check asks for more records than a global \
                 analysis (C8.7.1.2.1.9)"
            ));
        }
        if parameters.overburden > 0.0 && statement.table.overburden_mass.is_some_and(|r| r > 0.0) {
            warnings.push(
                "the dynamic model has no mass on top: the overburden loads the wall without inertia".into(),
            );
        }
        if parameters.tie_stiffness > 0.0 && parameters.tie_strength > 0.0 {
            warnings.push(
                "the tie of the dynamic model does not break: a run that reaches its strength fails".into(),
            );
        }
        for (name, state) in self.states().filter(|(_, state)| state.passed && state.zeta < 1.0) {
            warnings.push(format!(
                "{}: the wall passes under the records, and fails under {:.3} of them: the response is not \
                 monotonic",
                name.name(),
                state.zeta
            ));
        }
        warnings
    }
}

/// Runs the dynamic check; `None` without records. Where this check does not decide, a limit state whose site
/// gives no S is left out.
pub(super) fn check(
    parameters: &Parameters,
    floors: Option<&Floors>,
    statement: &Statement,
    sides: &SideVerdicts,
) -> Result<Option<DynamicCheck>, CheckError> {
    let records = &statement.records;
    if records.named.is_empty() {
        return Ok(None);
    }
    if statement.table.building.is_some() && floors.is_none() {
        let message = "the records move the ground: give [[storeys]] in place of [check.building]";
        return Err(CheckError::value(&["building"], message));
    }
    let factor = statement.confidence_factor;
    let divided = Parameters {
        gravity: parameters.gravity / factor,
        overburden: parameters.overburden / factor,
        tie_stiffness: parameters.tie_stiffness / factor,
        tie_strength: parameters.tie_strength / factor,
        u_start: 0.0,
        u_dot_start: 0.0,
        ..parameters.clone()
    };
    let motion = Motion::of(&divided, divided.tolerance)?;
    let felt = records.felt(floors, motion.wall())?;
    let stretch = sides.iter().next().map_or(1.0, |(_, side)| side.d_per_u);
    let solvers: Vec<_> = felt.iter().map(|record| RecordSolver::new(&motion, record.step())).collect();
    let shake = |(record, solver)| Shaking::new(&motion, solver, record, DEFAULT_TAIL);
    let runs = Runs { records: felt.iter().zip(&solvers).map(shake).collect(), stretch };
    let state = |state: LimitState, limit: fn(&SideVerdict) -> Option<f64>| {
        let Some(given) = statement.state(state) else { return Ok(None) };
        let factors = match factors(statement, given, records) {
            Err(_) if statement.table.method != Method::Dynamic => return Ok(None),
            factors => factors?,
        };
        runs.check(&Thresholds::of(motion.wall(), sides, limit), &factors, records).map(Some)
    };
    let slv = state(LimitState::Slv, |side| side.slv.map(|check| check.d))?;
    let slc = state(LimitState::Slc, |side| side.slc.map(|check| check.d))?;
    Ok((slv.is_some() || slc.is_some()).then_some(DynamicCheck { slv, slc }))
}

/// The factors that bring the peaks of the records to `a_g` S, or 1.
fn factors(statement: &Statement, given: &StateStatement, records: &Records) -> Result<Vec<f64>, CheckError> {
    let records = records.named.iter();
    match (statement.table.record_scale, &given.source) {
        (RecordScale::None, _) => Ok(records.map(|_| 1.0).collect()),
        (RecordScale::Ag, Source::Code(ground)) => {
            let peak = given.ag * G * ground.s;
            Ok(records.map(|record| peak / record.motion.peak()).collect())
        }
        (RecordScale::Ag, _) => {
            let message = "record_scale = \"ag\" needs S of F0 and TC; give them, or record_scale = \"none\"";
            Err(CheckError::value(&["record_scale"], message))
        }
    }
}

/// Runs of one wall under what it feels of each record.
struct Runs<'a> {
    records: Vec<Shaking<'a>>,
    stretch: f64,
}

impl Runs<'_> {
    fn check(
        &self,
        thresholds: &Thresholds,
        factors: &[f64],
        records: &Records,
    ) -> Result<DynamicState, CheckError> {
        let maxima = self.maxima(factors, &[1.0])?.remove(0);
        let judged = thresholds.judge(&maxima);
        let runs = records.named.iter().zip(factors).zip(&maxima).map(|((record, factor), d)| DynamicRun {
            record: record.name.clone(),
            factor: *factor,
            d: *d,
            beyond_d0: thresholds.judge(&[*d]).beyond_d0 > 0,
        });
        Ok(DynamicState {
            passed: judged.passed(),
            d: judged.d,
            ratio: judged.ratio,
            beyond_d0: judged.beyond_d0,
            zeta: self.lowest_failure(thresholds, factors)?,
            side: judged.side,
            runs: runs.collect(),
        })
    }

    /// Returns the lowest factor on all records that fails, searched upwards, for the response is neither
    /// linear nor monotonic.
    fn lowest_failure(&self, thresholds: &Thresholds, factors: &[f64]) -> Result<f64, CheckError> {
        let fails = |factor: f64| {
            let maxima = self.maxima(factors, &[factor])?.remove(0);
            Ok(!thresholds.judge(&maxima).passed())
        };
        let powers: Vec<i32> = POWERS.collect();
        let mut below = RATIO.powi(powers[0]);
        for powers in powers.chunks(AT_ONCE) {
            let levels: Vec<f64> = powers.iter().map(|power| RATIO.powi(*power)).collect();
            for (level, maxima) in levels.iter().zip(self.maxima(factors, &levels)?) {
                if !thresholds.judge(&maxima).passed() {
                    return first_true([below, *level], HALVINGS, fails);
                }
                below = *level;
            }
        }
        Ok(below)
    }

    /// Returns the maxima of |d| on both sides: for each level, of each record.
    fn maxima(&self, factors: &[f64], levels: &[f64]) -> Result<Vec<Vec<[f64; 2]>>, CheckError> {
        let mut maxima = vec![Vec::with_capacity(self.records.len()); levels.len()];
        for (record, factor) in self.records.iter().zip(factors) {
            let scaled: Vec<f64> = levels.iter().map(|level| level * factor).collect();
            let outcomes =
                record.runs([0.0, 0.0], &scaled).map_err(|error| CheckError::wall(error.to_string()))?;
            for (at_level, outcome) in maxima.iter_mut().zip(outcomes) {
                let peaks = outcome.state.peaks;
                at_level.push([self.stretch * peaks.positive, self.stretch * peaks.negative]);
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
        let thresholds = Thresholds { limit: [0.08; 2], end: [0.2; 2] };
        let maxima = [0.031, 0.052, 0.066, 0.048, 0.090, 0.075, 0.058, 0.101];
        let judged = thresholds.judge(&maxima.map(|d| [0.5 * d, d]));
        assert!((judged.d - 0.065_125).abs() < 1e-15 && (judged.ratio - 1.228_41).abs() < 5e-6);
        assert!(judged.passed() && judged.side == Side::Negative);
        // one run beyond d_0 fails, whatever the mean
        let beyond = Thresholds { end: [0.2, 0.1], ..thresholds }.judge(&maxima.map(|d| [0.5 * d, d]));
        assert!(!beyond.passed() && beyond.beyond_d0 == 1);
        // each side by its own threshold
        let sides = Thresholds { limit: [0.04, 0.12], end: [0.2; 2] }.judge(&[[0.06, 0.06]; 7]);
        assert!((sides.ratio - 0.04 / 0.06).abs() < 1e-15 && sides.side == Side::Positive);
    }
}
