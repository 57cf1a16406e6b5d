//! What the engineer should know of a check that can be made.

use std::collections::BTreeSet;

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Parameters, Wall};
use scene::Floors;

use super::{Checked, loads, ranges, turns};
use crate::circolare::checks::DisplacementCheck;
use crate::circolare::checks::sides::{LeastAlpha0, SideVerdict, SideVerdicts};
use crate::circolare::curve::Curve;
use crate::circolare::curve::case::Case;
use crate::circolare::statement::Statement;
use crate::circolare::statement::table::{AtActivation, Hinge, LARGEST_CONFIDENCE_FACTOR, UseClass};
use crate::ntc::demand::{Demands, LONGEST_PERIOD};
use crate::words::names::{LimitState, Side};
use crate::words::others::{self, improbable};
use crate::words::{Sentence, apart, fixed, passed, say};

/// Share by which a searched hinge is said to be less favourable than the one given \[-\].
const LOWER: f64 = 0.01;

/// All warnings of a check in their order, each once; `scene` is the wall of the runs.
pub(crate) fn all(case: &Case<'_>, checked: &Checked<'_>, scene: &Parameters) -> Vec<Sentence> {
    let Checked { statement, wall, demands, outcome, .. } = checked;
    let floors = checked.floors.as_deref();
    // what a level cuts out of the wall nobody has stated
    let stated = statement.with_bar(scene).unwrap_or_else(|_| checked.parameters.clone());
    let (sides, governs) = (&outcome.sides, outcome.governs.side);
    // sides that are alike are named once
    let differing = || sides.iter().take(if case.alike { 1 } else { 2 });
    let ordered: [Vec<Sentence>; 13] = [
        of_states(statement, floors),
        of_statement(statement, &stated, floors, wall),
        loads::warnings(case, outcome.dynamic.is_some()),
        ranges::of_statement(statement).into_iter().chain(ranges::of_crack(case)).collect(),
        of_demands(statement, demands),
        differing().flat_map(|(side, verdict)| of_hinges(case, side, verdict)).collect(),
        differing().flat_map(|(_, verdict)| of_side(verdict, statement, demands)).collect(),
        of_untied_side(case, sides, governs).into_iter().collect(),
        of_periods(sides, demands),
        turns::by_raise(case, sides, outcome.passed),
        turns::by_sensitivity(case, sides),
        outcome.dynamic.iter().filter_map(|_| statement.differs_in_rocking(scene)).collect(),
        outcome.dynamic.iter().flat_map(|dynamic| dynamic.warnings(case)).collect(),
    ];
    let mut seen = BTreeSet::new();
    ordered.into_iter().flatten().filter(|warning| seen.insert(warning.clone())).collect()
}

/// What does not go together among the limit states.
fn of_states(statement: &Statement, floors: Option<&Floors>) -> Vec<Sentence> {
    let mut warnings = Vec::new();
    let mut below: Option<(LimitState, f64)> = None;
    for given in statement.states.iter().flatten() {
        if let Some((state, ag)) = below.filter(|(_, ag)| *ag >= given.ag) {
            warnings.push(say! {
                "a_g does not rise from {state} to {next}: {ag} and {then} g",
                "a_g non cresce da {state} a {next}: {ag} e {then} g",
                state, next = given.state, ag, then = given.ag
            });
        }
        below = Some((given.state, given.ag));
    }
    let on_ground = floors.is_none() && statement.table.building.is_none();
    for given in statement.states.iter().flatten().filter(|_| on_ground) {
        if given.building_damping.is_some() || given.building_period.is_some() {
            warnings.push(say! {
                "{state}: building_damping and building_period have no effect without [check.building]",
                "{state}: building_damping e building_period non hanno effetto senza [check.building]",
                state = given.state
            }.on_page(say! {
                "{state}: damping and period of the building have no effect on the ground",
                "{state}: smorzamento e periodo dell'edificio non hanno effetto al suolo", state = given.state
            }));
        }
    }
    warnings
}

