//! The description as variables, types and structure.

use crate::element::Element;
use crate::error::{Fault, Problem};
use crate::fingerprint::{fingerprint, with_guid};
use crate::{check, error};

/// A description that has passed every check.
#[derive(Clone, Debug)]
pub struct Description {
    pub(crate) root: Element,
    pub(crate) text: String,
    pub(crate) variables: Vec<Variable>,
    pub(crate) enumerations: Vec<EnumerationType>,
}

/// One `<ScalarVariable>`.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub(crate) line: usize,
    pub(crate) name: String,
    pub(crate) reference: u32,
    pub(crate) description: String,
    pub(crate) causality: Causality,
    pub(crate) variability: Variability,
    pub(crate) initial: Option<Initial>,
    pub(crate) declared_type: Option<String>,
    /// Its own or its type's.
    pub(crate) unit: Option<String>,
    pub(crate) display_unit: Option<String>,
    /// 1-based index of the variable this is the derivative of.
    pub(crate) derivative: Option<usize>,
    pub(crate) kind: Kind,
}

/// FMI base type with start value and limits, the type's where the variable has none of its own.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Real { start: Option<f64>, min: Option<f64>, max: Option<f64> },
    Integer { start: Option<i32>, min: Option<i32>, max: Option<i32> },
    Enumeration { start: Option<i32> },
    Boolean { start: Option<bool> },
    String { start: Option<String> },
}

/// One `<SimpleType>` with an `<Enumeration>`.
#[derive(Clone, Debug)]
pub(crate) struct EnumerationType {
    pub(crate) line: usize,
    pub(crate) name: String,
    pub(crate) description: String,
    pub(crate) items: Vec<Item>,
}

/// One `<Item>` of an enumeration.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub(crate) line: usize,
    pub(crate) name: String,
    pub(crate) value: i32,
    pub(crate) description: String,
}

/// Declares an enum whose variants have a name in the XML.
macro_rules! named {
    ($(#[$doc:meta])* $type:ident: $expected:literal { $($variant:ident = $name:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum $type { $($variant),+ }

        impl $type {
            /// What is expected where one of these stands.
            const EXPECTED: &'static str = $expected;

            /// The name in the XML.
            pub(crate) fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }
        }

        impl std::str::FromStr for $type {
            type Err = ();

            fn from_str(text: &str) -> Result<Self, ()> {
                match text { $($name => Ok(Self::$variant),)+ _ => Err(()) }
            }
        }
    };
}

named! {
    /// What a variable is to the outside.
    Causality: "a causality" {
        Parameter = "parameter", CalculatedParameter = "calculatedParameter", Input = "input", Output = "output",
        Local = "local", Independent = "independent",
    }
}
named! {
    /// When a variable changes.
    Variability: "a variability" {
        Constant = "constant", Fixed = "fixed", Tunable = "tunable", Discrete = "discrete", Continuous = "continuous",
    }
}
named! {
    /// How a variable starts.
    Initial: "exact, approx or calculated" { Exact = "exact", Approx = "approx", Calculated = "calculated" }
}

