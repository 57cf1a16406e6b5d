//! The curves of a complete folder, read part by part.

use std::collections::VecDeque;

use crate::ida::Curve;
use crate::tables::{Names, collapses, levels};
use report::table::Table;

use super::contents::Contents;
use super::error::FolderError;
use super::store::Folder;

/// The curves of a folder in the order of their numbers.
pub(crate) struct Curves<'a> {
    folder: &'a Folder,
    /// The next part to read.
    part: usize,
    read: VecDeque<Curve>,
}

impl<'a> Curves<'a> {
    pub(crate) fn of(folder: &'a Folder) -> Self {
        Self { folder, part: 0, read: VecDeque::new() }
    }

    /// Returns the next `count` curves, and reads as many parts as this takes.
    pub(crate) fn next_curves(&mut self, count: usize) -> Result<Vec<Curve>, FolderError> {
        while self.read.len() < count {
            let curves = self.folder.part(self.part);
            // it was found complete when the report began, and has been removed or damaged since
            self.read.extend(curves.ok_or_else(|| self.folder.incomplete(&[self.part], &[]))?);
            self.part += 1;
        }
        Ok(self.read.drain(..count).collect())
    }
}

/// Returns the tables of all runs and of the collapses of a complete folder, of any size.
///
/// # Errors
/// [`FolderError`] if parts are missing.
pub fn curve_tables(folder: &Folder) -> Result<[Table; 2], FolderError> {
    let contents = folder.contents();
    let (names, mut curves) = (names(folder), Curves::of(folder));
    let mut all = [const { Table { columns: Vec::new(), rows: Vec::new() } }; 2];
    for wall in 0..contents.walls.len() {
        let own = curves.next_curves(contents.models.len() * contents.records.len())?;
        for (all, table) in all.iter_mut().zip([levels, collapses]) {
            let Table { columns, rows } = table(&names, wall, &own);
            all.columns = columns;
            all.rows.extend(rows);
        }
    }
    Ok(all)
}

/// Returns the names that the tables of a folder state.
pub(crate) fn names(folder: &Folder) -> Names<'_> {
    let Contents { walls, models, records, unit, .. } = folder.contents();
    Names {
        walls: walls.iter().map(|wall| &*wall.name).collect(),
        models: models.iter().map(|model| &*model.name).collect(),
        records: records.iter().map(|record| &*record.name).collect(),
        fractions: &folder.manifest().report.fractions,
        unit: *unit,
        has_yielding_ties: folder.contents().has_yielding_ties(),
    }
}
