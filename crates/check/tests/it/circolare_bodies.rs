//! Bodies of parts, openings, loads and thrusts in the check by Circolare 7/2019: their sums beside those of
//! the text, levels, resultants, and what is refused.

use check::circolare::Outcome;
use serde_json::Value;

use crate::circolare::{checked, refuses, sides_in_json, warns};
use crate::formulas::assert_gives;
use crate::report::{plain, report_of_one};

/// Rounding of sums of some dozen terms.
const ROUNDING: f64 = 1e-12;
const G: f64 = 9.81;

pub(crate) fn near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= ROUNDING * expected.abs(), "{what}: {found}, expected {expected}");
}

pub(crate) fn check(more: &str) -> String {
    format!(
        "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
         SLD = {{ ag = 0.05, F0 = 2.45, TC = 0.28 }}\nSLV = {{ ag = 0.1, F0 = 2.4, TC = 0.32 }}\n{more}\n"
    )
}

/// A part by thickness and height, 1 m wide.
pub(crate) fn part(thickness: f64, height: f64) -> String {
    format!("[[geometry.part]]\nheight = {height}\nthickness = {thickness}\ndensity = 1800\n")
}

/// A load by force, height, place, share of its mass that moves, and thrust.
pub(crate) fn load(force: f64, height: f64, inside: f64, share: f64, thrust: &str) -> String {
    format!(
        "[[geometry.load]]\nforce = {force:?}\nheight = {height}\ninside = {inside}\nmoving_mass = {share}\n\
         {thrust}\n"
    )
}

/// A façade of two storeys, 50 and 36 cm thick, with a floor and a roof.
pub(crate) fn facade(thrust: &str, more: &str) -> String {
    part(0.5, 3.3)
        + &part(0.36, 3.1)
        + &load(14e3, 3.3, 0.4, 1.0, "")
        + &load(9.8e3, 6.4, 0.26, 0.5, thrust)
        + &check(more)
}

pub(crate) fn number(of: &Value, keys: &[&str]) -> f64 {
    let found = keys.iter().fold(of, |value, key| &value[*key]);
    found.as_f64().unwrap_or_else(|| panic!("{keys:?} of {of}"))
}

/// α0, e*, M*, a_0, d_0 and d/u of both sides by the sums of the text: N, T, D and K, with one resultant on a
/// body or of each weight.
#[test]
fn the_sums_are_those_of_the_text() {
    // weight, lever about the outer toe, height, moving share
    let [w1, w2] = [0.5 * 3.3, 0.36 * 3.1].map(|area| area * 1800.0 * G);
    let own = (w1 + w2, (w1 * 1.65 + w2 * 4.85) / (w1 + w2));
    let weights =
        [[w1, 0.25, 1.65, 1.0], [w2, 0.18, 4.85, 1.0], [14e3, 0.4, 3.3, 1.0], [9.8e3, 0.26, 6.4, 0.5]];
    let sum = |of: &dyn Fn(&[f64; 4]) -> f64| weights.iter().map(of).sum::<f64>();
    let (d, k) = (sum(&|w| w[3] * w[0] * w[2]), sum(&|w| w[0] * w[2]));
    let (pushed, t) = (sum(&|w| w[3] * w[0]), 800.0 * 6.4);
    let second = own.0 * own.1 * own.1 + 14e3 * 3.3 * 3.3 + 0.5 * 9.8e3 * 6.4 * 6.4;
    let e_stars = [1.0, d * d / (pushed * second)];
    for (resultants, e_star) in ["body", "each"].into_iter().zip(e_stars) {
        let text = facade("thrust = 800\nthrust_lasts = true", &format!("resultants = \"{resultants}\""));
        let sides = sides_in_json(&text);
        for (side, sign) in [("positive", 1.0), ("negative", -1.0)] {
            let arm = |x: f64| if sign > 0.0 { x } else { 0.5 - x };
            let held = sum(&|w| w[0] * arm(w[1])) - sign * t;
            let alpha0 = held / d;
            let per_rotation = d / pushed / e_star;
            for (key, expected) in [
                ("alpha0", alpha0),
                ("e_star", e_star),
                ("M_star", e_star * pushed / G),
                ("a0", alpha0 * G / e_star),
                ("d0", per_rotation * held / k),
                ("d_per_u", per_rotation / own.1),
                ("M_W", sum(&|w| w[0] * arm(w[1]))),
                ("M_H", sign * t),
                ("M_E", d),
                ("K_theta", k),
            ] {
                near(number(&sides, &[side, key]), expected, &format!("{resultants} {side} {key}"));
            }
        }
    }
}

