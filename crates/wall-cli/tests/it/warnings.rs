//! Tests what the program warns of: numbers that walls and motions rarely have, and studies that take long.

use std::collections::BTreeSet;

use rocking_wall::variables::DampingModel;
use rocking_wall::wall::{Parameters, Ratio, Wall, usage};
use scene::GROUPS;

use crate::command_line::{assert_has, content, fails, folder, json, printed, setting, succeed, text};

/// Runs `arguments` and returns what the program warns of.
fn warned(arguments: &[&str]) -> String {
    // it writes no file; a folder that each of these tests cleared would vanish under the others
    text(&succeed(crate::root(), arguments).stderr)
}

#[test]
fn improbable_walls_are_warned_of() {
    let arguments = setting("simulate --stop-time 0.1", "density=1.8");
    assert_has(&warned(&arguments), &["density = 1.8 kg/m3 is unusual"]);
    // usual walls are silent
    assert_eq!(warned(&["simulate", "--stop-time", "0.1"]), "");
}

/// A check of a wall whose force law is a curve in another unit says so. A warning of another kind is not
/// lost among ten of one.
#[test]
fn doubts_of_curves_are_told_in_checks_and_tables() {
    let folder = folder("doubtful_curves");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let wall = "[geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n\
                [force_law]\ncurve = [[0.02, 1e6], [0.2, 0.0]]\n";
    let check = "[check]\ncode = \"fractions\"\nspectrum = [[0, 1], [4, 1]]\nunit = \"m/s2\"\n";
    write("check.toml", &format!("{wall}{check}"));
    write("wall.toml", wall);
    let doubt = "the largest F is 353.947 F0 of the geometry, not 0.1 to 3: check the unit";
    assert_has(&text(&succeed(&folder, &["check", "check.toml"]).stderr), &[doubt]);
    let rows: Vec<_> = (0..10).map(|k| format!("{k},wall.toml,\n")).collect();
    write("walls.csv", &format!("name,scene,height\n{}thick,wall.toml,5\n", rows.concat()));
    write(
        "study.toml",
        "models = [\"CR\"]\nlevels = { method = \"grid\", values = [0.1] }\n\
         records = { synthetic = { count = 1 } }\nwalls = [{ table = \"walls.csv\" }]\n",
    );
    let told = text(&succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]).stderr);
    assert_eq!(told.matches(doubt).count(), 7, "{told}");
    assert_has(&told, &["wall \"thick\": the curve is scaled with F0 and u_ins", "3 more messages\n"]);
}

