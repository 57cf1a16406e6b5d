//! Tests force laws that are made of a capacity curve.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use rocking_wall::unit::UnitScene;
use rocking_wall::wall::{Parameters, Wall, Warning};
use scene::response::Response;
use scene::{Scene, to_toml};

/// A folder with the file `pushover.csv` of a text.
fn folder(name: &str, curve: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("curve").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("pushover.csv"), curve).unwrap();
    folder
}

fn read(name: &str, text: &str, curve: &str) -> Result<Scene, String> {
    Scene::parse("scene.toml", text, &folder(name, curve)).map_err(|error| error.to_string())
}

fn u_of(scene: &Scene) -> Vec<f64> {
    Response::of(scene).unwrap().samples.iter().map(|sample| sample.outputs.displacement).collect()
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().fold(0.0_f64, |largest, u| largest.max(u.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance * largest, "{found} for {expected} of {largest}");
    }
}

const FREE: &str = "stop_time = 6
[damping]
damping_model = \"constant_coefficient\"
xi = 0.05
[geometry]
height = 4
thickness = 0.4
[start]
u_start = 0.15
";

/// The bilinear wall of `FREE`: its F₀ and u_ins, and rows of its curve.
fn sampled(at: impl Fn(f64) -> f64, force: f64) -> String {
    let wall = Wall::new(&Parameters { height: 4.0, thickness: 0.4, ..Parameters::default() }).unwrap();
    let (u_ins, f0) = (wall.body().instability.positive, wall.body().strength.positive);
    let mut rows = String::new();
    for index in 0..=400 {
        let fraction = f64::from(index) / 400.0;
        let ratio = if fraction < 0.03 { fraction / 0.03 * 0.97 } else { 1.0 - fraction };
        let _ = writeln!(rows, "{:?},{:?}", at(fraction * u_ins), ratio * f0 / force);
    }
    rows
}

/// 401 points of the bilinear law make the bilinear wall: the default tolerance keeps its two corners, and
/// tolerance 0 all whose rounding tells. Rounding is all that differs.
#[test]
fn a_curve_of_the_bilinear_law_is_the_bilinear_wall() {
    let bilinear = u_of(&Scene::parse("bilinear", FREE, Path::new(".")).unwrap());
    let curve = format!("u [mm],F [kN]\n{}", sampled(|u| 1000.0 * u, 1000.0));
    for (tolerance, kept) in [("", "2 of 400 points"), ("curve_tolerance = 0\n", " of 400 points")] {
        let text = format!("{FREE}[force_law]\nfile = \"pushover.csv\"\n{tolerance}");
        let scene = read("bilinear", &text, &curve).unwrap();
        let of_file = scene.curve.as_ref().unwrap();
        assert!(of_file.note().contains(kept), "{}", of_file.note());
        assert_eq!((of_file.points.len(), scene.files.len()), (401, 1));
        assert_near(&u_of(&scene), &bilinear, 1e-12);
        // the FMU and a written scene have the same points, without the file
        let unit = UnitScene { parameters: scene.parameters.clone(), motion: None };
        assert_eq!(UnitScene::read(&unit.bytes()).unwrap(), unit);
        let written = Scene::parse("written", &to_toml(&scene, ""), Path::new("nowhere")).unwrap();
        assert_eq!(written.parameters.multilinear, scene.parameters.multilinear);
    }
}

/// The same curve in other units and at other points of the wall is the same law: a displacement at the top
/// is twice that at the centroid, d* = u/λ and a* = F/(λ m_eff).
#[test]
fn columns_and_control_points_are_those_of_one_law() {
    let wall = Wall::new(&Parameters { height: 4.0, thickness: 0.4, ..Parameters::default() }).unwrap();
    let (m, lambda) = (wall.body().effective_mass, wall.body().participation);
    let bilinear = u_of(&Scene::parse("bilinear", FREE, Path::new(".")).unwrap());
    let tables = [
        ("top", "at_height = 4.0", "d_top (cm);base shear (N)\n", sampled(|u| 200.0 * u, 1.0)),
        ("spectral", "", "d* [m],a* [g]\n", sampled(|u| u / lambda, lambda * m * 9.806_65)),
        ("spectral_top", "at_height = 4.0", "d [m],a* [m/s2]\n", sampled(|u| 2.0 * u, lambda * m)),
    ];
    for (name, key, header, rows) in tables {
        let rows = if header.contains(';') { rows.replace(',', ";") } else { rows };
        let text = format!("{FREE}[force_law]\nfile = \"pushover.csv\"\n{key}\n");
        assert_near(&u_of(&read(name, &text, &(header.to_owned() + &rows)).unwrap()), &bilinear, 1e-12);
    }
}

