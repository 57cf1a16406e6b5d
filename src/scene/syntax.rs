//! Says in plain words why a line is not TOML: what people write in its place, and how to write it.

use fmu_export::VariableId;

use crate::variables::RealVariable;

use super::error::Place;

/// Most characters of a faulty line that a message repeats.
pub(super) const SHOWN_CHARACTERS: usize = 60;

/// Explains a text that is not TOML; `at` is the byte at which reading stopped. Returns the line and the
/// message.
pub(super) fn explained(place: &Place<'_>, at: usize) -> (usize, String) {
    let text = place.text();
    let bare_return = text.bytes().zip(text.bytes().skip(1).chain([0])).any(|pair| {
        let (byte, next) = pair;
        byte == b'\r' && next != b'\n'
    });
    if bare_return {
        let message = "the lines end with CR alone, as on old Macs: save the file with LF or CRLF line ends";
        return (1, message.to_owned());
    }
    let stopped = place.line(at..at);
    let line = |number: usize| text.lines().nth(number - 1).unwrap_or_default().trim();
    // a line that goes on in the next one, which is where reading stopped
    let faulty = |number: &usize| fault(without_comment(line(*number))).is_some();
    let number = [stopped, stopped.saturating_sub(1).max(1)].into_iter().find(faulty).unwrap_or(stopped);
    let line = line(number);
    let message = fault(without_comment(line)).unwrap_or_else(|| {
        "expected a line such as height = 3, a table such as [geometry], or a comment after #".to_owned()
    });
    (number, format!("{message}, in `{}`", shown(line)))
}

/// Shortens a text for a message.
pub(super) fn shown(text: &str) -> String {
    text.trim().chars().take(SHOWN_CHARACTERS).collect()
}

/// Cuts the comment off a line; a `#` in quotes is none.
fn without_comment(line: &str) -> &str {
    let mut quote = None;
    for (index, character) in line.char_indices() {
        match (quote, character) {
            (None, '#') => return line[..index].trim_end(),
            (None, '"' | '\'') => quote = Some(character),
            (Some(open), _) if open == character => quote = None,
            _ => {}
        }
    }
    line
}

/// Finds what is wrong with a line, and how to write it.
fn fault(line: &str) -> Option<String> {
    if line.is_empty() {
        return None;
    }
    if line.starts_with("//") || line.starts_with(['%', '!', ';']) {
        return Some("a comment begins with #".to_owned());
    }
    if line.contains(['“', '”', '„', '‘', '’']) {
        return Some("a text stands in straight quotes, \"…\"".to_owned());
    }
    if line.starts_with('[') {
        let closed = line.matches('[').count() == line.matches(']').count();
        return (!closed).then(|| "a table's name stands in brackets, such as [geometry]".to_owned());
    }
    // every value of the line: those of { … } as well
    let mut parts = line.split('=').peekable();
    while let Some(before) = parts.next() {
        let key = before.rsplit([',', '{', ' ', '\t']).find(|word| !word.is_empty()).unwrap_or_default();
        if let Some(after) = parts.peek()
            && let Some(message) = faulty_value(key, after.trim())
        {
            return Some(message);
        }
    }
    let Some((key, _)) = line.split_once('=') else {
        let (key, value) = line.split_once([':', ' ', '\t'])?;
        return Some(format!("expected key = value: write {key} = {}", value.trim()));
    };
    let opens = |open: char, close: char| line.matches(open).count() > line.matches(close).count();
    match line.matches('"').count() % 2 {
        1 => Some(format!("{}: a quotation mark is missing", key.trim())),
        _ if line.contains('\\') => Some(format!("{}: write / for \\, or put the text in '…'", key.trim())),
        _ if opens('[', ']') => Some(format!("{}: the list has no end; close it with ]", key.trim())),
        _ if opens('{', '}') => Some(format!("{}: the table has no end; close it with }}", key.trim())),
        _ => None,
    }
}

/// Finds what is wrong with the value of a key.
fn faulty_value(key: &str, value: &str) -> Option<String> {
    if value.is_empty() {
        return Some(format!("{key} has no value; give one, or leave {key} out"));
    }
    if let Some(remedy) = number_meant(key, value) {
        return Some(remedy);
    }
    let word = value.split([',', '}', ' ', ';']).next().unwrap_or_default();
    let is_word = word.starts_with(|c: char| c.is_alphabetic());
    if is_word && ["true", "false"].contains(&word.to_lowercase().as_str()) && word != word.to_lowercase() {
        return Some(format!("{key} = {word}: write {}", word.to_lowercase()));
    }
    if is_word && !["true", "false", "inf", "nan"].contains(&word) {
        return Some(format!("{key} = {word}: a name or text stands in quotes, {key} = \"{word}\""));
    }
    value.ends_with(';').then(|| format!("{key}: leave out the ; at the end"))
}

/// Says how to write the number that a text is meant to be; `None` where it is none, or is right.
///
/// A decimal comma becomes a decimal point; a number has digits on both sides of it, and no unit.
pub(super) fn number_meant(key: &str, text: &str) -> Option<String> {
    let unsigned = text.trim_start_matches(['+', '-']);
    let sign = &text[..text.len() - unsigned.len()];
    let (whole, rest) = digits(unsigned);
    let mark = rest.chars().next().filter(|c| matches!(c, '.' | ','));
    let (fraction, rest) = mark.map_or(("", rest), |mark| digits(&rest[mark.len_utf8()..]));
    let (exponent, rest) = exponent(rest);
    if mark == Some(',') && !whole.is_empty() && !fraction.is_empty() {
        return Some(format!(
            "{key} = {sign}{whole},{fraction}{exponent}: a number has a decimal point, not a comma; write \
             {key} = {sign}{whole}.{fraction}{exponent}"
        ));
    }
    let point = match mark {
        Some('.') => ".",
        Some(_) => return None,
        None => "",
    };
    let number = format!("{sign}{whole}{point}{fraction}{exponent}");
    if !point.is_empty() && whole.is_empty() != fraction.is_empty() {
        let (before, after) = if whole.is_empty() { ("0", fraction) } else { (whole, "0") };
        return Some(format!(
            "{key} = {number}: a number has digits on both sides of its point; write {key} = \
             {sign}{before}.{after}{exponent}"
        ));
    }
    let unit = rest.split([',', '}', ']', '"', '#']).next().unwrap_or_default().trim();
    if whole.is_empty() || !unit.starts_with(|c: char| c.is_alphabetic() || c == '%') {
        return None;
    }
    Some(format!(
        "{key} = {number} {unit}: a number stands without its unit; write {key} = {number}, if that is its \
         value in {}",
        unit_of(key)
    ))
}

/// Splits a text after the digits that it starts with.
fn digits(text: &str) -> (&str, &str) {
    text.split_at(text.bytes().take_while(u8::is_ascii_digit).count())
}

/// Splits a text after the exponent that it starts with, `e-3`, if there is one.
fn exponent(text: &str) -> (&str, &str) {
    let power = text.strip_prefix(['e', 'E']).map(|power| power.strip_prefix(['+', '-']).unwrap_or(power));
    match power.map(digits) {
        Some((power, rest)) if !power.is_empty() => text.split_at(text.len() - rest.len()),
        _ => ("", text),
    }
}

/// The unit of a parameter; SI for other keys.
fn unit_of(key: &str) -> &'static str {
    let unit = RealVariable::from_name(key).and_then(|variable| variable.variable().unit);
    match unit {
        Some("1") => "parts of 1",
        Some(unit) => unit,
        None => "the unit of the documentation",
    }
}
