//! Corners passed by several lanes at once.

use super::super::careful::{EVEN, MOST_GUESSES, SMALL_BEND, SMALL_SHIFT};
use super::responses::{By, Found, Responses};
use super::vector::Vector;

/// 1/n!.
const INVERSE_FACTORIALS: [f64; 24] = {
    let mut inverse = [1.0; 24];
    let mut n = 1;
    while n < inverse.len() {
        inverse[n] = inverse[n - 1] / n as f64;
        n += 1;
    }
    inverse
};

/// A step h on which u leaves the lane's branch.
#[derive(Clone, Copy)]
pub(super) struct Leaving<V: Vector> {
    /// Lanes that take this step.
    pub(super) lanes: V::Mask,
    pub(super) branch: V,
    /// u and u̇ at the start, and at the end if the branch went on.
    pub(super) from: [V; 2],
    pub(super) to: [V; 2],
    /// p at both ends \[m/s²\].
    pub(super) forcing: [V; 2],
    /// P over the stretch \[m/s²\].
    pub(super) largest_forcing: V,
    /// Up to where u may go by what is known \[m\].
    pub(super) known: [V; 2],
    /// h \[s\].
    pub(super) step: V,
    pub(super) inverse_step: V,
}

/// The end of a step that passed a corner.
#[derive(Clone, Copy)]
pub(super) struct Arrival<V: Vector> {
    /// Lanes for which that was found.
    pub(super) lanes: V::Mask,
    pub(super) end: [V; 2],
    pub(super) branch: V,
}

impl<V: Vector> Leaving<V> {
    /// Passes the one corner of the step: u is monotone up to it and beyond it, and nothing but the stiffness changes there.
    /// Other lanes are left alone.
    #[inline(always)]
    pub(super) fn pass(self, responses: &Responses) -> Arrival<V> {
        let (zero, one, half) = (V::splat(0.0), V::splat(1.0), V::splat(0.5));
        let Self { branch, from: [u, v], to: [to_u, to_v], forcing: [p0, p1], step, .. } = self;
        let here = responses.of(branch);
        let (c, k, force) = (here.by(By::Damping), here.by(By::Stiffness), here.by(By::Force));
        let rate = (p1 - p0) * self.inverse_step;
        let (f0, f1) = (force + k * u, force + k * to_u);
        let (a0, a1) = (p0 - c * v - f0, p1 - c * to_v - f1);
        let keeps_on = self.keeps_its_sign(here, [v, to_v], [f0, f1], step);
        let upwards = u.below(to_u);
        let corner = V::choose(upwards, here.by(By::PlainUpper), here.by(By::PlainLower));
        let share = self.share(corner, [a0, a1]);
        // the time at the corner, by the derivatives at a guess
        let mut time = step * share;
        let mut sought = self.lanes & keeps_on & zero.below(share) & share.below(one);
        let mut found = V::mask(0);
        let (mut there, mut v_there, mut a_there) = (zero, zero, zero);
        for guess in 0..MOST_GUESSES {
            let [near_u, near_v, near_a] = after(responses.terms, time, [u, v, a0], rate, c, k);
            let beyond = near_u - corner;
            let jerk = rate - c * near_a - k * near_v;
            let pace = one / near_v;
            let first = zero - beyond * pace;
            let bend = half * near_a * first * pace;
            let third = jerk * (first * first) * pace * V::splat(1.0 / 6.0);
            let shift = first * (one - bend * (one - (bend + bend)) - third);
            let next = time + shift;
            let inside = zero.at_most(next) & next.below(step);
            let small =
                shift.abs().at_most(V::splat(SMALL_SHIFT) * step) & bend.abs().at_most(V::splat(SMALL_BEND));
            let now = sought & inside & small;
            // d⁴u/dt⁴ = −c d³u/dt³ − k ü
            let snap = zero - c * jerk - k * near_a;
            let third_shift = V::splat(1.0 / 3.0) * shift;
            there = V::choose(now, next, there);
            v_there = V::choose(
                now,
                near_v + shift * (near_a + half * shift * (jerk + third_shift * snap)),
                v_there,
            );
            a_there = V::choose(now, near_a + shift * (jerk + half * shift * snap), a_there);
            found = found | now;
            sought = sought & inside & !small;
            if V::bits(sought) == 0 || guess + 1 == MOST_GUESSES {
                break;
            }
            time = V::choose(sought, next, time);
        }
        let other = V::choose(upwards, branch + one, (branch - one).max(zero));
        let branch = V::choose(self.lanes, other, branch);
        let ahead = responses.of(branch);
        let (c, k, force) = (ahead.by(By::Damping), ahead.by(By::Stiffness), ahead.by(By::Force));
        let remaining = step - there;
        let [end_u, end_v, _] = after(responses.terms, remaining, [corner, v_there, a_there], rate, c, k);
        let (f0, f1) = (force + k * corner, force + k * end_u);
        let within = ahead.by(By::Lower).below(end_u)
            & end_u.below(ahead.by(By::Upper))
            & self.known[0].at_most(end_u)
            & end_u.at_most(self.known[1]);
        let lanes = found & within & self.keeps_its_sign(ahead, [v_there, end_v], [f0, f1], remaining);
        Arrival { lanes, end: [end_u, end_v], branch }
    }

