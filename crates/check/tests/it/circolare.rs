//! The check by Circolare 7/2019 beside worked examples, which an independent script computed from the
//! formulas of the code. Their numbers have six digits: half a unit of the last is 5e-6 of a number, and the
//! tolerance is 1e-5.
#![allow(clippy::unreadable_literal, reason = "numbers as the examples print them")]

use std::path::Path;

use check::circolare::{
    DisplacementCheck, FloorSpectrum, GroundSpectrum, Hazard, Mode, Outcome, SideVerdict, Soil, Statement,
    damping_factor,
};
use check::{CheckError, CheckFile, Subject};
use scene::Scene;

const DIGITS: f64 = 1e-5;

pub(crate) fn near(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= DIGITS * expected.abs(), "{what}: {found}, expected {expected}");
}

fn near_each<const N: usize>(found: [f64; N], expected: [f64; N], what: &str) {
    for (index, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        near(found, expected, &format!("{what}, number {index}"));
    }
}

/// Checks the wall of a scene by the table of its text.
pub(crate) fn checked(text: &str) -> Result<Outcome, String> {
    let scene = Scene::parse("scene.toml", text, Path::new(".")).unwrap();
    let file = CheckFile::parse("scene.toml", text).unwrap();
    let assumed = file.assumed(&[]);
    let subject = Subject { assumed: &assumed, ..(&scene).into() };
    let outcome = || Ok(Statement::read(&file)?.checked(subject)?.outcome);
    outcome().map_err(|error: CheckError| file.located(error).to_string())
}

