//! The `ModelStructure`: which unknowns there are and what they depend on.

use crate::element::Element;
use crate::error::{Fault, Problem};
use crate::variable::{Causality, Initial, Variable};
use std::collections::HashSet;

const KINDS: [&str; 5] = ["dependent", "constant", "fixed", "tunable", "discrete"];

/// One of the three lists of the `ModelStructure`.
struct List<'a> {
    name: &'static str,
    /// Whether a variable (with its 0-based index) belongs into it.
    belongs: &'a dyn Fn(usize, &Variable) -> bool,
    belongs_if: &'static str,
    belongs_not: &'static str,
    /// Whether an unknown may depend on a variable.
    known: &'a dyn Fn(usize, &Variable) -> bool,
    known_not: &'static str,
    /// The allowed values of `dependenciesKind`.
    kinds: &'a [&'static str],
}

/// Checks the three lists of `structure` against the variables.
pub(crate) fn check(variables: &[Variable], structure: &Element) -> Result<(), Fault> {
    let states = states(variables, structure);
    let free_at_start = |variable: &Variable| {
        matches!(variable.initial_or_default(), Some(Initial::Approx | Initial::Calculated))
    };
    let known_in_steps = |at: usize, variable: &Variable| {
        matches!(variable.causality, Causality::Input | Causality::Independent) || states.contains(&at)
    };
    let lists = [
        List {
            name: "Outputs",
            belongs: &|_, variable| variable.causality == Causality::Output,
            belongs_if: "is an output",
            belongs_not: "is not an output",
            known: &known_in_steps,
            known_not: "is neither an input nor a state",
            kinds: &KINDS,
        },
        List {
            name: "Derivatives",
            belongs: &|_, variable| variable.derivative.is_some(),
            belongs_if: "is a derivative",
            belongs_not: "has no attribute `derivative`",
            known: &known_in_steps,
            known_not: "is neither an input nor a state",
            kinds: &KINDS,
        },
        List {
            name: "InitialUnknowns",
            belongs: &|at, variable| match variable.causality {
                Causality::CalculatedParameter => true,
                Causality::Output => free_at_start(variable),
                _ => free_at_start(variable) && (states.contains(&at) || variable.derivative.is_some()),
            },
            belongs_if: "is calculated at the start",
            belongs_not: "is not calculated at the start",
            known: &|_, variable| {
                matches!(variable.causality, Causality::Input | Causality::Independent)
                    || variable.initial_or_default() == Some(Initial::Exact)
            },
            known_not: "is not known at the start",
            kinds: &KINDS[..2],
        },
    ];
    for list in &lists {
        match structure.child(list.name) {
            Some(element) => list.check(variables, element)?,
            // A co-simulation unit need not list its states.
            None if list.name == "Derivatives" => {}
            None => list.complete(variables, &HashSet::new(), structure.line)?,
        }
    }
    Ok(())
}

/// The 0-based indices of the continuous states: what the listed derivatives are derivatives of.
fn states(variables: &[Variable], structure: &Element) -> HashSet<usize> {
    if structure.child("Derivatives").is_none() {
        return HashSet::new();
    }
    variables.iter().filter_map(|variable| variable.derivative?.checked_sub(1)).collect()
}

impl List<'_> {
    fn check(&self, variables: &[Variable], element: &Element) -> Result<(), Fault> {
        let mut listed = HashSet::new();
        for unknown in &element.children {
            unknown.required("index")?;
            let index = unknown.parsed("index", "an index")?.unwrap_or_default();
            let at =
                position(variables, index, "index", self.name).map_err(|problem| unknown.fault(problem))?;
            let name = variables[at].name.clone();
            if !(self.belongs)(at, &variables[at]) {
                let problem = Problem::NotInList { list: self.name, name, why: self.belongs_not };
                return Err(unknown.fault(problem));
            }
            if !listed.insert(at) {
                return Err(unknown.fault(Problem::ListedTwice { list: self.name, name }));
            }
            self.dependencies(variables, unknown, name).map_err(|problem| unknown.fault(problem))?;
        }
        self.complete(variables, &listed, element.line)
    }

    fn complete(&self, variables: &[Variable], listed: &HashSet<usize>, line: usize) -> Result<(), Fault> {
        let missing = variables
            .iter()
            .enumerate()
            .find(|(at, variable)| (self.belongs)(*at, variable) && !listed.contains(at));
        match missing {
            None => Ok(()),
            Some((_, variable)) => {
                let name = variable.name.clone();
                Err(Fault { line, problem: Problem::LeftOut { list: self.name, name, why: self.belongs_if } })
            }
        }
    }

    fn dependencies(&self, variables: &[Variable], unknown: &Element, name: String) -> Result<(), Problem> {
        let words = |attribute| unknown.attribute(attribute).map(|text: &str| text.split_ascii_whitespace());
        let mut dependencies = 0;
        for word in words("dependencies").into_iter().flatten() {
            let index = word.parse();
            let index = index.map_err(|_| Problem::bad_value("dependencies", word, "an index"))?;
            let at = position(variables, index, "dependencies", &name)?;
            if !(self.known)(at, &variables[at]) {
                let on = variables[at].name.clone();
                return Err(Problem::UnknownDependency { name, on, list: self.name, why: self.known_not });
            }
            dependencies += 1;
        }
        let Some(kinds) = words("dependenciesKind") else { return Ok(()) };
        if let Some(kind) = kinds.clone().find(|kind| !self.kinds.contains(kind)) {
            let (name, kind) = (name, kind.to_owned());
            return Err(Problem::BadDependencyKind {
                name,
                kind,
                list: self.name,
                allowed: self.kinds.join(", "),
            });
        }
        let kinds = kinds.count();
        if kinds == dependencies {
            Ok(())
        } else {
            Err(Problem::UnequalDependencies { name, dependencies, kinds })
        }
    }
}

/// The 0-based position of the variable with the 1-based `index`; `attribute` of `owner` says it.
fn position(
    variables: &[Variable],
    index: usize,
    attribute: &'static str,
    owner: &str,
) -> Result<usize, Problem> {
    let count = variables.len();
    index.checked_sub(1).filter(|at| *at < count).ok_or_else(|| Problem::NoSuchIndex {
        name: owner.to_owned(),
        attribute,
        index,
        count,
    })
}
