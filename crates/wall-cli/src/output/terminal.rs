//! Text for people: stdout and stderr.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::fmt::{Display, Write as _};
use std::io::{self, ErrorKind, Write};

use anyhow::{Context, Result};
use report::number;

/// Most lines and characters of a message, and most messages of one kind.
const MOST_LINES: usize = 9;
const MOST_CHARACTERS: usize = 2000;
const MOST_MESSAGES: usize = 7;
/// Characters at the end of a message that tell its kind.
const ENDING: usize = 16;

/// Where a command prints: results on `out`, unless a file goes there (`--csv -`), and messages on `err`.
pub(crate) struct Console<'a> {
    out: RefCell<&'a mut dyn Write>,
    err: RefCell<&'a mut dyn Write>,
    out_takes_a_file: Cell<bool>,
}

impl<'a> Console<'a> {
    pub(crate) fn new(out: &'a mut dyn Write, err: &'a mut dyn Write) -> Self {
        Self { out: RefCell::new(out), err: RefCell::new(err), out_takes_a_file: Cell::new(false) }
    }

    /// Sends all messages to `err` from here on, since a file goes to `out`.
    pub(super) fn give_out_to_a_file(&self) {
        self.out_takes_a_file.set(true);
    }

    /// Prints results for the user: on `out`, unless a file goes there.
    pub(crate) fn print(&self, text: &str) -> Result<()> {
        let text = printable(text);
        if self.out_takes_a_file.get() {
            self.to_stderr(&text);
            return Ok(());
        }
        self.bytes(text.as_bytes())
    }

    /// Writes to `out`. A closed pipe or a lost terminal is no error, since nobody reads the output then.
    pub(super) fn bytes(&self, bytes: &[u8]) -> Result<()> {
        let mut out = self.out.borrow_mut();
        match out.write_all(bytes).and_then(|()| out.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe && !is_lost_terminal(&error) => {
                Err(error).context("stdout")
            }
            _ => Ok(()),
        }
    }

    /// Writes to `err`; a closed pipe or a lost terminal is no reason to stop.
    pub(crate) fn to_stderr(&self, text: &str) {
        let mut err = self.err.borrow_mut();
        let _ = err.write_all(text.as_bytes()).and_then(|()| err.flush());
    }

    /// Prints a message for the user, such as an error.
    pub(crate) fn report(&self, message: &str) {
        self.to_stderr(&(bounded(&printable(&with_short_numbers(&format!("wall: {message}")))) + "\n"));
    }

    /// Warns the user of what does not stop the work.
    pub(crate) fn warn(&self, messages: impl IntoIterator<Item = impl Display>) {
        messages.into_iter().for_each(|message| self.report(&format!("warning: {message}")));
    }

    /// Reports the first messages of each kind, and the number of the others. Those of a kind end alike.
    pub(crate) fn report_all(&self, messages: impl IntoIterator<Item = String>) {
        let (mut kinds, mut more) = (BTreeMap::<String, usize>::new(), 0);
        for message in messages {
            let words = message.chars().rev().filter(|c| !c.is_ascii_digit());
            let told = kinds.entry(words.take(ENDING).collect()).or_default();
            *told += 1;
            if *told <= MOST_MESSAGES && kinds.len() <= MOST_MESSAGES {
                self.report(&message);
            } else {
                more += 1;
            }
        }
        if more > 0 {
            self.report(&format!("{more} more messages"));
        }
    }
}

/// Returns whether stdout was a terminal that is gone, which answers with an input/output error.
#[cfg(unix)]
fn is_lost_terminal(error: &io::Error) -> bool {
    use std::os::unix::fs::FileTypeExt;
    const EIO: i32 = 5;
    let is_device = || {
        let metadata = std::fs::metadata("/dev/stdout");
        // the device of a lost terminal may have no name any more
        metadata.map_or(true, |metadata| metadata.file_type().is_char_device())
    };
    error.raw_os_error() == Some(EIO) && is_device()
}

#[cfg(not(unix))]
fn is_lost_terminal(_: &io::Error) -> bool {
    false
}

/// Escapes, as JSON does, the characters that a terminal would obey: control characters other than line ends
/// and tabs, and marks that reorder text.
fn printable(text: &str) -> String {
    let is_obeyed = |c: char| match c {
        '\n' | '\t' => false,
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        c => c.is_control(),
    };
    let mut printable = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) {
            // writing to a String cannot fail
            let _ = write!(printable, "\\u{:04x}", u32::from(c));
        } else {
            printable.push(c);
        }
    }
    printable
}

/// Joins an error and its causes, outermost first. A cause that already ends the text is not repeated.
pub(crate) fn message(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if !text.ends_with(&cause) {
            text = if text.is_empty() { cause } else { format!("{text}: {cause}") };
        }
    }
    text
}

/// Shortens the numbers of a message that have more digits than people write, as [`number`] does. Words that
/// contain digits, such as names of files, stay as they are.
fn with_short_numbers(message: &str) -> String {
    const MOST_DIGITS: usize = 12;
    let is_boundary = |c: char| !(c.is_alphanumeric() || matches!(c, '.' | '_' | '-' | '+' | '/' | '\\'));
    let shortened = |part: &str| {
        let (word, boundary) = part.split_at(part.trim_end_matches(is_boundary).len());
        let digits = word.chars().filter(char::is_ascii_digit).count();
        let is_number = word.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-'));
        match word.parse::<f64>() {
            Ok(value) if is_number && digits > MOST_DIGITS => number(value, MOST_DIGITS) + boundary,
            _ => part.to_owned(),
        }
    };
    message.split_inclusive(is_boundary).map(shortened).collect()
}

/// Leaves out the middle of a long message, and the end of one with many lines.
fn bounded(message: &str) -> String {
    let lines: Vec<&str> = message.lines().collect();
    let text = match lines.get(..MOST_LINES) {
        Some(first) if lines.len() > MOST_LINES => first[..MOST_LINES - 1].join("\n") + "\n…",
        _ => lines.join("\n"),
    };
    let characters: Vec<char> = text.chars().collect();
    if characters.len() <= MOST_CHARACTERS {
        return text;
    }
    let (head, tail) = (MOST_CHARACTERS * 2 / 3, MOST_CHARACTERS / 3 - 3);
    let [head, tail] = [&characters[..head], &characters[characters.len() - tail..]];
    head.iter().chain(&[' ', '…', ' ']).chain(tail).collect()
}
