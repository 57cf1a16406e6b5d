//! Tables as data: each number beside the one in print.

/// A table of the paper, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Such as "Table 5".
    pub name: &'static str,
    /// What it holds.
    pub title: &'static str,
    /// Where print cannot be matched and why, what was assumed.
    pub notes: Vec<String>,
    /// Heads of the columns.
    pub columns: Vec<&'static str>,
    /// The rows, as long as the heads.
    pub rows: Vec<Vec<Cell>>,
}

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Words, or a number that is only given.
    Words(String),
    /// A number computed now.
    Value(Value),
}

/// A number computed now, beside print.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Computed now.
    pub ours: f64,
    /// In print; `None` where the paper has no such number.
    pub printed: Option<f64>,
    /// Decimals in print.
    pub decimals: usize,
}

impl Value {
    /// Ours minus print.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        self.printed.map(|printed| self.ours - printed)
    }

    /// Whether ours rounds to print: within half a unit of its last digit, and 1e-9 of it for ties.
    #[must_use]
    pub fn agrees(&self) -> Option<bool> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "a few decimals")]
        let unit = 10.0_f64.powi(-(self.decimals as i32));
        self.deviation().map(|deviation| deviation.abs() <= (0.5 + 1e-9) * unit)
    }
}

impl Cell {
    /// Words.
    #[must_use]
    pub fn words(text: impl Into<String>) -> Self {
        Self::Words(text.into())
    }

    /// A number beside print.
    #[must_use]
    pub fn value(ours: f64, printed: f64, decimals: usize) -> Self {
        Self::Value(Value { ours, printed: Some(printed), decimals })
    }

    /// A number without a counterpart in print.
    #[must_use]
    pub fn ours(ours: f64, decimals: usize) -> Self {
        Self::Value(Value { ours, printed: None, decimals })
    }
}

impl Table {
    /// All numbers that have a counterpart in print.
    pub fn values(&self) -> impl Iterator<Item = &Value> {
        self.rows.iter().flatten().filter_map(|cell| match cell {
            Cell::Value(value) if value.printed.is_some() => Some(value),
            _ => None,
        })
    }
}
