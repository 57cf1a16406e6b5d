//! The `ModelStructure`: which unknowns there are and what they depend on.

use crate::element::Element;
use crate::error::Fault;
use crate::variable::{Causality, Initial, Variable};
use std::collections::HashSet;

const KINDS: [&str; 5] = ["dependent", "constant", "fixed", "tunable", "discrete"];

/// The lists of unknowns, in the order in which they are checked.
const LISTS: [&str; 3] = ["Outputs", "Derivatives", INITIAL];
const INITIAL: &str = "InitialUnknowns";

/// What the lists of the `ModelStructure` have of some variables.
pub(crate) struct Rules<'a> {
    variables: &'a [Variable],
    /// The 0-based indices of the continuous states: what the listed derivatives are derivatives of.
    states: HashSet<usize>,
}

impl<'a> Rules<'a> {
    /// The rules for `variables`. A co-simulation unit need not list its derivatives; it then has no states.
    pub(crate) fn new(variables: &'a [Variable], structure: &Element) -> Self {
        let has_states = structure.child("Derivatives").is_some();
        let states = variables.iter().filter_map(|variable| variable.derivative?.checked_sub(1));
        Self { variables, states: states.filter(|_| has_states).collect() }
    }

    /// Returns whether the variable with a 0-based index belongs into a list.
    pub(crate) fn belongs(&self, list: &str, at: usize) -> bool {
        let variable = &self.variables[at];
        let is_free_at_start =
            matches!(variable.initial_or_default(), Some(Initial::Approx | Initial::Calculated));
        match (list, variable.causality) {
            ("Outputs", causality) => causality == Causality::Output,
            ("Derivatives", _) => variable.derivative.is_some(),
            (_, Causality::CalculatedParameter) => true,
            (_, Causality::Output) => is_free_at_start,
            _ => is_free_at_start && (self.states.contains(&at) || variable.derivative.is_some()),
        }
    }

    /// Returns whether the unknowns of a list may depend on the variable with a 0-based index.
    pub(crate) fn is_known(&self, list: &str, at: usize) -> bool {
        let variable = &self.variables[at];
        matches!(variable.causality, Causality::Input | Causality::Independent)
            || match list {
                INITIAL => variable.initial_or_default() == Some(Initial::Exact),
                _ => self.states.contains(&at),
            }
    }
}

/// Checks the three lists of `structure` against the variables.
pub(crate) fn check(variables: &[Variable], structure: &Element) -> Result<(), Fault> {
    let rules = Rules::new(variables, structure);
    for list in LISTS {
        match structure.child(list) {
            Some(element) => rules.check(list, element)?,
            None if list == "Derivatives" => {}
            None => rules.complete(list, &HashSet::new(), structure.line)?,
        }
    }
    Ok(())
}

impl Rules<'_> {
    fn check(&self, list: &str, element: &Element) -> Result<(), Fault> {
        let mut listed = HashSet::new();
        for unknown in &element.children {
            unknown.required("index")?;
            let index = unknown.parsed("index", "an index")?.unwrap_or_default();
            let at = position(self.variables.len(), index, "index", list)
                .map_err(|problem| unknown.fault(problem))?;
            let name = &self.variables[at].name;
            if !self.belongs(list, at) {
                return Err(unknown.fault(format!("{list} lists `{name}`, which does not belong there")));
            }
            if !listed.insert(at) {
                return Err(unknown.fault(format!("{list} lists `{name}` twice")));
            }
            self.dependencies(list, unknown, name).map_err(|problem| unknown.fault(problem))?;
        }
        self.complete(list, &listed, element.line)
    }

    fn complete(&self, list: &str, listed: &HashSet<usize>, line: usize) -> Result<(), Fault> {
        let missing = (0..self.variables.len()).find(|at| self.belongs(list, *at) && !listed.contains(at));
        let Some(at) = missing else { return Ok(()) };
        Err(Fault::new(line, format!("{list} leaves out `{}`", self.variables[at].name)))
    }

    fn dependencies(&self, list: &str, unknown: &Element, name: &str) -> Result<(), String> {
        let words_of =
            |attribute| unknown.attribute(attribute).map(|text: &str| text.split_ascii_whitespace());
        let mut dependencies = 0;
        for word in words_of("dependencies").into_iter().flatten() {
            let index = word.parse();
            let index = index.map_err(|_| format!("dependencies=\"{word}\" is not an index"))?;
            let at = position(self.variables.len(), index, "dependencies", name)?;
            if !self.is_known(list, at) {
                let on = &self.variables[at].name;
                return Err(format!("in {list}, `{name}` cannot depend on `{on}`"));
            }
            dependencies += 1;
        }
        let Some(kinds) = words_of("dependenciesKind") else { return Ok(()) };
        let allowed = if list == INITIAL { &KINDS[..2] } else { &KINDS };
        if let Some(kind) = kinds.clone().find(|kind| !allowed.contains(kind)) {
            let why = format!("cannot contain {kind:?}, only {}", allowed.join(", "));
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
