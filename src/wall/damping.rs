//! Viscous damping: the coefficient C(u) of Eq. (12), per unit effective mass.

use crate::choices::DampingModel;

use super::equivalence;
use super::error::{Choice, ParameterError};
use super::force_law::{Line, RestoringForce};
use super::given::given;
use super::mechanism::Body;
use super::parameters::Parameters;
use super::ratio::Ratio;

impl DampingModel {
    /// Returns the model's ratio; none without damping.
    pub fn ratio(self) -> Option<Ratio> {
        match self {
            Self::None => None,
            Self::FreeStandingBlock => Some(Ratio::CBar),
            Self::ConstantCoefficient | Self::ConstantRatio | Self::StiffnessProportional => Some(Ratio::Xi),
        }
    }

    /// Returns the name of the parameter with the model's ratio: `xi`, `c_bar`, or none without damping.
    pub fn ratio_name(self) -> Option<&'static str> {
        self.ratio().map(Ratio::name)
    }

    /// Returns whether the model refers to the elastic branch. A wall must then have one.
    pub fn needs_elastic_branch(self) -> bool {
        match self {
            Self::None | Self::FreeStandingBlock => false,
            Self::ConstantCoefficient | Self::ConstantRatio | Self::StiffnessProportional => true,
        }
    }

    /// Returns the ratio \[-\] that a₁ and e predict, Eqs. (20)–(23): ξ, ξ₁ or c̄; 0 without damping.
    pub fn predicted_ratio(self, a1: f64, restitution: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::ConstantCoefficient => equivalence::constant_coefficient(a1, restitution),
            Self::FreeStandingBlock => equivalence::free_standing_block(restitution),
            Self::ConstantRatio => equivalence::constant_ratio(a1, restitution),
            Self::StiffnessProportional => equivalence::stiffness_proportional(a1, restitution),
        }
    }
}

/// The viscous damping that is asked for: a model with its ratio.
///
/// ```
/// use rocking_wall::{variables::DampingModel, wall::{Damping, Parameters, Wall}};
///
/// let mut parameters = Parameters::default();
/// parameters.set_damping(Damping::given(DampingModel::ConstantCoefficient, 0.05));
/// assert_eq!(Wall::new(&parameters)?.damping_ratio(), 0.05);
/// # Ok::<(), rocking_wall::wall::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// The model.
    pub model: DampingModel,
    /// ξ, ξ₁ or c̄ \[-\]; computed from a₁ and e where `None`, Eqs. (20)–(23).
    pub ratio: Option<f64>,
}

impl Damping {
    /// No damping.
    pub const NONE: Self = Self::computed(DampingModel::None);

    /// A model with the ratio that a₁ and e predict.
    pub const fn computed(model: DampingModel) -> Self {
        Self { model, ratio: None }
    }

    /// A model with a given ratio \[-\].
    pub const fn given(model: DampingModel, ratio: f64) -> Self {
        Self { model, ratio: Some(ratio) }
    }

    /// Makes the damping of a model from its ratio as a parameter states it: 0 or more, or
    /// [`COMPUTED`](super::COMPUTED).
    ///
    /// # Errors
    /// [`ParameterError::NotGiven`] for another negative number.
    pub fn new(model: DampingModel, ratio: f64) -> Result<Self, ParameterError> {
        Ok(Self { model, ratio: given(model.ratio_name().unwrap_or_default(), ratio)? })
    }

    /// Checks the numbers of all ratios, and returns the damping that the parameters ask for.
    pub(super) fn of(parameters: &Parameters) -> Result<Self, ParameterError> {
        for ratio in Ratio::ALL {
            given(ratio.name(), parameters.ratio(ratio))?;
        }
        Ok(parameters.damping())
    }

    /// Returns the name of the parameter whose ratio is computed; `None` where it is given or there is none.
    pub fn computed_name(self) -> Option<&'static str> {
        self.model.ratio_name().filter(|_| self.ratio.is_none())
    }
}

