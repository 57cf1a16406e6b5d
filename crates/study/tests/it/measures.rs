//! Which intensity measure to choose: numbers of `measures.csv` beside regressions of their own, and what is
//! refused.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::{Path, PathBuf};

use study::codes::NoCodes;
use study::ida::IntensityMeasure;
use study::loaded::LoadedStudy;

use crate::folders::{load, number, rows, run_analysis as run};

const TABLE: &str = "magnitude,station,record,distance_km\n6.1,A,synthetic 1,12\n5.4,B,synthetic 2,3.5\n\
    6.9,C,synthetic 3,31\n7.2,D,synthetic 4,18\n5.9,E,synthetic 5,44\n6.0,F,another,9\n";
const MEASURES: [&str; 5] = ["PGA", "PGV", "Arias", "Sa(0.5 s)", "AvgSA"];

/// A study that compares measures, with its levels and other keys.
fn text(intensity: &str, levels: &str) -> String {
    format!(
        "models = [\"CR\", \"CDC\"]\n{levels}\n\
         records = {{ synthetic = {{ count = 5, duration = 10, step = 0.01 }} }}\n\
         intensity = {{ {intensity} }}\nreport = {{ fractions = [1], resamples = 100 }}\n\
         walls = [{{ name = \"a\", geometry = {{ height = 3, thickness = 0.3 }} }}, {{ name = \"b\", \
         geometry = {{ height = 2, thickness = 0.3 }} }}]\n"
    )
}

/// Writes a table of records for a test, and returns its name beside the study files.
fn table(name: &str, content: &str) -> String {
    let file = format!("{name}.csv");
    fs::write(Path::new(env!("CARGO_TARGET_TMPDIR")).join(&file), content).unwrap();
    file
}

fn compared(name: &str, measure: &str, levels: &str) -> (LoadedStudy, PathBuf) {
    let file = table(name, TABLE);
    let intensity = format!(
        "measure = \"{measure}\", compare = [\"PGA\", \"PGV\", \"Arias\", \"Sa(0.5)\", \"AvgSA\"], \
         records_table = \"{file}\""
    );
    let loaded = load(name, &text(&intensity, levels), &NoCodes).unwrap();
    let path = run(name, &loaded);
    (loaded, path)
}

/// A point of a regression: the group, x, y and a feature.
type Given = (usize, f64, f64, f64);

/// Slope, standard deviation, and p of the slope of residuals over the feature, from the definitions: y and x
/// less their means in each group. Without x the slope is 0.
fn regression(points: &[Given], has_slope: bool) -> [f64; 3] {
    let mut groups: BTreeMap<usize, Vec<&Given>> = BTreeMap::new();
    for point in points {
        groups.entry(point.0).or_default().push(point);
    }
    let mean = |of: &dyn Fn(&Given) -> f64, all: &[&Given]| {
        all.iter().map(|point| of(point)).sum::<f64>() / all.len() as f64
    };
    let centred: Vec<[f64; 3]> = groups
        .values()
        .flat_map(|all| {
            let [x, y] = [mean(&|point| point.1, all), mean(&|point| point.2, all)];
            all.iter().map(move |point| [point.1 - x, point.2 - y, point.3]).collect::<Vec<_>>()
        })
        .collect();
    let sum = |of: &dyn Fn(&[f64; 3]) -> f64| centred.iter().map(of).sum::<f64>();
    let slope = if has_slope { sum(&|p| p[0] * p[1]) / sum(&|p| p[0] * p[0]) } else { 0.0 };
    let rest = |p: &[f64; 3]| p[1] - slope * p[0];
    let freedom = points.len() - groups.len() - usize::from(has_slope);
    let n = points.len() as f64;
    let z = sum(&|p| p[2]) / n;
    let [zz, zr] = [sum(&|p| (p[2] - z).powi(2)), sum(&|p| (p[2] - z) * rest(p))];
    let left = sum(&|p| (rest(p) - zr / zz * (p[2] - z)).powi(2));
    let t = (zr / zz).abs() / (left / (n - 2.0) / zz).sqrt();
    [slope, (sum(&|p| rest(p).powi(2)) / freedom as f64).sqrt(), two_sided(t, n - 2.0)]
}

/// P(|T| > t) of Student's t: the integral of cosᵛ⁻¹ from atan(t/√ν) to π/2, over that from 0, by Simpson's
/// rule with 20,000 steps.
fn two_sided(t: f64, freedom: f64) -> f64 {
    let integral = |from: f64| {
        let step = (FRAC_PI_2 - from) / 20_000.0;
        let weight = |k: u32| {
            if k % 2 == 1 {
                4.0
            } else if k == 0 || k == 20_000 {
                1.0
            } else {
                2.0
            }
        };
        let at = |k: u32| (from + step * f64::from(k)).cos().max(0.0).powf(freedom - 1.0);
        step / 3.0 * (0..=20_000).map(|k| weight(k) * at(k)).sum::<f64>()
    };
    integral((t / freedom.sqrt()).atan()) / integral(0.0)
}

