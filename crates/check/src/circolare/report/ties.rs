//! The tie: what its bar makes of it, where it yields and breaks, and the forces of its anchors.

use std::f64::consts::{PI, TAU};

use rocking_wall::wall::{Bar, Parameters, TiePart};

use super::by_side;
use super::spectrum::gives;
use crate::circolare::tie::{TieState, anchors};
use crate::circolare::{Checked, LARGEST_LOSS, SideVerdict, TieBreak, TieNumbers};
use crate::report::markup::{Calculation, kilonewtons, millimetres, or_dash, shown as n, table};

/// The section, if the wall has a tie on a side to which it rocks.
pub(super) fn section(case: &Checked<'_>) -> Option<String> {
    let of_sides = by_side(case, |_, side| {
        let Some(tie) = side.tie else { return String::new() };
        displacements(case, side, tie) + &forces(case, side) + &required(case, side)
    });
    let apart =
        "<p>The plate, the masonry around it and the connections are verified apart for these forces.</p>\n";
    (!of_sides.is_empty()).then(|| bar(case) + &of_sides + apart)
}

/// What the bar and its anchor make of the tie, for the width of the wall.
fn bar(case: &Checked<'_>) -> String {
    let parameters = &case.parameters;
    let Some((bar, weaker)) = parameters.bar.zip(parameters.weaker_part()) else { return String::new() };
    let Bar { diameter, length, young_modulus, yield_stress, ultimate_strain, anchor_capacity, spacing } =
        bar;
    let area = PI * diameter * diameter / 4.0;
    let (l, e, f) = (n(1e3 * length), n(1e-6 * young_modulus), n(1e-6 * yield_stress));
    let mut lines = Calculation::default();
    lines.line(
        ["Cross-section of the bar", ""],
        ["A_s = π φ²/4", &format!("π · {}²/4", n(1e3 * diameter))],
        (1e6 * area, "mm²"),
    );
    let of_width = |formula: &str, put: String| match spacing {
        Some(spacing) => {
            (format!("{formula} l/i"), format!("{put} · {}/{}", n(parameters.width), n(spacing)))
        }
        None => (formula.to_owned(), put),
    };
    let (left, put) = of_width("K = (E A_s/L)", format!("{e} · {}/{l}", n(1e6 * area)));
    let words = "Axial stiffness, for the width l";
    lines.line([words, ""], [&left, &put], (1e-3 * parameters.tie_stiffness, "kN/m"));
    let yields = area * yield_stress;
    let put = format!("{} · {f} · 10⁻³", n(1e6 * area));
    lines.line(["Yield force of one bar", ""], ["N_s = A_s f_y", &put], (1e-3 * yields, "kN"));
    if let Some(capacity) = anchor_capacity {
        lines.line(["Capacity of one anchor", ""], ["N_a", ""], (1e-3 * capacity, "kN"));
    }
    let own = anchor_capacity.map_or(yields, |capacity| capacity.min(yields));
    let least = if anchor_capacity.is_some() { "N_y = min(N_s; N_a)" } else { "N_y = N_s" };
    let (left, put) = of_width(least, kilonewtons(own));
    let words = "Strength of the tie, for the width l";
    lines.line([words, ""], [&left, &put], (1e-3 * parameters.tie_strength, "kN"));
    let words = "Plastic elongation at which the tie breaks";
    let ultimate = (1e3 * parameters.tie_ultimate, "mm");
    match ultimate_strain.filter(|_| weaker == TiePart::Bar) {
        Some(strain) => {
            let [strength, stiffness] =
                [parameters.tie_strength, parameters.tie_stiffness].map(|value| n(1e-3 * value));
            let put = format!("max(0; {} · {l} − {strength}/{stiffness} · 10³)", n(strain));
            lines.line([words, ""], ["e_p = max(0; ε_u L − N_y/K)", &put], ultimate);
        }
        None => lines.line([words, ""], ["e_p", ""], ultimate),
    }
    let first = match weaker {
        TiePart::Anchor => "the anchor (brittle)",
        TiePart::Bar if parameters.tie_ultimate == 0.0 => "the bar (brittle)",
        TiePart::Bar => "the bar",
    };
    lines.say("Part that gives way first", first);
    lines.table()
}

/// Where the tie pulls, yields and breaks, what it does at the activation, and what its rupture takes.
fn displacements(case: &Checked<'_>, side: &SideVerdict, tie: TieNumbers) -> String {
    let parameters = &case.parameters;
    let mut lines = Calculation::default();
    let [n_y, k] = [parameters.tie_strength, parameters.tie_stiffness].map(|value| n(1e-3 * value));
    let [g0, e_p] = [parameters.tie_slack, parameters.tie_ultimate].map(millimetres);
    let [h, y] = [parameters.height, parameters.tie_height].map(n);
    if tie.engaged > 0.0 {
        let put = format!("{g0} · {h}/(2 · {y})");
        lines.line(["The tie begins to pull at", ""], ["u_g = g_0 h/(2 y)", &put], (1e3 * tie.engaged, "mm"));
    }
    if let Some(yields) = tie.yields {
        let put = format!("({n_y}/{k} · 10³ + {g0}) · {h}/(2 · {y})");
        let left = "u_y = (N_y/K + g_0) h/(2 y)";
        lines.line(["The tie reaches its strength at", ""], [left, &put], (1e3 * yields, "mm"));
    }
    if let Some(breaks) = tie.breaks {
        let put = format!("({n_y}/{k} · 10³ + {g0} + {e_p}) · {h}/(2 · {y})");
        let left = "u_r = (N_y/K + g_0 + e_p) h/(2 y)";
        lines.line(["The tie breaks at", ""], [left, &put], (1e3 * breaks, "mm"));
    }
    if side.activation.force > 0.0 {
        activation(case, side, &mut lines);
    }
    if let Some(broken) = &side.tie_break {
        rupture(side, broken, &mut lines);
    }
    lines.table()
}

