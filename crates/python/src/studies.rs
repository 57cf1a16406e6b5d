//! The class `Study`: an incremental dynamic analysis, whose parts `Folder` keeps.

use std::path::PathBuf;
use std::sync::OnceLock;

use files::FileError;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use reliability::Codes;
use run::records::Listed;
use scene::SceneError;
use study::folder::{Contents, encode};
use study::loaded::{LoadedStudy, Sent};

use crate::arrays::{Motion, named_records};
use crate::errors::{failed, of_scene, refused};
use crate::study_walls::named_walls;

/// A study ready to run.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Study {
    pub(crate) loaded: LoadedStudy,
    /// What its parts depend on, and the fingerprint of this.
    contents: OnceLock<(Contents, String)>,
}

/// A study as values that pickle can send: its text, its walls, and its records by their names, with their
/// factors and weights.
type Values =
    (String, Vec<(String, String, Vec<String>)>, Vec<(String, Motion)>, Vec<(f64, f64, Option<usize>)>);

#[pymethods]
impl Study {
    /// Reads a study file.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let loaded = py.detach(|| LoadedStudy::read(&path, &Codes)).map_err(of_scene)?;
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
        let records = named_records(records);
        let made = py.detach(|| LoadedStudy::of_parts(text, walls, records, &Codes));
        let mut loaded = made.map_err(|error| match error {
            SceneError::File(FileError { line: Some(_), key, reason, .. }) => {
                refused(of_argument(&key.unwrap_or_default(), &reason))
            }
            other => refused(other),
        })?;
        loaded.warnings.splice(..0, warnings);
        Ok(Self { loaded, contents: OnceLock::new() })
    }

    /// Makes a study of its values on another machine.
    #[staticmethod]
    fn received(py: Python<'_>, values: Values) -> PyResult<Self> {
        let (text, walls, records, listed) = values;
        let mut records = named_records(records);
        for (record, (factor, weight, stripe)) in records.iter_mut().zip(listed) {
            record.listed = Listed { factor, weight, stripe };
        }
        let sent = Sent { text, walls, records };
        let loaded = py.detach(|| LoadedStudy::received(sent, &Codes)).map_err(of_scene)?;
        Ok(Self { loaded, contents: OnceLock::new() })
    }

    /// Returns the values of the study, to send them.
    fn sent(&self) -> Values {
        let Sent { text, walls, records } = self.loaded.sent(&Codes);
        let listed = |Listed { factor, weight, stripe }| (factor, weight, stripe);
        let listed = records.iter().map(|record| listed(record.listed)).collect();
        let records = records.into_iter().map(|record| (record.name, Motion(record.motion)));
        (text, walls, records.collect(), listed)
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
            let groups = study.groups(contents.part(part), 1).map(|group| study.curves(group));
            let curves = groups.collect::<Result<Vec<_>, _>>().map_err(failed)?.concat();
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
}

impl Study {
    fn contents(&self) -> &(Contents, String) {
        self.contents.get_or_init(|| {
            let contents = Contents::of(&self.loaded.study);
            let fingerprint = contents.fingerprint();
            (contents, fingerprint)
        })
    }
}

/// Names the argument in a message. The user has not written the text, which has a line for each argument.
fn of_argument(argument: &str, message: &str) -> String {
    if message.starts_with(argument) { message.to_owned() } else { format!("{argument}: {message}") }
}
