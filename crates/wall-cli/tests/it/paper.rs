//! `wall study calibrate` and `wall verify paper`.

use std::fmt::Write;
use std::path::Path;

use crate::command_line::{assert_has, content, folder, printed, refused, rows, succeed, text};

#[test]
fn calibrate_writes_a_table_a_csv_and_a_page() {
    let folder = folder("calibrate");
    std::fs::write(
        folder.join("strip.toml"),
        "title = \"A <strip>\"\n[geometry]\nmechanism = \"vertical_spanning\"\n",
    )
    .unwrap();
    let arguments = [
        "study",
        "calibrate",
        "strip.toml",
        "--set",
        "thickness=0.3",
        "--models",
        "constant_ratio",
        "--threads",
        "1",
    ];
    let lists = ["--restitution", "0.85,0.9", "--a1", "0.02,0.05", "--csv", "c.csv", "--html", "c.html"];
    let table = printed(&folder, &[&arguments[..], &lists[..]].concat());
    assert_has(&table, &["constant_ratio (CDR)", "(paper: 0.35 a1^0.074)"]);
    let rows = rows(&folder, "c.csv");
    assert_eq!(rows.len(), 4);
    for row in &rows {
        let [e, xi]: [f64; 2] = [row[3].parse().unwrap(), row[4].parse().unwrap()];
        // x of CDR is 0.25 to 0.28 for these a1
        assert!((0.22..0.30).contains(&(-xi / e.ln())), "{row:?}");
    }
    let page = content(&folder, "c.html");
    assert_eq!(page.matches("<figure>").count(), 3, "over e, errors, over a1");
    assert!(page.contains("A &lt;strip&gt;") && !page.contains("{{") && !page.contains("NaN"));
}

#[test]
fn a_rigid_wall_is_calibrated_for_c_bar() {
    let folder = folder("calibrate_rigid");
    let arguments = ["study", "calibrate", "--set", "force_law=rigid_linear", "--restitution", "0.9"];
    assert_has(&printed(&folder, &arguments), &["free_standing_block"]);
}

#[test]
fn calibrate_refuses_what_it_cannot_use() {
    let folder = folder("calibrate_refused");
    refused(&folder, &["study", "calibrate", "none.toml"], &["none.toml"]);
    refused(&folder, &["study", "calibrate", "--models", "cdr"], &["cdr", "constant_ratio"]);
    refused(&folder, &["study", "calibrate", "--models", "none"], &["none", "constant_ratio"]);
    refused(
        &folder,
        &["study", "calibrate", "--restitution", "1.2", "--html", "c.html"],
        &["e = 1.2", "below 1"],
    );
    refused(&folder, &["study", "calibrate", "--a1", "0.95", "--set", "a3=0.9"], &["a1"]);
    let rigid = ["study", "calibrate", "--set", "force_law=rigid_linear", "--models", "constant_ratio"];
    refused(&folder, &rigid, &["rigid", "free_standing_block"]);
}

/// An AT2 file of a pulse train.
fn record(path: &Path) {
    let mut content =
        String::from("PEER\nA TEST\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 1000, DT= .01 SEC\n");
    for index in 0..1000 {
        let time = f64::from(index) * 0.01;
        let sample = 0.3 * (7.0 * time).sin() * (std::f64::consts::PI * time / 10.0).sin();
        let _ = write!(content, "{sample:15.7E}{}", if index % 5 == 4 { "\n" } else { "" });
    }
    std::fs::write(path, content).unwrap();
}

/// One run shows the page and the words, which say how many numbers agree, and why: it takes seconds.
#[test]
fn reproduce_writes_one_page_of_everything_and_explains_deviations() {
    let folder = folder("reproduce");
    std::fs::create_dir(folder.join("records")).unwrap();
    record(&folder.join("records/a.AT2"));
    std::fs::write(folder.join("records/notes.md"), "# no record\n").unwrap();
    let output = succeed(&folder, &["verify", "paper", "--records", "records", "-o", "paper.html"]);
    assert_has(&text(&output.stderr), &["left out", "notes.md"]);
    let told = text(&output.stdout);
    assert_has(&told, &["Table 1", "Table 5", "Equations (20) to (23)", "Medians"]);
    let (told, _) = told.split_once("Figures 2, ").unwrap();
    let tables: Vec<_> = told.lines().filter(|line| line.contains("round to print")).collect();
    assert_eq!(tables.len(), 7, "{told}");
    let table_1 = told.lines().skip_while(|line| !line.starts_with("Table 1")).nth(1).unwrap();
    assert!(table_1.starts_with("    "), "{told}");
    assert!(told.lines().all(|line| line.chars().count() <= 160), "{told}");
    let page = content(&folder, "paper.html");
    assert!(page.len() < 3 << 20, "{} bytes", page.len());
    assert!(!page.contains("{{") && !page.contains("NaN") && !page.contains("inf"), "a place left open");
    for number in 2..=15 {
        assert_eq!(page.matches(&format!("id=\"figure-{number}\"")).count(), 1, "Figure {number}");
    }
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

#[test]
fn reproduce_refuses_a_folder_without_records() {
    let folder = folder("reproduce_refused");
    refused(&folder, &["verify", "paper", "--records", "none"], &["none", "cannot be read"]);
    std::fs::create_dir(folder.join("empty")).unwrap();
    refused(&folder, &["verify", "paper", "--records", "empty"], &["empty", "AT2"]);
}
