//! The tests of how safe walls are that just pass a check.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

mod asked;
#[path = "../../../study/tests/it/folders.rs"]
mod folders;
mod margins;
mod tables;
#[path = "../../../study/tests/it/uplift.rs"]
mod uplift;
