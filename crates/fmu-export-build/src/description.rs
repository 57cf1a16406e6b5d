//! A description that has passed every check.

use crate::check;
use crate::element::Element;
use crate::error::Fault;
use crate::fingerprint::{fingerprint, with_guid, without_annotations};
use crate::usage::{condition, written};
use crate::variable::{Causality, EnumerationType, Variable};

/// A description that has passed every check.
#[derive(Clone, Debug)]
pub struct Description {
    pub(crate) root: Element,
    pub(crate) text: String,
    pub(crate) variables: Vec<Variable>,
    pub(crate) enumerations: Vec<EnumerationType>,
}

impl Description {
    /// Reads and checks the description `text`.
    ///
    /// # Errors
    /// The first problem found, with its line.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let root = Element::parse(text)?;
        root.expect("fmiModelDescription")?;
        let version = root.required("fmiVersion")?;
        if version != "2.0" {
            return Err(root.fault(format!("fmiVersion is {version:?}: only \"2.0\" is understood")));
        }
        for name in ["modelName", "guid"] {
            root.required(name)?;
        }
        let elements = &root.required_child("ModelVariables")?.children;
        let variables =
            elements.iter().map(|element| Variable::read(&root, element)).collect::<Result<Vec<_>, _>>()?;
        let enumerations = EnumerationType::read_all(&root)?;
        check::all(&root, &variables, &enumerations)?;
        Ok(Self { root, text: text.to_owned(), variables, enumerations })
    }

    /// The guid that follows from the text: 32 hexadecimal digits in braces.
    pub fn guid(&self) -> String {
        fingerprint(&written(&self.text, &self.variables))
    }

    /// The guid written in the description.
    pub fn declared_guid(&self) -> &str {
        self.root.attribute("guid").unwrap_or_default()
    }

    /// The model's name.
    pub fn model_name(&self) -> &str {
        self.root.attribute("modelName").unwrap_or_default()
    }

    /// The name of the library, and of the functions' owner.
    pub fn model_identifier(&self) -> &str {
        let element = self.root.child("CoSimulation").or_else(|| self.root.child("ModelExchange"));
        element.and_then(|element| element.attribute("modelIdentifier")).unwrap_or_default()
    }

    /// The number of event indicators; 0 for co-simulation alone.
    pub fn event_indicators(&self) -> usize {
        let count = self.root.attribute("numberOfEventIndicators");
        count.and_then(|count| count.trim().parse().ok()).unwrap_or_default()
    }

    /// The parameters, in the order of the description.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(|variable| variable.causality == Causality::Parameter)
    }

    /// The derivatives in the order of the model structure, each with its state.
    pub(crate) fn derivatives(&self) -> Vec<(&Variable, &Variable)> {
        let structure = self.root.child("ModelStructure");
        let unknowns = structure.map_or(&[][..], |structure| structure.children_of("Derivatives")).iter();
        let pair = |unknown: &Element| {
            let index = unknown.index("index")?;
            let derivative = self.variables.get(index.checked_sub(1)?)?;
            Some((derivative, self.variables.get(derivative.derivative?.checked_sub(1)?)?))
        };
        unknowns.filter_map(pair).collect()
    }

    /// The names of the variables, in their order.
    pub fn variable_names(&self) -> impl Iterator<Item = &str> {
        self.variables.iter().map(|variable| variable.name.as_str())
    }

    fn variable(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name == name)
    }

    /// The value reference of the variable `name`.
    pub fn reference(&self, name: &str) -> Option<u32> {
        Some(self.variable(name)?.reference)
    }

    /// The text as it was read, with `guid` as its guid. Variables have no annotations; where they matter
    /// stands in their descriptions.
    pub fn text_with_guid(&self, guid: &str) -> String {
        let text = with_guid(&without_annotations(&self.text), guid);
        written(&text, &self.variables)
    }

    /// Where the variable `name` matters, in words; `None` for one that always does, or that is not there.
    pub fn condition(&self, name: &str) -> Option<String> {
        condition(self.variable(name)?, &self.variables)
    }

    /// The description in canonical form: no comments, two blanks per level.
    pub fn to_xml(&self) -> String {
        self.root.to_xml()
    }
}
