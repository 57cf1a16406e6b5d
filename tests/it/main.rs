//! The tests of the wall, its solver and its unit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

mod capacity;
mod cases;
#[path = "../../crates/ground-motion/tests/it/chain.rs"]
mod chain;
mod closed_forms;
mod configuration;
mod demands;
mod description;
mod floor_motion;
mod model_exchange;
mod numerics;
mod one_sided;
mod overturning;
mod page;
mod properties;
mod record_path;
mod ties;
mod trigonometric;
mod unit;
mod warnings;
mod wiring;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
