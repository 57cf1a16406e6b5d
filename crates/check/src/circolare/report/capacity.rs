//! The capacity curve: its numbers, and the curve over the demand.

use crate::names::{Deciding, Side};
use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::circolare::figure::over_demand;
use crate::circolare::{Activation, Checked, SideVerdict};
use crate::error::CheckError;
use crate::report::Figure;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Parameters;

use super::spectrum::gives;
use super::{by_side, calculation, eccentricity};
use crate::circolare::{case::has_plateau, curve::Curve};
use crate::report::markup::{Calculation, formula, millimetres, shown as n, table};

pub(super) fn section(case: &Checked<'_>) -> Result<String, CheckError> {
    let mut text =
        by_side(case, |side, verdict| numbers(case, side, verdict) + &at_hinges(case, side, verdict));
    for (name, _, side) in case.sides() {
        if side.checks.slv.is_some() || side.checks.slc.is_some() {
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
    let mut of_others = String::new();
    for (state, check) in side.by_displacement() {
        if let Some(hinge) = check.hinge.filter(|hinge| Some(*hinge) != side.curve.hinge) {
            // the curve is that of the hinge that governs
            let [d, at] = [format!("d_{state}"), "h_1/h".to_owned()].map(|text| formula(&text));
            let _ = write!(of_others, " <span>{d} is of the hinge {at} = {}.</span>", n(hinge));
        }
    }
    let caption = format!(
        "Capacity curve over the demand, {}. A wall passes by displacement where its circle lies right of \
         the triangle of the same colour.{of_others}",
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
    let d = 2.0
        * side.curve.d_per_u
        * tie.breaks.filter(|breaks| side.curve.d_per_u * breaks < side.curve.d0).or(tie.yields)?;
    (d > 0.0 && d < HIDDEN * side.curve.d0).then_some(d)
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
    let body = case.wall.body();
    let curve = &verdict.curve;
    let Curve { alpha0, e_star, mass, a0, d0, d_per_u, .. } = *curve;
    let specific = 1e-3 * case.parameters.density * case.parameters.gravity;
    let mut lines = calculation(case, side, curve);
    lines.line(["Specific weight", ""], "γ = ρ g {10⁻³}", (specific, "kN/m³"));
    lines.line(["Weight", ""], "W = γ h b l", (1e-3 * body.weight, "kN"));
    force(case, side, curve, &mut lines);
    let [multiplier, mass_of, ratio] = match body.mechanism {
        Mechanism::Parapet if body.overburden > 0.0 => {
            ["α0 = F_act/(W + 2 r O)", "M* = e* (W + r O)/g", "d/u = (W + 2 r O)/(W + r O)"]
        }
        Mechanism::Parapet => ["α0 = F_act/W", "M* = e* W/g", "d/u"],
        Mechanism::VerticalSpanning => ["α0 = F_act/W", "M* = e* W/g", "d/u = 1/2 · W/W"],
    };
    lines.line(["Multiplier of activation, without FC", "[C8.7.1.1]"], multiplier, (alpha0, ""));
    lines.line(["One resultant on each body", "[C8.7.1.5]"], "e*", (e_star, ""));
    lines.line(["Participating mass", ""], mass_of, (1e-3 * mass, "t"));
    lines.line(["Acceleration of activation, without FC", ""], "a_0 = α0 g/e*", (a0, "m/s²"));
    lines.line(["Displacement of the code over that of the model", "[C8.7.1.4]"], ratio, (d_per_u, ""));
    zero(curve, &mut lines);
    let words = if verdict.tie.is_some() {
        "Zero of the curve of the wall without a tie"
    } else {
        "Zero of the curve"
    };
    lines.line([words, "C8.7.1.2.1.6"], "d_0 = (d/u) u_0", (1e3 * d0, "mm"));
    elastic(case, curve, &mut lines);
    lines.table()
}

/// Adds `k_0` and `u_0` of the line that falls to its zero, unless a law of another form has them.
fn zero(curve: &Curve, lines: &mut Calculation) {
    let body = curve.body();
    let (w, o) = (body.weight, body.overburden);
    let (k, formula) = if body.mechanism == Mechanism::Parapet {
        (2.0 * (w + 2.0 * o) / body.height, "k_0 = 2 (W + 2 O)/h")
    } else {
        let [h1, h2] = [body.hinge_height, body.height - body.hinge_height];
        (2.0 * (w + o) / h1 + 2.0 * o / h2, "k_0 = 2 (W + O)/h_1 + 2 O/h_2")
    };
    let u_0 = curve.d0 / curve.d_per_u;
    if gives(curve.acting_force / k, u_0) {
        lines.line(["Slope of the line that falls to its zero", ""], formula, (1e-3 * k, "kN/m"));
        lines.line(["Zero of the line", ""], "u_0 = F_act/k_0 {10³}", (1e3 * u_0, "mm"));
    }
}

/// The numbers of a side at the hinges of all checks, by the formulas of the one that governs.
fn at_hinges(case: &Checked<'_>, of: Side, side: &SideVerdict) -> String {
    if side.others.is_empty() {
        return String::new();
    }
    let checks = side.checks;
    let made = Deciding::ALL.into_iter().filter_map(|check| Some((check.name(), checks.hinge(check)?)));
    let at = |(check, hinge)| (check, calculation(case, of, side.at(Some(hinge))));
    let (heads, made): (Vec<&str>, Vec<Calculation>) = made.map(at).unzip();
    let all = [
        ("h_1/h", ""),
        ("F0", " [kN]"),
        ("t_b", " [mm]"),
        ("t_m", " [mm]"),
        ("F_act", " [kN]"),
        ("α0", ""),
        ("a_0", " [m/s²]"),
        ("k_0", " [kN/m]"),
        ("u_0", " [mm]"),
        ("d_0", " [mm]"),
        ("d_y", " [mm]"),
        ("a_y", " [m/s²]"),
        ("T0", " [s]"),
    ];
    let row = |(symbol, unit): (&str, &str)| {
        let cells: Vec<&str> = made.iter().map(|lines| lines.number(symbol)).collect();
        let is_said = cells.iter().any(|cell| *cell != "0");
        is_said.then(|| [formula(symbol) + unit, cells.join("</td><td>")])
    };
    let rows: Vec<_> = all.into_iter().filter_map(row).collect();
    let heads = [&["at the hinge of each check"], &heads[..]].concat();
    format!("<div class=\"together\">{}</div>", table(&heads, &rows))
}

/// Adds F0 of Eq. (1) with the hinges at the edges, where the side has them, and `F_act`.
fn force(case: &Checked<'_>, side: Side, curve: &Curve, lines: &mut Calculation) {
    let acting = (1e-3 * curve.acting_force, "kN");
    let body = curve.body();
    if has_plateau(&case.parameters) {
        lines.line(["Largest force of the law", ""], "F_act", acting);
        return;
    }
    let formula = match body.mechanism {
        Mechanism::Parapet if body.overburden == 0.0 => "W b/h",
        Mechanism::Parapet => "[(W + O) b − 2 O c]/h",
        Mechanism::VerticalSpanning => {
            lines.line(["Height of the hinge", ""], "h_1", (body.hinge_height, "m"));
            "(2/h_1) (W + O) b + O (b + 2 c)/h_2"
        }
    };
    let words = ["Force at u = 0 of the line that falls to its zero", ""];
    let strength = body.strength.of(side.sign());
    if gives(curve.acting_force, strength) {
        lines.line(words, &format!("F_act = F0 = {formula}"), acting);
        return;
    }
    let of_edges = ["Force at u = 0 with the hinges at the edges", ""];
    lines.line(of_edges, &format!("F0 = {formula}"), (1e-3 * strength, "kN"));
    // the overburden passes no nearer to the edge than the set-back of the top
    let is_cut = eccentricity(case, side) > 0.5 * case.parameters.thickness - curve.set_back.top;
    let formula = match (case.statement.masonry, body.mechanism) {
        (None, _) => "F_act",
        (Some(_), Mechanism::Parapet) => "F_act = F0 − (2/h) (W + O) t_b {10⁻³}",
        (Some(_), Mechanism::VerticalSpanning) if is_cut => {
            "F_act = F0 − (2/h_1) (W + O) t_b {10⁻³} − 2 (W_2 + O) t_m {10⁻³} h/(h_1 h_2) − (2/h_2) O [c − \
             (b/2 − t_t {10⁻³})]"
        }
        (Some(_), Mechanism::VerticalSpanning) => {
            "F_act = F0 − (2/h_1) (W + O) t_b {10⁻³} − 2 (W_2 + O) t_m {10⁻³} h/(h_1 h_2)"
        }
    };
    lines.line(words, formula, acting);
}

/// Adds T0, `d_y` and `a_y`.
fn elastic(case: &Checked<'_>, curve: &Curve, lines: &mut Calculation) {
    let parameters = &case.parameters;
    let Curve { t0, dy, ay, a0, d0, d_per_u, .. } = *curve;
    let end = (1e3 * dy, "mm");
    match case.statement.table.before_activation {
        None | Some(Activation::Rigid) => {
            lines.line(["Period before activation: rigid", "C8.7.1.2.1.3"], "T0", (0.0, "s"));
        }
        Some(Activation::Law) => {
            let (a1, at_end) = (parameters.a1, dy * (TAU / t0).powi(2));
            lines.know(&[("a_1", a1), ("u_ins", 1e3 * dy / (a1 * d_per_u)), ("a(d_y)", at_end)]);
            let formula = if parameters.multilinear.is_none() { "d_y = (d/u) a_1 u_ins" } else { "d_y" };
            lines.line(["End of the elastic branch", ""], formula, end);
            let on_line = gives(a0 * (1.0 - dy / d0), ay);
            let formula = if on_line { "a_y = a_0 (1 − d_y/d_0)" } else { "a_y" };
            lines.line(["Largest acceleration, without FC", ""], formula, (ay, "m/s²"));
            let is_largest = gives(at_end, ay);
            let formula = if is_largest {
                "T0 = 2π √(d_y {10⁻³}/a_y)"
            } else {
                "T0 = 2π √[d_y {10⁻³}/a(d_y)]"
            };
            lines.line(["Period of the elastic branch", "[C8.7.1.6]"], formula, (t0, "s"));
        }
        Some(Activation::Beam) => {
            let Parameters { height, thickness, density, gravity, mechanism, .. } = *parameters;
            lines.know(&[
                ("κ", if mechanism == Mechanism::Parapet { 6.2 } else { 2.2 }),
                ("λ", height / thickness),
                ("L", height),
                ("W_s", 1e-3 * density * gravity),
                ("E", 1e-6 * case.statement.table.young_modulus.unwrap_or(f64::NAN)),
                ("4π²/T0²", (TAU / t0).powi(2)),
                ("(4π²/T0²)", (TAU / t0).powi(2)),
            ]);
            let words = ["Period of a uniform beam", "[C8.7.1.7]"];
            lines.line(words, "T0 = κ λ L √(W_s/(E {10³} g))", (t0, "s"));
            let words = ["End of the elastic branch", "[C8.7.1.6]"];
            lines.line(words, "d_y = a_0/(4π²/T0² + a_0/{(}d_0 {10⁻³)}) {10³}", end);
            lines.line(["Acceleration there, without FC", ""], "a_y = (4π²/T0²) d_y {10⁻³}", (ay, "m/s²"));
        }
    }
}
