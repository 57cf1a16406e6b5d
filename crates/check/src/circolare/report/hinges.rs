//! The hinges: what each rule on the hinge of a strip gives, and how far hinges are set back.

use crate::names::{Deciding, Side};
use rocking_wall::variables::Mechanism;

use super::{by_side, calculation};
use crate::circolare::table::{Hinge, STRESS_BLOCK};
use crate::circolare::{Checked, SideVerdict};
use crate::report::markup::{Calculation, formula, or_dash, shown as n, table};

/// The section, if the wall is a strip or its hinges are set back.
pub(super) fn section(case: &Checked<'_>) -> Option<String> {
    let text = by_side(case, |of, side| rules(case, side) + &set_back(case, of, side));
    (!text.is_empty()).then_some(text)
}

/// What each rule on the hinge gives, and where the hinge of each check is.
fn rules(case: &Checked<'_>, side: &SideVerdict) -> String {
    let (Some(rule), Some(found)) = (case.rule, side.least_alpha0) else { return String::new() };
    let some = |value: Option<f64>| or_dash(value, n);
    let taken = |own: Hinge| if rule == own { "yes" } else { "no" }.to_owned();
    let words = |words: &str, key: &str| format!("{words} <small translate=\"no\">{key}</small>");
    let mut rows = vec![
        [
            words("Hinge of the least multiplier", "least_alpha0"),
            n(found.hinge),
            some(found.zeta),
            taken(Hinge::LeastAlpha0),
        ],
        [
            words("Least favourable hinge", "worst"),
            some(found.worst_hinge),
            some(found.worst),
            taken(Hinge::Worst),
        ],
    ];
    if rule == Hinge::Given {
        let zeta = side.checks.governing(case.statement).1;
        let zeta = some(Some(zeta).filter(|zeta| zeta.is_finite()));
        rows.push([words("Hinge as given", "given"), some(side.curve.hinge), zeta, taken(rule)]);
    }
    let (at, zeta) = (formula("h_1/h"), formula("ζ_E"));
    let mut text = table(&["rule of the hinge", &at, &format!("least {zeta} that decides"), "taken"], &rows);
    let mut lines = Calculation::default();
    let words = ["Least multiplier, without FC", "C8.7.1.2.1.1"];
    lines.line(words, "min α0", (found.alpha0, ""));
    text += &lines.table();
    if rule == Hinge::Worst {
        let checks = side.checks;
        let made = Deciding::ALL.into_iter().zip(checks.zetas()).filter(|(_, zeta)| zeta.is_finite());
        let row =
            |(check, zeta): (Deciding, f64)| [check.name().to_owned(), some(checks.hinge(check)), n(zeta)];
        let rows: Vec<_> = made.map(row).collect();
        text += &table(&["check, each with its own hinge", &at, &zeta], &rows);
    }
    text
}

/// The depths of stress blocks and what they take of F0.
fn set_back(case: &Checked<'_>, of: Side, side: &SideVerdict) -> String {
    let given = &case.statement.table;
    let (Some(strength), Some(bears)) = (given.masonry_strength, case.statement.masonry) else {
        return String::new();
    };
    let (gamma, block) = (given.masonry_gamma.unwrap_or(1.0), given.stress_block.unwrap_or(STRESS_BLOCK));
    let mut lines = calculation(case, of, &side.curve);
    lines.know(&[("f_m", 1e-6 * strength), ("γ", gamma), ("κ", block)]);
    let (words, formula) = if given.masonry_over_fc.unwrap_or(true) {
        ("Design strength of the masonry, with FC", "f_d = f_m/(γ FC)")
    } else {
        ("Design strength of the masonry, without FC", "f_d = f_m/γ")
    };
    lines.line([words, "C8.7.1.2.1 d)"], formula, (1e-6 * bears / block, "MPa"));
    let places = [
        ("Set-back of the hinge at the base", "t_b = (W + O)/(2 κ f_d l)", side.curve.set_back.base),
        ("Set-back of the intermediate hinge", "t_m = (W_2 + O)/(2 κ f_d l)", side.curve.set_back.middle),
        ("Set-back of the hinge at the top", "t_t = O/(2 κ f_d l)", side.curve.set_back.top),
    ];
    let is_strip = case.parameters.mechanism == Mechanism::VerticalSpanning;
    // kN over MPa and m are mm
    for (words, formula, depth) in places.into_iter().take(if is_strip { 3 } else { 1 }) {
        lines.line([words, "NTC 7.8.2.2.3"], formula, (1e3 * depth, "mm"));
    }
    let share = side.curve.set_back.base.max(side.curve.set_back.middle) / case.parameters.thickness;
    lines.line(["Largest set-back over the thickness", ""], "t/b", (share, ""));
    lines.table()
}
