//! What the program `wall` writes: files in place of others, and text on a terminal.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::command_line::{
    assert_has, content, fails, folder, json, printed, program, refused, setting, succeed, text, wall,
};

const SCENE: &str = "title = \"A wall\"\nstop_time = 1\n[geometry]\nheight = 3\n";

fn scene(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    fs::write(folder.join("s.toml"), SCENE).unwrap();
    folder
}

/// A record that leaves the ground at rest.
const RECORD: &str = "time,a_g\n0,0\n0.1,0.1\n0.2,0\n0.3,-0.2\n0.4,0\n0.5,0.1\n0.6,0\n";

#[test]
fn an_output_is_no_input_and_no_other_output() {
    let folder = scene("outputs_inputs");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("r.csv", RECORD);
    write("shaken.toml", "[motion]\nrecord = \"r.csv\"\nunit = \"g\"\n");
    let checked = crate::root().join("scenes/checked_parapet.toml");
    fs::copy(checked, folder.join("checked.toml")).unwrap();
    let record = ["--record", "r.csv", "--unit", "g"];
    let pdf = ["no output is a PDF", "ends in .html", "from a browser"];
    let cases: [(&[&str], &[&str]); 9] = [
        (&["check", "checked.toml", "--report", "a.pdf"], &pdf),
        (&["simulate", "s.toml", "--html", "a.PDF"], &pdf),
        (&["simulate", "s.toml", "--csv", "s.toml"], &["s.toml", "the input s.toml"]),
        (&["simulate", "s.toml", "--csv", "x", "--html", "./x"], &["./x", "the output x"]),
        (&["simulate", "shaken.toml", "--csv", "r.csv"], &["the input", "r.csv"]),
        (&[&["simulate", "--html", "r.csv"], &record[..]].concat(), &["the input r.csv"]),
        (&["describe", "s.toml", "--csv", "y.svg", "--plot", "y.svg"], &["the output y.svg"]),
        (&["record", "r.csv", "--unit", "g", "--csv", "r.csv"], &["the input r.csv"]),
        (&["package", "s.toml", "-o", "s.toml", "--base", "b.fmu"], &["the input s.toml"]),
    ];
    for (arguments, words) in cases {
        refused(&folder, arguments, words);
        assert_eq!(content(&folder, "s.toml"), SCENE, "{arguments:?}");
        assert_eq!(content(&folder, "r.csv"), RECORD, "{arguments:?}");
    }
    // the results of a study beside a record of the same name
    write("study.toml", "[[walls]]\nscene = \"s.toml\"\n[records]\nfiles = [\"levels.csv\"]\nunit = \"g\"\n");
    let study = content(&folder, "study.toml");
    write(
        "study.toml",
        &format!("models = [\"CR\"]\nlevels = {{ method = \"grid\", values = [0.1] }}\n{study}"),
    );
    write("levels.csv", RECORD);
    refused(&folder, &["study", "ida", "study.toml", "-o", "."], &["levels.csv", "the input"]);
    assert_eq!(content(&folder, "levels.csv"), RECORD);
    // a result that is a link to the record, and a record that is a link to a result
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        write("study.toml", &content(&folder, "study.toml").replace("levels.csv", "r.csv"));
        fs::create_dir(folder.join("linked")).unwrap();
        symlink("../r.csv", folder.join("linked/levels.csv")).unwrap();
        let linked = ["study", "ida", "study.toml", "-o", "linked"];
        refused(&folder, &linked, &["linked/levels.csv", "the input r.csv"]);
        assert_eq!(content(&folder, "r.csv"), RECORD);
        fs::remove_file(folder.join("linked/levels.csv")).unwrap();
        fs::rename(folder.join("r.csv"), folder.join("linked/levels.csv")).unwrap();
        symlink("linked/levels.csv", folder.join("r.csv")).unwrap();
        refused(&folder, &linked, &["linked/levels.csv", "the input r.csv"]);
        assert_eq!(content(&folder, "r.csv"), RECORD);
    }
    // devices and pipes may be shared
    #[cfg(unix)]
    succeed(&folder, &["simulate", "s.toml", "--csv", "/dev/null", "--html", "/dev/null"]);
}

