//! The tie: what its bar makes of it, where it yields and breaks, and the forces of its anchors.

use crate::names::Side;
use std::f64::consts::{PI, TAU};

use rocking_wall::wall::{Parameters, TiePart};

use super::{by_side, calculation};
use crate::circolare::tie::{TieState, anchors};
use crate::circolare::{Checked, LARGEST_LOSS, SideVerdict, TieBreak, TieNumbers};
use crate::report::markup::{Calculation, kilonewtons, millimetres, or_dash, shown as n, table};

/// The section, if the wall has a tie on a side to which it rocks.
pub(super) fn section(case: &Checked<'_>) -> Option<String> {
    let of_sides = by_side(case, |of, side| {
        let Some(tie) = side.tie else { return String::new() };
        displacements(case, of, side, tie) + &forces(case, side) + &required(case, of, side)
    });
    let apart =
        "<p>The plate, the masonry around it and the connections are verified apart for these forces.</p>\n";
    (!of_sides.is_empty()).then(|| bar(case) + &of_sides + apart)
}

/// What the bar and its anchor make of the tie, for the width of the wall.
fn bar(case: &Checked<'_>) -> String {
    let parameters = &case.parameters;
    let Some((bar, weaker)) = parameters.bar.zip(parameters.weaker_part()) else { return String::new() };
    let area = PI * bar.diameter * bar.diameter / 4.0;
    let mut lines = Calculation::default();
    lines.know(&[
        ("φ", 1e3 * bar.diameter),
        ("E", 1e-6 * bar.young_modulus),
        ("L", 1e3 * bar.length),
        ("f_y", 1e-6 * bar.yield_stress),
        ("l", parameters.width),
        ("i", bar.spacing.unwrap_or(f64::NAN)),
        ("N_a", 1e-3 * bar.anchor_capacity.unwrap_or(f64::NAN)),
        ("ε_u", bar.ultimate_strain.unwrap_or(f64::NAN)),
    ]);
    let of_width = if bar.spacing.is_some() { " l/i" } else { "" };
    lines.line(["Cross-section of the bar", ""], "A_s = π φ²/4", (1e6 * area, "mm²"));
    let words = ["Axial stiffness, for the width l", ""];
    lines.line(words, &format!("K = (E A_s/L){of_width}"), (1e-3 * parameters.tie_stiffness, "kN/m"));
    let yields = 1e-3 * area * bar.yield_stress;
    lines.line(["Yield force of one bar", ""], "N_s = A_s f_y {10⁻³}", (yields, "kN"));
    if let Some(capacity) = bar.anchor_capacity {
        lines.line(["Capacity of one anchor", ""], "N_a", (1e-3 * capacity, "kN"));
    }
    let least = if bar.anchor_capacity.is_some() { "min(N_s; N_a)" } else { "N_s" };
    let words = ["Strength of the tie, for the width l", ""];
    lines.line(words, &format!("N_y = {least}{of_width}"), (1e-3 * parameters.tie_strength, "kN"));
    let elongates = bar.ultimate_strain.is_some() && weaker == TiePart::Bar;
    let formula = if elongates { "e_p = max(0; ε_u L − N_y/K {10³})" } else { "e_p" };
    let words = ["Plastic elongation at which the tie breaks", ""];
    lines.line(words, formula, (1e3 * parameters.tie_ultimate, "mm"));
    let first = match weaker {
        TiePart::Anchor => "the anchor (brittle)",
        TiePart::Bar if parameters.tie_ultimate == 0.0 => "the bar (brittle)",
        TiePart::Bar => "the bar",
    };
    lines.say("Part that gives way first", first);
    lines.table()
}

/// Where the tie pulls, yields and breaks, what it does at the activation, and what its rupture takes.
fn displacements(case: &Checked<'_>, of: Side, side: &SideVerdict, tie: TieNumbers) -> String {
    let mut lines = calculation(case, of, &side.curve);
    for (words, formula, u) in [
        ("The tie begins to pull at", "u_g = g_0 h/(2 y)", Some(tie.engaged).filter(|u| *u > 0.0)),
        ("The tie reaches its strength at", "u_y = (N_y/K {10³} + g_0) h/(2 y)", tie.yields),
        ("The tie breaks at", "u_r = (N_y/K {10³} + g_0 + e_p) h/(2 y)", tie.breaks),
    ] {
        if let Some(u) = u {
            lines.line([words, ""], formula, (1e3 * u, "mm"));
        }
    }
    if side.activation.force > 0.0 {
        activation(case, side, &mut lines);
    }
    if let Some(broken) = side.curve.tie_break() {
        rupture(side, &broken, &mut lines);
    }
    lines.table()
}

/// The wall at its activation with the tie at its strength.
fn activation(case: &Checked<'_>, side: &SideVerdict, lines: &mut Calculation) {
    let Parameters { tie_height, height, gravity, tie_stiffness, .. } = case.parameters;
    let lever = 2.0 * tie_height / height;
    let stiffness = lever * lever * tie_stiffness * gravity / (side.curve.pushed_weight * side.curve.d_per_u);
    let at = side.activation;
    let words = ["Multiplier of activation with the tie at its strength, without FC", "[C8.7.1.1]"];
    lines.line(words, "α0 = [F_act + (2 y/h) N_y]/(W + 2 r O)", (at.alpha0, ""));
    let words = ["Acceleration of activation with the tie at its strength, without FC", ""];
    let formula = format!("a = {} + (2 y/h) N_y g/[(W + 2 r O) e*]", own(side));
    lines.line(words, &formula, (at.acceleration, "m/s²"));
    if side.curve.t0 > 0.0 {
        let tied = "(2 y/h)² K g/((W + 2 r O) e* d/u)";
        lines.know(&[("4π²/T0²", (TAU / side.curve.t0).powi(2)), (tied, stiffness)]);
        let words = ["Period of wall and tie", "[C8.7.1.6]"];
        lines.line(words, &format!("T_0t = 2π/√[4π²/T0² + {tied}]"), (at.t0, "s"));
    }
}

