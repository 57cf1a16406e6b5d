//! The tests of studies, checks and comparisons.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

mod accuracy;
#[path = "../../../../tests/it/broken.rs"]
mod broken;
mod calibration;
mod circolare;
mod circolare_cases;
mod circolare_dynamic;
mod circolare_properties;
mod circolare_refusals;
#[path = "../../../../tests/it/configuration.rs"]
mod configuration;
mod extremes;
mod figure_15;
mod fragility;
mod ida;
mod linearisation;
mod messages;
mod record_files;
#[path = "../../../ground-motion/tests/it/records.rs"]
mod records;
mod reproduce;
mod rocking_spectrum;
mod storeys;
mod validation;
mod verification;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
