//! Writes `variables.rs`: what FMI calls need.
//!
//! One enum per FMI base type, a table of what the description says about each variable, and the access to
//! the parameters by variable.

use crate::description::Description;
use crate::names::{DERIVE, HEAD, camel, field, markdown, type_name};
use crate::usage::described;
use crate::variable::{BaseType, Causality, Item, Kind, Variable};
use std::fmt::Write as _;

/// The text of `variables.rs`: constants, and for each FMI base type its enum, its table and the access to
/// its parameters.
pub(crate) fn module(description: &Description) -> String {
    let mut code = String::from(HEAD);
    for (name, value, what) in [
        ("MODEL_NAME", description.model_name(), "Name of the model."),
        ("MODEL_IDENTIFIER", description.model_identifier(), "Name of the library inside the FMU."),
        ("GUID", &description.guid(), "Fingerprint of the model description, in braces."),
    ] {
        let _ = write!(code, "\n/// {what}\npub const {name}: &str = {value:?};\n");
    }
    let parameters: Vec<_> = description.parameters().collect();
    groups(&mut code, &parameters);
    exchange(&mut code, description);
    for base in BaseType::ALL {
        let of_base = |variable: &&Variable| variable.base() == base;
        let variables: Vec<_> = description.variables.iter().filter(of_base).collect();
        base_type(&mut code, base, &variables, description);
        let of_base: Vec<_> = parameters.iter().copied().filter(of_base).collect();
        if !of_base.is_empty() {
            access(&mut code, base, &of_base);
        }
        patterns(&mut code, base, &variables);
    }
    transfer(&mut code, &parameters);
    code
}

/// Saving and reading the parameters as part of a state.
fn transfer(code: &mut String, parameters: &[&Variable]) {
    if parameters.is_empty() {
        return;
    }
    let line = |parameter: &&Variable| {
        let field = field(parameter);
        let (name, variant) = (format!("&mut self.{field}"), camel(&parameter.name));
        let call = match parameter.kind {
            Kind::Real { .. } => format!("real(RealVariable::{variant}, {name})"),
            Kind::Integer { .. } => format!("integer(IntegerVariable::{variant}, {name})"),
            Kind::Enumeration { .. } => format!("item({name}, {}::ALL)", type_name(parameter)),
            Kind::Boolean { .. } => format!("bool({name})"),
            Kind::String { .. } => format!("text({name})"),
        };
        format!("        codec.{call}?;\n")
    };
    let lines: String = parameters.iter().map(line).collect();
    code.push_str(&TRANSFER.replace("@lines@", &lines));
}

const TRANSFER: &str = "
impl Parameters {
    /// Passes every parameter of the description to `codec`, which writes or reads it.
    ///
    /// # Errors
    /// When the bytes to read end before, or are not a value that the parameter could be set to.
    pub fn transfer(
        &mut self,
        codec: &mut ::fmu_export::StateCodec<'_>,
    ) -> Result<(), ::fmu_export::Failure> {
@lines@        Ok(())
    }
}
";

/// The groups of parameters, in the order of their first parameters.
fn groups(code: &mut String, parameters: &[&Variable]) {
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for parameter in parameters {
        let Some(name) = parameter.group.as_deref() else { continue };
        match groups.iter_mut().find(|(group, _)| *group == name) {
            Some((_, members)) => members.push(&parameter.name),
            None => groups.push((name, vec![&parameter.name])),
        }
    }
    if groups.is_empty() {
        return;
    }
    code.push_str("\n/// The groups of parameters: name, and names of the parameters in it.\n");
    let _ = writeln!(code, "pub const GROUPS: [(&str, &[&str]); {}] = [", groups.len());
    for (name, members) in groups {
        let _ = writeln!(code, "    ({name:?}, &{members:?}),");
    }
    code.push_str("];\n");
}

