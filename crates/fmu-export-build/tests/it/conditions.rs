//! Where a variable matters: read from the description, refused where it is wrong, written once.

use crate::BLOCK;
use fmu_export_build::{Description, Fault};

/// The parameter whose condition is tested; its line is the first of the replaced text.
const LAYERS: &str = "name=\"layers\"";

/// The block with `<Where …/>` as the condition of its layers.
fn with_where(place: &str) -> Result<Description, Fault> {
    Description::parse(&annotated(BLOCK, LAYERS, place))
}

/// A text with `<Where …/>` as the condition of the variable that has `name`.
fn annotated(text: &str, name: &str, place: &str) -> String {
    let (before, variable) = text.split_once(name).unwrap();
    let note = format!("<Annotations><Tool name=\"t\">{place}</Tool></Annotations></ScalarVariable>");
    format!("{before}{name}{}", variable.replacen("</ScalarVariable>", &note, 1))
}

#[test]
fn a_condition_is_told_in_words() {
    for (place, words) in [
        ("<Where surface=\"sand\"/>", "surface = sand"),
        ("<Where x_start=\"not 0\"/>", "x_start is not 0"),
        ("<Where x_start=\"1 2 3\" surface=\"sand\"/>", "x_start = 1, 2 or 3 and surface = sand"),
        ("<Where surface=\"sand\"/><Where x_start=\"-1\"/>", "surface = sand, or x_start = -1"),
    ] {
        assert_eq!(with_where(place).unwrap().condition("layers").as_deref(), Some(words));
    }
    assert_eq!(Description::parse(BLOCK).unwrap().condition("layers"), None);
}

/// What makes a parameter count is worth nothing where that parameter does not count itself.
#[test]
fn a_condition_includes_those_of_the_parameters_that_it_names() {
    let own = "<Where surface=\"sand\"/><Where weight_given=\"not 0\"/>";
    let text = annotated(BLOCK, "name=\"x_start\"", own).replace("layers", "weight_given");
    let text = annotated(&text, "name=\"x\"", "<Where x_start=\"0\" surface=\"wet_ice sand\"/>");
    let description = Description::parse(&text).unwrap();
    assert_eq!(
        description.condition("x").unwrap(),
        "x_start = 0 and surface = sand and surface = wet_ice or sand, or \
         x_start = 0 and weight_given is not 0 and surface = wet_ice or sand"
    );
}

/// XML allows `>` in values.
#[test]
fn a_condition_follows_the_whole_description() {
    let description = with_where("<Where surface=\"sand\"/>").unwrap();
    let text = description.text_with_guid(&description.guid());
    let text = text.replace("description=\"where surface = sand\"", "description=\"a > b\"");
    assert_ne!(text, description.text_with_guid(&description.guid()));
    let description = Description::parse(&annotated(&text, LAYERS, "<Where surface=\"sand\"/>")).unwrap();
    let packaged = description.text_with_guid(&description.guid());
    assert!(packaged.contains("description=\"a > b; where surface = sand\""), "{packaged}");
}

/// Importers see the condition in the description of the variable; annotations they do not see.
#[test]
fn a_packaged_description_tells_the_condition() {
    let description = with_where("<Where surface=\"sand\"/>").unwrap();
    let packaged = description.text_with_guid(&description.guid());
    assert!(
        packaged.contains(" description=\"where surface = sand\"") && !packaged.contains("<Where"),
        "{packaged}"
    );
    let again = Description::parse(&packaged).unwrap();
    assert_eq!(again.guid(), description.guid());
    assert_ne!(again.guid(), Description::parse(BLOCK).unwrap().guid());
}

#[test]
fn a_wrong_condition_is_refused_with_its_line() {
    let line = BLOCK.lines().position(|line| line.contains(LAYERS)).unwrap() + 1;
    for (place, why) in [
        ("<Where/>", "is empty"),
        ("<Where x=\"1\"/>", "names `x`, which is not a parameter"),
        ("<Where surface=\"\"/>", "gives \"\", which `surface` cannot be"),
        ("<Where surface=\"gravel\"/>", "gives \"gravel\", which `surface` cannot be"),
        ("<Where x_start=\"many\"/>", "gives \"many\", which `x_start` cannot be"),
        ("<Where layers=\"1\"/>", "depends on itself, by way of others"),
    ] {
        let message = with_where(place).unwrap_err().to_string();
        assert_eq!(message, format!("line {line}: <Where> of `layers` {why}"));
    }
}
