//! Figures 5, 6 and 7: free vibrations; and the numbers printed in captions and text.

use std::f64::consts::TAU;
use std::num::NonZeroUsize;

use report::plot::{Axis, Plot, Series};
use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism};
use rocking_wall::wall::restitution::{analytic_parapet, analytic_vertical_spanning};
use rocking_wall::wall::{ParameterError, Parameters, Wall, equivalence};
use run::free_motion::{with_damping, with_restitution};
use run::model::{RATIO_MODELS as MODELS, color, label};
use scene::response::Sample;
use study::calibration::{Grid, calibrate};

use super::PaperTable;
use super::figure::{Figure, history, run, spaced};
use super::printed::{
    FIGURE_2_RESTITUTION, FIGURE_5_COEFFICIENT, FIGURE_5_RATIOS, FIGURE_5_WALL, FIGURE_6, FIGURE_7,
    FIGURE_7_START, FIGURE_WALL, START,
};
use crate::{Comparison, EvidenceError};

/// Width \[m\] and density \[kg/m³\] of the strip of Figures 5 and 6, which the paper does not state. With
/// them `C_CDC` is the 300 kg/s of the text, and nothing else depends on them.
const STRIP_WIDTH: f64 = 1.5;
const STRIP_DENSITY: f64 = 1850.0;

/// Returns the strip of Figures 5 and 6, released at 0.9 `u_ins`.
fn strip() -> Result<Parameters, ParameterError> {
    let [height, thickness, h1, a1, d1] = FIGURE_5_WALL;
    released(
        Parameters {
            mechanism: Mechanism::VerticalSpanning,
            height,
            thickness,
            width: STRIP_WIDTH,
            density: STRIP_DENSITY,
            hinge_ratio: h1 / height,
            force_law: ForceLaw::Trilinear,
            a1,
            d1,
            u_start: 0.0,
            ..Parameters::default()
        },
        START,
    )
}

/// Returns a wall released at the fraction `start` of its `u_ins`.
fn released(parameters: Parameters, start: f64) -> Result<Parameters, ParameterError> {
    let u_start = start * Wall::new(&parameters)?.body().instability.positive;
    Ok(Parameters { u_start, ..parameters })
}

/// The axis of u.
fn u_axis() -> Axis {
    Axis::over("u / u_ins", [-1.0, 1.0])
}

/// Computes Figure 5: C over u, ξ over ω, damping force over u.
pub(super) fn figure_5() -> Result<Figure, EvidenceError> {
    let strip = strip()?;
    let (mut coefficients, mut ratios, mut forces) = (Vec::new(), Vec::new(), Vec::new());
    // a constant coefficient, a constant ratio, and one proportional to stiffness
    for ((model, xi), power) in MODELS.into_iter().zip(FIGURE_5_RATIOS).zip([-1, 0, 1]) {
        let parameters = with_damping(&strip, model, xi);
        let wall = Wall::new(&parameters)?;
        let (name, strength) = (label(model).name, wall.body().strength.positive);
        let color = color(name);
        coefficients.push(Series::line(name, color, damping_coefficients(&wall)));
        let omega1 = wall.omega1();
        // C = 2 m_eff ω₁ ξ = 2 m_eff ω ξ(ω)
        let ratio = |omega: f64| (omega, 100.0 * xi * (omega / omega1).powi(power));
        ratios.push(Series::line(name, color, spaced([0.5, omega1], 200).map(ratio).collect()));
        let force = |sample: &Sample| (sample.outputs.ratio, sample.outputs.damping_force / strength);
        forces.push(Series::line(name, color, run(&parameters, None, [0.002, 5.0], force)?));
    }
    // the model with the largest forces lies behind the others
    forces.reverse();
    let forces_title = "c) damping force in a free vibration from 0.9 u_ins";
    Ok(Figure {
        number: 5,
        title: "The three damping models on one strip",
        notes: format!(
            "Width and density are not stated: {STRIP_WIDTH} m and {STRIP_DENSITY} kg/m³ make C_CDC the 300 \
             kg/s of the text.\n\
             b) ω is the secant frequency; a constant coefficient C is there ξ = C/(2 m_eff ω). c) The force \
             is divided by F₀, which the caption does not say; the first 5 s."
        ),
        charts: vec![
            Plot::titled("a) damping coefficient", u_axis(), "C (kg/s)", coefficients),
            Plot::titled(
                "b) damping ratio",
                "ω (rad/s)",
                Axis::over("damping ratio (%)", [0.0, 10.0]),
                ratios,
            ),
            Plot::titled(forces_title, u_axis(), "C u̇ / F0", forces),
        ],
    })
}

