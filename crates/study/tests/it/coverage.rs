//! How often intervals contain the truth: populations with known θ and β through a whole study, each a wall.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use fragility::hazard::HazardCurve;
use fragility::quantile;
use run::sample::Pcg;
use study::codes::NoCodes;
use study::folder::{Folder, finish};
use study::ida::{Curve, Run};

use crate::folders::{load, number, rows};

const THETA: f64 = 2.0;
const BETA: f64 = 0.4;
const GRID: [f64; 8] = [0.6, 1.0, 1.4, 1.8, 2.2, 2.8, 3.5, 5.0];
/// About the rate of the walls with θ.
const TARGET: f64 = 5e-4;
const HAZARD: [[f64; 2]; 3] = [[0.2, 1e-1], [1.0, 1e-3], [8.0, 1e-6]];

/// How the records of a population are run.
#[derive(Clone, Copy, PartialEq)]
enum Runs {
    /// Each to its collapse, known to 1 %.
    Hunt,
    /// To 1.2 θ at most: a third of the records stands there.
    Censored,
    /// At eight levels, of which the fractions count.
    Stripes,
    /// Each once, about 0.8 θ: some 30 % overturn.
    Cloud,
}

fn normal(random: &mut Pcg) -> f64 {
    quantile((random.below(1 << 30) as f64 + 0.5) / f64::from(1 << 30))
}

/// The runs of a record that makes the wall collapse at an intensity.
fn curve(runs: Runs, collapse: f64, other: f64) -> Curve {
    let levels = match runs {
        Runs::Censored if collapse > 1.2 * THETA => vec![1.2 * THETA],
        Runs::Hunt | Runs::Censored => vec![0.995 * collapse, 1.005 * collapse],
        Runs::Stripes => GRID.to_vec(),
        Runs::Cloud => vec![0.8 * THETA * (0.5 * other).exp()],
    };
    let run = |intensity: f64| Run {
        intensity,
        demand: (intensity / collapse).min(1.0),
        overturning: (intensity >= collapse).then_some(1.0),
        ..Run::default()
    };
    Curve::new(levels.into_iter().map(run).collect())
}

