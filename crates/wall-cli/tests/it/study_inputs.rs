//! Tests what the program says of the inputs of studies and checks other than record files: hazard curves,
//! grids, names, copies of records, folders, and walls that are given in several ways.

use std::fs;
use std::path::Path;

use crate::command_line::{assert_has, content, fails, folder, printed, refused, rows, succeed, text};
use crate::specimen::{SAMPLES, at2};

/// A study of PGA with records, levels of a grid, and more keys.
fn study(records: &str, more: &str) -> String {
    format!(
        "models = [\"CR\"]\nintensity = {{ measure = \"PGA\" }}\nrecords = {{ {records} }}\n\
         levels = {{ method = \"grid\", values = [0.1, 0.2, 0.4, 0.8] }}\n{more}\n"
    )
}

const SYNTHETIC: &str = "synthetic = { count = 4, duration = 10, step = 0.01 }";
const WALL: &str = "[[walls]]\nname = \"a\"\ngeometry = { height = 3, thickness = 0.3 }\n";

/// Runs a study and returns what the program warns of.
fn warned(folder: &Path, study: &str) -> String {
    fs::write(folder.join("study.toml"), study).unwrap();
    let _ = fs::remove_dir_all(folder.join("out"));
    text(&succeed(folder, &["study", "ida", "study.toml", "-o", "out"]).stderr)
}

/// A hazard in another unit than the study says is warned of, in a file and in the study. By hand, the power
/// law from 0.1 to 0.4 g has a rate of 1/2475 at 0.4 (0.866250)^(ln 4/ln 20) g.
#[test]
fn hazards_in_another_unit_are_warned_of() {
    let folder = folder("hazard_units");
    let points = [(0.02, 0.08), (0.1, 0.007), (0.4, 3.5e-4), (1.6, 5e-6)];
    for (factor, unit, words) in [
        (1.0, "", ""),
        (9.80665, "", "if it is in m/s2, give 0.374286 g; state its unit"),
        (980.665, "", "if it is in cm/s2, give 0.374286 g; state its unit"),
        (9.80665, ", unit = \"m/s2\"", ""),
        (0.01, "", "PGA = 0.00374286 g is unusual"),
    ] {
        let points = points.map(|(x, rate)| [factor * x, rate]);
        let lines = points.map(|[x, rate]| format!("{x},{rate}\n")).concat();
        fs::write(folder.join("h.csv"), format!("PGA,annual_rate\n{lines}")).unwrap();
        for source in [format!("points = {points:?}"), "file = \"h.csv\"".to_owned()] {
            let told = warned(&folder, &study(SYNTHETIC, &format!("hazard = {{ {source}{unit} }}\n{WALL}")));
            assert_eq!(told.contains("at a return period of 2475 years, PGA"), !words.is_empty(), "{told}");
            assert_has(&told, &[words]);
        }
    }
}

/// A copy of a record, and a file named in two ways, count twice; three copies are not three records.
#[test]
fn copies_of_a_record_are_warned_of() {
    let folder = folder("record_copies");
    fs::create_dir_all(folder.join("records")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join("records").join(name), text).unwrap();
    for name in ["a.AT2", "a (1).AT2", "b.AT2"] {
        write(name, &at2(&SAMPLES));
    }
    write("other.AT2", &at2(&SAMPLES.map(|sample| 1.5 * sample)));
    for (files, names) in [
        ("\"records\"", "\"a (1).AT2\", \"a.AT2\", \"b.AT2\" are the same motion, which counts 3 times"),
        ("\"records/a.AT2\", \"records/../records/a.AT2\"", "are the same motion, which counts 2 times"),
    ] {
        let told = warned(&folder, &study(&format!("files = [{files}]"), WALL));
        assert_has(&told, &[names]);
    }
    let two = study("files = [\"records/a.AT2\", \"records/other.AT2\"]", WALL);
    assert!(!warned(&folder, &two).contains("same motion"));
    let check = |files: &str| {
        format!(
            "[geometry]\nheight = 2\nthickness = 0.3\ndensity = 1800\n[force_law]\na1 = 0.05\n\
             [check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\n\
             SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32 }}\nrecords = {{ files = [{files}] }}\n"
        )
    };
    fs::write(folder.join("wall.toml"), check("\"records/a*\", \"records/b.AT2\"")).unwrap();
    refused(&folder, &["check", "wall.toml"], &["records: found 1 that differ; at least 3 records"]);
}

