//! Every static check with its clause, equations, the numbers put in and the result.

use crate::circolare::statement::Displacements;
use crate::circolare::{
    ActivationCheck, Checked, Deciding, Demand, DisplacementCheck, LimitState, MEAN_COUNTS_FROM, SideVerdict,
    StateStatement,
};
use rocking_wall::wall::Parameters;

use super::spectrum::gives;
use crate::circolare::warnings::LONGEST_PERIOD;
use crate::report::markup::{Calculation, formula, kilonewtons, millimetres, result, shown as n, side_head};

/// a and b of C7.2.3 times the first period, from where the second term of [C8.7.1.12] counts.
const BEYOND: f64 = 1.1;

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
    let activated = |side, check, q| activation((case, side), (given, demand, xi), check, q);
    let mut text = String::new();
    for (name, _, side) in case.sides() {
        let displaced =
            || side.displacement(given.state).map(|found| displacement((case, side), (given, demand), found));
        let calculation = match check {
            Deciding::Sld => side.sld.map(|found| activated(side, found, 1.0)),
            Deciding::SlvWithQ => {
                side.slv_q.map(|found| activated(side, found, case.statement.behaviour_factor))
            }
            Deciding::Slv | Deciding::Slc => displaced(),
        };
        let Some(calculation) = calculation else { continue };
        let head = if case.outcome.alike { String::new() } else { side_head(name) };
        text.push_str(&["<div class=\"together\">", &head, &calculation, "</div>\n"].concat());
    }
    text
}

