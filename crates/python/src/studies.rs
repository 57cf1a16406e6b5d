//! The class `Study`: an incremental dynamic analysis, in memory or in parts.

use std::convert::Infallible;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use ground_motion::STANDARD_GRAVITY;
use numpy::PyArray1;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rocking_wall::scene::SceneError;
use study::fragility::{Interval, Summary};
use study::ida::{Curve, Exceedance, IdaError, NamedRecord, Run, Study as Ida};
use study::loaded::{LoadedStudy, Sent};
use study::parallel;
use study::results::{Fitting, WallResults};
use study_folder::{Contents, encode};

use crate::arrays::{Given, motion};
use crate::errors::{failed, of_scene, refused};
use crate::study_walls::named_walls;
use crate::tables::Column::{self, Counts, Flags, Names, Numbers};
use crate::tables::table;
use crate::watch::watched;

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

    /// Makes a study of the text of its options, of walls and of records, by their names.
    #[staticmethod]
    fn of_parts(
        py: Python<'_>,
        text: String,
        walls: Vec<(String, Bound<'_, PyAny>)>,
        records: Vec<(String, Given<'_>)>,
    ) -> PyResult<Self> {
        let mut warnings = Vec::new();
        let walls = named_walls(&walls, &mut warnings)?;
        let record = |(name, given): (String, Given<'_>)| Ok(NamedRecord { name, motion: motion(&given)? });
        let records = records.into_iter().map(record).collect::<PyResult<_>>()?;
        let made = py.detach(|| LoadedStudy::of_parts(text, walls, records));
        let mut loaded = made.map_err(|error| match error {
            // the lines are those of a text that nobody has written
            SceneError::Line { message, .. } => refused(message),
            other => refused(other),
        })?;
        loaded.warnings.splice(..0, warnings);
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
        let done = AtomicUsize::new(0);
        let work = |is_wanted: &(dyn Fn() -> bool + Sync)| {
            parallel::map(study.count(), threads, |index| {
                if !is_wanted() {
                    return Err(Stop::Asked);
                }
                let curve = study.curve(study.case(index)).map_err(Stop::Failed)?;
                done.fetch_add(1, Ordering::Relaxed);
                Ok(curve)
            })
        };
        watched(py, work, || progress.call1((done.load(Ordering::Relaxed),)).map(drop))?.map_err(|stop| {
            match stop {
                Stop::Failed(error) => failed(error),
                Stop::Asked => PyKeyboardInterrupt::new_err(()),
            }
        })
    }
}

/// The first columns of a table: wall, model and record of each row, given by the number of its combination.
fn names<'a>(study: &'a Ida, rows: &[usize]) -> Vec<(&'static str, Column<'a>)> {
    let of =
        |name: fn(&'a Ida, usize) -> &'a str| Names(rows.iter().map(|&index| name(study, index)).collect());
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
    let numbers = |value: fn(&Run) -> f64| Numbers(runs.iter().map(|(_, run)| value(run)).collect());
    let values = [
        ("intensity_g", numbers(|run| in_g(run.intensity))),
        ("u_max_over_u_ins", numbers(|run| run.demand)),
        ("overturned", Flags(runs.iter().map(|(_, run)| run.overturning.is_some()).collect())),
        ("overturn_time_s", numbers(|run| run.overturning.unwrap_or(f64::NAN))),
    ];
    table(py, names(study, &rows).into_iter().chain(values))
}

/// The collapse of every wall, model and record, as in `collapses.csv`.
fn collapses<'py>(py: Python<'py>, study: &Ida, curves: &[Curve]) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<_> = (0..curves.len()).collect();
    let of = |value: fn(&Curve) -> f64| Numbers(curves.iter().map(value).collect());
    let count = |value: fn(&Curve) -> usize| Counts(curves.iter().map(value).collect());
    let values = [
        (
            "collapse_g",
            of(|curve| match curve.collapse() {
                Exceedance::At(intensity) => in_g(intensity),
                Exceedance::Above(_) => f64::NAN,
            }),
        ),
        ("standing_below_g", of(|curve| in_g(curve.level_below_collapse()))),
        ("highest_level_g", of(|curve| in_g(curve.top()))),
        ("runs", count(|curve| curve.runs().len())),
        ("resurrections", count(Curve::resurrections)),
    ];
    table(py, names(study, &rows).into_iter().chain(values))
}

/// The fragility of every wall, model and limit state, as in `fragilities.csv`.
fn fragilities<'py>(
    py: Python<'py>,
    study: &Ida,
    results: &[WallResults],
    fractions: &[f64],
) -> PyResult<Bound<'py, PyDict>> {
    let mut rows = Vec::new();
    for (w, wall) in study.walls().iter().enumerate() {
        for (m, model) in study.models().iter().enumerate() {
            let row = |(f, fraction): (usize, &f64)| {
                (wall.name.as_str(), model.name.as_str(), *fraction, &results[w].summaries(f)[m])
            };
            rows.extend(fractions.iter().enumerate().map(row));
        }
    }
    let summaries = || rows.iter().map(|row| row.3);
    let numbers = |value: fn(&Summary) -> f64| Numbers(summaries().map(value).collect());
    let counts = |value: fn(&Summary) -> usize| Counts(summaries().map(value).collect());
    let interval = |names: [&'static str; 3], of: fn(&Summary) -> &Interval, unit: f64| {
        let [estimates, lows, highs] = [0, 1, 2]
            .map(|part| Numbers(summaries().map(|summary| values(of(summary), unit)[part]).collect()));
        [(names[0], estimates), (names[1], lows), (names[2], highs)]
    };
    let g = STANDARD_GRAVITY;
    let first = [
        ("wall", Names(rows.iter().map(|row| row.0).collect())),
        ("model", Names(rows.iter().map(|row| row.1).collect())),
        ("u_max_over_u_ins", Numbers(rows.iter().map(|row| row.2).collect())),
        ("records", counts(|summary| summary.records)),
        ("censored", counts(|summary| summary.censored)),
    ];
    let betas = [
        ("beta", numbers(|summary| summary.fitted.map_or(f64::NAN, |fit| fit.dispersion))),
        ("beta_alone", numbers(|summary| summary.alone.map_or(f64::NAN, |fit| fit.dispersion))),
    ];
    let columns = first
        .into_iter()
        .chain(interval(["median_g", "median_low_g", "median_high_g"], |summary| &summary.median, g))
        .chain(interval(["theta_g", "theta_low_g", "theta_high_g"], |summary| &summary.theta, g))
        .chain(betas)
        .chain(interval(
            ["median_ratio", "median_ratio_low", "median_ratio_high"],
            |summary| &summary.median_ratio,
            1.0,
        ))
        .chain(interval(
            ["theta_ratio", "theta_ratio_low", "theta_ratio_high"],
            |summary| &summary.theta_ratio,
            1.0,
        ));
    table(py, columns)
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
