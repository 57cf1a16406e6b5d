//! A branch continued beyond its ends, for an importer's solver that goes there before the event.

use super::branch::Branch;
use super::damping::BranchDamping;

impl Branch {
    /// C/`m_eff` \[1/s\] and its slope \[1/(m s)\] on this branch, continued smoothly beyond its ends.
    ///
    /// Between the ends it is [`damping_at`](Self::damping_at). Towards u = 0, where F/u grows without bound,
    /// it keeps its slope and curvature at the end and stays bounded. Beyond u₃ a stiffness-proportional
    /// coefficient changes its sign, and that of a constant ratio is 0.
    pub fn continued_damping(&self, displacement: f64) -> (f64, f64) {
        if let BranchDamping::Constant(c) = self.damping {
            return (c, 0.0);
        }
        // a branch with secant damping lies on one side of u = 0
        let (inner, outer) =
            if self.lower >= 0.0 { (self.lower, self.upper) } else { (self.upper, self.lower) };
        let inwards = (inner - displacement) / inner;
        if inwards > 0.0 {
            return self.towards_zero(inner, inwards);
        }
        if let (BranchDamping::SecantStiffness(factor), true) =
            (self.damping, displacement.abs() > outer.abs())
        {
            let omega_squared = self.own.at(displacement) / displacement;
            return (factor * omega_squared, factor * (self.own.slope - omega_squared) / displacement);
        }
        (self.damping_at(displacement), self.damping_slope(displacement))
    }

    /// Beyond the end `inner` by the fraction s = `inwards` of it: c₀ + a t + b t² with t = s/(1 + s), which
    /// has the first and second derivative of C at s = 0.
    fn towards_zero(&self, inner: f64, inwards: f64) -> (f64, f64) {
        let w = self.own.at(inner) / inner;
        // with u = inner (1 − s): w = k + const/u, so that dw/ds = w − k and d²w/ds² = 2 (w − k)
        let (first, second) = (w - self.own.slope, 2.0 * (w - self.own.slope));
        let c = self.damping.coefficient(w);
        let by_w = self.damping.sensitivity(w);
        let curvature = match self.damping {
            // d²√w/dw² = −(d√w/dw)/(2w)
            BranchDamping::SecantRatio(_) if w > 0.0 => -by_w / (2.0 * w),
            _ => 0.0,
        };
        let slope = by_w * first;
        let a = slope;
        // t = s − s² + …, hence ½ d²C/ds² = b − a
        let b = 0.5 * (curvature * first * first + by_w * second) + slope;
        let t = inwards / (1.0 + inwards);
        let dt_du = -1.0 / (inner * (1.0 + inwards) * (1.0 + inwards));
        (c + t * (a + b * t), (a + 2.0 * b * t) * dt_du)
    }
}
