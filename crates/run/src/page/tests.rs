//! Tests of the page without a browser.

use rocking_wall::wall::Wall;
use scene::Scene;
use scene::response::Response;

use super::render;
use crate::figure::{WIDTH, cut, history};

fn page(change: impl Fn(&mut Scene)) -> String {
    let mut scene = Scene::default();
    change(&mut scene);
    let response = Response::of(&scene).unwrap();
    render(&scene, &Wall::new(&scene.parameters).unwrap(), &response).unwrap()
}

#[test]
fn a_long_history_stays_small() {
    let html = page(|scene| {
        scene.stop_time = 100.0;
        scene.output_step = 1e-3;
    });
    assert!(html.len() < 300_000, "{} bytes", html.len());
}

#[test]
fn nothing_is_loaded_from_elsewhere() {
    let html = page(|_| {});
    let links = html.replace("http://www.w3.org/2000/svg", "");
    assert!(!links.contains("http"), "a link");
    assert!(!html.contains("{{") && !html.contains("NaN"), "a gap");
}

#[test]
fn titles_are_text() {
    let html = page(|scene| scene.title = "<b>\"A\" & B</b></script>".into());
    assert!(html.contains("&lt;b&gt;&quot;A&quot; &amp; B&lt;/b&gt;"));
    assert!(!html.contains("<b>\"A\""));
}

/// After the fall the line leaves the plot: drawn on along the edge it would look like a wall at rest there.
#[test]
fn the_line_of_a_fallen_wall_ends() {
    let mut scene = Scene::default();
    scene.set("u_start", "0.199").unwrap();
    scene.set("u_dot_start", "0.1").unwrap();
    let response = Response::of(&scene).unwrap();
    let line = cut(response.samples.iter().map(|sample| (sample.time, sample.outputs.ratio)).collect());
    let (before, last) = (line[line.len() - 2], line[line.len() - 1]);
    assert!(before.1 <= 1.25 && last.1 == 1.25 && last.0 < 10.0, "{before:?}, {last:?}");
}

/// A wall that its tie brings back is drawn to its end, at its peak.
#[test]
fn the_line_of_a_wall_that_comes_back_goes_on() {
    let tied = |scene: &mut Scene| {
        let parameters = [("u_start", "0.19"), ("u_dot_start", "0.5"), ("tie_height", "3")];
        for (name, value) in parameters.into_iter().chain([("tie_stiffness", "2e4"), ("tie_side", "both")]) {
            scene.set(name, value).unwrap();
        }
    };
    let html = page(tied);
    assert!(html.contains("and comes back.") && html.contains(">exceeds u_ins</span>"));
    let shown =
        html.split("id=\"force\"").nth(1).and_then(|rest| rest.split("data-ranges=\"[").nth(1)).unwrap();
    let left: f64 = shown.split(',').next().unwrap().parse().unwrap();
    let peak = html.split("\"open\":").nth(1).and_then(|rest| rest.split(',').next()).unwrap();
    let mut scene = Scene::default();
    tied(&mut scene);
    let response = Response::of(&scene).unwrap();
    let time = response.samples[peak.parse::<usize>().unwrap()].time;
    assert!(time > response.summary.overturn_time.unwrap(), "{time}");
    let ratio = response.summary.u_ratio_max;
    assert!(ratio > 1.2 && -left > ratio, "the dot of the force stays within {left}: {ratio}");
}

/// The capacity curve of a force law is drawn over it, point by point.
#[test]
fn a_capacity_curve_is_drawn_over_the_force() {
    let html = page(|scene| {
        let law = "[force_law]\ncurve = [[0.01, 900.0], [0.02, 1500.0], [0.2, 0.0]]\n";
        let given = Scene::parse("curve", law, ".".as_ref()).unwrap();
        (scene.parameters, scene.curve) = (given.parameters, given.curve);
    });
    let plain = page(|_| {});
    let caption = "<figcaption>Restoring force; dashed: its backbone";
    assert!(html.contains(&format!("{caption}; circles: the capacity curve as given</figcaption>")));
    assert!(plain.contains(&format!("{caption}</figcaption>")));
    // the first half of a circle of 2 px
    let circles = |html: &str| html.matches("a2.0 2.0 0 1 0 4.0 0").count();
    assert_eq!(circles(&html) - circles(&plain), 2 * 4, "points and origin, on screens of two widths");
}

