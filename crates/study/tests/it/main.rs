//! The tests of studies and checks.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

#[path = "../../../../tests/it/broken.rs"]
mod broken;
mod calibration;
mod cloud;
#[path = "../../../../tests/it/configuration.rs"]
mod configuration;
mod coverage;
mod estimators;
mod fragility;
mod ida;
mod margins;
mod messages;
mod polarity;
mod record_files;
mod reliability;
mod reliability_tables;
mod rocking_spectrum;
mod sensitivity;
mod storeys;
mod ties;
mod uncertain;