/// The eight bodies of an independent program: α0 on both sides, with the masses of the loads.
#[test]
fn bodies_have_the_multipliers_of_an_independent_program() {
    let wide = |text: &str| part(0.25, 2.4).replace("density", &format!("width = {text}\ndensity"));
    let window = "[[geometry.opening]]\nbase = 0.9\nheight = 1.5\nwidth = 1.2\n";
    let battered =
        "[[geometry.part]]\nheight = 4\nthickness = [0.5, 0.3]\nouter = [0, 0.2]\ndensity = 1800\n";
    let floors = load(12e3, 3.2, 0.5, 1.0, "")
        + &load(12e3, 6.4, 0.5, 1.0, "thrust = 500\nthrust_lasts = true")
        + &load(8e3, 9.6, 0.4, 1.0, "thrust = 1000\nthrust_lasts = true");
    for (name, text, expected) in [
        ("A", part(0.25, 3.0), [0.25 / 3.0; 2]),
        ("B", wide("[6, 0]"), [0.15625; 2]),
        ("C", wide("[6, 2]"), [0.125; 2]),
        ("D", battered.to_owned(), [0.161_363_636_363_636_4, 0.111_363_636_363_636_4]),
        ("E", part(0.25, 3.0).replace("density", "width = 3\ndensity") + window, [0.125 / 1.4625; 2]),
        ("G", part(0.6, 9.6) + &floors, [0.048_386_677_9, 0.069_556_661_0]),
    ] {
        let sides = sides_in_json(&(text + &check("")));
        for (side, expected) in ["positive", "negative"].into_iter().zip(expected) {
            let found = number(&sides, &[side, "alpha0"]);
            // the last two are given with nine digits
            let tolerance = if name == "G" { 1e-9 } else { ROUNDING };
            assert!((found - expected).abs() <= tolerance * expected, "{name} {side}: {found}");
        }
    }
}

fn levels(outcome: &Value) -> &[Value] {
    outcome["levels"].as_array().unwrap()
}

pub(crate) fn json(text: &str) -> Value {
    use scene::Scene;
    let scene = Scene::parse("scene.toml", text, ".".as_ref()).unwrap();
    let code = check::read(&check::CheckFile::parse("scene.toml", text).unwrap()).unwrap();
    code.check((&scene).into()).unwrap_or_else(|error| panic!("{error}\n{text}")).json()
}

/// The body above a level is the wall that would be stated in its place, the floor at the level rests on what
/// is below, and the level with the least ζ_E governs.
#[test]
fn a_level_cuts_out_the_body_above_it() {
    let both = json(&facade("thrust = 800", "hinge_levels = [0, 3.3]"));
    let whole = json(&facade("thrust = 800", ""));
    let above = part(0.36, 3.1) + &load(9.8e3, 3.1, 0.26, 0.5, "thrust = 800") + &check("");
    let above = json(&above);
    for (level, alone) in levels(&both).iter().zip([&whole, &above]) {
        for side in ["positive", "negative"] {
            for keys in [&["alpha0"][..], &["d0"], &["M_star"], &["SLD", "ratio"], &["SLV", "zeta_E"]] {
                let keys = [&[side], keys].concat();
                let (found, expected) = (number(&level["sides"], &keys), number(&alone["sides"], &keys));
                near(found, expected, &format!("{} {keys:?}", level["level"]));
            }
        }
    }
    let governs = &both["governs"];
    let zetas: Vec<_> =
        [&whole, &above].map(|alone| number(alone, &["governs", "zeta_E"])).into_iter().collect();
    near(number(governs, &["zeta_E"]), zetas[0].min(zetas[1]), "zeta_E");
    assert_eq!(number(governs, &["level"]), if zetas[0] < zetas[1] { 0.0 } else { 3.3 });
    // a rectangle opens at a level, too
    let wall = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n";
    let cut = json(&(wall.to_owned() + &check("hinge_levels = [1.5]")));
    near(number(&cut, &["sides", "positive", "alpha0"]), 0.4 / 2.5, "alpha0");
}

