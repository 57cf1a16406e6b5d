//! Tests what is said of tables `[check]` that cannot be read: key, line and what is expected, in plain
//! words.

use check::circolare::read_table;
use rocking_wall::scene::Place;

use crate::broken::walk;

const CHECK: &str = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"beam\"\nyoung_modulus = 1e9\n\
    knowledge_level = \"LC1\"\ncompression_considered = true\nsoil = \"B\"\ntopography = \"T1\"\n\
    use_class = \"II\"\nmethod = \"nonlinear\"\nrecord_scale = \"ag\"\n[check.SLV]\nag = 0.15\nF0 = 2.4\n\
    TC = 0.3\n[check.SLC]\nag = 0.2\nspectrum = [[0.0, 0.2], [4.0, 0.01]]\nspectrum_damping = 0.1\n\
    [check.building]\nstoreys = 3\nperiod = 0.3\nheight_ratio = 1.0\n[check.records]\nfiles = [\"a.AT2\"]\n";

#[test]
fn no_message_speaks_in_words_of_the_reader() {
    walk(CHECK, |text| read_table(&Place::new("s.toml", text)));
}

#[test]
fn messages_name_line_and_key_and_what_is_expected() {
    let check = |text: &str| read_table(&Place::new("s.toml", text)).unwrap_err().to_string();
    for (found, message) in [
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
