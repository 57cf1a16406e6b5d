//! A side of a wall: its hinge by the rule that is stated, its numbers there, and what other rules give.

use report::apart;
use rocking_wall::variables::{DampingModel, Impact, Rocking};
use rocking_wall::wall::{Parameters, Wall};

use super::case::Case;
use super::checks::{Checks, at_activation};
use super::curve::Curve;
use super::hinge::{self, Search};
use super::side_verdict::{LeastAlpha0, Sensitivity, SideVerdict, TieNumbers, Untied};
use super::states::Source;
use super::table::{Activation, Hinge};
use super::verdict::{Deciding, Side};
use crate::error::CheckError;

/// Share by which a searched hinge is said to be less favourable than the one given \[-\].
const LOWER: f64 = 0.01;
/// Factors on a₁ or E whose verdicts are told.
const VARIED: [f64; 2] = [0.5, 2.0];

/// Makes the wall of a drawing. Damping and impacts that do not go with the wall have no part in the static
/// checks.
pub(super) fn drawn(parameters: &Parameters) -> Result<Wall, CheckError> {
    Ok(Wall::new(parameters).or_else(|_| {
        let impact = if parameters.rocking == Rocking::TwoSided { Impact::None } else { Impact::Restitution };
        let (damping_model, restitution) = (DampingModel::None, 0.5);
        Wall::new(&Parameters { impact, damping_model, restitution, ..parameters.clone() })
    })?)
}

/// The checks of a side by a rule on the hinge, searched as finely as stated, and the curve with the hinge of
/// the check that governs. A coarse search is for the checks that decide.
fn by_rule(
    case: &Case<'_>,
    sign: f64,
    rule: Option<Hinge>,
    search: Search,
) -> Result<(Curve, Checks), CheckError> {
    match rule {
        None => case.at(sign, None, true),
        Some(Hinge::Given) => case.at(sign, Some(case.parameters.hinge_ratio), true),
        Some(Hinge::LeastAlpha0) => case.at(sign, Some(case.least_alpha0(sign)?), true),
        Some(Hinge::Worst) => {
            let range = case.statement.hinge_range;
            let counts = Deciding::ALL.map(|check| search.is_fine() || case.statement.decides(check));
            let places = hinge::least(search, range, |x, which| {
                let wanted = which.map_or(counts, |which| std::array::from_fn(|check| check == which));
                let mut zetas = case.of_these(sign, (Some(x), true), wanted)?.1.zetas();
                for (zeta, _) in zetas.iter_mut().zip(counts).filter(|(_, counts)| !counts) {
                    *zeta = f64::INFINITY;
                }
                Ok::<_, CheckError>(zetas)
            })?;
            let at = |which: usize| places[which].map(|x| case.at(sign, Some(x), true)).transpose();
            let found = [at(0)?, at(1)?, at(2)?, at(3)?];
            let [sld, slv_q, slv, slc] = found.each_ref().map(|found| found.as_ref().map(|found| found.1));
            let checks = Checks {
                sld: sld.and_then(|checks| checks.sld),
                slv_q: slv_q.and_then(|checks| checks.slv_q),
                slv: slv.and_then(|checks| checks.slv),
                slc: slc.and_then(|checks| checks.slc),
            };
            let (governs, _) = checks.governing(case.statement);
            let curve = match found.into_iter().nth(governs as usize).flatten() {
                Some((curve, _)) => curve,
                None => case.at(sign, Some(case.least_alpha0(sign)?), true)?.0,
            };
            Ok((curve, checks))
        }
    }
}

/// Checks a side; returns what the engineer should know of it, too.
pub(super) fn side(case: &Case<'_>, sign: f64) -> Result<(SideVerdict, Vec<String>), CheckError> {
    let (curve, checks) = by_rule(case, sign, case.rule, hinge::FINE)?;
    let mut warnings = super::warnings::of_curve(&curve, case);
    let beside = case.rule.map(|rule| beside(case, sign, rule, &checks, &mut warnings));
    let least_alpha0 = beside.transpose()?.flatten();
    let untied = curve.tie().is_some().then(|| case.at(sign, curve.hinge, false)).transpose()?;
    let untied = untied.map(|(_, checks)| Untied {
        slv: checks.slv.map(|check| check.zeta),
        slc: checks.slc.map(|check| check.zeta),
    });
    let tie = curve.tie().map(|tie| TieNumbers {
        engaged: tie.onset(),
        yields: tie.strength_displacement(),
        breaks: tie.fracture_displacement(),
        loss: curve.tie_break().map(|broken| broken.loss),
    });
    let activation = at_activation(&curve, case.statement)?;
    let mut others: Vec<Curve> = Vec::new();
    for hinge in Deciding::ALL.into_iter().filter_map(|check| checks.hinge(check)) {
        if curve.hinge != Some(hinge) && others.iter().all(|other| other.hinge != Some(hinge)) {
            others.push(Curve::new(case, sign, Some(hinge), true)?);
        }
    }
    let sensitivity = sensitivity(case, sign);
    Ok((SideVerdict { curve, checks, least_alpha0, activation, tie, untied, sensitivity, others }, warnings))
}