/// The acceleration of activation without the tie.
fn own(side: &SideVerdict) -> &'static str {
    if side.curve.t0 > 0.0 { "a_y" } else { "a_0" }
}

/// What the curve loses where the tie breaks.
fn rupture(side: &SideVerdict, broken: &TieBreak, lines: &mut Calculation) {
    let TieBreak { before, after, largest, loss, .. } = *broken;
    let put = format!("({} − {})/{}", n(before), n(after), n(largest));
    let words = "What the curve, with FC, loses there for good, over its largest a";
    lines.line_of([words, "C8.7.1.2.1.6"], ["Δa/a_max", &put], (loss, ""));
    let early = side.checks.slv.is_some_and(|check| check.limited_by_tie);
    let decides = if early {
        format!("more than {LARGEST_LOSS}, before 0.40 d_0: d_SLV is there")
    } else {
        "d_SLV stays at 0.40 d_0".to_owned()
    };
    lines.say("Consequence", &decides);
}

/// Headings of forces.
const FORCES: [&str; 3] = ["N [kN]", "N/l [kN/m]", "one anchor [kN]"];

/// A force of the tie in all and per metre, and of each anchor where the bar is known: cells of a row.
fn cells(case: &Checked<'_>, force: f64) -> String {
    let anchor = anchors(&case.parameters).map(|anchors| kilonewtons(force / anchors));
    let all = [kilonewtons(force), kilonewtons(force / case.parameters.width)];
    all.into_iter().chain(anchor).collect::<Vec<_>>().join("</td><td>")
}

/// The headings of those cells between others.
fn heads(case: &Checked<'_>, before: &[&'static str], after: &[&'static str]) -> Vec<&'static str> {
    let count = if anchors(&case.parameters).is_some() { 3 } else { 2 };
    [before, &FORCES[..count], after].concat()
}

/// The forces of the tie at the activation, the limit states and their demands.
fn forces(case: &Checked<'_>, side: &SideVerdict) -> String {
    let mut rows = Vec::new();
    let mut row = |place: String, d: Option<f64>, force: f64, state: &str| {
        let d = or_dash(d, millimetres);
        rows.push([place, d, cells(case, force), state.to_owned()]);
    };
    if side.activation.force > 0.0 {
        row("Activation".to_owned(), None, side.activation.force, TieState::AtStrength.name());
    }
    for (state, check) in side.by_displacement() {
        let Some(tie) = check.tie else { continue };
        row(format!("d_{state}"), Some(check.d), tie.force, tie.state.name());
        row(
            format!("Demand of {state}, S_d"),
            Some(check.demand),
            tie.force_at_demand,
            tie.state_at_demand.name(),
        );
    }
    if case.parameters.tie_strength > 0.0 {
        row("Strength of the tie".to_owned(), None, case.parameters.tie_strength, "");
    }
    table(&heads(case, &["force of the tie, of anchor and bar", "d [mm]"], &["state"]), &rows)
}

/// The strength that brings `ζ_E` of the checks at the activation to 1, and `ζ_E` without the tie.
fn required(case: &Checked<'_>, of: Side, side: &SideVerdict) -> String {
    let mut lines = calculation(case, of, &side.curve);
    let mut rows = Vec::new();
    let with_q = if case.statement.behaviour_factor == 1.0 { "S_a" } else { "S_a/q" };
    for (name, check, demand) in [("SLD", side.checks.sld, "S_a"), ("SLV with q", side.checks.slv_q, with_q)]
    {
        let Some((check, force)) = check.and_then(|check| Some((check, check.required?))) else { continue };
        let words = format!("Required force for ζ_E = 1, {name}");
        let formula = format!("N = max[0; (FC {demand} − {}) (W + 2 r O) e*/(g 2 y/h)]", own(side));
        // a tie that does not count here changes the period, and with it the demand
        if side.activation.force > 0.0 || side.curve.t0 == 0.0 {
            lines.know(&[("S_a", check.demand)]);
            lines.line([&words, ""], &formula, (1e-3 * force, "kN"));
        } else {
            lines.line_of([&words, ""], [&formula, ""], (1e-3 * force, "kN"));
        }
        rows.push([name.to_owned(), cells(case, force)]);
    }
    let mut text = String::new();
    if !rows.is_empty() {
        text += &lines.table();
        text += &table(&heads(case, &["required force, at the activation"], &[]), &rows);
    }
    let Some(untied) = side.untied else { return text };
    let mut lines = Calculation::default();
    for (state, zeta) in [("SLV", untied.slv), ("SLC", untied.slc)] {
        if let Some(zeta) = zeta {
            lines.line([&format!("Without the tie, {state}"), ""], "ζ_E", (zeta, ""));
        }
    }
    text + &lines.table()
}
