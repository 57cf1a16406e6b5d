//! Samples of uncertain parameters: strata, correlations, messages, and what explains a number.

use std::collections::BTreeMap;

use fragility::cumulative;
use ground_motion::{Pulse, Shape};
use rocking_wall::wall::Parameters;
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::codes::NoCodes;
use study::document::StudyFile;
use study::folder::Contents;
use study::loaded::LoadedStudy;
use study::uncertain::{Uncertain, hypercube, pearson_of_spearman, rank_correlation, sensitivities};

use crate::folders::{load, number, rows, run_analysis as run};

fn with(uncertain: &str) -> String {
    format!(
        "models = [\"CR\"]\nlevels = {{ method = \"step\", step = 0.4, top = 2 }}\n\
         records = {{ synthetic = {{ count = 2, duration = 10, step = 0.02 }} }}\n\
         walls = [{{ name = \"a\", geometry = {{ height = 3, thickness = 0.3 }} }}]\n[uncertain]\n{uncertain}"
    )
}

fn read(uncertain: &str) -> Uncertain {
    StudyFile::parse("study.toml", &with(uncertain), &NoCodes).unwrap().uncertain.unwrap().0
}

fn column(rows: &[Vec<f64>], place: usize) -> Vec<f64> {
    rows.iter().map(|row| row[place]).collect()
}

/// Each n-th of each distribution has one sample, also of correlated and truncated ones.
#[test]
fn each_stratum_has_one_sample() {
    let uncertain = read(
        "samples = 40\ncorrelation = [[\"height\", \"thickness\", -0.6]]\n[uncertain.parameters]\n\
         height = { normal = [3, 0.2] }\nthickness = { lognormal = [0.3, 0.1] }\n\
         a1 = { uniform = [0.02, 0.1] }\ndensity = { triangular = [1500, 1800, 2000] }\n\
         overburden = { normal = [1000, 1000] }\nrestitution = { values = [0.8, 0.9], weights = [1, 3] }\n",
    );
    let rows = uncertain.rows().unwrap();
    let names: Vec<_> = uncertain.parameters.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["a1", "density", "height", "overburden", "restitution", "thickness"]);
    let below = cumulative(-1.0);
    let triangular = |x: f64| {
        if x < 1800.0 { (x - 1500.0).powi(2) / 150_000.0 } else { 1.0 - (2000.0 - x).powi(2) / 100_000.0 }
    };
    let parts: [&dyn Fn(f64) -> f64; 6] = [
        &|x| (x - 0.02) / 0.08,
        &triangular,
        &|x| cumulative((x - 3.0) / 0.2),
        &|x| (cumulative((x - 1000.0) / 1000.0) - below) / (1.0 - below),
        &|_| f64::NAN,
        &|x| cumulative((x / 0.3).ln() / 0.1),
    ];
    for (place, part) in parts.iter().enumerate().filter(|(place, _)| *place != 4) {
        let mut strata: Vec<f64> = rows.iter().map(|row| (40.0 * part(row[place])).floor()).collect();
        strata.sort_by(f64::total_cmp);
        assert!(strata.into_iter().eq((0..40).map(f64::from)), "{}", names[place]);
    }
    assert_eq!(rows.iter().filter(|row| row[4] == 0.8).count(), 10);
}

/// Normal scores have the wanted correlation to a rounding. Of independent ranks Spearman's correlation then
/// scatters by √(1 − (3/π)²)/√n = 0.3/√n, since its own correlation with that of normal scores is 3/π; of
/// correlated ones by less. Four of these are allowed.
#[test]
fn ranks_have_their_correlation() {
    for (samples, wanted) in [(30, 0.5), (100, -0.7), (1000, 0.9), (1000, 0.0)] {
        let r = pearson_of_spearman(wanted);
        let matrix = [vec![1.0, r, 0.0], vec![r, 1.0, 0.0], vec![0.0, 0.0, 1.0]];
        for seed in 1..=5 {
            let parts = hypercube(samples, &matrix, seed).unwrap();
            let allowed = 1.2 / (samples as f64).sqrt();
            for (a, b, wanted) in [(0, 1, wanted), (0, 2, 0.0), (1, 2, 0.0)] {
                let found = rank_correlation(&parts[a], &parts[b]).unwrap();
                assert!((found - wanted).abs() < allowed, "{samples} {seed}: {found} is not {wanted}");
            }
        }
    }
}

