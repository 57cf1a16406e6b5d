//! Files that are read into memory whole.

use std::fs::{File, metadata};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

use crate::error::{Fault, GroundMotionError};

/// Largest file that is read: about four million samples in AT2, hours of shaking.
pub const MAX_FILE_BYTES: u64 = 64 << 20;

/// Reads a regular file of at most `limit` bytes; `what` says in messages what it should be.
///
/// Anything else is refused before it is opened: opening a pipe waits for its other end, and a device never
/// ends.
///
/// ```
/// let error = ground_motion::read_file(&std::env::temp_dir(), "a table", 1000).unwrap_err();
/// assert_eq!(error.to_string(), "expected a table of at most 1000 bytes, found a folder");
/// ```
///
/// # Errors
/// If the file cannot be read; [`ErrorKind::InvalidInput`] if it is not a regular file, or too large.
pub fn read_file(path: &Path, what: &str, limit: u64) -> Result<Vec<u8>> {
    let refused = |found: &str| {
        let message = format!("expected {what} of at most {limit} bytes, found {found}");
        Err(Error::new(ErrorKind::InvalidInput, message))
    };
    let metadata =
        metadata(path).map_err(|error| Error::new(error.kind(), format!("{error}{}", escapes(path))))?;
    if metadata.is_dir() {
        return refused("a folder");
    }
    if !metadata.is_file() {
        return refused("a pipe or device; save its content to a file first");
    }
    if metadata.len() > limit {
        return refused(&metadata.len().to_string());
    }
    // The limit holds while reading too: a file may grow, or state no length.
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { refused("more") } else { Ok(bytes) }
}

/// Says of a path that cannot be read what is unusual about it: a line break or a tab, a home folder, a web
/// address, a blank at an end.
///
/// ```
/// assert!(ground_motion::escapes("records\new.AT2".as_ref()).contains("single quotes"));
/// ```
pub fn escapes(path: &Path) -> &'static str {
    let path = path.to_string_lossy();
    let has_part = |is: fn(&str) -> bool| path.split('/').any(is);
    match () {
        () if path.contains(char::is_control) => {
            "; in TOML, \\n and \\t in double quotes are a line break and a tab: write / or single quotes"
        }
        () if path.contains("://") => "; web addresses are not read: fetch the file and give its path",
        () if has_part(|part| part.starts_with(['~', '$', '%'])) => {
            "; `~` and variables are not replaced: write them out"
        }
        () if path.is_empty() || has_part(|part| part.trim() != part) => {
            "; the path is empty, or has a blank at an end"
        }
        () => "",
    }
}

/// Returns the name of a path for messages, on one line.
///
/// ```
/// assert_eq!(ground_motion::shown_path("records\new.AT2".as_ref()), "records\\new.AT2");
/// ```
pub fn shown_path(path: &Path) -> String {
    let shown = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    path.to_string_lossy().chars().map(shown).collect()
}

/// Returns the name of a file without its folder.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// Returns the text of bytes in UTF-8; `what` says in messages what it should be. Bytes in UTF-16, and those
/// of Windows-1252, in which Excel saves CSV, are named for what they are.
///
/// ```
/// let error = ground_motion::utf8_text(b"M\xfcller,3".to_vec(), "a table").unwrap_err();
/// assert!(error.to_string().contains("Windows-1252") && error.line() == 1);
/// ```
///
/// # Errors
/// [`Fault`] if the bytes are not UTF-8.
pub fn utf8_text(bytes: Vec<u8>, what: &str) -> std::result::Result<String, Fault> {
    let expected = "text in UTF-8";
    check_is_text(&bytes, expected, &format!("this is a binary file: give {what}"))?;
    String::from_utf8(bytes).map_err(|error| {
        let (bytes, at) = (error.as_bytes(), error.utf8_error().valid_up_to());
        let found = format!("the byte 0x{:02x}, as in Windows-1252 or Latin-1", bytes[at]);
        Fault::new(line_of(bytes, at), expected, found, SAVE_AS_UTF8)
    })
}

