//! Equations with a symmetric, positive definite matrix.

/// Puts the lower triangle L of a matrix L Lᵀ in its place; `None` if the square of a pivot is not above
/// `least`.
pub fn cholesky(matrix: &mut [impl AsRef<[f64]> + AsMut<[f64]>], least: f64) -> Option<()> {
    for row in 0..matrix.len() {
        for column in 0..=row {
            let [own, other] = [row, column].map(|k| matrix[k].as_ref());
            let rest = own[column] - (0..column).map(|k| own[k] * other[k]).sum::<f64>();
            let entry = if column < row { rest / other[column] } else { rest.sqrt() };
            if column == row && (rest.is_nan() || rest <= least) {
                return None;
            }
            matrix[row].as_mut()[column] = entry;
        }
    }
    Some(())
}

/// Solves L Lᵀ x = b, with x in the place of b.
pub fn solve(lower: &[impl AsRef<[f64]>], x: &mut [f64]) {
    forward(lower, x);
    for row in (0..x.len()).rev() {
        let known: f64 = (row + 1..x.len()).map(|k| lower[k].as_ref()[row] * x[k]).sum();
        x[row] = (x[row] - known) / lower[row].as_ref()[row];
    }
}

/// Solves L x = b, with x in the place of b.
pub fn forward(lower: &[impl AsRef<[f64]>], x: &mut [f64]) {
    for (row, line) in lower.iter().map(AsRef::as_ref).enumerate() {
        let known: f64 = (0..row).map(|column| line[column] * x[column]).sum();
        x[row] = (x[row] - known) / line[row];
    }
}
