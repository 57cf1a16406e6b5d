//! Tables laid over others.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Lays a table over another, key by key.
pub fn overlay<'a>(base: &mut DeTable<'a>, patch: &DeTable<'a>) {
    for (key, value) in patch {
        let below = base.get_mut(key).map(Spanned::get_mut);
        if let (Some(DeValue::Table(below)), DeValue::Table(patch)) = (below, value.get_ref()) {
            overlay(below, patch);
        } else {
            base.remove(key);
            base.insert(key.clone(), value.clone());
        }
    }
}

/// Moves the places of a value by some bytes.
pub(crate) fn shift(value: &mut Spanned<DeValue<'_>>, by: usize) {
    let place = value.span();
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| shift(value, by)),
        DeValue::Array(array) => array.iter_mut().for_each(|value| shift(value, by)),
        _ => {}
    }
    let inner = std::mem::replace(value.get_mut(), DeValue::Boolean(false));
    *value = Spanned::new(place.start + by..place.end + by, inner);
}
