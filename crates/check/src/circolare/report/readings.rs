//! Where the code can be read in two ways: the reading that this check takes.

use crate::circolare::{Checked, Demand, Source};

use crate::report::markup::formula;

fn any_demand(case: &Checked<'_>, holds: fn(&Demand) -> bool) -> bool {
    case.demands.iter().flatten().any(holds)
}

fn is_at_height(case: &Checked<'_>) -> bool {
    any_demand(case, |demand| demand.floor().is_some())
}

/// Returns whether there is a check of accelerations of a side whose T0 fulfils a condition.
fn is_activated(case: &Checked<'_>, such: fn(f64) -> bool) -> bool {
    let sides = case.outcome.sides.iter();
    sides
        .map(|(_, side)| side)
        .any(|side| (side.checks.sld.is_some() || side.checks.slv_q.is_some()) && such(side.curve.t0))
}

fn is_by_code(case: &Checked<'_>) -> bool {
    case.statement.states.iter().flatten().any(|given| matches!(given.source, Source::Code(_)))
}

/// A test whether a reading bears on a check, and the reading with its formulas in braces.
type Reading = (fn(&Checked<'_>) -> bool, &'static str);

const READINGS: [Reading; 13] = [
    (
        |_| true,
        "Lumping: the definitions of C8.7.1.1 speak of one resultant of the forces on each body, and the \
         check takes one. Distributed mass would give larger capacities.",
    ),
    (
        is_at_height,
        "Units of {ξ_k}: [C7.2.6] and [C7.2.9] are printed with per cent. Taken as a fraction in \
         {ξ_k}<sup>−0.5</sup> and as per cent elsewhere; otherwise the spectrum dips at resonance.",
    ),
    (
        |_| true,
        "FC: [C8.7.1.3] has it in {a}, so that it lengthens {T_SLV} and {T_SLC}. {d_0}, {d_SLV}, {d_SLC} \
         and {T0} are free of it.",
    ),
    (
        |case| is_activated(case, |t0| t0 > 0.0),
        "[C8.7.1.9] divides {a_y} by FC, which {a(d)} already has. {a_y} is read on the curve without FC \
         and divided once.",
    ),
    (
        |case| is_activated(case, |t0| t0 == 0.0) && is_at_height(case),
        "Demand of the wall that is held: C8.7.1.2.1.5 points to [C7.2.11], C8.7.1.2.1.7 to [C7.2.8]. \
         [C7.2.11] is for frames. Taken: [C7.2.8].",
    ),
    (
        is_by_code,
        "Scaling: {S_S} and {T_D} depend on {a_g}; {F0} and {T_C*} on the return period. Taken: the shape \
         at the {a_g} of the site, so that {ζ_E} is a ratio. SLV with {q} takes the shape of SLV, the \
         floor of SLD that of SLD.",
    ),
    (
        |case| {
            case.outcome.sides.iter().any(|(_, side)| side.checks.sld.is_some() && side.checks.slc.is_some())
        },
        "The rule that the acceleration of activation at SLD is the least one is printed for SLV. It is \
         taken for SLC, too.",
    ),
    (
        |case| case.wall.tie().is_some(),
        "A tie: actions that last until collapse are asked for {d_0} only. {a(d)} is the curve as it is at \
         {d_SLV}; at the rupture of the tie it is the value just before.",
    ),
    (
        |case| any_demand(case, |demand| matches!(demand, Demand::Floor(floor) if floor.modes().len() > 1)),
        "{T_1} in the conditions of [C7.2.5] and [C8.7.1.12]: with several modes it is that of the first.",
    ),
    (
        is_at_height,
        "Height {z}: not defined for walls; taken as given. The base of a parapet and the mid-height of a \
         strip wall are recommended.",
    ),
    (
        |case| any_demand(case, |demand| matches!(demand, Demand::Points(..) | Demand::Records(_))),
        "Spectra that are given, or of records: the largest {S_d} from {T0} to {T_SLV} (SLC likewise), of \
         the mean spectrum of 7 and more records, of the envelope of fewer.",
    ),
    (
        |case| case.outcome.dynamic.is_some(),
        "Runs under records: the skeleton is the capacity curve, which contains FC. Gravity, overburden, \
         stiffness and strength of a tie are divided by FC; masses and thresholds are not.",
    ),
    (
        |_| true,
        "Scope: {α} is linear in the displacement (small rotations). Friction of transverse walls \
         [C8.7.1.2] and sliding are not included; the height of the wall is the engineer's.",
    ),
];

/// The readings that bear on this check, as markup.
pub(in crate::circolare) fn of(case: &Checked<'_>) -> Vec<String> {
    READINGS.into_iter().filter(|(bears, _)| bears(case)).map(|(_, text)| filled(text)).collect()
}

/// The text with the formulas in its braces as markup.
fn filled(text: &str) -> String {
    let part = |part: &str| match part.split_once('}') {
        Some((symbols, after)) => formula(symbols) + after,
        None => part.to_owned(),
    };
    text.split('{').map(part).collect()
}
