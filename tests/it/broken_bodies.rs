//! Tests what is wrong with parts, openings, loads and integrals: place, value and remedy.

use std::path::Path;

use rocking_wall::wall::{Parameters, Wall};
use scene::Scene;

const PART: &str = "[[geometry.part]]\nheight = 3.0\nthickness = 0.3\n";
const BODY: &str =
    "[geometry.body]\nmass = 1e3\ncentroid_height = 1.0\ninertia = 2e3\narm = 0.1\nheight = 2.5\n";
const LOAD: &str = "[[geometry.load]]\nheight = 2.5\ninside = 0.1\n";

fn refused(text: &str) -> String {
    let scene = Scene::parse("s.toml", &format!("{text}\n[start]\nu_start = 0.0\n"), Path::new("nowhere"));
    match scene.map(|scene| Wall::new(&scene.parameters)) {
        Err(error) => error.to_string(),
        Ok(Err(error)) => error.to_string(),
        Ok(Ok(_)) => "accepted".to_owned(),
    }
}

#[test]
fn parts_that_make_no_wall_are_refused_at_their_table() {
    let part = |more: &str| format!("{PART}[[geometry.part]]\nthickness = 0.3\n{more}");
    for (text, message) in [
        (
            part("base = 4.0\nheight = 1.0"),
            "line 4: part 2: floats: no part touches it from its base = 4 m on",
        ),
        (part("height = 1.0\nouter = 0.5"), "line 4: part 2: floats"),
        (part("base = 2.0\nheight = 2.0"), "line 4: part 2: overlaps part 1 between 2 m and 4 m; give base"),
        (part("base = 0.0\nheight = 1.0\nouter = 5.0"), "line 4: part 2: floats"),
        (
            "[[geometry.part]]\nheight = 3.0\nthickness = 0.1\nouter = [0.0, 1.0]\n\
             [[geometry.part]]\nbase = 0.0\nheight = 3.0\nthickness = 0.1\nouter = [0.7, -0.3]"
                .into(),
            "part 2: overlaps part 1",
        ),
        (
            format!("{PART}width = [1.0, 0.0]\n[[geometry.part]]\nheight = 1.0\nthickness = 0.3"),
            "line 5: part 2: floats",
        ),
        (
            "[[geometry.parts]]\nheight = 3.0".into(),
            "unknown key \"parts\" in [geometry] (did you mean \"part\"?)",
        ),
        ("[[part]]\nheight = 3.0".into(), "\"part\" belongs in [geometry]"),
        (part("densty = 1800"), "unknown key \"densty\" in [geometry.part] (did you mean \"density\"?)"),
        (PART.replace("0.3", "-0.3"), "line 1: part 1: thickness = -0.3 m must be from 0.0001 to 100 m"),
        (PART.replace("0.3", "[0, 0]"), "part 1: thickness = 0 m must be"),
        (
            PART.replace("0.3", "[0.3, 0.2, 0.1]"),
            "line 3: thickness = [0.3, 0.2, 0.1]: expected a number, or",
        ),
        (PART.replace("0.3", "\"0.3\""), "line 3: thickness = \"0.3\": expected a number, or [bottom, top]"),
        (PART.replace("thickness = 0.3", ""), "line 1: thickness is missing in [geometry.part]; add it"),
        (format!("{PART}width = 1e6"), "part 1: width = 1000000 m must be from 0.001 to 1000 m"),
        (format!("{PART}base = 1.0"), "line 1: part 1: base = 1 m and outer = 0 m at its foot must be 0"),
        (format!("{PART}outer = 0.1"), "part 1: base = 0 m and outer = 0.1 m at its foot must be 0"),
        ("[geometry]\npart = 3".into(), "line 2: part = 3: expected a table"),
        (
            format!("[geometry]\nheight = 3.0\n{PART}"),
            "line 2: height is that of a rectangle; [[geometry.part]]",
        ),
        (format!("{PART}{BODY}"), "line 4: [geometry.body] stands in place of [[geometry.part]]; leave one"),
    ] {
        let found = refused(&text);
        assert!(found.contains(message), "{text}\n{found}");
    }
    let many = format!("[geometry]\npart = [{}]", "{ height = 1.0, thickness = 0.3 }, ".repeat(201));
    assert!(refused(&many).contains("a wall has at most 200, this one has 201"));
}

