//! Start values.

use crate::access;
use crate::call::Phase;
use crate::model::Model;
use crate::variable::{Kind, VariableId};

/// Sets every parameter and input of `model` to the start value of its description.
///
/// A model that is instantiated this way has no second list of defaults.
pub fn set_start_values<M: Model>(model: &mut M) {
    for (id, kind) in settable::<M::Real>() {
        if let Kind::Real { start: Some(start), .. } = kind {
            model.set_real(id, start);
        }
    }
    for (id, kind) in settable::<M::Integer>() {
        if let Kind::Integer { start: Some(start), .. } | Kind::Enumeration { start: Some(start), .. } = kind
        {
            model.set_integer(id, start);
        }
    }
    for (id, kind) in settable::<M::Boolean>() {
        if let Kind::Boolean { start: Some(start) } = kind {
            model.set_boolean(id, start);
        }
    }
    for (id, kind) in settable::<M::Text>() {
        if let Kind::String { start: Some(start) } = kind {
            model.set_text(id, start);
        }
    }
}

/// The variables that can be set before initialisation.
fn settable<V: VariableId>() -> impl Iterator<Item = (V, Kind)> {
    let all = V::ALL.iter().map(|&id| (id, id.variable()));
    all.filter(|(_, variable)| access::is_settable(variable, Phase::Instantiated))
        .map(|(id, variable)| (id, variable.kind))
}