/// The distribution decides, not the samples: one that reaches near 0 is taken itself.
#[test]
fn a_logarithm_is_taken_of_what_is_far_from_zero() {
    for (distribution, is_logarithmic) in [
        ("{ lognormal = [0.05, 1.0] }", true),
        ("{ normal = [0.05, 0.01] }", true),
        // a thousandth is below 0.05 − 3.09·0.018, cut off at 0
        ("{ normal = [0.05, 0.018] }", false),
        ("{ normal = [0.05, 0.05], within = [0.001, 0.2] }", false),
        // a sample of many may be below 0 where the parameter has no limit there
        ("{ normal = [0.05, 0.0145] }", true),
        ("{ uniform = [0.02, 0.1] }", true),
        ("{ uniform = [0.002, 0.1] }", false),
        ("{ values = [0.02, 0.1] }", true),
        ("{ values = [0.001, 0.1] }", false),
    ] {
        let uncertain = read(&format!("samples = 9\n[uncertain.parameters]\na1 = {distribution}\n"));
        assert_eq!(uncertain.parameters[0].1.is_logarithmic(), is_logarithmic, "{distribution}");
    }
    let text = "samples = 9\n[uncertain.parameters]\noverburden_eccentricity = { normal = [0.05, 0.0145] }\n";
    assert!(!read(text).parameters[0].1.is_logarithmic(), "it may be below 0");
}

/// The samples are those of every machine, to the last bit.
#[test]
fn samples_are_pinned() {
    let text = "samples = 5\nseed = 7\n[uncertain.parameters]\nheight = { lognormal = [3, 0.1] }\n\
                a1 = { uniform = [0.02, 0.08] }\n";
    let found: Vec<String> = read(text).rows().unwrap().iter().map(|row| format!("{row:?}")).collect();
    assert_eq!(found, PINNED);
}

const PINNED: [&str; 5] = [
    "[0.021757955827941603, 3.0806595946598874]",
    "[0.05567950515646426, 2.7045629646130083]",
    "[0.06957158441972686, 2.945220030351941]",
    "[0.06265844549531518, 3.3328115691865308]",
    "[0.03539542063167425, 2.8979234326874237]",
];

/// Ranks against the formula 1 − 6Σd²/(n(n²−1)), the regression against numbers that it explains.
#[test]
fn sensitivities_are_those_of_formulas() {
    let columns: [Vec<f64>; 3] =
        [vec![1.0, 3.0, 2.0, 5.0, 4.0, 6.0], vec![2.0, -1.0, 4.0, 3.0, 6.0, 5.0], vec![7.0; 6]];
    let number = |k: usize| 1.5 + 2.0 * columns[0][k].ln() - 0.25 * columns[1][k];
    let numbers: Vec<f64> = (0..6).map(number).collect();
    let (found, explained) = sensitivities(&columns, &[true, false, true], &numbers);
    // normal equations of two columns whose correlation is below 0.9 keep all but 2 digits
    assert!((found[0].coefficient.unwrap() - 2.0).abs() < 1e-13, "{found:?}");
    assert!((found[1].coefficient.unwrap() + 0.25).abs() < 1e-13);
    assert!((explained.unwrap() - 1.0).abs() < 1e-13);
    assert_eq!((found[2].rank_correlation, found[2].coefficient), (None, None));
    // ranks of the numbers: 1, 5, 2, 6, 3, 4; those of the first parameter are its values
    let order = |k: usize| 1 + numbers.iter().filter(|other| **other < numbers[k]).count();
    let squares: f64 = (0..6).map(|k| (order(k) as f64 - columns[0][k]).powi(2)).sum();
    let spearman = 1.0 - 6.0 * squares / (6.0 * 35.0);
    assert!((found[0].rank_correlation.unwrap() - spearman).abs() < 1e-15);
    // alike values share their ranks: 1.5, 1.5, 3 against 1, 2, 3 is √3/2
    let tied = rank_correlation(&[1.0, 1.0, 2.0], &[1.0, 2.0, 3.0]).unwrap();
    assert!((tied - 0.75_f64.sqrt()).abs() < 1e-15);
}

