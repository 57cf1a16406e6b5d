//! Tests what is said of scenes that cannot be read: key, line and what is expected, in plain words.

use std::path::Path;

use rocking_wall::scene::Scene;

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

#[test]
fn messages_name_line_and_key_and_say_how_to_write_it() {
    for (text, message) in [
        (
            "[geometry]\nthickness = 0,30\n",
            "line 2: thickness = 0,30: a number has a decimal point, not a comma; write thickness = 0.30",
        ),
        ("damping = { xi = -0,03, c_bar = 1 }\n", "line 1: xi = -0,03: a number has a decimal point"),
        ("[geometry]\nthickness = \"0,30\"\n", "line 2: thickness = 0,30: a number has a decimal point"),
        ("[geometry]\nheight = .5\n", "line 2: height = .5: a number has digits on both sides of its point"),
        ("[geometry]\nheight = 3.\n", "write height = 3.0"),
        (
            "[geometry]\nheight = 3 m\n",
            "height = 3 m: a number stands without its unit; write height = 3, if",
        ),
        ("[geometry]\nheight = \"1.2 m\"\n", "write height = 1.2, if that is its value in m"),
        ("stop_time = \"20 s\"\n", "line 1: stop_time = 20 s: a number stands without its unit"),
        ("[force_law]\nforce_law = bilinear\n", "stands in quotes, force_law = \"bilinear\""),
        ("[supports]\ndrift = True\n", "drift = True: write true"),
        ("height: 3\n", "line 1: expected key = value: write height = 3, in `height: 3`"),
        ("height 3\n", "line 1: expected key = value: write height = 3"),
        ("[geometry]\nheight =\nthickness = 0.3\n", "line 2: height has no value; give one"),
        ("[geometry\nheight = 3\n", "line 1: a table's name stands in brackets"),
        ("title = \"a\n", "line 1: title: a quotation mark is missing"),
        ("title = “a”\n", "straight quotes"),
        ("// a scene\n", "line 1: a comment begins with #"),
        ("[motion]\nrecord = \"C:\\acc.AT2\"\n", "record: write / for \\"),
        ("[start]\r[geometry]\r", "line 1: the lines end with CR alone"),
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
            "line 2: motion.ricker needs centre; add it",
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
fn advice_on_numbers_keeps_their_exponents() {
    for (text, message) in [
        (
            "[geometry]\noverburden = 1,2e6\n",
            "overburden = 1,2e6: a number has a decimal point, not a comma; write overburden = 1.2e6",
        ),
        (
            "[geometry]\noverburden = \"1,2E+6\"\n",
            "line 2: overburden = 1,2E+6: a number has a decimal point",
        ),
        (
            "[geometry]\noverburden = 3.e5\n",
            "overburden = 3.e5: a number has digits on both sides of its point; write overburden = 3.0e5",
        ),
        ("[geometry]\nheight = .5e-3\n", "height = .5e-3: a number has digits on both sides"),
        ("[geometry]\nheight = .5e-3\n", "write height = 0.5e-3"),
        ("[geometry]\noverburden = 3e3 N\n", "a number stands without its unit; write overburden = 3e3, if"),
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
fn a_value_that_is_set_keeps_its_exponent() {
    let error = Scene::default().set("overburden", "1,2e6").unwrap_err().to_string();
    assert!(error.ends_with("write overburden = 1.2e6"), "{error}");
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
