//! Checks what the FMI 2.0 schema cannot: units, variables, enumerations and interfaces.

use crate::element::Element;
use crate::error::{Fault, Problem};
use crate::names::camel_case;
use crate::structure;
use crate::usage;
use crate::variable::{
    BaseType, Causality, EnumerationType, Initial, Kind, Variability, Variable, simple_type,
};
use std::collections::HashMap;
use std::fmt::Display;

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
            return Err(variable.fault(Problem::NoGroup { name: variable.name.clone() }));
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
            let (own, other) = (own.to_owned(), other.to_owned());
            return Err(element.fault(Problem::TwoLibraries { own, other }));
        }
    }
    let count = root.parsed::<usize>("numberOfEventIndicators", "a number of event indicators")?;
    match exchange {
        None if steps.is_none() => Err(root.fault(Problem::MissingElement { element: "CoSimulation" })),
        None if count.is_some() => {
            Err(root.fault(Problem::EventIndicators { why: "belongs to <ModelExchange>, which is missing" }))
        }
        None => Ok(()),
        Some(element) => {
            if count.is_none() {
                let why = "is missing, which <ModelExchange> needs; 0 if there are none";
                return Err(root.fault(Problem::EventIndicators { why }));
            }
            let derivative = variables.iter().any(|variable| variable.derivative.is_some());
            let listed = root.child("ModelStructure").is_some_and(|list| list.child("Derivatives").is_some());
            if derivative && !listed {
                return Err(element.fault(Problem::MissingElement { element: "Derivatives" }));
            }
            Ok(())
        }
    }
}