#[cfg(unix)]
#[test]
fn what_stands_at_the_path_of_an_output_stays() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let folder = scene("outputs_stay");
    let at = |name: &str| folder.join(name);
    let kind = |path: &Path| fs::symlink_metadata(path).unwrap().file_type();
    let run = |csv: &str| succeed(&folder, &["simulate", "s.toml", "--csv", csv]);

    run("plain.csv");
    let history = fs::read(at("plain.csv")).unwrap();
    // a file keeps its permissions, a link stays and its target is written, also one that is not there yet
    fs::set_permissions(at("plain.csv"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink("plain.csv", at("link.csv")).unwrap();
    symlink("new.csv", at("to_new.csv")).unwrap();
    fs::write(at("plain.csv"), "old").unwrap();
    run("link.csv");
    run("to_new.csv");
    assert!(kind(&at("link.csv")).is_symlink() && kind(&at("to_new.csv")).is_symlink());
    assert_eq!(fs::metadata(at("plain.csv")).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(fs::read(at("plain.csv")).unwrap() == history && fs::read(at("new.csv")).unwrap() == history);

    // a pipe and a device take the bytes and stay
    assert!(Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    let path = at("pipe");
    let reader = std::thread::spawn(move || fs::read(path).unwrap());
    run("pipe");
    assert!(reader.join().unwrap() == history && kind(&at("pipe")).is_fifo());
    run("/dev/null");
    assert!(kind(Path::new("/dev/null")).is_char_device());
    let output = program(&folder, &["simulate", "s.toml", "--csv", "/dev/stdout"]).output().unwrap();
    assert!(output.stdout.starts_with(&history), "{}", text(&output.stdout));

    // a folder is no file, and a full device takes nothing
    fs::create_dir(at("taken")).unwrap();
    refused(&folder, &["simulate", "s.toml", "--csv", "taken"], &["taken: cannot be written"]);
    refused(&folder, &["simulate", "s.toml", "--csv", "/dev/full"], &["/dev/full: cannot be written"]);
    let mut left: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["link.csv", "new.csv", "pipe", "plain.csv", "s.toml", "taken", "to_new.csv"]);
}

/// A stderr that cannot be written does not change the outcome.
#[cfg(target_os = "linux")]
#[test]
fn a_lost_stderr_does_not_end_the_program() {
    let folder = scene("lost_stderr");
    let full = || Stdio::from(fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
    let status = |arguments: &[&str]| {
        program(&folder, arguments).stdout(Stdio::null()).stderr(full()).status().unwrap()
    };
    assert_eq!(status(&["simulate", "none.toml"]).code(), Some(2));
    // a wall that never comes to rest brings a warning
    let settings = "impact=restitution restitution=1 damping_model=none";
    let arguments = setting("simulate s.toml --csv x.csv", settings);
    assert!(text(&succeed(&folder, &arguments).stderr).contains("warning"));
    fs::remove_file(folder.join("x.csv")).unwrap();
    assert_eq!(status(&arguments).code(), Some(0));
    assert!(folder.join("x.csv").exists());
}

#[test]
fn no_file_controls_the_terminal() {
    let folder = folder("control");
    let title = "title = \"red \\u001B[31m, back \\b\\r, CSI \\u009B2J, reversed \\u202Etxt\"\n";
    fs::write(folder.join("s.toml"), format!("{title}stop_time = 1\n")).unwrap();
    fs::write(folder.join("bad.toml"), "[geometry]\n\"\\u001B]0;title\\u0007\" = 1\n").unwrap();
    let is_obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    let shown = |arguments: &[&str]| {
        let output = wall(&folder, arguments);
        let shown = text(&output.stdout) + &text(&output.stderr);
        assert!(!shown.contains(is_obeyed), "{arguments:?}: {shown:?}");
        shown
    };
    let summary = shown(&["simulate", "s.toml"]);
    assert!(summary.contains("red \\u001b[31m, back \\u0008\\u000d, CSI \\u009b2J, reversed \\u202etxt"));
    assert!(shown(&["simulate", "bad.toml"]).contains("line 2"));
    // the title in JSON stays what it is
    let value: serde_json::Value = serde_json::from_str(&shown(&["simulate", "s.toml", "--json"])).unwrap();
    assert_eq!(value["title"], "red \u{1b}[31m, back \u{8}\r, CSI \u{9b}2J, reversed \u{202e}txt");
}

#[test]
fn messages_are_short() {
    let folder = folder("short_messages");
    let long = "x".repeat(100_000);
    fs::write(folder.join("key.toml"), format!("[geometry]\n{long} = 1\n")).unwrap();
    fs::write(folder.join("lines.toml"), format!("[geometry]\n\"{}\" = 1\n", "a\\n".repeat(1000))).unwrap();
    let message = |arguments: &[&str]| {
        let message = text(&wall(&folder, arguments).stderr);
        assert!(message.lines().count() < 10, "{arguments:?}: {} lines", message.lines().count());
        assert!(message.chars().count() <= 2000, "{arguments:?}: {} characters", message.chars().count());
        message
    };
    assert!(message(&["simulate", "key.toml"]).contains("overburden"), "it says what is known");
    message(&["simulate", "lines.toml"]);
    let names: Vec<String> = (0..30).map(|k| format!("{k}.csv")).collect();
    for name in &names {
        fs::write(folder.join(name), "time,a\n0,0\n1,nan\n").unwrap();
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let told = message(&[&["record", "--unit", "g"], &names[..]].concat());
    assert_has(&told, &["0.csv", "30 of 30 files could not be read"]);
    // numbers as people write them
    let pulse = "[motion.ricker]\namplitude = 1\nfrequency = 0.3\ncentre = 4\n";
    fs::write(folder.join("pulse.toml"), pulse).unwrap();
    let summary = printed(&folder, &["simulate", "pulse.toml"]);
    assert!(summary.split(|c: char| !c.is_ascii_digit()).all(|digits| digits.len() < 8), "{summary}");
    for (arguments, number) in [
        (["simulate", "--set", "xi=1e300"], "xi = 1e300 is"),
        (["simulate", "--set", "height=1e-300"], "height = 1e-300 m is"),
        (["simulate", "--stop-time", "1e300"], "--stop-time: stop_time = 1e300 must"),
        (["simulate", "--output-step", "0"], "--output-step: output_step = 0 must"),
        (["describe", "--thresholds", "2"], "--thresholds: thresholds = 2 must"),
        (["simulate", "--thresholds", "1e22"], "--thresholds: thresholds = 1e22 must"),
        (["simulate", "--set", "xi=10.000000000000002"], "maximum, 10"),
    ] {
        refused(&folder, &arguments, &[number]);
    }
}

#[test]
fn a_peak_acceleration_may_have_a_unit() {
    let folder = folder("pga_unit");
    let peak = |pga: &str| {
        let told = json(&folder, &["record", "--synthetic", "--pga", pga, "--json"]);
        format!("{:.4}", told["records"][0]["pga_g"].as_f64().unwrap() * 9.80665)
    };
    assert_eq!(peak("2.5"), "2.5000");
    for (pga, expected) in
        [("0.3g", "2.9420"), ("0.3 g", "2.9420"), ("250cm/s2", "2.5000"), ("2.5e2 gal", "2.5000")]
    {
        assert_eq!(peak(pga), expected, "{pga}");
    }
    for pga in ["0.3h", "g", "0.3g0", ""] {
        fails(&folder, &["record", "--synthetic", "--pga", pga, "--samples", "x.csv"], &["such as 0.3g"]);
    }
}

#[test]
fn the_csv_of_a_motion_is_a_record_with_its_unit() {
    let folder = folder("motion_csv");
    succeed(&folder, &["record", "--synthetic", "--samples", "a.csv"]);
    succeed(&folder, &["record", "a.csv", "--samples", "b.csv"]);
    let [first, second] = ["a.csv", "b.csv"].map(|name| content(&folder, name));
    assert!(first == second, "not read back as it was written");
    // importers look for the column of the input
    assert_eq!(first.lines().next().unwrap().split(',').nth(1), Some("a_g"));
    let conflict = ["record", "a.csv", "--unit", "g", "--samples", "c.csv"];
    refused(&folder, &conflict, &["a.csv, line 1", "the stated unit g", "m/s2"]);
}

#[test]
fn a_mistyped_key_gets_the_nearest_name() {
    let folder = folder("mistyped");
    for (content, words) in [
        ("[geometry]\nhieght = 3\n", ["line 2", "did you mean \"height\"?"]),
        ("[geomtry]\nheight = 3\n", ["line 1", "did you mean \"geometry\"?"]),
        ("stop_tme = 3\n", ["line 1", "did you mean \"stop_time\"?"]),
        ("[motion]\nrecrod = \"a\"\n", ["line 2", "did you mean \"record\"?"]),
        ("inputs = [\"a_botom\"]\n", ["line 1", "is not one of the inputs a_g, a_bottom"]),
    ] {
        fs::write(folder.join("s.toml"), content).unwrap();
        refused(&folder, &["simulate", "s.toml"], &words);
    }
    refused(&folder, &["simulate", "--set", "thicknes=0.3"], &["did you mean \"thickness\"?"]);
    let study = "models = [\"CR\"]\nlevels = { method = \"grid\", values = [0.1] }\n\
                 records = { synthetic = { count = 1 } }\n";
    for (content, words) in [
        ("[[wals]]\nname = \"1\"\n", ["line 4", "did you mean \"walls\"?"]),
        (
            "[[walls]]\nname = \"1\"\n[walls.geometry]\ntickness = 1\n",
            ["line 7", "did you mean \"thickness\"?"],
        ),
        ("[reprot]\nseed = 1\n", ["line 4", "did you mean \"report\"?"]),
    ] {
        fs::write(folder.join("study.toml"), format!("{study}{content}")).unwrap();
        refused(&folder, &["study", "ida", "study.toml", "-o", "new"], &words);
    }
}
