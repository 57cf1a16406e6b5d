//! Tests how safe walls are that just pass a check.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use check::{CheckFile, Rule, Subject, read};
use ground_motion::{GroundMotion, STANDARD_GRAVITY};
use rocking_wall::variables::ForceLaw;
use rocking_wall::wall::Parameters;
use run::records::NamedRecord;
use run::walls::NamedWall;
use study::folder::{Folder, compute};
use study::fragility::{Lognormal, cumulative};
use study::loaded::LoadedStudy;
use study::reliability::{FILES, Reliability, finish};

/// Height and thickness of the wall under pulses [m]; g [m/s²].
const CONTINUE: std::ops::ControlFlow<()> = std::ops::ControlFlow::Continue(());
const HEIGHT: f64 = 2.0;
const THICKNESS: f64 = 0.2;
const G: f64 = 9.81;
const CHECK: &str = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"A\"\n\
                     SLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    drop(fs::remove_dir_all(&path));
    path
}

/// Runs a study of reliability, and returns its folder.
fn run(name: &str, loaded: &LoadedStudy) -> PathBuf {
    let path = folder(name);
    let folder = Folder::of_study(&path, loaded).unwrap();
    let missing = folder.missing(0..folder.contents().parts());
    compute(&loaded.study, &folder, &missing, 2, |_, _| CONTINUE).unwrap();
    study::folder::finish(&folder, 2, || {}).unwrap();
    finish(&folder, &Reliability::of(loaded).unwrap(), 2, || {}).unwrap();
    path
}

/// The rows of a table by the names of its columns.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    lines.map(|cells| names.iter().cloned().zip(cells).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name} = {:?}", row[name]))
}