/// 3000 m/s² are 305.9 g.
#[test]
fn motions_stronger_than_any_record_are_warned_of() {
    let folder = folder("strong_motions");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("s.toml", "[motion]\nsynthetic = {}\npga = 3000\n");
    let top = "geometry = { mechanism = \"vertical_spanning\" }\n[motion]\nrecord = \"r.csv\"\n";
    write("top.toml", &format!("{top}top = {{ record = \"r.csv\", scale = 1000 }}\n"));
    write("pulse.toml", "[motion]\nsine_cycle = { amplitude = 3000, frequency = 1 }\n");
    write("r.csv", "t [s],a [m/s2]\n0,0\n0.1,3\n0.2,-3\n0.3,0\n");
    let walls = "[[walls]]\nname = \"a\"\ngeometry = { height = 2, thickness = 0.3 }\n";
    let study = |levels: &str| {
        format!(
            "models = [\"CDC\"]\nintensity = {{ measure = \"PGA\" }}\n\
             levels = {{ unit = \"m/s2\", {levels} }}\n\
             records = {{ synthetic = {{ count = 1, duration = 10, step = 0.02 }} }}\n{walls}"
        )
    };
    write("grid.toml", &study("method = \"grid\", values = [1, 3000]"));
    write("hunt.toml", &study("method = \"hunt\", first = 3000, increase = 1, top = 9000"));
    write("step.toml", &study("method = \"step\", step = 3000, top = 9000"));
    write("usual.toml", &study("method = \"step\", step = 3, top = 3000"));
    let tied = ["--set", "tie_height=3", "--stiffness", "1e5"];
    let cases: [&[&str]; 14] = [
        &["simulate", "--synthetic", "--pga", "3000"],
        &["simulate", "--record", "r.csv", "--scale", "1000"],
        &["simulate", "--records", "r.csv", "--pga", "3000"],
        &["simulate", "s.toml", "--stop-time", "1"],
        &["simulate", "top.toml", "--stop-time", "0.3"],
        &["simulate", "pulse.toml"],
        &["study", "spectrum", "s.toml", "--heights", "1:2:2", "--ratios", "5:6:2"],
        &["record", "--synthetic", "--pga", "3000", "--samples", "m.csv"],
        &[&["study", "tie", "--records", "r.csv", "--scale", "1000"][..], &tied].concat(),
        &["study", "ida", "grid.toml", "--output", "grid"],
        &["study", "ida", "hunt.toml", "--output", "hunt"],
        &["study", "ida", "step.toml", "--output", "step"],
        // usual ones
        &["simulate", "--synthetic", "--pga", "29"],
        &["study", "ida", "usual.toml", "--output", "usual"],
    ];
    for (index, arguments) in cases.into_iter().enumerate() {
        let message = text(&succeed(&folder, arguments).stderr);
        let told = message.matches("a peak of 3000.0 m/s² is 305.9 g").count();
        assert_eq!(told, usize::from(index < 12), "{arguments:?}: {message}");
        assert_eq!(message.contains("check its scale"), index < 12, "{arguments:?}: {message}");
    }
}

/// Lists damping models as conditions do.
fn one_of<'a>(models: impl Iterator<Item = &'a DampingModel>) -> String {
    let names: Vec<_> = models.map(|model| model.name()).collect();
    let (last, others) = names.split_last().unwrap();
    if others.is_empty() { (*last).to_owned() } else { format!("{} or {last}", others.join(", ")) }
}

/// A parameter that is set counts, or is named in a warning with what would make it count.
#[test]
fn a_parameter_without_effect_is_warned_of() {
    let with_xi = DampingModel::ALL.iter().filter(|model| model.ratio() == Some(Ratio::Xi));
    let is_curved = |model: &&DampingModel| {
        let parameters = Parameters { damping_model: **model, ..Parameters::default() };
        !Wall::new(&parameters).unwrap().has_constant_damping()
    };
    let ratio = &*format!("damping_model = {}", one_of(with_xi.clone()));
    let with_c_bar = DampingModel::ALL.iter().filter(|model| model.ratio() == Some(Ratio::CBar));
    let constant = &*format!("damping_model = {}", one_of(with_c_bar));
    let block = format!("c_bar = -1 and {constant}");
    let mut named = BTreeSet::new();
    for (changes, name, condition) in [
        ("damping_model=none xi=0.2", "xi", ratio),
        ("c_bar=0.2", "c_bar", constant),
        (
            "xi=0.05 restitution=0.9",
            "restitution",
            &format!("impact = restitution, or xi = -1 and {ratio}, or {block}"),
        ),
        (
            // restitution is -1 here: what else it takes is told too
            "xi=0.05 restitution_source=analytic",
            "restitution_source",
            &format!(
                "restitution = -1 and impact = restitution, or restitution = -1 and xi = -1 and {ratio}, or \
                 restitution = -1 and {block}"
            ),
        ),
        ("hinge_ratio=0.6", "hinge_ratio", "mechanism = vertical_spanning"),
        ("overburden_eccentricity=0.1", "overburden_eccentricity", "overburden is not 0"),
        (
            "overburden=3000 eccentricity_mode=follows_pivot",
            "eccentricity_mode",
            "overburden_eccentricity is not 0 and overburden is not 0",
        ),
        ("force_law=rigid_linear damping_model=none a1=0.05", "a1", "force_law = bilinear or trilinear"),
        ("d1=0.7", "d1", "force_law = trilinear"),
        ("softening=chord", "softening", "a3 is not 1"),
        ("tie_height=3", "tie_height", "tie_stiffness is not 0"),
        ("tie_slack=0.01", "tie_slack", "tie_stiffness is not 0"),
        ("tie_strength=1000", "tie_strength", "tie_stiffness is not 0"),
        ("tie_side=both", "tie_side", "tie_stiffness is not 0"),
        ("tie_ultimate=0.1", "tie_ultimate", "tie_strength is not 0 and tie_stiffness is not 0"),
        (
            "damping_model=constant_coefficient tolerance=1e-10",
            "tolerance",
            &format!(
                "solver = adaptive, or solver = automatic and damping_model = {}",
                one_of(with_xi.clone().filter(is_curved))
            ),
        ),
        ("newmark_step=1e-4", "newmark_step", "solver = newmark"),
    ] {
        assert_warned(changes, name, condition);
        named.insert(name);
    }
    for (changes, name, condition) in of_bodies() {
        assert_warned(&changes, name, &condition);
        named.insert(name);
    }
    // the list is complete: a new condition needs a line here
    let conditional = usage(&Parameters::default()).filter(|usage| !usage.condition.is_empty());
    let parameters = GROUPS.iter().flat_map(|(_, names)| names.iter().copied());
    let parameters: BTreeSet<_> = parameters.collect();
    let conditional: BTreeSet<_> = conditional.map(|usage| usage.name).collect();
    assert_eq!(named, &conditional & &parameters);
}