impl Description {
    /// Reads and checks the description `text`.
    ///
    /// # Errors
    ///
    /// The first [`Problem`] found, with its line.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        Self::from_root(Element::parse(text)?, text.to_owned())
    }

    /// Interprets and checks the element `root`, whose text is `text`.
    pub(crate) fn from_root(root: Element, text: String) -> Result<Self, Fault> {
        if root.name != "fmiModelDescription" {
            let found = root.name.clone();
            return Err(root.fault(Problem::UnexpectedElement { expected: "fmiModelDescription", found }));
        }
        let version = root.required("fmiVersion")?;
        if version != "2.0" {
            return Err(root.fault(Problem::Version { found: version.to_owned() }));
        }
        for name in ["modelName", "guid"] {
            root.required(name)?;
        }
        let variables = required_child(&root, "ModelVariables")?
            .children
            .iter()
            .map(|element| read_variable(&root, element))
            .collect::<Result<Vec<_>, _>>()?;
        let enumerations = read_enumerations(&root)?;
        let description = Self { root, text, variables, enumerations };
        check::all(&description)?;
        Ok(description)
    }

    /// The guid that follows from the text: 32 hexadecimal digits in braces.
    #[must_use]
    pub fn guid(&self) -> String {
        fingerprint(&self.text)
    }

    /// The guid written in the description.
    #[must_use]
    pub fn declared_guid(&self) -> &str {
        self.root.attribute("guid").unwrap_or_default()
    }

    /// The model's name.
    #[must_use]
    pub fn model_name(&self) -> &str {
        self.root.attribute("modelName").unwrap_or_default()
    }

    /// The name of the library, and of the functions' owner.
    #[must_use]
    pub fn model_identifier(&self) -> &str {
        let element = self.root.child("CoSimulation").or_else(|| self.root.child("ModelExchange"));
        element.and_then(|element| element.attribute("modelIdentifier")).unwrap_or_default()
    }

    /// The number of event indicators; 0 for co-simulation alone.
    #[must_use]
    pub fn event_indicators(&self) -> usize {
        let count = self.root.attribute("numberOfEventIndicators");
        count.and_then(|count| count.trim().parse().ok()).unwrap_or_default()
    }

    /// The derivatives in the order of the model structure, each with its state.
    pub(crate) fn derivatives(&self) -> Vec<(&Variable, &Variable)> {
        let listed = self.root.child("ModelStructure").and_then(|structure| structure.child("Derivatives"));
        let unknowns = listed.map_or(&[][..], |list| &list.children).iter();
        let pair = |unknown: &Element| {
            let index: usize = unknown.attribute("index")?.trim().parse().ok()?;
            let derivative = self.variables.get(index.checked_sub(1)?)?;
            Some((derivative, self.variables.get(derivative.derivative?.checked_sub(1)?)?))
        };
        unknowns.filter_map(pair).collect()
    }

    /// The names of the variables, in their order.
    pub fn variable_names(&self) -> impl Iterator<Item = &str> {
        self.variables.iter().map(|variable| variable.name.as_str())
    }

    /// The text as it was read, with `guid` as its guid and everything else as it was.
    #[must_use]
    pub fn text_with_guid(&self, guid: &str) -> String {
        with_guid(&self.text, guid)
    }

    /// The description in canonical form: no comments, two blanks per level.
    #[must_use]
    pub fn to_xml(&self) -> String {
        self.root.to_xml()
    }
}

/// The child `name` of `root`, which must be there.
pub(crate) fn required_child<'a>(root: &'a Element, name: &'static str) -> Result<&'a Element, Fault> {
    root.child(name).ok_or_else(|| root.fault(Problem::MissingElement { element: name }))
}

/// The `<SimpleType>` called `name`.
pub(crate) fn simple_type<'a>(root: &'a Element, name: &str) -> Option<&'a Element> {
    root.child("TypeDefinitions")?.children.iter().find(|element| element.attribute("name") == Some(name))
}

fn read_variable(root: &Element, element: &Element) -> Result<Variable, Fault> {
    if element.name != "ScalarVariable" {
        let found = element.name.clone();
        return Err(element.fault(Problem::UnexpectedElement { expected: "ScalarVariable", found }));
    }
    let name = element.required("name")?.to_owned();
    element.required("valueReference")?;
    let reference = element.parsed("valueReference", "a value reference")?.unwrap_or_default();
    let causality = element.parsed("causality", Causality::EXPECTED)?.unwrap_or(Causality::Local);
    let variability =
        element.parsed("variability", Variability::EXPECTED)?.unwrap_or(Variability::Continuous);
    let initial = element.parsed("initial", Initial::EXPECTED)?;
    let typed = element
        .children
        .iter()
        .find(|child| child.name != "Annotations")
        .ok_or_else(|| element.fault(Problem::MissingElement { element: "Real" }))?;
    let declared_type = typed.attribute("declaredType").map(str::to_owned);
    // Attributes the variable does not have itself come from its type.
    let inherited = match &declared_type {
        None => None,
        Some(declared_type) => Some(type_of(root, &name, declared_type, typed)?),
    };
    let text = |attribute: &str| {
        let own = typed.attribute(attribute);
        own.or_else(|| inherited?.attribute(attribute)).map(str::to_owned)
    };
    Ok(Variable {
        line: element.line,
        description: element.attribute("description").unwrap_or_default().to_owned(),
        unit: text("unit"),
        display_unit: text("displayUnit"),
        derivative: typed.parsed("derivative", "an index")?,
        kind: read_kind(typed, inherited)?,
        name,
        reference,
        causality,
        variability,
        initial,
        declared_type,
    })
}

