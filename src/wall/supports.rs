//! Moving supports: the forces they exert on the wall, and the impulses of a step.

use crate::choices::Mechanism;

use super::mechanism::Body;

/// Motion of the supports at one instant: absolute accelerations \[m/s²\] and the drift `x_top` − `x_bottom`
/// \[m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// Absolute acceleration of the bottom support \[m/s²\].
    pub bottom: f64,
    /// Absolute acceleration of the top support \[m/s²\]; a parapet has none.
    pub top: f64,
    /// Relative displacement of the supports, `x_top` − `x_bottom` \[m\].
    pub drift: f64,
}

impl Support {
    /// Both supports move with one acceleration \[m/s²\], without drift.
    pub fn rigid(acceleration: f64) -> Self {
        Self { bottom: acceleration, top: acceleration, drift: 0.0 }
    }

    /// Linear interpolation towards `other`; `fraction` from 0 to 1.
    pub fn towards(self, other: Self, fraction: f64) -> Self {
        self.with(other, |a, b| a + (b - a) * fraction)
    }

    /// Combines each component with that of `other`.
    pub(crate) fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            bottom: f(self.bottom, other.bottom),
            top: f(self.top, other.top),
            drift: f(self.drift, other.drift),
        }
    }
}

/// A quantity at the bottom and at the top support.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ends {
    /// At the bottom support.
    pub bottom: f64,
    /// At the top support; 0 for a parapet.
    pub top: f64,
}

impl Body {
    /// Effective forcing per unit effective mass, −λ `a_eff` + W d/(h `m_eff`) \[m/s²\].
    ///
    /// `a_eff` = `w_b` `a_b` + `w_t` `a_t`: a parapet knows its base only, and no drift.
    pub fn forcing(&self, support: Support) -> f64 {
        let [w_b, w_t] = self.support_weights;
        match self.mechanism {
            Mechanism::Parapet => -self.participation * support.bottom,
            Mechanism::VerticalSpanning => {
                -self.participation * (w_b * support.bottom + w_t * support.top)
                    + self.weight * support.drift / (self.height * self.effective_mass)
            }
        }
    }

    /// Forces the supports exert on the wall \[N\]; `acceleration` is ü \[m/s²\].
    ///
    /// `drift` says whether a drift has been given: then the couple G = −W u/(2h) − (W/2 + O) d/h acts too.
    pub fn reactions(&self, support: Support, acceleration: f64, displacement: f64, drift: bool) -> Ends {
        let couple = if drift { self.couple(displacement, support.drift) } else { 0.0 };
        self.exchange([support.bottom, support.top], acceleration, couple)
    }

    /// Impulses of the supports on the wall \[N s\], from the changes of velocity, jumps at impacts included.
    /// `velocity_changes` are those of the bottom and top support \[m/s\], `couple_impulse` is ∫G dt.
    pub fn impulses(&self, velocity_changes: [f64; 2], velocity_change: f64, couple_impulse: f64) -> Ends {
        self.exchange(velocity_changes, velocity_change, couple_impulse)
    }

    /// G = −W u/(2h) − (W/2 + O) d/h \[N\]; with time integrals of u and d it gives ∫G dt.
    pub(crate) fn couple(&self, displacement: f64, drift: f64) -> f64 {
        match self.mechanism {
            Mechanism::Parapet => 0.0,
            Mechanism::VerticalSpanning => {
                -(self.weight * displacement / 2.0 + (self.weight / 2.0 + self.overburden) * drift)
                    / self.height
            }
        }
    }

    /// R or ∫R dt, from accelerations or from velocity changes.
    fn exchange(&self, [bottom, top]: [f64; 2], relative: f64, couple: f64) -> Ends {
        let m = self.mass;
        match self.mechanism {
            // R_b = m (a_b + ü)
            Mechanism::Parapet => Ends { bottom: m * (bottom + relative), top: 0.0 },
            // R_b = m (2a_b + a_t)/6 + (m w_b/2) ü − G,  R_t = m (a_b + 2a_t)/6 + (m w_t/2) ü + G
            Mechanism::VerticalSpanning => {
                let [w_b, w_t] = self.support_weights;
                Ends {
                    bottom: m * (2.0 * bottom + top) / 6.0 + m * w_b / 2.0 * relative - couple,
                    top: m * (bottom + 2.0 * top) / 6.0 + m * w_t / 2.0 * relative + couple,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::{Parameters, Wall};

    const MOVED: Support = Support { bottom: 2.0, top: -1.0, drift: 0.01 };

    /// Equal within a few dozen roundings.
    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} for {expected}");
    }

    /// A parapet stands on one support.
    #[test]
    fn a_parapet_moves_with_its_base() {
        let wall = Wall::new(&Parameters::default()).unwrap();
        let body = wall.body();
        assert_eq!(body.hinge(), None);
        near(body.forcing(MOVED), -0.75 * 2.0);
        for drift in [false, true] {
            let Ends { bottom, top } = body.reactions(MOVED, 0.3, 0.02, drift);
            near(bottom, body.mass * 2.3);
            assert_eq!(top, 0.0);
        }
        near(body.impulses([2.0, -1.0], 0.3, 9.0).bottom, body.mass * 2.3);
    }

    /// A strip of 3 m with its hinge at 1.8 m has `w_b` = 7/15, `w_t` = 8/15, λ = 3/2 and `m_eff` = 2m/3.
    /// With a drift G = −(W u/2 + (W/2 + O) d)/h acts.
    #[test]
    fn a_strip_moves_with_both_supports() {
        let mechanism = Mechanism::VerticalSpanning;
        let (height, hinge_ratio, overburden, u_start) = (3.0, 0.6, 5e3, 0.0);
        let parameters = Parameters::default();
        let strip = Parameters { mechanism, height, hinge_ratio, overburden, u_start, ..parameters };
        let wall = Wall::new(&strip).unwrap();
        let (body, gravity) = (wall.body(), strip.gravity);
        let (m, weight) = (body.mass, body.mass * gravity);
        near(body.hinge().unwrap(), 1.8);
        near(body.forcing(MOVED), -1.5 * (14.0 - 8.0) / 15.0 + 1.5 * gravity * 0.01 / 3.0);
        for drift in [false, true] {
            let couple = if drift { -(weight * 0.01 + (weight / 2.0 + 5e3) * 0.01) / 3.0 } else { 0.0 };
            let Ends { bottom, top } = body.reactions(MOVED, 0.3, 0.02, drift);
            near(bottom, m * (0.5 + 0.07) - couple);
            near(top, m * 0.08 + couple);
        }
        let Ends { bottom, top } = body.impulses([2.0, -1.0], 0.3, 9.0);
        near(bottom, m * 0.57 - 9.0);
        near(top, m * 0.08 + 9.0);
    }
}
