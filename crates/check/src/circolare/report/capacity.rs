//! The capacity curve: its numbers, and the curve over the demand.

use std::f64::consts::TAU;

use crate::circolare::figure::{CAPACITY, DEMAND, color, over_demand};
use crate::circolare::{Activation, Checked, LARGEST_LOSS, LimitState, Side, SideVerdict, TieBreak};
use crate::error::CheckError;
use crate::report::Figure;
use ::report::palette::{BLACK, sign};
use rocking_wall::variables::{EccentricityMode, ForceLaw, Mechanism};

use crate::report::markup::{Calculation, formula, shown as n, side_head};

pub(super) fn section(case: &Checked<'_>) -> Result<String, CheckError> {
    let mut text = String::new();
    for (name, side, verdict) in case.sides() {
        if !case.outcome.alike {
            text.push_str(&side_head(name));
        }
        text += &numbers(case, side, verdict);
    }
    for (name, _, side) in case.sides() {
        if side.slv.is_some() || side.slc.is_some() {
            text += &figure(case, name, side)?.html();
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
    let line = |color: &str, style: &str, name: &str| {
        entry(format!("<i class=\"chip line\" style=\"border-top:2px {style} {color}\"></i>"), name)
    };
    let mut key = line(BLACK, "solid", &format!("{} with FC", formula("a(d)")));
    for (state, check) in [(LimitState::Slv, side.slv), (LimitState::Slc, side.slc)] {
        if check.is_none() {
            continue;
        }
        let color = color(state);
        key += &entry(sign(color, CAPACITY), &formula(&format!("d_{state}")));
        key += &entry(sign(color, DEMAND), &format!("demand of {state}"));
        key += &line(color, "dashed", &format!("secant to {}", formula(&format!("d_{state}"))));
        key += &line(color, "dotted", &formula(&format!("T_{state}")));
        key += &line(color, "solid", "its spectrum");
    }
    let caption = format!(
        "Capacity curve over the demand, {}. A wall passes by displacement where its circle lies right of \
         the triangle of the same colour. <span class=\"key\">{key}</span>",
        ::report::escaped(name)
    );
    Ok(Figure { caption, plot: over_demand(side, case.statement, &case.demands)? })
}

/// The numbers of one side, from the force to the curve.
fn numbers(case: &Checked<'_>, side: Side, verdict: &SideVerdict) -> String {
    let parameters = &case.parameters;
    let body = case.wall.body();
    let r = case.statement.table.overburden_mass.unwrap_or(0.0);
    let o = body.overburden;
    let SideVerdict { alpha0, mass, a0, d0, d_per_u, acting_force, pushed_weight, .. } = *verdict;
    let mut lines = Calculation::default();
    let [rho, h, b, l, g] =
        [parameters.density, parameters.height, parameters.thickness, parameters.width, parameters.gravity]
            .map(n);
    lines.line(
        ["Weight", ""],
        ["W = ρ h b l g", &format!("{rho} · {h} · {b} · {l} · {g}")],
        (body.weight, "N"),
    );
    let (left, put) = force(case, side, acting_force);
    let has_plateau = parameters.multilinear.is_some() || parameters.force_law == ForceLaw::Trilinear;
    let words = if has_plateau {
        "Largest force of the law"
    } else {
        "Force at u = 0 of the line that falls to its zero"
    };
    lines.line([words, ""], [left, &put], (acting_force, "N"));
    let is_parapet = body.mechanism == Mechanism::Parapet;
    let loaded = is_parapet && o > 0.0;
    let divisor = if loaded { "α0 = F_act/(W + 2 r O)" } else { "α0 = F_act/W" };
    let put = format!("{}/{}", n(acting_force), n(pushed_weight));
    lines.line(["Multiplier of activation", "[C8.7.1.1]"], [divisor, &put], (alpha0, ""));
    lines.line(["One resultant on each body", "[C8.7.1.5]"], ["e*", ""], (verdict.e_star, ""));
    let (formula_of, put) = if loaded {
        ("M* = e* (W + r O)/g", format!("1 · ({} + {} · {})/{g}", n(body.weight), n(r), n(o)))
    } else {
        ("M* = e* W/g", format!("1 · {}/{g}", n(body.weight)))
    };
    lines.line(["Participating mass", ""], [formula_of, &put], (mass, "kg"));
    let put = format!("{} · {g}/1", n(alpha0));
    lines.line(["Acceleration of activation, without FC", ""], ["a_0 = α0 g/e*", &put], (a0, "m/s²"));
    let ratio = match (is_parapet, loaded) {
        (_, true) => "d/u = (W + 2 r O)/(W + r O)",
        (true, false) => "d/u",
        (false, _) => "d/u = 1/2 · W/W",
    };
    lines.line(["Displacement of the code over that of the model", "[C8.7.1.4]"], [ratio, ""], (d_per_u, ""));
    let put = format!("{} · {}", n(d_per_u), n(d0 / d_per_u));
    let words = "Zero of the curve of the wall without a tie";
    lines.line([words, "C8.7.1.2.1.6"], ["d_0 = (d/u) u_0", &put], (d0, "m"));
    elastic(case, verdict, &mut lines);
    if let Some(broken) = &verdict.tie_break {
        tie(case, verdict, broken, &mut lines);
    }
    lines.table()
}

/// The formula of `F_act` and the numbers put in, where it is F0 of Eq. (1).
fn force(case: &Checked<'_>, side: Side, acting: f64) -> (&'static str, String) {
    let parameters = &case.parameters;
    let body = case.wall.body();
    let sign = if side == Side::Negative { -1.0 } else { 1.0 };
    let strength = body.strength.of(sign);
    if (acting - strength).abs() > 1e-9 * strength {
        return ("F_act", String::new());
    }
    let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot;
    let c = if follows { 1.0 } else { sign } * parameters.overburden_eccentricity;
    let [w, o, b, h, c] = [body.weight, body.overburden, parameters.thickness, body.height, c + 0.0].map(n);
    match body.mechanism {
        Mechanism::Parapet if body.overburden == 0.0 => ("F_act = F0 = W b/h", format!("{w} · {b}/{h}")),
        Mechanism::Parapet => {
            ("F_act = F0 = [(W + O) b − 2 O c]/h", format!("[({w} + {o}) · {b} − 2 · {o} · ({c})]/{h}"))
        }
        Mechanism::VerticalSpanning => {
            let [h1, h2] = [body.hinge_height, body.height - body.hinge_height].map(n);
            let put = format!("2/{h1} · ({w} + {o}) · {b} + {o} · ({b} + 2 · ({c}))/{h2}");
            ("F_act = F0 = (2/h_1) (W + O) b + O (b + 2 c)/h_2", put)
        }
    }
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
            let at_end = dy * (TAU / t0).powi(2);
            let put = format!("2π √({}/{})", n(dy), n(at_end));
            let words =
                format!("Period of the elastic branch of the force law, to its end {}", formula("d_1, a_1"));
            lines.line([&words, "[C8.7.1.6]"], ["T0 = 2π √(d_1/a_1)", &put], (t0, "s"));
            lines.line(["End of the elastic branch", ""], ["d_y = d_1", ""], (dy, "m"));
            lines.line(["Largest acceleration, without FC", ""], ["a_y", ""], (ay, "m/s²"));
        }
        Some(Activation::Beam) => {
            let parapet = parameters.mechanism == Mechanism::Parapet;
            let factor = if parapet { "6.2" } else { "2.2" };
            let [h, b, rho] = [parameters.height, parameters.thickness, parameters.density].map(n);
            let e = n(case.statement.table.young_modulus.unwrap_or(f64::NAN));
            let put = format!("{factor} · ({h}/{b}) · {h} · √({rho}/{e})");
            let words = "Period of a uniform beam";
            lines.line([words, "[C8.7.1.7]"], ["T0 = κ λ L √(W_s/(E g))", &put], (t0, "s"));
            let k = (TAU / t0).powi(2);
            let put = format!("{}/({} + {}/{})", n(a0), n(k), n(a0), n(d0));
            let words = "End of the elastic branch";
            lines.line([words, "[C8.7.1.6]"], ["d_y = a_0/(4π²/T0² + a_0/d_0)", &put], (dy, "m"));
            let put = format!("{} · {}", n(k), n(dy));
            lines.line(["Acceleration there, without FC", ""], ["a_y = (4π²/T0²) d_y", &put], (ay, "m/s²"));
        }
    }
}

