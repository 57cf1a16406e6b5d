//! Descriptions with fewer variables.

use crate::{BLOCK, exchange};
use fmu_export_build::{DefaultExperiment, Description, Reduction, ReductionError};

fn reduce(
    text: &str,
    keep: &dyn Fn(&str) -> bool,
    starts: &[(&str, &str)],
) -> Result<Description, ReductionError> {
    let starts: Vec<_> =
        starts.iter().map(|(name, start)| ((*name).to_owned(), (*start).to_owned())).collect();
    let reduction = Reduction {
        model_name: "block on sand",
        description: "Sand & nothing else",
        keep,
        starts: &starts,
        experiment: DefaultExperiment { start: 0.0, stop: 12.5, step: 0.01, tolerance: 1e-9 },
    };
    Description::parse(text).unwrap().reduced(&reduction, "{a-b}")
}

/// A condition goes with the parameter that it names.
#[test]
fn conditions_name_no_parameter_that_is_left_out() {
    let condition =
        "<Annotations><Tool name=\"t\"><Where surface=\"sand\"/></Tool></Annotations></ScalarVariable>";
    let at = BLOCK.find("name=\"layers\"").unwrap();
    let end = at + BLOCK[at..].find("</ScalarVariable>").unwrap();
    let text = BLOCK[..end].to_owned() + condition + &BLOCK[end + "</ScalarVariable>".len()..];
    let has_condition = |left_out: &str| {
        reduce(&text, &|name| name != left_out, &[]).unwrap().to_xml().contains("<Where surface")
    };
    assert!(has_condition("weight") && !has_condition("surface"));
}

#[test]
fn what_is_left_out_leaves_no_trace() {
    let keep = |name: &str| !["force", "x_dot", "surface"].contains(&name);
    let reduced = reduce(BLOCK, &keep, &[("x_start", "0.25"), ("layers", "4")]).unwrap();
    // Indices count anew, value references stay, x is no state without x_dot.
    let expected = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="block on sand" guid="{a-b}" description="Sand &amp; nothing else">
  <CoSimulation modelIdentifier="block"/>
  <UnitDefinitions>
    <Unit name="m">
      <BaseUnit m="1"/>
      <DisplayUnit name="mm" factor="1000"/>
    </Unit>
    <Unit name="N">
      <BaseUnit kg="1" m="1" s="-2"/>
    </Unit>
  </UnitDefinitions>
  <TypeDefinitions>
    <SimpleType name="Length">
      <Real unit="m" displayUnit="mm" max="50"/>
    </SimpleType>
  </TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="12.5" stepSize="0.01" tolerance="1e-9"/>
  <ModelVariables>
    <ScalarVariable name="x" valueReference="20" causality="output" initial="calculated" description="Position">
      <Real declaredType="Length"/>
    </ScalarVariable>
    <ScalarVariable name="moving" valueReference="40" causality="output" variability="discrete">
      <Boolean/>
    </ScalarVariable>
    <ScalarVariable name="x_start" valueReference="50" causality="parameter" variability="fixed">
      <Real declaredType="Length" min="-5e-8" start="0.25"/>
    </ScalarVariable>
    <ScalarVariable name="layers" valueReference="70" causality="parameter" variability="fixed">
      <Integer min="1" max="9" start="4"/>
    </ScalarVariable>
    <ScalarVariable name="weight" valueReference="80" causality="calculatedParameter" variability="fixed">
      <Real unit="N"/>
    </ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs>
      <Unknown index="1" dependencies="" dependenciesKind=""/>
      <Unknown index="2" dependencies=""/>
    </Outputs>
    <InitialUnknowns>
      <Unknown index="1" dependencies="3" dependenciesKind="dependent"/>
      <Unknown index="2"/>
      <Unknown index="5" dependencies="4" dependenciesKind="dependent"/>
    </InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"#;
    assert_eq!(reduced.to_xml(), expected);
    assert_eq!(reduced.declared_guid(), "{a-b}");
}

#[test]
fn states_and_their_derivatives_stay_related() {
    let reduced = reduce(BLOCK, &|name| name != "force", &[]).unwrap().to_xml();
    assert!(reduced.contains("<Real unit=\"m/s\" derivative=\"1\"/>"), "{reduced}");
    assert!(reduced.contains("<Derivatives>\n      <Unknown index=\"2\" dependencies=\"\"/>"), "{reduced}");
    assert!(
        reduced.contains("<Unknown index=\"2\" dependencies=\"1\" dependenciesKind=\"dependent\"/>"),
        "{reduced}"
    );
}

#[test]
fn model_exchange_goes_with_a_state() {
    let without = |left_out: &str| reduce(&exchange(), &|name| name != left_out, &[]).unwrap().to_xml();
    assert!(without("force").contains("<ModelExchange"));
    assert!(without("force").contains("numberOfEventIndicators=\"4\""));
    for state in ["x", "x_dot"] {
        let reduced = without(state);
        assert!(
            !reduced.contains("ModelExchange") && !reduced.contains("numberOfEventIndicators"),
            "{reduced}"
        );
    }
}

#[test]
fn start_values_are_checked() {
    let all = |_: &str| true;
    let unknown = reduce(BLOCK, &all, &[("weigth", "1")]).unwrap_err();
    let message = "a start value is given for `weigth`, which the reduced description does not have";
    assert_eq!(unknown.to_string(), message);
    let left_out = reduce(BLOCK, &|name| name != "layers", &[("layers", "1")]);
    assert_eq!(left_out.unwrap_err(), ReductionError::NoSuchVariable { name: "layers".to_owned() });
    for (name, start, message) in [
        ("layers", "10", "the start value 10 of `layers` is outside its limits 1 to 9"),
        ("x_start", "51", "the start value 51 of `x_start` is outside its limits -0.00000005 to 50"),
        ("surface", "3", "the start value 3 of `surface` is not an item of its type `Surface`"),
        ("weight", "3", "`weight` (calculatedParameter, calculated) must not have a start value"),
        ("x_start", "inf", "start=\"inf\" is not a finite number"),
    ] {
        let error = reduce(BLOCK, &all, &[(name, start)]).unwrap_err().to_string();
        assert!(error.ends_with(message), "{error}");
    }
}
