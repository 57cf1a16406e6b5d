//! `wall verify accuracy` and `wall verify stability`.

use crate::command_line::{args, assert_has, content, folder, printed, refused, rows};

fn scene() -> String {
    crate::root().join("scenes/plain_parapet.toml").display().to_string()
}

#[test]
fn accuracy_measures_a_scene() {
    let folder = folder("accuracy");
    let peers = "scene,tool,setting,seconds,error_max\nwall 6 CDC,SciPy,RK45 1e-4,0.01,1e-3\n";
    std::fs::write(folder.join("peers.csv"), peers).unwrap();
    let measured = |outputs: &str| {
        printed(&folder, &[&["verify", "accuracy", &scene(), "--budget", "0"], &args(outputs)[..]].concat())
    };
    let table =
        measured("--peers peers.csv --csv a.csv --html a.html --linearisation l.csv --plot peers.svg");
    measured("--plot a.svg");
    let rows = rows(&folder, "a.csv");
    let errors = |solver: &str| -> Vec<f64> {
        rows.iter().filter(|row| row[1] == solver).map(|row| row[4].parse().unwrap()).collect()
    };
    let (exact, adaptive, newmark) = (errors("exact"), errors("adaptive"), errors("newmark"));
    assert_eq!([exact.len(), adaptive.len(), newmark.len()], [3, 6, 6]);
    // 100 ε S: a free motion from two thirds of u_ins is amplified some ten times
    assert!(exact.iter().all(|&error| error < 1e-12), "{exact:?}");
    assert!(adaptive[5] < 1e-12 && adaptive[0] > adaptive[5], "{adaptive:?}");
    assert!(newmark[0] > 1e-3 && newmark[5] < 1e-4, "{newmark:?}");
    let plot = content(&folder, "a.svg");
    assert_has(&plot, &["exact", "adaptive", "newmark", "run time (ms)"]);
    let plot = content(&folder, "peers.svg");
    assert_has(&plot, &["SciPy", "Table 5, wall 6 CDC"]);
    assert!(!plot.contains("newmark"));
    let page = content(&folder, "a.html");
    assert_eq!(page.matches("<figure>").count(), 6, "the scene, the peers, and small rotations");
    let content = content(&folder, "l.csv");
    assert_eq!(content.lines().count(), 1 + 2 * 3 * 15, "mechanisms, starts, angles");
    assert!(table.contains("1.56059 s instead of 1.56459 s"), "Figure 2");
    assert!(!page.contains("{{") && !page.contains("NaN"), "a place left open");
    assert!(page.contains("Beside other tools") && page.contains("exact, step"), "no words at the marks");
}

#[test]
fn stability_maps_every_solver() {
    let folder = folder("stability");
    let table =
        printed(&folder, &["verify", "stability", "--columns", "2", "--csv", "s.csv", "--html", "s.html"]);
    let rows = rows(&folder, "s.csv");
    let maps = 2 * evidence::stability::maps().len();
    assert_eq!(rows.len(), maps * 9 * 2);
    let of = |solver: &'static str| rows.iter().filter(move |row| row[0] == solver);
    for row in of("automatic") {
        let error: f64 = row[6].parse().unwrap();
        assert!(row[5] == "true" && error <= 1e-7, "{row:?}");
    }
    assert!(of("newmark").any(|row| row[5] == "false"), "a scheme that is known to blow up does");
    let page = content(&folder, "s.html");
    assert_eq!(page.matches("<figure>").count(), maps);
    assert!(!page.contains("{{") && !page.contains("NaN") && !table.contains("FAIL"));
}

#[test]
fn bad_input_is_refused_before_anything_is_measured() {
    let folder = folder("accuracy_refused");
    refused(&folder, &["verify", "accuracy", "none.toml"], &["none.toml"]);
    refused(
        &folder,
        &["verify", "accuracy", &scene(), "--html", "a.html", "--peers", "none.csv"],
        &["none.csv"],
    );
    refused(
        &folder,
        &["verify", "accuracy", &scene(), "--peers", "none.csv"],
        &["add --html FILE or --plot FILE"],
    );
    std::fs::write(folder.join("empty.csv"), "scene,tool,setting,seconds,error_max\n").unwrap();
    refused(
        &folder,
        &["verify", "accuracy", &scene(), "--html", "a.html", "--peers", "empty.csv"],
        &["no measurement"],
    );
    std::fs::write(folder.join("bad.toml"), "[geometry]\nheight = -3\n").unwrap();
    refused(&folder, &["verify", "accuracy", &scene(), "bad.toml"], &["bad.toml", "line 2", "-3"]);
    std::fs::write(folder.join("fallen.toml"), "[start]\nu_start = 0.21\n").unwrap();
    refused(
        &folder,
        &["verify", "accuracy", "fallen.toml"],
        &["u_start = 0.21 m is beyond u_ins", "set u_start = 0"],
    );
}
