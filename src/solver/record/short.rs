//! Green's functions of a branch as polynomials, for times up to one step.

use oscillator::{KinematicState, Oscillator};

/// Coefficients taken together: four chains run side by side.
const WIDTH: usize = 4;
/// Most groups of coefficients, enough for c h + √|k| h ≤ 0.55.
const MOST_GROUPS: usize = 4;
/// Largest share of the leading term that may be left out.
const NEGLIGIBLE: f64 = 1e-18;

/// G, H and J of an oscillator over its first step.
///
/// With γ₀ = 1, γ₁ = −c, γₙ = −(c γₙ₋₁ + k γₙ₋₂),
/// ```text
/// G = t Σ γₙ tⁿ/(n+1)!,   H = t² Σ γₙ tⁿ/(n+2)!,   J = t³ Σ γₙ tⁿ/(n+3)!
/// ```
#[derive(Clone, Copy, Debug)]
pub(super) struct Short {
    /// γₙ over (n+1)!, (n+2)! and (n+3)!; the fourth place stays 0.
    coefficients: [[f64; 4]; WIDTH * MOST_GROUPS],
    groups: usize,
    damping: f64,
    stiffness: f64,
}

impl Short {
    /// Prepares the polynomials for times up to `step` \[s\]; `None` where they would be long.
    pub(super) fn new(oscillator: &Oscillator, step: f64) -> Option<Self> {
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        // |γₙ| ≤ (c + √|k|)ⁿ
        let reach = (c + k.abs().sqrt()) * step;
        let left_out = |groups: usize| {
            let terms = (WIDTH * groups) as f64;
            (1..=WIDTH * groups + 1).fold(reach.powf(terms), |share, n| share / n as f64)
        };
        let groups = (2..=MOST_GROUPS).find(|&groups| left_out(groups) < NEGLIGIBLE)?;
        let mut coefficients = [[0.0; 4]; WIDTH * MOST_GROUPS];
        let (mut before, mut gamma, mut factorial) = (0.0, 1.0, 1.0);
        for (n, weights) in coefficients.iter_mut().enumerate().take(WIDTH * groups) {
            let n = n as f64;
            factorial *= n + 1.0;
            let [second, third] = [n + 2.0, (n + 2.0) * (n + 3.0)];
            *weights = [gamma / factorial, gamma / (factorial * second), gamma / (factorial * third), 0.0];
            (before, gamma) = (gamma, -(c * gamma + k * before));
        }
        Some(Self { coefficients, groups, damping: c, stiffness: k })
    }

    /// Returns the motion `time` after `start` under a forcing that changes at `rate` \[m/s³\].
    #[inline(always)]
    pub(super) fn after(&self, time: f64, start: KinematicState, rate: f64) -> KinematicState {
        let [g, h, j] = self.green(time);
        let (c, k) = (self.damping, self.stiffness);
        let KinematicState { displacement, velocity, acceleration } = start;
        KinematicState {
            displacement: displacement + ((g + c * h) * velocity + (h * acceleration + j * rate)),
            velocity: velocity + ((g * acceleration + h * rate) - k * h * velocity),
            acceleration: acceleration
                + (g * (rate - k * velocity - c * acceleration) - k * h * acceleration),
        }
    }

    #[inline(always)]
    fn green(&self, time: f64) -> [f64; 3] {
        match self.groups {
            2 => self.summed::<2>(time),
            3 => self.summed::<3>(time),
            _ => self.summed::<MOST_GROUPS>(time),
        }
    }

    /// Sums G, H and J: every fourth coefficient by Horner's rule in t⁴, then the four sums together.
    #[inline(always)]
    fn summed<const GROUPS: usize>(&self, time: f64) -> [f64; 3] {
        let square = time * time;
        let fourth = square * square;
        let mut sums: [[f64; 4]; WIDTH] =
            std::array::from_fn(|j| self.coefficients[WIDTH * (GROUPS - 1) + j]);
        for group in (0..GROUPS - 1).rev() {
            for (j, sum) in sums.iter_mut().enumerate() {
                for (place, value) in sum.iter_mut().enumerate() {
                    *value = *value * fourth + self.coefficients[WIDTH * group + j][place];
                }
            }
        }
        let total = |place: usize| {
            (sums[0][place] + time * sums[1][place]) + square * (sums[2][place] + time * sums[3][place])
        };
        [time * total(0), square * total(1), square * time * total(2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the closed forms, over a step, within roundings of each term.
    #[test]
    fn sums_are_the_closed_forms() {
        for (damping, stiffness, step) in
            [(0.5, 130.0, 5e-3), (3.6, 8100.0, 5e-3), (0.5, -2.5, 0.02), (0.0, 0.0, 1.0)]
        {
            let oscillator = Oscillator::new(damping, stiffness);
            let short = Short::new(&oscillator, step).expect("a short step");
            for part in 1..=10 {
                let time = step * f64::from(part) / 10.0;
                let ours = short.green(time);
                let theirs = oscillator.green(time);
                for (a, b) in ours.into_iter().zip([theirs.g, theirs.h, theirs.j]) {
                    assert!(
                        (a - b).abs() <= 8.0 * f64::EPSILON * b.abs(),
                        "{a:e} {b:e} after {time} s of {step} s"
                    );
                }
            }
        }
    }

    #[test]
    fn long_steps_have_no_polynomials() {
        assert!(Short::new(&Oscillator::new(0.0, 1e4), 0.01).is_none());
    }
}