    /// Lanes whose u̇ keeps its sign between two instants: |ü| ≤ A, so that u̇ has no zero between values of one sign that are
    /// larger together than A times the time between; A as of the module `record`, with |u̇| and |f| at both ends for V and f̂.
    #[inline(always)]
    fn keeps_its_sign(&self, branch: Found<'_, V>, [v0, v1]: [V; 2], [f0, f1]: [V; 2], time: V) -> V::Mask {
        let driving =
            self.largest_forcing + branch.by(By::Damping) * v0.abs().max(v1.abs()) + f0.abs().max(f1.abs());
        let most = branch.by(By::Growth) * driving;
        V::splat(0.0).below(v0 * v1) & (most * time).below(v0.abs() + v1.abs())
    }

    /// The fraction of the step after which u passes a corner: by the quintic t(u) through the ends, where the velocity does not
    /// change much.
    #[inline(always)]
    fn share(&self, corner: V, [a0, a1]: [V; 2]) -> V {
        let Self { from: [u, v], to: [to_u, to_v], step, .. } = *self;
        let (one, number) = (V::splat(1.0), V::splat);
        let rise = to_u - u;
        let inverse = one / rise;
        let (w0, w1) = (rise / (v * step), rise / (to_v * step));
        let bend = number(-0.5) * step * step * inverse;
        let (b0, b1) = (bend * a0 * (w0 * w0 * w0), bend * a1 * (w1 * w1 * w1));
        let (d, dv, db) = (one - w0 - b0, w1 - w0 - (b0 + b0), b1 - b0);
        let c3 = number(10.0) * d - number(4.0) * dv + db;
        let c4 = number(7.0) * dv - number(15.0) * d - (db + db);
        let c5 = number(6.0) * d - number(3.0) * dv + db;
        let s = (corner - u) * inverse;
        let square = s * s;
        let quintic = s * ((w0 + s * b0) + square * ((c3 + s * c4) + square * c5));
        let (least, most) = (number(EVEN.start), number(EVEN.end));
        let even = least.at_most(w0) & w0.below(most) & least.at_most(w1) & w1.below(most);
        V::choose(even, quintic, s)
    }
}

/// u, u̇ and ü `time` after an instant, under a forcing that changes at `rate`: with E₀ = ü, E₁ = t d³u/dt³ and
/// Eₙ = −c t Eₙ₋₁ − k t² Eₙ₋₂, u̇ grows by t Σ Eₙ/(n+1)! and u by t (u̇ + t Σ Eₙ/(n+2)!).
#[inline(always)]
fn after<V: Vector>(terms: usize, time: V, [u, v, a]: [V; 3], rate: V, c: V, k: V) -> [V; 3] {
    let (p, q) = (V::splat(0.0) - c * time, V::splat(0.0) - k * time * time);
    // two terms at once wait for each other half as long
    let (p2, q2) = (p * p + q, p * q);
    let (mut even, mut odd) = (a, time * (rate - c * a - k * v));
    let mut sum_v = a + V::splat(0.5) * odd;
    let mut sum_u = V::splat(0.5) * a + V::splat(1.0 / 6.0) * odd;
    for n in (2..terms).step_by(2) {
        (even, odd) = (p * odd + q * even, p2 * odd + q2 * even);
        let [of_v, of_even, of_odd] = [n + 1, n + 2, n + 3].map(|n| V::splat(INVERSE_FACTORIALS[n]));
        sum_v = sum_v + (of_v * even + of_even * odd);
        sum_u = sum_u + (of_even * even + of_odd * odd);
    }
    let (dv, du) = (time * sum_v, time * (v + time * sum_u));
    [u + du, v + dv, a + (rate * time - c * dv - k * du)]
}
