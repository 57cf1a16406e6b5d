//! Tables, formulas and calculations as markup.

use std::collections::BTreeMap;
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
    let mut text = [report::SCROLLS, "<table>\n"].concat();
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
#[derive(Clone, Default)]
pub(crate) struct Calculation {
    lines: String,
    /// Symbols and parts of formulas, such as `(W + O)`, with their numbers as they are put in.
    known: BTreeMap<String, String>,
}

impl Calculation {
    /// Makes symbols known, in the units in which formulas take them.
    pub(crate) fn know(&mut self, symbols: &[(&str, f64)]) {
        for (symbol, value) in symbols {
            let number = shown(*value).replace('-', "−");
            let number = if *value < 0.0 { format!("({number})") } else { number };
            self.known.insert((*symbol).to_owned(), number);
        }
    }

    /// The number of a known symbol; empty of another.
    pub(crate) fn number(&self, symbol: &str) -> &str {
        self.known.get(symbol).map_or("", String::as_str)
    }

    /// Adds a line: words and source of the formula, the formula, its numbers, result and unit; empty sources
    /// and units are left out. Numbers are put in where every symbol behind the last `=` is known; what
    /// stands in braces, such as a power of ten between units, is for them alone. From then on the symbols
    /// before the `=` are known.
    pub(crate) fn line(&mut self, words: [&str; 2], formula: &str, result: (f64, &str)) {
        let (left, right) = formula.rsplit_once(" = ").unwrap_or(("", formula));
        let put = self.put(right).filter(|put| *put != shown(result.0)).unwrap_or_default();
        for symbol in left.split(" = ").filter(|symbol| !symbol.is_empty()) {
            self.know(&[(symbol, result.0)]);
        }
        let mut bare = formula.to_owned();
        while let Some((from, to)) = bare.find('{').zip(bare.find('}')) {
            bare = bare[..from].trim_end().to_owned() + &bare[to + 1..];
        }
        self.line_of(words, [&bare, &put], result);
    }

    /// Adds a line whose numbers are put in already; none if empty.
    pub(crate) fn line_of(
        &mut self,
        [words, source]: [&str; 2],
        [left, put]: [&str; 2],
        (value, unit): (f64, &str),
    ) {
        let some = |text: &str, shown: String| if text.is_empty() { String::new() } else { shown };
        let source = some(source, format!(" <small>{}</small>", escaped(source)));
        let put = some(put, format!(" = {}", raised(&escaped(put))));
        let unit = some(unit, format!(" {unit}"));
        let (left, value) = (formula(left), shown(value));
        let _ = writeln!(
            self.lines,
            "<tr><td>{words}{source}</td><td>{left}{put} = <b>{value}</b>{unit}</td></tr>"
        );
    }

    /// A formula with the numbers of its symbols; `None` where one is not known.
    fn put(&self, formula: &str) -> Option<String> {
        let (mut text, mut rest) = (String::new(), formula);
        while let Some(first) = rest.chars().next() {
            let goes_on = |next: char| next.is_alphabetic() || next.is_ascii_digit() || next == '_';
            let is_whole =
                |symbol: &str| rest.strip_prefix(symbol).is_some_and(|after| !after.starts_with(goes_on));
            let known = self.known.iter().filter(|(symbol, _)| is_whole(symbol));
            if let Some((symbol, number)) = known.max_by_key(|(symbol, _)| symbol.len()) {
                text += number;
                rest = &rest[symbol.len()..];
                continue;
            }
            let word = leading(rest, char::is_alphabetic);
            let (part, after) = rest.split_at(word.len().max(first.len_utf8()));
            let is_symbol = word.chars().count() == 1 && word != "π" || after.starts_with('_');
            if !word.is_empty() && is_symbol {
                return None;
            }
            let is_sign = |letter: char| "+−=·;π".contains(letter);
            text += match first {
                '{' | '}' => "",
                // a product, unless it is the space around a sign
                ' ' if !(text.ends_with(is_sign) || after.starts_with(is_sign)) => " · ",
                _ => part,
            };
            rest = after;
        }
        Some(text)
    }

    /// Adds a line of words.
    pub(crate) fn say(&mut self, words: &str, said: &str) {
        let _ = writeln!(self.lines, "<tr><td>{words}</td><td>{said}</td></tr>");
    }

    /// The lines as a table.
    pub(crate) fn table(self) -> String {
        format!("<table class=\"calculation\">\n{}</table>\n", self.lines)
    }
}

#[cfg(test)]
mod tests {
    use super::{Calculation, formula, shown};

    #[test]
    fn zeros_are_digits_of_rounded_numbers() {
        let numbers = [(13.9979, "14.00"), (2.4, "2.4"), (1.30049, "1.300"), (-0.5, "-0.5"), (0.0, "0")];
        for (value, text) in numbers {
            assert_eq!(shown(value), text);
        }
    }

    #[test]
    fn known_numbers_are_put_in() {
        let mut lines = Calculation::default();
        lines.know(&[("a_0", 2.0), ("d", 30.0), ("d_0", 150.0), ("c", -0.5), ("(W + O)", 7.0), ("(W", 1.0)]);
        for (formula, put) in [
            ("a_0 (1 − d/d_0)", Some("2 · (1 − 30/150)")),
            ("max(0; (W + O) c)", Some("max(0; 7 · (−0.5))")),
            ("2π √(d {10⁻³}/a_0)", Some("2π √(30 · 10⁻³/2)")),
            ("1.68 π d_0²", Some("1.68 π 150²")),
            ("a_0 d_1", None),
            ("a_0 e", None),
        ] {
            assert_eq!(lines.put(formula).as_deref(), put, "{formula}");
        }
        lines.line(["d", ""], "u_0 = d {10³}", (30.0, "mm"));
        assert!(lines.table().contains("<sub>0</sub> = <i>d</i> = 30 · 10³ = <b>30</b> mm"));
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
