//! What every building code has: it is read from the table `[check]`, and gives a verdict on a wall.
//!
//! ```
//! use check::code::{Given, Subject, read};
//! use rocking_wall::scene::Place;
//! use rocking_wall::wall::Parameters;
//!
//! let text = r#"
//! [check]
//! code = "circolare-2019"
//! before_activation = "rigid"
//! soil = "B"
//! SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
//! "#;
//! let code = read(&Place::new("scene.toml", text), Given::default())?.expect("there is a table [check]");
//! let parameters = Parameters::default();
//! let subject = Subject { title: "a wall", parameters: &parameters, floors: None, is_tried: false };
//! let verdict = code.check(&subject)?;
//! assert!(!verdict.passed && (verdict.zeta - 0.855812).abs() < 5e-7);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fmt::Debug;
use std::path::{Path, PathBuf};

use report::page::Page;
use report::plot::Plot;
use report::table::Table;
use report::{escaped, moving};
use rocking_wall::scene::{Floors, Place, Scene, SceneError, parse_toml};
use rocking_wall::wall::Parameters;
use run::records::NamedRecord;
use serde::Deserialize;
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::CheckError;
use crate::{circolare, fractions};

/// What an engineer states by a code, ready to check walls.
pub trait Code: Debug + Send + Sync {
    /// Checks a wall.
    ///
    /// # Errors [`CheckError`] of a statement that is missing or does not go with the wall, of a wall that
    /// the code does not cover, or of a run.
    fn check(&self, subject: &Subject<'_>) -> Result<Verdict, CheckError>;

    /// Draws the capacity of the side that governs over the demand.
    ///
    /// # Errors
    /// Those of [`check`](Self::check).
    fn plot(&self, subject: &Subject<'_>) -> Result<Plot, CheckError>;

    /// Makes the page of a wall for a calculation file: verdict, numbers, picture and warnings, or what the
    /// code asks for.
    ///
    /// # Errors
    /// Those of [`check`](Self::check), and of a file that cannot be read again.
    fn report(&self, subject: &Subject<'_>, document: &Document<'_>) -> Result<String, CheckError> {
        let verdict = self.check(subject)?;
        let list = |items: &[String]| {
            items.iter().fold(String::new(), |list, item| list + "<p>" + &escaped(item) + "</p>\n")
        };
        let date = document.date.map_or_else(String::new, |date| format!("<p>{}</p>", escaped(date)));
        let page = Page::new(subject.title)
            .text(&date)
            .text(&moving::verdict(&verdict.headline, !verdict.passed))
            .text(&format!("<figure>{}</figure>", self.plot(subject)?.svg()))
            .section("Numbers", &(verdict.numbers.html() + &list(&verdict.notes)));
        Ok(page.section("Warnings", &list(&verdict.warnings)).html())
    }

    /// Returns the files that were read besides the one with the table.
    fn files(&self) -> &[PathBuf] {
        &[]
    }

    /// Returns what was noticed about these files.
    fn warnings(&self) -> &[String] {
        &[]
    }

    /// Returns whether a check takes runs under records: a search then tries fewer values.
    fn takes_runs(&self) -> bool {
        false
    }
}

/// A wall that is checked.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Title, or the name of the wall.
    pub title: &'a str,
    /// Its parameters.
    pub parameters: &'a Parameters,
    /// The storeys between ground and wall.
    pub floors: Option<&'a Floors>,
    /// Whether only what decides counts: a search leaves out runs that only inform.
    pub is_tried: bool,
}

impl<'a> From<&'a Scene> for Subject<'a> {
    fn from(scene: &'a Scene) -> Self {
        let (title, parameters, floors) = (&scene.title, &scene.parameters, scene.floors.as_ref());
        Self { title, parameters, floors, is_tried: false }
    }
}

/// What a report says of its origin.
#[derive(Clone, Copy, Debug)]
pub struct Document<'a> {
    /// Name of the scene file, and its text.
    pub file: (&'a str, &'a str),
    /// What `--set` replaces.
    pub set: &'a [String],
    /// Date or place, as the user gives it.
    pub date: Option<&'a str>,
}