fn of_statement(
    statement: &Statement,
    parameters: &Parameters,
    floors: Option<&Floors>,
    wall: &Wall,
) -> Vec<Sentence> {
    let mut warnings = Vec::new();
    let body = wall.body();
    if statement.table.overburden_mass.is_some()
        && (body.overburden == 0.0 || body.mechanism != Mechanism::Parapet)
    {
        warnings.push(
            say! {
                "overburden_mass has no effect: it is for a parapet with overburden",
                "overburden_mass non ha effetto: vale per un parapetto con carico in sommità"
            }
            .on_page(say! {
                "the mass of the overburden has no effect: it is for a parapet with overburden",
                "la massa del carico non ha effetto: vale per un parapetto con carico in sommità"
            }),
        );
    }
    let is_at_edges = parameters.a3 == 1.0 && parameters.multilinear.is_none() && statement.masonry.is_none();
    if statement.table.compression_considered && is_at_edges {
        warnings.push(say! {
            "compression_considered with a3 = 1 puts the hinges at the edges: give the reduced thickness",
            "compression_considered con a3 = 1 lascia le cerniere agli spigoli: fornire lo spessore ridotto"
        }.on_page(say! {
            "compression is stated as considered, and the hinges are at the edges of the thickness given",
            "la compressione è dichiarata considerata e le cerniere sono agli spigoli dello spessore fornito"
        }));
    }
    let of_wall = parameters.unusual();
    warnings.extend(of_wall.chain(statement.improbable(floors)).map(|warning| improbable(&warning)));
    let factor = statement.confidence_factor;
    if factor > LARGEST_CONFIDENCE_FACTOR {
        warnings.push(say! {
            "FC = {factor} is above that of LC1, 1.35 (C8.5.4)",
            "FC = {factor} è superiore a quello di LC1, 1,35 (C8.5.4)", factor
        });
    }
    if statement.table.building.is_some() && floors.is_some() {
        warnings.push(say! {
            "the static checks use [check.building]; runs under records use [[storeys]]",
            "le verifiche statiche usano [check.building]; le analisi con accelerogrammi usano [[storeys]]"
        }.on_page(say! {
            "the static checks use the building of the check, runs under records its storeys",
            "le verifiche statiche usano l'edificio della verifica, le analisi dinamiche i suoi piani"
        }));
    }
    if statement.table.use_class == Some(UseClass::IV) && statement.state(LimitState::Sld).is_none() {
        warnings.push(
            say! {
                "use class IV is checked for SLD too (NTC 8.3); give [check.SLD]",
                "in classe d'uso IV si verifica anche lo SLD (NTC 8.3); fornire [check.SLD]"
            }
            .on_page(say! {
                "use class IV is checked for SLD too (NTC 8.3), whose hazard is not given",
                "in classe d'uso IV si verifica anche lo SLD (NTC 8.3), i cui dati non sono forniti"
            }),
        );
    }
    warnings.extend(floors.and_then(|floors| floors.heavy(wall)).map(|heavy| {
        say! {
            "{heavy}; the check is then on the safe side (C8.7.1.2.1.4)",
            "{heavy}; la verifica è allora a favore di sicurezza (C8.7.1.2.1.4)", heavy = others::heavy(heavy)
        }
    }));
    warnings
}

/// What the printed `a_Z` lets pass: an acceleration below that of the ground.
fn of_demands(statement: &Statement, demands: &Demands) -> Vec<Sentence> {
    let below = statement.demanded(demands).filter_map(|(given, demand)| {
        let floor = demand.floor()?;
        let (place, ground) = (floor.printed_peak(), floor.ground().acceleration(0.0, 0.05));
        let is_below = place < ground && !statement.bounds_heights();
        is_below.then(|| {
            let [place, ground] = apart([place, ground], 5);
            say! {
                "{state}: a_Z = {place} m/s² is below a_g S = {ground} m/s² of the ground",
                "{state}: a_Z = {place} m/s² è inferiore ad a_g S = {ground} m/s² del suolo",
                state = given.state, place, ground
            }
        })
    });
    below.collect()
}

/// What the curve of a side and its hinge leave to be known.
fn of_hinges(case: &Case<'_>, side: Side, verdict: &SideVerdict) -> Vec<Sentence> {
    let (mut warnings, side) = (of_curve(case, &verdict.curve), case.told(side));
    warnings.extend(verdict.unsearched.as_ref().map(|error| {
        say! {
            "{side}: other hinges could not be searched: {error}",
            "{side}: non è stato possibile cercare altre cerniere: {error}", side, error
        }
    }));
    let searched = verdict.least_alpha0.filter(|found| found.worst_check.is_some());
    if let Some(found) = searched {
        warnings.extend(of_rules(case, &side, verdict, found));
        warnings.extend(of_place(case, &side, verdict));
    }
    warnings
}

