//! The generated modules, as text; the crates that include them compile them.

use crate::{BLOCK, Folder, block_with, exchange};
use fmu_export_build::{Description, generate};

/// The modules generated from the description `xml`; `test` names a folder of its own.
fn module(test: &str, xml: &str) -> String {
    let folder = Folder::new(test);
    let description = folder.path("modelDescription.xml");
    std::fs::write(&description, xml).unwrap();
    generate(&description, &folder.0).unwrap();
    ["variables.rs", "choices.rs"].map(|name| std::fs::read_to_string(folder.path(name)).unwrap()).concat()
}

/// The text between the braces of the first item that starts with `head`.
fn body<'a>(code: &'a str, head: &str) -> &'a str {
    let start = code.find(head).unwrap_or_else(|| panic!("{head} is there")) + head.len();
    &code[start..start + code[start..].find("\n}").unwrap()]
}

#[test]
fn each_base_type_has_an_enum_of_its_variables() {
    let code = module("enums", BLOCK);
    let variants = |name: &str| {
        let lines = body(&code, &format!("pub enum {name} {{")).lines().map(str::trim);
        lines.filter(|line| !line.starts_with("///") && !line.is_empty()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(variants("RealVariable"), "Force, X, XDot, XStart, Weight,");
    assert_eq!(variants("IntegerVariable"), "Surface, Layers,");
    assert_eq!(variants("BooleanVariable"), "Moving,");
    assert_eq!(variants("StringVariable"), "");
    assert_eq!(variants("Surface"), "WetIce, Sand,");
    assert!(code.contains("    /// `x`: Position \\[m\\].\n    X,\n"), "{code}");
    assert!(code.contains("    /// `x_dot`: Speed \\< 1 \\[m/s\\].\n"), "{code}");
}

#[test]
fn states_and_derivatives_are_named() {
    let code = module("states", &exchange());
    for line in [
        "pub const CONTINUOUS_STATES: &[RealVariable] = &[RealVariable::X];",
        "pub const DERIVATIVES: &[RealVariable] = &[RealVariable::XDot];",
        "pub const EVENT_INDICATORS: usize = 4;",
    ] {
        assert!(code.contains(line), "{line} is missing in\n{code}");
    }
}

/// A `match` names the variables of one causality and leaves the others to patterns, so that the compiler
/// misses a new one.
#[test]
fn each_causality_has_a_pattern() {
    let code = module("patterns", BLOCK);
    let pattern = |name: &str| {
        let head = format!("macro_rules! {name} {{");
        body(&code, &head).split_whitespace().skip(3).take_while(|word| *word != "};").collect::<String>()
    };
    assert_eq!(pattern("real_input"), "RealVariable::Force");
    assert_eq!(pattern("real_output"), "RealVariable::X|RealVariable::XDot");
    assert_eq!(pattern("real_calculated"), "RealVariable::Weight");
    assert_eq!(pattern("integer_parameter"), "IntegerVariable::Surface|IntegerVariable::Layers");
}

#[test]
fn the_tables_say_what_the_description_says() {
    let code = module("tables", BLOCK);
    let guid = Description::parse(BLOCK).unwrap().guid();
    for text in [
        "pub const MODEL_NAME: &str = \"sliding block\";",
        "pub const MODEL_IDENTIFIER: &str = \"block\";",
        &format!("pub const GUID: &str = \"{guid}\";"),
        "50 => Some(Self::XStart),",
        "Real { start: Some(0.1), min: Some(-5e-8), max: Some(50.0) }",
        "Integer { start: Some(3), min: Some(1), max: Some(9) }",
        "Enumeration { start: Some(2), items: &[",
        "::fmu_export::Item { name: \"wet_ice\", value: 1, description: \"Hardly any friction\" },",
        "Boolean { start: None }",
        "causality: ::fmu_export::Causality::CalculatedParameter,",
        "variability: ::fmu_export::Variability::Discrete,",
        "unit: Some(\"m/s\"),",
    ] {
        assert!(code.contains(text), "{text} is missing in\n{code}");
    }
}

#[test]
fn removing_or_adding_a_variable_changes_the_enum() {
    let before = module("before", BLOCK);
    let line = BLOCK.lines().find(|line| line.contains("\"layers\"")).unwrap();
    let structure =
        "      <Unknown index=\"8\" dependencies=\"7 6\" dependenciesKind=\"dependent constant\"/>";
    let without = block_with(&format!("{line}\n"), "")
        .replace(structure, "      <Unknown index=\"7\" dependencies=\"6\"/>");
    let without = module("without", &without);
    assert!(before.contains("Layers") && !without.contains("Layers"));
    let with = line.replace("layers", "tiles").replace("\"70\"", "\"90\"");
    let with = module("with", &block_with("  </ModelVariables>", &format!("{with}\n  </ModelVariables>")));
    assert!(
        !before.contains("Tiles") && with.contains("    Layers,\n    /// `tiles`: .\n    Tiles,\n"),
        "{with}"
    );
}

/// rustc warns of a field with two underscores in a row.
#[test]
fn a_structured_name_becomes_a_field_without_a_warning() {
    let code = module("structured", &block_with("name='layers'", "name='tank[1].count'"));
    assert!(code.contains("self.tank_1_count = value") && code.contains("tank_1_count: 3"), "{code}");
    assert!(code.contains("Tank1Count"));
}
