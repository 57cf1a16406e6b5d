//! Tables: what they hold, and the forms in which they are shown.
//!
//! A column has a name for files and programs, with its unit, and a heading for people. Files get every digit in
//! SI units; people get the digits that they read, in the unit of the heading.
//!
//! ```
//! use report::table::{Column, Digits, Table};
//!
//! let mut table = Table::new([
//!     Column::text("wall", "wall"),
//!     Column::number("force_n", "force [kN]", Digits::Significant(3)).shown(1e-3),
//!     Column::number("time_s", "time [s]", Digits::Decimals(2)),
//! ]);
//! table.row(["gable".into(), 1234.5.into(), None::<f64>.into()]);
//! assert_eq!(table.text(), "wall   force [kN]  time [s]\ngable        1.23         -\n");
//! assert_eq!(table.csv(), "wall,force_n,time_s\ngable,1234.5,\n");
//! assert_eq!(table.json()[0]["force_n"], 1234.5);
//! ```

use std::borrow::Cow;
use std::fmt::Write;

use serde_json::{Map, Value};

use crate::{escaped, number};

/// A table: columns, and rows with a cell for each column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Columns in order.
    pub columns: Vec<Column>,
    /// Rows in order.
    pub rows: Vec<Vec<Cell<'static>>>,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name with its unit, in CSV, in JSON and as the key of a Python table; empty for a column that only people
    /// see.
    pub name: Cow<'static, str>,
    /// Heading with its unit, on a terminal and in pages, in one line or more; empty for a column that people do
    /// not see.
    pub heading: Cow<'static, str>,
    /// How numbers are shown to people.
    pub digits: Digits,
    /// Factor from the unit of the name to that of the heading.
    pub factor: f64,
    /// Whether it holds words, which start at the left.
    pub is_text: bool,
}

/// How numbers are shown to people; files get every digit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// So many significant digits, with a power of ten far from 1; zeros at the end are kept.
    Significant(usize),
    /// At most so many significant digits, without zeros at the end.
    AtMost(usize),
    /// So many decimals.
    Decimals(usize),
    /// A power of ten with so many decimals; `0` for zero.
    Exponent(usize),
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell<'a> {
    /// Nothing: not known, or it does not apply.
    Empty,
    /// A number, in the unit of the column's name.
    Number(f64),
    /// A number that people read with so many decimals, whatever its column says.
    Rounded(f64, usize),
    /// A number of which only bounds are known: the least and the most that it can be.
    Between([f64; 2]),
    /// A count.
    Count(usize),
    /// Yes or no.
    Flag(bool),
    /// Words.
    Text(Cow<'a, str>),
}

impl Column {
    /// A column of words.
    pub fn text(name: impl Into<Cow<'static, str>>, heading: impl Into<Cow<'static, str>>) -> Self {
        Self { is_text: true, ..Self::number(name, heading, Digits::AtMost(6)) }
    }

    /// A column of numbers, counts or flags.
    pub fn number(
        name: impl Into<Cow<'static, str>>,
        heading: impl Into<Cow<'static, str>>,
        digits: Digits,
    ) -> Self {
        Self { name: name.into(), heading: heading.into(), digits, factor: 1.0, is_text: false }
    }

    /// A column of counts.
    pub fn count(name: impl Into<Cow<'static, str>>, heading: impl Into<Cow<'static, str>>) -> Self {
        Self::number(name, heading, Digits::AtMost(20))
    }

    /// Shows numbers in another unit: times `factor`.
    #[must_use]
    pub fn shown(self, factor: f64) -> Self {
        Self { factor, ..self }
    }

    /// Returns the text of a cell for people; `-` for none in a column of numbers.
    pub fn words(&self, cell: &Cell<'_>) -> String {
        match cell {
            Cell::Empty if self.is_text => String::new(),
            Cell::Empty => "-".to_owned(),
            Cell::Number(value) => self.digits.of(self.factor * value),
            Cell::Rounded(value, decimals) => Digits::Decimals(*decimals).of(self.factor * value),
            Cell::Between(bounds) => between(*bounds, |value| self.digits.of(self.factor * value)),
            Cell::Count(count) => count.to_string(),
            Cell::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Cell::Text(text) => text.clone().into_owned(),
        }
    }
}

