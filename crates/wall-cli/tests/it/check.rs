//! `wall check` and `wall study tie`.

use std::f64::consts::TAU;
use std::path::Path;

use ground_motion::{Spectrum, SyntheticMotion};
use scene::Scene;

use crate::command_line::{
    assert_has, content, fails, folder, json, printed, refused, setting, succeed, text, wall,
};

/// Writes a scene that is checked by the code `fractions`, with more keys of `[check]`.
fn of_fractions(folder: &Path, more: &str) {
    std::fs::write(folder.join("scene.toml"), format!("[check]\ncode = \"fractions\"\n{more}\n")).unwrap();
}

/// The hand calculations of docs/model.md, to the last printed digit.
#[test]
fn a_check_is_that_by_hand() {
    let folder = folder("check_by_hand");
    std::fs::write(folder.join("spectrum.csv"), "T,Sa\n0,2\n0.1,5\n0.5,5\n1,2.5\n2,1.25\n4,0.3\n").unwrap();
    of_fractions(&folder, "spectrum = \"spectrum.csv\"\nunit = \"m/s2\"");
    let strip = "mechanism=vertical_spanning height=3 thickness=0.25 overburden=10000";
    let tied = "tie_height=3 tie_stiffness=2e5 tie_slack=0.03 tie_strength=5000";
    let document = std::fs::read_to_string(crate::root().join("docs/model.md")).unwrap();
    let rows: Vec<Vec<&str>> = document
        .lines()
        .skip_while(|line| !line.starts_with("| `wall check` prints"))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 10);
    for (column, set) in ["", strip, tied].into_iter().enumerate() {
        let text = printed(&folder, &setting("check scene.toml", set));
        for row in &rows {
            let line = text.lines().find(|line| line.starts_with(row[0])).unwrap();
            let value = line[row[0].len()..].split_whitespace().nth(1).unwrap();
            assert_eq!(value, row[2 + column], "{}: {text}", row[0]);
        }
    }
    let value = json(&folder, &["check", "scene.toml", "--json", "--report", "report.html"]);
    assert_eq!((&value["code"], &value["secant_fraction"]), (&"fractions".into(), &0.4.into()));
    assert_eq!(value["passed"], true);
    let page = content(&folder, "report.html");
    assert_has(&page, &["<svg", "PASSED: displacement governs with ratio = 1.050", "the wall rocks"]);
}

#[test]
fn a_spectrum_states_its_unit() {
    let folder = folder("check_unit");
    let write = |header: &str| {
        std::fs::write(folder.join("s.csv"), format!("{header}\n0,0.2\n0.5,0.5\n4,0.03\n")).unwrap();
    };
    let with = |more: &str| {
        of_fractions(&folder, &format!("spectrum = \"s.csv\"\n{more}"));
        ["check", "scene.toml"]
    };
    for header in ["T [s],Sa [g]", "T,Sa (g)", "\"T\",\"Sa [g]\""] {
        write(header);
        // 0.2 g
        assert!(printed(&folder, &with("")).contains("1.961"), "{header}");
        refused(&folder, &with("unit = \"m/s2\""), &["line 1", "g", "leave out"]);
    }
    write("T,Sa (5 %)");
    refused(&folder, &with(""), &["s.csv, line 1", "a unit of acceleration"]);
    assert!(printed(&folder, &with("unit = \"m/s2\"")).contains(" 0.2000"));
    // the column that is read is said
    let rows = "T [s],Sa 2% [g],Sa 5% [g]\n0,0.3,0.2\n0.5,0.6,0.5\n4,0.04,0.03\n";
    std::fs::write(folder.join("s.csv"), rows).unwrap();
    refused(&folder, &with(""), &["s.csv, line 1", "one column beside T"]);
    let text = printed(&folder, &with("column = \"Sa 5%\""));
    assert_has(&text, &["s.csv, column Sa 5% [g], Sa in g", "1.961"]);
    // and so is its damping
    assert_has(&printed(&folder, &with("column = \"Sa 2%\"")), &["2 % damping"]);
    let words = ["scene.toml, line 5", "s.csv: expected the damping ratio", "0.02, found damping 0.05"];
    refused(&folder, &with("column = \"Sa 2%\"\ndamping = 0.05"), &words);
}

