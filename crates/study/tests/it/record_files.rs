//! The files of a study: records, folders and patterns of them, a table of walls.

use std::fs;
use std::path::{Path, PathBuf};

use study::codes::NoCodes;
use study::loaded::LoadedStudy;

/// A folder with a horizontal and two vertical records, and with one that has its times beside it.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("records")).unwrap();
    let at2 = |direction: &str| {
        format!("A\nNowhere, 1/1/2001, Hill, {direction}\nUNITS OF G\nNPTS= 3, DT= .01 SEC\n0 0.1 0\n")
    };
    let write = |name: &str, text: &str| fs::write(folder.join("records").join(name), text).unwrap();
    write("a.AT2", &at2("90"));
    write("b.AT2", &at2("UP"));
    write("x-V.AT2", &at2("90"));
    write("acc_1.csv", "0\n0.1\n0\n");
    write("dts_1.csv", "0.01\n0.02\n0.03\n");
    folder
}

/// Names of the records, and warnings.
fn loaded(folder: &Path, files: &str) -> Result<(Vec<String>, String), String> {
    let text = format!(
        "models = [\"CDC\"]\nlevels = {{ method = \"grid\", values = [0.1] }}\n\
         records = {{ files = [{files}], unit = \"g\" }}\n\
         [[walls]]\nname = \"w\"\ngeometry = {{ height = 2, thickness = 0.3 }}\n"
    );
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    let study = LoadedStudy::read(&path, &NoCodes).map_err(|error| error.to_string())?;
    let names = study.study.records().iter().map(|record| record.name.clone()).collect();
    Ok((names, study.warnings.join("\n")))
}

/// Vertical records of a folder or a pattern are left out and named; one that is named itself is used, with a
/// warning. The times beside a record are no record.
#[test]
fn vertical_files_of_a_folder_are_left_out() {
    let folder = folder("study_records");
    for files in ["\"records\"", "\"records/*\""] {
        let (names, warnings) = loaded(&folder, files).unwrap();
        assert_eq!(names, ["a.AT2", "acc_1.csv"], "{files}");
        for name in ["b.AT2", "x-V.AT2"] {
            assert!(warnings.contains(&format!("{name}: vertical, left out; name the file")), "{warnings}");
        }
    }
    for files in ["\"records/b.AT2\"", "\"records/?.AT2\", \"records/b.AT2\""] {
        let (names, warnings) = loaded(&folder, files).unwrap();
        assert_eq!(names.last().unwrap(), "b.AT2", "{files}");
        assert!(warnings.contains("b.AT2: vertical: this component is vertical"), "{warnings}");
    }
    let error = loaded(&folder, "\"records/b*\"").unwrap_err();
    assert!(error.contains("all are vertical") && error.contains("name horizontal ones"), "{error}");
}

/// The study passes the warnings of a table of walls on.
#[test]
fn a_table_of_walls_without_a_column_is_warned_of() {
    let folder = folder("study_table");
    fs::write(folder.join("walls.csv"), "name,height\na,2\nb,3\n").unwrap();
    let path = folder.join("study.toml");
    let text = "models = [\"CDC\"]\nlevels = { method = \"grid\", values = [0.1] }\n\
                records = { files = [\"records/a.AT2\"] }\nwalls = [{ table = \"walls.csv\" }]\n";
    fs::write(&path, text).unwrap();
    let warnings = LoadedStudy::read(&path, &NoCodes).unwrap().warnings.join("\n");
    assert!(warnings.contains("study.toml: 2 of 2 walls have no thickness"), "{warnings}");
}
