//! Tests what the program and the FMU warn of: numbers that walls rarely have, and starts that overturn.

use std::sync::{Arc, Mutex};

use fmu_export::{Category, Environment, Filter, Interface, Log, Model, Status};
use rocking_wall::unit::Unit;
use rocking_wall::variables::RealVariable;

use crate::command_line::{folder, text, wall};

/// Runs `arguments` and returns what the program warns of.
fn warned(arguments: &[&str]) -> String {
    let output = wall(&folder("warnings"), arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stderr)
}

#[test]
fn improbable_walls_are_warned_of() {
    let heavy = "overburden=3000";
    for (changes, words) in [
        (vec!["density=1.8"], ["density = 1.8 kg/m3", "400 to 3000 kg/m3"]),
        (vec!["overburden=10"], ["overburden = 10 N", "100 to 1000000 N"]),
        (vec![heavy, "overburden_eccentricity=0.25"], ["overburden_eccentricity = 0.25 m", "-0.2 to 0.2 m"]),
        // 100 N/m times 0.07 m is 7.000000000000001 N
        (vec!["width=0.07", "overburden=1"], ["overburden = 1 N is", "7 to 70000 N"]),
        (vec!["width=0.07", "overburden=1e11"], ["overburden = 1e11 N is", "7 to 70000 N"]),
        (vec!["height=300"], ["height = 300 m", "0.2 to 30 m"]),
        (vec!["thickness=5", "u_start=0"], ["height/thickness = 0.8 is", "1 to 100 is"]),
        (vec!["gravity=1.62"], ["gravity = 1.62 m/s2", "9.7 to 9.9 m/s2"]),
    ] {
        let mut arguments = vec!["simulate", "--stop-time", "0.1"];
        for change in changes {
            arguments.extend(["--set", change]);
        }
        let message = warned(&arguments);
        for word in words {
            assert!(message.contains(word), "{arguments:?}: no {word:?} in {message}");
        }
    }
    // usual walls are silent, also where an eccentricity has no load
    assert_eq!(warned(&["simulate", "--stop-time", "0.1"]), "");
    let eccentric = ["simulate", "--stop-time", "0.1", "--set", "overburden_eccentricity=0.25"];
    assert_eq!(warned(&eccentric), "");
}

/// The default start of 0.18 m is beyond u_ins of a wall 0.3 m thick, 0.15 m.
#[test]
fn a_start_beyond_u_ins_is_warned_of() {
    let message = warned(&["simulate", "--set", "thickness=0.3", "--stop-time", "1"]);
    assert!(message.contains("u_start = 0.18 m is beyond u_ins = 0.150000 m"), "{message}");
    assert!(!warned(&["simulate", "--set", "thickness=0.37", "--stop-time", "1"]).contains("beyond"));
}

#[test]
fn the_unit_logs_a_start_beyond_u_ins() {
    let logged = |thickness: f64| {
        let texts = Arc::new(Mutex::new(Vec::new()));
        let sink = texts.clone();
        let mut push = move |_: Status, _: Category, text: &str| sink.lock().unwrap().push(text.to_owned());
        let mut log = Log::new(&mut push, Filter::ERRORS.with(Category::Warning));
        let environment = Environment {
            interface: Interface::CoSimulation,
            instance_name: "wall",
            resources: None,
            payload: None,
        };
        let mut unit = Unit::instantiate(environment, &mut log).unwrap();
        unit.set_real(RealVariable::Thickness, thickness);
        unit.initialize(&mut log).unwrap();
        texts.lock().unwrap().concat()
    };
    assert!(logged(0.3).contains("u_start = 0.18 m is beyond u_ins"), "{}", logged(0.3));
    assert_eq!(logged(0.4), "");
}

