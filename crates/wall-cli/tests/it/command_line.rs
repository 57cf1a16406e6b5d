//! Tests the program `wall` with bad input: one clear message, exit code 2, no files left behind.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use serde_json::Value;

/// Makes an empty folder for a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The program as a process of its own, for what only a process shows: pipes, signals, lost terminals.
pub(crate) fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wall"));
    command.current_dir(folder).args(arguments);
    command
}

/// What the program returns and prints.
pub(crate) struct Told {
    pub(crate) code: u8,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: Vec<u8>,
}

/// Runs the program in this process, in a folder.
pub(crate) fn wall(folder: &Path, arguments: &[&str]) -> Told {
    // a process has one working folder
    static FOLDER: Mutex<()> = Mutex::new(());
    let _taken = FOLDER.lock().unwrap_or_else(PoisonError::into_inner);
    std::env::set_current_dir(folder).unwrap();
    let (mut stdout, mut stderr) = (Vec::new(), Vec::new());
    let code = wall::run(["wall"].iter().chain(arguments), &mut stdout, &mut stderr);
    Told { code, stdout, stderr }
}

/// Splits the arguments of a command.
pub(crate) fn args(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// Splits the arguments of a command, and sets parameters such as `xi=0.1 a1=0.02`.
pub(crate) fn setting<'a>(line: &'a str, parameters: &'a str) -> Vec<&'a str> {
    let set = parameters.split_whitespace().flat_map(|parameter| ["--set", parameter]);
    args(line).into_iter().chain(set).collect()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Returns a file of a folder as text.
pub(crate) fn content(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// Returns the cells of a CSV file of a folder, row by row, without its header.
pub(crate) fn rows(folder: &Path, name: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| line.split(',').map(str::to_owned).collect();
    content(folder, name).lines().skip(1).map(cells).collect()
}

/// Runs a command that succeeds.
#[track_caller]
pub(crate) fn succeed(folder: &Path, arguments: &[&str]) -> Told {
    let output = wall(folder, arguments);
    assert!(output.code == 0, "{arguments:?}: {}", text(&output.stderr));
    output
}

/// Runs a command that succeeds, and returns what it prints.
pub(crate) fn printed(folder: &Path, arguments: &[&str]) -> String {
    text(&succeed(folder, arguments).stdout)
}

/// Runs a command that succeeds, and returns the JSON that it prints.
pub(crate) fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(folder, arguments)).unwrap()
}

/// Expects a text that contains all `words`.
#[track_caller]
pub(crate) fn assert_has(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "no {word:?} in {text}");
    }
}

/// Runs `arguments`. Expects exit code 2 and a message that contains all `words`.
#[track_caller]
pub(crate) fn fails(folder: &Path, arguments: &[&str], words: &[&str]) -> Told {
    let output = wall(folder, arguments);
    let message = text(&output.stderr);
    assert_eq!(output.code, 2, "{arguments:?}: {message}");
    assert_has(&message, words);
    output
}

/// Runs `arguments`. Expects one line on stderr that contains all `words`, exit code 2, and no new file.
#[track_caller]
pub(crate) fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let names = || {
        let mut names: Vec<_> =
            std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let before = names();
    let output = fails(folder, arguments, words);
    let message = text(&output.stderr);
    assert_eq!(message.trim_end().lines().count(), 1, "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}: {}", text(&output.stdout));
    assert_eq!(names(), before, "{arguments:?}: left something behind");
}

#[test]
fn parameters_that_make_runs_long_are_named_before_the_run() {
    let folder = folder("long");
    let of = |settings| setting("simulate --stop-time 1e-4 --set damping_model=none", settings);
    let warned = succeed(&folder, &of("a1=1e-9 solver=exact"));
    assert_has(&text(&warned.stderr), &["warning: omega1 = "]);
    let words = ["newmark_step = 1e-7 s is below its minimum, 1e-6 s"];
    refused(&folder, &of("solver=newmark newmark_step=1e-7"), &words);
}

/// To open a pipe would be to wait for its writer, for ever.
#[test]
fn pipes_in_place_of_files_are_refused() {
    let folder = folder("pipes");
    std::fs::create_dir(folder.join("results")).unwrap();
    std::fs::write(folder.join("scene.toml"), "stop_time = 1\n").unwrap();
    for (pipe, arguments) in [
        ("base.fmu", &["package", "scene.toml", "-o", "scene.fmu", "--base", "base.fmu"][..]),
        ("building.toml", &["building", "building.toml", "-o", "building.ssp"]),
        ("results/study.json", &["study", "merge", "results", "-o", "merged"]),
    ] {
        let pipe = folder.join(pipe);
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let (ended, end) = std::sync::mpsc::channel();
        let place = folder.clone();
        std::thread::spawn(move || ended.send(wall(&place, arguments).code));
        let code = end.recv_timeout(Duration::from_secs(60));
        if code.is_err() {
            // lets the other tests have the working folder
            drop(std::fs::OpenOptions::new().write(true).open(pipe));
        }
        assert_eq!(code, Ok(2), "{arguments:?}");
    }
}