/// Checks that a parameter is warned of, and where it counts.
fn assert_warned(changes: &str, name: &str, condition: &str) {
    let told = warned(&setting("simulate --stop-time 0.1", changes));
    let expected = format!("{name} is set and has no effect: it counts where {condition}\n");
    assert!(told.ends_with(&expected), "{told}\n{expected}");
}

/// The parameters of a rectangle and of a rigid body, where the wall is the other.
fn of_bodies() -> impl Iterator<Item = (String, &'static str, String)> {
    let body = "mechanism = rigid_body";
    let of_rectangle = ["thickness", "width", "density"].map(|name| {
        let changes = format!("mechanism=rigid_body restitution=0.9 {name}=2");
        (changes, name, "mechanism = parapet or vertical_spanning".to_owned())
    });
    let of_body =
        ["body_mass", "centroid_height", "inertia", "arm", "arm_inner", "load_force", "load_mass", "thrust"];
    let of_body = of_body.map(|name| (format!("{name}=10"), name, body.to_owned()));
    let of_loads = [
        ("load_height", "load_force"),
        ("load_arm", "load_force"),
        ("load_mass_height", "load_mass"),
        ("load_inertia", "load_mass"),
        ("thrust_height", "thrust"),
    ];
    let of_loads =
        of_loads.map(|(name, of)| (format!("{name}=0.1"), name, format!("{of} is not 0 and {body}")));
    of_rectangle.into_iter().chain(of_body).chain(of_loads)
}

/// A number that is set is the one in use, whatever the start values are.
#[test]
fn a_number_that_is_given_counts() {
    let used = |changes: &str| {
        let facts = json(&folder("given"), &setting("describe --json", changes));
        ["xi_used", "restitution_used"].map(|name| facts[name].as_f64().unwrap())
    };
    assert_eq!(used("xi=0.2")[0], 0.2);
    assert_eq!(used("xi=0")[0], 0.0);
    // Eq. (21) with a1 = 0.03 and the calibrated e
    let [xi, e] = used("");
    assert!((xi + 0.350 * 0.03_f64.powf(0.074) * e.ln()).abs() < 1e-15, "{xi} {e}");
    assert_eq!(used("xi=-1"), [xi, e]);
    assert_eq!(used("damping_model=none impact=restitution restitution=0.8")[1], 0.8);
    // a given e is behind the computed damping, too
    assert!((used("restitution=0.8")[0] + 0.350 * 0.03_f64.powf(0.074) * 0.8_f64.ln()).abs() < 1e-15);
}

