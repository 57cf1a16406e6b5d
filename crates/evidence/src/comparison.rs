//! The row of every table of evidence: what is compared, the computed and the given number, and the
//! difference that is allowed.
//!
//! ```
//! use evidence::Comparison;
//!
//! // 0.0298 is printed as 0.030: half a unit of the last decimal is allowed
//! let printed = Comparison::printed("P7-(C)", "ξ", [0.0298, 0.030], 3);
//! assert!(printed.passes() && !Comparison::printed("P7-(C)", "ξ", [0.0298, 0.029], 3).passes());
//! ```

use report::table::{Cell, Digits, Table};

/// A computed number beside a given one: a reference, a printed number, or the limit of a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Scene, wall or example.
    pub case: String,
    /// What is compared, or what happens in the case.
    pub quantity: String,
    /// Unit of the quantity.
    pub unit: &'static str,
    /// Computed number.
    pub computed: f64,
    /// Given number, which the computed one should be.
    pub given: f64,
    /// What the difference is divided by, in the unit of the quantity.
    pub scale: f64,
    /// Largest difference over the scale that passes \[-\].
    pub allowed: f64,
    /// Decimals of a printed number.
    pub decimals: Option<usize>,
}

impl Comparison {
    /// Compares a number with a reference, relative to the reference.
    pub fn new(
        case: impl Into<String>,
        quantity: impl Into<String>,
        unit: &'static str,
        [computed, given]: [f64; 2],
        allowed: f64,
    ) -> Self {
        let (case, quantity, scale) = (case.into(), quantity.into(), given.abs());
        Self { case, quantity, unit, computed, given, scale, allowed, decimals: None }
    }

    /// Compares a number with a printed one, to which it should round: they may differ by half a unit of the
    /// last decimal, and by 1e-9 of that unit more for ties.
    pub fn printed(
        case: impl Into<String>,
        quantity: impl Into<String>,
        numbers: [f64; 2],
        decimals: usize,
    ) -> Self {
        let allowed = (0.5 + 1e-9) * unit_of(decimals);
        let comparison = Self::new(case, quantity, "-", numbers, allowed);
        Self { scale: 1.0, decimals: Some(decimals), ..comparison }
    }

    /// Compares a value that should be 0 with its limit.
    pub fn limited(case: &str, quantity: &str, value: f64, limit: f64) -> Self {
        Self { scale: 1.0, ..Self::new(case, quantity, "-", [value, 0.0], limit) }
    }

    /// Returns the difference over the scale \[-\].
    pub fn error(&self) -> f64 {
        (self.computed - self.given).abs() / self.scale
    }

    /// Returns whether the difference is allowed; that of a number that is not finite is not.
    pub fn passes(&self) -> bool {
        self.error() <= self.allowed
    }

    /// Returns the result in a word: `PASS` or `FAIL`.
    pub fn word(&self) -> &'static str {
        if self.passes() { "PASS" } else { "FAIL" }
    }
}

/// Returns a unit of the last of so many decimals.
pub(crate) fn unit_of(decimals: usize) -> f64 {
    libm::pow(10.0, -(decimals as f64))
}

/// What tables call the columns case, quantity, unit, given, computed, error, allowed and result; people do
/// not see a column without a heading.
pub(crate) type Headings = [&'static str; 8];

/// Returns the table of comparisons, with `digits` of the given and the computed numbers.
pub(crate) fn table<'a>(
    rows: impl IntoIterator<Item = &'a Comparison>,
    [case, quantity, unit, given, computed, error, allowed, result]: Headings,
    digits: Digits,
) -> Table {
    // one decimal more than print shows what was rounded
    let shown = |row: &Comparison, value, more| match row.decimals {
        Some(decimals) => Cell::Rounded(value, decimals + more),
        None => Cell::Number(value),
    };
    Table::over(rows)
        .text("case", case, |row| row.case.clone())
        .text("quantity", quantity, |row| row.quantity.clone())
        .text("unit", unit, |row| row.unit)
        .number("reference", given, digits, |row| shown(row, row.given, 0))
        .number("computed", computed, digits, |row| shown(row, row.computed, 1))
        .number("scale", "", digits, |row| row.scale)
        .number("error", error, Digits::Exponent(0), |row| shown(row, row.error(), 1))
        .number("bound", allowed, Digits::Exponent(0), |row| row.allowed)
        .text("result", result, |row| row.word())
        .done()
}

/// Returns a table of comparisons as markup; rows that fail are shaded.
pub(crate) fn html(table: &Table) -> String {
    table.html_with(|row| if table.rows[row].last() == Some(&Cell::from("FAIL")) { "FAIL" } else { "" })
}

/// Style of the rows that fail.
pub(crate) const STYLE: &str = "tr.FAIL { background: var(--shade); }";
