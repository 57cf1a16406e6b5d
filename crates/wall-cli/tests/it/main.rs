//! The tests of the program `wall`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

mod building;
mod check;
mod check_before;
mod check_languages;
mod check_report;
mod check_report_walls;
mod command_line;
mod describe;
mod files;
mod given_files;
mod hazard;
mod ida;
mod measure;
mod overturning;
mod paper;
mod record;
mod risk;
mod signs;
mod simulate;
#[allow(dead_code, reason = "the tests of the readers use more of it")]
#[path = "../../../ground-motion/tests/it/specimen.rs"]
mod specimen;
mod spectrum;
mod standard_output;
mod study_inputs;
mod study_parts;
mod validate;
mod verify;
mod warnings;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