impl Parameters {
    /// Returns the damping that the parameters ask for. A negative ratio counts as not given; [`Wall::new`]
    /// refuses negative ratios other than [`COMPUTED`](super::COMPUTED).
    ///
    /// [`Wall::new`]: super::Wall::new
    pub fn damping(&self) -> Damping {
        let model = self.damping_model;
        Damping { model, ratio: model.ratio().map(|ratio| self.ratio(ratio)).filter(|number| *number >= 0.0) }
    }

    /// Sets the damping model and its ratio. Ratios that the model does not use are set to
    /// [`COMPUTED`](super::COMPUTED).
    pub fn set_damping(&mut self, Damping { model, ratio }: Damping) {
        self.leave_out_ratios();
        self.damping_model = model;
        if let (Some(own), Some(number)) = (model.ratio(), ratio) {
            *self.ratio_mut(own) = number;
        }
    }
}

/// Distance before u₃, as a fraction of it, from which a constant damping ratio no longer acts. So no solver
/// reaches the zero of √(u₃ − u), where its slope is infinite.
///
/// The impulse left out is ∫C du = (4/3) ξ `m_eff` ω u₃ δ^{3/2} for this fraction δ, where ω² is the slope of
/// the softening branch over `m_eff`: about 1e-15 ξ of the scale ω u₃ of u̇.
pub(super) const RATIO_CUTOFF: f64 = 1e-10;

/// Damping per unit effective mass, c(u) = C(u)/`m_eff` \[1/s\], on one branch of the restoring force.
///
/// A wall moves by the series that any law has, `DampingSeries`; in records its branches are left to the
/// general search, which is right and slower. A law c(ω²) may have a fast series, a `Secant` of the solver.
/// c is monotone on each branch: the record path takes its bound from both ends. Where c divides by u, the
/// branch must not reach u = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BranchDamping {
    /// c is constant.
    Constant(f64),
    /// c = 2ξ ω(u), constant damping ratio on the secant frequency, Eqs. (8)–(9). Holds 2ξ.
    SecantRatio(f64),
    /// c = (2 ξ₁/ω₁) ω(u)², stiffness-proportional ratio, Eqs. (10)–(11). Holds 2 ξ₁/ω₁ \[s\].
    SecantStiffness(f64),
}

impl BranchDamping {
    /// Returns c \[1/s\] where it is constant.
    pub fn constant(self) -> Option<f64> {
        match self {
            Self::Constant(c) => Some(c),
            Self::SecantRatio(_) | Self::SecantStiffness(_) => None,
        }
    }

    /// Returns c \[1/s\], dc/du and d²c/du² at u \[m\], where `own` is the force of the wall without a tie.
    #[inline]
    pub(super) fn derivatives(self, own: &Line, u: f64) -> [f64; 3] {
        // the branch through u = 0, where ω² = F/(u m_eff) is not defined, has constant damping
        if let Self::Constant(c) = self {
            return [c, 0.0, 0.0];
        }
        // w = ω² = F/(u m_eff)
        let w = own.at(u) / u;
        let [c, by_w, by_w2] = match self {
            Self::Constant(c) => [c, 0.0, 0.0],
            Self::SecantRatio(twice_xi) if w > 0.0 => {
                let slope = 0.5 * twice_xi / w.sqrt();
                [twice_xi * w.sqrt(), slope, -0.5 * slope / w]
            }
            Self::SecantRatio(_) => [0.0; 3],
            Self::SecantStiffness(factor) => [factor * w, factor, 0.0],
        };
        // dw/du = (k − w)/u, d²w/du² = −2 (dw/du)/u
        let slope = (own.slope - w) / u;
        [c, by_w * slope, by_w2 * slope * slope - 2.0 * by_w * slope / u]
    }

    /// Bounds c \[1/s\], |dc/du| and |d²c/du²| between two displacements of a branch \[m\], where `own` is
    /// the force of the wall without a tie. ω² = k + f(0)/u is monotone there.
    pub(super) fn bounds(self, own: &Line, range: [f64; 2]) -> [f64; 3] {
        let [first, second] = range.map(|u| own.at(u) / u);
        let (least, most) = (first.min(second), first.max(second));
        let nearest = range[0].abs().min(range[1].abs());
        let [c, by_w, by_w2] = match self {
            Self::Constant(c) => return [c, 0.0, 0.0],
            Self::SecantRatio(twice_xi) => {
                let slope = 0.5 * twice_xi / least.sqrt();
                [twice_xi * most.sqrt(), slope, 0.5 * slope / least]
            }
            Self::SecantStiffness(factor) => [factor * most, factor, 0.0],
        };
        let slope = own.at(0.0).abs() / (nearest * nearest);
        [c, by_w * slope, by_w2 * slope * slope + 2.0 * by_w * slope / nearest]
    }

