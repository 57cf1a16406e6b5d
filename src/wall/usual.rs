//! Numbers that walls usually have, and the units in which others were perhaps meant.

use super::warning::Warning;

/// The usual range of a number, and other units in which people give it.
#[derive(Clone, Copy, Debug)]
pub struct Usual {
    /// Name of the number.
    pub name: &'static str,
    /// Its unit; empty for none.
    pub unit: &'static str,
    /// Least and most of the usual range.
    pub range: [f64; 2],
    /// How it may be given instead, such as "in cm", and the factor to its own unit.
    pub others: &'static [(&'static str, f64)],
}

/// Lengths in m.
pub(super) const LENGTHS: &[(&str, f64)] = &[("in cm", 0.01), ("in mm", 0.001)];
/// Forces in N.
pub(super) const FORCES: &[(&str, f64)] = &[("in kN", 1e3)];

impl Usual {
    /// A period in s: 5 s is beyond that of any building with masonry walls, 0.02 s below that of a storey.
    pub const fn period(name: &'static str) -> Self {
        Self { name, unit: "s", range: [0.02, 5.0], others: &[("in ms", 1e-3)] }
    }

    /// Returns the warning of a number outside the range. It names the unit that brings it nearest to the
    /// middle of the range, if one brings it inside.
    ///
    /// ```
    /// use rocking_wall::wall::Usual;
    ///
    /// let warning = Usual::period("period").warning(320.0).unwrap();
    /// assert_eq!(
    ///     warning.to_string(),
    ///     "period = 320 s is unusual: 0.02 to 5 s is usual; if it is in ms, give 0.32 s"
    /// );
    /// assert_eq!(Usual::period("period").warning(0.3), None);
    /// ```
    pub fn warning(&self, value: f64) -> Option<Warning> {
        let Self { name, unit, range: usual @ [least, most], others } = *self;
        let inside = |value: f64| (least..=most).contains(&value);
        if inside(value) {
            return None;
        }
        let distance = |value: f64| (value.abs().ln() - 0.5 * (least * most).abs().ln()).abs();
        let meant = others.iter().map(|(unit, size)| (*unit, value * size)).filter(|(_, own)| inside(*own));
        let meant = meant.min_by(|(_, a), (_, b)| distance(*a).total_cmp(&distance(*b)));
        Some(Warning::Unusual { name, value, unit, usual, meant })
    }
}