/// A scene, and words that the message must contain.
const BAD_SCENES: [(&str, &str, &[&str]); 24] = [
    ("unknown_key", "[geometry]\nheight = 3\ncolour = 1\n", &["line 3", "colour", "thickness"]),
    ("unknown_table", "[geomtry]\nheight = 3\n", &["line 1", "geomtry"]),
    ("wrong_table", "[geometry]\nxi = 0.1\n", &["line 2", "xi", "[damping]"]),
    ("not_toml", "title = \"a\"\nheight 3\n", &["line 2"]),
    ("twice", "[start]\nu_start = 0\nu_start = 1\n", &["line 3", "u_start"]),
    ("negative", "[geometry]\n\nthickness = -0.3\n", &["line 3", "thickness", "-0.3", "0.0001 m"]),
    ("nan", "[damping]\nxi = nan\n", &["line 2", "xi", "finite"]),
    ("infinite", "[geometry]\nheight = inf\n", &["line 2", "height", "finite"]),
    ("word", "[geometry]\nheight = \"tall\"\n", &["line 2", "height", "number"]),
    (
        "item",
        "[force_law]\nforce_law = \"linear\"\n",
        &["line 2", "linear", "rigid_linear, bilinear, trilinear"],
    ),
    ("a1_above_a3", "[force_law]\na1 = 0.95\na3 = 0.9\n", &["a1 = 0.95", "a3 = 0.9", "reduce a1"]),
    ("d1", "[force_law]\nforce_law = \"trilinear\"\nd1 = 0.98\n", &["d1 = 0.98", "0.97", "parallel"]),
    (
        "rigid_ratio",
        "[force_law]\nforce_law = \"rigid_linear\"\n",
        &["constant_ratio", "free_standing_block"],
    ),
    ("exact_ratio", "[solver]\nsolver = \"exact\"\n", &["exact", "constant_ratio", "adaptive"]),
    ("eccentric", "[geometry]\noverburden = 1e6\noverburden_eccentricity = 0.3\n", &["F0", "overburden"]),
    ("far", "[start]\nu_start = 5\n", &["u_start = 5 m is beyond u_ins = 0.2", "set u_start = 0"]),
    (
        "points",
        "[force_law]\nforce_law = \"multilinear\"\npoints = [[0.1, 1.0], [0.05, 0.0]]\n",
        &["point 2", "rise"],
    ),
    ("no_points", "[force_law]\nforce_law = \"multilinear\"\n", &["line 2", "points"]),
    ("input", "inputs = [\"a_g\", \"wind\"]\n", &["line 1", "wind", "a_bottom"]),
    ("motion", "[motion]\ntail = 1\n", &["line 1", "record", "synthetic"]),
    ("two_motions", "[motion]\nsynthetic = {}\nrecord = \"a.csv\"\nunit = \"g\"\n", &["exactly one"]),
    ("scale", "[motion]\nsynthetic = {}\nscale = 2\npga = 3\n", &["scale", "pga", "one of them"]),
    ("no_record", "[motion]\nrecord = \"none.AT2\"\n", &["none.AT2"]),
    ("step", "stop_time = 1e6\noutput_step = 1e-6\n", &["stop_time", "output_step"]),
];

#[test]
fn wrong_types_are_told_in_the_words_of_toml() {
    let folder = folder("toml_words");
    for (command, text, words) in [
        ("simulate", "motion = \"a.AT2\"\n", "expected a table"),
        ("simulate", "geometry = 3\n", "expected a table"),
        ("simulate", "storeys = 3\n", "expected a list"),
        ("simulate", "[[storeys]]\nmass = \"heavy\"\n", "expected a number"),
        ("simulate", "[motion]\nsynthetic = { seed = \"a\" }\n", "expected a whole number from 0 on"),
        ("simulate", "[motion]\nrecord = 3\n", "expected a path in quotes"),
        ("study ida", "intensity = \"PGA\"\n", "expected a table"),
        ("building", "floor = 3\n", "floor = 3: expected a list"),
    ] {
        std::fs::write(folder.join("wrong.toml"), text).unwrap();
        refused(&folder, &[&args(command)[..], &["wrong.toml"]].concat(), &["line", words]);
    }
}