/// Sides of their own: the law is the curve on both, mirrored it is the mirrored wall.
#[test]
fn each_side_has_its_own_points() {
    let free = FREE.replace("constant_coefficient", "none").replace("0.15", "0.05");
    let text = |points: &str| format!("{free}[force_law]\ncurve_tolerance = 0.0\ncurve = {points}\n");
    let one = "[[-0.2, 0.0], [-0.05, -1500.0], [-0.01, -900.0], [0.02, 2000.0], [0.1, 1500.0], [0.25, 0.0]]";
    let other =
        "[[-0.25, 0.0], [-0.1, -1500.0], [-0.02, -2000.0], [0.01, 900.0], [0.05, 1500.0], [0.2, 0.0]]";
    let scene = read("sides", &text(one), "").unwrap();
    let wall = Wall::new(&scene.parameters).unwrap();
    let backbone = wall.backbone();
    for (u, force) in [(-0.05, -1500.0), (-0.01, -900.0), (0.02, 2000.0), (0.1, 1500.0)] {
        let near = |point: &&(f64, f64)| (point.0 - u).abs() < 1e-15 && (point.1 - force).abs() < 1e-10;
        assert!(backbone.iter().any(|point| near(&point)), "{u}, {force}: {backbone:?}");
    }
    let mirrored = text(other).replace("u_start = 0.05", "u_start = -0.05");
    let u: Vec<_> = u_of(&read("sides", &mirrored, "").unwrap()).iter().map(|u| -u).collect();
    assert_near(&u, &u_of(&scene), 1e-13);
}

/// Curve, constants and ground motion of tests/data/curve.py, whose numbers these are; its integration has a
/// relative tolerance of 1e-13 on each piece.
#[test]
fn an_oscillator_moves_as_scipy_has_it() {
    let u = [-0.30, -0.18, -0.07, -0.03, -0.01, 0.0, 0.012, 0.03, 0.06, 0.11, 0.2, 0.26];
    let force = [0.0, -1.5, -2.6, -2.4, -1.1, 0.0, 1.3, 2.2, 2.5, 2.3, 0.9, 0.2];
    let mut rows = "u [m],F [kN]\n".to_owned();
    for (u, force) in u.iter().zip(force) {
        let _ = writeln!(rows, "{u:?},{force:?}");
    }
    let mut ground = String::new();
    for i in 0..60 {
        let _ = writeln!(ground, "{:?}", 5.0 * f64::from((7 * i) % 11 - 5) / 5.0);
    }
    let text = "stop_time = 5.9\noutput_step = 0.1\n\
                [force_law]\nfile = \"pushover.csv\"\ncurve_tolerance = 0\n\
                oscillator = { effective_mass = 1200.0, participation = 1.3 }\n\
                [damping]\ndamping_model = \"constant_coefficient\"\nxi = 0.05\n\
                [motion]\nrecord = \"ground.txt\"\nstep = 0.1\nunit = \"m/s2\"\n";
    std::fs::write(folder("scipy", "").join("ground.txt"), ground).unwrap();
    let scene = read("scipy", text, &rows).unwrap();
    let found = u_of(&scene);
    let expected = [
        0.019_349_914_953_280_402,
        -0.090_580_070_188_729_99,
        -0.102_910_890_615_394_16,
        0.007_721_127_757_110_393,
        0.003_395_344_979_043_583_4,
    ];
    for (index, expected) in expected.into_iter().enumerate() {
        let found = found[10 * (index + 1)];
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} for {expected}");
    }
}

/// The rigid body that stands for an oscillator has its constants, for any λ, and the curve's ends.
#[test]
fn an_oscillator_has_the_constants_that_are_given() {
    for participation in [0.4, 1.0, 1.3, 2.5] {
        let text = format!(
            "[force_law]\ncurve = [[-0.3, 0], [-0.1, -900.0], [0.02, 1000.0], [0.1, 600.0]]\n\
             oscillator = {{ effective_mass = 800.0, participation = {participation} }}\n\
             [damping]\nxi = 0.05\n"
        );
        let scene = read("oscillator", &text, "").unwrap();
        assert!(scene.curve.as_ref().unwrap().note().contains("F falls to 0 at |u| = 0.2200 m"));
        let body = Wall::new(&scene.parameters).unwrap().body().clone();
        for (found, expected) in [
            (body.effective_mass, 800.0),
            (body.participation, participation),
            (body.instability.positive, 0.22),
            (body.instability.negative, 0.3),
        ] {
            assert!((found - expected).abs() <= 1e-14 * expected, "{participation}: {found} for {expected}");
        }
    }
}

