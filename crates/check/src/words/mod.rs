//! What is told to people: English and Italian, side by side where their author writes them.
//!
//! ```
//! use check::{Language, Sentence};
//!
//! let said = Sentence::new("It holds.", "La parete regge.");
//! assert_eq!((&*said, said.of(Language::It)), ("It holds.", "La parete regge."));
//! ```

pub(crate) mod entry;
pub(crate) mod formulas;
pub(crate) mod ledger;
pub(crate) mod markup;
pub(crate) mod names;
pub(crate) mod of_record;
pub(crate) mod others;

use std::fmt;
use std::ops::Deref;

use ::report::number;
use ::report::table::{Cell, Table, significant};
use serde::{Deserialize, Serialize, Serializer};

use formulas::markup;
use names::{Deciding, LimitState, Sides};

/// Makes a [`Sentence`]: English, Italian, and the values of the gaps of both, as
/// `say!("{d} mm", "{d} mm", d = at_most(d, 4))`. A gap that one of both lacks is an unused variable.
macro_rules! say {
    (@of $name:ident) => { &$name };
    (@of $name:ident $value:expr) => { &$value };
    ($en:literal, $it:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {{
        $(let $name = $crate::words::InWords::in_words($crate::words::say!(@of $name $($value)?));)*
        #[allow(clippy::useless_format, reason = "a text without gaps is one, too")]
        let both = [
            { $(let $name = $name.of($crate::words::Language::En);)* format!($en) },
            { $(let $name = $name.of($crate::words::Language::It);)* format!($it) },
        ];
        let [en, it] = both;
        $crate::words::Sentence::new(en, it)
    }};
}
pub(crate) use say;

/// The language of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English.
    #[default]
    En,
    /// Italian.
    It,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::En, Self::It];

    /// Returns the value of the key `language`.
    pub fn name(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::It => "it",
        }
    }

    /// A text with numbers, none of which is a clause: Italian has decimal commas.
    pub(crate) fn decimal(self, text: &str) -> String {
        let is_digit = |letter: Option<char>| letter.is_some_and(|letter| letter.is_ascii_digit());
        if self == Self::En {
            return text.to_owned();
        }
        let mut written = String::with_capacity(text.len());
        let mut rest = text.chars().peekable();
        while let Some(letter) = rest.next() {
            let is_point =
                letter == '.' && is_digit(written.chars().last()) && is_digit(rest.peek().copied());
            written.push(if is_point { ',' } else { letter });
        }
        written
    }

    /// A number that is computed, as a report has it.
    pub(crate) fn shown(self, value: f64) -> String {
        self.decimal(&shown(value))
    }

    /// A number that the engineer states, as it was written.
    pub(crate) fn stated(self, value: f64) -> String {
        self.decimal(&number(value, 6))
    }

    /// The text of a number; a dash without one.
    pub(crate) fn or_dash(self, value: Option<f64>) -> String {
        value.map_or_else(|| "–".to_owned(), |value| self.shown(value))
    }

    /// A table as CSV: Italian has its own names of columns, semicolons and decimal commas.
    pub(crate) fn csv(self, mut table: Table) -> String {
        if self == Self::En {
            return table.csv();
        }
        for column in &mut table.columns {
            let name = match &*column.name {
                "name" => "parete",
                "check" => "verifica",
                "side" => "verso",
                "passed" => "soddisfatta",
                "ag_g" => "a_g_sopportata_g",
                "site_ag_g" => "a_g_sito_g",
                "capacity" => "capacita",
                "demand" => "domanda",
                "unit" => "unita",
                "decides" => "decide",
                "clause" => "punto_norma",
                "remark" => "osservazione",
                "governs" => "determinante",
                "zeta_E_before" => "zeta_E_stato_di_fatto",
                "not_checked" => "non_verificata",
                "warnings" => "avvertenze",
                _ => continue,
            };
            column.name = name.into();
        }
        for cell in table.rows.iter_mut().flatten() {
            if let Cell::Flag(flag) = cell {
                *cell = said(*flag).of(self).to_owned().into();
            }
        }
        table.csv_with_commas()
    }

    /// The same table with the numbers of people in this language.
    pub(crate) fn table(self, mut table: Table) -> Table {
        for row in &mut table.rows {
            for (cell, column) in row.iter_mut().zip(&table.columns) {
                if self == Self::It && !matches!(cell, Cell::Text(_)) {
                    *cell = match &*cell {
                        Cell::Flag(flag) => said(*flag).of(self).to_owned().into(),
                        other => self.decimal(&column.words(other)).into(),
                    };
                }
            }
        }
        table
    }
}

/// A text in both languages. As a value, and in JSON, it is the English one.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sentence {
    en: String,
    it: String,
    /// What pages say in its place, where it names a key of a file.
    page: Option<Box<Sentence>>,
}

impl Sentence {
    /// Makes a text of its two forms.
    pub fn new(en: impl Into<String>, it: impl Into<String>) -> Self {
        Self { en: en.into(), it: it.into(), page: None }
    }

    /// Makes a text that is the same in both languages: a symbol, or what the user writes.
    pub fn same(text: impl Into<String>) -> Self {
        let text = text.into();
        Self { it: text.clone(), en: text, page: None }
    }

    /// The text in a language.
    pub fn of(&self, language: Language) -> &str {
        match language {
            Language::En => &self.en,
            Language::It => &self.it,
        }
    }

    /// Gives what pages say in its place: who reads a report has no file with keys.
    #[must_use]
    pub(crate) fn on_page(self, page: Self) -> Self {
        Self { page: Some(Box::new(page)), ..self }
    }

