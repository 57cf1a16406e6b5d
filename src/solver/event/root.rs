//! The search for a root on a motion.

use oscillator::KinematicState;

/// Most Newton steps and bisections of one root. 64 bisections alone reach the resolution of a double.
const ROOT_STEPS: u32 = 128;

/// An instant of a motion.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) time: f64,
    pub(super) motion: KinematicState,
}

/// The result of one evaluation in the search for a root.
pub(super) struct Trial {
    pub(super) value: f64,
    /// Step to the root.
    pub(super) step: f64,
    /// The error after that step is small enough for it to be the last.
    pub(super) settled: bool,
    pub(super) node: Node,
}

/// Returns the step to the zero of a parabola with `[value, slope, curvature]`, in the direction of Newton's
/// step.
pub(super) fn parabola([value, slope, curvature]: [f64; 3]) -> f64 {
    let discriminant = slope * slope - 2.0 * curvature * value;
    if discriminant >= 0.0 {
        // of the two forms of the root, take the one without cancellation
        -2.0 * value / (slope + slope.signum() * discriminant.sqrt())
    } else {
        -value / slope
    }
}

/// Finds a root in a bracket from a first `guess`, by the steps of `trial` safeguarded with bisection.
/// `rising` says that the value is negative at the low end. The last step is made along the motion, by
/// constant ü, without another evaluation.
pub(super) fn root(bracket: [f64; 2], guess: f64, rising: bool, trial: impl Fn(f64) -> Trial) -> Node {
    let [mut low, mut high] = bracket;
    let mut last_step = high - low;
    let time = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
    let mut now = trial(time);
    for _ in 0..ROOT_STEPS {
        let time = now.node.time;
        if now.value == 0.0 {
            break;
        }
        if (now.value < 0.0) == rising {
            low = time;
        } else {
            high = time;
        }
        let ahead = time + now.step;
        let inside = ahead >= low && ahead <= high;
        if now.settled && inside {
            return now.node.shifted(now.step);
        }
        if high - low <= f64::EPSILON * high {
            break;
        }
        // bisect where a step leaves the bracket or does not shrink
        let next = if inside && now.step.abs() < 0.75 * last_step.abs() { ahead } else { 0.5 * (low + high) };
        last_step = next - time;
        if next == time {
            break;
        }
        now = trial(next);
    }
    now.node
}

impl Node {
    /// Returns the motion a small step later, by constant ü.
    fn shifted(self, step: f64) -> Self {
        let KinematicState { displacement, velocity, acceleration } = self.motion;
        let motion = KinematicState {
            displacement: displacement + step * (velocity + 0.5 * step * acceleration),
            velocity: velocity + step * acceleration,
            acceleration,
        };
        Self { time: self.time + step, motion }
    }
}
