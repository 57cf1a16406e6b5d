//! The tests of ground motions.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

mod chain;
#[path = "../../../../tests/it/configuration.rs"]
mod configuration;
mod damaged_records;
mod motion;
mod pulse;
mod record_at2;
mod record_csv;
mod record_file;
mod record_formats;
mod record_real;
mod records;
mod specimen;
mod spectrum;
mod storeys;
mod synthetic;
