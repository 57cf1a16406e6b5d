//! What turns a verdict: the raise by SLD, and another a₁ or E.

use crate::circolare::checks::sides::SideVerdicts;
use crate::circolare::curve::case::Case;
use crate::circolare::statement::table::Method;
use crate::words::names::{Deciding, LimitState};
use crate::words::{Sentence, fixed, passed, say};

/// What a verdict owes to the raise by SLD, or lacks without it.
pub(super) fn by_raise(case: &Case<'_>, sides: &SideVerdicts, passes: bool) -> Vec<Sentence> {
    let (mut warnings, statement) = (Vec::new(), case.statement);
    let (decides, target) = (statement.table.method != Method::Linear, statement.target);
    for (side, verdict) in sides.iter() {
        let side = case.told(side);
        for (state, found) in verdict.by_displacement().filter(|(_, found)| found.ratio < target) {
            let [ratio, zeta] = [found.ratio, found.zeta].map(|value| fixed(value, 3));
            let is_broken = verdict.activation.force > 0.0 && found.has_broken_tie;
            if statement.state(LimitState::Sld).is_none() && state == LimitState::Slv {
                warnings.push(say! {
                    "{side}: {state} by displacement is {ratio}; without [check.SLD] no a_g of activation \
                     raises it (C8.7.1.2.1.8)",
                    "{side}: {state} in spostamento vale {ratio}; senza [check.SLD] nessuna a_g di \
                     attivazione lo innalza (C8.7.1.2.1.8)", side, state, ratio
                }.on_page(say! {
                    "{side}: {state} by displacement is {ratio}; without SLD no a_g of activation raises it \
                     (C8.7.1.2.1.8)",
                    "{side}: {state} in spostamento vale {ratio}; senza lo SLD nessuna a_g di attivazione lo \
                     innalza (C8.7.1.2.1.8)", side, state, ratio
                }));
            } else if state == LimitState::Slc && decides && found.raised && found.zeta < target {
                warnings.push(say! {
                    "{side}: SLC by displacement has zeta_E = {ratio}; {zeta} is by analogy with \
                     C8.7.1.2.1.8, which has the raise for SLV only",
                    "{side}: lo SLC ha ζ_E = {ratio} in spostamento; {zeta} è per analogia con C8.7.1.2.1.8, \
                     che lo prevede per il solo SLV", side, ratio, zeta
                });
            } else if state == LimitState::Slc && statement.table.raise_slc && is_broken {
                warnings.push(say! {
                    "{side}: SLD does not raise SLC: it counts the tie, which is broken at d_SLC",
                    "{side}: lo SLD non innalza lo SLC: considera la catena, che a d_SLC è rotta", side
                });
            } else if passes && decides && found.zeta >= target {
                let only = if state == LimitState::Slc {
                    say!("; the text has the raise for SLV only", "; la norma lo prevede per il solo SLV")
                } else {
                    Sentence::default()
                };
                warnings.push(say! {
                    "{side}: the raise by SLD turns the verdict of {state}: {ratio} by displacement, raised \
                     to {zeta}{only}",
                    "{side}: lo SLD cambia l'esito di {state}: {ratio} in spostamento, portato a \
                     {zeta}{only}", side, state, ratio, zeta, only
                });
            }
            if state == LimitState::Slv && found.raised && is_broken {
                warnings.push(say! {
                    "{side}: SLV has {zeta} by SLD, which counts the tie; at d_SLV the tie is broken. The \
                     letter of C8.7.1.2.1.8 admits it; by displacement it is {ratio}",
                    "{side}: lo SLV vale {zeta} per lo SLD, che considera la catena; a d_SLV la catena è \
                     rotta. La lettera di C8.7.1.2.1.8 lo ammette; in spostamento vale {ratio}",
                    side, zeta, ratio
                });
            }
        }
    }
    warnings
}

/// Where another a₁ or E turns the verdict on a side: which check turns, and whether the wall does.
pub(super) fn by_sensitivity(case: &Case<'_>, sides: &SideVerdicts) -> Vec<Sentence> {
    let statement = case.statement;
    if statement.table.method == Method::Dynamic {
        // the runs decide, and no a₁ of theirs is varied
        return Vec::new();
    }
    let mut warnings = Vec::new();
    let passes = |zeta: f64| zeta >= statement.target;
    for (name, side) in sides.iter() {
        for (index, varied) in side.sensitivity.iter().enumerate() {
            let (own, zetas) = (side.checks.zetas(), varied.zetas);
            let is_turned =
                |at: &usize| statement.decides(Deciding::ALL[*at]) && passes(own[*at]) != passes(zetas[*at]);
            let holds = passes(side.checks.governing(statement).zeta);
            let Some(at) = (0..4).find(is_turned).filter(|_| varied.passed == Some(!holds)) else {
                continue;
            };
            let before = sides.iter().all(|(_, side)| passes(side.checks.governing(statement).zeta));
            let after = sides.iter().all(|(_, side)| side.sensitivity[index].passed == Some(true));
            let what = if before == after {
                say! {
                    "turns the verdict on this side, not that on the wall",
                    "cambia l'esito in questo verso, non quello della parete"
                }
            } else {
                say!("turns the verdict", "cambia l'esito")
            };
            let said = |parameter: &str| {
                say! {
                    "{side}: {parameter} {what}: with {assigned} {check} goes from {from} to {to}, {result}",
                    "{side}: {parameter} {what}: con {assigned} lo {check} passa da {from} a {to}, {result}",
                    side = case.told(name), parameter, what,
                    assigned = varied.assigned(), check = Deciding::ALL[at], from = fixed(own[at], 3),
                    to = fixed(zetas[at], 3), result = passed(!holds)
                }
            };
            let symbol = if varied.parameter == "young_modulus" { "E" } else { varied.parameter };
            warnings.push(said(varied.parameter).on_page(said(symbol)));
        }
    }
    warnings
}
