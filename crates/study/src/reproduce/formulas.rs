//! Tables 1 and 2: the paper's formulas as printed, evaluated beside the wall.

use rocking_wall::variables::{ForceLaw, Mechanism};
use rocking_wall::wall::{ParameterError, Parameters, Wall};

use super::{Cell, Table};

/// A wall with an eccentric overburden, for which every term counts: O = W/2, c = b/10, h₁ = 0.6 h.
fn loaded(mechanism: Mechanism) -> Result<Wall, ParameterError> {
    let bare = Parameters { mechanism, hinge_ratio: 0.6, ..Parameters::default() };
    let weight = Wall::new(&bare)?.body().weight;
    Wall::new(&Parameters {
        overburden: 0.5 * weight,
        overburden_eccentricity: 0.1 * bare.thickness,
        force_law: ForceLaw::RigidLinear,
        damping_model: rocking_wall::variables::DampingModel::None,
        ..bare
    })
}

/// The numbers in the formulas.
struct Numbers {
    h: f64,
    b: f64,
    h1: f64,
    h2: f64,
    c: f64,
    weight: f64,
    overburden: f64,
}

impl Numbers {
    fn of(wall: &Wall) -> Self {
        let body = wall.body();
        let b = body.hinge_height * body.slenderness.tan();
        Self {
            h: body.height,
            b,
            h1: body.hinge_height,
            h2: body.height - body.hinge_height,
            c: 0.1 * b,
            weight: body.weight,
            overburden: body.overburden,
        }
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

/// Tables 1 and 2.
///
/// # Errors
/// [`ParameterError`], if the example made no wall.
pub(super) fn tables_1_and_2() -> Result<[Table; 2], ParameterError> {
    let [parapet, strip] = [Mechanism::Parapet, Mechanism::VerticalSpanning].map(loaded);
    let (parapet, strip) = (parapet?, strip?);
    let (p, s) = (Numbers::of(&parapet), Numbers::of(&strip));
    let force = |wall: &Wall, u: f64| {
        let branch = &wall.branches()[wall.branch_of(u, 1.0)];
        branch.restoring(u) * wall.body().effective_mass / 1e3
    };
    let row = |name: &str, formula: &str, ours: f64, printed: f64, remark: &str| {
        vec![Cell::words(name), Cell::words(formula), Cell::value(ours, printed, 4), Cell::words(remark)]
    };
    let columns = vec!["quantity", "as printed", "value", "remark"];
    let mut first = Vec::new();
    for (wall, name, m_eff, lambda) in
        [(&parapet, "PW", "4/3 m", 0.75), (&strip, "VSSW", "2/3 (m₁ + m₂)", 1.5)]
    {
        let body = wall.body();
        let factor = if name == "PW" { 4.0 / 3.0 } else { 2.0 / 3.0 };
        let mass = factor * body.mass / 1e3;
        first.push(row(&format!("{name}: m_eff (t)"), m_eff, body.effective_mass / 1e3, mass, ""));
        first.push(row(&format!("{name}: λ"), &format!("{lambda}"), body.participation, lambda, ""));
        let misprint = "print: −u and 2/h₁; from Lagrange: h/(h₁h₂) O (b + 2c − 2u) + O (b − 2c)/h₁";
        let (formula, remark) = if name == "PW" {
            ("2/h W (b/2 − u) + 2/h O (b/2 − c − 2u)", "")
        } else {
            ("2/h₁ W (b − u) + h/(h₁h₂) O (b + 2c − u) + 2/h₁ O (b − 2c)", misprint)
        };
        for (words, part) in [("0⁺", 0.0), ("u_ins/2", 0.5), ("u_ins", 1.0)] {
            let u = part * body.instability.positive;
            let printed = if name == "PW" { p.parapet_force(u) } else { s.strip_force(u) } / 1e3;
            // at the corner u = u_ins the force is zero but for rounding, of either sign
            let ours = if part < 1.0 { force(wall, u) } else { 0.0 };
            first.push(row(&format!("{name}: F({words}) (kN)"), formula, ours, printed, remark));
        }
    }
    let second = vec![
        row(
            "PW: F₀ (kN)",
            "(W + O) b/h + 2/h O c",
            parapet.body().strength.positive / 1e3,
            p.parapet_strength() / 1e3,
            "sign of c: Table 1 and u_ins have −c",
        ),
        row(
            "PW: u_ins (m)",
            "[2/h (W + O) b/2 − 2/h O c]/[2/h (W + 2O)]",
            parapet.body().instability.positive,
            p.parapet_instability(),
            "",
        ),
        row(
            "VSSW: F₀ (kN)",
            "2/h₁ (W + O) b + O (b + 2c)/(h − h₁)",
            strip.body().strength.positive / 1e3,
            s.strip_strength() / 1e3,
            "",
        ),
        row(
            "VSSW: u_ins (m)",
            "F₀/[2/h₁ (W + O) + 2 O/(h − h₁)]",
            strip.body().instability.positive,
            s.strip_instability(),
            "",
        ),
    ];
    let example = "Evaluated for a wall of 4 m by 0.4 m by 1 m, 1800 kg/m³, with O = W/2 at c = b/10 and h₁ = 0.6 h. Without \
                   overburden every formula agrees.";
    Ok([
        Table {
            name: "Table 1",
            title: "Parameters of Eq. (1): the printed formulas beside those derived from Lagrange's equations",
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
