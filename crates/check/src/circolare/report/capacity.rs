//! The capacity curve: its numbers, and the curve over the demand.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::circolare::figure::{CAPACITY, DEMAND, color, over_demand};
use crate::circolare::{Activation, Checked, Side, SideVerdict};
use crate::error::CheckError;
use crate::report::Figure;
use ::report::palette::{BLACK, sign, stroke};
use rocking_wall::variables::{EccentricityMode, ForceLaw, Mechanism};
use rocking_wall::wall::{Body, Parameters};

use super::by_side;
use super::hinges::body_of;
use super::spectrum::gives;
use crate::circolare::verdict::Deciding;
use crate::report::markup::{Calculation, formula, kilonewtons, millimetres, shown as n, table};

pub(super) fn section(case: &Checked<'_>) -> Result<String, CheckError> {
    let mut text =
        by_side(case, |side, verdict| numbers(case, side, verdict) + &at_hinges(case, side, verdict));
    for (name, _, side) in case.sides() {
        if side.slv.is_some() || side.slc.is_some() {
            text += &figure(case, name, side)?.html();
            if let Some(d) = cut(side) {
                text += &detail(case, name, side, d)?.html();
            }
        }
    }
    Ok(text)
}

/// The curve of a side over the demands of SLV and SLC.
pub(in crate::circolare) fn figure(
    case: &Checked<'_>,
    name: &str,
    side: &SideVerdict,
) -> Result<Figure, CheckError> {
    let entry = |sample: String, name: &str| format!("<span>{sample}{name}</span>");
    let line = |color: &str, style: &str, name: &str| entry(stroke(color, style), name);
    let mut key = line(BLACK, "solid", &format!("{} with FC", formula("a(d)")));
    for (state, _) in side.by_displacement() {
        let color = color(state);
        key += &entry(sign(color, CAPACITY), &formula(&format!("d_{state}")));
        key += &entry(sign(color, DEMAND), &format!("demand of {state}"));
        key += &line(color, "dashed", &format!("secant to {}", formula(&format!("d_{state}"))));
        key += &line(color, "dotted", &formula(&format!("T_{state}")));
        key += &line(color, "solid", "its spectrum");
    }
    let mut of_others = String::new();
    for (state, check) in side.by_displacement() {
        if let Some(hinge) = check.hinge.filter(|hinge| Some(*hinge) != side.hinge) {
            // the curve is that of the hinge that governs
            let [d, at] = [format!("d_{state}"), "h_1/h".to_owned()].map(|text| formula(&text));
            let _ = write!(of_others, " <span>{d} is of the hinge {at} = {}.</span>", n(hinge));
        }
    }
    let caption = format!(
        "Capacity curve over the demand, {}. A wall passes by displacement where its circle lies right of \
         the triangle of the same colour.{of_others} <span class=\"key\">{key}</span>",
        ::report::escaped(name)
    );
    Ok(Figure { caption, plot: over_demand(side, case.statement, &case.demands, None)? })
}

/// The share of the axis below which what a tie does cannot be read \[-\].
const HIDDEN: f64 = 0.3;

/// Where to cut the axis of d so that the tie can be read: at twice `u_r`, or `u_y` of a tie that lasts;
/// `None` where the whole curve shows it \[m\].
fn cut(side: &SideVerdict) -> Option<f64> {
    let tie = side.tie?;
    let d = 2.0 * side.d_per_u * tie.breaks.filter(|breaks| side.d_per_u * breaks < side.d0).or(tie.yields)?;
    (d > 0.0 && d < HIDDEN * side.d0).then_some(d)
}

/// The beginning of the curve, up to d = `cut`.
fn detail(case: &Checked<'_>, name: &str, side: &SideVerdict, cut: f64) -> Result<Figure, CheckError> {
    let caption = format!(
        "The beginning of the curve, {}, up to {} = {} mm: where the tie pulls and gives way.",
        ::report::escaped(name),
        formula("d"),
        millimetres(cut)
    );
    Ok(Figure { caption, plot: over_demand(side, case.statement, &case.demands, Some(cut))? })
}

