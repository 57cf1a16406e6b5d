//! Problems on which solvers are measured.

use ground_motion::{GroundMotion, GroundMotionError, SyntheticMotion};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Parameters, Support, Wall};
use scene::Scene;

use crate::EvidenceError;

/// A wall under a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Name in tables and messages.
    pub name: String,
    /// Parameters of the wall; its solver is ignored.
    pub parameters: Parameters,
    /// Forcing p at the samples, linear between them \[m/s²\].
    pub forcing: Vec<f64>,
    /// Time between samples \[s\].
    pub step: f64,
}

/// Most samples of a problem.
const MOST_SAMPLES: f64 = 1e7;

impl Problem {
    /// Takes the wall and the motion of a scene, sampled as its bottom record, or at the output step if it
    /// has none.
    ///
    /// # Errors
    /// [`EvidenceError::Parameters`] if the parameters make no wall, or start it where it cannot be,
    /// [`EvidenceError::Scene`] if the wall does not go with its floors.
    pub fn from_scene(scene: &Scene) -> Result<Self, EvidenceError> {
        let wall = Wall::new(&scene.parameters)?;
        wall.check_start(scene.parameters.u_start)?;
        let motion = scene.support_motion()?;
        let step = motion.as_ref().map_or(scene.output_step, |motion| motion.step());
        let count = (scene.stop_time / step).round().clamp(1.0, MOST_SAMPLES);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 1e7")]
        let count = count as usize;
        let support = |index: usize| {
            let time = index as f64 * step;
            motion.as_ref().map_or_else(Support::default, |motion| motion.segment(time, 0.0).from)
        };
        let forcing = (0..=count).map(|index| wall.body().forcing(support(index))).collect();
        Ok(Self { name: scene.title.clone(), parameters: scene.parameters.clone(), forcing, step })
    }

    fn shaken(
        name: &str,
        parameters: Parameters,
        motion: &GroundMotion,
        factor: f64,
    ) -> Result<Self, EvidenceError> {
        let parameters = Parameters { u_start: 0.0, ..parameters };
        let wall = Wall::new(&parameters)?;
        let forcing = |a: &f64| wall.body().forcing(Support::rigid(factor * a));
        let forcing = motion.samples().iter().map(forcing).collect();
        Ok(Self { name: name.into(), parameters, forcing, step: motion.step() })
    }
}

/// A parapet with the other parameters at their defaults.
fn parapet([height, thickness, a1]: [f64; 3], damping_model: DampingModel) -> Parameters {
    Parameters { height, thickness, a1, damping_model, ..Parameters::default() }
}

/// Returns the problems measured by default. The first 30 s of `record` replace the synthetic motion under
/// the walls of Table 5.
///
/// # Errors
/// [`EvidenceError::Motion`] if the record cannot be cut.
pub fn defaults(record: Option<&GroundMotion>) -> Result<Vec<Problem>, EvidenceError> {
    use DampingModel::{ConstantCoefficient as Cdc, ConstantRatio as Cdr, StiffnessProportional as Sdr};
    let synthetic = SyntheticMotion::default().motion()?;
    let long = SyntheticMotion { duration: 120.0, ..SyntheticMotion::default() }.motion()?;
    let record = match record {
        Some(record) => record.trimmed(0.0, record.duration().min(30.0))?,
        None => synthetic.clone(),
    };
    let stiff = |a1: f64, damping_model| parapet([3.0, 0.3, a1], damping_model);
    let mechanism = Mechanism::VerticalSpanning;
    let strip = Parameters { mechanism, ..parapet([5.0, 0.3, 0.02], Sdr) };
    let default = Parameters::default();
    let (force_law, impact) = (ForceLaw::RigidLinear, Impact::Restitution);
    let rigid = Parameters { force_law, impact, ..stiff(default.a1, DampingModel::None) };
    let default = Parameters { damping_model: Cdc, ..default };
    let shaken = Problem::shaken;
    Ok(vec![
        shaken("mild: the default parapet, CDC", default.clone(), &synthetic, 0.4)?,
        shaken("stiff: a1 = 1e-3, CDC", stiff(1e-3, Cdc), &synthetic, 0.5)?,
        shaken("stiff: a1 = 1e-3, CDR", stiff(1e-3, Cdr), &synthetic, 0.5)?,
        shaken("very stiff: a1 = 1e-4, CDC", stiff(1e-4, Cdc), &synthetic, 0.5)?,
        shaken("Table 5, wall 6, CDC", parapet([6.0, 0.6, 0.018], Cdc), &record, 0.8)?,
        shaken("Table 5, wall 6, CDR", parapet([6.0, 0.6, 0.018], Cdr), &record, 0.8)?,
        shaken("Table 5, wall 5, CDC", parapet([3.0, 0.6, 0.0024], Cdc), &record, 1.2)?,
        shaken("Table 5, wall 5, CDR", parapet([3.0, 0.6, 0.0024], Cdr), &record, 1.2)?,
        shaken("Table 5, wall 2, CDC", parapet([1.5, 0.3, 0.0012], Cdc), &record, 0.8)?,
        shaken("Table 5, wall 2, CDR", parapet([1.5, 0.3, 0.0012], Cdr), &record, 0.8)?,
        shaken("strip: Table 5, wall 7, SDR", strip, &synthetic, 1.0)?,
        shaken("restitution: rigid-linear", rigid, &synthetic, 0.5)?,
        shaken("high frequencies: 12 to 40 Hz, CDC", stiff(3e-3, Cdc), &high_frequencies()?, 4.0)?,
        shaken("long: 120 s, CDC", default, &long, 0.5)?,
        shaken("overturning, CDC", stiff(9e-3, Cdc), &synthetic, 3.0)?,
    ])
}

/// Eight harmonics from 12 to 40 Hz under a smooth envelope of 10 s, peak near 8 m/s², sampled at 1 kHz.
fn high_frequencies() -> Result<GroundMotion, GroundMotionError> {
    let (step, count) = (1e-3, 10_000_u32);
    let sample = |index: u32| {
        let time = f64::from(index) * step;
        let envelope = libm::sin(std::f64::consts::PI * time / 10.0).powi(2);
        // phases of a quadratic sequence, so that the harmonics do not peak together
        let harmonic = |n: u32| {
            let (frequency, phase) = (12.0 + 4.0 * f64::from(n), 0.7 * f64::from(n * n));
            libm::sin(std::f64::consts::TAU * frequency * time + phase)
        };
        2.0 * envelope * (0..8).map(harmonic).sum::<f64>()
    };
    GroundMotion::new(step, (0..=count).map(sample).collect())
}
