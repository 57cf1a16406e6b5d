//! Events inside a piece of motion: leaving the branch, and turning points.

use oscillator::{Bounds, KinematicState};

use super::state::Peaks;

mod root;
#[cfg(test)]
pub(super) mod tests;

use root::{Node, Trial, parabola, root};

/// A smooth motion u(t) on one branch, for 0 ≤ t ≤ `horizon`.
pub(super) trait Piece {
    /// The motion at the start of the piece.
    fn start(&self) -> KinematicState;

    /// Length of time over which the piece holds \[s\].
    fn horizon(&self) -> f64;

    /// Returns the motion `time` seconds after the start of the piece.
    fn at(&self, time: f64) -> KinematicState;

    /// Bounds on |ü| \[m/s²\] and on the jerk \[m/s³\] for `length` seconds after an instant of the piece.
    fn bounds(&self, from: KinematicState, length: f64) -> Bounds;

    /// Returns the motion at a time, with ü by the equation of motion. A series whose u and u̇ are within the
    /// tolerance may be far from it in ü.
    fn balanced(&self, time: f64) -> KinematicState {
        self.at(time)
    }

    /// Bounds on |ü|, on the jerk and on the second derivative of the ü of [`balanced`](Self::balanced)
    /// between two times, of which the first has the motion `from` \[m/s², m/s³, m/s⁴\].
    fn curvatures(&self, between: [f64; 2], from: KinematicState) -> [f64; 3];

    /// The time after which the motion only repeats, with the same or smaller swings, under a forcing that
    /// does not change \[s\]; infinite for another motion.
    fn period(&self) -> f64 {
        f64::INFINITY
    }

    /// ∫u dt from the start of the piece \[m s\].
    fn displacement_integral(&self, time: f64) -> f64;
}

/// The motion leaves its branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exit {
    pub(super) time: f64,
    pub(super) velocity: f64,
    pub(super) upwards: bool,
}

/// How a piece of motion ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ending {
    /// At its horizon.
    Horizon(KinematicState),
    /// At a corner.
    Exit(Exit),
    /// At a turning point, where a tie yields.
    Turn { time: f64, displacement: f64, velocity: f64 },
}

/// A search that has reached its limit on intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SearchExhausted;

/// Most halvings of an interval. After them it counts as monotone: a turn within 2⁻⁴⁸ of a piece changes u by
/// less than its rounding, as the change goes with the square of the time.
const DEEPEST: u32 = 48;
/// Most intervals of one search.
const MOST_INTERVALS: u32 = 1 << 20;

/// Follows a piece to its horizon, or to the first time u passes `bounds` = \[lower, upper\]. Raises `peaks`
/// to the extremes of u on the way.
///
/// Works through intervals from left to right. An interval is settled when it is too short for u to reach a
/// bound or a peak, when u̇ keeps its sign, or when ü does, so that u̇ has at most one zero. Otherwise it is
/// halved.
pub(super) fn find_ending<P: Piece>(
    piece: &P,
    bounds: [f64; 2],
    peaks: &mut Peaks,
) -> Result<Ending, SearchExhausted> {
    let horizon = piece.horizon();
    let search = Search { piece, bounds, outwards: 0.0 };
    let left = Node { time: 0.0, motion: piece.start() };
    let right = Node { time: horizon, motion: piece.at(horizon) };
    let ending = match search.settle(left, right, false, peaks) {
        // the ordinary step
        Shape::Quiet => {
            peaks.include(right.motion.displacement);
            None
        }
        Shape::Split => search.by_halves(left, right, peaks)?,
        shape => search.settled(left, right, &shape, peaks),
    };
    Ok(ending.unwrap_or(Ending::Horizon(right.motion)))
}

/// Follows a piece as [`find_ending`] does, but only to the first point where it moves inwards, away from the
/// side `outwards`.
pub(super) fn find_turn<P: Piece>(
    piece: &P,
    bounds: [f64; 2],
    peaks: &mut Peaks,
    outwards: f64,
) -> Result<Ending, SearchExhausted> {
    let search = Search { piece, bounds, outwards };
    let left = Node { time: 0.0, motion: piece.start() };
    let right = Node { time: piece.horizon(), motion: piece.at(piece.horizon()) };
    // every turning point outwards is a peak of this piece, also where the run has been farther
    let mut own = Peaks::at(left.motion.displacement);
    let ending = search.by_halves(left, right, &mut own)?;
    peaks.include(own.positive);
    peaks.include(-own.negative);
    Ok(ending.unwrap_or(Ending::Horizon(right.motion)))
}