/// A check of accelerations, with a factor q.
fn activation(
    (case, side): (&Checked<'_>, &SideVerdict),
    (given, demand, xi): (&StateStatement, &Demand, f64),
    check: ActivationCheck,
    q: f64,
) -> String {
    let held = check.t0 == 0.0;
    let mut lines = Calculation::default();
    own_hinge(&mut lines, side, check.hinge);
    let factor = n(case.statement.confidence_factor);
    let is_tied = side.activation.force > 0.0;
    let (symbol, source) = match (is_tied, held) {
        (true, true) => ("a", "[C8.7.1.8]"),
        (true, false) => ("a", "[C8.7.1.9]"),
        (false, true) => ("a_0", "[C8.7.1.8]"),
        (false, false) => ("a_y", "[C8.7.1.9]"),
    };
    let words = if is_tied { "Capacity with the tie at its strength, with FC" } else { "Capacity, with FC" };
    let value = n(check.acceleration);
    let (left, put) = if q == 1.0 {
        (format!("{symbol}/FC"), format!("{value}/{factor}"))
    } else {
        (format!("q {symbol}/FC"), format!("{} · {value}/{factor}", n(q)))
    };
    lines.line([words, source], [&left, &put], (check.capacity, "m/s²"));
    let [at_left, at_put] = super::spectrum::of(demand, ("T0", check.t0), xi);
    let at_t0 =
        || format!("Demand at {} = {} s, {} = {} %", formula("T0"), n(check.t0), formula("ξ"), n(100.0 * xi));
    let (words, source, left, put) = match demand {
        Demand::Ground(ground) if held => {
            let put = format!("{} · {}", n(ground.a_g), n(ground.s));
            ("Demand".to_owned(), "[3.2.2], T = 0", "a_g S", put)
        }
        Demand::Ground(_) => (at_t0(), "[3.2.2]", &*at_left, at_put),
        Demand::Floor(floor) if floor.ground_governs(check.t0, xi) => {
            let ground = floor.ground();
            let put = format!("{} · {}", n(ground.a_g), n(ground.s));
            let of_height = if held { "a_Z" } else { "S_eZ" };
            let words = format!("Demand: the ground governs, above the {of_height} of the height");
            (words, "[3.2.2]", "a_g S", put)
        }
        Demand::Floor(_) if held => ("Demand".to_owned(), "[C7.2.8]", "a_Z", String::new()),
        Demand::Floor(_) => (at_t0(), "[C7.2.6]", &*at_left, at_put),
        Demand::Points(..) => (at_t0(), "the spectrum given", "S_e(T0, ξ)", String::new()),
        Demand::Records(_) => (at_t0(), "the records", "S_e(T0, ξ)", String::new()),
    };
    lines.line([&words, source], [left, &put], (check.demand, "m/s²"));
    let put = format!("{}/{}", n(check.capacity), n(check.demand));
    lines.line(["Safety index", "NTC 8.3"], ["ζ_E", &put], (check.ratio, ""));
    end(&mut lines, given, check.ratio, check.ag);
    lines.table()
}

/// Says where the hinge of a check is that is not that of its side: its numbers are of that hinge.
fn own_hinge(lines: &mut Calculation, side: &SideVerdict, hinge: Option<f64>) {
    if let Some(hinge) = hinge.filter(|_| hinge != side.hinge) {
        lines.line(["Hinge of this check, with its own curve", ""], ["h_1/h", ""], (hinge, ""));
    }
}

/// The last lines of a check: `a_g` and the result.
fn end(lines: &mut Calculation, given: &StateStatement, zeta: f64, ag: f64) {
    let put = format!("{} · {}", n(zeta), n(given.ag));
    lines.line(["Acceleration that it bears", ""], ["a_g,cap = ζ_E a_g", &put], (ag, "g"));
    lines.say("Result", result(zeta >= 1.0));
}

/// A check of displacements.
fn displacement(
    (case, side): (&Checked<'_>, &SideVerdict),
    (given, demand): (&StateStatement, &Demand),
    check: DisplacementCheck,
) -> String {
    let mut lines = Calculation::default();
    own_hinge(&mut lines, side, check.hinge);
    let state = given.state;
    let source = if state == LimitState::Slc { "[C8.7.1.11]" } else { "[C8.7.1.10]" };
    let Displacements { fraction: share, period_factor: factor } = case.statement.rules(state);
    let (d, a, t) = (format!("d_{state}"), format!("a(d_{state})"), format!("T_{state}"));
    let of_curve = share * check.d0;
    let of_u = |u: &str| {
        let put = format!("{} · {}", n(side.d_per_u), millimetres(check.d / side.d_per_u));
        (format!("{d} = (d/u) {u}"), put)
    };
    let (words, (left, put)) = if check.limited_by_tie {
        ("Capacity, where the tie breaks", of_u("u_r"))
    } else if (check.d - of_curve).abs() > 1e-9 * of_curve {
        ("Capacity, at the local instability stated", of_u("u"))
    } else {
        ("Capacity", (format!("{d} = {share:.2} d_0"), format!("{share:.2} · {}", millimetres(check.d0))))
    };
    lines.line([words, "C8.7.1.2.1.6"], [&left, &put], (1e3 * check.d, "mm"));
    let [of_curve, put] = on_curve(case, side.at(check.hinge), &check);
    let left = format!("{a}{of_curve}");
    lines.line(["The curve there, with FC", "[C8.7.1.3]"], [&left, &put], (check.a, "m/s²"));
    let put = format!("{factor} π √({} · 10⁻³/{})", millimetres(check.d), n(check.a));
    let left = format!("{t} = {factor} π √({d}/a)");
    lines.line(["Period", source], [&left, &put], (check.period, "s"));
    if check.period > LONGEST_PERIOD && matches!(demand, Demand::Ground(_) | Demand::Floor(_)) {
        lines.say(
            "Range of the spectra <small>NTC 3.2.3.2</small>",
            "T &gt; 4 s: the demand is outside and needs a spectrum of a special study",
        );
    }
    demanded(&mut lines, given, demand, &check);
    let put = format!("{}/{}", millimetres(check.d), millimetres(check.demand));
    lines.line(["Capacity over demand", ""], [&format!("{d}/S_d"), &put], (check.ratio, ""));
    if check.raised {
        let left = format!("ζ_E = a_g,SLD/a_g,{state}");
        let put = format!("{}/{}", n(check.ag), n(given.ag));
        let words = format!("The acceleration of activation at SLD is larger than {} g and replaces it", {
            n(check.ratio * given.ag)
        });
        lines.line([&words, "C8.7.1.2.1.8"], [&left, &put], (check.zeta, ""));
    } else {
        lines.line(["Safety index", "NTC 8.3"], [&format!("ζ_E = {d}/S_d"), ""], (check.zeta, ""));
    }
    end(&mut lines, given, check.zeta, check.ag);
    lines.table()
}

/// a(d) of the line of the wall with the force of its tie: the formula behind `a(d)`, and the numbers put in;
/// empty where a law of another form has the curve.
fn on_curve(case: &Checked<'_>, side: &SideVerdict, check: &DisplacementCheck) -> [String; 2] {
    let (factor, d) = (case.statement.confidence_factor, check.d);
    let own = side.a0 * (1.0 - d / side.d0);
    let [a_0, d_of, d_0, fc] = [n(side.a0), millimetres(d), millimetres(side.d0), n(factor)];
    let line = format!("{a_0} · (1 − {d_of}/{d_0})");
    if gives(own / factor, check.a) {
        return [" = a_0 (1 − d/d_0)/FC".to_owned(), format!("{line}/{fc}")];
    }
    let Some(tie) = check.tie else { return [const { String::new() }; 2] };
    let Parameters { tie_height, height, gravity, .. } = case.parameters;
    let lever = 2.0 * tie_height / height;
    let pull = lever * tie.force * gravity / side.pushed_weight;
    if !gives((own + pull) / factor, check.a) {
        return [const { String::new() }; 2];
    }
    let [y, h, g] = [tie_height, height, gravity].map(n);
    let (force, pushed) = (kilonewtons(tie.force), kilonewtons(side.pushed_weight));
    let put = format!("[{line} + 2 · {y}/{h} · {force} · {g}/{pushed}]/{fc}");
    [" = [a_0 (1 − d/d_0) + (2 y/h) N g/((W + 2 r O) e*)]/FC".to_owned(), put]
}

/// The demand of displacement: both terms where there are two.
fn demanded(lines: &mut Calculation, given: &StateStatement, demand: &Demand, check: &DisplacementCheck) {
    let t = format!("T_{}", given.state);
    let (period, xi) = (n(check.period), n(100.0 * given.damping));
    let words = format!("Spectrum at {} and {} = {xi} %", formula(&t), formula("ξ"));
    let source = match demand {
        Demand::Ground(_) => "[3.2.2]",
        Demand::Floor(_) => "[C7.2.6]",
        Demand::Points(..) => "the spectrum given",
        Demand::Records(records) if records.len() >= MEAN_COUNTS_FROM => "mean of the records",
        Demand::Records(_) => "envelope of the records",
    };
    let [left, put] = super::spectrum::of(demand, (&t, check.period), given.damping);
    lines.line([&words, source], [&left, &put], (check.acceleration, "m/s²"));
    let put = format!("{} · {period}²/(4π²) · 10³", n(check.acceleration));
    let (words, source, left, put) = match (demand, check.demand_terms) {
        (Demand::Points(..) | Demand::Records(_), _) => {
            let words = format!("Demand: the largest from {} to {}", formula("T0"), formula(&t));
            (words, "C8.7.1.2.1.8", "S_d = max S_e T²/(4π²)".to_owned(), String::new())
        }
        (Demand::Floor(floor), [Some(first), Some(second)]) => {
            let left = format!("S_eZ({t}) {t}²/(4π²)");
            lines.line(["Demand, first term", "[C8.7.1.12]"], [&left, &put], (1e3 * first, "mm"));
            let t1 = floor.first_period();
            let at_first = floor.acceleration(t1, given.damping);
            let [left, of_first] = super::spectrum::of(demand, ("T_1", t1), given.damping);
            lines.line(["Spectrum at T_1", "[C7.2.6]"], [&left, &of_first], (at_first, "m/s²"));
            let put = format!("{} · {BEYOND}² · {}²/(4π²) · 10³", n(at_first), n(t1));
            let left = "S_eZ(T_1) (1.1 T_1)²/(4π²)";
            lines.line(["Demand, second term", "[C8.7.1.12]"], [left, &put], (1e3 * second, "mm"));
            ("Demand, the larger".to_owned(), "", "S_d".to_owned(), String::new())
        }
        (Demand::Floor(_), _) => {
            ("Demand".to_owned(), "[C8.7.1.12]", format!("S_d = S_eZ({t}) {t}²/(4π²)"), put)
        }
        (Demand::Ground(ground), _) if check.period > ground.t_e => {
            let words = format!("Demand, beyond {}", formula("T_E"));
            (words, "[3.2.11], [3.2.12]", format!("S_d = S_De({t}, ξ)"), String::new())
        }
        (Demand::Ground(_), _) => {
            ("Demand".to_owned(), "[3.2.10]", format!("S_d = S_e({t}) {t}²/(4π²)"), put)
        }
    };
    lines.line([&words, source], [&left, &put], (1e3 * check.demand, "mm"));
}
