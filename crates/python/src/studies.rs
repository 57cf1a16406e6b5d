//! The class `Study`: an incremental dynamic analysis, in memory or in parts.

use std::convert::Infallible;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use ground_motion::STANDARD_GRAVITY;
use numpy::PyArray1;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use study::fragility::Interval;
use study::ida::{Curve, Exceedance, IdaError, Study as Ida};
use study::loaded::{LoadedStudy, Sent};
use study::parallel;
use study::results::{Fitting, WallResults};
use study_folder::{Contents, encode};

use crate::errors::{failed, of_scene};

/// Time between two looks at Ctrl-C and at the progress.
const LOOK: Duration = Duration::from_millis(50);

/// A study ready to run.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Study {
    pub(crate) loaded: LoadedStudy,
    /// What its parts depend on, and the fingerprint of this.
    contents: OnceLock<(Contents, String)>,
}

/// A study as values that pickle can send: its text, its walls, and its records with steps and samples.
type Values<Samples> = (String, Vec<(String, String)>, Vec<(String, f64, Samples)>);

/// Why the curves of a study are not complete.
enum Stop {
    Asked,
    Failed(IdaError),
}

#[pymethods]
impl Study {
    /// Reads a study file.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let loaded = py.detach(|| LoadedStudy::read(&path)).map_err(of_scene)?;
        Ok(Self { loaded, contents: OnceLock::new() })
    }

    /// Makes a study of its values on another machine.
    #[staticmethod]
    fn received(py: Python<'_>, values: Values<Vec<f64>>) -> PyResult<Self> {
        let (text, walls, records) = values;
        let sent = Sent { text, walls, records };
        let loaded = py.detach(|| LoadedStudy::received(sent)).map_err(of_scene)?;
        Ok(Self { loaded, contents: OnceLock::new() })
    }

    /// Returns the values of the study, to send them.
    fn sent<'py>(&self, py: Python<'py>) -> Values<Bound<'py, PyArray1<f64>>> {
        let Sent { text, walls, records } = self.loaded.sent();
        let array = |(name, dt, samples)| (name, dt, PyArray1::from_vec(py, samples));
        (text, walls, records.into_iter().map(array).collect())
    }

    /// Counts the parts.
    #[getter]
    fn parts(&self) -> usize {
        self.contents().0.parts()
    }

    /// Computes a part, on this thread, as the bytes of its file.
    fn part<'py>(&self, py: Python<'py>, part: usize) -> PyResult<Bound<'py, PyBytes>> {
        let (contents, fingerprint) = self.contents();
        if part >= contents.parts() {
            return Err(PyIndexError::new_err(format!("part {part} of {}", contents.parts())));
        }
        let bytes = py.detach(|| {
            let study = &self.loaded.study;
            let curve = |index| study.curve(study.case(index));
            let curves = contents.part(part).map(curve).collect::<Result<Vec<_>, _>>().map_err(failed)?;
            encode(contents, fingerprint, part, &curves).map_err(failed)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.loaded.title
    }

    #[getter]
    fn measure(&self) -> String {
        self.loaded.study.measure().name()
    }

    #[getter]
    fn walls(&self) -> Vec<&str> {
        self.loaded.study.walls().iter().map(|wall| wall.name.as_str()).collect()
    }

    #[getter]
    fn records(&self) -> Vec<&str> {
        self.loaded.study.records().iter().map(|record| record.name.as_str()).collect()
    }

    #[getter]
    fn models(&self) -> Vec<&str> {
        self.loaded.study.models().iter().map(|model| model.name.as_str()).collect()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.loaded.warnings.clone()
    }

    /// Counts the combinations of walls, records and models.
    fn __len__(&self) -> usize {
        self.loaded.study.count()
    }

    /// Runs the study and returns its tables. `progress` is called with the number of combinations done.
    fn run<'py>(
        &self,
        py: Python<'py>,
        threads: Option<NonZeroUsize>,
        progress: &Bound<'py, PyAny>,
    ) -> PyResult<[Bound<'py, PyDict>; 3]> {
        let LoadedStudy { study, report, .. } = &self.loaded;
        let threads = parallel::threads(threads).get();
        let curves = self.curves(py, threads, progress)?;
        let results = py.detach(|| {
            let grid = study.levels().shared();
            let fitting = Fitting::new(study.records().len(), &self.models(), grid, report);
            let of_wall: Vec<_> = curves.chunks(study.count() / study.walls().len()).collect();
            let fitted = parallel::map(of_wall.len(), threads, |wall| {
                Ok::<_, Infallible>(fitting.results(of_wall[wall].to_vec()))
            });
            let Ok(results) = fitted;
            results
        });
        Ok([
            levels(py, study, &curves)?,
            collapses(py, study, &curves)?,
            fragilities(py, study, &results, &report.fractions)?,
        ])
    }
}

