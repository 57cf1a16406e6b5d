//! Columns and cells: how a value is written in files, in JSON and for people.

use std::borrow::Cow;

use serde_json::Value;

use crate::number;

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name with its unit, in CSV, in JSON and as the key of a Python table; empty for a column that only
    /// people see.
    pub name: Cow<'static, str>,
    /// Heading with its unit, on a terminal and in pages, in one line or more; empty for a column that people
    /// do not see.
    pub heading: Cow<'static, str>,
    /// How numbers are shown to people.
    pub digits: Digits,
    /// Factor from the unit of the name to that of the heading.
    pub factor: f64,
    /// Whether it holds words, which start at the left.
    pub is_text: bool,
    /// Whether the words are the user's own, which no language of a page replaces.
    pub is_of_user: bool,
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
        Self {
            name: name.into(),
            heading: heading.into(),
            digits,
            factor: 1.0,
            is_text: false,
            is_of_user: false,
        }
    }

    /// Marks the words of the column as the user's own, which no language of a page replaces.
    #[must_use]
    pub fn of_user(self) -> Self {
        Self { is_of_user: true, ..self }
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
            Cell::Rounded(value, decimals) => {
                let text = Digits::Decimals(*decimals).of(self.factor * value);
                // what shows as zero has no sign
                let is_zero = text.trim_matches(['-', '0', '.']).is_empty();
                if is_zero && value.is_finite() { text.replace('-', "") } else { text }
            }
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
    /// Returns the field of a CSV file: every digit of a number, quotes where RFC 4180 asks for them, nothing
    /// for an empty cell.
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
