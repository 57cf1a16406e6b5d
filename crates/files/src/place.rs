//! Where something stands in a file.

use std::ops::Range;

use crate::error::FileError;

/// A file's name and text, to turn byte ranges into lines.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Place<'a> {
    /// Makes the place of a text: that of a file or of a part of one, with the file's name.
    pub fn new(name: &'a str, text: &'a str) -> Self {
        Self { name, text }
    }

    /// Returns the file's name.
    pub fn name(&self) -> &'a str {
        self.name
    }

    /// Returns the file's text.
    pub fn text(&self) -> &'a str {
        self.text
    }

    /// Returns the 1-based line at which a byte range starts.
    pub fn line(&self, span: Range<usize>) -> usize {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        before.split(|&byte| byte == b'\n').count()
    }

    /// Returns an error that names the file and the line of a byte range.
    pub fn error(&self, span: Range<usize>, reason: impl Into<String>) -> FileError {
        self.error_on(self.line(span), reason)
    }

    /// Returns an error that names the file and a line of it.
    pub fn error_on(&self, line: usize, reason: impl Into<String>) -> FileError {
        let key = self.text.lines().nth(line - 1).and_then(|text| text.split_once('='));
        let key = key.map(|(key, _)| key.trim().to_owned());
        FileError { key, ..FileError::on_line(self.name, line, reason) }
    }
}