/// Margins of a rigid wall under rectangles are those of the closed form: the wall falls from
/// a₀/(1 − e^−d) on, d = p T, and during a rectangle that is longer than half a
/// period an oscillator reaches 1 + exp(−ξπ/√(1 − ξ²)) times its acceleration. The bracket of a fall is 1e-12
/// of it, and spectra are found to 1e-12.
#[test]
fn margins_under_pulses_are_those_of_closed_forms() {
    const PERIODS: [f64; 2] = [0.2, 0.3];
    let rate = (1.5 * G / HEIGHT).sqrt();
    let wall = Parameters {
        height: HEIGHT,
        thickness: THICKNESS,
        force_law: ForceLaw::RigidLinear,
        gravity: G,
        ..Parameters::default()
    };
    let lengths = [0.8, 1.3, 2.0, 3.0];
    let record = |length: &f64| {
        let motion = GroundMotion::new(length / rate / 100.0, vec![-1.0; 101]).unwrap();
        NamedRecord { name: format!("rectangle {length}"), motion }
    };
    let text = format!(
        "models = [\"CR\"]\nlevels = {{ method = \"hunt\", first = 0.05, increase = 0.02, top = 3, \
         resolution = 1e-12, gap = 0.5 }}\nintensity = {{ measure = \"code\", periods = [0.2, 0.3] \
         }}\n{CHECK}"
    );
    let walls = vec![NamedWall::new("a", wall)];
    let loaded = LoadedStudy::of_parts(text, walls, lengths.iter().map(record).collect()).unwrap();
    let path = run("pulses", &loaded);
    let row =
        rows(&path.join(FILES[0])).into_iter().find(|row| row["check"] == "SLV" && row["event"] == "fall");
    let found = number(&row.unwrap(), "margin");

    // S_e/a_g at 5 % on soil A is the plateau, F0, up to T_C = 0.3 s
    let amplified = 1.0 + (-0.05 * std::f64::consts::PI / (1.0_f64 - 0.0025).sqrt()).exp();
    let worth = amplified / 2.4;
    assert!(PERIODS.iter().all(|period| *period < 2.0 * lengths[0] / rate));
    let falls = lengths.iter().map(|d| (worth * 0.981 / (1.0 - (-d).exp())).ln()).sum::<f64>() / 4.0;
    // d_SLV = 0.4 b/2 at mid-height, a = 0.6 a₀/FC; S_De between T_C and T_D at 8 % damping
    let (d, a) = (0.2 * THICKNESS, 0.6 * 0.981 / loaded_factor(&loaded));
    let period = 1.68 * std::f64::consts::PI * (d / a).sqrt();
    assert!(period > 0.3 && period < 4.0 * 0.2 + 1.6, "{period}");
    let eta = (10.0_f64 / 13.0).sqrt();
    let demand = |ag: f64| ag * G * eta * 2.4 * 0.3 * period / (2.0 * std::f64::consts::PI).powi(2);
    let code = 0.2 * G * d / demand(0.2);
    let expected = falls.exp() / code;
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// FC of the study's check.
fn loaded_factor(loaded: &LoadedStudy) -> f64 {
    let statement =
        check::circolare::Statement::read(&CheckFile::parse("a", loaded.text()).unwrap()).unwrap();
    statement.confidence_factor
}

const WALLS: &str = "[[walls]]\nname = \"low\"\ngeometry = { height = 1, thickness = 0.2, density = 1800 }\n\
                     force_law = { a1 = 0.05 }\n[[walls]]\nname = \"slender\"\ngeometry = { height = 2.4, \
                     thickness = 0.2, density = 1800 }\nforce_law = { a1 = 0.05 }\n";

/// A study of two parapets under eight motions; `more` is put above all tables.
fn text(more: &str) -> String {
    format!(
        "models = [\"CR\", \"CDR\"]\nlevels = {{ method = \"hunt\", first = 0.05, increase = 0.05, top = 5 \
         }}\nrecords = {{ synthetic = {{ count = 8 }} }}\nreport = {{ fractions = [0.4, 1.0], resamples = \
         200 }}\n\
         {more}{CHECK}SLC = {{ ag = 0.25, F0 = 2.4, TC = 0.3 }}\n{WALLS}"
    )
}

fn load(name: &str, text: &str) -> Result<LoadedStudy, String> {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.toml"));
    fs::write(&path, text).unwrap();
    LoadedStudy::read(&path).map_err(|error| error.to_string())
}

const MEASURE: &str = "intensity = { measure = \"code\" }\n";

/// Each number of the tables follows from the fragilities of the analysis and the verdict of the check.
#[test]
fn tables_follow_from_the_analysis_and_the_check() {
    let loaded = load("follows", &text(MEASURE)).unwrap();
    let path = run("follows", &loaded);
    let file = text(MEASURE);
    let file = CheckFile::parse("a", &file).unwrap();
    let code = read(&file).unwrap();
    let fitted = rows(&path.join("fragilities.csv"));
    let mut compared = 0;
    for row in rows(&path.join(FILES[0])) {
        let wall = loaded.study.walls().iter().find(|wall| wall.name == row["wall"]).unwrap();
        let verdict = code.check(Subject::new(&wall.parameters)).unwrap();
        let checked = verdict.rows.iter().find(|one| one.check == row["check"]).unwrap();
        let ground = checked.ground.unwrap()[0] * G / STANDARD_GRAVITY;
        assert!((number(&row, "ag_code_g") / ground - 1.0).abs() < 1e-12);
        assert_eq!(row["decides"], checked.decides.to_string());
        let is = |one: &&BTreeMap<String, String>| {
            one["wall"] == row["wall"]
                && one["model"] == row["model"]
                && (number(one, "u_max_over_u_ins") - number(&row, "u_over_u_ins")).abs() < 1e-9
        };
        // d_SLC is not among the fractions of the analysis
        let Some(curve) = fitted.iter().find(is) else {
            assert_eq!(row["event"], "beyond d_SLC");
            continue;
        };
        let [theta, beta] = [number(curve, "theta_g"), number(curve, "beta")];
        assert!((number(&row, "margin") / (theta / ground) - 1.0).abs() < 1e-9);
        let probability = cumulative((ground / theta).ln() / beta);
        assert!((number(&row, "probability") - probability).abs() < 1e-9);
        let [low, high] = [number(&row, "probability_low"), number(&row, "probability_high")];
        assert!(low <= probability && probability <= high, "{low} {probability} {high}");
        compared += 1;
    }
    // 2 walls, 2 models, 3 checks, d_SLV and the fall
    assert_eq!(compared, 24);
}

/// With the number that is found the wall just passes where the probability of a fall is the target.
#[test]
fn numbers_of_the_code_give_the_target() {
    let loaded =
        load("turned", &text(&format!("reliability = {{ probability = 0.02 }}\n{MEASURE}"))).unwrap();
    let path = run("turned", &loaded);
    let file = text("");
    let code = read(&CheckFile::parse("a", &file).unwrap()).unwrap();
    let safe = rows(&path.join(FILES[0]));
    let (mut found, mut open) = (0, 0);
    for row in rows(&path.join(FILES[1])) {
        let Ok(value) = row["value"].parse::<f64>() else {
            open += 1;
            continue;
        };
        let rule = Rule::ALL.into_iter().find(|rule| rule.name() == row["number"]).unwrap();
        let wall = loaded.study.walls().iter().find(|wall| wall.name == row["wall"]).unwrap();
        let varied = code.with_rule(&row["check"], rule, value).unwrap();
        let verdict = varied.check(Subject::new(&wall.parameters)).unwrap();
        let checked = verdict.rows.iter().find(|one| one.check == row["check"]).unwrap();
        let ground = checked.ground.unwrap()[0] * G / STANDARD_GRAVITY;
        let is = |one: &&BTreeMap<String, String>| {
            one["wall"] == row["wall"] && one["model"] == row["model"] && one["event"] == "fall"
        };
        let fall = safe.iter().find(is).unwrap();
        let curve = Lognormal { median: number(fall, "theta_g"), dispersion: number(fall, "beta") };
        // a step of the first search over 2^30, and a slope of P over ln(value) below 10
        assert!((curve.probability(ground) - 0.02).abs() < 1e-8, "{row:?} {}", curve.probability(ground));
        found += 1;
    }
    assert!(found >= 12 && found + open == 20, "{found} {open}");
}

/// The runs are those of the analysis alone, and a study that is done in parts has the same bytes.
#[test]
fn runs_are_those_of_the_analysis() {
    let loaded = load("alone", &text(MEASURE)).unwrap();
    let whole = run("whole", &loaded);
    let path = folder("alone");
    let of_parts = Folder::of_study(&path, &loaded).unwrap();
    let parts = of_parts.contents().parts();
    for part in [0, 1] {
        let mine: Vec<_> = (part..parts).step_by(2).collect();
        compute(&loaded.study, &of_parts, &of_parts.missing(mine), 1, |_, _| CONTINUE).unwrap();
    }
    study::folder::finish(&of_parts, 1, || {}).unwrap();
    finish(&of_parts, &Reliability::of(&loaded).unwrap(), 1, || {}).unwrap();
    for name in ["levels.csv", "fragilities.csv", "study.html"].into_iter().chain(FILES) {
        assert_eq!(fs::read(whole.join(name)).unwrap(), fs::read(path.join(name)).unwrap(), "{name}");
    }
}

/// The intensity is linear in the scale, 1 for a motion with the spectrum of a_g = 1, and `select` takes
/// those that fit best.
#[test]
fn records_that_fit_best_are_selected() {
    let all = load("all", &text(MEASURE)).unwrap();
    let measure = all.study.measure();
    for (index, record) in all.study.records().iter().enumerate() {
        let worth = measure.of(&record.motion).unwrap();
        assert_eq!(worth, all.study.intensity(index));
        let twice = measure.of(&record.motion.scaled(2.0)).unwrap();
        assert!((twice / worth - 2.0).abs() < 1e-12);
        let ratios = measure.ratios(&record.motion).unwrap().unwrap();
        assert_eq!(ratios.len(), 19);
        // the geometric mean of the ratios is 1
        assert!(ratios.iter().map(|ratio| ratio.ln()).sum::<f64>().abs() < 1e-12);
    }
    let rms = |record: &NamedRecord| {
        let ratios = measure.ratios(&record.motion).unwrap().unwrap();
        (ratios.iter().map(|ratio| ratio.ln().powi(2)).sum::<f64>() / ratios.len() as f64).sqrt()
    };
    let mut order: Vec<_> = all.study.records().iter().collect();
    order.sort_by(|a, b| rms(a).total_cmp(&rms(b)));
    let mut best: Vec<_> = order[..3].iter().map(|record| record.name.clone()).collect();
    let chosen = load("chosen", &text("intensity = { measure = \"code\", select = 3 }\n")).unwrap();
    let mut found: Vec<_> = chosen.study.records().iter().map(|record| record.name.clone()).collect();
    best.sort();
    found.sort();
    assert_eq!(found, best);
}

/// What cannot be answered is refused, with the remedy.
#[test]
fn what_cannot_be_answered_is_refused() {
    let refusal = |name: &str, text: String| match load(name, &text) {
        Ok(loaded) => Reliability::of(&loaded).err().map(|error| error.to_string()).unwrap_or_default(),
        Err(message) => message,
    };
    let with = |intensity: &str| text(&format!("intensity = {intensity}\n"));
    let own = |change: [&str; 2]| text(MEASURE).replace(change[0], change[1]);
    let building = "SLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }\n\
                    building = { height_ratio = 0.8, period = 0.3, storeys = 2 }\n";
    for (name, text, parts) in [
        ("pga", with("{ measure = \"PGA\" }"), &["a_g of the site", "measure = \"code\""][..]),
        ("select", with("{ measure = \"PGA\", select = 2 }"), &["line ", "select", "measure = \"code\""]),
        ("many", with("{ measure = \"code\", select = 9 }"), &["select = 9", "8 records"]),
        ("none", with("{ measure = \"code\", select = 0 }"), &["select = 0"]),
        ("period", with("{ measure = \"code\", periods = [0] }"), &["line ", "periods: 0 s", "above 0"]),
        ("empty", with("{ measure = \"code\", periods = [] }"), &["line "]),
        ("one", with("{ measure = \"code\", period = 1 }"), &["line ", "list of periods"]),
        (
            "points",
            own(["F0 = 2.4, TC = 0.3 }\nSLC", "spectrum = [[0, 1], [4, 1]], spectrum_damping = 0.08 }\nSLC"]),
            &["F0 and TC of SLV"],
        ),
        (
            "building",
            own(["SLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }\n", building]),
            &["wall \"low\"", "[[storeys]]"],
        ),
        (
            "target",
            text(&format!("reliability = {{ probability = 1.0 }}\n{MEASURE}")),
            &["line ", "probability = 1", "below 1"],
        ),
    ] {
        let message = refusal(&format!("refused_{name}"), text);
        assert!(parts.iter().all(|part| message.contains(part)), "{name}: {message}");
    }
    let unchecked = "models = [\"CR\"]\nlevels = { method = \"step\", step = 0.1, top = 2 }\nrecords = { \
                     synthetic = { count = 2 } }\nintensity = { measure = \"code\" }\n";
    let message = refusal("refused_unchecked", format!("{unchecked}{WALLS}"));
    assert!(message.contains("the table [check] is missing"), "{message}");
}

/// Over a hazard that is one power law, k₀ x^−k, the rate of a wall that just passes at the site is
/// k₀ θ^−k exp(k²β²/2), θ = margin a_g,site; from 1e-4 g to 1e6 g, beyond which λ is 1e-16.
#[test]
fn annual_rates_are_those_of_a_power_law() {
    let [k0, k]: [f64; 2] = [1e-4, 2.0];
    let point = |x: f64| format!("[{x:e}, {:e}]", k0 * x.powf(-k));
    let hazard = format!("hazard = {{ points = [{}, {}] }}\n", point(1e-4), point(1e6));
    let loaded = load("hazard", &text(&format!("{hazard}{MEASURE}"))).unwrap();
    let rows = rows(&run("hazard", &loaded).join(FILES[0]));
    for row in &rows {
        let site = if row["check"] == "SLC" { 0.25 } else { 0.2 } * G / STANDARD_GRAVITY;
        let [margin, beta] = [number(row, "margin"), number(row, "beta")];
        let expected = k0 * (margin * site).powf(-k) * (0.5 * (k * beta).powi(2)).exp();
        assert!((number(row, "annual_rate") / expected - 1.0).abs() < 1e-9, "{row:?}");
    }
    assert_eq!(rows.len(), 36);
}

/// Of a wall that is alike on both sides both signs of a record tell the same: as pairs they change no number
/// by more than the fits' 1e-9, and ζ by the records counts each record once. The worst changes no byte.
#[test]
fn signs_of_records_count_once() {
    let of = |polarity: &str| {
        let text = format!("polarity = \"{polarity}\"\n{}", text(MEASURE));
        let name = format!("signs_{polarity}");
        run(&name, &load(&name, &text).unwrap())
    };
    let [plain, both, worst] = ["as_recorded", "both", "worst"].map(of);
    let table = "reliability.csv";
    assert_eq!(fs::read(plain.join(table)).unwrap(), fs::read(worst.join(table)).unwrap());
    let mut compared = 0;
    for (one, other) in rows(&plain.join(table)).iter().zip(rows(&both.join(table))) {
        for (name, cell) in one {
            match (cell.parse::<f64>(), other[name].parse::<f64>()) {
                (Ok(one), Ok(other)) if one.is_finite() => {
                    let times = if name == "records" { 2.0 } else { 1.0 };
                    assert!((times * one - other).abs() <= 1e-9 * one.abs(), "{name}: {one}, {other}");
                    compared += usize::from(name == "dynamic_zeta" || name == "theta_g");
                }
                _ => assert_eq!(*cell, other[name], "{name}"),
            }
        }
    }
    assert!(compared > 4, "{compared}");
}