/// A body that stands on a narrower one turns about the edge of the contact; a set-back widens nothing.
#[test]
fn the_toes_of_a_level_are_the_edges_of_the_contact() {
    // 0.3 m on 0.5 m, set back by 0.1 m from outside; then 0.5 m on 0.3 m
    let upper = part(0.3, 2.0) + "outer = 0.1\n";
    let stepped = json(&(part(0.5, 2.0) + &upper + &check("hinge_levels = [2]")));
    near(number(&stepped, &["sides", "positive", "alpha0"]), 0.15, "set back");
    let wide = json(&(part(0.3, 2.0) + &part(0.5, 2.0) + &check("hinge_levels = [2]")));
    near(number(&wide, &["sides", "positive", "alpha0"]), 0.25, "outer toe");
    near(number(&wide, &["sides", "negative", "alpha0"]), 0.05, "edge of the narrow part");
}

/// A thrust counts where it takes from a side, and where it helps only if it lasts.
#[test]
fn a_thrust_helps_only_where_it_lasts() {
    let alpha0 = |thrust: &str| {
        let sides = sides_in_json(&facade(thrust, ""));
        ["positive", "negative"].map(|side| number(&sides, &[side, "alpha0"]))
    };
    let (none, passing) = (alpha0(""), alpha0("thrust = 800"));
    let lasting = alpha0("thrust = 800\nthrust_lasts = true");
    assert_eq!(passing[0], lasting[0]);
    assert!(passing[0] < none[0] && lasting[1] > none[1]);
    near(passing[1], none[1], "left out");
    assert!(!plain(&report_of_one(&facade("thrust = 800", ""))).contains("-0 "), "a moment of -0");
    warns(
        &facade("thrust = 800", ""),
        "u < 0: thrusts with a moment of 5.12 kN m would help and are left out",
    );
    warns(&facade("", ""), "load 2 at 6.4 m: moving_mass = 0.5 is below 1");
    let silent = checked(&facade("thrust = 800\nthrust_lasts = true", "")).unwrap();
    assert!(!silent.warnings.iter().any(|warning| warning.contains("left out")), "{:?}", silent.warnings);
}

/// A mass that only pushes the wall adds to what is pushed, and to nothing else.
#[test]
fn a_mass_may_push_without_resting() {
    let mass = "[[geometry.load]]\nforce = 0\nmass = 500\nheight = 3\ninside = 0.1\n";
    let bare = sides_in_json(&(part(0.4, 4.0) + &check("")));
    let pushed = sides_in_json(&(part(0.4, 4.0) + mass + &check("")));
    let w = 0.4 * 4.0 * 1800.0 * G;
    let ratio = w * 2.0 / (w * 2.0 + 500.0 * G * 3.0);
    let of = |sides: &Value, key: &str| number(sides, &["positive", key]);
    near(of(&pushed, "alpha0"), ratio * of(&bare, "alpha0"), "alpha0");
    near(of(&pushed, "M_star"), of(&bare, "M_star") + 500.0, "M*");
}

