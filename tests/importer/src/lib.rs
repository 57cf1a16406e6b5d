//! Tests only: see `tests/drive.rs`.
