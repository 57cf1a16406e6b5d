//! The generated Rust module.
//!
//! What a variable is stands in one table per base type; the enums index into it. Functions stay short that way
//! and adding a variable changes three lines.

use crate::description::{Causality, Description, EnumerationType, Kind, Variability, Variable};
use std::fmt::Write as _;

/// The module's text: constants, one enum per FMI base type, one per enumeration type.
pub(crate) fn module(description: &Description) -> String {
    let mut code = String::from("// Generated from the model description: change that instead.\n");
    for (name, value, what) in [
        ("MODEL_NAME", description.model_name(), "Name of the model."),
        ("MODEL_IDENTIFIER", description.model_identifier(), "Name of the library inside the FMU."),
        ("GUID", &description.guid(), "Fingerprint of the model description, in braces."),
    ] {
        add(&mut code, format_args!("\n/// {what}\npub const {name}: &str = {value:?};\n"));
    }
    for base in [BaseType::Real, BaseType::Integer, BaseType::Boolean, BaseType::String] {
        let variables: Vec<_> =
            description.variables.iter().filter(|variable| BaseType::of(&variable.kind) == base).collect();
        base_type(&mut code, base, &variables, &description.enumerations);
    }
    exchange(&mut code, description);
    for enumeration in &description.enumerations {
        enumeration_type(&mut code, enumeration);
    }
    code
}

/// What Model Exchange needs to know: states, derivatives, event indicators.
fn exchange(code: &mut String, description: &Description) {
    let pairs = description.derivatives();
    if pairs.is_empty() && description.event_indicators() == 0 {
        return;
    }
    let list = |of: &dyn Fn(&(&Variable, &Variable)) -> String| {
        let names: Vec<_> = pairs.iter().map(|pair| format!("RealVariable::{}", of(pair))).collect();
        names.join(", ")
    };
    let states = list(&|(_, state)| variant(state));
    let derivatives = list(&|(derivative, _)| variant(derivative));
    let count = description.event_indicators();
    add(
        code,
        format_args!(
            "\n/// The continuous states.\npub const CONTINUOUS_STATES: &[RealVariable] = &[{states}];\n\
             \n/// Their derivatives, in the same order.\npub const DERIVATIVES: &[RealVariable] = &[{derivatives}];\n\
             \n/// The number of event indicators of Model Exchange.\npub const EVENT_INDICATORS: usize = {count};\n"
        ),
    );
}

/// `name` as a Rust type or variant: `u_dot_start` becomes `UDotStart`. None if that is no Rust name.
pub(crate) fn camel_case(name: &str) -> Option<String> {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let camel: String = words
        .flat_map(|word| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters)
        })
        .collect();
    let starts_well = camel.starts_with(|c: char| c.is_ascii_alphabetic());
    (starts_well && camel != "Self").then_some(camel)
}

/// The four types that FMI 2.0 has get and set functions for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum BaseType {
    Real,
    Integer,
    Boolean,
    String,
}

impl BaseType {
    /// Enumerations are read and set as Integers.
    pub(crate) fn of(kind: &Kind) -> Self {
        match kind {
            Kind::Real { .. } => Self::Real,
            Kind::Integer { .. } | Kind::Enumeration { .. } => Self::Integer,
            Kind::Boolean { .. } => Self::Boolean,
            Kind::String { .. } => Self::String,
        }
    }

    fn rust_name(self) -> &'static str {
        match self {
            Self::Real => "RealVariable",
            Self::Integer => "IntegerVariable",
            Self::Boolean => "BooleanVariable",
            Self::String => "StringVariable",
        }
    }

    /// The table of its variables.
    fn table(self) -> &'static str {
        match self {
            Self::Real => "REALS",
            Self::Integer => "INTEGERS",
            Self::Boolean => "BOOLEANS",
            Self::String => "STRINGS",
        }
    }

    fn documentation(self) -> &'static str {
        match self {
            Self::Real => "Variables of type Real.",
            Self::Integer => "Variables of type Integer or Enumeration.",
            Self::Boolean => "Variables of type Boolean.",
            Self::String => "Variables of type String.",
        }
    }
}

