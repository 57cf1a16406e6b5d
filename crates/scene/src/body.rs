//! The tables of `[geometry]` that describe a body: parts, openings and loads, or given integrals.

use std::fmt;

use files::{Described, FileError, Schema, Tables, TomlFile, list, tables, with};
use rocking_wall::choices::Mechanism;
use rocking_wall::wall::{COMPUTED, Hollow, Item, Load, OF_RECTANGLE, Opening, Parameters, Part, Profile};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use toml::de::DeValue;
use toml::{Spanned, Value};

use crate::keys::Group;

/// The keys in `[geometry]` of parts, openings, loads and integrals.
pub(crate) const PART: &str = "part";
pub(crate) const OPENING: &str = "opening";
pub(crate) const LOAD: &str = "load";
pub(crate) const BODY: &str = "body";

/// The keys in `[geometry]` that stand in place of the parameters of a rectangle.
pub const BODIES: [&str; 2] = [PART, BODY];

/// The parameters of a rigid body, which `[geometry.body]` states.
pub const OF_BODY: [&str; 13] = [
    "body_mass",
    "centroid_height",
    "inertia",
    "arm",
    "arm_inner",
    "load_force",
    "load_height",
    "load_arm",
    "load_mass",
    "load_mass_height",
    "load_inertia",
    "thrust",
    "thrust_height",
];

/// A size that is constant, or changes linearly from the bottom to the top of a part.
#[derive(Clone, Copy, Debug)]
pub struct Ends(pub [f64; 2]);

tables! {
    /// A part of the masonry, from the base up.
    #[derive(Debug)]
    pub struct PartTable {
        /// Height of its lower edge above the base \[m\]; by default the top of the part before.
        #[key(minimum = 0, maximum = 1000)]
        pub base: Option<f64>,
        /// Height of the part \[m\].
        #[key(minimum = 0.001, maximum = 1000)]
        pub height: f64,
        /// Thickness, or that at the bottom and at the top \[m\].
        pub thickness: Ends,
        /// Length along the wall, or that at the bottom and at the top \[m\]; by default 1 m.
        pub width: Option<Ends>,
        /// Density \[kg/m³\].
        #[key(minimum = 1, maximum = 1e5, default = 1800)]
        pub density: Option<f64>,
        /// Outer face, inwards from that of the lowest part at its foot \[m\], or that at the bottom and at
        /// the top; by default 0.
        pub outer: Option<Ends>,
    }

    /// An opening or, with a thickness, a hollow.
    #[derive(Debug)]
    pub struct OpeningTable {
        /// Height of its lower edge above the base \[m\].
        #[key(minimum = 0, maximum = 1000)]
        pub base: f64,
        /// Height of the opening \[m\].
        #[key(exclusiveMinimum = 0, maximum = 1000)]
        pub height: f64,
        /// Length along the wall \[m\].
        #[key(exclusiveMinimum = 0, maximum = 1000)]
        pub width: f64,
        /// Thickness of a hollow \[m\]; by default the opening goes through the wall.
        #[key(exclusiveMinimum = 0, maximum = 100)]
        pub thickness: Option<f64>,
        /// Outer face of a hollow, inwards from that of the lowest part at its foot \[m\].
        pub outer: Option<f64>,
    }

    /// A load at a height.
    #[derive(Debug)]
    pub struct LoadTable {
        /// Force downwards \[N\]; 0 for a mass that moves along without resting on the wall.
        #[key(minimum = 0, maximum = 1e12)]
        pub force: f64,
        /// Height above the base \[m\].
        #[key(exclusiveMinimum = 0, maximum = 1000)]
        pub height: f64,
        /// Distance inwards from the outer face of the lowest part at its foot \[m\]. With \[geometry.body\]:
        /// from the outer hinge.
        #[key(minimum = -100, maximum = 100)]
        pub inside: f64,
        /// Share of force/g that moves along with the wall \[-\]; a check needs it.
        #[key(minimum = 0, maximum = 1, default = 0)]
        pub moving_mass: Option<f64>,
        /// Mass that moves along with the wall without resting on it \[kg\], with force = 0.
        #[key(minimum = 0, maximum = 1e12, default = 0)]
        pub mass: Option<f64>,
        /// Thrust, positive outwards \[N\].
        #[key(minimum = -1e12, maximum = 1e12, default = 0)]
        pub thrust: Option<f64>,
        /// Whether the thrust certainly lasts until collapse: a check counts it on the side that it helps.
        #[key(default = false)]
        pub thrust_lasts: Option<bool>,
    }

    /// A body that is given by its integrals, in place of parts.
    #[derive(Debug)]
    pub struct BodyTable {
        /// Mass \[kg\].
        #[key(minimum = 1e-6, maximum = 1e12)]
        pub mass: f64,
        /// Height of the centroid above the base \[m\], where u is measured.
        #[key(minimum = 0.0005, maximum = 1000)]
        pub centroid_height: f64,
        /// Integral of z² over the mass, from the base \[kg m²\].
        #[key(minimum = 1e-9, maximum = 1e18)]
        pub inertia: f64,
        /// Distance from the outer hinge to the centroid \[m\].
        #[key(minimum = 0, maximum = 100)]
        pub arm: f64,
        /// Distance from the inner hinge to the centroid \[m\]; by default as `arm`.
        #[key(minimum = 0, maximum = 100)]
        pub arm_inner: Option<f64>,
        /// Height of the top of the body \[m\].
        #[key(minimum = 0.001, maximum = 1000)]
        pub height: f64,
    }
}

