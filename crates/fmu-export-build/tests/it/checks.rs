//! Every check: the right description with one mistake, and the message it gets.

use crate::{BLOCK, Folder, block_with, quoted};
use fmu_export_build::{Description, DescriptionError, generate};

/// The message for the description with `from` replaced by `to`; the line in it is that of `from`.
#[track_caller]
fn refused(from: &str, to: &str, message: &str) {
    let at = BLOCK.find(&quoted(from)).expect("the text to replace is there");
    let line = BLOCK[..at].matches('\n').count() + 1;
    refused_at(from, to, &format!("line {line}: {message}"));
}

/// The same with the line in the message, for mistakes that show elsewhere.
#[track_caller]
fn refused_at(from: &str, to: &str, message: &str) {
    let error = Description::parse(&block_with(from, to)).expect_err("the mistake is found");
    assert_eq!(error.to_string(), message);
}

#[test]
fn names() {
    refused(
        "name='x_dot'",
        "name='force'",
        "`force` has the name force, which `force` on line 20 has already",
    );
    refused(
        "name='x_start'",
        "name='x.dot'",
        "`x.dot` has the Rust name XDot, which `x_dot` on line 22 has already",
    );
    refused("name='weight'", "name='1'", "`1` cannot be turned into a Rust name");
    refused("name='weight'", "name='self'", "`self` cannot be turned into a Rust name");
    // In different enums equal Rust names do not clash.
    assert!(Description::parse(&block_with("name='moving'", "name='X'")).is_ok());
}

#[test]
fn value_references_are_unique_over_all_types() {
    refused(
        "valueReference='60'",
        "valueReference='10'",
        "`surface` has the value reference 10, which `force` on line 20 has already",
    );
    refused("valueReference='60'", "valueReference='-1'", "valueReference=\"-1\" is not a value reference");
    refused("valueReference='60'", "", "<ScalarVariable> needs the attribute `valueReference`");
}

#[test]
fn start_values_are_there_where_they_must_be_and_only_there() {
    refused("unit='N' start='0'", "unit='N'", "`force` (input) needs a start value");
    refused("max='9' start='3'", "max='9'", "`layers` (parameter, exact) needs a start value");
    refused("initial='calculated'", "initial='exact'", "`x` (output, exact) needs a start value");
    refused("initial='calculated'", "initial='approx'", "`x` (output, approx) needs a start value");
    refused(
        "derivative='2'",
        "derivative='2' start='0'",
        "`x_dot` (output, calculated) must not have a start value",
    );
    refused(
        "<Boolean/>",
        "<Boolean start='true'/>",
        "`moving` (output, calculated) must not have a start value",
    );
}

#[test]
fn units_and_types_are_declared() {
    refused("unit='m/s'", "unit='km/h'", "the unit `km/h` of `x_dot` is not declared in UnitDefinitions");
    refused(
        "<Real unit='m' ",
        "<Real unit='ft' ",
        "the unit `ft` of `Length` is not declared in UnitDefinitions",
    );
    refused(
        "displayUnit='mm'",
        "displayUnit='cm'",
        "the display unit `cm` of `Length` is not declared with the unit `m`",
    );
    refused(
        "unit='m/s' derivative",
        "unit='m/s' displayUnit='mm' derivative",
        "the display unit `mm` of `x_dot` is not declared with the unit `m/s`",
    );
    refused(
        "<Real declaredType='Length'/>",
        "<Real declaredType='Length' unit='N'/>",
        "`x` has the unit `N`, but its type has `m`",
    );
    refused(
        "<Real declaredType='Length'/>",
        "<Real declaredType='Lenght'/>",
        "the type `Lenght` of `x` is not declared in TypeDefinitions as a Real",
    );
    refused(
        "declaredType='Surface'",
        "declaredType='Length'",
        "the type `Length` of `surface` is not declared in TypeDefinitions as an Enumeration",
    );
}

#[test]
fn causality_variability_and_initial_go_together() {
    let parameter = "'layers' valueReference='70' causality='parameter' variability='fixed'";
    for (attributes, what) in [
        ("causality='parameter'", "parameter, continuous and without initial"),
        ("causality='parameter' variability='fixed' initial='calculated'", "parameter, fixed and calculated"),
        ("causality='input' variability='fixed'", "input, fixed and without initial"),
        ("causality='input' variability='discrete' initial='exact'", "input, discrete and exact"),
        ("causality='output' variability='tunable'", "output, tunable and without initial"),
        (
            "causality='calculatedParameter' variability='fixed' initial='exact'",
            "calculatedParameter, fixed and exact",
        ),
        ("variability='constant' initial='approx'", "local, constant and approx"),
        ("causality='independent' variability='discrete'", "independent, discrete and without initial"),
    ] {
        let replacement = format!("'layers' valueReference='70' {attributes}");
        refused(parameter, &replacement, &format!("`layers` cannot be {what} at once"));
    }
    refused(
        "causality='output' variability='discrete'",
        "causality='output'",
        "`moving` is continuous (which is what leaving out the variability means), but only a Real can be",
    );
    refused("causality='input'", "causality='inputs'", "causality=\"inputs\" is not a causality");
}

