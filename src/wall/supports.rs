//! Moving supports: the forces they exert on the wall, and the couple of a wall at rest.

use super::branch::Couple;
use super::equation::Wall;
use super::mechanism::{Body, Contact, MassShares};

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
    /// `a_eff` = `w_b` `a_b` + `w_t` `a_t`: one body knows its base only, and no drift.
    pub fn forcing(&self, support: Support) -> f64 {
        let [w_b, w_t] = self.support_weights;
        if self.is_strip() {
            -self.participation * (w_b * support.bottom + w_t * support.top)
                + self.drift_weight * support.drift / (self.height * self.effective_mass)
        } else {
            -self.participation * support.bottom
        }
    }

    /// Forces the supports exert on the wall \[N\]: `acceleration` is ü \[m/s²\], `couple` the couple G of a
    /// strip without that of the drift \[N\] ([`Couple`]).
    pub fn reactions(&self, support: Support, acceleration: f64, couple: f64) -> Ends {
        let Ends { bottom, top } = self.reaction_changes(support, acceleration, couple);
        Ends { bottom: bottom - self.contact.thrust, top }
    }

    /// Changes of these forces \[N\] under changes of the accelerations and the couple; thrusts stay.
    ///
    /// Integrals over time in place of all these give the impulses of the supports without those of the
    /// thrusts \[N s\], jumps of u̇ at impacts included.
    pub fn reaction_changes(&self, support: Support, acceleration: f64, couple: f64) -> Ends {
        let Contact { mass, bottom, top, by_drift, .. } = self.contact;
        let felt = |by: MassShares| {
            mass * (by.bottom * support.bottom + by.top * support.top + by.wall * acceleration)
        };
        if self.is_strip() {
            let couple = couple - by_drift * support.drift;
            Ends { bottom: felt(bottom) - couple, top: felt(top) + couple }
        } else {
            Ends { bottom: mass * (support.bottom + bottom.wall * acceleration), top: 0.0 }
        }
    }
}

impl Wall {
    /// Returns the couple of a wall at rest as a line in the forcing p, on the side of p. What transverse
    /// walls hold does not move the toe.
    pub fn couple_at_rest(&self, forcing: f64) -> Couple {
        let body = self.body();
        let at = |force: f64| body.contact_couple(force, forcing);
        let is_held = self.free_side().is_some_and(|side| side * forcing < 0.0);
        let slope = if is_held { 0.0 } else { at(body.effective_mass) - at(0.0) };
        Couple { at_zero: at(0.0), slope }
    }

    /// Returns whether the couple at rest bends where p changes its sign.
    pub fn bends_at_rest(&self) -> bool {
        self.body().has_bent_couple() || self.free_side().is_some()
    }

    /// Returns ∫G dt of a rest over a length \[s\] in which p goes from one value to another \[N s\].
    pub fn couple_of_rest(&self, [from, to]: [f64; 2], length: f64) -> f64 {
        let mean = |from: f64, to: f64| {
            let middle = 0.5 * (from + to);
            self.couple_at_rest(middle).at(middle)
        };
        if from * to >= 0.0 {
            return length * mean(from, to);
        }
        let share = from / (from - to);
        length * (share * mean(from, 0.0) + (1.0 - share) * mean(0.0, to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::Mechanism;
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
        let Ends { bottom, top } = body.reactions(MOVED, 0.3, 9.0);
        near(bottom, body.mass * 2.3);
        assert_eq!(top, 0.0);
        assert!(wall.branches().iter().all(|branch| branch.couple == Couple::default()));
    }

    /// A strip of 3 m with its hinge at 1.8 m has `w_b` = 7/15, `w_t` = 8/15, λ = 3/2 and `m_eff` = 2m/3.
    /// A drift has the couple −(W/2 + O) d/h.
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
        for couple in [0.0, 900.0] {
            let Ends { bottom, top } = body.reactions(MOVED, 0.3, couple);
            let couple = couple - (weight / 2.0 + 5e3) * 0.01 / 3.0;
            near(bottom, m * (0.5 + 0.07) - couple);
            near(top, m * 0.08 + couple);
        }
    }
}