/// A strip wall whose supports have motions of their own shows both, and both peaks.
#[test]
fn two_motions_are_both_shown() {
    let folder = folder("two_motions");
    let record = |name: &str, peak: f64| {
        let sample = |k: u32| format!("{:.2},{}\n", 0.01 * f64::from(k), peak * f64::from(k % 3) / 2.0);
        let rows: String = (0..300).map(sample).collect();
        std::fs::write(folder.join(name), format!("time,a_g\n{rows}")).unwrap();
    };
    record("bottom.csv", 0.25);
    record("top.csv", 0.75);
    let scene = "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3\nthickness = 0.3\n\
                 [motion]\nrecord = \"bottom.csv\"\nunit = \"m/s2\"\n\
                 [motion.top]\nrecord = \"top.csv\"\nunit = \"m/s2\"\n";
    std::fs::write(folder.join("strip.toml"), scene).unwrap();
    let output = wall(&folder, &["simulate", "strip.toml", "--html", "page.html"]);
    let summary = text(&output.stdout);
    assert!(summary.contains("0.2500 m/s² (bottom), 0.7500 m/s² (top)"), "{summary}");
    let page = std::fs::read_to_string(folder.join("page.html")).unwrap();
    let motion = page.split("<figure>").find(|figure| figure.contains("id=\"motion\"")).unwrap();
    assert!(motion.contains("bottom (grey), top (amber)"), "{motion}");
    for color in [figures::palette::DARK_GREY, figures::palette::AMBER] {
        assert!(motion.contains(&format!("stroke=\"{color}\"")), "no {color} in {motion}");
    }
}

/// Writes a study into a folder of its own and returns what `wall ida` warns of.
fn warned_of_study(name: &str, study: &str) -> String {
    let folder = folder(name);
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let output = wall(&folder, &["ida", "study.toml"]);
    let message = text(&output.stderr);
    assert!(output.status.success(), "{message}");
    message
}

/// The PGA at which a rigid wall starts to rock hardly depends on the record; that of its collapse does.
#[test]
fn contradictions_of_a_common_beta_are_warned_of() {
    let study = |fractions: &str| {
        format!(
            "models = [\"CR rigid\"]\nintensity = {{ measure = \"PGA\" }}\n\
             report = {{ fractions = {fractions} }}\n\
             records = {{ synthetic = {{ count = 8, duration = 10 }} }}\n\
             levels = {{ method = \"hunt\", first = 0.02, increase = 0.1, top = 4, gap = 0.1 }}\n\
             [[walls]]\nname = \"parapet\"\ngeometry = {{ height = 3, thickness = 0.3 }}\n"
        )
    };
    let message = warned_of_study("contradicted", &study("[0.001, 1]"));
    for words in [
        "warning: limit states contradict a common beta in 1 of 1 fits",
        ": wall \"parapet\" with CR rigid (0.08, 0.30); their fitted curves are rough",
        "see the steps on the page and beta_alone in fragilities.csv",
    ] {
        assert!(message.contains(words), "no {words:?} in {message}");
    }
    let alike = warned_of_study("not_contradicted", &study("[0.9, 1]"));
    assert!(!alike.contains("beta"), "{alike}");
}

/// Steps of Newmark and elastic frequencies that make a study slow are named before its runs.
#[test]
fn a_study_warns_of_much_work() {
    // each run overturns within the first steps
    let study = |wall: &str| {
        format!(
            "models = [\"CR\"]\nlevels = {{ method = \"grid\", values = [50] }}\n\
             records = {{ synthetic = {{ count = 1, duration = 10 }} }}\n\
             [[walls]]\nname = \"slow\"\n{wall}\n"
        )
    };
    for (name, settings, words) in [
        (
            "newmark",
            "solver = { solver = \"newmark\", newmark_step = 1e-7 }",
            "newmark_step = 1e-7 s: 100000 ",
        ),
        ("stiff", "force_law = { a1 = 1e-9 }", "omega1 = "),
    ] {
        let message = warned_of_study(&format!("work_{name}"), &study(settings));
        assert!(message.contains(&format!("warning: wall \"slow\": {words}")), "{message}");
        assert!(message.contains("computing takes as much longer than usual"), "{message}");
    }
}

/// A study shakes its walls with its own records.
#[test]
fn a_study_says_that_it_ignores_a_motion() {
    let folder = folder("ignored_motion");
    std::fs::write(folder.join("shaken.toml"), "[motion]\nsynthetic = {}\n").unwrap();
    let study = "models = [\"CR\"]\nlevels = { method = \"grid\", values = [0.1] }\n\
                 records = { synthetic = { count = 1, duration = 10 } }\n\
                 [[walls]]\nscene = \"shaken.toml\"\n\
                 [[walls]]\nname = \"light\"\ngeometry = { density = 1.8 }\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let message = text(&wall(&folder, &["ida", "study.toml"]).stderr);
    assert!(message.contains("wall \"shaken\": the study ignores the motion of its scene"), "{message}");
    assert!(message.contains("wall \"light\": density = 1.8 kg/m3 is unusual"), "{message}");
}
