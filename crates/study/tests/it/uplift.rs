//! A rigid block under pulses up to its first impact, in closed form.

use study::spectrum::PulseForm;

/// The root of a rising function by bisection.
pub(crate) fn root(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    assert!(function(low) < 0.0 && function(high) > 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { high = middle } else { low = middle }
    }
    high
}

/// A rigid block under a_p sin ω_p t up to its first impact, in closed form.
///
/// With x = |u|/u_ins, η = a_p/a₀, β = ω_p/p, time in 1/p, and uplift at sin βt₀ = 1/η, it obeys ẍ = x − 1 +
/// η sin βt. The modes z = x − 1 + ẋ and w = x − 1 − ẋ obey ż = z + η sin βt and ẇ = −w − η sin βt, both from
/// −1 at t₀, so that
/// ```text
/// z = B (sin βt + β cos βt) + C e^{t−t₀},   w = B (sin βt − β cos βt) + D e^{t₀−t},   B = −η/(1 + β²)
/// ```
pub(crate) struct Uplift {
    beta: f64,
    pub(crate) start: f64,
    scale: f64,
    modes: [f64; 2],
}

impl Uplift {
    pub(crate) fn new(eta: f64, beta: f64) -> Self {
        let (scale, phase) = (-eta / (1.0 + beta * beta), (1.0 / eta).asin());
        let modes = [1.0, -1.0].map(|sign| -1.0 - scale * (phase.sin() + sign * beta * phase.cos()));
        Self { beta, start: phase / beta, scale, modes }
    }

    /// z at a time.
    pub(crate) fn growing(&self, time: f64) -> f64 {
        let (sin, cos) = (self.beta * time).sin_cos();
        self.scale * (sin + self.beta * cos) + self.modes[0] * (time - self.start).exp()
    }

    /// x at a time.
    pub(crate) fn reach(&self, time: f64) -> f64 {
        let (sin, cos) = (self.beta * time).sin_cos();
        let falling = self.scale * (sin - self.beta * cos) + self.modes[1] * (self.start - time).exp();
        1.0 + 0.5 * (self.growing(time) + falling)
    }
}

/// a_p/a₀ from which on rectangles and triangles of duration d/p overturn the block without an impact, where
/// ∫ e^−s f(τ_u + s) ds > 1 (docs/model.md). For a triangle that rises first, with uplift at τ_u = d/(2η),
/// the integral by parts is 1 + (2η/d) (1 − 2 e^−(d/2 − τ_u) + e^−(d − τ_u)).
pub(crate) fn straight(form: PulseForm, d: f64) -> f64 {
    match form {
        PulseForm::Rectangle => 1.0 / (1.0 - (-d).exp()),
        PulseForm::FallingTriangle => 1.0 / (1.0 - (1.0 - (-d).exp()) / d),
        PulseForm::Triangle => root(1.0 + 1e-12, 1e3, |eta| {
            let uplift = d / (2.0 * eta);
            1.0 - 2.0 * (uplift - d / 2.0).exp() + (uplift - d).exp()
        }),
        curved => panic!("{curved:?} is not straight"),
    }
}
