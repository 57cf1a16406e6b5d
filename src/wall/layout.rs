//! Lays out the branches and corners of a wall.

use super::branch::{Branch, Corner, Couple};
use super::equation::Wall;
use super::force_law::Line;
use super::sides::Sides;
use super::statics::Statics;

impl Wall {
    /// Returns the corners in order of displacement, the two landings first and last. Ties have those that
    /// belong to their memory. A wall with one free side has no landing on the other: the corner at u = 0 is
    /// its end there.
    pub(super) fn lay_out_corners(&self) -> Vec<Corner> {
        let Statics { body, force, .. } = self.statics();
        let passage = self.impact || self.is_rigid();
        let stop = self.free_side().is_some();
        let mut corners = vec![Corner { displacement: 0.0, passage, stop, ..Corner::default() }];
        let memory = *self.tie_memory();
        for sign in self.sides() {
            let side = force.side(sign);
            let of = |sides: Sides| sides.of(sign);
            let mut place = |displacement: f64, mark: fn(&mut Corner)| {
                if displacement <= of(body.landing) {
                    insert(&mut corners, sign * displacement, mark);
                }
            };
            if self.rotations().is_none() {
                for &corner in &side.corners {
                    place(corner, |_| {});
                }
                place(side.end, |_| {});
                place(side.end * self.damping.rocking.end(), |_| {});
            }
            for hold in self.ties().holds(sign, memory) {
                let mut before_departure = |displacement: f64, mark: fn(&mut Corner)| {
                    if displacement < of(body.departure) {
                        place(displacement, mark);
                    }
                };
                before_departure(hold.onset, |_| {});
                before_departure(hold.yields, |_| {});
                before_departure(hold.breaks, |corner| corner.fracture = true);
            }
            place(of(body.instability), |corner| corner.overturning = true);
            place(of(body.departure), |corner| corner.departure = true);
            place(of(body.landing), |corner| corner.landing = true);
        }
        corners.sort_by(|a, b| a.displacement.total_cmp(&b.displacement));
        let of_both = [1.0, -1.0].into_iter().flat_map(|sign| self.ties().holds(sign, memory));
        let pulls_at_once = of_both.map(|hold| hold.onset).any(|onset| onset == 0.0);
        if !passage && force.is_straight() && !body.has_bent_couple() && !pulls_at_once {
            // One elastic line runs through the origin, and one line of the couple.
            corners.retain(|corner| corner.displacement != 0.0);
        }
        corners
    }

    /// Returns the branches between the corners.
    ///
    /// The body and the side are known here: a damping law that needs more than F(u), such as `u_ins`, gets
    /// it from here, for `DampingLaw` holds one law for both sides. A law that changes at some |u| has a
    /// corner there, and is chosen here.
    pub(super) fn lay_out_branches(&self) -> Vec<Branch> {
        let m = self.body().effective_mass;
        let between = |pair: &[Corner]| {
            let (lower, upper) = (pair[0].displacement, pair[1].displacement);
            let middle = 0.5 * (lower + upper);
            let side = self.statics().force.side(middle);
            let reach = middle.abs();
            let index = side.corners.partition_point(|&corner| corner <= reach);
            let line = side.lines[index];
            let is_beyond = reach > side.end * self.damping.rocking.end();
            let damping = self.damping.on_branch(line.is_elastic(), is_beyond);
            let couple = Couple::on(&line, self.body(), middle);
            let own = Line { anchor: line.anchor, force: line.force / m, slope: line.slope / m };
            let tie = self.ties().action(lower, upper, self.tie_memory());
            let line = self.ties().added_to(own, [lower, upper], self.tie_memory(), m);
            let Line { anchor, force, slope: stiffness } = line;
            Branch { lower, upper, anchor, force, stiffness, own, tie, couple, damping }
        };
        self.corners().windows(2).map(between).collect()
    }
}

fn insert(corners: &mut Vec<Corner>, displacement: f64, mark: fn(&mut Corner)) {
    let found = corners.iter_mut().find(|corner| corner.displacement == displacement);
    if let Some(corner) = found {
        mark(corner);
    } else {
        let mut corner = Corner { displacement, ..Corner::default() };
        mark(&mut corner);
        corners.push(corner);
    }
}
