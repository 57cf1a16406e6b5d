//! Tests what `wall building` prints and refuses. tests/masters tests what it makes, in other masters.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use crate::command_line::{folder, refused, text, wall};

const FLOOR: &str = "[[floor]]\nname = \"low\"\n";

#[test]
fn the_first_fault_is_named_with_its_line_and_nothing_is_left() {
    let folder = folder("building");
    fs::write(folder.join("parapet.toml"), "inputs = [\"a_bottom\"]\n").unwrap();
    fs::write(folder.join("moved.toml"), "[motion]\nsynthetic = {}\n").unwrap();
    let wall = |text: &str| format!("{FLOOR}[[wall]]\nname = \"w\"\n{text}\n");
    let cases: [(String, &[&str]); 12] = [
        (String::new(), &["[[floor]]"]),
        (format!("{FLOOR}mass = 0.0\n"), &["line 3", "mass", "0.001"]),
        (format!("{FLOOR}coupling = \"impulses\"\n"), &["line 3", "coupling", "stiffness"]),
        (format!("{FLOOR}hysteresis = \"cubic\"\n"), &["line 3", "cubic", "none, bilinear"]),
        (format!("{FLOOR}on = \"high\"\n"), &["line 3", "high", "ground"]),
        ("[[floor]]\nname = \"a b\"\n".into(), &["line 2", "a b", "letters"]),
        (format!("[[floor]]\nname = \"{}\"\n", "a".repeat(101)), &["line 2", "101", "at most 100"]),
        // the same file on machines whose file names ignore case
        (format!("{FLOOR}[[floor]]\nname = \"LOW\"\n"), &["line 4", "LOW", "choose another"]),
        (
            wall("scene = \"parapet.toml\"\nbottom = \"low\"\ntop = \"ground\"\ndrift = true"),
            &["line 8", "drift"],
        ),
        (FLOOR.into(), &["cargo xtask fmu", "--floor-fmu"]),
        (wall("scene = \"moved.toml\"\nbottom = \"low\""), &["moved.toml", "[motion]"]),
        // the option of this command, not that of `wall package`
        (wall("scene = \"parapet.toml\"\nbottom = \"low\""), &["cargo xtask fmu", "--wall-fmu"]),
    ];
    for (text, words) in cases {
        fs::write(folder.join("b.toml"), &text).unwrap();
        refused(&folder, &["building", "b.toml", "-o", "b.ssp"], words);
    }
}

const STOREYS: [(f64, f64); 3] = [(2.0e4, 4.0e7), (2.0e4, 3.0e7), (1.5e4, 2.0e7)];

fn parapet(width: f64) -> String {
    format!(
        "inputs = [\"a_bottom\"]\n[geometry]\nheight = 1.2\nthickness = 0.3\nwidth = {width:?}\n\
         [force_law]\na1 = 0.05\n[damping]\ndamping_model = \"constant_coefficient\"\n\
         xi = 0.05\n"
    )
}

/// Writes a building and returns its path.
fn written(folder: &Path, storeys: &[(f64, f64)], damping_ratio: f64, walls: &[(&str, &str)]) -> PathBuf {
    let mut building = String::from("title = \"a test\"\n");
    let mut below = "ground".to_owned();
    for (index, (mass, stiffness)) in storeys.iter().enumerate() {
        let name = format!("floor_{}", index + 1);
        // writing to a String cannot fail
        let _ = write!(building, "[[floor]]\nname = \"{name}\"\non = \"{below}\"\nmass = {mass:?}\n");
        let _ = write!(building, "stiffness = {stiffness:?}\ndamping_ratio = {damping_ratio:?}\n");
        below = name;
    }
    for (name, keys) in walls {
        let _ = write!(building, "[[wall]]\nname = \"{name}\"\nscene = \"{name}.toml\"\n{keys}\n");
    }
    let path = folder.join("b.toml");
    fs::write(&path, building).unwrap();
    path
}

#[test]
fn the_program_prints_peaks_and_writes_histories() {
    let folder = folder("building_record");
    fs::write(folder.join("light.toml"), parapet(1.0)).unwrap();
    let thin = parapet(1.0).replace("thickness = 0.3", "thickness = 0.06");
    fs::write(folder.join("thin.toml"), thin).unwrap();
    let roof = "bottom = \"floor_3\"";
    written(&folder, &STOREYS, 0.03, &[("light", roof), ("thin", roof)]);
    let arguments = [
        "building",
        "b.toml",
        "--synthetic",
        "--scale",
        "0.4",
        "--csv",
        "h.csv",
        "--tail",
        "2",
        "--html",
        "p.html",
        "--svg",
        "b.svg",
    ];
    let output = wall(&folder, &arguments);
    let shown = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let row = |name: &str| shown.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(row("light").ends_with("no") && row("thin").contains(" at "), "{shown}");
    let csv = fs::read_to_string(folder.join("h.csv")).unwrap();
    assert!(
        csv.starts_with("time_s,ground.acceleration_m_s2,floor_1.acceleration_m_s2,floor_1.drift_m,"),
        "{}",
        &csv[..80]
    );
    assert!(!folder.join("fmu_out").exists(), "a run writes no SSP");
    let svg = fs::read_to_string(folder.join("b.svg")).unwrap();
    // the last time that |u| exceeds u_ins, from the history itself
    let place = csv.lines().next().unwrap().split(',').position(|name| name == "thin.u_ratio").unwrap();
    let cell = |line: &str, place: usize| line.split(',').nth(place).unwrap().parse::<f64>().unwrap();
    let within = csv.lines().skip(1).filter(|line| cell(line, place).abs() < 1.0);
    let falls = cell(within.last().unwrap(), 0);
    let said = format!("The thin exceeds u_ins at 8.4 s, comes back and falls at {falls:.1} s");
    assert!(falls > 10.0 && svg.contains(&said) && svg.contains("skewX") && !svg.contains("<script"));
    assert!(svg.len() < 100_000 && !svg.contains("NaN"), "{} bytes", svg.len());
    let page = fs::read_to_string(folder.join("p.html")).unwrap();
    assert!(page.contains(&format!("<p class=\"verdict falls\">{said}")));
    let links = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!links.contains("http") && !page.contains("{{") && !page.contains("NaN"));
    let json = wall(&folder, &[&arguments[..5], &["--tail", "2", "--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&text(&json.stdout)).unwrap();
    assert!(json["walls"][0]["overturn_time"].is_null() && json["walls"][1]["overturn_time"].is_f64());
    refused(&folder, &["building", "b.toml", "--csv", "x.csv"], &["--record", "--synthetic"]);
    refused(&folder, &["building", "b.toml", "--synthetic", "--tolerance", "0"], &["--tolerance"]);
}
