//! Runs of many walls through many records.

use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

use ground_motion::GroundMotion;
use numpy::PyArray1;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use record::{LANES, Outcome, RecordSolver, RunEnd};
use rocking_wall::scene::{SceneError, check_tail};
use rocking_wall::solver::{Motion as Solved, SolverError};
use rocking_wall::wall::Sides;
use run::parallel;
use run::shaking::{Shaken, Shaking, felt, together};

use crate::arrays::{Motion, Numbers, samples};
use crate::errors::{failed, of_scene, refused};
use crate::walls::Wall;
use crate::watch::{threads_of, watched};

/// Most runs of a thread between two looks at Ctrl-C.
const RUNS_AT_ONCE: usize = 256;

/// A wall as records find it.
pub(crate) struct Prepared<'a> {
    wall: &'a Wall,
    pub(crate) motion: Solved,
    /// u and u̇ at the start of a record.
    pub(crate) start: [f64; 2],
}

impl<'a> Prepared<'a> {
    pub(crate) fn new(wall: &'a Wall) -> PyResult<Self> {
        let mut parameters = wall.scene.parameters.clone();
        parameters.u_start = wall.start.unwrap_or(0.0);
        let motion = Solved::of(&parameters, parameters.tolerance).map_err(refused)?;
        motion.wall().check_start(parameters.u_start).map_err(refused)?;
        Ok(Self { wall, motion, start: [parameters.u_start, parameters.u_dot_start] })
    }

    /// Returns the motion that the wall feels under a record: on storeys that of the floors, until the tail
    /// ends.
    pub(crate) fn felt<'r>(
        &self,
        record: &'r GroundMotion,
        tail: f64,
    ) -> Result<Cow<'r, GroundMotion>, SceneError> {
        felt(self.wall.scene.floors.as_ref(), self.wall.equation.body(), record, tail)
    }

    /// Returns `u_max`, its largest ratio to `u_ins`, and the time of overturning (NaN for none).
    pub(crate) fn peaks(&self, outcome: &Outcome) -> [f64; 3] {
        let instability: Sides = self.wall.equation.body().instability;
        let [largest, ratio] = outcome.state.reported_peak(instability, outcome.overturning.is_some());
        [largest, ratio, outcome.overturning.unwrap_or(f64::NAN)]
    }
}

/// Checks the factors on a record.
pub(crate) fn check_factor(record: &GroundMotion, factor: f64) -> PyResult<()> {
    if (factor * record.peak()).is_finite() {
        return Ok(());
    }
    Err(refused(format!("a factor is {factor}; give finite factors that keep the record finite")))
}

/// A run: the numbers of its wall and of its record, and the factor.
type Numbered = (usize, usize, f64);

/// Why a run has no peaks.
enum Failure {
    /// The motion of the floors could not be computed.
    Floors(SceneError),
    Run(SolverError),
}

/// Runs walls through records, each run given by the numbers of both and a factor; returns `u_max`, its
/// largest ratio to `u_ins`, and the time of overturning (NaN for none).
#[pyfunction]
pub(crate) fn simulate_many<'py>(
    py: Python<'py>,
    walls: Vec<Py<Wall>>,
    records: Vec<Motion>,
    wall_of: Vec<usize>,
    record_of: Vec<usize>,
    factors: &Bound<'py, PyAny>,
    tail: f64,
    threads: Option<&Bound<'py, PyAny>>,
) -> PyResult<[Numbers<'py>; 3]> {
    check_tail(tail).map_err(of_scene)?;
    let (factors, threads) = (samples(factors)?, threads_of(threads)?.get());
    let walls = walls.iter().map(|wall| Prepared::new(wall.get())).collect::<PyResult<Vec<_>>>()?;
    let records: Vec<_> = records.into_iter().map(|Motion(record)| record).collect();
    let runs = wall_of.into_iter().zip(record_of).zip(factors);
    let runs: Vec<Numbered> = runs.map(|((wall, record), factor)| (wall, record, factor)).collect();
    runs.iter().try_for_each(|(_, record, factor)| check_factor(&records[*record], *factor))?;
    // the runs of a wall and record beside each other, so that they are prepared once
    let mut order: Vec<usize> = (0..runs.len()).collect();
    order.sort_by_key(|&number| (runs[number].0, runs[number].1));
    let size = runs.len().div_ceil(threads).clamp(LANES, RUNS_AT_ONCE);
    let groups: Vec<_> = order.chunks(size).collect();
    let work = |is_wanted: &(dyn Fn() -> bool + Sync)| {
        parallel::map(groups.len(), threads, |group| {
            let numbers = groups[group];
            let chosen: Vec<_> = numbers.iter().map(|&number| runs[number]).collect();
            if !is_wanted() {
                return Err(None);
            }
            let found = run_group(&walls, &records, &chosen, tail);
            found.map_err(|(place, failure)| Some((numbers[place], failure)))
        })
    };
    let found = watched(py, work, || Ok(()))?.map_err(|error| match error {
        None => PyKeyboardInterrupt::new_err(()),
        Some((number, failure)) => {
            let run = format!("run {number}, of factor {:?}", runs[number].2);
            match failure {
                Failure::Floors(error) => refused(format!("{run}: {error}")),
                Failure::Run(error) => failed(format!("{run}: {error}")),
            }
        }
    })?;
    let mut peaks = vec![[f64::NAN; 3]; runs.len()];
    for (number, found) in order.into_iter().zip(found.concat()) {
        peaks[number] = found;
    }
    Ok([0, 1, 2].map(|part| PyArray1::from_iter(py, peaks.iter().map(|peaks| peaks[part]))))
}

/// Runs some walls through some records together. A failure has the place of its run.
fn run_group(
    walls: &[Prepared<'_>],
    records: &[GroundMotion],
    runs: &[Numbered],
    tail: f64,
) -> Result<Vec<[f64; 3]>, (usize, Failure)> {
    // the pairs of wall and record, and the walls with the steps of their records, in order of appearance
    let (mut places, mut pairs) = (HashMap::new(), Vec::new());
    for (number, &(wall, record, _)) in runs.iter().enumerate() {
        if let Entry::Vacant(place) = places.entry((wall, record)) {
            place.insert(pairs.len());
            let felt = walls[wall].felt(&records[record], tail);
            pairs.push((wall, felt.map_err(|error| (number, Failure::Floors(error)))?));
        }
    }
    let (mut of_step, mut solvers) = (HashMap::new(), Vec::new());
    let mut of_pair = Vec::with_capacity(pairs.len());
    for (wall, felt) in &pairs {
        let place = *of_step.entry((*wall, felt.step().to_bits())).or_insert(solvers.len());
        if place == solvers.len() {
            solvers.push(RecordSolver::new(&walls[*wall].motion, felt.step()));
        }
        of_pair.push(place);
    }
    let mut shakings = Vec::with_capacity(pairs.len());
    for ((_, felt), place) in pairs.iter().zip(of_pair) {
        shakings.push(Shaking::new(&solvers[place], felt, tail));
    }
    let mut shaken = Vec::with_capacity(runs.len());
    for &(wall, record, factor) in runs {
        let shaking = &shakings[places[&(wall, record)]];
        shaken.push(Shaken { shaking, start: walls[wall].start, factor });
    }
    let outcomes = together(&shaken, RunEnd::AtPeaks).into_iter().zip(runs).enumerate();
    outcomes
        .map(|(number, (outcome, (wall, ..)))| match outcome {
            Ok(outcome) => Ok(walls[*wall].peaks(&outcome)),
            Err(error) => Err((number, Failure::Run(error))),
        })
        .collect()
}
