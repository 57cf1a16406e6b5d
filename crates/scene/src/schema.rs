//! JSON schemas of what the model description declares: parameters by their groups, and the bar of a tie.

use files::{Described, Groups, Schema, Tables, list, names, object, one_of, positive, several, with};
use fmu_export::{Kind, Variable, VariableId};
use rocking_wall::variables::{GROUPS, IntegerVariable, RealVariable};
use rocking_wall::wall::{Bar, BarNumber, Kinematics};
use toml::Value;

use crate::body::{BODY, LOAD, OPENING, PART, describe_body};
use crate::curve::CurveTable;
use crate::keys::{
    BAR, Group, KINEMATICS, KINEMATICS_GROUP, MOST_TIES, MULTILINEAR, POINTS, TIE_GROUP, TieTables,
};

/// Returns the keys of the groups that who applies a group checks, and knows the place of.
pub(crate) fn groups() -> Groups {
    let mut groups: Groups = GROUPS.iter().map(|(group, names)| (*group, names.to_vec())).collect();
    groups.entry("force_law").or_default().extend(names::<CurveTable>());
    groups.entry(KINEMATICS_GROUP).or_default().extend([KINEMATICS, PART, OPENING, LOAD, BODY]);
    groups
}

impl Described for Group {
    const OPTIONAL: bool = true;

    fn describe(key: &str, tables: &mut Tables) -> Schema {
        tables.groups.extend(groups());
        let mut members = parameters(key);
        if key == KINEMATICS_GROUP {
            describe_body(&mut members, tables);
        }
        if key == "force_law" {
            // its keys stand in the group
            CurveTable::describe(key, tables);
            let keys = tables.schemas.remove("CurveTable").and_then(|curve| curve.get("properties").cloned());
            members.extend(keys.and_then(|keys| keys.as_table().cloned()).unwrap_or_default());
        }
        object(members)
    }
}

impl Described for TieTables {
    const OPTIONAL: bool = true;

    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let one = Group::describe(key, tables);
        let most = i64::try_from(MOST_TIES).unwrap_or(i64::MAX);
        let several = with(with(list(one.clone()), "minItems", 1), "maxItems", most);
        with(Schema::new(), "anyOf", vec![Value::Table(one), Value::Table(several)])
    }
}

/// A bar as the table of a file: [`Bar`] belongs to a crate that reads no files.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(transparent)]
pub struct BarTable(pub Bar);

impl Described for BarTable {
    fn describe(_key: &str, _tables: &mut Tables) -> Schema {
        bar()
    }
}

/// Describes the parameters of a group, and what only scenes know: kinematics, and a law of points.
pub fn parameters(group: &str) -> Schema {
    let names = GROUPS.iter().find(|(name, _)| *name == group).map_or(&[][..], |(_, names)| *names);
    let mut members: Schema =
        names.iter().filter_map(|name| Some(((*name).to_owned(), parameter(variable(name)?)?))).collect();
    if group == TIE_GROUP {
        members.insert(BAR.into(), bar().into());
    }
    if group == KINEMATICS_GROUP {
        let text = "Small rotations, or full ones (rigid_linear without damping).";
        let choice = with(one_of(Kinematics::ALL.map(Kinematics::name)), "description", text);
        members.insert(KINEMATICS.into(), with(choice, "default", Kinematics::default().name()).into());
    }
    let laws = members.get_mut("force_law").and_then(|law| law.get_mut("enum")?.as_array_mut());
    if let Some(laws) = laws {
        laws.push(MULTILINEAR.into());
        let text = "Corners [u/u_ins, F/F0] of a multilinear law without the origin; both sides are alike \
                    unless some have u < 0.";
        let points = with(list(several(2, number())), "minItems", 2);
        members.insert(POINTS.into(), with(points, "description", text).into());
    }
    members
}

fn number() -> Schema {
    with(Schema::new(), "type", "number")
}

/// Describes the bar of a tie.
fn bar() -> Schema {
    let describe = |number: BarNumber| {
        let unit = Some(number.usual.unit).filter(|unit| !unit.is_empty());
        let text = format!("{}{}", number.text, unit.map_or(String::new(), |unit| format!(" [{unit}]")));
        (number.key().to_owned(), with(positive(), "description", text).into())
    };
    let required = Bar::NUMBERS.iter().filter(|number| number.is_required).map(BarNumber::key);
    let bar = with(
        object(Bar::NUMBERS.map(describe).into_iter().collect()),
        "required",
        required.collect::<Vec<_>>(),
    );
    with(
        bar,
        "description",
        "The tie as it is built, in place of tie_stiffness, tie_strength and tie_ultimate.",
    )
}

/// Returns the variable of the model description with a name: a number, or a choice.
pub fn variable(name: &str) -> Option<&'static Variable> {
    let real = RealVariable::from_name(name).map(VariableId::variable);
    real.or_else(|| IntegerVariable::from_name(name).map(VariableId::variable))
}

/// Describes a parameter of a model description; `None` for what has no number or choice.
pub fn parameter(variable: &Variable) -> Option<Value> {
    let unit = variable.unit.map_or(String::new(), |unit| format!(" [{unit}]"));
    let schema = match variable.kind {
        Kind::Real { start, min, max } => {
            let mut number = number();
            let limits = [("default", start), ("minimum", min), ("maximum", max)];
            number.extend(limits.into_iter().filter_map(|(word, x)| Some((word.to_owned(), x?.into()))));
            number
        }
        Kind::Enumeration { start, items } => {
            let mut choice = one_of(items.iter().map(|item| item.name));
            let default = items.iter().find(|item| Some(item.value) == start);
            choice.extend(default.map(|item| ("default".to_owned(), item.name.into())));
            choice
        }
        _ => return None,
    };
    Some(with(schema, "description", format!("{}{unit}", variable.description)).into())
}
