//! The dynamic check: its runs.

use crate::circolare::curve::ledger::gives;
use crate::circolare::outcome::Checked;
use crate::circolare::runs::{DynamicRun, DynamicState};
use crate::circolare::statement::table::RecordScale;
use crate::ntc::demand::MEAN_COUNTS_FROM;
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::markup::{as_written, heads, paragraph, table};
use crate::words::names::{LimitState, Side};
use crate::words::{Language, Sentence, Written, passed, said, say, shown, side as told_side};

/// The section of the dynamic check; empty without one.
pub(super) fn section(case: &Checked<'_>, language: Language) -> String {
    let Some(dynamic) = case.outcome.dynamic.as_ref() else { return String::new() };
    let said = say! {
        "The wall of the scene, with its damping, restitution and one-sided rocking, moves under each \
         record, with both signs unless stated otherwise. FC = {factor} divides its forces (gravity, \
         overburden, tie), not its masses. The check is passed if no run exceeds d_0 or fails by its tie, \
         and the mean of the largest |`d`| over the threshold of its side (of fewer than {count} records the \
         largest, NTC 7.3.5) is at most 1. ζ_E is the lowest factor on all records that fails, searched \
         upwards.",
        "La parete, con il suo smorzamento, la restituzione e l'eventuale vincolo monolatero, si muove sotto \
         ogni accelerogramma, con entrambi i versi se non dichiarato altrimenti. FC = {factor} divide le \
         forze (gravità, carico in sommità, catena), non le masse. La verifica è soddisfatta se nessuna \
         analisi supera d_0 o cede per la catena, e se la media dei massimi di |`d`| sulla soglia del suo \
         verso (con meno di {count} accelerogrammi il massimo, NTC 7.3.5) è al più 1. ζ_E è il minimo \
         fattore su tutti gli accelerogrammi che non è sopportato, cercato dal basso.",
        factor = Written(shown(case.statement.confidence_factor)), count = MEAN_COUNTS_FROM
    };
    let states = dynamic.states().map(|(name, state)| one(case, name, state, language));
    paragraph(&said, language) + &states.collect::<String>()
}

fn one(case: &Checked<'_>, name: LimitState, state: &DynamicState, language: Language) -> String {
    let judged = state.judged;
    let mut ledger = Ledger::default();
    let mut thresholds = Vec::new();
    let mm = |d: f64| Written(shown(1e3 * d));
    for (side, verdict) in case.sides() {
        let Some(check) = verdict.displacement(name) else { continue };
        thresholds.push(check.d);
        let side = told_side(case.which(side));
        let words =
            say!("Threshold and zero of the curve, {side}", "Soglia e zero della curva, {side}", side);
        let said = say! {
            "d_{name} = {d} mm, d_0 = {zero} mm",
            "d_{name} = {d} mm, d_0 = {zero} mm", name, d = mm(check.d), zero = mm(verdict.curve.d0)
        };
        ledger.say(words, said.as_markup());
    }
    for (side, threshold) in Side::ALL.into_iter().zip(state.thresholds) {
        // the runs rock as the scene does, to sides that the static checks leave out, too
        let Some(d) = threshold.filter(|_| case.outcome.sides.of(side).is_none()) else { continue };
        let words = say! {
            "Threshold on the side {side}, which the static checks leave out: overturning",
            "Soglia nel verso {side}, escluso dalle verifiche statiche: ribaltamento", side = side.name()
        };
        let said = say!("`(d/u) u_ins` = {d} mm", "`(d/u) u_ins` = {d} mm", d = mm(d));
        ledger.say(words, said.as_markup());
    }
    let words = if case.statement.records.named.len() < MEAN_COUNTS_FROM {
        say!("Largest of the maxima", "Il maggiore dei massimi")
    } else {
        say!("Mean of the maxima", "Media dei massimi")
    };
    ledger.add(Quantity::new("", "d", Unit::MILLIMETRES, judged.d, words).at("NTC 7.3.5"));
    // with sides of different thresholds the ratio is no quotient of these numbers
    if let [threshold] = thresholds[..]
        && gives(threshold / judged.d, judged.ratio)
    {
        ledger.know(&[(&format!("d_{name}"), 1e3 * threshold), ("d", 1e3 * judged.d)]);
    }
    let words =
        say!("Threshold over it, each side by its own", "Soglia divisa per esso, ogni verso con la sua");
    ledger.add(Quantity::new("", format!("d_{name}/d"), Unit::NONE, judged.ratio, words));
    for (words, count) in [
        (say!("Runs beyond the zero of the curve", "Analisi oltre lo zero della curva"), judged.beyond_d0),
        (say!("Runs at the strength of the tie", "Analisi alla resistenza della catena"), judged.at_strength),
    ] {
        ledger.say(words, Sentence::same(format!("<b>{count}</b>/{}", state.runs.len())));
    }
    let words = say! {
        "Lowest factor on all records that fails",
        "Minimo fattore su tutti gli accelerogrammi che non soddisfa"
    };
    ledger.add(Quantity::new("", "ζ_E", Unit::NONE, state.zeta, words).at("NTC 8.3"));
    ledger.say(say!("Result", "Esito"), passed(judged.passed));
    let rows: Vec<_> = state.runs.iter().map(|run| row(run, language)).collect();
    let factor = if case.statement.table.record_scale == RecordScale::Ag {
        say!("factor to `a_g S`", "fattore a `a_g S`")
    } else {
        say!("factor", "fattore")
    };
    let parts = [
        say!("record", "accelerogramma"),
        factor,
        say!("largest d, u > 0 [mm]", "d massimo, u > 0 [mm]"),
        say!("largest d, u < 0 [mm]", "d massimo, u < 0 [mm]"),
        say!("beyond d_0", "oltre d_0"),
    ];
    let table = table(&heads(parts, language), &rows);
    format!("<h3>{name}</h3>\n{}{table}", ledger.markup("", language))
}

fn row(run: &DynamicRun, language: Language) -> [String; 5] {
    let number = |value: f64| language.decimal(&::report::number(value, 4));
    let [positive, negative] = run.d.map(|d| number(1000.0 * d));
    let beyond = said(run.beyond_d0).markup(language);
    let beyond = if run.beyond_d0 { format!("<span class=\"fails\">{beyond}</span>") } else { beyond };
    [as_written(&run.record), number(run.sign * run.factor), positive, negative, beyond]
}
