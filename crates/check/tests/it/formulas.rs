//! Every formula that a report prints with numbers, evaluated: they give the result printed beside them.
//!
//! A number with four digits or more stands for all that round to it, one with fewer is exact, and the
//! formula of such intervals is an interval that meets that of the result.

use std::f64::consts::PI;

use check::Language;

use crate::report::{plain, report_of_one, report_of_walls};

/// Least and largest value.
#[derive(Clone, Copy, Debug)]
struct Interval([f64; 2]);

impl Interval {
    fn exact(value: f64) -> Self {
        Self([value, value])
    }

    /// All numbers that are printed as this one.
    fn printed(text: &str) -> Option<Self> {
        let plain = text.replace(',', ".").replace('−', "-");
        let value: f64 = plain.parse().ok()?;
        let (digits, power) = plain.split_once('e').unwrap_or((&plain, "0"));
        let figures = digits.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit).count();
        let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let half_unit = 0.5 * 10.0_f64.powi(power.parse::<i32>().ok()? - i32::try_from(decimals).ok()?);
        let half_unit = if figures < 4 { 0.0 } else { half_unit };
        Some(Self([value - half_unit, value + half_unit]))
    }

    fn of(self, other: Self, operation: fn(f64, f64) -> f64) -> Self {
        let all = self.0.iter().flat_map(|a| other.0.map(|b| operation(*a, b)));
        let [mut least, mut largest] = [f64::INFINITY, f64::NEG_INFINITY];
        all.for_each(|value| (least, largest) = (least.min(value), largest.max(value)));
        Self([least, largest])
    }

    /// Whether both have a value in common, up to the rounding of the formula itself.
    fn meets(self, other: Self) -> bool {
        let room = 1e-9 * self.0[1].abs().max(other.0[1].abs());
        self.0[0] <= other.0[1] + room && other.0[0] <= self.0[1] + room
    }
}

/// Reads sums, products, powers, roots, `max` and `min` of numbers.
struct Parser<'a>(&'a str);

impl Parser<'_> {
    fn takes(&mut self, text: &str) -> bool {
        let after = self.0.strip_prefix(text);
        self.0 = after.unwrap_or(self.0);
        after.is_some()
    }

    fn sum(&mut self) -> Option<Interval> {
        let mut sum = self.product()?;
        loop {
            if self.takes(" + ") {
                sum = sum.of(self.product()?, |a, b| a + b);
            } else if self.takes(" − ") {
                sum = sum.of(self.product()?, |a, b| a - b);
            } else {
                return Some(sum);
            }
        }
    }

    /// Factors with a dot, a space or nothing between them.
    fn product(&mut self) -> Option<Interval> {
        let mut product = self.power()?;
        loop {
            let is_next = |text: &str| text.starts_with(['π', '√', '(', '[']);
            let after_space = self.0.strip_prefix(' ').unwrap_or_default();
            let is_after_space =
                is_next(after_space) || after_space.starts_with(|c: char| c.is_ascii_digit());
            if self.takes("/") {
                product = product.of(self.power()?, |a, b| a / b);
            } else if self.takes(" · ") || is_next(self.0) || is_after_space && self.takes(" ") {
                product = product.of(self.power()?, |a, b| a * b);
            } else {
                return Some(product);
            }
        }
    }

    fn power(&mut self) -> Option<Interval> {
        let base = self.atom()?;
        if self.takes("²") {
            return Some(Interval(base.0.map(|value| value * value)));
        }
        if self.takes("^") {
            let exponent = self.number()?;
            return Some(base.of(exponent, f64::powf));
        }
        Some(base)
    }

    fn number(&mut self) -> Option<Interval> {
        let first = if self.0.starts_with('−') { '−'.len_utf8() } else { 0 };
        let is_part = |letter: char| letter.is_ascii_digit() || matches!(letter, '.' | ',');
        let end = self.0[first..].find(|letter| !is_part(letter)).map_or(self.0.len(), |end| first + end);
        let (text, after) = self.0.split_at(end);
        self.0 = after;
        Interval::printed(text)
    }

    fn atom(&mut self) -> Option<Interval> {
        for (text, value) in [("10⁻³", 1e-3), ("10³", 1e3), ("π", PI)] {
            if self.takes(text) {
                return Some(Interval::exact(value));
            }
        }
        if self.takes("√") {
            return self.power().map(|of| Interval(of.0.map(|value| value.max(0.0).sqrt())));
        }
        let operations = [("max", f64::max as fn(f64, f64) -> f64), ("min", f64::min)];
        let operation = operations.into_iter().find(|(name, _)| self.takes(name)).map(|(_, of)| of);
        if !(self.takes("(") || self.takes("[")) {
            return self.number();
        }
        let mut inner = self.sum()?;
        if let Some(operation) = operation {
            self.takes("; ").then_some(())?;
            inner = inner.of(self.sum()?, operation);
        }
        (self.takes(")") || self.takes("]")).then_some(inner)
    }
}

