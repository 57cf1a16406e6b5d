//! Parts, openings and loads of a wall, as they are given.
//!
//! z is measured upwards from the base and x inwards from the outer face of the lowest part at its foot, so
//! that the outer toe is at x = 0. u > 0 is towards the outside.

use super::section::Section;

/// A prism of masonry. Its thickness, width and outer face change linearly from the bottom to the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Height of its lower edge above the base \[m\].
    pub base: f64,
    /// Height from its lower to its upper edge \[m\].
    pub height: f64,
    /// Thickness at its bottom and top \[m\].
    pub thickness: [f64; 2],
    /// Length along the wall at its bottom and top \[m\].
    pub width: [f64; 2],
    /// Place x of its outer face at its bottom and top \[m\].
    pub outer: [f64; 2],
    /// Density \[kg/m³\].
    pub density: f64,
}

/// An opening, taken out of the parts at its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Height of its lower edge above the base \[m\].
    pub base: f64,
    /// Height from its lower to its upper edge \[m\].
    pub height: f64,
    /// Length along the wall \[m\].
    pub width: f64,
    /// Where a hollow lies in the thickness; `None` for an opening through the wall.
    pub hollow: Option<Hollow>,
}

/// The place of a hollow in the thickness of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hollow {
    /// Thickness \[m\].
    pub thickness: f64,
    /// Place x of its outer face \[m\].
    pub outer: f64,
}

/// A load at a height, such as that of a floor, a roof or a vault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Force downwards \[N\].
    pub force: f64,
    /// Height above the base \[m\].
    pub height: f64,
    /// Place x \[m\].
    pub inside: f64,
    /// Share of force/g that moves along with the wall, 0 to 1 \[-\]; `None` where nobody states it, and none
    /// moves.
    pub moving_mass: Option<f64>,
    /// Mass that moves along with the wall without resting on it \[kg\].
    pub mass: f64,
    /// Thrust, positive outwards \[N\].
    pub thrust: f64,
    /// Whether the thrust certainly lasts until collapse: a check counts it where it helps.
    pub thrust_lasts: bool,
}

impl Load {
    /// A force without mass and thrust at a place.
    pub fn resting(force: f64, height: f64, inside: f64) -> Self {
        Self { force, height, inside, moving_mass: None, mass: 0.0, thrust: 0.0, thrust_lasts: false }
    }

    /// The mass that moves along with the wall under a gravity \[m/s²\].
    pub fn moving(&self, gravity: f64) -> f64 {
        self.moving_mass.unwrap_or(0.0) * self.force / gravity + self.mass
    }
}

/// An item of a profile, by its place in its list from 0 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Item {
    Part(usize),
    Opening(usize),
    Load(usize),
}

impl std::fmt::Display for Item {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Part(index) => write!(f, "part {}", index + 1),
            Self::Opening(index) => write!(f, "opening {}", index + 1),
            Self::Load(index) => write!(f, "load {}", index + 1),
        }
    }
}

/// What is wrong with an item of a profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{item}: {reason}")]
pub struct ProfileError {
    /// The item.
    pub item: Item,
    /// Its value, the limit and the remedy.
    pub reason: String,
}

impl Part {
    /// Height of its upper edge above the base \[m\].
    pub fn top(&self) -> f64 {
        self.base + self.height
    }

    /// Returns the faces and the width at a height \[m\].
    pub fn section(&self, z: f64) -> Section {
        let share = (z - self.base) / self.height;
        let at = |[bottom, top]: [f64; 2]| bottom + (top - bottom) * share;
        let outer = at(self.outer);
        Section { outer, inner: outer + at(self.thickness), width: at(self.width) }
    }

    /// Returns the heights that it shares with another stretch; `None` where they only meet.
    pub(super) fn common(&self, base: f64, top: f64) -> Option<[f64; 2]> {
        let common = [self.base.max(base), self.top().min(top)];
        (common[0] < common[1]).then_some(common)
    }
}

impl Opening {
    /// Height of its upper edge above the base \[m\].
    pub fn top(&self) -> f64 {
        self.base + self.height
    }

    /// Returns what it takes out of a part at a height: through its whole thickness, or the hollow.
    pub(super) fn section(&self, part: &Part, z: f64) -> Section {
        let Section { outer, inner, .. } = part.section(z);
        let [outer, inner] =
            self.hollow.map_or([outer, inner], |hollow| [hollow.outer, hollow.outer + hollow.thickness]);
        Section { outer, inner, width: self.width }
    }

    /// Returns the heights at which it cuts a part \[m\]; `None` where it does not. A hollow cuts the part
    /// that contains it, faces within `same` \[m\].
    pub(super) fn cut(&self, part: &Part, same: f64) -> Option<[f64; 2]> {
        let heights = part.common(self.base, self.top())?;
        (self.hollow.is_none() || self.is_within(part, heights, same)).then_some(heights)
    }

    pub(super) fn is_within(&self, part: &Part, heights: [f64; 2], same: f64) -> bool {
        heights.iter().all(|z| part.section(*z).contains(&self.section(part, *z), same))
    }
}

impl Item {
    pub(super) fn refused(self, reason: impl Into<String>) -> ProfileError {
        ProfileError { item: self, reason: reason.into() }
    }
}

/// Says which size or density of a part makes no sense.
pub(super) fn fault_of_size(part: &Part) -> Option<String> {
    let Part { base, height, thickness, width, outer, density } = *part;
    let limited = |name: &str, value: f64, [least, most]: [f64; 2], unit: &str| {
        let fits = least <= value && value <= most;
        (!fits).then(|| format!("{name} = {value} {unit} must be from {least} to {most} {unit}"))
    };
    // the limits of the model description; one end may be 0, as at the top of a gable
    let range = |name: &str, ends: [f64; 2], [least, most]: [f64; 2]| {
        let larger = ends[0].max(ends[1]);
        limited(name, larger, [least, most], "m")
            .or_else(|| ends.into_iter().find_map(|end| limited(name, end, [0.0, most], "m")))
    };
    limited("base", base, [0.0, 1000.0], "m")
        .or_else(|| limited("height", height, [0.001, 1000.0], "m"))
        .or_else(|| range("thickness", thickness, [1e-4, 100.0]))
        .or_else(|| range("width", width, [0.001, 1000.0]))
        .or_else(|| outer.into_iter().find_map(|outer| limited("outer", outer, [-100.0, 100.0], "m")))
        .or_else(|| limited("density", density, [1.0, 1e5], "kg/m3"))
}