/// The numbers of the sides of a wall, as JSON has them.
pub(crate) fn sides_in_json(text: &str) -> serde_json::Value {
    let scene = Scene::parse("scene.toml", text, Path::new(".")).unwrap();
    let code = check::read(&CheckFile::parse("scene.toml", text).unwrap()).unwrap();
    let verdict = code.check((&scene).into()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    verdict.json()["sides"].take()
}

/// Checks that a scene is refused with a message, which is returned whole.
pub(crate) fn refuses(text: &str, message: &str) -> String {
    let error = checked(text).expect_err(message);
    assert!(error.contains(message), "{error}\nexpected {message}\nfor {text}");
    error
}

/// Checks that a scene is checked with a warning.
pub(crate) fn warns(text: &str, message: &str) {
    let warnings = checked(text).unwrap().warnings;
    assert!(
        warnings.iter().any(|warning| warning.contains(message)),
        "{warnings:?}\nlack {message}\nfor {text}"
    );
}

pub(crate) const PARAPET: &str = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n";
const SITE: &str = "ag = 0.15, F0 = 2.45, TC = 0.32";

/// Checks a wall with a₁ = 0.03 on the ground, or at z/H of a building of three storeys.
fn example(wall: &str, activation: &str, height_ratio: Option<f64>, more: &str) -> Outcome {
    let mut building = String::new();
    let mut damping = ["", ""];
    if let Some(ratio) = height_ratio {
        building = format!("building = {{ storeys = 3, period = 0.3, height_ratio = {ratio} }}\n");
        damping = [", building_damping = 0.05", ", building_damping = 0.1"];
    }
    let [sld, ultimate] = damping;
    let beam = if activation == "beam" { "young_modulus = 0.75e9\n" } else { "" };
    let text = format!(
        "{wall}[force_law]\na1 = 0.03\n[check]\ncode = \"circolare-2019\"\n\
         before_activation = {activation:?}\n{beam}soil = \"B\"\n{more}\n{building}\
         SLD = {{ {SITE}{sld} }}\nSLV = {{ {SITE}{ultimate} }}\nSLC = {{ {SITE}{ultimate} }}\n"
    );
    checked(&text).unwrap()
}

fn positive(verdict: &Outcome) -> &SideVerdict {
    verdict.sides.positive.as_ref().expect("the wall rocks to u > 0")
}

fn ground() -> GroundSpectrum {
    GroundSpectrum::new(Hazard { ag: 0.15, f0: 2.45, tc: 0.32 }, Soil::B, 1.0)
}

#[test]
fn site_of_the_examples() {
    let ground = ground();
    for (found, expected) in [
        (ground.a_g, 1.4715),
        (ground.soil_factor, 1.2),
        (ground.period_factor, 1.38154),
        (ground.t_b, 0.147364),
        (ground.t_c, 0.442092),
        (ground.t_d, 2.2),
        (ground.acceleration(0.0, 0.05), 1.7658),
        (damping_factor(0.08), 0.877058),
        (damping_factor(0.10), 0.816497),
        (ground.acceleration(0.3, 0.05), 4.32621),
        (ground.acceleration(0.3, 0.10), 3.53234),
    ] {
        near(found, expected, "site");
    }
    for (ratio, participation, a_z, amplified) in [
        (1.0, 1.28571, [5.59001, 4.63152], [27.4992, 14.1301, 13.1544]),
        (0.833333, 1.07143, [4.65834, 3.8596], [22.916, 11.7751, 10.962]),
    ] {
        // z/H = 5/6 is printed with six digits
        let mode = Mode::of_storeys(3, 0.3, if ratio < 1.0 { 5.0 / 6.0 } else { ratio });
        near(mode.participation, participation, "participation");
        let [sld, ultimate] = [0.05, 0.10].map(|xi| FloorSpectrum::new(ground, vec![mode], xi));
        near(sld.peak_acceleration(), a_z[0], "a_Z of SLD");
        near(ultimate.peak_acceleration(), a_z[1], "a_Z of SLV");
        let floors = [(&sld, 0.05, 4.91935), (&ultimate, 0.08, 3.05085), (&ultimate, 0.10, 2.84019)];
        for ((floor, xi, amplification), expected) in floors.into_iter().zip(amplified) {
            near(floor.amplification(xi), amplification, "A");
            near(floor.acceleration(0.3, xi), expected, "A a_Z");
        }
    }
}

/// Example (a): T0, `d_y`, `a_y`, capacity; then demand, ζ and `a_g` of SLD and ζ with q, on the
/// ground and on the roof.
#[test]
fn parapet_at_activation() {
    let rigid = [0.0, 0.0, 0.981, 0.726667];
    let law = [0.498925, 0.006, 0.95157, 0.704867];
    let beam = [0.3842, 0.0036019, 0.963333, 0.71358];
    for (activation, branch, ground, roof) in [
        ("rigid", rigid, [1.7658, 0.411523, 0.0617284, 0.823045], [5.59001, 0.129994, 0.0194991, 0.313792]),
        ("law", law, [3.83341, 0.183875, 0.0275812, 0.367749], [9.98227, 0.0706119, 0.0105918, 0.184604]),
        ("beam", beam, [4.32621, 0.164943, 0.0247415, 0.329887], [18.9842, 0.0375882, 0.00563822, 0.113711]),
    ] {
        for (ratio, expected) in [(None, ground), (Some(1.0), roof)] {
            let verdict = example(PARAPET, activation, ratio, "");
            let side = positive(&verdict);
            let sld = side.checks.sld.unwrap();
            near_each(
                [side.curve.alpha0, side.curve.mass, side.curve.d0, side.curve.a0],
                [0.1, 2880.0, 0.2, 0.981],
                "the curve",
            );
            near_each(
                [side.curve.t0, side.curve.dy, side.curve.ay, sld.capacity],
                branch,
                "the elastic branch",
            );
            let with_q = side.checks.slv_q.unwrap().ratio;
            near_each([sld.demand, sld.ratio, sld.ag, with_q], expected, "SLD, and SLV with q");
        }
    }
}

/// The numbers of the examples; −1 for a second term of the demand that there is not.
fn numbers(check: &DisplacementCheck) -> [f64; 8] {
    let [first, second] = check.demand_terms.map(|term| term.unwrap_or(-1.0));
    [check.d, check.a, check.period, check.acceleration, first, second, check.zeta, check.ag]
}

/// Example (a) by displacement, the same for all three curves.
#[test]
fn parapet_by_displacement() {
    let none = -1.0;
    let slv = [0.08, 0.436, 2.26079];
    let slc = [0.12, 0.290667, 3.14896];
    let ground =
        [[0.72202, 0.0934785, none, 0.855812, 0.128372], [0.346467, 0.0870237, none, 1.37893, 0.20684]];
    let roof = [
        [0.781339, 0.101158, 0.0389773, 0.79084, 0.118626],
        [0.523227, 0.131421, 0.0362859, 0.913095, 0.136964],
    ];
    let all =
        |[d, a, t]: [f64; 3], [s, first, second, zeta, ag]: [f64; 5]| [d, a, t, s, first, second, zeta, ag];
    for activation in ["rigid", "law", "beam"] {
        for (ratio, expected) in [(None, ground), (Some(1.0), roof)] {
            let verdict = example(PARAPET, activation, ratio, "");
            for side in [positive(&verdict), verdict.sides.negative.as_ref().unwrap()] {
                near_each(numbers(&side.checks.slv.unwrap()), all(slv, expected[0]), "SLV");
                near_each(numbers(&side.checks.slc.unwrap()), all(slc, expected[1]), "SLC");
            }
            assert!(!verdict.passed);
            near(verdict.governs.zeta, expected[0][3], "what governs");
        }
    }
}

/// Example (b): a loaded strip wall under the roof. On a rigid one `a_g` of SLD replaces that of SLV.
#[test]
fn strip_wall() {
    let wall = "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3\nhinge_ratio = 0.5\n\
                thickness = 0.25\ndensity = 1800\noverburden = 10e3\n";
    for (activation, branch, sld, with_q, zeta) in [
        ("rigid", [0.0, 0.0, 6.9737], [5.16571, 4.65834, 1.10891, 0.166337], 2.67681, 1.10891),
        ("law", [0.136359, 0.00318598, 6.76449], [5.01074, 11.3297, 0.442265, 0.0663398], 1.22917, 1.02249),
        ("beam", [0.122696, 0.00259432, 6.80334], [5.03951, 10.1997, 0.494086, 0.0741129], 1.34261, 1.02249),
    ] {
        // 7.5/9, with more digits than the table has
        let verdict = example(wall, activation, Some(7.5 / 9.0), "");
        let side = positive(&verdict);
        let curve = [side.curve.alpha0, side.curve.mass, side.curve.a0, side.curve.d0];
        near_each(curve, [0.710877, 1350.0, 6.9737, 0.106199], "the curve");
        near_each([side.curve.t0, side.curve.dy, side.curve.ay], branch, "the elastic branch");
        let found = side.checks.sld.unwrap();
        near_each([found.capacity, found.demand, found.ratio, found.ag], sld, "SLD");
        near(side.checks.slv_q.unwrap().ratio, with_q, "SLV with q");
        let slv = side.checks.slv.unwrap();
        assert_eq!(slv.raised, activation == "rigid");
        near(slv.ratio, 1.02249, "SLV before the floor");
        let ag = if slv.raised { 0.166337 } else { 0.153374 };
        let expected = [0.0424797, 3.09942, 0.617888, 4.29598, 0.0415453, 0.0324811, zeta, ag];
        near_each(numbers(&slv), expected, "SLV");
        let ag = 1.31793 * 0.15;
        let expected = [0.0637196, 2.06628, 0.860629, 2.57697, 0.0483483, 0.0302383, 1.31793, ag];
        near_each(numbers(&side.checks.slc.unwrap()), expected, "SLC");
        assert!(verdict.passed);
        near(verdict.governs.zeta, zeta, "what governs");
    }
}

/// Example (c): the tie breaks before 0.4 `d_0` and takes more than half of the largest a with it.
#[test]
fn tied_parapet() {
    let tie = "[tie]\ntie_stiffness = 200e3\ntie_height = 3\ntie_slack = 0.03\ntie_strength = 5e3\n";
    let none = -1.0;
    for (ratio, slv, slc) in [
        (None, [2.63612, 0.0270378, none, 1.35612, 0.203419], 1.37893),
        (Some(1.0), [4.91373, 0.0503985, 0.0389773, 0.727534, 0.10913], 0.913095),
    ] {
        let verdict = example(&format!("{PARAPET}{tie}"), "law", ratio, "");
        let side = positive(&verdict);
        let found = side.checks.slv.unwrap();
        assert!(found.limited_by_tie && !side.checks.slc.unwrap().limited_by_tie);
        let [s, first, second, zeta, ag] = slv;
        near_each(numbers(&found), [0.0366667, 2.52246, 0.636331, s, first, second, zeta, ag], "SLV");
        near(side.checks.slc.unwrap().zeta, slc, "SLC");
        near(side.checks.sld.unwrap().capacity, 0.704867, "SLD");
    }
}

/// Example (d): a loaded parapet, without and with the mass of its overburden.
#[test]
fn loaded_parapet() {
    for (r, expected) in [
        (0, [0.113273, 2880.0, 1.11121, 0.167323, 0.466144, 0.0669291, 0.49387, 1.94294, 0.082556, 0.810711]),
        (
            1,
            [
                0.0836613, 3389.68, 0.820718, 0.192482, 0.344285, 0.0769927, 0.364763, 2.42481, 0.0934785,
                0.823641,
            ],
        ),
    ] {
        let wall = format!("{PARAPET}overburden = 5e3\noverburden_eccentricity = 0.05\n");
        let verdict = example(&wall, "rigid", None, &format!("overburden_mass = {r}"));
        let side = positive(&verdict);
        let (sld, slv) = (side.checks.sld.unwrap(), side.checks.slv.unwrap());
        let [d, a, period, _, demand, _, zeta, _] = numbers(&slv);
        let found = [
            side.curve.alpha0,
            side.curve.mass,
            side.curve.a0,
            side.curve.d0,
            sld.ratio,
            d,
            a,
            period,
            demand,
            zeta,
        ];
        near_each(found, expected, &format!("r = {r}"));
    }
}

/// Example (f): spectra of every soil, of two modes, and the second term of [C8.7.1.12].
#[test]
fn spectra() {
    let hazard = Hazard { ag: 0.25, f0: 2.4, tc: 0.30 };
    for (soil, factors, at_5, at_8) in [
        (Soil::A, [1.0, 1.0, 0.1, 0.3], [5.0031, 7.0632, 2.11896], [0.122395, 0.0919762, 0.0573885]),
        (
            Soil::B,
            [1.16, 1.39949, 0.139949, 0.419846],
            [5.12145, 8.19331, 3.43993],
            [0.198697, 0.154929, 0.0931647],
        ),
        (
            Soil::C,
            [1.34, 1.56221, 0.156221, 0.468663],
            [5.71069, 9.46469, 4.43575],
            [0.256217, 0.219691, 0.120135],
        ),
        (
            Soil::D,
            [1.5, 2.28218, 0.228218, 0.684653],
            [5.76854, 10.5948, 7.25376],
            [0.418992, 0.35926, 0.196456],
        ),
        (
            Soil::E,
            [1.34, 1.86144, 0.186144, 0.558432],
            [5.42663, 9.46469, 5.28539],
            [0.305294, 0.261772, 0.143146],
        ),
    ] {
        let ground = GroundSpectrum::new(hazard, soil, 1.2);
        let found = [ground.soil_factor, ground.period_factor, ground.t_b, ground.t_c];
        let accelerations = [0.05, 0.3, 1.0].map(|period| ground.acceleration(period, 0.05));
        let displacements = [3.0, 7.0, 11.0].map(|period| ground.displacement(period, 0.08));
        let found = found.into_iter().chain(accelerations).chain(displacements);
        for (found, expected) in found.zip(factors.into_iter().chain(at_5).chain(at_8)) {
            near(found, expected, &format!("{soil:?}"));
        }
        near(ground.t_d, 2.6, "T_D");
    }
    let ground = ground();
    let mode = |period, participation| Mode { period, participation };
    let floor = FloorSpectrum::new(ground, vec![mode(0.3, 1.2), mode(0.1, -0.3)], 0.05);
    near(FloorSpectrum::new(ground, vec![mode(0.3, 1.2)], 0.05).peak_acceleration(), 5.21734, "a_Z,1");
    near(FloorSpectrum::new(ground, vec![mode(0.1, -0.3)], 0.05).peak_acceleration(), 1.05622, "a_Z,2");
    near(floor.peak_acceleration(), 5.32318, "a_Z");
    for (period, expected) in
        [(0.05, 7.50888), (0.1, 10.9764), (0.3, 25.6731), (0.5, 9.27572), (1.0, 2.52633), (2.5, 0.673229)]
    {
        near(floor.acceleration(period, 0.05), expected, "two modes");
    }
    near(floor.acceleration(2.5, 0.05), ground.acceleration(2.5, 0.05), "not below the ground");
    let roof = FloorSpectrum::new(ground, vec![Mode::of_storeys(3, 0.3, 1.0)], 0.03);
    let (first, second) = roof.displacement(0.36, 0.08);
    near(first, 0.0906135, "first term");
    near(second.unwrap(), 0.0957229, "second term");
}