#[test]
#[allow(clippy::too_many_lines, reason = "one list of cases")]
fn what_cannot_be_sampled_is_refused_with_its_line() {
    let parameters = "[uncertain.parameters]\n";
    for (text, words) in [
        (
            "samples = 1\n[uncertain.parameters]\nheight = { normal = [3, 1] }",
            "study.toml, line 6: uncertain.samples = 1 must be at least 2",
        ),
        (parameters, "no parameter is uncertain"),
        (
            "[uncertain.parameters]\nheigth = { normal = [3, 1] }",
            "line 7: \"heigth\" is not a number of a wall",
        ),
        (
            "[uncertain.parameters]\nheight = { normal = [3, -1] }",
            "line 7: height: normal = [3, -1]: the mean must be finite and the standard deviation above 0",
        ),
        (
            "[uncertain.parameters]\nheight = { lognormal = [0, 0.1] }",
            "line 7: height: lognormal = [0, 0.1]: the median and the standard deviation of the logarithm",
        ),
        (
            "[uncertain.parameters]\nheight = { uniform = [3, 2] }",
            "line 7: height: uniform = [3, 2]: the upper end must be above the lower one",
        ),
        (
            "[uncertain.parameters]\nheight = { triangular = [2, 4, 3] }",
            "line 7: height: triangular = [2, 4, 3]: the upper end must be above the lower one, and the mode",
        ),
        (
            "[uncertain.parameters]\nheight = { values = [3, 4], weights = [1, -0.5] }",
            "line 7: height: values with 4 of weight -0.5: values must be finite and weights above 0",
        ),
        (
            "[uncertain.parameters]\nheight = { values = [] }",
            "line 7: uncertain.parameters.height.values needs at least 1 value, found 0",
        ),
        (
            "[uncertain.parameters]\nheight = { values = [3], weights = [] }",
            "line 7: uncertain.parameters.height.weights needs at least 1 value, found 0",
        ),
        ("[uncertain.parameters]\nheight = { normal = [3] }", "line 7: normal = [3]: expected"),
        ("[uncertain.parameters]\nheight = 3", "line 7: height = 3: expected a table"),
        (
            "[uncertain.parameters]\nheight = { normal = [3, 1], uniform = [2, 3] }",
            "height: expected one of normal, lognormal,",
        ),
        ("[uncertain.parameters]\nheight = { norml = [3, 1] }", "(did you mean \"normal\"?)"),
        (
            "[uncertain.parameters]\nhinge_ratio = { normal = [5, 1] }",
            "of it is outside its limits (0.01 to 0.99), and at most 50 %",
        ),
        (
            "[uncertain.parameters]\na1 = { values = [0.1, 3] }",
            "its value 3 is outside its limits (0.000000001 to 1)",
        ),
        (
            "samples = 3\n[uncertain.parameters]\na1 = { uniform = [0.1, 0.3] }\n\
             d1 = { uniform = [0.1, 0.3] }",
            "are too few",
        ),
        (
            "correlation = [[\"a1\", \"d1\", 1.5]]\n[uncertain.parameters]\na1 = { uniform = [0.1, 0.3] }\n\
             d1 = { uniform = [0.1, 0.3] }",
            "line 6: correlation: 1.5 must be above -1 and below 1",
        ),
        (
            "correlation = [[\"a1\", \"b\", 0.5]]\n[uncertain.parameters]\na1 = { uniform = [0.1, 0.3] }",
            "is not among",
        ),
    ] {
        let error = StudyFile::parse("study.toml", &with(text), &NoCodes).unwrap_err().to_string();
        assert!(error.contains(words), "{text}: {error}");
    }
    let cut = "[uncertain.parameters]\nthickness = { normal = [0.3, 0.1], within = [0.2, 0.6] }";
    let (_, warnings) = StudyFile::parse("study.toml", &with(cut), &NoCodes).unwrap().uncertain.unwrap();
    // Φ(−1) + Φ(−3)
    assert_eq!(warnings, ["[uncertain] thickness: its limits (0.2 to 0.6) cut off 16.00 % of it"]);
}

