//! Peaks of a wall by the classical Runge-Kutta method. It shares only the equation with the solvers: ü on
//! each branch, and what its corners are.

use rocking_wall::wall::{Branch, Support, Wall};

/// Highest and lowest u, u̇, ü, bottom and top reaction, and force of the tie.
pub(crate) type Ranges = [[f64; 2]; 6];

/// Longest step: in radians of the branch, and where C varies in parts of the way from the nearest corner.
const STEP: [f64; 2] = [0.015, 0.02];
/// Most steps of one run: stiff elastic branches take more.
const MOST_STEPS: u32 = 40_000;

/// A wall on its way through one segment.
struct Way<'a> {
    wall: &'a Wall,
    branch: usize,
    motion: [f64; 2],
    ranges: Ranges,
    /// Time, values and slopes at the last step on this branch.
    last: Option<(f64, [f64; 6], [f64; 6])>,
    steps: u32,
}

/// Returns the peaks of a wall up to overturning, from u and u̇ on a branch, under accelerations that are
/// linear between samples. `None` where the wall all but rests, or takes too many steps.
pub(crate) fn ranges(
    wall: &Wall,
    (motion, branch): ([f64; 2], usize),
    accelerations: &[f64],
    step: f64,
) -> Option<Ranges> {
    let ranges = [[f64::NEG_INFINITY, f64::INFINITY]; 6];
    let mut way = Way { wall, branch, motion, ranges, last: None, steps: 0 };
    for ends in accelerations.windows(2) {
        way.last = None;
        if way.segment([ends[0], ends[1]], step)? {
            break;
        }
    }
    Some(way.ranges)
}

