//! The tests of checks.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

#[path = "../../../../tests/it/broken.rs"]
mod broken;
mod circolare;
mod circolare_bodies;
mod circolare_body_ties;
mod circolare_cases;
mod circolare_dynamic;
mod circolare_edges;
mod circolare_hinge_cases;
mod circolare_hinges;
mod circolare_mechanisms;
mod circolare_messages;
mod circolare_properties;
mod circolare_ranges;
mod circolare_refusals;
mod circolare_site;
mod circolare_target;
mod circolare_ties;
mod circolare_warnings;
mod codes;
mod formulas;
mod messages;
mod report;