impl Study {
    fn contents(&self) -> &(Contents, String) {
        self.contents.get_or_init(|| {
            let contents = Contents::of(&self.loaded.study);
            let fingerprint = contents.fingerprint();
            (contents, fingerprint)
        })
    }

    /// Computes all curves on other threads, while this one looks at Ctrl-C and reports progress.
    fn curves(&self, py: Python<'_>, threads: usize, progress: &Bound<'_, PyAny>) -> PyResult<Vec<Curve>> {
        let study = &self.loaded.study;
        let (asked_to_stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
        let curve = |index| {
            if asked_to_stop.load(Ordering::Relaxed) {
                return Err(Stop::Asked);
            }
            let curve = study.curve(study.case(index)).map_err(Stop::Failed)?;
            done.fetch_add(1, Ordering::Relaxed);
            Ok(curve)
        };
        let watcher = thread::current();
        let (outcome, watched) = thread::scope(|scope| {
            let work = scope.spawn(|| {
                let outcome = parallel::map(study.count(), threads, curve);
                watcher.unpark();
                outcome
            });
            let mut watched = Ok(());
            while !work.is_finished() && watched.is_ok() {
                py.detach(|| thread::park_timeout(LOOK));
                let report = || progress.call1((done.load(Ordering::Relaxed),)).map(drop);
                watched = py.check_signals().and_then(|()| report());
            }
            asked_to_stop.store(watched.is_err(), Ordering::Relaxed);
            (py.detach(|| work.join()), watched)
        });
        let outcome = outcome.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        outcome.map_err(|stop| match (watched, stop) {
            (Err(error), _) => error,
            (Ok(()), Stop::Failed(error)) => failed(error),
            (Ok(()), Stop::Asked) => PyKeyboardInterrupt::new_err(()),
        })
    }
}

/// A table: the columns by their names.
fn table<'py>(
    py: Python<'py>,
    names: Vec<(&str, Vec<&str>)>,
    numbers: Vec<(&str, Vec<f64>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (name, column) in names {
        table.set_item(name, column)?;
    }
    for (name, column) in numbers {
        table.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(table)
}

/// The first columns of a table: wall, model and record of each row, given by the number of its combination.
fn names<'a>(study: &'a Ida, rows: &[usize]) -> Vec<(&'static str, Vec<&'a str>)> {
    let of = |name: fn(&'a Ida, usize) -> &'a str| rows.iter().map(|&index| name(study, index)).collect();
    vec![
        ("wall", of(|study, index| &study.walls()[study.case(index).wall].name)),
        ("model", of(|study, index| &study.models()[study.case(index).model].name)),
        ("record", of(|study, index| &study.records()[study.case(index).record].name)),
    ]
}

/// Every run, as in `levels.csv`.
fn levels<'py>(py: Python<'py>, study: &Ida, curves: &[Curve]) -> PyResult<Bound<'py, PyDict>> {
    let curves = curves.iter().enumerate();
    let runs: Vec<_> =
        curves.flat_map(|(index, curve)| curve.runs().iter().map(move |run| (index, run))).collect();
    let rows: Vec<_> = runs.iter().map(|(index, _)| *index).collect();
    let numbers = vec![
        ("intensity_g", runs.iter().map(|(_, run)| in_g(run.intensity)).collect()),
        ("u_max_over_u_ins", runs.iter().map(|(_, run)| run.demand).collect()),
        ("overturned", runs.iter().map(|(_, run)| f64::from(u8::from(run.overturning.is_some()))).collect()),
        ("overturn_time_s", runs.iter().map(|(_, run)| run.overturning.unwrap_or(f64::NAN)).collect()),
    ];
    table(py, names(study, &rows), numbers)
}