#[test]
fn a_check_refuses_what_it_cannot_use() {
    let folder = folder("check_refuses");
    let refuses = |spectrum: &str, words: &[&str]| {
        std::fs::write(folder.join("spectrum.csv"), spectrum).unwrap();
        of_fractions(&folder, "spectrum = \"spectrum.csv\"\nunit = \"g\"");
        refused(&folder, &["check", "scene.toml"], words);
    };
    refuses("T,Sa\n0.1,1\n2,0.5\n", &["scene.toml, line 3", "T from 0 on", "T = 0.1 s"]);
    let rise = "expected T from 0 on that rises, and Sa above 0; found T = 0.5 s and Sa = ";
    refuses("0,1\n1,0.5\n0.5,0.3\n", &[rise]);
    refuses("0,1\n1,-0.5\n", &["found T = 1 s and Sa = -4.9", "line 2"]);
    refuses("0,1\n1,0.5\n", &["has no T = 1.4"]);
    refuses("0,1.0\n1\n", &["line 2: expected one value for each column, 2 in all"]);
    for (more, words) in [
        ("", "the demand is spectrum"),
        ("spectrum = [[0, 1], [4, 1]]", "unit is missing"),
        ("spectrum = [[0, 1], [4, 1]]\nunit = \"g\"\nsecant_fraction = 2", "above 0 and at most 1"),
        ("records = { synthetic = { count = 1 } }\nunit = \"g\"", "records.unit"),
        ("spectrum = \"s.csv\"\nrecords = { synthetic = { count = 1 } }", "give one of both"),
    ] {
        of_fractions(&folder, more);
        refused(&folder, &["check", "scene.toml"], &["scene.toml, line", words]);
    }
    refused(&folder, &["check"], &["there is no file", "[check]", "code = \"circolare-2019\""]);
}

#[test]
fn a_check_reads_the_records_of_a_folder() {
    let folder = folder("check_folder");
    std::fs::create_dir(folder.join("records")).unwrap();
    succeed(&folder, &["record", "--synthetic", "--samples", "records/a.csv"]);
    let record = content(&folder, "records/a.csv");
    std::fs::write(folder.join("records/b.csv"), &record).unwrap();
    let vertical = record.replace("time (a_g in m/s2),a_g", "time [s],UP [m/s2]");
    std::fs::write(folder.join("records/c.csv"), vertical).unwrap();
    of_fractions(&folder, "records = { files = [\"records\"] }");
    let output = succeed(&folder, &["check", "scene.toml", "--json"]);
    assert_has(&text(&output.stderr), &["records/c.csv: vertical, left out"]);
    assert_has(&text(&output.stdout), &["\"median of 2 records\""]);
    let over = ["check", "scene.toml", "--report", "records/a.csv"];
    refused(&folder, &over, &["the input records/a.csv"]);
    refused(&folder, &["check", "scene.toml", "--csv", "scene.toml"], &["the input scene.toml"]);
}

/// On storeys the demand is the floor's: its peak, and S_d of its spectrum.
#[test]
fn a_check_on_storeys_takes_the_spectrum_of_the_floor() {
    let folder = folder("check_storeys");
    let scene = std::fs::read_to_string(crate::root().join("scenes/parapet_on_a_roof.toml")).unwrap();
    let with = |table: &str| {
        let text = format!("{scene}\n[check]\ncode = \"fractions\"\n{table}\n");
        std::fs::write(folder.join("roof.toml"), text).unwrap();
    };
    let ground = SyntheticMotion::default().motion().unwrap();
    with("records = { synthetic = { count = 1 } }");
    let value = json(&folder, &["check", "roof.toml", "--json"]);
    assert_eq!(value["demand"], "median of 1 record felt on 3 storeys, T = 0.510, 0.211, 0.144 s");
    let side = &value["sides"][0];
    let number = |name: &str| side[name].as_f64().unwrap();
    let storeys = Scene::read(&folder.join("roof.toml")).unwrap().floors.unwrap().storeys().clone();
    let roof = storeys.floor(&ground, ground.duration() + 10.0, 3).unwrap().acceleration;
    let period = number("secant_period");
    let demand = Spectrum::default().acceleration(&roof, period).unwrap() * (period / TAU).powi(2);
    for (name, expected) in [("peak_acceleration", roof.peak()), ("displacement_demand", demand)] {
        assert!((number(name) / expected - 1.0).abs() < 1e-9, "{name}: {side} for {expected}");
    }
    assert!(roof.peak() > 1.5 * ground.peak());
    with("spectrum = [[0, 2], [4, 0.3]]\nunit = \"m/s2\"");
    let output = wall(&folder, &["check", "roof.toml"]);
    assert!(text(&output.stderr).contains("storeys are not applied to the spectrum"));
}