/// The numbers of one side, from the force to the curve.
fn numbers(case: &Checked<'_>, side: Side, verdict: &SideVerdict) -> String {
    let parameters = &case.parameters;
    let body = case.wall.body();
    let r = case.statement.table.overburden_mass.unwrap_or(0.0);
    let o = body.overburden;
    let SideVerdict { alpha0, mass, a0, d0, d_per_u, acting_force, pushed_weight, .. } = *verdict;
    let mut lines = Calculation::default();
    let specific = 1e-3 * parameters.density * parameters.gravity;
    let [rho, h, b, l, g] =
        [parameters.density, parameters.height, parameters.thickness, parameters.width, parameters.gravity]
            .map(n);
    lines.line(["Specific weight", ""], ["γ = ρ g", &format!("{rho} · {g} · 10⁻³")], (specific, "kN/m³"));
    let put = format!("{} · {h} · {b} · {l}", n(specific));
    lines.line(["Weight", ""], ["W = γ h b l", &put], (1e-3 * body.weight, "kN"));
    force(case, side, verdict, &mut lines);
    let is_parapet = body.mechanism == Mechanism::Parapet;
    let loaded = is_parapet && o > 0.0;
    let divisor = if loaded { "α0 = F_act/(W + 2 r O)" } else { "α0 = F_act/W" };
    let put = format!("{}/{}", kilonewtons(acting_force), kilonewtons(pushed_weight));
    let words = "Multiplier of activation, without FC";
    lines.line([words, "[C8.7.1.1]"], [divisor, &put], (alpha0, ""));
    lines.line(["One resultant on each body", "[C8.7.1.5]"], ["e*", ""], (verdict.e_star, ""));
    let (formula_of, put) = if loaded {
        let put = format!("1 · ({} + {} · {})/{g}", kilonewtons(body.weight), n(r), kilonewtons(o));
        ("M* = e* (W + r O)/g", put)
    } else {
        ("M* = e* W/g", format!("1 · {}/{g}", kilonewtons(body.weight)))
    };
    lines.line(["Participating mass", ""], [formula_of, &put], (1e-3 * mass, "t"));
    let put = format!("{} · {g}/1", n(alpha0));
    lines.line(["Acceleration of activation, without FC", ""], ["a_0 = α0 g/e*", &put], (a0, "m/s²"));
    let ratio = match (is_parapet, loaded) {
        (_, true) => "d/u = (W + 2 r O)/(W + r O)",
        (true, false) => "d/u",
        (false, _) => "d/u = 1/2 · W/W",
    };
    lines.line(["Displacement of the code over that of the model", "[C8.7.1.4]"], [ratio, ""], (d_per_u, ""));
    zero(case, verdict, &mut lines);
    let put = format!("{} · {}", n(d_per_u), millimetres(d0 / d_per_u));
    let words = if verdict.tie.is_some() {
        "Zero of the curve of the wall without a tie"
    } else {
        "Zero of the curve"
    };
    lines.line([words, "C8.7.1.2.1.6"], ["d_0 = (d/u) u_0", &put], (1e3 * d0, "mm"));
    elastic(case, verdict, &mut lines);
    lines.table()
}

/// Adds `k_0` and `u_0` of the line that falls to its zero, unless a law of another form has them.
fn zero(case: &Checked<'_>, verdict: &SideVerdict, lines: &mut Calculation) {
    let body = body_of(case, verdict);
    let (w, o) = (body.weight, body.overburden);
    let [w_of, o_of, h] = [kilonewtons(w), kilonewtons(o), n(body.height)];
    let (k, left, put) = if body.mechanism == Mechanism::Parapet {
        let k = 2.0 * (w + 2.0 * o) / body.height;
        (k, "k_0 = 2 (W + 2 O)/h", format!("2 · ({w_of} + 2 · {o_of})/{h}"))
    } else {
        let [h1, h2] = [body.hinge_height, body.height - body.hinge_height];
        let k = 2.0 * (w + o) / h1 + 2.0 * o / h2;
        let put = format!("2 · ({w_of} + {o_of})/{} + 2 · {o_of}/{}", n(h1), n(h2));
        (k, "k_0 = 2 (W + O)/h_1 + 2 O/h_2", put)
    };
    let u_0 = verdict.d0 / verdict.d_per_u;
    if !gives(verdict.acting_force / k, u_0) {
        return;
    }
    lines.line(["Slope of the line that falls to its zero", ""], [left, &put], (1e-3 * k, "kN/m"));
    let put = format!("{}/{} · 10³", kilonewtons(verdict.acting_force), n(1e-3 * k));
    lines.line(["Zero of the line", ""], ["u_0 = F_act/k_0", &put], (1e3 * u_0, "mm"));
}

/// A number of a side.
type Value<'a> = &'a dyn Fn(&SideVerdict) -> f64;

