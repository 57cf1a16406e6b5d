//! The dynamic check, C8.7.1.2.1.9: runs of the wall under records, with both signs.
//!
//! The skeleton of the model is the capacity curve, which FC divides: gravity, the overburden, the stiffness
//! and the strength of a tie are divided by FC, masses stay. The result of a record is the largest of
//! |d|/threshold on the two sides under its two signs. A tie without `tie_ultimate` does not break: a run
//! that reaches its strength fails. One that has it yields and breaks as in every run.

use record::RecordSolver;
use rocking_wall::solver::Motion;
use rocking_wall::wall::{ParameterError, Parameters, Sides};
use run::shaking::Shaking;
use scene::{DEFAULT_TAIL, Floors};
use serde::Serialize;

use super::level::{has_storeys, scaled};
use super::{DynamicState, Runs, Thresholds, is_end};
use crate::circolare::checks::sides::SideVerdicts;
use crate::circolare::curve::Curve;
use crate::circolare::curve::case::Case;
use crate::circolare::curve::level;
use crate::circolare::statement::table::{Method, Polarities};
use crate::error::CheckError;
use crate::ntc::demand::MEAN_COUNTS_FROM;
use crate::words::names::LimitState;
use crate::words::{Sentence, fixed, say};

/// The dynamic check of a wall.
#[derive(Clone, Debug, Serialize)]
pub struct DynamicCheck {
    /// Where the hinge of a strip is in the runs, of h \[-\].
    #[serde(rename = "hinge_ratio", skip_serializing_if = "Option::is_none")]
    pub hinge: Option<f64>,
    /// Whether a run that reaches the strength of the tie fails.
    #[serde(skip)]
    pub tie_is_end: bool,
    /// SLV.
    #[serde(rename = "SLV", skip_serializing_if = "Option::is_none")]
    pub slv: Option<DynamicState>,
    /// SLC.
    #[serde(rename = "SLC", skip_serializing_if = "Option::is_none")]
    pub slc: Option<DynamicState>,
}

impl DynamicCheck {
    pub(crate) fn states(&self) -> impl Iterator<Item = (LimitState, &DynamicState)> {
        let states = [(LimitState::Slv, &self.slv), (LimitState::Slc, &self.slc)];
        states.into_iter().filter_map(|(state, found)| Some((state, found.as_ref()?)))
    }

    /// Returns whether every limit state holds.
    pub fn passed(&self) -> bool {
        self.states().all(|(_, state)| state.judged.passed)
    }
}