/// Where another rule on the hinge gives another verdict.
fn of_rules(case: &Case<'_>, side: &Sentence, verdict: &SideVerdict, found: LeastAlpha0) -> Option<Sentence> {
    let own = verdict.checks.governing(case.statement).zeta;
    let [least, lowest] = [found.zeta, found.worst].map(|zeta| zeta.unwrap_or(f64::INFINITY));
    let place = fixed(found.worst_hinge.unwrap_or(f64::NAN), 4);
    let passes = |zeta: f64| zeta >= case.statement.target;
    let turns = passes(lowest) != passes(own);
    match case.rule? {
        Hinge::Given if turns || lowest < own * (1.0 - LOWER) => {
            let said = say! {
                "{side}: the hinge is given at {given}; at {place} {check} has zeta_E = {zeta}, {result}",
                "{side}: la cerniera è fornita a {given}; a {place} {check} ha ζ_E = {zeta}, {result}",
                side, given = case.parameters.hinge_ratio, place, check = found.worst_check?,
                zeta = fixed(lowest, 3), result = passed(passes(lowest))
            };
            let remedy = say! {
                "{said}; state hinge = \"worst\"", "{said}; dichiarare hinge = \"worst\"", said
            };
            Some(remedy.on_page(said))
        }
        Hinge::Worst | Hinge::LeastAlpha0 if passes(lowest) != passes(least) => Some(say! {
            "{side}: the hinge turns the verdict: {lowest}, {one}, at the least favourable hinge {place}; \
             {least}, {other}, at that of the least alpha0, {hinge}",
            "{side}: la cerniera cambia l'esito: {lowest}, {one}, con la cerniera più sfavorevole {place}; \
             {least}, {other}, con quella del minimo α0, {hinge}",
            side, one = passed(passes(lowest)), other = passed(passes(least)), lowest = fixed(lowest, 3),
            least = fixed(least, 3), place, hinge = fixed(found.hinge, 4)
        }),
        _ => None,
    }
}

/// Where the hinge that governs is at an end of its range, or so near an end of the wall that a body is
/// squat.
fn of_place(case: &Case<'_>, side: &Sentence, verdict: &SideVerdict) -> Vec<Sentence> {
    let mut warnings = Vec::new();
    let hinge = verdict.checks.hinge(verdict.checks.governing(case.statement).check);
    let [from, to] = case.statement.hinge_range;
    let is_end = |x: &f64| (x - from).abs() < 1e-9 || (x - to).abs() < 1e-9;
    if let Some(at) = hinge.filter(is_end).filter(|_| case.rule != Some(Hinge::Given)) {
        warnings.push(say! {
            "{side}: the hinge that governs, {at}, is at an end of hinge_range = [{from}, {to}]",
            "{side}: la cerniera determinante, {at}, è a un estremo di hinge_range = [{from}; {to}]",
            side, at, from, to
        }.on_page(say! {
            "{side}: the hinge that governs, {at} h, is at an end of the range from {from} h to {to} h",
            "{side}: la cerniera determinante, {at} h, è a un estremo dell'intervallo da {from} h a {to} h",
            side, at, from, to
        }));
    }
    let Parameters { height, thickness, .. } = case.parameters;
    let at = hinge.unwrap_or(0.5);
    let shortest = height * at.min(1.0 - at);
    if shortest < thickness {
        let [shortest, _] = apart([shortest, thickness], 4);
        warnings.push(say! {
            "{side}: with the hinge at {at} a body is {shortest} m high, lower than b = {thickness} m: small \
             rotations no longer hold",
            "{side}: con la cerniera a {at} un corpo è alto {shortest} m, meno di b = {thickness} m: le \
             piccole rotazioni non valgono più", side, at = fixed(at, 4), shortest, thickness
        });
    }
    warnings
}

fn of_curve(case: &Case<'_>, curve: &Curve) -> Vec<Sentence> {
    let statement = case.statement;
    let mut warnings = Vec::new();
    if curve.tie().is_some_and(|tie| tie.strength_displacement().is_none()) {
        warnings.push(
            say! {
                "the tie has no tie_strength: it never breaks and is counted at d_SLV and d_SLC",
                "la catena è senza tie_strength: non si rompe ed è contata a d_SLV e d_SLC"
            }
            .on_page(say! {
                "no strength of the tie is given: it never breaks and is counted at d_SLV and d_SLC",
                "la resistenza della catena non è fornita: non si rompe ed è contata a d_SLV e d_SLC"
            }),
        );
    }
    warnings.extend(ranges::of_tie(case, curve));
    let makes = |state: LimitState| statement.state(state).is_some();
    if makes(LimitState::Sld) || makes(LimitState::Slv) {
        warnings.extend(of_tie(case, curve));
    }
    warnings
}

