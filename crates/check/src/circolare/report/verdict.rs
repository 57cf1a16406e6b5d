//! The verdict: every check in one row a side.

use crate::circolare::{ActivationCheck, DisplacementCheck, LimitState, Method, UseClass};
use ::report::escaped;

use super::Case;
use super::markup::{formula, number, result};

/// The verdict in one line as markup.
pub(super) fn headline(text: &str) -> String {
    escaped(text).replace("zeta_E", &formula("ζ_E"))
}

/// A check in a row: its cells without the result, the fourth.
struct Row {
    cells: [String; 7],
    passes: bool,
    decides: bool,
}

pub(super) fn section(case: &Case<'_>) -> String {
    let statement = case.report.statement;
    let class_iv = statement.use_class == Some(UseClass::IV);
    let mut rows = Vec::new();
    for (name, _, side) in case.sides() {
        let activation = |check: ActivationCheck, state: LimitState, name: [&str; 3], decides: bool| {
            let ends = [number(check.capacity) + " m/s²", number(check.demand) + " m/s²"];
            row(case, state, name, ends, check.ratio, check.ag, decides)
        };
        if let Some(check) = side.sld {
            let words = ["SLD, activation", "C8.7.1.2.1.5", name];
            rows.push(activation(check, LimitState::Sld, words, class_iv));
        }
        if let Some(check) = side.slv_q {
            let words = ["SLV with q", "C8.7.1.2.1.7", name];
            rows.push(activation(check, LimitState::Slv, words, statement.method == Method::Linear));
        }
        let states = [(LimitState::Slv, side.slv), (LimitState::Slc, side.slc)];
        for (state, check) in states.into_iter().filter_map(|(state, check)| Some((state, check?))) {
            let DisplacementCheck { d, demand, zeta, ag, .. } = check;
            let ends = [d, demand].map(|end| number(1000.0 * end) + " mm");
            let words = [&*format!("{state} by displacement"), "C8.7.1.2.1.8", name];
            rows.push(row(case, state, words, ends, zeta, ag, statement.method == Method::Nonlinear));
        }
    }
    if let Some(dynamic) = &case.report.verdict.dynamic {
        let states = [(LimitState::Slv, &dynamic.slv), (LimitState::Slc, &dynamic.slc)];
        for (state, check) in states.into_iter().filter_map(|(state, check)| Some((state, check.as_ref()?))) {
            let side = if case.report.verdict.alike { "both sides" } else { check.side.name() };
            let words = [&*format!("{state} under records"), "C8.7.1.2.1.9", side];
            let of_side = case.report.verdict.sides.iter().find(|(side, _)| *side == check.side);
            let limit =
                of_side.and_then(|(_, side)| if state == LimitState::Slc { side.slc } else { side.slv });
            let ends = [limit.map_or(f64::NAN, |limit| limit.d), check.d].map(|end| number(1000.0 * end));
            let ag = statement.state(state).map_or(f64::NAN, |given| check.zeta * given.ag);
            let decides = statement.method == Method::Dynamic;
            let made = row(case, state, words, ends.map(|end| end + " mm"), check.zeta, ag, decides);
            rows.push(Row { passes: check.passed, ..made });
        }
    }
    let [zeta, ag] = [formula("ζ_E"), formula("a_g,cap") + " / " + &formula("a_g")];
    let heads = ["check", "side", &zeta, "result", &ag, "capacity", "demand", "clause"];
    let mut text = format!(
        "<div class=\"scroll\"><table class=\"checks\">\n<thead><tr><th>{}</th></tr></thead>\n",
        heads.join("</th><th>")
    );
    for Row { cells, passes, decides } in rows {
        let class = if decides { " class=\"decides\"" } else { "" };
        let (first, rest) = cells.split_at(3);
        let cells = [first, &[result(passes).to_owned()], rest].concat();
        text.push_str(&["<tr", class, "><td>", &cells.join("</td><td>"), "</td></tr>\n"].concat());
    }
    let method = match statement.method {
        Method::Nonlinear => "SLV and SLC by displacement",
        Method::Linear => "SLV with q",
        Method::Dynamic => "the runs under records",
    };
    let class_iv = if class_iv { ", and SLD in use class IV" } else { "" };
    text + "</table></div>\n"
        + &format!(
            "<p>{} is the ground acceleration that just brings the wall to the limit state, over that of \
             the site: {} = {}/{} (NTC 8.3). A check passes from {} = 1 on. The rows in bold decide \
             ({method}{class_iv}); the others are for information.</p>\n",
            formula("ζ_E"),
            formula("ζ_E"),
            formula("a_g,cap"),
            formula("a_g"),
            formula("ζ_E"),
        )
}

fn row(
    case: &Case<'_>,
    state: LimitState,
    [check, clause, side]: [&str; 3],
    [capacity, demand]: [String; 2],
    zeta: f64,
    ag: f64,
    decides: bool,
) -> Row {
    let site = case.report.statement.state(state).map_or(f64::NAN, |given| given.ag);
    let acceleration = format!("{} / {} g", ::report::number(ag, 4), number(site));
    let [check, side] = [check, side].map(escaped);
    let zeta_text = ::report::number(zeta, 4);
    let cells = [check, side, zeta_text, acceleration, capacity, demand, clause.to_owned()];
    Row { cells, passes: zeta >= 1.0, decides }
}
