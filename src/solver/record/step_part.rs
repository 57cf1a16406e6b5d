//! A part of a step on one branch: whether it stays there, its turning point, and its passage of a corner.

use super::super::Peaks;
use super::super::event::{Verdict, crossing, settle};
use super::step_map::AffineSteps;
use oscillator::{KinematicState, Polynomial};

/// Largest correction δ of a first guess, over the step h: beyond, the general search takes over
/// (docs/record-path.md, §4).
pub(super) const SMALL_SHIFT: f64 = 1e-4;
/// Largest ü δ/(2 u̇) of a correction on the way to a corner. Only where u all but turns at the corner is it
/// larger.
pub(super) const SMALL_BEND: f64 = 1e-4;
/// Evaluations of the motion on the way to a corner.
pub(super) const MOST_GUESSES: u32 = 4;
/// Ratios of the mean velocity of a passage to those at its ends for which time is well told from u.
pub(super) const EVEN: std::ops::Range<f64> = 0.3..3.0;

/// The part of a step that lies on one branch.
#[derive(Clone, Copy)]
pub(super) struct StepPart<'a> {
    pub(super) flow: Flow<'a>,
    pub(super) from: KinematicState,
    pub(super) to: KinematicState,
    /// \[s\]
    pub(super) length: f64,
    /// The forcing at the start of the part \[m/s²\], and its rate \[m/s³\].
    pub(super) forcing: f64,
    pub(super) rate: f64,
}

/// The motion over a part of a step.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "measured: a series is read where it is made")]
pub(super) enum Flow<'a> {
    /// That of a linear oscillator.
    Linear(&'a AffineSteps),
    /// A Taylor series from the start of the part on.
    Series(Polynomial),
    /// One on which u̇ keeps its sign, known at its end: that of the step, or a corner.
    Known,
}

/// The motion at one instant, with its third and fourth derivatives.
struct Near {
    motion: KinematicState,
    jerk: f64,
    snap: f64,
}

/// How a part of a step ends.
#[derive(Clone, Copy)]
pub(super) enum Course {
    /// It ends on its branch.
    Stays,
    /// It leaves its branch.
    Leaves(WayOut),
    /// More may happen than is looked for here.
    Unclear,
}

/// How a part leaves its branch.
#[derive(Clone, Copy)]
pub(super) struct WayOut {
    pub(super) upwards: bool,
    /// Whether u turns before, ü keeping its sign; else u is monotone.
    pub(super) turns: bool,
}

