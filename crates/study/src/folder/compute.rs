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
    // parts that are fewer than threads are split among these
    let of_part = threads.div_ceil(parts.len().max(1));
    let groups: Vec<_> = parts
        .iter()
        .flat_map(|&part| study.groups(folder.contents().part(part), of_part).map(move |group| (part, group)))
        .collect();
    let open: Mutex<BTreeMap<usize, Vec<(usize, Curve)>>> = Mutex::default();
    parallel::each(groups.len(), threads, |place| {
        let (part, group) = groups[place].clone();
        let computed: Vec<_> = group.clone().zip(study.curves(group)?).collect();
        if computed.iter().any(|(index, curve)| done(study.case(*index), curve).is_break()) {
            return Err(ComputeError::Stopped);
        }
        let mut open = open.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let curves = open.entry(part).or_default();
        curves.extend(computed);
        if curves.len() < folder.contents().part(part).len() {
            return Ok(());
        }
        let mut curves = open.remove(&part).unwrap_or_default();
        drop(open);
        curves.sort_by_key(|(index, _)| *index);
        let curves: Vec<_> = curves.into_iter().map(|(_, curve)| curve).collect();
        Ok(folder.keep(part, &curves)?)
    })
}
