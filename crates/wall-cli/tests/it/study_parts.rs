//! Tests what the parts of a study hold, and studies of many walls.

use std::fs;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::command_line::{content, folder, printed, refused, succeed};
use crate::ida::{bytes, part_files, study};

/// The parts hold the rows of levels.csv, in its order, for any reader of Parquet.
#[test]
fn parts_hold_what_the_csv_holds() {
    let folder = study("ida_parquet");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let csv = content(&folder, "out/levels.csv");
    let mut lines = csv.lines().skip(1);
    let word = |(name, field): (&String, &Field)| match field {
        Field::Str(text) if text.contains(',') => format!("\"{text}\""),
        Field::Str(text) => text.clone(),
        Field::Double(number) if name == "intensity_m_s2" => {
            format!("{:?}", number / ::ground_motion::STANDARD_GRAVITY)
        }
        Field::Double(number) => format!("{number:?}"),
        Field::Bool(flag) => flag.to_string(),
        Field::Null => String::new(),
        other => panic!("{other:?}"),
    };
    for part in part_files(&folder.join("out")) {
        let reader = SerializedFileReader::new(fs::File::open(part).unwrap()).unwrap();
        for row in reader.get_row_iter(None).unwrap() {
            let row = row.unwrap();
            let cells: Vec<_> = row.get_column_iter().skip(1).map(word).collect();
            assert_eq!(Some(cells.join(",").as_str()), lines.next());
        }
    }
    assert_eq!(lines.next(), None);
}

/// Many walls from a table: their page shows distributions, and the bytes depend on nothing but the study.
#[test]
fn a_large_study_shows_distributions() {
    let folder = folder("ida_large");
    let study = "models = [\"CR\", \"CDC\"]\nlevels = { method = \"step\", step = 0.4, top = 2 }\n\
                 records = { synthetic = { count = 2, duration = 10, step = 0.02 } }\n\
                 report = { resamples = 100 }\nwalls = [{ table = \"walls.csv\" }]\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let wall_row = |k: u32| format!("wall {k},{},0.3\n", 2.0 + 0.05 * f64::from(k));
    let rows: String = (0..41).map(wall_row).collect();
    fs::write(folder.join("walls.csv"), format!("name,height,thickness\n{rows}")).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out", "--threads", "2"]);
    assert!(told.contains("of the walls have a lower median") && !told.contains("wall 7"), "{told}");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
    assert!(bytes(&folder.join("out")) == bytes(&folder.join("one")));
    let page = content(&folder, "out/study.html");
    // one for each limit state, and the dispersions
    assert_eq!(page.matches("<svg").count(), 5);
    assert!(page.contains("41 walls") && page.contains("lowest medians"));
    assert!(page.contains("<td>wall 2</td>"));
    assert!(!page.contains("NaN") && !page.contains("inf"));
    // the table is an input, and no place for results
    refused(&folder, &["study", "ida", "study.toml", "-o", "walls.csv"], &["walls.csv"]);
}
