//! The state before an intervention beside the one after it.

use report::table::{Column, Digits, Table};
use serde_json::{Value, json};

use super::row::Row;
use crate::words::markup::{as_written, table_as_cards};
use crate::words::{Language, Sentence, passed, say};

/// The state before an intervention.
#[derive(Clone, Debug, PartialEq)]
pub struct Before {
    /// Title of its scene.
    pub title: String,
    /// Whether it passes.
    pub passed: bool,
    /// Its least ratio of capacity over demand \[-\].
    pub zeta: f64,
    /// Its verdict in a line.
    pub headline: Sentence,
    /// Its checks, each with the least ratio of its sides.
    pub checks: Vec<BeforeCheck>,
}

/// A check of the state before.
#[derive(Clone, Debug, PartialEq)]
pub struct BeforeCheck {
    /// Its name, such as `SLV`.
    pub check: &'static str,
    /// Capacity over demand, the least of the sides \[-\].
    pub zeta: f64,
    /// Whether it passes on every side.
    pub passed: bool,
}

impl Before {
    /// Both states, a row for each check that both have.
    fn table(&self, after: &[Row], language: Language) -> Table {
        let head = |heading: Sentence| heading.of(language).to_owned();
        let title = |check: &str| {
            let row = after.iter().find(|row| row.check == check);
            row.map_or_else(|| check.to_owned(), |row| row.title.of(language).to_owned())
        };
        let result = |is_passed: bool| passed(is_passed).of(language).to_owned();
        let own = |check: &str| self.checks.iter().find(|own| own.check == check);
        let least = least(after).into_iter();
        let both = least.filter_map(|after| Some((own(after.check)?, after)));
        let three = Digits::Decimals(3);
        let table = Table::over(both)
            .column(Column::text("", head(say!("check", "verifica"))), |(own, _)| title(own.check))
            .number("", head(say!("before", "stato\ndi fatto")), three, |(own, _)| own.zeta)
            .text("", head(say!("result", "esito")), |(own, _)| result(own.passed))
            .number("", head(say!("after", "stato\ndi progetto")), three, |(_, after)| after.zeta)
            .text("", head(say!("result", "esito")), |(_, after)| result(after.passed))
            .number("", head(say!("difference", "differenza")), three, |(own, after)| after.zeta - own.zeta)
            .done();
        language.table(table)
    }

    /// Both states for a terminal.
    pub(super) fn text(&self, after: &[Row], language: Language) -> String {
        let said = say!("Before ({title})", "Stato di fatto ({title})", title = self.title);
        let [said, headline] = [said.of(language), self.headline.of(language)];
        format!("{said}: {headline}\n{}\n", self.table(after, language).text())
    }

    /// Both states as markup.
    pub(crate) fn markup(&self, after: &[Row], language: Language) -> String {
        let (said, headline) = (say!("Before", "Stato di fatto"), self.headline.markup(language));
        let said = format!("{} ({})", said.markup(language), as_written(&self.title));
        let table = table_as_cards(&self.table(after, language), |_| "", "");
        format!("<p>{said}: {headline}</p>\n<div class=\"checks\">{table}</div>")
    }

    /// The state before by names.
    pub(super) fn json(&self) -> Value {
        let of = |one: &BeforeCheck| json!({ "check": one.check, "zeta": one.zeta, "passed": one.passed });
        json!({
            "title": self.title,
            "passed": self.passed,
            "headline": self.headline,
            "checks": self.checks.iter().map(of).collect::<Vec<_>>(),
        })
    }
}

/// The checks of rows, each with the least ratio of its sides.
pub(super) fn least(rows: &[Row]) -> Vec<BeforeCheck> {
    let mut all: Vec<BeforeCheck> = Vec::new();
    for row in rows {
        match all.iter_mut().find(|own| own.check == row.check) {
            Some(own) => (own.zeta, own.passed) = (own.zeta.min(row.zeta), own.passed && row.passed),
            None => all.push(BeforeCheck { check: row.check, zeta: row.zeta, passed: row.passed }),
        }
    }
    all
}
