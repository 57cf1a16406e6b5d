//! The check of many walls.

use std::path::{Path, PathBuf};

use report::page::Page;
use report::table::{Cell, Column, Digits, Table};
use rocking_wall::scene::{Place, SceneError};
use run::parallel;
use run::walls::{NamedWall, read_walls};
use serde_json::{Value, json};

use crate::code::{Code, Given, Subject, Verdict, in_table, read};
use crate::error::CheckError;

/// Walls of a file, and what the engineer states of all of them.
#[derive(Debug)]
pub struct Walls {
    /// The walls.
    pub walls: Vec<NamedWall>,
    /// Files that they were read from.
    pub inputs: Vec<PathBuf>,
    /// Warnings about tables of walls, and of a quick check of the records.
    pub warnings: Vec<String>,
    code: Box<dyn Code>,
}

/// The outcomes of walls, the worst first.
#[derive(Debug)]
pub struct WallVerdicts(pub Vec<WallVerdict>);

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
        self.verdict.as_ref().map_or(f64::NEG_INFINITY, |verdict| verdict.zeta)
    }

    fn passed(&self) -> bool {
        self.verdict.as_ref().is_ok_and(|verdict| verdict.passed)
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
        let folder = path.parent().unwrap_or(Path::new("."));
        let (mut inputs, mut warnings) = (Vec::new(), Vec::new());
        let walls = read_walls(text, path, &mut inputs, &mut warnings)?;
        let (place, given) = (Place::new(&name, text), Given { folder, records: Vec::new() });
        let Some(code) = read(&place, given).map_err(|error| in_table(error, &place))? else {
            let reason = "there is no table [check]; add one with code = \"circolare-2019\"".into();
            return Err(SceneError::File { file: name, reason });
        };
        inputs.extend_from_slice(code.files());
        warnings.extend_from_slice(code.warnings());
        Ok(Self { walls, inputs, warnings, code })
    }

    /// Checks every wall on some threads; returns the worst first, in the order of the file where they are
    /// alike.
    pub fn check(&self, threads: usize) -> WallVerdicts {
        let one = |index: usize| {
            let NamedWall { name, parameters, floors } = &self.walls[index];
            let verdict = self.code.check(&Subject {
                title: name,
                parameters,
                floors: floors.as_ref(),
                is_tried: false,
            });
            Ok::<_, std::convert::Infallible>(WallVerdict { name: name.clone(), verdict })
        };
        let Ok(mut verdicts) = parallel::map(self.walls.len(), threads, one);
        verdicts.sort_by(|a, b| a.zeta().total_cmp(&b.zeta()));
        WallVerdicts(verdicts)
    }
}

impl WallVerdicts {
    /// Returns how many walls could not be checked.
    pub fn refused(&self) -> usize {
        self.0.iter().filter(|wall| wall.verdict.is_err()).count()
    }

    /// Returns the warnings of each wall in a line with its name.
    pub fn warnings(&self) -> impl Iterator<Item = String> {
        self.0.iter().filter_map(|wall| {
            let own = &wall.verdict.as_ref().ok()?.warnings;
            (!own.is_empty()).then(|| format!("warning: wall {:?}: {}", wall.name, own.join("; ")))
        })
    }

    /// Returns a row for each wall, with the least `ζ_E` of each limit state of its code.
    pub fn table(&self) -> Table {
        let four = Digits::Decimals(4);
        let ratios = self.0.iter().find_map(|wall| Some(&wall.verdict.as_ref().ok()?.ratios));
        let names: Vec<&'static str> = ratios.into_iter().flatten().map(|(name, _)| *name).collect();
        let heading = |name: &'static str| name.trim_start_matches("zeta_E_").replace("_q", ", q");
        let mut columns = vec![
            Column::text("name", "wall"),
            Column::text("passed", "passed"),
            Column::number("zeta_E", "zeta_E", four),
            Column::text("governs", "governs"),
            Column::text("side", "side"),
        ];
        columns.extend(names.iter().map(|name| Column::number(*name, heading(name), four)));
        columns.push(Column::text("not_checked", if self.refused() > 0 { "not checked" } else { "" }));
        columns.push(Column::text("warnings", ""));
        let mut table = Table::new(columns);
        for WallVerdict { name, verdict } in &self.0 {
            let mut row: Vec<Cell<'static>> = vec![name.clone().into()];
            match verdict {
                Ok(verdict) => {
                    let side = verdict.side.trim_end_matches(" sides");
                    row.push(if verdict.passed { "yes" } else { "no" }.into());
                    row.extend([verdict.zeta.into(), verdict.governs.into(), side.into()]);
                    row.extend(verdict.ratios.iter().map(|(_, ratio)| Cell::from(*ratio)));
                    row.extend([Cell::Empty, verdict.warnings.join("; ").into()]);
                }
                Err(error) => {
                    row.resize(5 + names.len(), Cell::Empty);
                    row.extend([error.to_string().into(), Cell::Empty]);
                }
            }
            table.row(row);
        }
        table
    }

    /// Returns the names with their verdicts, or with the reasons why there is none.
    pub fn json(&self) -> Value {
        let row = |wall: &WallVerdict| match &wall.verdict {
            Ok(verdict) => json!({ "name": wall.name, "verdict": verdict.values }),
            Err(error) => json!({ "name": wall.name, "not_checked": error.to_string() }),
        };
        self.0.iter().map(row).collect()
    }

    /// Makes a page with a row for each wall.
    pub fn page(&self, file: &str) -> String {
        let passed = self.0.iter().filter(|wall| wall.passed()).count();
        let rows = self.table().html_with(|index| if self.0[index].passed() { "holds" } else { "fails" });
        Page::new(&format!("{file}: {passed} of {} walls pass", self.0.len()))
            .styled("tr.fails td:nth-child(2), tr.fails td:nth-child(3) { font-weight: 700; }")
            .text("<p>The wall with the smallest zeta_E of the limit states that decide comes first.</p>")
            .text(&rows)
            .html()
    }
}
