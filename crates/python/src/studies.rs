//! The class `Study`: an incremental dynamic analysis, in memory or in parts.

use std::convert::Infallible;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use numpy::PyArray1;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use report::table::Table;
use rocking_wall::scene::SceneError;
use run::parallel;
use run::records::NamedRecord;
use study::document::ReportOptions;
use study::folder::{Contents, encode};
use study::ida::{Curve, IdaError};
use study::loaded::{LoadedStudy, Sent};
use study::reliability::Reliability;
use study::results::Fitting;
use study::tables::{KINDS, Kind, Names};

use crate::arrays::Motion;
use crate::errors::{failed, of_scene, refused};
use crate::study_walls::named_walls;
use crate::tables::table;
use crate::watch::{threads_of, watched};

/// Three tables of how safe walls are, and the walls without a check with the reasons.
type Safe<'py> = ([Bound<'py, PyDict>; 3], Vec<(String, String)>);

/// A study ready to run.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Study {
    pub(crate) loaded: LoadedStudy,
    /// What its parts depend on, and the fingerprint of this.
    contents: OnceLock<(Contents, String)>,
}

/// A study as values that pickle can send: its text, its walls, and its records with steps and samples.
type Values<Samples> = (String, Vec<(String, String)>, Vec<(String, f64, Samples)>);

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
        records: Vec<(String, Motion)>,
    ) -> PyResult<Self> {
        let mut warnings = Vec::new();
        let walls = named_walls(&walls, &mut warnings)?;
        let record = |(name, Motion(motion)): (String, Motion)| NamedRecord { name, motion };
        let records = records.into_iter().map(record).collect();
        let made = py.detach(|| LoadedStudy::of_parts(text, walls, records));
        let mut loaded = made.map_err(|error| match error {
            SceneError::Line { key, message, .. } => refused(of_argument(&key.unwrap_or_default(), &message)),
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
        threads: Option<&Bound<'py, PyAny>>,
        progress: &Bound<'py, PyAny>,
    ) -> PyResult<[Bound<'py, PyDict>; 3]> {
        let LoadedStudy { study, report, .. } = &self.loaded;
        let threads = threads_of(threads)?.get();
        let curves = self.curves(py, threads, progress)?;
        let results = py.detach(|| {
            let grid = study.levels().shared();
            // classes and a hazard would keep the resamples of all walls in memory
            let report = ReportOptions { classes: Vec::new(), hazard: None, ..report.clone() };
            let fitting = Fitting::new(study.records().len(), &self.models(), grid, &report);
            let of_wall: Vec<_> = curves.chunks(study.count() / study.walls().len()).collect();
            let fitted = parallel::map(of_wall.len(), threads, |wall| {
                Ok::<_, Infallible>(fitting.results(of_wall[wall].to_vec()))
            });
            let Ok(results) = fitted;
            results
        });
        let names = Names {
            walls: self.walls(),
            models: self.models(),
            records: self.records(),
            fractions: &report.fractions,
            has_yielding_ties: (0..study.walls().len()).any(|wall| study.has_yielding_tie(wall)),
        };
        let of = |(_, of_wall): Kind| {
            let mut all = Table::default();
            for (wall, results) in results.iter().enumerate() {
                let Table { columns, rows } = of_wall(&names, wall, results);
                all.columns = columns;
                all.rows.extend(rows);
            }
            table(py, all)
        };
        let [levels, collapses, fragilities] = KINDS.map(of);
        Ok([levels?, collapses?, fragilities?])
    }

    /// Runs the study and returns how safe its walls are where they just pass their check: its tables, and
    /// the walls without a check with the reasons. `progress` is called with the number of combinations done.
    fn reliability<'py>(
        &self,
        py: Python<'py>,
        threads: Option<&Bound<'py, PyAny>>,
        progress: &Bound<'py, PyAny>,
    ) -> PyResult<Safe<'py>> {
        let LoadedStudy { study, report, .. } = &self.loaded;
        let question = Reliability::of(&self.loaded).map_err(of_scene)?;
        let threads = threads_of(threads)?.get();
        let curves = self.curves(py, threads, progress)?;
        let found = || study::reliability::tables(&question, (study, report), &curves, threads);
        let ([rows, rules, summary], refused) = py.detach(found);
        Ok(([table(py, rows)?, table(py, rules)?, table(py, summary)?], refused))
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
                    return Err(None);
                }
                let curve = study.curve(study.case(index)).map_err(Some)?;
                done.fetch_add(1, Ordering::Relaxed);
                Ok(curve)
            })
        };
        let report = || progress.call1((done.load(Ordering::Relaxed),)).map(drop);
        // without an error the work was asked to stop
        watched(py, work, report)?
            .map_err(|error: Option<IdaError>| error.map_or_else(|| PyKeyboardInterrupt::new_err(()), failed))
    }
}

/// Names the argument in a message. The user has not written the text, which has a line for each argument.
fn of_argument(argument: &str, message: &str) -> String {
    if message.starts_with(argument) { message.to_owned() } else { format!("{argument}: {message}") }
}
