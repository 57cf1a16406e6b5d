//! Tests `[hazard]` and `wall study reliability` through the program: the same bytes for shards and kills,
//! and what is refused. `tests/python/test_estimators.py` has the numbers.

use std::fs;
use std::path::Path;

use crate::command_line::{assert_has, content, folder, printed, refused, rows, succeed, text};
use crate::ida::{bytes, part_files};

const STUDY: &str = r#"
models = ["CR", "CDC"]
intensity = { measure = "code" }
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 4, gap = 0.3 }
records = { synthetic = { count = 6, duration = 12, step = 0.01 } }
report = { fractions = [0.4, 1], resamples = 100 }
hazard = { points = [[0.05, 3e-2], [0.2, 2e-3], [0.8, 1e-4]], years = 30, target = 1e-3 }

[check]
code = "circolare-2019"
before_activation = "law"
soil = "B"
SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }

[[walls]]
name = "low"
geometry = { height = 1.5, thickness = 0.3, density = 1800 }
force_law = { a1 = 0.05 }

[[walls]]
name = "high"
geometry = { height = 3, thickness = 0.3, density = 1800 }
force_law = { a1 = 0.05 }

[[classes]]
name = "both"
"#;

/// The results of a study are those that the program compares with its inputs.
fn assert_listed(results: &Path) {
    let listed = || study::folder::FILES.iter().chain(&reliability::FILES);
    for entry in fs::read_dir(results).unwrap().map(Result::unwrap).filter(|entry| entry.path().is_file()) {
        let name = entry.file_name().into_string().unwrap();
        assert!(listed().any(|file| **file == name), "study::folder::FILES lacks {name}");
    }
}

#[test]
fn rates_and_reliability_are_the_same_bytes() {
    let folder = folder("hazard_bytes");
    fs::write(folder.join("study.toml"), STUDY).unwrap();
    let told = printed(&folder, &["study", "reliability", "study.toml", "-o", "whole", "--threads", "1"]);
    assert_has(&told, &["target 1e-3 a year", "walls that just pass fall", "P in 30 years"]);
    assert_listed(&folder.join("whole"));
    let whole = bytes(&folder.join("whole"));
    for name in ["rates.csv", "rate_shares.csv", "reliability.csv", "reliability.html"] {
        assert!(whole.contains_key(std::path::Path::new(name)), "{name}");
    }
    // walls, then the class, each with two models and two limit states
    let rates = rows(&folder, "whole/rates.csv");
    let names: Vec<_> = rates.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(names, [["low"; 4], ["high"; 4], ["both"; 4]].concat());
    assert!(rates.iter().all(|row| ["yes", "no", "open"].contains(&row.last().unwrap().as_str())));

    // shards in one folder, completed by the command itself, which merging does not know
    for shard in ["1/2", "2/2"] {
        let arguments = ["study", "reliability", "study.toml", "-o", "shared", "--shard", shard];
        let told = printed(&folder, &arguments);
        assert_has(&told, &["when all are: wall study reliability study.toml -o shared"]);
        assert!(!folder.join("shared/reliability.csv").exists());
    }
    succeed(&folder, &["study", "reliability", "study.toml", "-o", "shared"]);
    assert!(bytes(&folder.join("shared")) == whole, "shards");

    // lost and damaged parts, and a table that is gone
    let parts = part_files(&folder.join("shared"));
    fs::remove_file(&parts[0]).unwrap();
    fs::write(&parts[1], "").unwrap();
    fs::remove_file(folder.join("shared/reliability.csv")).unwrap();
    let again = succeed(&folder, &["study", "reliability", "study.toml", "-o", "shared", "--threads", "2"]);
    assert_has(&text(&again.stderr), &["combinations are done already"]);
    assert!(bytes(&folder.join("shared")) == whole, "after losses");

    // rates that the points leave out are warned of
    fs::write(folder.join("short.toml"), STUDY.replace(", [0.8, 1e-4]", "")).unwrap();
    let short = succeed(&folder, &["study", "ida", "short.toml", "-o", "short"]);
    let warning =
        "8 of 8 rates may have more than 5 % beyond the last point of the hazard curve, at 0.200 g; give";
    assert_has(&text(&short.stderr), &[warning]);

    // a study without a hazard leaves no rates of an earlier one
    let hazard = STUDY.lines().find(|line| line.starts_with("hazard")).unwrap();
    fs::write(folder.join("study.toml"), STUDY.replace(hazard, "")).unwrap();
    succeed(&folder, &["study", "ida", "study.toml", "-o", "shared"]);
    assert!(!folder.join("shared/rates.csv").exists() && !folder.join("shared/rate_shares.csv").exists());
}

