//! Tests how safe walls are that just pass a check.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use check::{CheckFile, Rule, Subject, WallCodes, read};
use fragility::{Lognormal, cumulative};
use ground_motion::STANDARD_GRAVITY;
use reliability::{Codes, FILES, Reliability, finish};
use run::records::NamedRecord;
use study::folder::{Contents, Folder, Report, compute};
use study::loaded::LoadedStudy;

use crate::folders::{self, folder, number, rows, run_analysis};
use crate::tables::{self, WALLS, least};

/// g of codes [m/s²].
pub(crate) const G: f64 = 9.81;
pub(crate) const CHECK: &str = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\n\
                                soil = \"A\"\nSLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }\n";

/// Reads a study that names a code.
pub(crate) fn load(name: &str, text: &str) -> Result<LoadedStudy, String> {
    folders::load(name, text, &Codes)
}

/// Runs a study of reliability, and returns its folder.
pub(crate) fn run(name: &str, loaded: &LoadedStudy) -> PathBuf {
    run_reported(name, loaded).0
}

/// Runs a study of reliability, and returns its folder and what is told of it.
pub(crate) fn run_reported(name: &str, loaded: &LoadedStudy) -> (PathBuf, Report) {
    let path = run_analysis(name, loaded);
    let folder = Folder::open(&path).unwrap();
    let report = finish(&folder, &Reliability::of(loaded).unwrap(), 2).unwrap();
    (path, report)
}

/// The codes of the walls of a study.
pub(crate) fn code_of(loaded: &LoadedStudy) -> WallCodes {
    WallCodes::read(&CheckFile::parse("a", &loaded.text).unwrap(), loaded.study.walls()).unwrap()
}

const MEASURE: &str = "intensity = { measure = \"code\" }\n";

/// A study of three parapets under eight motions, with a measure.
fn text(more: &str) -> String {
    tables::text("", 8, WALLS).replace(MEASURE, more)
}

/// Each number of the tables follows from the fragilities of the analysis and the verdict of the check.
#[test]
fn tables_follow_from_the_analysis_and_the_check() {
    let loaded = load("follows", &text(MEASURE)).unwrap();
    let path = run("follows", &loaded);
    let code = code_of(&loaded);
    let fitted = rows(&path.join("fragilities.csv"));
    let mut compared = 0;
    for row in rows(&path.join(FILES[0])) {
        let wall = loaded.study.walls().iter().find(|wall| wall.name == row["wall"]).unwrap();
        let verdict = code.of(wall).check(Subject::new(&wall.parameters)).unwrap();
        let checked = least(&verdict.rows, &row["check"]);
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
    // 3 walls, 2 models, 3 checks, d_SLV and the fall
    assert_eq!(compared, 36);
}

/// A β of modelling is in β, in P and its interval, and in the rate, as in `rates.csv`; margins stay.
#[test]
fn modelling_uncertainty_is_in_every_probability() {
    let hazard = "hazard = { points = [[0.05, 3e-2], [0.2, 2e-3], [3.0, 1e-6]] }\n";
    let plain = text(MEASURE).replace(MEASURE, &format!("{MEASURE}{hazard}"));
    let path = run("modelled", &load("modelled", &plain).unwrap());
    let narrow = rows(&path.join(FILES[0]));
    let wide = plain.replace("resamples = 200", "resamples = 200, modelling_uncertainty = 0.3");
    let loaded = load("modelled", &wide).unwrap();
    let folder = Folder::of_study(&path, &loaded).unwrap();
    study::folder::finish(&folder, 2).unwrap();
    finish(&folder, &Reliability::of(&loaded).unwrap(), 2).unwrap();
    let rates = rows(&path.join("rates.csv"));
    for (before, row) in narrow.iter().zip(rows(&path.join(FILES[0]))) {
        let beta = number(before, "beta").hypot(0.3);
        assert!((number(&row, "beta") / beta - 1.0).abs() < 1e-14 && row["margin"] == before["margin"]);
        let probability = |margin: f64| cumulative(-margin.ln() / beta);
        assert!((number(&row, "probability") - probability(number(&row, "margin"))).abs() < 1e-12);
        // a wider curve is nearer to one half
        let from_half = |row: &BTreeMap<String, String>| (number(row, "probability_low") - 0.5).abs();
        assert!(from_half(&row) < from_half(before), "{before:?} {row:?}");
        let is_same = |one: &&BTreeMap<String, String>| {
            ["wall", "model"].iter().all(|name| one[*name] == row[*name])
                && number(one, "u_max_over_u_ins") == number(&row, "u_over_u_ins")
        };
        let of_rates = rates.iter().find(is_same).map(|one| number(one, "beta"));
        assert!(row["event"] != "fall" || of_rates == Some(number(&row, "beta")), "{of_rates:?} {row:?}");
    }
}

/// With the number that is found the wall just passes where the probability of a fall is the target.
#[test]
fn numbers_of_the_code_give_the_target() {
    let loaded =
        load("turned", &text(&format!("reliability = {{ probability = 0.02 }}\n{MEASURE}"))).unwrap();
    let path = run("turned", &loaded);
    let code = code_of(&loaded);
    let safe = rows(&path.join(FILES[0]));
    let (mut found, mut open) = (0, 0);
    for row in rows(&path.join(FILES[1])) {
        let Ok(value) = row["value"].parse::<f64>() else {
            open += 1;
            continue;
        };
        let rule = Rule::ALL.into_iter().find(|rule| rule.name() == row["number"]).unwrap();
        let wall = loaded.study.walls().iter().find(|wall| wall.name == row["wall"]).unwrap();
        let ground = |value: f64| {
            let varied = code.of(wall).with_rule(&row["check"], rule, value).unwrap();
            let verdict = varied.check(Subject::new(&wall.parameters)).unwrap();
            least(&verdict.rows, &row["check"]).ground.unwrap()[0] * G / STANDARD_GRAVITY
        };
        let is = |one: &&BTreeMap<String, String>| {
            one["wall"] == row["wall"] && one["model"] == row["model"] && one["event"] == "fall"
        };
        let fall = safe.iter().find(is).unwrap();
        let curve = Lognormal { median: number(fall, "theta_g"), dispersion: number(fall, "beta") };
        // a step of the first search over 2^30, and a slope of P over ln(value) below 10
        let there = curve.probability(ground(value));
        assert!((there - 0.02).abs() < 1e-8, "{row:?} {there}");
        // none is nearer to that of the code
        let own = number(&row, "code");
        let safer =
            |part: i32| curve.probability(ground(own * (value / own).powf(f64::from(part) / 20.0))) < 0.02;
        assert!((1..20).all(|part| safer(part) == safer(0)), "{row:?}");
        found += 1;
    }
    assert!(found >= 18 && found + open == 30, "{found} {open}");
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
        compute(&loaded.study, &of_parts, &of_parts.missing(mine), 1).unwrap();
    }
    study::folder::finish(&of_parts, 1).unwrap();
    finish(&of_parts, &Reliability::of(&loaded).unwrap(), 1).unwrap();
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
            "dynamic",
            own(["SLV = {", "method = \"dynamic\"\nSLV = {"]),
            &["takes runs", "leave out method = \"dynamic\""],
        ),
        (
            "bar",
            own([
                "SLV = {",
                "tie = { bar = { diameter = 0.016, length = 1.0, yield_stress = 3.9e8 } }\nSLV = {",
            ]),
            &["wall \"low\"", "[check.tie]", "[tie] of the wall"],
        ),
        (
            "cloud",
            own(["{ method = \"hunt\", first = 0.05, increase = 0.05, top = 5 }", "{ method = \"cloud\" }"]),
            &[
                "method of [levels]",
                "clouds and stripes run each record once",
                "such as levels = { method = \"hunt\", first = 0.05",
            ],
        ),
        ("all", own(["thickness", "width"]), &["no wall can be checked; wall \"low\"", "thickness"]),
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

