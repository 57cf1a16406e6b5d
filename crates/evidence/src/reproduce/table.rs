//! Tables as data: each computed number beside the printed one.

/// A table of the paper, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name, such as "Table 5".
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Assumptions, and why some numbers do not match print.
    pub notes: Vec<String>,
    /// Heads of the columns.
    pub columns: Vec<&'static str>,
    /// Rows, each with a cell for each column.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A text, or a number that is given and not computed.
    Text(String),
    /// A computed number.
    Value(Value),
}

/// A computed number beside the printed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Computed number.
    pub computed: f64,
    /// Printed number.
    pub printed: f64,
    /// Decimals in print.
    pub decimals: usize,
}

impl Value {
    /// Returns the computed number minus the printed one.
    pub fn deviation(&self) -> f64 {
        self.computed - self.printed
    }

    /// Returns whether the computed number rounds to the printed one. They may differ by half a unit of the
    /// last printed digit, and by 1e-9 of that unit more for ties.
    pub fn agrees(&self) -> bool {
        #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "a few decimals")]
        let unit = 10.0_f64.powi(-(self.decimals as i32));
        self.deviation().abs() <= (0.5 + 1e-9) * unit
    }
}

impl Cell {
    /// Creates a cell of text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// Creates a cell of a computed number beside the printed one.
    pub fn value(computed: f64, printed: f64, decimals: usize) -> Self {
        Self::Value(Value { computed, printed, decimals })
    }
}

/// Splits a line of column heads at " | ".
pub(super) fn columns(heads: &'static str) -> Vec<&'static str> {
    heads.split(" | ").collect()
}

impl Table {
    /// Returns all computed numbers.
    pub fn values(&self) -> impl Iterator<Item = &Value> {
        self.rows.iter().flatten().filter_map(|cell| match cell {
            Cell::Value(value) => Some(value),
            Cell::Text(_) => None,
        })
    }

    /// Counts the computed numbers: those that agree with print, and all.
    pub fn counts(&self) -> [usize; 2] {
        [self.values().filter(|value| value.agrees()).count(), self.values().count()]
    }
}
