//! The protocol turned round: the number of a code with which the probability of a fall would be a stated
//! one.
//!
//! With another number the wall just passes at another `a_g`. The one sought is that at which the fragility
//! of the fall has the target, θ exp(β Φ⁻¹(p)).

use check::{Code, Rule, Subject};

use crate::fragility::Lognormal;
use run::bisection::first_true;

use super::wall::Checkpoint;

/// Numbers at which a rule is tried first, on each side of that of the code.
const TRIED: i32 = 24;
/// Fractions of `d_0` that are tried, by their number.
const FRACTIONS: i32 = 50;
/// Halvings of a step between two of them: to 1e-9 of it.
const HALVINGS: u32 = 30;

/// A number of the code, and the one that would give the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// The check.
    pub check: &'static str,
    /// The number.
    pub rule: Rule,
    /// That of the code.
    pub code: f64,
    /// That which gives the target, of several the nearest; `None` where no number does.
    pub value: Option<f64>,
}

/// Seeks the numbers, model by model; `fall` holds the fragility of the fall with each.
pub(super) fn turned(
    (code, subject): (&dyn Code, Subject<'_>),
    checks: &[Checkpoint],
    fall: &[Option<Lognormal>],
    target: f64,
) -> Vec<Vec<Turned>> {
    let mut turned = vec![Vec::new(); fall.len()];
    for check in checks {
        for rule in Rule::ALL {
            let Some(own) = code.rule(check.check, rule) else { continue };
            // ln a_g with which the wall just passes
            let ground = |value: f64| {
                let varied = code.with_rule(check.check, rule, value)?;
                let verdict = varied.check(subject).ok()?;
                let rows = verdict.rows.iter().filter(|row| row.check == check.check);
                let least = rows.filter_map(|row| row.ground).map(|[ag, _]| ag).fold(f64::INFINITY, f64::min);
                least.is_finite().then(|| libm::log(least * verdict.code.gravity))
            };
            let tried: Vec<(f64, f64)> =
                candidates(rule, own).filter_map(|value| Some((value, ground(value)?))).collect();
            for (of_model, curve) in turned.iter_mut().zip(fall) {
                let wanted = curve.map(|curve| libm::log(curve.intensity(target)));
                let value = wanted.and_then(|wanted| nearest(&tried, own, wanted, &ground));
                of_model.push(Turned { check: check.check, rule, code: own, value });
            }
        }
    }
    turned
}

/// Numbers at which a rule is tried, in rising order.
fn candidates(rule: Rule, own: f64) -> Box<dyn Iterator<Item = f64>> {
    match rule {
        Rule::Fraction => Box::new((1..FRACTIONS).map(|k| f64::from(k) / f64::from(FRACTIONS))),
        // an eighth to eight times the number of the code
        Rule::PeriodFactor | Rule::BehaviourFactor => {
            Box::new((-TRIED..=TRIED).map(move |k| own * libm::exp2(f64::from(k) / 8.0)))
        }
    }
}

/// Returns the number nearest to that of the code at which `ground` is `wanted`.
fn nearest(tried: &[(f64, f64)], own: f64, wanted: f64, ground: &impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let crosses = tried.windows(2).filter(|pair| (pair[0].1 < wanted) != (pair[1].1 < wanted));
    let distance = |pair: &&[(f64, f64)]| {
        let of = |(value, _): (f64, f64)| libm::log(value / own).abs();
        of(pair[0]).min(of(pair[1]))
    };
    let pair = crosses.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let rises = pair[0].1 < wanted;
    first_true([pair[0].0, pair[1].0], HALVINGS, |value| {
        ground(value).map(|found| (found >= wanted) == rises).ok_or(())
    })
    .ok()
}
