//! Checks what the FMI 2.0 schema cannot: units, variables, enumerations and interfaces.

use crate::element::Element;
use crate::error::Fault;
use crate::names::camel_case;
use crate::structure;
use crate::usage;
use crate::variable::{
    BaseType, Causality, EnumerationType, Initial, Item, Kind, Variability, Variable, simple_type,
};
use std::collections::HashMap;

/// Makes every check and reports the first problem in this order.
pub(crate) fn all(
    root: &Element,
    variables: &[Variable],
    enumerations: &[EnumerationType],
) -> Result<(), Fault> {
    units_of_types(root)?;
    enumerations.iter().try_for_each(items)?;
    rust_names(enumerations.iter().map(|kind| (kind.line, kind.name.as_str())))?;
    names(variables)?;
    references(variables)?;
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
    let mut identifier = None;
    for element in [exchange, steps].into_iter().flatten() {
        let own = element.required("modelIdentifier")?;
        if let Some(other) = identifier.replace(own).filter(|other| *other != own) {
            return Err(element.fault(format!(
                "the modelIdentifier is {own:?} here and {other:?} in <ModelExchange>: one library serves \
                 both kinds"
            )));
        }
    }
    let count = root.parsed::<usize>("numberOfEventIndicators", "a number of event indicators")?;
    let derivative = variables.iter().any(|variable| variable.derivative.is_some());
    let listed = root.child("ModelStructure").is_some_and(|list| list.child("Derivatives").is_some());
    match exchange {
        None if steps.is_none() => Err(root.missing("CoSimulation")),
        None if count.is_some() => {
            Err(root.fault("numberOfEventIndicators belongs to <ModelExchange>, which is missing"))
        }
        Some(_) if count.is_none() => Err(root
            .fault("numberOfEventIndicators is missing, which <ModelExchange> needs; 0 if there are none")),
        Some(element) if derivative && !listed => Err(element.missing("Derivatives")),
        _ => Ok(()),
    }
}

fn names(variables: &[Variable]) -> Result<(), Fault> {
    let mut seen = HashMap::new();
    for variable in variables {
        if let Some(first) = seen.insert(&variable.name, variable.line) {
            let name = &variable.name;
            return Err(variable.fault(format!("the name `{name}` was used on line {first} already")));
        }
    }
    for base in BaseType::ALL {
        let of_base = variables.iter().filter(|variable| variable.base() == base);
        rust_names(of_base.map(|variable| (variable.line, variable.name.as_str())))?;
    }
    Ok(())
}

/// The names, with their lines, must become different Rust names.
fn rust_names<'a>(names: impl Iterator<Item = (usize, &'a str)>) -> Result<(), Fault> {
    let mut seen: HashMap<String, (usize, &str)> = HashMap::new();
    for (line, name) in names {
        let rust = camel_case(name)
            .ok_or_else(|| Fault::new(line, format!("`{name}` cannot be turned into a Rust name")))?;
        if let Some((first, other)) = seen.insert(rust.clone(), (line, name)) {
            let clash = format!("`{name}` and `{other}` on line {first} both become the Rust name {rust}");
            return Err(Fault::new(line, clash));
        }
    }
    Ok(())
}

fn references(variables: &[Variable]) -> Result<(), Fault> {
    let mut seen: HashMap<u32, &Variable> = HashMap::new();
    for variable in variables {
        let reference = variable.reference;
        let Some(other) = seen.insert(reference, variable) else { continue };
        // Some value of 0..=count is free, there being count variables.
        let taken = |free: &u32| variables.iter().any(|variable| variable.reference == *free);
        let free = (0..=u32::MAX).find(|free| !taken(free)).unwrap_or_default();
        return Err(variable.fault(format!(
            "`{}` has value reference {reference}, which `{}` on line {} has already; take a free one, \
             {free} for example",
            variable.name, other.name, other.line
        )));
    }
    Ok(())
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
    let name = &variable.name;
    let (needed, why) = match (variable.causality, variable.initial_or_default()) {
        (Causality::Input, _) => (true, "an input"),
        (Causality::Parameter, _) => (true, "a parameter"),
        (Causality::Independent, _) => (false, "the independent variable"),
        (_, Some(Initial::Exact)) => (true, "exact at the start"),
        (_, Some(Initial::Approx)) => (true, "approximate at the start"),
        (_, Some(Initial::Calculated) | None) => (false, "calculated"),
    };
    match (needed, present) {
        (true, false) => Err(variable.fault(format!("`{name}` needs a start value, being {why}"))),
        (false, true) => Err(variable.fault(format!("`{name}` must not have a start value, being {why}"))),
        _ => Ok(()),
    }
}

fn units_of_types(root: &Element) -> Result<(), Fault> {
    for declared in root.children_of("TypeDefinitions") {
        let Some(real) = declared.child("Real") else { continue };
        let name = declared.attribute("name").unwrap_or_default();
        unit_is_declared(root, name, real.attribute("unit"), real.attribute("displayUnit"))
            .map_err(|problem| real.fault(problem))?;
    }
    Ok(())
}

fn units(root: &Element, variable: &Variable) -> Result<(), Fault> {
    let declared = variable.declared_type.as_deref().and_then(|name| simple_type(root, name, "Real"));
    let (name, unit) = (&variable.name, variable.unit.as_deref());
    if let (Some(type_unit), Some(unit)) = (declared.and_then(|real| real.attribute("unit")), unit)
        && type_unit != unit
    {
        let of_type = variable.declared_type.as_deref().unwrap_or_default();
        let problem = format!("`{name}` has the unit `{unit}`, but its type `{of_type}` has `{type_unit}`");
        return Err(variable.fault(problem));
    }
    unit_is_declared(root, name, unit, variable.display_unit.as_deref())
        .map_err(|problem| variable.fault(problem))
}

fn unit_is_declared(
    root: &Element,
    name: &str,
    unit: Option<&str>,
    display_unit: Option<&str>,
) -> Result<(), String> {
    let Some(unit) = unit else { return Ok(()) };
    let named = |element: &&Element, name: &str| element.attribute("name") == Some(name);
    let mut units = root.children_of("UnitDefinitions").iter();
    let declared = units
        .find(|element| named(element, unit))
        .ok_or_else(|| format!("the unit `{unit}` of `{name}` is not declared in UnitDefinitions"))?;
    match display_unit {
        Some(shown) if shown != unit && !declared.children.iter().any(|element| named(&element, shown)) => {
            Err(format!("the display unit `{shown}` of `{name}` is not declared with the unit `{unit}`"))
        }
        _ => Ok(()),
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

fn items(enumeration: &EnumerationType) -> Result<(), Fault> {
    rust_names(enumeration.items.iter().map(|item| (item.line, item.name.as_str())))?;
    let mut seen = HashMap::new();
    for item in &enumeration.items {
        if let Some(first) = seen.insert(item.value, item.line) {
            let Item { line, name, value, .. } = item;
            return Err(Fault::new(
                *line,
                format!(
                    "the item `{name}` has the value {value}, which the item on line {first} has already"
                ),
            ));
        }
    }
    Ok(())
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
