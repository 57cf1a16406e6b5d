//! Tables: what they hold, and the forms in which they are shown.
//!
//! A column has a name for files and programs, with its unit, and a heading for people. Files get every digit
//! in SI units; people get the digits that they read, in the unit of the heading.
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

mod cell;

use std::borrow::Cow;
use std::fmt::Write;

use serde_json::{Map, Value};

use crate::{SCROLLS, escaped};

pub use cell::{Cell, Column, Digits, between, quoted, significant};

/// A table that grows by columns, see [`Table::over`].
#[derive(Clone, Debug)]
pub struct Growing<R> {
    items: Vec<R>,
    table: Table,
}

impl<R> Growing<R> {
    /// Adds a column with the cell of each item.
    #[must_use]
    pub fn column<C: Into<Cell<'static>>>(self, column: Column, cell: impl Fn(&R) -> C) -> Self {
        self.cells(column, &|item| cell(item).into())
    }

    /// Adds a column. Not generic in the function, so that rustc compiles it once for each type of item, not
    /// once for each of hundreds of columns.
    fn cells(mut self, column: Column, cell: &dyn Fn(&R) -> Cell<'static>) -> Self {
        self.table.columns.push(column);
        for (row, item) in self.table.rows.iter_mut().zip(&self.items) {
            row.push(cell(item));
        }
        self
    }

    /// Adds a column of words.
    #[must_use]
    pub fn text<C: Into<Cell<'static>>>(
        self,
        name: impl Into<Cow<'static, str>>,
        heading: impl Into<Cow<'static, str>>,
        cell: impl Fn(&R) -> C,
    ) -> Self {
        self.column(Column::text(name, heading), cell)
    }

    /// Adds a column of numbers, counts or flags.
    #[must_use]
    pub fn number<C: Into<Cell<'static>>>(
        self,
        name: impl Into<Cow<'static, str>>,
        heading: impl Into<Cow<'static, str>>,
        digits: Digits,
        cell: impl Fn(&R) -> C,
    ) -> Self {
        self.column(Column::number(name, heading, digits), cell)
    }

    /// Adds a column of numbers, counts or flags for files and programs, which people do not see.
    #[must_use]
    pub fn value<C: Into<Cell<'static>>>(
        self,
        name: impl Into<Cow<'static, str>>,
        cell: impl Fn(&R) -> C,
    ) -> Self {
        self.column(Column::count(name, ""), cell)
    }

    /// Returns the table.
    pub fn done(self) -> Table {
        self.table
    }
}

/// A table: columns, and rows with a cell for each column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Columns in order.
    pub columns: Vec<Column>,
    /// Rows in order.
    pub rows: Vec<Vec<Cell<'static>>>,
}

