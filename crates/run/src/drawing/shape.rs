//! The shape of a wall, whatever states it: a rectangle, parts, or integrals.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{COMPUTED, Centroid, Load, Opening, Parameters, Part, Profile, Wall};

/// What pictures show of a wall: x inwards from the outer face of the lowest part at its foot, z upwards from
/// the base \[m\].
#[derive(Clone, Debug)]
pub struct Shape {
    /// Height of its top.
    pub height: f64,
    /// Its parts; none where only integrals are given.
    pub parts: Vec<Part>,
    /// Its openings.
    pub openings: Vec<Opening>,
    /// Its loads, without the overburden.
    pub loads: Vec<Load>,
    /// The overburden, where it acts for u > 0.
    pub overburden: Option<Load>,
    /// Places x of the outer toe, about which it turns for u > 0, and of the inner one.
    pub toes: [f64; 2],
    /// The hinge of a strip.
    pub hinge: Option<Hinge>,
    /// The centroid of each body.
    pub centroids: Vec<Centroid>,
}

/// The hinge of a strip.
#[derive(Clone, Copy, Debug)]
pub struct Hinge {
    /// Height above the base \[m\].
    pub height: f64,
    /// Places x of the outer edge, about which it opens for u < 0, and of the inner one \[m\].
    pub edges: [f64; 2],
}

impl Shape {
    /// Returns the shape of a wall with its parameters.
    pub fn new(wall: &Wall, parameters: &Parameters) -> Self {
        let mut shape = match &parameters.profile {
            Some(profile) => Self::of_parts(wall, profile),
            None if parameters.mechanism == Mechanism::RigidBody => Self::of_integrals(wall, parameters),
            None => {
                let Parameters { height, thickness, width, density, .. } = *parameters;
                let part = Part {
                    base: 0.0,
                    height,
                    thickness: [thickness; 2],
                    width: [width; 2],
                    outer: [0.0; 2],
                    density,
                };
                let profile = Profile::new(vec![part], Vec::new(), Vec::new());
                // a size beyond those of parts leaves a shape without parts
                let empty = Self { toes: [0.0, thickness], ..Self::empty(height) };
                profile.map_or(empty, |profile| Self::of_parts(wall, &profile))
            }
        };
        let force = wall.body().overburden;
        if force > 0.0 {
            let (outer, inner) = shape.faces(shape.height);
            let inside = 0.5 * (outer + inner) - parameters.overburden_eccentricity;
            let height = shape.height;
            shape.overburden = Some(Load::resting(force, height, inside));
        }
        shape
    }

    fn empty(height: f64) -> Self {
        Self {
            height,
            parts: Vec::new(),
            openings: Vec::new(),
            loads: Vec::new(),
            overburden: None,
            toes: [0.0; 2],
            hinge: None,
            centroids: Vec::new(),
        }
    }

    fn of_parts(wall: &Wall, profile: &Profile) -> Self {
        let height = profile.height();
        let hinge = wall.body().hinge().and_then(|at| {
            let edges = profile.hinge_edges(at).ok()?;
            Some(Hinge { height: at, edges })
        });
        let ends = hinge.map_or(vec![0.0, height], |hinge| vec![0.0, hinge.height, height]);
        Self {
            parts: profile.parts().to_vec(),
            openings: profile.openings().to_vec(),
            loads: profile.loads().to_vec(),
            toes: profile.toes(),
            hinge,
            centroids: ends.windows(2).map(|ends| profile.centroid([ends[0], ends[1]])).collect(),
            ..Self::empty(height)
        }
    }

