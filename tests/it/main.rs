//! The tests of the library.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

mod building_command;
mod building_run;
mod calibration;
mod capacity;
mod cases;
mod check_command;
mod closed_forms;
mod command_line;
mod demands;
mod description;
mod documents;
mod extremes;
mod figure_15;
mod files_command;
mod floor_motion;
mod fragility;
mod ground_motion;
mod ida;
mod ida_command;
mod imports;
mod manifest;
mod measure_command;
mod model_exchange;
mod notices;
mod numerics;
mod one_sided;
mod overturning;
mod paper_commands;
mod properties;
mod record_command;
mod record_path;
mod reproduce;
mod risk;
mod rocking_spectrum;
mod standard_output;
mod study_parts;
mod tidy;
mod ties;
mod trigonometric;
mod unit;
mod validation;
mod warnings;
mod wiring;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
