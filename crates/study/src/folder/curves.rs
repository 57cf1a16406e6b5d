//! The curves of a complete folder, read part by part.

use std::collections::VecDeque;
use std::convert::Infallible;

use crate::ida::Curve;
use report::table::Table;
use run::parallel;

use super::contents::Contents;
use super::error::FolderError;
use super::store::Folder;
use super::tables::{collapses, levels};

/// Walls of which each thread makes something before it is taken.
const WALLS_AT_ONCE: usize = 4;

/// The curves of a folder in the order of their numbers.
struct Curves<'a> {
    folder: &'a Folder,
    /// The next part to read.
    part: usize,
    read: VecDeque<Curve>,
}

impl<'a> Curves<'a> {
    fn of(folder: &'a Folder) -> Self {
        Self { folder, part: 0, read: VecDeque::new() }
    }

    /// Returns the curves of the next wall, and reads as many parts as this takes.
    fn next_wall(&mut self) -> Result<Vec<Curve>, FolderError> {
        let Contents { models, records, .. } = self.folder.contents();
        let count = models.len() * records.len();
        while self.read.len() < count {
            let curves = self.folder.part(self.part);
            // it was found complete when the report began, and has been removed or damaged since
            self.read.extend(curves.ok_or_else(|| self.folder.incomplete(&[self.part], &[]))?);
            self.part += 1;
        }
        Ok(self.read.drain(..count).collect())
    }
}

/// Makes something of the curves of each wall of a complete folder, on some threads, and takes it wall by
/// wall: memory does not grow with the walls. Counts each wall as [done](parallel::count_done).
///
/// # Errors
/// [`FolderError`] if parts are missing, or that of `take`.
pub fn each_wall<T: Send>(
    folder: &Folder,
    threads: usize,
    make: impl Fn(usize, &[Curve]) -> T + Sync,
    mut take: impl FnMut(usize, T) -> Result<(), FolderError>,
) -> Result<(), FolderError> {
    let (mut curves, walls) = (Curves::of(folder), folder.contents().walls.len());
    for start in (0..walls).step_by(threads * WALLS_AT_ONCE) {
        let end = (start + threads * WALLS_AT_ONCE).min(walls);
        let read = (start..end).map(|_| curves.next_wall()).collect::<Result<Vec<_>, _>>()?;
        let made = |place: usize| Ok::<_, Infallible>(make(start + place, &read[place]));
        let Ok(made) = parallel::map(read.len(), threads, made);
        for (wall, made) in (start..end).zip(made) {
            take(wall, made)?;
            parallel::count_done(walls);
        }
    }
    Ok(())
}

/// Returns the tables of all runs and of the collapses of a complete folder, of any size.
///
/// # Errors
/// [`FolderError`] if parts are missing.
pub fn curve_tables(folder: &Folder) -> Result<[Table; 2], FolderError> {
    let contents = folder.contents();
    let (mut curves, mut all) = (Curves::of(folder), <[Table; 2]>::default());
    for wall in 0..contents.walls.len() {
        let own = curves.next_wall()?;
        for (all, table) in all.iter_mut().zip([levels, collapses]) {
            let Table { columns, rows } = table(folder.manifest(), wall, &own);
            all.columns = columns;
            all.rows.extend(rows);
        }
    }
    Ok(all)
}
