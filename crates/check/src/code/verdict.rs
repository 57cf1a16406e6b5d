//! What every code says of a wall: a verdict with rows, and what only that code knows.

use rocking_wall::wall::{Parameters, Wall};
use run::drawing::View;
use serde_json::{Value, json};

use super::before::{Before, least};
use super::row::Row;
use crate::error::CheckError;
use crate::sections::drawing;
use crate::sections::inputs::{of_wall, overview};
use crate::sections::origin::{Figure, Origin};
use crate::words::entry::Entry;
use crate::words::ledger::Ledger;
use crate::words::markup::side_head;
use crate::words::names::Sides;
use crate::words::{Language, Sentence, Written, above, fixed, governing, say};

/// The outcome of a check, as every code has it.
pub struct Verdict<'a> {
    /// The code.
    pub code: Entry,
    /// Whether the wall passes.
    pub passed: bool,
    /// The check that governs, such as `SLV`.
    pub governs: &'static str,
    /// The side that governs.
    pub side: Sides,
    /// Height of the level above which the wall turns, where levels are stated \[m\].
    pub level: Option<f64>,
    /// Capacity over demand of what governs \[-\].
    pub zeta: f64,
    /// The ratio from which on a check passes \[-\].
    pub target: f64,
    /// A row for each check of each side; of sides that are alike, one.
    pub rows: Vec<Row>,
    /// What a rule of the code replaces, where that lets the wall pass, or governs one that fails.
    pub raise: Option<Raise>,
    /// What is to be said of the rows, in sentences.
    pub notes: Vec<Sentence>,
    /// What the engineer should know, and
    /// [`Parameters::unusual`](rocking_wall::wall::Parameters::unusual); none of it stops the check.
    pub warnings: Vec<Sentence>,
    /// The state before an intervention, where the file names one.
    pub before: Option<Before>,
    /// What only this code knows.
    pub details: Box<dyn Details + Send + 'a>,
}

/// A ratio of capacity to demand that a rule of the code replaces by a larger one.
#[derive(Clone, Debug, PartialEq)]
pub struct Raise {
    /// The check whose ratio it is, such as `SLV`.
    pub check: &'static str,
    /// The ratio that is replaced \[-\].
    pub ratio: f64,
    /// What replaces it, such as `SLD`.
    pub by: Sentence,
}

/// What only one code knows of a verdict.
pub trait Details {
    /// The wall that was checked.
    fn wall(&self) -> &Wall;

    /// Its parameters.
    fn parameters(&self) -> &Parameters;

