//! The description and the terminals of an FMI 3.0 unit, from the FMI 2.0 description.
//!
//! ```
//! use fmu_export_build::{Additions, Description};
//!
//! let description = Description::parse(r#"
//!     <fmiModelDescription fmiVersion="2.0" modelName="clock" guid="{0}">
//!       <CoSimulation modelIdentifier="clock"/>
//!       <ModelVariables>
//!         <ScalarVariable name="rate" valueReference="1" causality="parameter" variability="fixed">
//!           <Real start="1"/>
//!         </ScalarVariable>
//!       </ModelVariables>
//!       <ModelStructure/>
//!     </fmiModelDescription>"#)?;
//! let additions = Additions::parse("<fmi3/>")?;
//! let (xml, terminals) = description.to_fmi3(&additions)?;
//! assert!(xml.contains(r#"instantiationToken="{0}""#));
//! assert!(xml.contains(r#"<Float64 name="rate" valueReference="1""#));
//! assert_eq!(terminals, None);
//! # Ok::<(), fmu_export_build::Fault>(())
//! ```

use crate::description::Description;
use crate::element::Element;
use crate::error::Fault;
use crate::types3::{Types, is_of_type, type_name};
use crate::variable::{Causality, Variable};
use fmu_export::{FIRST_INDICATOR_REFERENCE, TIME_REFERENCE};

/// What an FMI 3.0 unit states beyond its FMI 2.0 description: an element `<fmi3>` with attributes of
/// `<CoSimulation>` and with `<Terminals>`.
#[derive(Clone, Debug)]
pub struct Additions {
    root: Element,
}

impl Additions {
    /// Reads the additions `text`.
    ///
    /// # Errors
    /// Text that is not an element `<fmi3>`, with its line.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let root = Element::parse(text)?;
        root.expect("fmi3")?;
        Ok(Self { root })
    }

    /// Checks that the terminals have variables of `description` alone.
    ///
    /// # Errors
    /// The first variable that is not there, with its line.
    pub fn check(&self, description: &Description) -> Result<(), Fault> {
        for member in self.root.children_of("Terminals").iter().flat_map(|terminal| &terminal.children) {
            let name = member.required("variableName")?;
            if description.variable_names().all(|variable| variable != name) {
                return Err(member.fault(format!("there is no variable `{name}`")));
            }
        }
        Ok(())
    }

    /// `terminalsAndIcons.xml` with those members whose variables `is_there`; none without terminals.
    fn terminals(&self, is_there: impl Fn(&str) -> bool) -> Option<String> {
        let mut terminals = self.root.child("Terminals")?.clone();
        for terminal in &mut terminals.children {
            terminal.children.retain(|member| member.attribute("variableName").is_some_and(&is_there));
        }
        terminals.children.retain(|terminal| !terminal.children.is_empty());
        let any = !terminals.children.is_empty();
        let mut root = Element::new("fmiTerminalsAndIcons", &[("fmiVersion", "3.0")]);
        root.children.push(terminals);
        any.then(|| root.to_xml())
    }
}

impl Description {
    /// The FMI 3.0 description, whose instantiation token is the guid, and `terminalsAndIcons.xml` if there
    /// are terminals.
    ///
    /// Variables keep their value references. Units and nominal values of Reals stand in their types, which
    /// get variants where they differ. The independent variable `time` is added if there is none, and
    /// one variable for each event indicator, as `fmu-export` serves them. Capabilities that FMI 2.0 does not
    /// know are those of `fmu-export`, and those of `additions`.
    ///
    /// # Errors
    /// A variable that takes a name or a value reference of the added ones, with its line.
    pub fn to_fmi3(&self, additions: &Additions) -> Result<(String, Option<String>), Fault> {
        self.check_reserved()?;
        let mut root = Element::new("fmiModelDescription", &[]);
        for (name, value) in &self.root.attributes {
            match name.as_str() {
                "fmiVersion" => root.set_attribute(name, "3.0"),
                "guid" => root.set_attribute("instantiationToken", value.as_str()),
                "numberOfEventIndicators" => {}
                _ => root.set_attribute(name, value.as_str()),
            }
        }
        let taken = self.variable_names().map(str::to_owned).collect();
        let mut types = Types::new(self.root.children_of("TypeDefinitions"), taken);
        for child in &self.root.children {
            match child.name.as_str() {
                "ModelExchange" | "CoSimulation" => root.children.push(interface(child, &additions.root)),
                "ModelVariables" => root.children.push(self.variables3(child, &mut types)),
                "ModelStructure" => root.children.push(self.structure3(child)),
                "TypeDefinitions" | "VendorAnnotations" => {}
                _ => root.children.push(child.clone()),
            }
        }
        insert_types(&mut root, types);
        let is_there = |name: &str| self.variable_names().any(|variable| variable == name);
        Ok((root.to_xml(), additions.terminals(is_there)))
    }

