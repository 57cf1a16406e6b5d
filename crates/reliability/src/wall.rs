//! One wall: its checks, its events, and the probabilities of the ones where the others have ζ = 1.

use check::circolare::MEAN_COUNTS_FROM;
use check::{Code, Subject, Verdict};
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Wall;
use run::sample::sorted;
use run::walls::NamedWall;

use fragility::{CONFIDENCE, Interval, Lognormal, Summary, cumulative};
use study::ida::{Crossing, Curve, Exceedance};
use study::results::Fitting;

use crate::rules::{self, Turned};

/// Name of the event that the wall falls.
pub(crate) const FALL: &str = "fall";

/// Hinges that differ by less are the same, of h \[-\].
const SAME_HINGE: f64 = 1e-6;

/// A check of a wall, of its sides the less favourable one.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Name of the check, such as `SLV`.
    pub check: &'static str,
    /// Whether it decides.
    pub decides: bool,
    /// Capacity over demand \[-\].
    pub zeta: f64,
    /// Ground acceleration with which the wall just passes \[m/s²\].
    pub code: f64,
    /// That of the site \[m/s²\].
    pub site: f64,
}

/// An event, with a fragility of each damping model.
#[derive(Clone, Debug)]
pub struct Event {
    /// Its name: `beyond d_SLV`, `fall`.
    pub name: String,
    /// The check whose capacity is exceeded; `None` of a fall.
    pub check: Option<&'static str>,
    /// |u|/`u_ins` that is exceeded \[-\].
    pub fraction: f64,
    /// The fragilities, model by model, over `a_g` \[m/s²\], with the β of modelling.
    pub fragilities: Vec<Summary>,
    /// `a_g` at which the mean demand of 7 records and more, or the largest of fewer, reaches the fraction,
    /// model by model; infinite above the levels \[m/s²\].
    pub dynamic: Vec<f64>,
    /// Where each record exceeds the fraction, model by model.
    exceedances: Vec<Vec<Exceedance>>,
}

/// Margin and probability of an event with a model, where a check has ζ = 1; `None` without a curve.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Place of the model.
    pub model: usize,
    /// Place of the check.
    pub check: usize,
    /// Place of the event.
    pub event: usize,
    /// θ over `a_g`.
    pub margin: Option<Interval>,
    /// P of the event at `a_g`.
    pub probability: Option<Interval>,
}

/// The reliability of one wall.
#[derive(Clone, Debug)]
pub struct WallReliability {
    /// What is checked, as the code has it.
    pub checks: Vec<Checkpoint>,
    /// Place of the check that governs.
    pub governs: usize,
    /// Events, the fall last.
    pub events: Vec<Event>,
    /// Margins and probabilities: model by model, check by check, event by event.
    pub answers: Vec<Answer>,
    /// The numbers of the code that would give the target, model by model.
    pub turned: Vec<Vec<Turned>>,
    /// The probability below which a number says nothing \[-\].
    pub least: f64,
    /// Where the hinge of a strip is in the runs and in the check, where it differs \[-\].
    pub hinges: Option<[f64; 2]>,
    /// Whether the check has another body than the runs: with a crack that it searched, or above a level.
    pub is_other_body: bool,
}

/// Returns a wall as a check sees it.
pub(crate) fn subject(NamedWall { parameters, floors, assumed, .. }: &NamedWall) -> Subject<'_> {
    Subject { parameters, floors: floors.as_ref(), assumed }
}

impl WallReliability {
    /// Asks how safe a wall is with which a code is content. `curves` has models outermost.
    ///
    /// # Errors
    /// The reason why there is no check.
    pub(crate) fn of(
        wall: &NamedWall,
        code: &dyn Code,
        curves: &[Curve],
        fitting: &Fitting,
        target: f64,
    ) -> Result<Self, String> {
        let (parameters, subject) = (&wall.parameters, subject(wall));
        let verdict = code.check(subject).map_err(|error| error.to_string())?;
        let checks = checkpoints(&verdict);
        let governs = checks.iter().position(|one| one.check == verdict.governs).unwrap_or(0);
        let limits = limits(&verdict, verdict.details.wall());
        let fractions: Vec<f64> = limits.iter().map(|(_, fraction)| *fraction).collect();
        let (records, models) = (fitting.records(), curves.len() / fitting.records());
        let of_model = |model: usize| &curves[model * records..(model + 1) * records];
        let fitted = fitting.summaries(curves, &fractions).into_iter();
        let widened = |summary: Summary| summary.widened(fitting.modelling());
        let fitted = fitted.map(|of_models| of_models.into_iter().map(widened).collect());
        let events = limits.into_iter().zip(fitted).map(|((check, fraction), fragilities)| Event {
            name: check.map_or_else(|| FALL.into(), |check| format!("beyond d_{check}")),
            check,
            fraction,
            fragilities,
            dynamic: (0..models).map(|model| dynamic(of_model(model), fitting.signs(), fraction)).collect(),
            exceedances: (0..models)
                .map(|model| {
                    let exceeds = |curve: &Curve| curve.exceedance(fraction, Crossing::First, false);
                    of_model(model).iter().map(exceeds).collect()
                })
                .collect(),
        });
        let events: Vec<Event> = events.collect();
        let fall = events.last().map_or(&[][..], |fall| &fall.fragilities);
        let fall: Vec<Option<Lognormal>> = fall.iter().map(|summary| summary.fitted.ok()).collect();
        let turned = rules::turned(code, subject, checks.iter().map(|check| check.check), &fall, target);
        let hinges = [parameters.hinge_ratio, verdict.details.parameters().hinge_ratio];
        let differs =
            parameters.mechanism == Mechanism::VerticalSpanning && (hinges[0] - hinges[1]).abs() > SAME_HINGE;
        let answers = answers(models, &checks, &events);
        let (least, hinges) = (fitting.least_probability(), differs.then_some(hinges));
        let is_other_body = parameters.profile != verdict.details.parameters().profile;
        Ok(Self { checks, governs, events, answers, turned, least, hinges, is_other_body })
    }
}

