//! A wall of parts, checked as a whole.

use super::part::{Item, Load, Opening, Part, ProfileError, fault_of_size};
use super::section::Section;

/// The parameters of a rectangle, which parts replace: height, thickness, width and density.
pub const OF_RECTANGLE: [&str; 4] = ["height", "thickness", "width", "density"];

/// Most parts, openings or loads of a wall; more is a mistake.
pub const MOST_ITEMS: usize = 200;
/// Heights and faces that differ by less than this share of the height are the same.
pub(super) const SAME: f64 = 1e-9;

/// A wall of parts, with its openings and loads; it never changes.
///
/// ```
/// use rocking_wall::wall::{Part, Profile};
///
/// let gable = Part {
///     base: 0.0,
///     height: 2.4,
///     thickness: [0.25, 0.25],
///     width: [6.0, 0.0],
///     outer: [0.0, 0.0],
///     density: 1800.0,
/// };
/// let profile = Profile::new(vec![gable], vec![], vec![])?;
/// assert_eq!(profile.height(), 2.4);
/// # Ok::<(), rocking_wall::wall::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    parts: Vec<Part>,
    openings: Vec<Opening>,
    loads: Vec<Load>,
    /// The edges on which it bears, where what it stands on is narrower than its foot \[m\].
    bearing: Option<[f64; 2]>,
}

impl Profile {
    /// Checks the parts, from the base up, with the openings in them and the loads on them.
    ///
    /// # Errors
    /// [`ProfileError`] of an item without size or mass, of parts that float or overlap, of an opening that
    /// is not within the parts or as wide as they are, and of a load beyond the wall.
    pub fn new(parts: Vec<Part>, openings: Vec<Opening>, loads: Vec<Load>) -> Result<Self, ProfileError> {
        Self::of_checked(parts, openings, loads).checked()
    }

    fn checked(self) -> Result<Self, ProfileError> {
        self.check_count()?;
        self.check_parts()?;
        self.check_openings()?;
        self.parts.iter().try_for_each(|part| self.check_left(part))?;
        self.check_loads()?;
        Ok(self)
    }

    /// Takes what has been checked: an FMU's library does without the checks and their words.
    pub(crate) fn of_checked(parts: Vec<Part>, openings: Vec<Opening>, loads: Vec<Load>) -> Self {
        Self { parts, openings, loads, bearing: None }
    }

    /// The same wall on what is narrower than its foot, between two edges \[m\].
    pub(super) fn bearing_on(self, edges: [f64; 2]) -> Self {
        Self { bearing: Some(edges), ..self }
    }

    /// The same parts and openings with other loads.
    #[must_use]
    pub fn with_loads(&self, loads: Vec<Load>) -> Self {
        Self { loads, ..self.clone() }
    }

