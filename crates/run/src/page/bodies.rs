//! What moves on a page: the bodies of a wall with their loads, x outwards from the middle of the base and z
//! upwards \[m\].

use std::fmt::Write;

use rocking_wall::wall::{Centroid, Load, Parameters, Wall};
use serde_json::{Value, json};

use crate::drawing::Shape;

/// The shape of a wall as it moves.
pub(super) struct Moving<'a> {
    wall: &'a Wall,
    pub(super) shape: Shape,
    is_rectangle: bool,
}

impl<'a> Moving<'a> {
    pub(super) fn new(wall: &'a Wall, parameters: &Parameters) -> Self {
        let shape = Shape::new(wall, parameters);
        Self { wall, shape, is_rectangle: parameters.is_rectangle() }
    }

    /// The place of an x of the shape.
    fn x(&self, x: f64) -> f64 {
        0.5 * (self.shape.toes[0] + self.shape.toes[1]) - x
    }

    /// Distance of the toes.
    pub(super) fn base(&self) -> f64 {
        self.shape.toes[1] - self.shape.toes[0]
    }

    /// Twice the distance of the farthest place from the middle of the base.
    pub(super) fn breadth(&self) -> f64 {
        self.shape.extent().map(|x| 2.0 * self.x(x).abs()).into_iter().fold(self.base(), f64::max)
    }

    /// What turns a body that is no rectangle, null for a rectangle: toes and edges of the hinge for u > 0
    /// and for u < 0, the height at which u is measured and the arms of the centroid from the toes there, and
    /// for each body its parts with their corners.
    pub(super) fn data(&self) -> Value {
        if self.is_rectangle {
            return Value::Null;
        }
        let parts = |heights: [f64; 2]| {
            let parts = self.shape.parts.iter().filter_map(|part| Shape::corners(part, heights));
            parts.map(|corners| self.placed(corners).to_vec()).chain(self.arms()).collect::<Vec<_>>()
        };
        let bodies: Vec<_> = self.shape.bodies().into_iter().map(parts).collect();
        // the hinge opens about the edge away from u
        let edges = self.shape.hinge.map(|hinge| [hinge.edges[1], hinge.edges[0]].map(|x| self.x(x)));
        let arms = match self.shape.centroids[..] {
            [Centroid { x, .. }] => Some([x - self.shape.toes[0], self.shape.toes[1] - x]),
            _ => None,
        };
        json!({
            "toes": self.shape.toes.map(|x| self.x(x)),
            "edges": edges,
            "centroid": self.wall.body().centroid_height,
            "arms": arms,
            "bodies": bodies,
        })
    }

    fn placed(&self, corners: [[f64; 2]; 4]) -> [[f64; 2]; 4] {
        corners.map(|[x, z]| [self.x(x), z])
    }

    /// Draws what stands between two heights: parts, dashed openings and loads, or the arms of a body that is
    /// given by its integrals. Arrows have lines of the width `line`.
    pub(super) fn body(&self, heights: [f64; 2], line: f64) -> String {
        let mut svg = String::new();
        for corners in self.shape.parts.iter().filter_map(|part| Shape::corners(part, heights)) {
            write_polygon(&mut svg, "body", &self.placed(corners));
        }
        for opening in &self.shape.openings {
            if let Some(corners) = self.shape.opened(opening, heights) {
                write_polygon(&mut svg, "opening", &self.placed(corners));
            }
        }
        for arms in self.arms() {
            write_polygon(&mut svg, "arms", &arms);
        }
        let [from, to] = heights;
        let loads = self.shape.loads.iter().chain(&self.shape.overburden);
        // a load at the height of a hinge is one of the lower body
        let own = loads.filter(|load| load.height <= to && (load.height > from || from == 0.0));
        own.for_each(|load| self.write_load(&mut svg, load, line));
        svg
    }

    /// Of a body by its integrals: the lines from its toes to its centroid, and from there to the top.
    fn arms(&self) -> Vec<Vec<[f64; 2]>> {
        let [Centroid { x, z, .. }] = self.shape.centroids[..] else { return Vec::new() };
        if !self.shape.parts.is_empty() {
            return Vec::new();
        }
        let ([outer, inner], centroid) = (self.shape.toes.map(|toe| [self.x(toe), 0.0]), [self.x(x), z]);
        vec![vec![outer, inner, centroid], vec![centroid, [centroid[0], self.shape.height]]]
    }

    fn write_load(&self, svg: &mut String, load: &Load, line: f64) {
        let mut arrow = |class: &str, [x, z]: [f64; 2], turn: f64| {
            // writing to a String cannot fail
            let _ = write!(
                svg,
                "<path class=\"{class}\" transform=\"translate({x:.4} {z:.4}) rotate({turn}) \
                 scale({line:.4})\" d=\"M0 1l-3 6h2v18h2v-18h2z\"/>"
            );
        };
        if load.force > 0.0 {
            arrow("force", [self.x(load.inside), load.height], 0.0);
        }
        if load.thrust != 0.0 {
            let face = self.x(self.shape.faces(load.height).0);
            // outwards it begins at the face, inwards it ends there
            let (x, turn) = if load.thrust > 0.0 { (face + 26.0 * line, 90.0) } else { (face, -90.0) };
            arrow("force thrust", [x, load.height], turn);
        }
    }
}

fn write_polygon(svg: &mut String, class: &str, corners: &[[f64; 2]]) {
    let points: Vec<_> = corners.iter().map(|[x, z]| format!("{x:.4},{z:.4}")).collect();
    let points = points.join(" ");
    let _ = write!(svg, "<polygon class=\"{class}\" points=\"{points}\"/>");
}
