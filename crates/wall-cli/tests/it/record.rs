//! `wall record`: its table, its files, and what it refuses.

use std::fs;
use std::path::PathBuf;

use crate::command_line::{
    assert_has, content, fails, folder, json, printed, program, refused, succeed, text,
};
use crate::specimen::{self, SAMPLES};

/// A folder with two channels in CSMIP, one record in AT2 and one column of numbers.
fn records(name: &str) -> PathBuf {
    let folder = folder(name);
    let two = specimen::csmip_channels(&[(1, " 90 Deg", &SAMPLES), (2, " Up", &SAMPLES[..8])]);
    fs::write(folder.join("two.V2"), two).unwrap();
    fs::write(folder.join("one.AT2"), specimen::at2(&SAMPLES)).unwrap();
    fs::write(folder.join("column.csv"), "0.1\n-0.25\n0.1\n").unwrap();
    folder
}

#[test]
fn the_table_lists_every_channel() {
    let folder = records("record_table");
    let table = printed(&folder, &["record", "two.V2", "one.AT2", "--periods", "0.3,1.5"]);
    let lines: Vec<_> = table.lines().collect();
    for (line, words) in [
        (0, &["file", "format", "points", "step [s]", "PGA [g]", "AvgSA", "Sa(0.3 s)", "Sa(1.5 s)"][..]),
        (1, &["two.V2 [1: 90 Deg]", "CSMIP V2", " 11 ", " 0.01 ", " 0.100 ", " 0.10529 "]),
        (2, &["two.V2 [2: Up]", " 8 ", " 0.070 "]),
        (3, &["one.AT2", "PEER AT2", " 11 ", " 0.10529 "]),
        (4, &["5 % damping", "0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4 s"]),
    ] {
        assert_has(lines[line], words);
    }
    // The eight samples end during the strong motion.
    assert_has(&table, &["check    two.V2 [2: Up]: ", "is the end missing?"]);
}

/// A step that is too long for an oscillator is one of a file.
#[test]
fn a_long_step_names_its_file() {
    let folder = records("record_long_step");
    let arguments = ["record", "one.AT2", "column.csv", "--unit", "cm/s2", "--record-step", "6"];
    let words = ["column.csv: ", "at most 500 periods", "one.AT2, line 4: expected the stated step of 6 s"];
    fails(&folder, &[&arguments[..], &["--periods", "0.01"]].concat(), &words);
}

#[test]
fn json_and_csv_hold_the_same_numbers() {
    let folder = records("record_json");
    let value = json(&folder, &["record", "two.V2", "--channel", "1", "--json", "--csv", "table.csv"]);
    let record = &value["records"][0];
    assert_eq!(value["records"].as_array().unwrap().len(), 1);
    assert_eq!(record["channel"], "1: 90 Deg");
    assert_eq!(record["points"], 11);
    assert!((record["pga_g"].as_f64().unwrap() - 103.25 / 980.665).abs() < 1e-12);
    let csv = content(&folder, "table.csv");
    let mut lines = csv.lines();
    let columns = "file,channel,format,points,step_s,duration_s,pga_g,average_sa_g,sa_0.2s_g";
    assert!(lines.next().unwrap().starts_with(columns));
    let cells: Vec<_> = lines.next().unwrap().split(',').collect();
    assert_eq!(cells[..6], ["two.V2", "1: 90 Deg", "csmip", "11", "0.01", "0.1"]);
    assert_eq!(cells[7].parse::<f64>().unwrap(), record["average_sa_g"].as_f64().unwrap());
    assert_eq!(cells[8].parse::<f64>().unwrap(), record["sa_g"][0].as_f64().unwrap());
}

#[test]
fn plots_are_svg() {
    let folder = records("record_plot");
    let table = printed(&folder, &["record", "two.V2", "one.AT2", "--plot", "plot.svg"]);
    assert!(table.contains("written  plot.svg"));
    let svg = content(&folder, "plot.svg");
    assert_has(&svg, &["two.V2 [1: 90 Deg]", "one.AT2", "time (s)", "period T (s)", "Sa (g)"]);
    // With more records than colours, the plot shows the median of those that are not vertical.
    let many = [
        "record", "one.AT2", "one.AT2", "one.AT2", "two.V2", "two.V2", "two.V2", "two.V2", "--plot",
        "many.svg",
    ];
    succeed(&folder, &many);
    assert!(content(&folder, "many.svg").contains("median of 7 horizontal records"));
}

/// 100 times 0.07 is 7.000000000000001.
#[test]
fn percentages_are_printed_as_people_write_them() {
    let folder = records("record_percent");
    let table = printed(&folder, &["record", "one.AT2", "--damping", "0.07", "--plot", "plot.svg"]);
    assert_has(&table, &["Sa in g at 7 % damping"]);
    assert!(content(&folder, "plot.svg").contains("Sa (g) at 7 % damping"));
}

