//! Tests `wall simulate`: demands, tables, pictures and what it refuses.

use std::fs;

use ground_motion::SyntheticMotion;
use rocking_wall::choices::Mechanism;
use scene::{Floors, StoreyTable, SupportsTable};

use crate::command_line::{
    args, assert_has, content, fails, folder, json, printed, refused, rows, setting, succeed, text,
};

#[test]
fn the_program_reports_demands() {
    let folder = folder("demands");
    let summary = json(&folder, &["simulate", "--synthetic", "--json", "--thresholds", "0.5,1"]);
    let demands = &summary["demands"];
    assert_eq!(demands["thresholds"][1]["time"], summary["overturn_time"]);
    assert_eq!(demands["thresholds"][0]["fraction"], 0.5);
    assert!(demands["reaction_bottom"]["lowest"]["value"].as_f64().unwrap() < 0.0);
    let table = printed(&folder, &["simulate", "--synthetic", "--html", "page.html"]);
    let words =
        ["base force", "first reached  0.1 u_ins at", "half cycles", "residual u", "up to overturning"];
    assert_has(&table, &words);
    assert!(content(&folder, "page.html").contains("0.1 u_ins at"));
    let folder = crate::command_line::folder("demands_refused");
    for bad in ["0", "1.5", "nan", "-0.1"] {
        refused(
            &folder,
            &["simulate", &format!("--thresholds={bad}")],
            &["thresholds", "above 0 and at most 1"],
        );
    }
    fs::write(folder.join("bad.toml"), "thresholds = [0.4, 2]\n").unwrap();
    refused(&folder, &["simulate", "bad.toml"], &["bad.toml", "line 1", "thresholds", "2"]);
}

/// The page shows the transverse walls, on the side to which the wall cannot rock.
#[test]
fn the_page_shows_the_transverse_walls() {
    let folder = folder("one_sided_pictures");
    // the wall is 0.4 m thick
    for (rocking, drawn) in [
        ("one_sided_positive", "x=\"-12.6000\" y=\"0.0000\" width=\"12.4000\""),
        ("one_sided_negative", "x=\"0.2000\" y=\"0.0000\" width=\"12.4000\""),
    ] {
        let impacts = "impact=restitution restitution=0.4 damping_model=none u_start=0 height=3";
        let settings = format!("rocking={rocking} {impacts}");
        succeed(&folder, &setting("simulate --synthetic --html w.html", &settings));
        assert_has(&content(&folder, "w.html"), &[drawn]);
    }
}

#[test]
fn supports_that_do_not_exist_are_refused() {
    let floors =
        |supports| Floors::new(&[StoreyTable { period: Some(0.3), ..StoreyTable::default() }], supports);
    let roof = SupportsTable { bottom: Some(1), ..SupportsTable::default() };
    let floors_of = floors(roof).unwrap();
    assert_eq!(floors_of.supports(Mechanism::Parapet).unwrap(), (1, None));
    assert!(floors_of.supports(Mechanism::VerticalSpanning).is_err(), "a strip on the roof");
    let below = floors(SupportsTable::default()).unwrap();
    assert_eq!(below.supports(Mechanism::VerticalSpanning).unwrap(), (0, Some(1)));
    let folder = folder("floors");
    let storey = "[[storeys]]\nmass = 1e4\nstiffness = 1e6\n";
    let cases: [(String, &[&str]); 7] = [
        ("[supports]\nbottom = 1\n".into(), &["line 1", "[[storeys]]"]),
        (format!("{storey}period = 1.0\n"), &["line 1", "either a stiffness"]),
        (format!("{storey}[[storeys]]\nperiod = 0.2\n"), &["line 4", "mass"]),
        (format!("{storey}[supports]\nbottom = 2\n"), &["line 4", "no floor 2", "1 to 1"]),
        (format!("{storey}damping_ratio = 1.5\n"), &["damping ratio", "1.5"]),
        (storey.into(), &["[motion]", "--record"]),
        (format!("{storey}[supports]\ntop = 1\n[motion]\nsynthetic = {{}}\n"), &["parapet", "top"]),
    ];
    for (text, words) in cases {
        fs::write(folder.join("s.toml"), &text).unwrap();
        refused(&folder, &["simulate", "s.toml"], words);
    }
    fails(&folder, &["simulate", "--synthetic", "--floor", "xi=0.3"], &["a period"]);
    refused(&folder, &["simulate", "--synthetic", "--floor", "T=0.3", "--hold"], &["--hold"]);
    let heavy = ["simulate", "--synthetic", "--floor", "T=0.3,xi=0.05,mass=1e4"];
    assert_has(&text(&succeed(&folder, &heavy).stderr), &["wall building"]);
    let light = succeed(&folder, &["simulate", "--synthetic", "--floor", "T=0.3,xi=0.05,mass=1e6"]);
    assert!(light.stderr.is_empty());
    assert_has(&text(&light.stdout), &["felt on a floor, T = 0.300 s"]);
}

