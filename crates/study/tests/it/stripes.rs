//! Stripes whose levels have records of their own, as studies of conditional spectra have them.

use std::fs;
use std::path::{Path, PathBuf};

use fragility::{Sample, fit};
use ground_motion::SyntheticMotion;
use study::codes::NoCodes;
use study::ida::{Curve, Run};
use study::loaded::LoadedStudy;

use crate::folders::{number, rows, run_analysis};

/// A folder with the records `1.txt` to `6.txt`, and lists of them with factors for three levels.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    for seed in 1..=6 {
        let motion = SyntheticMotion { seed, duration: 10.0, step: 0.01, peak: 2.0 }.motion().unwrap();
        let samples: Vec<_> = motion.samples().iter().map(f64::to_string).collect();
        fs::write(folder.join(format!("{seed}.txt")), samples.join("\n")).unwrap();
    }
    let list = |name: &str, rows: &str| {
        fs::write(folder.join(name), format!("file,scale_factor,weight\n{rows}")).unwrap();
    };
    list("low.csv", "1.txt,0.5,1\n2.txt,0.6,3\n3.txt,0.5,1\n");
    list("middle.csv", "2.txt,1.2,1\n3.txt,1.1,1\n4.txt,1.3,1\n5.txt,1.2,1\n");
    list("high.csv", "4.txt,2.2,2\n5.txt,2.4,1\n6.txt,2.3,2\n");
    folder
}

const STRIPES: &str = "levels = { method = \"stripes\", unit = \"g\", stripe = [\
    { intensity = 0.1, selection = \"low.csv\" }, { intensity = 0.25, selection = \"middle.csv\" }, \
    { intensity = 0.5, selection = \"high.csv\" }] }\n";
const RECORDS: &str = "records = { format = \"numbers\", step = 0.01, unit = \"m/s2\" }\n";

fn load(folder: &Path, levels: &str, more: &str) -> Result<LoadedStudy, String> {
    let text = format!(
        "models = [\"CR\"]\nintensity = {{ measure = \"PGA\" }}\n{levels}{more}\
         walls = [{{ name = \"w\", geometry = {{ height = 3, thickness = 0.3 }} }}]\n"
    );
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    LoadedStudy::read(&path, &NoCodes).map_err(|error| error.to_string())
}

/// Each record is run once, as its list scales it: the run is that of a cloud of the list, to the last bit,
/// but for the level that it stands for. Weights have a mean of 1 in each list.
#[test]
fn records_are_run_once_at_the_level_of_their_list() {
    let folder = folder("stripes");
    let loaded = load(&folder, STRIPES, RECORDS).unwrap();
    let study = &loaded.study;
    let names: Vec<_> = study.records().iter().map(|record| record.name.as_str()).collect();
    assert_eq!((names.len(), names[1], names[3]), (10, "2.txt (stripe 1)", "2.txt (stripe 2)"));
    let weights: Vec<_> = (0..10).map(|place| loaded.report.weights.of_record(place)).collect();
    let expected = [0.6, 1.8, 0.6, 1.0, 1.0, 1.0, 1.0, 1.2, 0.6, 1.2];
    assert!(weights.iter().zip(expected).all(|(weight, own)| (weight - own).abs() < 1e-12), "{weights:?}");
    let curves = study.run(2).unwrap();
    let g = 9.806_65;
    let levels = [0.1, 0.1, 0.1, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5].map(|level| level * g);
    let mut clouds = Vec::new();
    for list in ["low.csv", "middle.csv", "high.csv"] {
        let records = RECORDS.replace("format", &format!("selection = \"{list}\", format"));
        let cloud = load(&folder, "levels = { method = \"cloud\" }\n", &records).unwrap().study;
        clouds.extend(cloud.run(1).unwrap());
    }
    for ((curve, cloud), level) in curves.iter().zip(&clouds).zip(levels) {
        let [run] = curve.runs() else { panic!("one run of each record: {curve:?}") };
        assert_eq!(*run, Run { intensity: level, ..cloud.runs()[0] });
    }
    // the results, with θ for the median
    let path = run_analysis("stripes_results", &load(&folder, STRIPES, RECORDS).unwrap());
    for row in rows(&path.join("fragilities.csv")).iter().filter(|row| !row["theta_g"].is_empty()) {
        assert_eq!(row["median_g"], row["theta_g"], "{row:?}");
    }
    assert_eq!(rows(&path.join("levels.csv")).len(), 10);
    let factors: f64 = rows(&path.join("records.csv")).iter().map(|row| number(row, "factor")).sum();
    assert!((factors - 13.3).abs() < 1e-12, "{factors}");
}

