//! Fragilities for risk engines: `fragilities.xml` and `fragility_curves.csv` of `wall study ida`.
//!
//! The reader of `openquake.engine` imports some 25 other packages, which are not installed for tests. The
//! tests therefore check the file by the rules of that reader: the order of elements, their attributes, the
//! formats of names and numbers. Release 3.26.2 has read these files, and its functions gave Φ(ln(IM/θ)/β) of
//! the table to 4e-16.

use std::collections::BTreeSet;
use std::fs;

use crate::command_line::{assert_has, folder, printed, refused, succeed};

const STUDY: &str = r#"
title = "Walls & classes"
models = ["CDC"]
intensity = { measure = "PGA" }
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 8, gap = 0.3 }
records = { synthetic = { count = 6, duration = 12, step = 0.01 } }
report = { fractions = [0.4, 0.1, 1], resamples = 100 }

[[walls]]
name = "low"
geometry = { height = 3, thickness = 0.3 }

[[walls]]
name = "high"
geometry = { height = 4, thickness = 0.3 }

[[classes]]
name = "alone"
walls = ["high"]

[[classes]]
name = "both"
weights = [3, 1]
"#;

/// A function as a risk engine reads it: its name, and limit state, θ and β of each curve.
type Function = (String, Vec<(String, [f64; 2])>);

/// Runs a study; returns the XML, the table and what was printed.
fn run(name: &str, study: &str) -> [String; 3] {
    let folder = folder(name);
    fs::write(folder.join("study.toml"), study).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let read = |file: &str| fs::read_to_string(folder.join("out").join(file)).unwrap_or_default();
    [read("fragilities.xml"), read("fragility_curves.csv"), told]
}

/// Takes the next element, and checks its name and the names of its attributes; returns their values.
fn element<'a>(lines: &mut impl Iterator<Item = &'a str>, name: &str, attributes: &[&str]) -> Vec<&'a str> {
    let line = lines.next().unwrap().trim();
    let inner = line.strip_prefix('<').unwrap().split('>').next().unwrap().trim_end_matches('/');
    let (found, rest) = inner.split_once(' ').unwrap_or((inner, ""));
    let parts: Vec<_> = rest.split('"').collect();
    let names: Vec<_> = parts.iter().step_by(2).map(|name| name.trim().trim_end_matches('=')).collect();
    assert_eq!((found, &names[..names.len() - 1]), (name, attributes), "{line}");
    parts.into_iter().skip(1).step_by(2).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// Reads a file with three limit states, by the rules of the reader of `openquake.engine`.
fn read(xml: &str, measure: &str) -> Vec<Function> {
    let lines = &mut xml.lines();
    assert_eq!(lines.next(), Some("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
    assert_eq!(element(lines, "nrml", &["xmlns"]), ["http://openquake.org/xmlns/nrml/0.5"]);
    element(lines, "fragilityModel", &["id", "assetCategory", "lossCategory"]);
    assert!(lines.next().unwrap().trim().starts_with("<description>Walls &amp; classes: "));
    let states = lines.next().unwrap().trim().replace("</limitStates>", "").replace("<limitStates>", "");
    assert!(states.chars().all(|c| c.is_ascii_alphanumeric() || "_-: ".contains(c)), "{states}");
    let (mut functions, mut names) = (Vec::new(), BTreeSet::new());
    let mut rest = lines.peekable();
    while rest.peek().is_some_and(|line| line.contains("<fragilityFunction")) {
        let [id, format, shape] =
            element(&mut rest, "fragilityFunction", &["id", "format", "shape"]).try_into().unwrap();
        assert!([format, shape] == ["continuous", "logncdf"] && !id.contains(['#', '\'']));
        assert!(names.insert(id), "{id} occurs twice");
        let imls = element(&mut rest, "imls", &["imt", "noDamageLimit", "minIML", "maxIML"]);
        let [none, least, most] = [1, 2, 3].map(|k| number(imls[k]));
        assert!(imls[0] == measure && 0.0 < none && none <= least && least < most, "{imls:?}");
        let curve = |state: &str| {
            let params = element(&mut rest, "params", &["ls", "mean", "stddev"]);
            assert_eq!(params[0], state);
            let [mean, deviation] = [1, 2].map(|k| number(params[k]));
            let square = (deviation / mean).powi(2).ln_1p();
            (state.to_owned(), [mean * (-0.5 * square).exp(), square.sqrt()])
        };
        functions.push((id.to_owned(), states.split(' ').map(curve).collect()));
        assert_eq!(rest.next().unwrap().trim(), "</fragilityFunction>");
    }
    let end: Vec<_> = rest.map(str::trim).collect();
    assert_eq!(end, ["</fragilityModel>", "</nrml>"]);
    functions
}

fn assert_close(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} instead of {expected}");
}

/// The file gives back the θ and β of the table to 1e-12. Limit states are in order; with one β they never
/// cross.
#[test]
fn risk_engines_read_the_fragilities() {
    let [xml, table, _] =
        run("risk", &STUDY.replace("resamples = 100", "resamples = 100, beta = \"common\""));
    let functions = read(&xml, "PGA");
    let names: Vec<_> = functions.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["low", "high", "alone", "both"]);
    let curves = functions.iter().flat_map(|(name, curves)| curves.iter().map(move |curve| (name, curve)));
    let curves: Vec<_> = curves.collect();
    assert_eq!(table.lines().count(), 1 + curves.len(), "{table}");
    for (line, (name, (state, [theta, beta]))) in table.lines().skip(1).zip(curves) {
        // from β of modelling on, the columns from the last one back
        let modelling = table.lines().next().unwrap().split(',').position(|name| name == "beta_modelling");
        let fields: Vec<_> = line.split(',').take(modelling.unwrap() + 1).collect();
        let fields: Vec<_> = fields.into_iter().rev().collect();
        assert!(line.starts_with(name.as_str()) && fields[8] == state && fields[9] == "g", "{line}");
        assert_close(*theta, number(fields[6]));
        assert_close(*beta, number(fields[3]));
        let squares: f64 = fields[..3].iter().map(|part| number(part).powi(2)).sum();
        assert_close(squares.sqrt(), number(fields[3]));
    }
    for (name, curves) in &functions {
        let states: Vec<_> = curves.iter().map(|(state, _)| state.as_str()).collect();
        assert_eq!(states, ["u_ins_0_1", "u_ins_0_4", "u_ins_1"]);
        for pair in curves.windows(2) {
            let [[theta, beta], [next_theta, next_beta]] = [pair[0].1, pair[1].1];
            // one β but for the rounding of means and deviations; between walls each limit state has its own
            let is_common = name == "both" || (beta / next_beta - 1.0).abs() < 1e-12;
            assert!(theta < next_theta && is_common, "{name}: {pair:?}");
        }
    }
}

