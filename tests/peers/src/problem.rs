//! The problems: what every tool is given, and the reference history it is compared with.

use std::path::Path;

use ground_motion::GroundMotion;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::{Segment, SolverError};
use rocking_wall::variables::{DampingModel, Solver};
use rocking_wall::wall::{ParameterError, Parameters, Support};
use serde::Serialize;

/// A parapet of Table 5 of Tomassetti et al. and the factor on its record.
struct Parapet {
    number: u32,
    height: f64,
    thickness: f64,
    a1: f64,
    scale: f64,
}

const PARAPETS: [Parapet; 3] = [
    Parapet { number: 2, height: 1.5, thickness: 0.3, a1: 0.0012, scale: 0.8 },
    Parapet { number: 5, height: 3.0, thickness: 0.6, a1: 0.0024, scale: 1.2 },
    Parapet { number: 6, height: 6.0, thickness: 0.6, a1: 0.018, scale: 1.3 },
];

/// Tolerance of the reference where there is no closed form \[-\].
const REFERENCE_TOLERANCE: f64 = 1e-13;

/// One wall with one damping model under one motion.
pub(crate) struct Problem {
    pub(crate) scene: String,
    pub(crate) parameters: Parameters,
    pub(crate) motion: GroundMotion,
    pub(crate) equation: Equation,
    /// Displacement at every sample of the motion \[m\].
    pub(crate) reference: Vec<f64>,
}

/// ü = −λ `a_g` − c(u) u̇ − F(u)/`m_eff`, written out for tools without a model of walls.
pub(crate) struct Equation {
    pub(crate) u_ins: f64,
    pub(crate) step: f64,
    /// −λ `a_g` at the samples \[m/s²\].
    pub(crate) forcing: Vec<f64>,
    /// Corners of F(u) \[m\], and the lines between and beyond them as (u, F/`m_eff`, slope).
    pub(crate) corners: Vec<f64>,
    lines: Vec<[f64; 3]>,
    /// 2 ξ.
    twice_xi: f64,
    /// c on the elastic line, for CDC on all \[1/s\].
    elastic_damping: f64,
    constant: bool,
}

/// What is written for the tools outside Rust; SI units, force and mass per wall.
#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    effective_mass: f64,
    participation: f64,
    omega1: f64,
    u_ins: f64,
    damping_model: &'a str,
    xi: f64,
    /// (u, F/`m_eff`); the force goes on along the first and last lines.
    force_points: &'a [[f64; 2]],
    step: f64,
    samples_file: &'a str,
    reference_file: &'a str,
    tolerance_of_reference: f64,
}

impl Problem {
    /// Walls 2, 5 and 6, each with CDC and CDR and the computed ξ.
    ///
    /// # Errors
    /// If a wall cannot be followed, or overturns, in which case errors are meaningless.
    pub(crate) fn all(motion: &GroundMotion) -> Result<Vec<Self>, String> {
        let models = [("CDC", DampingModel::ConstantCoefficient), ("CDR", DampingModel::ConstantRatio)];
        let pairs = PARAPETS.iter().flat_map(|parapet| models.map(|model| (parapet, model)));
        pairs.map(|(parapet, (name, model))| Self::new(parapet, name, model, motion)).collect()
    }

    fn new(
        parapet: &Parapet,
        name: &str,
        damping_model: DampingModel,
        motion: &GroundMotion,
    ) -> Result<Self, String> {
        let scene = format!("wall {} {name}", parapet.number);
        let parameters = Parameters {
            height: parapet.height,
            thickness: parapet.thickness,
            a1: parapet.a1,
            damping_model,
            u_start: 0.0,
            tolerance: REFERENCE_TOLERANCE,
            ..Parameters::default()
        };
        let motion = motion.scaled(parapet.scale);
        let failed = |error: &dyn std::fmt::Display| format!("{scene}: {error}");
        let simulation = start(&parameters).map_err(|error| failed(&error))?;
        let equation = Equation::new(&simulation, &parameters, &motion);
        let mut reference = Vec::new();
        run(&mut simulation.clone(), &motion, &mut reference).map_err(|error| failed(&error))?;
        if reference.iter().any(|u| u.abs() > equation.u_ins) {
            return Err(failed(&"the wall overturns, so that its errors mean nothing; give another record"));
        }
        Ok(Self { scene, parameters, motion, equation, reference })
    }

    /// Writes the problem, its samples and its reference into a folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), String> {
        let simulation = start(&self.parameters).map_err(|error| error.to_string())?;
        let wall = simulation.wall();
        let stem = self.scene.replace(' ', "_");
        let (samples_file, reference_file) = (format!("{stem}_samples.txt"), format!("{stem}_reference.txt"));
        let document = Document {
            scene: &self.scene,
            effective_mass: wall.body().effective_mass,
            participation: wall.body().participation,
            omega1: wall.omega1(),
            u_ins: self.equation.u_ins,
            damping_model: if self.equation.constant { "CDC" } else { "CDR" },
            xi: wall.damping_ratio(),
            force_points: &force_points(&simulation),
            step: self.motion.step(),
            samples_file: &samples_file,
            reference_file: &reference_file,
            tolerance_of_reference: if self.equation.constant { 0.0 } else { REFERENCE_TOLERANCE },
        };
        let text = serde_json::to_string_pretty(&document).map_err(|error| error.to_string())?;
        let write = |name: &str, text: String| {
            let path = folder.join(name);
            std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
        };
        let lines = |values: &[f64]| {
            let words: Vec<String> = values.iter().map(|value| format!("{value:e}")).collect();
            words.join("\n") + "\n"
        };
        write(&format!("{stem}.json"), text)?;
        write(&samples_file, lines(self.motion.samples()))?;
        write(&reference_file, lines(&self.reference))
    }
}

