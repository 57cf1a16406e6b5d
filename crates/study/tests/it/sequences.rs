//! Studies of sequences: what the levels scale, the state before the last shock, and what is refused.

use std::fs;
use std::path::PathBuf;
use std::sync::Once;

use fragility::{Sample, fit};
use ground_motion::{GroundMotion, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::Parameters;
use run::model::{EnergyLoss, Model};
use run::records::NamedRecord;
use run::walls::NamedWall;
use scene::Scene;
use scene::response::Response;
use study::codes::NoCodes;
use study::ida::{Case, Crossing, IntensityMeasure, Levels, Run, Scaled, Study};
use study::loaded::LoadedStudy;

use crate::folders::{load, number, rows, run_analysis};

const STEP: f64 = 0.01;

fn shock(seed: u64, peak: f64) -> GroundMotion {
    let samples = SyntheticMotion { seed, duration: 10.0, step: STEP, peak }.motion().unwrap();
    GroundMotion::new(STEP, [samples.samples(), &[0.0]].concat()).unwrap()
}

/// Main shocks that differ in size, each before an aftershock.
fn sequences(count: u64) -> Vec<NamedRecord> {
    let record = |seed: u64| {
        let shocks = [shock(seed, 0.8 + 0.15 * seed as f64), shock(100 + seed, 2.0)];
        NamedRecord::new(format!("sequence {seed}"), GroundMotion::sequence(&shocks, 6.0).unwrap())
    };
    (1..=count).map(record).collect()
}

/// A wall with a tie that yields.
fn tied() -> NamedWall {
    let parameters = Parameters {
        height: 3.0,
        thickness: 0.3,
        tie_height: 2.6,
        tie_stiffness: 2e6,
        tie_strength: 2e3,
        tie_ultimate: 0.05,
        u_start: 0.0,
        ..Parameters::default()
    };
    NamedWall::new("tied", parameters)
}

fn study(records: Vec<NamedRecord>, levels: Levels) -> Study {
    let models = vec![Model::new(EnergyLoss::Restitution)];
    Study::new(vec![tied()], records, models, IntensityMeasure::Pga, levels).unwrap()
}

/// Sequences that are scaled as a whole are the records that they are.
#[test]
fn all_shocks_are_scaled_as_one_record() {
    let levels = Levels::ToOverturning { step: 0.5, top: 12.0 };
    let whole = |record: NamedRecord| {
        let motion = GroundMotion::new(STEP, record.motion.samples().to_vec()).unwrap();
        NamedRecord { motion, ..record }
    };
    let cut = study(sequences(3), levels.clone());
    let records = sequences(3).into_iter().map(whole).collect();
    assert_eq!(cut.run(2).unwrap(), study(records, levels).run(2).unwrap());
}

/// A run whose last shock is scaled is the run of the sequence with that shock scaled: its demand and its tie
/// are those of the last shock.
#[test]
fn the_last_shock_goes_on_from_the_others() {
    let levels = Levels::Grid(vec![1.0, 3.0]);
    let of_last = study(sequences(4), levels).with_scaled(Scaled::Last).unwrap();
    let mut stretched = 0;
    for record in 0..4 {
        let curve = of_last.curve(Case { wall: 0, record, model: 0 }).unwrap();
        let seed = record as u64 + 1;
        for run in curve.runs() {
            let last = shock(100 + seed, 2.0).scaled_to_peak(run.intensity).unwrap();
            let motion = GroundMotion::sequence(&[shock(seed, 0.8 + 0.15 * seed as f64), last], 6.0).unwrap();
            let parameters = of_last.models()[0].applied_to(&tied().parameters).unwrap();
            let mut scene = Scene { parameters, ..Scene::default() };
            scene.shake(Excitation::new(motion, None), of_last.tail(), Vec::new());
            let response = Response::of(&scene).unwrap();
            let [first, second] = &response.shocks[..] else { panic!("two shocks") };
            // roundings of the factor, which the wall amplifies
            let alike = |one: f64, other: f64| assert!((one - other).abs() < 1e-9, "{one} and {other}");
            assert_eq!(run.overturning.is_some(), second.overturned);
            alike(run.demand, second.u_ratio_max);
            let before = curve.before().unwrap();
            alike(before.demand, first.u_ratio_max);
            let yielding = |shock: &scene::response::Shock| shock.demands.ties[0].yielding.unwrap();
            assert_eq!(before.tie.unwrap().broken, yielding(first).breaks[0].is_some());
            if second.overturned {
                continue;
            }
            let tie = run.tie.unwrap();
            alike(tie.elongation, yielding(second).elongation.positive);
            assert_eq!(tie.broken, yielding(second).breaks[0].is_some());
            stretched += usize::from(yielding(first).elongation.positive > 1e-3);
        }
    }
    assert!(stretched >= 4, "{stretched} of 8");
}

/// The table by states counts each record in the states that its first shock leads to, and fits these alone;
/// `tests/python/test_estimators.py` has the fits of SciPy.
#[test]
fn fragilities_are_told_by_the_state_before() {
    let text = "models = [\"CDC\"]\nintensity = { measure = \"PGA\" }\n\
                levels = { method = \"grid\", step = 0.05, top = 1.5 }\n\
                scaled_shocks = \"last\"\n\
                [report]\nfractions = [0.2, 1.0]\nresamples = 100\ncollapse = \"first\"\n\
                given = [0.1, 0.2]\n";
    let loaded = LoadedStudy::of_parts(text.into(), vec![tied()], sequences(12), &NoCodes).unwrap();
    let received = LoadedStudy::received(loaded.sent(&NoCodes), &NoCodes).unwrap();
    assert_eq!(received.study.run(2).unwrap(), loaded.study.run(2).unwrap());
    let path = run_analysis("sequences", &loaded);
    let (given, collapses) = (rows(&path.join("given.csv")), rows(&path.join("collapses.csv")));
    assert_eq!(given.len(), 2 * 5);
    let curves = loaded.study.run(2).unwrap();
    for (curve, row) in curves.iter().zip(&collapses) {
        assert_eq!(number(row, "u_max_over_u_ins_before"), curve.before().unwrap().demand);
    }
    let mut fitted = 0;
    for row in &given {
        let fraction = number(row, "u_max_over_u_ins");
        let is_in = |before: &Run| match row["given"].as_str() {
            "any" => true,
            "tie broken" => before.tie.unwrap().broken,
            "d <= 0.1" => before.demand <= 0.1 && !before.tie.unwrap().broken,
            "d > 0.1" => before.demand > 0.1,
            "d > 0.2" => before.demand > 0.2,
            other => panic!("{other}"),
        };
        let chosen: Vec<_> = curves.iter().filter(|curve| is_in(curve.before().unwrap())).cloned().collect();
        assert_eq!(number(row, "records"), chosen.len() as f64);
        let levels = loaded.study.levels().shared();
        let sample = Sample::of_curves(&chosen, fraction, Crossing::First, levels.as_deref());
        let Ok(curve) = fit(&sample) else {
            assert_eq!((&*row["theta_g"], &*row["beta"]), ("", ""));
            continue;
        };
        fitted += 1;
        assert_eq!(number(row, "theta_g"), curve.median / 9.80665);
        assert_eq!(number(row, "beta"), curve.dispersion);
    }
    assert!(fitted >= 4, "{fitted} of {}", given.len());
    let page = fs::read_to_string(path.join("study.html")).unwrap();
    assert!(page.contains("Fragilities of the last shock"));
}

const PAIR: &str = "[\"main shock.csv\", \"aftershock.csv\"]";
const GRID: &str = "levels = { method = \"step\", step = 0.5, top = 1 }";

/// A study of one wall under records of three files.
fn of_files(name: &str, records: &str, more: &str) -> Result<LoadedStudy, String> {
    static FILES: Once = Once::new();
    FILES.call_once(|| {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
        let write = |name: &str, motion: &GroundMotion| {
            let samples = motion.samples().iter().enumerate();
            let rows = samples.map(|(k, a)| format!("{:?},{a:?}\n", k as f64 * STEP));
            fs::write(folder.join(name), "t,a\n".to_owned() + &rows.collect::<String>()).unwrap();
        };
        write("main shock.csv", &shock(1, 2.0));
        write("aftershock.csv", &shock(2, 1.0));
        write("cut.csv", &GroundMotion::new(STEP, vec![0.0, 1.0]).unwrap());
    });
    let text = format!(
        "models = [\"CDC\"]\nintensity = {{ measure = \"PGA\" }}\n{more}\n\
         [records]\nunit = \"m/s2\"\n{records}\n\
         [[walls]]\nname = \"a\"\ngeometry = {{ height = 3, thickness = 0.3, density = 1800 }}\n"
    );
    load(name, &text, &NoCodes)
}

#[test]
fn files_make_sequences() {
    let loaded = of_files("sequences of files", &format!("sequences = [{PAIR}]\npause = 4"), GRID).unwrap();
    let shocks = [shock(1, 2.0), shock(2, 1.0)];
    let wanted = GroundMotion::sequence(&shocks, 4.0).unwrap();
    assert_eq!(loaded.study.records()[0].motion, wanted);
    assert_eq!(loaded.study.records()[0].name, "main shock.csv + aftershock.csv");
    assert!(loaded.inputs.iter().any(|input| input.ends_with("aftershock.csv")));
    // a factor of two is the doubled record, bit for bit
    let doubled = "sequences = [[\"main shock.csv\", { record = \"aftershock.csv\", scale = 2 }]]\npause = 4";
    let doubled = of_files("sequences of files", doubled, GRID).unwrap();
    let wanted = GroundMotion::sequence(&[shocks[0].clone(), shocks[1].scaled(2.0)], 4.0).unwrap();
    assert_eq!(doubled.study.records()[0].motion, wanted);
    let twice =
        format!("sequences = [{PAIR}, [\"main shock.csv\", {{ record = \"aftershock.csv\", scale = 2 }}]]");
    let twice = of_files("sequences of files", &twice, GRID).unwrap();
    let names: Vec<_> = twice.study.records().iter().map(|record| &*record.name).collect();
    assert_eq!(names, ["main shock.csv + aftershock.csv", "main shock.csv + aftershock.csv (scale 2)"]);
    // a single record keeps its place among sequences
    let among =
        of_files("sequences of files", &format!("sequences = [\"aftershock.csv\", {PAIR}]"), GRID).unwrap();
    let single = &among.study.records()[0];
    assert_eq!((&*single.name, &single.motion), ("aftershock.csv", &shocks[1]));
}

#[test]
fn mistakes_in_sequences_of_files_are_named() {
    let grid = GRID;
    let files = "files = [\"main shock.csv\"]";
    let last = format!("{grid}\nscaled_shocks = \"last\"");
    let given = |scaled: &str, given: &str| {
        format!("{grid}\nscaled_shocks = \"{scaled}\"\nreport = {{ given = {given} }}")
    };
    let cloud = "levels = { method = \"cloud\" }\nscaled_shocks = \"last\"\nreport = { given = [0.1] }";
    let strong = "sequences = [[{ record = \"main shock.csv\", scale = 20 }, \"aftershock.csv\"]]";
    let sequences = &format!("sequences = [{PAIR}]");
    for (records, more, message) in [
        (
            "sequences = [\"main shock.csv\", \"aftershock.csv\"]",
            grid,
            "line 6: a sequence is a list of two records or more",
        ),
        ("sequences = [[]]", grid, "line 6: "),
        ("sequences = [[[\"a\"], \"b\"]]", grid, "expected a path in quotes, or a list"),
        ("sequences = [[\"main shock.csv\", \"gone.csv\"]]", grid, "gone.csv: cannot be read"),
        (&format!("{files}\npause = 4"), grid, "line 7: a sequence is a list of two records or more"),
        (&format!("{sequences}\npause = -1"), grid, "pause = -1"),
        ("", grid, "[records] needs files = [...], selection = \"…\", sequences = [[...], ...]"),
        (files, &last, "record \"main shock.csv\" is no sequence with a pause"),
        ("sequences = [[\"cut.csv\", \"aftershock.csv\"]]\npause = 0", &last, "needs a pause of two steps"),
        (sequences, &given("first", "[0.1]"), "\"all\""),
        (sequences, &given("all", "[0.1]"), "given needs scaled_shocks"),
        (sequences, &given("last", "[1.5]"), "1.5"),
        (sequences, &given("last", "[]"), "given"),
        (sequences, cloud, "levels of another method than a cloud"),
        (sequences, &format!("{last}\nstoreys = [{{ period = 0.3 }}]"), "\"a\" stands on storeys"),
    ] {
        let told = of_files("wrong sequences of files", records, more)
            .err()
            .unwrap_or_else(|| panic!("{records} {more}"));
        assert!(told.contains(message), "{records} {more}\n{told}");
    }
    let told =
        of_files("wrong sequences of files", strong, &last).unwrap().study.run(1).unwrap_err().to_string();
    assert!(
        told.contains("\"a\" with \"CDC\" overturns before the last shock of") && told.contains("scale"),
        "{told}"
    );
}
