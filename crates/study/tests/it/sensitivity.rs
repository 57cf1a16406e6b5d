//! Sensitivities of collapses: what they are, and how they are kept and counted.

use std::fs;

use ground_motion::SyntheticMotion;
use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::Motion;
use rocking_wall::wall::{Parameters, Support};
use run::model::Model;
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::codes::NoCodes;
use study::ida::{IntensityMeasure, Levels, SENSITIVE_ABOVE, Study};

use crate::folders::{load, number, rows, run_analysis};

const HUNT: Levels = Levels::HuntAndFill { first: 0.5, increase: 0.5, top: 60.0, resolution: 0.01, gap: 0.2 };

/// Parapets of Table 5 of the paper under synthetic motions of consecutive seeds.
fn study(seeds: std::ops::RangeInclusive<u64>) -> Study {
    let wall = |name: &str, height, thickness, a1| {
        NamedWall::new(name, Parameters { height, thickness, a1, ..Parameters::default() })
    };
    let walls = vec![wall("3", 3.0, 0.3, 0.009), wall("small", 1.0, 0.2, 0.01)];
    let record = |seed| {
        NamedRecord::new(
            format!("seed {seed}"),
            SyntheticMotion { seed, duration: 12.0, step: 0.01, peak: 3.0 }.motion().unwrap(),
        )
    };
    let records = seeds.map(record).collect();
    Study::new(walls, records, Model::figure_15(), IntensityMeasure::Pga, HUNT).unwrap()
}

/// Wall 2 of Table 5 of the paper under three of the motions of studies/table_5.toml.
const SENSITIVE: &str = r#"
models = ["CR"]
intensity = { measure = "AvgSA" }
levels = { method = "hunt", first = 0.05, increase = 0.02, top = 10, resolution = 0.01, gap = 0.05 }
records = { synthetic = { count = 3, seed = 1 } }
walls = [{ name = "2", geometry = { height = 1.5, thickness = 0.3 }, force_law = { a1 = 0.0012 } }]
"#;

/// One of three collapses depends on the tenth digit of its record. It is marked in the table, kept in the
/// parts, written with two digits and counted on the page.
#[test]
fn collapses_that_depend_on_digits_of_the_record_are_counted() {
    let loaded = load("sensitive", SENSITIVE, &NoCodes).unwrap();
    let found: Vec<_> =
        loaded.study.run(1).unwrap().iter().map(|curve| curve.sensitivity().unwrap()).collect();
    let above = |found: &[f64]| found.iter().filter(|one| **one > SENSITIVE_ABOVE).count();
    assert!(above(&found) == 1 && found.iter().all(|one| (1.0..=1e12).contains(one)), "{found:?}");
    let path = run_analysis("sensitive_results", &loaded);
    let kept: Vec<_> =
        rows(&path.join("collapses.csv")).iter().map(|row| number(row, "sensitivity")).collect();
    // two digits of each
    let rounded: Vec<f64> = found.iter().map(|one| format!("{one:.1e}").parse().unwrap()).collect();
    assert_eq!(kept, rounded);
    let page = fs::read_to_string(path.join("study.html")).unwrap();
    assert!(page.contains("Sensitivity above 1e10: 1 of 3 collapses; the level of such"));
}

/// A collapse without a level at which the wall stands below has no sensitivity, and neither has a curve
/// without a collapse.
#[test]
fn other_curves_have_no_sensitivity() {
    for (levels, collapses) in [("grid\", values = [5]", true), ("grid\", values = [0.01, 0.02]", false)] {
        let hunt = SENSITIVE.find("hunt").unwrap();
        let end = hunt + SENSITIVE[hunt..].find(" }").unwrap();
        let text = format!("{}{levels}{}", &SENSITIVE[..hunt], &SENSITIVE[end..]);
        let curves = load("insensitive", &text, &NoCodes).unwrap().study.run(1).unwrap();
        assert!(curves.iter().all(|curve| curve.runs().last().unwrap().overturning.is_some() == collapses));
        assert!(curves.iter().all(|curve| curve.sensitivity().is_none()));
    }
}

/// The sensitivity of a collapse is |Δu|/`u_ins` over a relative change of the record, where the wall
/// overturns, or that of the largest |u| at the level below. In single runs with all their samples, the
/// former lies between the changes at the two samples around overturning, to the part by which u̇ differs
/// there, and to what rounding does to two runs 1e-12 apart: 100 ε S/1e-12 of S.
#[test]
fn a_sensitivity_is_the_change_of_u_over_that_of_the_record() {
    const CHANGE: f64 = 1e-9;
    let study = study(1..=4);
    let (mut compared, mut below_is_larger) = (0, 0);
    for (index, curve) in study.run(2).unwrap().iter().enumerate() {
        let case = study.case(index);
        let Some(place) = curve.runs().iter().position(|run| run.overturning.is_some()) else { continue };
        let run = curve.runs()[place];
        // of a fall after the record nothing is seen here
        let record = &study.records()[case.record].motion;
        let is_seen = run.overturning.is_some_and(|time| time < record.duration());
        let Some(found) = run.sensitivity.filter(|found| is_seen && *found < 1e5) else { continue };
        let parameters = study.models()[case.model].applied_to(&study.walls()[case.wall].parameters).unwrap();
        let motion = Motion::of(&parameters, parameters.tolerance).unwrap();
        let instability = motion.wall().body().instability;
        let solver = RecordSolver::new(&motion, record.step());
        // u/u_ins and its rate at the samples, and the largest
        let moved = |intensity: f64, part: f64| {
            let level = part * intensity / study.intensity(case.record);
            let factor = level * motion.wall().body().forcing(Support::rigid(1.0));
            let state = motion.start_under(0.0, 0.0, factor * record.samples()[0]);
            let mut history = vec![[0.0; 2]];
            let mut observe = |_, u: f64, v| history.push([u, v].map(|x| x / instability.of(u)));
            let (start, forcing) = (RunStart { state, factor }, Forcing::Samples(record.samples()));
            let outcome = solver.run_observed(start, forcing, RunEnd::AtOverturning, &mut observe).unwrap();
            (history, outcome.state.peaks.ratio(instability))
        };
        let both = |intensity: f64| [moved(intensity, 1.0), moved(intensity, 1.0 + CHANGE)];
        let [(one, _), (other, _)] = both(run.intensity);
        let last = one.len() - 1;
        let changes = [last - 1, last].map(|n| (one[n][0] - other[n][0]).abs() / CHANGE);
        let rates = [one[last - 1][1], one[last][1]];
        let [(_, one), (_, other)] = both(curve.runs()[place - 1].intensity);
        let below = (one - other).abs() / CHANGE;
        let allowed = ((rates[1] - rates[0]) / rates[1]).abs() + 100.0 * f64::EPSILON / 1e-12;
        let [least, most] = [f64::min, f64::max].map(|end| below.max(end(changes[0], changes[1])));
        assert!(
            (least * (1.0 - allowed)..=most * (1.0 + allowed)).contains(&found),
            "{case:?}: {found}, {changes:?}, {below}, {allowed}"
        );
        compared += 1;
        below_is_larger += usize::from(below > most * (1.0 - allowed));
    }
    assert!(compared > 20 && below_is_larger > 3, "{compared} and {below_is_larger} of {}", study.count());
}
