//! The crate from outside: descriptions that are right, wrong in one place, and reduced.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[cfg(feature = "archive")]
mod archive;
mod checks;
mod conditions;
mod fmi3;
mod generated;
#[cfg(feature = "archive")]
mod pack;
mod reduced;

use fmu_export_build::Description;
use std::path::PathBuf;

/// A description that is right.
const BLOCK: &str = include_str!("block.xml");

/// A text with double quotes for its single ones.
fn quoted(text: &str) -> String {
    text.replace('\'', "\"")
}

/// Returns the right description with `from`, which must occur once, replaced; both have single quotes for
/// double ones.
fn block_with(from: &str, to: &str) -> String {
    let [from, to] = [from, to].map(quoted);
    assert_eq!(BLOCK.matches(&from).count(), 1, "{from:?} must occur once");
    BLOCK.replace(&from, &to)
}

/// The right description for Model Exchange too, with 4 event indicators.
fn exchange() -> String {
    let both = "guid='{fingerprint}' numberOfEventIndicators='4'><ModelExchange modelIdentifier='block'/>";
    block_with("guid='{fingerprint}'>", both)
}

/// A folder of its own for a test, which goes with this.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("fmu-export-build-{test}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
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
    let other = Description::parse(&block_with("start='0.1'", "start='0.2'")).unwrap();
    assert_ne!(other.guid(), description.guid());
}
