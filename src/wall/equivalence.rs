//! Equivalences between restitution and viscous damping, Eqs. (5), (13)–(14), (17), (20)–(23).
//!
//! Eqs. (20)–(22) were fitted over 0.005 < a₁ < 0.1.

/// Range of a₁ over which Eqs. (20)–(22) were fitted \[-\].
pub const FITTED_A1: std::ops::RangeInclusive<f64> = 0.005..=0.1;

/// Damping ratio of a constant damping coefficient, ξ = −0.667 a₁^0.450 ln e. Eq. (20).
pub fn constant_coefficient(a1: f64, restitution: f64) -> f64 {
    -0.667 * a1.powf(0.450) * restitution.ln()
}

/// Constant damping ratio, ξ = −0.350 a₁^0.074 ln e. Eq. (21).
pub fn constant_ratio(a1: f64, restitution: f64) -> f64 {
    -0.350 * a1.powf(0.074) * restitution.ln()
}

/// Stiffness-proportional damping ratio at ω₁, ξ₁ = −0.218 a₁^−0.195 ln e. Eq. (22).
pub fn stiffness_proportional(a1: f64, restitution: f64) -> f64 {
    -0.218 * a1.powf(-0.195) * restitution.ln()
}

/// Damping coefficient ratio of an unloaded free-standing parapet, c̄ = −1.55 ln e. Eq. (23).
pub fn free_standing_block(restitution: f64) -> f64 {
    -1.55 * restitution.ln()
}

/// Damping ratio of an elastic oscillator that decays like a rocking block over `impacts` impacts from the
/// rotation ratio θ₀/α. Priestley et al., Eq. (13).
pub fn priestley(restitution: f64, rotation_ratio: f64, impacts: u32) -> f64 {
    let n = f64::from(impacts);
    let energy = 1.0 - (1.0 - rotation_ratio).powi(2);
    // θₙ/α = 1 − √(1 − e²ⁿ (1 − (1 − θ₀/α)²))
    let after = 1.0 - (1.0 - restitution.powf(2.0 * n) * energy).sqrt();
    (rotation_ratio / after).ln() / (n * std::f64::consts::PI)
}

/// Damping ratio of an elastic oscillator, ξ = −0.68 ln e. Makris and Konstantinidis, Eq. (14).
pub fn makris_konstantinidis(restitution: f64) -> f64 {
    -0.68 * restitution.ln()
}

/// Damping ratio from a sine-shaped half cycle, ξ = 2(1 − e)/(π(1 + e)). Giannini and Masiani, Eq. (17).
pub fn giannini_masiani(restitution: f64) -> f64 {
    2.0 * (1.0 - restitution) / (std::f64::consts::PI * (1.0 + restitution))
}

/// Period of free rocking from the rotation ratio θ₀/α, T = (4/p) acosh(1/(1 − θ₀/α)) \[s\]. Housner, Eq.
/// (5).
///
/// `frequency` is the frequency parameter p = √(3g/(4R)) \[rad/s\].
pub fn housner_period(frequency: f64, rotation_ratio: f64) -> f64 {
    4.0 / frequency * (1.0 / (1.0 - rotation_ratio)).acosh()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::DampingModel;

    /// Equations (14), (17) and (20)–(23) at ln e = −1, where Eqs. (20)–(22) are c a₁ᵖ.
    #[test]
    fn damping_of_a_restitution_is_that_of_its_equation() {
        let e = (-1.0_f64).exp();
        for &model in DampingModel::ALL {
            let (coefficient, power) = match model {
                DampingModel::None => (0.0, 0.0),
                DampingModel::ConstantCoefficient => (0.667, 0.450),
                DampingModel::FreeStandingBlock => (1.55, 0.0),
                DampingModel::ConstantRatio => (0.350, 0.074),
                DampingModel::StiffnessProportional => (0.218, -0.195),
            };
            for (a1, decades) in [(1.0, 0.0), (0.01, -2.0)] {
                let expected = coefficient * (std::f64::consts::LN_10 * power * decades).exp();
                let found = model.predicted_ratio(a1, e);
                assert!((found - expected).abs() <= 1e-15, "{model:?}, {a1}: {found} for {expected}");
            }
            // in proportion to ln e, and none without loss
            assert!(
                (model.predicted_ratio(0.03, e * e) - 2.0 * model.predicted_ratio(0.03, e)).abs() <= 1e-15
            );
            assert_eq!(model.predicted_ratio(0.03, 1.0), 0.0);
        }
        assert!((makris_konstantinidis(e) - 0.68).abs() <= 1e-15);
        assert!((giannini_masiani(1.0 / 3.0) - 1.0 / std::f64::consts::PI).abs() <= 1e-15);
        assert_eq!(giannini_masiani(1.0), 0.0);
    }

    /// Equations (13) and (5) where they have simple values: from θ₀ = α/2 with e²ⁿ = 7/12 the block comes
    /// to α/4, and acosh 2 = ln(2 + √3). Within a few roundings.
    #[test]
    fn rocking_of_blocks_is_that_of_its_equation() {
        for impacts in [1, 2, 3] {
            let n = f64::from(impacts);
            let expected = std::f64::consts::LN_2 / (n * std::f64::consts::PI);
            let found = priestley((7.0_f64 / 12.0).powf(0.5 / n), 0.5, impacts);
            assert!((found - expected).abs() <= 1e-15, "{impacts}: {found} for {expected}");
        }
        let expected = 2.0 * (2.0 + 3.0_f64.sqrt()).ln();
        assert!((housner_period(2.0, 0.5) - expected).abs() <= 1e-15 * expected);
    }
}
