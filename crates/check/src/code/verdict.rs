//! What every code says of a wall: a verdict with rows, and what only that code knows.

use std::fmt::Write;

use report::number;
use report::table::{Cell, Column, Digits, Table};
use rocking_wall::wall::{Parameters, Wall};
use serde_json::{Value, json};

use crate::error::CheckError;
use crate::sections::inputs::{overview, the_wall};
use crate::sections::origin::{Figure, Origin};
use crate::words::entry::Entry;
use crate::words::formulas::markup;
use crate::words::ledger::{Ledger, numbers};
use crate::words::markup::side_head;
use crate::words::names::Sides;
use crate::words::{Language, Sentence, Written, fixed, governing, passed, said, say, side};

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

/// A check of one side.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name of the check, such as `SLV`.
    pub check: &'static str,
    /// The same for people.
    pub title: Sentence,
    /// The side.
    pub side: Sides,
    /// Capacity over demand \[-\].
    pub zeta: f64,
    /// The same before a rule of the code replaces it by a larger one \[-\].
    pub ratio: f64,
    /// Whether it passes.
    pub passed: bool,
    /// Whether it decides; otherwise it informs.
    pub decides: bool,
    /// Ground acceleration that just passes, and that of the site, if the code has one \[g\].
    pub ground: Option<[f64; 2]>,
    /// Capacity and demand.
    pub ends: Ends,
    /// The capacity as u of the wall; `None` of a check of accelerations, and of runs \[m\].
    pub displacement: Option<f64>,
    /// Where the code has it.
    pub clause: &'static str,
    /// What is to be said beside the numbers; empty where nothing is.
    pub remark: Sentence,
}

impl Row {
    /// Makes a row of a check that informs, and passes from capacity over demand 1 on; the rest is empty.
    pub(crate) fn new(check: &'static str, title: Sentence, side: Sides, zeta: f64, ends: Ends) -> Self {
        let (passed, decides, ground, displacement) = (zeta >= 1.0, false, None, None);
        Self {
            check,
            title,
            side,
            zeta,
            ratio: zeta,
            passed,
            decides,
            ground,
            ends,
            displacement,
            clause: "",
            remark: Sentence::default(),
        }
    }
}

/// A capacity and its demand.
#[derive(Clone, Copy, Debug)]
pub enum Ends {
    /// Accelerations \[m/s²\].
    Accelerations([f64; 2]),
    /// Displacements \[m\].
    Displacements([f64; 2]),
}

impl Ends {
    /// Both in SI units.
    fn values(self) -> [f64; 2] {
        let (Self::Accelerations(ends) | Self::Displacements(ends)) = self;
        ends
    }

    /// The SI unit.
    fn unit(self) -> &'static str {
        if matches!(self, Self::Displacements(_)) { "m" } else { "m/s2" }
    }

    /// One of both for people.
    fn shown(self, end: f64) -> String {
        let (factor, unit) =
            if matches!(self, Self::Displacements(_)) { (1e3, "mm") } else { (1.0, "m/s²") };
        format!("{} {unit}", number(factor * end, 4))
    }
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
        let wall = the_wall(self.wall(), self.parameters(), origin, &|_, _| true);
        let ledgers = self.ledgers();
        let head = |side| if ledgers.len() > 1 { side_head(side, language) } else { String::new() };
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
        let (of, target) = (governing(self.side), self.against());
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

    /// The rows as a table: for people four digits, for files SI units and every digit.
    pub fn table(&self) -> Table {
        self.table_in(Language::En)
    }

    /// The rows as a table whose people read a language.
    pub(crate) fn table_in(&self, language: Language) -> Table {
        let four = Digits::AtMost(4);
        let head = |heading: Sentence| heading.of(language).to_owned();
        let only = |is_there: bool, heading: Sentence| if is_there { head(heading) } else { String::new() };
        let has_ground = self.rows.iter().any(|row| row.ground.is_some());
        let has_remarks = self.rows.iter().any(|row| !row.remark.is_empty());
        let ground = |name: &'static str| if has_ground { name } else { "" };
        let [bears, site] = [
            only(has_ground, say!("bears a_g [g]", "a_g\nsopportata\n[g]")),
            only(has_ground, say!("site a_g [g]", "a_g\ndel sito\n[g]")),
        ];
        let remark = only(has_remarks, say!("remark", "osservazione"));
        let table = Table::over(&self.rows)
            .column(Column::text("check", ""), |row| row.check)
            .text("", head(say!("check", "verifica")), |row| row.title.of(language).to_owned())
            .column(Column::text("side", ""), |row| row.side.name())
            .text("", head(say!("side", "verso")), |row| side(row.side).of(language).to_owned())
            .number(self.code.symbol, head(self.code.ratio()), four, |row| row.zeta)
            .value("passed", |row| row.passed)
            .text("", head(say!("result", "esito")), |row| passed(row.passed).of(language).to_owned())
            .number(ground("ag_g"), bears, four, |row| row.ground.map(|of| of[0]))
            .number(ground("site_ag_g"), site, four, |row| row.ground.map(|of| of[1]))
            .value("capacity", |row| row.ends.values()[0])
            .value("demand", |row| row.ends.values()[1])
            .column(Column::text("unit", ""), |row| row.ends.unit())
            .text("", head(say!("capacity", "capacità")), |row| {
                language.decimal(&row.ends.shown(row.ends.values()[0]))
            })
            .text("", head(say!("demand", "domanda")), |row| {
                language.decimal(&row.ends.shown(row.ends.values()[1]))
            })
            .value("decides", |row| row.decides)
            .number("", head(say!("decides", "decide")), four, |row| {
                Cell::from(said(row.decides).of(language).to_owned())
            })
            .text("clause", head(say!("clause", "punto della norma")), |row| row.clause)
            .column(Column::text("remark", ""), |row| row.remark.to_string())
            .text("", remark, |row| row.remark.of(language).to_owned())
            .done();
        language.table(table)
    }

    /// The rows as markup, with classes for those that decide and for those that fail.
    pub fn html(&self) -> String {
        self.table().html_with(|index| self.class(index))
    }

    /// The rows as markup of a report, with formulas.
    pub(crate) fn markup(&self, language: Language) -> String {
        self.table_in(language).html_by(|index| self.class(index), markup)
    }

    fn class(&self, index: usize) -> &'static str {
        match (self.rows[index].decides, self.rows[index].passed) {
            (true, true) => "decides",
            (true, false) => "decides fails",
            (false, true) => "",
            (false, false) => "fails",
        }
    }

    /// The numbers of the sides as a table.
    pub fn numbers(&self) -> Table {
        numbers(&self.details.ledgers())
    }

    /// The verdict for a terminal: title, headline, rows, numbers and notes.
    pub fn text(&self, title: &str) -> String {
        let numbers = self.numbers().text();
        let mut text = format!("{title}\n{}\n\n{}\n{numbers}\n", self.headline(), self.table().text());
        for note in &self.notes {
            // writing to a String cannot fail
            let _ = writeln!(text, "{note}");
        }
        text
    }

    /// What every front says besides the rows, by name.
    pub fn summary(&self) -> Value {
        json!({
            "code": self.code.name,
            "passed": self.passed,
            "governs": self.governs,
            "side": self.side.name(),
            "zeta": self.zeta,
            "headline": self.headline(),
            "notes": self.notes,
            "warnings": self.warnings,
        })
    }

    /// All numbers by name.
    pub fn json(&self) -> Value {
        self.details.json(self)
    }
}
