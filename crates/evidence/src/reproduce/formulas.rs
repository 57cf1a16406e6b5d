//! Tables 1 and 2: the paper's formulas as printed, evaluated beside the wall.

use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::{ParameterError, Parameters, Wall};

use super::PaperTable;
use crate::Comparison;

/// Returns a wall with an eccentric overburden, for which every term counts: O = W/2, c = b/10, h₁ = 0.6 h.
fn loaded(mechanism: Mechanism) -> Result<Wall, ParameterError> {
    let bare = Parameters { mechanism, hinge_ratio: 0.6, ..Parameters::default() };
    let weight = Wall::new(&bare)?.body().weight;
    Wall::new(&Parameters {
        overburden: 0.5 * weight,
        overburden_eccentricity: 0.1 * bare.thickness,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        ..bare
    })
}

/// Symbols of the formulas: h, h₁ and h₂, b, c, W, O.
fn symbols(wall: &Wall) -> [f64; 7] {
    let body = wall.body();
    let (h, h1, b) = (body.height, body.hinge_height, body.hinge_height * body.slenderness.positive.tan());
    [h, h1, h - h1, b, 0.1 * b, body.weight, body.overburden]
}

/// Returns a row of either table: its name, the printed formula, the computed number and that of the formula.
fn row(name: impl Into<String>, formula: &str, computed: f64, printed: f64) -> Comparison {
    Comparison::printed(name, formula, [computed, printed], 4)
}

/// Returns the rows of Table 1 for one mechanism: `m_eff` as printed and its factor, λ, and the force as
/// printed with its formula.
fn parameter_rows(
    name: &str,
    wall: &Wall,
    m_eff: &str,
    [factor, lambda]: [f64; 2],
    formula: &str,
    force: impl Fn(f64) -> f64,
) -> Vec<Comparison> {
    let body = wall.body();
    let mass = factor * body.mass / 1e3;
    let mut rows = vec![
        row(format!("{name}: m_eff (t)"), m_eff, body.effective_mass / 1e3, mass),
        row(format!("{name}: λ"), &lambda.to_string(), body.participation, lambda),
    ];
    for (place, part) in [("0⁺", 0.0), ("u_ins/2", 0.5), ("u_ins", 1.0)] {
        let u = part * body.instability.positive;
        let branch = &wall.branches()[wall.branch_of(u, 1.0)];
        // at the corner u = u_ins the force is zero but for rounding, of either sign
        let computed = if part < 1.0 { branch.restoring(u) * body.effective_mass / 1e3 } else { 0.0 };
        rows.push(row(format!("{name}: F({place}) (kN)"), formula, computed, force(u) / 1e3));
    }
    rows
}

/// Computes Tables 1 and 2.
///
/// # Errors
/// [`ParameterError`] if the example makes no wall.
pub(super) fn tables_1_and_2() -> Result<[PaperTable; 2], ParameterError> {
    let [parapet, strip] = [Mechanism::Parapet, Mechanism::VerticalSpanning].map(loaded);
    let (parapet, strip) = (parapet?, strip?);
    // as printed; right are those of Table 1 for the parapet and of Table 2 for the strip
    let [h, .., b, c, w, o] = symbols(&parapet);
    let force = |u: f64| 2.0 / h * w * (b / 2.0 - u) + 2.0 / h * o * (b / 2.0 - c - 2.0 * u);
    let p_f0 = ((w + o) * b / h + 2.0 / h * o * c) / 1e3;
    let p_u = (2.0 / h * (w + o) * b / 2.0 - 2.0 / h * o * c) / (2.0 / h * (w + 2.0 * o));
    let formula = "2/h W (b/2 − u) + 2/h O (b/2 − c − 2u)";
    let mut first = parameter_rows("PW", &parapet, "4/3 m", [4.0 / 3.0, 0.75], formula, force);
    let [h, h1, h2, b, c, w, o] = symbols(&strip);
    let force = |u: f64| {
        2.0 / h1 * w * (b - u) + h / (h1 * h2) * o * (b + 2.0 * c - u) + 2.0 / h1 * o * (b - 2.0 * c)
    };
    let s_f0 = 2.0 / h1 * (w + o) * b + o / h2 * (b + 2.0 * c);
    let s_u = s_f0 / (2.0 / h1 * (w + o) + 2.0 * o / h2);
    let formula = "2/h₁ W (b − u) + h/(h₁h₂) O (b + 2c − u) + 2/h₁ O (b − 2c)";
    first.extend(parameter_rows("VSSW", &strip, "2/3 (m₁ + m₂)", [2.0 / 3.0, 1.5], formula, force));
    let strength = |wall: &Wall| wall.body().strength.positive / 1e3;
    let instability = |wall: &Wall| wall.body().instability.positive;
    let second = vec![
        row("PW: F₀ (kN)", "(W + O) b/h + 2/h O c", strength(&parapet), p_f0),
        row("PW: u_ins (m)", "[2/h (W + O) b/2 − 2/h O c]/[2/h (W + 2O)]", instability(&parapet), p_u),
        row("VSSW: F₀ (kN)", "2/h₁ (W + O) b + O (b + 2c)/(h − h₁)", strength(&strip), s_f0 / 1e3),
        row("VSSW: u_ins (m)", "F₀/[2/h₁ (W + O) + 2 O/(h − h₁)]", instability(&strip), s_u),
    ];
    let example = "Evaluated for a wall of 4 m by 0.4 m by 1 m, 1800 kg/m³, with O = W/2 at c = b/10 and h₁ \
        = 0.6 h. Without overburden every formula agrees.";
    Ok([
        PaperTable {
            name: "Table 1",
            title: "Parameters of Eq. (1): the printed formulas beside those derived from Lagrange's \
                    equations",
            notes: format!(
                "{example}\n\
                 The printed strip force contradicts Table 2: it is not F₀ at u = 0 and not zero at u_ins. \
                 Print has −u and 2/h₁; from Lagrange: h/(h₁h₂) O (b + 2c − 2u) + O (b − 2c)/h₁."
            ),
            rows: first,
        },
        PaperTable {
            name: "Table 2",
            title: "Rigid strength and instability displacement",
            notes: format!(
                "{example}\nF₀ of the parapet has the sign of c wrong: Table 1 and u_ins have −c."
            ),
            rows: second,
        },
    ])
}
