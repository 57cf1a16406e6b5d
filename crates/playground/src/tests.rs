//! Tests of the answers, without a browser.

use std::fs;

use scene::Scene;
use scene::response::Response;
use serde_json::{Value, json};

use crate::Session;

mod codes;

fn ask(session: &mut Session, request: &Value) -> Value {
    serde_json::from_str(&session.answer(&request.to_string())).unwrap()
}

fn run(session: &mut Session, parameters: &Value, motion: &Value) -> Value {
    let inputs = json!({ "parameters": parameters, "motion": motion, "width": 600 });
    ask(session, &json!({ "run": inputs }))
}

/// The fault of one field.
fn fault(parameters: &Value, motion: &Value, field: &str) -> String {
    let answer = run(&mut Session::default(), parameters, motion);
    answer["faults"][field].as_str().unwrap_or_else(|| panic!("no fault of {field}: {answer}")).to_owned()
}

/// The scene file that the page hands out gives the history that it shows, bit for bit.
#[test]
fn the_scene_file_computes_the_same() {
    let cases = [
        (json!({}), json!({ "kind": "synthetic", "seed": "3", "pga": "2.5" })),
        (
            json!({ "mechanism": "vertical_spanning", "force_law": "trilinear", "overburden": "10000" }),
            json!({ "kind": "ricker", "amplitude": "3", "frequency": "1.5", "centre": "2" }),
        ),
        (
            json!({ "force_law": "rigid_linear", "damping_model": "none", "impact": "restitution" }),
            json!({ "kind": "harmonic", "amplitude": "2", "frequency": "1", "duration": "4" }),
        ),
        (json!({}), json!({ "kind": "sine_cycle", "amplitude": "1.5", "frequency": "1" })),
        (json!({ "u_start": "0.1" }), json!({ "kind": "none" })),
    ];
    for (parameters, motion) in cases {
        let mut session = Session::default();
        let answer = run(&mut session, &parameters, &motion);
        let toml = answer["answer"]["toml"].as_str().unwrap_or_else(|| panic!("{answer}"));
        let scene = Scene::parse("scene.toml", toml, "".as_ref()).unwrap();
        let csv = ask(&mut session, &json!("csv"));
        assert_eq!(csv["answer"], Response::of(&scene).unwrap().csv(), "{motion}");
    }
}

/// A wall of parts is drawn with them, and its scene file computes the same.
#[test]
fn parts_take_the_place_of_the_rectangle() {
    let mut session = Session::default();
    let run = |session: &mut Session, parts: &str| {
        let motion = json!({ "kind": "sine_cycle", "amplitude": "1.5", "frequency": "1" });
        let inputs = json!({ "parameters": {}, "motion": motion, "parts": parts, "width": 600 });
        ask(session, &json!({ "run": inputs }))
    };
    let facade = "[[geometry.part]]\nheight = 6\nthickness = 0.5\n\
                  [[geometry.load]]\nforce = 8e3\nheight = 3\ninside = 0.4\n";
    let answer = run(&mut session, facade);
    let answer = &answer["answer"];
    let toml = answer["toml"].as_str().unwrap_or_else(|| panic!("{answer}"));
    let scene = Scene::parse("scene.toml", toml, "".as_ref()).unwrap();
    assert_eq!(ask(&mut session, &json!("csv"))["answer"], Response::of(&scene).unwrap().csv());
    assert!(answer["drawing"].as_str().unwrap().contains("class=\"force\""), "{answer}");
    assert_eq!(answer["wall"]["shape"]["toes"], json!([0.25, -0.25]));
    for (parts, words) in [
        ("[[geometry.part]]\nheight = 6\n", "thickness"),
        ("[geometry]\nheight = 3\n", "[[geometry.part]]"),
        (&facade.replace("= 3", "= 7"), "load 1"),
    ] {
        let refused = run(&mut session, parts);
        let fault = refused["faults"]["parts"].as_str().unwrap_or_else(|| panic!("{refused}"));
        assert!(fault.contains(words), "{fault}");
    }
}

/// Browsers have windows of any width, and zoom makes widths of any digits.
#[test]
fn charts_have_any_width() {
    let mut session = Session::default();
    for width in (270..1250).step_by(41).map(f64::from).flat_map(|width| [width, width + 0.328_125]) {
        let motion = json!({ "kind": "sine_cycle", "amplitude": "1.5", "frequency": "1", "duration": "1" });
        let answer =
            ask(&mut session, &json!({ "run": { "parameters": {}, "motion": motion, "width": width } }));
        let svg = answer["answer"]["charts"]["history"]["svg"].as_str().unwrap_or_else(|| panic!("{answer}"));
        assert!(svg.contains("viewBox"), "{width}");
    }
}