/// The outcome of a check, as every code has it.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Name of the code.
    pub code: &'static str,
    /// Whether the wall passes.
    pub passed: bool,
    /// The limit state that governs.
    pub governs: &'static str,
    /// The side that governs: `u > 0`, `u < 0` or `both sides`.
    pub side: &'static str,
    /// `ζ_E`, capacity over demand of what governs \[-\].
    pub zeta: f64,
    /// The verdict in a line.
    pub headline: String,
    /// What follows from it, in a sentence.
    pub detail: String,
    /// The least `ζ_E` of each limit state, by the name of its column in tables of walls \[-\].
    pub ratios: Vec<(&'static str, Option<f64>)>,
    /// A row for each limit state of each side.
    pub rows: Table,
    /// A row for each number of the check: its name, its unit, and a column for each side that differs.
    pub numbers: Table,
    /// What else decides, in lines.
    pub notes: Vec<String>,
    /// What the engineer should know; none of it stops the check.
    pub warnings: Vec<String>,
    /// All of it by names: SI units, `a_g` in g.
    pub values: Value,
}

/// What is given besides the table: where its files are, and records.
#[derive(Clone, Debug)]
pub struct Given<'a> {
    /// The folder beside which files are looked up.
    pub folder: &'a Path,
    /// Records by name, instead of those of the table.
    pub records: Vec<NamedRecord>,
}

impl Default for Given<'_> {
    fn default() -> Self {
        Self { folder: Path::new("."), records: Vec::new() }
    }
}

/// Reads the statements of a code from a table `[check]`.
type Read = fn(&Place<'_>, Given<'_>) -> Result<Box<dyn Code>, CheckError>;

/// The codes by their names, as `code` in `[check]` gives them. A new code is a line here.
pub const CODES: [(&str, Read); 2] = [(circolare::CODE, circolare::read), (fractions::CODE, fractions::read)];

/// Reads the table `[check]` of a scene's or a study's text; `None` without one.
///
/// # Errors
/// [`CheckError`]; [`in_table`] adds the line.
pub fn read(place: &Place<'_>, given: Given<'_>) -> Result<Option<Box<dyn Code>>, CheckError> {
    #[derive(Deserialize)]
    struct Named {
        code: Spanned<String>,
    }
    #[derive(Deserialize)]
    struct WithCheck {
        check: Option<Named>,
    }
    let WithCheck { check } = parse_toml(place)?;
    let Some(Named { code }) = check else { return Ok(None) };
    let Some((_, read)) = CODES.iter().find(|(name, _)| name == code.get_ref()) else {
        let known = CODES.map(|(name, _)| format!("{name:?}")).join(" or ");
        let message = format!("[check] code = {:?} is unknown; write {known}", code.get_ref());
        return Err(place.error(code.span(), message).into());
    };
    read(place, given).map(Some)
}

/// Adds file and line of a key of the table to an error that names one.
pub fn in_table(error: CheckError, place: &Place<'_>) -> SceneError {
    let message = error.to_string();
    match (error.keys(), error) {
        (_, CheckError::Scene(error)) => error,
        (Some(keys), _) => match line_of(place.text(), &keys) {
            Some(span) => place.error(span, format!("[check] {message}")),
            // the statements are not those of a file
            None => SceneError::Value { message },
        },
        (None, _) => SceneError::File { file: place.name().to_owned(), reason: message },
    }
}

/// The span of the last of the keys below `[check]` that is there.
fn line_of(text: &str, keys: &[&str]) -> Option<std::ops::Range<usize>> {
    let document = DeTable::parse(text).ok()?;
    let mut at = document.get_ref().get("check")?;
    for key in keys {
        let DeValue::Table(table) = at.get_ref() else { break };
        match table.get(*key) {
            Some(value) => at = value,
            None => break,
        }
    }
    Some(at.span())
}
