//! Tests what is said of studies that cannot be read: key, line and what is expected, in plain words.

use study::codes::NoCodes;
use study::document::StudyFile;

use crate::broken::walk;

const STUDY: &str = "title = \"a\"\nmodels = [\"CR\", { model = \"CDC\", xi = 0.03 }]\ntail = 5.0\n\
    intensity = { measure = \"Sa\", period = 0.5 }\n[levels]\nmethod = \"grid\"\nunit = \"g\"\n\
    values = [0.1, 0.2]\n[records]\nfiles = [\"a.AT2\"]\nunit = \"g\"\nformat = \"at2\"\n\
    synthetic = { count = 2, seed = 1 }\n[report]\nfractions = [0.1, 1]\nresamples = 200\n[[classes]]\n\
    name = \"all\"\nwalls = [\"1\"]\nweights = [1.0]\n[[storeys]]\nperiod = 0.3\n[supports]\nbottom = 1\n\
    [[walls]]\nname = \"1\"\ngeometry = { height = 3.0, thickness = 0.3 }\n[[walls]]\ntable = \"a.csv\"\n";

#[test]
fn no_message_speaks_in_words_of_the_reader() {
    walk(STUDY, |text| StudyFile::parse("s.toml", text, &NoCodes));
}

#[test]
fn messages_name_line_and_key_and_what_is_expected() {
    let study = |text: &str| StudyFile::parse("s.toml", text, &NoCodes).unwrap_err().to_string();
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
            "line 3: tail = \"5,0\": expected a number with a decimal point",
        ),
    ] {
        assert!(found.contains(message), "{found}\nfor {message}");
    }
}