#[test]
fn one_bad_file_does_not_hide_the_others() {
    let folder = records("record_some");
    let words = ["column.csv, line 3: expected a stated step", "none.AT2: cannot be read", "2 of 3 files"];
    let output = fails(&folder, &["record", "one.AT2", "column.csv", "none.AT2"], &words);
    assert!(text(&output.stdout).contains("one.AT2"));
}

#[test]
fn bad_requests_are_refused() {
    let folder = records("record_refused");
    let cases: [(&[&str], &[&str]); 8] = [
        (&["record", "column.csv", "--record-step", "0.01"], &["column.csv, line 1", "no unit", "cm/s2"]),
        (&["record", "column.csv", "--record-step", "0.01", "--unit", "feet"], &["`feet`", "cm/s2"]),
        (
            &["record", "one.AT2", "--format", "sac"],
            &["`sac`", "at2, esm, knet, knet-csv, cosmos, csmip, smc, geonet"],
        ),
        (&["record", "one.AT2", "--format", "smc"], &["one.AT2, line 1", "CORRECTED ACCELEROGRAM"]),
        (&["record", "two.V2", "--channel", "3"], &["`3`", "`1: 90 Deg`, `2: Up`"]),
        (&["record", "one.AT2", "--periods", "0.2,1000"], &["1000", "0.001 to 100 s"]),
        (&["record", "one.AT2", "--damping", "5"], &["damping ratio", "5", "below 1"]),
        (
            &["record", "two.V2", "--samples", "out.csv"],
            &["--samples writes one motion", "two.V2 [2: Up]", "--channel"],
        ),
    ];
    for (arguments, words) in cases {
        refused(&folder, arguments, words);
    }
    fails(&folder, &["record", "one.AT2", "--plot", "plot.jpg"], &["plot.jpg", "ends in .svg"]);
}

/// One row a file, below it the files that are no record and why.
#[test]
fn a_folder_is_listed() {
    let folder = records("record_folder");
    fs::create_dir(folder.join("inner")).unwrap();
    fs::write(folder.join(".hidden"), "x").unwrap();
    fs::write(folder.join("notes.md"), "These are records.\n").unwrap();
    fs::write(folder.join("up.AT2"), specimen::at2(&SAMPLES).replace(", 90\n", ", UP\n")).unwrap();
    let table = printed(&folder, &["record", "."]);
    let lines: Vec<_> = table.lines().collect();
    for (line, words) in [
        (0, &["file", "format", "channels", "points", "step [s]", "PGA [g]", "findings"][..]),
        (1, &["one.AT2", "PEER AT2", "  1  ", " 11 ", " 0.01 ", " 0.10529"]),
        (2, &["two.V2", "CSMIP V2", "  2  ", " 11 ", "vertical (1)", "tail"]),
        (3, &["up.AT2", "vertical"]),
        (4, &["not read  ", "column.csv, line 3: expected a stated step"]),
        (5, &["not read  ", "notes.md, line 1: expected "]),
    ] {
        assert_has(lines[line], words);
    }
    assert_eq!(lines.len(), 6, "{table}");
    let value = json(&folder, &["record", ".", "--json"]);
    assert_eq!(
        (value["records"].as_array().unwrap().len(), value["unread"].as_array().unwrap().len()),
        (4, 2)
    );
    refused(&folder, &["record", "inner"], &["inner", "a folder without files"]);
    // a file that is named itself must be there
    let output = fails(&folder, &["record", ".", "missing.AT2"], &["1 of the files that are named"]);
    assert_has(&text(&output.stdout), &["one.AT2", "not read  missing.AT2: cannot be read"]);
}

#[test]
fn standard_input_is_a_record() {
    let folder = records("record_stdin");
    let given = |arguments: &[&str], name: &str| {
        let file = fs::File::open(folder.join(name)).unwrap();
        program(&folder, arguments).stdin(file).output().unwrap()
    };
    let table = given(&["record", "-"], "one.AT2");
    assert_has(&text(&table.stdout), &["standard input", "PEER AT2", " 0.10529 "]);
    let error = given(&["simulate", "--record", "-"], "column.csv");
    assert_has(&text(&error.stderr), &["standard input, line 3: expected a stated step"]);
    #[cfg(unix)]
    {
        let endless = fs::File::open("/dev/zero").unwrap();
        let error = program(&folder, &["record", "-"]).stdin(endless).output().unwrap();
        assert_has(&text(&error.stderr), &["standard input: expected a record of at most 67108864 bytes"]);
    }
}
