//! The paper's tables of damping ratios beside print.

use crate::comparison::unit_of;
use crate::reproduce::PaperTable;
use crate::reproduce::printed::{TABLE_3_RESTITUTION, TABLE_4, TABLE_5};
use crate::reproduce::tables::{TABLE_5_NUMBERS, table_3, table_4, table_5};
use crate::{Comparison, EvidenceError};

/// Place of the damping ratio in Table 5 that print does not make of Eq. (21): 0.352 to 0.354 there instead
/// of 0.350.
const CDR: usize = 3;

pub(super) fn tables() -> Result<Vec<Comparison>, EvidenceError> {
    // half a unit of the printed e, and e; Tables 3 and 5 print ratios and per cent
    let third = |index: usize| Some((0.005, TABLE_3_RESTITUTION.as_flattened()[index % 4]));
    let fourth = |index: usize| Some((0.0005, TABLE_4[index / 2].restitution[1]));
    let fifth = |index: usize| {
        let place = index % TABLE_5_NUMBERS;
        let half_unit = if place < 2 { 0.0 } else { 0.0005 };
        (place != CDR).then(|| (half_unit, TABLE_5[index / TABLE_5_NUMBERS].restitution[1]))
    };
    Ok(vec![worst(table_3(), third), worst(table_4(), fourth), worst(table_5()?, fifth)])
}

/// Returns the number of a table that takes most of its bound; `source` gives half a unit of e, and e.
fn worst(table: PaperTable, source: impl Fn(usize) -> Option<(f64, f64)>) -> Comparison {
    let bounded = table.rows.into_iter().enumerate().filter_map(|(index, row)| {
        let (half_unit, e) = source(index)?;
        // dξ/de = ξ/(e ln e)
        let from_e = if half_unit > 0.0 { row.computed * half_unit / (e * -libm::log(e)) } else { 0.0 };
        Some(Comparison {
            case: table.name.to_owned(),
            quantity: format!("{}: {}", row.case, row.quantity),
            unit: "as printed",
            allowed: unit_of(row.decimals?) + from_e,
            decimals: None,
            ..row
        })
    });
    let part = |row: &Comparison| row.error() / row.allowed;
    // the first of equal ones
    bounded.rev().max_by(|a, b| part(a).total_cmp(&part(b))).expect("a table has numbers")
}
