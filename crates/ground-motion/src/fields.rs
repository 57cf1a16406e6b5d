//! Lines, words and numbers of a record: in free form, and in the fixed widths that Fortran wrote.

use crate::error::{CUT_SHORT, DAMAGED, Fault, TOO_MANY};
use crate::motion::floor_index;
use crate::quantity::Quantity;

/// A line and its number, from 1.
pub(crate) type Numbered<'a> = (usize, &'a str);

/// Returns the lines that are not blank, trimmed, with their numbers from 1. Line ends may be `\n`, `\r\n` or
/// `\r\r\n`; in a text without `\n`, as old Macs wrote it, `\r`.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Numbered<'_>> + Clone {
    untrimmed_lines(text).map(|(number, line)| (number, line.trim_start()))
}

/// Returns all lines, also blank ones, with their numbers from 1 and with leading blanks.
pub(crate) fn all_lines(text: &str) -> impl Iterator<Item = Numbered<'_>> + Clone {
    text.split(line_end(text)).enumerate().map(|(index, line)| (index + 1, line.trim_end()))
}

/// Returns the lines that are not blank, with their numbers from 1 and with leading blanks.
pub(crate) fn untrimmed_lines(text: &str) -> impl Iterator<Item = Numbered<'_>> + Clone {
    all_lines(text).filter(|(_, line)| !line.is_empty())
}

/// Returns what ends the lines of a text.
pub(crate) fn line_end(text: &str) -> char {
    if text.contains('\n') { '\n' } else { '\r' }
}

/// Finds the position of an ASCII word, in any case.
pub(crate) fn find(line: &str, word: &str) -> Option<usize> {
    line.as_bytes().windows(word.len()).position(|window| window.eq_ignore_ascii_case(word.as_bytes()))
}

/// Returns what follows an ASCII word, in any case.
pub(crate) fn after<'a>(line: &'a str, word: &str) -> Option<&'a str> {
    find(line, word).map(|at| &line[at + word.len()..])
}

/// Reads a number as Fortran writes it: the exponent's letter may be D. It may be infinite or NaN.
pub(crate) fn real(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| word.replace(['D', 'd'], "E").parse().ok())
}

/// Splits off the number that a text starts with, after blanks, commas, equals signs and colons.
pub(crate) fn leading_number(text: &str) -> (&str, &str) {
    let text = text.trim_start_matches(|c: char| c.is_ascii_whitespace() || matches!(c, '=' | ':' | ','));
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | 'E' | 'e' | 'D' | 'd');
    // A word such as `DT` also starts with such a letter, a number does not.
    if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return ("", text);
    }
    text.split_at(text.find(|c| !is_number(c)).unwrap_or(text.len()))
}

/// Splits numbers that touch: fixed-width fields leave no blank before a sign, `.1234567E-03-.7654321E-03`.
/// Fortran leaves out the letter of an exponent with three digits, `.1234567-103`: that is one number.
pub(crate) fn touching(word: &str) -> impl Iterator<Item = &str> {
    let mut rest = word;
    std::iter::from_fn(move || {
        let bytes = rest.as_bytes();
        let is_exponent =
            |at: usize| bytes.len() == at + 4 && rest[..at].contains('.') && !rest[at..].contains('.');
        let is_start = |at: &usize| {
            let is_sign = matches!(bytes[*at], b'+' | b'-') && !is_exponent(*at);
            is_sign && !matches!(bytes[*at - 1], b'E' | b'e' | b'D' | b'd')
        };
        let (number, after) = rest.split_at((1..bytes.len()).find(is_start).unwrap_or(bytes.len()));
        rest = after;
        Some(number).filter(|number| !number.is_empty())
    })
}

/// Reads a number that is finite and above 0.
pub(crate) fn positive(word: &str) -> Option<f64> {
    real(word).filter(|value| value.is_finite() && *value > 0.0)
}

/// Reads the leading number of a text, if it is finite.
pub(crate) fn leading_real(text: &str) -> Option<f64> {
    real(leading_number(text).0).filter(|value| value.is_finite())
}

/// Finds the unit after `UNIT:`, `UNITS OF`, `UNITS ARE` …: the most words that are one, or else the first.
pub(crate) fn unit_word(line: &str) -> Option<String> {
    const MOST_WORDS: usize = 6;
    const FILLERS: [&str; 5] = ["of", "are", "is", "in", ""];
    let is_edge =
        |c: char| c.is_whitespace() || matches!(c, '(' | ')' | '[' | ']' | ',' | '.' | ';' | ':' | '=');
    let is_filler = |word: &&str| FILLERS.contains(&&*word.trim_matches(is_edge).to_ascii_lowercase());
    let stated = after(line, "UNIT")?.trim_start_matches(['S', 's']);
    if stated.starts_with(char::is_alphanumeric) {
        return None;
    }
    let words = stated.split_ascii_whitespace().skip_while(is_filler);
    let words: Vec<&str> = words.take(MOST_WORDS).collect();
    let candidates =
        || (1..=words.len()).rev().map(|n| words[..n].join(" ").trim_matches(is_edge).to_owned());
    let known = candidates().find(|unit| Quantity::of(unit).is_some_and(|of| of != Quantity::Other));
    known
        .or_else(|| candidates().find(|unit| Quantity::of(unit).is_some()))
        .or_else(|| candidates().next_back())
}