/// A wall is pushed once to either side of its two ties: one that lasts, and one that breaks.
#[test]
fn a_tie_is_drawn_slack_pulling_yielding_and_broken() {
    let tied = |scene: &mut Scene, ultimate: &str| {
        for (name, value) in [
            ("u_start", "0"),
            ("u_dot_start", "0.4"),
            ("tie_height", "3"),
            ("tie_stiffness", "2e5"),
            ("tie_strength", "2e3"),
            ("tie_slack", "0.01"),
            ("tie_ultimate", ultimate),
            ("tie_side", "both"),
        ] {
            scene.set(name, value).unwrap();
        }
        scene.output_step = 0.002;
        scene.stop_time = 5.0;
    };
    let states = |html: &str| -> Vec<Vec<u64>> {
        let data = html.split("id=\"data\">").nth(1).and_then(|rest| rest.split("</script>").next()).unwrap();
        let data: serde_json::Value = serde_json::from_str(data).unwrap();
        let sides = data["ties"][0]["sides"].as_array().unwrap().iter();
        let numbers = |side: &serde_json::Value| side["state"].as_array().unwrap().clone();
        sides.map(|side| numbers(side).iter().map(|state| state.as_u64().unwrap()).collect()).collect()
    };
    let in_turn = |mut states: Vec<u64>| {
        states.dedup();
        states
    };
    let lasts = page(|scene| tied(scene, "1"));
    let [outwards, _] = &states(&lasts)[..] else { panic!("two ties") };
    // slack, pulling, yielding, unloading, slack
    assert_eq!(in_turn(outwards.clone())[..5], [0, 1, 2, 1, 0]);
    assert!(lasts.contains("Its tie yields and gets ") && lasts.contains("<span>yields</span>"));
    assert!(lasts.contains("id=\"tie_force\"") && lasts.contains("id=\"tie_elongation\""));
    assert!(lasts.contains("0.2 kN/mm at 3 m, yields at 2 kN, breaks 1000 mm later"));

    let torn = page(|scene| tied(scene, "0.01"));
    assert_eq!(in_turn(states(&torn)[0].clone()), [0, 1, 2, 3]);
    assert!(torn.contains(" A tie breaks at 0.") && torn.contains("<span>breaks</span>"));
    let brittle = page(|scene| tied(scene, "0"));
    assert_eq!(in_turn(states(&brittle)[0].clone()), [0, 1, 3]);
    assert!(!brittle.contains("<span>yields</span>") && brittle.contains(", breaks at 2 kN"));
    // an elastic tie is drawn, too, and has no elongation
    let elastic = page(|scene| tied(scene, "-1"));
    assert_eq!(in_turn(states(&elastic)[0].clone())[..3], [0, 1, 0]);
    assert!(elastic.contains("id=\"tie_force\"") && !elastic.contains("id=\"tie_elongation\""));
}

fn page_of(text: &str) -> (String, serde_json::Value) {
    let mut scene = Scene::parse("scene.toml", text, std::path::Path::new(".")).unwrap();
    scene.stop_time = 3.0;
    let response = Response::of(&scene).unwrap();
    let html = render(&scene, &Wall::new(&scene.parameters).unwrap(), &response).unwrap();
    let data = html.split("id=\"data\">").nth(1).and_then(|rest| rest.split("</script>").next()).unwrap();
    let data = serde_json::from_str(data).unwrap();
    (html, data)
}