    /// Returns the fraction of u₃, the end of the softening branch, up to which the damping acts.
    pub(super) fn end(self) -> f64 {
        match self {
            Self::SecantRatio(_) => 1.0 - RATIO_CUTOFF,
            Self::Constant(_) | Self::SecantStiffness(_) => 1.0,
        }
    }
}

/// Taylor coefficients of c over time along a motion, for any damping law. Each is computed once the
/// coefficients of u up to its order are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DampingSeries<const N: usize> {
    law: BranchDamping,
    own: Line,
    /// Of ω² and of ω.
    omega_squared: [f64; N],
    omega: [f64; N],
    /// Of c: \[1/s\], \[1/s²\] …
    pub(crate) coefficients: [f64; N],
}

impl<const N: usize> DampingSeries<N> {
    pub(crate) fn new(law: BranchDamping, own: Line) -> Self {
        let zeros = [0.0; N];
        Self { law, own, omega_squared: zeros, omega: zeros, coefficients: zeros }
    }

    /// Adds the n-th coefficient from those of u, known up to n.
    pub(crate) fn extend(&mut self, u: &[f64; N], n: usize) {
        if let BranchDamping::Constant(c) = self.law {
            self.coefficients[0] = c;
            return;
        }
        let product = |a: &[f64; N], b: &[f64; N], first: usize, end: usize| -> f64 {
            (first..end).map(|i| a[i] * b[n - i]).sum()
        };
        // u ω² = F/m_eff, ω ω = ω²
        let force = if n == 0 { self.own.at(u[0]) } else { self.own.slope * u[n] };
        self.omega_squared[n] = (force - product(u, &self.omega_squared, 1, n + 1)) / u[0];
        self.omega[n] = if n == 0 {
            self.omega_squared[0].max(0.0).sqrt()
        } else {
            0.5 * (self.omega_squared[n] - product(&self.omega, &self.omega, 1, n)) / self.omega[0]
        };
        self.coefficients[n] = match self.law {
            BranchDamping::Constant(_) => 0.0,
            BranchDamping::SecantRatio(twice_xi) => twice_xi * self.omega[n],
            BranchDamping::SecantStiffness(factor) => factor * self.omega_squared[n],
        };
    }
}

/// The damping of a wall with the numbers in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DampingLaw {
    pub(super) asked: Damping,
    /// The model's own ratio in use \[-\]; 0 where there is none.
    pub(super) own_ratio: f64,
    /// ξ in use \[-\]: for a free-standing block its equivalent at ω₁, and 0 where there is none.
    pub(super) ratio: f64,
    /// C/`m_eff` on the elastic branch \[1/s\].
    pub(super) elastic: f64,
    /// The damping on the other branches, before the force falls to zero.
    pub(super) rocking: BranchDamping,
}

