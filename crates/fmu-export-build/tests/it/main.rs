//! The crate from outside: descriptions that are right, wrong in one place, and reduced.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod checks;
mod conditions;
mod fmi3;
mod generated;
#[cfg(feature = "archive")]
mod pack;
mod reduced;

use fmu_export_build::Description;

/// A description that is right.
const BLOCK: &str = include_str!("block.xml");

/// The right description with `from`, which must occur once, replaced.
fn block_with(from: &str, to: &str) -> String {
    assert_eq!(BLOCK.matches(from).count(), 1, "{from:?} must occur once");
    BLOCK.replace(from, to)
}

#[test]
fn a_right_description_is_accepted_as_it_stands_and_in_canonical_form() {
    let description = Description::parse(BLOCK).unwrap();
    let names: Vec<_> = description.variable_names().collect();
    assert_eq!(names, ["force", "x", "x_dot", "moving", "x_start", "surface", "layers", "weight"]);
    assert_eq!((description.model_name(), description.model_identifier()), ("sliding block", "block"));
    let canonical = description.to_xml();
    assert!(!canonical.contains("<!--"));
    assert_eq!(Description::parse(&canonical).unwrap().to_xml(), canonical);
}

#[test]
fn the_guid_follows_from_the_text_but_not_from_itself() {
    let description = Description::parse(BLOCK).unwrap();
    let packaged = description.text_with_guid(&description.guid());
    assert_eq!(description.declared_guid(), "{fingerprint}");
    let again = Description::parse(&packaged).unwrap();
    assert_eq!(again.declared_guid(), description.guid());
    assert_eq!(again.guid(), description.guid());
    assert_eq!(packaged.replace(&description.guid(), "{fingerprint}"), BLOCK);
    let other = Description::parse(&block_with("start=\"0.1\"", "start=\"0.2\"")).unwrap();
    assert_ne!(other.guid(), description.guid());
}
