//! Computes the parts that are not on disk yet.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Mutex;

use crate::ida::{Case, Curve, IdaError, Study};
use run::parallel;

use super::error::FolderError;
use super::store::Folder;

/// Why a part could not be computed or written.
#[derive(Debug, thiserror::Error)]
pub enum ComputeError {
    /// A run failed.
    #[error(transparent)]
    Run(#[from] IdaError),
    /// A part could not be written.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The caller has asked to stop; the parts that are complete stay.
    #[error("stopped; the parts that are complete stay")]
    Stopped,
}

/// Computes some parts of a study, in rising order, and writes each once it is complete. Threads share the
/// combinations of a part. `done` is called with each combination and its curve, on the thread that has
/// computed it, and says whether to go on.
///
/// # Errors
/// [`ComputeError`] of the first combination that fails, or where `done` stops the work.
pub fn compute(
    study: &Study,
    folder: &Folder,
    parts: &[usize],
    threads: usize,
    done: impl Fn(Case, &Curve) -> ControlFlow<()> + Sync,
) -> Result<(), ComputeError> {
    let size = study.part_size();
    // only the last part may have fewer combinations, and it comes last
    let short = parts.last().map_or(0, |&last| size - study.part(last).len());
    let open: Mutex<BTreeMap<usize, Vec<(usize, Curve)>>> = Mutex::default();
    parallel::each(parts.len() * size - short, threads, |place| {
        let part = parts[place / size];
        let range = study.part(part);
        let index = range.start + place % size;
        let curve = study.curve(study.case(index))?;
        if done(study.case(index), &curve).is_break() {
            return Err(ComputeError::Stopped);
        }
        let mut open = open.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let curves = open.entry(part).or_default();
        curves.push((index, curve));
        if curves.len() < range.len() {
            return Ok(());
        }
        let mut curves = open.remove(&part).unwrap_or_default();
        drop(open);
        curves.sort_by_key(|(index, _)| *index);
        let curves: Vec<_> = curves.into_iter().map(|(_, curve)| curve).collect();
        Ok(folder.keep(part, &curves)?)
    })
}