impl DampingLaw {
    /// # Errors
    /// [`ParameterError::Conflict`] where a ratio ξ meets the rigid-linear law;
    /// [`ParameterError::Computed`] where e = 0 leaves none to compute.
    pub(super) fn new(
        asked: Damping,
        parameters: &Parameters,
        body: &Body,
        force: &RestoringForce,
        restitution: f64,
    ) -> Result<Self, ParameterError> {
        let model = asked.model;
        if force.elastic_stiffness.is_none() && model.needs_elastic_branch() {
            return Err(ParameterError::conflict(
                [Choice::new("damping_model", model.name()), Choice::new("force_law", "rigid_linear")],
                "force_law = bilinear, since the model needs an elastic branch, damping_model = \
                 free_standing_block, or none with impact = restitution",
            ));
        }
        let value = match (asked.ratio, asked.computed_name()) {
            (Some(number), _) => number,
            (None, Some(name)) if restitution <= 0.0 => {
                return Err(ParameterError::Computed { name, restitution });
            }
            (None, _) => model.predicted_ratio(force.elastic_fraction, restitution),
        };
        let omega1 = force.omega1(body.effective_mass);
        // C = 2 m_eff ω₁ ξ on the elastic branch
        let elastic = 2.0 * omega1 * value;
        let (ratio, elastic, rocking) = match model {
            DampingModel::None => (0.0, 0.0, BranchDamping::Constant(0.0)),
            DampingModel::ConstantCoefficient => (value, elastic, BranchDamping::Constant(elastic)),
            DampingModel::FreeStandingBlock => {
                // C = m_eff √(g/z_G) c̄
                let c = (parameters.gravity / body.centroid_height).sqrt() * value;
                (if omega1 > 0.0 { c / (2.0 * omega1) } else { 0.0 }, c, BranchDamping::Constant(c))
            }
            DampingModel::ConstantRatio => (value, elastic, BranchDamping::SecantRatio(2.0 * value)),
            DampingModel::StiffnessProportional => {
                // ω₁ is 0 for the rigid-linear law, and the compiler may compute the quotient before it knows
                // the model; it must not divide by zero
                let factor = 2.0 * value / omega1.max(f64::MIN_POSITIVE);
                (value, elastic, BranchDamping::SecantStiffness(factor))
            }
        };
        Ok(Self { asked, own_ratio: value, ratio, elastic, rocking })
    }

    /// Returns the damping on a branch: on the elastic branch, on another one before the force falls to zero,
    /// or beyond that (`is_beyond`).
    ///
    /// On the elastic branch ω = ω₁ and c is constant. Beyond u₃, c = 0 unless it is constant on all
    /// branches. A law that does otherwise returns before these two rules. One that depends on |u| on the
    /// elastic branch, too, keeps the corner at u = 0 in `lay_out_corners`.
    pub(super) fn on_branch(&self, is_elastic: bool, is_beyond: bool) -> BranchDamping {
        if is_elastic {
            BranchDamping::Constant(self.elastic)
        } else if is_beyond {
            // where the secant stiffness is negative
            BranchDamping::Constant(self.rocking.constant().unwrap_or(0.0))
        } else {
            self.rocking
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// c and its derivatives keep within their bounds between two displacements on either side. Over a short
    /// way, on which nothing cancels, the bounds are the values.
    #[test]
    fn damping_keeps_within_its_bounds() {
        for law in [BranchDamping::SecantRatio(0.4), BranchDamping::SecantStiffness(0.03)] {
            for (slope, force) in [(-3.7, 0.0), (0.0, 0.4), (2.5, 0.6)] {
                for (side, from, width) in [(1.0, 0.01, 0.08), (-1.0, 0.01, 0.08), (1.0, 0.09, 1e-9)] {
                    let own = Line { anchor: 0.1 * side, force: force * side, slope };
                    let range = [from * side, (from + width) * side];
                    let bounds = law.bounds(&own, range);
                    let mut most = [0.0_f64; 3];
                    for part in (0..=64).map(|n| f64::from(n) / 64.0) {
                        let found = law.derivatives(&own, range[0] + part * (range[1] - range[0]));
                        for (most, value) in most.iter_mut().zip(found) {
                            *most = most.max(value.abs());
                        }
                    }
                    for (n, (bound, most)) in bounds.into_iter().zip(most).enumerate() {
                        // rounding; the terms of d²c/du² may cancel
                        assert!(bound >= most * (1.0 - 1e-14), "{law:?} {slope}, {n}: {most} of {bound}");
                        let near = n < 2 && width < 1e-8;
                        assert!(!near || bound <= most * (1.0 + 1e-6), "{law:?} {n}: {most} of {bound}");
                    }
                }
            }
        }
        assert_eq!(
            BranchDamping::Constant(0.7).bounds(&Line { anchor: 0.1, force: 0.2, slope: 1.0 }, [0.1; 2]),
            [0.7, 0.0, 0.0]
        );
    }
}
