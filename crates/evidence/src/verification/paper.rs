//! The paper's tables of damping ratios beside print.

use super::error::VerificationError;
use super::formula::{Check, Formula};
use crate::reproduce::tables::{table_3, table_4, table_5};
use crate::reproduce::{Cell, Table, Value};

/// Damping ratios in Table 5 that print does not make of Eq. (21): 0.352 to 0.354 there instead of 0.350.
const COLUMN_OF_CDR: usize = 8;

pub(super) fn tables() -> Result<Formula, VerificationError> {
    let number = |cell: &Cell| match cell {
        Cell::Text(text) => text.parse().unwrap_or(f64::NAN),
        Cell::Value(value) => value.printed,
    };
    // half a unit of the printed e, and e; Tables 3 and 5 print ratios and per cent
    let third = |_: &[Cell], column: usize| match column {
        2 => (0.005, 0.84),
        3 => (0.005, 0.87),
        5 => (0.005, 0.61),
        _ => (0.005, 0.74),
    };
    let fourth = |row: &[Cell], _: usize| (0.0005, number(&row[4]));
    let fifth = |row: &[Cell], column: usize| (if column < 7 { 0.0 } else { 0.0005 }, number(&row[6]));
    Ok(Formula::new(
        [
            "Tables 3, 4 and 5 of the paper",
            "damping",
            "Eqs. (2), (3), (14) and (20) to (22) of the paper's walls. The column CDR of Table 5 is left \
             out: print was made with 0.352 to 0.354 in Eq. (21), which prints 0.350",
            "the printed numbers; shown is the one that takes most of its bound",
            "one unit of the last digit, as print is cut off in places, and half a unit of the printed e in \
             ln e",
        ],
        vec![worst(&table_3(), third), worst(&table_4(), fourth), worst(&table_5()?, fifth)],
    ))
}

/// Returns the number of a table that takes most of its bound; `source` gives half a unit of e, and e.
fn worst(table: &Table, source: impl Fn(&[Cell], usize) -> (f64, f64)) -> Check {
    let is_left_out = |column: usize| table.name == "Table 5" && column == COLUMN_OF_CDR;
    let mut worst: Option<Check> = None;
    for row in &table.rows {
        for (column, cell) in row.iter().enumerate() {
            let Cell::Value(Value { computed, printed, decimals }) = *cell else { continue };
            if is_left_out(column) {
                continue;
            }
            let (half_unit, e) = source(row, column);
            // dξ/de = ξ/(e ln e)
            let unit = libm::pow(10.0, -(decimals as f64));
            let bound = unit + if half_unit > 0.0 { computed * half_unit / (e * -libm::log(e)) } else { 0.0 };
            let name = match &row[0] {
                Cell::Text(name) => format!("{name}: {}", table.columns[column]),
                Cell::Value(_) => table.columns[column].to_owned(),
            };
            let check = Check {
                scale: 1.0,
                ..Check::of((table.name, &name, "as printed"), [computed, printed], bound)
            };
            let part = |check: &Check| check.error().unwrap_or(f64::INFINITY) / check.bound;
            if worst.as_ref().is_none_or(|worst| part(worst) < part(&check)) {
                worst = Some(check);
            }
        }
    }
    worst.expect("a table has numbers")
}
