//! Writes `choices.rs`: plain enumerations, the start values of the parameters, and where variables
//! matter. It knows no FMI.

use crate::description::Description;
use crate::names::{DERIVE, HEAD, camel, field, markdown, type_name};
use crate::usage;
use crate::variable::{Causality, EnumerationType, Item, Kind, Variable};
use std::fmt::Write as _;

/// The text of `choices.rs`: one enum per enumeration type, and the macros `start_values` and `usages`.
pub(crate) fn module(description: &Description) -> String {
    let mut code = String::from(HEAD);
    for enumeration in &description.enumerations {
        enumeration_type(&mut code, enumeration);
    }
    let start = |variable: &Variable| match &variable.kind {
        Kind::Real { start, .. } => format!("{:?}", start.unwrap_or_default()),
        Kind::Integer { start, .. } => start.unwrap_or_default().to_string(),
        Kind::Boolean { start } => start.unwrap_or_default().to_string(),
        Kind::String { start } => format!("{:?}.to_owned()", start.as_deref().unwrap_or_default()),
        Kind::Enumeration { start } => {
            let items = variable.items(&description.enumerations);
            let item = items.iter().find(|item| Some(item.value) == *start);
            format!("{}::{}", type_name(variable), camel(item.map_or("", |item| &item.name)))
        }
    };
    let line = |variable: &Variable| format!("            {}: {},\n", field(variable), start(variable));
    let fields: String = description.parameters().map(line).collect();
    let line_of_usage = |variable: &Variable| {
        let is_start = match variable.causality {
            Causality::Parameter => format!("$parameters.{} == {}", field(variable), start(variable)),
            _ => "true".to_owned(),
        };
        let matters = usage::code(variable, &description.variables);
        let (name, words) = (&variable.name, usage::condition(variable, &description.variables));
        format!(
            "            Usage {{ name: {name:?}, is_start: {is_start}, matters: {matters}, condition: {:?} \
             }},\n",
            words.unwrap_or_default()
        )
    };
    let usages: String = description.variables.iter().map(line_of_usage).collect();
    code + &START_VALUES.replace("@fields@", &fields) + &USAGES.replace("@usages@", &usages)
}

const USAGES: &str = "
/// Says of each variable whether its value is its start value, and whether it matters beside the others, from
/// a struct with one field per parameter. A struct `Usage` is in scope.
#[allow(unused_macros)]
macro_rules! usages {
    ($parameters:expr) => {
        [
@usages@        ]
    };
}
#[allow(unused_imports)]
pub(crate) use usages;
";

const START_VALUES: &str = "
/// Makes a struct of the parameters: each has a field of its name, set to its start value. Other fields
/// follow in the braces: `start_values!(Self { other: 0.0 })`.
#[allow(unused_macros)]
macro_rules! start_values {
    ($name:ident { $($others:tt)* }) => {
        $name {
@fields@            $($others)*
        }
    };
}
#[allow(unused_imports)]
pub(crate) use start_values;
";

/// The enum of an enumeration type, convertible to and from its numbers and names.
fn enumeration_type(code: &mut String, enumeration: &EnumerationType) {
    let name = camel(&enumeration.name);
    let documentation = markdown(&enumeration.description);
    let _ = write!(code, "\n/// {documentation}.\n{DERIVE}pub enum {name} {{\n");
    for item in &enumeration.items {
        let (variant, text) = (camel(&item.name), markdown(&item.description));
        let _ = write!(code, "    /// `{}`: {text}.\n    {variant},\n", item.name);
    }
    code.push_str("}\n");
    let each = |text: &dyn Fn(&Item) -> String| -> String {
        let lines = enumeration.items.iter().map(|item| format!("Self::{}{}", camel(&item.name), text(item)));
        lines.fold(String::new(), |all, line| all + "\n            " + &line + ",")
    };
    code.push_str(
        &ENUMERATION
            .replace("@name@", &name)
            .replace("@list@", &each(&|_| String::new()))
            .replace("@values@", &each(&|item| format!(" => {}", item.value)))
            .replace("@names@", &each(&|item| format!(" => {:?}", item.name)))
            .replace("@descriptions@", &each(&|item| format!(" => {:?}", item.description))),
    );
}

const ENUMERATION: &str = "
impl @name@ {
    /// Every item, in the order of the description.
    pub const ALL: &'static [Self] = &[@list@
    ];

    /// The number that stands for it in FMI.
    pub fn value(self) -> i32 {
        match self {@values@
        }
    }

    /// The item with this number.
    pub fn from_value(value: i32) -> Option<Self> {
        Self::ALL.iter().copied().find(|item| item.value() == value)
    }

    /// Its name in the description and in scenes.
    pub fn name(self) -> &'static str {
        match self {@names@
        }
    }

    /// The item with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|item| item.name() == name)
    }

    /// One line on what it means.
    pub fn description(self) -> &'static str {
        match self {@descriptions@
        }
    }
}
";