impl<'de> Deserialize<'de> for Ends {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrTwo;

        #[allow(clippy::cast_precision_loss, reason = "larger whole numbers are beyond every limit too")]
        impl<'de> Visitor<'de> for OneOrTwo {
            type Value = Ends;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or [bottom, top]")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Ends, E> {
                Ok(Ends([value; 2]))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Ends, E> {
                Ok(Ends([value as f64; 2]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Ends, A::Error> {
                let mut next = || list.next_element::<f64>();
                match (next()?, next()?, next()?) {
                    (Some(bottom), Some(top), None) => Ok(Ends([bottom, top])),
                    _ => Err(A::Error::invalid_length(0, &self)),
                }
            }
        }

        deserializer.deserialize_any(OneOrTwo)
    }
}

impl Described for Ends {
    fn describe(_key: &str, tables: &mut Tables) -> Schema {
        let one = f64::describe("", tables);
        let two = <[f64; 2]>::describe("", tables);
        Schema::from_iter([("anyOf".to_owned(), Value::from(vec![Value::Table(one), Value::Table(two)]))])
    }
}

/// Adds to the schema of `[geometry]` what describes a body.
pub(crate) fn describe_body(members: &mut Schema, tables: &mut Tables) {
    let lists = [
        (PART, PartTable::describe(PART, tables), "Parts of the masonry, in place of one rectangle."),
        (OPENING, OpeningTable::describe(OPENING, tables), "Openings and hollows in the parts."),
        (LOAD, LoadTable::describe(LOAD, tables), "Loads on the parts or the body."),
    ];
    for (key, items, text) in lists {
        members.insert(key.into(), with(list(items), "description", text).into());
    }
    let text = "A body by its integrals, in place of parts.";
    members.insert(BODY.into(), with(BodyTable::describe(BODY, tables), "description", text).into());
}

/// Reads the body that the keys of `[geometry]` describe, if they describe one. The other keys of the table
/// have been applied.
///
/// # Errors
/// [`FileError`] of the key, the part, the opening or the load at fault.
pub(crate) fn apply_body(
    parameters: &mut Parameters,
    entries: &Group,
    file: &TomlFile<'_>,
) -> Result<(), FileError> {
    let place = file.place();
    let spans = [PART, OPENING, LOAD, BODY].map(|key| entries.get(key).map(Spanned::span));
    let [part, opening, load, body] = &spans;
    let Some(first) = [body, part, opening, load].into_iter().flatten().next() else { return Ok(()) };
    let refused = |message: &str| Err(place.error(first.clone(), message));
    match (part, body) {
        (Some(_), Some(_)) => {
            return refused("[geometry.body] stands in place of [[geometry.part]]; leave one of them out");
        }
        (None, None) => {
            return refused(
                "openings and loads are those of a wall of parts; give the wall as [[geometry.part]], or a \
                 load on the top of a rectangle as overburden",
            );
        }
        _ => {}
    }
    if let (Some(_), Some(opening)) = (body, opening) {
        let message = "[geometry.body] states the whole body; leave [[geometry.opening]] out";
        return Err(place.error(opening.clone(), message));
    }
    let stated = |names: &[&str]| entries.keys().find(|key| names.contains(&key.get_ref().as_str()));
    if let (Some(_), Some(key)) = (body, stated(&OF_BODY)) {
        let message = "follows from [geometry.body] and its loads; leave out one of them";
        return Err(place.error(key.span(), format!("{} {message}", key.get_ref())));
    }
    if let Some(key) = stated(&OF_RECTANGLE) {
        let name = key.get_ref();
        let message =
            format!("{name} is that of a rectangle; [[geometry.part]] or [geometry.body] states it");
        return Err(place.error(key.span(), message));
    }
    let loads = read::<LoadTable>(file, entries, LOAD)?;
    if body.is_some() {
        let integrals = read::<BodyTable>(file, entries, BODY)?;
        let loads: Vec<_> = loads.iter().map(|(_, load)| load.load()).collect();
        return integrals.iter().try_for_each(|(span, body)| {
            set_integrals(parameters, body, &loads).map_err(|message| place.error(span.clone(), message))
        });
    }
    let (parts, openings) = (read::<PartTable>(file, entries, PART)?, read(file, entries, OPENING)?);
    let profile = Profile::new(
        stacked(parts.iter().map(|(_, part)| part)),
        openings.iter().map(|(_, opening): &(_, OpeningTable)| opening.opening()).collect(),
        loads.iter().map(|(_, load)| load.load()).collect(),
    );
    let profile = profile.map_err(|error| {
        let span = match error.item {
            Item::Part(index) => parts.get(index).map(|(span, _)| span),
            Item::Opening(index) => openings.get(index).map(|(span, _)| span),
            Item::Load(index) => loads.get(index).map(|(span, _)| span),
        };
        place.error(span.unwrap_or(first).clone(), error.to_string())
    })?;
    for (span, opening) in &openings {
        if opening.thickness.is_none() && opening.outer.is_some() {
            let message = "outer is that of a hollow; give its thickness, too, or leave both out";
            return Err(place.error(span.clone(), message));
        }
    }
    parameters.set_profile(profile);
    Ok(())
}

type Span = std::ops::Range<usize>;

/// Reads the tables under a key of a group, each with its place.
fn read<T: serde::de::DeserializeOwned + Described>(
    file: &TomlFile<'_>,
    entries: &Group,
    key: &str,
) -> Result<Vec<(Span, T)>, FileError> {
    let Some(value) = entries.get(key) else { return Ok(Vec::new()) };
    let Some(own) = file.find(key, &value.span()) else { return Ok(Vec::new()) };
    let read = |table: &Spanned<DeValue<'_>>| {
        let read = file.read_value(table).map_err(|fault| file.place().error(fault.span, fault.message))?;
        Ok((table.span(), read))
    };
    match own.get_ref() {
        DeValue::Array(_) if key == BODY => {
            Err(file.place().error(own.span(), "[geometry.body] is one table; give one body"))
        }
        DeValue::Array(tables) => tables.iter().map(read).collect(),
        _ => Ok(vec![read(own)?]),
    }
}

/// Returns parts, each on top of the one before unless it states its base.
fn stacked<'a>(tables: impl Iterator<Item = &'a PartTable>) -> Vec<Part> {
    let mut top = 0.0;
    let one = Ends([1.0; 2]);
    tables
        .map(|table| {
            let part = Part {
                base: table.base.unwrap_or(top),
                height: table.height,
                thickness: table.thickness.0,
                width: table.width.unwrap_or(one).0,
                outer: table.outer.unwrap_or(Ends([0.0; 2])).0,
                density: table.density.unwrap_or(1800.0),
            };
            top = part.top();
            part
        })
        .collect()
}

