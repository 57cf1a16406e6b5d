//! A tie as it is built: a round bar and its anchor.
//!
//! ```text
//! A = π φ²/4    K = n E A/L    N_y = n min(A f_y, N_anchor)    p_u = ε_u L − N_y/K
//! ```
//!
//! n bars hold the wall: its width over their spacing, or one. A bar stretches by `p_u` under `N_y` before
//! it tears. An anchor that is weaker than its bar breaks at once: `p_u` = 0.

use std::f64::consts::PI;

use super::error::ParameterError;
use super::given::COMPUTED;
use super::usual::{FORCES, LENGTHS, Usual};
use super::warning::Warning;

/// A bar and its anchor; lengths in m, stresses in Pa, forces in N.
///
/// ```
/// use rocking_wall::wall::{Bar, TiePart};
///
/// // φ 16 mm, every 3 m
/// let bar = Bar {
///     diameter: 0.016,
///     length: 6.0,
///     yield_stress: 235e6,
///     ultimate_strain: Some(0.02),
///     spacing: Some(3.0),
///     ..Bar::default()
/// };
/// // for 1 m of wall
/// let tie = bar.tie(1.0).unwrap();
/// assert!((tie.stiffness - 2.34572e6).abs() < 10.0);
/// assert!((tie.strength - 15749.9).abs() < 0.1);
/// assert!((tie.ultimate - 0.113286).abs() < 1e-6);
/// assert_eq!(tie.weaker, TiePart::Bar);
///
/// let weak = Bar { anchor_capacity: Some(30e3), ..bar }.tie(1.0).unwrap();
/// assert_eq!((weak.weaker, weak.ultimate), (TiePart::Anchor, 0.0));
/// assert!((weak.strength - 10e3).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// Diameter φ \[m\].
    pub diameter: f64,
    /// Free length L between the anchors \[m\].
    pub length: f64,
    /// Young's modulus E \[Pa\].
    #[serde(default = "steel")]
    pub young_modulus: f64,
    /// Yield stress `f_y` \[Pa\].
    pub yield_stress: f64,
    /// Strain `ε_u` at which the bar tears \[-\]; `None` where nothing is said of it: the tie stays elastic.
    pub ultimate_strain: Option<f64>,
    /// The force at which an anchor fails \[N\]; `None` for one that is stronger than the bar.
    pub anchor_capacity: Option<f64>,
    /// Distance between bars along the wall \[m\]; `None` for one bar, whatever the wall's width.
    pub spacing: Option<f64>,
}

/// E of steel \[Pa\].
fn steel() -> f64 {
    210e9
}

impl Default for Bar {
    /// Steel of 210 `GPa`; diameter, length and yield stress, which have to be given, are 0.
    fn default() -> Self {
        Self {
            diameter: 0.0,
            length: 0.0,
            young_modulus: steel(),
            yield_stress: 0.0,
            ultimate_strain: None,
            anchor_capacity: None,
            spacing: None,
        }
    }
}

/// What bars and anchors make of the tie of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarTie {
    /// `tie_stiffness`, K \[N/m\].
    pub stiffness: f64,
    /// `tie_strength`, `N_y` \[N\].
    pub strength: f64,
    /// `tie_ultimate`, `p_u` \[m\]; −1 for a tie that stays elastic.
    pub ultimate: f64,
    /// The part that gives way first.
    pub weaker: TiePart,
}

/// A part of a tie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TiePart {
    /// The bar, which yields.
    Bar,
    /// The anchor, which breaks.
    Anchor,
}

/// A number of a bar, as files and messages have it.
#[derive(Clone, Copy, Debug)]
pub struct BarNumber {
    /// What it is.
    pub text: &'static str,
    /// Whether it has to be given.
    pub is_required: bool,
    /// Its name, its unit and usual range.
    pub usual: Usual,
}

/// Other units of stresses.
const STRESSES: &[(&str, f64)] = &[("in MPa", 1e6), ("in GPa", 1e9)];

const fn number(
    name: &'static str,
    text: &'static str,
    is_required: bool,
    unit: &'static str,
    range: [f64; 2],
    others: &'static [(&'static str, f64)],
) -> BarNumber {
    BarNumber { text, is_required, usual: Usual { name, unit, range, others } }
}

