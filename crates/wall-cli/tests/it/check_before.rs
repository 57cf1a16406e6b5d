//! `wall check` of a state before and after an intervention, and in Italian.

use crate::command_line::{assert_has, content, fails, folder, json, succeed, text};

const WALL: &str = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n";
const TIE: &str = "[tie]\ntie_stiffness = 2e6\ntie_height = 3\ntie_strength = 5e3\ntie_ultimate = 0.2\n";
const CHECK: &str = "code = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
                     SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n";

/// Both states stand side by side; the one before may leave its table `check` out.
#[test]
fn before_and_after() {
    let folder = folder("check_before");
    let after = format!("{WALL}{TIE}[check]\nbaseline = \"before.toml\"\n{CHECK}");
    std::fs::write(folder.join("after.toml"), after).unwrap();
    for table in [String::new(), format!("[check]\n{CHECK}")] {
        std::fs::write(folder.join("before.toml"), format!("title = \"old\"\n{WALL}{table}")).unwrap();
        let value = json(&folder, &["check", "after.toml", "--json"]);
        let before = &value["before"];
        assert_eq!((&before["title"], &before["passed"]), (&"old".into(), &false.into()));
        // docs of the library: the wall without a tie
        assert!((before["checks"][1]["zeta"].as_f64().unwrap() - 0.855_812).abs() < 5e-7, "{before}");
    }
    let printed = text(&succeed(&folder, &["check", "after.toml"]).stdout);
    assert_has(&printed, &["Before (old): NOT PASSED: SLV governs with zeta_E = 0.856", "difference"]);
    fails(&folder, &["check", "after.toml", "--set", "check.baseline=none.toml"], &["none.toml"]);
}

/// The files of the baseline are inputs: none of them is overwritten.
#[test]
fn the_baseline_is_not_overwritten() {
    let folder = folder("check_before_kept");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let baseline = "[check]\nbaseline = \"before.toml\"\n";
    write("after.toml", &format!("{WALL}{TIE}{baseline}{CHECK}"));
    write("before.toml", WALL);
    fails(&folder, &["check", "after.toml", "--csv", "before.toml"], &["before.toml"]);
    let set = "check.baseline=before.svg";
    write("before.svg", WALL);
    let find = ["check", "after.toml", "--set", set, "--find", "thickness", "--plot", "before.svg"];
    fails(&folder, &find, &["before.svg"]);
    assert_eq!([content(&folder, "before.toml"), content(&folder, "before.svg")], [WALL, WALL]);
    let row = "name,height,thickness,density\nlow,4,0.4,1800\n";
    write("after.toml", &format!("walls = [{{ table = \"after.csv\" }}]\n{baseline}{CHECK}"));
    write("after.csv", row);
    write("before.toml", "walls = [{ table = \"before.csv\" }]\n");
    write("before.csv", row);
    fails(&folder, &["check", "after.toml", "--csv", "before.csv"], &["before.csv"]);
    assert_eq!(content(&folder, "before.csv"), row);
}

