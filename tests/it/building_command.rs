//! Tests what `wall building` refuses. tests/masters tests what it makes, in other masters.

use crate::command_line::{folder, refused};

const FLOOR: &str = "[[floor]]\nname = \"low\"\n";

#[test]
fn the_first_fault_is_named_with_its_line_and_nothing_is_left() {
    let folder = folder("building");
    std::fs::write(folder.join("parapet.toml"), "inputs = [\"a_bottom\"]\n").unwrap();
    std::fs::write(folder.join("moved.toml"), "[motion]\nsynthetic = {}\n").unwrap();
    let wall = |text: &str| format!("{FLOOR}[[wall]]\nname = \"w\"\n{text}\n");
    let cases: [(String, &[&str]); 12] = [
        (String::new(), &["[[floor]]"]),
        (format!("{FLOOR}mass = 0.0\n"), &["line 3", "mass", "0.001"]),
        (format!("{FLOOR}coupling = \"impulses\"\n"), &["line 3", "coupling", "stiffness"]),
        (format!("{FLOOR}hysteresis = \"cubic\"\n"), &["line 3", "cubic", "none, bilinear"]),
        (format!("{FLOOR}on = \"high\"\n"), &["line 3", "high", "ground"]),
        ("[[floor]]\nname = \"a b\"\n".into(), &["line 2", "a b", "letters"]),
        (format!("[[floor]]\nname = \"{}\"\n", "a".repeat(101)), &["line 2", "101", "at most 100"]),
        // the same file on machines whose file names ignore case
        (format!("{FLOOR}[[floor]]\nname = \"LOW\"\n"), &["line 4", "LOW", "choose another"]),
        (
            wall("scene = \"parapet.toml\"\nbottom = \"low\"\ntop = \"ground\"\ndrift = true"),
            &["line 8", "drift"],
        ),
        (FLOOR.into(), &["cargo xtask fmu", "--floor-fmu"]),
        (wall("scene = \"moved.toml\"\nbottom = \"low\""), &["moved.toml", "[motion]"]),
        // the option of this command, not that of `wall package`
        (wall("scene = \"parapet.toml\"\nbottom = \"low\""), &["cargo xtask fmu", "--wall-fmu"]),
    ];
    for (text, words) in cases {
        std::fs::write(folder.join("b.toml"), &text).unwrap();
        refused(&folder, &["building", "b.toml", "-o", "b.ssp"], words);
    }
}
