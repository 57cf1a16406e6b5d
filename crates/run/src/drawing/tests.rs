//! What drawings of the scenes of `scenes/bodies` hold.

use std::path::Path;

use rocking_wall::wall::Wall;
use scene::Scene;

use super::{Shape, svg};

/// A file of `scenes/bodies`.
macro_rules! text {
    ($name:literal) => {
        include_str!(concat!("../../../../scenes/bodies/", $name, ".toml"))
    };
}

/// A scene, and how many items of each kind its section has.
struct Drawn {
    text: &'static str,
    parts: usize,
    openings: usize,
    loads: usize,
    thrusts: usize,
    hinges: usize,
    has_front: bool,
}

const fn drawn(text: &'static str, parts: usize, hinges: usize) -> Drawn {
    Drawn { text, parts, openings: 0, loads: 0, thrusts: 0, hinges, has_front: false }
}

const SCENES: [Drawn; 9] = [
    drawn(text!("battered_wall"), 1, 2),
    Drawn { openings: 1, has_front: true, ..drawn(text!("chimney"), 2, 2) },
    Drawn { loads: 3, thrusts: 2, ..drawn(text!("facade"), 1, 2) },
    Drawn { has_front: true, ..drawn(text!("gable"), 1, 2) },
    drawn(text!("rectangle"), 1, 2),
    Drawn { loads: 1, ..drawn(text!("stepped_strip"), 2, 4) },
    drawn(text!("stone_under_brick"), 2, 2),
    Drawn { has_front: true, ..drawn(text!("trapezium"), 1, 2) },
    Drawn { openings: 1, has_front: true, ..drawn(text!("wall_with_opening"), 1, 2) },
];

fn of(text: &str) -> (Scene, Wall) {
    let scene = Scene::parse("scene.toml", text, Path::new(".")).unwrap();
    let wall = Wall::new(&scene.parameters).unwrap();
    (scene, wall)
}

fn count(svg: &str, kind: &str) -> usize {
    svg.matches(&format!("data-drawn=\"{kind}\"")).count()
}

/// Corners of the polygons of a kind \[px\].
fn polygons(svg: &str, kind: &str) -> Vec<Vec<[f64; 2]>> {
    let lines = svg.lines().filter(|line| line.contains(&format!("data-drawn=\"{kind}\"")));
    let points = lines.map(|line| line.split('"').nth(1).unwrap().split(' '));
    let corner = |point: &str| {
        let (x, y) = point.split_once(',').unwrap();
        [x, y].map(|number| number.parse().unwrap())
    };
    points.map(|points| points.map(corner).collect()).collect()
}

#[test]
fn a_section_has_every_part_opening_load_thrust_and_hinge() {
    for expected in SCENES {
        let (scene, wall) = of(expected.text);
        let svg = svg(&wall, &scene.parameters);
        let found = ["part", "opening", "load", "thrust", "hinge"].map(|kind| count(&svg, kind));
        let Drawn { parts, openings, loads, thrusts, hinges, .. } = expected;
        assert_eq!(found, [parts, openings, loads, thrusts, hinges], "{}", scene.title);
        assert_eq!(count(&svg, "front") > 0, expected.has_front, "{}", scene.title);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", scene.title);
    }
}

/// The scale is one in both directions, and the outside is on the right.
#[test]
fn parts_are_to_scale() {
    let (scene, wall) = of(text!("battered_wall"));
    let svg = svg(&wall, &scene.parameters);
    // outer and inner corner at the bottom, inner and outer one at the top: 0.5 m, 4 m, 0.3 m
    let [b_out, b_in, t_in, t_out] = polygons(&svg, "part")[0][..] else { panic!("four corners") };
    let scale = (b_out[1] - t_out[1]) / 4.0;
    for (found, expected) in
        [(b_out[0] - b_in[0], 0.5), (t_out[0] - t_in[0], 0.3), (b_out[0] - t_out[0], 0.2)]
    {
        // corners are rounded to tenths of a pixel
        assert!((found / scale - expected).abs() <= 0.15 / scale, "{found} px for {expected} m");
    }
}

/// Bodies that are cut by a hinge have the area of the whole.
#[test]
fn a_hinge_cuts_parts_without_loss() {
    let (scene, wall) = of(text!("stepped_strip"));
    let shape = Shape::new(&wall, &scene.parameters);
    let area = |[[x0, z0], [x1, _], [x2, z1], [x3, _]]: [[f64; 2]; 4]| 0.5 * (z1 - z0) * (x1 - x0 + x2 - x3);
    let areas: Vec<f64> = shape
        .bodies()
        .iter()
        .map(|heights| shape.parts.iter().filter_map(|part| Shape::corners(part, *heights)).map(area).sum())
        .collect();
    assert!((areas[0] - 1.6 * 0.4).abs() < 1e-12 && (areas[1] - 1.4 * 0.25).abs() < 1e-12, "{areas:?}");
    // the hinge opens about the edges of the thinner part
    let edges = shape.hinge.unwrap().edges;
    assert!((edges[0] - 0.15).abs() < 1e-12 && (edges[1] - 0.4).abs() < 1e-12, "{edges:?}");
}

/// A body by its integrals has no outline: an axis, its hinges, its centroid and the sums of its loads.
#[test]
fn a_body_by_integrals_is_drawn_without_an_outline() {
    let (scene, wall) = of("[geometry.body]\nmass = 880\ncentroid_height = 0.89\ninertia = 950\narm = 0.3\n\
                            height = 1.6\n[[geometry.load]]\nforce = 1e3\nheight = 1.6\ninside = 0.3\n\
                            thrust = 200\n[damping]\ndamping_model = \"none\"\n");
    let svg = svg(&wall, &scene.parameters);
    let found = ["part", "load", "thrust", "hinge"].map(|kind| count(&svg, kind));
    assert_eq!(found, [0, 1, 1, 2]);
    assert!(svg.contains("only its integrals") && svg.contains("W = 8.63 kN at 0.89 m"), "{svg}");
}

#[test]
fn a_tie_and_transverse_walls_are_drawn() {
    let tied = "[[geometry.part]]\nheight = 3\nthickness = 0.3\n[tie]\ntie_height = 2.5\n\
                tie_stiffness = 1e6\ntie_strength = 5e3\n[damping]\ndamping_model = \"none\"\n[impact]\n\
                impact = \"restitution\"\nrestitution = 0.8\nrocking = \"one_sided_positive\"\n";
    let (scene, wall) = of(tied);
    let svg = svg(&wall, &scene.parameters);
    assert_eq!([count(&svg, "tie"), count(&svg, "hinge")], [1, 1]);
    assert!(svg.contains("tie at 2.5 m") && svg.contains("up to 5 kN") && svg.contains("transverse walls"));
}