/// What the motion between two instants looks like.
pub(super) enum Shape {
    /// No bound or peak can be reached inside.
    Quiet,
    /// u̇ keeps its sign.
    Monotone,
    /// u̇ changes its sign once.
    Turning,
    /// As `Turning`, where the turn is no new peak and the bound ahead of it is not reached.
    Back,
    /// Too long to decide.
    Split,
}

/// Decides what can happen between two instants `length` apart, given bounds on |ü| and on the jerk between
/// them.
#[inline]
pub(super) fn settle(
    [from, to]: [KinematicState; 2],
    length: f64,
    most: Bounds,
    [lower, upper]: [f64; 2],
    peaks: &Peaks,
) -> Shape {
    // |u(t) − chord| ≤ L²/8 max|ü|
    let sag = 0.125 * length * length * most.acceleration;
    let highest = from.displacement.max(to.displacement) + sag;
    let lowest = from.displacement.min(to.displacement) - sag;
    if highest <= upper && lowest >= lower && peaks.cover(lowest, highest) {
        return Shape::Quiet;
    }
    let (v0, v1) = (from.velocity, to.velocity);
    let apart = v0 * v1 < 0.0;
    // |u̇(t) − u̇(tᵢ)| ≤ max|ü| |t − tᵢ|: no zero where the two values add up to more than max|ü| L
    if !apart && v0.abs() + v1.abs() > most.acceleration * length {
        return Shape::Monotone;
    }
    let (a0, a1) = (from.acceleration, to.acceleration);
    let steady = a0 * a1 >= 0.0 && a0.abs() + a1.abs() > most.jerk * length;
    match (steady, apart) {
        (true, true) if v0 > 0.0 && highest <= upper.min(peaks.positive) => Shape::Back,
        (true, true) if v0 < 0.0 && lowest >= lower.max(-peaks.negative) => Shape::Back,
        (true, true) => Shape::Turning,
        (true, false) => Shape::Monotone,
        (false, _) => Shape::Split,
    }
}

struct Search<'a, P> {
    piece: &'a P,
    bounds: [f64; 2],
    /// The sign of u̇ whose change ends the search; 0 for none.
    outwards: f64,
}