/// Returns (u/`u_ins`, C) of a wall, C in kg/s.
fn damping_coefficients(wall: &Wall) -> Vec<(f64, f64)> {
    let body = wall.body();
    let coefficient = |part: f64| {
        let u = part * body.instability.positive;
        (part, wall.branches()[wall.branch_of(u, 0.0)].damping_at(u) * body.effective_mass)
    };
    // C changes at u_ins
    spaced([-0.9999, 0.9999], 800).map(coefficient).collect()
}

/// Computes Figure 6: a free vibration of CR beside one of CDR.
pub(super) fn figure_6() -> Result<Figure, EvidenceError> {
    let [e, xi] = FIGURE_6;
    let strip = strip()?;
    let u_ins = Wall::new(&strip)?.body().instability.positive;
    let runs = [
        (format!("CR, e = {e}"), color("CR"), with_restitution(&strip, e)),
        (format!("CDR, ξ = {xi}"), color("CDR"), with_damping(&strip, DampingModel::ConstantRatio, xi)),
    ];
    let (mut histories, mut phases) = (Vec::new(), Vec::new());
    for (name, color, parameters) in runs {
        let phase = |sample: &Sample| (sample.outputs.ratio, sample.outputs.velocity / u_ins);
        histories.push(Series::line(&name, color, run(&parameters, None, [0.002, 10.0], history)?));
        phases.push(Series::line(&name, color, run(&parameters, None, [0.002, 10.0], phase)?));
    }
    Ok(Figure {
        number: 6,
        title: "Matched free vibrations of CR and CDR",
        notes: "The wall is that of Figure 5; the velocity is divided by u_ins.".into(),
        charts: vec![
            Plot::titled("a) history", Axis::over("time (s)", [0.0, 10.0]), u_axis(), histories),
            Plot::titled("b) displacement and velocity", u_axis(), "velocity / u_ins (1/s)", phases),
        ],
    })
}

/// Computes Figure 7: a rocking body beside elastic oscillators.
pub(super) fn figure_7() -> Result<Figure, EvidenceError> {
    let [height, thickness] = FIGURE_WALL;
    let rigid = Parameters {
        height,
        thickness,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        u_start: 0.0,
        ..Parameters::default()
    };
    let body = released(rigid, FIGURE_7_START)?;
    // p = √(3g/(4R)), R = √(h² + b²)/2
    let frequency = (0.75 * body.gravity / (height.hypot(thickness) / 2.0)).sqrt();
    let mut charts = Vec::new();
    for ((e, impacts), (panel, end)) in FIGURE_7.into_iter().zip([("a", 20.0), ("b", 10.0)]) {
        let rocking = run(&with_restitution(&body, e), None, [0.005, end], history)?;
        let xi = equivalence::priestley(e, FIGURE_7_START, impacts);
        // half-way through the impacts, each of which leaves e² of the energy
        let energy = e.powf(2.0 * f64::from(impacts / 2)) * (1.0 - (1.0 - FIGURE_7_START).powi(2));
        let period = equivalence::housner_period(frequency, 1.0 - (1.0 - energy).sqrt());
        let oscillator = |period: f64| {
            spaced([0.0, end], 2000).map(|t| (t, FIGURE_7_START * elastic(t, TAU / period, xi))).collect()
        };
        let title = format!("{panel}) e = {e}, ξ = {xi:.4} from Eq. (13) with n = {impacts}");
        let series = vec![
            Series::line(&format!("EO_stiff, T = {:.2} s", period / 2.0), 4, oscillator(period / 2.0)),
            Series::line(&format!("EO, T = {period:.2} s"), 1, oscillator(period)),
            Series::line("rocking body, CR", color("CR"), rocking),
        ];
        charts.push(Plot::titled(title, Axis::over("time (s)", [0.0, end]), u_axis(), series));
    }
    Ok(Figure {
        number: 7,
        title: "Free vibrations of a rocking body and of elastic oscillators",
        notes: "Which cycle gave the period is lost; taken is the one that starts half-way through the \
                impacts that Eq. (13) counts, after 2 of 4 in a) and after 1 of 3 in b), by Eq. (5)."
            .into(),
        charts,
    })
}

