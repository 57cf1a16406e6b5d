//! Figure 14: parapets P4-(B) and P7-(C) under a harmonic motion.

use std::f64::consts::TAU;

use crate::chart::{Axis, Chart, Series};
use ground_motion::GroundMotion;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::{DampingModel, DampingSource, Impact};
use rocking_wall::wall::{ParameterError, Parameters, Wall};

use super::decays::rocking;
use super::facts::{TABLE_4, TABLE_4_SIZE, Table4};
use super::{Figure, ReproductionError, history};

/// The motion assumed: a sine whose amplitude grows and falls again linearly.
const FREQUENCY: f64 = 1.5;
const AMPLITUDE: f64 = 4.0;
const RISE: f64 = 30.0;
const FALL: f64 = 6.0;
const END: f64 = 40.0;
const STEP: f64 = 1e-3;

fn motion() -> Result<GroundMotion, ReproductionError> {
    let sample = |index: u32| {
        let time = f64::from(index) * STEP;
        let envelope = (time / RISE).min((RISE + FALL - time) / FALL).max(0.0);
        AMPLITUDE * envelope * libm::sin(TAU * FREQUENCY * time)
    };
    Ok(GroundMotion::new(STEP, (0..=36_000).map(sample).collect())?)
}

/// The parapet of a row of Table 4, with the density that makes its F₀ the printed one.
fn specimen(row: &Table4) -> Result<Parameters, ParameterError> {
    let [height, thickness, width] = TABLE_4_SIZE;
    let parameters =
        Parameters { height, thickness, width, a3: row.a3, u_start: 0.0, ..Parameters::default() };
    let strength = Wall::new(&parameters)?.body().strength.positive;
    Ok(Parameters { density: parameters.density * row.strength / strength, ..parameters })
}

/// Figure 14.
pub(super) fn figure_14() -> Result<Figure, ReproductionError> {
    let motion = motion()?;
    let mut charts = Vec::new();
    let mut density = 0.0;
    for row in &TABLE_4 {
        let wall = specimen(row)?;
        density = wall.density;
        let [cr_a1, e] = row.restitution;
        let [cdr_a1, cdr, _] = row.constant_ratio;
        let [sdr_a1, sdr, _] = row.stiffness_proportional;
        let damped = |damping_model, a1, xi| Parameters {
            damping_model,
            damping_source: DampingSource::Given,
            xi,
            a1,
            impact: Impact::None,
            ..wall.clone()
        };
        let runs = [
            ("CR", 0, rocking(&Parameters { a1: cr_a1, ..wall.clone() }, e)),
            ("CDR", 1, damped(DampingModel::ConstantRatio, cdr_a1, cdr)),
            ("SDR", 2, damped(DampingModel::StiffnessProportional, sdr_a1, sdr)),
        ];
        let mut series = Vec::new();
        for (name, color, parameters) in runs {
            let excitation = Excitation::new(motion.clone(), None);
            let samples = history(&parameters, Some(excitation), [0.005, END])?;
            let points: Vec<_> = samples.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect();
            let peak = points.iter().fold(0.0_f64, |peak, point| peak.max(point.1.abs()));
            series.push(Series::line(&format!("{name}, peak {peak:.3}"), color, points));
        }
        charts.push(Chart {
            title: format!("{}: the whole motion", row.specimen),
            x: Axis::over("time (s)", [0.0, END]),
            y: Axis::over("u / u_ins", [-0.6, 0.6]),
            series: series.clone(),
        });
        charts.push(Chart {
            title: format!("{}: around the largest amplitude", row.specimen),
            x: Axis::over("time (s)", [27.0, 33.0]),
            y: Axis::over("u / u_ins", [-0.6, 0.6]),
            series,
        });
    }
    Ok(Figure {
        number: 14,
        title: "Parapets P4-(B) and P7-(C) under a harmonic motion, with the parameters of Table 4",
        notes: vec![
            format!(
                "The shake-table signals and the measured response are not public. Assumed: a sine of {FREQUENCY} Hz whose amplitude \
                 grows linearly to {AMPLITUDE} m/s² in {RISE} s and falls to zero in {FALL} s. What can be compared is whether CR, CDR \
                 and SDR agree with each other, not with the tests."
            ),
            format!(
                "F₀ = 1.24 kN with h = 1180 mm, b = 230 mm and a width of 1200 mm means {density:.0} kg/m³."
            ),
        ],
        charts,
    })
}
