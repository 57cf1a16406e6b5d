//! What the engineer should know of a check that can be made.

use report::apart;
use rocking_wall::scene::Floors;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Usual, Wall, Warning};

use super::LimitState;
use super::case::{Case, Demands};
use super::curve::Curve;
use super::side_verdict::{DisplacementCheck, SideVerdict};
use super::statement::{LARGEST_CONFIDENCE_FACTOR, Statement};
use super::states::Source;
use super::table::{AtActivation, Method, UseClass};
use super::tie::TieState;
use super::verdict::{Deciding, Side, SideVerdicts};

/// Longest period for which NTC 3.2.3.2 admits its spectra \[s\].
pub(super) const LONGEST_PERIOD: f64 = 4.0;

pub(super) fn of_statement(
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
    warnings.extend(of_wall.chain(improbable(statement, floors)).map(|warning| warning.to_string()));
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

/// Usual E of masonry: 1e8 to 5e10 Pa. NTC Tab. C8.5.I has 0.69e9 to 3.36e9 Pa.
pub(super) const YOUNG_MODULUS: Usual = Usual {
    name: "young_modulus",
    unit: "Pa",
    range: [1e8, 5e10],
    others: &[("in MPa", 1e6), ("in GPa", 1e9)],
};
/// Usual F0: from the least of NTC 3.2.3.2.1 on; the hazard of Italy stays well below 4.
const F0: Usual =
    Usual { name: "F0", unit: "", range: [2.2, 4.0], others: &[("without its decimal point", 0.1)] };
/// Usual `T_C`*: the hazard of Italy has 0.15 to 0.9 s.
const TC: Usual = Usual { name: "TC", unit: "s", range: [0.1, 1.0], others: &[("in ms", 1e-3)] };

/// Finds what the engineer states that is improbable, and what may be meant.
pub(super) fn improbable(statement: &Statement, floors: Option<&Floors>) -> Vec<Warning> {
    let mut found: Vec<_> =
        statement.table.young_modulus.and_then(|e| YOUNG_MODULUS.warning(e)).into_iter().collect();
    for given in statement.states.iter().flatten() {
        if let Source::Code(ground) = &given.source {
            let tc = ground.t_c / ground.period_factor;
            found.extend(F0.warning(ground.f0).into_iter().chain(TC.warning(tc)));
        }
        let (name, period) = match given.building_period {
            Some(period) => ("building_period", Some(period)),
            None => ("period of the building", given.modes.first().map(|mode| mode.period)),
        };
        found.extend(period.and_then(|period| Usual::period(name).warning(period)));
    }
    found.extend(floors.into_iter().flat_map(Floors::improbable));
    found
}

/// What the printed `a_Z` lets pass: an acceleration below that of the ground.
pub(super) fn of_demands(statement: &Statement, demands: &Demands) -> Vec<String> {
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

/// What the curve of a side leaves to be known.
pub(super) fn of_curve(curve: &Curve, case: &Case<'_>) -> Vec<String> {
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
pub(super) fn of_untied_side(case: &Case<'_>, sides: &SideVerdicts, governs: Side) -> Option<String> {
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

/// Where runs rock as the scene does, and the static checks do not.
pub(super) fn of_rocking(statement: &Statement, scene: &Parameters) -> Option<String> {
    let stated = statement.table.rocking?.rocking();
    (stated != scene.rocking).then(|| {
        format!(
            "the static checks take rocking = {} of [check], the runs rocking = {} of the scene; state the \
             same in [impact]",
            stated.name(),
            scene.rocking.name()
        )
    })
}

/// Where a spectrum at a height is below that of the ground at T0.
pub(super) fn of_side(side: &SideVerdict, statement: &Statement, demands: &Demands) -> Vec<String> {
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
pub(super) fn of_verdict(case: &Case<'_>, sides: &SideVerdicts, passed: bool) -> Vec<String> {
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

pub(super) fn of_periods(sides: &SideVerdicts) -> impl Iterator<Item = String> {
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
pub(super) fn of_sensitivity(case: &Case<'_>, sides: &SideVerdicts) -> Vec<String> {
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
