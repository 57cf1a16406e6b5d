//! Every static check with its clause, equations, the numbers put in and the result.

use crate::circolare::curve::Curve;
use crate::circolare::statement::Displacements;
use crate::circolare::{
    ActivationCheck, Checked, Demand, DisplacementCheck, MEAN_COUNTS_FROM, SideVerdict, StateStatement,
};
use crate::names::{Deciding, LimitState};
use rocking_wall::wall::Parameters;

use super::calculation;
use super::spectrum::gives;
use crate::circolare::demand::LONGEST_PERIOD;
use crate::report::markup::{Calculation, formula, result, shown as n, side_head};

/// The sections of all checks that are made.
pub(super) fn sections(case: &Checked<'_>) -> Vec<(String, String)> {
    let titles = [
        "SLD: activation C8.7.1.2.1.5",
        "SLV with q C8.7.1.2.1.7",
        "SLV by displacement C8.7.1.2.1.8",
        "SLC by displacement C8.7.1.2.1.8",
    ];
    let made =
        Deciding::ALL.into_iter().zip(titles).map(|(check, title)| (title.to_owned(), one(case, check)));
    made.filter(|(_, markup)| !markup.is_empty()).collect()
}

/// A check of both sides; empty where it is not made.
fn one(case: &Checked<'_>, check: Deciding) -> String {
    let mut demanded = case.statement.demanded(&case.demands);
    let Some((given, demand)) = demanded.find(|(given, _)| given.state == check.state()) else {
        return String::new();
    };
    let xi = case.statement.state(LimitState::Sld).map_or(0.05, |given| given.damping);
    let mut text = String::new();
    for (name, of, side) in case.sides() {
        let lines = || calculation(case, of, &side.curve);
        let activated = |check, q| activation(lines(), side, (given, demand, xi), (check, q));
        let displaced = |check| displacement(case, lines(), side, (given, demand), check);
        let calculation = match check {
            Deciding::Sld => side.checks.sld.map(|check| activated(check, 1.0)),
            Deciding::SlvWithQ => {
                side.checks.slv_q.map(|check| activated(check, case.statement.behaviour_factor))
            }
            Deciding::Slv | Deciding::Slc => side.displacement(given.state).map(displaced),
        };
        let Some(calculation) = calculation else { continue };
        let head = if case.outcome.alike { String::new() } else { side_head(name) };
        text.push_str(&["<div class=\"together\">", &head, &calculation, "</div>\n"].concat());
    }
    text
}

/// A check of accelerations, with a factor q.
fn activation(
    mut lines: Calculation,
    side: &SideVerdict,
    (given, demand, xi): (&StateStatement, &Demand, f64),
    (check, q): (ActivationCheck, f64),
) -> String {
    let held = check.t0 == 0.0;
    own_hinge(&mut lines, side, check.hinge);
    let is_tied = side.activation.force > 0.0;
    let symbol = match (is_tied, held) {
        (true, _) => "a",
        (false, true) => "a_0",
        (false, false) => "a_y",
    };
    let source = if held { "[C8.7.1.8]" } else { "[C8.7.1.9]" };
    let words = if is_tied { "Capacity with the tie at its strength, with FC" } else { "Capacity, with FC" };
    lines.know(&[(symbol, check.acceleration)]);
    let formula_of = if q == 1.0 { format!("{symbol}/FC") } else { format!("q {symbol}/FC") };
    lines.line([words, source], &formula_of, (check.capacity, "m/s²"));
    let at_t0 =
        format!("Demand at {} = {} s, {} = {} %", formula("T0"), n(check.t0), formula("ξ"), n(100.0 * xi));
    let of_t0 = super::spectrum::of(&mut lines, demand, ("T0", check.t0), xi);
    let (words, source, formula_of) = match demand {
        Demand::Ground(_) if held => ("Demand", "[3.2.2], T = 0", "a_g S"),
        Demand::Ground(_) => (&*at_t0, "[3.2.2]", &*of_t0),
        Demand::Floor(floor) if floor.ground_governs(check.t0, xi) => {
            let words = [
                "Demand: the ground governs, above the S_eZ of the height",
                "Demand: the ground governs, above the a_Z of the height",
            ];
            (words[usize::from(held)], "[3.2.2]", "a_g S")
        }
        Demand::Floor(_) if held => ("Demand", "[C7.2.8]", "a_Z"),
        Demand::Floor(_) => (&*at_t0, "[C7.2.6]", &*of_t0),
        Demand::Points(..) => (&*at_t0, "the spectrum given", "S_e(T0, ξ)"),
        Demand::Records(_) => (&*at_t0, "the records", "S_e(T0, ξ)"),
    };
    lines.line([words, source], formula_of, (check.demand, "m/s²"));
    let put = format!("{}/{}", n(check.capacity), n(check.demand));
    lines.line_of(["Safety index", "NTC 8.3"], ["ζ_E", &put], (check.ratio, ""));
    end(&mut lines, given, check.ratio, check.ag);
    lines.table()
}

