//! Tests of files as tables.

use files::{TomlFile, check_value, names};
use serde::Deserialize;

files::tables! {
    /// A load.
    #[derive(Debug)]
    struct LoadTable {
        /// Force.
        #[key(exclusiveMinimum = 0)]
        force: f64,
        /// Where it acts.
        #[serde(rename = "at")]
        place: Option<Place>,
        /// How often it acts.
        #[serde(default)]
        #[key(maximum = 4_294_967_296_i64)]
        count: u64,
    }
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Place {
    Top,
    AtMidHeight,
}

files::choices!(Place);

#[test]
fn names_come_from_the_types_that_read_them() {
    assert_eq!(names::<LoadTable>(), ["force", "at", "count"]);
    assert_eq!(names::<Place>(), ["top", "at_mid_height"]);
    assert!(names::<f64>().is_empty());
}

#[test]
fn a_value_by_itself_is_checked_by_the_limits_of_its_key() {
    // 2³² is beyond a whole number of 32 bits
    let error = check_value::<LoadTable>("count", 4_294_967_297_u64).unwrap_err();
    assert_eq!(error, "count = 4294967297 must be at least 0 and at most 4294967296: How often it acts");
    let error = check_value::<LoadTable>("Force", 1.0).unwrap_err();
    assert_eq!(error, "unknown key \"Force\" (did you mean \"force\"?); it holds at, count, force");
}

#[test]
fn a_file_is_asked_for_its_values() {
    let file = TomlFile::new("a.toml", "force = 2.0\n[inner]\nat = \"top\"\n").unwrap();
    assert_eq!(file.get(&["inner", "at"]).and_then(|at| at.get_ref().as_str()), Some("top"));
    assert!(file.get(&["inner", "force"]).is_none() && file.get(&["force", "at"]).is_none());
    let error = file.read::<LoadTable>().unwrap_err();
    assert_eq!((error.line, error.key), (Some(2), None));
    assert_eq!(error.reason, "unknown key \"inner\"; it holds force, at, count");
}

#[test]
fn assignments_are_laid_over_a_file_one_after_another() {
    let own = "force = -2.0\nat = \"top\"\n";
    let read = |assignments: &str| {
        let text = format!("{own}{assignments}");
        TomlFile::with_assignments("a.toml", &text, own.len()).unwrap().read::<LoadTable>()
    };
    let load = read("force = 1.0\nforce = 3.0\nat = \"at_mid_height\"").unwrap();
    assert_eq!((load.force, load.place, load.count), (3.0, Some(Place::AtMidHeight), 0));
    // the value is that of the assignment, which stands below the file's own lines
    let error = read("force = 1.0\nat = \"botom\"").unwrap_err();
    assert_eq!((error.line, error.key.as_deref()), (Some(4), Some("at")));
    assert_eq!(error.reason, "at = \"botom\" is not one of \"top\", \"at_mid_height\"");
    assert!(read("").unwrap_err().to_string().starts_with("a.toml, line 1: force = -2 must be above 0"));
}
