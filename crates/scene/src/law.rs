//! The force law that is made of a capacity curve.
//!
//! A law keeps the points from which the curve is within a tolerance: the ends of straight lines, each split
//! where the curve is farthest from it. This is the rule of Douglas and Peucker (1973), with the distance
//! measured along the force.

use std::fmt::Write;
use std::ops::RangeInclusive;

use rocking_wall::wall::{Body, Sides, six_digits};

/// How far the end of a curve may be from `u_ins` without a word, of it \[-\].
const MOST_OFF_END: f64 = 0.01;
/// Largest forces of a curve that are probable, of F₀ \[-\].
const USUAL_FORCES: RangeInclusive<f64> = 0.1..=3.0;

/// Ends |u| \[m\] and largest a* \[g\] of oscillators that are probable.
const USUAL_ENDS: RangeInclusive<f64> = 0.001..=5.0;
const USUAL_ACCELERATIONS: RangeInclusive<f64> = 0.005..=5.0;

/// A law of some of the points of a curve.
pub(crate) struct Law {
    pub(crate) points: Vec<[f64; 2]>,
    /// The place of the origin among the points.
    zero: usize,
    /// The places of the points that are kept, rising.
    pub(crate) kept: Vec<usize>,
    /// The largest |ΔF| between law and curve over the largest |F| of its side \[-\], and its u \[m\].
    off: [f64; 2],
}

/// The end of a side of a law: its point, dF/du of the last line, and |u| where that is 0.
pub(crate) struct End {
    point: [f64; 2],
    pub(crate) slope: f64,
    pub(crate) u: f64,
}

impl Law {
    pub(crate) fn new(mut points: Vec<[f64; 2]>, tolerance: f64) -> Self {
        let zero = points.partition_point(|point| point[0] < 0.0);
        points.insert(zero, [0.0; 2]);
        let [left, right] = [&points[..zero], &points[zero..]].map(largest_force);
        let (mut kept, mut off) = (vec![0, zero], [0.0; 2]);
        let mut open = vec![[0, zero], [zero, points.len() - 1]];
        while let Some([from, to]) = open.pop() {
            let [[u0, f0], [u1, f1]] = [points[from], points[to]];
            let largest = if from < zero { left } else { right };
            let away = |at: usize| {
                let [u, force] = points[at];
                [((force - f0 - (f1 - f0) * (u - u0) / (u1 - u0)) / largest).abs(), u]
            };
            let farthest = (from + 1..to).max_by(|a, b| away(*a)[0].total_cmp(&away(*b)[0]));
            match farthest.map(|at| (at, away(at))) {
                Some((at, away)) if away[0] > tolerance => open.extend([[from, at], [at, to]]),
                farthest => {
                    kept.push(to);
                    off = farthest.map(|(_, away)| away).filter(|away| away[0] > off[0]).unwrap_or(off);
                }
            }
        }
        kept.sort_unstable();
        kept.dedup();
        Self { points, zero, kept, off }
    }

    /// The ends of u > 0 and, where the curve has that side, of u < 0.
    pub(crate) fn ends(&self) -> impl Iterator<Item = End> {
        let count = self.kept.len();
        let pairs = [Some([count - 2, count - 1]), (self.zero > 0).then_some([1, 0])];
        pairs.into_iter().flatten().map(|pair| {
            let [[u0, f0], point] = pair.map(|place| self.points[self.kept[place]]);
            let slope = (point[1] - f0) / (point[0] - u0);
            End { point, slope, u: (point[0] - point[1] / slope).abs() }
        })
    }

    /// Returns the corners [u/`u_ins`, F/F₀] on a body.
    pub(crate) fn fractions(&self, body: &Body) -> Vec<[f64; 2]> {
        let fraction = |[u, force]: [f64; 2]| [u / body.instability.of(u), force / body.strength.of(u)];
        let corners = self.kept.iter().filter(|at| **at != self.zero).map(|at| self.points[*at]);
        let is_mirrored = self.zero == 0 && body.strength != Sides::both(body.strength.positive);
        let mirrored = corners.clone().rev().filter(|_| is_mirrored).map(|point| point.map(|number| -number));
        mirrored.chain(corners).map(fraction).collect()
    }

