//! What can be wrong with a description.

use std::path::PathBuf;

/// Why [`generate`](crate::generate) gave up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum DescriptionError {
    /// The description cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    /// The generated module cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    /// The description contradicts itself or FMI 2.0.
    #[error("{}:{}: {}", path.display(), fault.line, fault.problem)]
    Invalid { path: PathBuf, fault: Box<Fault> },
}

/// A problem and the line of the description it is on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct Fault {
    /// 1-based line of the XML.
    pub line: usize,
    /// What is wrong there.
    pub problem: Problem,
}

/// What FMI 2.0 forbids and the schema cannot always say.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the messages document the variants and their fields")]
pub enum Problem {
    #[error("not well-formed XML: {message}")]
    Malformed { message: String },
    #[error("expected <{expected}>, found <{found}>")]
    UnexpectedElement { expected: &'static str, found: String },
    #[error("<{element}> is missing")]
    MissingElement { element: &'static str },
    #[error(
        "the modelIdentifier is {own:?} here and {other:?} in <ModelExchange>: one library serves both kinds"
    )]
    TwoLibraries { own: String, other: String },
    #[error("numberOfEventIndicators {why}")]
    EventIndicators { why: &'static str },
    #[error("<{element}> needs the attribute `{attribute}`")]
    MissingAttribute { element: String, attribute: &'static str },
    #[error("{attribute}=\"{value}\" is not {expected}")]
    BadValue { attribute: String, value: String, expected: &'static str },
    #[error("there is no variable `{name}`")]
    NoSuchVariable { name: String },
    #[error("FMI 3.0 needs the name `{name}` or the value reference {reference} for a variable of its own")]
    Reserved { name: String, reference: u32 },
    #[error("fmiVersion is {found:?}: only \"2.0\" is understood")]
    Version { found: String },
    #[error("the name `{name}` was used on line {first} already")]
    RepeatedName { name: String, first: usize },
    #[error(
        "`{name}` has value reference {reference}, which `{other}` on line {first} has already; take a free \
         one, {free} for example"
    )]
    RepeatedReference { name: String, reference: u32, other: String, first: usize, free: u32 },
    #[error("`{name}` and `{other}` on line {first} both become the Rust name {rust}")]
    RustNameClash { name: String, other: String, first: usize, rust: String },
    #[error("`{name}` cannot be turned into a Rust name")]
    NoRustName { name: String },
    #[error("`{name}` needs a start value, being {why}")]
    MissingStart { name: String, why: &'static str },
    #[error("`{name}` must not have a start value, being {why}")]
    ForbiddenStart { name: String, why: &'static str },
    #[error("the unit `{unit}` of `{name}` is not declared in UnitDefinitions")]
    UndeclaredUnit { name: String, unit: String },
    #[error("the display unit `{display_unit}` of `{name}` is not declared with the unit `{unit}`")]
    UndeclaredDisplayUnit { name: String, unit: String, display_unit: String },
    #[error("`{name}` has the unit `{unit}`, but its type `{declared_type}` has `{type_unit}`")]
    UnitMismatch { name: String, unit: String, declared_type: String, type_unit: String },
    #[error("the type `{declared_type}` of `{name}` is not declared in TypeDefinitions as {kind}")]
    UndeclaredType { name: String, declared_type: String, kind: &'static str },
    #[error("`{name}` cannot be {causality}, {variability} and {initial} at once")]
    IllegalCombination { name: String, causality: &'static str, variability: &'static str, initial: String },
    #[error(
        "`{name}` is continuous (which is what leaving out the variability means), but only a Real can be"
    )]
    ContinuousNotReal { name: String },
    #[error("the limits of `{name}` are crossed: min {min} exceeds max {max}")]
    CrossedLimits { name: String, min: String, max: String },
    #[error("the start value {start} of `{name}` is outside its limits {min} to {max}")]
    StartOutsideLimits { name: String, start: String, min: String, max: String },
    #[error("the start value {start} of `{name}` is not an item of its type `{declared_type}`")]
    StartNotAnItem { name: String, start: i32, declared_type: String },
    #[error("the item `{name}` has the value {value}, which the item on line {first} has already")]
    RepeatedItemValue { name: String, value: i32, first: usize },
    #[error(
        "`{name}` gives the index {index} in `{attribute}`, but there are only the variables 1 to {count}"
    )]
    NoSuchIndex { name: String, attribute: &'static str, index: usize, count: usize },
    #[error("`{name}` is the derivative of `{of}`, and both must be continuous Reals and not the same")]
    BadDerivative { name: String, of: String },
    #[error("the parameter `{name}` has no annotation <Group name=\"…\"/>, but others have one")]
    NoGroup { name: String },
    #[error("<Where> of `{name}` {why}")]
    BadCondition { name: String, why: String },
    #[error("{list} lists `{name}`, which {why}")]
    NotInList { list: &'static str, name: String, why: &'static str },
    #[error("{list} leaves out `{name}`, which {why}")]
    LeftOut { list: &'static str, name: String, why: &'static str },
    #[error("{list} lists `{name}` twice")]
    ListedTwice { list: &'static str, name: String },
    #[error("in {list}, `{name}` cannot depend on `{on}`, which {why}")]
    UnknownDependency { name: String, on: String, list: &'static str, why: &'static str },
    #[error("in {list}, the dependenciesKind of `{name}` cannot contain {kind:?}, only {allowed}")]
    BadDependencyKind { name: String, kind: String, list: &'static str, allowed: String },
    #[error("`{name}` has {dependencies} dependencies, but dependenciesKind has {kinds} entries")]
    UnequalDependencies { name: String, dependencies: usize, kinds: usize },
}

impl Problem {
    pub(crate) fn bad_value(attribute: &str, value: &str, expected: &'static str) -> Self {
        Self::BadValue { attribute: attribute.to_owned(), value: value.to_owned(), expected }
    }
}