/// The numbers of a side at the hinges of all checks, by the formulas of the one that governs.
fn at_hinges(case: &Checked<'_>, of: Side, side: &SideVerdict) -> String {
    if side.others.is_empty() {
        return String::new();
    }
    let checks = side.checks();
    let made =
        Deciding::ALL.into_iter().filter_map(|check| Some((check, side.at(Some(checks.hinge(check)?)))));
    let made: Vec<(Deciding, &SideVerdict)> = made.collect();
    let sign = if of == Side::Negative { -1.0 } else { 1.0 };
    let heads: Vec<_> = made.iter().map(|(check, _)| check.name()).collect();
    let heads: Vec<&str> = std::iter::once("at the hinge of each check").chain(heads).collect();
    let strength = |at: &SideVerdict| 1e-3 * body_of(case, at).strength.of(sign);
    let stiffness = |at: &SideVerdict| 1e-3 * at.acting_force * at.d_per_u / at.d0;
    let all: [(&str, &str, Value<'_>); 13] = [
        ("h_1/h", "", &|at| at.hinge.unwrap_or(f64::NAN)),
        ("F0", "kN", &strength),
        ("t_b", "mm", &|at| 1e3 * at.set_back.base),
        ("t_m", "mm", &|at| 1e3 * at.set_back.middle),
        ("F_act", "kN", &|at| 1e-3 * at.acting_force),
        ("α0", "", &|at| at.alpha0),
        ("a_0", "m/s²", &|at| at.a0),
        ("k_0", "kN/m", &stiffness),
        ("u_0", "mm", &|at| 1e3 * at.d0 / at.d_per_u),
        ("d_0", "mm", &|at| 1e3 * at.d0),
        ("d_y", "mm", &|at| 1e3 * at.dy),
        ("a_y", "m/s²", &|at| at.ay),
        ("T0", "s", &|at| at.t0),
    ];
    let rows: Vec<_> = all
        .into_iter()
        .filter(|(_, _, value)| made.iter().any(|(_, at)| value(at) != 0.0))
        .map(|(symbol, unit, value)| {
            let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
            let cells: Vec<_> = made.iter().map(|(_, at)| n(value(at))).collect();
            [formula(symbol) + &unit, cells.join("</td><td>")]
        })
        .collect();
    format!("<div class=\"together\">{}</div>", table(&heads, &rows))
}

/// Adds F0 of Eq. (1) with the hinges at the edges, where the side has them, and `F_act`.
fn force(case: &Checked<'_>, side: Side, verdict: &SideVerdict, lines: &mut Calculation) {
    let parameters = &case.parameters;
    let acting = verdict.acting_force;
    let body = body_of(case, verdict);
    let strength = body.strength.of(if side == Side::Negative { -1.0 } else { 1.0 });
    if parameters.multilinear.is_some() || parameters.force_law == ForceLaw::Trilinear {
        lines.line(["Largest force of the law", ""], ["F_act", ""], (1e-3 * acting, "kN"));
        return;
    }
    let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot;
    let sign = if side == Side::Negative && !follows { -1.0 } else { 1.0 };
    let c = n(sign * parameters.overburden_eccentricity + 0.0).replace('-', "−");
    let [w, o] = [body.weight, body.overburden].map(kilonewtons);
    let [b, h] = [parameters.thickness, body.height].map(n);
    let (left, put) = match body.mechanism {
        Mechanism::Parapet if body.overburden == 0.0 => ("W b/h", format!("{w} · {b}/{h}")),
        Mechanism::Parapet => ("[(W + O) b − 2 O c]/h", format!("[({w} + {o}) · {b} − 2 · {o} · ({c})]/{h}")),
        Mechanism::VerticalSpanning => {
            let [h1, h2] = [body.hinge_height, body.height - body.hinge_height].map(n);
            lines.line(["Height of the hinge", ""], ["h_1", ""], (body.hinge_height, "m"));
            let put = format!("2/{h1} · ({w} + {o}) · {b} + {o} · ({b} + 2 · ({c}))/{h2}");
            ("(2/h_1) (W + O) b + O (b + 2 c)/h_2", put)
        }
    };
    let value = (1e-3 * strength, "kN");
    if (acting - strength).abs() <= 1e-9 * strength {
        let words = "Force at u = 0 of the line that falls to its zero";
        lines.line([words, ""], [&format!("F_act = F0 = {left}"), &put], value);
        return;
    }
    let words = "Force at u = 0 with the hinges at the edges";
    lines.line([words, ""], [&format!("F0 = {left}"), &put], value);
    let words = "Force at u = 0 of the line that falls to its zero";
    let (left, put) = if case.statement.masonry.is_some() {
        set_back(&body, parameters, sign * parameters.overburden_eccentricity, verdict)
    } else {
        ("F_act".to_owned(), String::new())
    };
    lines.line([words, ""], [&left, &put], (1e-3 * acting, "kN"));
}

/// F0' of hinges that are set back: the formula and the numbers put in; c is that of the side.
fn set_back(body: &Body, parameters: &Parameters, c: f64, verdict: &SideVerdict) -> (String, String) {
    let strength = kilonewtons(verdict.acting_force / verdict.a3);
    let [all, o, h] =
        [kilonewtons(body.weight + body.overburden), kilonewtons(body.overburden), n(body.height)];
    let [t_b, t_m, t_t] =
        [verdict.set_back.base, verdict.set_back.middle, verdict.set_back.top].map(millimetres);
    if body.mechanism == Mechanism::Parapet {
        let put = format!("{strength} − 2/{h} · {all} · {t_b} · 10⁻³");
        return ("F_act = F0 − (2/h) (W + O) t_b".to_owned(), put);
    }
    let h2 = body.height - body.hinge_height;
    let above = kilonewtons(body.weight * h2 / body.height + body.overburden);
    let [h1, h2] = [body.hinge_height, h2].map(n);
    let mut left = "F_act = F0 − (2/h_1) (W + O) t_b − 2 (W_2 + O) t_m h/(h_1 h_2)".to_owned();
    let mut put = format!(
        "{strength} − 2/{h1} · {all} · {t_b} · 10⁻³ − 2 · {above} · {t_m} · 10⁻³ · {h}/({h1} · {h2})"
    );
    // the overburden passes no nearer to the edge than the set-back of the top
    if c > 0.5 * parameters.thickness - verdict.set_back.top {
        left += " − (2/h_2) O [c − (b/2 − t_t)]";
        let [c, b] = [c, parameters.thickness].map(n);
        put = format!("{put} − 2/{h2} · {o} · [{c} − ({b}/2 − {t_t} · 10⁻³)]");
    }
    (left, put)
}

/// Adds T0, `d_y` and `a_y`.
fn elastic(case: &Checked<'_>, verdict: &SideVerdict, lines: &mut Calculation) {
    let parameters = &case.parameters;
    let SideVerdict { t0, dy, ay, a0, d0, .. } = *verdict;
    match case.statement.table.before_activation {
        None | Some(Activation::Rigid) => {
            lines.line(["Period before activation: rigid", "C8.7.1.2.1.3"], ["T0", ""], (0.0, "s"));
        }
        Some(Activation::Law) => {
            let words = ["End of the elastic branch", ""];
            if parameters.multilinear.is_none() {
                let u_ins = dy / (parameters.a1 * verdict.d_per_u);
                let put = format!("{} · {} · {}", n(verdict.d_per_u), n(parameters.a1), millimetres(u_ins));
                lines.line(words, ["d_y = (d/u) a_1 u_ins", &put], (1e3 * dy, "mm"));
            } else {
                lines.line(words, ["d_y", ""], (1e3 * dy, "mm"));
            }
            let on_line = gives(a0 * (1.0 - dy / d0), ay);
            let put = format!("{} · (1 − {}/{})", n(a0), millimetres(dy), millimetres(d0));
            let (left, put) = if on_line { ("a_y = a_0 (1 − d_y/d_0)", &*put) } else { ("a_y", "") };
            lines.line(["Largest acceleration, without FC", ""], [left, put], (ay, "m/s²"));
            let at_end = dy * (TAU / t0).powi(2);
            let put = format!("2π √({} · 10⁻³/{})", millimetres(dy), n(at_end));
            let left = if gives(at_end, ay) { "T0 = 2π √(d_y/a_y)" } else { "T0 = 2π √[d_y/a(d_y)]" };
            lines.line(["Period of the elastic branch", "[C8.7.1.6]"], [left, &put], (t0, "s"));
        }
        Some(Activation::Beam) => {
            let parapet = parameters.mechanism == Mechanism::Parapet;
            let factor = if parapet { "6.2" } else { "2.2" };
            let [h, b, rho] = [parameters.height, parameters.thickness, parameters.density].map(n);
            let e = n(1e-6 * case.statement.table.young_modulus.unwrap_or(f64::NAN));
            let put = format!("{factor} · ({h}/{b}) · {h} · √({rho}/({e} · 10⁶))");
            let words = "Period of a uniform beam";
            lines.line([words, "[C8.7.1.7]"], ["T0 = κ λ L √(W_s/(E g))", &put], (t0, "s"));
            let k = (TAU / t0).powi(2);
            let put = format!("{}/({} + {}/({} · 10⁻³)) · 10³", n(a0), n(k), n(a0), millimetres(d0));
            let words = "End of the elastic branch";
            lines.line([words, "[C8.7.1.6]"], ["d_y = a_0/(4π²/T0² + a_0/d_0)", &put], (1e3 * dy, "mm"));
            let put = format!("{} · {} · 10⁻³", n(k), millimetres(dy));
            lines.line(["Acceleration there, without FC", ""], ["a_y = (4π²/T0²) d_y", &put], (ay, "m/s²"));
        }
    }
}
