//! The hinges: what each rule on the hinge of a strip gives, and how far hinges are set back.

use super::{SideLedger, by_side};
use crate::circolare::outcome::Checked;
use crate::circolare::statement::table::Hinge;
use crate::words::markup::{heads, table};
use crate::words::names::Deciding;
use crate::words::{Language, Sentence, say};

/// The section; empty unless the wall is a strip or its hinges are set back.
pub(super) fn section(case: &Checked<'_>, sides: &[SideLedger<'_>], language: Language) -> String {
    by_side(case, sides, language, |one| {
        let set_back = one.ledger.markup("set-back", language);
        rules(case, one, language) + &set_back
    })
}

/// What each rule on the hinge gives, and where the hinge of each check is.
fn rules(case: &Checked<'_>, one: &SideLedger<'_>, language: Language) -> String {
    let side = one.verdict;
    let (Some(rule), Some(found)) = (case.rule, side.least_alpha0) else { return String::new() };
    let row = |own: Hinge, words: Sentence, at: Option<f64>, zeta: Option<f64>| {
        let name = words.markup(language);
        let taken = crate::words::said(rule == own).markup(language);
        [name, language.or_dash(at), language.or_dash(zeta), taken]
    };
    let words = say!("Hinge of the least multiplier", "Cerniera del moltiplicatore minimo");
    let mut rows = vec![row(Hinge::LeastAlpha0, words, Some(found.hinge), found.zeta)];
    let words = say!("Least favourable hinge", "Cerniera più sfavorevole");
    rows.push(row(Hinge::Worst, words, found.worst_hinge, found.worst));
    if rule == Hinge::Given {
        let zeta = Some(side.checks.governing(case.statement).zeta).filter(|zeta| zeta.is_finite());
        let words = say!("Hinge as given", "Cerniera come fornita");
        rows.push(row(Hinge::Given, words, side.curve.hinge, zeta));
    }
    let parts = [
        say!("rule of the hinge", "criterio per la cerniera"),
        Sentence::same("`h_1/h`"),
        say!("least ζ_E that decides", "ζ_E minimo determinante"),
        say!("taken", "adottata"),
    ];
    let mut text = table(&heads(parts, language), &rows);
    text += &one.ledger.markup("hinges", language);
    if rule == Hinge::Worst {
        let checks = side.checks;
        let made = Deciding::ALL.into_iter().zip(checks.zetas()).filter(|(_, zeta)| zeta.is_finite());
        let row = |(check, zeta): (Deciding, f64)| {
            let name = say!("{check}", "{check}", check).markup(language);
            [name, language.or_dash(checks.hinge(check)), language.shown(zeta)]
        };
        let rows: Vec<_> = made.map(row).collect();
        let parts = [
            say!("check, each with its own hinge", "verifica, ognuna con la sua cerniera"),
            Sentence::same("`h_1/h`"),
            Sentence::same("ζ_E"),
        ];
        text += &table(&heads(parts, language), &rows);
    }
    text
}