/// A wall at rest before its motion.
pub(crate) fn start(parameters: &Parameters) -> Result<Simulation, ParameterError> {
    Simulation::new(parameters, None, 0.0, Support::default())
}

/// Moves a wall through a motion; the displacement at each sample goes to `history`.
pub(crate) fn run(
    simulation: &mut Simulation,
    motion: &GroundMotion,
    history: &mut Vec<f64>,
) -> Result<(), SolverError> {
    history.clear();
    history.push(simulation.progress().state.displacement);
    for ends in motion.samples().windows(2) {
        let (from, to) = (Support::rigid(ends[0]), Support::rigid(ends[1]));
        simulation.advance(&Segment { duration: motion.step(), from, to })?;
        history.push(simulation.progress().state.displacement);
    }
    Ok(())
}

/// Corners of F/`m_eff` with one point on each outer line; points within a line are left out.
fn force_points(simulation: &Simulation) -> Vec<[f64; 2]> {
    let branches = simulation.wall().branches();
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut last_stiffness = f64::NAN;
    for branch in branches {
        if branch.stiffness != last_stiffness {
            points.push([branch.lower, branch.restoring(branch.lower)]);
            last_stiffness = branch.stiffness;
        }
    }
    if let Some(branch) = branches.last() {
        points.push([branch.upper, branch.restoring(branch.upper)]);
    }
    points
}

impl Equation {
    fn new(simulation: &Simulation, parameters: &Parameters, motion: &GroundMotion) -> Self {
        let wall = simulation.wall();
        let points = force_points(simulation);
        let lines = points.windows(2).map(|pair| {
            let [[u, force], [next, force_next]] = [pair[0], pair[1]];
            [u, force, (force_next - force) / (next - u)]
        });
        let participation = wall.body().participation;
        Self {
            u_ins: wall.displacement_scale(),
            step: motion.step(),
            forcing: motion.samples().iter().map(|a| -participation * a).collect(),
            corners: points[1..points.len() - 1].iter().map(|point| point[0]).collect(),
            lines: lines.collect(),
            twice_xi: 2.0 * wall.damping_ratio(),
            elastic_damping: 2.0 * wall.damping_ratio() * wall.omega1(),
            constant: parameters.damping_model == DampingModel::ConstantCoefficient,
        }
    }

    /// Number of the line a displacement lies on.
    pub(crate) fn line_of(&self, displacement: f64) -> usize {
        self.corners.iter().take_while(|corner| displacement > **corner).count()
    }

    /// −λ `a_g`, linear between samples \[m/s²\].
    pub(crate) fn forcing_at(&self, time: f64) -> f64 {
        let position = time / self.step;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the record")]
        let index = (position.max(0.0) as usize).min(self.forcing.len() - 2);
        let (from, to) = (self.forcing[index], self.forcing[index + 1]);
        from + (to - from) * (position - index as f64)
    }

    /// ü on a line, which may be followed beyond its corners \[m/s²\].
    pub(crate) fn acceleration(&self, line: usize, time: f64, u: f64, v: f64) -> f64 {
        let [anchor, force, slope] = self.lines[line];
        let restoring = force + slope * (u - anchor);
        self.forcing_at(time) - self.damping(line, u, restoring) * v - restoring
    }

    fn damping(&self, line: usize, u: f64, restoring: f64) -> f64 {
        if self.constant || self.lines[line][2] > 0.0 {
            return self.elastic_damping;
        }
        // c = 2 ξ √(F/(u m_eff)), none where the secant stiffness is negative
        self.twice_xi * (restoring / u).max(0.0).sqrt()
    }

    /// ∂ü/∂u and ∂ü/∂u̇ on a line.
    pub(crate) fn jacobian(&self, line: usize, u: f64, v: f64) -> [f64; 2] {
        let [anchor, force, slope] = self.lines[line];
        let restoring = force + slope * (u - anchor);
        let damping = self.damping(line, u, restoring);
        let curved = !self.constant && slope <= 0.0 && damping > 0.0;
        // from c² = (2ξ)² F/(u m_eff): 2 c dc/du = (2ξ)² (slope − F/u)/u
        let damping_slope = if curved {
            self.twice_xi * self.twice_xi * (slope - restoring / u) / (2.0 * damping * u)
        } else {
            0.0
        };
        [-slope - damping_slope * v, -damping]
    }
}

/// The parameters of a problem with another solver.
pub(crate) fn with_solver(parameters: &Parameters, solver: Solver, tolerance: f64, step: f64) -> Parameters {
    Parameters { solver, tolerance, newmark_step: step, ..parameters.clone() }
}