/// A class of one wall is that wall to the last bit; one of several has the total variance.
#[test]
fn classes_join_walls() {
    let [xml, table, told] = run("risk_classes", STUDY);
    assert_has(&told, &["curves of classes of walls", "modelling\n", "both ", "alone "]);
    let of =
        |name: &str| xml.split(&format!("id=\"{name}\"")).nth(1).unwrap().split("</frag").next().unwrap();
    assert_eq!(of("alone"), of("high"));
    let functions = read(&xml, "PGA");
    let [low, high, both] = [0, 1, 3].map(|k| &functions[k].1);
    for state in 0..3 {
        let [a, b] = [low, high].map(|curves| curves[state].1[0].ln());
        let mean = 0.75 * a + 0.25 * b;
        assert_close(both[state].1[0], mean.exp());
        let between = 0.75 * (a - mean).powi(2) + 0.25 * (b - mean).powi(2);
        let within = 0.75 * low[state].1[1].powi(2) + 0.25 * high[state].1[1].powi(2);
        assert_close(both[state].1[1], (within + between).sqrt());
    }
    // θ and β of walls and classes lie in their intervals, with a covariance that is one
    let column = |name: &str| table.lines().next().unwrap().rsplit(',').position(|c| c == name).unwrap();
    for line in table.lines().skip(1) {
        let fields: Vec<_> = line.rsplit(',').collect();
        let of = |name: &str| number(fields[column(name)]);
        for name in ["theta", "beta"] {
            let [low, high] = ["low", "high"].map(|end| of(&format!("{name}_{end}")));
            assert!(low <= of(name) && of(name) <= high && low < high, "{name} in {line}");
        }
        let [theta, both, beta] = ["var_ln_theta", "cov_ln_theta_beta", "var_beta"].map(of);
        assert!(theta > 0.0 && beta > 0.0 && both * both < theta * beta, "{line}");
        let is_wall = line.starts_with("low") || line.starts_with("high");
        assert_eq!(!fields[column("misfit")].is_empty(), is_wall, "{line}");
    }
    assert_has(&table, &["both,2,CDC,PGA,g,", "low,1,CDC,PGA,g,", ",parapet,3.0,0.3,"]);
}

