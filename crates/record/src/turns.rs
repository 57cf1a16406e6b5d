//! Steps in which u turns, and may come back to a corner that it has passed: of one lane, where no other rule
//! serves (docs/record-path.md, §4).
//!
//! A wall that settles passes u = 0 a hundred times in a step, each time a little slower. Between two
//! passages ü keeps its sign: u is a convex or a concave function, which no more than one passage ends.

use crate::corners::{Arrival, Part, Passage};
use crate::lanes::Lanes;
use crate::line::Bounds;
use crate::run::Observer;

/// Most corners passed in a step. A wall that comes to rest passes some hundred.
const MOST_CORNERS: u32 = 1000;

/// Where u goes in a part along which ü keeps its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    /// It stays on its branch and within its bounds.
    Stays,
    /// It leaves the branch by the end to which ü points.
    Leaves,
    /// Neither is sure.
    Unclear,
}

impl Part<f64> {
    /// Finds where u goes, if ü is sure to keep its sign.
    ///
    /// ü obeys the free equation, d²ü/dt² + c dü/dt + k ü = 0: its zeros are π/√k apart or more, longer than
    /// any part whose γ is finite, and without k > 0 it has one at most. So values of one sign at both ends
    /// have no zero between them. While ü < 0, u lies above its chord, by A L²/8 at most, and comes down to
    /// each value once at most: it leaves through the lower end where it is below that at the end, and else
    /// stays above. ü > 0 is the mirror image.
    #[inline(always)]
    fn turn(&self, bounds: &Bounds<f64>) -> Turn {
        let Self { line, from: [u, v, a], to, length, forcing, rate, .. } = *self;
        let last = forcing + rate * length;
        let fastest = v.abs().max(to[1].abs());
        let change = line.most(forcing.abs().max(last.abs()), [u, v], to) * length;
        let a_last = line.acceleration(to, last);
        let bends = a * a_last > 0.0;
        if !bends || fastest > bounds.speed {
            return Turn::Unclear;
        }
        let bulge = 0.125 * change * length;
        let bulge = if a < 0.0 { [0.0, bulge] } else { [bulge, 0.0] };
        let clear =
            [bounds.within[0] <= u.min(to[0]) - bulge[0], u.max(to[0]) + bulge[1] <= bounds.within[1]];
        let beyond = [to[0] <= bounds.ends[0], bounds.ends[1] <= to[0]];
        let [behind, ahead] = if a < 0.0 { [1, 0] } else { [0, 1] };
        match (beyond[ahead], beyond[behind]) {
            (true, false) if clear[behind] => Turn::Leaves,
            (false, false) if clear == [true; 2] => Turn::Stays,
            _ => Turn::Unclear,
        }
    }

    /// Finds when u passes the corner to which ü points, and u̇ there.
    #[inline(always)]
    fn find_after_turn(&self, corner: f64, terms: usize) -> Passage<f64> {
        let Self { lanes, line, from: [u, v, a], length, rate, .. } = *self;
        // by constant ü, of the two forms of the root that without cancellation, and then by the jerk
        let speed = (v * v + 2.0 * a * (corner - u)).max(0.0).sqrt();
        let sum = v.abs() + speed;
        let time = if v * a < 0.0 { sum / a.abs() } else { 2.0 * (corner - u).abs() / sum };
        let jerk = rate - line.c * a - line.k * v;
        let late = jerk * (time * time * time) / (6.0 * (v + a * time));
        let passage = self.find_near(lanes, (time - late).max(0.0).min(length), corner, terms);
        // the corner from which u starts is passed with u̇ against ü
        Passage { found: passage.found && passage.velocity * a > 0.0, ..passage }
    }
}

impl<O: Observer> Lanes<'_, O> {
    /// Takes what is left of the step of a lane, or as much of it as parts along which ü keeps its sign go;
    /// returns whether that is all.
    #[inline(always)]
    pub(crate) fn follow_turns(&mut self, lane: usize) -> bool {
        let mut part: Part<f64> = self.rest((), lane);
        let (mut corners, mut is_curved, mut arrival) = (0, false, Arrival::none(&part));
        while corners < MOST_CORNERS {
            let bounds = self.bounds((), lane, part.branch);
            match part.turn(&bounds) {
                Turn::Unclear => break,
                Turn::Stays => {
                    arrival.take(true, &part, part.to, corners, 0.0);
                    break;
                }
                Turn::Leaves => {}
            }
            let ahead = self.ahead((), lane, &part);
            let passage = part.find_after_turn(ahead.corner, self.solvers[lane].table.terms);
            let (next, curved) = self.cross((), lane, &part, ahead, passage);
            if !(next.lanes || curved) {
                break;
            }
            (part, is_curved, corners) = (next, curved, corners + 1);
            // u may turn beyond a corner: the margin of the block counts from there, too
            let (rows, corner) = (&mut self.rows, part.from[0]);
            rows.highest[lane] = rows.highest[lane].max(corner);
            rows.lowest[lane] = rows.lowest[lane].min(corner);
            if is_curved {
                break;
            }
        }
        if !arrival.lanes {
            if corners == 0 {
                return false;
            }
            arrival.take(true, &part, [part.from[0], part.from[1]], corners, part.length);
        }
        self.arrive((), lane, &arrival);
        if self.rows.step_taken[lane] > 0.0 && !is_curved {
            // each part so far ended at a corner, which counts
            self.runs[lane].steps += 1;
            return false;
        }
        if self.rows.step_taken[lane] == 0.0 {
            self.see_now(lane);
        }
        true
    }
}

#[cfg(test)]
mod tests;