/// The default start of 0.18 m is beyond u_ins of a wall 0.25 m thick, 0.125 m.
#[test]
fn a_start_beyond_u_ins_is_refused() {
    let folder = folder("start_beyond");
    let remedy = "u_start = 0.18 m is beyond u_ins = 0.125000 m: set u_start = 0 for a wall that is at rest";
    fails(&folder, &["simulate", "--set", "thickness=0.25"], &[remedy]);
    // what does not move has no start
    assert_eq!(warned(&["describe", "--set", "thickness=0.25"]), "");
    assert_eq!(warned(&["simulate", "--set", "thickness=0.37", "--stop-time", "1"]), "");
}

/// A strip wall whose supports have motions of their own shows both, and both peaks.
#[test]
fn two_motions_are_both_shown() {
    let folder = folder("two_motions");
    let record = |name: &str, peak: f64| {
        let sample = |k: u32| format!("{:.2},{}\n", 0.01 * f64::from(k), peak * f64::from(k % 3) / 2.0);
        let rows: String = (0..300).map(sample).collect();
        std::fs::write(folder.join(name), format!("time,a_g\n{rows}")).unwrap();
    };
    record("bottom.csv", 0.25);
    record("top.csv", 0.75);
    let scene = "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3\nthickness = 0.3\n\
                 [motion]\nrecord = \"bottom.csv\"\nunit = \"m/s2\"\n\
                 [motion.top]\nrecord = \"top.csv\"\nunit = \"m/s2\"\n";
    std::fs::write(folder.join("strip.toml"), scene).unwrap();
    let summary = printed(&folder, &["simulate", "strip.toml", "--html", "page.html"]);
    assert_has(&summary, &["0.2500 m/s² (bottom), 0.7500 m/s² (top)"]);
    let page = content(&folder, "page.html");
    let motion = page.split("<figure>").find(|figure| figure.contains("id=\"motion\"")).unwrap();
    assert_has(motion, &["bottom (grey), top (amber)"]);
    for color in [report::palette::DARK_GREY, report::palette::AMBER] {
        assert!(motion.contains(&format!("stroke=\"{color}\"")), "no {color} in {motion}");
    }
}

/// Writes a study into a folder of its own and returns what `wall study ida` warns of.
fn warned_of_study(name: &str, study: &str) -> String {
    let folder = folder(name);
    std::fs::write(folder.join("study.toml"), study).unwrap();
    text(&succeed(&folder, &["study", "ida", "study.toml"]).stderr)
}

/// The PGA at which a rigid wall starts to rock hardly depends on the record; that of its collapse does.
/// Their own curves cross below all levels, with a common β they are rough.
#[test]
fn contradictions_of_a_common_beta_and_crossings_are_warned_of() {
    let study = |fractions: &str, beta: &str| {
        format!(
            "models = [\"CR rigid\"]\nintensity = {{ measure = \"PGA\" }}\n\
             report = {{ fractions = {fractions}, beta = \"{beta}\" }}\n\
             records = {{ synthetic = {{ count = 8, duration = 10 }} }}\n\
             levels = {{ method = \"hunt\", first = 0.02, increase = 0.1, top = 4, gap = 0.1 }}\n\
             [[walls]]\nname = \"parapet\"\ngeometry = {{ height = 3, thickness = 0.3 }}\n"
        )
    };
    let message = warned_of_study("contradicted", &study("[0.001, 1]", "common"));
    let words = [
        "warning: limit states contradict a common beta in 1 of 1 fits",
        ": wall \"parapet\" with CR rigid; their fitted curves are rough",
        "see the steps on the page and beta_alone in fragilities.csv",
    ];
    assert_has(&message, &words);
    let alike = warned_of_study("not_contradicted", &study("[0.9, 1]", "common"));
    assert!(!alike.contains("beta"), "{alike}");
    let crossing = warned_of_study("crossing", &study("[0.05, 0.4, 1]", "own"));
    let words = [
        "warning: curves of limit states cross by up to 0.",
        " of P in 1 of 1 fits: wall \"parapet\" with CR rigid, see",
    ];
    assert_has(&crossing, &words);
    assert_has(
        &crossing,
        &["crossing_excess in fragilities.csv", "beta = \"ordered\" fits curves that do not cross"],
    );
    // by 0.001 of P is not worth a word
    let slight = warned_of_study("slight", &study("[0.001, 0.01, 0.1, 1]", "own"));
    assert!(!slight.contains("cross"), "{slight}");
    let ordered = warned_of_study("ordered", &study("[0.05, 0.4, 1]", "ordered"));
    assert!(!ordered.contains("cross"), "{ordered}");
}

