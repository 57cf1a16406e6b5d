//! Descriptions of FMI 3.0 units.

use crate::{BLOCK, block_with};
use fmu_export_build::{Additions, Description};

const ADDITIONS: &str = r#"<fmi3 mightReturnEarlyFromDoStep="true">
  <Terminals>
    <Terminal name="hand" matchingRule="plug">
      <TerminalMemberVariable variableName="force" memberName="force" variableKind="signal"/>
      <TerminalMemberVariable variableName="x" memberName="position" variableKind="signal"/>
    </Terminal>
    <Terminal name="foot" matchingRule="plug">
      <TerminalMemberVariable variableName="weight" memberName="force" variableKind="signal"/>
    </Terminal>
  </Terminals>
</fmi3>"#;

fn exchange() -> String {
    block_with(
        "<CoSimulation modelIdentifier=\"block\"/>",
        r#"<ModelExchange modelIdentifier="block" completedIntegratorStepNotNeeded="true"/>
  <CoSimulation modelIdentifier="block" canGetAndSetFMUstate="true" canInterpolateInputs="true"
    providesDirectionalDerivative="true"/>"#,
    )
    .replace("guid=", "numberOfEventIndicators=\"2\" guid=")
    .replace("{fingerprint}", "{token}")
}

fn written(description: &str) -> (String, Option<String>) {
    let additions = Additions::parse(ADDITIONS).unwrap();
    Description::parse(description).unwrap().to_fmi3(&additions).unwrap()
}