impl Way<'_> {
    fn branch(&self) -> &Branch {
        &self.wall.branches()[self.branch]
    }

    /// Moves to the end of a segment; returns whether the wall overturns in it.
    fn segment(&mut self, ends: [f64; 2], duration: f64) -> Option<bool> {
        let ground = |time: f64| ground(ends, time / duration);
        let mut time = 0.0;
        self.include(time, ends, duration);
        while time < duration {
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return None;
            }
            let length = self.length().min(duration - time);
            let next = self.after(length, time, ground);
            let Branch { lower, upper, .. } = *self.branch();
            let upwards = next[0] > upper;
            if !upwards && next[0] >= lower {
                (self.motion, time) = (next, time + length);
                self.include(time, ends, duration);
                continue;
            }
            let corner = if upwards { upper } else { lower };
            let [mut low, mut high] = [0.0, length];
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                let beyond = (self.after(middle, time, ground)[0] > corner) == upwards;
                if beyond { high = middle } else { low = middle }
            }
            let length = high;
            self.motion = [corner, self.after(length, time, ground)[1]];
            time += length;
            self.include(time, ends, duration);
            if self.pass(upwards)? {
                return Some(true);
            }
            self.last = None;
            self.include(time, ends, duration);
        }
        Some(false)
    }

    /// Passes a corner; returns whether the wall overturns there.
    fn pass(&mut self, upwards: bool) -> Option<bool> {
        let corner = self.wall.corners()[self.branch + usize::from(upwards)];
        if corner.overturning && upwards == (corner.displacement > 0.0) {
            return Some(true);
        }
        if corner.passage {
            self.motion[1] *= self.wall.passage_factor(self.motion[1]);
        }
        if !corner.stop {
            self.branch = if upwards { self.branch + 1 } else { self.branch - 1 };
        }
        let rests = self.motion[1].abs() < 1e-3 * self.wall.displacement_scale() * self.wall.rocking_rate();
        (!(rests && self.wall.can_rest())).then_some(false)
    }

    /// The length of the next step.
    fn length(&self) -> f64 {
        let [u, v] = self.motion;
        let branch = self.branch();
        let rate = |branch: &Branch| branch.stiffness.abs().sqrt();
        let own = rate(branch) + branch.damping_at(u);
        // within reach of a corner a step must not turn unseen on a stiffer branch
        let beside = self.wall.branches()[self.branch.saturating_sub(1)..].iter().take(3).map(rate);
        let away = (u - branch.lower).min(branch.upper - u);
        let (longest, a) = (STEP[0] / own, self.last.map_or(0.0, |(_, [_, _, a, ..], _)| a));
        let reaches = away < longest * (v.abs() + longest * a.abs());
        let radians = STEP[0] / if reaches { beside.fold(own, f64::max) } else { own };
        if branch.damping.constant().is_some() {
            return radians;
        }
        radians.min(STEP[1] * away.max(1e-9 * self.wall.displacement_scale()) / v.abs())
    }

    /// u and u̇ a length later.
    fn after(&self, length: f64, time: f64, ground: impl Fn(f64) -> f64) -> [f64; 2] {
        let (branch, body) = (self.branch(), self.wall.body());
        let slope = |[u, v]: [f64; 2], part: f64| {
            let forcing = body.forcing(Support::rigid(ground(time + part * length)));
            [v, branch.acceleration(u.clamp(branch.lower, branch.upper), v, forcing)]
        };
        let along = |[u, v]: [f64; 2], part: f64| {
            [self.motion[0] + part * length * u, self.motion[1] + part * length * v]
        };
        let first = slope(self.motion, 0.0);
        let second = slope(along(first, 0.5), 0.5);
        let third = slope(along(second, 0.5), 0.5);
        let fourth = slope(along(third, 1.0), 1.0);
        let mean = |i: usize| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0;
        along([mean(0), mean(1)], 1.0)
    }

    /// Includes the present values, and those since the last step by the cubic with the values and slopes of
    /// both its ends.
    fn include(&mut self, time: f64, ends: [f64; 2], duration: f64) {
        let ([u, v], wall, branch) = (self.motion, self.wall, self.branch());
        let body = wall.body();
        let rate = Support::rigid((ends[1] - ends[0]) / duration);
        let support = Support::rigid(ground(ends, time / duration));
        let a = branch.acceleration(u, v, body.forcing(support));
        let (c, slope) = (branch.damping_at(u), branch.damping_slope(u));
        let jerk = body.forcing(rate) - slope * v * v - c * a - branch.stiffness * v;
        let now = body.reactions(support, a, branch.couple.at(u));
        let later = body.reactions(rate, jerk, branch.couple.slope * v);
        let tie = wall.tie_slope(self.branch) * u.signum();
        let values = [u, v, a, now.bottom, now.top, wall.tie_force(self.branch, u)];
        let slopes = [v, a, jerk, later.bottom, later.top, tie * v];
        for (index, [highest, lowest]) in self.ranges.iter_mut().enumerate() {
            let mut widen = |value: f64| (*highest, *lowest) = (highest.max(value), lowest.min(value));
            widen(values[index]);
            if let Some((since, from, rise)) = &self.last {
                let length = time - since;
                let [g0, g1] = [from[index], values[index]];
                turns([g0, rise[index] * length, g1, slopes[index] * length]).into_iter().for_each(widen);
            }
        }
        self.last = Some((time, values, slopes));
    }
}

/// The values at the turning points between 0 and 1 of the cubic with values and slopes at both; g₀ for none.
fn turns([g0, s0, g1, s1]: [f64; 4]) -> [f64; 2] {
    // g = g₀ + s₀ x + b x² + c x³
    let (b, c) = (3.0 * (g1 - g0) - 2.0 * s0 - s1, 2.0 * (g0 - g1) + s0 + s1);
    let root = (b * b - 3.0 * c * s0).sqrt();
    let q = -(b + b.signum() * root);
    [q / (3.0 * c), s0 / q].map(|x| if x > 0.0 && x < 1.0 { g0 + x * (s0 + x * (b + x * c)) } else { g0 })
}

/// The acceleration of the ground after a part of a segment.
fn ground(ends: [f64; 2], part: f64) -> f64 {
    ends[0] + (ends[1] - ends[0]) * part
}
