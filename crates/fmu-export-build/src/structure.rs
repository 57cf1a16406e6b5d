//! The `ModelStructure`: which unknowns there are and what they depend on.

use crate::element::Element;
use crate::error::Fault;
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
            let at = position(variables.len(), index, "index", self.name)
                .map_err(|problem| unknown.fault(problem))?;
            let (list, name) = (self.name, &variables[at].name);
            if !(self.belongs)(at, &variables[at]) {
                return Err(unknown.fault(format!("{list} lists `{name}`, which {}", self.belongs_not)));
            }
            if !listed.insert(at) {
                return Err(unknown.fault(format!("{list} lists `{name}` twice")));
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
            Some((_, Variable { name, .. })) => {
                Err(Fault::new(line, format!("{} leaves out `{name}`, which {}", self.name, self.belongs_if)))
            }
        }
    }

    fn dependencies(&self, variables: &[Variable], unknown: &Element, name: &str) -> Result<(), String> {
        let list = self.name;
        let words = |attribute| unknown.attribute(attribute).map(|text: &str| text.split_ascii_whitespace());
        let mut dependencies = 0;
        for word in words("dependencies").into_iter().flatten() {
            let index = word.parse();
            let index = index.map_err(|_| format!("dependencies=\"{word}\" is not an index"))?;
            let at = position(variables.len(), index, "dependencies", name)?;
            if !(self.known)(at, &variables[at]) {
                let (on, why) = (&variables[at].name, self.known_not);
                return Err(format!("in {list}, `{name}` cannot depend on `{on}`, which {why}"));
            }
            dependencies += 1;
        }
        let Some(kinds) = words("dependenciesKind") else { return Ok(()) };
        if let Some(kind) = kinds.clone().find(|kind| !self.kinds.contains(kind)) {
            let allowed = self.kinds.join(", ");
            let why = format!("cannot contain {kind:?}, only {allowed}");
            return Err(format!("in {list}, the dependenciesKind of `{name}` {why}"));
        }
        let kinds = kinds.count();
        if kinds != dependencies {
            return Err(format!(
                "`{name}` has {dependencies} dependencies, but dependenciesKind has {kinds} entries"
            ));
        }
        Ok(())
    }
}

/// The 0-based position of the variable with the 1-based `index` among `count`; `attribute` of `owner` says
/// it.
pub(crate) fn position(count: usize, index: usize, attribute: &str, owner: &str) -> Result<usize, String> {
    index.checked_sub(1).filter(|at| *at < count).ok_or_else(|| {
        let there = format!("there are only the variables 1 to {count}");
        format!("`{owner}` gives the index {index} in `{attribute}`, but {there}")
    })
}
