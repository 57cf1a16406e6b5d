//! Computes the parts that are not on disk yet.

use std::collections::BTreeMap;
use std::sync::Mutex;

use crate::ida::{Curve, Study};
use run::parallel;

use super::error::FolderError;
use super::store::Folder;

/// Computes some parts of a study, in rising order, and writes each once it is complete; returns the number
/// of runs. Threads share the combinations of a part. Counts each combination as
/// [done](parallel::count_done); work that is stopped leaves the parts that are complete.
///
/// # Errors
/// [`FolderError`] of the first combination that fails, or of a part that cannot be written.
pub fn compute(
    study: &Study,
    folder: &Folder,
    parts: &[usize],
    threads: usize,
) -> Result<usize, FolderError> {
    let count = |part: usize| folder.contents().part(part).len();
    let all = parts.iter().map(|&part| count(part)).sum();
    // parts that are fewer than threads are split among these
    let of_part = threads.div_ceil(parts.len().max(1));
    let groups: Vec<_> = parts
        .iter()
        .flat_map(|&part| study.groups(folder.contents().part(part), of_part).map(move |group| (part, group)))
        .collect();
    let open: Mutex<BTreeMap<usize, Vec<(usize, Curve)>>> = Mutex::default();
    let runs = parallel::map(groups.len(), threads, |place| {
        let (part, group) = groups[place].clone();
        let computed: Vec<_> = group.clone().zip(study.curves(group)?).collect();
        let mut runs = 0;
        for (_, curve) in &computed {
            runs += curve.runs().len();
            parallel::count_done(all);
        }
        let mut open = open.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let curves = open.entry(part).or_default();
        curves.extend(computed);
        if curves.len() < count(part) {
            return Ok(runs);
        }
        let mut curves = open.remove(&part).unwrap_or_default();
        drop(open);
        curves.sort_by_key(|(index, _)| *index);
        let curves: Vec<_> = curves.into_iter().map(|(_, curve)| curve).collect();
        folder.keep(part, &curves)?;
        Ok::<_, FolderError>(runs)
    })?;
    Ok(runs.into_iter().sum())
}
