#![doc = include_str!("../README.md")]
//!
//! # What is asked
//! The runs are those of an incremental dynamic analysis. Its intensity is the ground acceleration `a_g` of
//! the site's spectrum that a record is worth, so that a fragility can be read where the check has ζ = 1:
//!
//! ```text
//! a_g,code = ζ a_g                   the ground acceleration with which the wall just passes the check
//! P(event | a_g,code) = Φ(ln(a_g,code/θ)/β)        margin = θ/a_g,code
//! ```
//!
//! An event is that |u| exceeds the displacement capacity of a check, or that the wall falls.
//!
//! # Modules
//! Each module uses only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | `codes` | what a study asks of the codes of `rocking-check` |
//! | `rules` | the numbers of the code that would give a stated probability |
//! | `wall` | one wall: its checks, its events, their probabilities |
//! | `class` | all walls together |
//! | `table` | the tables |
//! | `page` | the page |
//! | `finish` | all results of a complete folder |

mod class;
mod codes;
mod finish;
mod page;
mod rules;
mod table;
mod wall;

use check::{CheckFile, WallCodes};
use run::walls::NamedWall;
use scene::SceneError;

use study::ida::{Curve, IntensityMeasure, Levels};
use study::loaded::LoadedStudy;
use study::results::Fitting;

pub use codes::Codes;
pub use finish::finish;
pub use rules::Turned;
pub use wall::{Answer, Checkpoint, Event, WallReliability};

/// Files of the results, beside those of the analysis.
pub const FILES: [&str; 4] =
    ["reliability.csv", "reliability_rules.csv", "reliability_summary.csv", "reliability.html"];

/// The question: the walls of a study, and the codes that check them.
pub struct Reliability {
    title: String,
    codes: WallCodes,
    walls: Vec<NamedWall>,
    target: f64,
}

impl Reliability {
    /// Reads the table `[check]` of a study, and sees that runs and checks concern the same buildings.
    ///
    /// # Errors
    /// [`SceneError`] of the table; of a measure that is not that of the code; of a check that takes runs; of
    /// a building that only one of both sides has; of a tie that only the check has; where no wall can be
    /// checked.
    pub fn of(loaded: &LoadedStudy) -> Result<Self, SceneError> {
        let name =
            loaded.inputs.first().map_or_else(|| "the study".into(), |path| path.display().to_string());
        let refused = |reason: String| Err(SceneError::Value { message: format!("{name}: {reason}") });
        let walls = loaded.study.walls().to_vec();
        // records have no part: those of a check that they decide are refused below
        let codes = WallCodes::read(&CheckFile::parse(&name, &loaded.text)?.without_records(), &walls)?;
        if !matches!(loaded.study.measure(), IntensityMeasure::Code { .. }) {
            return refused(
                "a study of reliability needs a_g of the site as intensity; set intensity = { measure = \
                 \"code\" }"
                    .into(),
            );
        }
        if matches!(loaded.study.levels(), Levels::Cloud { .. } | Levels::Stripes(_)) {
            return refused(
                "method of [levels]: a study of reliability needs several levels of each record, and clouds \
                 and stripes run each record once; give levels of another method, such as levels = { \
                 method = \"hunt\", first = 0.05, increase = 0.05, top = 5 }, in g"
                    .into(),
            );
        }
        for wall in &walls {
            let code = codes.of(wall);
            if code.takes_runs() {
                return refused(
                    "[check] takes runs; a study of reliability reads the static check: leave out method = \
                     \"dynamic\", and give F0 and TC"
                        .into(),
                );
            }
            if code.states_building() && wall.floors.is_none() {
                return refused(format!(
                    "wall {:?}: the building of [check] is not in the runs; give [[storeys]] in place of \
                     [check.building]",
                    wall.name
                ));
            }
            let prepared = code.prepared(&wall.parameters);
            if prepared.is_ok_and(|prepared| prepared != wall.parameters) {
                return refused(format!(
                    "wall {:?}: the bar of [check.tie] is not in the runs; give it in [tie] of the wall",
                    wall.name
                ));
            }
        }
        let reason = |wall| codes.of(wall).check(wall::subject(wall)).err();
        let reasons = walls.iter().map_while(reason).map(|error| error.to_string());
        let reasons: Vec<_> = reasons.collect();
        if reasons.len() == walls.len() {
            return refused(format!("no wall can be checked; wall {:?}: {}", walls[0].name, reasons[0]));
        }
        let title = loaded.title.clone();
        Ok(Self { title, codes, walls, target: loaded.target })
    }

    /// Asks how safe a wall is, given by its place, from its curves.
    ///
    /// # Errors
    /// The reason why there is no check.
    fn of_wall(&self, place: usize, curves: &[Curve], fitting: &Fitting) -> Result<WallReliability, String> {
        let wall = &self.walls[place];
        WallReliability::of(wall, self.codes.of(wall), curves, fitting, self.target)
    }
}
