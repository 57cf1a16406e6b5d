//! Tests `wall verify tests`, and that `docs/validation.md` shows what it computes.

use std::fs;
use std::path::Path;

use crate::command_line::{assert_has, content, folder, printed, refused};
use crate::root;

/// The document and its pictures are those of this program.
#[test]
fn the_document_shows_what_the_program_computes() {
    let document = fs::read_to_string(root().join("docs/validation.md")).unwrap();
    let folder = folder("validation");
    let mut cases = 0;
    for entry in fs::read_dir(root().join("tests/data/validation")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        cases += 1;
        let name = path.file_stem().unwrap().to_str().unwrap();
        let table = printed(&folder, &["verify", "tests", path.to_str().unwrap(), "--plot", "plot.svg"]);
        let remedy = "run cargo xtask figures --validation";
        assert!(document.contains(table.trim_matches('\n')), "{name}: {remedy}\n{table}");
        assert!(document.contains(&format!("images/{name}.svg")), "{name}");
        let drawn = content(&folder, "plot.svg");
        let kept = fs::read_to_string(root().join(format!("docs/images/{name}.svg"))).unwrap();
        assert!(drawn == kept, "docs/images/{name}.svg: {remedy}");
    }
    assert_eq!(cases, 3);
}

/// The example for a laboratory is a test as it stands in the document.
#[test]
fn the_example_of_the_document_can_be_used() {
    let document = fs::read_to_string(root().join("docs/validation.md")).unwrap();
    let folder = folder("validation_example");
    for (language, file) in [("toml", "my_wall.toml"), ("csv", "my_wall.csv")] {
        let (_, rest) = document.split_once(&format!("```{language}\n")).unwrap();
        fs::write(folder.join(file), rest.split_once("```").unwrap().0).unwrap();
    }
    assert_has(&printed(&folder, &["verify", "tests", "my_wall.toml"]), &["fitted to the peaks"]);
}

#[test]
fn tests_that_cannot_be_used_are_refused() {
    let folder = folder("validate_refused");
    let data = root().join("tests/data/validation");
    let copy = |name: &str, from: &str, to: &str| {
        let text = fs::read_to_string(data.join(name)).unwrap();
        assert!(text.contains(from));
        fs::write(folder.join("test.toml"), text.replace(from, to)).unwrap();
    };
    fs::copy(data.join("brick_wall_11.csv"), folder.join("brick_wall_11.csv")).unwrap();
    fs::write(folder.join("short.csv"), "time_s,displacement_over_thickness\n0,0.5\n0,0.4\n").unwrap();
    fs::write(
        folder.join("beyond.csv"),
        "time_s,displacement_over_thickness\n0,0.5\n0.7,-1.1\n1,0\n1.2,0.4\n",
    )
    .unwrap();
    for (from, to, words) in [
        ("[decay]", "[push]", &["test.toml", "line"][..]),
        ("start = 0.64", "start = 9", &["start = 9", "fewer than two peaks"]),
        ("start = 0.64", "start = 2.1", &["start = 2.1", "fewer than two peaks"]),
        ("a1 = 0.03", "a1 = -0.1", &["test.toml, line", "a1 = -0.1", "minimum"]),
        ("start = 0.64", "start = 0.64\nrestitution = 0", &["restitution = 0", "above 0"]),
        ("start = 0.64", "start = 0.64\nrestitution = 1.2", &["restitution = 1.2", "at most 1"]),
        ("brick_wall_11.csv", "beyond.csv", &["|d|/t = 1.1", "u_ins = 1 t"]),
        ("brick_wall_11.csv", "none.csv", &["none.csv", "cannot be read"]),
        ("brick_wall_11.csv", "short.csv", &["short.csv, line 3", "above"]),
        ("thickness = 0.11", "thickness = -1", &["test.toml, line", "thickness"]),
    ] {
        copy("brick_wall_11.toml", from, to);
        refused(&folder, &["verify", "tests", "test.toml", "--plot", "plot.svg"], words);
    }
    fs::copy(data.join("brick_wall_12.csv"), folder.join("brick_wall_12.csv")).unwrap();
    for (from, to, words) in [
        ("fit_from = 0.058", "fit_from = 0.5", &["fit_from = 0.5", "fewer than two points"][..]),
        ("d1 = 0.94", "d1 = 5", &["test.toml, line", "d1 = 5", "above its maximum, 1"]),
    ] {
        copy("brick_wall_12.toml", from, to);
        refused(&folder, &["verify", "tests", "test.toml"], words);
    }
    assert!(!Path::new(&folder).join("plot.svg").exists());
}
