//! The variables of a model, as the model description lists them.

use std::fmt::Debug;

/// The value reference of the time in FMI 3.0, for a model without an independent variable of its own.
pub const TIME_REFERENCE: u32 = 0;
/// The value reference of the first event indicator in FMI 3.0, where each has a variable; the others follow.
pub const FIRST_INDICATOR_REFERENCE: u32 = 1 << 30;

/// One variable of the model description.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Variable {
    /// Its name, unique in the description.
    pub name: &'static str,
    /// Its value reference, unique over all types.
    pub reference: u32,
    /// What it is, in one line.
    pub description: &'static str,
    /// Who determines it.
    pub causality: Causality,
    /// When it may change.
    pub variability: Variability,
    /// The name of its unit in the description.
    pub unit: Option<&'static str>,
    /// Its type, start value and limits.
    pub kind: Kind,
}

/// Who determines a variable (FMI 2.0.5, section 2.2.7).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Causality {
    /// Set by the importer, constant during the simulation.
    Parameter,
    /// Computed by the model from parameters.
    CalculatedParameter,
    /// Set by the importer at communication points.
    Input,
    /// Computed by the model for others.
    Output,
    /// Computed by the model for itself.
    Local,
    /// Time.
    Independent,
}

/// When a variable may change (FMI 2.0.5, section 2.2.7).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Variability {
    /// Never.
    Constant,
    /// Not after initialisation.
    Fixed,
    /// At communication points.
    Tunable,
    /// At events.
    Discrete,
    /// At any time.
    Continuous,
}

/// Type of a variable with its start value and inclusive limits, in the unit of the variable.
#[derive(Clone, Copy, PartialEq, Debug)]
#[allow(missing_docs, reason = "the fields are the attributes of the model description")]
pub enum Kind {
    /// Double-precision number.
    Real { start: Option<f64>, min: Option<f64>, max: Option<f64> },
    /// 32-bit integer.
    Integer { start: Option<i32>, min: Option<i32>, max: Option<i32> },
    /// One of a list of named integers, got and set as an integer.
    Enumeration { start: Option<i32>, items: &'static [Item] },
    /// True or false.
    Boolean { start: Option<bool> },
    /// Text in UTF-8.
    String { start: Option<&'static str> },
}

/// One item of an enumeration.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Item {
    /// Its name.
    pub name: &'static str,
    /// The number that stands for it.
    pub value: i32,
    /// What it means, in one line.
    pub description: &'static str,
}

/// The variables of one FMI base type, as an enum with one variant each.
///
/// `fmu-export-build` generates the implementations from the model description.
pub trait VariableId: Copy + Eq + Debug + 'static {
    /// Every variable of this type, in the order of the description.
    const ALL: &'static [Self];

    /// Continuous inputs of this type may change inside a step: the description has `canInterpolateInputs`.
    const INTERPOLATES: bool = false;

    /// Returns what the description says about the variable.
    fn variable(self) -> &'static Variable;

    /// The variable with this value reference.
    fn from_reference(reference: u32) -> Option<Self>;

    /// The variable with this name.
    fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|id| id.variable().name == name)
    }
}