impl<P: Piece> Search<'_, P> {
    /// Searches `left`…`right` in halves.
    fn by_halves(
        &self,
        left: Node,
        right: Node,
        peaks: &mut Peaks,
    ) -> Result<Option<Ending>, SearchExhausted> {
        let mut left = left;
        let mut pending = [(right, 0_u32); DEEPEST as usize + 1];
        let mut count = 1;
        for _ in 0..MOST_INTERVALS {
            let Some(index) = usize::checked_sub(count, 1) else { return Ok(None) };
            let (right, depth) = pending[index];
            let shape = self.settle(left, right, depth == DEEPEST, peaks);
            if let Shape::Split = shape {
                let time = 0.5 * (left.time + right.time);
                pending[index].1 = depth + 1;
                pending[count] = (Node { time, motion: self.piece.at(time) }, depth + 1);
                count += 1;
                continue;
            }
            if let Some(ending) = self.settled(left, right, &shape, peaks) {
                return Ok(Some(ending));
            }
            left = right;
            count = index;
        }
        Err(SearchExhausted)
    }

    /// Returns the exit in an interval that needs no more halving, or the turn that ends the search.
    fn settled(&self, left: Node, right: Node, shape: &Shape, peaks: &mut Peaks) -> Option<Ending> {
        let is_inwards = |velocity: f64| self.outwards * velocity < 0.0;
        if is_inwards(left.motion.velocity) {
            return Some(left.turn(left.motion.velocity));
        }
        match shape {
            Shape::Quiet | Shape::Split => {}
            Shape::Monotone => {
                if is_inwards(left.motion.velocity + right.motion.velocity) {
                    return Some(left.turn(left.motion.velocity));
                }
                if let Some(exit) = self.monotone(left, right) {
                    return Some(Ending::Exit(exit));
                }
            }
            Shape::Back if self.outwards == 0.0 => {
                if let Some(exit) = self.after_turn(left, right) {
                    return Some(Ending::Exit(exit));
                }
            }
            Shape::Turning | Shape::Back => {
                let turn = self.turning_point(left, right);
                if let Some(exit) = self.monotone(left, turn) {
                    return Some(Ending::Exit(exit));
                }
                peaks.include(turn.motion.displacement);
                if self.outwards != 0.0 {
                    return Some(turn.turn(0.0));
                }
                if let Some(exit) = self.monotone(turn, right) {
                    return Some(Ending::Exit(exit));
                }
            }
        }
        peaks.include(right.motion.displacement);
        None
    }

    fn settle(&self, left: Node, right: Node, deepest: bool, peaks: &Peaks) -> Shape {
        let length = right.time - left.time;
        let bounds = self.piece.bounds(left.motion, length);
        match settle([left.motion, right.motion], length, bounds, self.bounds, peaks) {
            Shape::Split if deepest => Shape::Monotone,
            shape => shape,
        }
    }

    /// Finds the one zero of u̇ in an interval. The last step δ is made by constant ü, which leaves an error
    /// of jerk δ³/6 in u.
    fn turning_point(&self, left: Node, right: Node) -> Node {
        let (from, to) = (left.motion, right.motion);
        // the chord of u̇
        let share = (from.velocity / (from.velocity - to.velocity)).clamp(0.0, 1.0);
        let guess = left.time + (right.time - left.time) * share;
        let jerk = self.piece.bounds(from, right.time - left.time).jerk;
        root([left.time, right.time], guess, from.velocity < 0.0, |time| {
            let motion = self.piece.at(time);
            let KinematicState { velocity, acceleration, .. } = motion;
            let step = -velocity / acceleration;
            // A Newton step δ leaves an error of jerk δ²/(2ü) in time, where u differs from that of the turn
            // by ü/2 times its square. The step is the last where this difference is at most ε u/4.
            // Where motion goes on from the turn by another law, the time itself counts.
            let left = 0.5 * jerk * step * step / acceleration.abs();
            let settled = if self.outwards == 0.0 {
                0.5 * acceleration.abs() * left * left <= 0.25 * f64::EPSILON * motion.displacement.abs()
            } else {
                left <= 0.25 * f64::EPSILON * time
            };
            Trial { value: velocity, step, settled, node: Node { time, motion } }
        })
    }

    /// Returns the exit in an interval over which u is monotone.
    fn monotone(&self, left: Node, right: Node) -> Option<Exit> {
        let upwards = left.motion.velocity + right.motion.velocity > 0.0;
        let bound = self.passed(right, upwards)?;
        let KinematicState { displacement, velocity, acceleration } = left.motion;
        if displacement == bound {
            return Some(Exit { time: left.time, velocity, upwards });
        }
        // by constant ü; at a turning point rounding may give u̇ the wrong sign, but the root is ahead
        let guess = parabola([displacement - bound, velocity, acceleration]).abs();
        Some(self.exit([left, right], guess, upwards))
    }

    /// Returns the exit in an interval in which u turns once before.
    fn after_turn(&self, left: Node, right: Node) -> Option<Exit> {
        let upwards = right.motion.velocity > 0.0;
        let bound = self.passed(right, upwards)?;
        let KinematicState { displacement, velocity, acceleration } = left.motion;
        // by constant ü the later root, whose terms have one sign
        let square = velocity * velocity - 2.0 * acceleration * (displacement - bound);
        let guess = (velocity.abs() + square.max(0.0).sqrt()) / acceleration.abs();
        Some(self.exit([left, right], guess, upwards))
    }

    /// Returns the bound in a direction, if u is beyond it.
    fn passed(&self, node: Node, upwards: bool) -> Option<f64> {
        let [lower, upper] = self.bounds;
        let u = node.motion.displacement;
        if upwards { (u > upper).then_some(upper) } else { (u < lower).then_some(lower) }
    }

    /// Finds the one exit in an interval, from a guess of the time after its start.
    fn exit(&self, [left, right]: [Node; 2], guess: f64, upwards: bool) -> Exit {
        let bound = self.bounds[usize::from(upwards)];
        let jerk = self.piece.bounds(left.motion, right.time - left.time).jerk;
        let exit = root([left.time, right.time], left.time + guess, upwards, |time| {
            let motion = self.piece.at(time);
            let KinematicState { displacement, velocity, acceleration } = motion;
            let value = displacement - bound;
            let step = parabola([value, velocity, acceleration]);
            // A step δ of the parabola leaves an error of jerk δ³/6 in u, hence of jerk δ³/(6u̇) in time, and
            // of jerk δ²/2 in u̇. The step is the last where that in u̇ is at most ε/4 of u̇; that in time is
            // then at most ε δ/12, below the rounding of the bracket's times.
            let settled = 0.5 * jerk * step * step <= 0.25 * f64::EPSILON * velocity.abs();
            Trial { value, step, settled, node: Node { time, motion } }
        });
        Exit { time: exit.time, velocity: exit.motion.velocity, upwards }
    }
}

impl Node {
    fn turn(self, velocity: f64) -> Ending {
        Ending::Turn { time: self.time, displacement: self.motion.displacement, velocity }
    }
}
