//! Tests what is said of tables `[check]` that cannot be read: key, line and what is expected, in plain
//! words.

use check::{CODES, CheckFile, read};
use scene::SceneError;

use crate::broken::walk;

const CHECK: &str = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"beam\"\nyoung_modulus = 1e9\n\
    knowledge_level = \"LC1\"\ncompression_considered = true\nsoil = \"B\"\ntopography = \"T1\"\n\
    use_class = \"II\"\nmethod = \"nonlinear\"\nrecord_scale = \"ag\"\n[check.SLV]\nag = 0.15\nF0 = 2.4\n\
    TC = 0.3\n[check.SLC]\nag = 0.2\nspectrum = [[0.0, 0.2], [4.0, 0.01]]\nspectrum_damping = 0.1\n\
    [check.building]\nstoreys = 3\nperiod = 0.3\nheight_ratio = 1.0\n[check.records]\nfiles = [\"a.AT2\"]\n";

const FRACTIONS: &str = "[check]\ncode = \"fractions\"\ndisplacement_fraction = 0.4\nsecant_fraction = 0.4\n\
    spectrum = [[0.0, 2.0], [4.0, 0.5]]\nunit = \"m/s2\"\ndamping = 0.05\n";

fn reads(text: &str) -> Result<(), SceneError> {
    let file = CheckFile::parse("s.toml", text)?;
    read(&file).map(drop).map_err(|error| file.located(error))
}

#[test]
fn no_message_speaks_in_words_of_the_reader() {
    // a spectrum is that of the wall's own place, without a building
    let records = "[check.records]\nsynthetic = { count = 3, duration = 10, step = 0.02 }\n";
    let (states, _) = CHECK.split_once("[check.building]").unwrap();
    walk(&format!("{states}{records}"), reads);
    let (slv, rest) = CHECK.split_once("[check.SLC]").unwrap();
    let (_, building) = rest.split_once("[check.building]").unwrap();
    let (building, _) = building.split_once("[check.records]").unwrap();
    walk(&format!("{slv}building_damping = 0.1\n[check.building]{building}{records}"), reads);
    walk(FRACTIONS, reads);
}

#[test]
fn messages_name_line_and_key_and_what_is_expected() {
    let check = |text: &str| reads(text).unwrap_err().to_string();
    for (found, message) in [
        (
            check(&CHECK.replace("\"nonlinear\"", "\"nonlinaer\"")),
            "line 10: [check] method = \"nonlinaer\" is not one of \"nonlinear\", \"linear\", \"dynamic\" \
             (did you mean \"nonlinear\"?)",
        ),
        (
            check(&CHECK.replace("\"LC1\"", "1")),
            "line 5: [check] knowledge_level = 1: expected a name in quotes",
        ),
        (
            check(&CHECK.replace("\"T1\"", "true")),
            "line 8: [check] topography = true: expected \"T1\" to \"T4\", or S_T",
        ),
        (check(&CHECK.replace("ag = 0.15\n", "")), "line 12: [check] SLV: ag is missing; state a_g in g"),
        (check(&CHECK.replace("[0.0, 0.2]", "[0.0]")), "spectrum = [0.0]: expected a list of 2 values"),
        (check(&CHECK.replace("F0", "f0")), "unknown key \"f0\" in [check.SLV] (did you mean \"F0\"?)"),
        (check(&CHECK.replace("2019", "2018")), "line 2: [check] code = \"circolare-2018\" (did you mean"),
        (check("[check]\nsoil = \"B\"\n"), "line 1: [check] code is missing; state one of"),
        (check("height = 3\n"), "the table [check] is missing; the codes are"),
        (
            check(&FRACTIONS.replace("unit", "unti")),
            "unknown key \"unti\" in [check] (did you mean \"unit\"?)",
        ),
        (check(&FRACTIONS.replace("m/s2", "km")), "line 6: [check] unit = \"km\""),
        (check(&FRACTIONS.replace("unit = \"m/s2\"\n", "")), "line 1: [check] unit is missing"),
    ] {
        assert!(found.contains(message), "{found}\nfor {message}");
    }
}

/// Every error of a table says which key it is about, be it read, checked or missing.
#[test]
fn errors_carry_their_key() {
    for (text, keys) in [
        (CHECK.replace("\"LC1\"", "1"), "knowledge_level"),
        (CHECK.replace("F0", "f0"), "SLV.f0"),
        (CHECK.replace("ag = 0.15", "ag = \"much\""), "SLV.ag"),
        (CHECK.replace("ag = 0.15", "ag = 15"), "SLV.ag"),
        (CHECK.replace("soil = \"B\"\n", ""), "soil"),
        (FRACTIONS.replace("damping = 0.05", "dampening = 1"), "dampening"),
        (FRACTIONS.replace("[4.0, 0.5]", "[4.0, -0.5]"), "spectrum"),
    ] {
        let file = CheckFile::parse("s.toml", &text).unwrap();
        let error = read(&file).unwrap_err();
        assert_eq!(error.keys().unwrap().join("."), keys, "{error}");
    }
}

/// The example of each code is a table that it takes.
#[test]
fn examples_are_read() {
    for code in CODES {
        reads(code.example).unwrap();
        assert!(code.example.contains(&format!("code = {:?}", code.name)));
    }
}
