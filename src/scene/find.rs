//! Finds values of a document by their places.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Finds the value of a key in a document by its place.
pub(super) fn find<'a, 'b>(
    table: &'a DeTable<'b>,
    key: &str,
    span: &Range<usize>,
) -> Option<&'a Spanned<DeValue<'b>>> {
    fn inside<'a, 'b>(
        value: &'a Spanned<DeValue<'b>>,
        key: &str,
        span: &Range<usize>,
    ) -> Option<&'a Spanned<DeValue<'b>>> {
        match value.get_ref() {
            DeValue::Table(table) => find(table, key, span),
            DeValue::Array(items) => items.iter().find_map(|item| inside(item, key, span)),
            _ => None,
        }
    }
    let own = table.iter().find(|(own, value)| own.get_ref() == key && value.span() == *span);
    own.map(|(_, value)| value).or_else(|| table.values().find_map(|value| inside(value, key, span)))
}