/// Each wall of a file stands beside the wall of its name in the file of the state before.
#[test]
fn before_and_after_of_many_walls() {
    let folder = folder("check_before_walls");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let table = "walls = [{ table = \"walls.csv\" }]\n[check]\nbaseline = \"before.toml\"\n";
    write("walls.toml", &(table.to_owned() + CHECK));
    write("walls.csv", "name,height,thickness,density\nlow,4,0.6,1800\ntall,5,0.6,1800\n");
    let wall = |name: &str, height| {
        let geometry = format!("{{ height = {height}, thickness = 0.4, density = 1800 }}");
        format!("[[walls]]\nname = {name:?}\ngeometry = {geometry}\n")
    };
    let arguments = ["check", "walls.toml", "--csv", "out.csv", "--report", "out.html"];
    for check in [String::new(), format!("[check]\n{CHECK}")] {
        write("before.toml", &(wall("tall", 5) + &wall("low", 4) + &check));
        let value = json(&folder, &["check", "walls.toml", "--json"]);
        let low = value.as_array().unwrap().iter().find(|wall| wall["name"] == "low").unwrap();
        // docs of the library: this wall 0.4 m thick
        let before = low["verdict"]["before"]["checks"][1]["zeta"].as_f64().unwrap();
        assert!((before - 0.855_812).abs() < 5e-7, "{low}");
        assert_has(&text(&succeed(&folder, &arguments).stdout), &["before", "0.8558"]);
        assert!(content(&folder, "out.csv").starts_with("name,passed,zeta_E,zeta_E_before,"));
        assert_eq!(content(&folder, "out.html").matches(">Before and after<").count(), 2);
    }
    // a row may name its scene, over which its own cells count
    write("before.csv", "name,scene,height,hinge_levels\nlow,one.toml,,\ntall,one.toml,5,\"[0, 2]\"\n");
    write("one.toml", WALL);
    write("before.toml", "walls = [{ table = \"before.csv\" }]\n");
    let value = json(&folder, &["check", "walls.toml", "--json"]);
    let zeta = |name: &str| {
        let wall = value.as_array().unwrap().iter().find(|wall| wall["name"] == name).unwrap();
        wall["verdict"]["before"]["checks"][1]["zeta"].as_f64().unwrap()
    };
    assert!((zeta("low") - 0.855_812).abs() < 5e-7 && zeta("tall") < zeta("low"));
    write("before.csv", "name,scene\nlow,none.toml\n");
    fails(&folder, &["check", "walls.toml"], &["before.csv, line 2: scene: ", "none.toml"]);
    write("before.toml", &wall("low", 4));
    fails(&folder, &["check", "walls.toml"], &["before.toml", "wall \"tall\" is missing"]);
    write("before.toml", WALL);
    fails(&folder, &["check", "walls.toml"], &["before.toml", "a baseline of walls is a file of walls"]);
}

/// Italian is for terminal, CSV and pages.
#[test]
fn what_is_printed_is_italian() {
    let folder = folder("check_italian");
    std::fs::write(folder.join("scene.toml"), format!("{WALL}{TIE}[check]\n{CHECK}")).unwrap();
    let arguments = ["check", "scene.toml", "--lang", "it", "--csv", "out.csv", "--target", "0.5"];
    let output = succeed(&folder, &arguments);
    assert_has(&text(&output.stdout), &["SODDISFATTA per ζ_E ≥ 0,50", "grandezza", "scritto  out.csv"]);
    assert_has(&text(&output.stderr), &["avvertenza: "]);
    let csv = content(&folder, "out.csv");
    assert!(csv.starts_with("verifica;verso;zeta_E;soddisfatta;"), "{csv}");
    assert!(csv.lines().all(|line| !line.contains("0.")) && csv.contains(";0,15;"), "{csv}");
    let walls = "walls = [{ table = \"walls.csv\" }]\n[check]\n".to_owned() + CHECK;
    std::fs::write(folder.join("walls.toml"), walls).unwrap();
    std::fs::write(folder.join("walls.csv"), "name,height,thickness,density\nalta,6,0.4,1800\n").unwrap();
    let arguments = ["check", "walls.toml", "--lang", "it", "--csv", "out.csv", "--html", "out.html"];
    assert_has(&text(&succeed(&folder, &arguments).stdout), &["parete", "determinante"]);
    assert_has(
        &content(&folder, "out.csv"),
        &["parete;soddisfatta;zeta_E;determinante;verso;", "\nalta;no;0,"],
    );
    assert_has(
        &content(&folder, "out.html"),
        &["<html lang=\"it\"", "pareti che soddisfano la verifica: 0 su 1"],
    );
    let found =
        text(&succeed(&folder, &["check", "scene.toml", "--lang", "it", "--find", "thickness"]).stdout);
    assert_has(&found, &["spessore, valore minimo che soddisfa la verifica: 0,"]);
}