impl Event {
    /// The probability of the event at `a_g`, with its interval; `None` without a curve.
    fn probability(&self, model: usize, ground: f64) -> Option<Interval> {
        let summary = &self.fragilities[model];
        let curve = summary.fitted.ok()?;
        // Φ is taken of the ends alone, since it rises with z
        let z = |median: f64, dispersion: f64| libm::log(ground / median) / dispersion;
        let resampled = summary.resamples.iter().map(|[median, dispersion]| z(*median, *dispersion));
        Some(Interval::new(z(curve.median, curve.dispersion), resampled, CONFIDENCE).mapped(cumulative))
    }

    /// θ over `a_g`, with its interval; `None` without a curve.
    fn margin(&self, model: usize, ground: f64) -> Option<Interval> {
        let summary = &self.fragilities[model];
        let curve = summary.fitted.ok()?;
        let medians = summary.resamples.iter().map(|[median, _]| median / ground);
        Some(Interval::new(curve.median / ground, medians, CONFIDENCE))
    }

    /// How many of the records lead to the event at `a_g` or below it.
    pub fn records(&self, model: usize, ground: f64) -> usize {
        self.exceedances[model].iter().filter(|exceedance| exceedance.or_infinity() <= ground).count()
    }
}

/// Reads each event where each check has ζ = 1, with each model.
fn answers(models: usize, checks: &[Checkpoint], events: &[Event]) -> Vec<Answer> {
    let mut answers = Vec::with_capacity(models * checks.len() * events.len());
    for model in 0..models {
        for (check, Checkpoint { code, .. }) in checks.iter().enumerate() {
            for (event, own) in events.iter().enumerate() {
                let (margin, probability) = (own.margin(model, *code), own.probability(model, *code));
                answers.push(Answer { model, check, event, margin, probability });
            }
        }
    }
    answers
}

/// The checks of a verdict that state a ground acceleration, of the sides the less favourable one.
fn checkpoints(verdict: &Verdict<'_>) -> Vec<Checkpoint> {
    let mut checks: Vec<Checkpoint> = Vec::new();
    for row in &verdict.rows {
        let Some([code, site]) = row.ground.map(|ground| ground.map(|ag| ag * verdict.code.gravity)) else {
            continue;
        };
        let one = Checkpoint { check: row.check, decides: row.decides, zeta: row.zeta, code, site };
        match checks.iter_mut().find(|known| known.check == row.check) {
            Some(known) if known.code <= one.code => {}
            Some(known) => *known = one,
            None => checks.push(one),
        }
    }
    checks
}

/// The checks by displacement with |u|/`u_ins` at their capacities, of the sides the smaller one, and the
/// fall.
fn limits(verdict: &Verdict<'_>, wall: &Wall) -> Vec<(Option<&'static str>, f64)> {
    let mut limits: Vec<(Option<&'static str>, f64)> = Vec::new();
    for row in &verdict.rows {
        let Some(u) = row.displacement else { continue };
        let fraction = (u / wall.body().instability.of(row.side.sign())).min(1.0);
        match limits.iter_mut().find(|known| known.0 == Some(row.check)) {
            Some(known) => known.1 = known.1.min(fraction),
            None => limits.push((Some(row.check), fraction)),
        }
    }
    limits.push((None, 1.0));
    limits
}

/// Returns the lowest intensity at which a wall fails under its records, NTC 7.3.5: the mean of the demands
/// of 7 and more, or the largest of fewer, reaches `fraction`, or one record overturns it. The curves of a
/// record that is run with several `signs` follow each other; its demand is the largest of them.
fn dynamic(curves: &[Curve], signs: usize, fraction: f64) -> f64 {
    let lowest = |fraction: f64| {
        let first = |curve: &Curve| curve.exceedance(fraction, Crossing::First, false).or_infinity();
        curves.iter().map(first).fold(f64::INFINITY, f64::min)
    };
    if curves.len() / signs < MEAN_COUNTS_FROM || fraction >= 1.0 {
        return lowest(fraction);
    }
    let falls = lowest(1.0);
    let levels = sorted(curves.iter().flat_map(Curve::runs).map(|run| run.intensity));
    // the mean is straight between levels
    let mut before = [0.0, 0.0];
    for level in levels.into_iter().take_while(|level| *level < falls) {
        let demands: Option<Vec<f64>> = curves.iter().map(|curve| curve.demand(level)).collect();
        let Some(demands) = demands else { break };
        let largest = |of_record: &[f64]| of_record.iter().copied().fold(0.0, f64::max);
        let demands: Vec<f64> = demands.chunks(signs).map(largest).collect();
        let mean = demands.iter().sum::<f64>() / demands.len() as f64;
        if mean >= fraction && mean.is_finite() {
            return before[0] + (level - before[0]) * (fraction - before[1]) / (mean - before[1]);
        }
        before = [level, mean];
    }
    falls
}
