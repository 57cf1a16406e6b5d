//! What every code says of a wall: a verdict with rows, and what only that code knows.

use std::fmt::Write;

use report::number;
use report::table::{Column, Digits, Table};
use rocking_wall::wall::{Parameters, Wall};
use serde_json::{Value, json};

use crate::entry::Entry;
use crate::error::CheckError;
use crate::report::{Figure, Origin, overview, the_wall};

/// The outcome of a check, as every code has it.
pub struct Verdict<'a> {
    /// The code.
    pub code: Entry,
    /// Whether the wall passes.
    pub passed: bool,
    /// The check that governs, such as `SLV`.
    pub governs: &'static str,
    /// The side that governs, such as `u > 0`; `None` where both are alike.
    pub side: Option<&'static str>,
    /// Capacity over demand of what governs \[-\].
    pub zeta: f64,
    /// A row for each check of each side; of sides that are alike, one.
    pub rows: Vec<Row>,
    /// What a rule of the code replaces, where that lets the wall pass, or governs one that fails.
    pub raise: Option<Raise>,
    /// What is to be said of the rows, in sentences.
    pub notes: Vec<String>,
    /// What the engineer should know, and
    /// [`Parameters::unusual`](rocking_wall::wall::Parameters::unusual); none of it stops the check.
    pub warnings: Vec<String>,
    /// What only this code knows.
    pub details: Box<dyn Details + Send + 'a>,
}

/// A ratio of capacity to demand that a rule of the code replaces by a larger one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raise {
    /// The check whose ratio it is, such as `SLV`.
    pub check: &'static str,
    /// The ratio that is replaced \[-\].
    pub ratio: f64,
    /// What replaces it, such as `SLD`.
    pub by: &'static str,
}

/// A check of one side.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name of the check, such as `SLV`.
    pub check: &'static str,
    /// The side.
    pub side: &'static str,
    /// Capacity over demand \[-\].
    pub zeta: f64,
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
    pub remark: String,
}

impl Row {
    /// Makes a row of a check that informs, and passes from capacity over demand 1 on; the rest is empty.
    pub(crate) fn new(check: &'static str, side: &'static str, zeta: f64, ends: Ends) -> Self {
        let (passed, decides, ground, displacement) = (zeta >= 1.0, false, None, None);
        Self {
            check,
            side,
            zeta,
            passed,
            decides,
            ground,
            ends,
            displacement,
            clause: "",
            remark: String::new(),
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
    fn figure(&self) -> Result<Figure, CheckError>;

    /// Intermediate numbers: a row for each, a column for each side.
    fn numbers(&self) -> Table;

    /// The wall in a table of walls: headings, with units, and cells, as markup.
    fn overview(&self) -> Vec<(String, String)> {
        overview(self.wall(), self.parameters())
    }

    /// The sections of a report about the site, which the walls of a building share; by default none.
    ///
    /// # Errors
    /// Those of [`figure`](Self::figure).
    fn site(&self) -> Result<Vec<(String, String)>, CheckError> {
        Ok(Vec::new())
    }

    /// The symbols of the sections, as markup; by default none.
    fn symbols(&self) -> String {
        String::new()
    }

    /// Where the code can be read in two ways: the readings taken, as markup; by default none.
    fn readings(&self) -> Vec<String> {
        Vec::new()
    }

    /// The sections of a report about the wall: by default the wall, the figure and the numbers.
    ///
    /// # Errors
    /// Those of [`figure`](Self::figure).
    fn sections(&self, origin: &Origin<'_>) -> Result<Vec<(String, String)>, CheckError> {
        let wall = the_wall(self.wall(), self.parameters(), origin, &|_, _| true);
        Ok(vec![
            ("The wall".to_owned(), wall),
            ("Capacity over demand".to_owned(), self.figure()?.html() + &self.numbers().html()),
        ])
    }
}

/// A table of intermediate numbers of some digits, without rows: a name, a unit, and a column for each side.
pub(crate) fn numbers(sides: impl Iterator<Item = &'static str>, digits: Digits) -> Table {
    let heads = [Column::text("quantity", "quantity"), Column::text("unit", "unit")];
    Table::new(heads.into_iter().chain(sides.map(|side| Column::number(side, side, digits))))
}

impl Verdict<'_> {
    /// The verdict in a line.
    pub fn headline(&self) -> String {
        let said = |Raise { check, ratio, by }| format!("{by}; {check} by displacement {ratio:.3}");
        let raised = self.raise.map(said);
        let [passed, raised] = match (self.passed, raised) {
            (true, None) => ["PASSED".to_owned(), String::new()],
            (true, Some(raised)) => [format!("PASSED by the raise of {raised}"), String::new()],
            (false, None) => ["NOT PASSED".to_owned(), String::new()],
            (false, Some(raised)) => ["NOT PASSED".to_owned(), format!(", raised by {raised}")],
        };
        let Self { code: Entry { symbol, .. }, governs, zeta, .. } = self;
        format!(
            "{passed}: {governs} governs with {symbol} = {zeta:.3}{raised} ({})",
            self.at("both sides alike")
        )
    }

    /// The side that governs, or `both` where they are alike.
    pub fn at(&self, both: &'static str) -> &'static str {
        self.side.unwrap_or(both)
    }

    /// The rows as a table: for people four digits, for files SI units and every digit.
    pub fn table(&self) -> Table {
        let four = Digits::AtMost(4);
        let has_ground = self.rows.iter().any(|row| row.ground.is_some());
        let ground = |heading: &'static str| if has_ground { heading } else { "" };
        let has_remarks = self.rows.iter().any(|row| !row.remark.is_empty());
        Table::over(&self.rows)
            .text("check", "check", |row| row.check)
            .text("side", "side", |row| row.side)
            .number(self.code.symbol, self.code.symbol, four, |row| row.zeta)
            .value("passed", |row| row.passed)
            .text("", "result", |row| if row.passed { "passed" } else { "not passed" })
            .number(ground("ag_g"), ground("bears a_g [g]"), four, |row| row.ground.map(|of| of[0]))
            .number(ground("site_ag_g"), ground("site a_g [g]"), four, |row| row.ground.map(|of| of[1]))
            .value("capacity", |row| row.ends.values()[0])
            .value("demand", |row| row.ends.values()[1])
            .column(Column::text("unit", ""), |row| row.ends.unit())
            .text("", "capacity", |row| row.ends.shown(row.ends.values()[0]))
            .text("", "demand", |row| row.ends.shown(row.ends.values()[1]))
            .number("decides", "decides", four, |row| row.decides)
            .text("clause", "clause", |row| row.clause)
            .text("remark", if has_remarks { "remark" } else { "" }, |row| row.remark.clone())
            .done()
    }

    /// The rows as markup, with classes for those that decide and for those that fail.
    pub fn html(&self) -> String {
        self.table().html_with(|index| match (self.rows[index].decides, self.rows[index].passed) {
            (true, true) => "decides",
            (true, false) => "decides fails",
            (false, true) => "",
            (false, false) => "fails",
        })
    }

    /// The verdict for a terminal: title, headline, rows, numbers and notes.
    pub fn text(&self, title: &str) -> String {
        let numbers = self.details.numbers().text();
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
            "side": self.at("both sides"),
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