#[test]
fn the_scene_of_a_record_computes_the_same() {
    let folder = std::env::temp_dir().join(format!("playground-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let record = "time,a_g\n0,0\n0.05,2\n0.1,-3\n0.15,1\n0.2,0\n";
    fs::write(folder.join("quake.csv"), record).unwrap();
    let mut session = Session::default();
    session.keep_record(record.into());
    let motion = json!({ "kind": "record", "record": "quake.csv", "unit": "m/s2", "scale": "1.5" });
    let answer = run(&mut session, &json!({}), &motion);
    let toml = answer["answer"]["toml"].as_str().unwrap_or_else(|| panic!("{answer}"));
    let scene = Scene::parse("scene.toml", toml, &folder).unwrap();
    assert_eq!(ask(&mut session, &json!("csv"))["answer"], Response::of(&scene).unwrap().csv());
    assert_eq!(answer["answer"]["warnings"], json!([]), "{answer}");
    let strong = json!({ "kind": "record", "record": "quake.csv", "unit": "m/s2", "scale": "100" });
    let answer = run(&mut session, &json!({}), &strong);
    let warning = answer["answer"]["warnings"][0].as_str().unwrap_or_else(|| panic!("{answer}"));
    assert!(warning.contains("a peak of 300.0 m/s² is 30.6 g"), "{warning}");
    // the same bytes read in another way
    let motion = json!({ "kind": "record", "record": "quake.csv", "unit": "", "scale": "1" });
    let answer = run(&mut session, &json!({}), &motion);
    assert!(answer["faults"]["record"].as_str().unwrap().contains("state the unit as `unit`"), "{answer}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_message_stands_beside_its_field() {
    let none = json!({ "kind": "none" });
    let synthetic = json!({ "kind": "synthetic", "seed": "1", "pga": "2" });
    assert!(fault(&json!({ "height": "-3" }), &none, "height").contains("below its minimum"));
    assert!(fault(&json!({ "height": "tall" }), &none, "height").contains("expected a number"));
    assert!(fault(&json!({ "a1": "0.9", "a3": "0.5" }), &synthetic, "a1").contains("smaller than a3"));
    let pulled = json!({ "overburden": "1e5", "overburden_eccentricity": "0.5" });
    assert!(fault(&pulled, &none, "overburden_eccentricity").contains("no rocking strength"));
    let pulse =
        |amplitude, frequency| json!({ "kind": "half_sine", "amplitude": amplitude, "frequency": frequency });
    assert!(fault(&json!({}), &pulse("1", "-1"), "frequency").contains("must be"));
    assert!(fault(&json!({}), &pulse("", "1"), "amplitude").contains("is not a number"));
    let seed = json!({ "kind": "synthetic", "seed": "1.5", "pga": "2" });
    assert!(fault(&json!({}), &seed, "seed").contains("whole number"));
    let record = json!({ "kind": "record", "record": "", "scale": "1" });
    assert!(fault(&json!({}), &record, "record").contains("drop a record"));
}

#[test]
fn the_verdict_says_whether_the_wall_falls() {
    let headline = |pga: &str| {
        let motion = json!({ "kind": "synthetic", "seed": "1", "pga": pga });
        let answer = run(&mut Session::default(), &json!({}), &motion);
        answer["answer"]["verdict"]["headline"].as_str().unwrap().to_owned()
    };
    assert!(headline("2.5").starts_with("The wall stands: it reaches "));
    assert!(headline("20").starts_with("The wall falls at "));
    assert_eq!(headline("0.01"), "The wall stands and hardly moves");
    let parameters = json!({ "restitution": "0.8", "impact": "restitution", "damping_model": "none" });
    let motion = json!({ "kind": "synthetic", "seed": "1", "pga": "8" });
    let answer = run(&mut Session::default(), &parameters, &motion);
    assert_eq!(
        answer["answer"]["verdict"]["headline"],
        "The wall exceeds u_ins at 7.05 s, comes back and falls at 9.26 s"
    );
}

/// A wall with an elastic branch rocks below the static onset. The displacement beyond which it overturns is
/// no capacity: in a check by a code, capacity is a part of it.
#[test]
fn onset_is_static_and_u_ins_is_no_capacity() {
    let motion = json!({ "kind": "synthetic", "seed": "1", "pga": "0.9" });
    let answer = run(&mut Session::default(), &json!({}), &motion);
    let detail = answer["answer"]["verdict"]["detail"].as_str().unwrap();
    assert!(detail.contains(" is 0.95 times the static onset of rocking, 0.952 m/s²."), "{detail}");
    let facts = answer["answer"]["facts"].as_array().unwrap();
    let fact = |name: &str| facts.iter().find(|fact| fact[0] == name).unwrap()[1].as_str().unwrap();
    assert_eq!(fact("static onset of rocking"), "0.952 m/s²");
    assert!(fact("half cycles of rocking").parse::<u32>().unwrap() > 1);
    assert!(!answer.to_string().contains("capacity"));
}

/// A tie that holds the wall beyond `u_ins`: the page does not say that it falls, and shows the whole run.
#[test]
fn a_wall_that_comes_back_does_not_fall() {
    let tied = json!({ "tie_stiffness": "5000", "tie_height": "3.5", "tie_side": "both" });
    let motion = json!({ "kind": "synthetic", "seed": "1", "pga": "6" });
    let answer = run(&mut Session::default(), &tied, &motion)["answer"].clone();
    assert_eq!(answer["verdict"]["headline"], "The wall exceeds u_ins at 10.75 s and comes back");
    assert_eq!(answer["summary"]["falls"], Value::Null);
    let [time, ratio] =
        [0, 2].map(|place| answer["charts"]["history"]["ranges"][place + 1].as_f64().unwrap());
    assert!(time > 20.0 && ratio > 1.9, "{time} {ratio}");
    let free = run(&mut Session::default(), &json!({}), &motion)["answer"].clone();
    assert!(free["summary"]["falls"].as_f64().unwrap() < 13.0);
}

#[test]
fn a_history_has_at_most_4000_points() {
    let motion = json!({ "kind": "harmonic", "amplitude": "0.5", "frequency": "1", "duration": "20" });
    let mut session = Session::default();
    run(&mut session, &json!({}), &motion);
    let frames = ask(&mut session, &json!("frames"));
    let times = frames["answer"]["t"].as_array().unwrap();
    assert!((2000..=4001).contains(&times.len()), "{}", times.len());
}

#[test]
fn every_parameter_is_described() {
    let answer = ask(&mut Session::default(), &json!("parameters"));
    let all = answer["answer"].as_array().unwrap();
    let height = all.iter().find(|one| one["name"] == "height").unwrap();
    assert_eq!((&height["default"], &height["unit"]), (&json!("4"), &json!("m")));
    let is_empty = |one: &&Value| one["default"].as_str().unwrap().is_empty();
    let without: Vec<_> = all.iter().filter(is_empty).map(|one| one["name"].as_str().unwrap()).collect();
    let of_wall: Vec<_> = without.into_iter().filter(|name| !name.starts_with("bar_")).collect();
    assert_eq!(of_wall, ["xi", "c_bar", "restitution"], "they are computed");
}

/// A bar gives the tie its numbers, in the run and in the scene file.
#[test]
fn a_tie_can_be_given_by_its_bar() {
    let bar = json!({
        "tie_height": "3", "bar_diameter": "0.006", "bar_length": "6", "bar_yield_stress": "235e6",
        "bar_ultimate_strain": "0.02", "bar_spacing": "3",
    });
    let answer = run(&mut Session::default(), &bar, &json!({ "kind": "synthetic", "seed": "1", "pga": "4" }))
        ["answer"]
        .clone();
    let facts = answer["facts"].as_array().unwrap();
    let value = |name: &str| facts.iter().find(|fact| fact[0] == name).unwrap_or_else(|| panic!("{name}"));
    // a third of 6.64 kN
    assert_eq!(value("largest force of the tie")[1], "2.21 kN", "{facts:?}");
    value("largest plastic elongation of the tie");
}

/// The page knows what each tie does in each frame, and has charts of its force and elongation.
#[test]
fn a_tie_is_slack_pulls_yields_and_breaks() {
    let tied = json!({
        "tie_height": "3", "tie_stiffness": "2e5", "tie_strength": "1e3", "tie_slack": "0.01",
        "tie_ultimate": "0.02", "tie_side": "both",
    });
    let (mut session, motion) = (Session::default(), json!({ "kind": "synthetic", "seed": "1", "pga": "4" }));
    let answer = run(&mut session, &tied, &motion)["answer"].clone();
    for (place, name) in ["tie_force", "tie_elongation"].into_iter().enumerate() {
        assert!(answer["captions"][place][0] == name && answer["charts"][name]["svg"].is_string());
    }
    let tie = ask(&mut session, &json!("frames"))["answer"]["ties"][0].clone();
    let states = tie["sides"].as_array().unwrap().iter().flat_map(|side| side["state"].as_array().unwrap());
    let states: std::collections::BTreeSet<_> = states.map(|state| state.as_u64().unwrap()).collect();
    assert!(states.into_iter().eq(0..4) && tie["sides"].as_array().unwrap().len() == 2);
    let free = run(&mut session, &json!({}), &motion)["answer"].clone();
    let frames = ask(&mut session, &json!("frames"))["answer"].clone();
    assert!(free["captions"] == json!([]) && frames["ties"] == json!([]));
}

/// The page shows the fields that matter, by the conditions of the model description.
#[test]
fn the_library_says_which_parameters_do_not_matter() {
    let mut session = Session::default();
    let mut unused = |parameters: Value| {
        let answer = ask(&mut session, &json!({ "unused": parameters }));
        let names = answer["answer"].as_array().unwrap_or_else(|| panic!("{answer}"));
        names.iter().map(|name| name.as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let plain = unused(json!({}));
    assert!(
        ["d1", "tie_height", "c_bar"].iter().all(|name| plain.contains(&(*name).to_owned())),
        "{plain:?}"
    );
    assert!(!plain.contains(&"xi".to_owned()));
    let changed =
        unused(json!({ "force_law": "trilinear", "tie_stiffness": "1e5", "damping_model": "none" }));
    assert!(!changed.iter().any(|name| name == "d1" || name == "tie_height"), "{changed:?}");
    assert!(changed.contains(&"xi".to_owned()) && changed.contains(&"restitution".to_owned()));
    // a number that is being typed hides nothing
    assert_eq!(unused(json!({ "height": "-" })), plain);
}

/// A number left empty is computed and shown; one that is given counts.
#[test]
fn a_given_number_counts() {
    let motion = json!({ "kind": "none" });
    let run = |parameters| run(&mut Session::default(), &parameters, &motion)["answer"].clone();
    let [computed, given] = [run(json!({})), run(json!({ "xi": "0.2" }))];
    assert_eq!(computed["computed"]["xi"], "0.0179");
    assert_eq!(given["computed"]["xi"], "0.2");
    assert!(given["toml"].as_str().unwrap().contains("xi = 0.2"));
    assert!(!computed["toml"].as_str().unwrap().contains("xi"));
    assert_ne!(computed["facts"], given["facts"]);
}

#[test]
fn a_fragility_comes_from_twenty_motions() {
    let mut session = Session::default();
    let wall = |parameters| json!({ "parameters": parameters, "motion": { "kind": "none" }, "width": 600 });
    let both = json!({ "impact": "restitution" });
    let refused = ask(&mut session, &json!({ "fragility": wall(both) }));
    assert!(refused["faults"]["fragility"].as_str().unwrap().contains("not both"));
    assert!(ask(&mut session, &json!("next_motion"))["faults"]["fragility"].is_string());

    ask(&mut session, &json!({ "fragility": wall(json!({ "height": "2" })) }));
    let mut last = Value::Null;
    for done in 1..=20 {
        last = ask(&mut session, &json!("next_motion"));
        assert_eq!(last["answer"]["done"], done);
    }
    let table = last["answer"]["result"]["table"].as_str().unwrap();
    // the second cell of each row
    let medians = table.split("<td>").skip(1).skip(1).step_by(4);
    let medians: Vec<f64> = medians.map(|cell| cell.split('<').next().unwrap().parse().unwrap()).collect();
    assert!(0.05 < medians[0] && medians[0] < medians[1] && medians[1] < 5.0, "{medians:?}");
    assert!(last["answer"]["result"]["figure"].as_str().unwrap().contains("<svg"));
}

/// Labels of fields and names of choices have their Italian, but for symbols and names that are both.
#[test]
fn every_label_has_its_italian() {
    let fields = include_str!("page/fields.js");
    let pairs: Vec<_> = include_str!("page/italian.txt").lines().map(|pair| pair.split_once(" | ")).collect();
    let english: Vec<&str> = pairs.iter().map(|pair| pair.expect("a pair").0).collect();
    let labels = fields.split("label: \"").skip(1).map(|rest| rest.split('"').next().unwrap());
    let names = fields.split("names: {").skip(1).map(|rest| rest.split('}').next().unwrap());
    let names =
        names.flat_map(|names| names.split(": \"").skip(1)).map(|rest| rest.split('"').next().unwrap());
    let both = ["q", "g", "m/s²", "cm/s²", "mm/s²", "Circolare 7/2019"];
    let missing: Vec<_> =
        labels.chain(names).filter(|label| !both.contains(label) && !english.contains(label)).collect();
    assert!(missing.is_empty() && english.len() > 150, "{missing:?}");
}

/// The check answers in the language of the page.
#[test]
fn the_check_speaks_italian() {
    let mut inputs = codes::run_and_check(&json!({}), &json!({}));
    inputs["run"]["language"] = json!("it");
    let check = ask(&mut Session::default(), &inputs)["answer"]["check"].clone();
    let has = |name: &str, words: &str| assert!(check[name].to_string().contains(words), "{check}");
    has("headline", "VERIFICA NON SODDISFATTA");
    has("notes", "La parete sopporta a_g = 0,128 g");
    has("rows", "punto della norma");
    has("numbers", "grandezza");
}
