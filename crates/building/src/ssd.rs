//! The system's description as XML: SSP 1.0, with types and units inside.

use std::collections::BTreeSet;

use fmu_export::{Causality, Kind, Variable, VariableId};
use rocking_floor::variables::RealVariable as FloorVariable;

use crate::document::{Building, fmu_path};
use crate::wiring::{Connection, System};

/// The name of description and system. Some importers want identifiers, so the title is the description.
const NAME: &str = "building";

/// Units of connectors in SI base units, as in the model descriptions.
const UNITS: [(&str, &str); 6] = [
    ("1", ""),
    ("m", r#" m="1""#),
    ("m/s", r#" m="1" s="-1""#),
    ("m/s2", r#" m="1" s="-2""#),
    ("s", r#" s="1""#),
    ("N", r#" kg="1" m="1" s="-2""#),
];

/// The text of `SystemStructure.ssd`, with the communication step `step` \[s\]: that of `oms` is for
/// `OMSimulator`, that of `osp` for libcosim.
pub(crate) fn text(building: &Building, system: &System, step: f64) -> String {
    let (version, title) = (env!("CARGO_PKG_VERSION"), escaped(&building.title));
    let ground = if system.expose_ground {
        connectors("    ", &[FloorVariable::AG.variable()])
    } else {
        String::new()
    };
    let elements: String = system.components.iter().map(|(name, own)| component(name, own)).collect();
    let connections: String = system.described().map(|each| connection(system, each)).collect();
    let (units, stop_time) = (units(system), building.stop_time);
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="{NAME}" generationTool="rocking-wall {version}"
  xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
  xmlns:osp="http://opensimulationplatform.com/SSP/OSPAnnotations"
  xmlns:oms="https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd">
  <ssd:System name="{NAME}" description="{title}">
{ground}    <ssd:Elements>
{elements}    </ssd:Elements>
    <ssd:Connections>
{connections}    </ssd:Connections>
    <ssd:Annotations>
      <ssc:Annotation type="org.openmodelica">
        <oms:Annotations>
          <oms:SimulationInformation>
            <oms:FixedStepMaster description="oms-ma" stepSize="{step:?}" relativeTolerance="1e-08"/>
          </oms:SimulationInformation>
        </oms:Annotations>
      </ssc:Annotation>
    </ssd:Annotations>
  </ssd:System>
  <ssd:Units>
{units}  </ssd:Units>
  <ssd:DefaultExperiment startTime="0" stopTime="{stop_time:?}">
    <ssd:Annotations>
      <ssc:Annotation type="com.opensimulationplatform">
        <osp:Algorithm>
          <osp:FixedStepAlgorithm baseStepSize="{step:?}"/>
        </osp:Algorithm>
      </ssc:Annotation>
    </ssd:Annotations>
  </ssd:DefaultExperiment>
</ssd:SystemStructureDescription>
"#
    )
}

fn component(name: &str, own: &[&Variable]) -> String {
    let source = fmu_path(name);
    format!(
        "      <ssd:Component name=\"{name}\" type=\"application/x-fmu-sharedlibrary\" source=\"{source}\" \
         implementation=\"CoSimulation\">\n{}      </ssd:Component>\n",
        connectors("        ", own)
    )
}

fn connectors(indent: &str, variables: &[&Variable]) -> String {
    let connector = |Variable { name, causality, kind, unit, .. }: &&Variable| {
        let direction = if *causality == Causality::Input { "input" } else { "output" };
        let kind = match (kind, unit) {
            (Kind::Boolean { .. }, _) => "<ssc:Boolean/>".to_owned(),
            (_, Some(unit)) => format!("<ssc:Real unit=\"{unit}\"/>"),
            (_, None) => "<ssc:Real/>".to_owned(),
        };
        format!("{indent}  <ssd:Connector name=\"{name}\" kind=\"{direction}\">{kind}</ssd:Connector>\n")
    };
    let connectors: String = variables.iter().map(connector).collect();
    format!("{indent}<ssd:Connectors>\n{connectors}{indent}</ssd:Connectors>\n")
}

fn connection(system: &System, Connection { from, output, to, input }: &Connection) -> String {
    let name = |index: usize| &system.components[index].0;
    let start = from.map_or_else(String::new, |from| format!(" startElement=\"{}\"", name(from)));
    format!(
        "      <ssd:Connection{start} startConnector=\"{}\" endElement=\"{}\" \
         endConnector=\"{}\"/>\n",
        output.name,
        name(*to),
        input.name
    )
}

/// The units that connectors name.
fn units(system: &System) -> String {
    let connectors = system.components.iter().flat_map(|(_, connectors)| connectors);
    let used: BTreeSet<&str> = connectors.filter_map(|connector| connector.unit).chain(["m/s2"]).collect();
    let unit = |unit: &str| {
        let base = UNITS.iter().find(|(name, _)| *name == unit).map_or("", |(_, base)| base);
        format!("    <ssc:Unit name=\"{unit}\"><ssc:BaseUnit{base}/></ssc:Unit>\n")
    };
    used.into_iter().map(unit).collect()
}

/// Text inside an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;").replace(char::is_control, " ")
}
