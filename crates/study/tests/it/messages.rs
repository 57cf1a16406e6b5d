//! Tests what is said of studies and tables `[check]` that cannot be read: key, line and what is expected, in
//! plain words.

use rocking_wall::scene::{Place, SceneError};
use study::circolare::read_table;
use study::document::StudyFile;

use crate::broken::{assert_plain, broken};

const STUDY: &str = "title = \"a\"\nmodels = [\"CR\", { model = \"CDC\", xi = 0.03 }]\ntail = 5.0\n\
    intensity = { measure = \"Sa\", period = 0.5 }\n[levels]\nmethod = \"grid\"\nunit = \"g\"\n\
    values = [0.1, 0.2]\n[records]\nfiles = [\"a.AT2\"]\nunit = \"g\"\nformat = \"at2\"\n\
    synthetic = { count = 2, seed = 1 }\n[report]\nfractions = [0.1, 1]\nresamples = 200\n[[classes]]\n\
    name = \"all\"\nwalls = [\"1\"]\nweights = [1.0]\n[[storeys]]\nperiod = 0.3\n[supports]\nbottom = 1\n\
    [[walls]]\nname = \"1\"\ngeometry = { height = 3.0, thickness = 0.3 }\n[[walls]]\ntable = \"a.csv\"\n";

const CHECK: &str = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"beam\"\nyoung_modulus = 1e9\n\
    knowledge_level = \"LC1\"\ncompression_considered = true\nsoil = \"B\"\ntopography = \"T1\"\n\
    use_class = \"II\"\nmethod = \"nonlinear\"\nrecord_scale = \"ag\"\n[check.SLV]\nag = 0.15\nF0 = 2.4\n\
    TC = 0.3\n[check.SLC]\nag = 0.2\nspectrum = [[0.0, 0.2], [4.0, 0.01]]\nspectrum_damping = 0.1\n\
    [check.building]\nstoreys = 3\nperiod = 0.3\nheight_ratio = 1.0\n[check.records]\nfiles = [\"a.AT2\"]\n";

/// Breaks every line of a text in every way.
fn walk<T>(text: &str, read: impl Fn(&Place<'_>) -> Result<T, SceneError>) {
    assert!(read(&Place::new("whole.toml", text)).is_ok());
    let texts = broken(text);
    let mut refusals = 0;
    for text in &texts {
        if let Err(error) = read(&Place::new("broken.toml", text)) {
            assert_plain(&error.to_string(), text);
            refusals += 1;
        }
    }
    // a few changes leave a text that reads, and the table checks its values later
    assert!(2 * refusals > texts.len(), "{refusals} of {}", texts.len());
}

#[test]
fn no_message_speaks_in_words_of_the_reader() {
    walk(STUDY, |place| StudyFile::parse(place.name(), place.text()));
    walk(CHECK, read_table);
}

#[test]
fn messages_name_line_and_key_and_what_is_expected() {
    let study = |text: &str| StudyFile::parse("s.toml", text).unwrap_err().to_string();
    let check = |text: &str| read_table(&Place::new("s.toml", text)).unwrap_err().to_string();
    for (found, message) in [
        (study("models = \"CR\"\n"), "s.toml, line 1: models = \"CR\": expected a list"),
        (study("models = []\n"), "s.toml, line 1: levels is missing; add it"),
        (study("models = []\nlevels = { method = 3 }\n"), "line 2: method = 3: expected a text in quotes"),
        (study(&STUDY.replace("\"at2\"", "\"at3\"")), "line 12: format = \"at3\": "),
        (
            study(&STUDY.replace("count = 2", "count = 2.5")),
            "line 13: count = 2.5: expected a whole number from 0 on",
        ),
        (
            study(&STUDY.replace("tail = 5.0", "tail = \"5,0\"")),
            "line 3: tail = 5,0: a number has a decimal point",
        ),
        (
            check(&CHECK.replace("\"nonlinear\"", "\"nonlinaer\"")),
            "line 10: method = \"nonlinaer\" is not one of \"nonlinear\", \"linear\", \"dynamic\" (did you \
             mean \"nonlinear\"?)",
        ),
        (check(&CHECK.replace("\"LC1\"", "1")), "line 5: knowledge_level = 1: expected a name in quotes"),
        (
            check(&CHECK.replace("\"T1\"", "true")),
            "line 8: topography = true: expected \"T1\" to \"T4\", or S_T",
        ),
        (check(&CHECK.replace("ag = 0.15\n", "")), "line 12: check.SLV needs ag; add it"),
        (check(&CHECK.replace("[0.0, 0.2]", "[0.0]")), "spectrum = [0.0]: expected a list of 2 values"),
        (check(&CHECK.replace("F0", "f0")), "unknown key \"f0\" in [check.SLV] (did you mean \"F0\"?)"),
    ] {
        assert!(found.contains(message), "{found}\nfor {message}");
    }
}
