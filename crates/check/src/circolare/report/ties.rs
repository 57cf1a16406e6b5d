//! The tie: what its bar makes of it, where it yields and breaks, and the forces of its anchors.

use super::loads::of_tie;
use super::{SideLedger, by_side};
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::curve::tie::{TieState, add_bar};
use crate::circolare::outcome::Checked;
use crate::words::ledger::Ledger;
use crate::words::markup::{heads, paragraph, table};
use crate::words::names::Deciding;
use crate::words::{Language, Sentence, say};

/// The section; empty unless the wall has a tie on a side to which it rocks.
pub(super) fn section(case: &Checked<'_>, sides: &[SideLedger<'_>], language: Language) -> String {
    let of_sides = by_side(case, sides, language, |one| {
        if one.verdict.tie.is_none() {
            return String::new();
        }
        one.ledger.markup("tie", language)
            + &forces(case, one, language)
            + &of_several(one, language)
            + &one.ledger.markup("required", language)
            + &required(case, one, language)
            + &one.ledger.markup("untied", language)
    });
    if of_sides.is_empty() {
        return of_sides;
    }
    let apart = say! {
        "The plate, the masonry around it and the connections are verified apart for these forces.",
        "Il capochiave, la muratura circostante e i collegamenti si verificano a parte per questi tiri."
    };
    let whole = case.lowest();
    let bars = whole.parameters.ties().map(|tie| {
        let mut bar = Ledger::default();
        add_bar(&whole.parameters.tied_by(tie), &mut bar);
        let (which, bar) = (of_tie(whole, &tie), bar.markup("", language));
        if which.is_empty() || bar.is_empty() {
            return bar;
        }
        let head = say!("Bar{which}", "Barra{which}", which);
        format!("<h3>{}</h3>{bar}", head.markup(language))
    });
    bars.collect::<String>() + &of_sides + &paragraph(&apart, language)
}

/// The forces of several ties, and what each would need alone.
fn of_several(one: &SideLedger<'_>, language: Language) -> String {
    let mut rows = Vec::new();
    for tie in &one.verdict.ties {
        let mut row = |place: Sentence, force: f64, state: Sentence| {
            let height = language.shown(one.level.above_base(tie.height));
            let force = language.shown(1e-3 * force);
            rows.push([height, place.markup(language), force, state.markup(language)]);
        };
        if tie.at_activation > 0.0 {
            let place = say!("Activation", "Attivazione del meccanismo");
            row(place, tie.at_activation, TieState::AtStrength.words());
        }
        for (state, at) in &tie.limits {
            row(Sentence::same(format!("d_{state}")), at.force, at.state.words());
            let place = say!("Demand of {state}, S_d", "Domanda allo {state}, S_d", state);
            row(place, at.force_at_demand, at.state_at_demand.words());
        }
        for (check, required) in [Deciding::Sld, Deciding::SlvWithQ].into_iter().zip(tie.required) {
            let Some(force) = required else { continue };
            let place = say!("Required of it alone, {check}", "Tiro richiesto se sola, {check}", check);
            row(place, force, Sentence::default());
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let parts = [
        say!("tie at [m]", "catena a [m]"),
        say!("where", "dove"),
        Sentence::same("`N` [kN]"),
        say!("state", "stato"),
    ];
    table(&heads(parts, language), &rows)
}

/// A force of the tie in all and per metre, and of each anchor where the bar is known: cells of a row.
fn cells(case: &Checked<'_>, side: &SideVerdict, force: f64, language: Language) -> String {
    let of_anchor = side.curve.anchors.map(|anchors| force / anchors);
    let all = [force, force / case.parameters.width].into_iter().chain(of_anchor);
    all.map(|force| language.shown(1e-3 * force)).collect::<Vec<_>>().join("</td><td>")
}

/// The headings of those cells between others.
fn between(side: &SideVerdict, before: &[Sentence], after: &[Sentence], language: Language) -> Vec<String> {
    let forces = [
        Sentence::same("`N` [kN]"),
        Sentence::same("`N/l` [kN/m]"),
        say!("one anchor [kN]", "un ancoraggio [kN]"),
    ];
    let count = if side.curve.anchors.is_some() { 3 } else { 2 };
    let all = before.iter().chain(&forces[..count]).chain(after);
    all.map(|head| head.markup(language)).collect()
}

/// The forces of the tie at the activation, the limit states and their demands.
fn forces(case: &Checked<'_>, one: &SideLedger<'_>, language: Language) -> String {
    let (side, mut rows) = (one.verdict, Vec::new());
    if !side.ties.is_empty() {
        return String::new();
    }
    let mut row = |place: Sentence, d: Option<f64>, force: f64, state: Sentence| {
        let d = language.or_dash(d.map(|d| 1e3 * d));
        rows.push([place.markup(language), d, cells(case, side, force, language), state.markup(language)]);
    };
    if side.activation.force > 0.0 {
        let place = say!("Activation", "Attivazione del meccanismo");
        row(place, None, side.activation.force, TieState::AtStrength.words());
    }
    for (state, check) in side.by_displacement() {
        let Some(tie) = check.tie else { continue };
        row(Sentence::same(format!("d_{state}")), Some(check.d), tie.force, tie.state.words());
        let place = say!("Demand of {state}, S_d", "Domanda allo {state}, S_d", state);
        row(place, Some(check.demand), tie.force_at_demand, tie.state_at_demand.words());
    }
    if let Some(strength) = side.curve.tie().and_then(|tie| tie.strength) {
        let place = say!("Strength of the tie", "Resistenza della catena");
        row(place, None, strength, Sentence::default());
    }
    let before = [
        say!("force of the tie, of anchor and bar", "tiro della catena, di ancoraggio e barra"),
        Sentence::same("`d` [mm]"),
    ];
    table(&between(side, &before, &[say!("state", "stato")], language), &rows)
}

/// The strength that brings `ζ_E` of the checks at the activation to 1.
fn required(case: &Checked<'_>, one: &SideLedger<'_>, language: Language) -> String {
    let side = one.verdict;
    let checks = side.checks;
    let all = [(Deciding::Sld, checks.sld), (Deciding::SlvWithQ, checks.slv_q)].into_iter();
    let rows: Vec<_> = all
        .filter_map(|(check, found)| {
            let name = say!("{check}", "{check}", check).markup(language);
            Some([name, cells(case, side, found?.required?, language)])
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let before = [say!("required force, at the activation", "tiro richiesto, all'attivazione")];
    table(&between(side, &before, &[], language), &rows)
}
