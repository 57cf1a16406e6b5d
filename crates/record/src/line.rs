//! The line of a branch with constant damping: the motion along it, and the bounds within which that holds.

use crate::branches::Branches;
use crate::lanes::{Lanes, Rows};
use crate::number::Number;
use crate::numbering::LaneBranch;

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

/// The line of the branch of each lane, ü = p − c u̇ − f(0) − k u, and γ over a step.
#[derive(Clone, Copy)]
pub(crate) struct LinearBranch<N> {
    pub(crate) c: N,
    pub(crate) k: N,
    pub(crate) force_at_zero: N,
    pub(crate) growth: N,
}

impl<N: Number> LinearBranch<N> {
    #[inline(always)]
    pub(crate) fn look_up(token: N::Token, branches: &Branches<'_, N>) -> Self {
        Self {
            c: branches.look_up(token, |table| &table.damping),
            k: branches.look_up(token, |table| &table.stiffness),
            force_at_zero: branches.look_up(token, |table| &table.force_at_zero),
            growth: branches.look_up(token, |table| &table.growth),
        }
    }

    #[inline(always)]
    fn force(&self, u: N) -> N {
        self.force_at_zero + self.k * u
    }

    #[inline(always)]
    pub(crate) fn acceleration(&self, [u, v]: [N; 2], forcing: N) -> N {
        forcing - self.c * v - self.force(u)
    }

    /// Finds where u goes between two instants, |p| being up to `forcing` (docs/record-path.md, §3).
    #[inline(always)]
    pub(crate) fn course(
        &self,
        from: [N; 2],
        to: [N; 2],
        forcing: N,
        length: N,
        bounds: &Bounds<N>,
    ) -> Course<N::Mask> {
        let zero = length.like(0.0);
        let (speed0, speed1) = (from[1].abs(), to[1].abs());
        let change = self.most(forcing, from, to) * length;
        let keeps = zero.below(from[1] * to[1]) & change.below(speed0 + speed1);
        let margin = N::select(keeps, zero, change * length * 0.125);
        // from this speed on u does not come back to where it starts
        let away = change.at_most(speed0 + speed0);
        let low = from[0].min(to[0]) - N::select(away & zero.below(from[1]), zero, margin);
        let high = from[0].max(to[0]) + N::select(away & from[1].below(zero), zero, margin);
        let inside = bounds.ends[0].below(to[0]) & to[0].below(bounds.ends[1]);
        let slow = speed0.max(speed1).at_most(bounds.speed);
        let [lowest, highest] = bounds.within;
        let stays = inside & slow & lowest.at_most(low) & high.at_most(highest);
        Course { stays, leaves: keeps & !inside }
    }

    /// Returns A, the bound on |ü| between two instants up to a step apart, by the largest |p| and by |u̇|
    /// and |f| there.
    #[inline(always)]
    pub(crate) fn most(&self, forcing: N, from: [N; 2], to: [N; 2]) -> N {
        let force = self.force(from[0]).abs().max(self.force(to[0]).abs());
        self.growth * (forcing + self.c * from[1].abs().max(to[1].abs()) + force)
    }

    /// Returns u, u̇ and ü `time` after an instant, under a forcing that changes at `rate`: with E₀ = ü, E₁ =
    /// t d³u/dt³ and Eₙ = −c t Eₙ₋₁ − k t² Eₙ₋₂, u̇ grows by t Σ Eₙ/(n+1)! and u by t (u̇ + t Σ Eₙ/(n+2)!).
    #[inline(always)]
    pub(crate) fn after(&self, terms: usize, time: N, [u, v, a]: [N; 3], rate: N) -> [N; 3] {
        let Self { c, k, .. } = *self;
        let (p, q) = (-(c * time), -(k * time * time));
        // two terms at a time: the chain of terms that depend on each other is half as long
        let (p2, q2) = (p * p + q, p * q);
        let (mut even, mut odd) = (a, time * (rate - c * a - k * v));
        let mut sum_v = a + odd * 0.5;
        let mut sum_u = a * 0.5 + odd * (1.0 / 6.0);
        for n in (2..terms).step_by(2) {
            (even, odd) = (p * odd + q * even, p2 * odd + q2 * even);
            let [of_v, of_even, of_odd] =
                [INVERSE_FACTORIALS[n + 1], INVERSE_FACTORIALS[n + 2], INVERSE_FACTORIALS[n + 3]];
            sum_v = sum_v + (even * of_v + odd * of_even);
            sum_u = sum_u + (even * of_even + odd * of_odd);
        }
        let (dv, du) = (time * sum_v, time * (v + time * sum_u));
        [u + du, v + dv, a + (rate * time - c * dv - k * du)]
    }
}

/// Where u and u̇ may be, on the branch of each lane.
#[derive(Clone, Copy)]
pub(crate) struct Bounds<N> {
    /// The ends of the branch \[m\].
    pub(crate) ends: [N; 2],
    /// The part of the branch that u must not leave \[m\]: where f̂ bounds the forces, or up to the peaks.
    pub(crate) within: [N; 2],
    /// V, the largest |u̇| \[m/s\].
    pub(crate) speed: N,
}

impl<N: Number> Bounds<N> {
    #[inline(always)]
    pub(crate) fn look_up(token: N::Token, branches: &Branches<'_, N>, rows: &Rows, first: usize) -> Self {
        let [lower, upper] = [0, 1].map(|side| branches.look_up(token, |table| &table.ends[side]));
        let [lowest, highest] = [0, 1].map(|side| N::load(token, &rows.limits[side], first));
        let share = branches.look_up(token, |table| &table.speed_share);
        Self {
            ends: [lower, upper],
            within: [lower.max(lowest), upper.min(highest)],
            speed: share * N::load(token, &rows.driving, first),
        }
    }
}

impl<O> Lanes<'_, O> {
    /// Returns where u and u̇ may be on the branch of each lane.
    #[inline(always)]
    pub(crate) fn bounds<N: Number>(
        &self,
        token: N::Token,
        first: usize,
        branch: LaneBranch<N>,
    ) -> Bounds<N> {
        Bounds::look_up(token, &self.branches(first, branch), &self.rows, first)
    }
}

/// Where u goes in lanes: lanes in which it stays on its branch and within its bounds, and lanes in which it
/// leaves the branch with u̇ of one sign.
#[derive(Clone, Copy)]
pub(crate) struct Course<M> {
    pub(crate) stays: M,
    pub(crate) leaves: M,
}

#[cfg(test)]
pub(crate) mod tests;
