//! Tests `wall describe`.

use crate::command_line::{assert_has, content, fails, folder, json, printed, refused, succeed};

#[test]
fn describe_writes_the_curve() {
    let folder = folder("capacity");
    let arguments = ["describe", "--thresholds", "0.4,1", "--csv", "c.csv", "--plot", "c.svg"];
    let table = printed(&folder, &arguments);
    // 2π √(2/3) / 1.918 rad/s
    assert_has(&table, &["u > 0  limit_state", "T_sec [s]", "2.67476"]);
    let csv = content(&folder, "c.csv");
    let kinds: Vec<_> = csv.lines().skip(1).map(|line| line.split(',').nth(1).unwrap()).collect();
    assert_eq!(kinds, ["corner", "corner", "corner", "limit_state", "limit_state"]);
    assert!(content(&folder, "c.svg").contains("0.4 u_ins, T = 2.675 s"));
    // legends name the limit state as it was given: 0.1 u_ins/u_ins is 0.09999999999999999 here
    let strip = crate::root().join("scenes/strip_between_floors.toml").display().to_string();
    succeed(&folder, &["describe", &strip, "--set", "thickness=0.41", "--plot", "d.svg"]);
    let svg = content(&folder, "d.svg");
    assert!(svg.contains(">0.1 u_ins, T = ") && svg.contains(">0.4 u_ins, T = "));
    let json = json(&folder, &["describe", "--json"]);
    let limits = json["capacity"][0]["limit_states"].as_array().unwrap();
    assert_eq!(limits.len(), 4);
    assert!(limits[3]["secant_period"].is_null());
    let folder = crate::command_line::folder("capacity_refused");
    refused(&folder, &["describe", "--thresholds", "2"], &["thresholds", "2"]);
    fails(&folder, &["describe", "--csv", "c.csv", "--plot", "c.jpg"], &["c.jpg", "ends in .svg"]);
}

/// A capacity curve is told and drawn over its law, and no output replaces its file. A study reads it beside
/// itself; a check by a code needs a geometry.
#[test]
fn describe_draws_a_capacity_curve_over_its_law() {
    let folder = folder("pushover");
    let example = crate::root().join("examples/capacity_curve.csv");
    std::fs::copy(example, folder.join("curve.csv")).unwrap();
    let law = "file = \"curve.csv\"\ncurve_tolerance = 0.02\n";
    let scene = format!("[geometry]\nheight = 4\nthickness = 0.25\n[force_law]\nat_height = 4.0\n{law}");
    std::fs::write(folder.join("scene.toml"), &scene).unwrap();
    let text = printed(&folder, &["describe", "scene.toml", "--plot", "c.svg"]);
    assert_has(
        &text,
        &["force_law", "multilinear", "of 15 points, ΔF at most", "% of the largest F of its side, at u = "],
    );
    let kept = text.split_once(" of the largest F").unwrap().0.rsplit("  ").next().unwrap();
    assert!(content(&folder, "c.svg").contains(&format!(">as given: {kept}<")), "{kept}");
    let json = json(&folder, &["describe", "scene.toml", "--json"]);
    assert!(json["curve"].as_str().unwrap().contains(" of 15 points"));
    fails(&folder, &["describe", "scene.toml", "--csv", "curve.csv"], &["curve.csv"]);
    let run = printed(&folder, &["simulate", "scene.toml", "--synthetic", "--html", "page.html"]);
    assert!(run.contains("\ncurve          ") && content(&folder, "page.html").contains("capacity curve"));
    let oscillator =
        format!("[force_law]\n{law}oscillator = {{ effective_mass = 800, participation = 1.2 }}\n");
    let check = "xi = 0.05\n[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\nbefore_activation = \"law\"\n\
                 SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n";
    std::fs::write(folder.join("check.toml"), format!("{oscillator}[damping]\n{check}")).unwrap();
    let words =
        "height, thickness, density not stated: a check needs a wall with a geometry, and an oscillator";
    fails(&folder, &["check", "check.toml"], &[words]);
    let other = printed(&folder, &["describe", "scene.toml", "--set", "force_law=bilinear"]);
    assert!(other.contains("bilinear") && !other.contains("curve "), "{other}");
    let walls = scene.replace("[geometry]", "[[walls]]\nname = \"a\"\n[walls.geometry]");
    let walls = walls.replace("[force_law]", "[walls.force_law]");
    let check = check.replace("xi = 0.05\n", "");
    std::fs::write(
        folder.join("walls.toml"),
        walls.replace("thickness", "density = 1800\nthickness") + &check,
    )
    .unwrap();
    printed(&folder, &["check", "walls.toml"]);
    fails(&folder, &["check", "walls.toml", "--csv", "curve.csv"], &["curve.csv"]);
}

/// A formula of restitution that is far from the impulses of an impact is said, where it counts.
#[test]
fn describe_says_where_restitution_is_doubtful() {
    let folder = folder("doubtful_restitution");
    let strip = ["describe", "--set", "mechanism=vertical_spanning", "--set", "thickness=0.25", "--set"];
    let told = |more: &[&str]| printed(&folder, &[&strip[..], more].concat());
    let words = "restitution_source = calibrated gives e = 0.794, the impulses of an impact 0.625";
    assert!(told(&["height=2"]).contains(words));
    // slender, given, by impulses, and of no effect
    for more in [
        &["height=3.5"][..],
        &["height=2", "--set", "restitution=0.8"],
        &["height=2", "--set", "restitution_source=impulses"],
        &["height=2", "--set", "xi=0.05"],
    ] {
        assert!(!told(more).contains("the impulses of an impact"), "{more:?}");
    }
}

#[test]
fn describe_draws_the_wall() {
    let folder = folder("drawn_wall");
    let scene = crate::root().join("scenes/bodies/facade.toml").display().to_string();
    let text = printed(&folder, &["describe", &scene, "--drawing", "wall.svg"]);
    assert!(text.ends_with("written wall.svg\n"), "{text}");
    let svg = content(&folder, "wall.svg");
    assert_has(&svg, &["h = 9.6 m", "12 kN at 3.2 m", "thrust 1 kN", "W = 102 kN at 4.8 m"]);
    fails(&folder, &["describe", "--drawing", "wall.png"], &["wall.png", "ends in .svg"]);
    fails(&folder, &["describe", "--plot", "a.svg", "--drawing", "a.svg"], &["the output a.svg"]);
}

/// The part of the tie that gives way first is told, with the places where the tie changes.
#[test]
fn a_tie_of_a_bar_is_described() {
    let folder = folder("described_tie");
    let scene = crate::root().join("scenes/tied_facade.toml").display().to_string();
    let text = printed(&folder, &["describe", &scene]);
    assert_has(&text, &["of its bar, which yields first", "tie_strength", "15749.9 N", "0.0617647 m"]);
    let of_anchor = ["describe", &scene, "--json", "--set", "bar_anchor_capacity=30e3"];
    let json = json(&folder, &of_anchor);
    assert_eq!(json["tie"], "of its anchor, which breaks before the bar yields");
    assert_eq!(json["tie_strength"].as_f64(), Some(10e3));
    let both = ["describe", &scene, "--set", "bar_spacing=-3"];
    refused(&folder, &both, &["bar_spacing = -3 m must be above 0"]);
}
