//! Tests what is said of scenes that cannot be read: key, line and what is expected, in plain words.

use std::path::Path;

use files::check_value;
use scene::{Document, Scene};

use crate::broken::walk;

/// Asserts that a text is refused with a line and some words.
#[track_caller]
fn assert_says(text: &str, message: &str) {
    let found = refused(text);
    assert!(found.starts_with("scene.toml, line ") && found.contains(message), "{found}\nfor {message}");
}

fn refused(text: &str) -> String {
    Scene::parse("scene.toml", text, Path::new(".")).unwrap_err().to_string()
}

/// All that is not TOML has one message: the line, and how lines are written.
#[test]
fn what_is_not_toml_is_shown_with_the_way_to_write_it() {
    for (text, line) in [
        ("[geometry]\nthickness = 0,30\n", "line 2: cannot read `thickness = 0,30`"),
        (
            "damping = { xi = -0,03, c_bar = 1 }\n",
            "line 1: cannot read `damping = { xi = -0,03, c_bar = 1 }`",
        ),
        ("[geometry]\nheight = .5\n", "line 2: cannot read `height = .5`"),
        ("[geometry]\nheight = 3 m\n", "line 2: cannot read `height = 3 m`"),
        ("[force_law]\nforce_law = bilinear\n", "line 2: cannot read `force_law = bilinear`"),
        ("[supports]\ndrift = True\n", "line 2: cannot read `drift = True`"),
        ("height: 3\n", "line 1: cannot read `height: 3`"),
        ("[geometry]\nheight =\nthickness = 0.3\n", "line 2: cannot read `height =`"),
        ("[geometry\nheight = 3\n", "line 1: cannot read `[geometry`"),
        ("title = “a”\n", "line 1: cannot read `title = “a”`"),
        ("// a scene\n", "line 1: cannot read `// a scene`"),
        ("[motion]\nrecord = \"C:\\acc.AT2\"\n", "line 2: cannot read `record = \"C:\\acc.AT2\"`"),
        ("[start]\r[geometry]\r", "line 1: cannot read `[start]\\r[geometry]`"),
    ] {
        let found = refused(text);
        let rest = found.strip_prefix(&format!("scene.toml, {line}: ")).unwrap_or_else(|| panic!("{found}"));
        for remedy in ["key = value", "# comment", "decimal point and no unit", "straight quotes", "closed"] {
            assert!(rest.contains(remedy), "{found}");
        }
    }
}

/// The reader stops at the first line that cannot go on with what is open, which is right by itself.
#[test]
fn what_is_not_closed_accuses_no_line_below() {
    for (text, line) in [
        ("thresholds = [1,\n\n[geometry]\nheight = 3\n", 4),
        ("thresholds = [1,\noutput_step = 0.1\n", 2),
        ("[motion]\nsine = { amplitude = 3,\n[geometry]\nheight = 3\n", 3),
        ("title = \"\"\"a\n[geometry]\nheight = 3\n", 4),
    ] {
        let found = refused(text);
        let start = format!("scene.toml, line {line}: a list, table or text above is not closed");
        assert!(found.starts_with(&start), "{found}");
    }
    // nothing is open here
    assert_says("title = 3\n[title.of]\n", "line 2: `[title.of]` adds to a value that is given above");
}

/// Full rotations of a strip know one motion for both supports, a parapet has one support.
#[test]
fn a_motion_of_the_top_is_refused_at_its_table() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join("apart.csv"), "0.0\n1.0\n0.0\n").unwrap();
    let record = "record = \"apart.csv\"\nunit = \"m/s2\"\nstep = 0.1\n";
    for (wall, start) in [
        (
            "mechanism = \"vertical_spanning\"\nkinematics = \"trigonometric\"\n",
            "scene.toml, line 4: kinematics = trigonometric knows one motion for both supports; leave",
        ),
        (
            "mechanism = \"parapet\"\n",
            "scene.toml, line 3: a parapet has no top support; leave [motion.top] out",
        ),
    ] {
        let text = format!("[geometry]\n{wall}[motion]\n{record}[motion.top]\n{record}");
        let error = Scene::parse("scene.toml", &text, folder).unwrap_err().to_string();
        assert!(error.starts_with(start), "{error}");
    }
}

