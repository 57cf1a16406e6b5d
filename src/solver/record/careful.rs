//! Steps that are not plain: new extremes, turning points, corners.

use super::super::event::{Kinematics, Verdict, crossing, settle};
use super::super::run::Run;
use super::super::transition::branch_beyond;
use super::super::{Peaks, Report, SolverError, Work};
use super::lane::Lane;
use super::short::Short;
use super::{Forcing, StepMap};

/// Largest correction δ of a first guess, over the step h: beyond, the general search takes over. The expansions to the fourth
/// derivative leave out (ωδ)⁴ of u̇, 1e-16/24 even for ωh = 1.
pub(super) const SMALL_SHIFT: f64 = 1e-4;
/// Largest ü δ/(2 u̇) of a correction on the way to a corner: the inversion leaves out 5 times its cube, 5e-12 of δ. Only where u
/// all but turns at the corner is it larger.
pub(super) const SMALL_BEND: f64 = 1e-4;
/// Evaluations of the motion on the way to a corner.
pub(super) const MOST_GUESSES: u32 = 4;
/// Corners crossed in one step without the general search.
const MOST_CROSSINGS: u32 = 4;
/// Ratios of the mean velocity of a crossing to those at its ends for which time is well told from u.
pub(super) const EVEN: std::ops::Range<f64> = 0.3..3.0;

/// A stretch of a step, its forcing changing at `rate` \[m/s³\].
#[derive(Clone, Copy)]
struct Stretch {
    from: Kinematics,
    to: Kinematics,
    length: f64,
    rate: f64,
}

impl<'a, F: Forcing> Lane<'a, F> {
    /// A step that may reach a corner or a new extreme, and its end if it does not leave its branch.
    #[inline(always)]
    pub(super) fn careful(
        &mut self,
        map: &'a StepMap,
        p: [f64; 2],
        end: [f64; 2],
    ) -> Result<(), SolverError> {
        let start = self.now;
        let step = self.solver.step;
        self.take_in_nodes();
        let [lower, upper] = map.corners;
        let within = end[0] > lower && end[0] < upper;
        if within && self.is_steady(start[1], end) {
            self.arrive(end);
            return Ok(());
        }
        let kinematics = |[displacement, velocity]: [f64; 2], p: f64| Kinematics {
            displacement,
            velocity,
            acceleration: p
                - map.oscillator.damping() * velocity
                - (map.force_at_zero + map.oscillator.stiffness() * displacement),
        };
        let (from, to) = (kinematics(start, p[0]), kinematics(end, p[1]));
        let stretch = Stretch { from, to, length: step, rate: (p[1] - p[0]) / step };
        let bounds = map.oscillator.bounds(from, stretch.rate, step);
        let verdict = settle([from, to], step, bounds, map.corners, &self.state.peaks);
        let done = match verdict {
            Verdict::Quiet => true,
            Verdict::Monotone => within,
            Verdict::Turning => within && turn(&mut self.state.peaks, map, &stretch),
            Verdict::Split => false,
        };
        if done {
            self.arrive(end);
            return Ok(());
        }
        if matches!(verdict, Verdict::Monotone) && self.cross(stretch) {
            return Ok(());
        }
        self.search(p, Some(to))
    }

    /// A step on which u, monotone, leaves the branch through corners where nothing but the stiffness changes, and then
    /// stays on a branch: the ordinary case of a corner, without the general search. Tells whether it was that.
    #[inline(always)]
    fn cross(&mut self, mut stretch: Stretch) -> bool {
        let motion = self.solver.motion;
        let mut state = self.state;
        let upwards = stretch.to.displacement > stretch.from.displacement;
        for corners in 1..=MOST_CROSSINGS {
            let index = state.branch + usize::from(upwards);
            let corner = motion.wall.corners()[index];
            if corner.is_marked() || stretch.from.displacement == corner.displacement {
                return false;
            }
            let next = branch_beyond(index, upwards);
            let shorts = [state.branch, next].map(|branch| {
                let map = self.solver.maps.get(branch)?.as_ref()?;
                Some((map, map.short.as_ref()?))
            });
            let [Some((map, short)), Some((ahead, short_ahead))] = shorts else { return false };
            let change = ahead.oscillator.stiffness() - map.oscillator.stiffness();
            let Some((time, start)) = passage(map, short, &stretch, corner.displacement, change) else {
                return false;
            };
            let remaining = stretch.length - time;
            let end = short_ahead.after(remaining, start, stretch.rate);
            stretch = Stretch { from: start, to: end, length: remaining, rate: stretch.rate };
            state.branch = next;
            state.peaks.include(corner.displacement);
            let bounds = ahead.oscillator.bounds(start, stretch.rate, remaining);
            let verdict = settle([start, end], remaining, bounds, ahead.corners, &state.peaks);
            let within = end.displacement > ahead.corners[0] && end.displacement < ahead.corners[1];
            let ends = match verdict {
                Verdict::Quiet => true,
                Verdict::Monotone => within,
                Verdict::Turning => within && turn(&mut state.peaks, ahead, &stretch),
                Verdict::Split => return false,
            };
            match (ends, verdict) {
                (true, _) => {
                    (state.displacement, state.velocity) = (end.displacement, end.velocity);
                    state.peaks.include(end.displacement);
                    self.state = state;
                    self.searched += 1;
                    self.work.add(Work {
                        pieces: 1 + u64::from(corners),
                        corners: u64::from(corners),
                        impacts: 0,
                    });
                    self.load();
                    self.look_around();
                    return true;
                }
                (false, Verdict::Monotone) => {}
                _ => return false,
            }
        }
        false
    }

