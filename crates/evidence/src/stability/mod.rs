//! Stability of the solvers: maps over stiffness, step and damping, and a table of extremes.
//!
//! A free motion is stable if it stays finite, |u| never exceeds its start, and the energy ½ u̇² + ∫F du
//! never grows by more than [`GROWTH`]. Its error is the largest |Δu|/`u_ins` against the tightest solver, at
//! every tenth of a second.
//!
//! ```
//! use rocking_wall::variables::{DampingModel, Solver};
//! use evidence::stability::{RowQuantity, map};
//!
//! let damping = DampingModel::ConstantCoefficient;
//! let map = map(Solver::Automatic, damping, RowQuantity::DampingRatio, 2)?;
//! assert!(map.cells.iter().flatten().all(|cell| cell.stable));
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

mod extreme;
pub mod page;
mod released;

pub use extreme::extremes;
use released::Released;
use rocking_wall::solver::{Method, Motion};
use rocking_wall::variables::{DampingModel, Solver};
use rocking_wall::wall::{Parameters, Ratio};

use crate::EvidenceError;
use run::model::damping_models;

/// Largest growth of the energy in one step, over the energy at the start, that counts as none \[-\]. The
/// adaptive solver's tolerance of 1e-8 on u allows ten times as much on the energy.
pub const GROWTH: f64 = 1e-7;
/// Number of instants compared in a run of 4 s.
const INSTANTS: u32 = 40;
/// Time between them \[s\].
const INTERVAL: f64 = 0.1;
/// Start of a run over `u_ins`.
const RELEASE: f64 = 0.6;

/// Result of one free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCell {
    /// Whether the motion is stable.
    pub stable: bool,
    /// Largest |Δu|/`u_ins` \[-\]; infinite where the run failed.
    pub error: f64,
    /// Largest growth of the energy in one step over the energy at the start \[-\].
    pub growth: f64,
}

/// Quantity that varies from row to row of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowQuantity {
    /// Step \[s\].
    Step,
    /// Damping ratio ξ \[-\].
    DampingRatio,
}

impl RowQuantity {
    /// Its name in files, in words and on an axis.
    fn names(self) -> [&'static str; 3] {
        match self {
            Self::Step => ["step_s", "step", "step (s)"],
            Self::DampingRatio => ["xi", "xi", "ξ"],
        }
    }
}

/// Free motions of one solver with one damping model over a₁ and a second quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Solver.
    pub solver: Solver,
    /// Damping model.
    pub damping: DampingModel,
    /// Quantity of the rows.
    pub quantity: RowQuantity,
    /// a₁ of each column \[-\].
    pub columns: Vec<f64>,
    /// Step \[s\] or ξ \[-\] of each row.
    pub rows: Vec<f64>,
    /// Results: `cells[row][column]`.
    pub cells: Vec<Vec<MapCell>>,
}

/// Solvers and damping models worth a map: `automatic` with each damping model, and the others where they
/// differ.
pub fn maps() -> Vec<(Solver, DampingModel)> {
    let models = || damping_models().filter(|model| model.ratio() == Some(Ratio::Xi));
    let with = |solver: Solver| models().map(move |model| (solver, model));
    // the adaptive solver is the automatic one where damping varies on a branch
    let adaptive = (Solver::Adaptive, DampingModel::ConstantCoefficient);
    with(Solver::Automatic).chain([adaptive]).chain(with(Solver::Newmark)).collect()
}

/// Steps in an interval, down to steps of 1e-5 s.
const STEPS: [u32; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];
const RATIOS: [f64; 9] = [0.0, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9, 1.0, 2.0];
/// Steps in an interval of the maps over ξ.
const RATIO_STEPS: u32 = 20;
/// ξ of the maps over the step.
const STEP_RATIO: f64 = 0.03;

/// Makes one map with `columns` values of a₁ from 1e-6 to 0.1.
///
/// # Errors
/// [`EvidenceError`] if a reference run fails.
pub fn map(
    solver: Solver,
    damping: DampingModel,
    quantity: RowQuantity,
    columns: u32,
) -> Result<Map, EvidenceError> {
    let a1 = |index| libm::pow(10.0, -6.0 + 5.0 * f64::from(index) / f64::from(columns - 1));
    let columns: Vec<f64> = (0..columns).map(a1).collect();
    let rows: Vec<(f64, u32, f64)> = match quantity {
        RowQuantity::Step => STEPS.iter().map(|&n| (INTERVAL / f64::from(n), n, STEP_RATIO)).collect(),
        RowQuantity::DampingRatio => RATIOS.iter().map(|&xi| (xi, RATIO_STEPS, xi)).collect(),
    };
    let row = |&(_, steps, xi): &(f64, u32, f64)| {
        columns.iter().map(|&a1| cell(solver, damping, a1, xi, steps)).collect()
    };
    let cells = rows.iter().map(row).collect::<Result<_, EvidenceError>>()?;
    let rows = rows.iter().map(|row| row.0).collect();
    Ok(Map { solver, damping, quantity, columns, rows, cells })
}

/// Compares a free motion in `steps` steps an interval with the reference.
fn cell(
    solver: Solver,
    damping_model: DampingModel,
    a1: f64,
    xi: f64,
    steps: u32,
) -> Result<MapCell, EvidenceError> {
    let step = INTERVAL / f64::from(steps);
    let parameters = Parameters {
        height: 3.0,
        thickness: 0.3,
        a1,
        damping_model,
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
    let scale = wall.displacement_scale();
    let mut reference = Released::new(Motion::new(wall, tightest), RELEASE);
    let mut tried = Released::new(motion, RELEASE);
    let (mut error, mut growth) = (0.0_f64, 0.0_f64);
    for _ in 0..INSTANTS {
        reference.advance(INTERVAL)?;
        for _ in 0..steps {
            let Ok(grown) = tried.advance(step) else {
                return Ok(MapCell { stable: false, error: f64::INFINITY, growth: f64::INFINITY });
            };
            growth = growth.max(grown);
        }
        error = error.max((tried.state.displacement - reference.state.displacement).abs() / scale);
    }
    let bounded = tried.state.peaks.largest() <= start * (1.0 + GROWTH);
    Ok(MapCell { stable: growth <= GROWTH && bounded && error.is_finite(), error, growth })
}