/// Says where the hinge of a check is that is not that of its side: its numbers are of that hinge.
fn own_hinge(lines: &mut Calculation, side: &SideVerdict, hinge: Option<f64>) {
    if let Some(hinge) = hinge.filter(|_| hinge != side.curve.hinge) {
        lines.line_of(["Hinge of this check, with its own curve", ""], ["h_1/h", ""], (hinge, ""));
    }
}

/// The last lines of a check: `a_g` and the result.
fn end(lines: &mut Calculation, given: &StateStatement, zeta: f64, ag: f64) {
    lines.know(&[("ζ_E", zeta), ("a_g", given.ag)]);
    lines.line(["Acceleration that it bears", ""], "a_g,cap = ζ_E a_g", (ag, "g"));
    lines.say("Result", result(zeta >= 1.0));
}

/// A check of displacements.
fn displacement(
    case: &Checked<'_>,
    mut lines: Calculation,
    side: &SideVerdict,
    (given, demand): (&StateStatement, &Demand),
    check: DisplacementCheck,
) -> String {
    own_hinge(&mut lines, side, check.hinge);
    let state = given.state;
    let source = if state == LimitState::Slc { "[C8.7.1.11]" } else { "[C8.7.1.10]" };
    let Displacements { fraction: share, period_factor: factor } = case.statement.rules(state);
    let own = side.at(check.hinge);
    let of_curve = share * own.d0;
    let u = 1e3 * check.d / side.curve.d_per_u;
    lines.know(&[("d", 1e3 * check.d), ("u_r", u), ("u", u), ("d_0", 1e3 * own.d0)]);
    let (words, capacity) = if check.limited_by_tie {
        ("Capacity, where the tie breaks", "(d/u) u_r".to_owned())
    } else if (check.d - of_curve).abs() > 1e-9 * of_curve {
        ("Capacity, at the local instability stated", "(d/u) u".to_owned())
    } else {
        ("Capacity", format!("{share:.2} d_0"))
    };
    lines.line([words, "C8.7.1.2.1.6"], &format!("d_{state} = {capacity}"), (1e3 * check.d, "mm"));
    let of_curve = on_curve(case, &mut lines, own, &check);
    let words = ["The curve there, with FC", "[C8.7.1.3]"];
    lines.line(words, &format!("a(d_{state}){of_curve}"), (check.a, "m/s²"));
    lines.know(&[("a", check.a)]);
    let formula_of = format!("T_{state} = {factor} π √(d_{state} {{10⁻³}}/a)");
    lines.line(["Period", source], &formula_of, (check.period, "s"));
    if check.period > LONGEST_PERIOD && matches!(demand, Demand::Ground(_) | Demand::Floor(_)) {
        lines.say(
            "Range of the spectra <small>NTC 3.2.3.2</small>",
            "T &gt; 4 s: the demand is outside and needs a spectrum of a special study",
        );
    }
    demanded(&mut lines, given, demand, &check);
    lines.know(&[("S_d", 1e3 * check.demand)]);
    lines.line(["Capacity over demand", ""], &format!("d_{state}/S_d"), (check.ratio, ""));
    if check.raised {
        lines.know(&[("a_g,SLD", check.ag), (&format!("a_g,{state}"), given.ag)]);
        let words = format!("The acceleration of activation at SLD is larger than {} g and replaces it", {
            n(check.ratio * given.ag)
        });
        lines.line([&words, "C8.7.1.2.1.8"], &format!("ζ_E = a_g,SLD/a_g,{state}"), (check.zeta, ""));
    } else {
        lines.line_of(["Safety index", "NTC 8.3"], [&format!("ζ_E = d_{state}/S_d"), ""], (check.zeta, ""));
    }
    end(&mut lines, given, check.zeta, check.ag);
    lines.table()
}

