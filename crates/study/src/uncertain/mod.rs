//! Uncertain parameters of walls: distributions, samples of them, and which of them explains a fragility.
//!
//! ```
//! use study::uncertain::{Distribution, Shape, Uncertain};
//!
//! let height = Distribution::new(Shape::Normal { mean: 3.0, deviation: 0.1 }, [0.001, 1000.0])?;
//! let parameters = vec![("height".to_owned(), height)];
//! let uncertain = Uncertain { samples: 100, seed: 1, parameters, correlations: Vec::new() };
//! let rows = uncertain.rows()?;
//! // each hundredth of the distribution has one sample
//! assert_eq!(rows.iter().filter(|row| row[0] < 3.0).count(), 50);
//! # Ok::<(), String>(())
//! ```

mod distribution;
mod hypercube;
mod sensitivity;

use run::walls::NamedWall;
use scene::{Scene, SceneError, is_of_oscillator};
use serde::{Deserialize, Serialize};

pub use distribution::{Distribution, Shape, range};
pub use hypercube::{hypercube, pearson_of_spearman};
pub use sensitivity::{Sensitivity, rank_correlation, ranks, sensitivities};

/// Uncertain parameters of the walls of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertain {
    /// Number of samples of each wall.
    pub samples: usize,
    /// Seed of the samples.
    pub seed: u64,
    /// Parameters by their names, each with its distribution.
    pub parameters: Vec<(String, Distribution)>,
    /// Places of two parameters, and Spearman's correlation of their ranks.
    pub correlations: Vec<([usize; 2], f64)>,
}

/// The samples of a study: each wall of the file stands for as many walls as there are samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Samples {
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Whether the logarithm of a parameter is its natural scale ([`Distribution::is_logarithmic`]).
    pub is_logarithmic: Vec<bool>,
    /// Names of the walls of the file, whose samples are the walls of the study in their order.
    pub walls: Vec<String>,
    /// The value of each parameter in each sample, in the units of the parameters.
    pub rows: Vec<Vec<f64>>,
}

impl Uncertain {
    /// Draws the samples: sample by sample, the value of each parameter. The same on every machine.
    ///
    /// # Errors
    /// The reason why the correlations cannot be had.
    pub fn rows(&self) -> Result<Vec<Vec<f64>>, String> {
        let count = self.parameters.len();
        let mut matrix: Vec<Vec<f64>> = (0..count)
            .map(|row| (0..count).map(|column| f64::from(u8::from(row == column))).collect())
            .collect();
        for &([a, b], correlation) in &self.correlations {
            matrix[a][b] = pearson_of_spearman(correlation);
            matrix[b][a] = matrix[a][b];
        }
        let parts = hypercube(self.samples, &matrix, self.seed)?;
        let row = |sample: usize| {
            let value = |(column, (_, of)): (&Vec<f64>, &(String, Distribution))| of.value(column[sample]);
            parts.iter().zip(&self.parameters).map(value).collect()
        };
        Ok((0..self.samples).map(row).collect())
    }

    /// Draws the samples of some walls.
    ///
    /// # Errors
    /// As [`Self::rows`].
    pub fn samples(&self, walls: &[NamedWall]) -> Result<Samples, String> {
        Ok(Samples {
            parameters: self.parameters.iter().map(|(name, _)| name.clone()).collect(),
            is_logarithmic: self.parameters.iter().map(|(_, of)| of.is_logarithmic()).collect(),
            walls: walls.iter().map(|wall| wall.name.clone()).collect(),
            rows: self.rows()?,
        })
    }
}

impl Samples {
    /// Returns the name of a sample of a wall, such as `parapet 007`.
    pub fn name(&self, wall: &str, sample: usize) -> String {
        let digits = self.rows.len().to_string().len();
        format!("{wall} {:0digits$}", sample + 1)
    }

    /// Returns the names of all samples of a wall.
    pub fn names<'a>(&'a self, wall: &'a str) -> impl Iterator<Item = String> + 'a {
        (0..self.rows.len()).map(move |sample| self.name(wall, sample))
    }

    /// Makes the walls of the study.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a value that a parameter cannot have, or one that an oscillator lacks.
    pub fn of_walls(&self, walls: &[NamedWall]) -> Result<Vec<NamedWall>, SceneError> {
        let mut all = Vec::with_capacity(walls.len() * self.rows.len());
        for wall in walls {
            let mut names = self.parameters.iter();
            if let Some(name) = names.find(|name| wall.is_oscillator && !is_of_oscillator(name)) {
                let message = format!(
                    "wall {:?}: {name} is that of a wall, and no oscillator has it; leave it out",
                    wall.name
                );
                return Err(SceneError::Value { message });
            }
            for (sample, row) in self.rows.iter().enumerate() {
                let name = self.name(&wall.name, sample);
                let mut scene = Scene { parameters: wall.parameters.clone(), ..Scene::default() };
                for (parameter, value) in self.parameters.iter().zip(row) {
                    scene
                        .set(parameter, &value.to_string())
                        .map_err(|error| SceneError::Value { message: format!("wall {name:?}: {error}") })?;
                }
                let mut assumed = wall.assumed.clone();
                assumed.retain(|name| self.parameters.iter().all(|parameter| parameter != name));
                all.push(NamedWall { name, parameters: scene.parameters, assumed, ..wall.clone() });
            }
        }
        Ok(all)
    }
}
