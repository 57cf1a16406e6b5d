//! Tests what the parts of a study hold, and studies of many walls.

use std::fs;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::command_line::{content, folder, printed, refused, succeed};
use crate::ida::{bytes, part_files, study};

/// The parts hold the rows of levels.csv, in its order, for any reader of Parquet. Where no tie may yield,
/// nothing is said of ties.
#[test]
fn parts_hold_what_the_csv_holds() {
    let folder = study("ida_parquet");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let csv = levels(&folder);
    assert!(!csv.contains("tie") && !folder.join("out/ties.csv").exists());
}

/// Walls of a table have ties that yield, that stay elastic, or none. Only runs of the first have demands on
/// them. Bytes depend on the study alone.
#[test]
fn a_table_of_walls_names_the_parameters_of_ties() {
    let folder = folder("ida_ties");
    let study = "models = [\"CDC\", \"CDR\"]\nlevels = { method = \"grid\", values = [0.1, 0.3, 0.5] }\n\
                 intensity = { measure = \"PGA\" }\n\
                 records = { synthetic = { count = 3, duration = 10, step = 0.01 } }\n\
                 report = { resamples = 100 }\nwalls = [{ table = \"walls.csv\" }]\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let walls = "name,height,thickness,tie_height,tie_stiffness,tie_slack,tie_strength,tie_ultimate,\
                 tie_side\nyields,3,0.3,2.6,2e5,5e-3,5e2,0.05,both\nbrittle,3,0.3,2.6,2e5,5e-3,5e2,0,both\n\
                 elastic,3,0.3,2.6,2e5,5e-3,5e2,-1,both\nfree,3,0.3,,,,,,\n";
    fs::write(folder.join("walls.csv"), walls).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out", "--threads", "2"]);
    let csv = levels(&folder);
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let of = |wall: &'static str| rows.iter().filter(move |row| row[0] == wall);
    assert!(of("elastic").chain(of("free")).all(|row| row[7..] == ["", "", ""]), "{csv}");
    assert!(of("brittle").all(|row| row[8] == "0.0"));
    let count = |wall, is: fn(&Vec<&str>) -> bool| of(wall).filter(|row| is(row)).count();
    let [yielded, broken] = [count("yields", |row| row[8] != "0.0"), count("yields", |row| row[9] == "true")];
    let snapped = count("brittle", |row| row[9] == "true");
    assert!(yielded > broken && broken > 0 && snapped >= broken, "{csv}");
    let line =
        format!("ties yielded in {yielded} and broke in {} of 36 runs; see ties.csv", broken + snapped);
    assert!(told.contains(&line), "{line}: {told}");
    // two walls, two models and three levels
    let ties = content(&folder, "out/ties.csv");
    assert_eq!(ties.lines().count(), 1 + 2 * 2 * 3, "{ties}");
    let sum = |wall: &str, column: usize| -> usize {
        let cells = ties.lines().filter(|line| line.starts_with(wall));
        cells.map(|line| line.split(',').nth(column).unwrap().parse::<usize>().unwrap()).sum()
    };
    assert_eq!([sum("yields", 3), sum("yields", 4), sum("yields", 5)], [18, yielded, broken], "{ties}");
    assert!(content(&folder, "out/study.html").contains("Ties, up to overturning"));
    succeed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
    assert!(bytes(&folder.join("out")) == bytes(&folder.join("one")));
}

/// Returns levels.csv of the study `out`, once its parts are found to have the same rows.
fn levels(folder: &Path) -> String {
    let csv = content(folder, "out/levels.csv");
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
            // without the number of the combination, and the sensitivity, which collapses.csv has
            let listed = row.get_column_iter().skip(1).filter(|(name, _)| *name != "sensitivity");
            let cells: Vec<_> = listed.map(word).collect();
            assert_eq!(Some(cells.join(",").as_str()), lines.next());
        }
    }
    assert_eq!(lines.next(), None);
    csv
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

/// Samples are walls, an output, and explain θ; the bytes depend on nothing but the study.
#[test]
fn samples_of_uncertain_parameters_are_walls() {
    let folder = folder("ida_uncertain");
    let study = "models = [\"CR\"]\n\
                 levels = { method = \"hunt\", first = 0.05, increase = 0.05, top = 8 }\n\
                 intensity = { measure = \"PGA\" }\n\
                 records = { synthetic = { count = 6, duration = 12, step = 0.01 } }\n\
                 report = { resamples = 100, fractions = [0.4, 1] }\n\
                 walls = [{ name = \"a\", geometry = { height = 2, thickness = 0.3 } }]\n[uncertain]\n\
                 samples = 6\n[uncertain.parameters]\nthickness = { uniform = [0.2, 0.4] }\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out", "--threads", "2"]);
    assert!(told.contains("curves of classes of walls") && told.contains("\na      CR "), "{told}");
    let samples = content(&folder, "out/samples.csv");
    assert!(samples.starts_with("wall,of,sample,thickness\na 1,a,1,0."), "{samples}");
    assert_eq!(samples.lines().count(), 1 + 6);
    let sensitivity = content(&folder, "out/sensitivity.csv");
    // two limit states
    assert_eq!(sensitivity.lines().count(), 1 + 2, "{sensitivity}");
    assert!(content(&folder, "out/study.html").contains("Which parameter explains"));
    // killed after a part, and resumed
    let first = part_files(&folder.join("out")).remove(0);
    succeed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
    let part = first.strip_prefix(folder.join("out")).unwrap();
    fs::remove_file(folder.join("one").join(part)).unwrap();
    succeed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
    assert!(bytes(&folder.join("out")) == bytes(&folder.join("one")));
    // without uncertain parameters their files go
    let certain = study.split("[uncertain]").next().unwrap();
    fs::write(folder.join("certain.toml"), certain).unwrap();
    succeed(&folder, &["study", "ida", "certain.toml", "-o", "certain"]);
    fs::write(folder.join("certain/samples.csv"), "").unwrap();
    succeed(&folder, &["study", "ida", "certain.toml", "-o", "certain"]);
    assert!(!folder.join("certain/samples.csv").exists());
}
