//! Stands in for `part` in a program without Parquet, as that of `cargo xtask demo`.

use study::ida::Curve;

use crate::contents::Contents;
use crate::error::FolderError;

/// Refuses to write a part.
///
/// # Errors
/// Always: there is no Parquet to write.
pub fn encode(_: &Contents, _: &str, part: usize, _: &[Curve]) -> Result<Vec<u8>, FolderError> {
    let reason = "this program has no Parquet; build it with `cargo build --release --bin wall`";
    Err(FolderError::Parquet { part, source: reason.into() })
}

/// Finds no part: there is no Parquet to read.
pub fn decode(_: &Contents, _: &str, _: usize, _: Vec<u8>) -> Option<Vec<Curve>> {
    None
}
