//! Fragilities of walls and of classes of walls, with the parts of their variance.

use super::fit::Lognormal;

/// Curves of a wall or a class for rising limit states. They have one β, so that they do not cross.
#[derive(Clone, Debug, PartialEq)]
pub struct FragilityFunction {
    /// θ of each limit state, in the unit of the intensities.
    pub medians: Vec<f64>,
    /// β from record to record \[-\].
    pub beta_records: f64,
    /// β from wall to wall \[-\]; 0 for one wall.
    pub beta_walls: f64,
    /// β of the model \[-\].
    pub beta_modelling: f64,
}

impl FragilityFunction {
    /// Takes the curves of a joint fit, in the order of rising limit states, and the β of the model.
    ///
    /// # Panics
    /// If there is no curve, or β is not common.
    pub fn new(curves: &[Lognormal], beta_modelling: f64) -> Self {
        let beta_records = curves[0].dispersion;
        assert!(curves.iter().all(|curve| curve.dispersion == beta_records), "the fit has one β");
        // the medians of the fit rise, but for rounding
        let risen = |highest: &mut f64, curve: &Lognormal| {
            *highest = highest.max(curve.median);
            Some(*highest)
        };
        let medians = curves.iter().scan(0.0, risen).collect();
        Self { medians, beta_records, beta_walls: 0.0, beta_modelling }
    }

    /// Joins walls with the same limit states into a class, by the law of total variance of ln IM. The shares
    /// w of the walls have the sum 1. The variance from wall to wall is the mean over the limit states, so
    /// that the class has one β too.
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
        let first = &walls[0];
        let (mut medians, mut between) = (Vec::new(), 0.0);
        for (state, base) in first.medians.iter().enumerate() {
            let over_first = |wall: &FragilityFunction| libm::log(wall.medians[state] / base);
            let mean = weighted(&over_first);
            between += weighted(&|wall| (over_first(wall) - mean).powi(2));
            medians.push(base * libm::exp(mean));
        }
        Self {
            beta_records: weighted(&|wall| wall.beta_records.powi(2)).sqrt(),
            beta_walls: (between / medians.len() as f64).sqrt(),
            beta_modelling: first.beta_modelling,
            medians,
        }
    }

    /// Returns β with all its parts: their squares add up.
    pub fn dispersion(&self) -> f64 {
        (self.beta_records.powi(2) + self.beta_walls.powi(2) + self.beta_modelling.powi(2)).sqrt()
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
            assert_eq!(wall.dispersion(), beta);
        }
    }

    /// The variance of a class is that of its walls' intensities taken together.
    #[test]
    fn the_variance_is_the_total_one() {
        let walls = [wall(&[1.0], 0.3), wall(&[2.0], 0.5)];
        let class = FragilityFunction::of_class(&[0.25, 0.75], &walls);
        let mean = 0.75 * 2.0_f64.ln();
        // E[ln² IM] − E²[ln IM]
        let second = 0.25 * 0.3_f64.powi(2) + 0.75 * (0.5_f64.powi(2) + 2.0_f64.ln().powi(2));
        assert!((class.medians[0] / mean.exp() - 1.0).abs() < 1e-15);
        assert!((class.dispersion().powi(2) - (second - mean * mean)).abs() < 1e-15);
    }

    #[test]
    fn medians_rise() {
        let class =
            FragilityFunction::of_class(&[0.5, 0.5], &[wall(&[1.0, 3.0], 0.3), wall(&[2.0, 2.0], 0.4)]);
        assert!(class.medians[0] < class.medians[1]);
        assert_eq!(wall(&[2.0, 2.0 - 1e-15], 0.3).medians, [2.0, 2.0]);
    }
}