/// The example of the documentation.
#[test]
fn the_example_reads_its_curve() {
    let scene = Scene::read(&crate::root().join("examples/capacity_curve.toml")).unwrap();
    let curve = scene.curve.as_ref().unwrap();
    assert_eq!(curve.short_note(), "14 of 15 points, ΔF at most 0.128 %");
    let kept = "14 of 15 points, ΔF at most 0.128 % of the largest F of its side, at u =";
    assert!(curve.note().starts_with(kept), "{}", curve.note());
    let end = "beyond its last point, u = 0.1225 m, F falls to 0 at |u| =";
    assert!(curve.note().contains(end), "{}", curve.note());
    // it fits its geometry
    assert_eq!(curve.doubts, [""; 0]);
    assert!(Wall::new(&scene.parameters).unwrap().omega1() > 0.0 && u_of(&scene).len() > 1000);
}

/// A header that says another thing than how its numbers would be read is refused, at its line.
#[test]
fn names_of_displacements_are_believed() {
    let oscillator = "oscillator = { effective_mass = 800.0, participation = 1.2 }";
    for (geometry, key, header, words) in [
        (FREE, "", "u [mm],a* [g]", Some("read as d* = u/λ; name them d*")),
        (FREE, "", "d* [mm],F* [kN]", Some("d* goes with accelerations a*; beside forces give u")),
        (
            FREE,
            "at_height = 2.0",
            "d* [mm],a* [g]",
            Some("d* is not measured at a height; leave at_height out"),
        ),
        ("", oscillator, "d* [mm],F [kN]", Some("d* goes with accelerations")),
        (FREE, "at_height = 2.0", "u [mm],a* [g]", None),
        (FREE, "", "d* [mm],a* [g]", None),
        (FREE, "", "u [mm],F [kN]", None),
    ] {
        let text = format!("{geometry}[force_law]\nfile = \"pushover.csv\"\n{key}\n");
        let error = read("header", &text, &format!("# of a test\n{header}\n1,0.1\n200,0\n")).err();
        assert_eq!(error.is_some(), words.is_some(), "{header}: {error:?}");
        for (error, words) in error.iter().zip(words) {
            assert!(error.contains("pushover.csv, line 2: the displacements are named"), "{error}");
            assert!(error.contains(words), "{header}: {error}");
        }
    }
}

/// A curve that ends elsewhere than the wall of its geometry, or whose forces are those of another unit, is
/// told. F₀ = 1800 · 9.81 · 4 · 0.4/10 N and u_ins = 0.2 m; the curve of 1 kN ends at 0.22 m.
#[test]
fn a_curve_that_does_not_fit_its_geometry_is_told() {
    let doubts = |curve: &str| {
        let text = format!("{FREE}[force_law]\ncurve = {curve}\n");
        let curve = read("doubts", &text, "").unwrap().curve.unwrap();
        assert!(curve.doubts.iter().all(|doubt| curve.note().contains(doubt)), "{}", curve.note());
        curve.doubts
    };
    let end = doubts("[[0.02, 1000.0], [0.22, 0.0]]");
    let words = "F is 100 N at u_ins = 0.2000 m, beyond which the wall is overturned, and 0 at |u| = 0.22 m";
    assert!(end.len() == 1 && end[0].contains(words), "{end:?}");
    // a side of its own that ends before u_ins
    let end = doubts("[[-0.18, 0.0], [-0.02, -1600.0], [0.02, 1000.0], [0.2, 0.0]]");
    assert!(end.len() == 1 && end[0].contains("F is 200 N at u_ins = 0.2000 m"), "{end:?}");
    assert!(doubts("[[0.02, 1000.0], [0.2019, 0.0]]").is_empty());
    let unit = doubts("[[0.02, 1.0e6], [0.2, 0.0]]");
    assert!(unit.len() == 1 && unit[0].contains("the largest F is 353.947 F0"), "{unit:?}");
    assert_eq!(doubts("[[0.02, 100.0], [0.2, 0.0]]").len(), 1);
}