impl Table {
    /// Creates a table without rows.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Self {
        Self { columns: columns.into_iter().collect(), rows: Vec::new() }
    }

    /// Begins a table with a row for each item, to which columns are added.
    ///
    /// ```
    /// use report::table::{Digits, Table};
    ///
    /// let walls = [("gable", 2.5), ("strip", 4.0)];
    /// let table = Table::over(&walls)
    ///     .text("wall", "wall", |wall| wall.0)
    ///     .number("height_m", "height [m]", Digits::Decimals(2), |wall| wall.1)
    ///     .value("is_high", |wall| wall.1 > 3.0)
    ///     .done();
    /// assert_eq!(table.csv(), "wall,height_m,is_high\ngable,2.5,false\nstrip,4.0,true\n");
    /// ```
    pub fn over<R>(items: impl IntoIterator<Item = R>) -> Growing<R> {
        let items: Vec<R> = items.into_iter().collect();
        let rows = items.iter().map(|_| Vec::new()).collect();
        Growing { items, table: Self { columns: Vec::new(), rows } }
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

    /// Returns the table as text for a terminal: headings, then a line for each row, in columns as wide as
    /// they need.
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
        names.join(",") + "\n" + &self.csv_rows()
    }

    /// Returns the table as CSV for programs that have decimal commas: fields stand between semicolons.
    ///
    /// ```
    /// use report::table::{Digits, Table};
    ///
    /// let table = Table::over([2.5]).number("height_m", "", Digits::AtMost(3), |height| *height).done();
    /// assert_eq!(table.csv_with_commas(), "height_m\n2,5\n");
    /// ```
    pub fn csv_with_commas(&self) -> String {
        let quoted = |text: &str| {
            if text.contains(';') {
                format!("\"{}\"", text.replace('"', "\"\""))
            } else {
                quoted(text).into_owned()
            }
        };
        let field = |cell: &Cell<'_>| match cell {
            Cell::Text(text) => quoted(text),
            other => other.field().replace('.', ","),
        };
        let names: Vec<_> = self.named().map(|(_, column)| quoted(&column.name)).collect();
        let rows = self.rows.iter().map(|row| self.named().map(|(k, _)| field(&row[k])).collect());
        let lines = std::iter::once(names).chain(rows);
        lines.map(|fields: Vec<String>| fields.join(";") + "\n").collect()
    }

    /// Returns the rows as CSV without the line of names, to add them to a file that has it.
    pub fn csv_rows(&self) -> String {
        let mut text = String::new();
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
        self.html_by(class, escaped)
    }

    /// Returns the same markup with headings and words as `markup` makes them, such as with formulas.
    pub fn html_by(&self, class: impl Fn(usize) -> &'static str, markup: impl Fn(&str) -> String) -> String {
        let class_of = |column: &Column| if column.is_text { "" } else { " class=\"number\"" };
        let mut text = [SCROLLS, "<table>\n<thead><tr>"].concat();
        for (_, column) in self.shown() {
            // where a table is too wide, a heading of numbers breaks between its lines only
            let space = if column.is_text { " " } else { "\u{a0}" };
            let heading = column.heading.replace(' ', space).replace('\n', " ");
            let _ = write!(text, "<th{}>{}</th>", class_of(column), markup(&heading));
        }
        text += "</tr></thead>\n<tbody>\n";
        for (index, row) in self.rows.iter().enumerate() {
            let class = class(index);
            let _ =
                if class.is_empty() { write!(text, "<tr>") } else { write!(text, "<tr class=\"{class}\">") };
            for (k, column) in self.shown() {
                let words = column.words(&row[k]);
                let words = if column.is_of_user {
                    format!("<span translate=\"no\">{}</span>", escaped(&words))
                } else {
                    markup(&words)
                };
                let _ = write!(text, "<td{}>{words}</td>", class_of(column));
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

    /// On a narrow page a heading of numbers breaks where it has lines, and not within a unit.
    #[test]
    fn headings_of_numbers_break_between_their_lines() {
        let table = Table::new([
            Column::number("", "rate of\nfalls [1/year]", Digits::AtMost(3)),
            Column::text("", "the wall"),
        ]);
        let head = "<th class=\"number\">rate\u{a0}of falls\u{a0}[1/year]</th><th>the wall</th>";
        assert!(table.html().contains(head), "{}", table.html());
    }

    #[test]
    fn the_keyboard_reaches_a_table_that_scrolls() {
        let html = Table::new([Column::text("", "wall")]).html();
        assert!(
            html.starts_with("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label="),
            "{html}"
        );
    }

    #[test]
    fn words_of_the_user_are_marked() {
        let mut table = Table::new([Column::text("name", "wall").of_user(), Column::text("side", "side")]);
        table.row(["a < b".into(), "a < b".into()]);
        let cells = "<td><span translate=\"no\">a &lt; b</span></td><td>a &lt; b</td>";
        assert!(table.html().contains(cells) && table.csv().ends_with("a < b,a < b\n"));
    }

    #[test]
    fn a_number_can_have_decimals_of_its_own() {
        let column = Column::number("x", "x", Digits::Exponent(1)).shown(10.0);
        for (cell, field, words) in [
            (Cell::Number(0.5), "0.5", "5.0e0"),
            (Cell::Number(0.0), "0.0", "0"),
            (Cell::Rounded(0.5, 2), "0.5", "5.00"),
            (Cell::Rounded(-1e-4, 1), "-0.0001", "0.0"),
            (Cell::Rounded(f64::NAN, 1), "NaN", "-"),
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
