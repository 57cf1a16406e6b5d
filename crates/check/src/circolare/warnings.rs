//! What the engineer should know of a check that can be made.

use std::collections::BTreeSet;

use report::apart;
use rocking_wall::scene::Floors;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Wall};

use super::case::Case;
use super::checks::DisplacementCheck;
use super::curve::Curve;
use super::demand::{Demands, LONGEST_PERIOD};
use super::dynamic::DynamicCheck;
use super::outcome::Checked;
use super::sides::{LeastAlpha0, SideVerdict, SideVerdicts};
use super::statement::Statement;
use super::table::{AtActivation, Hinge, LARGEST_CONFIDENCE_FACTOR, Method, UseClass};
use super::tie::TieState;
use crate::names::{Deciding, LimitState, Side};

/// Share by which a searched hinge is said to be less favourable than the one given \[-\].
const LOWER: f64 = 0.01;

/// All warnings of a check in their order, each once; `scene` is the wall of the runs.
pub(super) fn all(case: &Case<'_>, checked: &Checked<'_>, scene: &Parameters) -> Vec<String> {
    let Checked { statement, parameters, floors, wall, demands, outcome, .. } = checked;
    let (sides, governs) = (&outcome.sides, outcome.governs.side);
    // of sides that are alike one is told
    let told = || sides.iter().take(if case.alike { 1 } else { 2 });
    let ordered: [Vec<String>; 10] = [
        of_statement(statement, parameters, *floors, wall),
        of_demands(statement, demands),
        told().flat_map(|(side, verdict)| of_hinges(case, side, verdict)).collect(),
        told().flat_map(|(_, verdict)| of_side(verdict, statement, demands)).collect(),
        of_untied_side(case, sides, governs).into_iter().collect(),
        of_periods(sides).collect(),
        of_verdict(case, sides, outcome.passed),
        of_sensitivity(case, sides),
        outcome.dynamic.iter().filter_map(|_| statement.differs_in_rocking(scene)).collect(),
        outcome.dynamic.iter().flat_map(|dynamic: &DynamicCheck| dynamic.warnings(case)).collect(),
    ];
    let mut seen = BTreeSet::new();
    ordered.into_iter().flatten().filter(|warning| seen.insert(warning.clone())).collect()
}

fn of_statement(
    statement: &Statement,
    parameters: &Parameters,
    floors: Option<&Floors>,
    wall: &Wall,
) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut below: Option<(LimitState, f64)> = None;
    for given in statement.states.iter().flatten() {
        if let Some((state, ag)) = below.filter(|(_, ag)| *ag >= given.ag) {
            warnings
                .push(format!("a_g does not rise from {state} to {}: {ag} and {} g", given.state, given.ag));
        }
        below = Some((given.state, given.ag));
    }
    let on_ground = floors.is_none() && statement.table.building.is_none();
    for given in statement.states.iter().flatten().filter(|_| on_ground) {
        if given.building_damping.is_some() || given.building_period.is_some() {
            warnings.push(format!(
                "{}: building_damping and building_period have no effect without [check.building]",
                given.state
            ));
        }
    }
    let body = wall.body();
    if statement.table.overburden_mass.is_some()
        && (body.overburden == 0.0 || body.mechanism != Mechanism::Parapet)
    {
        warnings.push("overburden_mass has no effect: it is for a parapet with overburden".into());
    }
    let is_at_edges = parameters.a3 == 1.0 && parameters.multilinear.is_none() && statement.masonry.is_none();
    if statement.table.compression_considered && is_at_edges {
        warnings.push(
            "compression_considered with a3 = 1 puts the hinges at the edges: give the reduced thickness"
                .into(),
        );
    }
    let of_wall = parameters.unusual();
    warnings.extend(of_wall.chain(statement.improbable(floors)).map(|warning| warning.to_string()));
    if statement.confidence_factor > LARGEST_CONFIDENCE_FACTOR {
        warnings.push(format!("FC = {} is above that of LC1, 1.35 (C8.5.4)", statement.confidence_factor));
    }
    if statement.table.building.is_some() && floors.is_some() {
        warnings.push("the static checks use [check.building]; runs under records use [[storeys]]".into());
    }
    if statement.table.use_class == Some(UseClass::IV) && statement.state(LimitState::Sld).is_none() {
        warnings.push("use class IV is checked for SLD too (NTC 8.3); give [check.SLD]".into());
    }
    warnings.extend(
        floors
            .and_then(|floors| floors.heavy(wall))
            .map(|warning| format!("{warning}; the check is then on the safe side (C8.7.1.2.1.4)")),
    );
    warnings
}