/// A wall with a loaded edge rocks differently under both signs of a record, and a table holds what single
/// runs give.
#[test]
fn many_records_make_a_table() {
    let folder = folder("many_records");
    fs::create_dir(folder.join("records")).unwrap();
    for seed in 0..4 {
        let motion = SyntheticMotion { seed, duration: 10.0, ..SyntheticMotion::default() }.motion().unwrap();
        let rows = motion.samples().iter().enumerate();
        let rows: Vec<_> = rows.map(|(k, a)| format!("{},{a:?}\n", k as f64 * motion.step())).collect();
        fs::write(folder.join(format!("records/{seed}.csv")), format!("time,a_g\n{}", rows.concat()))
            .unwrap();
    }
    let settings = "thickness=0.25 overburden=2000 overburden_eccentricity=0.05";
    let wall = setting("simulate --unit m/s2", settings);
    let files = ["records/0.csv", "records/1.csv", "records/2.csv", "records/3.csv"];
    let arguments = [&["--records"], &files[..]].concat();
    let both = [&wall[..], &arguments, &["--both-polarities", "--csv", "table.csv"]].concat();
    let table = printed(&folder, &both);
    assert_eq!(table.lines().count(), 1 + 1 + 8 + 1 + 1, "{table}");
    for (pair, file) in rows(&folder, "table.csv").chunks(2).zip(files) {
        assert_eq!((&*pair[0][1], &*pair[1][1]), ("+1", "-1"));
        assert_ne!(pair[0][3..], pair[1][3..], "{file}");
        let single = json(&folder, &[&wall[..], &["--record", file, "--json"]].concat());
        let (u, ratio): (f64, f64) = (pair[0][3].parse().unwrap(), pair[0][4].parse().unwrap());
        assert!((single["u_max"].as_f64().unwrap() / u - 1.0).abs() < 1e-9);
        assert!((single["u_ratio_max"].as_f64().unwrap() / ratio - 1.0).abs() < 1e-9);
    }
    let json = json(&folder, &[&wall[..], &arguments, &["--json"]].concat());
    assert_eq!(json["runs"].as_array().unwrap().len(), 4);
    let html = [&["simulate"], &arguments[..], &["--unit", "m/s2", "--html", "a.html"]].concat();
    refused(&folder, &html, &["--html", "--record"]);
}

const SCENE: &str = "[geometry]\nkinematics = \"trigonometric\"\n[force_law]\nforce_law = \"rigid_linear\"\n\
                     [damping]\ndamping_model = \"none\"\n[impact]\nimpact = \"restitution\"\n";

#[test]
fn what_full_rotations_do_not_know_is_refused_with_the_remedy() {
    let folder = folder("trigonometric_refused");
    fs::write(folder.join("good.toml"), SCENE).unwrap();
    let simulate = |setting: &'static str| vec!["simulate", "good.toml", "--set", setting];
    for (setting, words) in [
        ("force_law=bilinear", &["force_law = bilinear", "rigid_linear"][..]),
        ("a3=0.9", &["a3 = 0.9", "set a3 = 1"]),
        ("damping_model=free_standing_block", &["free_standing_block", "impact = restitution"]),
        ("solver=exact", &["solver = exact", "adaptive"]),
        ("solver=newmark", &["solver = newmark", "adaptive"]),
        ("kinematics=spherical", &["spherical", "linear, trigonometric"]),
    ] {
        refused(&folder, &simulate(setting), words);
    }
    let strip = SCENE.replacen("[geometry]", "[geometry]\nmechanism = \"vertical_spanning\"", 1);
    fs::write(folder.join("strip.toml"), strip).unwrap();
    refused(&folder, &["package", "strip.toml", "-o", "x.fmu"], &["kinematics = linear", "wall simulate"]);
    fs::write(folder.join("table.toml"), "[solver]\nkinematics = \"linear\"\n").unwrap();
    refused(&folder, &["simulate", "table.toml"], &["line 2", "[geometry]"]);
    fs::write(folder.join("a.csv"), "0.0\n1.0\n0.0\n").unwrap();
    let record = "record = \"a.csv\"\nunit = \"m/s2\"\nstep = 0.1\n";
    let apart = format!("{SCENE}[motion]\n{record}[motion.top]\n{record}");
    let strip = apart.replacen("[geometry]", "[geometry]\nmechanism = \"vertical_spanning\"", 1);
    fs::write(folder.join("apart.toml"), strip).unwrap();
    refused(
        &folder,
        &["simulate", "apart.toml"],
        &["apart.toml, line", "[motion.top]", "kinematics = linear"],
    );
    succeed(&folder, &["simulate", "good.toml", "--html", "page.html"]);
    let page = content(&folder, "page.html");
    assert!(page.contains("0.26 % short") && !page.contains("NaN"), "the error of small rotations");
}

#[test]
fn a_file_that_says_nothing_is_no_scene() {
    let folder = folder("nothing");
    for nothing in ["", "# a comment\n\n  # and another\n"] {
        fs::write(folder.join("empty.toml"), nothing).unwrap();
        for command in ["simulate", "check", "study tie"] {
            let words = ["empty.toml: is empty or has comments alone; state the wall, as in"];
            refused(&folder, &args(&format!("{command} empty.toml")), &words);
        }
    }
}
