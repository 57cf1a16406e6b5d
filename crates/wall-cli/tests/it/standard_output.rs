//! What the program writes where: `-` as standard output, endings of pictures, units, words for people.

use std::fs;

use crate::command_line::{folder, refused, text, wall};

/// `--csv -` writes the file that `--csv FILE` writes, and the summary goes to stderr; it names no file.
#[test]
fn a_dash_is_standard_output() {
    let folder = folder("dash");
    for command in [
        &["simulate", "--synthetic"][..],
        &["simulate", "--synthetic", "--json"],
        &["motion", "--synthetic"],
        &["describe", "--thresholds", "0.4"],
        &["calibrate", "--a1", "0.05", "--restitution", "0.9", "--models", "constant_ratio"],
    ] {
        let run = |csv: &str| {
            let output = wall(&folder, &[command, &["--csv", csv]].concat());
            assert!(output.status.success(), "{command:?}: {}", text(&output.stderr));
            output
        };
        let (to_file, to_stdout) = (run("file.csv"), run("-"));
        assert_eq!(
            text(&to_stdout.stdout),
            fs::read_to_string(folder.join("file.csv")).unwrap(),
            "{command:?}"
        );
        let told = text(&to_stdout.stderr);
        let summary = text(&to_file.stdout);
        let summary: String =
            summary.split_inclusive('\n').filter(|line| !line.contains("written")).collect();
        let summary = summary.replace("file.csv", "-");
        assert!(told.trim_end().ends_with(summary.trim_end()), "{command:?}: {told}");
        assert!(!told.contains("written"), "{command:?}: {told}");
    }
    assert!(!folder.join("-").exists());
    refused(&folder, &["simulate", "--csv", "-", "--html", "-"], &["two outputs are -"]);
}

#[test]
fn an_animation_is_svg() {
    let folder = folder("svg_ending");
    for command in ["simulate", "spectrum"] {
        refused(&folder, &[command, "--synthetic", "--svg", "x.png"], &["x.png", "ends in .svg"]);
    }
    let building = crate::root().join("scenes/building/three_storeys.toml");
    let building = ["building", building.to_str().unwrap(), "--synthetic", "--svg", "x.png"];
    refused(&folder, &building, &["x.png", "ends in .svg"]);
    assert!(!folder.join("x.png").exists());
}

/// A peak acceleration has a unit in a scene as after `--pga`.
#[test]
fn a_scene_states_the_unit_of_its_peak() {
    let folder = folder("pga_unit");
    let told = |pga: &str| {
        fs::write(folder.join("s.toml"), format!("[motion]\nsynthetic = {{}}\npga = {pga}\n")).unwrap();
        let output = wall(&folder, &["simulate", "s.toml", "--json"]);
        assert!(output.status.success(), "{pga}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    assert_eq!(told("\"0.3g\""), told("2.941995"));
    assert_eq!(told("\"300 cm/s2\""), told("3"));
    assert_ne!(told("3"), told("2.941995"));
    for wrong in ["\"0.3 km\"", "\"\"", "true"] {
        fs::write(folder.join("s.toml"), format!("[motion]\nsynthetic = {{}}\npga = {wrong}\n")).unwrap();
        refused(&folder, &["simulate", "s.toml"], &["s.toml, line 3", "acceleration", "0.3g"]);
    }
}

/// Each column of a CSV states its unit, unless it is a ratio, a count, a flag or a name.
#[test]
fn columns_state_their_units() {
    const WITHOUT: [&str; 11] = [
        "u_ratio",
        "u_ratio_max",
        "overturned",
        "falls",
        "record",
        "sign",
        "side",
        "point",
        "force_ratio",
        "rocked",
        "slenderness",
    ];
    const UNITS: [&str; 7] = ["_s", "_m", "_m_s", "_m_s2", "_n", "_n_m", "_rad"];
    let folder = folder("units");
    wall(&folder, &["motion", "--synthetic", "--csv", "r.csv"]);
    let tied = ["--set", "tie_height=3", "--set", "tie_stiffness=1e5"];
    let commands: [&[&str]; 5] = [
        &["simulate", "--synthetic"],
        &[&["simulate", "--synthetic"], &tied[..]].concat(),
        &["simulate", "--records", "r.csv"],
        &["describe", "--thresholds", "0.4"],
        &["spectrum", "--synthetic", "--heights", "2:3:2", "--ratios", "8:9:2"],
    ];
    for command in commands {
        let output = wall(&folder, &[command, &["--csv", "-"]].concat());
        let csv = text(&output.stdout);
        let header = csv.lines().next().unwrap_or_else(|| panic!("{command:?}: {}", text(&output.stderr)));
        for name in header.split(',') {
            let stated = UNITS.iter().any(|unit| name.ends_with(unit));
            assert!(stated || WITHOUT.contains(&name), "{command:?}: {name} of {header}");
        }
    }
}

