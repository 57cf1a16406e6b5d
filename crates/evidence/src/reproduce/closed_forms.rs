//! Figures 4 and 13: force laws, and damping ratios over slenderness.

use report::plot::{Axis, Plot, Series};
use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::restitution::{analytic_parapet, analytic_vertical_spanning, calibration};
use rocking_wall::wall::{ParameterError, Parameters, Wall};
use run::model::{RATIO_MODELS, label};

use super::figure::{Figure, spaced};

/// Figure 4: a) bilinear and b) trilinear law on the rigid-linear one.
pub(super) fn figure_4() -> Result<Figure, ParameterError> {
    let (a1, a3, d1) = (0.1, 0.9, 0.6);
    let law = |force_law| -> Result<Vec<(f64, f64)>, ParameterError> {
        let damping_model = DampingModel::None;
        let wall = Wall::new(&Parameters { force_law, a1, a3, d1, damping_model, ..Parameters::default() })?;
        let body = wall.body();
        let scale = (body.instability.positive, body.strength.positive);
        let corners = wall.backbone().into_iter().map(|(u, force)| (u / scale.0, force / scale.1));
        let mut points = vec![(0.0, 0.0)];
        points.extend(corners.filter(|&(u, force)| u > 0.0 && force > -1e-9));
        Ok(points)
    };
    let chart = |title: &str, name: &str, points: Vec<(f64, f64)>, at: f64| {
        let secant = at.mul_add(-1.0, a3) / at;
        let [x, y] = ["u / u_ins", "F / F0"].map(|label| Axis::over(label, [0.0, 1.1]));
        Plot::titled(
            title,
            x,
            y,
            vec![
                Series::dashed("rigid-linear, slope −k₀", 5, vec![(0.0, 1.0), (1.0, 0.0)]),
                Series::dashed("secant stiffness k_sec", 2, vec![(0.0, 0.0), (at, secant * at)]),
                Series::line(name, 0, points),
            ],
        )
    };
    Ok(Figure {
        number: 4,
        title: "Force-displacement laws built on the rigid-linear one",
        notes: format!(
            "The values drawn are lost; here a₁ = {a1}, a₃ = {a3}, d₁ = {d1}. The softening line keeps the \
             slope −k₀ and ends at u₃ = a₃ u_ins; for a₃ = 1 all readings of the figure agree."
        ),
        charts: vec![
            chart("a) bilinear", "bilinear: u₁ = a₁ u_ins, u₃ = a₃ u_ins", law(ForceLaw::Bilinear)?, 0.6),
            chart("b) trilinear", "trilinear: plateau F_y = d₁ F₀", law(ForceLaw::Trilinear)?, 0.6),
        ],
    })
}

/// Figure 13: ξ over the slenderness angle.
pub(super) fn figure_13() -> Figure {
    let a1 = 0.06;
    let curve = |model: DampingModel, mechanism, factor: f64| -> Vec<(f64, f64)> {
        let ratio = |angle: f64| {
            let analytic = match mechanism {
                Mechanism::Parapet | Mechanism::RigidBody => analytic_parapet(angle),
                Mechanism::VerticalSpanning => analytic_vertical_spanning(angle),
            };
            model.predicted_ratio(a1, factor * analytic)
        };
        spaced([0.02, 0.35], 66).map(|angle| (angle, 100.0 * ratio(angle))).collect()
    };
    let (parapet, strip) = (Mechanism::Parapet, Mechanism::VerticalSpanning);
    let charts = RATIO_MODELS.map(|model| {
        let title = format!("{}, a₁ = {a1}, a₃ = 1", label(model).name);
        let top = if model == RATIO_MODELS[0] { 8.0 } else { 16.0 };
        let (x, y) = (Axis::over("α or α₁ (rad)", [0.0, 0.35]), Axis::over("damping ratio (%)", [0.0, top]));
        let series = vec![
            Series::line("PW, e_an", 0, curve(model, parapet, 1.0)),
            Series::dashed("PW, 0.95 e_an", 0, curve(model, parapet, calibration(parapet))),
            Series::line("VSSW, e_an", 1, curve(model, strip, 1.0)),
            Series::dashed("VSSW, 0.90 e_an", 1, curve(model, strip, calibration(strip))),
        ];
        Plot::titled(title, x, y, series)
    });
    Figure {
        number: 13,
        title: "Damping ratio over the geometry, Eqs. (20) to (22)",
        notes: "tan α = b/h, tan α₁ = b/h₁, with h₁ = h/2; of the SDR model ξ₁ is shown.".into(),
        charts: charts.into(),
    }
}