#[test]
fn a_value_by_itself_is_checked_by_the_limits_of_its_key() {
    for (key, value, message) in [
        ("stop_time", f64::NAN, "stop_time = NaN must be above 0 and at most 1e7: "),
        ("stop_time", f64::INFINITY, "stop_time = inf must be above 0 and at most 1e7: "),
        ("Stop_Time", 1.0, "unknown key \"Stop_Time\" (did you mean \"stop_time\"?)"),
    ] {
        let error = check_value::<Document>(key, value).unwrap_err();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn messages_name_line_and_key_and_what_is_expected() {
    for (text, message) in [
        (
            "[geometry]\nthickness = \"0,30\"\n",
            "line 2: thickness = \"0,30\": expected a number with a decimal point, without a unit",
        ),
        ("[geometry]\nheight = true\n", "line 2: height = true: expected a number"),
        ("stop_time = \"20 s\"\n", "line 1: stop_time = \"20 s\": expected a number with a decimal point"),
        ("height = 3\n", "line 1: \"height\" belongs in [geometry]"),
        (
            "[geomtry]\nheight = 3\n",
            "line 1: unknown key \"geomtry\" (did you mean \"geometry\"?); it holds title,",
        ),
        (
            "[motion]\nRecord = \"a\"\n",
            "line 2: unknown key \"Record\" in [motion] (did you mean \"record\"?)",
        ),
        (
            "[motion]\nricker = { amplitude = 3, frequency = 1 }\n",
            "line 2: centre is missing in [motion.ricker]; add it",
        ),
        ("geometry = 3\n", "line 1: geometry = 3: expected a table"),
        ("[motion]\nrecord = 3\n", "line 2: record = 3: expected a path in quotes"),
        ("[[storeys]]\nmass = \"heavy\"\n", "line 2: mass = \"heavy\": expected a number"),
        ("[motion]\nsynthetic = { seed = -1 }\n", "line 2: seed = -1: expected a whole number from 0 on"),
        ("[motion]\nsynthetic = {}\npga = true\n", "pga = true: expected an acceleration"),
        ("[supports]\ndrift = 1\n", "drift = 1: expected true or false"),
    ] {
        assert_says(text, message);
    }
}

#[test]
fn a_doubled_key_is_named_with_its_line() {
    for (text, message) in [
        ("[start]\nu_start = 0\nu_start = 1\n", "line 3: u_start is given twice; leave one out"),
        ("title = \"xi = 0,3\"\ntitle = \"b\"\n", "line 2: title is given twice"),
        ("damping = { c_bar = 1, xi = 0.1, xi = 0.2 }\n", "line 1: xi is given twice; leave one out"),
        ("[start]\nu_start = 1\n[geometry]\n[start]\n", "line 4: start is given twice; leave one out"),
        ("start.u_start = 1\nstart.u_start = 2\n", "line 2: u_start is given twice; leave one out"),
        ("[start]\nvelocity = \"a\"\n\"velocity\" = 2\n", "line 3: velocity is given twice"),
    ] {
        assert_says(text, message);
    }
}

#[test]
fn a_value_that_is_set_is_told_how_to_write_a_number() {
    let error = Scene::default().set("overburden", "1,2e6").unwrap_err().to_string();
    assert!(error.starts_with("overburden = \"1,2e6\": expected a number with a decimal point"), "{error}");
}

/// Every line of a scene with all tables, broken in every way.
#[test]
fn no_message_speaks_in_words_of_the_reader() {
    let scene = "title = \"a\"\nstop_time = 3\nthresholds = [0.1, 1]\ninputs = [\"a_g\"]\n[geometry]\n\
                 height = 3.0\nmechanism = \"parapet\"\n[motion]\n\
                 ricker = { amplitude = 3, frequency = 1, centre = 1 }\npga = \"0.3g\"\n[[storeys]]\n\
                 period = 0.3\n[supports]\nbottom = 1\ndrift = false\n";
    walk(scene, |text| Scene::parse("scene.toml", text, Path::new(".")));
}
