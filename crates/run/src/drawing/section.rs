//! The section of a wall, seen along the wall: the outside is on the right.

use report::number;
use rocking_wall::wall::{Load, Parameters, Part, Tie, Wall};

use super::canvas::{Anchor, Canvas, FORCE, HINGE, LINE, Label, OPENING, STONE, TIE};
use super::shape::Shape;
use super::{MOST_LABELS, bar, kilonewtons, metres};

/// The axis of the wall, and its room: width and height \[px\].
const AXIS: f64 = 158.0;
const ROOM: [f64; 2] = [90.0, 290.0];
/// Room above the wall for loads, and half the width of supports \[px\].
const ABOVE: f64 = 62.0;
const SUPPORT: f64 = 85.0;
/// Places of the dimensions of the height and of the hinge \[px\].
const HEIGHT: f64 = 396.0;
const HINGE_HEIGHT: f64 = 12.0;
/// Length of an arrow \[px\].
const ARROW: f64 = 28.0;

/// What is drawn, and where.
struct Section<'a> {
    canvas: &'a mut Canvas,
    shape: &'a Shape,
    /// px for a metre.
    scale: f64,
    /// The x that is drawn on the axis \[m\].
    middle: f64,
    /// y of the base \[px\].
    foot: f64,
    /// Labels on the left and on the right of the wall.
    labels: [Vec<Label>; 2],
}

/// Draws the section on the top of a canvas, and returns where it ends \[px\].
pub(super) fn draw(canvas: &mut Canvas, shape: &Shape, wall: &Wall, parameters: &Parameters) -> f64 {
    let [outer, inner] = shape.extent();
    let scale = (ROOM[1] / shape.height).min(ROOM[0] / (inner - outer).max(1e-6));
    let above = if shape.overburden.is_some() || is_loaded_on_top(shape) { ABOVE } else { 26.0 };
    let foot = above + scale * shape.height;
    let middle = 0.5 * (outer + inner);
    let mut section = Section { canvas, shape, scale, middle, foot, labels: [Vec::new(), Vec::new()] };
    section.supports(wall);
    section.parts();
    section.openings();
    section.ties(wall);
    section.loads();
    section.centroids(parameters);
    section.hinges(wall);
    section.write_labels();
    section.dimensions();
    foot + 76.0
}

fn is_loaded_on_top(shape: &Shape) -> bool {
    shape.loads.iter().any(|load| load.force > 0.0 && load.height > 0.9 * shape.height)
}

