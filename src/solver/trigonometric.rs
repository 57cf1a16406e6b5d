//! Taylor series of a wall in full rotations, of its [`Turn`] to one side.
//!
//! With the angular velocities zᵢ = ṡ/cᵢ the tangents and the reciprocals rᵢ = 1/cᵢ obey ṫ = (1 + t²) z and ṙ
//! = t r z, so that products of series give every coefficient, and no sine is evaluated:
//!
//! ```text
//! zₙ = Σ rᵢ ṡₙ₋ᵢ    (n+1) tₙ₊₁ = Σ (1 + t²)ᵢ zₙ₋ᵢ    (n+1) rₙ₊₁ = Σ (t r)ᵢ zₙ₋ᵢ
//! μ₀ üₙ = (p q)ₙ − fₙ − ½ Σ μ̇ᵢ u̇ₙ₋ᵢ − Σ_{i≥1} μᵢ üₙ₋ᵢ
//! ```

use crate::wall::{FullRotations, Turn};

use super::adaptive::Recurrence;
use oscillator::{HIGHEST_ORDER, KinematicState};

/// Coefficients of one quantity.
type Terms = [f64; HIGHEST_ORDER + 1];

/// Work arrays of the recurrence, for the side on which u > 0.
pub(super) struct Rotation<'a> {
    wall: &'a Turn,
    /// p₀ and p₁.
    forcing: [f64; 2],
    displacement: Terms,
    acceleration: Terms,
    bodies: [Turning; 2],
    /// t₁ + t₂/2.
    joint: Terms,
    /// μ.
    mass: Terms,
}

/// Series of one body.
struct Turning {
    /// t.
    tangent: Terms,
    /// 1 + t².
    secant_squared: Terms,
    /// r.
    reciprocal: Terms,
    /// t r.
    ratio: Terms,
    /// z.
    rate: Terms,
}

/// Σ aᵢ bₙ₋ᵢ
fn product(a: &Terms, b: &Terms, n: usize) -> f64 {
    (0..=n).map(|i| a[i] * b[n - i]).sum()
}

impl Turning {
    fn new(tangent: f64, s: f64, diagonal: f64) -> Self {
        let zero = [0.0; HIGHEST_ORDER + 1];
        let mut body =
            Self { tangent: zero, secant_squared: zero, reciprocal: zero, ratio: zero, rate: zero };
        body.tangent[0] = tangent;
        body.secant_squared[0] = 1.0 + tangent * tangent;
        body.reciprocal[0] = 1.0 / (diagonal - s * s).sqrt();
        body
    }

    /// Extends t, 1 + t² and r from the terms up to n to those at n + 1.
    fn extend(&mut self, speed: &Terms, n: usize) {
        let next = (n + 1) as f64;
        self.rate[n] = product(&self.reciprocal, speed, n);
        self.ratio[n] = product(&self.tangent, &self.reciprocal, n);
        self.tangent[n + 1] = product(&self.secant_squared, &self.rate, n) / next;
        self.reciprocal[n + 1] = product(&self.ratio, &self.rate, n) / next;
        self.secant_squared[n + 1] = product(&self.tangent, &self.tangent, n + 1);
    }
}

impl<'a> Rotation<'a> {
    /// The motion from `start` on the side of `sign` under the forcing p₀ + p₁ t.
    pub(super) fn new(wall: &'a FullRotations, sign: f64, start: KinematicState, forcing: [f64; 2]) -> Self {
        let (wall, zero) = (wall.side(sign), [0.0; HIGHEST_ORDER + 1]);
        let s = wall.place(sign * start.displacement);
        let t = wall.tangents(s);
        let body = |index: usize| Turning::new(t[index], s, wall.diagonals[index]);
        let mut rotation = Self {
            wall,
            forcing: forcing.map(|p| sign * p),
            displacement: zero,
            acceleration: zero,
            bodies: [body(0), body(1)],
            joint: zero,
            mass: zero,
        };
        rotation.displacement[0] = sign * start.displacement;
        rotation.displacement[1] = sign * start.velocity;
        rotation.extend_mass(0);
        rotation
    }

    /// μₙ, once the tangents are known.
    fn extend_mass(&mut self, n: usize) {
        let [m1, m2] = self.wall.masses;
        let [lower, upper] = &self.bodies;
        self.mass[n] = m1 * lower.secant_squared[n];
        if self.wall.bodies == 2 {
            // 1 + 3 q² + t₂²/4 = 3/4 + 3 q² + (1 + t₂²)/4
            self.joint[n] = lower.tangent[n] + 0.5 * upper.tangent[n];
            let constant = if n == 0 { 0.75 } else { 0.0 };
            let square = product(&self.joint, &self.joint, n);
            self.mass[n] += m2 * (constant + 3.0 * square + 0.25 * upper.secant_squared[n]);
        }
    }

    /// (p q)ₙ, with q = 1 + ρ (t₁ − t₁(0)).
    fn push(&self, n: usize) -> f64 {
        let forcing = |n: usize| self.forcing.get(n).copied().unwrap_or(0.0);
        let (&Turn { drag, .. }, tangent) = (self.wall, &self.bodies[0].tangent);
        if drag == 0.0 {
            return forcing(n);
        }
        let share = |n: usize| if n == 0 { self.wall.share(tangent[0]) } else { drag * tangent[n] };
        (0..=n.min(1)).map(|i| forcing(i) * share(n - i)).sum()
    }

    /// fₙ
    fn force(&self, n: usize) -> f64 {
        let [lower, upper] = &self.bodies;
        let tangents = [lower.tangent[n], upper.tangent[n]];
        if n == 0 {
            // the sum that also decides whether the wall rests
            return self.wall.force(tangents);
        }
        let [_, g1, g2] = self.wall.forces;
        -g1 * tangents[0] - g2 * tangents[1]
    }
}

impl Recurrence for Rotation<'_> {
    fn displacement(&mut self) -> &mut Terms {
        &mut self.displacement
    }

    fn acceleration(&mut self, n: usize) -> f64 {
        let mut velocity = [0.0; HIGHEST_ORDER + 1];
        let mut speed = velocity;
        for i in 0..=n {
            velocity[i] = (i + 1) as f64 * self.displacement[i + 1];
            speed[i] = self.wall.lever * velocity[i];
        }
        for body in &mut self.bodies[..self.wall.bodies] {
            body.extend(&speed, n);
        }
        self.extend_mass(n + 1);
        let mut sum = self.push(n) - self.force(n);
        for i in 0..=n {
            sum -= 0.5 * (i + 1) as f64 * self.mass[i + 1] * velocity[n - i];
        }
        for i in 1..=n {
            sum -= self.mass[i] * self.acceleration[n - i];
        }
        self.acceleration[n] = sum / self.mass[0];
        self.acceleration[n]
    }
}
