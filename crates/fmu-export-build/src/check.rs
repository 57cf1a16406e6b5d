//! Checks what the FMI 2.0 schema cannot: units, variables, enumerations and interfaces.

use crate::element::Element;
use crate::error::Fault;
use crate::names::camel_case;
use crate::structure;
use crate::usage;
use crate::variable::{
    BaseType, Causality, EnumerationType, Initial, Kind, Variability, Variable, simple_type,
};
use std::collections::HashMap;
use std::fmt::Display;
use std::hash::Hash;

/// Makes every check and reports the first problem in this order.
pub(crate) fn all(
    root: &Element,
    variables: &[Variable],
    enumerations: &[EnumerationType],
) -> Result<(), Fault> {
    for kind in root.children_of("TypeDefinitions") {
        if let Some(real) = kind.child("Real") {
            let name = kind.attribute("name").unwrap_or_default();
            unit(root, (real.line, name), real.attribute("unit"), real.attribute("displayUnit"))?;
        }
    }
    for EnumerationType { items, .. } in enumerations {
        rust_names(items.iter().map(|item| (item.line, item.name.as_str())))?;
        unique("value", items.iter().map(|item| ((item.line, item.name.as_str()), item.value)))?;
    }
    rust_names(enumerations.iter().map(|kind| (kind.line, kind.name.as_str())))?;
    unique("name", variables.iter().map(|variable| (named(variable), &variable.name)))?;
    for base in BaseType::ALL {
        rust_names(variables.iter().filter(|variable| variable.base() == base).map(named))?;
    }
    unique("value reference", variables.iter().map(|variable| (named(variable), variable.reference)))?;
    let grouped = variables.iter().any(|variable| variable.group.is_some());
    for variable in variables {
        combination(variable)?;
        start_presence(variable)?;
        units(root, variable)?;
        limits(variable)?;
        enumeration_start(variable, enumerations)?;
        derivative(variable, variables)?;
        if grouped && variable.causality == Causality::Parameter && variable.group.is_none() {
            let name = &variable.name;
            return Err(variable.fault(format!(
                "the parameter `{name}` has no annotation <Group name=\"…\"/>, but others have one"
            )));
        }
    }
    usage::check(variables, enumerations)?;
    structure::check(variables, root.required_child("ModelStructure")?)?;
    interfaces(root, variables)
}

/// At least one of co-simulation and Model Exchange, by one library; Model Exchange tells its derivatives and
/// the number of its event indicators.
fn interfaces(root: &Element, variables: &[Variable]) -> Result<(), Fault> {
    let (exchange, steps) = (root.child("ModelExchange"), root.child("CoSimulation"));
    let mut identifiers = Vec::new();
    for element in [exchange, steps].into_iter().flatten() {
        identifiers.push(element.required("modelIdentifier")?);
    }
    let count = root.parsed::<usize>("numberOfEventIndicators", "a number of event indicators")?;
    let derivative = variables.iter().any(|variable| variable.derivative.is_some());
    let listed = root.child("ModelStructure").is_some_and(|list| list.child("Derivatives").is_some());
    match (&identifiers[..], exchange) {
        ([], _) => Err(root.missing("CoSimulation")),
        ([one, other], _) if one != other => Err(root.fault(format!(
            "the modelIdentifiers {one:?} and {other:?} differ: one library serves both kinds"
        ))),
        _ if exchange.is_some() != count.is_some() => {
            Err(root
                .fault("<ModelExchange> and numberOfEventIndicators belong together; 0 if there are none"))
        }
        (_, Some(element)) if derivative && !listed => Err(element.missing("Derivatives")),
        _ => Ok(()),
    }
}

/// A line and the name of what stands there.
type Named<'a> = (usize, &'a str);

fn named(variable: &Variable) -> Named<'_> {
    (variable.line, &variable.name)
}

/// No two may have the same value of `what`.
fn unique<'a, V: Copy + Display + Eq + Hash>(
    what: &str,
    all: impl IntoIterator<Item = (Named<'a>, V)>,
) -> Result<(), Fault> {
    let mut seen = HashMap::new();
    for ((line, name), value) in all {
        if let Some((first, other)) = seen.insert(value, (line, name)) {
            let problem =
                format!("`{name}` has the {what} {value}, which `{other}` on line {first} has already");
            return Err(Fault::new(line, problem));
        }
    }
    Ok(())
}

/// The names must become different Rust names.
fn rust_names<'a>(names: impl Iterator<Item = Named<'a>>) -> Result<(), Fault> {
    let mut all = Vec::new();
    for (line, name) in names {
        let no_name = || Fault::new(line, format!("`{name}` cannot be turned into a Rust name"));
        all.push(((line, name), camel_case(name).ok_or_else(no_name)?));
    }
    unique("Rust name", all.iter().map(|(named, rust)| (*named, rust)))
}

