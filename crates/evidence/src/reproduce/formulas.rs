//! Tables 1 and 2: the paper's formulas as printed, evaluated beside the wall.

use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::{ParameterError, Parameters, Wall};

use super::table::{Cell, Table, columns};

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

/// Symbols of the formulas.
struct Symbols {
    h: f64,
    b: f64,
    h1: f64,
    h2: f64,
    c: f64,
    weight: f64,
    overburden: f64,
}

impl Symbols {
    fn of(wall: &Wall) -> Self {
        let body = wall.body();
        let (h, h1, b) = (body.height, body.hinge_height, body.hinge_height * body.slenderness.tan());
        Self { h, b, h1, h2: h - h1, c: 0.1 * b, weight: body.weight, overburden: body.overburden }
    }

    /// Table 1, parapet: as printed, which is right.
    fn parapet_force(&self, u: f64) -> f64 {
        let Self { h, b, c, weight, overburden, .. } = *self;
        2.0 / h * weight * (b / 2.0 - u) + 2.0 / h * overburden * (b / 2.0 - c - 2.0 * u)
    }

    /// Table 1, strip, as printed.
    fn strip_force(&self, u: f64) -> f64 {
        let Self { h, b, h1, h2, c, weight, overburden } = *self;
        2.0 / h1 * weight * (b - u)
            + h / (h1 * h2) * overburden * (b + 2.0 * c - u)
            + 2.0 / h1 * overburden * (b - 2.0 * c)
    }

    /// Table 2, parapet, as printed.
    fn parapet_strength(&self) -> f64 {
        let Self { h, b, c, weight, overburden, .. } = *self;
        (weight + overburden) * b / h + 2.0 / h * overburden * c
    }

    fn parapet_instability(&self) -> f64 {
        let Self { h, b, c, weight, overburden, .. } = *self;
        (2.0 / h * (weight + overburden) * b / 2.0 - 2.0 / h * overburden * c)
            / (2.0 / h * (weight + 2.0 * overburden))
    }

    /// Table 2, strip: as printed, which is right.
    fn strip_strength(&self) -> f64 {
        let Self { b, h1, h2, c, weight, overburden, .. } = *self;
        2.0 / h1 * (weight + overburden) * b + overburden / h2 * (b + 2.0 * c)
    }

    fn strip_instability(&self) -> f64 {
        let Self { h1, h2, weight, overburden, .. } = *self;
        self.strip_strength() / (2.0 / h1 * (weight + overburden) + 2.0 * overburden / h2)
    }
}

/// Returns a row of either table.
fn row(name: &str, formula: &str, computed: f64, printed: f64, remark: &str) -> Vec<Cell> {
    vec![Cell::text(name), Cell::text(formula), Cell::value(computed, printed, 4), Cell::text(remark)]
}

/// Returns the rows of Table 1 for one mechanism: `m_eff` as printed and its factor, λ, and the force as
/// printed with its formula and a remark.
fn parameter_rows(
    (name, wall): (&str, &Wall),
    (m_eff, factor, lambda): (&str, f64, f64),
    (formula, force, remark): (&str, impl Fn(f64) -> f64, &str),
) -> Vec<Vec<Cell>> {
    let body = wall.body();
    let mass = factor * body.mass / 1e3;
    let mut rows = vec![
        row(&format!("{name}: m_eff (t)"), m_eff, body.effective_mass / 1e3, mass, ""),
        row(&format!("{name}: λ"), &format!("{lambda}"), body.participation, lambda, ""),
    ];
    for (place, part) in [("0⁺", 0.0), ("u_ins/2", 0.5), ("u_ins", 1.0)] {
        let u = part * body.instability.positive;
        let branch = &wall.branches()[wall.branch_of(u, 1.0)];
        // at the corner u = u_ins the force is zero but for rounding, of either sign
        let computed = if part < 1.0 { branch.restoring(u) * body.effective_mass / 1e3 } else { 0.0 };
        rows.push(row(&format!("{name}: F({place}) (kN)"), formula, computed, force(u) / 1e3, remark));
    }
    rows
}

/// Computes Tables 1 and 2.
///
/// # Errors
/// [`ParameterError`] if the example makes no wall.
pub(super) fn tables_1_and_2() -> Result<[Table; 2], ParameterError> {
    let [parapet, strip] = [Mechanism::Parapet, Mechanism::VerticalSpanning].map(loaded);
    let (parapet, strip) = (parapet?, strip?);
    let (p, s) = (Symbols::of(&parapet), Symbols::of(&strip));
    let mut first = parameter_rows(
        ("PW", &parapet),
        ("4/3 m", 4.0 / 3.0, 0.75),
        ("2/h W (b/2 − u) + 2/h O (b/2 − c − 2u)", |u| p.parapet_force(u), ""),
    );
    first.extend(parameter_rows(
        ("VSSW", &strip),
        ("2/3 (m₁ + m₂)", 2.0 / 3.0, 1.5),
        (
            "2/h₁ W (b − u) + h/(h₁h₂) O (b + 2c − u) + 2/h₁ O (b − 2c)",
            |u| s.strip_force(u),
            "print: −u and 2/h₁; from Lagrange: h/(h₁h₂) O (b + 2c − 2u) + O (b − 2c)/h₁",
        ),
    ));
    let (f0, u_ins) = (["PW: F₀ (kN)", "VSSW: F₀ (kN)"], ["PW: u_ins (m)", "VSSW: u_ins (m)"]);
    let strength = [&parapet, &strip].map(|wall| wall.body().strength.positive / 1e3);
    let instability = [&parapet, &strip].map(|wall| wall.body().instability.positive);
    let (p_f0, s_f0) = (p.parapet_strength() / 1e3, s.strip_strength() / 1e3);
    let (p_u, s_u) = (p.parapet_instability(), s.strip_instability());
    let sign = "sign of c: Table 1 and u_ins have −c";
    let second = vec![
        row(f0[0], "(W + O) b/h + 2/h O c", strength[0], p_f0, sign),
        row(u_ins[0], "[2/h (W + O) b/2 − 2/h O c]/[2/h (W + 2O)]", instability[0], p_u, ""),
        row(f0[1], "2/h₁ (W + O) b + O (b + 2c)/(h − h₁)", strength[1], s_f0, ""),
        row(u_ins[1], "F₀/[2/h₁ (W + O) + 2 O/(h − h₁)]", instability[1], s_u, ""),
    ];
    let example = "Evaluated for a wall of 4 m by 0.4 m by 1 m, 1800 kg/m³, with O = W/2 at c = b/10 and h₁ \
        = 0.6 h. Without overburden every formula agrees.";
    let columns = columns("quantity | as printed | value | remark");
    Ok([
        Table {
            name: "Table 1",
            title: "Parameters of Eq. (1): the printed formulas beside those derived from Lagrange's \
                    equations",
            notes: vec![
                example.into(),
                "The printed strip force contradicts Table 2: it is not F₀ at u = 0 and not zero at u_ins."
                    .into(),
            ],
            columns: columns.clone(),
            rows: first,
        },
        Table {
            name: "Table 2",
            title: "Rigid strength and instability displacement",
            notes: vec![example.into()],
            columns,
            rows: second,
        },
    ])
}