impl OpeningTable {
    fn opening(&self) -> Opening {
        let Self { base, height, width, .. } = *self;
        let hollow = self.thickness.map(|thickness| Hollow { thickness, outer: self.outer.unwrap_or(0.0) });
        Opening { base, height, width, hollow }
    }
}

impl LoadTable {
    fn load(&self) -> Load {
        let Self { force, height, inside, moving_mass, .. } = *self;
        let [mass, thrust] = [self.mass, self.thrust].map(|given| given.unwrap_or(0.0));
        let thrust_lasts = self.thrust_lasts.unwrap_or(false);
        Load { moving_mass, mass, thrust, thrust_lasts, ..Load::resting(force, height, inside) }
    }
}

/// Sets a rigid body with the sums of its loads.
///
/// # Errors
/// A message for a strip, and for a load above the body.
fn set_integrals(parameters: &mut Parameters, body: &BodyTable, loads: &[Load]) -> Result<(), String> {
    if parameters.mechanism == Mechanism::VerticalSpanning {
        return Err("[geometry.body] is one body; a strip has two: give it as [[geometry.part]]".to_owned());
    }
    if let Some(above) = loads.iter().find(|load| load.height > body.height) {
        let (load, height) = (above.height, body.height);
        return Err(format!("a load at height = {load} m is above the body, height = {height} m"));
    }
    let p = parameters;
    let sum = |of: &dyn Fn(&Load) -> f64| loads.iter().map(of).sum::<f64>();
    let mean = |sum: f64, of: f64| if of == 0.0 { 0.0 } else { sum / of };
    let mass = |load: &Load| load.moving(p.gravity);
    let (force, moving, thrust) = (sum(&|l| l.force), sum(&mass), sum(&|l| l.thrust));
    let moment = sum(&|l| l.thrust * l.height);
    let thrust_height = mean(moment, thrust);
    if !(0.0..=body.height).contains(&thrust_height) || (thrust == 0.0 && moment != 0.0) {
        return Err(format!(
            "the thrusts add to {thrust} N with a moment of {moment} N m, which no single thrust on the body \
             has; give thrusts of one sign, or the body as [[geometry.part]]"
        ));
    }
    let [load_height, load_arm] =
        [sum(&|l| l.force * l.height), sum(&|l| l.force * l.inside)].map(|sum| mean(sum, force));
    let load_mass_height = mean(sum(&|l| mass(l) * l.height), moving);
    let load_inertia = sum(&|l| mass(l) * l.height * l.height);
    p.mechanism = Mechanism::RigidBody;
    p.height = body.height;
    (p.body_mass, p.centroid_height, p.inertia) = (body.mass, body.centroid_height, body.inertia);
    (p.arm, p.arm_inner) = (body.arm, body.arm_inner.unwrap_or(COMPUTED));
    (p.load_force, p.load_height, p.load_arm) = (force, load_height, load_arm);
    (p.load_mass, p.load_mass_height, p.load_inertia) = (moving, load_mass_height, load_inertia);
    (p.thrust, p.thrust_height) = (thrust, thrust_height);
    p.loads = Some(loads.into());
    Ok(())
}
