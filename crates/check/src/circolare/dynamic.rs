//! The dynamic check, C8.7.1.2.1.9: runs of the wall under records, with both signs.
//!
//! The skeleton of the model is the capacity curve, which FC divides: gravity, the overburden, the stiffness
//! and the strength of a tie are divided by FC, masses stay. The result of a record is the largest of
//! |d|/threshold on the two sides under its two signs. A tie without `tie_ultimate` does not break: a run
//! that reaches its strength fails. One that has it yields and breaks as in every run.

use record::{RecordSolver, RunEnd};
use rocking_wall::scene::{DEFAULT_TAIL, Floors};
use rocking_wall::solver::Motion;
use rocking_wall::wall::{Parameters, Sides, Tie, Wall};

use super::LimitState;
use super::case::Case;
use super::curve::Curve;
use super::demand::{MEAN_COUNTS_FROM, combined};
use super::level::{has_storeys, scaled};
use super::side_verdict::SideVerdict;
use super::table::{Method, Polarities};
use super::verdict::{DynamicCheck, DynamicRun, DynamicState, Judged, Side, SideVerdicts};
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

/// Thresholds of both sides; those of limit states are overturning on a side that is not checked \[m\].
#[derive(Clone, Copy, Debug)]
struct Thresholds {
    limit: [f64; 2],
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
    fn of(wall: &Wall, sides: &SideVerdicts, state: LimitState, stretch: f64) -> Self {
        let of_side = |(sign, side): (f64, Option<&SideVerdict>)| {
            // runs rock as the scene does: where the static checks leave a side out, they may go up to
            // overturning
            let falls = stretch * wall.body().instability.of(sign);
            let end = side.map_or(falls, |side| side.curve.d0.min(falls));
            let limit = side.and_then(|side| side.displacement(state)).map_or(end, |check| check.d);
            let tie = wall.tie().filter(|tie| side.is_some() && tie.holds(sign));
            let strength = tie.and_then(Tie::strength_displacement).map_or(f64::INFINITY, |u| stretch * u);
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

impl DynamicCheck {
    pub(super) fn warnings(&self, case: &Case<'_>) -> Vec<String> {
        let (statement, parameters) = (case.statement, &case.parameters);
        let mut warnings = Vec::new();
        let count = statement.records.named.len();
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
        if self.tie_is_end {
            warnings.push(
                "the tie of the dynamic model does not break: a run that reaches its strength fails".into(),
            );
        }
        for (name, state) in self.states() {
            if state.judged.passed && state.zeta < 1.0 {
                warnings.push(format!(
                    "{name}: the wall passes under the records, and fails when they are scaled by {:.3}: the \
                     response is not monotonic",
                    state.zeta
                ));
            }
            let factors = state.runs.iter().map(|run| run.factor);
            let compatibility = state.compatibility.iter();
            warnings.extend(compatibility.flat_map(|own| own.warnings(name.key(), factors.clone())));
            let stated = case.floors.into_iter().flat_map(Floors::stated_damping);
            let xi = statement.state(name).and_then(|given| given.building_damping);
            if let Some((xi, stated)) = xi.zip(stated.into_iter().find(|stated| Some(*stated) != xi)) {
                warnings.push(format!(
                    "{name}: the runs have building_damping = {xi} for every mode, not damping_ratio = \
                     {stated} of [[storeys]]"
                ));
            }
        }
        warnings
    }
}

/// The wall of the runs: that of the scene with the tie of the check, its hinge where SLV (or SLC) by
/// displacement has the smallest `ζ_E`, set back, and its forces over FC. Returns that hinge, too.
fn divided(
    parameters: &Parameters,
    case: &Case<'_>,
    sides: &SideVerdicts,
) -> Result<(Parameters, Option<f64>), CheckError> {
    let mut parameters = case.statement.with_bar(parameters)?;
    let least = |state: LimitState| {
        let found = sides.iter().filter_map(|(_, side)| side.displacement(state));
        found.min_by(|a, b| a.zeta.total_cmp(&b.zeta)).map(|check| check.hinge)
    };
    let hinge = least(LimitState::Slv).or_else(|| least(LimitState::Slc)).flatten();
    parameters.hinge_ratio = hinge.unwrap_or(parameters.hinge_ratio);
    if case.statement.masonry.is_some() {
        let a3 = |sign: f64| {
            let rocks = case.sides().any(|own| own == sign);
            if rocks { Curve::new(case, sign, hinge, true).map(|curve| curve.a3) } else { Ok(1.0) }
        };
        parameters.a3_of_sides = Some(Sides { positive: a3(1.0)?, negative: a3(-1.0)? });
    }
    let factor = case.statement.confidence_factor;
    parameters.gravity /= factor;
    parameters.overburden /= factor;
    parameters.tie_stiffness /= factor;
    parameters.tie_strength /= factor;
    // these are the tie's own numbers, no longer those of its bar
    parameters.bar = None;
    (parameters.u_start, parameters.u_dot_start) = (0.0, 0.0);
    Ok((parameters, hinge))
}

/// Runs the dynamic check; `None` without records. Where this check does not decide, a limit state whose site
/// gives no S is left out.
pub(super) fn check(
    parameters: &Parameters,
    case: &Case<'_>,
    sides: &SideVerdicts,
) -> Result<Option<DynamicCheck>, CheckError> {
    let (statement, floors) = (case.statement, case.floors);
    let records = &statement.records;
    if records.named.is_empty() {
        return Ok(None);
    }
    has_storeys(statement, floors)?;
    let (divided, hinge) = divided(parameters, case, sides)?;
    let motion = Motion::of(&divided, divided.tolerance)?;
    let stretch = sides.iter().next().map_or(1.0, |(_, side)| side.curve.d_per_u);
    let decides = statement.table.method == Method::Dynamic;
    // a wall that rocks, and is checked, alike on both sides has mirrored runs
    let is_alike = case.alike && motion.wall().has_equal_sides();
    let both = statement.table.polarities == Polarities::Both && !is_alike;
    let signs: &[f64] = if both { &[1.0, -1.0] } else { &[1.0] };
    let state = |state: LimitState| {
        let Some(given) = statement.state(state) else { return Ok::<_, CheckError>(None) };
        let longest =
            sides.iter().filter_map(|(_, side)| Some(side.displacement(state)?.period)).fold(0.0, f64::max);
        let (factors, compatibility) = match scaled(case, given, longest) {
            Err(_) if !decides => return Ok(None),
            found => found?,
        };
        // the building of this limit state, as its spectra have it
        let floors = floors.map(|floors| floors.in_state(given.building_damping, given.building_period));
        let felt = records.felt(floors.transpose()?.as_ref(), motion.wall().body())?;
        let solvers: Vec<_> = felt.iter().map(|record| RecordSolver::new(&motion, record.step())).collect();
        let shake = |(record, solver)| Shaking::new(solver, record, DEFAULT_TAIL);
        let runs = Runs { records: felt.iter().zip(&solvers).map(shake).collect(), stretch, signs };
        let thresholds = Thresholds::of(motion.wall(), sides, state, stretch);
        let rocks = |sign: f64| motion.wall().sides().any(|own| own == sign);
        let [positive, negative] = thresholds.limit;
        let limit = [rocks(1.0).then_some(positive), rocks(-1.0).then_some(negative)];
        let found = runs.check(&thresholds, &factors, records)?;
        Ok(Some(DynamicState { compatibility, thresholds: limit, ..found }))
    };
    let (slv, slc) = (state(LimitState::Slv)?, state(LimitState::Slc)?);
    let tie_is_end = is_end(motion.wall());
    Ok((slv.is_some() || slc.is_some()).then_some(DynamicCheck { hinge, tie_is_end, slv, slc }))
}

/// Whether a run that reaches the strength of the tie fails: it does not break, and has no other end.
fn is_end(wall: &Wall) -> bool {
    wall.tie().is_some_and(|tie| tie.strength.is_some() && tie.fracture_displacement().is_none())
}

/// Runs of one wall under what it feels of each record.
struct Runs<'a> {
    records: Vec<Shaking<'a>>,
    stretch: f64,
    /// Signs with which each record acts.
    signs: &'a [f64],
}

impl Runs<'_> {
    fn check(
        &self,
        thresholds: &Thresholds,
        factors: &[f64],
        records: &Records,
    ) -> Result<DynamicState, CheckError> {
        let maxima = self.maxima(factors, &[1.0])?.remove(0);
        let of_record = |((record, factor), runs): ((&run::records::NamedRecord, &f64), &Vec<Maxima>)| {
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
