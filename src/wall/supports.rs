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
