//! Several ties of a façade in the check by Circolare 7/2019, its drawing, and the loads that it bears.

use check::{CheckFile, Found, Language, Sought, WallCodes, check_walls, find, read};
use scene::Scene;
use serde_json::Value;

use crate::circolare::refuses;
use crate::circolare_bodies::{facade, json, near, number};
use crate::formulas::assert_gives;
use crate::report::report_of_one;

const ONE_SIDED: &str = "rocking = \"one_sided_positive\"\ntie = { at_activation = \"yield\" }\n\
                         SLC = { ag = 0.13, F0 = 2.4, TC = 0.32 }";

/// A tie by height, stiffness, strength and plastic elongation.
fn tie(height: f64, stiffness: f64, strength: f64, ultimate: f64) -> String {
    format!(
        "[[tie]]\ntie_height = {height}\ntie_stiffness = {stiffness:e}\ntie_strength = {strength:e}\n\
         tie_ultimate = {ultimate}\ntie_side = \"positive\"\n"
    )
}

fn positive(text: &str) -> Value {
    json(text)["sides"]["positive"].take()
}

/// Two ties side by side are one of twice their stiffness and strength.
#[test]
fn equal_ties_are_one_of_twice_their_strength() {
    let check = facade("thrust = 800", ONE_SIDED);
    let half = tie(6.2, 2e6, 4e3, 0.09);
    let two = positive(&(half.clone() + &half + &check));
    let one = positive(&(tie(6.2, 4e6, 8e3, 0.09) + &check));
    for keys in [
        ["activation", "alpha0"],
        ["SLD", "ratio"],
        ["SLV_q", "ratio"],
        ["SLV", "a"],
        ["SLV", "zeta_E"],
        ["SLC", "a"],
        ["SLC", "zeta_E"],
    ] {
        near(number(&two, &keys), number(&one, &keys), &format!("{keys:?}"));
    }
    for own in two["ties"].as_array().unwrap() {
        near(number(own, &["u_break"]), number(&one, &["tie", "u_break"]), "u_break");
        near(number(own, &["force_at_activation"]), 4e3, "force");
        near(number(own, &["SLD", "tie_required"]), number(&one, &["SLD", "tie_required"]), "required alone");
    }
}

/// A wall of two storeys with these ties and levels, held before it rocks.
fn tied(ties: &str, levels: &str) -> String {
    format!(
        "{ties}[[geometry.part]]\nheight = 3.3\nthickness = 0.6\ndensity = 1800\n\
         [[geometry.part]]\nheight = 6.3\nthickness = 0.6\ndensity = 1800\n\
         [force_law]\nforce_law = \"rigid_linear\"\n\
         [check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
         confidence_factor = 1.35\nhinge_levels = {levels}\nSLV = {{ ag = 0.2, F0 = 2.4, TC = 0.35 }}\n"
    )
}

/// A side that the first tie holds may be free of others: it is checked by itself, in any order of the ties,
/// and a tie below the level that opens counts nowhere.
#[test]
fn ties_count_on_their_sides_in_any_order_and_above_their_levels() {
    let both = tie(6.4, 2e6, 2e4, 0.02).replace("\"positive\"", "\"both\"");
    let positive = tie(3.0, 3e6, 1.5e4, 0.05);
    let zeta = |text: &str, side: &str| number(&json(text)["sides"][side], &["SLV", "zeta_E"]);
    let orders = [both.clone() + &positive, positive.clone() + &both].map(|ties| tied(&ties, "[0]"));
    for side in ["positive", "negative"] {
        near(zeta(&orders[0], side), zeta(&orders[1], side), side);
    }
    assert!(zeta(&orders[0], "negative") < zeta(&orders[0], "positive"));
    // the tie at 3 m holds nothing above 3.3 m
    let upper = tie(6.4, 2e6, 2e4, 0.02);
    let [with, without] = [positive + &upper, upper].map(|ties| tied(&ties, "[3.3]"));
    for side in ["positive", "negative"] {
        near(zeta(&with, side), zeta(&without, side), side);
    }
    assert!(zeta(&with, "negative") < zeta(&with, "positive"));
}