/// 1 of 5 records exceed at 0.2, 3 of 6 at 0.4 and 7 of 8 at 0.8: `scipy.optimize.minimize` (Nelder-Mead,
/// xatol 1e-13) of −Σ (k ln Φ(z) + (n − k) ln Φ(−z)), SciPy 1.17.1.
#[test]
fn the_fit_over_levels_is_that_of_scipy() {
    let levels = [0.2, 0.4, 0.8];
    let curve = |level: f64, exceeds: bool| {
        let overturning = exceeds.then_some(1.0);
        Curve::new(vec![Run { intensity: level, demand: 0.3, overturning, ..Run::default() }])
    };
    let counts = levels.into_iter().zip([[5, 1], [6, 3], [8, 7]]);
    let curves: Vec<_> =
        counts.flat_map(|(level, [all, exceed])| (0..all).map(move |k| curve(level, k < exceed))).collect();
    let sample = Sample::of_stripes(&curves, 1.0, &levels);
    assert_eq!(sample.counts(), [(0.2, [5.0, 1.0]), (0.4, [6.0, 3.0]), (0.8, [8.0, 7.0])]);
    let fitted = fit(&sample).unwrap();
    assert!((fitted.median / 0.375_685_884_218_141_6 - 1.0).abs() < 1e-6, "{fitted:?}");
    assert!((fitted.dispersion / 0.690_080_391_625_131_4 - 1.0).abs() < 1e-6, "{fitted:?}");
}

/// The records of the low list have 2 m/s² × 0.5, 0.6 and 0.5: a median of 1 m/s², a fifth of 0.5 g.
#[test]
fn stripes_unlike_their_records_are_warned_of() {
    let folder = folder("stripes_unlike");
    let unlike = |levels: &str| -> Vec<String> {
        let warnings = load(&folder, levels, RECORDS).unwrap().warnings;
        warnings.into_iter().filter(|warning| warning.contains("a median of")).collect()
    };
    assert_eq!(unlike(STRIPES), [""; 0]);
    let [warning] = &unlike(&STRIPES.replace("high.csv", "low.csv"))[..] else { panic!("one warning") };
    assert!(warning.starts_with("stripe 3 states 4.90332 m/s² (0.5 g)"), "{warning}");
    assert!(warning.contains("a median of 1 m/s² (0.101972 g); check"), "{warning}");
}

#[test]
fn wrong_stripes_are_refused() {
    let folder = folder("stripes_wrong");
    let one = |stripe: &str| format!("levels = {{ method = \"stripes\", stripe = [{stripe}] }}\n");
    let low = "{ intensity = 0.1, selection = \"low.csv\" }";
    for (levels, more, expected) in [
        (one(""), RECORDS, "method = \"stripes\" needs [[levels.stripe]]"),
        (one("{ intensity = 0.1 }"), RECORDS, "line 3: selection is missing"),
        (one("{ selection = \"low.csv\" }"), RECORDS, "line 3: intensity is missing"),
        (one("{ intensity = \"0,1\", selection = \"low.csv\" }"), RECORDS, "expected a number"),
        (
            one("{ intensity = 0.1, selection = \"lost.csv\" }"),
            RECORDS,
            "\"lost.csv\": no such list; name a table",
        ),
        (one("{ intensity = 0.1, files = [\"1.txt\"] }"), RECORDS, "files"),
        (
            one(&format!("{low}, {{ intensity = 0.1, selection = \"high.csv\" }}")),
            RECORDS,
            "above the level before",
        ),
        (one("{ intensity = -0.1, selection = \"low.csv\" }"), RECORDS, "top of the levels is 0 m/s²"),
        (
            one("{ intensity = nan, selection = \"low.csv\" }"),
            RECORDS,
            "levels.stripe.intensity = NaN must be finite",
        ),
        (STRIPES.replace("unit", "top = 2, unit"), RECORDS, "top has no part in method = \"stripes\""),
        (STRIPES.replace("\"stripes\"", "\"cloud\""), RECORDS, "has no part in method = \"cloud\""),
        (
            STRIPES.to_owned(),
            "records = { synthetic = { count = 3 } }\n",
            "the records of stripes stand in the lists",
        ),
        (
            STRIPES.to_owned(),
            "records = { format = \"numbers\", step = 0.01, unit = \"g\" }\nreport.collapse = \"first\"\n",
            "collapse has no part in stripes, of which no record is run twice; leave it out",
        ),
    ] {
        let error = load(&folder, &levels, more).unwrap_err();
        assert!(error.contains(expected), "{error}\nfor {expected}");
    }
}