/// The formula behind `a(d)` of the line of the wall with the force of its tie; empty where a law of another
/// form has the curve.
fn on_curve(
    case: &Checked<'_>,
    lines: &mut Calculation,
    curve: &Curve,
    check: &DisplacementCheck,
) -> &'static str {
    let factor = case.statement.confidence_factor;
    let own = curve.a0 * (1.0 - check.d / curve.d0);
    lines.know(&[("a_0", curve.a0), ("d_0", 1e3 * curve.d0)]);
    if gives(own / factor, check.a) {
        return " = a_0 (1 − d/d_0)/FC";
    }
    let Parameters { tie_height, height, gravity, .. } = case.parameters;
    let force = check.tie.map_or(0.0, |tie| tie.force);
    let pull = 2.0 * tie_height / height * force * gravity / curve.pushed_weight;
    lines.know(&[("N", 1e-3 * force)]);
    let is_tied = gives((own + pull) / factor, check.a);
    if is_tied { " = [a_0 (1 − d/d_0) + (2 y/h) N g/((W + 2 r O) e*)]/FC" } else { "" }
}

/// The demand of displacement: both terms where there are two.
fn demanded(lines: &mut Calculation, given: &StateStatement, demand: &Demand, check: &DisplacementCheck) {
    let t = format!("T_{}", given.state);
    let xi = given.damping;
    let words = format!("Spectrum at {} and {} = {} %", formula(&t), formula("ξ"), n(100.0 * xi));
    let source = match demand {
        Demand::Ground(_) => "[3.2.2]",
        Demand::Floor(_) => "[C7.2.6]",
        Demand::Points(..) => "the spectrum given",
        Demand::Records(records) if records.len() >= MEAN_COUNTS_FROM => "mean of the records",
        Demand::Records(_) => "envelope of the records",
    };
    let formula_of = super::spectrum::of(lines, demand, (&t, check.period), xi);
    lines.line([&words, source], &formula_of, (check.acceleration, "m/s²"));
    let symbol = if demand.floor().is_some() { "S_eZ" } else { "S_e" };
    let at_period = format!("{symbol}({t})");
    let first_term = format!("{at_period} {t}²/(4π²) {{10³}}");
    lines.know(&[(&at_period, check.acceleration)]);
    let (words, source, formula_of) = match (demand, check.demand_terms) {
        (Demand::Points(..) | Demand::Records(_), _) => {
            let words = format!("Demand: the largest from {} to {}", formula("T0"), formula(&t));
            (words, "C8.7.1.2.1.8", "S_d = max S_e T²/(4π²)".to_owned())
        }
        (Demand::Floor(floor), [Some(first), Some(second)]) => {
            lines.line(["Demand, first term", "[C8.7.1.12]"], &first_term, (1e3 * first, "mm"));
            let t1 = floor.first_period();
            let at_first = floor.acceleration(t1, xi);
            let formula_of = super::spectrum::of(lines, demand, ("T_1", t1), xi);
            lines.line(["Spectrum at T_1", "[C7.2.6]"], &formula_of, (at_first, "m/s²"));
            lines.know(&[("S_eZ(T_1)", at_first)]);
            let formula_of = "S_eZ(T_1) (1.1 T_1)²/(4π²) {10³}";
            lines.line(["Demand, second term", "[C8.7.1.12]"], formula_of, (1e3 * second, "mm"));
            ("Demand, the larger".to_owned(), "", "S_d".to_owned())
        }
        (Demand::Floor(_), _) => ("Demand".to_owned(), "[C8.7.1.12]", format!("S_d = {first_term}")),
        (Demand::Ground(ground), _) if check.period > ground.t_e => {
            let words = format!("Demand, beyond {}", formula("T_E"));
            (words, "[3.2.11], [3.2.12]", format!("S_d = S_De({t}, ξ)"))
        }
        (Demand::Ground(_), _) => ("Demand".to_owned(), "[3.2.10]", format!("S_d = {first_term}")),
    };
    lines.line([&words, source], &formula_of, (1e3 * check.demand, "mm"));
}
