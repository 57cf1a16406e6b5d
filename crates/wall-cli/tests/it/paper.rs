//! `wall study calibrate`, and what `wall verify paper` refuses; tests/python has its page.

use crate::command_line::{assert_has, content, folder, printed, refused, rows};

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

#[test]
fn reproduce_refuses_a_folder_without_records() {
    let folder = folder("reproduce_refused");
    refused(&folder, &["verify", "paper", "--records", "none"], &["none", "cannot be read"]);
    std::fs::create_dir(folder.join("empty")).unwrap();
    refused(&folder, &["verify", "paper", "--records", "empty"], &["empty", "AT2"]);
}
