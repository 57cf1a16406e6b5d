//! The tables of a study as CSV.

use std::io::{self, Write};

use study::fragility::between;
use study::results::WallResults;
use study::tables::{COLLAPSES, Cell, FRAGILITIES, LEVELS, Names, Table};

use crate::contents::{Contents, Manifest};
use crate::csv::quoted;

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
        let texts: Vec<_> = cells.iter().map(text).collect();
        written = std::mem::replace(&mut written, Ok(())).and_then(|()| writeln!(out, "{}", texts.join(",")));
    });
    written
}

/// Returns the text of a cell; nothing for what is not known.
fn text(cell: &Cell<'_>) -> String {
    match *cell {
        Cell::Name(name) => quoted(name),
        Cell::Number(number) => number.map_or_else(String::new, |number| number.to_string()),
        Cell::Between(bounds) => between(bounds, None).replace('–', ""),
        Cell::Count(count) => count.to_string(),
        Cell::Flag(flag) => u8::from(flag).to_string(),
    }
}
