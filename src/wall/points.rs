//! The masses and loads of a wall of parts, as points.
//!
//! The equation of motion and the impulses of an impact need integrals of polynomials of second degree over
//! the masonry. Gauss points give these exactly: two across the thickness and three over the height, on which
//! a prism's width, faces and squares of places make a polynomial of fourth degree. Loads are points as they
//! are. So every constant of a body is a sum over points.

use super::profile::{Profile, SAME};
use super::section::Section;

/// A mass that moves along with the wall and a force downwards, at a place of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    /// Mass \[kg\]; below 0 in an opening.
    pub(super) mass: f64,
    /// Force \[N\].
    pub(super) weight: f64,
    /// Thrust, positive outwards \[N\].
    pub(super) thrust: f64,
    /// Distance inwards from the outer face of the lowest part at its foot \[m\].
    pub(super) x: f64,
    /// Height above the base \[m\].
    pub(super) z: f64,
}

/// The mass of some masonry, and where its centroid is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centroid {
    /// Mass \[kg\].
    pub mass: f64,
    /// Distance inwards from the outer face of the lowest part at its foot \[m\].
    pub x: f64,
    /// Height above the base \[m\].
    pub z: f64,
}

impl Profile {
    /// Returns the centroid of the masonry between two heights \[m\].
    pub fn centroid(&self, heights: [f64; 2]) -> Centroid {
        let masonry = self.masonry(heights, 0.0);
        let sum = |of: fn(&Point) -> f64| masonry.iter().map(of).sum::<f64>();
        let mass = sum(|point| point.mass);
        Centroid {
            mass,
            x: sum(|point| point.mass * point.x) / mass,
            z: sum(|point| point.mass * point.z) / mass,
        }
    }

    /// Returns the masonry between two heights \[m\] under a gravity \[m/s²\].
    #[cold]
    pub(super) fn masonry(&self, [from, to]: [f64; 2], gravity: f64) -> Vec<Point> {
        let mut points = Vec::new();
        let same = SAME * self.height();
        for part in self.parts() {
            let within = |[base, top]: [f64; 2]| [base.max(from), top.min(to)];
            let whole = within([part.base, part.top()]);
            add_prism(&mut points, whole, [part.density, gravity], &|z| part.section(z));
            for opening in self.openings() {
                if let Some(heights) = opening.cut(part, same) {
                    let section = |z| opening.section(part, z);
                    add_prism(&mut points, within(heights), [-part.density, gravity], &section);
                }
            }
        }
        points
    }

    /// Returns the loads under a gravity \[m/s²\].
    pub(super) fn load_points(&self, gravity: f64) -> impl Iterator<Item = Point> {
        self.loads().iter().map(move |load| Point {
            mass: load.moving(gravity),
            weight: load.force,
            thrust: load.thrust,
            x: load.inside,
            z: load.height,
        })
    }
}

/// Adds the Gauss points of a prism between two heights \[m\], whose section is linear in between.
#[inline(never)]
fn add_prism(
    points: &mut Vec<Point>,
    [from, to]: [f64; 2],
    [density, gravity]: [f64; 2],
    section: &dyn Fn(f64) -> Section,
) {
    let length = to - from;
    if length <= 0.0 {
        return;
    }
    let (outermost, across) = (0.6_f64.sqrt(), (1.0_f64 / 3.0).sqrt());
    for (place, share) in [(-outermost, 5.0 / 18.0), (0.0, 8.0 / 18.0), (outermost, 5.0 / 18.0)] {
        let z = from + 0.5 * length * (1.0 + place);
        let Section { outer, inner, width } = section(z);
        let thickness = inner - outer;
        let mass = density * 0.5 * share * length * width * thickness;
        for place in [-across, across] {
            let x = outer + 0.5 * thickness * (1.0 + place);
            points.push(Point { mass, weight: mass * gravity, thrust: 0.0, x, z });
        }
    }
}