/// What every code has works for the second one, too: rows, a search, and many walls.
#[test]
fn the_second_code_finds_and_lists_walls() {
    let folder = folder("check_fractions");
    let table = "spectrum = [[0, 2], [0.1, 5], [0.5, 5], [1, 2.5], [2, 1.25], [4, 0.6]]\nunit = \"m/s2\"";
    of_fractions(&folder, table);
    let found = json(&folder, &["check", "scene.toml", "--find", "thickness", "--json", "--plot", "f.svg"]);
    let value = found["value"].as_f64().unwrap();
    assert!(value > 0.1 && content(&folder, "f.svg").contains("thickness"));
    for (factor, passes) in [(1.0, true), (1.0 - 1e-6, false)] {
        let set = format!("thickness={}", value * factor);
        assert_eq!(json(&folder, &["check", "scene.toml", "--json", "--set", &set])["passed"], passes);
    }
    succeed(&folder, &["check", "scene.toml", "--csv", "rows.csv"]);
    let rows = content(&folder, "rows.csv");
    assert!(
        rows.starts_with("check,side,ratio,passed,capacity,demand,unit,decides,clause,remark\n"),
        "{rows}"
    );
    let walls = "[[walls]]\nname = \"thin\"\ngeometry = { thickness = 0.1 }\n\
                 [[walls]]\nname = \"thick\"\ngeometry = { thickness = 0.8 }\n";
    let text = format!("{walls}[check]\ncode = \"fractions\"\n{table}\n");
    std::fs::write(folder.join("walls.toml"), text).unwrap();
    let arguments = ["check", "walls.toml", "--csv", "walls.csv", "--html", "walls.html"];
    assert_has(&printed(&folder, &arguments), &["thin", "thick", "displacement"]);
    let rows = content(&folder, "walls.csv");
    assert!(rows.starts_with("name,passed,ratio,governs,side,ratio_onset,ratio_displacement,"), "{rows}");
    assert!(rows.lines().nth(1).unwrap().starts_with("thin,false,"), "{rows}");
    assert!(content(&folder, "walls.html").contains("1 of 2 walls pass"));
}

/// A stiffer tie takes more force and lets the wall move less; without one it is the wall alone.
#[test]
fn ties_of_several_stiffnesses() {
    let (folder, scene) = (folder("ties"), crate::root().join("scenes/shaken_parapet.toml"));
    let scene = scene.to_str().unwrap();
    let stiffness = ["--stiffness", "1e7,0,1e5", "--set", "tie_height=3", "--set", "tie_side=both"];
    let value = json(&folder, &[&["study", "tie", scene, "--json"], &stiffness[..]].concat());
    let column = |name: &str| -> Vec<f64> {
        value["rows"].as_array().unwrap().iter().map(|row| row[name].as_f64().unwrap()).collect()
    };
    assert_eq!(column("stiffness_n_m"), [0.0, 1e5, 1e7]);
    let (force, u) = (column("force_max_n"), column("u_ratio_max"));
    assert!(force[0] == 0.0 && force[1] > 0.0 && force[2] > 0.0, "{force:?}");
    assert!(u[0] > u[1] && u[1] > u[2], "{u:?}");
    refused(&folder, &["study", "tie", scene], &["tie_height"]);
}