fn names(variables: &[Variable]) -> Result<(), Fault> {
    let mut seen = HashMap::new();
    for variable in variables {
        if let Some(first) = seen.insert(&variable.name, variable.line) {
            return Err(variable.fault(Problem::RepeatedName { name: variable.name.clone(), first }));
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
        let fault = |problem| Fault { line, problem };
        let rust = camel_case(name).ok_or_else(|| fault(Problem::NoRustName { name: name.to_owned() }))?;
        if let Some((first, other)) = seen.insert(rust.clone(), (line, name)) {
            let (name, other) = (name.to_owned(), other.to_owned());
            return Err(fault(Problem::RustNameClash { name, other, first, rust }));
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
        return Err(variable.fault(Problem::RepeatedReference {
            name: variable.name.clone(),
            reference,
            other: other.name.clone(),
            first: other.line,
            free,
        }));
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
    if !legal {
        return Err(variable.fault(Problem::IllegalCombination {
            name: variable.name.clone(),
            causality: variable.causality.name(),
            variability: variable.variability.name(),
            initial: variable.initial.map_or("without initial", Initial::name).to_owned(),
        }));
    }
    if variable.variability == Variability::Continuous && !matches!(variable.kind, Kind::Real { .. }) {
        return Err(variable.fault(Problem::ContinuousNotReal { name: variable.name.clone() }));
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
    let name = variable.name.clone();
    let (needed, why) = match (variable.causality, variable.initial_or_default()) {
        (Causality::Input, _) => (true, "an input"),
        (Causality::Parameter, _) => (true, "a parameter"),
        (Causality::Independent, _) => (false, "the independent variable"),
        (_, Some(Initial::Exact)) => (true, "exact at the start"),
        (_, Some(Initial::Approx)) => (true, "approximate at the start"),
        (_, Some(Initial::Calculated) | None) => (false, "calculated"),
    };
    match (needed, present) {
        (true, false) => Err(variable.fault(Problem::MissingStart { name, why })),
        (false, true) => Err(variable.fault(Problem::ForbiddenStart { name, why })),
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
    match (declared.and_then(|real| real.attribute("unit")), &variable.unit) {
        (Some(type_unit), Some(unit)) if type_unit != unit => Err(variable.fault(Problem::UnitMismatch {
            name: variable.name.clone(),
            unit: unit.clone(),
            declared_type: variable.declared_type.clone().unwrap_or_default(),
            type_unit: type_unit.to_owned(),
        })),
        (_, unit) => {
            unit_is_declared(root, &variable.name, unit.as_deref(), variable.display_unit.as_deref())
                .map_err(|problem| variable.fault(problem))
        }
    }
}

fn unit_is_declared(
    root: &Element,
    name: &str,
    unit: Option<&str>,
    display_unit: Option<&str>,
) -> Result<(), Problem> {
    let Some(unit) = unit else { return Ok(()) };
    let named = |element: &&Element, name: &str| element.attribute("name") == Some(name);
    let mut units = root.children_of("UnitDefinitions").iter();
    let declared = units
        .find(|element| named(element, unit))
        .ok_or_else(|| Problem::UndeclaredUnit { name: name.to_owned(), unit: unit.to_owned() })?;
    match display_unit {
        Some(shown) if shown != unit && !declared.children.iter().any(|element| named(&element, shown)) => {
            Err(Problem::UndeclaredDisplayUnit {
                name: name.to_owned(),
                unit: unit.to_owned(),
                display_unit: shown.to_owned(),
            })
        }
        _ => Ok(()),
    }
}

fn limits(variable: &Variable) -> Result<(), Fault> {
    fn within<T: Copy + PartialOrd + Display>(
        variable: &Variable,
        start: Option<T>,
        min: Option<T>,
        max: Option<T>,
    ) -> Result<(), Fault> {
        let text = |limit: Option<T>| limit.map_or("none".to_owned(), |limit| limit.to_string());
        let name = variable.name.clone();
        if min.is_some() && max.is_some() && min > max {
            let (min, max) = (text(min), text(max));
            return Err(variable.fault(Problem::CrossedLimits { name, min, max }));
        }
        let Some(value) = start else { return Ok(()) };
        if min.is_some_and(|min| value < min) || max.is_some_and(|max| value > max) {
            let (start, min, max) = (value.to_string(), text(min), text(max));
            return Err(variable.fault(Problem::StartOutsideLimits { name, start, min, max }));
        }
        Ok(())
    }
    match variable.kind {
        Kind::Real { start, min, max } => within(variable, start, min, max),
        Kind::Integer { start, min, max } => within(variable, start, min, max),
        _ => Ok(()),
    }
}

fn items(enumeration: &EnumerationType) -> Result<(), Fault> {
    rust_names(enumeration.items.iter().map(|item| (item.line, item.name.as_str())))?;
    let mut seen = HashMap::new();
    for item in &enumeration.items {
        if let Some(first) = seen.insert(item.value, item.line) {
            let (name, value) = (item.name.clone(), item.value);
            return Err(Fault {
                line: item.line,
                problem: Problem::RepeatedItemValue { name, value, first },
            });
        }
    }
    Ok(())
}

fn enumeration_start(variable: &Variable, enumerations: &[EnumerationType]) -> Result<(), Fault> {
    let Kind::Enumeration { start: Some(start) } = variable.kind else { return Ok(()) };
    if variable.items(enumerations).iter().any(|item| item.value == start) {
        return Ok(());
    }
    let declared_type = variable.declared_type.clone().unwrap_or_default();
    Err(variable.fault(Problem::StartNotAnItem { name: variable.name.clone(), start, declared_type }))
}

fn derivative(variable: &Variable, variables: &[Variable]) -> Result<(), Fault> {
    let Some(index) = variable.derivative else { return Ok(()) };
    let state = index.checked_sub(1).and_then(|at| variables.get(at)).ok_or_else(|| {
        variable.fault(Problem::NoSuchIndex {
            name: variable.name.clone(),
            attribute: "derivative",
            index,
            count: variables.len(),
        })
    })?;
    let continuous = |variable: &Variable| {
        matches!(variable.kind, Kind::Real { .. }) && variable.variability == Variability::Continuous
    };
    if continuous(variable) && continuous(state) && state.name != variable.name {
        return Ok(());
    }
    Err(variable.fault(Problem::BadDerivative { name: variable.name.clone(), of: state.name.clone() }))
}
