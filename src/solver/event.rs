//! Events inside a piece of motion: leaving the branch, and turning points.

/// Displacement, velocity and acceleration at one instant \[m, m/s, m/s²\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kinematics {
    pub(super) displacement: f64,
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
}

/// The largest u and −u so far, neither negative \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Largest u.
    pub positive: f64,
    /// Largest −u.
    pub negative: f64,
}

impl Peaks {
    /// The peaks of a wall that stands at `displacement`.
    #[must_use]
    pub fn at(displacement: f64) -> Self {
        Self { positive: displacement.max(0.0), negative: (-displacement).max(0.0) }
    }

    /// Largest |u| \[m\].
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.positive.max(self.negative)
    }

    pub(super) fn include(&mut self, displacement: f64) {
        self.positive = self.positive.max(displacement);
        self.negative = self.negative.max(-displacement);
    }

    /// Whether a range holds nothing new.
    pub(super) fn cover(&self, lowest: f64, highest: f64) -> bool {
        highest <= self.positive && -lowest <= self.negative
    }
}

/// A smooth stretch of motion u(t) on one branch, for 0 ≤ t ≤ `horizon`.
pub(super) trait Piece {
    /// The motion at the start of the piece.
    fn start(&self) -> Kinematics;

    /// Length of time over which the piece holds \[s\].
    fn horizon(&self) -> f64;

    /// The motion `time` after the start of the piece.
    fn at(&self, time: f64) -> Kinematics;

    /// Bounds on |ü| \[m/s²\] and on the jerk \[m/s³\] for `length` seconds after an instant of the piece.
    fn bounds(&self, from: Kinematics, length: f64) -> (f64, f64);

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
    Horizon(Kinematics),
    /// At a corner.
    Exit(Exit),
}

/// A search stopped short of its bound on intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SearchExhausted;

/// Halvings of an interval before it counts as monotone: 2⁻⁴⁸ of a piece is below its rounding.
const DEEPEST: u32 = 48;
/// Intervals one search may visit.
const MOST_INTERVALS: u32 = 1 << 20;
/// Newton steps and bisections of one root; 64 bisections alone exhaust a double.
const ROOT_STEPS: u32 = 128;

#[derive(Clone, Copy)]
struct Node {
    time: f64,
    motion: Kinematics,
}

/// Follows a piece to its horizon or to the first time u passes `bounds` = \[lower, upper\]. Raises `peaks` to the extremes of u
/// at turning points and ends before that.
///
/// Works through intervals from left to right. An interval is settled when it is too short for u to reach anything
/// (|ü| bound), when u̇ keeps its sign in it, or when ü does, so that u̇ has at most one zero; else it is halved.
pub(super) fn follow<P: Piece>(
    piece: &P,
    bounds: [f64; 2],
    peaks: &mut Peaks,
) -> Result<Ending, SearchExhausted> {
    let horizon = piece.horizon();
    let search = Search { piece, bounds };
    let left = Node { time: 0.0, motion: piece.start() };
    let right = Node { time: horizon, motion: piece.at(horizon) };
    match search.settle(left, right, false, peaks) {
        // The ordinary step: nothing to look for.
        Verdict::Quiet => {
            peaks.include(right.motion.displacement);
            Ok(Ending::Horizon(right.motion))
        }
        Verdict::Split => Ok(ending(search.by_halves(left, right, peaks)?, right)),
        verdict => Ok(ending(search.settled(left, right, &verdict, peaks), right)),
    }
}

fn ending(exit: Option<Exit>, end: Node) -> Ending {
    exit.map_or(Ending::Horizon(end.motion), Ending::Exit)
}

enum Verdict {
    /// Nothing can happen inside.
    Quiet,
    /// u̇ keeps its sign.
    Monotone,
    /// u̇ changes its sign once.
    Turning,
    Split,
}

struct Search<'a, P> {
    piece: &'a P,
    bounds: [f64; 2],
}