/// At the level of a limit state the records have the peak a_g S of the check, and the wall has its tie.
#[test]
fn ties_at_the_level_of_a_check() {
    let folder = folder("ties_at_level");
    let scene = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\nwidth = 2\n[force_law]\na1 = 0.05\n\
        [tie]\ntie_height = 3\ntie_side = \"both\"\n\
        [check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\n\
        SLV = { ag = 0.3, F0 = 2.45, TC = 0.32 }\n\
        tie.bar = { diameter = 0.01, length = 4, yield_stress = 200e6, ultimate_strain = 0.02, \
        spacing = 1 }\nrecords = { synthetic = { count = 3, duration = 10, step = 0.02 } }\n";
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    let study = ["study", "tie", "scene.toml", "--strength", "1e4,4e4", "--both-polarities"];
    let at = |more: &[&str]| json(&folder, &[&study[..], &["--level", "SLV", "--json"], more].concat());
    let found = at(&[]);
    assert_eq!((&found["level"], found["motions"].as_u64()), (&"SLV".into(), Some(3)), "{found}");
    let row = &found["rows"][1];
    let [n, of_metre] = ["force_84_n", "force_84_n_m"].map(|name| row[name].as_f64().unwrap());
    // the wall is 2 m wide
    assert!(n > 0.0 && (n / of_metre / 2.0 - 1.0).abs() < 1e-12, "{row}");
    // records that are given take the place of those of the check: S = 1.4 − 0.4 F0 a_g = 1.106 of soil B
    let names = [("1.csv", 0.5), ("2.csv", 2.0), ("3.csv", 4.0)];
    for (name, peak) in names {
        let row = |k: i32| format!("{},{}\n", 0.02 * f64::from(k), if k == 100 { peak } else { 0.0 });
        let rows: String = (0..500).map(row).collect();
        std::fs::write(folder.join(name), format!("time [s],acc [m/s2]\n{rows}")).unwrap();
    }
    let given = ["--records", "1.csv", "2.csv", "3.csv"];
    let found = at(&given);
    for (factor, (_, peak)) in found["factors"].as_array().unwrap().iter().zip(names) {
        assert!((factor.as_f64().unwrap() * peak / (0.3 * 9.81 * 1.106) - 1.0).abs() < 1e-12, "{factor}");
    }
    let table = printed(&folder, &[&study[..], &["--level", "SLV"]].concat());
    assert_has(&table, &["3 motions at SLV (factors", "N 84 %", "[kN/m]", "N_y [kN]"]);
    let words = ["scene.toml, line", "SLC is not stated; give its ag, F0 and TC"];
    refused(&folder, &[&study[..], &["--level", "SLC"]].concat(), &words);
    std::fs::write(folder.join("bare.toml"), scene.split("records").next().unwrap()).unwrap();
    let bare = ["study", "tie", "bare.toml", "--strength", "1e4", "--level", "SLV"];
    refused(&folder, &bare, &["there are no records; give --records, or [check.records]"]);
    let limit_states = ["'slv'", "SLD, SLV, SLC"];
    fails(&folder, &[&study[..], &["--level", "slv"]].concat(), &limit_states);
    // what the dynamic check says of the factors is said here, too: 3.25/0.5 is not usual
    let told = succeed(&folder, &[&study[..], &["--level", "SLV"], &given].concat());
    assert_has(&text(&told.stderr), &["SLV: a record is scaled by 6.510; 0.25 to 4 is usual"]);
    // both signs, as the check has them
    let signs = ["study", "tie", "scene.toml", "--strength", "1e4", "--level", "SLV", "--json"];
    let motions = |more: &str| {
        std::fs::write(folder.join("scene.toml"), scene.replace("\"both\"", "\"positive\"") + more).unwrap();
        json(&folder, &signs)["motions"].as_u64()
    };
    assert_eq!([motions(""), motions("polarities = \"as_recorded\"\n")], [Some(6), Some(3)]);
    // records move the ground, and nothing says how the building moves
    let building = "building = { storeys = 3, period = 0.3, height_ratio = 1 }\n";
    let high = scene.replace("0.32 }", "0.32, building_damping = 0.1 }") + building;
    std::fs::write(folder.join("scene.toml"), high).unwrap();
    refused(&folder, &signs, &["scene.toml, line 18", "give [[storeys]] in place of [check.building]"]);
    let fractions = scene.split("[check]").next().unwrap().to_owned()
        + "[check]\ncode = \"fractions\"\nspectrum = [[0, 1], [4, 1]]\nunit = \"m/s2\"\n";
    std::fs::write(folder.join("scene.toml"), fractions).unwrap();
    refused(
        &folder,
        &signs,
        &["no limit states with runs; use code = \"circolare-2019\", or scale the records"],
    );
}