/// Records of the check have no part, and are not read.
#[test]
fn records_of_the_check_are_not_read() {
    let with = text(MEASURE).replace("SLC = { ag", "records = { files = [\"none.AT2\"] }\nSLC = { ag");
    let loaded = load("unread", &with).unwrap();
    Reliability::of(&loaded).unwrap();
    assert_eq!(loaded.study.measure(), load("measured", &text(MEASURE)).unwrap().study.measure());
    let message = read(&CheckFile::parse("a", &with).unwrap()).unwrap_err().to_string();
    assert!(message.contains("none.AT2"), "{message}");
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
    assert_eq!(rows.len(), 54);
}

/// Of a wall that is alike on both sides both signs of a record tell the same: as pairs they change no number
/// by more than the fits' 1e-9, and ζ by the records counts each record once. The worst changes no digit.
#[test]
fn signs_of_records_count_once() {
    let of = |polarity: &str| {
        let text = format!("polarity = \"{polarity}\"\n{}", text(MEASURE));
        let name = format!("signs_{polarity}");
        run(&name, &load(&name, &text).unwrap())
    };
    let [plain, both, worst] = ["as_recorded", "both", "worst"].map(of);
    // the sides of the loaded wall differ
    let alike = |folder: PathBuf| {
        rows(&folder.join(FILES[0])).into_iter().filter(|row| row["wall"] != "loaded").collect::<Vec<_>>()
    };
    let [plain, both, worst] = [plain, both, worst].map(alike);
    assert!(plain == worst, "the worst sign changes a number");
    let mut compared = 0;
    for (one, other) in plain.iter().zip(&both) {
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

/// A study that is sent holds the lines of the grid that its check names: it has the same contents where
/// there is no such file.
#[test]
fn a_grid_is_sent_with_the_study() {
    let folder = folder("sent_grid");
    fs::create_dir_all(&folder).unwrap();
    let node = |place: &str| format!("{place},0.1,2.4,0.3,0.3,2.5,0.35\n");
    let nodes = ["13.0,42.0", "13.05,42.0", "13.05,42.05", "13.0,42.05"].map(node).concat();
    let names = "lon,lat,ag_30,F0_30,TC_30,ag_3000,F0_3000,TC_3000\n";
    fs::write(folder.join("grid.csv"), names.to_owned() + &nodes).unwrap();
    let site = "site = { grid = \"grid.csv\", coordinates = [42.02, 13.03], nominal_life = 50, \
                use_coefficient = 1 }\nSLV = {}\n";
    let own = "SLV = { ag = 0.2, F0 = 2.4, TC = 0.3 }\n";
    let text = text(MEASURE).replace(own, site);
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    let loaded = LoadedStudy::read(&path, &Codes).unwrap();
    let sent = loaded.sent(&Codes);
    assert!(!sent.text.contains("grid.csv"));
    let received = LoadedStudy::received(sent, &Codes).unwrap();
    assert!(Contents::of(&received.study) == Contents::of(&loaded.study));
    assert!(Reliability::of(&received).is_ok());
}