/// β² = β_r² + β_m², and θ stays.
#[test]
fn modelling_uncertainty_widens_the_curves() {
    let sa = STUDY.replace("measure = \"PGA\"", "measure = \"Sa\", period = 0.5");
    let wider = sa.replace("resamples = 100", "resamples = 100, modelling_uncertainty = 0.3");
    let [without, with] = [("risk_sa", sa), ("risk_model", wider)].map(|(name, study)| run(name, &study));
    for ((_, narrow), (_, wide)) in read(&without[0], "SA(0.5)").iter().zip(read(&with[0], "SA(0.5)")) {
        for ((_, [theta, beta]), (_, [wide_theta, wide_beta])) in narrow.iter().zip(wide) {
            assert_close(wide_theta, *theta);
            assert_close(wide_beta, beta.hypot(0.3));
        }
    }
}

/// With several models their names tell functions apart. Where a limit state has no curve, none is written.
#[test]
fn functions_of_several_models() {
    let [xml, table, told] = run(
        "risk_models",
        &STUDY
            .replace("[\"CDC\"]", "[\"CDC\", \"CR\"]")
            .replace("top = 8", "top = 0.25")
            .replace("[0.4, 0.1, 1]", "[0.1]")
            .replace("name = \"low\"", "name = \"l'ow\""),
    );
    let ids: Vec<_> = xml.split("id=\"").skip(2).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(&ids[..2], ["l_ow (CDC)", "l_ow (CR)"], "{told}");
    assert!(table.contains("\nl'ow,") && !told.contains("lacks"), "{told}");
    let [xml, table, told] = run("risk_open", &STUDY.replace("top = 8", "top = 0.15"));
    assert_eq!((xml.matches("<fragilityFunction").count(), table.lines().count()), (0, 13), "{table}");
    assert_has(&told, &["fragilities.xml lacks 4 functions, ", "add levels below or above"]);
    // what is known of them is a bound, in the table and in a comment of the file
    assert_has(&xml, &["<!-- no function of high: theta in g of ", ", u_ins_1 open &gt;0.150 -->"]);
    assert_has(&table, &[",u_ins_1,1.0,open >0.15,open >0.15,open >0.15,,,,,"]);
}

#[test]
fn other_measures_have_no_nrml() {
    let code = "intensity = { measure = \"code\" }";
    let check = "[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\n\
                 SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n";
    let study = STUDY.replace("intensity = { measure = \"PGA\" }", code) + check;
    let [xml, table, told] = run("risk_measures", &study);
    assert!(xml.is_empty() && !table.is_empty());
    let known = "OpenQuake knows PGA, PGV, PGD, Sa(T), AvgSA, IA and CAV, and not a_g";
    assert_has(&told, &[known, "measure = \"AvgSA\""]);
}

/// NRML has a name for AvgSA and no place for its periods, which stand in the description.
#[test]
fn averages_state_their_periods() {
    let [xml, ..] = run("risk_average", &STUDY.replace("\"PGA\"", "\"AvgSA\", periods = [0.2, 0.5]"));
    assert_eq!(read(&xml, "AvgSA").len(), 4);
    assert_has(&xml, &["intensities in g; AvgSA over 0.2, 0.5 s</description>"]);
}

/// A file of an earlier report that the present one does not have is removed.
#[test]
fn no_file_of_an_earlier_report_stays() {
    let folder = folder("risk_earlier");
    for (study, is_drawn) in [(STUDY.to_owned(), true), (STUDY.replace("0.1, 1]", "0.1]"), false)] {
        fs::write(folder.join("study.toml"), study).unwrap();
        succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
        assert_eq!(folder.join("out/fragilities.svg").exists(), is_drawn);
    }
}

#[test]
fn classes_that_cannot_be_made_are_refused() {
    let folder = folder("risk_refused");
    for (from, to, words) in [
        (
            "walls = [\"high\"]",
            "walls = [\"hihg\"]",
            &["class \"alone\"", "no wall \"hihg\"", "\"high\""][..],
        ),
        ("walls = [\"high\"]", "walls = [\"low\", \"low\"]", &["\"low\" is listed twice", "weight"]),
        ("[3, 1]", "[3, 1, 1]", &["class \"both\"", "3 weights for 2 walls"]),
        ("[3, 1]", "[3, -1]", &["classes.weights = -1 must be above 0: Weight of each wall"]),
        ("name = \"both\"", "name = \"alone\"", &["\"alone\" is listed twice"]),
        ("name = \"both\"", "name = \"low\"", &["class \"low\"", "name of a wall"]),
        (
            "fractions = [0.4, 0.1, 1]",
            "fractions = []",
            &["report.fractions needs at least 1 value, found 0"],
        ),
        (
            "resamples = 100",
            "modelling_uncertainty = -1",
            &["modelling_uncertainty = -1", "at least 0 and at most 2"],
        ),
    ] {
        fs::write(folder.join("study.toml"), STUDY.replace(from, to)).unwrap();
        refused(&folder, &["study", "ida", "study.toml", "-o", "out"], words);
    }
}
