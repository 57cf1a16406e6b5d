//! Numbers that walls usually have, and the units in which others were perhaps meant.

use super::bar::Bar;
use super::parameters::Parameters;
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

impl Warning {
    /// Finds the parameters of a wall whose values are improbable.
    pub fn unusual(parameters: &Parameters) -> impl Iterator<Item = Self> + use<> {
        let Parameters { height, thickness, width, overburden, tie_strength, .. } = *parameters;
        let of_bar: Vec<_> = parameters.bar.iter().flat_map(Bar::warnings).collect();
        // of a bar with a number in another unit, stiffness and strength say nothing more
        let has_tie = parameters.tie_stiffness > 0.0 && of_bar.is_empty();
        let half = thickness / 2.0;
        let usual = |name, unit, range, others| Usual { name, unit, range, others };
        let of_shape = [
            (height, usual("height", "m", [0.2, 30.0], LENGTHS)),
            (thickness, usual("thickness", "m", [0.03, 3.0], LENGTHS)),
        ];
        // the ratio of a height or thickness in another unit says nothing more
        let slender = of_shape.iter().all(|(value, usual)| usual.warning(*value).is_none());
        let density =
            usual("density", "kg/m3", [400.0, 3000.0], &[("in t/m3", 1e3), ("in kN/m3", 1e3 / 9.80665)]);
        let of_wall = [
            (true, parameters.density, density),
            (slender, height / thickness, usual("height/thickness", "", [1.0, 100.0], &[])),
            (true, parameters.gravity, usual("gravity", "m/s2", [9.7, 9.9], &[("in cm/s2", 0.01)])),
            // below 0 it is computed
            (parameters.xi >= 0.0, parameters.xi, usual("xi", "", [0.0, 0.5], &[("in per cent", 0.01)])),
            // 0.1 to 1000 kN per metre of width; without a load its eccentricity does not matter
            (overburden > 0.0, overburden, usual("overburden", "N", [100.0, 1e6].map(|o| o * width), FORCES)),
            (
                overburden > 0.0,
                parameters.overburden_eccentricity,
                usual("overburden_eccentricity", "m", [-half, half], LENGTHS),
            ),
            // a steel bar of 12 mm over 20 m has 1.2e6 N/m, two of 40 mm over 1 m have 5e8 N/m
            (
                has_tie,
                parameters.tie_stiffness,
                usual("tie_stiffness", "N/m", [1e5, 1e9], &[("in kN/m", 1e3), ("in kN/mm", 1e6)]),
            ),
            // an anchor in poor masonry resists some kN, two steel bars of 40 mm 1.3e6 N
            (has_tie && tie_strength > 0.0, tie_strength, usual("tie_strength", "N", [1e3, 2e6], FORCES)),
        ];
        let of_shape = of_shape.map(|(value, usual)| (true, value, usual));
        let all = of_shape.into_iter().chain(of_wall);
        all.filter(|(counts, ..)| *counts).filter_map(|(_, value, usual)| usual.warning(value)).chain(of_bar)
    }
}