/// The element inside the `<SimpleType>` that the variable `name` declares, of the same FMI base type as the variable.
fn type_of<'a>(
    root: &'a Element,
    name: &str,
    declared_type: &str,
    typed: &Element,
) -> Result<&'a Element, Fault> {
    simple_type(root, declared_type).and_then(|element| element.child(&typed.name)).ok_or_else(|| {
        typed.fault(Problem::UndeclaredType {
            name: name.to_owned(),
            declared_type: declared_type.to_owned(),
            kind: error::base_type(&typed.name),
        })
    })
}

fn read_kind(typed: &Element, inherited: Option<&Element>) -> Result<Kind, Fault> {
    let real = |name: &str| match typed.parsed(name, "a number")? {
        None => inherited.map_or(Ok(None), |element| element.parsed::<f64>(name, "a number")),
        own => Ok(own),
    };
    let integer = |name: &str| match typed.parsed(name, "a whole number of 32 bits")? {
        None => {
            inherited.map_or(Ok(None), |element| element.parsed::<i32>(name, "a whole number of 32 bits"))
        }
        own => Ok(own),
    };
    match typed.name.as_str() {
        "Real" => {
            let kind = Kind::Real {
                start: typed.parsed("start", "a number")?,
                min: real("min")?,
                max: real("max")?,
            };
            check::finite(typed, &kind)?;
            Ok(kind)
        }
        "Integer" => Ok(Kind::Integer {
            start: typed.parsed("start", "a whole number of 32 bits")?,
            min: integer("min")?,
            max: integer("max")?,
        }),
        "Enumeration" => {
            typed.required("declaredType")?;
            Ok(Kind::Enumeration { start: typed.parsed("start", "a whole number of 32 bits")? })
        }
        "Boolean" => Ok(Kind::Boolean { start: boolean(typed)? }),
        "String" => Ok(Kind::String { start: typed.attribute("start").map(str::to_owned) }),
        found => Err(typed.fault(Problem::UnexpectedElement { expected: "Real", found: found.to_owned() })),
    }
}

/// XML Schema's booleans: true, false, 1 and 0.
fn boolean(typed: &Element) -> Result<Option<bool>, Fault> {
    match typed.attribute("start") {
        None => Ok(None),
        Some("true" | "1") => Ok(Some(true)),
        Some("false" | "0") => Ok(Some(false)),
        Some(value) => Err(typed.fault(Problem::BadValue {
            attribute: "start".to_owned(),
            value: value.to_owned(),
            expected: "true or false",
        })),
    }
}

fn read_enumerations(root: &Element) -> Result<Vec<EnumerationType>, Fault> {
    let types = root.child("TypeDefinitions").map_or(&[][..], |element| &element.children);
    let mut enumerations = Vec::new();
    for element in types {
        let name = element.required("name")?.to_owned();
        let Some(enumeration) = element.child("Enumeration") else { continue };
        let items = enumeration.children.iter().map(read_item).collect::<Result<Vec<_>, _>>()?;
        let description = element.attribute("description").unwrap_or_default().to_owned();
        enumerations.push(EnumerationType { line: element.line, name, description, items });
    }
    Ok(enumerations)
}

fn read_item(element: &Element) -> Result<Item, Fault> {
    element.required("value")?;
    Ok(Item {
        line: element.line,
        name: element.required("name")?.to_owned(),
        value: element.parsed("value", "a whole number of 32 bits")?.unwrap_or_default(),
        description: element.attribute("description").unwrap_or_default().to_owned(),
    })
}