/// A side that the tie of the wall does not hold, and whether it governs.
fn of_untied_side(case: &Case<'_>, sides: &SideVerdicts, governs: Side) -> Option<Sentence> {
    let has_tie = case.parameters.ties().any(|tie| tie.stiffness > 0.0);
    let (untied, _) = sides.iter().find(|(_, side)| has_tie && side.tie.is_none())?;
    let which = if untied == governs {
        say!("; the side without a tie governs", "; è determinante il verso senza catena")
    } else {
        Sentence::default()
    };
    Some(say! {
        "{side}: no tie holds this side{which}",
        "{side}: nessuna catena trattiene questo verso{which}", side = case.told(untied), which
    })
}

/// What the tie leaves out at the activation.
fn of_tie(case: &Case<'_>, curve: &Curve) -> Option<Sentence> {
    let tie = curve.tie()?;
    let has_q = case.statement.behaviour_factor > 1.0;
    match case.statement.at_activation() {
        AtActivation::None => Some(say! {
            "SLD and SLV with q do not count the tie; state [check.tie] at_activation = \"yield\" for a \
             tight tie that acts at the activation",
            "SLD e SLV con q non considerano la catena; dichiarare [check.tie] at_activation = \"yield\" per \
             una catena tesa attiva all'attivazione"
        }.on_page(say! {
            "SLD and SLV with q do not count the tie", "SLD e SLV con q non considerano la catena"
        })),
        AtActivation::Yield if has_q && tie.ultimate == Some(0.0) => Some(say! {
            "SLV with q counts a brittle tie (tie_ultimate = 0), and q > 1 asks for one that yields",
            "SLV con q considera una catena fragile (tie_ultimate = 0), mentre q > 1 ne richiede una duttile"
        }.on_page(say! {
            "SLV with q counts a brittle tie, and q > 1 asks for one that yields",
            "SLV con q considera una catena fragile, mentre q > 1 ne richiede una duttile"
        })),
        AtActivation::Yield => None,
    }
}

/// Where a spectrum at a height is below that of the ground at T0.
fn of_side(side: &SideVerdict, statement: &Statement, demands: &Demands) -> Vec<Sentence> {
    let mut warnings = Vec::new();
    for (given, demand) in statement.demanded(demands) {
        let Some(floor) = demand.floor() else { continue };
        let (xi, t0) = (LimitState::Sld.damping(), side.curve.t0);
        let (above, ground) = (floor.acceleration(t0, xi), floor.ground().acceleration(t0, xi));
        if t0 > 0.0 && t0 < floor.first_period() && above < ground {
            let [above, ground] = apart([above, ground], 5);
            warnings.push(say! {
                "{state}: S_eZ(T0) = {above} m/s² is below S_e(T0) = {ground} m/s² of the ground",
                "{state}: S_eZ(T0) = {above} m/s² è inferiore a S_e(T0) = {ground} m/s² del suolo",
                state = given.state, above, ground
            });
        }
    }
    warnings
}

/// Where the demand is beyond the spectra of accelerations.
fn of_periods(sides: &SideVerdicts, demands: &Demands) -> Vec<Sentence> {
    let by_code =
        |state: LimitState| demands[state as usize].as_ref().is_some_and(|demand| demand.ground().is_some());
    let checks = sides.iter().flat_map(|(_, side)| side.by_displacement());
    let long = checks.filter(|(state, check)| check.period > LONGEST_PERIOD && by_code(*state));
    let said = long.map(|(state, DisplacementCheck { period, .. })| {
        say! {
            "T_{state} = {period} s: NTC 3.2.3.2 admits the spectra of accelerations up to 4 s; that of \
             displacements, [3.2.10] to [3.2.12], is printed for all periods",
            "T_{state} = {period} s: NTC 3.2.3.2 ammette gli spettri in accelerazione fino a 4 s; quello in \
             spostamento, da [3.2.10] a [3.2.12], è scritto per ogni periodo",
            state, period = fixed(period, 3)
        }
    });
    said.collect()
}
