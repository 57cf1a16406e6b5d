//! Variables and enumerations, as a description declares them.

use crate::condition::{self, Alternative};
use crate::element::Element;
use crate::error::Fault;

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
    /// The unit of the variable or else of its type.
    pub(crate) unit: Option<String>,
    pub(crate) display_unit: Option<String>,
    /// 1-based index of the variable this is the derivative of.
    pub(crate) derivative: Option<usize>,
    /// The name in an annotation `<Group name="…"/>`.
    pub(crate) group: Option<String>,
    /// Where it matters; everywhere if there are none.
    pub(crate) conditions: Vec<Alternative>,
    pub(crate) kind: Kind,
}

/// FMI base type with start value and limits; limits that the variable does not have are those of its type.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Real { start: Option<f64>, min: Option<f64>, max: Option<f64> },
    Integer { start: Option<i32>, min: Option<i32>, max: Option<i32> },
    Enumeration { start: Option<i32> },
    Boolean { start: Option<bool> },
    String { start: Option<String> },
}

/// The four types that FMI 2.0 has get and set functions for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BaseType {
    Real,
    Integer,
    Boolean,
    String,
}

impl BaseType {
    pub(crate) const ALL: [Self; 4] = [Self::Real, Self::Integer, Self::Boolean, Self::String];
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
    /// Who determines a variable.
    Causality: "a causality" {
        Parameter = "parameter", CalculatedParameter = "calculatedParameter", Input = "input",
        Output = "output", Local = "local", Independent = "independent",
    }
}
named! {
    /// When a variable may change.
    Variability: "a variability" {
        Constant = "constant", Fixed = "fixed", Tunable = "tunable", Discrete = "discrete",
        Continuous = "continuous",
    }
}
named! {
    /// Where the start value comes from.
    Initial: "exact, approx or calculated" { Exact = "exact", Approx = "approx", Calculated = "calculated" }
}

impl Variable {
    /// Reads one element of the `<ModelVariables>` of `root`.
    pub(crate) fn read(root: &Element, element: &Element) -> Result<Self, Fault> {
        element.expect("ScalarVariable")?;
        let name = element.required("name")?.to_owned();
        element.required("valueReference")?;
        let typed = element
            .children
            .iter()
            .find(|child| child.name != "Annotations")
            .ok_or_else(|| element.missing("Real"))?;
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
        let tools = || element.children_of("Annotations").iter();
        let group = tools().find_map(|tool| tool.child("Group")?.attribute("name"));
        Ok(Self {
            line: element.line,
            reference: element.parsed("valueReference", "a value reference")?.unwrap_or_default(),
            description: element.attribute("description").unwrap_or_default().to_owned(),
            causality: element.parsed("causality", Causality::EXPECTED)?.unwrap_or(Causality::Local),
            variability: element
                .parsed("variability", Variability::EXPECTED)?
                .unwrap_or(Variability::Continuous),
            initial: element.parsed("initial", Initial::EXPECTED)?,
            unit: text("unit"),
            display_unit: text("displayUnit"),
            derivative: typed.parsed("derivative", "an index")?,
            group: group.map(str::to_owned),
            conditions: condition::read(tools()),
            kind: Kind::read(typed, inherited)?,
            name,
            declared_type,
        })
    }

    /// The type of the functions that get and set it: enumerations are got and set as Integers.
    pub(crate) fn base(&self) -> BaseType {
        match self.kind {
            Kind::Real { .. } => BaseType::Real,
            Kind::Integer { .. } | Kind::Enumeration { .. } => BaseType::Integer,
            Kind::Boolean { .. } => BaseType::Boolean,
            Kind::String { .. } => BaseType::String,
        }
    }

    /// The items of its type, if that is an enumeration.
    pub(crate) fn items<'a>(&self, enumerations: &'a [EnumerationType]) -> &'a [Item] {
        let declared = enumerations.iter().find(|of_type| Some(&of_type.name) == self.declared_type.as_ref());
        declared.map_or(&[], |enumeration| &enumeration.items)
    }

    /// Its `initial`, which follows from causality and variability where the description leaves it out.
    pub(crate) fn initial_or_default(&self) -> Option<Initial> {
        self.initial.or(match (self.causality, self.variability) {
            (Causality::Input | Causality::Independent, _) => None,
            (Causality::Parameter, _) | (_, Variability::Constant) => Some(Initial::Exact),
            _ => Some(Initial::Calculated),
        })
    }

    /// A problem on its line.
    pub(crate) fn fault(&self, problem: impl Into<String>) -> Fault {
        Fault::new(self.line, problem)
    }
}

