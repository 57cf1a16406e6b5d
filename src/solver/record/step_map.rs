//! Steps of one length on one branch.

use super::super::secant::SecantBranch;
use super::short::Short;
use crate::wall::Branch;
use oscillator::Oscillator;

/// c V over P + f̂, which fixes the largest speed V of a plain step: walls stay far below it, as they do
/// below the terminal speed (docs/record-path.md, §2).
pub(super) const DAMPING_SHARE: f64 = 0.25;

/// Returns γ(L) = 1/(1 − c L/2 − |k| L²/8), by which P + c V + f̂ is multiplied to bound |ü| over a length L;
/// infinite where L is too long for the bound (docs/record-path.md, §2).
pub(super) fn growth(oscillator: &Oscillator, length: f64) -> f64 {
    let (c, k) = (oscillator.damping(), oscillator.stiffness());
    let slack = 1.0 - 0.5 * c * length - 0.125 * k.abs() * length * length;
    if slack > 0.0 { 1.0 / slack } else { f64::INFINITY }
}

/// Steps on one branch, by the forcing less the branch's force at u = 0, q = p − f(0): the change of u and of
/// u̇ for each of u₀, u̇₀, q₀, q₁ and q₂.
#[derive(Clone, Copy, Debug)]
pub(super) struct Affine {
    pub(super) terms: [[f64; 2]; 5],
}

impl Affine {
    /// Makes the map of one step h: q₂ does not count.
    pub(super) fn single(oscillator: &Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        let green = oscillator.green(step);
        let (g, h, j) = (green.g, green.h, green.j / step);
        let (of_u, of_v) = ([-k * h, -k * g], [g, -(k * h + c * g)]);
        Self { terms: [of_u, of_v, [h - j, g - h / step], [j, h / step], [0.0; 2]] }
    }

    /// Makes the map of two steps h: the closed form over 2h, and the forcing of both, each as in `one`.
    fn double(one: &Self, oscillator: &Oscillator, step: f64) -> Self {
        let [one_u, one_v, first, second, _] = one.terms;
        let [two_u, two_v, ..] = Self::single(oscillator, 2.0 * step).terms;
        // what the first step changed, moved on by the second
        let onward = |[u, v]: [f64; 2], part: usize| [u, v][part] + (one_u[part] * u + one_v[part] * v);
        let parts = [0, 1];
        Self {
            terms: [
                two_u,
                two_v,
                parts.map(|part| onward(first, part)),
                parts.map(|part| onward(second, part) + first[part]),
                second,
            ],
        }
    }

    /// Returns u and u̇ after one step.
    #[inline(always)]
    pub(super) fn one_step(&self, [u, v]: [f64; 2], q: [f64; 2]) -> [f64; 2] {
        let part = |part: usize| {
            let c = |term: usize| self.terms[term][part];
            // the products with the state last: they are what the next step waits for
            [u, v][part] + ((c(2) * q[0] + c(3) * q[1]) + (c(0) * u + c(1) * v))
        };
        [part(0), part(1)]
    }

    /// Returns u and u̇ after two steps.
    #[inline(always)]
    pub(super) fn two_steps(&self, [u, v]: [f64; 2], q: [f64; 3]) -> [f64; 2] {
        let part = |part: usize| {
            let c = |term: usize| self.terms[term][part];
            [u, v][part] + (((c(2) * q[0] + c(3) * q[1]) + c(4) * q[2]) + (c(0) * u + c(1) * v))
        };
        [part(0), part(1)]
    }
}

/// What steps on one branch need.
#[derive(Clone, Debug)]
pub(super) struct StepMap {
    pub(super) way: Way,
    /// Corners of the branch \[m\].
    pub(super) corners: [f64; 2],
    /// A over P + c V + f̂, for one step and for two at once; on a curved branch that of one (§7).
    pub(super) growth: [f64; 2],
    /// V over P + f̂ \[s\].
    pub(super) speed_share: f64,
    /// The largest c of the branch \[1/s\].
    pub(super) damping: f64,
    /// f(0) of the branch's line \[m/s²\], and its stiffness \[1/s²\].
    pub(super) force_at_zero: f64,
    pub(super) stiffness: f64,
}

/// How steps on a branch are made.
#[derive(Clone, Debug)]
pub(super) enum Way {
    /// As affine maps: damping is constant.
    Affine(Box<AffineSteps>),
    /// As Taylor series: damping follows the secant stiffness.
    Curved(SecantBranch),
}

/// Steps on a branch with constant damping.
#[derive(Clone, Debug)]
pub(super) struct AffineSteps {
    pub(super) single: Affine,
    pub(super) double: Affine,
    pub(super) oscillator: Oscillator,
    pub(super) short: Option<Short>,
}

impl AffineSteps {
    pub(super) fn new(oscillator: Oscillator, step: f64) -> Self {
        let single = Affine::single(&oscillator, step);
        let double = Affine::double(&single, &oscillator, step);
        Self { single, double, oscillator, short: Short::new(&oscillator, step) }
    }
}

impl StepMap {
    /// Prepares steps on a branch with constant damping; `None` where its modes part during two of them.
    pub(super) fn affine(branch: &Branch, oscillator: Oscillator, step: f64) -> Option<Self> {
        let growth = [growth(&oscillator, step), growth(&oscillator, 2.0 * step)];
        let way = Way::Affine(Box::new(AffineSteps::new(oscillator, step)));
        (!oscillator.is_spread(2.0 * step)).then(|| Self::on(branch, way, oscillator.damping(), growth))
    }

    /// Prepares steps on a branch with secant damping; `None` where they are longer than 1/c.
    pub(super) fn curved(branch: &Branch, secant: SecantBranch, step: f64) -> Option<Self> {
        // c is monotone in u
        let damping = branch.damping_at(branch.lower).max(branch.damping_at(branch.upper));
        let slack = 1.0 - damping * step;
        (slack > 0.0).then(|| Self::on(branch, Way::Curved(secant), damping, [1.0 / slack; 2]))
    }

    fn on(branch: &Branch, way: Way, damping: f64, growth: [f64; 2]) -> Self {
        Self {
            way,
            corners: [branch.lower, branch.upper],
            growth,
            speed_share: DAMPING_SHARE * (1.0 / damping),
            damping,
            force_at_zero: branch.restoring(0.0),
            stiffness: branch.stiffness,
        }
    }

    /// Returns the affine maps of a branch that has them.
    pub(super) fn affine_steps(&self) -> Option<&AffineSteps> {
        if let Way::Affine(steps) = &self.way { Some(steps) } else { None }
    }

    /// Returns the law of a branch with secant damping.
    pub(super) fn secant(&self) -> Option<&SecantBranch> {
        if let Way::Curved(secant) = &self.way { Some(secant) } else { None }
    }

    /// Returns c V over P + f̂: none without damping.
    pub(super) fn damping_share(&self) -> f64 {
        if self.damping > 0.0 { DAMPING_SHARE } else { 0.0 }
    }

    /// Returns f at u on the branch's line \[m/s²\].
    pub(super) fn force(&self, displacement: f64) -> f64 {
        self.force_at_zero + self.stiffness * displacement
    }
}