#[test]
fn limits_are_in_order_and_hold_for_the_start_value() {
    refused(
        "min='1' max='9'",
        "min='10' max='9'",
        "the limits of `layers` are crossed: min 10 exceeds max 9",
    );
    refused(
        "max='9' start='3'",
        "max='2' start='3'",
        "the start value 3 of `layers` is outside its limits 1 to 2",
    );
    // The upper limit is the type's.
    refused(
        "start='0.1'",
        "start='50.1'",
        "the start value 50.1 of `x_start` is outside its limits -0.00000005 to 50",
    );
    assert!(Description::parse(&block_with("start='0.1'", "start='50'")).is_ok(), "limits are inclusive");
    refused("start='0.1'", "start='nan'", "start=\"NaN\" is not a finite number");
    refused("start='0.1'", "start='0,1'", "start=\"0,1\" is not a number");
    refused("start='3'", "start='3.5'", "start=\"3.5\" is not a whole number of 32 bits");
}

#[test]
fn enumerations() {
    refused("start='2'", "start='3'", "the start value 3 of `surface` is not an item of its type `Surface`");
    refused(
        "name='sand' value='2'",
        "name='sand' value='1'",
        "`sand` has the value 1, which `wet_ice` on line 13 has already",
    );
    refused(
        "name='sand'",
        "name='wet-ice'",
        "`wet-ice` has the Rust name WetIce, which `wet_ice` on line 13 has already",
    );
}

#[test]
fn derivatives() {
    refused(
        "derivative='2'",
        "derivative='9'",
        "`x_dot` gives the index 9 in `derivative`, but there are only the variables 1 to 8",
    );
    refused(
        "derivative='2'",
        "derivative='0'",
        "`x_dot` gives the index 0 in `derivative`, but there are only the variables 1 to 8",
    );
    let rule = "and both must be continuous Reals and not the same";
    refused("derivative='2'", "derivative='4'", &format!("`x_dot` is the derivative of `moving`, {rule}"));
    refused("derivative='2'", "derivative='3'", &format!("`x_dot` is the derivative of `x_dot`, {rule}"));
}

#[test]
fn the_structure_lists_exactly_what_it_must() {
    refused(
        "index='4' dependencies",
        "index='8' dependencies",
        "Outputs lists `weight`, which does not belong there",
    );
    refused("index='4' dependencies", "index='2' dependencies", "Outputs lists `x` twice");
    refused(
        "index='4' dependencies",
        "index='9' dependencies",
        "`Outputs` gives the index 9 in `index`, but there are only the variables 1 to 8",
    );
    refused_at("      <Unknown index='4' dependencies=''/>\n", "", "line 30: Outputs leaves out `moving`");
    refused(
        "index='3' dependencies='1'",
        "index='2' dependencies='1'",
        "Derivatives lists `x`, which does not belong there",
    );
    refused(
        "<Unknown index='4'/>",
        "<Unknown index='5'/>",
        "InitialUnknowns lists `x_start`, which does not belong there",
    );
    refused_at("      <Unknown index='4'/>\n", "", "line 38: InitialUnknowns leaves out `moving`");
    let whole =
        &BLOCK[BLOCK.find("    <InitialUnknowns>").unwrap()..BLOCK.find("  </ModelStructure>").unwrap()];
    refused_at(whole, "", "line 29: InitialUnknowns leaves out `x`");
}

#[test]
fn dependencies() {
    refused(
        "dependencies='1 2' dependenciesKind='fixed dependent'",
        "dependencies='1 2' dependenciesKind='fixed'",
        "`x_dot` has 2 dependencies, but dependenciesKind has 1 entries",
    );
    refused("dependencies='1'", "dependencies='one'", "dependencies=\"one\" is not an index");
    refused(
        "dependencies='1'",
        "dependencies='12'",
        "`x_dot` gives the index 12 in `dependencies`, but there are only the variables 1 to 8",
    );
    refused("dependencies='1'", "dependencies='5'", "in Derivatives, `x_dot` cannot depend on `x_start`");
    refused("dependencies='5'", "dependencies='8'", "in InitialUnknowns, `x` cannot depend on `weight`");
    refused(
        "dependenciesKind='dependent constant'",
        "dependenciesKind='dependent fixed'",
        "in InitialUnknowns, the dependenciesKind of `weight` cannot contain \"fixed\", only dependent, \
         constant",
    );
}