    /// The event indicators as their numbers, from 1 on; none where Model Exchange is not offered.
    fn indicators(&self) -> std::ops::RangeInclusive<u32> {
        let count = self.root.child("ModelExchange").map_or(0, |_| self.event_indicators());
        1..=u32::try_from(count).unwrap_or_default()
    }

    /// Returns whether continuous inputs may change inside a step.
    pub(crate) fn interpolates(&self) -> bool {
        let steps = self.root.child("CoSimulation");
        steps.is_some_and(|steps| matches!(steps.attribute("canInterpolateInputs"), Some("true" | "1")))
    }

    fn has_time(&self) -> bool {
        self.variables.iter().any(|variable| variable.causality == Causality::Independent)
    }

    fn check_reserved(&self) -> Result<(), Fault> {
        let taken = |variable: &&Variable| {
            let time = variable.reference == TIME_REFERENCE || variable.name == "time";
            variable.reference >= FIRST_INDICATOR_REFERENCE
                || self.indicators().any(|number| variable.name == indicator_name(number))
                || (time && !self.has_time())
        };
        match self.variables.iter().find(taken) {
            None => Ok(()),
            Some(variable) => Err(variable.fault(format!(
                "FMI 3.0 needs the name `{}` or the value reference {} for a variable of its own",
                variable.name, variable.reference
            ))),
        }
    }

    fn variables3(&self, variables: &Element, types: &mut Types) -> Element {
        let mut list = Element::new("ModelVariables", &[]);
        list.children.extend(variables.children.iter().map(|variable| self.variable3(variable, types)));
        if !self.has_time() {
            list.children.insert(0, self.time(types));
        }
        for number in self.indicators() {
            let reference = (FIRST_INDICATOR_REFERENCE + number - 1).to_string();
            list.children.push(Element::new(
                "Float64",
                &[
                    ("name", &indicator_name(number)),
                    ("valueReference", &reference),
                    ("description", &format!("Event indicator {number} of Model Exchange")),
                    ("causality", "local"),
                    ("variability", "continuous"),
                    ("initial", "calculated"),
                ],
            ));
        }
        list
    }

    fn time(&self, types: &mut Types) -> Element {
        let mut time = Element::new(
            "Float64",
            &[
                ("name", "time"),
                ("valueReference", &TIME_REFERENCE.to_string()),
                ("description", "Time"),
                ("causality", "independent"),
                ("variability", "continuous"),
            ],
        );
        let units = self.root.children_of("UnitDefinitions");
        if units.iter().any(|unit| unit.attribute("name") == Some("s")) {
            time.set_attribute("declaredType", types.of_time());
        }
        time
    }

