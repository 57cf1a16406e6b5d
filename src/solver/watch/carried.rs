//! The acceleration that the reactions of a wall carry, over a length of motion: ü, and in full rotations
//! that of the momentum of masonry and loads.

use oscillator::KinematicState;

use crate::wall::{Branch, Wall};

/// The acceleration that the reactions of a wall carry: at both ends of a motion, and the bound on its second
/// derivative \[m/s², m/s⁴\].
#[derive(Clone, Copy)]
pub(super) struct Carried {
    pub(super) ends: [f64; 2],
    pub(super) most: f64,
}

impl Carried {
    /// Returns it from the ends of a motion over a length \[s\], with bounds on |ü|, on the jerk and on the
    /// second derivative of ü.
    pub(super) fn new(
        wall: &Wall,
        branch: &Branch,
        ends: [KinematicState; 2],
        length: f64,
        [acceleration, jerk, snap]: [f64; 3],
    ) -> Self {
        let most = if wall.rotations().is_none() {
            snap
        } else {
            let [by_a, by_jerk, by_snap, more] = curvature(wall, branch, ends, length, acceleration);
            by_a * acceleration + by_jerk * jerk + by_snap * snap + more
        };
        Self { ends: ends.map(|motion| wall.carried(branch.side(), motion)), most }
    }
}

/// Bounds the second derivative of that acceleration over a length of motion \[s\] with a bound on |ü|:
/// shares of the bounds on |ü|, on the jerk and on the second derivative of ü, and a number.
pub(super) fn curvature(
    wall: &Wall,
    branch: &Branch,
    [start, end]: [KinematicState; 2],
    length: f64,
    most: f64,
) -> [f64; 4] {
    let Some(rotations) = wall.rotations() else { return [0.0, 0.0, 1.0, 0.0] };
    let sag = 0.125 * length * length * most;
    let (u, v) = ([start.displacement, end.displacement], [start.velocity, end.velocity]);
    let range = [u[0].min(u[1]) - sag, u[0].max(u[1]) + sag];
    let speed = v[0].abs().max(v[1].abs()) + 0.5 * length * most;
    rotations.carried_curvature(branch.side(), range, [speed, most])
}