const SAVE_AS_UTF8: &str = "save the file as UTF-8 (Excel: \"CSV UTF-8\")";

/// Returns whether bytes are UTF-16: by their mark, or by a zero beside each of the first letters.
fn is_utf16(bytes: &[u8]) -> bool {
    let is_letter = |byte: u8| matches!(byte, b'\t' | b'\n' | b'\r' | 0x20..=0x7e);
    match *bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        [0, first, 0, second, ..] | [first, 0, second, 0, ..] => is_letter(first) && is_letter(second),
        _ => false,
    }
}

/// Refuses bytes that are no text in UTF-8 or another encoding with ASCII; `expected` and `remedy` are the
/// words of the message about a byte that no text has.
pub(crate) fn check_is_text(bytes: &[u8], expected: &str, remedy: &str) -> std::result::Result<(), Fault> {
    if is_utf16(bytes) {
        return Err(Fault::new(1, "text in UTF-8", "UTF-16, which Excel calls Unicode text", SAVE_AS_UTF8));
    }
    if let Some([what, remedy]) = named(bytes) {
        return Err(Fault::new(1, expected, what, remedy));
    }
    let is_text = |byte| matches!(byte, b'\n' | b'\t' | b'\r' | 0x0c | 0x20..=0x7e | 0x80..);
    let Some(at) = bytes.iter().position(|&byte| !is_text(byte)) else { return Ok(()) };
    Err(Fault::new(line_of(bytes, at), expected, format!("the byte 0x{:02x}", bytes[at]), remedy))
}

/// Names what is no text by its first bytes, with the remedy.
fn named(bytes: &[u8]) -> Option<[&'static str; 2]> {
    const WAVEFORMS: &str = "read it with ObsPy, and in Python take rw.Record.from_trace(trace, unit); or \
                             write two columns, times and accelerations";
    const PAGE: &str = "where a site asks for a login, this page comes instead: fetch the file again";
    let starts = |starts: &[&[u8]]| starts.iter().any(|start| bytes.starts_with(start));
    let page = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let is_number = |bytes: &[u8]| bytes.iter().all(|byte| byte.is_ascii_digit() || *byte == b' ');
    let is_miniseed = matches!(bytes.get(6..8), Some([b'D' | b'R' | b'Q' | b'M', b' ' | 0]))
        && is_number(&bytes[..6])
        && bytes.contains(&0);
    // the version of the header is 6
    let is_sac = bytes.len() > 632 && matches!(bytes[304..308], [6, 0, 0, 0] | [0, 0, 0, 6]);
    match () {
        () if starts(&[b"\x1f\x8b", b"BZh", b"\xfd7zXZ"]) => {
            Some(["a compressed file", "decompress it first"])
        }
        () if starts(&[b"PK\x03\x04", b"PK\x05\x06", b"7z\xbc\xaf", b"Rar!", b"\xd0\xcf\x11\xe0"]) => Some([
            "an archive or a workbook (.zip, .xlsx, .xls)",
            "unpack the archive, or save the sheet as CSV UTF-8",
        ]),
        () if is_miniseed || starts(&[b"MS\x03"]) => Some(["miniSEED", WAVEFORMS]),
        () if is_sac => Some(["SAC", WAVEFORMS]),
        () if page.starts_with(b"<") => Some(["a web page or XML", PAGE]),
        () => None,
    }
}

/// Returns the line, from 1, of a place in bytes.
fn line_of(bytes: &[u8], at: usize) -> usize {
    bytes[..at].split(|&byte| byte == b'\n').count()
}

/// Reads a record file, or one beside it.
pub(crate) fn read_bounded(path: &Path, name: &str) -> std::result::Result<Vec<u8>, GroundMotionError> {
    read_file(path, "a record", MAX_FILE_BYTES)
        .map_err(|reason| GroundMotionError::Io { file: name.to_owned(), reason })
}