impl DynamicCheck {
    pub(crate) fn warnings(&self, case: &Case<'_>) -> Vec<Sentence> {
        let (statement, parameters) = (case.statement, &case.parameters);
        let mut warnings = Vec::new();
        let count = statement.records.named.len();
        if count <= MEAN_COUNTS_FROM {
            let what = if count < MEAN_COUNTS_FROM {
                say!("the least favourable one counts", "vale il più sfavorevole")
            } else {
                say!("the mean counts", "vale la media")
            };
            warnings.push(say! {
                "{count} records: {what} (NTC 7.3.5); the dynamic check asks for more records than a global \
                 analysis (C8.7.1.2.1.9)",
                "{count} accelerogrammi: {what} (NTC 7.3.5); la verifica dinamica ne richiede più di \
                 un'analisi globale (C8.7.1.2.1.9)", count, what
            });
        }
        if parameters.overburden > 0.0 && statement.table.overburden_mass.is_some_and(|r| r > 0.0) {
            warnings.push(say! {
                "the dynamic model has no mass on top: the overburden loads the wall without inertia",
                "il modello dinamico non ha massa in sommità: il carico agisce sulla parete senza inerzia"
            });
        }
        if self.tie_is_end {
            warnings.push(say! {
                "the tie of the dynamic model does not break: a run that reaches its strength fails",
                "la catena del modello dinamico non si rompe: un'analisi che ne raggiunge la resistenza non \
                 è soddisfatta"
            });
        }
        for (state, found) in self.states() {
            if found.judged.passed && found.zeta < statement.target {
                warnings.push(say! {
                    "{state}: the wall passes under the records, and fails when they are scaled by {zeta}: \
                     the response is not monotonic",
                    "{state}: la parete supera gli accelerogrammi, ma non se scalati per {zeta}: la risposta \
                     non è monotona", state, zeta = fixed(found.zeta, 3)
                });
            }
            let factors = found.runs.iter().map(|run| run.factor);
            let compatibility = found.compatibility.iter();
            warnings.extend(compatibility.flat_map(|own| own.warnings(state.key(), factors.clone())));
            let stated = case.floors.as_deref().into_iter().flat_map(Floors::stated_damping);
            let xi = statement.state(state).and_then(|given| given.building_damping);
            if let Some((xi, stated)) = xi.zip(stated.into_iter().find(|stated| Some(*stated) != xi)) {
                warnings.push(say! {
                    "{state}: the runs have building_damping = {xi} for every mode, not damping_ratio = \
                     {stated} of [[storeys]]",
                    "{state}: le analisi hanno building_damping = {xi} per ogni modo, non damping_ratio = \
                     {stated} di [[storeys]]", state, xi, stated
                }.on_page(say! {
                    "{state}: the runs have ξ_k = {xi} for every mode, not {stated} of the storeys",
                    "{state}: le analisi hanno ξ_k = {xi} per ogni modo, non {stated} dei piani",
                    state, xi, stated
                }));
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
    let whole = case.statement.with_bar(parameters)?;
    let mut parameters = level::above(&whole, case.statement.hinge_levels[case.level])?;
    if let (Some(_), Some(profile)) = (case.crack, &case.parameters.profile) {
        parameters.set_profile(profile.as_ref().clone());
    }
    let least = |state: LimitState| {
        let found = sides.iter().filter_map(|(_, side)| side.displacement(state));
        found.min_by(|a, b| a.zeta.total_cmp(&b.zeta)).map(|check| check.hinge)
    };
    let hinge = least(LimitState::Slv).or_else(|| least(LimitState::Slc)).flatten();
    parameters.hinge_ratio = hinge.unwrap_or(parameters.hinge_ratio);
    if case.statement.masonry.is_some() {
        let a3 = |sign: f64| {
            let rocks = case.sides().any(|own| own == sign);
            if rocks { Curve::new(case, sign, hinge).map(|curve| curve.a3) } else { Ok(1.0) }
        };
        parameters.a3_of_sides = Some(Sides { positive: a3(1.0)?, negative: a3(-1.0)? });
    }
    let factor = case.statement.confidence_factor;
    level::divide_loads(&mut parameters, factor);
    parameters.gravity /= factor;
    parameters.overburden /= factor;
    parameters.tie_stiffness /= factor;
    parameters.tie_strength /= factor;
    // these are the tie's own numbers, no longer those of its bar
    parameters.bar = None;
    (parameters.u_start, parameters.u_dot_start) = (0.0, 0.0);
    Ok((parameters, hinge))
}

/// The error of a wall whose forces FC divides: its numbers are not those that somebody stated.
fn without_doubts(error: ParameterError) -> ParameterError {
    match error {
        ParameterError::Improbable { error, .. } => *error,
        error => error,
    }
}

/// Runs the dynamic check; `None` without records. Where this check does not decide, a limit state whose site
/// gives no S is left out.
pub(crate) fn check(
    parameters: &Parameters,
    case: &Case<'_>,
    sides: &SideVerdicts,
) -> Result<Option<DynamicCheck>, CheckError> {
    let (statement, floors) = (case.statement, case.floors.as_deref());
    let records = &statement.records;
    if records.named.is_empty() {
        return Ok(None);
    }
    has_storeys(statement, floors)?;
    let (divided, hinge) = divided(parameters, case, sides)?;
    let motion = Motion::of(&divided, divided.tolerance).map_err(without_doubts)?;
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
        let mut found = runs.check(&thresholds, &factors, records)?;
        if statement.target < 1.0 {
            // the records as they are scaled ask for more than the target
            found.judged.passed = found.zeta >= statement.target;
        }
        Ok(Some(DynamicState { compatibility, thresholds: limit, ..found }))
    };
    let (slv, slc) = (state(LimitState::Slv)?, state(LimitState::Slc)?);
    let tie_is_end = is_end(motion.wall());
    Ok((slv.is_some() || slc.is_some()).then_some(DynamicCheck { hinge, tie_is_end, slv, slc }))
}
