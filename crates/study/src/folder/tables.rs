//! The tables of a study as CSV.

use std::io::{self, Write};

use crate::results::WallResults;
use crate::tables::{COLLAPSES, FRAGILITIES, LEVELS, Names, Table};

use super::contents::{Contents, Manifest};
use report::table::line;

/// Most combinations of a study whose runs and collapses are written as CSV too. Those of larger studies are
/// in the parts only.
const MOST_CASES: usize = 10_000;

/// Returns the tables of a study.
pub(crate) fn tables(contents: &Contents) -> Vec<Table> {
    if contents.count() <= MOST_CASES { vec![LEVELS, COLLAPSES, FRAGILITIES] } else { vec![FRAGILITIES] }
}

/// Returns the names that the tables show.
pub(crate) fn names(manifest: &Manifest) -> Names<'_> {
    let Contents { walls, models, records, .. } = &manifest.contents;
    Names {
        walls: walls.iter().map(|wall| &*wall.name).collect(),
        models: models.iter().map(|model| &*model.name).collect(),
        records: records.iter().map(|record| &*record.name).collect(),
        fractions: &manifest.report.fractions,
    }
}

/// Writes the rows of a wall.
pub(crate) fn write(
    out: &mut impl Write,
    table: &Table,
    names: &Names<'_>,
    wall: usize,
    results: &WallResults,
) -> io::Result<()> {
    let mut written = Ok(());
    (table.rows)(names, wall, results, &mut |cells| {
        written = std::mem::replace(&mut written, Ok(())).and_then(|()| writeln!(out, "{}", line(cells)));
    });
    written
}
