//! The tests of comparisons: formulas, published tests, the paper, errors of the solvers.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

mod accuracy;
mod extremes;
mod figure_15;
mod linearisation;
#[path = "../../../ground-motion/tests/it/records.rs"]
mod records;
mod reproduce;
mod validation;
mod verification;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