/// One tie yields on where another is broken: a(d) has those that hold, and their levers are y/z_G.
#[test]
fn a_tie_holds_on_where_another_is_broken() {
    let check = facade("thrust = 800", ONE_SIDED);
    let (lower, upper) = (tie(3.2, 4e6, 5e3, 0.5), tie(6.2, 4e6, 9e3, 0.17));
    let both = positive(&(lower.clone() + &upper + &check));
    let (d, u0) = (number(&both, &["SLC", "d"]), number(&both, &["d0"]) / number(&both, &["d_per_u"]));
    let breaks = number(&both["ties"][1], &["u_break"]);
    assert!((0.4 * u0..0.6 * u0).contains(&breaks), "{breaks} of {u0}");
    let z = number(&both, &["z_G"]);
    let pull = |forces: &[(f64, f64)]| forces.iter().map(|(y, force)| y / z * force).sum::<f64>();
    let a = |state: &str, forces: &[(f64, f64)]| {
        let own = number(&both, &["a0"]) * (1.0 - number(&both, &[state, "d"]) / number(&both, &["d0"]));
        let per_force = 9.81 * z / number(&both, &["M_E"]);
        (own + pull(forces) * per_force) / 1.35
    };
    near(number(&both, &["SLV", "a"]), a("SLV", &[(3.2, 5e3), (6.2, 9e3)]), "a(d_SLV)");
    near(number(&both, &["SLC", "a"]), a("SLC", &[(3.2, 5e3)]), "a(d_SLC)");
    assert_eq!(both["ties"][1]["SLC"]["tie_state"], "broken");
    near(d, 0.6 * number(&both, &["d0"]), "d_SLC");
}

/// The loss at a break counts those before it: two ties of which each takes less than half may together take
/// more.
#[test]
fn breaks_one_after_the_other_add_up() {
    let none = ONE_SIDED.replace("yield", "none");
    let check = facade("thrust = 800", &none);
    let (first, second) = (tie(6.2, 4e6, 6e3, 0.01), tie(6.2, 4e6, 6e3, 0.012));
    let found = positive(&(first + &second + &check));
    let losses: Vec<_> = found["ties"].as_array().unwrap().iter().map(|tie| number(tie, &["loss"])).collect();
    assert!(losses.iter().all(|loss| *loss < 0.5), "{losses:?}");
    assert_eq!(found["SLV"]["limited_by_tie"], true);
    let u = number(&found["ties"][1], &["u_break"]);
    near(number(&found, &["SLV", "d"]), u * number(&found, &["d_per_u"]), "d_SLV");
}

/// Ties at a level or below do not hold what turns above it.
#[test]
fn ties_at_a_level_hold_what_is_below() {
    let check = facade("thrust = 800", &format!("{ONE_SIDED}\nhinge_levels = [0, 3.3]"));
    let found = json(&(tie(3.3, 4e6, 5e3, 0.2) + &tie(6.2, 4e6, 9e3, 0.2) + &check));
    let [whole, above] = &found["levels"].as_array().unwrap()[..] else { panic!("{found}") };
    assert_eq!(whole["sides"]["positive"]["ties"].as_array().unwrap().len(), 2);
    let above = &above["sides"]["positive"];
    let alpha0 = number(above, &["alpha0"]) + 9e3 * 2.9 / number(above, &["M_E"]);
    near(number(above, &["activation", "alpha0"]), alpha0, "alpha0");
}

#[test]
fn ties_that_cannot_be_counted_together_are_refused() {
    let check = facade("thrust = 800", ONE_SIDED);
    let brittle = tie(6.2, 4e6, 6e3, 0.0) + &tie(6.2, 4e6, 9e3, 0.2) + &check;
    refuses(&brittle, "with tie 1 of the side: cannot count it: it is broken at u_r = ");
    let bar = ONE_SIDED.replace(
        "tie = { at_activation",
        "tie = { bar = { diameter = 0.016, length = 6, yield_stress = 235e6 }, at_activation",
    );
    let two = tie(3.2, 4e6, 6e3, 0.2) + &tie(6.2, 4e6, 9e3, 0.2) + &facade("", &bar);
    refuses(&two, "[check.tie] holds for all ties, and a bar belongs to each");
}

