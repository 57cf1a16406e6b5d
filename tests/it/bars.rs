//! Tests the bar of a tie: how scenes give it, what follows from it, and what is refused.

use std::path::Path;

use rocking_wall::variables::{DampingModel, ForceLaw, Impact, TieSide};
use rocking_wall::wall::{Bar, Parameters, TiePart, Wall};
use scene::response::Response;
use scene::{Scene, to_toml};

/// A parapet of 2 m and a bar every 3 m.
const TIED: &str = "[geometry]\nheight = 3.0\nthickness = 0.4\nwidth = 2.0\n[tie]\ntie_height = 2.6\n\
                    [tie.bar]\ndiameter = 0.016\nlength = 6.0\nyield_stress = 235e6\n\
                    ultimate_strain = 0.02\nspacing = 3\n";

fn read(text: &str) -> Result<Scene, String> {
    Scene::parse("scene.toml", text, Path::new(".")).map_err(|error| error.to_string())
}

/// K, `N_y` and p_u.
fn numbers(parameters: &Parameters) -> [f64; 3] {
    [parameters.tie_stiffness, parameters.tie_strength, parameters.tie_ultimate]
}

/// E A/L and A `f_y` of one bar are 7037.168 kN/m and 47249.55 N; 2/3 of a bar holds the wall.
#[test]
fn a_bar_gives_the_tie_its_numbers() {
    let mut scene = read(TIED).unwrap();
    let area = std::f64::consts::PI * 0.008 * 0.008;
    let [stiffness, strength] = [210e9 * area / 6.0 * 2.0 / 3.0, 235e6 * area * 2.0 / 3.0];
    let ultimate = 0.12 - strength / stiffness;
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        // a dozen roundings
        let differs = |(found, wanted): (f64, f64)| (found - wanted).abs() > 3e-15 * wanted;
        assert!(!found.into_iter().zip(wanted).any(differs), "{found:?} for {wanted:?}");
    };
    near(numbers(&scene.parameters), [stiffness, strength, ultimate]);
    assert_eq!(scene.parameters.weaker_part(), Some(TiePart::Bar));

    // a wider wall has more bars
    scene.set("width", "4").unwrap();
    near(numbers(&scene.parameters), [2.0 * stiffness, 2.0 * strength, ultimate]);
    scene.set("bar_anchor_capacity", "30e3").unwrap();
    near(numbers(&scene.parameters), [2.0 * stiffness, 40e3, 0.0]);
    assert_eq!(scene.parameters.weaker_part(), Some(TiePart::Anchor));
    // an anchor that is as strong as the bar lets it yield
    scene.set("bar_anchor_capacity", &format!("{:?}", area * 235e6)).unwrap();
    assert_eq!(scene.parameters.weaker_part(), Some(TiePart::Bar));

    // a strain below that of yielding leaves nothing to stretch; none at all leaves the tie elastic
    scene.set("bar_ultimate_strain", "0.001").unwrap();
    assert_eq!(scene.parameters.tie_ultimate, 0.0);
    let elastic = read(&TIED.replace("ultimate_strain = 0.02\n", "")).unwrap();
    assert_eq!(elastic.parameters.tie_ultimate, -1.0);

    // a number that is set takes the place of the bar
    scene.set("tie_stiffness", "0").unwrap();
    scene.set("width", "2").unwrap();
    assert_eq!((scene.parameters.bar, scene.parameters.tie_stiffness), (None, 0.0));
}

#[test]
fn a_bar_can_be_set_number_by_number() {
    let mut scene = read("[geometry]\nheight = 3\n[tie]\ntie_height = 2.6\ntie_stiffness = 1e6\n").unwrap();
    scene.set("bar_diameter", "0.016").unwrap();
    scene.set("bar_length", "6").unwrap();
    assert_eq!(scene.parameters.tie_stiffness, 1e6);
    let error = Wall::new(&scene.parameters).unwrap_err();
    assert!(error.to_string().contains("the bar of the tie needs bar_yield_stress"), "{error}");
    assert_eq!(error.keys(), ["bar_yield_stress"]);
    scene.set("bar_yield_stress", "235e6").unwrap();
    let bar = Bar { diameter: 0.016, length: 6.0, yield_stress: 235e6, ..Bar::default() };
    assert_eq!(scene.parameters.bar, Some(bar));
    let tie = bar.tie(1.0).unwrap();
    assert_eq!(numbers(&scene.parameters), [tie.stiffness, tie.strength, tie.ultimate]);
    let error = scene.set("bar_length", "-6").unwrap_err().to_string();
    assert_eq!(error, "bar_length = -6 m must be above 0");
}

