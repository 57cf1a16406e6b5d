//! The hinges: what each rule on the hinge of a strip gives, and how far hinges are set back.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Body, Parameters, Statics};

use super::by_side;
use crate::circolare::table::{Hinge, STRESS_BLOCK};
use crate::circolare::{Checked, Deciding, SideVerdict};
use crate::report::markup::{Calculation, formula, kilonewtons, or_dash, shown as n, table};

/// The section, if the wall is a strip or its hinges are set back.
pub(super) fn section(case: &Checked<'_>) -> Option<String> {
    let text = by_side(case, |_, side| rules(case, side) + &set_back(case, side));
    (!text.is_empty()).then_some(text)
}

/// The body of the wall, with the hinge of a strip where the side has it.
pub(super) fn body_of(case: &Checked<'_>, side: &SideVerdict) -> Body {
    let hinge_ratio = side.hinge.unwrap_or(case.parameters.hinge_ratio);
    let parameters = Parameters { hinge_ratio, ..case.parameters.clone() };
    Statics::new(&parameters).map_or_else(|_| case.wall.body().clone(), |statics| statics.body().clone())
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
        let zeta = side.checks().governing(case.statement).1;
        let zeta = some(Some(zeta).filter(|zeta| zeta.is_finite()));
        rows.push([words("Hinge as given", "given"), some(side.hinge), zeta, taken(rule)]);
    }
    let (at, zeta) = (formula("h_1/h"), formula("ζ_E"));
    let mut text = table(&["rule of the hinge", &at, &format!("least {zeta} that decides"), "taken"], &rows);
    let mut lines = Calculation::default();
    let words = ["Least multiplier, without FC", "C8.7.1.2.1.1"];
    lines.line(words, ["min α0", ""], (found.alpha0, ""));
    text += &lines.table();
    if rule == Hinge::Worst {
        let checks = side.checks();
        let made = Deciding::ALL.into_iter().zip(checks.zetas()).filter(|(_, zeta)| zeta.is_finite());
        let row =
            |(check, zeta): (Deciding, f64)| [check.name().to_owned(), some(checks.hinge(check)), n(zeta)];
        let rows: Vec<_> = made.map(row).collect();
        text += &table(&["check, each with its own hinge", &at, &zeta], &rows);
    }
    text
}

/// The depths of stress blocks and what they take of F0.
fn set_back(case: &Checked<'_>, side: &SideVerdict) -> String {
    let given = &case.statement.table;
    let (Some(strength), Some(_)) = (given.masonry_strength, case.statement.masonry) else {
        return String::new();
    };
    let (gamma, block) = (given.masonry_gamma.unwrap_or(1.0), given.stress_block.unwrap_or(STRESS_BLOCK));
    let factor = case.statement.confidence_factor;
    let is_over_factor = given.masonry_over_fc.unwrap_or(true);
    let design = strength / gamma / if is_over_factor { factor } else { 1.0 };
    let mut lines = Calculation::default();
    let (words, left, put) = if is_over_factor {
        let put = format!("{}/({} · {})", n(1e-6 * strength), n(gamma), n(factor));
        ("Design strength of the masonry, with FC", "f_d = f_m/(γ FC)", put)
    } else {
        let put = format!("{}/{}", n(1e-6 * strength), n(gamma));
        ("Design strength of the masonry, without FC", "f_d = f_m/γ", put)
    };
    lines.line([words, "C8.7.1.2.1 d)"], [left, &put], (1e-6 * design, "MPa"));
    let body = body_of(case, side);
    let (w, o) = (body.weight, body.overburden);
    let is_strip = body.mechanism == Mechanism::VerticalSpanning;
    let above = w * (1.0 - body.hinge_height / body.height) + o;
    let mut places =
        vec![("Set-back of the hinge at the base", "t_b = (W + O)/(2 κ f_d l)", w + o, side.set_back.base)];
    if is_strip {
        places.push((
            "Set-back of the intermediate hinge",
            "t_m = (W_2 + O)/(2 κ f_d l)",
            above,
            side.set_back.middle,
        ));
        places.push(("Set-back of the hinge at the top", "t_t = O/(2 κ f_d l)", o, side.set_back.top));
    }
    for (words, left, force, depth) in places {
        let width = n(case.parameters.width);
        // kN over kN/m² and m
        let put = format!("{}/(2 · {} · {} · {width}) · 10³", kilonewtons(force), n(block), n(1e-3 * design));
        lines.line([words, "NTC 7.8.2.2.3"], [left, &put], (1e3 * depth, "mm"));
    }
    let share = side.set_back.base.max(side.set_back.middle) / case.parameters.thickness;
    lines.line(["Largest set-back over the thickness", ""], ["t/b", ""], (share, ""));
    lines.table()
}