/// The element inside the `<SimpleType>` called `name`.
pub(crate) fn simple_type<'a>(root: &'a Element, name: &str, base: &str) -> Option<&'a Element> {
    let mut types = root.children_of("TypeDefinitions").iter();
    types.find(|element| element.attribute("name") == Some(name))?.child(base)
}

/// The type that the variable `name` declares, which must be of the same FMI base type as the variable.
fn type_of<'a>(
    root: &'a Element,
    name: &str,
    declared_type: &str,
    typed: &Element,
) -> Result<&'a Element, Fault> {
    simple_type(root, declared_type, &typed.name).ok_or_else(|| {
        let article = if typed.name.starts_with(['E', 'I']) { "an" } else { "a" };
        let expected = format!("is not declared in TypeDefinitions as {article} {}", typed.name);
        typed.fault(format!("the type `{declared_type}` of `{name}` {expected}"))
    })
}

impl Kind {
    fn read(typed: &Element, inherited: Option<&Element>) -> Result<Self, Fault> {
        let real = |name: &str| {
            let value: Option<f64> = own_or_inherited(typed, inherited, name, "a number")?;
            // Importers write these as text, and infinity has several spellings.
            match value.filter(|value| !value.is_finite()) {
                Some(value) => Err(typed.bad_value(name, &value.to_string(), "a finite number")),
                None => Ok(value),
            }
        };
        let whole = |name: &str| own_or_inherited(typed, inherited, name, "a whole number of 32 bits");
        match typed.name.as_str() {
            "Real" => Ok(Self::Real { start: real("start")?, min: real("min")?, max: real("max")? }),
            "Integer" => Ok(Self::Integer { start: whole("start")?, min: whole("min")?, max: whole("max")? }),
            "Enumeration" => {
                typed.required("declaredType")?;
                Ok(Self::Enumeration { start: whole("start")? })
            }
            "Boolean" => Ok(Self::Boolean { start: boolean(typed)? }),
            "String" => Ok(Self::String { start: typed.attribute("start").map(str::to_owned) }),
            _ => Err(typed.unexpected("Real")),
        }
    }
}

/// The value of the attribute `name` of a variable, or else of its type, which has no `start`.
fn own_or_inherited<T: std::str::FromStr>(
    typed: &Element,
    inherited: Option<&Element>,
    name: &str,
    expected: &'static str,
) -> Result<Option<T>, Fault> {
    let of = [Some(typed), inherited].into_iter().flatten().find(|element| element.attribute(name).is_some());
    of.map_or(Ok(None), |element| element.parsed(name, expected))
}

/// The start value of a Boolean: XML Schema writes it as true, false, 1 or 0.
fn boolean(typed: &Element) -> Result<Option<bool>, Fault> {
    match typed.attribute("start") {
        None => Ok(None),
        Some("true" | "1") => Ok(Some(true)),
        Some("false" | "0") => Ok(Some(false)),
        Some(value) => Err(typed.bad_value("start", value, "true or false")),
    }
}

impl EnumerationType {
    /// The enumerations among the `<TypeDefinitions>` of `root`.
    pub(crate) fn read_all(root: &Element) -> Result<Vec<Self>, Fault> {
        let mut enumerations = Vec::new();
        for element in root.children_of("TypeDefinitions") {
            let name = element.required("name")?.to_owned();
            let Some(enumeration) = element.child("Enumeration") else { continue };
            let items = enumeration.children.iter().map(Item::read).collect::<Result<_, _>>()?;
            let description = element.attribute("description").unwrap_or_default().to_owned();
            enumerations.push(Self { line: element.line, name, description, items });
        }
        Ok(enumerations)
    }
}

impl Item {
    fn read(element: &Element) -> Result<Self, Fault> {
        element.required("value")?;
        Ok(Self {
            line: element.line,
            name: element.required("name")?.to_owned(),
            value: element.parsed("value", "a whole number of 32 bits")?.unwrap_or_default(),
            description: element.attribute("description").unwrap_or_default().to_owned(),
        })
    }
}