/// The enum of the variables of one base type, its `VariableId` and its table.
fn base_type(code: &mut String, base: BaseType, variables: &[&Variable], enumerations: &[EnumerationType]) {
    let (name, documentation) = (base.rust_name(), base.documentation());
    add(code, format_args!("\n/// {documentation}\n#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]\n"));
    add(code, format_args!("pub enum {name} {{\n"));
    for variable in variables {
        let text = markdown(&variable.description);
        // Plain brackets would be a link to rustdoc.
        let unit = match variable.unit.as_deref() {
            None | Some("1") => String::new(),
            Some(unit) => format!(" \\[{unit}\\]"),
        };
        add(code, format_args!("    /// `{}`: {text}{unit}.\n    {},\n", variable.name, variant(variable)));
    }
    code.push_str("}\n");
    if variables.is_empty() {
        code.push_str(&EMPTY.replace("@name@", name));
        return;
    }
    let list = variables.iter().map(|variable| format!("\n        Self::{},", variant(variable)));
    let arms = variables.iter().map(|variable| {
        format!("            {} => Some(Self::{}),\n", variable.reference, variant(variable))
    });
    code.push_str(
        &FILLED
            .replace("@name@", name)
            .replace("@table@", base.table())
            .replace("@list@", &list.collect::<String>())
            .replace("@arms@", &arms.collect::<String>()),
    );
    code.push_str(LITERALS);
    let count = variables.len();
    add(code, format_args!("static {}: [::fmi2_export::Variable; {count}] = [\n", base.table()));
    for variable in variables {
        table_row(code, variable, enumerations);
    }
    code.push_str("];\n");
}

const EMPTY: &str = "
impl ::fmi2_export::VariableId for @name@ {
    const ALL: &'static [Self] = &[];

    fn variable(self) -> &'static ::fmi2_export::Variable {
        match self {}
    }

    fn from_reference(_: u32) -> Option<Self> {
        None
    }
}
";

const FILLED: &str = "
impl ::fmi2_export::VariableId for @name@ {
    const ALL: &'static [Self] = &[@list@
    ];

    fn variable(self) -> &'static ::fmi2_export::Variable {
        &@table@[self as usize]
    }

    #[allow(clippy::too_many_lines, reason = \"one line per variable\")]
    fn from_reference(reference: u32) -> Option<Self> {
        match reference {
@arms@            _ => None,
        }
    }
}
";

const LITERALS: &str = "\n#[allow(clippy::unreadable_literal, reason = \"numbers as Rust prints them read back to the same bits\")]\n";

fn variant(variable: &Variable) -> String {
    camel_case(&variable.name).unwrap_or_default()
}

fn table_row(code: &mut String, variable: &Variable, enumerations: &[EnumerationType]) {
    let causality = match variable.causality {
        Causality::Parameter => "Parameter",
        Causality::CalculatedParameter => "CalculatedParameter",
        Causality::Input => "Input",
        Causality::Output => "Output",
        Causality::Local => "Local",
        Causality::Independent => "Independent",
    };
    let variability = match variable.variability {
        Variability::Constant => "Constant",
        Variability::Fixed => "Fixed",
        Variability::Tunable => "Tunable",
        Variability::Discrete => "Discrete",
        Variability::Continuous => "Continuous",
    };
    let kind = match &variable.kind {
        Kind::Real { start, min, max } => {
            format!("Real {{ start: {start:?}, min: {min:?}, max: {max:?} }}")
        }
        Kind::Integer { start, min, max } => {
            format!("Integer {{ start: {start:?}, min: {min:?}, max: {max:?} }}")
        }
        Kind::Enumeration { start } => {
            let items = items(variable, enumerations);
            format!("Enumeration {{ start: {start:?}, items: {items} }}")
        }
        Kind::Boolean { start } => format!("Boolean {{ start: {start:?} }}"),
        Kind::String { start } => format!("String {{ start: {start:?} }}"),
    };
    add(
        code,
        format_args!(
            "    ::fmi2_export::Variable {{\n        name: {:?},\n        reference: {},\n        description: {:?},\n        \
             causality: ::fmi2_export::Causality::{causality},\n        variability: \
             ::fmi2_export::Variability::{variability},\n        unit: {:?},\n        kind: \
             ::fmi2_export::Kind::{kind},\n    }},\n",
            variable.name, variable.reference, variable.description, variable.unit,
        ),
    );
}

