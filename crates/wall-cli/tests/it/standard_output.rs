//! What the program writes where: `-` as standard output, endings of pictures, units, words for people.

use std::fs;

use crate::command_line::{assert_has, content, fails, folder, printed, refused, setting, succeed, text};

/// `--csv -` writes the file that `--csv FILE` writes, and the summary goes to stderr; it names no file.
#[test]
fn a_dash_is_standard_output() {
    let folder = folder("dash");
    for command in [
        &["simulate", "--synthetic"][..],
        &["simulate", "--synthetic", "--json"],
        &["record", "--synthetic"],
        &["describe", "--thresholds", "0.4"],
        &["study", "calibrate", "--a1", "0.05", "--restitution", "0.9", "--models", "constant_ratio"],
    ] {
        let run = |csv: &str| succeed(&folder, &[command, &["--csv", csv]].concat());
        let (to_file, to_stdout) = (run("file.csv"), run("-"));
        assert_eq!(text(&to_stdout.stdout), content(&folder, "file.csv"), "{command:?}");
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
fn a_map_is_svg() {
    let folder = folder("svg_ending");
    fails(&folder, &["study", "spectrum", "--synthetic", "--svg", "x.png"], &["x.png", "ends in .svg"]);
    assert!(!folder.join("x.png").exists());
}

/// A peak acceleration has a unit in a scene as after `--pga`.
#[test]
fn a_scene_states_the_unit_of_its_peak() {
    let folder = folder("pga_unit");
    let told = |pga: &str| {
        fs::write(folder.join("s.toml"), format!("[motion]\nsynthetic = {{}}\npga = {pga}\n")).unwrap();
        printed(&folder, &["simulate", "s.toml", "--json"])
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
    succeed(&folder, &["record", "--synthetic", "--samples", "r.csv"]);
    let tied = setting("simulate --synthetic", "tie_height=3 tie_stiffness=1e5");
    let commands: [&[&str]; 5] = [
        &["simulate", "--synthetic"],
        &tied,
        &["simulate", "--records", "r.csv"],
        &["describe", "--thresholds", "0.4"],
        &["study", "spectrum", "--synthetic", "--heights", "2:3:2", "--ratios", "8:9:2"],
    ];
    for command in commands {
        let csv = printed(&folder, &[command, &["--csv", "-"]].concat());
        let header = csv.lines().next().unwrap();
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
        let told = printed(&folder, &[&["simulate", "--synthetic", "--html", "p.html"], more].concat());
        (told, content(&folder, "p.html"))
    };
    let (told, html) = page(&["--floor", "T=0.3,xi=0.05"]);
    assert_has(&told, &["peak ground acceleration", "felt on a floor"]);
    assert!(html.contains("Acceleration of the floor") && !html.contains("a_g"), "a_g");
    let (told, html) = page(&[]);
    assert!(told.contains(", peak acceleration") && html.contains("Acceleration of the support"), "{told}");
}

/// Ctrl-C ends a study with the words that the same command resumes; what is there is complete.
#[cfg(unix)]
#[test]
fn an_interrupted_study_says_that_it_resumes() {
    use std::process::{Command, Stdio};

    use crate::command_line::{fails, program};
    use crate::ida::{bytes, part_files, study};

    let folder = study("ida_interrupted");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "whole", "--threads", "1"]);
    let parts = part_files(&folder.join("whole")).len();
    // as soon as the first part is there; other tests run at the same time, and may hold up the signal until
    // the study is done
    let interrupted = (0..20).any(|_| {
        // what an attempt has run to its end cannot be interrupted again
        let _ = fs::remove_dir_all(folder.join("broken"));
        let mut child = program(&folder, &["study", "ida", "study.toml", "-o", "broken", "--threads", "1"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        while !folder.join("broken/runs/0000/0000000.parquet").exists() && child.try_wait().unwrap().is_none()
        {
            std::thread::yield_now();
        }
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let told = text(&output.stderr);
        let is_told = told.contains("interrupted; finished parts are kept, and the same command resumes");
        assert!(is_told == (output.status.code() == Some(130)), "{:?}: {told}", output.status);
        is_told && (1..parts).contains(&part_files(&folder.join("broken")).len())
    });
    assert!(interrupted, "the study was never interrupted between its parts");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "broken"]);
    assert!(bytes(&folder.join("broken")) == bytes(&folder.join("whole")));
    // the folder tells the study in words, not in those of the source
    let manifest = content(&folder, "whole/study.json");
    assert_has(&manifest, &["\"hunt from ", "\"AvgSA over "]);
    for word in ["HuntAndFill", "Computed", "periods: ["] {
        assert!(!manifest.contains(word), "{word} in {manifest}");
    }
    // and another study is refused in words
    let other = content(&folder, "study.toml").replace("gap = 0.3", "gap = 0.2");
    fs::write(folder.join("other.toml"), other).unwrap();
    let words = ["found \"levels\": \"hunt from ", "gap 0.2\")"];
    fails(&folder, &["study", "ida", "other.toml", "-o", "whole"], &words);
    // short names are spelled out once
    let page = content(&folder, "whole/study.html");
    assert_eq!(page.matches("CDR: constant damping ratio").count(), 1);
    assert_eq!(page.matches("CR: coefficient of restitution").count(), 1);
}

/// A terminal has 24 lines of 80 characters.
#[test]
fn the_first_screen_of_help_fits_a_terminal() {
    let help = printed(&folder("help"), &["--help"]);
    assert!(help.lines().count() < 24 && help.lines().all(|line| line.chars().count() <= 80), "{help}");
}