/// A wall on a floor feels the floor: a_g is the ground's.
#[test]
fn the_acceleration_of_a_floor_is_not_called_that_of_the_ground() {
    let folder = folder("floor_label");
    let page = |more: &[&str]| {
        let output = wall(&folder, &[&["simulate", "--synthetic", "--html", "p.html"], more].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        (text(&output.stdout), fs::read_to_string(folder.join("p.html")).unwrap())
    };
    let (told, html) = page(&["--floor", "T=0.3,xi=0.05"]);
    assert!(told.contains("peak ground acceleration") && told.contains("felt on a floor"), "{told}");
    assert!(html.contains("Acceleration of the floor") && !html.contains("a_g"), "a_g");
    let (told, html) = page(&[]);
    assert!(told.contains(", peak acceleration") && html.contains("Acceleration of the support"), "{told}");
}

/// `wall reproduce` says which number deviates most, and why.
#[test]
fn deviations_from_print_are_explained() {
    let folder = folder("reproduce_words");
    let output = wall(&folder, &["reproduce", "-o", "p.html"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let told = text(&output.stdout);
    let tables: Vec<_> = told.lines().filter(|line| line.contains("round to print")).collect();
    assert!(tables.len() == 7 && tables.iter().all(|line| line.contains(": printed ")), "{told}");
    let table_1 = told.lines().skip_while(|line| !line.starts_with("Table 1")).nth(1).unwrap();
    assert!(table_1.starts_with("    "), "{told}");
    assert!(told.lines().all(|line| line.chars().count() <= 160), "{told}");
}

/// Ctrl-C ends a study with the words that the same command resumes; what is there is complete.
#[cfg(unix)]
#[test]
fn an_interrupted_study_says_that_it_resumes() {
    use std::process::{Command, Stdio};
    use std::time::Instant;

    use crate::ida::{bytes, study, succeed};

    let folder = study("ida_interrupted");
    let start = Instant::now();
    succeed(&folder, &["ida", "study.toml", "-o", "whole", "--threads", "1"]);
    let whole = start.elapsed();
    // at 0.1 to 0.95 of the time that the whole takes now, twice: other tests run at the same time
    let interrupted = (0..36_u32).any(|attempt| {
        // what an attempt has run to its end cannot be interrupted again
        let _ = fs::remove_dir_all(folder.join("broken"));
        let child = Command::new(env!("CARGO_BIN_EXE_wall"))
            .current_dir(&folder)
            .args(["ida", "study.toml", "-o", "broken", "--threads", "1"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(whole * (2 + attempt % 18) / 20);
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let told = text(&output.stderr);
        let is_told = told.contains("interrupted; finished parts are kept, and the same command resumes");
        // before the study is read there is nothing to say, and at its end nothing to resume
        assert!(is_told == (output.status.code() == Some(130)), "{:?}: {told}", output.status);
        is_told
    });
    assert!(interrupted, "the study was never interrupted");
    let resumed = wall(&folder, &["ida", "study.toml", "-o", "broken"]);
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    assert!(bytes(&folder.join("broken")) == bytes(&folder.join("whole")));
    // the folder tells the study in words, not in those of the source
    let manifest = fs::read_to_string(folder.join("whole/study.json")).unwrap();
    assert!(manifest.contains("\"hunt from ") && manifest.contains("\"AvgSA over "), "{manifest}");
    assert!(
        !["HuntAndFill", "Computed", "periods: ["].iter().any(|word| manifest.contains(word)),
        "{manifest}"
    );
    // and another study is refused in words
    let other = fs::read_to_string(folder.join("study.toml")).unwrap().replace("gap = 0.3", "gap = 0.2");
    fs::write(folder.join("other.toml"), other).unwrap();
    let refusal = text(&wall(&folder, &["ida", "other.toml", "-o", "whole"]).stderr);
    assert!(refusal.contains("found levels: hunt from ") && refusal.contains("gap 0.2)"), "{refusal}");
    // short names are spelled out once
    let page = fs::read_to_string(folder.join("whole/study.html")).unwrap();
    assert_eq!(page.matches("CDR: constant damping ratio").count(), 1);
    assert_eq!(page.matches("CR: coefficient of restitution").count(), 1);
}