#[test]
fn openings_and_loads_that_do_not_fit_are_refused_at_their_table() {
    let opening = |keys: &str| format!("{PART}[[geometry.opening]]\nheight = 1.0\n{keys}");
    let load = |keys: &str| format!("{PART}{LOAD}{keys}");
    for (text, message) in [
        (opening("base = 2.5\nwidth = 0.5"), "line 4: opening 1: from 2.5 m to 3.5 m is not within the wall"),
        (
            opening("base = 1.0\nwidth = 1.0"),
            "opening 1: width = 1 m must be smaller than that of part 1 there",
        ),
        (
            opening("base = 1.0\nwidth = 0.5\nouter = 0.2"),
            "line 4: outer is that of a hollow; give its thick",
        ),
        (
            opening("base = 1.0\nwidth = 0.5\nouter = 0.2\nthickness = 0.2"),
            "opening 1: is in no part: thickness and outer have to lie within one",
        ),
        (
            opening("base = 1.0\nwidth = 0.6\n[[geometry.opening]]\nbase = 1.5\nheight = 1.0\nwidth = 0.5"),
            "line 8: opening 2: at 1.5 m openings take 1.1 m of a width of 1 m; leave some of the wall",
        ),
        (
            // the first is within the second
            opening("base = 1.4\nwidth = 0.6\n[[geometry.opening]]\nbase = 1.0\nheight = 2.0\nwidth = 0.6"),
            "opening 2: at 1.4 m openings take 1.2 m of a width of 1 m",
        ),
        (load("force = -1e3"), "line 7: force = -1000 must be at least 0"),
        (load("force = 1e3\nmoving_mass = 2"), "moving_mass = 2 must be at least 0 and at most 1"),
        (
            load("force = 1e3").replace("2.5", "3.5"),
            "line 4: load 1: height = 3.5 m must be above 0 and at most",
        ),
        (load("force = 1e3").replace("= 0.1", "= 100"), "load 1: inside = 100 m is farther from the wall"),
        (
            load("force = 1e3\nthrust = 1e5"),
            "for u > 0: F0 = -165010.78 N must be positive, but thrusts with a moment of",
        ),
        (format!("{LOAD}force = 1e3"), "openings and loads are those of a wall of parts; give the wall as"),
    ] {
        let found = refused(&text);
        assert!(found.contains(message), "{text}\n{found}");
    }
    // two windows, one above the other, may take more than the width together
    let stacked = "base = 0.5\nwidth = 0.6\n[[geometry.opening]]\nbase = 1.5\nheight = 1.0\nwidth = 0.5";
    assert_eq!(refused(&opening(stacked)), "accepted");
}

#[test]
fn bodies_that_cannot_rock_are_refused() {
    let given = "[impact]\nrestitution = 0.9\n";
    let strip = "[geometry]\nmechanism = \"vertical_spanning\"\n";
    for (text, message) in [
        (
            BODY.to_owned(),
            "restitution_source = calibrated does not go with mechanism = rigid_body; set restit",
        ),
        (
            format!("[geometry]\nthrust = 5e3\n{BODY}{given}"),
            "line 2: thrust follows from [geometry.body] and",
        ),
        (
            format!("{}{}", BODY.replace("[geometry.body]", "[[geometry.body]]"), given),
            "[geometry.body] is one table; give one body",
        ),
        (
            format!(
                "{BODY}{given}{LOAD}force = 0.0\nthrust = 1e3\n{}force = 0.0\nthrust = -900.0",
                LOAD.replace("2.5", "1.0")
            ),
            "the thrusts add to 100 N with a moment of 1600 N m, which no single thrust on the body has",
        ),
        (format!("{strip}{BODY}"), "line 3: [geometry.body] is one body; a strip has two: give it as"),
        (BODY.replace("2e3", "200.0") + given, "inertia = 200 kg m2 must be at least 1000 times 1 squared"),
        (BODY.replace("2.5", "0.5") + given, "centroid_height = 1 does not go with height = 0.5; set height"),
        (
            format!("[geometry]\noverburden = 1e3\n{BODY}{given}"),
            "overburden = 1000 does not go with mechanism",
        ),
        (
            format!("{BODY}{given}[[geometry.opening]]\nbase = 1.0\nheight = 1.0\nwidth = 0.5"),
            "line 9: [geometry.body] states the whole body; leave [[geometry.opening]] out",
        ),
        (
            format!("{BODY}{given}{}force = 1e3", LOAD.replace("2.5", "3.0")),
            "line 1: a load at height = 3 m is above the body, height = 2.5 m",
        ),
        (
            format!("{strip}kinematics = \"trigonometric\"\n{PART}width = [1.0, 0.5]"),
            "kinematics = trigonometric does not go with part = [...]; set mechanism = parapet, or height",
        ),
        (
            format!("[geometry]\nkinematics = \"trigonometric\"\n{BODY}{given}"),
            "kinematics = trigonometric does not go with mechanism = rigid_body; set its parts in place of",
        ),
        (
            format!("{strip}{PART}width = [1.0, 0.5]\n[impact]\nrestitution_source = \"momentum\""),
            "restitution_source = momentum does not go with mechanism = vertical_spanning; set restit",
        ),
    ] {
        let found = refused(&text);
        assert!(found.contains(message), "{text}\n{found}");
    }
}

/// The rectangle that stands for parts cannot be changed by itself.
#[test]
fn a_number_of_the_rectangle_is_not_that_of_parts() {
    let text = format!("{PART}width = [1.0, 0.5]\n");
    let mut scene = Scene::parse("s.toml", &text, Path::new("nowhere")).unwrap();
    let error = scene.set("height", "4").unwrap_err().to_string();
    assert_eq!(error, "height is that of a rectangle, and the wall has parts; change these in its file");
    let error = scene.set("thrust", "0").unwrap_err().to_string();
    assert!(
        error.starts_with("thrust is that of a body by its integrals, and the wall has parts"),
        "{error}"
    );
    let taller = Parameters { height: 4.0, ..scene.parameters.clone() };
    let error = Wall::new(&taller).unwrap_err().to_string();
    assert_eq!(error, "height = 4 does not go with the parts of the wall, which have 3; change the parts");
}

/// What a scene with parts is written as reads as the same wall.
#[test]
fn parts_are_written_as_they_are_read() {
    for name in ["battered_wall", "chimney", "facade", "gable", "stepped_strip", "wall_with_opening"] {
        let path = crate::root().join(format!("scenes/bodies/{name}.toml"));
        let scene = Scene::read(&path).unwrap();
        let text = scene::to_toml(&scene, "");
        let again = Scene::parse("again.toml", &text, Path::new("nowhere")).unwrap();
        assert_eq!(again.parameters, scene.parameters, "{text}");
    }
}
