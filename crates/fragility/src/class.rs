//! Fragilities of walls and of classes of walls, with the parts of their variance.

use crate::fit::Lognormal;

/// Curves of a wall or a class, one for each limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct FragilityFunction {
    /// Curves of rising limit states.
    pub states: Vec<StateCurve>,
    /// β of the model \[-\].
    pub beta_modelling: f64,
}

/// The curve of a limit state, without the β of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateCurve {
    /// θ, in the unit of the intensities.
    pub median: f64,
    /// β from record to record \[-\].
    pub beta_records: f64,
    /// β from wall to wall \[-\]; 0 for one wall.
    pub beta_walls: f64,
}

impl FragilityFunction {
    /// Takes the fitted curves of a wall, in the order of rising limit states, and the β of the model.
    pub fn new(curves: &[Lognormal], beta_modelling: f64) -> Self {
        let state = |curve: &Lognormal| StateCurve {
            median: curve.median,
            beta_records: curve.dispersion,
            beta_walls: 0.0,
        };
        Self { states: curves.iter().map(state).collect(), beta_modelling }
    }

    /// Joins walls with the same limit states into a class, by the law of total variance of ln IM, limit
    /// state by limit state. The shares w of the walls have the sum 1.
    ///
    /// ```text
    /// ln θ = Σ wᵢ ln θᵢ
    /// β²   = Σ wᵢ βᵢ² + Σ wᵢ (ln θᵢ − ln θ)² + β_m²
    /// ```
    /// A class of one wall is that wall, to the last bit.
    ///
    /// # Panics
    /// If there is no wall.
    pub fn of_class(shares: &[f64], walls: &[FragilityFunction]) -> Self {
        let weighted = |value: &dyn Fn(&FragilityFunction) -> f64| -> f64 {
            shares.iter().zip(walls).map(|(share, wall)| share * value(wall)).sum()
        };
        let state = |(state, first): (usize, &StateCurve)| {
            let over_first = |wall: &FragilityFunction| libm::log(wall.states[state].median / first.median);
            let mean = weighted(&over_first);
            StateCurve {
                median: first.median * libm::exp(mean),
                beta_records: weighted(&|wall| wall.states[state].beta_records.powi(2)).sqrt(),
                beta_walls: weighted(&|wall| (over_first(wall) - mean).powi(2)).sqrt(),
            }
        };
        let states = walls[0].states.iter().enumerate().map(state).collect();
        Self { states, beta_modelling: walls[0].beta_modelling }
    }

    /// Returns β of a limit state with all its parts: their squares add up.
    pub fn dispersion(&self, state: usize) -> f64 {
        let StateCurve { beta_records, beta_walls, .. } = self.states[state];
        (beta_records.powi(2) + beta_walls.powi(2) + self.beta_modelling.powi(2)).sqrt()
    }
}

/// The resamples of a class at one limit state, from those of its walls.
///
/// A resample has the same records for every wall.
#[derive(Clone, Debug, Default)]
pub struct ClassResamples {
    /// ln θ of the first wall.
    base: f64,
    /// Σ w d, Σ w d² and Σ w β² of each resample, with d = ln θᵢ less that of the first wall.
    sums: Vec<[f64; 3]>,
}

impl ClassResamples {
    /// Adds a wall by its share: θ, and θ and β of each resample.
    pub fn add(&mut self, share: f64, median: f64, resamples: &[[f64; 2]]) {
        if self.sums.is_empty() {
            self.base = libm::log(median);
            self.sums = vec![[0.0; 3]; resamples.len()];
        }
        for (sums, [theta, beta]) in self.sums.iter_mut().zip(resamples) {
            let over_first = libm::log(*theta) - self.base;
            for (sum, part) in sums.iter_mut().zip([over_first, over_first * over_first, beta * beta]) {
                *sum += share * part;
            }
        }
    }

    /// Returns θ and β of each resample; not numbers where a wall has no curve.
    pub fn curves(&self, beta_modelling: f64) -> Vec<[f64; 2]> {
        let curve = |[mean, square, within]: &[f64; 3]| {
            // a rounding below 0 for walls that are alike
            let between = (square - mean * mean).max(0.0);
            let variance = within + between + beta_modelling.powi(2);
            if variance.is_nan() { [f64::NAN; 2] } else { [libm::exp(self.base + mean), variance.sqrt()] }
        };
        self.sums.iter().map(curve).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(medians: &[f64], dispersion: f64) -> FragilityFunction {
        let curve = |&median: &f64| Lognormal { median, dispersion };
        FragilityFunction::new(&medians.iter().map(curve).collect::<Vec<_>>(), 0.0)
    }

    #[test]
    fn a_class_of_one_wall_is_that_wall() {
        for (medians, beta) in [([0.1, 0.3], 0.2), ([1.7, 2.9], 0.777), ([3.3e-3, 12.0], 1.3)] {
            let wall = wall(&medians, beta);
            assert_eq!(FragilityFunction::of_class(&[1.0], std::slice::from_ref(&wall)), wall);
            assert_eq!(wall.dispersion(1), beta);
        }
    }

    /// The variance of a class is that of its walls' intensities taken together, at each limit state.
    #[test]
    fn the_variance_is_the_total_one() {
        let walls = [wall(&[1.0, 3.0], 0.3), wall(&[2.0, 3.0], 0.5)];
        let class = FragilityFunction::of_class(&[0.25, 0.75], &walls);
        let mean = 0.75 * 2.0_f64.ln();
        // E[ln² IM] − E²[ln IM]
        let within = 0.25 * 0.3_f64.powi(2) + 0.75 * 0.5_f64.powi(2);
        let second = within + 0.75 * 2.0_f64.ln().powi(2);
        assert!((class.states[0].median / mean.exp() - 1.0).abs() < 1e-15);
        assert!((class.dispersion(0).powi(2) - (second - mean * mean)).abs() < 1e-15);
        // walls of one θ differ by their records alone
        assert_eq!(class.states[1].beta_walls, 0.0);
        assert!((class.dispersion(1).powi(2) - within).abs() < 1e-15);
    }

    /// Resample by resample, a class follows from its walls as it does from all records.
    #[test]
    fn resamples_of_a_class_are_classes_of_resamples() {
        let [one, other] = [[[1.1, 0.3], [0.9, 0.2]], [[2.3, 0.4], [1.9, f64::NAN]]];
        let mut class = ClassResamples::default();
        class.add(0.25, 1.0, &one);
        class.add(0.75, 2.0, &other);
        let walls = [one[0], other[0]].map(|[median, beta]| wall(&[median], beta));
        let expected = FragilityFunction::of_class(&[0.25, 0.75], &walls);
        let [[theta, beta], none] = class.curves(0.1).try_into().unwrap();
        assert!((theta / expected.states[0].median - 1.0).abs() < 1e-14);
        assert!((beta / expected.dispersion(0).hypot(0.1) - 1.0).abs() < 1e-14);
        assert!(none.iter().all(|value| value.is_nan()));
    }
}