/// Every level has its own place in the building and is raised by its own SLD.
#[test]
fn levels_have_their_own_heights() {
    let at = |ratio: &str, levels: &str| {
        let building = format!(
            "building = {{ storeys = 3, period = 0.3, height_ratio = {ratio} }}\nhinge_levels = {levels}"
        );
        let text = facade("thrust = 800", &building);
        text.replace("TC = 0.28 }", "TC = 0.28, building_damping = 0.05 }")
            .replace("TC = 0.32 }", "TC = 0.32, building_damping = 0.1 }")
    };
    let both = json(&at("[0, 0.52]", "[0, 3.3]"));
    for (level, alone) in levels(&both).iter().zip([at("0", "[0]"), at("0.52", "[3.3]")]) {
        let alone = json(&alone);
        for keys in [["SLD", "demand"], ["SLV", "demand"], ["SLV", "zeta_E"]] {
            let keys = ["sides", "positive", keys[0], keys[1]];
            near(number(level, &keys), number(&alone, &keys), &format!("{keys:?}"));
        }
    }
    // z/H = 0 is the ground
    let ground = json(&facade("thrust = 800", ""));
    let keys = ["sides", "positive", "SLV", "demand"];
    near(number(&levels(&both)[0], &keys), number(&ground, &keys), "ground");
    refuses(&at("0.52", "[0, 3.3]"), "height_ratio has 1 of the 2 z/H of hinge_levels; give a list");
    refuses(&at("[0, 0.2, 0.5]", "[0, 3.3]"), "height_ratio has 3 of the 2 z/H of hinge_levels");
    refuses(&at("[0, 1.2]", "[0, 3.3]"), "height_ratio = 1.2 must be at least 0 and at most 1");
    assert!(checked(&at("0", "[0, 3.3]")).is_ok());
}

/// A wedge of a transverse wall holds the wall back, and leaves it no inner toe.
#[test]
fn a_wedge_needs_one_sided_rocking() {
    let wedge = "[[geometry.part]]\nbase = 0\nheight = 6.4\nthickness = [0, 1.2]\nwidth = 0.5\n\
                 outer = 0.45\ndensity = 1800\n";
    let wall = part(0.45, 6.4) + wedge;
    let one_sided = "rocking = \"one_sided_positive\"";
    let sides = sides_in_json(&(wall.clone() + &check(one_sided)));
    // masses of the façade and of the wedge, a triangle with its tip below
    let [w, v] = [0.45 * 6.4, 0.5 * 0.5 * 1.2 * 6.4].map(|volume| 1800.0 * G * volume);
    let alpha0 = (w * 0.225 + v * (0.45 + 0.4)) / (w * 3.2 + v * 6.4 * 2.0 / 3.0);
    near(number(&sides, &["positive", "alpha0"]), alpha0, "alpha0");
    refuses(&(wall.clone() + &check("")), "part 2: hangs on the side of another and stands on nothing");
    let cut = format!("{one_sided}\nhinge_levels = [2]");
    refuses(&(wall + &check(&cut)), "hinge_levels: part 2: the level 2 m goes through it");
}

/// A body given by its integrals has the numbers of the same body of parts, also with each resultant.
#[test]
fn integrals_are_checked_as_parts() {
    let floors = load(12e3, 3.2, 0.35, 1.0, "thrust = 400") + &load(8e3, 6.0, 0.3, 0.4, "");
    for resultants in ["body", "each"] {
        let check = check(&format!("resultants = \"{resultants}\""));
        let parts = sides_in_json(&(part(0.5, 6.0) + &floors + &check));
        let m = 0.5 * 6.0 * 1800.0;
        let body = format!(
            "[geometry.body]\nmass = {m}\ncentroid_height = 3\ninertia = {:?}\narm = 0.25\nheight = 6\n",
            m * 12.0
        );
        let integrals = sides_in_json(&(body + &floors + &check));
        for side in ["positive", "negative"] {
            for key in ["alpha0", "e_star", "M_star", "a0", "d0", "d_per_u"] {
                let (found, expected) = (number(&integrals, &[side, key]), number(&parts, &[side, key]));
                near(found, expected, &format!("{resultants} {side} {key}"));
            }
        }
    }
}

