//! Branches and corners of a wall, laid out once.

use crate::variables::DampingModel;

use super::{Branch, BranchDamping, Corner, RATIO_CUTOFF, Sides, Wall};

impl Wall {
    /// Fills `branches` and `corners` from the force, the damping and the body.
    pub(super) fn lay_out(&mut self) {
        let mut corners =
            vec![Corner { displacement: 0.0, passage: self.impact || self.is_rigid(), ..Corner::default() }];
        for (side, sign) in [(&self.force.positive, 1.0), (&self.force.negative, -1.0)] {
            let of = |sides: Sides| sides.of(sign);
            let mut place = |displacement: f64, mark: fn(&mut Corner)| {
                if displacement < of(self.body.landing) || displacement == of(self.body.landing) {
                    insert(&mut corners, sign * displacement, mark);
                }
            };
            if self.rotations.is_none() {
                for &corner in &side.corners {
                    place(corner, |_| {});
                }
                place(side.end, |_| {});
            }
            if self.damping.model == DampingModel::ConstantRatio {
                place(side.end * (1.0 - RATIO_CUTOFF), |_| {});
            }
            place(of(self.body.instability), |corner| corner.overturning = true);
            place(of(self.body.departure), |corner| corner.departure = true);
            place(of(self.body.landing), |corner| corner.landing = true);
        }
        corners.sort_by(|a, b| a.displacement.total_cmp(&b.displacement));
        if !corners.iter().any(|corner| corner.displacement == 0.0 && corner.passage) {
            // One elastic line runs through the origin.
            corners.retain(|corner| corner.displacement != 0.0);
        }
        self.branches = corners.windows(2).map(|pair| self.branch_between(&pair[0], &pair[1])).collect();
        self.corners = corners;
    }

    fn branch_between(&self, from: &Corner, to: &Corner) -> Branch {
        let (lower, upper) = (from.displacement, to.displacement);
        let middle = 0.5 * (lower + upper);
        let side = if middle < 0.0 { &self.force.negative } else { &self.force.positive };
        let reach = middle.abs();
        let index = side.corners.partition_point(|&corner| corner <= reach);
        let line = side.lines[index];
        let elastic = index == 0 && self.force.elastic_stiffness.is_some();
        let end = match self.damping.model {
            DampingModel::ConstantRatio => side.end * (1.0 - RATIO_CUTOFF),
            _ => side.end,
        };
        let damping = if elastic {
            BranchDamping::Constant(self.damping.elastic)
        } else if reach > end {
            self.damping.beyond_end()
        } else {
            self.damping.on_curved_branch()
        };
        let m = self.body.effective_mass;
        Branch {
            lower,
            upper,
            anchor: line.anchor,
            force: line.force / m,
            stiffness: line.slope / m,
            damping,
        }
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
