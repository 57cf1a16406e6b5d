//! Tests of the repository: sizes, documents, manifests, notices, imports.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::Path;
use std::process::Command;

mod documents;
mod generated;
mod imports;
mod manifest;
mod notices;
mod signatures;
mod tidy;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns the text of a file of the project.
fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap()
}

/// Returns what a job of cargo prints, with more arguments at its end.
fn cargo(job: &[&str], more: &[&str]) -> String {
    let output = Command::new(env!("CARGO")).current_dir(root()).args(job).args(more).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}