impl BarNumber {
    /// Returns its key in `[tie.bar]`.
    pub fn key(&self) -> &'static str {
        self.usual.name.strip_prefix("bar_").unwrap_or(self.usual.name)
    }
}

impl Bar {
    /// The numbers of a bar, in the order of its fields.
    pub const NUMBERS: [BarNumber; 7] = [
        number("bar_diameter", "Diameter of the bar", true, "m", [0.004, 0.08], LENGTHS),
        number("bar_length", "Free length between the anchors", true, "m", [0.2, 60.0], LENGTHS),
        // from aluminium or fibres to steel
        number(
            "bar_young_modulus",
            "Young's modulus of the bar; 210e9 Pa by default",
            false,
            "Pa",
            [30e9, 300e9],
            STRESSES,
        ),
        number("bar_yield_stress", "Stress at which the bar yields", true, "Pa", [50e6, 2e9], STRESSES),
        number(
            "bar_ultimate_strain",
            "Strain at which the bar tears; where none is given, the tie stays elastic",
            false,
            "",
            [0.002, 0.4],
            &[("in per cent", 0.01)],
        ),
        number(
            "bar_anchor_capacity",
            "Force at which an anchor fails, without warning; by default it is stronger than the bar",
            false,
            "N",
            [1e3, 2e6],
            FORCES,
        ),
        number(
            "bar_spacing",
            "Distance between bars along the wall; by default one bar holds its width",
            false,
            "m",
            [0.2, 30.0],
            LENGTHS,
        ),
    ];

    /// Returns a number by its place in [`Self::NUMBERS`]; `None` where it is not given.
    pub fn get(&self, index: usize) -> Option<f64> {
        let given = |value: f64| Some(value).filter(|value| *value != 0.0);
        [
            given(self.diameter),
            given(self.length),
            given(self.young_modulus),
            given(self.yield_stress),
            self.ultimate_strain,
            self.anchor_capacity,
            self.spacing,
        ][index]
    }

    /// Sets a number by its place in [`Self::NUMBERS`].
    pub fn set(&mut self, index: usize, value: f64) {
        match index {
            0 => self.diameter = value,
            1 => self.length = value,
            2 => self.young_modulus = value,
            3 => self.yield_stress = value,
            4 => self.ultimate_strain = Some(value),
            5 => self.anchor_capacity = Some(value),
            _ => self.spacing = Some(value),
        }
    }

    /// Returns stiffness, strength and ultimate elongation of the bars that hold a wall of a width \[m\].
    ///
    /// # Errors
    /// [`ParameterError::BarNeeds`] and [`ParameterError::Bar`] of a number that is missing or not above 0.
    pub fn tie(&self, width: f64) -> Result<BarTie, ParameterError> {
        for (index, BarNumber { is_required, usual: Usual { name, unit, .. }, .. }) in
            Self::NUMBERS.into_iter().enumerate()
        {
            match self.get(index) {
                None if is_required => return Err(ParameterError::BarNeeds { name }),
                Some(value) if !(value > 0.0 && value.is_finite()) => {
                    return Err(ParameterError::Bar { name, value, unit });
                }
                _ => {}
            }
        }
        let bars = self.spacing.map_or(1.0, |spacing| width / spacing);
        let area = PI * self.diameter * self.diameter / 4.0;
        let stiffness = bars * (self.young_modulus * area / self.length);
        let of_bar = area * self.yield_stress;
        let anchor = self.anchor_capacity.filter(|capacity| *capacity < of_bar);
        let strength = bars * anchor.unwrap_or(of_bar);
        let (weaker, ultimate) = match (anchor, self.ultimate_strain) {
            (Some(_), _) => (TiePart::Anchor, 0.0),
            (None, Some(strain)) => (TiePart::Bar, (strain * self.length - strength / stiffness).max(0.0)),
            (None, None) => (TiePart::Bar, COMPUTED),
        };
        Ok(BarTie { stiffness, strength, ultimate, weaker })
    }

    /// Finds the numbers that bars rarely have.
    pub fn warnings(&self) -> impl Iterator<Item = Warning> + use<> {
        let given = Self::NUMBERS.into_iter().enumerate().zip([*self; 7]);
        given.filter_map(|((index, number), bar)| number.usual.warning(bar.get(index)?))
    }
}