impl Digits {
    /// Returns the text of a number.
    pub fn of(self, value: f64) -> String {
        if !value.is_finite() {
            return if value.is_nan() { "-".to_owned() } else { value.to_string() };
        }
        match self {
            Self::AtMost(digits) => number(value, digits),
            Self::Decimals(decimals) => format!("{value:.decimals$}"),
            Self::Exponent(_) if value == 0.0 => "0".to_owned(),
            Self::Exponent(decimals) => format!("{value:.decimals$e}"),
            Self::Significant(digits) => significant(value, digits),
        }
    }
}

/// Returns a number with `digits` significant digits, and a power of ten below 1e-3 and from 1e6 on.
///
/// ```
/// use report::table::significant;
///
/// assert_eq!([0.25, 1e7, 0.0].map(|value| significant(value, 3)), ["0.250", "1.00e7", "0.0"]);
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-3..1e6).contains(&magnitude) {
        let before = if value == 0.0 { 1.0 } else { magnitude.log10().floor() };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few decimals")]
        let decimals = (digits as f64 - 1.0 - before).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", digits.saturating_sub(1))
    }
}

/// Returns what is known of a number that lies between two bounds; `–` if nothing.
///
/// ```
/// use report::table::between;
///
/// let text = |bounds| between(bounds, |value| value.to_string());
/// assert_eq!([text([2.0, 2.0]), text([2.0, f64::INFINITY]), text([0.0, 3.0])], ["2", "open >2", "open <3"]);
/// ```
pub fn between([least, most]: [f64; 2], number: impl Fn(f64) -> String) -> String {
    match (least > 0.0, most < f64::INFINITY) {
        _ if most.is_nan() || least.is_nan() => "–".to_owned(),
        _ if least == most => number(most),
        (true, true) => format!("open {} to {}", number(least), number(most)),
        (true, false) => format!("open >{}", number(least)),
        (false, true) => format!("open <{}", number(most)),
        (false, false) => "open".to_owned(),
    }
}

impl Cell<'_> {
    /// Returns the field of a CSV file: every digit of a number, quotes where RFC 4180 asks for them, nothing for
    /// an empty cell.
    pub fn field(&self) -> Cow<'_, str> {
        match self {
            Self::Empty => "".into(),
            Self::Number(value) | Self::Rounded(value, _) => format!("{value:?}").into(),
            Self::Between(bounds) => between(*bounds, |value| format!("{value:?}")).replace('–', "").into(),
            Self::Count(count) => count.to_string().into(),
            Self::Flag(flag) => flag.to_string().into(),
            Self::Text(text) => quoted(text),
        }
    }

    /// Returns the value in JSON; `null` for an empty cell and a number that is not finite.
    pub fn json(&self) -> Value {
        match self {
            Self::Empty => Value::Null,
            Self::Number(value) | Self::Rounded(value, _) => (*value).into(),
            Self::Between([least, most]) if least == most => (*most).into(),
            Self::Between(bounds) => bounds.to_vec().into(),
            Self::Count(count) => (*count).into(),
            Self::Flag(flag) => (*flag).into(),
            Self::Text(text) => text.clone().into_owned().into(),
        }
    }
}

/// Quotes a text where RFC 4180 asks for it.
///
/// ```
/// assert_eq!(report::table::quoted("a, b"), "\"a, b\"");
/// ```
pub fn quoted(field: &str) -> Cow<'_, str> {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\"")).into()
    } else {
        field.into()
    }
}

