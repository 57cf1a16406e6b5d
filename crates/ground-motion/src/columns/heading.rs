//! The names of columns, and the units that they state.

use super::cells::{Separator, cells, unquoted};
use crate::error::Fault;
use crate::fields::{find, unit_word};
use crate::quantity::{Measured, Quantity};
use crate::unit::Unit;
use crate::vertical::is_vertical_channel;

/// Longest word of a name, and most words \[-\].
const LONGEST: usize = 64;

/// The name of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    written: String,
    text: String,
    unit: Option<String>,
}

impl Name {
    /// Splits `a_g [m/s2]` or `a_g (m/s2)` into the name and its unit. Of several brackets the first that
    /// holds a unit of acceleration counts, or else the first with another unit, or else one at the end.
    pub(super) fn of(cell: &str) -> Self {
        let written = unquoted(cell).into_owned();
        let (whole, mut inside) = (&*written, 0);
        let brackets = whole.match_indices(['[', '(']).filter_map(move |(at, opening)| {
            let rest = &whole[at + 1..];
            // a unit may have brackets inside: (cm/(s*s))
            let end = closing(rest, opening).filter(|_| at >= inside)?;
            inside = at + 1 + end;
            let is_last = rest[end + 1..].trim().is_empty();
            Some((at, rest[..end].trim(), is_last))
        });
        let is_acceleration = |text: &str| matches!(Quantity::of(text), Some(Quantity::Acceleration(_)));
        let unit = brackets.clone().find(|(_, text, _)| is_acceleration(text));
        let unit = unit.or_else(|| brackets.clone().find(|(_, text, _)| Quantity::of(text).is_some()));
        let unit = unit.or_else(|| brackets.clone().find(|(.., is_last)| *is_last));
        let unit = unit.map(|(at, unit, _)| (at, unit)).or_else(|| behind(&written));
        let text = unit.map_or(&*written, |(at, _)| &written[..at]).trim().to_owned();
        let unit = unit.map(|(_, unit)| unit.to_owned());
        Self { written, text, unit }
    }

    /// Returns the name as the file has it.
    pub fn written(&self) -> &str {
        &self.written
    }

    /// Returns the name without its unit.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the unit, or what else stands in the brackets.
    pub fn unit(&self) -> Option<&str> {
        self.unit.as_deref()
    }

    /// Returns what the unit measures, if it is a length, a force or an acceleration.
    pub fn measured(&self) -> Option<Measured> {
        self.unit.as_deref().and_then(Measured::of)
    }

    /// Returns the words of the name, in small letters; of a line that is no name, the first few.
    pub(crate) fn words(&self) -> Vec<String> {
        let words = self.text.split(|c: char| !c.is_alphanumeric());
        let words = words.filter(|word| (1..=LONGEST).contains(&word.len()));
        words.take(LONGEST).map(str::to_ascii_lowercase).collect()
    }

    /// Returns the unit that its brackets state, or its last word behind others, with its quantity.
    pub(crate) fn stated(&self) -> Option<(String, Quantity)> {
        let words = self.words();
        let last = words.last().filter(|_| words.len() > 1).map(String::as_str);
        let unit = self.unit().or(last)?;
        Some((unit.to_owned(), Quantity::of(unit)?))
    }

    /// Returns the quantity other than an acceleration of the ground that its words say.
    pub(crate) fn says(&self) -> Option<Quantity> {
        let words = self.words();
        // in English, German, French, Italian and Spanish; words keep the capitals that are not ASCII
        let starts = |word: &str, all: &[&str]| all.iter().any(|start| word.starts_with(start));
        let quantity = words.iter().find_map(|word| match word.as_str() {
            "sv" | "psv" | "vg" => Some(Quantity::Velocity),
            "sd" | "dg" => Some(Quantity::Displacement),
            word if starts(word, &["vel", "gesch", "vites"]) => Some(Quantity::Velocity),
            word if starts(word, &["dis", "spost", "dépl", "dÉpl", "depl", "versch", "despl"]) => {
                Some(Quantity::Displacement)
            }
            _ => None,
        });
        let is_period = words.first().is_some_and(|word| word.starts_with("period") || word == "tn");
        let is_spectrum = is_period || words.iter().any(|word| ["sa", "psa", "spectral"].contains(&&**word));
        quantity.or(is_spectrum.then_some(Quantity::Spectrum))
    }

