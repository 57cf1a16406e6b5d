//! The description of an FMU with some of the variables, and with its own start values.

use crate::description::Description;
use crate::element::Element;
use crate::error::Fault;
use crate::structure::Rules;
use crate::variable::Variable;
use std::collections::{HashMap, HashSet};

/// What the description of the smaller FMU is to say.
pub struct Reduction<'a> {
    /// Name of the model.
    pub model_name: &'a str,
    /// One line on the model.
    pub description: &'a str,
    /// Returns whether the variable of this name is kept.
    pub keep: &'a dyn Fn(&str) -> bool,
    /// New start values by name, as they are written in the XML: numbers, `true` or `false`, item numbers.
    pub starts: &'a [(String, String)],
    /// The default experiment.
    pub experiment: DefaultExperiment,
}

/// What an importer simulates unless it is told otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefaultExperiment {
    /// Start time \[s\].
    pub start: f64,
    /// Stop time \[s\].
    pub stop: f64,
    /// Communication step \[s\].
    pub step: f64,
    /// Relative tolerance \[-\].
    pub tolerance: f64,
}

/// Why a description cannot be reduced like this.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum ReductionError {
    /// A start value for a variable that is not there, or not kept.
    #[error("a start value is given for `{name}`, which the reduced description does not have")]
    NoSuchVariable { name: String },
    /// The result breaks a rule; the line is the result's.
    #[error("the reduced description, {0}")]
    Invalid(#[from] Fault),
}

impl Description {
    /// The description with the variables, start values, names and experiment of `reduction`, and with
    /// `guid`, braces included.
    ///
    /// Value references are kept, and indices are renumbered. Model Exchange is removed if a state or
    /// derivative is. Units, types and dependencies that are no longer used are removed, too.
    ///
    /// # Errors
    /// A start value for a variable that is not kept, or one its limits or its type refuse.
    pub fn reduced(&self, reduction: &Reduction<'_>, guid: &str) -> Result<Self, ReductionError> {
        let kept: HashSet<&str> = self.variable_names().filter(|name| (reduction.keep)(name)).collect();
        let is_kept = |variable: &Variable| kept.contains(variable.name.as_str());
        if let Some((name, _)) = reduction.starts.iter().find(|(name, _)| !kept.contains(name.as_str())) {
            return Err(ReductionError::NoSuchVariable { name: name.clone() });
        }
        let mut root = self.root.clone();
        root.set_attribute("modelName", reduction.model_name);
        root.set_attribute("description", reduction.description);
        root.set_attribute("guid", guid);
        let old = (1..).zip(&self.variables).filter(|(_, variable)| is_kept(variable)).map(|(old, _)| old);
        let indices: Indices = old.zip(1..).collect();
        if let Some(variables) = root.child_mut("ModelVariables") {
            retain_variables(variables, &indices, reduction.starts);
            for variable in &mut variables.children {
                retain_conditions(variable, &kept);
            }
        }
        if let Some(structure) = root.child_mut("ModelStructure") {
            retain_unknowns(structure, &indices, &renumbered(&self.variables, &indices));
        }
        let pairs = self.derivatives();
        if !pairs.iter().all(|(derivative, state)| is_kept(derivative) && is_kept(state)) {
            // the library would answer for states that the description no longer has
            root.children.retain(|element| element.name != "ModelExchange");
            root.attributes.retain(|(attribute, _)| attribute != "numberOfEventIndicators");
        }
        let types = values_in(root.child("ModelVariables"), "declaredType");
        retain_named(&mut root, "TypeDefinitions", &types);
        let mut units = values_in(root.child("ModelVariables"), "unit");
        units.extend(values_in(root.child("TypeDefinitions"), "unit"));
        retain_named(&mut root, "UnitDefinitions", &units);
        set_experiment(&mut root, reduction.experiment);
        Ok(Self::parse(&root.to_xml())?)
    }
}

/// New 1-based indices by old ones, of the variables that stay.
type Indices = HashMap<usize, usize>;

fn retain_variables(variables: &mut Element, indices: &Indices, starts: &[(String, String)]) {
    let mut old = 0;
    variables.children.retain(|_| {
        old += 1;
        indices.contains_key(&old)
    });
    for variable in &mut variables.children {
        let name = variable.attribute("name").unwrap_or_default().to_owned();
        let Some(typed) = variable.children.first_mut() else { continue };
        match typed.index("derivative").and_then(|old| indices.get(&old)) {
            Some(state) => typed.set_attribute("derivative", state.to_string()),
            // The state is not kept, so this is no longer a derivative of it.
            None => typed.attributes.retain(|(attribute, _)| attribute != "derivative"),
        }
        if let Some((_, start)) = starts.iter().find(|(of, _)| *of == name) {
            typed.set_attribute("start", start.as_str());
        }
    }
}

