//! The check of many walls.

use std::path::{Path, PathBuf};

use rocking_wall::scene::{Place, SceneError};

use super::error::CheckError;
use super::{CheckTable, Records, Statement, Verdict, check, in_table, read_table};
use run::parallel;
use run::walls::NamedWall;
use run::walls::read_walls;

/// Walls of a file, and what the engineer states of all of them.
#[derive(Clone, Debug)]
pub struct Walls {
    /// The walls.
    pub walls: Vec<NamedWall>,
    /// Files that they were read from.
    pub inputs: Vec<PathBuf>,
    /// Warnings about tables of walls, and of a quick check of the records.
    pub warnings: Vec<String>,
    statement: Statement,
    records: Records,
}

/// The outcome of one wall.
#[derive(Debug)]
pub struct WallVerdict {
    /// Name of the wall.
    pub name: String,
    /// Its verdict, or why there is none.
    pub verdict: Result<Verdict, CheckError>,
}

impl WallVerdict {
    /// `ζ_E`; −∞ for a wall without a verdict, which comes first.
    pub fn zeta(&self) -> f64 {
        self.verdict.as_ref().map_or(f64::NEG_INFINITY, |verdict| verdict.governs.zeta)
    }
}

impl Walls {
    /// Reads the text of a study, or of a file with `[check]`, `[[walls]]` and storeys only. What it names is
    /// looked up beside the file at `path`.
    ///
    /// # Errors
    /// [`SceneError`] with file, line, value and remedy.
    pub fn parse(path: &Path, text: &str) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let place = Place::new(&name, text);
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut inputs, mut warnings) = (Vec::new(), Vec::new());
        let walls = read_walls(text, path, &mut inputs, &mut warnings)?;
        let Some(table) = read_table(&place)? else {
            let reason = "there is no table [check]; add one with code = \"circolare-2019\"".into();
            return Err(SceneError::File { file: name, reason });
        };
        let statement = CheckTable::statement(&table).map_err(|error| in_table(error, &place))?;
        let records = Records::read(&table, &place, folder)?;
        inputs.extend(records.files.clone());
        warnings.extend(records.warnings.clone());
        Ok(Self { walls, inputs, warnings, statement, records })
    }

    /// Checks every wall on some threads; returns the worst first, in the order of the file where they are
    /// alike.
    pub fn check(&self, threads: usize) -> Vec<WallVerdict> {
        let one = |index: usize| {
            let NamedWall { name, parameters, floors } = &self.walls[index];
            let verdict = check(parameters, floors.as_ref(), &self.statement, &self.records);
            Ok::<_, std::convert::Infallible>(WallVerdict { name: name.clone(), verdict })
        };
        let Ok(mut verdicts) = parallel::map(self.walls.len(), threads, one);
        verdicts.sort_by(|a, b| a.zeta().total_cmp(&b.zeta()));
        verdicts
    }
}