impl<P: Piece> Search<'_, P> {
    /// Works through `left`…`right` in halves.
    fn by_halves(&self, left: Node, right: Node, peaks: &mut Peaks) -> Result<Option<Exit>, SearchExhausted> {
        let mut left = left;
        let mut pending = [(right, 0_u32); DEEPEST as usize + 1];
        let mut count = 1;
        for _ in 0..MOST_INTERVALS {
            let Some(index) = usize::checked_sub(count, 1) else { return Ok(None) };
            let (right, depth) = pending[index];
            let verdict = self.settle(left, right, depth == DEEPEST, peaks);
            if let Verdict::Split = verdict {
                let time = 0.5 * (left.time + right.time);
                pending[index].1 = depth + 1;
                pending[count] = (Node { time, motion: self.piece.at(time) }, depth + 1);
                count += 1;
                continue;
            }
            if let Some(exit) = self.settled(left, right, &verdict, peaks) {
                return Ok(Some(exit));
            }
            left = right;
            count = index;
        }
        Err(SearchExhausted)
    }

    /// The exit in an interval that needs no more halving.
    fn settled(&self, left: Node, right: Node, verdict: &Verdict, peaks: &mut Peaks) -> Option<Exit> {
        match verdict {
            Verdict::Quiet | Verdict::Split => {}
            Verdict::Monotone => {
                if let Some(exit) = self.monotone(left, right) {
                    return Some(exit);
                }
            }
            Verdict::Turning => {
                let turn = self.turning_point(left, right);
                if let Some(exit) = self.monotone(left, turn) {
                    return Some(exit);
                }
                peaks.include(turn.motion.displacement);
                if let Some(exit) = self.monotone(turn, right) {
                    return Some(exit);
                }
            }
        }
        peaks.include(right.motion.displacement);
        None
    }

    fn settle(&self, left: Node, right: Node, deepest: bool, peaks: &Peaks) -> Verdict {
        let (from, to) = (left.motion, right.motion);
        let length = right.time - left.time;
        let (most_acceleration, most_jerk) = self.piece.bounds(from, length);
        // |u(t) − chord| ≤ L²/8 max|ü|
        let sag = 0.125 * length * length * most_acceleration;
        let highest = from.displacement.max(to.displacement) + sag;
        let lowest = from.displacement.min(to.displacement) - sag;
        if highest <= self.bounds[1] && lowest >= self.bounds[0] && peaks.cover(lowest, highest) {
            return Verdict::Quiet;
        }
        let (v0, v1) = (from.velocity, to.velocity);
        let apart = v0 * v1 < 0.0;
        // |u̇(t) − u̇(tᵢ)| ≤ max|ü| |t − tᵢ|: no zero between two values larger together than max|ü| L
        if !apart && v0.abs() + v1.abs() > most_acceleration * length {
            return Verdict::Monotone;
        }
        let (a0, a1) = (from.acceleration, to.acceleration);
        let steady = a0 * a1 >= 0.0 && a0.abs() + a1.abs() > most_jerk * length;
        if steady || deepest {
            return if apart { Verdict::Turning } else { Verdict::Monotone };
        }
        Verdict::Split
    }

    /// The one zero of u̇ in an interval.
    fn turning_point(&self, left: Node, right: Node) -> Node {
        let (from, to) = (left.motion, right.motion);
        // the chord of u̇
        let guess = left.time
            + (right.time - left.time) * (from.velocity / (from.velocity - to.velocity)).clamp(0.0, 1.0);
        let (time, motion) = root([left.time, right.time], guess, from.velocity < 0.0, |time| {
            let motion = self.piece.at(time);
            ([motion.velocity, motion.acceleration, 0.0], motion)
        });
        Node { time, motion }
    }

    /// The exit in an interval over which u is monotone.
    fn monotone(&self, left: Node, right: Node) -> Option<Exit> {
        let [lower, upper] = self.bounds;
        let upwards = left.motion.velocity + right.motion.velocity > 0.0;
        let bound = if upwards { upper } else { lower };
        let end = right.motion.displacement;
        let leaves = if upwards { end > upper } else { end < lower };
        if !leaves {
            return None;
        }
        let Kinematics { displacement, velocity, acceleration } = left.motion;
        let missing = displacement - bound;
        if missing == 0.0 {
            return Some(Exit { time: left.time, velocity, upwards });
        }
        let guess = left.time + newton([missing, velocity, acceleration]).abs();
        let (time, at) = root([left.time, right.time], guess, upwards, |time| {
            let motion = self.piece.at(time);
            ([motion.displacement - bound, motion.velocity, motion.acceleration], motion)
        });
        // what the rounding of the time leaves to the bound, made up along the motion
        let rest = (bound - at.displacement) / at.velocity;
        let velocity = if rest.abs() <= TIME_ROUNDING * time {
            at.velocity + rest * at.acceleration
        } else {
            at.velocity
        };
        Some(Exit { time, velocity, upwards })
    }
}

/// Roundings by which a root may miss the bound.
const TIME_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Step to the zero of a parabola with `[value, slope, curvature]`, the one nearer in the direction of Newton's.
fn newton([value, slope, curvature]: [f64; 3]) -> f64 {
    let discriminant = slope * slope - 2.0 * curvature * value;
    if discriminant > 0.0 {
        // of the two forms of the root the one that does not cancel
        -2.0 * value / (slope + slope.signum() * discriminant.sqrt())
    } else {
        -value / slope
    }
}

/// Root of a function in a bracket, by parabolas (of third order) safeguarded with bisection, from a first `guess`; `rising`
/// tells the sign at the bracket's low end. The function gives its value, slope and curvature, and what to return.
fn root<T>(bracket: [f64; 2], guess: f64, rising: bool, function: impl Fn(f64) -> ([f64; 3], T)) -> (f64, T) {
    let [mut low, mut high] = bracket;
    let mut last_step = high - low;
    let mut time = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
    let (mut local, mut found) = function(time);
    for _ in 0..ROOT_STEPS {
        if local[0] == 0.0 {
            break;
        }
        if (local[0] < 0.0) == rising {
            low = time;
        } else {
            high = time;
        }
        let step = newton(local);
        // a step within the rounding of the time changes nothing
        if step.abs() <= 0.5 * f64::EPSILON * time || high - low <= f64::EPSILON * high {
            break;
        }
        // it must stay inside and shrink, else bisection
        let ahead = time + step;
        let next = if ahead > low && ahead < high && step.abs() < 0.75 * last_step.abs() {
            ahead
        } else {
            0.5 * (low + high)
        };
        last_step = next - time;
        if next == time {
            break;
        }
        time = next;
        (local, found) = function(time);
    }
    (time, found)
}
