//! Tests the tables of a study of reliability against its curves and its check, number by number.

use std::collections::BTreeMap;

use check::{Code, Row, Subject, WallCodes};
use fragility::{CONFIDENCE, Interval, Lognormal};
use reliability::FILES;
use rocking_wall::wall::Wall;
use run::sample::fractile;
use study::folder::Report;
use study::ida::{Case, Crossing, Curve};
use study::loaded::LoadedStudy;
use study::results::Fitting;

use crate::asked::{CHECK, G, code_of, load, run, run_reported};
use crate::folders::{number, rows};

type Cells = BTreeMap<String, String>;

/// Parapets: a low one, a slender one, and one whose overburden of half its weight stays on one side, so that
/// its sides differ. A displacement of a local instability is then another part of u_ins on each side.
pub(crate) const WALLS: &str = r#"
[[walls]]
name = "low"
geometry = { height = 1, thickness = 0.2, density = 1800 }
force_law = { a1 = 0.05 }
[[walls]]
name = "slender"
geometry = { height = 2.4, thickness = 0.2, density = 1800 }
force_law = { a1 = 0.05 }
[[walls]]
name = "loaded"
geometry.height = 1.6
geometry.thickness = 0.25
geometry.density = 1800
geometry.overburden = 3531.6
geometry.overburden_eccentricity = 0.05
geometry.eccentricity_mode = "fixed_to_wall"
force_law = { a1 = 0.05 }
check = { overburden_mass = 0, SLC = { displacement = 0.045 } }
"#;

/// A study of walls under some motions; `more` is put above all tables.
pub(crate) fn text(more: &str, records: usize, walls: &str) -> String {
    format!(
        "models = [\"CR\", \"CDR\"]\nlevels = {{ method = \"hunt\", first = 0.05, increase = 0.05, top = 5 \
         }}\nrecords = {{ synthetic = {{ count = {records} }} }}\nreport = {{ fractions = [0.4, 1.0], \
         resamples = 200 }}\nintensity = {{ measure = \"code\" }}\n{more}{CHECK}SLC = {{ ag = 0.25, F0 = \
         2.4, TC = 0.3 }}\n{walls}"
    )
}

/// The row of a check of the side that bears less.
pub(crate) fn least<'a>(rows: &'a [Row], check: &str) -> &'a Row {
    let ground = |row: &&Row| row.ground.unwrap()[0];
    let own = rows.iter().filter(|row| row.check == check);
    own.min_by(|a, b| ground(a).total_cmp(&ground(b))).unwrap()
}

/// Curves of a wall, models outermost, records innermost.
fn curves(loaded: &LoadedStudy, wall: usize) -> Vec<Curve> {
    let study = &loaded.study;
    let first = study.index(Case { wall, model: 0, record: 0 });
    let count = study.models().len() * study.records().len();
    (first..first + count).map(|index| study.curve(study.case(index)).unwrap()).collect()
}

