//! Tests what `wall building` prints and refuses. tests/masters tests what it makes, in other masters.

use std::fs;

use fmu_export_build::archive::Archive;

use crate::command_line::{args, content, folder, json, printed, refused};

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
        (format!("[[floor]]\nname = \"{}\"\n", "a".repeat(101)), &["line 2", "at most 100"]),
        // the same file on machines whose file names ignore case
        (format!("{FLOOR}[[floor]]\nname = \"LOW\"\n"), &["line 4", "LOW", "taken"]),
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

/// Three storeys with a parapet and a thin one on the roof.
const BUILDING: &str = r#"
floor = [
  { name = "floor_1", mass = 2e4, stiffness = 4e7, damping_ratio = 0.03 },
  { name = "floor_2", on = "floor_1", mass = 2e4, stiffness = 3e7, damping_ratio = 0.03 },
  { name = "floor_3", on = "floor_2", mass = 1.5e4, stiffness = 2e7, damping_ratio = 0.03 },
]
wall = [
  { name = "light", scene = "light.toml", bottom = "floor_3" },
  { name = "thin", scene = "thin.toml", bottom = "floor_3" },
]
"#;
const PARAPET: &str = r#"
inputs = ["a_bottom"]
geometry = { height = 1.2, thickness = 0.3 }
force_law = { a1 = 0.05 }
damping = { damping_model = "constant_coefficient", xi = 0.05 }
"#;

#[test]
fn the_program_prints_peaks_and_writes_histories() {
    let folder = folder("building_record");
    fs::write(folder.join("light.toml"), PARAPET).unwrap();
    fs::write(folder.join("thin.toml"), PARAPET.replace("0.3", "0.06")).unwrap();
    fs::write(folder.join("b.toml"), BUILDING).unwrap();
    let arguments = args("building b.toml --synthetic --scale 0.4 --csv h.csv --tail 2 --html p.html");
    let shown = printed(&folder, &arguments);
    let row = |name: &str| shown.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(row("light").ends_with("no") && row("thin").contains(" at "), "{shown}");
    let csv = content(&folder, "h.csv");
    assert!(
        csv.starts_with("time_s,ground.acceleration_m_s2,floor_1.acceleration_m_s2,floor_1.drift_m,"),
        "{}",
        &csv[..80]
    );
    assert!(!folder.join("fmu_out").exists(), "a run writes no SSP");
    // the last time that |u| exceeds u_ins, from the history itself
    let place = csv.lines().next().unwrap().split(',').position(|name| name == "thin.u_ratio").unwrap();
    let cell = |line: &str, place: usize| line.split(',').nth(place).unwrap().parse::<f64>().unwrap();
    let within = csv.lines().skip(1).filter(|line| cell(line, place).abs() < 1.0);
    let falls = cell(within.last().unwrap(), 0);
    let said = format!("The thin exceeds u_ins at 8.4 s, comes back and falls at {falls:.1} s");
    assert!(falls > 10.0, "{falls}");
    let page = content(&folder, "p.html");
    assert!(page.contains(&format!("<p class=\"verdict falls\">{said}")));
    let links = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!links.contains("http") && !page.contains("{{") && !page.contains("NaN"));
    let json = json(&folder, &[&arguments[..5], &["--tail", "2", "--json"]].concat());
    assert!(json["walls"][0]["overturn_time"].is_null() && json["walls"][1]["overturn_time"].is_f64());
    refused(&folder, &["building", "b.toml", "--csv", "x.csv"], &["--record", "--synthetic"]);
    refused(&folder, &["building", "b.toml", "--synthetic", "--tolerance", "0"], &["--tolerance"]);
}

/// The default output lies in a folder that need not exist.
#[test]
fn the_default_folder_is_made() {
    let folder = folder("building_folder");
    fs::write(folder.join("b.toml"), FLOOR).unwrap();
    // a general FMU without its libraries
    let mut general = Archive::default();
    let description =
        fs::read_to_string(crate::root().join("crates/floor/modelDescription/modelDescription.xml"));
    general.insert("modelDescription.xml", description.unwrap());
    fs::write(folder.join("floor.fmu"), general.to_bytes().unwrap()).unwrap();
    let told = printed(&folder, &["building", "b.toml", "--floor-fmu", "floor.fmu"]);
    assert!(told.starts_with("fmu_out/building.ssp: b, 1 unit"), "{told}");
    assert!(folder.join("fmu_out/building.ssp").is_file());
    // a folder that the user names has to exist
    let named = ["building", "b.toml", "--floor-fmu", "floor.fmu", "-o", "none/b.ssp"];
    refused(&folder, &named, &["none/b.ssp"]);
}