/// What Model Exchange needs to know: states, derivatives, event indicators.
fn exchange(code: &mut String, description: &Description) {
    let pairs = description.derivatives();
    let count = description.event_indicators();
    if pairs.is_empty() && count == 0 {
        return;
    }
    let list = |of: &dyn Fn(&(&Variable, &Variable)) -> String| {
        let names: Vec<_> = pairs.iter().map(|pair| format!("RealVariable::{}", of(pair))).collect();
        names.join(", ")
    };
    let states = list(&|(_, state)| camel(&state.name));
    let derivatives = list(&|(derivative, _)| camel(&derivative.name));
    let _ = write!(
        code,
        "\n/// The continuous states.\npub const CONTINUOUS_STATES: &[RealVariable] = &[{states}];\n\
             \n/// Their derivatives, in the same order.\n\
             pub const DERIVATIVES: &[RealVariable] = &[{derivatives}];\n\
             \n/// The number of event indicators of Model Exchange.\n\
             pub const EVENT_INDICATORS: usize = {count};\n"
    );
}

/// The enum of the variables of one base type, its `VariableId` and its table.
fn base_type(code: &mut String, base: BaseType, variables: &[&Variable], description: &Description) {
    let of = if base == BaseType::Integer { "Integer or Enumeration" } else { &format!("{base:?}") };
    let _ = write!(code, "\n/// Variables of type {of}.\n{DERIVE}pub enum {base:?}Variable {{\n");
    for variable in variables {
        let text = markdown(&described(variable, &description.variables));
        // Plain brackets would be a link to rustdoc.
        let unit = match variable.unit.as_deref() {
            None | Some("1") => String::new(),
            Some(unit) => format!(" \\[{unit}\\]"),
        };
        let (name, variant) = (&variable.name, camel(&variable.name));
        let _ = writeln!(code, "    /// `{name}`: {text}{unit}.\n    {variant},");
    }
    code.push_str("}\n");
    let name = format!("{base:?}Variable");
    if variables.is_empty() {
        code.push_str(&EMPTY.replace("@name@", &name));
        return;
    }
    let list = variables.iter().map(|variable| format!("\n        Self::{},", camel(&variable.name)));
    let arms = variables.iter().map(|variable| {
        format!("            {} => Some(Self::{}),\n", variable.reference, camel(&variable.name))
    });
    let rows = variables.iter().map(|variable| table_row(variable, description));
    code.push_str(
        &FILLED
            .replace("@name@", &name)
            .replace("@table@", &format!("{base:?}").to_uppercase())
            .replace("@interpolates@", &(base == BaseType::Real && description.interpolates()).to_string())
            .replace("@count@", &variables.len().to_string())
            .replace("@list@", &list.collect::<String>())
            .replace("@arms@", &arms.collect::<String>())
            .replace("@rows@", &rows.collect::<String>()),
    );
}

const EMPTY: &str = "
impl ::fmu_export::VariableId for @name@ {
    const ALL: &'static [Self] = &[];

    fn variable(self) -> &'static ::fmu_export::Variable {
        match self {}
    }

    fn from_reference(_: u32) -> Option<Self> {
        None
    }
}
";

const FILLED: &str = "
impl ::fmu_export::VariableId for @name@ {
    const ALL: &'static [Self] = &[@list@
    ];
    const INTERPOLATES: bool = @interpolates@;

    fn variable(self) -> &'static ::fmu_export::Variable {
        &@table@[self as usize]
    }

    #[allow(clippy::too_many_lines, reason = \"one line per variable\")]
    fn from_reference(reference: u32) -> Option<Self> {
        match reference {
@arms@            _ => None,
        }
    }
}

#[allow(clippy::unreadable_literal, reason = \"numbers as Rust prints them read back to the same bits\")]
static @table@: [::fmu_export::Variable; @count@] = [
@rows@];
";