/// Returns the free vibration of an elastic oscillator released at rest from 1.
fn elastic(time: f64, omega: f64, xi: f64) -> f64 {
    let root = (1.0 - xi * xi).sqrt();
    let phase = omega * root * time;
    (-xi * omega * time).exp() * (phase.cos() + xi / root * phase.sin())
}

/// Computes the numbers printed in captions and text.
pub(super) fn captions(threads: NonZeroUsize) -> Result<PaperTable, EvidenceError> {
    let strip = strip()?;
    let cdc = Wall::new(&with_damping(&strip, MODELS[0], FIGURE_5_RATIOS[0]))?;
    let fits = |model, restitution: &[f64]| {
        let grid = Grid { restitution: restitution.to_vec(), a1: vec![strip.a1], ..Grid::default() };
        let found = calibrate(&strip, model, &grid, threads)?;
        Ok::<Vec<f64>, EvidenceError>(found.fits.iter().map(|fit| fit.damping).collect())
    };
    let figure_6 = fits(DampingModel::ConstantRatio, &FIGURE_6[..1])?[0];
    // the e at which CDR needs the ratio of Figure 5, between two values around it
    let ends = [0.88, 0.94];
    let cdr = fits(MODELS[1], &ends)?;
    let part = (FIGURE_5_RATIOS[1] - cdr[0]) / (cdr[1] - cdr[0]);
    let e = ends[0] + part * (ends[1] - ends[0]);
    let [height, thickness] = FIGURE_WALL;
    let e_parapet = analytic_parapet((thickness / height).atan());
    let e_strip = analytic_vertical_spanning((2.0 * thickness / height).atan());
    let [e_2_parapet, e_2_strip] = FIGURE_2_RESTITUTION;
    let e_2 = "Figure 2: e of the";
    let mut rows = vec![
        Comparison::printed(format!("{e_2} parapet"), "Eq. (2)", [e_parapet, e_2_parapet], 3),
        Comparison::printed(format!("{e_2} strip"), "Eq. (3), h₁ = h/2", [e_strip, e_2_strip], 3),
        Comparison::printed(
            "Figure 5: C_CDC (kg/s)",
            "with the assumed width and density",
            [cdc.elastic_damping(), FIGURE_5_COEFFICIENT],
            0,
        ),
        Comparison::printed(
            "Figure 6: ξ of CDR for e = 0.875",
            "least of Eq. (18) for this wall and start",
            [figure_6, FIGURE_6[1]],
            3,
        ),
    ];
    let least = format!("least of Eq. (18) for e = {e:.3}");
    for (model, printed) in MODELS.into_iter().zip(FIGURE_5_RATIOS) {
        let case = format!("Figure 5: ξ of {}", label(model).name);
        rows.push(Comparison::printed(case, &least, [fits(model, &[e])?[0], printed], 3));
    }
    Ok(PaperTable {
        name: "Captions",
        title: "Numbers printed in captions and text",
        notes: format!(
            "Neither e by Eq. (3) nor 0.90 of it is what Figure 2 used for the strip.\n\
             Width and density were chosen so that C_CDC comes out, and e = {e:.3} so that CDR of Figure 5 \
             does."
        ),
        rows,
    })
}