#[test]
fn bad_scenes() {
    let folder = folder("bad_scenes");
    for (name, scene, words) in BAD_SCENES {
        let file = format!("{name}.toml");
        std::fs::write(folder.join(&file), scene).unwrap();
        refused(&folder, &["simulate", &file, "--csv", "out.csv", "--html", "out.html"], words);
        // an FMU has no output step
        if name != "step" {
            refused(&folder, &["package", &file, "-o", "out.fmu"], words);
        }
    }
    refused(&folder, &["simulate", "missing.toml"], &["missing.toml"]);
    std::fs::write(folder.join("noise.toml"), [0xff_u8, 0xfe, 0x00, 0x80]).unwrap();
    refused(&folder, &["simulate", "noise.toml"], &["noise.toml", "as UTF-8"]);
    std::fs::write(folder.join("cp1252.toml"), b"title = \"Mauer\"\n# M\xfcller\n").unwrap();
    refused(&folder, &["simulate", "cp1252.toml"], &["cp1252.toml, line 2", "as UTF-8"]);
}

/// A record, its arguments, and words that the message must contain. The readers have tests of their own.
const BAD_RECORDS: [(&str, &str, &[&str], &[&str]); 3] = [
    ("no_unit.csv", "time,a_g\n0,0\n0.01,1\n", &[], &["no_unit.csv", "unit"]),
    ("nan.csv", "time,a_g\n0,0\n0.01,nan\n", &["--unit", "g"], &["nan.csv", "line 3", "nan"]),
    ("unit.csv", "time,a_g\n0,0\n0.01,1\n", &["--unit", "furlong"], &["furlong", "m/s2"]),
];

#[test]
fn bad_records() {
    let folder = folder("bad_records");
    for (name, content, extra, words) in BAD_RECORDS {
        std::fs::write(folder.join(name), content).unwrap();
        let arguments = [&["simulate", "--csv", "out.csv", "--record", name][..], extra].concat();
        refused(&folder, &arguments, words);
    }
    // a gigabyte of noise is refused for its size, before it is read
    let file = std::fs::File::create(folder.join("huge.csv")).unwrap();
    file.set_len(1 << 30).unwrap();
    refused(&folder, &["simulate", "--record", "huge.csv", "--unit", "g"], &["huge.csv"]);
}

#[test]
fn bad_arguments() {
    let folder = folder("bad_arguments");
    refused(&folder, &["simulate", "--set", "xi"], &["NAME=VALUE"]);
    refused(&folder, &["simulate", "--set", "mass=3"], &["mass", "height"]);
    refused(&folder, &["simulate", "--set", "xi=11"], &["xi", "11", "10"]);
    refused(&folder, &["simulate", "--set", "xi=-2"], &["xi = -2.0 is below its minimum, -1.0\n"]);
    refused(&folder, &["simulate", "--set", "xi=-0.5"], &["xi = -0.5", "0 or more, or -1 where"]);
    let sources = "restitution_source = \"given\" is not one of ";
    refused(&folder, &["simulate", "--set", "restitution_source=given"], &[sources]);
    refused(&folder, &["simulate", "--set", "xi=much"], &["xi = \"much\": expected a number"]);
    refused(
        &folder,
        &["simulate", "--set", "xi=0,03"],
        &["xi = \"0,03\": expected a number with a decimal point"],
    );
    // what Rust says of numbers
    let decimal = "expected a number with a decimal point, such as 0.3";
    fails(&folder, &["simulate", "--synthetic", "--scale", "0,3"], &["--scale", "0,3", decimal]);
    fails(
        &folder,
        &["study", "ida", "s.toml", "--threads", "0"],
        &["--threads", "expected a number from 1 on"],
    );
    refused(&folder, &["simulate", "--hold"], &["--hold", "motion"]);
    refused(&folder, &["verify", "accuracy", "--budget", "-1"], &["--budget -1", "3600 s"]);
    refused(&folder, &["verify", "accuracy", "--synthetic", "scene.toml"], &["--synthetic", "[motion]"]);
    refused(&folder, &["simulate", "--stop-time", "-1"], &["stop_time = -1 must be above 0"]);
    refused(&folder, &["simulate", "--csv", "no/such/folder.csv"], &["folder.csv"]);
    let plain = &crate::root().join("scenes/plain_parapet.toml").display().to_string();
    refused(
        &folder,
        &["package", plain, "-o", "x.fmu", "--base", "none.fmu"],
        &["none.fmu", "cargo xtask fmu"],
    );
    std::fs::write(folder.join("broken.fmu"), "PK").unwrap();
    refused(&folder, &["package", plain, "-o", "x.fmu", "--base", "broken.fmu"], &["broken.fmu"]);
}

