//! Tests of the repository: sizes, documents, manifests, notices, imports.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::Path;

mod documents;
mod imports;
mod manifest;
mod notices;
mod tidy;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}