/// A run of `levels.csv` by the names of its columns.
type Row = BTreeMap<String, String>;

/// The study with what a comparison needs of its records.
struct Source {
    loaded: LoadedStudy,
    runs: Vec<Row>,
    features: [(&'static str, Vec<f64>); 3],
}

impl Source {
    fn record(&self, run: &Row) -> usize {
        self.loaded.study.records().iter().position(|own| own.name == run["record"]).unwrap()
    }

    /// ln of the intensity of a run's record in a measure, scaled to a level of PGA in g.
    fn log(&self, measure: &IntensityMeasure, run: &Row, level: f64) -> f64 {
        let motion = &self.loaded.study.records()[self.record(run)].motion;
        let factor = level * IntensityMeasure::Pga.unit().size() / motion.peak();
        measure.unit().of(measure.of(&motion.scaled(factor)).unwrap()).ln()
    }

    /// Points of ln D over ln IM of the runs that stand, and of ln θ, with a feature of the records.
    fn points(&self, own: &[&Row], measure: &IntensityMeasure, values: &[f64]) -> [Vec<Given>; 2] {
        let group = |run: &Row| usize::from(run["wall"] == "b");
        let fell = |run: &Row| run["overturned"] == "true";
        let stands = own.iter().filter(|run| !fell(run));
        let demands = stands.map(|run| {
            let x = self.log(measure, run, number(run, "intensity_g"));
            (group(run), x, number(run, "u_max_over_u_ins").ln(), values[self.record(run)])
        });
        let curves = own.chunk_by(|one, other| ["wall", "record"].iter().all(|key| one[*key] == other[*key]));
        let collapses = curves.filter_map(|curve| {
            let first = curve.iter().position(|run| fell(run)).filter(|first| *first > 0)?;
            let [below, at] = [curve[first - 1], curve[first]].map(|run| number(run, "intensity_g"));
            let theta = self.log(measure, curve[0], (below * at).sqrt());
            Some((group(curve[0]), 0.0, theta, values[self.record(curve[0])]))
        });
        [demands.collect(), collapses.collect()]
    }
}

/// Every number of every wall and model and of all walls follows from `levels.csv` and the records.
#[test]
fn numbers_follow_from_the_runs() {
    let levels = "levels = { method = \"hunt\", first = 0.1, increase = 0.1, top = 4 }";
    let (loaded, path) = compared("measures_numbers", "PGA", levels);
    let records = loaded.study.records();
    let features = [
        ("duration", records.iter().map(|record| record.motion.significant_duration()).collect()),
        ("magnitude", vec![6.1, 5.4, 6.9, 7.2, 5.9]),
        ("distance", vec![12.0, 3.5, 31.0, 18.0, 44.0]),
    ];
    let source = Source { runs: rows(&path.join("levels.csv")), loaded, features };
    let measures = [
        IntensityMeasure::Pga,
        IntensityMeasure::Pgv,
        IntensityMeasure::Arias,
        IntensityMeasure::Sa { period: 0.5 },
        IntensityMeasure::default(),
    ];
    let found = rows(&path.join("measures.csv"));
    // 2 walls and all, 2 models, 5 measures
    assert_eq!(found.len(), 3 * 2 * 5);
    for row in &found {
        let measure = &measures[MEASURES.iter().position(|name| *name == row["measure"]).unwrap()];
        let is_own = |run: &&Row| {
            run["model"] == row["model"] && (row["wall"] == "all walls" || run["wall"] == row["wall"])
        };
        let own: Vec<_> = source.runs.iter().filter(is_own).collect();
        for (name, values) in &source.features {
            let [demands, collapses] = source.points(&own, measure, values);
            let [slope, deviation, p] = regression(&demands, true);
            let [_, spread, p_theta] = regression(&collapses, false);
            let records = if row["wall"] == "all walls" { 10 } else { 5 };
            let counts = [records, records - collapses.len(), demands.len(), own.len() - demands.len()];
            let columns = ["records", "censored", "runs", "left_out"];
            assert_eq!(columns.map(|column| row[column].clone()), counts.map(|count| count.to_string()));
            for (column, expected) in [
                ("b", slope),
                ("sigma_ln_d", deviation),
                ("proficiency", deviation / slope),
                (&format!("p_d_{name}"), p),
                ("sigma_ln_theta", spread),
                (&format!("p_theta_{name}"), p_theta),
            ] {
                // of p about 1e-9 of the integrals, and roundings of sums of some hundred points
                let value = number(row, column);
                assert!((value / expected - 1.0).abs() < 1e-6, "{column} {value}, {expected}\n{row:?}");
            }
        }
    }
    let page = fs::read_to_string(path.join("study.html")).unwrap();
    assert!(page.contains("Which intensity measure?") && page.contains("Wall by wall"));
}

/// A cloud has the same runs whatever its measure, and the comparison the same numbers; the exponent of Arias
/// intensity goes both ways. A record is scaled by a root and its square, which cancel to some roundings.
#[test]
fn the_study_s_own_measure_makes_no_difference() {
    let levels = "levels = { method = \"cloud\", scale = 0.8 }";
    let [by_pga, by_arias] = ["PGA", "Arias"].map(|measure| {
        let (_, path) = compared(&format!("measures_cloud_{measure}"), measure, levels);
        rows(&path.join("measures.csv"))
    });
    assert_eq!(by_pga.len(), 30);
    let mut compared = 0;
    for (one, other) in by_pga.iter().zip(&by_arias) {
        for (column, value) in one {
            match (value.parse::<f64>(), other[column].parse::<f64>()) {
                (Ok(a), Ok(b)) if a != b => {
                    assert!((a / b - 1.0).abs() < 1e-7, "{column}: {a}, {b}");
                    compared += 1;
                }
                _ => assert_eq!(value, &other[column], "{column}"),
            }
        }
        // one run of a record tells no collapse
        assert_eq!((&*one["censored"], &*one["sigma_ln_theta"]), (&*one["records"], ""));
    }
    assert!(compared > 0);
}

/// Records that stand at the highest level and those that collapse at the lowest are counted, and left out.
#[test]
fn censored_records_are_counted() {
    let levels = "levels = { method = \"grid\", values = [0.3, 0.35, 0.4] }";
    let (_, path) = compared("measures_censored", "PGA", levels);
    let collapses = rows(&path.join("collapses.csv"));
    let mut kinds = [0; 2];
    for row in rows(&path.join("measures.csv")).iter().filter(|row| row["walls"] == "1") {
        let own = collapses.iter().filter(|one| one["wall"] == row["wall"] && one["model"] == row["model"]);
        let is_known = |one: &&BTreeMap<String, String>| {
            one["collapse_g"].parse().is_ok_and(|collapse: f64| collapse > 0.31)
        };
        let known = own.filter(is_known).count();
        assert_eq!(row["censored"], (5 - known).to_string(), "{row:?}");
        assert_eq!(row["sigma_ln_theta"].is_empty(), known < 2, "{row:?}");
        kinds[usize::from(known < 5)] += 1;
    }
    assert!(kinds[1] > 0, "{kinds:?}");
}

/// Both signs of a record have its duration, magnitude and distance; a study that compares no more loses the
/// table, and its description does not know of it.
#[test]
fn both_signs_are_records() {
    let levels = "polarity = \"both\"\nlevels = { method = \"cloud\" }";
    let (_, path) = compared("measures_both", "PGA", levels);
    let found = rows(&path.join("measures.csv"));
    assert!(found.iter().all(|row| row["records"] == if row["walls"] == "2" { "20" } else { "10" }));
    assert!(fs::read_to_string(path.join("study.json")).unwrap().contains("\"compared\""));
    let plain = load("measures_plain", &text("measure = \"PGA\"", levels), &NoCodes).unwrap();
    let folder = study::folder::Folder::of_study(&path, &plain).unwrap();
    assert_eq!(folder.missing(0..folder.contents().parts()), Vec::<usize>::new());
    study::folder::finish(&folder, 1).unwrap();
    assert!(!path.join("measures.csv").exists());
    assert!(!fs::read_to_string(path.join("study.json")).unwrap().contains("compared"));
    assert!(!fs::read_to_string(path.join("study.html")).unwrap().contains("Which intensity measure"));
}

const CLOUD: &str = "levels = { method = \"cloud\" }";

/// What is said of a study; `name` is that of its file.
fn refused(name: &str, intensity: &str) -> String {
    let text = text(&format!("measure = \"PGA\", {intensity}"), CLOUD);
    load(name, &text, &NoCodes).unwrap_err()
}

#[test]
fn measures_that_cannot_be_compared_are_refused_with_place_and_remedy() {
    for (intensity, message) in [
        (
            "compare = [\"PGC\"]",
            "line 4: compare: \"PGC\" is not one of PGA, PGV, PGD, Sa, AvgSA, Arias, CAV, Housner, code \
             (did you mean \"PGA\"?); Sa has its period, as in \"Sa(0.5)\"",
        ),
        ("compare = [\"PGV\", \"PGV\"]", "line 4: compare lists \"PGV\" twice; leave one out"),
        ("compare = [\"Sa(0.5)\", \"Sa(0.50 s)\"]", "line 4: compare lists \"Sa(0.50 s)\" twice"),
        ("compare = []", "line 4: intensity.compare needs at least 1 value, found 0"),
        ("compare = \"PGV\"", "line 4: compare = \"PGV\": expected a list"),
        ("compare = [3]", "line 4: compare = 3: expected a text"),
        ("compare = [\"Sa\"]", "line 4: \"Sa\" in compare needs its period in s, such as \"Sa(0.5)\""),
        ("compare = [\"Sa(-1)\"]", "line 4: \"Sa(-1)\" in compare: the period must be a number of s above 0"),
        ("compare = [\"Sa(x s)\"]", "line 4: \"Sa(x s)\" in compare: the period must be a number"),
        ("compare = [\"code\"]", "line 4: measure = \"code\" needs the spectrum of the site"),
        ("compare = [\"PGV\"], records_table = 3", "line 4: records_table = 3: expected a text"),
        ("records_table = \"a.csv\"", "line 4: records_table belongs to compare"),
        ("compare = [\"PGV\"], records_table = \"none.csv\"", "none.csv: "),
    ] {
        let found = refused("measures_refused", intensity);
        assert!(found.contains(message), "{found}\nfor {message}");
    }
    let few = text("measure = \"PGA\", compare = [\"PGV\"]", CLOUD).replace("count = 5", "count = 2");
    let found = load("measures_few", &few, &NoCodes).unwrap_err();
    assert!(
        found.contains("line 4: compare needs at least 3 records, and the study has 2 records"),
        "{found}"
    );
}

#[test]
fn tables_of_records_are_refused_with_place_and_remedy() {
    for (name, content, message) in [
        (
            "name",
            TABLE.replace("record,", "name,"),
            "line 1: no column `record`; expected a table of records",
        ),
        (
            "neither",
            TABLE.replace("magnitude", "size").replace("distance_km", "away"),
            "line 1: no column `magnitude` or `distance_km`",
        ),
        (
            "initial",
            TABLE.replace("magnitude", "M"),
            "line 1: unknown column \"M\" (did you mean \"magnitude\"?); rename or delete it",
        ),
        (
            "unit",
            TABLE.replace("distance_km", "Distance [km]"),
            "line 1: unknown column \"Distance [km]\" (did you mean \"distance_km\"?)",
        ),
        ("number", TABLE.replace("5.4", "ML 5"), "line 3: magnitude of the record \"synthetic 2\": "),
        (
            "empty",
            TABLE.replace("5.4", ""),
            "line 3: magnitude of the record \"synthetic 2\": the cell is empty; write",
        ),
        (
            "large",
            TABLE.replace("5.4", "54"),
            "line 3: magnitude of the record \"synthetic 2\": 54 must be from 0 to 10",
        ),
        (
            "far",
            TABLE.replace(",31", ",31000"),
            "line 4: distance_km of the record \"synthetic 3\": 31000 must be from 0 to 20000",
        ),
        (
            "below",
            TABLE.replace(",31", ",-1"),
            "distance_km of the record \"synthetic 3\": -1 must be from 0",
        ),
        (
            "twice",
            TABLE.replace("another", "synthetic 1"),
            "line 7: the record \"synthetic 1\" is listed twice; delete one row",
        ),
        (
            "lacking",
            TABLE.replace("synthetic 4", "synthetic_4"),
            "csv has no record \"synthetic 4\"; add a row with this name, that of its file",
        ),
        ("nothing", String::new(), "expected a table of records"),
    ] {
        let file = table(&format!("measures_refused_{name}"), &content);
        let intensity = format!("compare = [\"PGV\"], records_table = \"{file}\"");
        let found = refused("measures_table_refused", &intensity);
        assert!(found.contains(message), "{found}\nfor {message}");
        assert!(found.contains(&file) || name == "nothing", "{found}");
    }
}

/// A feature that is the same in all records is no fault.
#[test]
fn one_magnitude_of_all_is_told() {
    let content: String = "record,magnitude\n".to_owned()
        + &(1..=5).map(|k| format!("synthetic {k},6.5")).collect::<Vec<_>>().join("\n");
    let same = table("measures_same", &content);
    let intensity = format!("measure = \"PGA\", compare = [\"PGV\"], records_table = \"{same}\"");
    let loaded = load("measures_alike", &text(&intensity, CLOUD), &NoCodes).unwrap();
    let told = "compare: the magnitude is the same in all records; it explains nothing, and has no p-value";
    assert!(loaded.warnings.iter().any(|warning| warning.contains(told)), "{:?}", loaded.warnings);
    let found = rows(&run("measures_alike", &loaded).join("measures.csv"));
    assert!(found.iter().all(|row| row["p_d_magnitude"].is_empty() && !row["p_d_duration"].is_empty()));
}