/// a_g at which the demands reach a fraction of u_ins, NTC 7.3.5: the mean of 7 records and more, which is
/// straight between their levels, the largest of fewer; or where one record overturns the wall.
fn dynamic(curves: &[Curve], fraction: f64) -> f64 {
    let first = |fraction: f64| {
        let of = |curve: &Curve| curve.exceedance(fraction, Crossing::First, false).or_infinity();
        curves.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    if curves.len() < 7 {
        return first(fraction);
    }
    let mean = |ground: f64| {
        curves.iter().map(|curve| curve.demand(ground).unwrap()).sum::<f64>() / curves.len() as f64
    };
    let mut levels: Vec<f64> = curves.iter().flat_map(Curve::runs).map(|run| run.intensity).collect();
    levels.sort_by(f64::total_cmp);
    let falls = first(1.0);
    let Some(above) = levels.iter().position(|&level| level < falls && mean(level) >= fraction) else {
        return falls;
    };
    let mut bracket = [above.checked_sub(1).map_or(0.0, |below| levels[below]), levels[above]];
    for _ in 0..100 {
        let middle = 0.5 * (bracket[0] + bracket[1]);
        bracket[usize::from(mean(middle) >= fraction)] = middle;
    }
    bracket[1]
}

/// Numbers of the check, counts of records, ζ of the records and intervals of every row, with 7 records,
/// whose mean counts, and with 6.
#[test]
fn every_row_follows_from_curves_and_check() {
    for records in [6, 7] {
        let name = format!("rows_{records}");
        let loaded = load(&name, &text("", records, WALLS)).unwrap();
        let table = rows(&run(&name, &loaded).join(FILES[0]));
        assert_eq!(table.len(), 3 * 2 * 3 * 3);
        let code = code_of(&loaded);
        let curves: Vec<_> = (0..3).map(|wall| curves(&loaded, wall)).collect();
        let counts: Vec<_> = table.iter().map(|row| check_row(&loaded, &code, &curves, row)).collect();
        // neither none nor all of the records everywhere
        assert!(counts.iter().filter(|count| (1..records).contains(count)).count() > 10, "{counts:?}");
        let sides = loaded.study.walls().iter().map(|wall| sides(code.of(wall), &wall.parameters));
        assert_eq!(sides.collect::<Vec<_>>(), [1, 1, 2]);
    }
}

/// Of fewer than six records no interval is determined: its cells are empty, and the estimate stands.
#[test]
fn an_interval_that_is_not_determined_is_empty() {
    let loaded = load("few_records", &text("", 4, WALLS)).unwrap();
    let table = rows(&run("few_records", &loaded).join(FILES[0]));
    let filled = |name: &str| table.iter().filter(|row| !row[name].is_empty()).count();
    for name in ["margin", "probability"] {
        assert!(filled(name) > 0, "{name}");
        for end in ["low", "high"] {
            assert_eq!(filled(&format!("{name}_{end}")), 0, "{name}_{end}");
        }
    }
}

/// How many sides of a wall a code tells apart.
fn sides(code: &dyn Code, parameters: &rocking_wall::wall::Parameters) -> usize {
    let verdict = code.check(Subject::new(parameters)).unwrap();
    verdict.rows.iter().filter(|row| row.check == "SLV").count()
}

/// Compares a row with what it follows from, and returns its count of records.
fn check_row(loaded: &LoadedStudy, codes: &WallCodes, curves: &[Vec<Curve>], row: &Cells) -> usize {
    let study = &loaded.study;
    let place = study.walls().iter().position(|wall| wall.name == row["wall"]).unwrap();
    let model = study.models().iter().position(|model| model.name == row["model"]).unwrap();
    let wall = &study.walls()[place];
    let verdict = codes.of(wall).check(Subject::new(&wall.parameters)).unwrap();
    let checked = least(&verdict.rows, &row["check"]);
    assert_eq!(number(row, "zeta"), checked.zeta);
    let [ground, site] = checked.ground.unwrap().map(|ag| ag * G);
    // the least of both sides at which the event is
    let u_ins = Wall::new(&wall.parameters).unwrap().body().instability;
    let of_side = |one: &Row| one.displacement.unwrap() / u_ins.of(one.side.sign());
    let event = row["event"].strip_prefix("beyond d_");
    let rows_of_event = verdict.rows.iter().filter(|one| Some(one.check) == event);
    let fraction = rows_of_event.map(of_side).fold(1.0, f64::min);
    assert_eq!(number(row, "u_over_u_ins"), fraction);

    let (all, records) = (&curves[place], study.records().len());
    let own = &all[model * records..(model + 1) * records];
    let at_most = |curve: &&Curve| curve.exceedance(fraction, Crossing::First, false).or_infinity() <= ground;
    let count = own.iter().filter(at_most).count();
    assert_eq!(number(row, "records"), count as f64);
    if event == Some(checked.check) {
        let expected = dynamic(own, fraction) / site;
        assert!((number(row, "dynamic_zeta") / expected - 1.0).abs() < 1e-9, "{row:?} {expected}");
    } else {
        assert_eq!(row["dynamic_zeta"], "");
    }

    let names: Vec<_> = study.models().iter().map(|model| model.name.as_str()).collect();
    let fitting = Fitting::new(records, &names, None, &loaded.report);
    // of one event alone, as the curves of several may depend on each other
    let resamples = &fitting.summaries(all, &[fraction])[0][model].resamples;
    let margins = resamples.iter().map(|[theta, _]| theta / ground);
    let probability = |&[median, dispersion]: &[f64; 2]| Lognormal { median, dispersion }.probability(ground);
    for (name, values) in [
        ("margin", margins.collect::<Vec<_>>()),
        ("probability", resamples.iter().map(probability).collect()),
    ] {
        let Interval { range, .. } = Interval::new(0.0, values, CONFIDENCE);
        let found = ["low", "high"].map(|end| number(row, &format!("{name}_{end}")));
        assert_eq!(found, range, "{name} of {row:?}");
    }
    count
}

/// The summary holds fractiles over the walls and counts those above the target; the words those of the fall
/// where the check that governs has ζ = 1.
#[test]
fn the_summary_is_that_of_its_rows() {
    const TARGET: f64 = 0.03;
    let other = "[[walls]]\nname = \"thin\"\ngeometry = { height = 2, thickness = 0.15, density = 1800 }\n";
    let more = format!("reliability = {{ probability = {TARGET} }}\n");
    let loaded = load("summary", &text(&more, 6, &format!("{WALLS}{other}"))).unwrap();
    let (path, Report { summary: words, warnings, .. }) = run_reported("summary", &loaded);
    assert!(warnings.is_empty(), "{warnings:?}");
    let table = rows(&path.join(FILES[0]));
    let of = |is: &dyn Fn(&Cells) -> bool, name: &str| -> Vec<f64> {
        let mut values: Vec<f64> = table.iter().filter(|row| is(row)).map(|row| number(row, name)).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let summary = rows(&path.join(FILES[2]));
    assert_eq!(summary.len(), 2 * 3 * 3);
    let mut above = 0;
    for row in &summary {
        let is = |one: &Cells| ["model", "check", "event"].iter().all(|name| one[*name] == row[*name]);
        for name in ["margin", "probability"] {
            let values = of(&is, name);
            assert_eq!(values.len(), 4);
            for percent in [5, 16, 50, 84, 95] {
                let expected = fractile(&values, f64::from(percent) / 100.0).unwrap();
                assert_eq!(number(row, &format!("{name}_{percent}")), expected);
            }
        }
        let found = of(&is, "probability").iter().filter(|p| **p > TARGET).count();
        assert_eq!((number(row, "walls"), number(row, "above")), (4.0, found as f64));
        above += usize::from((1..4).contains(&found));
    }
    assert!(above > 3, "{above}");

    let code = code_of(&loaded);
    let governs: BTreeMap<_, _> = loaded
        .study
        .walls()
        .iter()
        .map(|wall| {
            (wall.name.as_str(), code.of(wall).check(Subject::new(&wall.parameters)).unwrap().governs)
        })
        .collect();
    for model in ["CR", "CDR"] {
        let is = |row: &Cells| {
            row["model"] == model && row["event"] == "fall" && row["check"] == governs[row["wall"].as_str()]
        };
        let falls = of(&is, "probability");
        let [least, median, most] = [0.05, 0.5, 0.95].map(|part| fractile(&falls, part).unwrap());
        let above = falls.iter().filter(|p| **p > TARGET).count();
        // z² (1 + z²/2) = 6 ln² 10 at z = 2.653, where Φ(−z) = 0.00399
        let shown = |p: f64| if p < 0.004 { "< 4e-3".to_owned() } else { format!("{p:.4}") };
        let expected = format!(
            "{model}: 4 walls that just pass fall with a probability of {} in the median ({} to {} from 5 to \
             95 %); P > {TARGET} for {above}\n",
            shown(median),
            shown(least),
            shown(most)
        );
        assert!(words.contains(&expected), "{words}\nwithout\n{expected}");
    }
    // the worst walls have the overburden over their weight
    let page = std::fs::read_to_string(path.join(FILES[3])).unwrap();
    let (_, worst) = page.split_once("The worst walls").unwrap();
    assert!(worst.split_once("</table>").unwrap().0.contains(">0.5<"));
}

/// Walls that are not checked, and hinges and bodies that the check has elsewhere than the runs, are told.
#[test]
fn what_the_numbers_are_not_of_is_told() {
    let walls = r#"
[[walls]]
name = "unstated"
geometry = { height = 2, density = 1800 }
[[walls]]
name = "strip"
geometry.mechanism = "vertical_spanning"
geometry.height = 3
geometry.thickness = 0.25
geometry.density = 1800
geometry.hinge_ratio = 0.5
geometry.overburden = 5000
check = { hinge = "least_alpha0", overburden_mass = 0 }
[[walls]]
name = "storey"
geometry.part = [
  { height = 1.5, thickness = 0.3, density = 1800 },
  { height = 1.5, thickness = 0.25, density = 1800 },
]
check = { hinge_levels = [1.5] }
[[walls]]
name = "same"
geometry.mechanism = "vertical_spanning"
geometry.height = 3
geometry.thickness = 0.25
geometry.density = 1800
geometry.hinge_ratio = 0.5
"#;
    let loaded = load("told", &text("", 2, walls)).unwrap();
    let (path, Report { warnings, .. }) = run_reported("told", &loaded);
    let begin = [
        "1 wall: the runs have the hinge elsewhere than the check, wall \"strip\" at 0.5 h",
        "1 wall: the check has another body than the runs, wall \"storey\": the wedge with the crack",
        "1 wall not checked, \"unstated\": thickness",
    ];
    let told = warnings.iter().zip(begin).all(|(one, begin)| one.starts_with(begin));
    assert!(told && warnings.len() == 3, "{warnings:#?}");
    let walls: std::collections::BTreeSet<_> =
        rows(&path.join(FILES[0])).into_iter().map(|row| row["wall"].clone()).collect();
    assert_eq!(walls.into_iter().collect::<Vec<_>>(), ["same", "storey", "strip"]);
}
