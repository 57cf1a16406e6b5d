//! Latin hypercubes with correlated ranks.

use fragility::linear::{cholesky, forward};
use fragility::quantile;
use run::sample::Pcg;

/// Squares of pivots below this are 0: a column is nearly made of others.
pub(super) const SINGULAR: f64 = 1e-9;

/// Returns the correlation of two normal variables whose ranks have Spearman's correlation ρ: 2 sin(πρ/6), as
/// in a Gaussian copula (K. Pearson: On further methods of determining correlation. 1907).
pub fn pearson_of_spearman(correlation: f64) -> f64 {
    2.0 * libm::sin(std::f64::consts::PI / 6.0 * correlation)
}

/// Draws a Latin hypercube: for each variable, the part of its distribution that each sample is above. Each
/// n-th of a distribution has one of its n samples, at random within (M. D. `McKay`, R. J. Beckman,
/// W. J. Conover: A comparison of three methods for selecting values of input variables. Technometrics
/// 21(2), 1979).
///
/// Samples are paired so that normal scores of the variables have the correlations of a matrix: R. L. Iman,
/// W. J. Conover: A distribution-free approach to inducing rank correlation among input variables.
/// Communications in Statistics B11(3), 1982. This also removes correlations by chance.
///
/// # Errors
/// The reason: samples too few for the variables, or a matrix that is not positive definite.
pub fn hypercube(samples: usize, correlation: &[Vec<f64>], seed: u64) -> Result<Vec<Vec<f64>>, String> {
    let count = correlation.len();
    let mut wanted = correlation.to_vec();
    cholesky(&mut wanted, SINGULAR)
        .ok_or("the correlations contradict each other: their matrix is not positive definite")?;
    let too_few = || format!("samples = {samples} are too few for {count} uncertain parameters");
    if samples < count + 2 {
        return Err(format!("{}; take {} and more", too_few(), count + 2));
    }
    let mut random = Pcg::new(seed);
    let score = |place: usize| quantile((place as f64 + 1.0) / (samples as f64 + 1.0));
    let (mut scores, mut within) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let mut order: Vec<usize> = (0..samples).collect();
        for end in (1..samples).rev() {
            order.swap(end, random.below(end + 1));
        }
        scores.push(order.into_iter().map(score).collect::<Vec<_>>());
        within.push((0..samples).map(|_| random.part()).collect::<Vec<_>>());
    }
    let mut found = correlations(&scores);
    cholesky(&mut found, SINGULAR).ok_or_else(|| format!("{}; take more", too_few()))?;
    let mut paired = vec![Vec::with_capacity(samples); count];
    for sample in 0..samples {
        // P Q⁻¹ takes scores of the correlations Q Qᵀ to those of P Pᵀ
        let mut free: Vec<f64> = scores.iter().map(|column| column[sample]).collect();
        forward(&found, &mut free);
        for row in 0..count {
            paired[row].push((0..=row).map(|column| wanted[row][column] * free[column]).sum::<f64>());
        }
    }
    let parts = |(column, within): (&Vec<f64>, &Vec<f64>)| {
        let mut order: Vec<usize> = (0..samples).collect();
        order.sort_by(|&a, &b| column[a].total_cmp(&column[b]));
        let mut parts = vec![0.0; samples];
        for (stratum, (sample, within)) in order.into_iter().zip(within).enumerate() {
            parts[sample] = (stratum as f64 + within) / samples as f64;
        }
        parts
    };
    Ok(paired.iter().zip(&within).map(parts).collect())
}

/// Returns the correlations of columns that have the same values in other orders, and the mean 0.
fn correlations(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let row = |a: &Vec<f64>| columns.iter().map(|b| product(a, b) / product(a, a)).collect();
    columns.iter().map(row).collect()
}