/// Removes conditions that name a parameter which the description no longer has.
fn retain_conditions(variable: &mut Element, kept: &HashSet<&str>) {
    let tools =
        |own: &Element| own.children.iter().flat_map(|tool| tool.children.clone()).collect::<Vec<_>>();
    let conditions = variable.child("Annotations").map(tools).unwrap_or_default();
    let mut names = conditions.iter().flat_map(|condition| &condition.attributes);
    if names.any(|(name, _)| !kept.contains(name.as_str())) {
        variable.children.retain(|child| child.name != "Annotations");
    }
}

/// The variables that stay. One whose state does not stay is no longer a derivative.
fn renumbered(variables: &[Variable], indices: &Indices) -> Vec<Variable> {
    let kept = (1..).zip(variables).filter(|(old, _)| indices.contains_key(old));
    let derivative = |of: Option<usize>| of.and_then(|old| indices.get(&old).copied());
    kept.map(|(_, old)| Variable { derivative: derivative(old.derivative), ..old.clone() }).collect()
}

/// Keeps the unknowns and dependencies that the variables that stay still have.
fn retain_unknowns(structure: &mut Element, indices: &Indices, variables: &[Variable]) {
    let rules = Rules::new(variables, structure);
    for Element { name: list, children: unknowns, .. } in &mut structure.children {
        let new_index = |unknown: &Element| indices.get(&unknown.index("index")?).copied();
        unknowns.retain(|unknown| new_index(unknown).is_some_and(|new| rules.belongs(list, new - 1)));
        for unknown in unknowns {
            if let Some(new) = new_index(unknown) {
                unknown.set_attribute("index", new.to_string());
            }
            let is_known = |new: &usize| rules.is_known(list, new - 1);
            retain_dependencies(unknown, |old| indices.get(&old).copied().filter(is_known));
        }
    }
    structure.children.retain(|list| !list.children.is_empty());
}

/// Renumbers the dependencies by `new_index`, which gives none for those that are gone.
fn retain_dependencies(unknown: &mut Element, new_index: impl Fn(usize) -> Option<usize>) {
    let Some(dependencies) = unknown.attribute("dependencies") else { return };
    let new: Vec<Option<usize>> =
        dependencies.split_ascii_whitespace().map(|old| new_index(old.parse().ok()?)).collect();
    let kinds = unknown.attribute("dependenciesKind").map(|kinds| {
        let kept = kinds.split_ascii_whitespace().zip(&new).filter(|(_, new)| new.is_some());
        kept.map(|(kind, _)| kind).collect::<Vec<_>>().join(" ")
    });
    let dependencies: Vec<_> = new.iter().flatten().map(usize::to_string).collect();
    unknown.set_attribute("dependencies", dependencies.join(" "));
    if let Some(kinds) = kinds {
        unknown.set_attribute("dependenciesKind", kinds);
    }
}

/// The values of an attribute in the children of the children.
fn values_in(list: Option<&Element>, attribute: &str) -> HashSet<String> {
    let elements = list.into_iter().flat_map(|list| &list.children).flat_map(|element| &element.children);
    elements.filter_map(|element| element.attribute(attribute)).map(str::to_owned).collect()
}

/// Keeps the children whose name is used, and the list itself only if any are left.
fn retain_named(root: &mut Element, list: &str, used: &HashSet<String>) {
    if let Some(list) = root.child_mut(list) {
        list.children.retain(|element| element.attribute("name").is_some_and(|name| used.contains(name)));
    }
    root.children.retain(|element| element.name != list || !element.children.is_empty());
}

fn set_experiment(root: &mut Element, experiment: DefaultExperiment) {
    const NAME: &str = "DefaultExperiment";
    if root.child(NAME).is_none() {
        // The schema's order: after the log categories, before annotations and variables.
        root.insert_before(&["VendorAnnotations", "ModelVariables"], Element::new(NAME, &[]));
    }
    if let Some(element) = root.child_mut(NAME) {
        for (attribute, value) in [
            ("startTime", experiment.start),
            ("stopTime", experiment.stop),
            ("stepSize", experiment.step),
            ("tolerance", experiment.tolerance),
        ] {
            // A number as Rust prints it reads back to the same bits. A whole number needs no fraction.
            let text = format!("{value:?}");
            element.set_attribute(attribute, text.strip_suffix(".0").unwrap_or(&text).to_owned());
        }
    }
}
