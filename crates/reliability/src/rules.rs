//! The protocol turned round: the number of a code with which the probability of a fall would be a stated
//! one.
//!
//! With another number the wall just passes at another `a_g`. The one sought is that at which the fragility
//! of the fall has the target, θ exp(β Φ⁻¹(p)).

use check::{Code, Rule, Subject};

use fragility::Lognormal;

/// Numbers at which a factor is tried, on each side of that of the code, and how many double it.
const TRIED: i32 = 9;
const TO_DOUBLE: f64 = 3.0;
/// Fractions of `d_0` that are tried: the first, in equal steps to below 1.
const FIRST: f64 = 0.05;
/// How near ln `a_g` comes to what is wanted, and the bound on the steps to it; six are usual.
const NEAR: f64 = 1e-10;
const MOST_STEPS: usize = 60;

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
pub(crate) fn turned(
    code: &dyn Code,
    subject: Subject<'_>,
    checks: impl Iterator<Item = &'static str>,
    fall: &[Option<Lognormal>],
    target: f64,
) -> Vec<Vec<Turned>> {
    let mut turned = vec![Vec::new(); fall.len()];
    for check in checks {
        for rule in Rule::ALL {
            let Some(own) = code.rule(check, rule) else { continue };
            // ln a_g with which the wall just passes
            let ground = |value: f64| {
                let varied = code.with_rule(check, rule, value)?;
                let verdict = varied.check(subject).ok()?;
                let rows = verdict.rows.iter().filter(|row| row.check == check);
                let least = rows.filter_map(|row| row.ground).map(|[ag, _]| ag).fold(f64::INFINITY, f64::min);
                least.is_finite().then(|| libm::log(least * verdict.code.gravity))
            };
            let tried: Vec<(f64, f64)> =
                candidates(rule, own).into_iter().filter_map(|value| Some((value, ground(value)?))).collect();
            for (of_model, curve) in turned.iter_mut().zip(fall) {
                let wanted = curve.map(|curve| libm::log(curve.intensity(target)));
                let value = wanted.and_then(|wanted| nearest(&tried, own, wanted, &ground));
                of_model.push(Turned { check, rule, code: own, value });
            }
        }
    }
    turned
}

/// Numbers at which a rule is tried, in rising order.
fn candidates(rule: Rule, own: f64) -> Vec<f64> {
    match rule {
        Rule::Fraction => (1..20).map(|k| FIRST * f64::from(k)).collect(),
        // an eighth to eight times the number of the code
        Rule::PeriodFactor | Rule::BehaviourFactor => {
            (-TRIED..=TRIED).map(|k| own * libm::exp2(f64::from(k) / TO_DOUBLE)).collect()
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
    between([pair[0], pair[1]].map(|(value, found)| (libm::log(value), found - wanted)), |logarithm| {
        Some(ground(libm::exp(logarithm))? - wanted)
    })
    .map(libm::exp)
}

/// Finds a zero between two places at which a function has different signs, by false positions; where one end
/// stays, its value is halved (Illinois). M. Dowell, P. Jarratt: A modified regula falsi method for computing
/// the root of an equation. BIT 11, 1971, 168–174.
fn between([mut a, mut b]: [(f64, f64); 2], f: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    for _ in 0..MOST_STEPS {
        let x = (a.0 * b.1 - b.0 * a.1) / (b.1 - a.1);
        let found = f(x)?;
        if found.abs() <= NEAR {
            return Some(x);
        }
        if (found < 0.0) == (b.1 < 0.0) {
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (x, found);
    }
    None
}