/// Returns the line of a CSV file, without its end.
///
/// ```
/// assert_eq!(report::table::line(&["a, b".into(), 0.5.into(), None::<f64>.into()]), "\"a, b\",0.5,");
/// ```
pub fn line(cells: &[Cell<'_>]) -> String {
    cells.iter().map(Cell::field).collect::<Vec<_>>().join(",")
}

impl Table {
    /// Creates a table without rows.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Self {
        Self { columns: columns.into_iter().collect(), rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// If it does not have a cell for each column.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell<'static>>) {
        let row: Vec<_> = cells.into_iter().collect();
        assert_eq!(row.len(), self.columns.len(), "a cell for each column");
        self.rows.push(row);
    }

    /// Columns that people see, with their places.
    fn shown(&self) -> impl Iterator<Item = (usize, &Column)> + Clone {
        self.columns.iter().enumerate().filter(|(_, column)| !column.heading.is_empty())
    }

    /// Columns of files, with their places.
    fn named(&self) -> impl Iterator<Item = (usize, &Column)> + Clone {
        self.columns.iter().enumerate().filter(|(_, column)| !column.name.is_empty())
    }

    /// Returns the table as text for a terminal: headings, then a line for each row, in columns as wide as they
    /// need.
    pub fn text(&self) -> String {
        let heads = self.shown().map(|(_, column)| column.heading.lines().count()).max().unwrap_or(0);
        let mut lines: Vec<Vec<String>> = Vec::with_capacity(heads + self.rows.len());
        for line in 0..heads {
            // short headings stand just above the numbers
            let of = |(_, column): (usize, &Column)| {
                let own = column.heading.lines().count();
                let part = (line + own).checked_sub(heads).and_then(|line| column.heading.lines().nth(line));
                part.unwrap_or_default().to_owned()
            };
            lines.push(self.shown().map(of).collect());
        }
        lines.extend(
            self.rows.iter().map(|row| self.shown().map(|(k, column)| column.words(&row[k])).collect()),
        );
        let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
        let widths: Vec<_> = (0..self.shown().count()).map(width).collect();
        let mut text = String::new();
        for line in lines {
            let mut row = String::new();
            for ((cell, width), (_, column)) in line.iter().zip(&widths).zip(self.shown()) {
                let gap = if row.is_empty() { "" } else { "  " };
                // writing to a String cannot fail
                let _ = if column.is_text {
                    write!(row, "{gap}{cell:<width$}")
                } else {
                    write!(row, "{gap}{cell:>width$}")
                };
            }
            text += row.trim_end();
            text.push('\n');
        }
        text
    }

    /// Returns the table as CSV: a line of names, then a line for each row.
    pub fn csv(&self) -> String {
        let names: Vec<_> = self.named().map(|(_, column)| quoted(&column.name)).collect();
        let mut text = names.join(",") + "\n";
        for row in &self.rows {
            let fields: Vec<_> = self.named().map(|(k, _)| row[k].field()).collect();
            text += &fields.join(",");
            text.push('\n');
        }
        text
    }

    /// Returns the rows as a list of objects with the names of the columns.
    pub fn json(&self) -> Value {
        let object = |row: &Vec<Cell<'_>>| -> Value {
            self.named()
                .map(|(k, column)| (column.name.to_string(), row[k].json()))
                .collect::<Map<_, _>>()
                .into()
        };
        self.rows.iter().map(object).collect()
    }

    /// Returns the table as markup: numbers at the right, wide tables scroll.
    pub fn html(&self) -> String {
        self.html_with(|_| "")
    }

    /// Returns the table as markup, with a class for each row; empty for none.
    pub fn html_with(&self, class: impl Fn(usize) -> &'static str) -> String {
        let class_of = |column: &Column| if column.is_text { "" } else { " class=\"number\"" };
        let mut text = String::from("<div class=\"scroll\"><table>\n<thead><tr>");
        for (_, column) in self.shown() {
            let _ =
                write!(text, "<th{}>{}</th>", class_of(column), escaped(&column.heading.replace('\n', " ")));
        }
        text += "</tr></thead>\n<tbody>\n";
        for (index, row) in self.rows.iter().enumerate() {
            let class = class(index);
            let _ =
                if class.is_empty() { write!(text, "<tr>") } else { write!(text, "<tr class=\"{class}\">") };
            for (k, column) in self.shown() {
                let _ = write!(text, "<td{}>{}</td>", class_of(column), escaped(&column.words(&row[k])));
            }
            text += "</tr>\n";
        }
        text + "</tbody></table></div>\n"
    }

    /// Returns the table as Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let heads = self.shown().map(|(_, column)| column.heading.replace('\n', " ")).collect();
        let rules = self.shown().map(|(_, column)| if column.is_text { "---" } else { "---:" });
        let rules = rules.collect::<Vec<_>>().join("|");
        let rows = self.rows.iter().map(|row| {
            line(self.shown().map(|(k, column)| column.words(&row[k]).replace('|', "\\|")).collect())
        });
        format!("{}|{rules}|\n{}", line(heads), rows.collect::<String>())
    }
}