/// What the printed `a_Z` lets pass: an acceleration below that of the ground.
fn of_demands(statement: &Statement, demands: &Demands) -> Vec<String> {
    let below = statement.demanded(demands).filter_map(|(given, demand)| {
        let (state, floor) = (given.state, demand.floor()?);
        let (place, ground) = (floor.printed_peak(), floor.ground().acceleration(0.0, 0.05));
        let is_below = place < ground && !statement.bounds_heights();
        is_below.then(|| {
            let [place, ground] = apart([place, ground], 5);
            format!("{state}: a_Z = {place} m/s² is below a_g S = {ground} m/s² of the ground")
        })
    });
    below.collect()
}

/// What the curve of a side and its hinge leave to be known.
fn of_hinges(case: &Case<'_>, side: Side, verdict: &SideVerdict) -> Vec<String> {
    let (mut warnings, name) = (of_curve(case, &verdict.curve), case.name(side));
    if let Some(error) = &verdict.unsearched {
        warnings.push(format!("{name}: other hinges could not be searched: {error}"));
    }
    let searched = verdict.least_alpha0.filter(|found| found.worst_check.is_some());
    if let (Some(rule), Some(found)) = (case.rule, searched) {
        warnings.extend(of_rules(case, (name, rule), verdict, found));
        warnings.extend(of_place(case, (name, rule), verdict));
    }
    warnings
}

/// Where another rule on the hinge gives another verdict.
fn of_rules(
    case: &Case<'_>,
    (side, rule): (&str, Hinge),
    verdict: &SideVerdict,
    found: LeastAlpha0,
) -> Option<String> {
    let own = verdict.checks.governing(case.statement).1;
    let [least, lowest] = [found.zeta, found.worst].map(|zeta| zeta.unwrap_or(f64::INFINITY));
    let place = found.worst_hinge.unwrap_or(f64::NAN);
    let passed = |zeta: f64| if zeta >= 1.0 { "passed" } else { "not passed" };
    let turns = (lowest >= 1.0) != (own >= 1.0);
    match rule {
        Hinge::Given if turns || lowest < own * (1.0 - LOWER) => Some(format!(
            "{side}: the hinge is given at {}; at {place:.4} {} has zeta_E = {lowest:.3}, {}; state hinge = \
             \"worst\"",
            case.parameters.hinge_ratio,
            found.worst_check?.name(),
            passed(lowest)
        )),
        Hinge::Worst | Hinge::LeastAlpha0 if (lowest >= 1.0) != (least >= 1.0) => Some(format!(
            "{side}: the hinge turns the verdict: {lowest:.3}, {}, at the least favourable hinge {place:.4}; \
             {least:.3}, {}, at that of the least alpha0, {:.4}",
            passed(lowest),
            passed(least),
            found.hinge
        )),
        _ => None,
    }
}

/// Where the hinge that governs is at an end of its range, or so near an end of the wall that a body is
/// squat.
fn of_place(case: &Case<'_>, (side, rule): (&str, Hinge), verdict: &SideVerdict) -> Vec<String> {
    let mut warnings = Vec::new();
    let hinge = verdict.checks.hinge(verdict.checks.governing(case.statement).0);
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
    warnings
}

/// What the curve of a side leaves to be known.
fn of_curve(case: &Case<'_>, curve: &Curve) -> Vec<String> {
    let statement = case.statement;
    let mut warnings = Vec::new();
    if curve.tie().is_some_and(|tie| tie.strength_displacement().is_none()) {
        warnings
            .push("the tie has no tie_strength: it never breaks and is counted at d_SLV and d_SLC".into());
    }
    let makes = |state: LimitState| statement.state(state).is_some();
    if makes(LimitState::Sld) || makes(LimitState::Slv) {
        warnings.extend(of_tie(case, curve));
    }
    warnings
}

/// A side that the tie of the wall does not hold, and whether it governs.
fn of_untied_side(case: &Case<'_>, sides: &SideVerdicts, governs: Side) -> Option<String> {
    let has_tie = case.parameters.tie_stiffness > 0.0;
    let (untied, _) = sides.iter().find(|(_, side)| has_tie && side.tie.is_none())?;
    let which = if untied == governs { "; the side without a tie governs" } else { "" };
    Some(format!("{}: no tie holds this side{which}", case.name(untied)))
}

/// What the tie leaves out at the activation.
fn of_tie(case: &Case<'_>, curve: &Curve) -> Option<String> {
    let tie = curve.tie()?;
    let has_q = case.statement.behaviour_factor > 1.0;
    match case.statement.at_activation() {
        AtActivation::None => Some(
            "SLD and SLV with q do not count the tie; state [check.tie] at_activation = \"yield\" for a \
             tight tie that acts at the activation"
                .into(),
        ),
        AtActivation::Yield if has_q && tie.ultimate == Some(0.0) => Some(
            "SLV with q counts a brittle tie (tie_ultimate = 0), and q > 1 asks for one that yields".into(),
        ),
        AtActivation::Yield => None,
    }
}

