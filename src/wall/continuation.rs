//! A branch continued beyond its ends, for an importer's solver that goes there before the event.

use super::branch::Branch;
use super::damping::BranchDamping;

impl Branch {
    /// C/`m_eff` \[1/s\] and its slope \[1/(m s)\] on this branch, continued smoothly beyond its ends.
    ///
    /// Between the ends this is [`damping_at`](Self::damping_at). Towards u = 0, where F/u grows without
    /// bound, it keeps its slope and curvature at the end and stays bounded. Beyond u₃ a
    /// stiffness-proportional coefficient changes its sign, and that of a constant ratio is 0.
    pub fn continued_damping(&self, displacement: f64) -> (f64, f64) {
        match self.damping {
            BranchDamping::Constant(c) => return (c, 0.0),
            BranchDamping::SecantRatio(_) | BranchDamping::SecantStiffness(_) => {}
        }
        // such a branch lies on one side of u = 0, which it does not reach
        let inner = if self.lower >= 0.0 { self.lower } else { self.upper };
        let inwards = (inner - displacement) / inner;
        if inwards > 0.0 {
            return self.towards_zero(inner, inwards);
        }
        (self.damping_at(displacement), self.damping_slope(displacement))
    }

    /// Beyond the end `inner` by the fraction s = `inwards` of it: c₀ + a t + b t² with t = s/(1 + s), which
    /// has the first and second derivative of C at s = 0.
    fn towards_zero(&self, inner: f64, inwards: f64) -> (f64, f64) {
        let [c, slope, curvature] = self.damping.derivatives(&self.own, inner);
        // with u = inner (1 − s); t = s − s² + …, hence ½ d²C/ds² = b − a
        let a = -inner * slope;
        let b = 0.5 * curvature * inner * inner + a;
        let t = inwards / (1.0 + inwards);
        let dt_du = -1.0 / (inner * (1.0 + inwards) * (1.0 + inwards));
        (c + t * (a + b * t), (a + 2.0 * b * t) * dt_du)
    }
}