/// The wall at its activation with the tie at its strength.
fn activation(case: &Checked<'_>, side: &SideVerdict, lines: &mut Calculation) {
    let parameters = &case.parameters;
    let [h, y] = [parameters.height, parameters.tie_height].map(n);
    let pull = kilonewtons(side.activation.force);
    let lever = 2.0 * parameters.tie_height / parameters.height;
    let pushed = kilonewtons(side.pushed_weight);
    let put = format!("({} + 2 · {y}/{h} · {pull})/{pushed}", kilonewtons(side.acting_force));
    lines.line(
        ["Multiplier of activation with the tie at its strength, without FC", "[C8.7.1.1]"],
        ["α0 = [F_act + (2 y/h) N_y]/(W + 2 r O)", &put],
        (side.activation.alpha0, ""),
    );
    let g = parameters.gravity;
    let own = if side.t0 > 0.0 { ("a_y", side.ay) } else { ("a_0", side.a0) };
    let put = format!("{} + 2 · {y}/{h} · {pull} · {}/{pushed}", n(own.1), n(g));
    lines.line(
        ["Acceleration of activation with the tie at its strength, without FC", ""],
        [&format!("a = {} + (2 y/h) N_y g/[(W + 2 r O) e*]", own.0), &put],
        (side.activation.acceleration, "m/s²"),
    );
    if side.t0 > 0.0 {
        let stiffness = lever * lever * parameters.tie_stiffness * g / (side.pushed_weight * side.d_per_u);
        let put = format!("2π/√({} + {})", n((TAU / side.t0).powi(2)), n(stiffness));
        lines.line(
            ["Period of wall and tie", "[C8.7.1.6]"],
            ["T_0t = 2π/√[4π²/T0² + (2 y/h)² K g/((W + 2 r O) e* d/u)]", &put],
            (side.activation.t0, "s"),
        );
    }
}

/// What the curve loses where the tie breaks.
fn rupture(side: &SideVerdict, broken: &TieBreak, lines: &mut Calculation) {
    let TieBreak { before, after, largest, loss, .. } = *broken;
    let put = format!("({} − {})/{}", n(before), n(after), n(largest));
    let words = "What the curve, with FC, loses there for good, over its largest a";
    lines.line([words, "C8.7.1.2.1.6"], ["Δa/a_max", &put], (loss, ""));
    let early = side.slv.is_some_and(|check| check.limited_by_tie);
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
fn required(case: &Checked<'_>, side: &SideVerdict) -> String {
    let (fc, q) = (case.statement.confidence_factor, case.statement.behaviour_factor);
    let Parameters { tie_height, height, gravity, .. } = case.parameters;
    let own = if side.t0 > 0.0 { ("a_y", side.ay) } else { ("a_0", side.a0) };
    let (mut lines, mut rows) = (Calculation::default(), Vec::new());
    let all = [("SLD", side.sld, 1.0), ("SLV with q", side.slv_q, q)];
    for (name, check, factor) in all {
        let Some((check, force)) = check.and_then(|check| Some((check, check.required?))) else { continue };
        let lacking = fc * check.demand / factor - own.1;
        let lever = 2.0 * tie_height / height;
        let found = (lacking * side.pushed_weight / (gravity * lever)).max(0.0);
        let put = format!(
            "max[0; ({} · {}{} − {}) · {}/({} · 2 · {}/{})]",
            n(fc),
            n(check.demand),
            if factor == 1.0 { String::new() } else { format!("/{}", n(factor)) },
            n(own.1),
            kilonewtons(side.pushed_weight),
            n(gravity),
            n(tie_height),
            n(height)
        );
        // a tie that does not count here changes the period, and with it the demand
        let put = if gives(found, force) || found == force { put } else { String::new() };
        let divisor = if factor == 1.0 { "" } else { "/q" };
        let left = format!("N = max[0; (FC S_a{divisor} − {}) (W + 2 r O) e*/(g 2 y/h)]", own.0);
        let words = format!("Required force for ζ_E = 1, {name}");
        lines.line([&words, ""], [&left, &put], (1e-3 * force, "kN"));
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
            lines.line([&format!("Without the tie, {state}"), ""], ["ζ_E", ""], (zeta, ""));
        }
    }
    text + &lines.table()
}