/// A strip of two bodies: sums with φ, a floor at the hinge on the lower body, and e* below 1 with it.
#[test]
fn strips_of_two_bodies_have_a_resultant_on_each() {
    let strip = |loads: &str, more: &str| {
        "[geometry]\nmechanism = \"vertical_spanning\"\nhinge_ratio = 0.5\n".to_owned()
            + &part(0.4, 3.0)
            + &part(0.3, 3.0)
            + loads
            + &check(more)
    };
    let bare = sides_in_json(&strip("", ""));
    near(number(&bare, &["positive", "e_star"]), 1.0, "e*");
    let floor = load(10e3, 3.0, 0.3, 1.0, "");
    let loaded = sides_in_json(&strip(&floor, ""));
    let [w1, w2] = [0.4, 0.3].map(|thickness| thickness * 3.0 * 1800.0 * G);
    let (lower, upper) = (0.5 * w1 + 10e3, 0.5 * w2);
    let second = lower * lower / (w1 + 10e3) + upper * upper / w2;
    let e_star = (lower + upper).powi(2) / ((w1 + w2 + 10e3) * second);
    assert!(e_star < 0.99);
    near(number(&loaded, &["positive", "e_star"]), e_star, "e*");
    near(number(&loaded, &["positive", "d_per_u"]), second / (lower + upper), "d/u");
    // u > 0: the base bears outside, the hinge at the inner edge of the thinner part
    let held = (w1 * 0.2 + 10e3 * 0.3 + w2 * 0.3) / 3.0 + w2 * (0.3 - 0.15) / 3.0;
    near(number(&loaded, &["positive", "alpha0"]), held / (lower + upper), "alpha0");
}

/// The set-back of a body takes N of all that stands on it and the width of the contact.
#[test]
fn hinges_of_bodies_are_set_back() {
    let text = facade("", "masonry_strength = 2e6\nconfidence_factor = 1.2");
    let (sides, edges) = (sides_in_json(&text), sides_in_json(&facade("", "")));
    let n = 1800.0 * G * (0.5 * 3.3 + 0.36 * 3.1) + 14e3 + 9.8e3;
    let t = n / (2.0 * 0.85 * 2e6 / 1.2);
    near(number(&sides, &["positive", "set_back", "base"]), t, "t_b");
    for side in ["positive", "negative"] {
        let moved = number(&edges, &[side, "alpha0"]) - n * t / number(&edges, &[side, "M_E"]);
        near(number(&sides, &[side, "alpha0"]), moved, side);
    }
}

/// Every formula of the reports of bodies gives its number.
#[test]
fn formulas_of_bodies_give_their_numbers() {
    let lasting = "thrust = 800\nthrust_lasts = true";
    let law = |text: String| text.replace("\"rigid\"", "\"law\"") + "[force_law]\na1 = 0.03\n";
    let tie = "[tie]\ntie_height = 6.2\ntie_stiffness = 4e6\ntie_strength = 9e3\ntie_ultimate = 0.1\n";
    let yields = "rocking = \"one_sided_positive\"\ntie = { at_activation = \"yield\" }";
    let strip = "[geometry]\nmechanism = \"vertical_spanning\"\nhinge_ratio = 0.5\n";
    let body = "[geometry.body]\nmass = 9000\ncentroid_height = 2.1\ninertia = 52e3\narm = 0.45\n\
                arm_inner = 0.3\nheight = 4.2\n";
    let texts = [
        facade(lasting, "hinge_levels = [0, 3.3]"),
        facade(lasting, "resultants = \"each\""),
        facade("thrust = 800", "masonry_strength = 2e6"),
        law(facade(lasting, "")),
        tie.to_owned() + &facade(lasting, yields),
        strip.to_owned() + &part(0.4, 3.0) + &part(0.3, 3.0) + &load(1e4, 3.0, 0.3, 1.0, "") + &check(""),
        body.to_owned() + &load(5e3, 4.0, 0.5, 1.0, lasting) + &check(""),
        // a rectangle whose overburden has a resultant of its own
        "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\noverburden = 8e3\n\
         overburden_eccentricity = 0.05\n"
            .to_owned()
            + &check("overburden_mass = 1\nresultants = \"each\""),
    ];
    let counts: Vec<_> = texts.iter().map(|text| assert_gives(&report_of_one(text))).collect();
    assert!(counts.iter().all(|count| *count > 30), "{counts:?} formulas");
}

