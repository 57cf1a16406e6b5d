//! Tables, formulas and calculations as markup.

use std::fmt::Write;

use ::report::escaped;
use ::report::table::significant;

/// A list of texts.
pub(crate) fn list(texts: &[String]) -> String {
    let items = texts.iter().map(|text| ["<li>", &escaped(text), "</li>\n"].concat());
    if texts.is_empty() { String::new() } else { format!("<ul>\n{}</ul>\n", items.collect::<String>()) }
}

/// The headline of a side.
pub(crate) fn side_head(name: &str) -> String {
    format!("<h3>Side {}</h3>\n", escaped(name))
}

/// The result of a check.
pub(crate) fn result(is_passed: bool) -> &'static str {
    if is_passed { "passed" } else { "<span class=\"fails\">not passed</span>" }
}

/// A number as people write it, with at most so many digits.
pub(crate) use ::report::number;

/// A number that is computed, as a report has it: with four digits, and fewer only where they are all.
pub(crate) fn shown(value: f64) -> String {
    let text = number(value, 4);
    let is_whole = text.parse().is_ok_and(|read: f64| (read - value).abs() <= 1e-9 * value.abs());
    let is_near = (1e-3..1e6).contains(&value.abs());
    if is_whole || !is_near { text } else { significant(value, 4) }
}

/// A force with four digits in kN; `force` in N.
pub(crate) fn kilonewtons(force: f64) -> String {
    shown(1e-3 * force)
}

/// A length with four digits in mm; `length` in m.
pub(crate) fn millimetres(length: f64) -> String {
    shown(1e3 * length)
}

/// A number that the engineer states, as it was written.
pub(crate) fn stated(value: f64) -> String {
    number(value, 6)
}

/// The text of a number; a dash without one.
pub(crate) fn or_dash(value: Option<f64>, text: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| "–".to_owned(), text)
}

/// A table of markup; without heads if there are none.
pub(crate) fn table<const N: usize>(heads: &[&str], rows: &[[String; N]]) -> String {
    let mut text = String::from("<div class=\"scroll\"><table>\n");
    if !heads.is_empty() {
        let _ = writeln!(text, "<thead><tr><th>{}</th></tr></thead>", heads.join("</th><th>"));
    }
    for row in rows {
        let _ = writeln!(text, "<tr><td>{}</td></tr>", row.join("</td><td>"));
    }
    text + "</table></div>\n"
}

/// Raises the powers of a formula as markup: the number behind `^`.
fn raised(markup: &str) -> String {
    let mut parts = markup.split('^');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let power = leading(part, |letter| letter.is_ascii_digit() || letter == '.' || letter == '−');
        text.extend(["<sup>", power, "</sup>", &part[power.len()..]]);
    }
    text
}

/// A formula as markup: single letters are italic, what follows `_`, and digits behind a letter, are indices;
/// the number behind `^` is a power.
pub(crate) fn formula(text: &str) -> String {
    let (mut markup, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        if !first.is_alphabetic() {
            markup.push_str(&escaped(&first.to_string()));
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let word = leading(rest, char::is_alphabetic);
        rest = &rest[word.len()..];
        let is_symbol = word.chars().count() == 1 && word != "π";
        let _ = if is_symbol { write!(markup, "<i>{word}</i>") } else { write!(markup, "{word}") };
        let index = match rest.strip_prefix('_') {
            Some(after) => {
                rest = after;
                leading(rest, |letter| letter.is_alphabetic() || letter.is_ascii_digit() || letter == ',')
            }
            None if is_symbol => leading(rest, |letter| letter.is_ascii_digit()),
            None => "",
        };
        // a comma at the end separates
        let index = index.trim_end_matches(',');
        if !index.is_empty() {
            let _ = write!(markup, "<sub>{index}</sub>");
            rest = &rest[index.len()..];
        }
    }
    raised(&markup)
}

fn leading(text: &str, belongs: impl Fn(char) -> bool) -> &str {
    &text[..text.find(|letter| !belongs(letter)).unwrap_or(text.len())]
}

/// A calculation: lines of what is computed, by which equation, from which numbers.
#[derive(Default)]
pub(crate) struct Calculation(String);

impl Calculation {
    /// Adds a line: words and source of the formula, the formula, the numbers put in, result and unit. Empty
    /// parts are left out.
    pub(crate) fn line(
        &mut self,
        [words, source]: [&str; 2],
        [left, numbers]: [&str; 2],
        (value, unit): (f64, &str),
    ) {
        let source =
            if source.is_empty() { String::new() } else { format!(" <small>{}</small>", escaped(source)) };
        let numbers =
            if numbers.is_empty() { String::new() } else { format!(" = {}", raised(&escaped(numbers))) };
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let _ = writeln!(
            self.0,
            "<tr><td>{words}{source}</td><td>{}{numbers} = <b>{}</b>{unit}</td></tr>",
            formula(left),
            shown(value)
        );
    }

    /// Adds a line of words.
    pub(crate) fn say(&mut self, words: &str, said: &str) {
        let _ = writeln!(self.0, "<tr><td>{words}</td><td>{said}</td></tr>");
    }

    /// The lines as a table.
    pub(crate) fn table(self) -> String {
        format!("<table class=\"calculation\">\n{}</table>\n", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{formula, shown};

    #[test]
    fn zeros_are_digits_of_rounded_numbers() {
        let numbers = [(13.9979, "14.00"), (2.4, "2.4"), (1.30049, "1.300"), (-0.5, "-0.5"), (0.0, "0")];
        for (value, text) in numbers {
            assert_eq!(shown(value), text);
        }
    }

    #[test]
    fn letters_are_italic_and_indices_low() {
        for (text, markup) in [
            ("a_0 = α0 g/(e* FC)", "<i>a</i><sub>0</sub> = <i>α</i><sub>0</sub> <i>g</i>/(<i>e</i>* FC)"),
            ("S_eZ(T_SLV, ξ)", "<i>S</i><sub>eZ</sub>(<i>T</i><sub>SLV</sub>, <i>ξ</i>)"),
            ("a_g,cap", "<i>a</i><sub>g,cap</sub>"),
            ("x^1.2", "<i>x</i><sup>1.2</sup>"),
            ("a_1, π", "<i>a</i><sub>1</sub>, π"),
            ("T_1² T0²", "<i>T</i><sub>1</sub>² <i>T</i><sub>0</sub>²"),
        ] {
            assert_eq!(formula(text), markup);
        }
    }
}