/// What the hinge of the least α0 gives; warns where another rule gives another verdict.
fn beside(
    case: &Case<'_>,
    sign: f64,
    rule: Hinge,
    checks: &Checks,
    warnings: &mut Vec<String>,
) -> Result<Option<LeastAlpha0>, CheckError> {
    let statement = case.statement;
    let side = case.name(Side::of(sign));
    let (curve, at_least) = match by_rule(case, sign, Some(Hinge::LeastAlpha0), hinge::FINE) {
        Err(error) if rule == Hinge::Given => {
            warnings.push(format!("{side}: other hinges could not be searched: {error}"));
            return Ok(None);
        }
        found => found?,
    };
    let least = at_least.governing(statement).1;
    let (governs, own) = checks.governing(statement);
    let found = LeastAlpha0 {
        alpha0: curve.alpha0,
        hinge: curve.hinge.unwrap_or(f64::NAN),
        zeta: Some(least).filter(|zeta| zeta.is_finite()),
        worst: None,
        worst_hinge: None,
    };
    // spectra of records at every hinge would take long for what only informs
    let by_records = statement.states.iter().flatten().any(|given| given.source == Source::Records);
    let worst = match rule {
        Hinge::Worst => *checks,
        _ if by_records => return Ok(Some(found)),
        Hinge::LeastAlpha0 | Hinge::Given => match by_rule(case, sign, Some(Hinge::Worst), hinge::FINE) {
            Ok((_, checks)) => checks,
            Err(error) => {
                warnings.push(format!("{side}: other hinges could not be searched: {error}"));
                return Ok(Some(found));
            }
        },
    };
    let (of, lowest) = worst.governing(statement);
    let place = worst.hinge(of).unwrap_or(f64::NAN);
    let passed = |zeta: f64| if zeta >= 1.0 { "passed" } else { "not passed" };
    let turns = (lowest >= 1.0) != (own >= 1.0);
    match rule {
        Hinge::Given if turns || lowest < own * (1.0 - LOWER) => warnings.push(format!(
            "{side}: the hinge is given at {}; at {place:.4} {} has zeta_E = {lowest:.3}, {}; state hinge = \
             \"worst\"",
            case.parameters.hinge_ratio,
            of.name(),
            passed(lowest)
        )),
        Hinge::Worst | Hinge::LeastAlpha0 if (lowest >= 1.0) != (least >= 1.0) => warnings.push(format!(
            "{side}: the hinge turns the verdict: {lowest:.3}, {}, at the least favourable hinge {place:.4}; \
             {least:.3}, {}, at that of the least alpha0, {:.4}",
            passed(lowest),
            passed(least),
            found.hinge
        )),
        _ => {}
    }
    about_place(case, (sign, rule), checks.hinge(governs), warnings);
    let some = |zeta: f64| Some(zeta).filter(|zeta| zeta.is_finite());
    Ok(Some(LeastAlpha0 { worst: some(lowest), worst_hinge: worst.hinge(of), ..found }))
}

/// Warns where the hinge that governs is at an end of its range, or so near an end of the wall that a body is
/// squat.
fn about_place(case: &Case<'_>, (sign, rule): (f64, Hinge), hinge: Option<f64>, warnings: &mut Vec<String>) {
    let side = case.name(Side::of(sign));
    let [from, to] = case.statement.hinge_range;
    let is_end = |x: &f64| (x - from).abs() < 1e-9 || (x - to).abs() < 1e-9;
    if let Some(at) = hinge.filter(is_end).filter(|_| rule != Hinge::Given) {
        warnings.push(format!(
            "{side}: the hinge that governs, {at}, is at an end of hinge_range = [{from}, {to}]"
        ));
    }
    let Parameters { height, thickness, .. } = case.parameters;
    let at = hinge.unwrap_or(0.5);
    let shortest = height * at.min(1.0 - at);
    if shortest < thickness {
        let [shortest, _] = apart([shortest, thickness], 4);
        warnings.push(format!(
            "{side}: with the hinge at {at:.4} a body is {shortest} m high, lower than b = {thickness} m: \
             small rotations no longer hold"
        ));
    }
}

/// `ζ_E` with half and twice a₁ (`law`) or E (`beam`).
fn sensitivity(case: &Case<'_>, sign: f64) -> Vec<Sensitivity> {
    let statement = case.statement;
    let (parameter, value) = match case.activation {
        Activation::Law if case.parameters.multilinear.is_none() => ("a1", case.parameters.a1),
        Activation::Beam => ("young_modulus", case.young_modulus.unwrap_or(f64::NAN)),
        _ => return Vec::new(),
    };
    let one = |factor: f64| {
        let value = factor * value;
        // without a check where the wall with this value has none
        let checks = by_rule(&case.with(factor), sign, case.rule, hinge::COARSE).ok().map(|found| found.1);
        let zeta = checks.map(|checks| checks.governing(statement).1);
        Sensitivity {
            parameter,
            value,
            zeta: zeta.filter(|zeta| zeta.is_finite()),
            passed: zeta.map(|zeta| zeta >= 1.0),
            slv: checks.and_then(|checks| Some(checks.slv?.zeta)),
            slc: checks.and_then(|checks| Some(checks.slc?.zeta)),
            zetas: checks.map_or([f64::NAN; 4], |checks| checks.zetas()),
        }
    };
    VARIED.map(one).to_vec()
}