/// Parts of the populations, and of classes of two, whose intervals contain θ, β and the annual rate.
///
/// The second wall of a class has twice the θ of the first, and half of its variance of ln IM in common.
#[allow(clippy::too_many_lines, reason = "one experiment: a study, its runs, its results, its counts")]
fn coverage(name: &str, runs: Runs, records: usize, populations: usize) -> BTreeMap<&'static str, f64> {
    let levels = match runs {
        Runs::Cloud => "method = \"cloud\"".to_owned(),
        Runs::Stripes => format!("method = \"grid\", values = {GRID:?}, unit = \"m/s2\""),
        _ => "method = \"hunt\", first = 0.05, increase = 0.05, top = 5".to_owned(),
    };
    let mut text = format!(
        "models = [\"CR\"]\nlevels = {{ {levels} }}\nintensity = {{ measure = \"PGA\" }}\n\
         records = {{ synthetic = {{ count = {records}, duration = 10 }} }}\n\
         report = {{ fractions = [1], resamples = 400 }}\n\
         [hazard]\npoints = {HAZARD:?}\nunit = \"m/s2\"\ntarget = {TARGET}\n"
    );
    for wall in 0..populations {
        text += "[[walls]]\ngeometry = { height = 2, thickness = 0.2 }\n";
        writeln!(text, "name = \"{wall}\"").unwrap();
        if wall % 2 == 1 {
            writeln!(text, "[[classes]]\nname = \"c{wall}\"\nwalls = [\"{}\", \"{wall}\"]", wall - 1)
                .unwrap();
        }
    }
    let loaded = load(name, &text, &NoCodes).unwrap();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    drop(std::fs::remove_dir_all(&path));
    let folder = Folder::of_study(&path, &loaded).unwrap();
    let (mut random, mut curves) = (Pcg::new(3), Vec::new());
    for _ in 0..populations.div_ceil(2) {
        let shared: Vec<f64> = (0..records).map(|_| normal(&mut random)).collect();
        for factor in [1.0, 2.0] {
            for common in &shared {
                let z = (common + normal(&mut random)) * 0.5_f64.sqrt();
                // a wall of twice the θ has twice all intensities
                let one = curve(runs, THETA * (BETA * z).exp(), normal(&mut random));
                let scaled = one.runs().iter().map(|run| Run { intensity: factor * run.intensity, ..*run });
                let grid = runs == Runs::Stripes;
                curves.push(if grid { one } else { Curve::new(scaled.collect()) });
            }
        }
    }
    for part in 0..folder.contents().parts() {
        folder.keep(part, &curves[folder.contents().part(part)]).unwrap();
    }
    finish(&folder, 2).unwrap();
    // g in the tables
    let g = ground_motion::STANDARD_GRAVITY;
    let hazard = HazardCurve::new(HAZARD.to_vec()).unwrap();
    let mut found = BTreeMap::<_, [f64; 2]>::new();
    let mut count = |name, row: &BTreeMap<String, String>, ends: [&str; 2], truth: f64| {
        // an end that the levels leave open is as far as it can be
        let end = |side: usize| match row[ends[side]].as_str() {
            "" => f64::NAN,
            text if text.starts_with("open") => [0.0, f64::INFINITY][side],
            _ => number(row, ends[side]),
        };
        let [low, high] = [end(0), end(1)];
        let [inside, all] = found.entry(name).or_default();
        *inside += f64::from(u8::from(low <= truth && truth <= high));
        *all += 1.0;
    };
    let theta_of = |row: &BTreeMap<String, String>| {
        let wall: usize = row["wall"].parse().unwrap();
        if wall.is_multiple_of(2) || runs == Runs::Stripes { THETA } else { 2.0 * THETA }
    };
    for row in rows(&path.join("fragility_curves.csv")) {
        if row["walls"] == "1" {
            count("θ", &row, ["theta_low", "theta_high"], theta_of(&row) / g);
            count("β", &row, ["beta_low", "beta_high"], BETA);
        } else if runs != Runs::Stripes {
            let apart = 0.5 * 2.0_f64.ln();
            count("θ of a class", &row, ["theta_low", "theta_high"], 2.0_f64.sqrt() * THETA / g);
            count("β of a class", &row, ["beta_low", "beta_high"], BETA.hypot(apart));
        }
    }
    let rates = rows(&path.join("rates.csv"));
    let of: BTreeMap<&str, f64> =
        rates.iter().map(|row| (row["wall"].as_str(), number(row, "annual_rate"))).collect();
    let mut words = BTreeMap::<&str, u32>::new();
    for row in &rates {
        // the interval reaches no further than what decides about the target
        let [low, high] = ["annual_rate_low", "annual_rate_high"].map(|end| number(row, end));
        let word = row["target_met"].as_str();
        *words.entry(word).or_default() += 1;
        assert!(word != "yes" || high <= TARGET && number(row, "annual_rate_most") <= TARGET, "{row:?}");
        assert!(word != "no" || low + number(row, "beyond_last_point_least") > 0.9 * TARGET, "{row:?}");
        if let Some(odd) = row["wall"].strip_prefix('c') {
            let even = (odd.parse::<usize>().unwrap() - 1).to_string();
            let mean = 0.5 * (of[odd] + of[even.as_str()]);
            assert!((number(row, "annual_rate_of_walls") / mean - 1.0).abs() < 1e-12, "{row:?}");
        } else {
            let rate = hazard.rate(theta_of(row), BETA).within();
            count("rate", row, ["annual_rate_low", "annual_rate_high"], rate);
        }
    }
    assert!(words["open"] > 0 && words.len() > 1, "{words:?}");
    found.into_iter().map(|(name, [inside, all])| (name, inside / all)).collect()
}

/// 95 % intervals contain the truth in 95 % of 200 populations of 20 records, within four standard errors of
/// that count, 4 √(0.95 · 0.05/200) = 6.2 %. By percentiles of the same resamples β would be within its
/// interval in 81 to 86 %.
#[test]
fn intervals_contain_the_truth() {
    for (name, runs) in [("covered", Runs::Hunt), ("covered_stripes", Runs::Stripes)] {
        for (name, part) in coverage(name, runs, 20, 200) {
            assert!(part > 0.888, "{name}: {part}");
        }
    }
    // the third that is censored, and what overturns in a cloud
    for (name, runs) in [("covered_censored", Runs::Censored), ("covered_cloud", Runs::Cloud)] {
        for (name, part) in coverage(name, runs, 20, 100) {
            assert!(part > 0.863, "{name}: {part}");
        }
    }
}

/// `cargo test --release -p rocking-study --test it table_of -- --ignored --nocapture` prints the table of
/// docs/model.md.
#[test]
#[ignore = "the table of the documents: a minute of an optimised program"]
fn table_of_coverage() {
    for (words, runs) in [
        ("hunt", Runs::Hunt),
        ("hunt, a third of the records censored", Runs::Censored),
        ("eight stripes", Runs::Stripes),
        ("cloud, a third overturned", Runs::Cloud),
    ] {
        for records in [10, 20, 30] {
            let part = coverage("coverage_table", runs, records, 1000);
            let cells = ["θ", "β", "rate", "θ of a class", "β of a class"];
            let cells =
                cells.map(|name| part.get(name).map_or("–".into(), |x| format!("{:.1}", 100.0 * x)));
            println!("| {words} | {records} | {} |", cells.join(" | "));
        }
    }
}
