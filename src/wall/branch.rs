//! Branches of the restoring force, and the corners between them.

use super::damping::BranchDamping;
use super::force_law::Line;
use super::mechanism::Body;
use super::tie::TieAction;

/// The couple G of a strip wall without that of a drift, a straight line: G = `at_zero` + `slope` x. On a
/// branch x is u \[m\], at rest the forcing p \[m/s²\]. 0 for a parapet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Couple {
    /// G at x = 0 \[N\].
    pub at_zero: f64,
    /// dG/dx \[N/m\], or at rest \[kg\].
    pub slope: f64,
}

impl Couple {
    /// Returns the couple where the wall's own force \[N\] is on a line on the side of `sign`:
    /// [`M_A` − W u/2]/h. The toe is at s = (F + k₀ u)/F₀ of its way between the edges.
    pub(super) fn on(own: &Line, body: &Body, sign: f64) -> Self {
        if body.hinge().is_none() {
            return Self::default();
        }
        let at = |force: f64| body.contact_couple(force, sign);
        let at_zero = at(own.at(0.0));
        let slope = at(own.slope + body.geometric_stiffness) - at(0.0) - body.contact.by_displacement;
        Self { at_zero, slope }
    }

    /// Returns G \[N\].
    pub fn at(&self, x: f64) -> f64 {
        self.at_zero + self.slope * x
    }
}

/// A straight piece of the restoring force per unit effective mass, with its damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Displacements the branch spans \[m\].
    pub lower: f64,
    /// See `lower`.
    pub upper: f64,
    /// Displacement of the line's anchor \[m\].
    pub anchor: f64,
    /// F/`m_eff` at the anchor \[m/s²\].
    pub force: f64,
    /// Slope of F/`m_eff` \[1/s²\].
    pub stiffness: f64,
    /// The force of the wall alone over `m_eff`, without ties: secant damping follows from it.
    pub own: Line,
    /// The most that a tie does.
    pub tie: TieAction,
    /// The couple of a strip wall.
    pub couple: Couple,
    /// Damping on the branch.
    pub damping: BranchDamping,
}

impl Branch {
    /// F/`m_eff` \[m/s²\].
    pub fn restoring(&self, displacement: f64) -> f64 {
        self.force + self.stiffness * (displacement - self.anchor)
    }

    /// Returns whether the wall is elastic there.
    pub fn is_elastic(&self) -> bool {
        self.own.is_elastic()
    }

    /// 1 for u > 0, −1 for u < 0.
    pub fn side(&self) -> f64 {
        if self.upper > 0.0 { 1.0 } else { -1.0 }
    }

    /// Returns the side on which a tie yields; `None` where none does.
    pub fn yielding_side(&self) -> Option<f64> {
        (self.tie == TieAction::Yields).then(|| self.side())
    }

    /// C/`m_eff` \[1/s\].
    pub fn damping_at(&self, displacement: f64) -> f64 {
        self.damping.derivatives(&self.own, displacement)[0]
    }

    /// d(C/`m_eff`)/du \[1/(m s)\].
    pub fn damping_slope(&self, displacement: f64) -> f64 {
        self.damping.derivatives(&self.own, displacement)[1]
    }

    /// Bounds C/`m_eff` \[1/s\] and the sizes of its first two derivatives between two displacements on the
    /// branch \[m\].
    pub(crate) fn damping_bounds(&self, range: [f64; 2]) -> [f64; 3] {
        self.damping.bounds(&self.own, range)
    }

    /// Relative acceleration, ü = p − c u̇ − F/`m_eff`, under the forcing p \[m/s²\].
    pub fn acceleration(&self, displacement: f64, velocity: f64, forcing: f64) -> f64 {
        forcing - self.damping_at(displacement) * velocity - self.restoring(displacement)
    }
}

/// What happens where two branches meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "independent marks of one place")]
pub struct Corner {
    /// Displacement of the corner \[m\].
    pub displacement: f64,
    /// Passing it is an impact, or a jump of the rigid force.
    pub passage: bool,
    /// Transverse walls stop the wall there and turn it back.
    pub stop: bool,
    /// Beyond it the wall has overturned.
    pub overturning: bool,
    /// Beyond it the wall has left its supports.
    pub departure: bool,
    /// Here a tie of this side breaks.
    pub fracture: bool,
    /// Here the wall lies down.
    pub landing: bool,
}

impl Corner {
    /// Returns whether anything but a change of branch happens here.
    pub fn is_marked(&self) -> bool {
        self.passage || self.overturning || self.departure || self.fracture || self.landing
    }
}

/// A branch continued beyond its ends, for an importer's solver that goes there before the event.
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