/// Refuses a number of samples that is not the stated one: a file that is cut short, or one with too many.
pub(crate) fn check_count(
    found: usize,
    stated: usize,
    stated_by: &str,
    last_line: usize,
) -> Result<(), Fault> {
    if found == stated {
        return Ok(());
    }
    let expected = format!("{stated} samples, as {stated_by} says");
    let remedy = if found < stated { CUT_SHORT } else { TOO_MANY };
    Err(Fault::new(last_line, expected, format!("{found} up to the end"), remedy))
}

/// Makes the fault of numbers behind the last one.
fn too_many((number, text): Numbered<'_>, count: usize, stated: usize) -> Fault {
    Fault::excerpt(number, format!("an end after {count} numbers, as line {stated} says"), text, DAMAGED)
}

/// Returns half a unit of the last decimal that a number is written with: what rounding may have changed.
pub(crate) fn rounding(text: &str) -> f64 {
    let (number, _) = leading_number(text);
    let mantissa = number.split(['E', 'e', 'D', 'd']).next().unwrap_or_default();
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    // longer numbers are not rounded as far as a double can tell
    0.5 * 0.1_f64.powi(decimals.min(20).try_into().unwrap_or(20))
}

/// A Fortran format of numbers, such as `(8F10.6)`: how many stand on a line, and how wide each is. They
/// may touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Layout {
    pub(crate) per_line: usize,
    pub(crate) width: usize,
}

impl Layout {
    /// Finds the last format of one kind of numbers that a line states in parentheses.
    pub(crate) fn stated_in(line: &str) -> Option<Self> {
        let candidates = line.rsplit('(').filter_map(|text| text.split_once(')')).map(|(format, _)| format);
        candidates.into_iter().find_map(Self::of)
    }

    /// Reads a format without parentheses, `4F10.3`.
    pub(crate) fn of(format: &str) -> Option<Self> {
        const LARGEST: usize = 1000;
        let (count, rest) = format.trim().split_once(['E', 'e', 'F', 'f', 'I', 'i'])?;
        // The scale, as in `1P8E10.3`, changes the value of a number only if that has no exponent.
        let has_exponent = format.contains(['E', 'e']);
        let count = match count.rsplit_once(['P', 'p']) {
            Some((_, count)) if has_exponent => count,
            _ => count,
        };
        let width = rest.split('.').next().unwrap_or_default().trim();
        let (per_line, width) = (count.trim().parse().ok()?, width.parse().ok()?);
        // One character holds no number with a sign.
        let is_sound = (1..=LARGEST).contains(&per_line) && (2..=LARGEST).contains(&width);
        is_sound.then_some(Self { per_line, width })
    }

    /// Returns the fields of a line, trimmed, without trailing blanks. A line that is too long ends in one
    /// long field.
    pub(crate) fn fields(self, line: &str) -> impl Iterator<Item = &str> {
        let line = line.trim_end();
        let fields = line.len().div_ceil(self.width).min(self.per_line);
        (0..fields).map(move |index| {
            let start = index * self.width;
            let end =
                if index + 1 == self.per_line { line.len() } else { line.len().min(start + self.width) };
            // A cut through a letter that is not ASCII leaves no number either way.
            line.get(start..end).unwrap_or(line).trim()
        })
    }

    /// Reads `count` finite numbers from the lines that follow, and returns the line of the last; `stated` is
    /// the line that says how many.
    pub(crate) fn numbers<'a>(
        self,
        lines: &mut impl Iterator<Item = Numbered<'a>>,
        count: usize,
        stated: usize,
    ) -> Result<(Vec<f64>, usize), Fault> {
        let Self { per_line, width } = self;
        let (mut numbers, mut last_line) = (Vec::new(), stated);
        while numbers.len() < count {
            let Some((number, line)) = lines.next() else {
                check_count(numbers.len(), count, &format!("line {stated}"), last_line)?;
                break;
            };
            last_line = number;
            for field in self.fields(line) {
                let value = real(field).filter(|value| value.is_finite());
                if numbers.len() == count && value == Some(0.0) {
                    // some programs fill the last line with zeros
                    continue;
                }
                if numbers.len() == count {
                    return Err(too_many((number, field), count, stated));
                }
                numbers.push(value.ok_or_else(|| {
                    let expected = format!(
                        "a finite number ({} of {count}, as line {stated} says; \
                         {per_line} a line, {width} characters each)",
                        numbers.len() + 1
                    );
                    Fault::no_number(number, expected, field, DAMAGED)
                })?);
            }
        }
        Ok((numbers, last_line))
    }

    /// Returns integer `place` of a header, from 1, as a count; the integers stand below line `above`.
    pub(crate) fn count_among(self, integers: &[f64], place: usize, above: usize) -> Result<usize, Fault> {
        let value = integers[place - 1];
        if value >= 0.0 && value.fract() == 0.0 {
            return Ok(floor_index(value));
        }
        let line = above + place.div_ceil(self.per_line);
        Err(Fault::new(line, format!("a count as integer {place}"), value.to_string(), "correct the header"))
    }

    /// Refuses more numbers where a block should have ended.
    pub(crate) fn check_ended(
        self,
        next: Option<Numbered<'_>>,
        count: usize,
        stated: usize,
    ) -> Result<(), Fault> {
        let Some((number, line)) = next else { return Ok(()) };
        match self.fields(line).next() {
            Some(field) if real(field).is_some() => Err(too_many((number, line.trim()), count, stated)),
            _ => Ok(()),
        }
    }
}
