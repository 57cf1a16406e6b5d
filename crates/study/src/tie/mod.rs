//! Force of a parapet's tie and displacement of the wall over the stiffness of the tie.
//!
//! ```
//! use ground_motion::SyntheticMotion;
//! use rocking_wall::scene::Scene;
//! use study::tie::TieStudy;
//!
//! let mut scene = Scene::default();
//! scene.set("tie_height", "4")?;
//! let study = TieStudy::new(scene, vec![SyntheticMotion::default().motion()?], false)?;
//! let rows = study.rows(&study.stiffnesses(&[0.0, 1e6])?, 1)?;
//! assert!(rows[0].outcomes[0].force == 0.0 && rows[1].outcomes[0].force > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod figure;
mod table;

use fmu_export::VariableId;
use ground_motion::{GroundMotion, GroundMotionError};
use rocking_wall::response::{Fate, Response};
use rocking_wall::scene::{DEFAULT_TAIL, Scene, SceneError, check_limits};
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::TieDemands;
use rocking_wall::variables::{RealVariable, TieSide};
use rocking_wall::wall::{ParameterError, Parameters, Wall};

use run::parallel;
use run::polarity::Polarities;
use run::sample::sample_median;

pub use table::table;

/// Why a tie cannot be studied.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum TieError {
    /// There is no tie.
    #[error("the wall has no tie_height; set it, such as tie_height = 3")]
    NoHeight,
    /// A stiffness beyond the limits of the model description.
    #[error("{0}")]
    Stiffness(String),
    /// There is no motion.
    #[error("there is no motion; give records, or a scene with one")]
    NoMotion,
    /// The parameters make no wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A motion that cannot be reversed.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A run that failed.
    #[error(transparent)]
    Run(#[from] SceneError),
}

/// A wall with a tie of any stiffness, under each motion and its signs.
#[derive(Clone, Debug)]
pub struct TieStudy {
    scenes: Vec<Scene>,
    polarities: Polarities,
    tied: Wall,
}

/// Outcome of one motion: its demands on the tie and on the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Peak force of the tie \[N\].
    pub force: f64,
    /// Largest |u|/`u_ins`; 1 where the wall falls.
    pub u_ratio: f64,
    /// What becomes of the wall.
    pub fate: Fate,
    /// The wall falls to the side on which no tie holds it.
    pub away: bool,
    /// The force reached the tie's strength.
    pub reached: bool,
}

/// The outcomes for one stiffness of the tie.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Stiffness of the tie; 0 for none \[N/m\].
    pub stiffness: f64,
    /// One for each motion and sign.
    pub outcomes: Vec<Outcome>,
}

impl TieStudy {
    /// Prepares the study of a scene under records, each from rest and with a tail, or under its own motion;
    /// with both signs where they are asked for and differ.
    ///
    /// # Errors
    /// [`TieError`] of a scene without a tie or a motion, or that makes no wall.
    pub fn new(scene: Scene, records: Vec<GroundMotion>, both_polarities: bool) -> Result<Self, TieError> {
        if scene.parameters.tie_height <= 0.0 {
            return Err(TieError::NoHeight);
        }
        let tied = Wall::new(&Parameters { tie_stiffness: 1.0, ..scene.parameters.clone() })?;
        let shaken = |record: GroundMotion| {
            let mut shaken = scene.clone();
            shaken.shake(Excitation::new(record, None), DEFAULT_TAIL, Vec::new());
            shaken
        };
        let mut scenes: Vec<Scene> = records.into_iter().map(shaken).collect();
        if scenes.is_empty() {
            if scene.excitation.is_none() {
                return Err(TieError::NoMotion);
            }
            scenes.push(scene);
        }
        let polarities = Polarities::of(both_polarities, &scenes[0].parameters, &tied);
        if polarities == Polarities::Both {
            for index in 0..scenes.len() {
                let mut other = scenes[index].clone();
                other.excitation = other.excitation.map(|motion| motion.reversed()).transpose()?;
                scenes.push(other);
            }
        }
        for scene in &mut scenes {
            // as few samples as possible
            scene.output_step = scene.stop_time;
        }
        Ok(Self { scenes, polarities, tied })
    }

    /// Returns the scene under the first motion.
    pub fn scene(&self) -> &Scene {
        &self.scenes[0]
    }

    /// Counts the motions that are run, those of the other sign included.
    pub fn motions(&self) -> usize {
        self.scenes.len()
    }

    /// Returns the signs with which the motions are run.
    pub fn polarities(&self) -> Polarities {
        self.polarities
    }

    /// Returns the stiffnesses given, in order; if there are none, 0 and 1e-2 to 1e3 of 2 W/h at the tie
    /// \[N/m\].
    ///
    /// # Errors
    /// [`TieError::Stiffness`].
    pub fn stiffnesses(&self, given: &[f64]) -> Result<Vec<f64>, TieError> {
        let mut stiffnesses = given.to_vec();
        let variable = RealVariable::TieStiffness.variable();
        for &stiffness in given {
            check_limits(variable, stiffness).map_err(TieError::Stiffness)?;
        }
        if stiffnesses.is_empty() {
            let lever = self.tied.tie().map_or(1.0, |tie| tie.lever);
            let unit = self.tied.body().geometric_stiffness / (lever * lever);
            stiffnesses.push(0.0);
            stiffnesses.extend((-8..=12).map(|exponent| unit * 10.0_f64.powf(f64::from(exponent) / 4.0)));
        }
        stiffnesses.sort_by(f64::total_cmp);
        stiffnesses.dedup();
        Ok(stiffnesses)
    }

    /// Runs every motion with a tie of each stiffness \[N/m\] on some threads.
    ///
    /// # Errors
    /// [`TieError`] of the first run that fails.
    pub fn rows(&self, stiffnesses: &[f64], threads: usize) -> Result<Vec<Row>, TieError> {
        let count = self.scenes.len();
        let outcomes = parallel::map(stiffnesses.len() * count, threads, |index| {
            outcome(&self.scenes[index % count], stiffnesses[index / count])
        })?;
        let rows = stiffnesses.iter().zip(outcomes.chunks(count));
        Ok(rows.map(|(&stiffness, chunk)| Row { stiffness, outcomes: chunk.to_vec() }).collect())
    }
}

fn outcome(scene: &Scene, stiffness: f64) -> Result<Outcome, TieError> {
    let mut scene = scene.clone();
    scene.parameters.tie_stiffness = stiffness;
    let free = match scene.parameters.tie_side {
        TieSide::Positive => -1.0,
        TieSide::Negative => 1.0,
        TieSide::Both => 0.0,
    };
    let Response { summary, demands, residual, .. } = Response::of(&scene)?;
    let tie = demands.tie;
    Ok(Outcome {
        force: tie.map_or(0.0, |TieDemands { force, .. }| force.value),
        u_ratio: summary.u_ratio_max,
        fate: summary.fate,
        away: summary.fate.falls() && residual * free > 0.0,
        reached: tie.is_some_and(|tie| tie.strength.is_some()),
    })
}

impl Row {
    /// Returns median and largest of a quantity.
    pub fn of(&self, pick: fn(&Outcome) -> f64) -> [f64; 2] {
        let mut values: Vec<f64> = self.outcomes.iter().map(pick).collect();
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [sample_median(&mut values), largest]
    }
}