fn value(formula: &str) -> Option<Interval> {
    let mut parser = Parser(formula);
    parser.sum().filter(|_| parser.0.is_empty())
}

/// Asserts that the formulas of a page give their numbers; returns how many have numbers put in.
pub(crate) fn assert_gives(page: &str) -> usize {
    let mut count = 0;
    for row in page.split("<tr>").filter(|row| row.contains(" = <b>")) {
        let (_, row) = row.split_once("</td><td>").unwrap();
        let row = plain(row.split("</td>").next().unwrap());
        let mut parts = row.trim().rsplit(" = ");
        let (result, formula) = (parts.next().unwrap(), parts.next().unwrap());
        let result = result.split(' ').next().unwrap();
        // the last of a row without numbers are symbols
        let names = formula.replace("max", "").replace("min", "");
        if parts.next().is_none() && names.contains(char::is_alphabetic)
            || names.chars().any(|letter| letter.is_alphabetic() && letter != 'π')
        {
            continue;
        }
        let found = value(formula).unwrap_or_else(|| panic!("{formula:?} of {row:?} cannot be read"));
        let printed =
            Interval::printed(result).unwrap_or_else(|| panic!("{result:?} of {row:?} is no number"));
        assert!(found.meets(printed), "{row}: {found:?}");
        count += 1;
    }
    count
}

#[test]
fn every_printed_formula_gives_its_number() {
    let count = Language::ALL.map(|language| assert_gives(&report_of_walls(language)));
    assert!(count[0] > 60 && count[0] == count[1], "{count:?} formulas");
    let data: toml::Table = include_str!("../data/circolare.toml").parse().unwrap();
    let cases = data["cases"].as_array().unwrap();
    let count: usize =
        cases.iter().map(|case| assert_gives(&report_of_one(case["scene"].as_str().unwrap()))).sum();
    assert!(count > 600, "{count} formulas of {} cases", cases.len());
    // the force that a tie needs is that for the target
    let tied =
        cases.iter().map(|case| case["scene"].as_str().unwrap()).filter(|scene| scene.contains("[tie]"));
    let with_target = |scene: &str| scene.replace("[check]\n", "[check]\ntarget = 0.8\n");
    let count: usize = tied.map(|scene| assert_gives(&report_of_one(&with_target(scene)))).sum();
    assert!(count > 100, "{count} formulas with a target");
}

#[test]
fn formulas_are_evaluated() {
    let near = |formula: &str, expected: f64| {
        let found = value(formula).unwrap_or_else(|| panic!("{formula}"));
        assert!(found.meets(Interval([expected - 1e-9, expected + 1e-9])), "{formula}: {found:?}");
    };
    near("2 · (1 − 30/150)", 1.6);
    near("2π √(30 · 10⁻³/2,5)", 2.0 * PI * 0.012_f64.sqrt());
    near("max[0; (−2) · 3]", 0.0);
    near("(2 · 3)²/4^1.5", 4.5);
    near("min(7; 5) · 0.1 + 1", 1.5);
    assert!(!value("2 · 3").unwrap().meets(Interval::printed("6.001").unwrap()));
    assert!(value("1.234 · 2").unwrap().meets(Interval::printed("2.469").unwrap()));
}
