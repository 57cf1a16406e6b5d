//! Maps of stability: free motions over stiffness, step and damping, and a table of extremes.
//!
//! A free motion is stable if nothing in it is not finite, |u| never exceeds its start and the energy ½ u̇² + ∫F du never grows
//! beyond [`GROWTH`]; its error is the largest |Δu|/`u_ins` against the tightest solver, at every tenth of a second.

mod extreme;

pub use extreme::{Extreme, extremes};

use rocking_wall::solver::{Memo, Method, Motion, Segment, SolverError, State};
use rocking_wall::variables::{DampingModel, DampingSource, Solver};
use rocking_wall::wall::{ParameterError, Parameters, Support};

/// Growth of the energy from one step to the next, over the energy at the start, that counts as none: the adaptive solver's
/// tolerance of 1e-8 on u allows ten times as much on the energy.
pub const GROWTH: f64 = 1e-7;
/// Instants compared in a run of 4 s.
const INSTANTS: u32 = 40;
/// Time between them \[s\].
const GRID: f64 = 0.1;
/// Start of a run over `u_ins`.
const RELEASE: f64 = 0.6;

/// One free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Nothing grew, nothing was lost.
    pub stable: bool,
    /// Largest |Δu|/`u_ins`; infinite where the run broke off.
    pub error: f64,
    /// Largest growth of the energy in one step over the energy at the start.
    pub growth: f64,
}

/// What the vertical axis of a map is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Steps \[s\].
    Step,
    /// Damping ratios \[-\].
    Ratio,
}

/// Free motions of one solver with one damping over a₁ and a second axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The solver asked for.
    pub solver: Solver,
    /// The damping.
    pub damping: DampingModel,
    /// What the rows are.
    pub axis: Axis,
    /// a₁ of each column.
    pub columns: Vec<f64>,
    /// Step or ξ of each row.
    pub rows: Vec<f64>,
    /// One for each row and column.
    pub cells: Vec<Vec<Cell>>,
}

/// Why a run could not be made.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// The wall's parameters.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The run.
    #[error(transparent)]
    Run(#[from] SolverError),
}

/// Solvers and dampings worth a map: `automatic` for each damping, and the others where they differ from it.
pub const MAPS: [(Solver, DampingModel); 7] = [
    (Solver::Automatic, DampingModel::ConstantCoefficient),
    (Solver::Automatic, DampingModel::ConstantRatio),
    (Solver::Automatic, DampingModel::StiffnessProportional),
    (Solver::Adaptive, DampingModel::ConstantCoefficient),
    (Solver::Newmark, DampingModel::ConstantCoefficient),
    (Solver::Newmark, DampingModel::ConstantRatio),
    (Solver::Newmark, DampingModel::StiffnessProportional),
];

/// a₁ from 1e-6 to 0.1, `count` of them.
fn stiffnesses(count: u32) -> Vec<f64> {
    (0..count).map(|index| libm::pow(10.0, -6.0 + 5.0 * f64::from(index) / f64::from(count - 1))).collect()
}

/// Parts of a tenth of a second, down to steps of 1e-5 s.
const PARTS: [u32; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];
const RATIOS: [f64; 9] = [0.0, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9, 1.0, 2.0];
/// Step of the maps over ξ: 1/20 of the grid \[s\].
const RATIO_PARTS: u32 = 20;
/// ξ of the maps over the step.
const STEP_RATIO: f64 = 0.03;

/// Makes one map, `columns` values of a₁ wide.
///
/// # Errors
/// [`StabilityError`] if a reference cannot be made.
pub fn map(solver: Solver, damping: DampingModel, axis: Axis, columns: u32) -> Result<Map, StabilityError> {
    let stiffnesses = stiffnesses(columns);
    let rows: Vec<(f64, u32, f64)> = match axis {
        Axis::Step => PARTS.iter().map(|&n| (GRID / f64::from(n), n, STEP_RATIO)).collect(),
        Axis::Ratio => RATIOS.iter().map(|&xi| (xi, RATIO_PARTS, xi)).collect(),
    };
    let mut cells = vec![Vec::with_capacity(stiffnesses.len()); rows.len()];
    for &a1 in &stiffnesses {
        for (row, &(_, parts, xi)) in rows.iter().enumerate() {
            cells[row].push(cell(solver, damping, a1, xi, parts)?);
        }
    }
    let rows = rows.iter().map(|row| row.0).collect();
    Ok(Map { solver, damping, axis, columns: stiffnesses, rows, cells })
}

fn cell(
    solver: Solver,
    damping_model: DampingModel,
    a1: f64,
    xi: f64,
    parts: u32,
) -> Result<Cell, StabilityError> {
    let step = GRID / f64::from(parts);
    let parameters = Parameters {
        height: 3.0,
        thickness: 0.3,
        a1,
        damping_model,
        damping_source: DampingSource::Given,
        xi,
        solver,
        newmark_step: step,
        ..Parameters::default()
    };
    let motion = Motion::of(&parameters, parameters.tolerance)?;
    let wall = motion.wall().clone();
    let tightest =
        if wall.has_constant_damping() { Method::Exact } else { Method::Adaptive { tolerance: 1e-13 } };
    let start = RELEASE * wall.body().instability.positive;
    let mut reference = FreeMotion::new(Motion::new(wall, tightest), start);
    let mut tried = FreeMotion::new(motion, start);
    let mut cell = Cell { stable: true, error: 0.0, growth: 0.0 };
    let scale = tried.motion.wall().displacement_scale();
    for _ in 0..INSTANTS {
        reference.advance(GRID)?;
        for _ in 0..parts {
            let Ok(growth) = tried.advance(step) else {
                return Ok(Cell { stable: false, error: f64::INFINITY, growth: f64::INFINITY });
            };
            cell.growth = cell.growth.max(growth);
        }
        let error = (tried.state.displacement - reference.state.displacement).abs() / scale;
        cell.error = cell.error.max(error);
    }
    let bounded = tried.state.peaks.largest() <= start * (1.0 + GROWTH);
    cell.stable = cell.growth <= GROWTH && bounded && cell.error.is_finite();
    Ok(cell)
}

/// A wall released, and its energy.
struct FreeMotion {
    motion: Motion,
    state: State,
    memo: Memo,
    first_energy: f64,
    energy: f64,
}

impl FreeMotion {
    fn new(motion: Motion, displacement: f64) -> Self {
        let state = motion.start(displacement, 0.0, Support::default());
        let energy = motion.wall().energy(displacement, 0.0);
        Self { motion, state, memo: Memo::default(), first_energy: energy, energy }
    }

    /// Moves on, and returns the growth of the energy over that at the start.
    fn advance(&mut self, duration: f64) -> Result<f64, SolverError> {
        let segment = Segment { duration, from: Support::default(), to: Support::default() };
        self.motion.advance(&mut self.state, &segment, false, &mut self.memo)?;
        let energy = self.motion.wall().energy(self.state.displacement, self.state.velocity);
        let growth = (energy - self.energy) / self.first_energy;
        self.energy = energy;
        Ok(growth)
    }
}