    /// A rigid body states its centroid, its hinges and the sums of its loads.
    fn of_integrals(wall: &Wall, parameters: &Parameters) -> Self {
        let Parameters { arm, arm_inner, load_force: force, load_arm, gravity, .. } = *parameters;
        let inner = if arm_inner == COMPUTED { arm } else { arm_inner };
        let toes = [0.0, arm + inner];
        let weight = (force > 0.0).then(|| {
            let moving_mass = Some(parameters.load_mass * gravity / force);
            Load { moving_mass, ..Load::resting(force, parameters.load_height, load_arm) }
        });
        let thrust = (parameters.thrust != 0.0).then(|| {
            let (height, thrust) = (parameters.thrust_height, parameters.thrust);
            Load { thrust, ..Load::resting(0.0, height, arm) }
        });
        let centroid = Centroid { mass: wall.body().mass, x: arm, z: wall.body().centroid_height };
        Self {
            loads: weight.into_iter().chain(thrust).collect(),
            toes,
            centroids: vec![centroid],
            ..Self::empty(wall.body().height)
        }
    }

    /// Returns the outermost and the innermost place of parts and toes \[m\].
    pub fn extent(&self) -> [f64; 2] {
        let faces = self.parts.iter().flat_map(|part| [part.base, part.top()].map(|z| part.section(z)));
        faces.fold(self.toes, |[outer, inner], section| [outer.min(section.outer), inner.max(section.inner)])
    }

    /// Returns the innermost outer face and the outermost inner face of all parts \[m\]; of a body without
    /// parts the toes.
    pub fn thinnest(&self) -> [f64; 2] {
        let faces = self.parts.iter().flat_map(|part| [part.base, part.top()].map(|z| part.section(z)));
        let faces = faces.map(|section| [section.outer, section.inner]);
        faces.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])]).unwrap_or(self.toes)
    }

    /// Returns the outer and the inner face at a height \[m\]; the axis of a body without parts.
    pub fn faces(&self, z: f64) -> (f64, f64) {
        if let ([], [centroid]) = (&self.parts[..], &self.centroids[..]) {
            return (centroid.x, centroid.x);
        }
        let same = 1e-9 * self.height;
        let at = self.parts.iter().filter(|part| part.base <= z + same && z <= part.top() + same);
        let sections = at.map(|part| part.section(z));
        let faces = sections.map(|section| [section.outer, section.inner]);
        let [outer, inner] = faces.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or(self.toes);
        (outer, inner)
    }

    /// Returns the heights of each body \[m\]: one, or those below and above the hinge.
    pub fn bodies(&self) -> Vec<[f64; 2]> {
        let top = self.height;
        self.hinge.map_or(vec![[0.0, top]], |hinge| vec![[0.0, hinge.height], [hinge.height, top]])
    }

    /// Returns the corners `[x, z]` of a part between two heights, in turn; `None` where it is not there.
    pub fn corners(part: &Part, [from, to]: [f64; 2]) -> Option<[[f64; 2]; 4]> {
        let [from, to] = [from.max(part.base), to.min(part.top())];
        (from < to).then(|| {
            let [bottom, top] = [from, to].map(|z| part.section(z));
            [[bottom.outer, from], [bottom.inner, from], [top.inner, to], [top.outer, to]]
        })
    }

    /// Returns the corners `[x, z]` of what an opening takes out between two heights.
    pub fn opened(&self, opening: &Opening, [from, to]: [f64; 2]) -> Option<[[f64; 2]; 4]> {
        let [from, to] = [from.max(opening.base), to.min(opening.top())];
        // faces of parts above and below an edge differ: those within the opening count
        let within = 1e-6 * (to - from);
        let at = |z: f64| {
            opening
                .hollow
                .map_or_else(|| self.faces(z), |hollow| (hollow.outer, hollow.outer + hollow.thickness))
        };
        (from < to).then(|| {
            let [bottom, top] = [at(from + within), at(to - within)];
            [[bottom.0, from], [bottom.1, from], [top.1, to], [top.0, to]]
        })
    }

    /// Returns whether its front shows more than a rectangle: its width varies, or there are openings.
    pub fn has_front(&self) -> bool {
        let width = self.parts.first().map_or(1.0, |part| part.width[0]);
        let varies = |part: &Part| part.width.iter().any(|own| *own != width);
        !self.openings.is_empty() || self.parts.iter().any(varies)
    }
}