/// What a check has to be told of a body, and what it cannot have.
#[test]
fn bodies_that_cannot_be_checked_are_refused() {
    let bare = "[[geometry.load]]\nforce = 1e3\nheight = 3\ninside = 0.2\n";
    let wall = part(0.4, 4.0);
    let strip = "[geometry]\nmechanism = \"vertical_spanning\"\nhinge_ratio = 0.5\n".to_owned() + &wall;
    let body = "[geometry.body]\nmass = 9e3\ncentroid_height = 2\ninertia = 52e3\narm = 0.4\nheight = 4\n";
    let overhanging = part(0.4, 2.0) + &part(0.4, 2.0) + "outer = 0.4\n";
    let beam = |text: &str| text.replace("\"rigid\"", "\"beam\"\nyoung_modulus = 1e9");
    let two = "hinge_levels = [0, 2]\nSLC = { ag = 0.2, F0 = 2.4, TC = 0.3, displacement = 0.1 }";
    for (text, message) in [
        (
            wall.clone() + bare + &check(""),
            "load 1: moving_mass is missing beside force = 1000 N at height = 3 m",
        ),
        (wall.clone() + &check("hinge_levels = [4]"), "nothing turns above the level 4 m; levels are from 0"),
        (wall.clone() + &check("hinge_levels = [5]"), "levels are from 0 to below the top, 4 m"),
        (wall.clone() + &check("hinge_levels = [2, 2]"), "hinge_levels = [2.0, 2.0] m are heights"),
        (wall.clone() + &check("hinge_levels = [-1]"), "they rise from 0 or above"),
        (wall.clone() + &check("hinge_levels = []"), "hinge_levels needs at least 1 value, found 0"),
        (wall.clone() + &check(two), "SLC.displacement is the u of one body; with several hinge_levels"),
        (strip + &check("hinge_levels = [2]"), "hinge_levels = 2 m: a strip wall has no levels"),
        (body.to_owned() + &check("hinge_levels = [2]"), "a body given by its integrals has no levels"),
        (
            body.to_owned() + &check("masonry_strength = 1e6"),
            "masonry_strength needs the width of the contact",
        ),
        (beam(&facade("", "")), "before_activation = \"beam\" has T0 of a uniform beam [C8.7.1.7]"),
        (facade("thrust = 5e3", ""), "thrusts with a moment of 32000 N m overturn it"),
        (overhanging + &check("hinge_levels = [2]"), "part 2"),
        (part(0.4, 4.0).replace("density = 1800", "") + &check(""), "density not stated"),
        (
            wall + "[[geometry.load]]\nforce = 1e3\nmass = 10\nheight = 3\ninside = 0.2\n" + &check(""),
            "load 1: mass = 10 kg moves along without resting on the wall, force = 1000 N rests on it",
        ),
    ] {
        let error = read_or_check(&text);
        assert!(error.contains(message), "{error}\nexpected {message}\nfor {text}");
    }
}

/// The message of a scene that is refused as it is read, or checked.
fn read_or_check(text: &str) -> String {
    use scene::Scene;
    match Scene::parse("scene.toml", text, ".".as_ref()) {
        Err(error) => error.to_string(),
        Ok(_) => checked(text).map(|outcome: Outcome| outcome.governs).expect_err(text),
    }
}
