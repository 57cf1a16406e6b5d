//! The rows and the numbers of a verdict, for terminals, files and pages.

use std::fmt::Write;

use report::table::{Cell, Column, Digits, Table};

use super::verdict::Verdict;
use crate::words::ledger::numbers;
use crate::words::markup::table_as_cards;
use crate::words::{Language, Sentence, passed, said, say, side};

impl Verdict<'_> {
    /// The rows as a table: for people four digits, for files SI units and every digit.
    pub fn table(&self) -> Table {
        self.columns(Language::En)
    }

    /// The rows as a table whose people read a language.
    pub(crate) fn table_in(&self, language: Language) -> Table {
        language.table(self.columns(language))
    }

    /// The rows as CSV of a language: Italian has semicolons and decimal commas.
    pub fn csv(&self, language: Language) -> String {
        language.csv(self.columns(language))
    }

    fn columns(&self, language: Language) -> Table {
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
        let has_levels = self.rows.iter().any(|row| row.level.is_some());
        let level = if has_levels { "level" } else { "" };
        let levels = only(has_levels, say!("above [m]", "sopra\n[m]"));
        let remark = only(has_remarks, say!("remark", "osservazione"));
        // programs know checks and sides by their English names
        let in_file = |name: &str, told: &Sentence| match language {
            Language::En => name.to_owned(),
            Language::It => told.of(language).to_owned(),
        };
        Table::over(&self.rows)
            .column(Column::text("check", ""), |row| in_file(row.check, &row.title))
            .text("", head(say!("check", "verifica")), |row| row.title.of(language).to_owned())
            .column(Column::text("side", ""), |row| in_file(row.side.name(), &side(row.side)))
            .number(level, levels, four, |row| row.level)
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
            .column(Column::text("remark", ""), |row| row.remark.of(language).to_owned())
            .text("", remark, |row| row.remark.of(language).to_owned())
            .done()
    }

    /// The rows as markup, with classes for those that decide and for those that fail.
    pub fn html(&self, language: Language) -> String {
        self.table_in(language).html_with(|index| self.class(index))
    }

    /// The rows as markup of a report, with formulas; remarks stand below, each once.
    pub(crate) fn markup(&self, language: Language) -> String {
        let mut remarks: Vec<&Sentence> = Vec::new();
        let mut table = self.table_in(language);
        let [result, capacity, demand] =
            [say!("result", "esito"), say!("capacity", "capacità"), say!("demand", "domanda")]
                .map(|head| head_of(&table, head.of(language)));
        for (row, cells) in self.rows.iter().zip(&mut table.rows) {
            // capacities and demands with as many digits as the numbers below
            for (place, end) in [capacity, demand].into_iter().zip(row.ends.values()) {
                cells[place] = language.decimal(&row.ends.in_full(end)).into();
            }
            if row.remark.is_empty() {
                continue;
            }
            let place = remarks.iter().position(|own| **own == row.remark).unwrap_or_else(|| {
                remarks.push(&row.remark);
                remarks.len() - 1
            });
            let passed = passed(row.passed);
            cells[result] = format!("{} ({})", passed.of(language), place + 1).into();
        }
        let remark = say!("remark", "osservazione");
        let mut text = table_as_cards(&table, |index| self.class(index), remark.of(language));
        let title = say!("Remark", "Osservazione").markup(language);
        for (index, said) in remarks.iter().enumerate() {
            let _ =
                writeln!(text, "<p class=\"foot\">({}) {title}: {}.</p>", index + 1, said.markup(language));
        }
        text
    }

    /// The class of a row in pages.
    fn class(&self, index: usize) -> &'static str {
        match (self.rows[index].decides, self.rows[index].passed) {
            (true, true) => "decides",
            (true, false) => "decides fails",
            (false, true) => "",
            (false, false) => "fails",
        }
    }

    /// The numbers of the sides as a table.
    pub fn numbers(&self, language: Language) -> Table {
        language.table(numbers(&self.details.ledgers(), language))
    }

    /// The verdict for a terminal: title, headline, rows, numbers and notes.
    pub fn text(&self, title: &str, language: Language) -> String {
        let numbers = self.numbers(language).text();
        let (headline, rows) = (self.headline(), self.table_in(language).text());
        let mut text = format!("{title}\n{}\n\n{rows}\n{numbers}\n", headline.of(language));
        if let Some(before) = &self.before {
            text += &before.text(&self.rows, language);
        }
        for note in &self.notes {
            // writing to a String cannot fail
            let _ = writeln!(text, "{}", note.of(language));
        }
        text
    }
}

/// The place of the last column with a heading.
fn head_of(table: &Table, heading: &str) -> usize {
    table.columns.iter().rposition(|column| column.heading == heading).unwrap_or_default()
}
