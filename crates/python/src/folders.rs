//! The class `Folder`: a study in a folder, whose parts this process or others compute.

use std::path::PathBuf;

use pyo3::exceptions::{PyFileNotFoundError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use reliability::Reliability;
use study::folder::{FolderError, compute, curve_tables, merge};

use crate::errors::{failed, of_scene, refused};
use crate::studies::Study;
use crate::tables::table;
use crate::watch::{stoppable, threads_of, watched};

/// The folder of a study.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Folder {
    folder: study::folder::Folder,
}

/// A summary, and what is to be warned of.
type Told = (String, Vec<String>);

#[pymethods]
impl Folder {
    /// Opens or makes the folder of a study.
    #[new]
    fn new(py: Python<'_>, path: PathBuf, study: &Study) -> PyResult<Self> {
        let opened = py.detach(|| study::folder::Folder::of_study(&path, &study.loaded));
        Ok(Self { folder: opened.map_err(of_folder)? })
    }

    /// Opens a folder that holds a study.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let folder = py.detach(|| study::folder::Folder::open(&path)).map_err(of_folder)?;
        Ok(Self { folder })
    }

    /// Takes together the parts of several folders; returns the folder of all.
    #[staticmethod]
    fn merged(py: Python<'_>, paths: Vec<PathBuf>, into: Option<PathBuf>) -> PyResult<Self> {
        let merged = py.detach(|| {
            let folders = paths.iter().map(|path| study::folder::Folder::open(path));
            merge(folders.collect::<Result<_, _>>()?, into.as_deref())
        });
        Ok(Self { folder: merged.map_err(of_folder)? })
    }

    #[getter]
    fn path(&self) -> PathBuf {
        self.folder.path().to_owned()
    }

    /// Lists the parts of a share that are missing or damaged, and says which of them are damaged.
    fn missing(&self, py: Python<'_>, number: usize, of: usize) -> (Vec<usize>, Vec<String>) {
        py.detach(|| {
            let missing = self.folder.missing(self.folder.contents().shard(number, of));
            let damage: Vec<_> = self.folder.damage(&missing).into_iter().collect();
            (missing, damage)
        })
    }

    /// Counts the combinations of some parts.
    fn count(&self, parts: Vec<usize>) -> usize {
        parts.into_iter().map(|part| self.folder.contents().part(part).len()).sum()
    }

    /// Computes parts of the folder's study. `progress` is called with the number of combinations done.
    fn compute(
        &self,
        py: Python<'_>,
        study: &Study,
        parts: Vec<usize>,
        threads: Option<i64>,
        progress: Py<PyAny>,
    ) -> PyResult<()> {
        let threads = threads_of(threads)?.get();
        let work = || compute(&study.loaded.study, &self.folder, &parts, threads);
        let report = |py: Python<'_>, done: usize| progress.call1(py, (done,)).map(drop);
        watched(py, work, report)?.map(drop).map_err(of_folder)
    }

    /// Writes a part.
    fn keep(&self, py: Python<'_>, part: usize, bytes: &[u8]) -> PyResult<()> {
        py.detach(|| self.folder.keep_encoded(part, bytes)).map_err(of_folder)
    }

    /// Writes the results of a complete folder; returns the summary and warnings.
    fn finish(&self, py: Python<'_>, threads: Option<i64>) -> PyResult<Told> {
        let threads = threads_of(threads)?.get();
        let report = stoppable(py, || study::folder::finish(&self.folder, threads))?.map_err(of_folder)?;
        Ok((report.summary, report.warnings))
    }

    /// Writes how safe the walls of a complete folder are where they just pass their check; returns as
    /// `finish`.
    fn reliability(&self, py: Python<'_>, study: &Study, threads: Option<i64>) -> PyResult<Told> {
        let question = Reliability::of(&study.loaded).map_err(of_scene)?;
        let threads = threads_of(threads)?.get();
        let found = stoppable(py, || reliability::finish(&self.folder, &question, threads))?;
        let report = found.map_err(of_folder)?;
        Ok((report.summary, report.warnings))
    }

    /// Returns the tables of all runs and collapses.
    fn curves<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyDict>; 2]> {
        let [levels, collapses] = py.detach(|| curve_tables(&self.folder)).map_err(of_folder)?;
        Ok([table(py, levels)?, table(py, collapses)?])
    }
}

/// Makes the exception of a folder.
fn of_folder(error: FolderError) -> PyErr {
    match error {
        FolderError::NoStudy { ref source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(error.to_string())
        }
        FolderError::File(_) | FolderError::NoStudy { .. } => PyOSError::new_err(error.to_string()),
        FolderError::Parquet { .. } | FolderError::Part { .. } | FolderError::Run(_) => failed(error),
        _ => refused(error),
    }
}