    /// Refuses the name of a velocity or a displacement on a line.
    pub(crate) fn refuse_other_quantity(&self, line: usize) -> Result<(), Fault> {
        match self.says() {
            Some(Quantity::Spectrum) | None => Ok(()),
            Some(quantity) => Err(quantity.refused(&self.written, line)),
        }
    }

    /// Returns whether one of its words, aside from the unit, means vertical.
    pub(crate) fn is_vertical(&self) -> bool {
        let unit = self.unit.as_deref().unwrap_or_default();
        let is_plain_v = self.text.eq_ignore_ascii_case("v");
        !is_plain_v && self.written.replacen(unit, " ", 1).split(['_', ' ']).any(is_vertical_channel)
    }

    /// Returns the quantity of its unit.
    pub(crate) fn quantity(&self) -> Option<Quantity> {
        self.unit.as_deref().and_then(Quantity::of)
    }

    /// Returns whether it states a unit of acceleration that is read.
    pub(crate) fn is_acceleration(&self) -> bool {
        matches!(self.quantity(), Some(Quantity::Acceleration(_)))
    }

    /// Returns whether it states a quantity other than an acceleration.
    pub(crate) fn is_another_quantity(&self) -> bool {
        self.quantity()
            .is_some_and(|of| !matches!(of, Quantity::Acceleration(_) | Quantity::OtherAcceleration(..)))
    }
}

/// Finds a unit without brackets at the end of a name, and where it is set off: `a, m/s2`, `a_ft/s2`,
/// `a_cm_s2`. The g of `a_g` is none: it may mean the ground. Neither is a number before it, as in `x_0.3g`.
fn behind(name: &str) -> Option<(usize, &str)> {
    if let Some(at) = name.rfind(',') {
        let unit = name[at + 1..].trim();
        return Quantity::of(unit).map(|_| (at, unit));
    }
    let is_unit = |unit: &str| match Quantity::of(unit) {
        _ if unit.starts_with(|c: char| c.is_ascii_digit() || c == '.') => false,
        Some(Quantity::Acceleration(Unit::StandardGravity)) | None => false,
        Some(Quantity::Acceleration(_) | Quantity::OtherAcceleration(..) | Quantity::Velocity) => true,
        Some(Quantity::Signal) => unit.len() > 1,
        Some(_) => unit.contains('/'),
    };
    let starts = std::iter::once((0, 0)).chain(name.match_indices(['_', ' ']).map(|(at, _)| (at, at + 1)));
    starts.map(|(at, start)| (at, name[start..].trim())).find(|(_, unit)| is_unit(unit))
}

/// Finds the unit that a title or a comment states: `units: gal`, `acceleration in g`, and `NS (counts)` if
/// it `may_be_in_brackets`. Lengths, velocities and other units count where the line starts with `unit`; they
/// may be those of something else.
pub(crate) fn unit_of_title(line: &str, may_be_in_brackets: bool) -> Option<String> {
    // not `scaled to (0.3g)`
    let is_acceleration = |unit: &str| {
        matches!(Quantity::of(unit), Some(Quantity::Acceleration(_) | Quantity::OtherAcceleration(..)))
            && !unit.starts_with(|c: char| c.is_ascii_digit())
    };
    let says_unit = find(line, "UNIT").is_some_and(|at| !line[..at].contains(char::is_alphanumeric));
    let is_meant = |unit: &String| match Quantity::of(unit) {
        Some(Quantity::Signal) => true,
        Some(Quantity::Time(_) | Quantity::Frequency) | None => false,
        Some(_) => says_unit || is_acceleration(unit),
    };
    let name = Name::of(line);
    let in_brackets = name.unit().filter(|_| may_be_in_brackets && line.matches(['[', '(']).count() == 1);
    let stated = [unit_word(line), in_brackets.map(str::to_owned)].into_iter().flatten().find(is_meant);
    stated.or_else(|| {
        let line = line.to_ascii_lowercase();
        let after_in = line.match_indices(" in ").map(|(at, word)| line[at + word.len()..].trim());
        let mut units =
            after_in.flat_map(|rest| [rest, rest.split([' ', ',', ';']).next().unwrap_or_default()]);
        units.find(|unit| is_acceleration(unit)).map(str::to_owned)
    })
}

