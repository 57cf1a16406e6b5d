//! Which parameter explains a number of the samples, such as ln θ: correlations of ranks, and a regression.

use fragility::linear::{cholesky, solve};

use super::hypercube::SINGULAR;

/// What a parameter explains of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivity {
    /// Spearman's correlation of the ranks \[-\]; `None` where all samples are alike.
    pub rank_correlation: Option<f64>,
    /// Coefficient of the regression; of a logarithm the exponent with which θ changes \[-\].
    pub coefficient: Option<f64>,
    /// The coefficient in standard deviations of the number, per standard deviation of the parameter \[-\].
    pub standardised: Option<f64>,
    /// Part of the variance of the number: the standardised coefficient times the correlation, so that the
    /// parts add up to R² \[-\].
    ///
    /// J. W. Pratt: Dividing the indivisible: using simple symmetry to partition variance explained. Second
    /// International Tampere Conference in Statistics, 1987, 245–260.
    pub part: Option<f64>,
}

/// Returns what each parameter explains of the numbers of some samples, and R² of the regression on all
/// parameters together. `columns` has the samples of each parameter; of some, all above 0, the regression
/// takes the logarithm.
///
/// There is no regression where the samples are not more than the parameters and 1, or a parameter follows
/// from others.
pub fn sensitivities(
    columns: &[Vec<f64>],
    is_logarithmic: &[bool],
    numbers: &[f64],
) -> (Vec<Sensitivity>, Option<f64>) {
    let scaled = columns.iter().zip(is_logarithmic).map(|(column, is_logarithmic)| {
        if *is_logarithmic { column.iter().copied().map(libm::log).collect() } else { column.clone() }
    });
    let scaled: Vec<Vec<f64>> = scaled.collect();
    // those that vary
    let units: Vec<Option<(Vec<f64>, f64)>> = scaled.iter().map(|column| centred(column)).collect();
    let varied: Vec<_> = units.iter().flatten().collect();
    let number = centred(numbers);
    let fit = number.as_ref().filter(|_| numbers.len() > varied.len() + 1).and_then(|(unit, _)| {
        let columns: Vec<&[f64]> = varied.iter().map(|(column, _)| &**column).collect();
        least_squares(&columns, unit)
    });
    let explained = fit.as_ref().zip(number.as_ref()).map(|(coefficients, (unit, _))| {
        coefficients.iter().zip(&varied).map(|(c, (column, _))| c * product(column, unit)).sum()
    });
    let mut coefficients = fit.into_iter().flatten();
    let mut found = Vec::with_capacity(columns.len());
    for (place, column) in columns.iter().enumerate() {
        let standardised = units[place].as_ref().and_then(|_| coefficients.next());
        let correlation = number.as_ref().zip(units[place].as_ref()).map(|((y, _), (x, _))| product(x, y));
        let spread = number.as_ref().zip(units[place].as_ref()).map(|((_, y), (_, x))| y / x);
        found.push(Sensitivity {
            rank_correlation: rank_correlation(column, numbers),
            coefficient: standardised.zip(spread).map(|(coefficient, spread)| coefficient * spread),
            standardised,
            part: standardised.zip(correlation).map(|(coefficient, correlation)| coefficient * correlation),
        });
    }
    (found, explained)
}

/// Returns Spearman's correlation of two lists; `None` where one is all alike.
pub fn rank_correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let (one, _) = centred(&ranks(one))?;
    let (other, _) = centred(&ranks(other))?;
    Some(product(&one, &other))
}

/// Returns the ranks of values, from 1; values that are alike have the mean of their ranks.
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut before = 0;
    for alike in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let rank = before as f64 + 0.5 * (alike.len() as f64 + 1.0);
        for &place in alike {
            ranks[place] = rank;
        }
        before += alike.len();
    }
    ranks
}

/// Returns values less their mean over their length as a vector, and this length; `None` where all are alike.
fn centred(values: &[f64]) -> Option<(Vec<f64>, f64)> {
    let first = values.first()?;
    if values.iter().all(|value| value == first) {
        return None;
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let off: Vec<f64> = values.iter().map(|value| value - mean).collect();
    let length = product(&off, &off).sqrt();
    Some((off.into_iter().map(|value| value / length).collect(), length))
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Returns the coefficients with which columns of length 1 add up to a list, in the least squares, from the
/// normal equations; `None` where a column follows from others.
fn least_squares(columns: &[&[f64]], list: &[f64]) -> Option<Vec<f64>> {
    let mut matrix: Vec<Vec<f64>> =
        columns.iter().map(|a| columns.iter().map(|b| product(a, b)).collect()).collect();
    cholesky(&mut matrix, SINGULAR)?;
    let mut found: Vec<f64> = columns.iter().map(|column| product(column, list)).collect();
    solve(&matrix, &mut found);
    Some(found)
}