    /// Other parts with the same openings and loads, on the same edges.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn with_parts(&self, parts: Vec<Part>) -> Result<Self, ProfileError> {
        Self { parts, ..self.clone() }.checked()
    }

    /// Its parts, the lowest first.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Its openings.
    pub fn openings(&self) -> &[Opening] {
        &self.openings
    }

    /// Its loads.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// Height of its highest edge \[m\].
    pub fn height(&self) -> f64 {
        self.parts.iter().map(Part::top).fold(0.0, f64::max)
    }

    /// Places x of its outer and inner toe \[m\].
    pub fn toes(&self) -> [f64; 2] {
        if let Some(edges) = self.bearing {
            return edges;
        }
        let touching = self.parts.iter().filter(|part| part.base <= SAME * self.height());
        let [outer, inner] = faces(touching.map(|part| part.section(part.base)));
        [outer, inner]
    }

    /// Distance of its toes \[m\].
    pub fn base_thickness(&self) -> f64 {
        let [outer, inner] = self.toes();
        inner - outer
    }

    /// Returns whether it is one prism without openings and loads.
    pub fn is_rectangle(&self) -> bool {
        let is_constant = |ends: [f64; 2]| ends[0] == ends[1];
        let prism = self
            .parts
            .iter()
            .all(|part| [part.thickness, part.width, part.outer].into_iter().all(is_constant));
        let alone = self.openings.is_empty() && self.loads.is_empty() && self.bearing.is_none();
        prism && self.parts.len() == 1 && alone
    }

    /// Its height, the distance of its toes, and the width and density of its lowest part: what stands for it
    /// where a rectangle is expected, as in pictures.
    pub(super) fn as_rectangle(&self) -> [f64; 4] {
        let Part { width, density, .. } = self.parts[0];
        [self.height(), self.base_thickness(), width[0].max(width[1]), density]
    }

    /// Returns the outermost and the innermost face just below (`false`) or above (`true`) a height \[m\].
    pub(super) fn faces_beside(&self, z: f64, above: bool) -> [f64; 2] {
        let same = SAME * self.height();
        let reaches = |part: &&Part| {
            if above {
                part.base <= z + same && z + same < part.top()
            } else {
                part.base < z - same && z - same <= part.top()
            }
        };
        faces(self.parts.iter().filter(reaches).map(|part| part.section(z)))
    }

    fn check_count(&self) -> Result<(), ProfileError> {
        let (parts, openings, loads) = (self.parts.len(), self.openings.len(), self.loads.len());
        for (count, item) in [
            (parts, Item::Part(MOST_ITEMS)),
            (openings, Item::Opening(MOST_ITEMS)),
            (loads, Item::Load(MOST_ITEMS)),
        ] {
            if count > MOST_ITEMS {
                return Err(item.refused(format!("a wall has at most {MOST_ITEMS}, this one has {count}")));
            }
        }
        if parts == 0 {
            return Err(Item::Part(0).refused("a wall needs a part: openings and loads are not enough"));
        }
        Ok(())
    }

    fn check_parts(&self) -> Result<(), ProfileError> {
        let lowest = self.parts[0];
        if lowest.base != 0.0 || lowest.outer[0] != 0.0 {
            let Part { base, outer, .. } = lowest;
            return Err(Item::Part(0).refused(format!(
                "base = {base} m and outer = {} m at its foot must be 0: from there heights and faces of all \
                 parts are measured",
                outer[0]
            )));
        }
        for (index, part) in self.parts.iter().enumerate() {
            let refused = |reason| Err(Item::Part(index).refused(reason));
            if let Some(reason) = fault_of_size(part) {
                return refused(reason);
            }
            if let Some(other) = self.parts[..index].iter().position(|other| overlaps(part, other)) {
                return refused(format!(
                    "overlaps part {} between {} m and {} m; give base, height or outer so that each place \
                     belongs to one part",
                    other + 1,
                    part.base,
                    part.top()
                ));
            }
            if index > 0 && !self.is_carried(index) {
                return refused(format!(
                    "floats: no part touches it from its base = {} m on; leave base out for a part on top of \
                     the one before, and give the outer face",
                    part.base
                ));
            }
        }
        Ok(())
    }

    /// Returns whether a part stands on a part before it, or touches the side of one.
    fn is_carried(&self, index: usize) -> bool {
        let (part, same) = (&self.parts[index], SAME * self.height());
        let foot = part.section(part.base);
        let touches = |other: &Part| {
            if (other.top() - part.base).abs() <= same {
                let below = other.section(other.top());
                return below.width > 0.0 && foot.overlap(&below) > same;
            }
            part.common(other.base, other.top()).is_some_and(|heights| {
                heights.iter().all(|z| part.section(*z).overlap(&other.section(*z)) >= -same)
            })
        };
        self.parts[..index].iter().any(touches)
    }

    fn check_openings(&self) -> Result<(), ProfileError> {
        for (index, opening) in self.openings.iter().enumerate() {
            let refused = |reason| Err(Item::Opening(index).refused(reason));
            let Opening { base, height, width, hollow } = *opening;
            let depth = hollow.map_or(1.0, |hollow| hollow.thickness);
            for (name, size) in [("height", height), ("width", width), ("thickness", depth)] {
                if !(size > 0.0 && size.is_finite()) {
                    return refused(format!("{name} = {size} m must be above 0"));
                }
            }
            let same = SAME * self.height();
            if !(base >= 0.0 && opening.top() <= self.height() + same) {
                let (top, height) = (opening.top(), self.height());
                return refused(format!("from {base} m to {top} m is not within the wall of {height} m"));
            }
            let cuts: Vec<_> =
                self.parts.iter().filter_map(|part| Some((part, opening.cut(part, same)?))).collect();
            for &(part, heights) in &cuts {
                if !opening.is_within(part, heights, same) {
                    let number = self.parts.iter().position(|own| std::ptr::eq(own, part)).unwrap_or(0) + 1;
                    let narrow = heights.map(|z| part.section(z).width).into_iter().fold(f64::MAX, f64::min);
                    return refused(format!(
                        "width = {width} m must be smaller than that of part {number} there, {narrow} m; an \
                         opening in other parts alone has their thickness and outer"
                    ));
                }
            }
            if cuts.is_empty() {
                return refused("is in no part: thickness and outer have to lie within one".to_owned());
            }
        }
        Ok(())
    }

    /// Checks that openings at the same heights and depths leave some of a part between them: they count as
    /// beside each other.
    fn check_left(&self, part: &Part) -> Result<(), ProfileError> {
        let same = SAME * self.height();
        let cuts = self.openings.iter().enumerate();
        let cuts: Vec<_> =
            cuts.filter_map(|(at, opening)| Some((at, opening, opening.cut(part, same)?))).collect();
        let ends = rising(cuts.iter().flat_map(|(.., heights)| *heights));
        for stretch in ends.windows(2).filter(|stretch| stretch[1] - stretch[0] > same) {
            let reaches = |heights: [f64; 2]| heights[0] <= stretch[0] && stretch[1] <= heights[1];
            let here: Vec<_> = cuts.iter().filter(|(.., heights)| reaches(*heights)).collect();
            // widths and faces are straight: what holds at both ends holds between them
            for &z in stretch {
                let sections: Vec<_> =
                    here.iter().map(|(at, opening, _)| (*at, opening.section(part, z))).collect();
                let (last, taken) = most_taken(&sections);
                let width = part.section(z).width;
                if taken >= width {
                    return Err(Item::Opening(last).refused(format!(
                        "at {z} m openings take {taken} m of a width of {width} m; leave some of the wall \
                         between them"
                    )));
                }
            }
        }
        Ok(())
    }

    fn check_loads(&self) -> Result<(), ProfileError> {
        let (top, same) = (self.height(), SAME * self.height());
        let [outer, inner] =
            faces(self.parts.iter().flat_map(|part| [part.base, part.top()].map(|z| part.section(z))));
        let reach = inner - outer;
        for (index, load) in self.loads.iter().enumerate() {
            let refused = |reason| Err(Item::Load(index).refused(reason));
            let Load { force, height, inside, moving_mass, mass, thrust, .. } = *load;
            if !(force >= 0.0 && force.is_finite() && thrust.is_finite()) {
                return refused(format!(
                    "force = {force} N must be 0 or more, downwards, and thrust = {thrust} N a number"
                ));
            }
            if let Some(share) = moving_mass.filter(|share| !(0.0..=1.0).contains(share)) {
                return refused(format!("moving_mass = {share} is the share of force/g from 0 to 1"));
            }
            if !(mass >= 0.0 && mass.is_finite() && (mass == 0.0 || force == 0.0)) {
                return refused(format!(
                    "mass = {mass} kg moves along without resting on the wall, force = {force} N rests on \
                     it: give them as two loads, the mass 0 or more"
                ));
            }
            if !(height > 0.0 && height <= top + same) {
                return refused(format!(
                    "height = {height} m must be above 0 and at most that of the wall, {top} m"
                ));
            }
            if !(outer - reach..=inner + reach).contains(&inside) {
                return refused(format!(
                    "inside = {inside} m is farther from the wall, {outer} m to {inner} m, than the wall is \
                     thick; it is measured inwards from the outer face"
                ));
            }
        }
        Ok(())
    }
}