/// An oscillator in other units is told, and has no rotations to warn of.
#[test]
fn an_oscillator_in_other_units_is_told() {
    let of = |curve: &str, mass: f64| {
        let oscillator = format!("oscillator = {{ effective_mass = {mass}, participation = 1.2 }}");
        let text = format!("[force_law]\ncurve = {curve}\n{oscillator}\n[damping]\nxi = 0.05\n");
        read("units", &text, "").unwrap()
    };
    let (curve, millimetres) = ("[[0.02, 1000.0], [0.2, 0.0]]", "[[20.0, 1000.0], [200.0, 0.0]]");
    let micrometres = "[[1e-6, 1000.0], [1e-5, 0.0]]";
    for (curve, mass, words) in [
        (curve, 800.0, None),
        (millimetres, 800.0, Some("F is 0 at |u| = 200 m, not 0.001 to 5 m: check the unit")),
        (micrometres, 800.0, Some("F is 0 at |u| = 1e-5 m, not 0.001 to 5 m: check the unit")),
        (curve, 8e5, Some("the largest a* is 1.062e-4 g, not 0.005 to 5: check the unit, and")),
    ] {
        let doubts = of(curve, mass).curve.unwrap().doubts;
        assert_eq!(doubts.len(), usize::from(words.is_some()), "{doubts:?}");
        assert!(doubts.iter().zip(words).all(|(doubt, words)| doubt.contains(words)), "{doubts:?}");
    }
    // a stiff one, whose rigid body is squat
    let scene = of("[[0.02, 30000.0], [0.2, 0.0]]", 800.0);
    let wall = Wall::new(&scene.parameters).unwrap();
    assert!(wall.warnings().iter().any(|warning| matches!(warning, Warning::LargeRotations { .. })));
    assert_eq!(scene.warnings_of(&wall).count(), wall.warnings().len() - 1);
}

/// Each side is measured by its own largest force; a law of all points has no deviation to tell.
#[test]
fn a_weak_side_is_kept() {
    let text =
        format!("{FREE}[force_law]\ncurve = [[-0.2, 0.0], [-0.01, -1.0], [0.02, 1500.0], [0.2, 0.0]]\n");
    let scene = read("weak", &text, "").unwrap();
    assert_eq!(scene.parameters.multilinear.as_ref().unwrap().len(), 4);
    assert!(scene.curve.unwrap().note().starts_with("4 of 4 points; the largest F is 0."));
}

/// A change of the parameters leaves no curve that is not the law, and an oscillator has no geometry.
#[test]
fn a_curve_follows_changes_of_its_wall() {
    let text = format!("{FREE}[force_law]\ncurve = [[0.02, 1000.0], [0.2, 0.0]]\n");
    let scene = read("changes", &text, "").unwrap();
    let changed = |name: &str, value: &str| {
        let mut scene = scene.clone();
        scene.set(name, value).unwrap();
        scene.curve
    };
    assert_eq!(changed("xi", "0.03"), scene.curve);
    assert_eq!(changed("force_law", "bilinear"), None);
    let scaled = changed("thickness", "0.3").unwrap();
    assert!(scaled.points.is_empty() && scaled.note().starts_with("the curve is scaled with F0 and u_ins"));
    let oscillator = "[force_law]\ncurve = [[0.02, 1000.0], [0.2, 0.0]]\n\
                      oscillator = { effective_mass = 800.0, participation = 1.2 }\n[damping]\nxi = 0.05\n";
    let mut oscillator = read("changes", oscillator, "").unwrap();
    let error = oscillator.set("height", "4").unwrap_err().to_string();
    assert!(error.contains("height is that of a wall, and no oscillator has it"), "{error}");
    oscillator.set("xi", "0.03").unwrap();
    assert_eq!(oscillator.curve.unwrap().points.len(), 3);
}