    /// Says how many points the law keeps, and how far it is from the others.
    pub(crate) fn short_note(&self) -> String {
        let [kept, all] = [self.kept.len(), self.points.len()].map(|count| count - 1);
        let points = format!("{kept} of {all} points");
        let percent = 100.0 * self.off[0];
        if percent > 0.0 { format!("{points}, ΔF at most {percent:.3} %") } else { points }
    }

    /// Goes on after the short note: where the law is farthest off, and how it ends.
    pub(crate) fn rest_of_note(&self) -> String {
        let [off, u] = self.off;
        let mut note = String::new();
        // writing to a String cannot fail
        if off > 0.0 {
            let _ = write!(note, " of the largest F of its side, at u = {u:.4} m");
        }
        for End { point: [last, _], u, .. } in self.ends().filter(|end| end.point[1] != 0.0) {
            let _ = write!(note, "; beyond its last point, u = {last:.4} m, F falls to 0 at |u| = {u:.4} m");
        }
        note
    }

    /// Says where the curve does not fit the geometry of a body: an end other than `u_ins`, an improbable F.
    pub(crate) fn doubts(&self, body: &Body) -> Vec<String> {
        let mut doubts = Vec::new();
        for End { point: [last, _], u: end, .. } in self.ends() {
            let (u_ins, f0) = (body.instability.of(last), body.strength.of(last));
            if (end / u_ins - 1.0).abs() > MOST_OFF_END {
                let force = self.force(u_ins.copysign(last));
                doubts.push(format!(
                    "F is {force:.0} N at u_ins = {u_ins:.4} m, beyond which the wall is overturned, and 0 \
                     at |u| = {} m: give the geometry of the curve, or an oscillator",
                    six_digits(end)
                ));
            }
            let side = if last < 0.0 { &self.points[..self.zero] } else { &self.points[self.zero..] };
            let ratio = largest_force(side) / f0;
            if !USUAL_FORCES.contains(&ratio) {
                let [least, most] = [USUAL_FORCES.start(), USUAL_FORCES.end()];
                doubts.push(format!(
                    "the largest F is {ratio:.3} F0 of the geometry, not {least} to {most}: check the unit"
                ));
            }
        }
        doubts
    }

    /// Says where the curve of an oscillator is improbable; `weight` is λ `m_eff` g \[N\].
    pub(crate) fn doubts_of_oscillator(&self, weight: f64) -> Vec<String> {
        let mut doubts = Vec::new();
        let end = self.ends().map(|end| end.u).fold(0.0, f64::max);
        if !USUAL_ENDS.contains(&end) {
            let [least, most] = [USUAL_ENDS.start(), USUAL_ENDS.end()];
            let end = six_digits(end);
            doubts.push(format!("F is 0 at |u| = {end} m, not {least} to {most} m: check the unit"));
        }
        let largest = largest_force(&self.points) / weight;
        if !USUAL_ACCELERATIONS.contains(&largest) {
            let [least, most] = [USUAL_ACCELERATIONS.start(), USUAL_ACCELERATIONS.end()];
            doubts.push(format!(
                "the largest a* is {largest:.3e} g, not {least} to {most}: check the unit, and effective_mass"
            ));
        }
        doubts
    }

    /// The force of the law \[N\] at u \[m\].
    fn force(&self, u: f64) -> f64 {
        let above = self.kept.partition_point(|at| self.points[*at][0] < u);
        let to = above.clamp(1, self.kept.len() - 1);
        let [[u0, f0], [u1, f1]] = [to - 1, to].map(|place| self.points[self.kept[place]]);
        f0 + (f1 - f0) * (u - u0) / (u1 - u0)
    }
}

/// The largest |F| of points \[N\].
fn largest_force(points: &[[f64; 2]]) -> f64 {
    points.iter().fold(0.0, |largest, point| largest.max(point[1].abs()))
}