/// Where a spectrum at a height is below that of the ground at T0.
fn of_side(side: &SideVerdict, statement: &Statement, demands: &Demands) -> Vec<String> {
    let mut warnings = Vec::new();
    for (given, demand) in statement.demanded(demands) {
        let Some(floor) = demand.floor() else { continue };
        let (xi, t0) = (LimitState::Sld.damping(), side.curve.t0);
        let (above, ground) = (floor.acceleration(t0, xi), floor.ground().acceleration(t0, xi));
        if t0 > 0.0 && t0 < floor.first_period() && above < ground {
            let [above, ground] = apart([above, ground], 5);
            warnings.push(format!(
                "{}: S_eZ(T0) = {above} m/s² is below S_e(T0) = {ground} m/s² of the ground",
                given.state
            ));
        }
    }
    warnings
}

/// What a verdict owes to the raise by SLD, or lacks without it.
fn of_verdict(case: &Case<'_>, sides: &SideVerdicts, passed: bool) -> Vec<String> {
    let (mut warnings, statement) = (Vec::new(), case.statement);
    let decides = statement.table.method != Method::Linear;
    for (side, verdict) in sides.iter() {
        let side = case.name(side);
        for (state, found) in verdict.by_displacement().filter(|(_, found)| found.ratio < 1.0) {
            if statement.state(LimitState::Sld).is_none() {
                warnings.push(format!(
                    "{side}: {state} by displacement is {:.3}; without [check.SLD] no a_g of activation \
                     raises it (C8.7.1.2.1.8)",
                    found.ratio
                ));
            } else if state == LimitState::Slc && decides && found.raised && found.zeta < 1.0 {
                let is_tied = verdict.activation.force > 0.0;
                let is_broken = found.tie.is_some_and(|tie| tie.state == TieState::Broken);
                let tie =
                    if is_tied && is_broken { "; SLD counts the tie, which is broken at d_SLC" } else { "" };
                warnings.push(format!(
                    "{side}: SLC by displacement has zeta_E = {:.3}; {:.3} is by analogy with C8.7.1.2.1.8, \
                     which has the raise for SLV only{tie}",
                    found.ratio, found.zeta
                ));
            } else if passed && decides && found.zeta >= 1.0 {
                warnings.push(format!(
                    "{side}: the raise by SLD turns the verdict of {state}: {:.3} by displacement, raised to \
                     {:.3}{}",
                    found.ratio,
                    found.zeta,
                    if state == LimitState::Slc { "; the text has the raise for SLV only" } else { "" }
                ));
            }
        }
    }
    warnings
}

fn of_periods(sides: &SideVerdicts) -> impl Iterator<Item = String> {
    let checks = sides.iter().flat_map(|(_, side)| side.by_displacement());
    let long = checks.filter(|(_, check)| check.period > LONGEST_PERIOD);
    long.map(|(state, DisplacementCheck { period, .. })| {
        format!(
            "T_{state} = {period:.3} s: NTC 3.2.3.2 admits its spectra up to 4 s; the demand of {state} is \
             outside and needs a spectrum of a special study"
        )
    })
}

/// Where another a₁ or E turns the verdict on a side: which check turns, and whether the wall does.
fn of_sensitivity(case: &Case<'_>, sides: &SideVerdicts) -> Vec<String> {
    let statement = case.statement;
    if statement.table.method == Method::Dynamic {
        // the runs decide, and no a₁ of theirs is varied
        return Vec::new();
    }
    let mut warnings = Vec::new();
    for (name, side) in sides.iter() {
        for (index, varied) in side.sensitivity.iter().enumerate() {
            let (own, zetas) = (side.checks.zetas(), varied.zetas);
            let is_turned = |at: &usize| {
                statement.decides(Deciding::ALL[*at]) && (own[*at] >= 1.0) != (zetas[*at] >= 1.0)
            };
            let passed = side.checks.governing(statement).1 >= 1.0;
            let Some(at) = (0..4).find(is_turned).filter(|_| varied.passed == Some(!passed)) else {
                continue;
            };
            let before = sides.iter().all(|(_, side)| side.checks.governing(statement).1 >= 1.0);
            let after = sides.iter().all(|(_, side)| side.sensitivity[index].passed == Some(true));
            warnings.push(format!(
                "{}: {} turns the verdict{}: with {} {} goes from {:.3} to {:.3}, {}",
                case.name(name),
                varied.parameter,
                if before == after { " on this side, not that on the wall" } else { "" },
                varied.assigned(),
                Deciding::ALL[at].name(),
                own[at],
                zetas[at],
                if passed { "not passed" } else { "passed" }
            ));
        }
    }
    warnings
}
