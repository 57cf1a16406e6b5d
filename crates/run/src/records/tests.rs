//! Tests the patterns of record files.

use std::fs;
use std::path::Path;

use super::files;

/// Marks of patterns in the name of the study's folder, and brackets in that of a record, are none.
#[test]
fn only_the_pattern_is_one() {
    let folder = std::env::temp_dir().join(format!("rocking wall [2024] {}", std::process::id()));
    let inner = folder.join("[a] b");
    fs::create_dir_all(&inner).unwrap();
    for name in ["x.AT2", "[y].AT2", "z.txt"] {
        fs::write(inner.join(name), "").unwrap();
    }
    let names = |folder: &Path, pattern: &str| -> Vec<String> {
        let found = files(folder, pattern).unwrap_or_default();
        found.iter().map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect()
    };
    assert_eq!(names(&inner, "*.AT2"), ["[y].AT2", "x.AT2"]);
    assert_eq!(names(&folder, "[a] ?/*.AT2"), ["[y].AT2", "x.AT2"]);
    assert_eq!(names(&inner, "?.AT2"), ["x.AT2"]);
    assert_eq!(names(&inner, "[y].*"), ["[y].AT2"]);
    assert_eq!(names(&folder, "[a] b"), ["[y].AT2", "x.AT2", "z.txt"]);
    assert_eq!(names(&inner, "[xy].AT2"), Vec::<String>::new());
    let absolute = inner.join("*.AT2").to_str().unwrap().to_owned();
    assert_eq!(names(Path::new("elsewhere"), &absolute), ["[y].AT2", "x.AT2"]);
    fs::remove_dir_all(&folder).unwrap();
}
