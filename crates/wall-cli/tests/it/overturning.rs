//! Tests that every command says the same of a wall that overturns, and of one that comes back.

use std::fs;

use ground_motion::SyntheticMotion;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::TieSide;
use rocking_wall::wall::Parameters;
use scene::Scene;
use scene::response::{Fate, Response};
use serde_json::Value;

use crate::command_line::{
    assert_has, content, fails, folder, json, printed, refused, rows, setting, succeed,
};

/// Returns the fate of the default parapet under `scale` times the synthetic motion, with a tie of a
/// stiffness [N/m] against both sides.
fn fate(scale: f64, tie_stiffness: f64) -> Fate {
    let tie_side = TieSide::Both;
    let parameters = Parameters { tie_height: 3.0, tie_stiffness, tie_side, ..Parameters::default() };
    let mut scene = Scene { parameters, ..Scene::default() };
    let motion = SyntheticMotion::default().motion().unwrap().checked_scaled(scale).unwrap();
    scene.shake(Excitation::new(motion, None), 10.0, Vec::new());
    Response::of(&scene).unwrap().summary.fate
}

/// The same number of a fall in the text, the JSON and the tables of all commands that run it.
#[test]
fn every_output_says_the_same_of_a_fall() {
    let folder = folder("overturning_rule");
    let run = |arguments: &[&str]| printed(&folder, arguments);
    run(&["record", "--synthetic", "--scale", "3", "--samples", "strong.csv"]);
    let record = ["--record", "strong.csv"];
    let told = run(&[&["simulate", "--html", "p.html"], &record[..]].concat());
    assert_has(&told, &["0.200000 m, 1.0000 u_ins, where the wall falls\n"]);
    let page = content(&folder, "p.html");
    assert!(page.contains("<td>200.0 mm, 1.0000 u_ins, where the wall falls</td>"));
    let value = json(&folder, &[&["simulate", "--json"], &record[..]].concat());
    assert_eq!((&value["u_ratio_max"], &value["falls"]), (&1.0.into(), &true.into()), "{value}");
    let table = run(&["simulate", "--records", "strong.csv", "--csv", "table.csv"]);
    assert_has(&table, &["    200.00     1.0000  at "]);
    let csv = content(&folder, "table.csv");
    let header = "record,sign,pga_m_s2,u_max_m,u_ratio_max,overturned,overturn_time_s,falls";
    assert_eq!(csv.lines().next(), Some(header));
    assert!(csv.contains(",1.0,true,") && csv.ends_with(",true\n"), "{csv}");
    let study = "models = [\"CDR\"]\nlevels = { method = \"grid\", values = [0.1, 0.9] }\n\
                 intensity = { measure = \"PGA\" }\nrecords = { files = [\"strong.csv\"] }\n\
                 report = { resamples = 100 }\n[[walls]]\nname = \"p\"\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    run(&["study", "ida", "study.toml", "-o", "r"]);
    let levels = content(&folder, "r/levels.csv");
    let fallen: Vec<_> = levels.lines().filter(|line| line.contains(",1.0,true,")).collect();
    assert_eq!(fallen.len(), 1, "u/u_ins = 1 and overturned: {levels}");
}

/// Polarity: a record alone is run with both signs; a wall that is alike on both sides is run once.
#[test]
fn both_polarities_of_one_record_and_of_a_tie() {
    let folder = folder("polarities");
    let run = |arguments: &[&str]| printed(&folder, arguments);
    run(&["record", "--synthetic", "--samples", "r.csv"]);
    let both = ["simulate", "--record", "r.csv", "--both-polarities"];
    let alike = run(&both);
    assert_has(&alike, &["both sides of the wall are alike", "   ±  "]);
    let leaning = "overburden=5000 overburden_eccentricity=0.05 eccentricity_mode=fixed_to_wall";
    let told = run(&setting("simulate --record r.csv --both-polarities --csv t.csv", leaning));
    assert!(!told.contains("alike"), "{told}");
    let [first, second] = rows(&folder, "t.csv").try_into().unwrap();
    assert_eq!([&*first[1], &*second[1]], ["+1", "-1"]);
    assert_ne!(first[3], second[3]);
    refused(&folder, &[&both[..], &["--html", "p.html"]].concat(), &["--html", "without --both-polarities"]);
    fails(&folder, &["simulate", "--synthetic", "--both-polarities"], &["--record <FILE>"]);

    let tie = |more: &[&str]| {
        let tie =
            ["study", "tie", "--records", "r.csv", "--set", "tie_height=3", "--stiffness", "1e5", "--json"];
        json(&folder, &[&tie[..], more].concat())
    };
    let (one, two) = (tie(&[]), tie(&["--both-polarities"]));
    assert_eq!(
        (&one["motions"], &two["motions"], &two["tie_side"]),
        (&1.into(), &2.into(), &"positive".into())
    );
    // pulled by one sign only
    let force = |value: &Value, name: &str| value["rows"][0][name].as_f64().unwrap();
    assert!(force(&two, "force_median_n") <= force(&two, "force_max_n"), "{two}");
    assert!(force(&two, "force_max_n") >= force(&one, "force_max_n"), "{two}");
    let both_sides = tie(&["--both-polarities", "--set", "tie_side=both"]);
    assert!(both_sides["motions"] == 1 && both_sides["alike_on_both_sides"] == true, "{both_sides}");
}

/// The table of ties states its side, gives forces in kN, and tells falls from walls that come back. Before,
/// both counted as overturned.
#[test]
fn a_tie_that_holds_a_wall_beyond_u_ins() {
    let folder = folder("tie_back");
    let (scales, names) = ([1.5, 2.0, 2.5, 3.0], ["a.csv", "b.csv", "c.csv", "d.csv"]);
    for (scale, name) in scales.iter().zip(names) {
        succeed(&folder, &["record", "--synthetic", "--scale", &scale.to_string(), "--samples", name]);
    }
    let tie = setting("study tie --stiffness 0,1e4,1e7 --csv t.csv", "tie_height=3 tie_side=both");
    let told = printed(&folder, &[&tie[..], &["--records"], &names].concat());
    assert_has(&told, &["tie at 3 m against both sides, 4 motions", "[kN]"]);
    let csv = content(&folder, "t.csv");
    let header: Vec<_> = csv.lines().next().unwrap().split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let place = header.iter().position(|column| *column == name).unwrap();
        csv.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().parse().unwrap()).collect()
    };
    let expect = |stiffness: f64| {
        let fates = scales.map(|scale| fate(scale, stiffness));
        let count = |is: fn(&Fate) -> bool| fates.iter().filter(|fate| is(fate)).count() as f64;
        [count(Fate::falls), count(|fate| matches!(fate, Fate::ComesBack { .. }))]
    };
    let (falls, back) = (column("falls"), column("beyond_u_ins_and_back"));
    for (index, stiffness) in [0.0, 1e4, 1e7].into_iter().enumerate() {
        assert_eq!([falls[index], back[index]], expect(stiffness), "{stiffness}: {told}");
    }
    assert!(falls[0] > 0.0 && back[1] > 0.0, "{told}");
    assert!(falls.is_sorted_by(|a, b| a >= b), "a stiffer tie lets fewer walls fall: {told}");
    let force = column("force_max_n")[1] / 1000.0;
    // four digits
    assert!(told.contains(&format!("{force:.3}")) && force < 10.0, "{force} kN: {told}");
}
