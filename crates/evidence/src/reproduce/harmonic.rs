//! Figure 14: parapets P4-(B) and P7-(C) under a harmonic motion.

use std::f64::consts::TAU;

use ground_motion::GroundMotion;
use report::plot::{Axis, Plot, Series};
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::DampingModel;
use rocking_wall::wall::{ParameterError, Parameters, Wall};
use run::free_motion::{with_damping, with_restitution};
use run::model::color;

use super::figure::{Figure, history, run};
use super::printed::{TABLE_4, TABLE_4_A3, TABLE_4_SIZE, TABLE_4_STRENGTH};
use crate::EvidenceError;

/// The motion assumed, a sine whose amplitude grows and falls linearly: frequency \[Hz\], amplitude \[m/s²\],
/// times \[s\].
const FREQUENCY: f64 = 1.5;
const AMPLITUDE: f64 = 4.0;
const RISE: f64 = 30.0;
const FALL: f64 = 6.0;
const END: f64 = 40.0;
const STEP: f64 = 1e-3;

fn motion() -> Result<GroundMotion, EvidenceError> {
    let sample = |index: u32| {
        let time = f64::from(index) * STEP;
        let envelope = (time / RISE).min((RISE + FALL - time) / FALL).max(0.0);
        AMPLITUDE * envelope * libm::sin(TAU * FREQUENCY * time)
    };
    Ok(GroundMotion::new(STEP, (0..=36_000).map(sample).collect())?)
}

/// Returns the parapets of Table 4, with the density that makes their F₀ the printed one.
fn specimen() -> Result<Parameters, ParameterError> {
    let [height, thickness, width] = TABLE_4_SIZE;
    let parameters =
        Parameters { height, thickness, width, a3: TABLE_4_A3, u_start: 0.0, ..Parameters::default() };
    let strength = Wall::new(&parameters)?.body().strength.positive;
    Ok(Parameters { density: parameters.density * TABLE_4_STRENGTH / strength, ..parameters })
}

/// Computes Figure 14.
pub(super) fn figure_14() -> Result<Figure, EvidenceError> {
    let motion = motion()?;
    let wall = specimen()?;
    let density = wall.density;
    let mut charts = Vec::new();
    for row in &TABLE_4 {
        let [cr_a1, e] = row.restitution;
        let [cdr_a1, cdr, _] = row.constant_ratio;
        let [sdr_a1, sdr, _] = row.stiffness_proportional;
        let with = |a1| Parameters { a1, ..wall.clone() };
        let runs = [
            ("CR", with_restitution(&with(cr_a1), e)),
            ("CDR", with_damping(&with(cdr_a1), DampingModel::ConstantRatio, cdr)),
            ("SDR", with_damping(&with(sdr_a1), DampingModel::StiffnessProportional, sdr)),
        ];
        let mut series = Vec::new();
        for (name, parameters) in runs {
            let excitation = Excitation::new(motion.clone(), None);
            let points = run(&parameters, Some(excitation), [0.005, END], history)?;
            let peak = points.iter().fold(0.0_f64, |peak, point| peak.max(point.1.abs()));
            series.push(Series::line(&format!("{name}, peak {peak:.3}"), color(name), points));
        }
        let panels = [("the whole motion", [0.0, END]), ("around the largest amplitude", [27.0, 33.0])];
        charts.extend(panels.map(|(panel, times)| {
            let title = format!("{}: {panel}", row.specimen);
            let (x, y) = (Axis::over("time (s)", times), Axis::over("u / u_ins", [-0.6, 0.6]));
            Plot::titled(title, x, y, series.clone())
        }));
    }
    Ok(Figure {
        number: 14,
        title: "Parapets P4-(B) and P7-(C) under a harmonic motion, with the parameters of Table 4",
        notes: format!(
            "The shake-table signals and the measured response are not public. Assumed: a sine of \
             {FREQUENCY} Hz whose amplitude grows linearly to {AMPLITUDE} m/s² in {RISE} s and falls to zero \
             in {FALL} s. What can be compared is whether CR, CDR and SDR agree with each other, not with \
             the tests.\n\
             F₀ = 1.24 kN with h = 1180 mm, b = 230 mm and a width of 1200 mm means {density:.0} kg/m³."
        ),
        charts,
    })
}