    /// `<ScalarVariable>` and the element of its type become one element.
    fn variable3(&self, variable: &Element, types: &mut Types) -> Element {
        let Some(typed) = variable.children.iter().find(|child| child.name != "Annotations") else {
            return variable.clone();
        };
        let mut written = Element { name: type_name(&typed.name).to_owned(), ..variable.clone() };
        written.children.clear();
        let continuous = variable.attribute("variability").is_none_or(|name| name == "continuous");
        let input = variable.attribute("causality") == Some("input") && typed.name == "Real";
        if input && continuous && self.interpolates() {
            written.set_attribute("intermediateUpdate", "true");
        }
        let is_real = typed.name == "Real";
        if let Some(name) = is_real.then(|| types.of_real(typed)).flatten() {
            written.set_attribute("declaredType", name);
        }
        for (name, value) in &typed.attributes {
            match name.as_str() {
                own if is_real && is_of_type(own) => {}
                "derivative" => written.set_attribute(name, self.references(value)),
                "start" if typed.name == "String" => {
                    written.children.push(Element::new("Start", &[("value", value)]));
                }
                _ => written.set_attribute(name, value.as_str()),
            }
        }
        written
    }

    /// The lists of unknowns become one list, and indices value references.
    fn structure3(&self, structure: &Element) -> Element {
        let mut written = Element::new("ModelStructure", &[]);
        for (list, name) in [
            ("Outputs", "Output"),
            ("Derivatives", "ContinuousStateDerivative"),
            ("InitialUnknowns", "InitialUnknown"),
        ] {
            for unknown in structure.children_of(list) {
                let mut new = Element::new(name, &[]);
                for (attribute, value) in &unknown.attributes {
                    match attribute.as_str() {
                        "index" => new.set_attribute("valueReference", self.references(value)),
                        "dependencies" => new.set_attribute(attribute, self.references(value)),
                        _ => new.set_attribute(attribute, value.as_str()),
                    }
                }
                written.children.push(new);
            }
        }
        for number in self.indicators() {
            let reference = (FIRST_INDICATOR_REFERENCE + number - 1).to_string();
            written.children.push(Element::new("EventIndicator", &[("valueReference", &reference)]));
        }
        written
    }

    /// The value references of the variables with these 1-based indices.
    fn references(&self, indices: &str) -> String {
        let reference = |index: &str| {
            let at = index.parse::<usize>().ok()?.checked_sub(1)?;
            Some(self.variables.get(at)?.reference.to_string())
        };
        indices.split_ascii_whitespace().filter_map(reference).collect::<Vec<_>>().join(" ")
    }
}

fn indicator_name(number: u32) -> String {
    format!("event_indicator_{number}")
}

/// `<ModelExchange>` or `<CoSimulation>` with the names of FMI 3.0.
fn interface(old: &Element, additions: &Element) -> Element {
    let mut new = Element::new(&old.name, &[]);
    for (name, value) in &old.attributes {
        let (name, value) = match name.as_str() {
            "canGetAndSetFMUstate" => ("canGetAndSetFMUState", value.as_str()),
            "canSerializeFMUstate" => ("canSerializeFMUState", value.as_str()),
            "providesDirectionalDerivative" => {
                new.set_attribute("providesDirectionalDerivatives", value.as_str());
                ("providesAdjointDerivatives", value.as_str())
            }
            "completedIntegratorStepNotNeeded" => (
                "needsCompletedIntegratorStep",
                if matches!(value.as_str(), "true" | "1") { "false" } else { "true" },
            ),
            // inputs run linearly to the values that the importer sets for the end of a step
            "canInterpolateInputs" => ("providesIntermediateUpdate", value.as_str()),
            "canNotUseMemoryManagementFunctions" | "canRunAsynchronuously" => continue,
            name => (name, value.as_str()),
        };
        new.set_attribute(name, value);
    }
    if old.name == "ModelExchange" && old.attribute("completedIntegratorStepNotNeeded").is_none() {
        new.set_attribute("needsCompletedIntegratorStep", "true");
    }
    if old.name == "CoSimulation" {
        new.set_attribute("hasEventMode", "true");
        for (name, value) in &additions.attributes {
            new.set_attribute(name, value.as_str());
        }
    }
    new
}

/// Puts the types where the schema has them: before what follows the units.
fn insert_types(root: &mut Element, types: Types) {
    let children = types.into_elements();
    if children.is_empty() {
        return;
    }
    let follows = ["LogCategories", "DefaultExperiment", "ModelVariables"];
    root.insert_before(&follows, Element { children, ..Element::new("TypeDefinitions", &[]) });
}