/// A ratio that a wall states, here by samples, is that of the models that state none: each curve has the
/// bits of a model with this ratio. Other models do not take it.
#[test]
fn walls_have_damping_ratios_of_their_own() {
    let pulse = Pulse { shape: Shape::HalfSine, amplitude: 1.0, frequency: 1.0 }.motion(None).unwrap();
    let of = |models: &str, rest: &str| {
        let text =
            format!("models = [{models}]\nlevels = {{ method = \"step\", step = 0.1, top = 1 }}\n{rest}");
        let records = vec![NamedRecord::new("pulse", pulse.clone())];
        let wall = NamedWall::new("a", Parameters { height: 3.0, thickness: 0.3, ..Parameters::default() });
        LoadedStudy::of_parts(text, vec![wall], records, &NoCodes).unwrap()
    };
    let own = "{ model = \"CDR\", xi = 0.1 }";
    let uncertain = "[uncertain]\nsamples = 3\n[uncertain.parameters]\nxi = { uniform = [0.01, 0.3] }\n";
    let sampled = of(&format!("\"CDC\", \"CR\", {own}"), uncertain);
    let found = sampled.study.run(1).unwrap();
    assert!(found[0] != found[3], "the ratio counts");
    for (row, curves) in sampled.report.samples.as_ref().unwrap().rows.iter().zip(found.chunks(3)) {
        let stated = format!("{{ model = \"CDC\", xi = {:?} }}, \"CR\", {own}", row[0]);
        assert_eq!(of(&stated, "").study.run(1).unwrap(), curves, "{row:?}");
    }
    let unused = of("\"CR\"", uncertain).warnings;
    assert!(unused.iter().any(|told| told.contains("xi") && told.contains("no effect")), "{unused:?}");
}

