//! All results of a complete folder: tables and page, made wall by wall.

use report::counted;
use run::file;

use crate::class::Class;
use crate::{FILES, Reliability, page, table};
use study::folder::{Folder, FolderError, MOST_WALLS, Report, Rows, each_wall};
use study::ida::Curve;

/// Most walls that a warning names.
const NAMED: usize = 3;

/// Writes the tables and the page of a study of reliability into a folder whose parts are complete. Counts
/// each wall as [done](run::parallel::count_done).
///
/// # Errors
/// [`FolderError`] if parts are missing, or a file cannot be written.
pub fn finish(folder: &Folder, reliability: &Reliability, threads: usize) -> Result<Report, FolderError> {
    let (manifest, contents) = (folder.manifest(), folder.contents());
    let models: Vec<_> = contents.models.iter().map(|model| model.name.as_str()).collect();
    let hazard = manifest.report.hazard.as_ref().map(|hazard| &hazard.curve);
    let paths = FILES.map(|name| folder.path().join(name));
    let (mut rows, mut rules) = (Rows::new(&paths[0])?, Rows::new(&paths[1])?);
    let (mut class, mut shown) = (Class::default(), Vec::new());
    let fitting = manifest.fitting();
    let found = |place, curves: &[Curve]| reliability.of_wall(place, curves, &fitting);
    each_wall(folder, threads, found, |place, found| {
        let wall = &reliability.walls[place];
        class.add(wall, &found);
        let Ok(found) = found else { return Ok(()) };
        let own = table::wall(&wall.name, &models, &found, hazard);
        rows.add(&own)?;
        rules.add(&table::rules(&wall.name, &models, &found, reliability.target))?;
        shown.extend((reliability.walls.len() <= MOST_WALLS).then_some(own));
        Ok(())
    })?;
    let summary = table::summary(&class, &models, reliability.target);
    file::to_file(&paths[2], summary.csv().as_bytes())?;
    let html = page::page(manifest, reliability, &class, &shown);
    file::to_file(&paths[3], html.as_bytes())?;
    rows.commit()?;
    rules.commit()?;
    Ok(Report {
        summary: table::words(&class, &models, reliability.target) + &summary.text(),
        warnings: warnings(&class),
        files: paths.into(),
    })
}

fn warnings(class: &Class) -> Vec<String> {
    let mut told = Vec::new();
    if let Some((name, [own, checked])) = class.hinges.first() {
        told.push(format!(
            "{}: the runs have the hinge elsewhere than the check, wall {name:?} at {own} h and {checked:.4} \
             h; state hinge_ratio in [geometry] for both",
            counted(class.hinges.len(), "wall")
        ));
    }
    if let Some(name) = class.other_bodies.first() {
        told.push(format!(
            "{}: the check has another body than the runs, wall {name:?}: the wedge with the crack of \
             crack_angles, or what stands above a level of hinge_levels; state that body in [geometry] for \
             both",
            counted(class.other_bodies.len(), "wall")
        ));
    }
    if !class.refused.is_empty() {
        let named = class.refused.iter().take(NAMED).map(|(name, reason)| format!("{name:?}: {reason}"));
        let named: Vec<_> = named.collect();
        let count = counted(class.refused.len(), "wall");
        told.push(format!("{count} not checked, {}", named.join("; ")));
    }
    told
}