/// NRML is well-formed whatever a wall is called: no comment holds two dashes.
#[test]
fn names_do_not_break_nrml() {
    let folder = folder("nrml_names");
    for name in ["a---b", "--", "a-----", "a\\u0001b", "<&>"] {
        warned(&folder, &study(SYNTHETIC, &WALL.replace("\"a\"", &format!("\"{name}\""))));
        let xml = content(&folder, "out/fragilities.xml");
        for comment in xml.split("<!--").skip(1) {
            let (inside, _) = comment.split_once("-->").unwrap();
            assert!(!inside.contains("--") && !inside.ends_with('-'), "{inside}");
        }
        assert!(!xml.contains(|c: char| c.is_control() && c != '\n'), "{xml}");
    }
}

/// A grid of the hazard in another unit than stated, and the heads of the ministry.
#[test]
fn grids_have_a_unit_and_heads() {
    let folder = folder("grid_units");
    let wall = "[geometry]\nheight = 1.2\nthickness = 0.3\ndensity = 1800\n[check]\n\
                code = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\nSLV = {}\n\
                site = { grid = \"g.csv\", coordinates = [42, 13], nominal_life = 50, use_coefficient = 1";
    let periods = "ag_30;F0_30;TC_30;ag_475;F0_475;TC_475";
    let ministry = ["TR = 30;;;TR = 475;;", "ag;Fo;TC*;ag;Fo;TC*"];
    let told = |heads: &str, ag: [f64; 2], unit: &str| {
        let row = format!("13;42;{};2.4;0.3;{};2.5;0.33", ag[0], ag[1]).replace('.', ",");
        fs::write(folder.join("g.csv"), format!("{heads}\n{row}\n")).unwrap();
        fs::write(folder.join("w.toml"), format!("{wall}{unit} }}\n")).unwrap();
        let told = crate::command_line::wall(&folder, &["check", "w.toml"]);
        (text(&told.stderr), text(&told.stdout))
    };
    let named = format!("lon;lat;{periods}");
    let right = told(&named, [0.02, 0.05], "");
    assert!(!right.0.contains("ag_unit"), "{}", right.0);
    let (tenth, _) = told(&named, [0.2, 0.5], "");
    assert_has(
        &tenth,
        &["at T_R = 475 years = 0.5 g is unusual", "in g/10 or m/s2, give 0.05 g; state ag_unit"],
    );
    assert_has(&told(&named, [0.02, 0.25], ", ag_unit = \"g/10\"").0, &["0.025 g is unusual"]);
    let heads = format!(";;{}\nLON;LAT;{}", ministry[0], ministry[1]);
    assert_eq!(told(&heads, [0.2, 0.5], ", ag_unit = \"g/10\"").1, right.1);
    assert_eq!(told(&named.replace("F0", "Fo").replace("TC", "TC*"), [0.02, 0.05], "").1, right.1);
}

/// One wall has one result, in a table, a scene or a study file: ξ counts for models that state none.
#[test]
fn a_wall_has_one_result_however_it_is_given() {
    let folder = folder("one_wall");
    fs::write(folder.join("a.toml"), "[geometry]\nheight = 3\nthickness = 0.3\n[damping]\nxi = 0.2\n")
        .unwrap();
    fs::write(folder.join("walls.csv"), "name,height,thickness,xi\na,3,0.3,0.2\n").unwrap();
    let of = |walls: &str| {
        warned(&folder, &study(SYNTHETIC, walls).replace("\"CR\"", "\"CDC\""));
        rows(&folder, "out/levels.csv")
    };
    let given = of(&format!("{WALL}damping = {{ xi = 0.2 }}\n"));
    assert_eq!(of("[[walls]]\nscene = \"a.toml\"\n"), given);
    assert_eq!(of("[[walls]]\ntable = \"walls.csv\"\n"), given);
    assert_ne!(of(WALL), given);
    let told = warned(&folder, &study(SYNTHETIC, "[[walls]]\nname = \"a\"\n"));
    assert_has(&told, &["study.toml: 1 of 1 walls have no height; the default of 4 m", "no thickness"]);
}