/// Steps of Newmark and elastic frequencies that make a study slow are named before its runs.
#[test]
fn a_study_warns_of_much_work() {
    // each run overturns within the first steps
    let study = |wall: &str| {
        format!(
            "models = [\"CR\"]\nlevels = {{ method = \"grid\", values = [50] }}\n\
             records = {{ synthetic = {{ count = 2, duration = 10 }} }}\n\
             [[walls]]\nname = \"slow\"\n{wall}\n"
        )
    };
    let message = warned_of_study("work_stiff", &study("force_law = { a1 = 1e-9 }"));
    assert_has(&message, &["warning: wall \"slow\": omega1 = ", "computing takes as much longer than usual"]);
    assert_has(&message, &["warning: 2 records: studentised intervals need 6; those of θ, β and what"]);
}

/// A ratio in per cent is unusual in a study, too.
#[test]
fn a_study_warns_of_an_unusual_ratio() {
    let message = warned_of_study(
        "percent",
        "models = [\"CR\", { model = \"CDC\", xi = 5 }]\nlevels = { method = \"grid\", values = [0.1] }\n\
         records = { synthetic = { count = 1 } }\n[[walls]]\nname = \"a\"\n",
    );
    assert_eq!(message.matches("is unusual").count(), 1, "{message}");
    assert_has(&message, &["model \"CDC 5\": xi = 5 is unusual: 0 to 0.5 is usual"]);
}

/// A study shakes its walls with its own records.
#[test]
fn a_study_says_that_it_ignores_a_motion() {
    let folder = folder("ignored_motion");
    std::fs::write(folder.join("shaken.toml"), "[motion]\nsynthetic = {}\n").unwrap();
    let study = "models = [\"CR\"]\nlevels = { method = \"grid\", values = [0.1] }\n\
                 records = { synthetic = { count = 1, duration = 10 } }\n\
                 [[walls]]\nscene = \"shaken.toml\"\n\
                 [[walls]]\nname = \"light\"\ngeometry = { density = 1.8 }\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let message = text(&succeed(&folder, &["study", "ida", "study.toml"]).stderr);
    let shaken = "wall \"shaken\": the study ignores the motion of its scene";
    assert_has(&message, &[shaken, "wall \"light\": density = 1.8 kg/m3 is unusual"]);
}

/// A run warns of a vertical record, from the command line or a scene.
#[test]
fn vertical_records_are_warned_of() {
    let folder = folder("vertical_record");
    let up = crate::specimen::at2(&crate::specimen::SAMPLES).replace(", 90\n", ", UP\n");
    std::fs::write(folder.join("a.AT2"), up).unwrap();
    std::fs::write(folder.join("s.toml"), "[motion]\nrecord = \"a.AT2\"\n").unwrap();
    for arguments in [&["simulate", "--record", "a.AT2"][..], &["simulate", "s.toml"]] {
        let told = text(&succeed(&folder, arguments).stderr);
        assert_has(&told, &["warning: ", "vertical: this component is vertical", "use a horizontal one"]);
    }
}
