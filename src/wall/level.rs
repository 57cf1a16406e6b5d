//! The body that turns above a level of a wall of parts.
//!
//! A crack at a level cuts a body out of the wall: the parts, openings and loads above it, about the edges of
//! the contact of the sections just below and just above. A load at the level rests on what is below.

use super::part::{Item, Load, Opening, Part, ProfileError};
use super::profile::{Profile, SAME};

impl Profile {
    /// Returns the wall above a level, with heights from there and places from its own outer face.
    ///
    /// # Errors
    /// [`ProfileError`] of a level that is not within the wall, goes through a part that hangs on another,
    /// such as the wedge of a transverse wall, or where nothing stands on the section below.
    pub fn above(&self, level: f64) -> Result<Self, ProfileError> {
        let (height, same) = (self.height(), SAME * self.height());
        let level = self.snapped(level);
        if level.abs() <= same {
            return Ok(self.clone());
        }
        if !(level > 0.0 && level < height - same) {
            return Err(Item::Part(self.parts().len() - 1).refused(format!(
                "nothing turns above the level {level} m; levels are from 0 to below the top, {height} m"
            )));
        }
        let is_cut = |part: &Part| part.base < level - same && part.top() > level + same;
        if let Some(wedge) = self.hanging().into_iter().find(|index| is_cut(&self.parts()[*index])) {
            let Part { base, .. } = self.parts()[wedge];
            return Err(Item::Part(wedge).refused(format!(
                "the level {level} m goes through it, and it hangs on the side of another part from {base} m \
                 on; give a level at its foot, or the wedge that turns above the level alone"
            )));
        }
        let [outer, inner] = self
            .hinge_edges(level)
            .map_err(|error| Item::Part(0).refused(format!("the level {level} m: {error}")))?;
        let face = self.faces_beside(level, true);
        let from = face[0];
        let parts = self.parts().iter().filter(|part| part.top() > level + same);
        let parts: Vec<_> = parts.map(|part| part.above(level, from, same)).collect();
        let reaches = |opening: &&Opening| opening.top() > level + same;
        let openings = self.openings().iter().filter(reaches).map(|opening| opening.above(level, from));
        let openings = openings.filter(|opening| parts.iter().any(|part| opening.cut(part, same).is_some()));
        let openings = openings.collect();
        let loads = self.loads().iter().filter(|load| load.height > level + same);
        let loads =
            loads.map(|load| Load { height: load.height - level, inside: load.inside - from, ..*load });
        let above = Self::of_checked(parts, openings, loads.collect());
        let is_narrower = outer > face[0] + same || inner < face[1] - same;
        Ok(if is_narrower { above.bearing_on([outer - from, inner - from]) } else { above })
    }

    /// Returns the parts that stand neither on the base nor on another part, and hang on the side of one, by
    /// their places in the list.
    pub fn hanging(&self) -> Vec<usize> {
        let same = SAME * self.height();
        let hangs = |part: &Part| {
            let foot = part.section(part.base);
            let stands = |other: &Part| {
                (other.top() - part.base).abs() <= same && foot.overlap(&other.section(other.top())) > same
            };
            let is_on_base = part.base <= same && foot.inner - foot.outer > same;
            !is_on_base && !self.parts().iter().any(stands)
        };
        (0..self.parts().len()).filter(|index| hangs(&self.parts()[*index])).collect()
    }

    /// Returns the outer and the inner face of the top section \[m\].
    pub fn top_faces(&self) -> [f64; 2] {
        self.faces_beside(self.height(), false)
    }

    /// Returns the least width of the sections in contact at a height, the base among them \[m\].
    pub fn contact_width(&self, z: f64) -> f64 {
        let same = SAME * self.height();
        let sections = self.parts().iter().filter(|part| part.base <= z + same && z - same <= part.top());
        let sections = sections.map(|part| part.section(z.clamp(part.base, part.top())));
        let touching = sections.filter(|section| section.inner - section.outer > same);
        touching.map(|section| section.width).fold(f64::INFINITY, f64::min)
    }
}

impl Part {
    /// What is above a level of a part that reaches beyond it, from the level and a face on \[m\].
    fn above(&self, level: f64, face: f64, same: f64) -> Self {
        let foot = if self.base < level - same { level } else { self.base };
        let (bottom, top) = (self.section(foot), self.section(self.top()));
        let is_whole = foot == self.base;
        let ends = |own: [f64; 2], cut: [f64; 2]| if is_whole { own } else { cut };
        Self {
            base: if foot <= level + same { 0.0 } else { foot - level },
            height: if is_whole { self.height } else { self.top() - level },
            thickness: ends(self.thickness, [bottom.inner - bottom.outer, self.thickness[1]]),
            width: ends(self.width, [bottom.width, self.width[1]]),
            outer: ends(self.outer, [bottom.outer, top.outer]).map(|outer| outer - face),
            density: self.density,
        }
    }
}

impl Opening {
    /// What is above a level of an opening that reaches beyond it, from the level and a face on \[m\].
    fn above(&self, level: f64, face: f64) -> Self {
        let foot = self.base.max(level);
        let hollow = self.hollow.map(|mut hollow| {
            hollow.outer -= face;
            hollow
        });
        Self { base: foot - level, height: self.top() - foot, hollow, ..*self }
    }
}