impl From<f64> for Cell<'_> {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<usize> for Cell<'_> {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<bool> for Cell<'_> {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Cell<'_> {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}

impl<'a, T: Into<Cell<'a>>> From<Option<T>> for Cell<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::{Cell, Column, Digits, Table};

    fn table() -> Table {
        let mut table = Table::new([
            Column::text("record", "record"),
            Column::number("pga_m_s2", "PGA\n[g]", Digits::Decimals(3)).shown(0.1),
            Column::count("runs", "runs"),
            Column::number("falls", "", Digits::AtMost(1)),
            Column::number("", "change [%]", Digits::AtMost(3)),
        ]);
        table.row(["a, \"b\"".into(), 1.5.into(), 12_usize.into(), true.into(), 0.5.into()]);
        table.row(["c".into(), Cell::Empty, 3_usize.into(), false.into(), f64::NAN.into()]);
        table
    }

    #[test]
    fn people_see_headings_and_files_names() {
        let table = table();
        assert_eq!(
            table.text(),
            "          PGA\n\
             record    [g]  runs  change [%]\n\
             a, \"b\"  0.150    12         0.5\n\
             c           -     3           -\n"
        );
        assert_eq!(table.csv(), "record,pga_m_s2,runs,falls\n\"a, \"\"b\"\"\",1.5,12,true\nc,,3,false\n");
        let json = r#"[{"falls":true,"pga_m_s2":1.5,"record":"a, \"b\"","runs":12},"#.to_owned()
            + r#"{"falls":false,"pga_m_s2":null,"record":"c","runs":3}]"#;
        let expected: serde_json::Value = serde_json::from_str(&json).unwrap_or_default();
        assert_eq!(table.json(), expected);
        assert!(table.html().contains("<th class=\"number\">PGA [g]</th>"));
        assert!(table.html().contains("<td>a, &quot;b&quot;</td><td class=\"number\">0.150</td>"));
        assert!(
            table.markdown().starts_with("| record | PGA [g] | runs | change [%] |\n|---|---:|---:|---:|\n")
        );
    }

    #[test]
    fn a_number_can_have_decimals_of_its_own() {
        let column = Column::number("x", "x", Digits::Exponent(1)).shown(10.0);
        for (cell, field, words) in [
            (Cell::Number(0.5), "0.5", "5.0e0"),
            (Cell::Number(0.0), "0.0", "0"),
            (Cell::Rounded(0.5, 2), "0.5", "5.00"),
        ] {
            assert_eq!((&*cell.field(), &*column.words(&cell)), (field, words));
        }
    }

    #[test]
    fn a_number_between_bounds_shows_what_is_known() {
        let column = Column::number("x", "x", Digits::AtMost(3));
        for (bounds, field, words) in [
            ([2.0, 2.0], "2.0", "2"),
            ([2.0, f64::INFINITY], "open >2.0", "open >2"),
            ([0.0, 2.0], "open <2.0", "open <2"),
            ([1.0, 2.0], "open 1.0 to 2.0", "open 1 to 2"),
            ([f64::NAN, 2.0], "", "–"),
        ] {
            let cell = Cell::Between(bounds);
            assert_eq!((&*cell.field(), &*column.words(&cell)), (field, words));
        }
    }
}