#[test]
fn a_written_scene_keeps_its_bar() {
    let scene = read(TIED).unwrap();
    let text = to_toml(&scene, "");
    assert!(
        text.contains("bar = { diameter = 0.016, length = 6.0, young_modulus = 210000000000.0, "),
        "{text}"
    );
    assert_eq!(read(&text).unwrap().parameters, scene.parameters);
    // a number that has been changed since counts
    let mut changed = scene.clone();
    changed.parameters.tie_strength = 3e3;
    let text = to_toml(&changed, "");
    assert!(!text.contains("bar =") && text.contains("tie_strength = 3000.0"), "{text}");
}

#[test]
fn bars_that_cannot_be_are_refused() {
    let given = |key: &str, value: &str| {
        let line = TIED.lines().find(|line| line.split(" =").next() == Some(key)).unwrap();
        TIED.replace(line, &format!("{key} = {value}"))
    };
    for (text, message) in [
        (
            TIED.replace("[tie.bar]", "tie_strength = 3e3\n[tie.bar]"),
            "line 7: tie_strength follows from [tie.bar]; leave out one of them",
        ),
        (
            TIED.replace("[tie.bar]", "tie_stiffness = 1e6\n[tie.bar]"),
            "line 7: tie_stiffness follows from [tie.bar]; leave out one of them",
        ),
        (TIED.replace("length = 6.0\n", ""), "line 7: length is missing in [tie.bar]; add it"),
        (
            TIED.replace("spacing", "spaceing"),
            "line 12: unknown key \"spaceing\" in [tie.bar] (did you mean \"spacing\"?); it holds diameter, ",
        ),
        (given("diameter", "\"16 mm\""), "line 8: diameter = \"16 mm\": expected a number"),
        (
            given("diameter", "-0.016"),
            "line 8: tie.bar.diameter = -0.016 must be above 0: Diameter of the bar [m]",
        ),
        (given("ultimate_strain", "nan"), "line 11: tie.bar.ultimate_strain = NaN must be above 0"),
        (given("spacing", "1e-15"), "line 7: of this bar tie_stiffness = 1.40743350880822"),
        ("[tie]\nbar = 16\n".to_owned(), "line 2: bar = 16: expected a table"),
        (
            "[tie]\nbar = { diameter = 0.016,\nlength = true, yield_stress = 1e8 }\n".to_owned(),
            "line 3: length = true: expected a number",
        ),
    ] {
        let error = read(&text).unwrap_err();
        assert!(error.starts_with(&format!("scene.toml, {message}")), "{error}");
    }
}

/// Each number in the unit in which people rather have it; what follows from it is not warned of again.
#[test]
fn numbers_of_a_bar_in_other_units_are_asked_back() {
    for (key, value, meant) in [
        (
            "diameter",
            "16",
            "bar_diameter = 16 m is unusual: 0.004 to 0.08 m is usual; if it is in mm, give 0.016 m",
        ),
        ("length", "6000", "if it is in mm, give 6 m"),
        ("yield_stress", "235", "bar_yield_stress = 235 Pa is unusual"),
        ("yield_stress", "235", "if it is in MPa, give 235000000 Pa"),
        ("young_modulus", "210e3", "if it is in MPa, give 2.1e11 Pa"),
        ("young_modulus", "210", "if it is in GPa, give 2.1e11 Pa"),
        ("ultimate_strain", "2", "if it is in per cent, give 0.02"),
        ("anchor_capacity", "30", "if it is in kN, give 30000 N"),
        ("spacing", "300", "if it is in cm, give 3 m"),
    ] {
        let mut scene = read(TIED).unwrap();
        scene.set(&format!("bar_{key}"), value).unwrap();
        let wall = Wall::new(&scene.parameters).unwrap();
        let warnings = wall.warnings().iter().map(ToString::to_string);
        let warnings: Vec<_> = warnings.filter(|warning| warning.contains("is unusual")).collect();
        assert!(warnings.len() == 1 && warnings[0].contains(meant), "{key}: {warnings:?}");
    }
    assert_eq!(Wall::new(&read(TIED).unwrap().parameters).unwrap().warnings(), []);
}

