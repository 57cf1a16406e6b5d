//! The system's description as XML: SSP 1.0, with types and units inside.

use std::collections::BTreeSet;
use std::fmt::Write;

use fmu_export::{Causality, Kind, Variable, VariableId};
use rocking_floor::variables::RealVariable as FloorVariable;

use crate::wiring::{Component, System};

const NAMESPACES: [(&str, &str); 4] = [
    ("ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon"),
    ("ssd", "http://ssp-standard.org/SSP1/SystemStructureDescription"),
    // the step for libcosim
    ("osp", "http://opensimulationplatform.com/SSP/OSPAnnotations"),
    // the step for OMSimulator
    ("oms", "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"),
];

/// The name of description and system. Some importers want identifiers, so the title is the description.
const NAME: &str = "building";

/// Units in SI base units, as in the model descriptions.
const UNITS: [(&str, &str); 9] = [
    ("1", ""),
    ("m", r#" m="1""#),
    ("m/s", r#" m="1" s="-1""#),
    ("m/s2", r#" m="1" s="-2""#),
    ("kg", r#" kg="1""#),
    ("s", r#" s="1""#),
    ("N", r#" kg="1" m="1" s="-2""#),
    ("N/m", r#" kg="1" s="-2""#),
    ("N.s/m", r#" kg="1" s="-1""#),
];

/// The text of `SystemStructure.ssd`, with the communication step `step` \[s\].
pub(crate) fn text(system: &System, step: f64) -> String {
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    // writing to a String cannot fail
    let _ = write(&mut xml, system, step);
    xml
}

fn write(xml: &mut String, system: &System, step: f64) -> std::fmt::Result {
    let title = escaped(&system.title);
    write!(xml, "<ssd:SystemStructureDescription version=\"1.0\" name=\"{NAME}\"")?;
    writeln!(xml, " generationTool=\"rocking-wall {}\"", env!("CARGO_PKG_VERSION"))?;
    let namespaces: Vec<_> =
        NAMESPACES.iter().map(|(prefix, uri)| format!("  xmlns:{prefix}=\"{uri}\"")).collect();
    writeln!(xml, "{}>", namespaces.join("\n"))?;
    writeln!(xml, "  <ssd:System name=\"{NAME}\" description=\"{title}\">")?;
    if system.expose_ground {
        writeln!(xml, "    <ssd:Connectors>")?;
        write_connector(xml, "      ", FloorVariable::AG.variable())?;
        writeln!(xml, "    </ssd:Connectors>")?;
    }
    writeln!(xml, "    <ssd:Elements>")?;
    for component in &system.components {
        write_component(xml, component)?;
    }
    writeln!(xml, "    </ssd:Elements>\n    <ssd:Connections>")?;
    for connection in &system.connections {
        write!(xml, "      <ssd:Connection")?;
        if let Some(from) = connection.from {
            write!(xml, " startElement=\"{}\"", system.components[from].name)?;
        }
        let to = &system.components[connection.to].name;
        let (output, input) = (connection.output, connection.input);
        writeln!(xml, " startConnector=\"{output}\" endElement=\"{to}\" endConnector=\"{input}\"/>")?;
    }
    writeln!(xml, "    </ssd:Connections>\n    <ssd:Annotations>")?;
    writeln!(xml, "      <ssc:Annotation type=\"org.openmodelica\">\n        <oms:Annotations>")?;
    writeln!(xml, "          <oms:SimulationInformation>")?;
    write!(xml, "            <oms:FixedStepMaster description=\"oms-ma\"")?;
    writeln!(xml, " stepSize=\"{step:?}\" relativeTolerance=\"1e-08\"/>")?;
    writeln!(xml, "          </oms:SimulationInformation>\n        </oms:Annotations>")?;
    writeln!(xml, "      </ssc:Annotation>\n    </ssd:Annotations>\n  </ssd:System>")?;
    write_units(xml, system)?;
    writeln!(xml, "  <ssd:DefaultExperiment startTime=\"0\" stopTime=\"{:?}\">", system.stop_time)?;
    writeln!(xml, "    <ssd:Annotations>\n      <ssc:Annotation type=\"com.opensimulationplatform\">")?;
    writeln!(xml, "        <osp:Algorithm>")?;
    writeln!(xml, "          <osp:FixedStepAlgorithm baseStepSize=\"{step:?}\"/>")?;
    writeln!(xml, "        </osp:Algorithm>\n      </ssc:Annotation>\n    </ssd:Annotations>")?;
    writeln!(xml, "  </ssd:DefaultExperiment>\n</ssd:SystemStructureDescription>")
}

fn write_component(xml: &mut String, component: &Component) -> std::fmt::Result {
    let Component { name, source, connectors } = component;
    write!(xml, "      <ssd:Component name=\"{name}\" type=\"application/x-fmu-sharedlibrary\"")?;
    writeln!(xml, " source=\"{source}\" implementation=\"CoSimulation\">\n        <ssd:Connectors>")?;
    for connector in connectors {
        write_connector(xml, "          ", connector)?;
    }
    writeln!(xml, "        </ssd:Connectors>")?;
    writeln!(xml, "      </ssd:Component>")
}

fn write_connector(xml: &mut String, indent: &str, variable: &Variable) -> std::fmt::Result {
    let Variable { name, causality, kind, unit, .. } = variable;
    let direction = if *causality == Causality::Input { "input" } else { "output" };
    let kind = match (kind, unit) {
        (Kind::Boolean { .. }, _) => "<ssc:Boolean/>".to_owned(),
        (_, Some(unit)) => format!("<ssc:Real unit=\"{unit}\"/>"),
        (_, None) => "<ssc:Real/>".to_owned(),
    };
    writeln!(xml, "{indent}<ssd:Connector name=\"{name}\" kind=\"{direction}\">{kind}</ssd:Connector>")
}

/// The units that connectors name.
fn write_units(xml: &mut String, system: &System) -> std::fmt::Result {
    let connectors = system.components.iter().flat_map(|component| &component.connectors);
    let mut used: BTreeSet<&str> = connectors.filter_map(|connector| connector.unit).collect();
    used.insert("m/s2");
    writeln!(xml, "  <ssd:Units>")?;
    for unit in used {
        let base = UNITS.iter().find(|(name, _)| *name == unit).map_or("", |(_, base)| base);
        writeln!(xml, "    <ssc:Unit name=\"{unit}\"><ssc:BaseUnit{base}/></ssc:Unit>")?;
    }
    writeln!(xml, "  </ssd:Units>")
}

/// Text inside an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;").replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use rocking_wall::variables::RealVariable;

    use super::*;

    #[test]
    fn every_unit_of_a_connector_has_its_base_units() {
        let known = |unit: Option<&str>| unit.is_none_or(|unit| UNITS.iter().any(|(name, _)| *name == unit));
        for variable in FloorVariable::ALL.iter().map(|id| id.variable()) {
            let connectable =
                variable.causality == Causality::Parameter || variable.name.contains("reaction");
            assert!(!connectable || known(variable.unit), "{}", variable.name);
        }
        for name in ["a_bottom", "drift", "reaction_top", "u", "u_dot", "u_ratio", "overturn_time"] {
            let variable = RealVariable::from_name(name).map(VariableId::variable);
            assert!(variable.is_some_and(|variable| known(variable.unit)), "{name}");
        }
    }

    /// `OMSimulator` accepts only identifiers as names. The annotation tells it that a system has a master.
    #[test]
    fn names_are_identifiers_and_the_system_states_its_step() {
        let (title, components, connections) = ("A \"tall\" house".to_owned(), Vec::new(), Vec::new());
        let system = System { title, components, connections, expose_ground: false, stop_time: 2.0 };
        let xml = text(&system, 0.0025);
        let names: Vec<_> = xml.split(" name=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(names, ["building", "building", "m/s2"]);
        assert!(xml.contains("description=\"A &quot;tall&quot; house\""));
        assert!(xml.contains("<oms:FixedStepMaster description=\"oms-ma\" stepSize=\"0.0025\""));
    }

    #[test]
    fn titles_are_escaped() {
        assert_eq!(escaped("a \"b\" <c> & d\n"), "a &quot;b&quot; &lt;c> &amp; d ");
    }
}