/// FMI 2.0.5, section 2.2.7: which causality, variability and initial go together.
fn combination(variable: &Variable) -> Result<(), Fault> {
    use {Causality as C, Initial as I, Variability as V};
    let legal = match (variable.causality, variable.variability, variable.initial) {
        (C::Parameter, V::Fixed | V::Tunable, None | Some(I::Exact))
        | (C::Output | C::Local, V::Constant, None | Some(I::Exact))
        | (C::Input, V::Discrete | V::Continuous, None)
        | (C::Output | C::Local, V::Discrete | V::Continuous, _)
        | (C::Independent, V::Continuous, None) => true,
        (C::CalculatedParameter | C::Local, V::Fixed | V::Tunable, initial) => initial != Some(I::Exact),
        _ => false,
    };
    let name = &variable.name;
    if !legal {
        let (causality, variability) = (variable.causality.name(), variable.variability.name());
        let initial = variable.initial.map_or("without initial", Initial::name);
        let problem = format!("`{name}` cannot be {causality}, {variability} and {initial} at once");
        return Err(variable.fault(problem));
    }
    if variable.variability == Variability::Continuous && !matches!(variable.kind, Kind::Real { .. }) {
        return Err(variable.fault(format!(
            "`{name}` is continuous (which is what leaving out the variability means), but only a Real can be"
        )));
    }
    Ok(())
}

fn start_presence(variable: &Variable) -> Result<(), Fault> {
    let present = match &variable.kind {
        Kind::Real { start, .. } => start.is_some(),
        Kind::Integer { start, .. } | Kind::Enumeration { start } => start.is_some(),
        Kind::Boolean { start } => start.is_some(),
        Kind::String { start } => start.is_some(),
    };
    let initial = variable.initial_or_default();
    let needed =
        variable.causality == Causality::Input || matches!(initial, Some(Initial::Exact | Initial::Approx));
    if needed == present {
        return Ok(());
    }
    let (name, verb) = (&variable.name, if needed { "needs" } else { "must not have" });
    let what = [Some(variable.causality.name()), initial.map(Initial::name)];
    let what = what.into_iter().flatten().collect::<Vec<_>>().join(", ");
    Err(variable.fault(format!("`{name}` ({what}) {verb} a start value")))
}

fn units(root: &Element, variable: &Variable) -> Result<(), Fault> {
    let Variable { line, name, declared_type, .. } = variable;
    let of_type =
        declared_type.as_deref().and_then(|name| simple_type(root, name, "Real")?.attribute("unit"));
    if let (Some(of_type), Some(unit)) = (of_type, &variable.unit)
        && of_type != unit
    {
        return Err(variable.fault(format!("`{name}` has the unit `{unit}`, but its type has `{of_type}`")));
    }
    unit(root, (*line, name), variable.unit.as_deref(), variable.display_unit.as_deref())
}

/// Checks that a unit and its display unit are declared.
fn unit(
    root: &Element,
    (line, name): Named<'_>,
    unit: Option<&str>,
    display_unit: Option<&str>,
) -> Result<(), Fault> {
    let Some(unit) = unit else { return Ok(()) };
    let is = |element: &Element, name: &str| element.attribute("name") == Some(name);
    let declared = root.children_of("UnitDefinitions").iter().find(|element| is(element, unit));
    let has =
        |shown: &str| shown == unit || declared.is_some_and(|one| one.children.iter().any(|e| is(e, shown)));
    match (declared, display_unit) {
        (Some(_), Some(shown)) if !has(shown) => {
            let problem =
                format!("the display unit `{shown}` of `{name}` is not declared with the unit `{unit}`");
            Err(Fault::new(line, problem))
        }
        (Some(_), _) => Ok(()),
        (None, _) => {
            let problem = format!("the unit `{unit}` of `{name}` is not declared in UnitDefinitions");
            Err(Fault::new(line, problem))
        }
    }
}

fn limits(variable: &Variable) -> Result<(), Fault> {
    let (start, min, max) = match variable.kind {
        Kind::Real { start, min, max } => (start, min, max),
        // each is a double too, and written alike
        Kind::Integer { start, min, max } => (start.map(f64::from), min.map(f64::from), max.map(f64::from)),
        _ => return Ok(()),
    };
    let text = |limit: Option<f64>| limit.map_or("none".to_owned(), |limit| limit.to_string());
    let (name, least, most) = (&variable.name, text(min), text(max));
    if min.is_some() && max.is_some() && min > max {
        let crossed = format!("the limits of `{name}` are crossed: min {least} exceeds max {most}");
        return Err(variable.fault(crossed));
    }
    match start.filter(|start| min.is_some_and(|min| *start < min) || max.is_some_and(|max| *start > max)) {
        Some(start) => Err(variable
            .fault(format!("the start value {start} of `{name}` is outside its limits {least} to {most}"))),
        None => Ok(()),
    }
}

fn enumeration_start(variable: &Variable, enumerations: &[EnumerationType]) -> Result<(), Fault> {
    let Kind::Enumeration { start: Some(start) } = variable.kind else { return Ok(()) };
    if variable.items(enumerations).iter().any(|item| item.value == start) {
        return Ok(());
    }
    let (name, of_type) = (&variable.name, variable.declared_type.as_deref().unwrap_or_default());
    let problem = format!("the start value {start} of `{name}` is not an item of its type `{of_type}`");
    Err(variable.fault(problem))
}

fn derivative(variable: &Variable, variables: &[Variable]) -> Result<(), Fault> {
    let Some(index) = variable.derivative else { return Ok(()) };
    let name = &variable.name;
    let at = structure::position(variables.len(), index, "derivative", name);
    let state = &variables[at.map_err(|problem| variable.fault(problem))?];
    let continuous = |variable: &Variable| {
        matches!(variable.kind, Kind::Real { .. }) && variable.variability == Variability::Continuous
    };
    if continuous(variable) && continuous(state) && state.name != variable.name {
        return Ok(());
    }
    let rule = "both must be continuous Reals and not the same";
    Err(variable.fault(format!("`{name}` is the derivative of `{}`, and {rule}", state.name)))
}
