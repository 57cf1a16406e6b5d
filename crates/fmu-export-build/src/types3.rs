//! The types of an FMI 3.0 description: those of the FMI 2.0 one, and what its Real variables say themselves.

use crate::element::Element;

/// What only the type of a Real says in FMI 3.0. The standard allows it on variables too, but fmi-schema 0.8
/// refuses it there, and every importer looks in the type.
const OF_TYPES: [&str; 6] = ["quantity", "unit", "displayUnit", "relativeQuantity", "unbounded", "nominal"];
/// The types of variables that declare none, and of the time.
const UNDECLARED: &str = "Number";
const TIME: &str = "Time";

/// The types of a description. Its variables complete them.
pub(crate) struct Types {
    /// As the FMI 2.0 description declares them.
    declared: Vec<Element>,
    written: Vec<Written>,
    /// Names that no type can have.
    variables: Vec<String>,
}

struct Written {
    kind: Element,
    /// The name of the type that it is a variant of.
    origin: String,
    /// A variable is of this type.
    is_used: bool,
}

impl Types {
    /// The types in `<TypeDefinitions>` of a description whose variables have the names `variables`.
    pub(crate) fn new(definitions: &[Element], variables: Vec<String>) -> Self {
        let declared: Vec<_> = definitions.iter().filter_map(type_definition).collect();
        let written = declared.iter().map(|kind| {
            let origin = name(kind).to_owned();
            Written { kind: kind.clone(), origin, is_used: false }
        });
        Self { written: written.collect(), declared, variables }
    }

    /// The name of the type of the element `<Real>` of a variable; none if that says nothing of its type.
    ///
    /// The first variable of a type completes it. Each one that says something else has a variant.
    pub(crate) fn of_real(&mut self, real: &Element) -> Option<String> {
        let declared = real.attribute("declaredType");
        let own: Vec<_> = OF_TYPES.into_iter().filter_map(|key| Some((key, real.attribute(key)?))).collect();
        if declared.is_none() && own.is_empty() {
            return None;
        }
        let origin = declared.unwrap_or(UNDECLARED);
        let known = self.declared.iter().find(|kind| Some(name(kind)) == declared).cloned();
        let mut kind = known.unwrap_or_else(|| float_type(origin));
        for (key, value) in own {
            kind.set_attribute(key, value);
        }
        Some(self.variant(origin, kind))
    }

    /// The name of the type of the time \[s\], after those of all variables.
    pub(crate) fn of_time(&mut self) -> String {
        let in_seconds = |kind: &Element| name(kind) == TIME && kind.attribute("unit") == Some("s");
        if self.written.iter().any(|written| in_seconds(&written.kind)) {
            return TIME.to_owned();
        }
        let mut kind = float_type(TIME);
        kind.set_attribute("unit", "s");
        self.variant(TIME, kind)
    }

    /// The types, in the order of the FMI 2.0 description, each with its variants.
    pub(crate) fn into_elements(self) -> Vec<Element> {
        self.written.into_iter().map(|written| written.kind).collect()
    }

    /// The name of the type that says the same as `kind`, one of those that follow from `origin`.
    fn variant(&mut self, origin: &str, mut kind: Element) -> String {
        let says = |kind: &Element| OF_TYPES.map(|key| kind.attribute(key).map(str::to_owned));
        let wanted = says(&kind);
        let of_origin = |written: &&mut Written| written.origin == origin;
        for written in self.written.iter_mut().filter(of_origin) {
            if !written.is_used || says(&written.kind) == wanted {
                let name = name(&written.kind).to_owned();
                kind.set_attribute("name", name.as_str());
                *written = Written { kind, origin: origin.to_owned(), is_used: true };
                return name;
            }
        }
        let name = self.free_name(origin);
        kind.set_attribute("name", name.as_str());
        let at = self.written.iter().rposition(|written| written.origin == origin);
        let at = at.map_or(self.written.len(), |last| last + 1);
        self.written.insert(at, Written { kind, origin: origin.to_owned(), is_used: true });
        name
    }

    /// `origin`, or else the first of `origin_2`, `origin_3`, … that no type and no variable has.
    fn free_name(&self, origin: &str) -> String {
        let is_free = |wanted: &String| {
            let types = self.written.iter().map(|written| name(&written.kind));
            types.chain(self.variables.iter().map(String::as_str)).all(|taken| taken != wanted)
        };
        let numbered = (2_u64..).map(|number| format!("{origin}_{number}"));
        std::iter::once(origin.to_owned()).chain(numbered).find(is_free).unwrap_or_default()
    }
}

/// `<SimpleType>` and the element inside become one element, without its description: `FMPy` up to 0.3.22,
/// and what builds on it, refuses a type that has one.
fn type_definition(simple: &Element) -> Option<Element> {
    let inner = simple.children.first()?;
    let mut written = Element { name: format!("{}Type", type_name(&inner.name)), ..simple.clone() };
    written.attributes.retain(|(name, _)| name != "description");
    written.attributes.extend(inner.attributes.iter().cloned());
    written.children.clone_from(&inner.children);
    Some(written)
}

/// FMI 3.0's name of a type of FMI 2.0.
pub(crate) fn type_name(name: &str) -> &str {
    match name {
        "Real" => "Float64",
        "Integer" => "Int32",
        other => other,
    }
}

/// Returns whether `attribute` of a Real stands in its type.
pub(crate) fn is_of_type(attribute: &str) -> bool {
    attribute == "declaredType" || OF_TYPES.contains(&attribute)
}

fn float_type(name: &str) -> Element {
    Element::new("Float64Type", &[("name", name)])
}

fn name(kind: &Element) -> &str {
    kind.attribute("name").unwrap_or_default()
}