/// Points in the file, two columns and a table of OpenQuake are one curve.
#[test]
fn a_hazard_is_read_from_files() {
    let folder = folder("hazard_files");
    let study = STUDY.replace("\"code\"", "\"PGA\"");
    let hazard = STUDY.lines().find(|line| line.starts_with("hazard")).unwrap();
    fs::write(folder.join("points.csv"), "PGA,annual_rate\n0.05,3e-2\n0.2,2e-3\n0.8,1e-4\n").unwrap();
    let poe = [3e-2, 2e-3, 1e-4].map(|rate: f64| -(-50.0 * rate).exp_m1());
    let table = format!(
        "#,,,,\"generated_by='OpenQuake engine 3.16.3', investigation_time=50.0, imt='PGA'\"\n\
         lon,lat,depth,poe-0.05,poe-0.2,poe-0.8\n12.0,42.0,0.0,{},{},{}\n",
        poe[0], poe[1], poe[2]
    );
    fs::write(folder.join("curve.csv"), table).unwrap();
    let run = |name: &str, hazard: &str| {
        fs::write(folder.join(format!("{name}.toml")), study.replace(hazard_of(&study), hazard)).unwrap();
        succeed(&folder, &["study", "ida", &format!("{name}.toml"), "-o", name]);
        rows(&folder, &format!("{name}/rates.csv"))
    };
    let given = run("given", hazard);
    let rest = "years = 30, target = 1e-3";
    assert_eq!(run("two", &format!("hazard = {{ file = \"points.csv\", {rest} }}")), given);
    let found = run("table", &format!("hazard = {{ file = \"curve.csv\", {rest} }}"));
    for (a, b) in given.iter().zip(&found) {
        let [a, b] = [a, b].map(|row| row[5].parse::<f64>().unwrap());
        // a probability loses 1e-16 of itself, and of its rate 50 years take it back
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    assert_has(&content(&folder, "given/study.html"), &["Annual rates", "Share of the rate"]);
}

fn hazard_of(study: &str) -> &str {
    study.lines().find(|line| line.starts_with("hazard")).unwrap()
}

#[test]
fn a_hazard_that_cannot_be_is_refused() {
    let folder = folder("hazard_refused");
    fs::write(folder.join("other.csv"), "Sa(0.5 s),annual_rate\n0.1,1e-2\n0.2,1e-3\n").unwrap();
    fs::write(folder.join("bad.csv"), "PGA,annual_rate\n0.1,1e-2\n0.2,2e-2\n").unwrap();
    let table = "# investigation_time=50.0, imt='PGA'\nlon,lat,poe-0.05,poe-0.2\n";
    fs::write(folder.join("empty.csv"), table).unwrap();
    let study = STUDY.replace("\"code\"", "\"PGA\"");
    for (hazard, words) in [
        ("{ file = \"bad.csv\", site = 1 }", &["bad.csv, line 1", "site of [hazard] belongs to a table"][..]),
        ("{ file = \"empty.csv\", unit = \"g\" }", &["empty.csv, line 1", "leave out unit of [hazard]"]),
        ("{ file = \"empty.csv\" }", &["empty.csv, line 2", "no row"]),
        ("{}", &["line 7", "hazard needs points, or a file"]),
        ("{ points = [[0.1, 1e-2]] }", &["line 7", "hazard.points needs at least 2 values, found 1"]),
        ("{ points = [[0.2, 1e-2], [0.1, 1e-3]] }", &["point 2", "0.1 must be above 0.2"]),
        ("{ points = [[0.1, 1e-3], [0.2, 1e-2]] }", &["point 2", "0.01 must be below 0.001"]),
        ("{ points = [[1e-2, 0.1], [1e-3, 0.2]] }", &["0.001 must be above 0.01", "annual rate swapped?"]),
        ("{ points = [[0.1, -1], [0.2, 1e-2]] }", &["point 1", "-1 must be positive"]),
        ("{ points = [[0.1, 1e-2], [0.2, 1e-3]], site = 1 }", &["site belongs to a file of OpenQuake"]),
        ("{ points = [[0.1, 1e-2], [0.2, 1e-3]], unit = \"furlong\" }", &["furlong"]),
        ("{ points = [[0.1, 1e-2], [0.2, 1e-3]], years = 0 }", &["years = 0 must be above 0"]),
        ("{ points = [[0.1, 1e-2], [0.2, 1e-3]], target = -1 }", &["target = -1 must be above 0"]),
        ("{ file = \"none.csv\" }", &["none.csv: cannot be read"]),
        ("{ file = \"other.csv\" }", &["other.csv, line 1", "\"Sa(0.5 s)\", the study of PGA"]),
        ("{ file = \"bad.csv\" }", &["bad.csv, line 3", "must be below 0.01"]),
    ] {
        let own = format!("hazard = {hazard}");
        fs::write(folder.join("study.toml"), study.replace(hazard_of(&study), &own)).unwrap();
        refused(&folder, &["study", "ida", "study.toml", "-o", "out"], words);
    }
}

/// What no wall can answer is not asked of thousands of runs.
#[test]
fn a_study_whose_walls_cannot_be_checked_is_refused() {
    let folder = folder("reliability_refused");
    fs::write(folder.join("study.toml"), STUDY.replace(", density = 1800", "")).unwrap();
    let words = ["study.toml: no wall can be checked; wall \"low\": density not stated"];
    refused(&folder, &["study", "reliability", "study.toml", "-o", "out"], &words);
}

/// At each intensity the probabilities of the loss ratios add up to 1, and give the mean of the table; the
/// annual loss is the sum of the rates of the limit states times the steps of the ratios.
#[test]
fn losses_follow_the_limit_states() {
    let folder = folder("hazard_losses");
    let ratios = "fractions = [1, 0.4], loss_ratios = [1, 0.3],";
    let study = STUDY.replace("\"code\"", "\"PGA\"").replace("fractions = [0.4, 1],", ratios);
    fs::write(folder.join("study.toml"), &study).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert_has(&told, &["average annual loss, of the value of the wall"]);
    assert_listed(&folder.join("out"));
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    let (rates, losses) = (rows(&folder, "out/rates.csv"), rows(&folder, "out/losses.csv"));
    assert_eq!(losses.len(), 3 * 2);
    for (pair, loss) in rates.chunks(2).zip(&losses) {
        assert_eq!([&pair[0][..2], &pair[1][..2]], [&loss[..2]; 2]);
        let wanted = 0.3 * number(&pair[0][5]) + 0.7 * number(&pair[1][5]);
        let [found, low, high] = [2, 3, 4].map(|cell| number(&loss[cell]));
        assert!((found / wanted - 1.0).abs() < 1e-12 && low < found && found < high, "{loss:?}");
    }
    // lists of numbers between > and <, function by function
    let (xml, curves) = (content(&folder, "out/vulnerability.xml"), rows(&folder, "out/vulnerability.csv"));
    assert_has(
        &xml,
        &["<vulnerabilityModel id=\"rocking_walls\"", "<vulnerabilityFunction id=\"low (CR)\" dist"],
    );
    let list =
        |line: &str| -> Vec<f64> { line.split(['>', '<']).nth(2).unwrap().split(' ').map(number).collect() };
    let functions: Vec<_> = xml.split("<vulnerabilityFunction").skip(1).collect();
    assert_eq!((functions.len(), curves.len()), (6, 6 * 41));
    for (function, curve) in functions.iter().zip(curves.chunks(41)) {
        let lines: Vec<_> = function.lines().skip(1).take(4).map(list).collect();
        for (k, row) in curve.iter().enumerate() {
            assert_eq!(lines[0][k], number(&row[2]));
            let [none, some, all] = [1, 2, 3].map(|line| lines[line][k]);
            assert!((none + some + all - 1.0).abs() < 1e-15);
            let mean = 0.3 * some + all;
            assert!((mean - number(&row[3])).abs() < 1e-15);
            let deviation = (0.09 * some + all - mean * mean).max(0.0).sqrt();
            // the square root of a rounding
            assert!((deviation - number(&row[4])).abs() < 1e-7);
        }
    }
    for (change, words) in [
        ("[1]", "loss_ratios: 1 loss ratio for 2 limit states; give one for each"),
        ("[1, 1.5]", "loss_ratios: 1.5 must be from 0 to 1"),
        ("[0.3, 1]", "loss_ratios: 0.3 at 1 u_ins must not be below 1 at 0.4 u_ins"),
    ] {
        fs::write(folder.join("study.toml"), study.replace("[1, 0.3]", change)).unwrap();
        refused(&folder, &["study", "ida", "study.toml", "-o", "other"], &["line 6", words]);
    }
}