/// Samples are walls of the study and of its classes, and stay the same on another machine.
#[test]
fn samples_are_walls_and_classes() {
    let text = with("samples = 10\n[uncertain.parameters]\nheight = { normal = [3, 0.1] }\n")
        + "[[classes]]\nname = \"mine\"\nwalls = [\"a\"]\nweights = [2]\n";
    let folder = std::env::temp_dir().join(format!("uncertain_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    let loaded = LoadedStudy::read(&path, &NoCodes).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let walls = loaded.study.walls();
    assert_eq!((walls.len(), walls[0].name.as_str(), walls[9].name.as_str()), (10, "a 01", "a 10"));
    let samples = loaded.report.samples.as_ref().unwrap();
    let heights: Vec<f64> = walls.iter().map(|wall| wall.parameters.height).collect();
    assert_eq!(heights, column(&samples.rows, 0));
    let classes: Vec<_> =
        loaded.report.classes.iter().map(|class| (&*class.name, class.walls.len())).collect();
    assert_eq!(classes, [("mine", 10), ("a", 10)]);
    assert_eq!(loaded.report.classes[0].weights, [2.0; 10]);
    let received = LoadedStudy::received(loaded.sent(&NoCodes), &NoCodes).unwrap();
    assert!(Contents::of(&received.study) == Contents::of(&loaded.study));
    assert_eq!(received.report, loaded.report);
    // the height is stated by its distribution, a1 by nobody
    let assumed = |loaded: &LoadedStudy| loaded.study.walls()[3].assumed.clone();
    assert!(assumed(&loaded).contains(&"a1") && !assumed(&loaded).contains(&"height"));
    assert_eq!(assumed(&received), assumed(&loaded));
}

/// A table may have the numbers of a tie as columns, and `[uncertain]` draws them: each sample has a tie of
/// its own, whose force is at most its own strength and which breaks at its own elongation.
#[test]
fn numbers_of_ties_are_columns_and_are_sampled() {
    let columns = ["tie_stiffness", "tie_slack", "tie_strength", "tie_ultimate"];
    let text = |uncertain: &str| {
        with(uncertain)
            .replace(
                "{ name = \"a\", geometry = { height = 3, thickness = 0.3 } }",
                "{ table = \"walls.csv\" }",
            )
            .replace(if uncertain.is_empty() { "[uncertain]\n" } else { "nothing" }, "")
    };
    let folder = std::env::temp_dir().join(format!("uncertain_ties_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let table = format!(
        "name,height,thickness,tie_height,{}\na,3,0.3,2.6,2e5,0.005,800,0.05\nb,2.5,0.25,2.5,1e5,0,500,0\n",
        columns.join(",")
    );
    std::fs::write(folder.join("walls.csv"), table).unwrap();
    let load = |uncertain: &str| {
        std::fs::write(folder.join("study.toml"), text(uncertain)).unwrap();
        LoadedStudy::read(&folder.join("study.toml"), &NoCodes).unwrap()
    };
    let of_tie =
        |wall: &Parameters| [wall.tie_stiffness, wall.tie_slack, wall.tie_strength, wall.tie_ultimate];
    let ties = |loaded: &LoadedStudy| -> Vec<[f64; 4]> {
        loaded.study.walls().iter().map(|wall| of_tie(&wall.parameters)).collect()
    };
    assert_eq!(ties(&load("")), [[2e5, 0.005, 800.0, 0.05], [1e5, 0.0, 500.0, 0.0]]);
    let loaded = load(
        "samples = 6\n[uncertain.parameters]\ntie_stiffness = { lognormal = [1.5e5, 0.3] }\n\
         tie_slack = { uniform = [0, 0.01] }\ntie_strength = { normal = [700, 100] }\n\
         tie_ultimate = { triangular = [0.005, 0.02, 0.03] }\n",
    );
    std::fs::remove_dir_all(&folder).unwrap();
    let samples = loaded.report.samples.as_ref().unwrap();
    let drawn = |row: &Vec<f64>| {
        columns.map(|name| row[samples.parameters.iter().position(|found| found == name).unwrap()])
    };
    let drawn: Vec<_> = samples.rows.iter().map(drawn).collect();
    assert_eq!(ties(&loaded), [&drawn[..], &drawn[..]].concat());
    let study = &loaded.study;
    let (mut whole, mut broken) = (0, 0);
    for case in (0..study.count()).map(|index| study.case(index)) {
        let [_, _, strength, ultimate] = drawn[case.wall % drawn.len()];
        for tie in study.curve(case).unwrap().runs().iter().filter_map(|run| run.tie) {
            // the force may round
            assert!(tie.force <= strength * (1.0 + 4.0 * f64::EPSILON), "{tie:?} {strength}");
            if tie.elongation > 0.0 {
                assert_eq!((tie.force, tie.broken), (strength, tie.elongation == ultimate));
                *(if tie.broken { &mut broken } else { &mut whole }) += 1;
            }
        }
    }
    assert!(whole > 5 && broken > 5, "{whole} ties yielded, {broken} broke");
}

/// Each row of `sensitivity.csv` follows from the samples and from θ of its wall, model and limit state, also
/// where some samples have no curve; the bars of the page are those of the highest limit state.
#[test]
fn sensitivities_of_a_folder_follow_from_its_tables() {
    let text = "models = [\"CR\", \"CDR\"]\n\
                levels = { method = \"step\", step = 0.05, top = 1 }\n\
                intensity = { measure = \"PGA\" }\nreport = { fractions = [1.0, 0.4], resamples = 100 }\n\
                records = { synthetic = { count = 4, duration = 10, step = 0.01 } }\n\
                walls = [{ name = \"a\", geometry = { height = 3, thickness = 0.3 } }, { name = \"b\", \
                geometry = { height = 2, thickness = 0.3 } }]\n\
                [uncertain]\nsamples = 8\n[uncertain.parameters]\n\
                height = { uniform = [2, 4] }\nthickness = { uniform = [0.2, 0.5] }\n";
    let path = run("sensitivity", &load("sensitivity_study", text, &NoCodes).unwrap());
    let samples = rows(&path.join("samples.csv"));
    let curves = rows(&path.join("fragilities.csv"));
    let (mut whole, mut lacking, mut bars) = (0, 0, Vec::new());
    for row in rows(&path.join("sensitivity.csv")) {
        let theta = |sample: &BTreeMap<String, String>| {
            let is_own = |curve: &&BTreeMap<String, String>| {
                curve["wall"] == sample["wall"]
                    && ["model", "u_max_over_u_ins"].iter().all(|name| curve[*name] == row[*name])
            };
            curves.iter().find(is_own).unwrap()["theta_g"].parse::<f64>().ok()
        };
        let own = samples.iter().filter(|sample| sample["of"] == row["wall"]);
        let pairs = own.filter_map(|sample| Some((number(sample, &row["parameter"]), theta(sample)?)));
        let (values, thetas): (Vec<f64>, Vec<f64>) = pairs.unzip();
        assert_eq!(row["with_curve"], values.len().to_string(), "{row:?}");
        assert_eq!((&*row["samples"], &*row["logarithm"]), ("8", "true"));
        lacking += usize::from(values.len() < 8);
        let expected = rank_correlation(&values, &thetas);
        assert_eq!(row["rank_correlation"], expected.map_or(String::new(), |found| format!("{found:?}")));
        whole += usize::from(expected.is_some());
        if let (Ok(standardised), "1.0") =
            (row["standardised_coefficient"].parse::<f64>(), &*row["u_max_over_u_ins"])
        {
            bars.push(standardised);
        }
    }
    crate::variance::check_parts(&rows(&path.join("variance.csv")), &curves);
    // 2 walls, 2 models, 2 limit states, 2 parameters
    assert!(whole >= 12 && lacking >= 2 && bars.len() >= 4, "{whole} {lacking} {bars:?}");
    let page = std::fs::read_to_string(path.join("study.html")).unwrap();
    let end = bars.iter().map(|bar| bar.abs()).fold(1.0, f64::max);
    for bar in &bars {
        let width = 50.0 * bar.abs() / end;
        let left = if *bar < 0.0 { 50.0 - width } else { 50.0 };
        let drawn =
            format!("<div title=\"{bar:.3}\"><i class=\"chip\" style=\"left:{left:.2}%;width:{width:.2}%;");
        assert!(page.contains(&drawn), "{drawn}");
    }
    assert!(bars.iter().any(|bar| *bar < 0.0) && bars.iter().any(|bar| *bar > 0.0), "{bars:?}");
    // the larger coefficient of a wall and model comes first
    let titles = page.split("<div title=\"").skip(1).filter_map(|rest| rest.split('"').next()?.parse().ok());
    let titles: Vec<f64> = titles.filter(|title: &f64| title.abs() <= end + 1e-3).collect();
    let found: Vec<_> = titles.chunks(2).map(|pair| pair[0].abs() >= pair[1].abs()).collect();
    assert_eq!((titles.len(), found.iter().all(|is_first| *is_first)), (bars.len(), true), "{titles:?}");
}