    /// All numbers by name, in SI units; what `wall check --json` prints.
    fn json(&self, verdict: &Verdict<'_>) -> Value;

    /// Draws the capacity of the side that governs over the demand.
    ///
    /// # Errors
    /// [`CheckError`] of a record, or of a spectrum that ends too early.
    fn figure(&self, language: Language) -> Result<Figure, CheckError>;

    /// The numbers of the sides that differ, with what is said of them, by side.
    fn ledgers(&self) -> Vec<(Sides, Ledger)>;

    /// The wall in a table of walls: headings, with units, and cells, as markup.
    fn overview(&self, language: Language) -> Vec<(String, String)> {
        overview(self.wall(), self.parameters(), language)
    }

    /// The sections of a report about the site, which the walls of a building share; by default none.
    ///
    /// # Errors
    /// Those of [`figure`](Self::figure).
    fn site(&self, _language: Language) -> Result<Vec<Section>, CheckError> {
        Ok(Vec::new())
    }

    /// The symbols of the sections, as markup; by default none.
    fn symbols(&self, _language: Language) -> String {
        String::new()
    }

    /// Where the code can be read in two ways: the readings taken; by default none.
    fn readings(&self) -> Vec<Sentence> {
        Vec::new()
    }

    /// The sections of a report about the wall: by default the wall, the figure and the numbers.
    ///
    /// # Errors
    /// Those of [`figure`](Self::figure).
    fn sections(&self, origin: &Origin<'_>) -> Result<Vec<Section>, CheckError> {
        let language = origin.report.language;
        let (wall, parameters) = (self.wall(), self.parameters());
        let drawn = drawing::figure(wall, parameters, View::Whole, None, language);
        let wall = drawn + &of_wall(wall, parameters, origin, &|_, _| true);
        let ledgers = self.ledgers();
        let head = |side| if ledgers.len() > 1 { side_head(side, None, language) } else { String::new() };
        let numbers = ledgers.iter().map(|(side, ledger)| head(*side) + &ledger.markup("", language));
        let over = self.figure(language)?.html(language) + &numbers.collect::<String>();
        Ok(vec![
            Section::new(say!("The wall", "La parete"), wall),
            Section::new(say!("Capacity over demand", "Rapporto capacità/domanda"), over),
        ])
    }
}

/// A section of a report.
pub struct Section {
    pub(crate) heading: Sentence,
    pub(crate) markup: String,
}

impl Section {
    /// Makes a section of its heading and its markup.
    pub fn new(heading: Sentence, markup: String) -> Self {
        Self { heading, markup }
    }
}

impl Verdict<'_> {
    /// The verdict in a line.
    pub fn headline(&self) -> Sentence {
        let raised = self.raise.as_ref().map(|Raise { check, ratio, by }| {
            let ratio = Written(format!("{ratio:.3}"));
            let said = say! {
                "{by}; {check} by displacement {ratio}",
                "{by}; {check} in spostamento {ratio}", by, check, ratio
            };
            if self.passed {
                say!(" by the raise of {said}", " assumendo a_g,{said}", said)
            } else {
                say!(", raised by {said}", ", innalzato dallo {said}", said)
            }
        });
        let raised = raised.unwrap_or_default();
        let title = self.rows.iter().find(|row| row.check == self.governs).map(|row| row.title.clone());
        let (governs, symbol) = (title.unwrap_or_else(|| Sentence::same(self.governs)), self.code.ratio());
        let zeta = Written(format!("{:.3}", self.zeta));
        let (of, target) = (above(governing(self.side), self.level), self.against());
        if self.passed {
            say! {
                "PASSED{target}{raised}: {governs} governs with {symbol} = {zeta} ({of})",
                "VERIFICA SODDISFATTA{target}{raised}: {governs} è determinante con {symbol} = {zeta} ({of})",
                target, raised, governs, symbol, zeta, of
            }
        } else {
            say! {
                "NOT PASSED{target}: {governs} governs with {symbol} = {zeta}{raised} ({of})",
                "VERIFICA NON SODDISFATTA{target}: {governs} è determinante con {symbol} = {zeta}{raised} \
                 ({of})",
                target, governs, symbol, zeta, raised, of
            }
        }
    }

    /// The target that the verdict is about, behind its first word; empty where that is 1.
    fn against(&self) -> Sentence {
        if self.target == 1.0 {
            return Sentence::default();
        }
        let symbol = self.code.ratio();
        say!(" for {symbol} ≥ {target}", " per {symbol} ≥ {target}", symbol, target = fixed(self.target, 2))
    }

    /// The state before an intervention that it is, under the title of its scene.
    pub(crate) fn as_before(&self, title: &str) -> Before {
        let Self { passed, zeta, ref rows, .. } = *self;
        Before { title: title.to_owned(), passed, zeta, headline: self.headline(), checks: least(rows) }
    }

    /// What every front says besides the rows, by name.
    pub fn summary(&self) -> Value {
        let mut summary = json!({
            "code": self.code.name,
            "passed": self.passed,
            "governs": self.governs,
            "side": self.side.name(),
            "zeta": self.zeta,
            "headline": self.headline(),
            "notes": self.notes,
            "warnings": self.warnings,
        });
        self.add_before(&mut summary);
        summary
    }

    /// All numbers by name.
    pub fn json(&self) -> Value {
        let mut all = self.details.json(self);
        self.add_before(&mut all);
        all
    }

    fn add_before(&self, json: &mut Value) {
        if let Some(before) = &self.before {
            json["before"] = before.json();
        }
    }
}