/// The tied parapet on the roof, example (c) of the check by Circolare 7/2019.
const TIED: &str = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n[force_law]\na1 = 0.03\n\
    [tie]\ntie_stiffness = 200e3\ntie_height = 3\ntie_slack = 0.03\ntie_strength = 5e3\n\
    [check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\n\
    building = { storeys = 3, period = 0.3, height_ratio = 1 }\n\
    SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n";

/// JSON has the keys that programs rely on, the table the same numbers, and `--set` another wall.
#[test]
fn a_check_by_the_code() {
    let folder = folder("check_code");
    std::fs::write(folder.join("scene.toml"), TIED).unwrap();
    let check = |more: &[&str]| json(&folder, &[&["check", "scene.toml", "--json"], more].concat());
    let value = check(&[]);
    assert_eq!((&value["code"], &value["passed"]), (&"circolare-2019".into(), &false.into()));
    assert_eq!(value["governs"]["side"], "positive");
    assert_eq!(value["governs"]["limit_state"], "SLV");
    let side = &value["sides"]["positive"];
    for (found, expected) in [
        (&value["governs"]["zeta_E"], 0.727_534),
        (&side["alpha0"], 0.1),
        (&side["e_star"], 1.0),
        (&side["M_star"], 2880.0),
        (&side["a0"], 0.981),
        (&side["d0"], 0.2),
        (&side["T0"], 0.498_925),
        (&side["SLV_q"]["ratio"], 0.184_604),
        (&side["SLV"]["d"], 0.036_666_7),
        (&side["SLV"]["a"], 2.522_46),
        (&side["SLV"]["T"], 0.636_331),
        (&side["SLV"]["demand"], 0.050_398_5),
        (&side["SLV"]["ratio"], 0.727_534),
        (&side["SLV"]["ag"], 0.109_13),
    ] {
        // six digits are printed
        assert!((found.as_f64().unwrap() / expected - 1.0).abs() < 1e-5, "{found} for {expected}");
    }
    assert_eq!(side["SLV"]["limited_by_tie"], true);
    assert_eq!(value["sides"]["negative"]["SLV"]["limited_by_tie"], false);
    let table = printed(&folder, &["check", "scene.toml"]);
    let words = ["NOT PASSED: SLV governs with zeta_E = 0.728 (u > 0)", "u > 0: the tie breaks at d_SLV"];
    assert_has(&table, &words);
    assert_eq!(check(&["--set", "thickness=1.2"])["passed"], true);
    let one_side = printed(&folder, &["check", "scene.toml", "--set", "tie_stiffness=0"]);
    assert_has(&one_side, &["(both sides alike)"]);
    succeed(&folder, &["check", "scene.toml", "--csv", "rows.csv"]);
    let rows = content(&folder, "rows.csv");
    let heads = "check,side,zeta_E,passed,ag_g,site_ag_g,capacity,demand,unit,decides,clause,remark\n";
    assert!(rows.starts_with(heads) && rows.lines().count() == 5, "{rows}");
}

/// The wall that is found passes, and one a millionth thinner does not.
#[test]
fn the_smallest_wall_that_passes_is_found() {
    let folder = folder("check_find");
    std::fs::write(folder.join("scene.toml"), TIED).unwrap();
    let arguments = ["check", "scene.toml", "--set", "tie_stiffness=0"];
    for (sought, smaller) in [("thickness", 1.0 - 1e-6), ("height", 1.0 + 1e-6)] {
        let find = ["--find", sought, "--json", "--plot", "find.svg"];
        let found = json(&folder, &[&arguments[..], &find].concat());
        let value = found["value"].as_f64().unwrap();
        for (factor, passes) in [(1.0, true), (smaller, false)] {
            let set = format!("{sought}={}", value * factor);
            let verdict = json(&folder, &[&arguments[..], &["--set", &set, "--json"]].concat());
            assert_eq!(verdict["passed"], passes, "{sought} = {set}");
        }
        let checks = found["checks"].as_array().unwrap();
        let names: Vec<_> = checks.iter().map(|check| check["check"].as_str().unwrap()).collect();
        assert_eq!(names, ["SLV with q", "SLV"]);
        assert_eq!(checks[1]["curve"].as_array().unwrap().len(), 241);
        let chart = content(&folder, "find.svg");
        assert!(chart.contains(">ζ<tspan") && chart.contains(&format!("{sought} (")), "{sought}");
    }
    let words = ["tie_strength is sought, but the wall has no such tie"];
    refused(&folder, &[&arguments[..], &["--find", "tie_strength"]].concat(), &words);
    fails(&folder, &[&arguments[..], &["--find", "width"]].concat(), &["expected thickness, height"]);
}

/// One row a wall, the worst first; a wall that cannot be checked stands above them with the reason.
#[test]
fn many_walls_are_checked() {
    let folder = folder("check_walls");
    let walls = "name;height;thickness;density;overburden\nlow;1;0,4;1800;0\n\"tall, thin\";6;0,4;1800;0\n\
         loaded;3;0,4;1800;5000\n;;;;\n";
    std::fs::write(folder.join("walls.csv"), walls).unwrap();
    let table = TIED.split("[check]").nth(1).unwrap();
    let study = format!("walls = [{{ table = \"walls.csv\" }}]\n[check]{table}");
    std::fs::write(folder.join("walls.toml"), study.replace("law", "rigid")).unwrap();
    let arguments = ["check", "walls.toml", "--csv", "out.csv", "--html", "out.html"];
    fails(&folder, &arguments, &["1 of 3 walls could not be checked"]);
    let rows = content(&folder, "out.csv");
    let rows: Vec<&str> = rows.lines().collect();
    assert!(rows[1].starts_with("loaded,") && rows[1].contains("overburden_mass is missing"), "{rows:?}");
    assert!(rows[2].starts_with("\"tall, thin\",false,") && rows[3].starts_with("low,true,"), "{rows:?}");
    let page = content(&folder, "out.html");
    assert!(page.contains("1 of 3 walls pass") && page.contains("tall, thin"));
    // warnings come by wall, its name first
    let centimetres = "name,height,thickness,density\na,90,9,1800\nb,2,0.3,1800\nc,80,0.4,1800\n";
    std::fs::write(folder.join("walls.csv"), centimetres).unwrap();
    let warned = text(&succeed(&folder, &["check", "walls.toml"]).stderr);
    let lines: Vec<&str> = warned.lines().collect();
    // b fails without a raise by SLD
    assert_eq!(lines.len(), 3, "{warned}");
    let of =
        |name: &str| lines.iter().find(|line| line.starts_with(&format!("wall: warning: wall {name:?}: ")));
    let thick = "thickness = 9 m is unusual: 0.03 to 3 m is usual; if it is in cm, give 0.09 m";
    let tall = "height = 90 m is unusual: 0.2 to 30 m is usual; if it is in cm, give 0.9 m";
    assert_has(of("a").unwrap(), &[tall, thick]);
    assert_has(of("c").unwrap(), &["height = 80 m is unusual"]);
    std::fs::write(folder.join("walls.csv"), "name,height\na,1\nb,0.9\n").unwrap();
    let warned = text(&wall(&folder, &["check", "walls.toml"]).stderr);
    assert_has(&warned, &["walls.toml: 2 of 2 walls have no thickness; the default of"]);
    std::fs::write(folder.join("none.toml"), "walls = [{ table = \"walls.csv\" }]\n").unwrap();
    refused(&folder, &["check", "none.toml"], &["none.toml", "the table [check] is missing"]);
    // a study is a file of walls with more keys
    let study = "models = [\"CR\"]\ncollapse_is = \"falls\"\nwalls = [{ table = \"walls.csv\" }]\n";
    for (key, words) in [("", "the table [check] is missing"), ("recrods = 1\n", "did you mean \"records\"?")]
    {
        std::fs::write(folder.join("study.toml"), format!("{key}{study}")).unwrap();
        refused(&folder, &["check", "study.toml"], &["study.toml", words]);
    }
    refused(&folder, &["check", "walls.toml", "--find", "height"], &["takes one wall"]);
}
