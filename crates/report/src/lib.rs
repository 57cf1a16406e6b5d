#![doc = include_str!("../README.md")]
//!
//! # Modules
//! ```text
//! values ─► Table ─► terminal · CSV · JSON · HTML · Markdown
//! values ─► Plot ─► inline SVG for a page · picture (SVG) for a file
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`mod@table`] | tables: columns, cells, and the forms they are shown in |
//! | [`mod@plot`] | lines and marks over two axes; with title and legend a figure |
//! | [`heat_map`] | cells in colours, and the scale of these colours |
//! | [`sheet`] | drawings side by side in a file |
//! | [`points`] | lines with fewer points that look the same |
//! | [`palette`] | the colours and marks of all of them |
//! | [`mod@page`] | pages of a title, an introduction and sections |
//! | [`template`] | pages with a body of their own: their head and style, and the gaps of a template |
//! | [`moving`] | pages with a moving picture |

mod axes;
mod figure;
mod frame;
pub mod heat_map;
pub mod moving;
pub mod page;
pub mod palette;
pub mod plot;
pub mod points;
mod series;
pub mod sheet;
pub mod table;
pub mod template;

pub use axes::{apart, label, number, ticks};

/// Escapes text for markup.
///
/// ```
/// assert_eq!(report::escaped("a < b"), "a &lt; b");
/// ```
pub fn escaped(text: &str) -> String {
    // what XML cannot hold
    let cannot =
        |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r') || matches!(c, '\u{fffe}' | '\u{ffff}');
    text.replace(cannot, "\u{fffd}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// What a table that may scroll begins with: the keyboard reaches it.
pub const SCROLLS: &str = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"table\">";

/// Returns a count with its noun.
///
/// ```
/// assert_eq!([1, 2].map(|count| report::counted(count, "record")), ["1 record", "2 records"]);
/// ```
pub fn counted(count: impl std::fmt::Display, noun: &str) -> String {
    let text = format!("{count} {noun}");
    if text.starts_with("1 ") { text } else { text + "s" }
}

/// Breaks a text into lines of at most `width` characters, if its words are not longer.
///
/// ```
/// assert_eq!(report::wrapped("one two three", 7), ["one two", "three"]);
/// ```
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                *line = format!("{line} {word}");
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