    /// A step through the search for events.
    #[cold]
    pub(super) fn search(&mut self, p: [f64; 2], known_end: Option<Kinematics>) -> Result<(), SolverError> {
        let (motion, step) = (self.solver.motion, self.solver.step);
        let start = self.now;
        [self.state.displacement, self.state.velocity] = start;
        let mut run = Run::new(motion, self.state, step, p, false, &mut self.memo);
        run.first_end = known_end;
        let (state, report) = run.finish()?;
        let Report { overturning, work, put_to_rest, .. } = report;
        self.state = state;
        self.work.add(work);
        self.searched += 1;
        self.stilled |= put_to_rest;
        if let (Some(offset), None) = (overturning, self.overturning) {
            self.overturning = Some(self.index as f64 * step + offset);
            self.overturned();
        }
        self.load();
        self.look_around();
        Ok(())
    }
}

/// A stretch with one turning point, its ends on the branch; takes in the extreme. Tells whether it was an ordinary one,
/// inside the branch.
#[inline(always)]
fn turn(peaks: &mut Peaks, map: &StepMap, stretch: &Stretch) -> bool {
    let Stretch { from, to, length, rate } = *stretch;
    let Some(short) = &map.short else { return false };
    let guess = turning(stretch);
    let near = short.after(guess, from, rate);
    let shift = -near.velocity / near.acceleration;
    if !(shift.abs() <= SMALL_SHIFT * length && from.velocity * to.velocity < 0.0) {
        return false;
    }
    let jerk = map.oscillator.jerk(near, rate);
    let extreme =
        near.displacement + shift * (near.velocity + shift * (near.acceleration / 2.0 + shift * jerk / 6.0));
    if extreme <= map.corners[0] || extreme >= map.corners[1] {
        return false;
    }
    peaks.include(extreme);
    true
}

/// When u, monotone, passes `corner`, beyond which the stiffness is greater by `change`, and the motion there; `None` where
/// that is not found at once.
///
/// The corner need not be met to the last bit: who changes branches δu from it, with ü for the branch ahead, has been driven by a
/// force that was wrong by |change| δu at most for a time δu/u̇, so that u̇ is wrong by |change| δu²/(2 u̇).
#[inline(always)]
fn passage(
    map: &StepMap,
    short: &Short,
    stretch: &Stretch,
    corner: f64,
    change: f64,
) -> Option<(f64, Kinematics)> {
    let Stretch { from, length, rate, .. } = *stretch;
    let mut guess = length * share(stretch, corner);
    for _ in 0..MOST_GUESSES {
        let near = short.after(guess, from, rate);
        let Kinematics { displacement, velocity, acceleration } = near;
        let beyond = displacement - corner;
        if change.abs() * beyond * beyond <= 0.5 * f64::EPSILON * velocity * velocity {
            let acceleration = acceleration - change * beyond;
            return (0.0..length).contains(&guess).then_some((guess, Kinematics { acceleration, ..near }));
        }
        let jerk = map.oscillator.jerk(near, rate);
        // u(δ) = corner, from the value on by the derivatives there
        let pace = 1.0 / velocity;
        let first = -beyond * pace;
        let bend = 0.5 * acceleration * first * pace;
        let shift = first * (1.0 - bend * (1.0 - 2.0 * bend) - jerk * first * first * pace / 6.0);
        let time = guess + shift;
        if !(0.0..length).contains(&time) {
            return None;
        }
        if shift.abs() > SMALL_SHIFT * length || bend.abs() > SMALL_BEND {
            guess = time;
            continue;
        }
        // d⁴u/dt⁴ = −c d³u/dt³ − k ü
        let snap = -map.oscillator.damping() * jerk - map.oscillator.stiffness() * acceleration;
        let velocity = velocity + shift * (acceleration + shift * (jerk / 2.0 + shift * snap / 6.0));
        let acceleration = acceleration + shift * (jerk + shift * snap / 2.0);
        return Some((time, Kinematics { displacement: corner, velocity, acceleration }));
    }
    None
}

