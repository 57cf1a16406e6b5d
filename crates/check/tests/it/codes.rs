//! What every code has: an entry, its rule in the manual, and a verdict from its example.

use check::{
    CODES, CheckFile, Ends, Language, Origin, ReportTable, Sought, WallCodes, check_walls, find, page, read,
};
use run::walls::NamedWall;
use scene::Scene;

fn source(name: &str) -> String {
    std::fs::read_to_string(format!("{}/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// A module with an `ENTRY` is one of the codes.
#[test]
fn every_module_of_a_code_is_listed() {
    let list = source("src/codes.rs");
    for file in std::fs::read_dir(format!("{}/src", env!("CARGO_MANIFEST_DIR"))).unwrap() {
        let path = file.unwrap().path();
        let module = path.file_stem().unwrap().to_string_lossy().into_owned();
        let face = if path.is_dir() { path.join("mod.rs") } else { path };
        if std::fs::read_to_string(face).unwrap().contains("pub const ENTRY: Entry") {
            assert!(list.contains(&format!("{module}::ENTRY")), "src/codes.rs: list {module}::ENTRY");
        }
    }
}

/// The manual and the playground have every code and its keys, as far as the example has them.
#[test]
fn every_code_is_documented_and_offered() {
    let manual = source("../../docs/model.md");
    let fields = source("../playground/src/page/fields.js");
    for code in CODES {
        let (name, title) = (code.name, code.title);
        assert!(manual.contains(&format!("`{name:?}`")), "docs/model.md: state the rule of {name:?}");
        let choice = format!("{name:?}: {title:?}");
        assert!(fields.contains(&choice), "fields.js: add {choice} to the names of the field `code`");
        let example: toml::Table = code.example.parse().unwrap();
        for key in example["check"].as_table().unwrap().keys() {
            assert!(manual.contains(&format!("`{key}`")), "docs/model.md: explain `{key}` of {name:?}");
            let is_offered = [key, &format!("check.{key}")].map(|key| fields.contains(&format!("{key:?}")));
            assert!(is_offered.contains(&true), "fields.js: add a field for `{key}` of {name:?}");
        }
    }
}

/// The example of each code gives rows, numbers, a picture, a report, a search and a table of walls.
#[test]
fn every_code_gives_all_of_a_verdict() {
    for code in CODES {
        let name = code.name;
        let scene = Scene::parse("scene.toml", code.example, ".".as_ref()).unwrap();
        let file = CheckFile::parse("scene.toml", code.example).unwrap();
        let stated = read(&file).unwrap();
        let verdict = stated.check((&scene).into()).unwrap();
        assert_eq!((verdict.json()["code"].as_str(), stated.entry().name), (Some(name), name));
        assert_eq!(verdict.json()["passed"], verdict.passed, "{name}");
        let governing = verdict.rows.iter().filter(|row| row.decides).map(|row| row.zeta);
        assert_eq!(governing.fold(f64::INFINITY, f64::min), verdict.zeta, "{name}");
        for row in &verdict.rows {
            let (Ends::Accelerations([capacity, demand]) | Ends::Displacements([capacity, demand])) =
                row.ends;
            assert!((capacity / demand / row.zeta - 1.0).abs() < 1e-12, "{name}: {row:?}");
        }
        let mut light = scene.clone();
        light.parameters.density = 300.0;
        let warnings = stated.check((&light).into()).unwrap().warnings;
        assert!(
            warnings.iter().any(|warning| warning.starts_with("density = 300 kg/m3 is unusual")),
            "{name}"
        );
        let text = verdict.text("a wall", Language::En);
        assert!(text.starts_with(&format!("a wall\n{}\n\ncheck", verdict.headline())), "{text}");
        let report = ReportTable::default();
        let origin = Origin::new("a wall", &file, stated.records(), &report, "wall");
        let page = page(&verdict, &origin).unwrap();
        for part in ["<svg", "Verdict</h2>", "The wall</h2>", "Warnings</h2>", "Document</h2>"] {
            assert!(page.contains(part), "{name}: the report lacks {part}");
        }
        let found = find(&*stated, (&scene).into(), Sought::Thickness).unwrap();
        let plot = found.plot(Language::En);
        // the area is 399 px high: the legend, its rows 18 px high, is above the lines, which go up to 3
        let rows = plot.series.iter().filter(|series| !series.name.is_empty()).count();
        let lines = found.checks.iter().flat_map(|check| &check.curve).map(|point| point.1);
        let lines = lines.filter(|ratio| ratio.is_finite()).fold(1.2, f64::max).min(3.0);
        assert!(399.0 * (1.0 - lines / plot.ranges()[3]) > 18.0 * rows as f64 + 18.0, "{name}: {rows} rows");
        assert!(plot.svg().starts_with("<svg") && found.text(Language::En).ends_with('\n'), "{name}");
        let walls = [NamedWall::new("one", scene.parameters.clone())];
        let codes = WallCodes::read(&file, &walls).unwrap();
        let table = check_walls(&codes, &walls, 1).table();
        let shown = table.columns.iter().filter(|column| code.checks.contains(&&*column.heading)).count();
        assert_eq!(shown, code.checks.len(), "{name}");
    }
}