/// The collapse of every wall, model and record, as in `collapses.csv`.
fn collapses<'py>(py: Python<'py>, study: &Ida, curves: &[Curve]) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<_> = (0..curves.len()).collect();
    let of = |value: fn(&Curve) -> f64| curves.iter().map(value).collect();
    let numbers = vec![
        (
            "collapse_g",
            of(|curve| match curve.collapse() {
                Exceedance::At(intensity) => in_g(intensity),
                Exceedance::Above(_) => f64::NAN,
            }),
        ),
        ("standing_below_g", of(|curve| in_g(curve.level_below_collapse()))),
        ("highest_level_g", of(|curve| in_g(curve.top()))),
        ("runs", of(|curve| curve.runs().len() as f64)),
        ("resurrections", of(|curve| curve.resurrections() as f64)),
    ];
    table(py, names(study, &rows), numbers)
}

/// The fragility of every wall, model and limit state, as in `fragilities.csv`.
fn fragilities<'py>(
    py: Python<'py>,
    study: &Ida,
    results: &[WallResults],
    fractions: &[f64],
) -> PyResult<Bound<'py, PyDict>> {
    let (mut walls, mut models) = (Vec::new(), Vec::new());
    let mut columns: Vec<(&str, Vec<f64>)> = Vec::new();
    for (w, wall) in study.walls().iter().enumerate() {
        for (m, model) in study.models().iter().enumerate() {
            for (f, fraction) in fractions.iter().enumerate() {
                let summary = &results[w].summaries(f)[m];
                let [median, median_low, median_high] = values(&summary.median, STANDARD_GRAVITY);
                let [theta, theta_low, theta_high] = values(&summary.theta, STANDARD_GRAVITY);
                let [ratio, ratio_low, ratio_high] = values(&summary.median_ratio, 1.0);
                let [theta_ratio, theta_ratio_low, theta_ratio_high] = values(&summary.theta_ratio, 1.0);
                let row = [
                    ("u_max_over_u_ins", *fraction),
                    ("records", summary.records as f64),
                    ("censored", summary.censored as f64),
                    ("median_g", median),
                    ("median_low_g", median_low),
                    ("median_high_g", median_high),
                    ("theta_g", theta),
                    ("theta_low_g", theta_low),
                    ("theta_high_g", theta_high),
                    ("beta", summary.fitted.map_or(f64::NAN, |fit| fit.dispersion)),
                    ("beta_alone", summary.alone.map_or(f64::NAN, |fit| fit.dispersion)),
                    ("median_ratio", ratio),
                    ("median_ratio_low", ratio_low),
                    ("median_ratio_high", ratio_high),
                    ("theta_ratio", theta_ratio),
                    ("theta_ratio_low", theta_ratio_low),
                    ("theta_ratio_high", theta_ratio_high),
                ];
                walls.push(wall.name.as_str());
                models.push(model.name.as_str());
                columns.resize(row.len(), ("", Vec::new()));
                for (column, (name, value)) in columns.iter_mut().zip(row) {
                    column.0 = name;
                    column.1.push(value);
                }
            }
        }
    }
    table(py, vec![("wall", walls), ("model", models)], columns)
}

/// Returns an estimate and the ends of its interval in a unit: infinite above the levels, NaN where only
/// bounds are known.
fn values(interval: &Interval, unit: f64) -> [f64; 3] {
    let [low, high] = interval.range;
    let [least, least_low, least_high] = interval.least;
    [(least, interval.estimate), (least_low, low), (least_high, high)]
        .map(|(least, most)| if least == most || most == f64::INFINITY { most / unit } else { f64::NAN })
}

fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}