/// A message states each cause once. It names the file, also if the error lies in a combination of
/// parameters.
#[test]
fn messages_name_the_file_once() {
    let folder = folder("messages");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("plateau.toml", "[force_law]\nforce_law = \"trilinear\"\na1 = 0.9\n");
    refused(&folder, &["simulate", "plateau.toml"], &["plateau.toml: d1 = 0.85", "a3 - a1 = 0.100000 "]);
    refused(&folder, &["describe", "plateau.toml"], &["plateau.toml: d1 = 0.85"]);
    write("record.csv", "time,a\n0,0\n0.01,1\n");
    write("shaken.toml", "[motion]\nrecord = \"record.csv\"\n");
    let message = text(&wall(&folder, &["simulate", "shaken.toml"]).stderr);
    assert_eq!(message.matches("record.csv").count(), 1, "{message}");
    assert_has(&message, &["shaken.toml, line 1", "`unit`"]);
    refused(&folder, &["simulate", "--record", "record.csv"], &["--unit"]);
    refused(&folder, &["simulate", "record.csv"], &["record.csv, line 1", "--record"]);
}

/// A record of 65 g has a wrong unit: the run warns about it, as `wall record` does.
#[test]
fn a_doubtful_record_is_noted() {
    let folder = folder("doubtful");
    let mut record = "time,a\n".to_owned();
    for k in 0..=200 {
        let (time, envelope) = (0.01 * f64::from(k), f64::from(k * (200 - k)) / 1e4);
        writeln!(record, "{time:.2},{:.6}", 640.0 * envelope * (10.0 * time).sin()).unwrap();
    }
    std::fs::write(folder.join("record.csv"), record).unwrap();
    let output =
        wall(&folder, &["simulate", "--record", "record.csv", "--unit", "m/s2", "--html", "page.html"]);
    assert_eq!(output.code, 0);
    let (summary, message) = (text(&output.stdout), text(&output.stderr));
    assert_has(&message, &["record.csv: unit: a peak of", "cm/s2"]);
    assert_has(&summary, &["1.0000 u_ins, where the wall falls\n", "mm, fallen\n"]);
}

/// Every example scene runs and stands or overturns as expected; summary and history agree.
#[test]
fn example_scenes() {
    let folder = folder("example_scenes");
    let scenes = crate::root().join("scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(scenes).unwrap() {
        let scene = entry.unwrap().path();
        if scene.is_dir() {
            // the walls of a building are tested with `wall building`
            continue;
        }
        let summary = json(&folder, &["simulate", scene.to_str().unwrap(), "--csv", "out.csv", "--json"]);
        let history = content(&folder, "out.csv");
        let column =
            history.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
        let largest = column.fold(0.0_f64, |largest, u| largest.max(u.abs()));
        let peak = summary["u_max"].as_f64().unwrap();
        // the history has no sample at the turning point itself
        assert!(largest <= peak && largest >= 0.99 * peak, "{}: {largest} for {peak}", scene.display());
        assert_eq!(summary["overturned"], false, "{}", scene.display());
        count += 1;
    }
    assert!(count >= 5);
}

/// The JSON forms are JSON; describe and simulate agree with the library.
#[test]
fn machine_readable_output() {
    let folder = folder("machine_readable");
    let facts = json(&folder, &["describe", "--json"]);
    // Figure 2's wall: m = 1800 · 4 · 0.4 · 1, m_eff = 4/3 m, u_ins = b/2, F0 = W b/h
    assert_eq!(facts["mass"], 2880.0);
    assert_eq!(facts["effective_mass"], 3840.0);
    for (name, expected) in [("u_ins", 0.2), ("F0", 2825.28)] {
        let found = facts[name].as_f64().unwrap();
        assert!((found - expected).abs() < 1e-12 * expected, "{name}: {found}");
    }
    let schema = json(&folder, &["schema"]);
    assert_eq!(schema["properties"]["damping"]["properties"]["xi"]["maximum"], 10.0);
    assert!(schema["$defs"]["MotionTable"]["properties"]["record"].is_object());
    for shell in ["bash", "zsh", "fish"] {
        assert_has(&printed(&folder, &["completions", shell]), &["simulate"]);
    }
}

/// A scene written by `to_toml` into an FMU is read back unchanged.
#[test]
fn a_scene_survives_being_written() {
    use scene::{Scene, to_toml};
    for name in ["plain_parapet", "strip_between_floors", "quadrilinear_strip"] {
        let path = crate::root().join(format!("scenes/{name}.toml"));
        let mut scene = Scene::read(&path).unwrap();
        scene.excitation = None;
        let written = to_toml(&scene, "");
        let read = Scene::parse("written", &written, Path::new(".")).unwrap();
        assert_eq!(read.parameters, scene.parameters, "{name}");
        assert_eq!((read.inputs, read.stop_time), (scene.inputs, scene.stop_time), "{name}");
        assert_eq!(read.title, scene.title);
    }
}