#[test]
fn the_frame() {
    refused("fmiVersion='2.0'", "fmiVersion='3.0'", "fmiVersion is \"3.0\": only \"2.0\" is understood");
    refused("guid='{fingerprint}'", "", "<fmiModelDescription> needs the attribute `guid`");
    refused_at("  <CoSimulation modelIdentifier='block'/>\n", "", "line 2: <CoSimulation> is missing");
    refused_at("<Boolean/>", "", "line 23: <Real> is missing");
    refused("<Boolean/>", "<Bool/>", "expected <Real>, found <Bool>");
    let error = Description::parse(&BLOCK[..BLOCK.len() - 10]).unwrap_err().to_string();
    assert!(error.starts_with("line 45: not well-formed XML: "), "{error}");
}

const CO_SIMULATION: &str = "  <CoSimulation modelIdentifier='block'/>\n";
const EXCHANGE: &str = "<ModelExchange modelIdentifier='block'/>";
const INDICATORS: &str = " numberOfEventIndicators='2'>\n";

/// The block for Model Exchange, `frame` being the end of its first tag.
fn exchange(frame: &str, element: &str, other: &str) -> Result<Description, String> {
    let head = format!("{{fingerprint}}'>\n{CO_SIMULATION}");
    let text = block_with(&head, &format!("{{fingerprint}}'{frame}{element}{other}"));
    Description::parse(&text).map_err(|fault| fault.to_string())
}

#[test]
fn either_kind_or_both() {
    for other in ["", CO_SIMULATION] {
        let description = exchange(INDICATORS, EXCHANGE, other).unwrap();
        assert_eq!(description.model_identifier(), "block");
        assert_eq!(description.event_indicators(), 2);
    }
    let error = exchange(">\n", EXCHANGE, CO_SIMULATION).unwrap_err();
    let apart = "<ModelExchange> and numberOfEventIndicators belong together; 0 if there are none";
    assert_eq!(error, format!("line 2: {apart}"));
    let error = exchange(INDICATORS, "", CO_SIMULATION).unwrap_err();
    assert_eq!(error, format!("line 2: {apart}"));
    let error = exchange(" numberOfEventIndicators='-1'>\n", EXCHANGE, "").unwrap_err();
    assert!(error.ends_with("numberOfEventIndicators=\"-1\" is not a number of event indicators"), "{error}");
    let error = exchange(INDICATORS, &EXCHANGE.replace("block", "brick"), CO_SIMULATION).unwrap_err();
    assert!(error.contains("the modelIdentifiers \"brick\" and \"block\" differ"), "{error}");
    let error = exchange(INDICATORS, "<ModelExchange/>", "").unwrap_err();
    assert!(error.ends_with("<ModelExchange> needs the attribute `modelIdentifier`"), "{error}");
}

#[test]
fn model_exchange_lists_its_derivatives() {
    let list = "    <Derivatives>\n      <Unknown index='3' dependencies='1'/>\n    </Derivatives>\n";
    // x is no known state then, and nothing may depend on it
    let text = block_with(list, "")
        .replace(&quoted(CO_SIMULATION), EXCHANGE)
        .replace("guid=\"{fingerprint}\">", "guid=\"{fingerprint}\" numberOfEventIndicators=\"0\">")
        .replace("dependencies=\"2\" dependenciesKind=\"constant\"", "dependencies=\"\"")
        .replace("dependencies=\"1 2\" dependenciesKind=\"fixed dependent\"", "dependencies=\"1\"");
    let error = Description::parse(&text).unwrap_err().to_string();
    assert!(error.ends_with("<Derivatives> is missing"), "{error}");
}

#[test]
fn the_message_of_generate_starts_with_file_and_line() {
    let folder = Folder::new("checks");
    let xml = folder.path("broken.xml");
    let missing = generate(&xml, &folder.0).unwrap_err();
    assert!(matches!(missing, DescriptionError::Read { .. }), "{missing}");
    std::fs::write(&xml, block_with("start='0.1'", "")).unwrap();
    let broken = generate(&xml, &folder.0).unwrap_err().to_string();
    assert_eq!(broken, format!("{}:24: `x_start` (parameter, exact) needs a start value", xml.display()));
    assert!(!folder.path("variables.rs").exists());
}