/// Formulas of several ties give their numbers; the drawing of a body has the words of the report.
#[test]
fn reports_of_several_ties_are_complete() {
    let ties = tie(3.2, 4e6, 5e3, 0.5) + &tie(6.2, 4e6, 9e3, 0.07);
    let text = ties + &facade("thrust = 800", ONE_SIDED);
    let english = report_of_one(&text);
    assert!(assert_gives(&english) > 30);
    for said in ["tie at 3.2 m", "thrust 0.8 kN", ">outside<", "Tie 2 breaks at"] {
        assert!(english.contains(said), "{said}");
    }
    let italian = report_of_one(&format!("{text}\n[report]\nlanguage = \"{}\"\n", Language::It.name()));
    for said in ["catena a 3,2 m", "spinta 0,8 kN", ">esterno<", "La catena 2 si rompe a"] {
        assert!(italian.contains(said), "{said}");
    }
    for said in [">outside<", "tie at", "thrust 0"] {
        assert!(!italian.contains(said), "{said}");
    }
}

fn searched(text: &str, sought: Sought) -> Result<Found, String> {
    let scene = Scene::parse("scene.toml", text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", text).unwrap()).unwrap();
    find(&*code, (&scene).into(), sought).map_err(|error| error.to_string())
}

/// The largest thrust that just passes has ζ_E = 1 as a thrust that is stated; sizes of rectangles and what
/// is not there are no answer.
#[test]
fn the_largest_thrust_that_passes_is_found() {
    let scene = |thrust: f64| facade(&format!("thrust = {thrust:?}"), "hinge_levels = [0, 3.3]");
    let found = searched(&scene(300.0), Sought::Thrust).unwrap();
    let most = found.value.unwrap();
    assert!(
        found.text(Language::It).contains("somma delle spinte, valore massimo"),
        "{}",
        found.text(Language::It)
    );
    let zeta = |thrust: f64| number(&json(&scene(thrust)), &["governs", "zeta_E"]);
    // the value is known to 1e-9 of itself
    assert!((zeta(most) - 1.0).abs() < 1e-6 && zeta(1.01 * most) < 1.0, "{most}: {}", zeta(most));
    let load = searched(&scene(300.0), Sought::Load).unwrap();
    assert!(load.checks.iter().all(|check| check.curve.len() == 241));
    for (text, sought, message) in [
        (
            scene(300.0),
            Sought::Thickness,
            "thickness is that of a rectangle; of a wall of parts thrust, load",
        ),
        (facade("", ""), Sought::Thrust, "thrust is sought, but the wall has none; state it"),
        (
            tie(3.2, 4e6, 5e3, 0.5) + &tie(6.2, 4e6, 9e3, 0.07) + &scene(300.0),
            Sought::TieStrength,
            "tie_strength is sought of one tie; leave the others out",
        ),
    ] {
        let error = searched(&text, sought).unwrap_err();
        assert!(error.contains(message), "{error}");
    }
}

/// Walls of a file state their own levels, and are checked as they are alone.
#[test]
fn walls_of_a_file_have_their_own_levels() {
    let part = "[[walls.geometry.part]]\nheight = 3\nthickness = 0.4\ndensity = 1800\n";
    let wall = |name: &str, levels: &str| {
        format!("[[walls]]\nname = \"{name}\"\ncheck = {{ hinge_levels = {levels} }}\n{part}{part}")
    };
    let table = &facade("", "")[facade("", "").find("[check]").unwrap()..];
    let text = format!("{table}{}{}", wall("P1", "[0]"), wall("P2", "[0, 3]"));
    let file = CheckFile::parse("walls.toml", &text).unwrap();
    let walls = file.walls(&[], &mut Vec::new(), &mut Vec::new()).unwrap();
    let codes = WallCodes::read(&file, &walls).unwrap();
    let found = check_walls(&codes, &walls, 1).json();
    let of = |name: &str| {
        let own = found.as_array().unwrap().iter().find(|own| own["name"] == name).unwrap();
        own["verdict"]["levels"].as_array().unwrap_or_else(|| panic!("{own}")).clone()
    };
    assert_eq!((of("P1").len(), of("P2").len()), (1, 2));
    let alpha0 = |level: &Value| number(level, &["sides", "positive", "alpha0"]);
    near(alpha0(&of("P2")[0]), alpha0(&of("P1")[0]), "the base");
    near(alpha0(&of("P2")[1]), 0.4 / 3.0, "above 3 m");
}
