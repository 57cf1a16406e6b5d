//! Tests, through the program, the files that people give: tables, spectra, hazard curves, and paths. None is
//! read as something else without a word, and each message has its remedy.

use std::fs;
use std::path::Path;

use crate::command_line::{args, assert_has, folder, printed, refused, succeed, text};
use crate::specimen::{SAMPLES, at2};

const CHECK: &str = "[check]\ncode = \"fractions\"\nunit = \"m/s2\"\n\
                     spectrum = [[0, 2.0], [0.1, 5], [0.5, 5], [1, 2.5], [2, 1.25], [4, 0.3]]\n";

fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) {
    fs::write(folder.join(name), content).unwrap();
}

/// Names that start with the mark of a comment, line breaks in cells, workbooks, gaps and summaries.
#[test]
fn tables_of_walls() {
    let folder = folder("given_tables");
    let of = |content: &[u8]| {
        write(&folder, "walls.csv", content);
        write(&folder, "walls.toml", format!("walls = [{{ table = \"walls.csv\" }}]\n{CHECK}"));
    };
    let heads = "name,height,thickness\n";
    for rows in ["#1,3.0,0.3\n", "#-1,3,.3\nW3,2.5,.3\n", "W3,2.5,.3\n#(2),2,.25\n"] {
        let line = if rows.starts_with('W') { "line 3" } else { "line 2" };
        for separator in [",", " ", ";"] {
            of((heads.to_owned() + rows).replace(',', separator).as_bytes());
            let words = ["walls.csv", line, "a row or a comment", "in quotes"];
            refused(&folder, &["check", "walls.toml"], &words);
        }
        of((heads.to_owned() + &rows.replace('#', "\"#").replacen(',', "\",", 1)).as_bytes());
        if !rows.starts_with('W') {
            assert_has(&printed(&folder, &["check", "walls.toml"]), &[&rows[..2]]);
        }
    }
    let rows = "\"facade\nnorth\",3.0,0.3\nB,2.0,0.3\n";
    of((heads.to_owned() + rows).as_bytes());
    let found = printed(&folder, &["check", "walls.toml"]);
    let plain = rows.replace("\"facade\nnorth\"", "facade north");
    of((heads.to_owned() + &plain).as_bytes());
    assert_eq!(found, printed(&folder, &["check", "walls.toml"]));
    assert_has(&found, &["facade north", "B "]);
    of(b"PK\x03\x04rest");
    refused(&folder, &["check", "walls.toml"], &["walls.csv, line 1", "a workbook", "CSV UTF-8"]);
    for name in ["Mean", "total", "None", "null", "Media"] {
        of(format!("{heads}a,3,0.3\n{name},2.5,0.25\n").as_bytes());
        refused(&folder, &["check", "walls.toml"], &["walls.csv, line 3", "a summary", "delete the row"]);
    }
}

/// Of Se and Sd beside each other, the check takes the one that it is told.
#[test]
fn spectra_with_several_columns() {
    let folder = folder("given_spectra");
    write(&folder, "ntc.csv", "T[s];Se(T)[g];Sd(T)[g]\n0;0,2;0,1\n0,1;0,5;0,25\n0,5;0,5;0,25\n3;0,05;0,02\n");
    let scene = |column: &str| {
        let check = "[geometry]\nheight = 4\nthickness = 0.4\n[check]\ncode = \"fractions\"\n";
        write(&folder, "wall.toml", format!("{check}spectrum = \"ntc.csv\"\n{column}"));
    };
    scene("");
    let words = ["ntc.csv, line 1", "3 columns", "`column = …` in [check]"];
    refused(&folder, &["check", "wall.toml"], &words);
    let of = |name: &str| {
        scene(&format!("column = \"{name}\"\n"));
        text(&crate::command_line::wall(&folder, &["check", "wall.toml"]).stdout)
    };
    let [elastic, design] = ["Se(T)[g]", "Sd(T)[g]"].map(of);
    assert_has(&elastic, &["ratio"]);
    assert_ne!(elastic, design);
}