impl StepPart<'_> {
    /// Tells how the part ends, and takes the extreme at a turning point inside it into the peaks.
    #[inline(always)]
    pub(super) fn course(&self, corners: [f64; 2], peaks: &mut Peaks) -> Course {
        let Self { from, to, length, rate, .. } = *self;
        let within = to.displacement > corners[0] && to.displacement < corners[1];
        let leaves = |turns: bool| Course::Leaves(WayOut { upwards: to.displacement >= corners[1], turns });
        let bounds = match &self.flow {
            Flow::Known => return if within { Course::Stays } else { leaves(false) },
            Flow::Linear(steps) => steps.oscillator.bounds(from, rate, length),
            Flow::Series(polynomial) => polynomial.bounds(length),
        };
        match settle([from, to], length, bounds, corners, peaks) {
            Verdict::Quiet => Course::Stays,
            Verdict::Monotone if within => Course::Stays,
            Verdict::Monotone => leaves(false),
            Verdict::Turning if !within => leaves(true),
            Verdict::Turning if self.turn(corners, peaks).is_some() => Course::Stays,
            Verdict::Turning | Verdict::Split => Course::Unclear,
        }
    }

    /// Returns the forcing some time after the start of the part \[m/s²\].
    #[inline(always)]
    pub(super) fn forcing_after(&self, time: f64) -> f64 {
        self.forcing + self.rate * time
    }

    /// Returns the motion some time after the start of the part; `None` where that needs the general search.
    #[inline(always)]
    fn near(&self, time: f64) -> Option<Near> {
        match &self.flow {
            Flow::Known => None,
            Flow::Linear(steps) => {
                let motion = steps.short.as_ref()?.after(time, self.from, self.rate);
                let jerk = steps.oscillator.jerk(motion, self.rate);
                // d⁴u/dt⁴ = −c d³u/dt³ − k ü
                let (c, k) = (steps.oscillator.damping(), steps.oscillator.stiffness());
                Some(Near { motion, jerk, snap: -c * jerk - k * motion.acceleration })
            }
            Flow::Series(polynomial) => {
                let [displacement, velocity, acceleration, jerk, snap] = polynomial.derivatives(time);
                Some(Near { motion: KinematicState { displacement, velocity, acceleration }, jerk, snap })
            }
        }
    }

    /// Takes the extreme at the one turning point of a part that ends on its branch into the peaks; `None`
    /// where it is not an ordinary one, inside the branch.
    #[inline(always)]
    fn turn(&self, corners: [f64; 2], peaks: &mut Peaks) -> Option<()> {
        let Self { from, to, length, .. } = *self;
        let Near { motion, jerk, .. } = self.near(self.turning_time())?;
        let shift = -motion.velocity / motion.acceleration;
        if !(shift.abs() <= SMALL_SHIFT * length && from.velocity * to.velocity < 0.0) {
            return None;
        }
        let extreme = motion.displacement
            + shift * (motion.velocity + shift * (motion.acceleration / 2.0 + shift * jerk / 6.0));
        let inside = extreme > corners[0] && extreme < corners[1];
        inside.then(|| peaks.include(extreme))
    }

    /// Returns the time of the one zero of u̇, by the cubic through u̇ and ü at the ends.
    #[inline(always)]
    fn turning_time(&self) -> f64 {
        let Self { from, to, length, .. } = *self;
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

    /// Finds when u leaves the branch, beyond which the stiffness is greater by `change`, and the motion
    /// there; `None` where that is not found at once. An infinite `change` asks for the corner itself.
    /// docs/record-path.md, §4, has the error.
    #[inline(always)]
    pub(super) fn leave(
        &self,
        WayOut { upwards, turns }: WayOut,
        corners: [f64; 2],
        change: f64,
        peaks: &Peaks,
    ) -> Option<(f64, KinematicState)> {
        let corner = corners[usize::from(upwards)];
        if turns {
            let (time, there) = self.passage(self.way_back(corner), corner, change)?;
            // before it turns, u̇ is never larger than at the start
            let furthest = self.from.displacement + self.from.velocity * time;
            let (lowest, highest) = (furthest.min(corner), furthest.max(corner));
            let known = lowest >= corners[0] && highest <= corners[1] && peaks.cover(lowest, highest);
            let comes_back = (there.velocity > 0.0) == upwards;
            return (known && comes_back).then_some((time, there));
        }
        if let Flow::Known = self.flow {
            return Some((self.length, KinematicState { displacement: corner, ..self.to }));
        }
        self.passage(self.length * self.share(corner), corner, change)
    }

    /// Returns about when u, after it has turned, comes to a corner: with constant ü, then with the mean of ü
    /// that counts, ü after a third of the way.
    #[inline(always)]
    fn way_back(&self, corner: f64) -> f64 {
        let KinematicState { displacement, velocity, acceleration } = self.from;
        let square = velocity * velocity;
        let after = |a: f64| (velocity.abs() + (square - 2.0 * a * (displacement - corner)).sqrt()) / a.abs();
        let jerk = (self.to.acceleration - acceleration) / self.length;
        after(acceleration + jerk * after(acceleration) / 3.0)
    }

    /// Finds when u passes a corner, and the motion there, from a guess of the time on.
    #[inline(always)]
    fn passage(&self, mut guess: f64, corner: f64, change: f64) -> Option<(f64, KinematicState)> {
        let length = self.length;
        for _ in 0..MOST_GUESSES {
            let Near { motion, jerk, snap } = self.near(guess)?;
            let KinematicState { displacement, velocity, acceleration } = motion;
            let beyond = displacement - corner;
            // close enough to change branches there, with ü for the branch ahead
            if change.abs() * beyond * beyond <= 0.5 * f64::EPSILON * velocity * velocity {
                let acceleration = acceleration - change * beyond;
                return (0.0..length)
                    .contains(&guess)
                    .then_some((guess, KinematicState { acceleration, ..motion }));
            }
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
            let velocity = velocity + shift * (acceleration + shift * (jerk / 2.0 + shift * snap / 6.0));
            let acceleration = acceleration + shift * (jerk + shift * snap / 2.0);
            return Some((time, KinematicState { displacement: corner, velocity, acceleration }));
        }
        None
    }

    /// Returns the fraction of the part after which u, monotone, passes `bound`: by the quintic t(u) through
    /// the ends, where the velocity does not change much, else by the quintic u(t).
    #[inline(always)]
    fn share(&self, bound: f64) -> f64 {
        let Self { from, to, length, .. } = *self;
        let rise = to.displacement - from.displacement;
        // dt/du and d²t/du² = −ü/u̇³, for t over the length and u over the rise
        let (w0, w1) = (rise / (from.velocity * length), rise / (to.velocity * length));
        if !(EVEN.contains(&w0) && EVEN.contains(&w1)) {
            return crossing([from, to], length, bound, 2);
        }
        let bend = -0.5 * length * length / rise;
        let (b0, b1) = (bend * from.acceleration * w0 * w0 * w0, bend * to.acceleration * w1 * w1 * w1);
        let (d, dv, db) = (1.0 - w0 - b0, w1 - w0 - 2.0 * b0, b1 - b0);
        let c3 = 10.0 * d - 4.0 * dv + db;
        let c4 = -15.0 * d + 7.0 * dv - 2.0 * db;
        let c5 = 6.0 * d - 3.0 * dv + db;
        let s = (bound - from.displacement) / rise;
        let square = s * s;
        s * ((w0 + s * b0) + square * ((c3 + s * c4) + square * c5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use oscillator::Oscillator;

    /// Corners passed shortly before u turns, beyond which the force stays the same: at the end of the step
    /// the motion is that from the corner found by halving, to the rounding of u.
    #[test]
    fn slow_passages_are_as_exact_as_fast_ones() {
        let (damping, stiffness, step) = (0.05, 1.0, 0.5);
        let oscillator = Oscillator::new(damping, stiffness);
        let ahead = AffineSteps::new(Oscillator::new(damping, 0.0), step);
        let Some(short_ahead) = &ahead.short else { panic!("a short step") };
        let (mut found, mut worst) = (0, 0.0_f64);
        for slowness in 0..400 {
            // u̇ at the end of the step from 0.1 to 1e-5
            let last = 10.0_f64.powf(-1.0 - 0.01 * f64::from(slowness));
            let back = AffineSteps::new(Oscillator::new(-damping, stiffness), step);
            let Some(short) = &back.short else { panic!("a short step") };
            // the motion back in time from there
            let start = short.after(
                step,
                KinematicState { displacement: 1.0, velocity: -last, acceleration: -1.0 - damping * last },
                0.0,
            );
            let velocity = -start.velocity;
            let displacement = start.displacement;
            let from =
                KinematicState { displacement, velocity, acceleration: -displacement - damping * velocity };
            for depth in 1..40 {
                let corner = 1.0 - 10.0_f64.powf(-0.2 * f64::from(depth) - 1.5);
                let steps = AffineSteps::new(oscillator, step);
                let Some(short) = &steps.short else { panic!("a short step") };
                let (to, flow) = (short.after(step, from, 0.0), Flow::Linear(&steps));
                let part = StepPart { flow, from, to, length: step, forcing: 0.0, rate: 0.0 };
                let way_out = WayOut { upwards: true, turns: false };
                let corners = [f64::NEG_INFINITY, corner];
                let peaks = Peaks::at(0.0);
                let Some((time, there)) = part.leave(way_out, corners, -stiffness, &peaks) else {
                    continue;
                };
                found += 1;
                let (mut low, mut high) = (0.0, step);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    let beyond = short.after(middle, from, 0.0).displacement > corner;
                    (low, high) = if beyond { (low, middle) } else { (middle, high) };
                }
                let exact = KinematicState { displacement: corner, ..short.after(low, from, 0.0) };
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

    /// Walls thrown off a corner come back to it when halving says so.
    #[test]
    fn ways_back_are_found() {
        let (damping, stiffness, step) = (0.05, -1.0, 0.5);
        let steps = AffineSteps::new(Oscillator::new(damping, stiffness), step);
        let Some(short) = &steps.short else { panic!("a short step") };
        let (mut found, mut worst) = (0, 0.0_f64);
        for (depth, rate) in (1..200).flat_map(|depth| [-1.5, 0.0, 0.5].map(|rate| (depth, rate))) {
            let velocity = 0.2 * 0.95_f64.powi(depth);
            let acceleration = -1.0 - damping * velocity;
            let from = KinematicState { displacement: 0.0, velocity, acceleration };
            let to = short.after(step, from, rate);
            let part = StepPart { flow: Flow::Linear(&steps), from, to, length: step, forcing: -1.0, rate };
            let corners = [0.0, 1.0];
            let mut peaks = Peaks::at(0.5);
            let Course::Leaves(way_out) = part.course(corners, &mut peaks) else { continue };
            assert!(way_out.turns && !way_out.upwards);
            let Some((time, there)) = part.leave(way_out, corners, f64::INFINITY, &peaks) else { continue };
            found += 1;
            let (mut low, mut high) = (velocity / 2.0, step);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                let above = short.after(middle, from, rate).displacement > 0.0;
                (low, high) = if above { (middle, high) } else { (low, middle) };
            }
            let exact = short.after(low, from, rate);
            assert_eq!(there.displacement, 0.0);
            worst = worst.max((time - low).abs() / low).max((there.velocity / exact.velocity - 1.0).abs());
        }
        assert!(found > 400, "{found}");
        // time and u̇ of a flight round by a few units each
        assert!(worst <= 16.0 * f64::EPSILON, "{worst:e}");
    }
}
