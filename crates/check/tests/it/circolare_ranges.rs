//! Values outside the ranges of the code, sizes that cannot be, and the ground of a building.

use check::{CheckFile, Language, Sought, find, read};
use scene::Scene;

use crate::circolare::{PARAPET, checked, refuses, warns};
use crate::circolare_hinges::{facade, positive};

const SLV: &str = "ag = 0.15, F0 = 2.45, TC = 0.32";

/// The parapet with more in the table and in SLV.
fn wall(more: &str, of_slv: &str) -> String {
    format!(
        "{PARAPET}[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n{more}\n\
         SLV = {{ {SLV}{of_slv} }}\n"
    )
}

#[test]
fn what_is_outside_the_code_is_said() {
    let high = "building = { storeys = 3, period = 0.3, height_ratio = 0.5 }";
    warns(&wall("", ", damping = 0.05"), "SLV: the mechanism has ξ = 5 %; C8.7.1.2.1.8 has 8 %");
    warns(&wall(high, ", building_damping = 0.3"), "ξ_k = 30 % of the building is outside 5 to 20 %");
    let strong = facade("tie_stiffness = 5e6\ntie_strength = 50e3\ntie_ultimate = 0.1", "");
    // W + O = 7 · 0.5 · 1900 · 9.81 + 12000 N
    warns(&strong, "the tie has 0.647 of W + O: a large force for an anchor");
    let quiet = checked(&wall(high, ", building_damping = 0.1")).unwrap().warnings;
    assert!(!quiet.iter().any(|warning| warning.contains('%')), "{quiet:?}");
}

/// A grid of a node, in its unit.
fn on_grid(ags: [f64; 2], more: &str, of_slv: &str) -> String {
    let grid = format!(
        "lon,lat,ag_30,F0_30,TC_30,ag_475,F0_475,TC_475\\n13.4,42.3,{},2.5,0.3,{},2.6,0.32\\n",
        ags[0], ags[1]
    );
    format!(
        "{PARAPET}[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n{more}\n\
         site = {{ grid = \"{grid}\", coordinates = [42.3, 13.4], nominal_life = 50, use_coefficient = 1 }}\n\
         SLD = {{}}\nSLV = {{ {of_slv} }}\n"
    )
}

#[test]
fn the_hazard_of_the_site_is_held_against_what_is_stated() {
    let of_site = |text: &str| {
        let scene = Scene::parse("scene.toml", text, ".".as_ref()).unwrap();
        let code = read(&CheckFile::parse("scene.toml", text).unwrap()).unwrap();
        code.check((&scene).into()).unwrap();
        let warnings = &code.records().warnings;
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let other = of_site(&on_grid([0.05, 0.2], "", SLV));
    assert!(other.contains("SLV: a_g = 0.15 g is stated; for T_R = 474.6 years of V_N and C_U the grid has"));
    assert!(of_site(&on_grid([0.05, 0.2], "", "")).is_empty());
    // Sardinia has 0.0186 and 0.0500 g; a table in g/10 is read as one in g
    assert!(of_site(&on_grid([0.186, 0.5], "", "")).contains("if it is in g/10 or m/s2, give 0.05 g"));
    // 0.033 g, too, where 475 years alone are those of an active zone
    assert!(of_site(&on_grid([0.13, 0.33], "", "")).contains("T_R = 30 years = 0.13 g is unusual"));
    let class = on_grid([0.05, 0.2], "use_class = \"III\"", "");
    warns(&class, "C_U = 1 is not that of class III, 1.5 (NTC Tab. 2.4.II)");
}

#[test]
fn impossible_sizes_are_refused() {
    let thick = wall("", "").replace("thickness = 0.4", "thickness = 42");
    let error = refuses(&thick, "thickness = 42 m is impossible: a check takes 10 m at most");
    assert!(error.contains("if it is in cm, give 0.42 m"), "{error}");
    let bar = "tie.bar = { diameter = 16, length = 6, yield_stress = 235e6 }";
    refuses(
        &facade("", bar),
        "bar_diameter = 16 m is impossible: a check takes 0.2 m at most; if it is in mm",
    );
}

/// At z/H = 0 of a building of storeys a wall has the demand of the ground.
#[test]
fn height_ratio_zero_is_the_ground() {
    let low = "building = { storeys = 3, period = 0.3, height_ratio = 0 }";
    let [stated, bare] = [low, ""].map(|building| checked(&wall(building, "")).unwrap());
    let demand = |outcome| positive(outcome).checks.slv.unwrap().demand.to_bits();
    assert_eq!(demand(&stated), demand(&bare));
    assert_eq!(stated.warnings, bare.warnings);
}

/// FC divides gravity in the runs; nobody stated that number.
#[test]
fn the_wall_of_the_runs_is_not_improbable() {
    let text =
        wall("method = \"dynamic\"\nrecords = { synthetic = { count = 3, duration = 10, step = 0.02 } }", "");
    let damped = "[force_law]\nforce_law = \"rigid_linear\"\n[damping]\ndamping_model = \"constant_ratio\"";
    let error = refuses(&text.replace("[check]", &format!("{damped}\n[check]")), "does not go with");
    assert!(!error.contains("gravity"), "{error}");
}

/// The bound of a search says by what it holds.
#[test]
fn a_search_says_what_rests_on_the_raise() {
    let tie = "tie_stiffness = 5e6\ntie_strength = 10e3";
    let text = facade(tie, "rocking = \"one_sided_positive\"\ntie.at_activation = \"yield\"");
    let text: String =
        text.lines().filter(|line| !line.starts_with("SLC")).map(|l| l.to_owned() + "\n").collect();
    let scene = Scene::parse("scene.toml", &text, ".".as_ref()).unwrap();
    let code = read(&CheckFile::parse("scene.toml", &text).unwrap()).unwrap();
    let found = find(&*code, (&scene).into(), Sought::TieStrength).unwrap();
    // example 15: by the raise from 18988.6 N, by displacement from 20767.2 N
    for said in [
        "smallest tie_strength that passes: 18988.6",
        " N, by the raise of SLD; by displacement 20767.",
        "SLV: from 18988.6 N, by the raise of SLD; by displacement from 20767.2 N",
        "raised to 1.000 by SLD",
    ] {
        assert!(found.text(Language::En).contains(said), "{}", found.text(Language::En));
    }
    let json = found.json();
    assert!((json["value_without_raise"].as_f64().unwrap() - 20767.2).abs() < 0.05);
    let italian = found.text(Language::It);
    assert!(italian.contains("assumendo a_g,SLD; in spostamento da 20767,2 N"), "{italian}");
}
