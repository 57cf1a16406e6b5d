//! Runs of many walls through many records.

use std::collections::BTreeMap;
use std::fmt::Display;

use files::check_value;
use numpy::PyArray1;
use pyo3::prelude::*;
use record::{LANES, Outcome, RecordSolver, RunEnd};
use rocking_wall::solver::Motion as Solved;
use run::parallel;
use run::shaking::{Shaken, Shaking, felt, together};
use scene::MotionTable;

use crate::arrays::{Motion, Numbers, samples};
use crate::errors::{failed, of_motion, refused};
use crate::walls::Wall;
use crate::watch::{stoppable, threads_of};

/// Most runs of a group, between two of which a thread looks at Ctrl-C: of one thread, and of several, which
/// end together only where each has several groups.
const RUNS_AT_ONCE: [usize; 2] = [1024, 256];

/// A wall as records find it.
struct Prepared<'a> {
    wall: &'a Wall,
    motion: Solved,
    /// u and u̇ at the start of a record.
    start: [f64; 2],
}

impl<'a> Prepared<'a> {
    fn new(wall: &'a Wall) -> PyResult<Self> {
        let mut parameters = wall.scene.parameters.clone();
        parameters.u_start = wall.start.unwrap_or(0.0);
        let motion = Solved::of(&parameters, parameters.tolerance).map_err(refused)?;
        motion.wall().check_start(parameters.u_start).map_err(refused)?;
        Ok(Self { wall, motion, start: [parameters.u_start, parameters.u_dot_start] })
    }

    /// Returns `u_max`, its largest ratio to `u_ins`, and the time of overturning (NaN for none).
    fn peaks(&self, outcome: &Outcome) -> [f64; 3] {
        let instability = self.wall.equation.body().instability;
        let [largest, ratio] = outcome.state.reported_peak(instability, outcome.overturning.is_some());
        [largest, ratio, outcome.overturning.unwrap_or(f64::NAN)]
    }
}

/// A run: its number, those of its wall and of its record, and the factor.
#[derive(Clone, Copy)]
struct Numbered {
    number: usize,
    wall: usize,
    record: usize,
    factor: f64,
}

impl Numbered {
    /// Names the run in an error.
    fn named(self, error: impl Display) -> String {
        format!("run {}, of factor {:?}: {error}", self.number, self.factor)
    }
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
    threads: Option<i64>,
) -> PyResult<[Numbers<'py>; 3]> {
    check_value::<MotionTable>("tail", tail).map_err(refused)?;
    let (factors, threads) = (samples(factors)?, threads_of(threads)?.get());
    let walls = walls.iter().map(|wall| Prepared::new(wall.get())).collect::<PyResult<Vec<_>>>()?;
    let mut runs = Vec::with_capacity(factors.len());
    for (number, ((wall, record), factor)) in wall_of.into_iter().zip(record_of).zip(factors).enumerate() {
        records[record].0.check_factor(factor).map_err(of_motion)?;
        runs.push(Numbered { number, wall, record, factor });
    }
    // the runs of a wall and record beside each other, so that they are prepared once
    runs.sort_by_key(|run| (run.wall, run.record));
    let most = RUNS_AT_ONCE[usize::from(threads > 1)];
    let size = runs.len().div_ceil(threads).clamp(LANES, most);
    let groups: Vec<_> = runs.chunks(size).collect();
    let run = |group: usize| run_group(&walls, &records, groups[group], tail);
    let found = stoppable(py, || parallel::map(groups.len(), threads, run))??;
    let mut peaks = vec![[f64::NAN; 3]; runs.len()];
    for (run, found) in runs.iter().zip(found.concat()) {
        peaks[run.number] = found;
    }
    Ok([0, 1, 2].map(|part| PyArray1::from_iter(py, peaks.iter().map(|peaks| peaks[part]))))
}

/// Runs some walls through some records together; the runs of a wall and record are beside each other.
fn run_group(
    walls: &[Prepared<'_>],
    records: &[Motion],
    runs: &[Numbered],
    tail: f64,
) -> PyResult<Vec<[f64; 3]>> {
    // what a wall feels under a record: on storeys the motion of the floors, until the tail ends
    let (mut pairs, mut solvers) = (Vec::new(), BTreeMap::new());
    for own in runs.chunk_by(|a, b| (a.wall, a.record) == (b.wall, b.record)) {
        let (Prepared { wall, motion, .. }, record) = (&walls[own[0].wall], &records[own[0].record].0);
        let felt = felt(wall.scene.floors.as_ref(), wall.equation.body(), record, tail);
        let felt = felt.map_err(|error| refused(own[0].named(error)))?;
        // walls share their solver between records of the same step
        let key = (own[0].wall, felt.step().to_bits());
        solvers.entry(key).or_insert_with(|| RecordSolver::new(motion, felt.step()));
        pairs.push((own, felt, key));
    }
    let shakings = pairs.iter().map(|(own, felt, key)| {
        let shaking = Shaking::new(&solvers[key], felt, tail);
        if own.len() >= LANES {
            shaking.prepare();
        }
        shaking
    });
    let shakings: Vec<_> = shakings.collect();
    let own = pairs
        .iter()
        .zip(&shakings)
        .flat_map(|((own, ..), shaking)| own.iter().map(move |run| (run, shaking)));
    let start = |run: &Numbered| walls[run.wall].start;
    let shaken: Vec<_> =
        own.map(|(run, shaking)| Shaken { shaking, start: start(run), factor: run.factor }).collect();
    let outcomes = together(&shaken, RunEnd::AtPeaks).into_iter().zip(runs);
    outcomes
        .map(|(outcome, run)| {
            let outcome = outcome.map_err(|error| failed(run.named(error)))?;
            Ok(walls[run.wall].peaks(&outcome))
        })
        .collect()
}
