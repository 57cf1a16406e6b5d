//! The tests of ground motions.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use ground_motion::{Record, RecordOptions, parse};

mod chain;
#[path = "../../../../tests/it/configuration.rs"]
mod configuration;
mod damaged_records;
mod inputs;
mod intensity;
mod motion;
mod pulse;
mod record_agencies;
mod record_at2;
mod record_csv;
mod record_file;
mod record_formats;
mod record_real;
mod records;
mod silent;
mod specimen;
mod spectrum;
mod spectrum_file;
mod spoiled;
mod storeys;
mod synthetic;

/// Reads a text as the file of a name.
fn read(name: &str, text: &str, options: &RecordOptions) -> Result<Record, String> {
    parse(name, text.as_bytes().to_vec(), options).map_err(|error| error.to_string())
}

/// Checks that a message has all of some words.
#[track_caller]
fn assert_mentions(error: &str, words: &[&str]) {
    for word in words {
        assert!(error.contains(word), "`{word}` is missing in: {error}");
    }
}