/// Adds where the tie breaks, and what the curve loses there.
fn tie(case: &Checked<'_>, verdict: &SideVerdict, broken: &TieBreak, lines: &mut Calculation) {
    let parameters = &case.parameters;
    let [n_s, k, g0, h, y] = [
        parameters.tie_strength,
        parameters.tie_stiffness,
        parameters.tie_slack,
        parameters.height,
        parameters.tie_height,
    ]
    .map(n);
    let TieBreak { u, before, after, largest, loss } = *broken;
    let e_p = n(parameters.tie_ultimate);
    let put = format!("({n_s}/{k} + {g0} + {e_p}) · {h}/(2 · {y})");
    lines.line(["The tie breaks at", ""], ["u_r = (N_y/K + g_0 + e_p) h/(2 y)", &put], (u, "m"));
    let [before, after, most] = [before, after, largest].map(n);
    let put = format!("({before} − {after})/{most}");
    let words = "What the curve loses there for good, over its largest a";
    lines.line([words, "C8.7.1.2.1.6"], ["Δa/a_max", &put], (loss, ""));
    let early = verdict.slv.is_some_and(|check| check.limited_by_tie);
    let decides = if early {
        format!("more than {LARGEST_LOSS}, before 0.40 {}: {} is there", formula("d_0"), formula("d_SLV"))
    } else {
        format!("{} stays at 0.40 {}", formula("d_SLV"), formula("d_0"))
    };
    lines.say("Consequence", &decides);
}