/// The items of an enumeration variable's type, as an expression.
fn items(variable: &Variable, enumerations: &[EnumerationType]) -> String {
    let declared =
        enumerations.iter().find(|candidate| Some(&candidate.name) == variable.declared_type.as_ref());
    let mut text = String::from("&[");
    for item in declared.map_or(&[][..], |enumeration| &enumeration.items) {
        let (name, value, description) = (&item.name, item.value, &item.description);
        add(
            &mut text,
            format_args!(
                "\n            ::fmi2_export::Item {{ name: {name:?}, value: {value}, description: {description:?} }},"
            ),
        );
    }
    text.push_str("\n        ]");
    text
}

/// The enum of an enumeration type, convertible to and from its numbers and names.
fn enumeration_type(code: &mut String, enumeration: &EnumerationType) {
    let name = camel_case(&enumeration.name).unwrap_or_default();
    let variants: Vec<_> =
        enumeration.items.iter().map(|item| (camel_case(&item.name).unwrap_or_default(), item)).collect();
    let documentation = markdown(&enumeration.description);
    add(code, format_args!("\n/// {documentation}.\n#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]\n"));
    add(code, format_args!("pub enum {name} {{\n"));
    for (variant, item) in &variants {
        add(
            code,
            format_args!("    /// `{}`: {}.\n    {variant},\n", item.name, markdown(&item.description)),
        );
    }
    add(code, format_args!("}}\n\nimpl {name} {{\n    /// Every item, in the order of the description.\n"));
    code.push_str("    pub const ALL: &'static [Self] = &[");
    let list: Vec<_> = variants.iter().map(|(variant, _)| format!("Self::{variant}")).collect();
    add(code, format_args!("{}];\n", list.join(", ")));

    let arms = |text: &dyn Fn(&str, &crate::description::Item) -> String, last: &str| {
        variants
            .iter()
            .fold(String::new(), |all, (variant, item)| all + "            " + &text(variant, item) + ",\n")
            + last
    };
    let method = |code: &mut String, documentation: &str, signature: &str, on: &str, arms: String| {
        add(
            code,
            format_args!(
                "\n    /// {documentation}\n    #[must_use]\n    pub fn {signature} {{\n        match {on} {{\n{arms}        \
                 }}\n    }}\n"
            ),
        );
    };
    let none = "            _ => None,\n";
    method(
        code,
        "The number that stands for it in FMI.",
        "value(self) -> i32",
        "self",
        arms(&|variant, item| format!("Self::{variant} => {}", item.value), ""),
    );
    method(
        code,
        "The item with this number.",
        "from_value(value: i32) -> Option<Self>",
        "value",
        arms(&|variant, item| format!("{} => Some(Self::{variant})", item.value), none),
    );
    method(
        code,
        "Its name in the description and in scenes.",
        "name(self) -> &'static str",
        "self",
        arms(&|variant, item| format!("Self::{variant} => {:?}", item.name), ""),
    );
    method(
        code,
        "The item with this name.",
        "from_name(name: &str) -> Option<Self>",
        "name",
        arms(&|variant, item| format!("{:?} => Some(Self::{variant})", item.name), none),
    );
    method(
        code,
        "One line on what it means.",
        "description(self) -> &'static str",
        "self",
        arms(&|variant, item| format!("Self::{variant} => {:?}", item.description), ""),
    );
    code.push_str("}\n");
}

/// `text` as rustdoc's Markdown: identifiers in backticks, brackets as they are.
fn markdown(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let core = word.trim_matches(|c: char| !c.is_alphanumeric() && c != '_');
        let letters: Vec<char> = core.chars().collect();
        let camel = letters.windows(2).any(|pair| pair[0].is_lowercase() && pair[1].is_uppercase());
        let numbered = core.contains(|c: char| c.is_ascii_digit()) && core.contains(char::is_alphabetic);
        let escaped = |text: &str| text.replace('[', "\\[").replace(']', "\\]").replace('<', "\\<");
        match word.find(core) {
            Some(at) if !core.is_empty() && (core.contains('_') || camel || numbered) => {
                let (before, after) = (escaped(&word[..at]), escaped(&word[at + core.len()..]));
                format!("{before}`{core}`{after}")
            }
            _ => escaped(word),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Appends to a string, which cannot fail.
fn add(code: &mut String, text: std::fmt::Arguments<'_>) {
    let written = code.write_fmt(text);
    debug_assert!(written.is_ok(), "a string takes everything");
}