#[test]
fn everything_is_written_with_the_names_of_fmi_3() {
    let (xml, _) = written(&exchange());
    let lines: Vec<_> = xml.lines().map(str::trim).collect();
    for line in [
        r#"<fmiModelDescription fmiVersion="3.0" modelName="sliding block" instantiationToken="{token}">"#,
        r#"<ModelExchange modelIdentifier="block" needsCompletedIntegratorStep="false"/>"#,
        concat!(
            r#"<CoSimulation modelIdentifier="block" canGetAndSetFMUState="true" "#,
            r#"providesIntermediateUpdate="true" "#,
            r#"providesDirectionalDerivatives="true" providesAdjointDerivatives="true" hasEventMode="true" "#,
            r#"mightReturnEarlyFromDoStep="true"/>"#
        ),
        r#"<Float64Type name="Length" unit="m" displayUnit="mm" max="50"/>"#,
        r#"<EnumerationType name="Surface">"#,
        r#"<Item name="sand" value="2"/>"#,
        r#"<DefaultExperiment startTime="0" stopTime="1" stepSize="0.1" tolerance="1e-6"/>"#,
        concat!(
            r#"<Float64 name="time" valueReference="0" description="Time" causality="independent" "#,
            r#"variability="continuous"/>"#
        ),
        concat!(
            r#"<Float64 name="force" valueReference="10" causality="input" description="Push" "#,
            r#"intermediateUpdate="true" declaredType="Number" start="0"/>"#
        ),
        r#"<Boolean name="moving" valueReference="40" causality="output" variability="discrete"/>"#,
        concat!(
            r#"<Enumeration name="surface" valueReference="60" causality="parameter" variability="fixed" "#,
            r#"declaredType="Surface" start="2"/>"#
        ),
        concat!(
            r#"<Int32 name="layers" valueReference="70" causality="parameter" variability="fixed" min="1" "#,
            r#"max="9" start="3"/>"#
        ),
        concat!(
            r#"<Float64 name="event_indicator_2" valueReference="1073741825" description="Event indicator 2 "#,
            r#"of Model Exchange" causality="local" variability="continuous" initial="calculated"/>"#
        ),
        r#"<Output valueReference="30" dependencies="10 20" dependenciesKind="fixed dependent"/>"#,
        r#"<Output valueReference="40" dependencies=""/>"#,
        r#"<ContinuousStateDerivative valueReference="30" dependencies="10"/>"#,
        r#"<InitialUnknown valueReference="80" dependencies="70 60" dependenciesKind="dependent constant"/>"#,
        r#"<EventIndicator valueReference="1073741824"/>"#,
    ] {
        assert!(lines.contains(&line), "{line} is missing in\n{xml}");
    }
    // the derivative is told by value reference
    assert!(xml.contains(r#"declaredType="Number_2" derivative="20"/>"#));
    for gone in ["guid", "ScalarVariable", "Real", "canInterpolateInputs", "numberOfEventIndicators"] {
        assert!(!xml.contains(gone), "{gone} in\n{xml}");
    }
}

/// Units and nominal values stand in types alone: fmi-schema 0.8 refuses them on variables.
#[test]
fn types_tell_the_units_of_their_variables() {
    let text = BLOCK
        .replace("<Real declaredType=\"Length\"/>", "<Real declaredType=\"Length\" nominal=\"0.5\"/>")
        .replace("<Real unit=\"N\"/>", "<Real unit=\"N\" nominal=\"1e3\"/>")
        .replace("name=\"layers\"", "name=\"Length_2\"")
        .replace("<Unit name=\"N\">", "<Unit name=\"s\"><BaseUnit s=\"1\"/></Unit>\n<Unit name=\"N\">");
    let (xml, _) = written(&text);
    let lines = xml.lines().map(str::trim);
    let types: Vec<_> = lines.filter(|line| line.starts_with("<Float64Type")).collect();
    assert_eq!(
        types,
        [
            // the first variable of a type completes it, and one that says less has a variant
            r#"<Float64Type name="Length" unit="m" displayUnit="mm" max="50" nominal="0.5"/>"#,
            r#"<Float64Type name="Length_3" unit="m" displayUnit="mm" max="50"/>"#,
            r#"<Float64Type name="Number" unit="N"/>"#,
            r#"<Float64Type name="Number_2" unit="m/s"/>"#,
            r#"<Float64Type name="Number_3" unit="N" nominal="1e3"/>"#,
            r#"<Float64Type name="Time" unit="s"/>"#,
        ]
    );
    let of = |name: &str| {
        let line = xml.lines().find(|line| line.contains(&format!("<Float64 name=\"{name}\""))).unwrap();
        assert!(!line.contains(" unit=") && !line.contains("nominal="), "{line}");
        line.split_once("declaredType=\"").unwrap().1.split('"').next().unwrap().to_owned()
    };
    let found = ["time", "force", "x", "x_dot", "x_start", "weight"].map(of);
    assert_eq!(found, ["Time", "Number", "Length", "Number_2", "Length_3", "Number_3"]);
    // a description without types has those that its variables need, in their place
    let before = text.split_once("<TypeDefinitions>").unwrap().0;
    let after = text.split_once("</TypeDefinitions>").unwrap().1;
    let bare = format!("{before}{after}").replace(" declaredType=\"Length\"", " unit=\"m\"");
    let (xml, _) = written(&bare.replace("<Enumeration declaredType=\"Surface\"", "<Integer"));
    let [units, types, experiment] =
        ["</UnitDefinitions>", "<TypeDefinitions>", "<DefaultExperiment"].map(|part| xml.find(part).unwrap());
    assert!(units < types && types < experiment);
}

#[test]
fn co_simulation_alone_has_no_event_indicators() {
    let (xml, _) = written(BLOCK);
    assert!(!xml.contains("event_indicator") && !xml.contains("EventIndicator"));
}

#[test]
fn a_text_starts_in_an_element_and_a_time_of_its_own_stays() {
    let own = block_with(
        "<ScalarVariable name=\"force\"",
        r#"<ScalarVariable name="label" valueReference="7" causality="parameter" variability="fixed">
        <String start="a &lt; b"/></ScalarVariable>
    <ScalarVariable name="t" valueReference="9" causality="independent"><Real/></ScalarVariable>
    <ScalarVariable name="force""#,
    );
    // the new variables shift the indices by two
    let own = own.replace("derivative=\"2\"", "derivative=\"4\"");
    let structure = r"<ModelStructure>
    <Outputs><Unknown index='4'/><Unknown index='5'/><Unknown index='6'/></Outputs>
    <Derivatives><Unknown index='5'/></Derivatives>
    <InitialUnknowns>
      <Unknown index='4'/><Unknown index='5'/><Unknown index='6'/><Unknown index='10'/>
    </InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>";
    let (before, _) = own.split_once("<ModelStructure>").unwrap();
    let (xml, _) = written(&format!("{before}{structure}"));
    assert!(xml.contains(r#"<Start value="a &lt; b"/>"#), "{xml}");
    assert_eq!(xml.matches("independent").count(), 1);
    assert!(!xml.contains("name=\"time\""));
    assert!(xml.contains(r#"<InitialUnknown valueReference="80"/>"#));
}

#[test]
fn terminals_have_the_variables_that_are_there() {
    let (_, terminals) = written(BLOCK);
    let expected = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiTerminalsAndIcons fmiVersion="3.0">
  <Terminals>
    <Terminal name="hand" matchingRule="plug">
      <TerminalMemberVariable variableName="force" memberName="force" variableKind="signal"/>
      <TerminalMemberVariable variableName="x" memberName="position" variableKind="signal"/>
    </Terminal>
"#;
    assert!(terminals.unwrap().starts_with(expected));
    let additions = Additions::parse(&ADDITIONS.replace("\"weight\"", "\"wheight\"")).unwrap();
    let description = Description::parse(BLOCK).unwrap();
    let fault = additions.check(&description).unwrap_err();
    assert_eq!(fault.to_string(), "line 8: there is no variable `wheight`");
    // one that is gone leaves its terminal, and a terminal without any goes with it
    let (_, terminals) = description.to_fmi3(&additions).unwrap();
    let terminals = terminals.unwrap();
    assert!(terminals.contains("\"hand\"") && !terminals.contains("\"foot\""), "{terminals}");
    let additions = Additions::parse("<fmi3/>").unwrap();
    assert_eq!(description.to_fmi3(&additions).unwrap().1, None);
    assert!(Additions::parse("<fmi2/>").is_err());
}

#[test]
fn names_and_references_of_the_added_variables_are_refused() {
    let additions = Additions::parse("<fmi3/>").unwrap();
    for (from, to) in [
        ("valueReference=\"10\"", "valueReference=\"0\""),
        ("valueReference=\"10\"", "valueReference=\"1073741824\""),
        ("name=\"force\"", "name=\"time\""),
        ("name=\"force\"", "name=\"event_indicator_1\""),
    ] {
        let description = Description::parse(&exchange().replace(from, to)).unwrap();
        let fault = description.to_fmi3(&additions).unwrap_err();
        assert!(fault.problem.starts_with("FMI 3.0 needs the name `"), "{to}: {fault}");
    }
}
