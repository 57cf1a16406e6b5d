//! Steps on a branch with constant damping as affine maps.

use oscillator::Oscillator;

/// Most plain steps taken at once. The last ones of a block may end beyond it, by one step less than this.
pub(crate) const MOST_AT_ONCE: usize = 4;

/// An affine map over some steps, by the forcing less the branch's force at u = 0, q = p − f(0): the
/// change of u and of u̇ for each of u₀, u̇₀ and the q at the samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Affine {
    pub(crate) of_state: [[f64; 2]; 2],
    pub(crate) of_forcing: [[f64; 2]; MOST_AT_ONCE + 1],
}

impl Affine {
    pub(crate) fn one_step(oscillator: &Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        let green = oscillator.green(step);
        let (g, h, j) = (green.g, green.h, green.j / step);
        let mut of_forcing = [[0.0; 2]; MOST_AT_ONCE + 1];
        [of_forcing[0], of_forcing[1]] = [[h - j, g - h / step], [j, h / step]];
        Self { of_state: [[-k * h, -k * g], [g, -(k * h + c * g)]], of_forcing }
    }

    /// Makes the map of some steps, four at most: the closed form for the state, and the forcing step by
    /// step.
    pub(crate) fn steps(one: &Self, count: usize, oscillator: &Oscillator, step: f64) -> Self {
        let of_state = Self::one_step(oscillator, count as f64 * step).of_state;
        let [by_u, by_v] = one.of_state;
        let mut of_forcing = [[0.0; 2]; MOST_AT_ONCE + 1];
        for n in 0..count {
            // what came before, moved on by one step
            for [u, v] in &mut of_forcing[..=n] {
                (*u, *v) = (*u + (by_u[0] * *u + by_v[0] * *v), *v + (by_u[1] * *u + by_v[1] * *v));
            }
            for (end, term) in one.of_forcing[..2].iter().enumerate() {
                of_forcing[n + end][0] += term[0];
                of_forcing[n + end][1] += term[1];
            }
        }
        Self { of_state, of_forcing }
    }

    /// Returns the change of u and u̇ by the forcing at five samples.
    #[inline(always)]
    pub(crate) fn respond(&self, p: &[f64]) -> [f64; 2] {
        let [a, b, c, d, e] = self.of_forcing;
        [
            ((a[0] * p[0] + b[0] * p[1]) + (c[0] * p[2] + d[0] * p[3])) + e[0] * p[4],
            ((a[1] * p[0] + b[1] * p[1]) + (c[1] * p[2] + d[1] * p[3])) + e[1] * p[4],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The map of two or four steps leads where two or four maps of one step lead.
    #[test]
    fn steps_at_once_are_single_steps() {
        let (step, q) = (0.01, [0.7, -1.1, 0.4, 2.3, -0.6]);
        for (c, k) in [(0.0, 0.0), (0.4, 900.0), (3.0, -2.5), (60.0, 400.0)] {
            let oscillator = Oscillator::new(c, k);
            let one = Affine::one_step(&oscillator, step);
            let change = |map: &Affine, [u, v]: [f64; 2], by_forcing: [f64; 2]| {
                let [by_u, by_v] = map.of_state;
                [0, 1].map(|part| by_u[part] * u + by_v[part] * v + by_forcing[part])
            };
            for count in [2, MOST_AT_ONCE] {
                let start = [0.03, -0.2];
                let mut now = start;
                for q in q[..=count].windows(2) {
                    let by_forcing = one.respond(&[q[0], q[1], 0.0, 0.0, 0.0]);
                    let [du, dv] = change(&one, now, by_forcing);
                    now = [now[0] + du, now[1] + dv];
                }
                let map = Affine::steps(&one, count, &oscillator, step);
                let [du, dv] = change(&map, start, map.respond(&q));
                // each step rounds a few times, to a share of the largest term: |u| and |u̇| are below 1 here
                let most = 8.0 * count as f64 * f64::EPSILON * (1.0 + k.abs() * step);
                let error = (start[0] + du - now[0]).abs().max((start[1] + dv - now[1]).abs());
                assert!(error <= most, "c = {c}, k = {k}, {count} steps: {error:e}");
            }
        }
    }
}
