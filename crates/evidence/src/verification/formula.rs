//! Formulas and their checks as data.

/// A formula, what it is compared with, and the numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// Title.
    pub title: String,
    /// Heading of `docs/model.md` that states it, as a link.
    pub section: String,
    /// The formula.
    pub statement: String,
    /// Where the reference comes from.
    pub reference: String,
    /// Why the bound is what it is.
    pub why: String,
    /// Numbers.
    pub checks: Vec<Check>,
}

impl Formula {
    pub(super) fn new([title, section, statement, reference, why]: [&str; 5], checks: Vec<Check>) -> Self {
        let [title, section, statement, reference, why] =
            [title, section, statement, reference, why].map(str::to_owned);
        Self { title, section, statement, reference, why, checks }
    }
}

/// A computed number beside its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Scene or example.
    pub case: String,
    /// What is compared, with its time.
    pub quantity: String,
    /// Unit of the quantity.
    pub unit: &'static str,
    /// Reference.
    pub reference: f64,
    /// Computed number; `None` where what is verified does not have it.
    pub computed: Option<f64>,
    /// What the error is relative to, in the unit of the quantity.
    pub scale: f64,
    /// Largest error that passes \[-\].
    pub bound: f64,
}

impl Check {
    /// Compares a number with a reference, relative to the reference.
    pub(super) fn of(
        (case, quantity, unit): (&str, &str, &'static str),
        [computed, reference]: [f64; 2],
        bound: f64,
    ) -> Self {
        let (case, quantity, scale) = (case.to_owned(), quantity.to_owned(), reference.abs());
        Self { case, quantity, unit, reference, computed: Some(computed), scale, bound }
    }

    /// Returns the error over its scale \[-\].
    pub fn error(&self) -> Option<f64> {
        Some((self.computed? - self.reference).abs() / self.scale)
    }

    /// Returns whether the error is within its bound. A number that is missing passes: it is counted by
    /// itself; one that is not finite fails.
    pub fn passes(&self) -> bool {
        self.error().is_none_or(|error| error <= self.bound)
    }

    /// Returns the result in a word: `PASS`, `FAIL`, or `none` for a number that is missing.
    pub fn word(&self) -> &'static str {
        match self.computed {
            None => "none",
            Some(_) if self.passes() => "PASS",
            Some(_) => "FAIL",
        }
    }
}

/// Numbers that pass, fail, or are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counts {
    /// Numbers within their bounds.
    pub passed: usize,
    /// Numbers outside their bounds.
    pub failed: usize,
    /// Numbers that what is verified does not have.
    pub missing: usize,
    /// Formulas.
    pub formulas: usize,
}

impl Counts {
    /// Counts the numbers of formulas.
    pub fn of(formulas: &[Formula]) -> Self {
        let checks = || formulas.iter().flat_map(|formula| &formula.checks);
        let failed = checks().filter(|check| !check.passes()).count();
        let missing = checks().filter(|check| check.computed.is_none()).count();
        Self { passed: checks().count() - failed - missing, failed, missing, formulas: formulas.len() }
    }

    /// Returns the counts in words.
    pub fn words(&self) -> String {
        let Self { passed, failed, missing, formulas } = self;
        let absent = if *missing > 0 { format!(", {missing} not in the FMU") } else { String::new() };
        format!("{passed} PASS, {failed} FAIL{absent}: numbers of {formulas} formulas")
    }
}
