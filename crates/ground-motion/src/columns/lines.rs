//! The lines of a table: comments, and line breaks in quoted cells.

use std::borrow::Cow;

use crate::error::Fault;
use crate::fields::{Numbered, line_end};

/// What starts a comment.
pub(crate) const COMMENTS: [char; 2] = ['#', '%'];

/// What starts a comment in other programs' files.
const OTHER_COMMENTS: [&str; 4] = ["//", "/*", "!", "; "];

/// Most lines of a quoted cell. A quote that none of them closes opens no cell.
const LONGEST_CELL: usize = 20;

/// Returns whether a line among rows is a comment: its mark stands alone, twice, or before a blank.
pub(crate) fn is_comment(line: &str) -> bool {
    let rest = line.strip_prefix(COMMENTS);
    rest.is_some_and(|rest| {
        rest.starts_with(char::is_whitespace) || rest.trim_start_matches(COMMENTS).is_empty()
    }) && !line.starts_with("###")
}

/// Returns whether a line above the rows is a comment: any that starts with its mark and is no error of a
/// spreadsheet.
pub(crate) fn is_comment_above(line: &str) -> bool {
    line.starts_with(COMMENTS) && !is_error(line)
}

/// Returns whether a line starts with a cell such as `#N/A`, `#DIV/0!`, `#WERT!` or `#NV`: capitals only,
/// with a mark, or alone on the line.
fn is_error(line: &str) -> bool {
    let is_edge = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"');
    let cell = line.split(is_edge).next().unwrap_or_default().trim_start_matches(COMMENTS);
    let is_capital = cell.contains(char::is_uppercase) && !cell.contains(char::is_lowercase);
    let has_mark = cell.contains('/') || cell.ends_with(['!', '?']);
    line.starts_with('#') && is_capital && !cell.contains([':', '=']) && (has_mark || line.ends_with(cell))
}

/// Refuses a line among rows that starts with the mark of a comment and is none.
pub(crate) fn refuse_unclear((number, line): Numbered<'_>) -> Result<(), Fault> {
    if is_comment(line) {
        return Ok(());
    }
    let remedy = "correct an error of a spreadsheet there; put a name that starts with the mark in \
                  quotes, and a blank behind the mark of a comment";
    Err(Fault::excerpt(number, "a row or a comment", line, remedy))
}

/// Returns the lines that are not blank, with their numbers from 1. A line break in a quoted cell ends none.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Numbered<'_>> + Clone {
    let (end, mut start, mut number) = (line_end(text), 0, 0);
    std::iter::from_fn(move || {
        while start <= text.len() {
            let ends = || text[start..].match_indices(end).map(|(at, _)| start + at).chain([text.len()]);
            let is_whole = |(_, stop): &(usize, usize)| !Quotes::of(text[start..*stop].trim()).is_open;
            let whole = ends().enumerate().take(LONGEST_CELL).find(is_whole);
            let (more, stop) = whole.or_else(|| ends().enumerate().next())?;
            let (first, line) = (number + 1, text[start..stop].trim());
            (number, start) = (first + more, stop + 1);
            if !line.is_empty() {
                return Some((first, line));
            }
        }
        None
    })
}

/// The quotes of a line.
pub(super) struct Quotes<'a> {
    /// What stands outside them.
    pub(super) outside: Cow<'a, str>,
    /// Whether a cell goes on behind the line.
    is_open: bool,
}

impl<'a> Quotes<'a> {
    /// Finds the quoted cells of a line. Their quotes stand behind a separator or a blank, and before none:
    /// `12" wall` and the mark `"` for "as above" open no cell.
    pub(super) fn of(line: &'a str) -> Self {
        if !line.contains('"') || is_comment_above(line) {
            return Self { outside: line.into(), is_open: false };
        }
        let (mut outside, mut is_open) = (String::new(), false);
        let is_edge = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '"');
        let mut is_start = true;
        let mut characters = line.chars().peekable();
        while let Some(c) = characters.next() {
            let opens = is_start && !characters.peek().is_some_and(|next| matches!(next, ',' | ';' | '\t'));
            is_open ^= c == '"' && (is_open || opens);
            if !is_open {
                outside.push(c);
            }
            is_start = is_edge(c);
        }
        Self { outside: outside.into(), is_open }
    }
}

/// Returns the lines that are no comments, from the first one with content on. `sep=;`, by which Excel knows
/// the separator, counts as a comment.
pub(super) fn content(text: &str) -> impl Iterator<Item = Numbered<'_>> + Clone {
    let content = lines(text).filter(|(_, line)| !(is_comment_above(line) || is_separator_line(line)));
    content.skip_while(|(_, line)| line.chars().all(|c| c.is_whitespace() || matches!(c, ',' | ';' | '"')))
}

fn is_separator_line(line: &str) -> bool {
    line.len() <= "sep=;".len() && line.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("sep="))
}

/// Returns the first line that is no comment.
pub(super) fn first_line<'a>(text: &'a str, forms: &str) -> Result<Numbered<'a>, Fault> {
    content(text).next().ok_or_else(|| {
        let found = if lines(text).next().is_some() { "comments only" } else { "an empty file" };
        Fault::new(1, forms, found, "check that this is the right file")
    })
}

/// Refuses comment marks of other programs, errors of spreadsheets, and bars between columns in lines that
/// `is_row` knows.
pub(super) fn refuse_foreign<'a>(
    lines: impl Iterator<Item = Numbered<'a>>,
    is_row: impl Fn(&str) -> bool,
) -> Result<(), Fault> {
    for (number, line) in lines {
        if line.starts_with(COMMENTS) {
            refuse_unclear((number, line))?;
        }
        if OTHER_COMMENTS.iter().any(|mark| line.starts_with(mark)) || line.contains('|') && is_row(line) {
            let expected = "columns between commas, semicolons, tabs or blanks";
            let remedy = "comments start with # or %, and `|` separates no columns: write these instead";
            return Err(Fault::excerpt(number, expected, line, remedy));
        }
    }
    Ok(())
}