/// An oscillator has no geometry: none is missed, and none is uncertain. Doubts about a curve are told.
#[test]
fn an_oscillator_has_no_height() {
    let folder = folder("oscillators");
    let law = "[walls.force_law]\ncurve = [[0.01, 900.0], [0.2, 0.0]]\n";
    let of = "oscillator = { effective_mass = 800.0, participation = 1.2 }\n";
    let damping = "[walls.damping]\nxi = 0.05\n";
    let wall = format!("[[walls]]\nname = \"a\"\n{law}{of}{damping}");
    let models = |walls: &str| study(SYNTHETIC, walls).replace("\"CR\"", "\"CDC\"");
    let told = warned(&folder, &models(&wall));
    assert!(!told.contains("no height") && !told.contains("no thickness"), "{told}");
    let height =
        format!("[uncertain]\nsamples = 3\nparameters = {{ height = {{ uniform = [3, 4] }} }}\n{wall}");
    fs::write(folder.join("uncertain.toml"), models(&height)).unwrap();
    let words = ["wall \"a\": height is that of a wall, and no oscillator has it"];
    fails(&folder, &["study", "ida", "uncertain.toml", "-o", "uncertain"], &words);
    let told =
        warned(&folder, &models(&format!("{WALL}[walls.force_law]\ncurve = [[0.01, 900.0], [0.2, 0.0]]\n")));
    assert_has(&told, &["wall \"a\": F is ", " N at u_ins = 0.1500 m"]);
}

/// Files of the user in the folder of a study stay, and are named where a result would replace one.
#[test]
fn no_result_replaces_a_file_of_the_user() {
    let folder = folder("own_files");
    fs::create_dir_all(folder.join("own")).unwrap();
    fs::write(folder.join("study.toml"), study(SYNTHETIC, WALL)).unwrap();
    fs::write(folder.join("own/notes.txt"), "mine").unwrap();
    for name in ["levels.csv", "reliability.csv"] {
        fs::write(folder.join("own").join(name), "mine").unwrap();
        let words = [name, "is there and no result of a study, which would replace it; give another folder"];
        refused(&folder, &["study", "ida", "study.toml", "-o", "own"], &words);
        assert_eq!(content(&folder, &format!("own/{name}")), "mine");
        fs::remove_file(folder.join("own").join(name)).unwrap();
    }
    for _ in 0..2 {
        succeed(&folder, &["study", "ida", "study.toml", "-o", "own"]);
        assert_eq!(content(&folder, "own/notes.txt"), "mine");
    }
}

/// The program says what was meant.
#[test]
fn other_commands_are_named() {
    let folder = folder("other_commands");
    for command in ["simulate", "describe"] {
        fails(&folder, &[command, "--height", "3"], &["give it as --set height=VALUE"]);
    }
    fs::write(folder.join("study.toml"), study(SYNTHETIC, WALL)).unwrap();
    refused(&folder, &["simulate", "study.toml"], &["no scene: wall study ida takes it"]);
    fs::write(folder.join("walls.toml"), WALL).unwrap();
    refused(&folder, &["simulate", "walls.toml"], &["no scene: wall check takes it"]);
    let motion = |seed: &[&str]| printed(&folder, &[&["record", "--synthetic"], seed].concat());
    assert_eq!(motion(&["--seed", "1"]), motion(&[]));
    assert_ne!(motion(&["--seed", "2"]), motion(&[]));
    fails(&folder, &["record", "a.csv", "--seed", "2"], &["cannot be used with"]);
}