    /// Puts it in a frame, and what pages say in its place in the same one.
    pub(crate) fn framed(&self, frame: impl Fn(Self) -> Self) -> Self {
        let own = frame(Self { page: None, ..self.clone() });
        match &self.page {
            Some(page) => own.on_page(frame((**page).clone())),
            None => own,
        }
    }

    /// The text in a language as markup, with its symbols as formulas.
    pub(crate) fn markup(&self, language: Language) -> String {
        markup(self.page.as_deref().unwrap_or(self).of(language))
    }

    /// The same as markup in both languages.
    pub(crate) fn as_markup(&self) -> Self {
        Self::new(markup(&self.en), markup(&self.it))
    }
}

impl From<&str> for Sentence {
    fn from(text: &str) -> Self {
        Self::same(text)
    }
}

impl Deref for Sentence {
    type Target = str;

    fn deref(&self) -> &str {
        &self.en
    }
}

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.en)
    }
}

impl Serialize for Sentence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.en)
    }
}

/// What fills a gap of a sentence.
pub(crate) trait InWords {
    /// Its text in both languages.
    fn in_words(&self) -> Sentence;
}

/// A number as it is written in English; Italian has a decimal comma.
#[derive(Clone, Debug)]
pub(crate) struct Written(pub(crate) String);

/// A number with at most so many digits.
pub(crate) fn at_most(value: f64, digits: usize) -> Written {
    Written(number(value, digits))
}

/// A number with so many decimals.
pub(crate) fn fixed(value: f64, decimals: usize) -> Written {
    Written(format!("{value:.decimals$}"))
}

/// Two numbers that are compared, with at most so many digits, or as many more as tell them apart.
pub(crate) fn apart(values: [f64; 2], digits: usize) -> [Written; 2] {
    ::report::apart(values, digits).map(Written)
}

/// A number that is computed, as a report has it: with four digits, and fewer only where they are all.
pub(crate) fn shown(value: f64) -> String {
    let text = number(value, 4);
    let is_whole = text.parse().is_ok_and(|read: f64| (read - value).abs() <= 1e-9 * value.abs());
    let is_near = (1e-3..1e6).contains(&value.abs());
    if is_whole || !is_near { text } else { significant(value, 4) }
}

impl InWords for Written {
    fn in_words(&self) -> Sentence {
        Sentence::new(&*self.0, self.0.replace('.', ","))
    }
}

impl InWords for f64 {
    fn in_words(&self) -> Sentence {
        Written(self.to_string()).in_words()
    }
}

impl InWords for usize {
    fn in_words(&self) -> Sentence {
        Sentence::same(self.to_string())
    }
}

impl InWords for Sentence {
    fn in_words(&self) -> Sentence {
        self.clone()
    }
}

impl InWords for LimitState {
    fn in_words(&self) -> Sentence {
        Sentence::same(self.key())
    }
}

impl InWords for Deciding {
    fn in_words(&self) -> Sentence {
        match self {
            Self::SlvWithQ => say!("SLV with q", "SLV con q"),
            _ => Sentence::same(self.name()),
        }
    }
}

impl InWords for str {
    fn in_words(&self) -> Sentence {
        Sentence::same(self)
    }
}

impl InWords for String {
    fn in_words(&self) -> Sentence {
        Sentence::same(&**self)
    }
}

impl<T: InWords + ?Sized> InWords for &T {
    fn in_words(&self) -> Sentence {
        (**self).in_words()
    }
}

/// Sentences one after the other, with something between them.
pub(crate) fn joined(all: &[Sentence], between: &str) -> Sentence {
    let of = |language| all.iter().map(|one| one.of(language)).collect::<Vec<_>>().join(between);
    Sentence::new(of(Language::En), of(Language::It))
}

/// Yes or no.
pub(crate) fn said(flag: bool) -> Sentence {
    if flag { say!("yes", "sì") } else { say!("no", "no") }
}

/// Whether something passes.
pub(crate) fn passed(is_passed: bool) -> Sentence {
    if is_passed {
        say!("passed", "verifica soddisfatta")
    } else {
        say!("not passed", "verifica non soddisfatta")
    }
}

/// What a number is of.
pub(crate) fn side(of: Sides) -> Sentence {
    match of {
        Sides::Alike => say!("both sides", "entrambi i versi"),
        Sides::One(side) => Sentence::same(side.name()),
    }
}

/// The same of the body above a level, where levels are stated \[m\].
pub(crate) fn above(of: Sentence, level: Option<f64>) -> Sentence {
    match level {
        None => of,
        Some(level) => say!("{of}, above {level} m", "{of}, sopra {level} m", of, level),
    }
}

/// The side that governs, of sides that may be alike.
pub(crate) fn governing(of: Sides) -> Sentence {
    match of {
        Sides::Alike => say!("both sides alike", "identico nei due versi"),
        Sides::One(_) => side(of),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_languages_have_the_same_numbers() {
        let said =
            say!("a_g = {ag} g at {state}", "{state}: a_g = {ag} g", ag = 0.15, state = LimitState::Slv);
        assert_eq!((&*said, said.of(Language::It)), ("a_g = 0.15 g at SLV", "SLV: a_g = 0,15 g"));
        assert_eq!(Language::It.decimal("1.1 T_1 = 0.5, 17."), "1,1 T_1 = 0,5, 17.");
    }

    #[test]
    fn zeros_are_digits_of_rounded_numbers() {
        let numbers = [(13.9979, "14.00"), (2.4, "2.4"), (1.30049, "1.300"), (-0.5, "-0.5"), (0.0, "0")];
        for (value, text) in numbers {
            assert_eq!(shown(value), text);
        }
    }
}