impl Section<'_> {
    fn x(&self, x: f64) -> f64 {
        AXIS - self.scale * (x - self.middle)
    }

    fn y(&self, z: f64) -> f64 {
        self.foot - self.scale * z
    }

    fn at(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        [self.x(x), self.y(z)]
    }

    /// The left and the right end of the wall \[px\].
    fn sides(&self) -> [f64; 2] {
        let [outer, inner] = self.shape.extent();
        [self.x(inner), self.x(outer)]
    }

    /// Adds a label on the outside or the inside, at the face there.
    fn label(&mut self, is_outside: bool, y: f64, text: String) {
        let (outer, inner) = self.shape.faces(((self.foot - y) / self.scale).clamp(0.0, self.shape.height));
        let face = if is_outside { outer } else { inner };
        self.labels[usize::from(is_outside)].push(Label { from: [self.x(face), y], text });
    }

    fn supports(&mut self, wall: &Wall) {
        let (foot, top) = (self.foot, self.y(self.shape.height));
        self.canvas.rect([AXIS - SUPPORT, AXIS + SUPPORT], [foot, foot + 9.0], STONE);
        if self.shape.hinge.is_some() {
            self.canvas.rect([AXIS - SUPPORT, AXIS + SUPPORT], [top - 9.0, top], STONE);
        }
        // as far as the thinnest place of the wall, which is drawn on it
        let [outer, inner] = self.shape.thinnest().map(|x| self.x(x));
        match wall.free_side() {
            Some(side) if side > 0.0 => self.canvas.rect([AXIS - SUPPORT, inner], [top, foot], STONE),
            Some(_) => self.canvas.rect([outer, AXIS + SUPPORT], [top, foot], STONE),
            None => {}
        }
    }

    fn parts(&mut self) {
        let few = self.shape.parts.len() <= MOST_LABELS;
        let mut density = 0.0;
        for part in &self.shape.parts {
            let Some(corners) = Shape::corners(part, [part.base, part.top()]) else { continue };
            let corners = corners.map(|corner| self.at(corner));
            self.canvas.polygon(&corners, &super::masonry(part.density));
            if few {
                let y = self.y(part.base + 0.72 * part.height);
                let text = of_part(part, self.canvas.words.to);
                let is_other = part.density != density;
                density = part.density;
                let text = if is_other { format!("{text}, {} kg/m³", number(density, 5)) } else { text };
                self.label(true, y, text);
            }
        }
        if self.shape.parts.is_empty() {
            let [outer, inner] = self.shape.toes.map(|toe| self.x(toe));
            let x = self.shape.centroids.first().map_or(AXIS, |centroid| self.x(centroid.x));
            let top = self.y(self.shape.height);
            let look = "stroke=\"#6b4a33\" stroke-width=\"2\" stroke-dasharray=\"6 4\"";
            self.canvas.line([x, self.foot], [x, top], look);
            self.canvas.line([x - 8.0, top], [x + 8.0, top], look);
            self.canvas.line([outer, self.foot], [inner, self.foot], "stroke=\"#6b4a33\" stroke-width=\"3\"");
        }
    }

    fn openings(&mut self) {
        let shape = self.shape;
        for opening in &shape.openings {
            if let Some(corners) = shape.opened(opening, [0.0, shape.height]) {
                let corners = corners.map(|corner| self.at(corner));
                self.canvas.polygon(&corners, &format!("data-drawn=\"opening\" {OPENING}"));
            }
        }
    }

    fn ties(&mut self, wall: &Wall) {
        for tie in wall.ties().iter() {
            self.tie(tie);
        }
    }

    fn tie(&mut self, tie: &Tie) {
        let z = tie.height;
        let (outer, inner) = self.shape.faces(z);
        let y = self.y(z);
        for sign in [1.0, -1.0].into_iter().filter(|sign| tie.holds(*sign)) {
            // through the wall, with a plate on the face that would move away
            let face = self.x(if sign > 0.0 { outer } else { inner });
            let far = AXIS - 1.15 * SUPPORT.copysign(sign);
            self.canvas.line([face, y], [far, y], &format!("data-drawn=\"tie\" {TIE}"));
            let plate = face + 2.0_f64.copysign(sign);
            self.canvas.line([plate, y - 8.0], [plate, y + 8.0], TIE);
        }
        let (is_outside, words) = (!tie.holds(1.0), self.canvas.words);
        self.label(is_outside, y + 14.0, format!("{} {} {}", words.tie, words.at, metres(z)));
        if let Some(strength) = tie.strength {
            self.label(is_outside, y + 14.0 + LINE, format!("{} {}", words.up_to, kilonewtons(strength)));
        }
    }

    /// Loads are arrows downwards to their places, thrusts arrows at the outer face.
    fn loads(&mut self) {
        let few = self.shape.loads.len() <= MOST_LABELS;
        let (shape, words) = (self.shape, self.canvas.words);
        for load in &shape.loads {
            let Load { force, height, inside, thrust, .. } = *load;
            let at = self.at([inside, height]);
            if force > 0.0 {
                self.canvas.arrow("load", at, [0.0, -ARROW]);
                if few {
                    let text = format!("{} {} {}", kilonewtons(force), words.at, metres(height));
                    // clear of the support of a strip
                    let is_on_top = shape.hinge.is_some() && height == shape.height;
                    self.label(false, at[1] - if is_on_top { ARROW } else { 0.4 * ARROW }, text);
                }
            }
            if thrust != 0.0 {
                let face = self.x(shape.faces(height).0);
                let (tip, tail) = if thrust > 0.0 { (ARROW + 4.0, -ARROW) } else { (2.0, ARROW) };
                self.canvas.arrow("thrust", [face + tip, at[1]], [tail, 0.0]);
                if few {
                    let text = format!("{} {}", words.thrust, kilonewtons(thrust.abs()));
                    self.labels[1].push(Label { from: [face + ARROW + 6.0, at[1]], text });
                }
            }
        }
        if !few {
            self.label(false, self.foot - 20.0, format!("{} {}", shape.loads.len(), words.loads));
        }
        if let Some(Load { force, height, inside, .. }) = shape.overburden {
            let [x, mut y] = self.at([inside, height]);
            if shape.hinge.is_some() {
                y -= 9.0;
            }
            self.canvas.arrow("load", [x, y], [0.0, -ARROW - 6.0]);
            let text = format!("O = {}", kilonewtons(force));
            self.canvas.text([x + 10.0, y - 20.0], Anchor::Start, &text);
        }
    }

    fn centroids(&mut self, parameters: &Parameters) {
        let (shape, words) = (self.shape, self.canvas.words);
        for (index, centroid) in shape.centroids.iter().enumerate() {
            let [x, y] = self.at([centroid.x, centroid.z]);
            let look = format!("fill=\"#fff\" stroke=\"{FORCE}\" stroke-width=\"1.5\"");
            self.canvas.circle([x, y], 4.5, &look);
            self.canvas.circle([x, y], 1.5, &format!("fill=\"{FORCE}\""));
            let name = if shape.centroids.len() > 1 { ["W₁", "W₂"][index.min(1)] } else { "W" };
            let weight = number(1e-3 * centroid.mass * parameters.gravity, 3);
            let text = format!("{name} = {weight} kN {} {} m", words.at, number(centroid.z, 3));
            self.label(true, y, text);
        }
    }

    /// One body turns about the toe towards u; a strip also opens at its hinge, about the other edge.
    fn hinges(&mut self, wall: &Wall) {
        let shape = self.shape;
        for sign in wall.sides() {
            let [near, far] = if sign > 0.0 { [0, 1] } else { [1, 0] };
            let mut places = vec![[shape.toes[near], 0.0]];
            places.extend(shape.hinge.map(|hinge| [hinge.edges[far], hinge.height]));
            let fill = if sign > 0.0 { HINGE } else { "#fff" };
            let look = format!("data-drawn=\"hinge\" fill=\"{fill}\" stroke=\"{HINGE}\" stroke-width=\"2\"");
            for place in places {
                let at = self.at(place);
                self.canvas.circle(at, 4.5, &look);
            }
        }
    }

    fn write_labels(&mut self) {
        let [left, right] = self.sides();
        let has_thrust = self.shape.loads.iter().any(|load| load.thrust != 0.0);
        let beside = if has_thrust { ARROW + 14.0 } else { 14.0 };
        let room = [self.y(self.shape.height) - 20.0, self.foot - 10.0];
        let [on_left, on_right] = std::mem::take(&mut self.labels);
        self.canvas.labels(on_left, left - 12.0, Anchor::End, room);
        self.canvas.labels(on_right, right + beside, Anchor::Start, room);
    }

    fn dimensions(&mut self) {
        let (foot, height) = (self.foot, self.shape.height);
        let top = self.y(height);
        self.canvas.upwards(HEIGHT, [foot, top], &format!("h = {}", metres(height)));
        if let Some(hinge) = self.shape.hinge {
            let y = self.y(hinge.height);
            self.canvas.upwards(HINGE_HEIGHT, [foot, y], &format!("h₁ = {}", metres(hinge.height)));
        }
        let [outer, inner] = self.shape.toes;
        let base = format!("b = {}", metres(inner - outer));
        let ends = [self.x(inner), self.x(outer)];
        self.canvas.across(ends, foot + 22.0, &base);
        self.canvas.text([AXIS - SUPPORT, foot + 27.0], Anchor::End, self.canvas.words.inside);
        self.canvas.text([AXIS + SUPPORT + 6.0, foot + 8.0], Anchor::Start, self.canvas.words.outside);
        let y = foot + 61.0;
        bar(self.canvas, [12.0, y], self.scale);
        let x = 210.0;
        self.canvas.line(
            [x, y - 3.0],
            [x + 34.0, y - 3.0],
            &format!("stroke=\"{HINGE}\" stroke-width=\"2\""),
        );
        let tip = [[x + 40.0, y - 3.0], [x + 31.0, y - 7.5], [x + 31.0, y + 1.5]];
        self.canvas.polygon(&tip, &format!("fill=\"{HINGE}\""));
        self.canvas.text([x + 48.0, y + 1.0], Anchor::Start, self.canvas.words.outwards);
    }
}

/// Thickness of a part; of a wedge with its tip below also the angle of its inner face from the vertical.
fn of_part(part: &Part, to: &str) -> String {
    let [bottom, top] = part.thickness;
    if bottom == top {
        return metres(bottom);
    }
    let thickness = format!("{} {to} {}", number(bottom, 4), metres(top));
    if bottom > 0.0 {
        return thickness;
    }
    let angle = ((top + part.outer[1] - part.outer[0]) / part.height).atan().to_degrees();
    format!("{thickness}, β = {}°", number(angle, 3))
}