/// Returns the outermost and the innermost face of sections; infinite where there are none.
fn faces(sections: impl Iterator<Item = Section>) -> [f64; 2] {
    sections.fold([f64::INFINITY, f64::NEG_INFINITY], |[outer, inner], section| {
        [outer.min(section.outer), inner.max(section.inner)]
    })
}

/// Returns whether two parts share a place.
fn overlaps(part: &Part, other: &Part) -> bool {
    let same = SAME * part.top().max(other.top());
    part.common(other.base, other.top()).is_some_and(|[from, to]| {
        // faces are straight: the shared thickness is largest at an end or where two of them cross
        let gaps = |z: f64| {
            let (own, other) = (part.section(z), other.section(z));
            [own.outer - other.outer, own.inner - other.inner]
        };
        let crossings = gaps(from).into_iter().zip(gaps(to)).filter(|(at, end)| at * end < 0.0);
        let crossings = crossings.map(|(at, end)| from + (to - from) * at / (at - end));
        let shares = |z: f64| part.section(z).overlap(&other.section(z)) > same;
        to - from > same && [from, to].into_iter().chain(crossings).any(shares)
    })
}

/// Returns the largest width that numbered openings take at one depth, and the last of these openings.
fn most_taken(sections: &[(usize, Section)]) -> (usize, f64) {
    let faces = rising(sections.iter().flat_map(|(_, section)| [section.outer, section.inner]));
    let depths = faces.windows(2).map(|faces| 0.5 * (faces[0] + faces[1]));
    let taken = depths.map(|x| {
        let across = sections.iter().filter(|(_, own)| own.outer < x && x < own.inner);
        across.fold((0, 0.0), |(_, taken), (at, section)| (*at, taken + section.width))
    });
    taken.max_by(|(_, one), (_, other)| one.total_cmp(other)).unwrap_or_default()
}

/// Returns numbers in rising order, each once.
fn rising(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut numbers: Vec<_> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers
}