/// Paths with backslashes, of web pages and of home folders; a study in a folder with brackets.
#[test]
fn paths() {
    let folder = folder("given_paths");
    for (path, words) in [
        ("records\\new\\test.AT2", ["write / or single quotes", "records\\new\\test.AT2"]),
        ("https://example.org/a.AT2", ["web addresses are not read", "line 1"]),
        ("~/a.AT2", ["write them out", "line 1"]),
        (" a.AT2", ["a blank at an end", "line 1"]),
    ] {
        write(&folder, "wall.toml", format!("[motion]\nrecord = \"{path}\"\n"));
        refused(&folder, &["simulate", "wall.toml"], &words);
    }
    let within = folder.join("[2024] rec");
    fs::create_dir_all(&within).unwrap();
    write(&within, "ok.AT2", at2(&SAMPLES));
    write(
        &within,
        "study.toml",
        "models = [\"CR\"]\nintensity = { measure = \"PGA\" }\nrecords = { files = [\"*.AT2\"] }\n\
         levels = { method = \"grid\", values = [0.1, 0.2] }\n\
         [[walls]]\nname = \"a\"\ngeometry = { height = 3, thickness = 0.3 }\n",
    );
    let told = succeed(&folder, &["study", "ida", "[2024] rec/study.toml", "-o", "out"]);
    assert_has(&text(&told.stdout), &["1 record"]);
}

/// Numbers that no type holds.
#[test]
fn huge_numbers_are_named() {
    let folder = folder("given_numbers");
    for number in ["99999999999999999999", "1e400"] {
        write(&folder, "wall.toml", format!("[geometry]\nheight = {number}\n"));
        refused(&folder, &args("simulate wall.toml"), &["line 2", "height = 1e", "a smaller number"]);
    }
}

/// Probabilities in 50 years and per cent in place of annual rates are warned of, and rates above those of
/// any site only; a return period is no target. Messages of OpenQuake's curves have the numbers of the file.
#[test]
fn hazard_curves() {
    let folder = folder("given_hazards");
    let study = |hazard: &str| {
        let study = "models = [\"CR\"]\nintensity = { measure = \"PGA\" }\n\
                     records = { synthetic = { count = 2, duration = 10 } }\n\
                     levels = { method = \"grid\", values = [0.1, 0.4] }\n";
        let wall = "[[walls]]\nname = \"a\"\ngeometry = { height = 3, thickness = 0.3 }\n";
        write(&folder, "study.toml", format!("{study}hazard = {{ {hazard} }}\n{wall}"));
        let _ = fs::remove_dir_all(folder.join("out"));
    };
    let run = args("study ida study.toml -o out");
    let points = [(0.02, 0.08), (0.05, 0.022), (0.1, 0.007), (0.2, 0.0018), (0.4, 3.5e-4), (1.6, 5e-6)];
    // at a rate of 0.1 the curve of probabilities has 0.184 g, that of per cent 0.256 g
    for (of_rate, words) in [
        ((|rate: f64| rate) as fn(f64) -> f64, ""),
        (|rate| 2.0 * rate, ""),
        (|rate| -(-50.0 * rate).exp_m1(), "PGA = 0.184 g every 10 years"),
        (|rate| 100.0 * rate, "PGA = 0.256 g every 10 years"),
    ] {
        let points = points.map(|(x, rate)| [x, of_rate(rate)]);
        let lines: Vec<_> = points.iter().map(|[x, rate]| format!("{x},{rate}\n")).collect();
        write(&folder, "h.csv", format!("PGA,annual_rate\n{}", lines.concat()));
        for source in [format!("points = {points:?}"), "file = \"h.csv\"".to_owned()] {
            study(&source);
            let told = text(&succeed(&folder, &run).stderr);
            assert_eq!(told.contains("are these annual rates"), !words.is_empty(), "{told}");
            assert_has(&told, &[words]);
        }
    }
    study("points = [[0.1, 0.01], [0.4, 1e-4]], target = 475");
    refused(&folder, &run, &["study.toml, line 5", "target = 475", "at most 1"]);
    study("points = [[0.1, 0.01], [0.4, 1e-4]], file = \"h.csv\"");
    refused(&folder, &run, &["line 5", "not both"]);
    study("file = \"h.csv\"");
    write(&folder, "h.csv", "PGA [%g],annual_rate\n10,0.01\n40,1e-4\n");
    refused(&folder, &run, &["h.csv, line 1", "\"%g\" of PGA", "m/s2, cm/s2, mm/s2 or g"]);
    let comment = "#,,,,\"kind='mean', investigation_time=50.0, imt='PGA'\"\n";
    write(&folder, "h.csv", format!("{comment}lon,lat,poe-0.8,poe-0.4\n12.0,42.0,2E-3,2E-2\n"));
    refused(&folder, &run, &["h.csv, line 3", "intensity 0.4 must be above 0.8"]);
}
