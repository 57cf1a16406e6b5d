//! A run beside the same run in the other kinematics: what small rotations leave out of it.

use rocking_wall::variables::Solver;
use rocking_wall::wall::{Kinematics, Parameters, Wall};
use scene::Scene;
use scene::response::Response;

use crate::rotations::{Period, SLENDERNESS, period};

/// Amplitudes between which a period is meaningful \[-\].
const AMPLITUDES: [f64; 2] = [0.01, 0.99];

/// A run in small and in full rotations.
///
/// ```
/// use scene::response::Response;
/// use scene::Scene;
/// use run::counterpart::Counterpart;
///
/// let block = "[force_law]\nforce_law = \"rigid_linear\"\n[damping]\ndamping_model = \"none\"\n\
///              [impact]\nimpact = \"restitution\"\n";
/// let scene = Scene::parse("block", block, ".".as_ref())?;
/// let both = Counterpart::of(&scene, &Response::of(&scene)?).expect("full rotations allow it");
/// assert!(both.period.ratio() < 1.0 && both.linear.len() == both.trigonometric.len());
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Counterpart {
    /// Times \[s\] and u/`u_ins` with small rotations.
    pub linear: Vec<(f64, f64)>,
    /// Times \[s\] and u/`u_ins` with full rotations.
    pub trigonometric: Vec<(f64, f64)>,
    /// Largest distance of the two while both walls stand \[-\].
    pub apart: f64,
    /// Fraction of `u_ins` from which the periods start: the largest of the run \[-\].
    pub start: f64,
    /// Period of this wall.
    pub period: Period,
    /// Slenderness \[rad\], and the period with small rotations over that with full ones, of the wall with
    /// other thicknesses; empty for a body of parts, which has no thickness of its own.
    pub ratios: Vec<(f64, f64)>,
}

impl Counterpart {
    /// Runs a scene with the other kinematics; `None` for walls that full rotations do not allow.
    pub fn of(scene: &Scene, response: &Response) -> Option<Self> {
        let other = Response::of(&counterpart(scene)?).ok()?;
        let history = |response: &Response| -> Vec<(f64, f64)> {
            response.samples.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect()
        };
        let (own, other) = (history(response), history(&other));
        let pairs = own.iter().zip(&other).take_while(|(a, b)| a.1.abs() <= 1.0 && b.1.abs() <= 1.0);
        let apart = pairs.map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max);
        let [linear, trigonometric] = match scene.parameters.kinematics {
            Kinematics::Linear => [own, other],
            Kinematics::Trigonometric => [other, own],
        };
        let start = response.summary.u_ratio_max.clamp(AMPLITUDES[0], AMPLITUDES[1]);
        let period = period(&scene.parameters, start).ok()?;
        let ratios =
            if scene.parameters.is_rectangle() { ratios(&scene.parameters, &period) } else { Vec::new() };
        Some(Self { linear, trigonometric, apart, start, period, ratios })
    }
}

/// Returns the ratios of periods of a rectangle with other thicknesses, from the start of its own period.
fn ratios(parameters: &Parameters, own: &Period) -> Vec<(f64, f64)> {
    let base = parameters.thickness / libm::tan(own.slenderness);
    let widest = own.slenderness.max(SLENDERNESS[SLENDERNESS.len() - 1]);
    let ratio = |alpha: &f64| {
        let thickness = base * libm::tan(*alpha);
        let period = period(&Parameters { thickness, ..parameters.clone() }, own.start).ok()?;
        Some((*alpha, period.ratio()))
    };
    let ratios = SLENDERNESS.iter().chain([&widest]).filter_map(ratio);
    std::iter::once((0.0, 1.0)).chain(ratios).collect()
}

/// The scene with the other kinematics.
fn counterpart(scene: &Scene) -> Option<Scene> {
    let mut other = scene.clone();
    other.parameters.solver = Solver::Automatic;
    other.parameters.kinematics = Kinematics::Trigonometric;
    // full rotations allow rigid walls without damping only
    Wall::new(&other.parameters).ok()?;
    other.support_motion().ok()?;
    if scene.parameters.kinematics == Kinematics::Trigonometric {
        other.parameters.kinematics = Kinematics::Linear;
    }
    Some(other)
}