/// The wall of the hand example of ties, whose tie is strong enough to move the unstable equilibrium only if
/// it lasts: u₃ + 2y/h `N_y`/k₀ = 0.15 + 0.0327203 m for 200 N.
#[test]
fn facts_say_where_a_tie_pulls_yields_and_breaks() {
    let parameters = Parameters {
        height: 3.0,
        thickness: 0.3,
        density: 1800.0,
        gravity: 9.81,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        u_start: 0.0,
        tie_height: 2.6,
        tie_stiffness: 200e3,
        tie_slack: 0.02,
        tie_strength: 3e3,
        tie_ultimate: 0.05,
        tie_side: TieSide::Both,
        ..Parameters::default()
    };
    let facts = |parameters: &Parameters| {
        let facts = Wall::new(parameters).unwrap().facts();
        let value = |name| facts.iter().find(|fact| fact.name == name).map(|fact| fact.value);
        ["tie_engages", "tie_yields", "tie_breaks", "tie_equilibrium", "tie_equilibrium_negative"].map(value)
    };
    let near = |found: Option<f64>, wanted: f64| assert!((found.unwrap() - wanted).abs() < 5e-8, "{found:?}");
    let [engages, yields, breaks, ..] = facts(&parameters);
    near(engages, 0.011_538_46);
    near(yields, 0.020_192_31);
    near(breaks, 0.049_038_46);
    // it breaks before
    assert_eq!(facts(&parameters)[3..], [None; 2]);
    let weak = Parameters { tie_strength: 200.0, tie_ultimate: 0.5, ..parameters.clone() };
    let k0 = Wall::new(&weak).unwrap().body().geometric_stiffness;
    for found in &facts(&weak)[3..] {
        near(*found, 0.15 + 2.0 * 2.6 / 3.0 * 200.0 / k0);
    }
    let one = Parameters { tie_side: TieSide::Negative, ..weak.clone() };
    assert!(facts(&one)[3].is_none() && facts(&one)[4].is_some());
    // an elastic tie has no such place, and none has no facts
    assert_eq!(facts(&Parameters { tie_ultimate: -1.0, ..weak.clone() })[2..], [None; 3]);
    assert_eq!(facts(&Parameters { tie_stiffness: 0.0, ..weak }), [None; 5]);
}

/// Columns of a tie stand where there is one, and elongations where it yields.
#[test]
fn histories_have_the_columns_of_their_tie() {
    let scene = |ties: &[(&str, &str)]| {
        let mut scene = Scene { stop_time: 2.0, ..Scene::default() };
        for (name, value) in ties {
            scene.set(name, value).unwrap();
        }
        Response::of(&scene).unwrap().csv()
    };
    let elastic =
        [("tie_height", "3"), ("tie_stiffness", "1e5"), ("tie_strength", "1e3"), ("u_start", "0.1")];
    let last = |csv: &str, count: usize| -> Vec<Vec<f64>> {
        let rows = csv.lines().skip(1).map(|row| row.rsplit(',').take(count).map(|x| x.parse().unwrap()));
        rows.map(Iterator::collect).collect()
    };
    assert!(scene(&[]).lines().next().unwrap().ends_with(",a_top_m_s2"));
    assert!(scene(&elastic).lines().next().unwrap().ends_with(",a_top_m_s2,tie_force_n"));
    let csv = scene(&[&elastic[..], &[("tie_ultimate", "1")]].concat());
    assert!(csv.lines().next().unwrap().ends_with(",tie_force_n,tie_elongation_m,tie_elongation_negative_m"));
    // released at 0.1 m with a lever of 1.5: e_y = 0.01 m, p = 0.14 m from the start on
    for row in last(&csv, 2) {
        assert!(row[0] == 0.0 && (row[1] - 0.14).abs() < 1e-15, "{row:?}");
    }
}