/// The fraction of a stretch after which u, monotone, passes `bound`: the quintic t(u) through the ends, where the velocity
/// does not change much, else the quintic u(t).
#[inline(always)]
fn share(stretch: &Stretch, bound: f64) -> f64 {
    let Stretch { from, to, length, .. } = *stretch;
    let rise = to.displacement - from.displacement;
    // dt/du and d²t/du² = −ü/u̇³, for t over the length and u over the rise
    let (w0, w1) = (rise / (from.velocity * length), rise / (to.velocity * length));
    if !(EVEN.contains(&w0) && EVEN.contains(&w1)) {
        return crossing([from, to], length, bound, 2);
    }
    let bend = -0.5 * length * length / rise;
    let (b0, b1) = (bend * from.acceleration * w0 * w0 * w0, bend * to.acceleration * w1 * w1 * w1);
    let (d, dv, db) = (1.0 - w0 - b0, w1 - w0 - 2.0 * b0, b1 - b0);
    let (c3, c4, c5) = (10.0 * d - 4.0 * dv + db, -15.0 * d + 7.0 * dv - 2.0 * db, 6.0 * d - 3.0 * dv + db);
    let s = (bound - from.displacement) / rise;
    let square = s * s;
    s * ((w0 + s * b0) + square * ((c3 + s * c4) + square * c5))
}

/// Time of the one zero of u̇ in a stretch, by the cubic through u̇ and ü at its ends.
#[inline(always)]
fn turning(stretch: &Stretch) -> f64 {
    let Stretch { from, to, length, .. } = *stretch;
    let (v0, v1) = (from.velocity, to.velocity);
    let (a0, a1) = (from.acceleration * length, to.acceleration * length);
    let (c2, c3) = (3.0 * (v1 - v0) - 2.0 * a0 - a1, 2.0 * (v0 - v1) + a0 + a1);
    let mut x = v0 / (v0 - v1);
    for _ in 0..2 {
        let value = v0 + x * (a0 + x * (c2 + x * c3));
        let slope = a0 + x * (2.0 * c2 + x * 3.0 * c3);
        x = (x - value / slope).clamp(0.0, 1.0);
    }
    x * length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::{Branch, BranchDamping};
    use oscillator::Oscillator;

    /// Corners passed shortly before u turns, beyond which the force stays the same: at the end of the step the motion is that
    /// from the corner found by halving, to the rounding of u.
    #[test]
    fn slow_passages_are_as_exact_as_fast_ones() {
        let (damping, stiffness, step) = (0.05, 1.0, 0.5);
        let oscillator = Oscillator::new(damping, stiffness);
        let branch = |upper| Branch {
            lower: 0.0,
            upper,
            anchor: 0.0,
            force: 0.0,
            stiffness,
            damping: BranchDamping::Constant(damping),
        };
        let ahead = StepMap::new(Oscillator::new(damping, 0.0), step);
        let Some(short_ahead) = &ahead.short else { panic!("a short step") };
        let (mut found, mut worst) = (0, 0.0_f64);
        for slowness in 0..400 {
            // u̇ at the end of the step from 0.1 to 1e-5
            let last = 10.0_f64.powf(-1.0 - 0.01 * f64::from(slowness));
            let back = StepMap::new(Oscillator::new(-damping, stiffness), step).on(&branch(2.0));
            let Some(short) = &back.short else { panic!("a short step") };
            // the motion back in time from there
            let start = short.after(
                step,
                Kinematics { displacement: 1.0, velocity: -last, acceleration: -1.0 - damping * last },
                0.0,
            );
            let velocity = -start.velocity;
            let displacement = start.displacement;
            let from =
                Kinematics { displacement, velocity, acceleration: -displacement - damping * velocity };
            for depth in 1..40 {
                let corner = 1.0 - 10.0_f64.powf(-0.2 * f64::from(depth) - 1.5);
                let map = StepMap::new(oscillator, step).on(&branch(corner));
                let Some(short) = &map.short else { panic!("a short step") };
                let stretch = Stretch { from, to: short.after(step, from, 0.0), length: step, rate: 0.0 };
                let Some((time, there)) = passage(&map, short, &stretch, corner, -stiffness) else {
                    continue;
                };
                found += 1;
                let (mut low, mut high) = (0.0, step);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    let beyond = short.after(middle, from, 0.0).displacement > corner;
                    (low, high) = if beyond { (low, middle) } else { (middle, high) };
                }
                let exact = Kinematics { displacement: corner, ..short.after(low, from, 0.0) };
                let [ours, theirs] = [(time, there), (low, exact)]
                    .map(|(time, start)| short_ahead.after(step - time, start, 0.0));
                worst = worst
                    .max((ours.displacement - theirs.displacement).abs())
                    .max((ours.velocity - theirs.velocity).abs());
            }
        }
        assert!(found > 10_000, "{found}");
        // u and u̇, of order 1, at the corner and at the end round by a few units each
        assert!(worst <= 8.0 * f64::EPSILON, "{worst:e}");
    }
}
