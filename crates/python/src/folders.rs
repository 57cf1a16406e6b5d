//! The class `Folder`: a study in a folder, whose parts other processes compute.

use std::path::PathBuf;

use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use study::folder::FolderError;

use crate::errors::{failed, refused};
use crate::studies::Study;
use crate::watch::threads_of;

/// The folder of a study.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Folder {
    folder: study::folder::Folder,
}

#[pymethods]
impl Folder {
    /// Opens or makes the folder of a study.
    #[new]
    fn new(py: Python<'_>, path: PathBuf, study: &Study) -> PyResult<Self> {
        let opened = py.detach(|| study::folder::Folder::of_study(&path, &study.loaded));
        Ok(Self { folder: opened.map_err(of_folder)? })
    }

    /// Lists the parts that are missing or damaged, and the damaged ones among them.
    fn missing(&self, py: Python<'_>) -> (Vec<usize>, Option<String>) {
        py.detach(|| {
            let missing = self.folder.missing(0..self.folder.contents().parts());
            let damage = self.folder.damage(&missing);
            (missing, damage)
        })
    }

    /// Writes a part.
    fn keep(&self, py: Python<'_>, part: usize, bytes: &[u8]) -> PyResult<()> {
        py.detach(|| self.folder.keep_encoded(part, bytes)).map_err(of_folder)
    }

    /// Writes the results of a complete folder; returns the summary and what the fits warn of.
    fn finish(
        &self,
        py: Python<'_>,
        threads: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(String, Option<String>)> {
        let threads = threads_of(threads)?.get();
        let report = py.detach(|| study::folder::finish(&self.folder, threads, || ())).map_err(of_folder)?;
        Ok((report.summary, report.warning))
    }
}

/// Makes the exception of a folder.
fn of_folder(error: FolderError) -> PyErr {
    match error {
        FolderError::File(_) => PyOSError::new_err(error.to_string()),
        FolderError::Parquet { .. } | FolderError::Part { .. } => failed(error),
        _ => refused(error),
    }
}