fn table_row(variable: &Variable, whole: &Description) -> String {
    let Variable { name, reference, causality, variability, unit, .. } = variable;
    let description = described(variable, &whole.variables);
    let kind = match &variable.kind {
        Kind::Enumeration { start } => {
            let items = variable.items(&whole.enumerations).iter().map(
                |Item { name, value, description, .. }| {
                    format!(
                        "\n            ::fmu_export::Item {{ name: {name:?}, value: {value}, description: \
                     {description:?} }},"
                    )
                },
            );
            let items: String = items.collect();
            format!("Enumeration {{ start: {start:?}, items: &[{items}\n        ] }}")
        }
        kind => format!("{kind:?}"),
    };
    format!(
        "    ::fmu_export::Variable {{\n        name: {name:?},\n        reference: {reference},\n        \
         description: {description:?},\n        causality: ::fmu_export::Causality::{causality:?},\n        \
         variability: ::fmu_export::Variability::{variability:?},\n        unit: {unit:?},\n        kind: \
         ::fmu_export::Kind::{kind},\n    }},\n"
    )
}

/// The name of the getter of one base type.
fn method(base: BaseType) -> &'static str {
    match base {
        BaseType::Real => "real",
        BaseType::Integer => "integer",
        BaseType::Boolean => "boolean",
        BaseType::String => "text",
    }
}

/// Getter and setter of the parameters of one base type.
fn access(code: &mut String, base: BaseType, parameters: &[&Variable]) {
    let value = match base {
        BaseType::Real => "f64",
        BaseType::Integer => "i32",
        BaseType::Boolean => "bool",
        BaseType::String => "&str",
    };
    let (mut get, mut set) = (String::new(), String::new());
    for parameter in parameters {
        let (variant, field) = (camel(&parameter.name), field(parameter));
        let (read, write) = match &parameter.kind {
            Kind::Enumeration { .. } => {
                let found = format!("{}::from_value(value)", type_name(parameter));
                let write = format!("return {found}.map(|item| self.{field} = item).is_some()");
                (format!("self.{field}.value()"), write)
            }
            Kind::String { .. } => (format!("&self.{field}"), format!("self.{field} = value.to_owned()")),
            _ => (format!("self.{field}"), format!("self.{field} = value")),
        };
        let _ = writeln!(get, "            {base:?}Variable::{variant} => Some({read}),");
        let _ = writeln!(set, "            {base:?}Variable::{variant} => {write},");
    }
    code.push_str(
        &ACCESS
            .replace("@base@", &format!("{base:?}"))
            .replace("@method@", method(base))
            .replace("@value@", value)
            .replace("@get@", &get)
            .replace("@set@", &set),
    );
}

const ACCESS: &str = "
#[allow(unreachable_patterns, unreachable_code, reason = \"every variable may be a parameter or a choice\")]
impl Parameters {
    /// The value of a parameter of type @base@; `None` for other variables.
    pub fn @method@(&self, variable: @base@Variable) -> Option<@value@> {
        match variable {
@get@            _ => None,
        }
    }

    /// Sets a parameter of type @base@; `false` for other variables and for an item that does not exist.
    pub fn set_@method@(&mut self, variable: @base@Variable, value: @value@) -> bool {
        match variable {
@set@            _ => return false,
        }
        true
    }
}

";

/// The patterns of the variables of one base type by their causality.
fn patterns(code: &mut String, base: BaseType, variables: &[&Variable]) {
    for (causality, name) in [
        (Causality::Input, "input"),
        (Causality::Output, "output"),
        (Causality::Local, "local"),
        (Causality::Parameter, "parameter"),
        (Causality::CalculatedParameter, "calculated"),
    ] {
        let of = variables.iter().filter(|variable| variable.causality == causality);
        let pattern: Vec<_> =
            of.map(|variable| format!("{base:?}Variable::{}", camel(&variable.name))).collect();
        if !pattern.is_empty() {
            code.push_str(
                &PATTERN
                    .replace("@name@", &format!("{}_{name}", method(base)))
                    .replace("@pattern@", &pattern.join("\n            | ")),
            );
        }
    }
}

const PATTERN: &str = "
/// The pattern of these variables, for a `match` that is to name all others.
#[allow(unused_macros)]
macro_rules! @name@ {
    () => {
        @pattern@
    };
}
#[allow(unused_imports)]
pub(crate) use @name@;
";
