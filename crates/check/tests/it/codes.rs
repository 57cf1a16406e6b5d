//! Tests what every code has. A new code has a table here.

use check::code::{CODES, Code, Document, Given, Subject, in_table, read};
use check::find::{Sought, find};
use rocking_wall::scene::Place;
use rocking_wall::wall::Parameters;

/// A table `[check]` of each code, and a name of its verdict.
const TABLES: [(&str, &str); 2] = [
    (
        "code = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
         SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n",
        "SLV",
    ),
    ("code = \"fractions\"\nspectrum = [[0, 2], [0.5, 5], [1, 2.5], [4, 0.3]]\n", "displacement"),
];

fn code(table: &str) -> Box<dyn Code> {
    let text = format!("[check]\n{table}");
    read(&Place::new("scene.toml", &text), Given::default()).unwrap().unwrap()
}

#[test]
fn every_code_gives_a_verdict_with_rows_numbers_picture_and_report() {
    for (name, _) in CODES {
        let of_code = |(table, _): &&(&str, &str)| table.contains(&format!("{name:?}"));
        let (table, governs) = TABLES.iter().find(of_code).unwrap_or_else(|| panic!("no table of {name}"));
        let (code, parameters) = (code(table), Parameters::default());
        let subject = Subject { title: "a <wall>", parameters: &parameters, floors: None, is_tried: false };
        let verdict = code.check(&subject).unwrap();
        assert_eq!((verdict.code, verdict.governs, verdict.side), (name, *governs, "both sides"));
        assert_eq!(verdict.passed, verdict.zeta >= 1.0);
        assert!(verdict.headline.contains(governs) && verdict.values["code"] == name, "{name}");
        let rows = verdict.rows.json();
        let of_row = |row: &serde_json::Value| row["zeta_E"].as_f64() == Some(verdict.zeta);
        assert!(rows.as_array().unwrap().iter().any(of_row), "{name}: {rows}");
        assert!(verdict.numbers.rows.len() >= 10 && !verdict.notes.is_empty(), "{name}");
        assert!(code.plot(&subject).unwrap().svg().starts_with("<svg"), "{name}");
        let document = Document { file: ("scene.toml", table), set: &[], date: Some("3 March 2027") };
        let page = code.report(&subject, &document).unwrap();
        assert!(page.contains("a &lt;wall&gt;") && page.contains("3 March 2027"), "{name}");
        // the wall that is found passes, and one a millionth thinner does not
        let found = find(&*code, &subject, Sought::Thickness).unwrap();
        for (factor, passes) in [(1.0, true), (1.0 - 1e-6, false)] {
            let parameters = Sought::Thickness.applied(&parameters, factor * found.value.unwrap());
            let verdict = code.check(&Subject { parameters: &parameters, ..subject }).unwrap();
            assert_eq!(verdict.passed, passes, "{name}: {factor}");
        }
    }
}

#[test]
fn an_unknown_code_is_refused_with_those_that_are_known() {
    let text = "title = \"a\"\n[check]\ncode = \"eurocode-8\"\n";
    let place = Place::new("s.toml", text);
    let error = in_table(read(&place, Given::default()).unwrap_err(), &place).to_string();
    let known = "write \"circolare-2019\" or \"fractions\"";
    assert_eq!(error, format!("s.toml, line 3: [check] code = \"eurocode-8\" is unknown; {known}"));
    assert!(read(&Place::new("s.toml", "title = \"a\"\n"), Given::default()).unwrap().is_none());
}

#[test]
fn statements_of_fractions_are_refused_with_their_key() {
    for (line, words) in [
        ("", "line 1: [check] there is no demand; give a spectrum, or records"),
        ("spectrum = [[0.1, 2], [4, 1]]", "line 3: [check] the spectrum has no T = 0"),
        (
            "spectrum = [[0, 2], [1, -1]]",
            "line 3: [check] point 2 of the spectrum: expected a finite Sa above 0",
        ),
        ("spectrum = \"none.csv\"", "none.csv"),
        ("spectrum = 3", "line 3: spectrum = 3: expected a file in quotes, or a list of points"),
        ("fraction = 3", "line 3: unknown key \"fraction\" in [check]"),
    ] {
        let text = format!("[check]\ncode = \"fractions\"\n{line}\n");
        let place = Place::new("s.toml", &text);
        let error = in_table(read(&place, Given::default()).unwrap_err(), &place).to_string();
        assert!(error.contains(words), "{error}\nfor {words}");
    }
    let code = code("code = \"fractions\"\nsecant_fraction = 2\nspectrum = [[0, 2], [4, 1]]\n");
    let parameters = Parameters::default();
    let error = code
        .check(&Subject { title: "", parameters: &parameters, floors: None, is_tried: false })
        .unwrap_err();
    assert_eq!(error.keys(), Some(vec!["secant_fraction"]));
}
