//! The tests of studies.

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
mod folders;
mod fragility;
mod ida;
mod measures;
mod messages;
mod polarity;
mod record_files;
mod rocking_spectrum;
mod selections;
mod sensitivity;
mod sequences;
mod storeys;
mod stripes;
mod ties;
mod uncertain;
mod uplift;
mod variance;
mod weights;