/// Parts and loads move; toes and the height of u are those of the body, not of its rectangle.
#[test]
fn a_body_of_parts_moves_with_its_loads() {
    let near = |found: &serde_json::Value, expected: f64| {
        assert!((found.as_f64().unwrap() - expected).abs() < 1e-9, "{found} for {expected}");
    };
    let (html, data) = page_of(include_str!("../../../../scenes/bodies/facade.toml"));
    let moving = html.split("id=\"lower\"").nth(1).and_then(|rest| rest.split("</svg>").next()).unwrap();
    let found = ["class=\"body\"", "class=\"force\"", "class=\"force thrust\""];
    assert_eq!(found.map(|class| moving.matches(class).count()), [1, 3, 2]);
    near(&data["shape"]["toes"][0], 0.3);
    near(&data["shape"]["toes"][1], -0.3);
    assert!(html.contains("The wall to scale"));

    let (_, data) = page_of(include_str!("../../../../scenes/bodies/gable.toml"));
    near(&data["shape"]["centroid"], 0.8);
    let (_, data) = page_of(include_str!("../../../../scenes/bodies/battered_wall.toml"));
    // full rotations turn the centroid about either toe: 0.2958 m from the outer one, of 0.5 m
    near(&data["shape"]["arms"][0], 0.295_833_333_333);
    near(&data["shape"]["arms"][1], 0.5 - 0.295_833_333_333);
    // the hinge is where the upper, thinner part stands: for u > 0 about its inner edge
    let (_, data) = page_of(include_str!("../../../../scenes/bodies/stepped_strip.toml"));
    near(&data["shape"]["edges"][0], -0.2);
    near(&data["shape"]["edges"][1], 0.05);
    let bodies = data["shape"]["bodies"].as_array().unwrap();
    assert!(bodies.iter().all(|parts| parts.as_array().unwrap().len() == 1), "{bodies:?}");

    let rectangle = page(|_| {});
    assert!(rectangle.contains("\"shape\":null") && !rectangle.contains("The wall to scale"));
}

/// A rigid body of parts is compared with itself in full rotations, which no thickness varies.
#[test]
fn a_body_is_compared_with_its_full_rotations() {
    let chimney = include_str!("../../../../scenes/bodies/chimney.toml");
    let rigid = "[impact]\nimpact = \"restitution\"\n[damping]\ndamping_model = \"none\"\n\
                 [force_law]\nforce_law = \"rigid_linear\"\n[start]\nu_start = 0.15\n[geometry]\n";
    let parts = chimney.split("[[geometry.part]]").skip(1).map(|part| format!("[[geometry.part]]{part}"));
    let body = parts.collect::<String>().split("[force_law]").next().unwrap().to_owned();
    let (html, data) = page_of(&format!("{rigid}{body}"));
    assert!(html.contains("Full rotations (blue) and small ones"), "{html}");
    assert!(html.contains("the time from rest at 0.50 u_ins to u = 0 is 3.") && !html.contains("NaN"));
    assert!(!html.contains("Period with small rotations") && data["full"] == false);
    let (_, data) = page_of(&format!("{rigid}kinematics = \"trigonometric\"\n{body}"));
    assert_eq!(data["full"], true);
}

#[test]
fn the_restitution_shown_is_one_that_matters() {
    assert!(page(|_| {}).contains("none; the damping stands for e = 0.936"));
    let given = page(|scene| scene.set("xi", "0.03").unwrap());
    assert!(given.contains("<td>impact</td><td>none</td>"));
}

#[test]
fn an_empty_response_is_refused() {
    let scene = Scene::default();
    let mut response = Response::of(&scene).unwrap();
    response.samples.clear();
    let wall = Wall::new(&scene.parameters).unwrap();
    assert!(render(&scene, &wall, &response).unwrap_err().to_string().contains("empty"));
}

/// The cursor's place is computed from the margins of the plot: the first and last points of a line must
/// lie there.
#[test]
fn the_cursor_lines_up_with_the_time_axis() {
    let points: Vec<_> = (0..=10).map(|index| (f64::from(index), 0.1 * f64::from(index))).collect();
    let figure = history(&points, 10.0);
    let svg = figure.svg();
    let path = svg.split("<path").find(|part| part.contains("#1f5fa8")).expect("the line");
    let data = path.split(" d=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("its path");
    let numbers: Vec<f64> = data
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|word| word.parse().ok())
        .collect();
    let [left, right, top, bottom] = figure.area();
    let [_, _, low, high] = figure.ranges();
    let height = 250.0;
    let expected_y = |value: f64| height * (bottom - (bottom - top) * (value - low) / (high - low));
    // the path has hundredths of a pixel
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 0.02, "{found} for {expected}");
    near(numbers[0], left * WIDTH);
    near(numbers[1], expected_y(0.0));
    near(numbers[numbers.len() - 2], right * WIDTH);
    near(numbers[numbers.len() - 1], expected_y(1.0));
}
