//! Tables for Python: columns by their names.

use std::borrow::Cow;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::{Cell, Column, Table};

/// Columns that grow table by table.
#[derive(Default)]
pub(crate) struct Columns(Vec<Named>);

/// A column with a name: its place in the rows, the name and the values.
struct Named(usize, Cow<'static, str>, Values);

enum Values {
    Names(Vec<String>),
    Numbers(Vec<f64>),
    Counts(Vec<i64>),
    Flags(Vec<bool>),
}

/// Makes a table for Python: names as lists, the others as arrays of their type.
pub(crate) fn table(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyDict>> {
    let mut columns = Columns::default();
    columns.add(table);
    columns.dict(py)
}

impl Columns {
    /// Adds the rows of a table with the same columns.
    pub(crate) fn add(&mut self, table: Table) {
        let Table { columns, rows } = table;
        if self.0.is_empty() {
            let named = |(place, column): (usize, Column)| {
                let is = |of: fn(&Cell<'_>) -> bool| rows.iter().map(|row| &row[place]).all(of);
                let values = if column.is_text || !is(|cell| !matches!(cell, Cell::Text(_))) {
                    Values::Names(Vec::new())
                } else if !rows.is_empty() && is(|cell| matches!(cell, Cell::Count(_))) {
                    Values::Counts(Vec::new())
                } else if !rows.is_empty() && is(|cell| matches!(cell, Cell::Flag(_))) {
                    Values::Flags(Vec::new())
                } else {
                    Values::Numbers(Vec::new())
                };
                (!column.name.is_empty()).then_some(Named(place, column.name, values))
            };
            self.0 = columns.into_iter().enumerate().filter_map(named).collect();
        }
        for row in &rows {
            self.0.iter_mut().for_each(|Named(place, _, values)| values.push(&row[*place]));
        }
    }

    /// Returns the columns by their names.
    pub(crate) fn dict(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let table = PyDict::new(py);
        for Named(_, name, values) in self.0 {
            match values {
                Values::Names(names) => table.set_item(name, names)?,
                Values::Numbers(numbers) => table.set_item(name, PyArray1::from_vec(py, numbers))?,
                Values::Counts(counts) => table.set_item(name, PyArray1::from_vec(py, counts))?,
                Values::Flags(flags) => table.set_item(name, PyArray1::from_vec(py, flags))?,
            }
        }
        Ok(table)
    }
}

impl Values {
    /// Adds a cell: a number that is not known is NaN, and one that is above the levels infinite.
    fn push(&mut self, cell: &Cell<'_>) {
        match (self, cell) {
            (Self::Names(names), Cell::Text(name)) => names.push(name.clone().into_owned()),
            (Self::Names(names), Cell::Empty) => names.push(String::new()),
            (Self::Numbers(numbers), Cell::Number(number) | Cell::Rounded(number, _)) => {
                numbers.push(*number);
            }
            (Self::Numbers(numbers), Cell::Empty) => numbers.push(f64::NAN),
            (Self::Numbers(numbers), Cell::Between([least, most])) => {
                let is_known = least == most || *most == f64::INFINITY;
                numbers.push(if is_known { *most } else { f64::NAN });
            }
            #[allow(clippy::cast_possible_wrap, reason = "nothing is counted up to 2⁶³")]
            (Self::Counts(counts), Cell::Count(count)) => counts.push(*count as i64),
            (Self::Flags(flags), Cell::Flag(flag)) => flags.push(*flag),
            _ => unreachable!("the cells of a column are alike"),
        }
    }
}
