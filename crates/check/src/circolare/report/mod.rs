//! The sections of the report: every statement, number and check, with its clause and equations.

pub(super) mod capacity;
mod hinges;
mod inputs;
mod limit_states;
pub(super) mod overview;
pub(super) mod readings;
mod runs;
pub(super) mod site;
mod spectrum;
pub(super) mod symbols;
mod ties;

use crate::names::Side;
use rocking_wall::variables::EccentricityMode;
use rocking_wall::wall::Parameters;

use super::curve::Curve;
use super::sides::SideVerdict;
use super::table::{Activation, Hinge};
use crate::circolare::Checked;
use crate::error::CheckError;
use crate::report::markup::{Calculation, side_head};
use crate::report::{Origin, the_wall};

/// What is to be said of each side, under its name where they differ; nothing of one is left out.
fn by_side(case: &Checked<'_>, say: impl Fn(Side, &SideVerdict) -> String) -> String {
    let mut text = String::new();
    for (name, side, verdict) in case.sides() {
        let own = say(side, verdict);
        if !own.is_empty() && !case.outcome.alike {
            text += &side_head(name);
        }
        text += &own;
    }
    text
}

/// A calculation that knows the wall, and the numbers of a side with its hinge: forces in kN, displacements
/// in mm.
fn calculation(case: &Checked<'_>, side: Side, curve: &Curve) -> Calculation {
    let (parameters, body) = (&case.parameters, curve.body());
    let (w, o, h1) = (1e-3 * body.weight, 1e-3 * body.overburden, body.hinge_height);
    let pushed = 1e-3 * curve.pushed_weight;
    let above = w * (1.0 - h1 / body.height) + o;
    let mut lines = Calculation::default();
    lines.know(&[
        ("ρ", parameters.density),
        ("g", parameters.gravity),
        ("h", body.height),
        ("b", parameters.thickness),
        ("l", parameters.width),
        ("h_1", h1),
        ("h_2", body.height - h1),
        ("r", case.statement.table.overburden_mass.unwrap_or(0.0)),
        ("c", eccentricity(case, side)),
        ("W", w),
        ("O", o),
        ("(W + O)", w + o),
        ("(W_2 + O)", above),
        ("(W + 2 r O)", pushed),
        ("((W + 2 r O) e*)", pushed),
        ("[(W + 2 r O) e*]", pushed),
        ("(W + 2 r O) e*", pushed),
        ("F0", 1e-3 * body.strength.of(side.sign())),
        ("F_act", 1e-3 * curve.acting_force),
        ("e*", curve.e_star),
        ("α0", curve.alpha0),
        ("a_0", curve.a0),
        ("a_y", curve.ay),
        ("d_y", 1e3 * curve.dy),
        ("(d/u)", curve.d_per_u),
        ("d_0", 1e3 * curve.d0),
        ("u_0", 1e3 * curve.d0 / curve.d_per_u),
        ("k_0", 1e-3 * curve.acting_force * curve.d_per_u / curve.d0),
        ("T0", curve.t0),
        ("h_1/h", curve.hinge.unwrap_or(f64::NAN)),
        ("t_b", 1e3 * curve.set_back.base),
        ("t_m", 1e3 * curve.set_back.middle),
        ("t_t", 1e3 * curve.set_back.top),
        ("FC", case.statement.confidence_factor),
        ("q", case.statement.behaviour_factor),
        ("K", 1e-3 * parameters.tie_stiffness),
        ("N_y", 1e-3 * parameters.tie_strength),
        ("g_0", 1e3 * parameters.tie_slack),
        ("e_p", 1e3 * parameters.tie_ultimate),
        ("y", parameters.tie_height),
    ]);
    lines
}

/// The eccentricity of the overburden, positive towards the side that it loads least \[m\].
fn eccentricity(case: &Checked<'_>, side: Side) -> f64 {
    let Parameters { eccentricity_mode, overburden_eccentricity, .. } = case.parameters;
    let follows = eccentricity_mode == EccentricityMode::FollowsPivot;
    if follows { overburden_eccentricity } else { side.sign() * overburden_eccentricity + 0.0 }
}

/// The groups of parameters that the static check uses, and those that only runs use.
const STATIC: [&str; 3] = ["geometry", "force_law", "tie"];
const DYNAMIC: [&str; 3] = ["damping", "impact", "solver"];

/// The sections, each with its heading.
pub(super) fn sections(case: &Checked<'_>, origin: &Origin<'_>) -> Result<Vec<(String, String)>, CheckError> {
    let is_dynamic = case.outcome.dynamic.is_some();
    let is_law = case.statement.table.before_activation == Some(Activation::Law);
    let is_used = |group: &str, name: &str| {
        // a wall that is rigid or a beam before it rocks has no elastic branch of its law
        let is_left_out = case.parameters.a3 == 1.0 && matches!(name, "force_law" | "a3" | "softening");
        let replaced = (name == "a1" || is_left_out) && !is_dynamic && !is_law;
        // a hinge that is searched has a section of its own
        let replaced =
            replaced || name == "hinge_ratio" && case.rule.is_some_and(|rule| rule != Hinge::Given);
        (STATIC.contains(&group) || is_dynamic && DYNAMIC.contains(&group)) && !replaced
    };
    let one = |heading: &str, markup: String| (heading.to_owned(), markup);
    let mut sections = vec![
        one("Statements of the engineer", inputs::statements(case, origin)),
        one("The wall", the_wall(&case.wall, &case.parameters, origin, &is_used)),
        one("Demand at the wall", site::at_wall(case)?),
    ];
    sections.extend(hinges::section(case).map(|markup| one("Hinges", markup)));
    sections.push(one("Capacity curve", capacity::section(case)?));
    sections.extend(ties::section(case).map(|markup| one("The tie", markup)));
    sections.extend(limit_states::sections(case));
    sections.extend(runs::section(case).map(|markup| one("Runs under records C8.7.1.2.1.9", markup)));
    Ok(sections)
}