/// Finds the bracket that closes one which is open at the start of a text.
fn closing(text: &str, opening: &str) -> Option<usize> {
    let closing = if opening == "[" { ']' } else { ')' };
    let mut depth = 1_usize;
    let mut characters = text.char_indices();
    let closes = |(_, c): &(usize, char)| {
        depth = if opening.starts_with(*c) { depth + 1 } else { depth - usize::from(*c == closing) };
        depth == 0
    };
    characters.find(closes).map(|(at, _)| at)
}

/// Splits a line of names, without empty ones at its end.
pub(super) fn names(line: &str, separator: Separator) -> Vec<Name> {
    let mut names: Vec<Name> = match separator {
        Separator::Blanks if line.contains(['\t', '"']) => {
            let separator = if line.contains('\t') { Separator::Tab } else { separator };
            let filled = cells(line, separator).filter(|name| !name.is_empty());
            filled.map(|name| Name::of(&name)).collect()
        }
        Separator::Blanks => words(line).iter().map(|name| Name::of(name)).collect(),
        _ => cells(line, separator).map(|name| Name::of(&name)).collect(),
    };
    let filled = names.iter().rposition(|name| !name.written.is_empty()).map_or(0, |last| last + 1);
    names.truncate(filled);
    names
}

/// Splits a line of names at blanks; a bracket belongs to the name before it, `time [s]`.
fn words(text: &str) -> Vec<String> {
    const OPENING: [char; 2] = ['(', '['];
    let mut words: Vec<String> = Vec::new();
    let mut depth = 0_usize;
    // in a row of units, each bracket is a word of its own
    let is_unit_row = text.trim_start().starts_with(OPENING);
    for word in text.split_whitespace() {
        let continues = depth > 0 || !is_unit_row && word.starts_with(OPENING);
        match words.last_mut().filter(|_| continues) {
            Some(before) => before.extend([" ", word]),
            None => words.push(word.to_owned()),
        }
        depth += word.matches(OPENING).count();
        depth = depth.saturating_sub(word.matches([')', ']']).count());
    }
    words
}

/// The unit in a cell of a row of units: `m/s2`, `[m/s2]` or `(m/s2)`.
fn unit_alone(name: &Name) -> &str {
    name.unit().filter(|_| name.text().is_empty()).unwrap_or(name.written())
}

/// Returns whether a line has units only, for two columns or more.
pub(super) fn is_unit_row(names: &[Name]) -> bool {
    let is_unit =
        |name: &Name| matches!(unit_alone(name), "" | "-") || Quantity::of(unit_alone(name)).is_some();
    names.len() > 1 && names.iter().all(is_unit)
}

/// Gives the units of a row to the names above it that state none.
pub(super) fn add_units(names: &mut [Name], line: &str) {
    let units = self::names(line, Separator::of_names(line, false));
    for (name, unit) in names.iter_mut().zip(&units) {
        let unit = Some(unit_alone(unit)).filter(|unit| !matches!(*unit, "" | "-"));
        name.unit = name.unit.take().or_else(|| unit.map(str::to_owned));
    }
}