/// What no law can have is refused with the row and what to do.
#[test]
fn curves_that_fit_no_law_are_refused() {
    let header = "u [mm],F [kN]\n";
    for (rows, words) in [
        (
            "1,2\n3,1\n2,0.5\n4,0\n",
            "pushover.csv, line 4: [2, 0.5] of the curve: the displacements must rise",
        ),
        ("1,2\n2,1\n2,0.5\n", "line 4: [2, 0.5] of the curve: the displacements must rise from zero; sort"),
        ("0,0\n1,2\n0.5,1\n0,0\n", "line 4: [0.5, 1] of the curve: the displacements must rise"),
        ("0,3\n1,2\n2,0\n", "line 2: [0, 3] of the curve: a curve begins at the origin; give the small"),
        ("1,2\n2,0\n3,-1\n", "line 3: [2, 0] of the curve: the force must be positive"),
        ("1,-2\n2,-1\n3,0\n", "line 2: [1, -2] of the curve: the force must be positive"),
        ("1,2\n2,3\n3,3\n", "line 4: [3, 3] of the curve: the last line must fall"),
        ("-2,-3\n-1,-1\n", "line 3: [-1, -1] of the curve: a multilinear law needs at least two points"),
        ("-1,-1\n1,2\n2,1\n", "line 2: [-1, -1] of the curve: a multilinear law needs at least two points"),
        ("1,2\n2,nan\n", "line 3: expected a finite number, found `nan`"),
        ("1,2\n2\n", "line 3: expected one value for each column, 2 in all, found 1"),
        ("1,2 kN\n2,0\n", "line 2: expected a finite number, found `2 kN`"),
    ] {
        let text = format!("{FREE}[force_law]\nfile = \"pushover.csv\"\n");
        let error = read("refused", &text, &(header.to_owned() + rows)).unwrap_err();
        assert!(error.contains(words), "{rows}: {error}");
    }
    for (header, words) in [
        ("u,F\n", "line 1: expected one column of displacements in m, cm or mm, found `u,F`; name each"),
        ("F [kN],u [mm]\n", "line 1: expected one column of displacements in m, cm or mm"),
        ("u [mm],F/W [-]\n", "line 1: expected one column of forces in N, kN or MN, or of accelerations"),
        ("u [mm],V [kN],N [kN]\n", "line 1: expected one column of forces"),
        ("u [mm],F [mN]\n", "line 1: expected one column of forces"),
        ("", "line 1: expected commas that either separate or stand before decimals"),
    ] {
        let rows = if header.contains("V [kN]") { "1,2,3\n2,0,3\n" } else { "1,2\n2,0\n" };
        let text = format!("{FREE}[force_law]\nfile = \"pushover.csv\"\n");
        let error = read("refused", &text, &(header.to_owned() + rows)).unwrap_err();
        assert!(error.contains(words), "{header}: {error}");
    }
}

/// Keys that contradict each other are refused with their line.
#[test]
fn keys_beside_a_curve_are_refused() {
    let law = "curve = [[0.01, 500.0], [0.1, 0.0]]";
    let oscillator = "oscillator = { effective_mass = 9.0, participation = 1.0 }";
    for (geometry, keys, words) in [
        ("", "file = \"pushover.csv\"\ncurve = [[1.0, 1.0]]", "line 3: a capacity curve is one of file"),
        ("", "at_height = 1.0", "line 3: a capacity curve is one of file"),
        ("", "file = \"none.csv\"", "none.csv: cannot be read"),
        ("", &format!("{law}\na1 = 0.1"), "line 4: a1 is that of another force law; leave one of them out"),
        ("", &format!("{law}\nforce_law = \"bilinear\""), "line 4: force_law is that of another force law"),
        ("", &format!("{law}\npoints = [[0.1, 1], [1, 0]]"), "line 4: "),
        ("", &format!("{law}\nat_height = 9.0"), "line 3: at_height is not on the wall"),
        ("", &format!("{law}\nat_height = 0.0"), "line 4: at_height = 0"),
        ("", &format!("{law}\ncurve_tolerance = 0.5"), "line 4: curve_tolerance = 0.5"),
        ("", "curve = [[0.01, 500.0, 1.0]]", "line 3: "),
        ("", "curve = [[0.01, 500.0], [nan, 0.0]]", "line 3: curve = NaN must be finite"),
        (
            "height = 3",
            &format!("{law}\n{oscillator}"),
            "line 1: height is that of a wall, and no oscillator",
        ),
        ("", &format!("{law}\n{oscillator}\nat_height = 1.0"), "at_height is that of a wall"),
        ("", &format!("{law}\noscillator = {{ effective_mass = 9.0 }}"), "participation is missing"),
        ("", oscillator, "line 3: a capacity curve is one of file"),
        ("kinematics = \"trigonometric\"", law, "multilinear"),
    ] {
        let geometry = if geometry.is_empty() { "title = \"t\"" } else { &format!("geometry.{geometry}") };
        let error = read("keys", &format!("{geometry}\n[force_law]\n{keys}\n"), "").map(|scene| {
            Wall::new(&scene.parameters).map_err(|error| error.to_string()).expect_err("refused")
        });
        let error = error.unwrap_or_else(|error| error);
        assert!(error.contains(words), "{keys}: {error}");
    }
}
