//! Demands on a tie and displacement of the wall over the stiffness, strength, slack, height or
//! ultimate elongation of the tie, or the diameter of its bar.
//!
//! ```
//! use ground_motion::SyntheticMotion;
//! use scene::Scene;
//! use study::tie::{STIFFNESS, TieStudy};
//!
//! let mut scene = Scene::default();
//! scene.set("tie_height", "4")?;
//! let records = vec![SyntheticMotion::default().motion()?];
//! let study = TieStudy::new(scene, &STIFFNESS, &[0.0, 1e6], records, false)?;
//! let rows = study.rows(1)?;
//! assert!(rows[0].outcomes[0].force == 0.0 && rows[1].outcomes[0].force > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod figure;
mod table;

use ground_motion::{GroundMotion, GroundMotionError};
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::{TieDemands, Yielding};
use rocking_wall::variables::TieSide;
use rocking_wall::wall::{ParameterError, Parameters, Tie, Wall};
use scene::response::{Fate, Response};
use scene::{DEFAULT_TAIL, Scene, SceneError};

use run::parallel;
use run::polarity::Polarities;
use run::sample::{fractile, sample_median, sorted};

pub use table::table;

/// The upper fractile of tables and figures: the mean and one standard deviation of a normal sample \[-\].
const UPPER: f64 = 0.84;

/// Why a tie cannot be studied.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum TieError {
    /// There is no tie, or one that what is varied does not change.
    #[error("the wall has no {missing}, so {varied} has no effect; set it, such as {missing} = {example}")]
    NoEffect { varied: &'static str, missing: &'static str, example: &'static str },
    /// Nothing to vary.
    #[error("there is no value of {varied}; give at least one")]
    NoValue { varied: &'static str },
    /// There is no motion.
    #[error("there is no motion; give records, or a scene with one")]
    NoMotion,
    /// The parameters make no wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A motion that cannot be reversed.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A value beyond the limits of the model description, or a run that failed.
    #[error(transparent)]
    Run(#[from] SceneError),
}

/// A parameter of the tie that a study varies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied {
    /// Name of the parameter, as scenes have it.
    pub parameter: &'static str,
    /// Column with its unit, in files.
    column: &'static str,
    /// Heading with its unit, for people.
    heading: &'static str,
    /// Factor from the unit of the column to that of the heading and the label.
    factor: f64,
    /// Label of the axis, with its unit for people.
    label: &'static str,
    /// Whether the axis is logarithmic.
    is_logarithmic: bool,
}

/// The stiffness K.
pub const STIFFNESS: Varied = Varied {
    parameter: "tie_stiffness",
    column: "stiffness_n_m",
    heading: "K [kN/m]",
    factor: 1e-3,
    label: "stiffness (kN/m)",
    is_logarithmic: true,
};
/// The force `N_y` that the tie resists.
pub const STRENGTH: Varied = Varied {
    parameter: "tie_strength",
    column: "strength_n",
    heading: "N_y [kN]",
    factor: 1e-3,
    label: "strength (kN)",
    is_logarithmic: true,
};
/// The slack g₀.
pub const SLACK: Varied = Varied {
    parameter: "tie_slack",
    column: "slack_m",
    heading: "slack [mm]",
    factor: 1e3,
    label: "slack (mm)",
    is_logarithmic: false,
};
/// The height above the base.
pub const HEIGHT: Varied = Varied {
    parameter: "tie_height",
    column: "height_m",
    heading: "height [m]",
    factor: 1.0,
    label: "height of the tie (m)",
    is_logarithmic: false,
};
/// The plastic elongation `p_u` at which the tie breaks; −1 for a tie that stays elastic.
pub const ULTIMATE: Varied = Varied {
    parameter: "tie_ultimate",
    column: "ultimate_m",
    heading: "p_u [mm]",
    factor: 1e3,
    label: "ultimate elongation (mm)",
    is_logarithmic: false,
};
/// The diameter of its bar, from which stiffness, strength and ultimate elongation follow.
pub const BAR_DIAMETER: Varied = Varied {
    parameter: "bar_diameter",
    column: "bar_diameter_m",
    heading: "bar [mm]",
    factor: 1e3,
    label: "diameter of the bar (mm)",
    is_logarithmic: false,
};
/// All that can be varied.
pub const ALL: [Varied; 6] = [STIFFNESS, STRENGTH, SLACK, HEIGHT, ULTIMATE, BAR_DIAMETER];

/// A wall whose tie has several values of one parameter, under each motion and its signs.
#[derive(Clone, Debug)]
pub struct TieStudy {
    varied: Varied,
    values: Vec<f64>,
    scenes: Vec<Scene>,
    polarities: Polarities,
    yields: bool,
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
    /// Plastic elongation of the tie at the end, the larger one of two \[m\].
    pub elongation: f64,
    /// A tie broke.
    pub broken: bool,
}

/// The outcomes for one value of what is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The value, in SI units.
    pub value: f64,
    /// One for each motion and sign.
    pub outcomes: Vec<Outcome>,
}

impl TieStudy {
    /// Prepares the study of a scene under records, each from rest and with a tail, or under its own motion;
    /// with both signs where they are asked for and differ. What is varied takes the values given, in order;
    /// for a stiffness without values these are 0 and 1e-2 to 1e3 of 2 W/h at the tie.
    ///
    /// # Errors
    /// [`TieError`] of a scene without a tie or a motion, and of a value beyond its limits or that makes no
    /// wall.
    pub fn new(
        scene: Scene,
        varied: &Varied,
        given: &[f64],
        records: Vec<GroundMotion>,
        both_polarities: bool,
    ) -> Result<Self, TieError> {
        let Parameters { tie_height, tie_stiffness, tie_strength, ref bar, .. } = scene.parameters;
        let example_of_bar = "{ diameter = 0.016, length = 6, yield_stress = 235e6 }";
        let needed = [
            (HEIGHT.parameter, tie_height <= 0.0 && *varied != HEIGHT, "3"),
            ("bar", bar.is_none() && *varied == BAR_DIAMETER, example_of_bar),
            (STIFFNESS.parameter, tie_stiffness == 0.0 && *varied != STIFFNESS, "1e6"),
            (STRENGTH.parameter, tie_strength == 0.0 && *varied == ULTIMATE, "1e4"),
        ];
        if let Some((missing, _, example)) = needed.into_iter().find(|(_, is_missing, _)| *is_missing) {
            return Err(TieError::NoEffect { varied: varied.parameter, missing, example });
        }
        let values = values(&scene, varied, given)?;
        let walls = values.iter().map(|&value| Ok(Wall::new(&with(&scene, varied, value)?.parameters)?));
        let walls = walls.collect::<Result<Vec<_>, TieError>>()?;
        let yields = walls.iter().flat_map(|wall| wall.ties().iter()).any(|tie| tie.ultimate.is_some());
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
        let tied = walls.iter().find(|wall| !wall.ties().is_empty()).unwrap_or(&walls[0]);
        let polarities = Polarities::of(both_polarities, &scenes[0].parameters, tied);
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
        Ok(Self { varied: *varied, values, scenes, polarities, yields })
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

    /// Returns what is varied.
    pub fn varied(&self) -> &Varied {
        &self.varied
    }

    /// Returns the values of what is varied, in order, in SI units.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns whether a tie of the study may yield.
    pub fn yields(&self) -> bool {
        self.yields
    }

    /// Runs every motion with a tie of each value, on some threads.
    ///
    /// # Errors
    /// [`TieError`] of the first run that fails.
    pub fn rows(&self, threads: usize) -> Result<Vec<Row>, TieError> {
        let (values, count) = (&self.values, self.scenes.len());
        let outcomes = parallel::map(values.len() * count, threads, |index| {
            outcome(&with(&self.scenes[index % count], &self.varied, values[index / count])?)
        })?;
        let rows = values.iter().zip(outcomes.chunks(count));
        Ok(rows.map(|(&value, chunk)| Row { value, outcomes: chunk.to_vec() }).collect())
    }
}

/// Returns a scene whose tie has a value.
fn with(scene: &Scene, varied: &Varied, value: f64) -> Result<Scene, TieError> {
    let mut scene = scene.clone();
    scene.set(varied.parameter, &value.to_string())?;
    Ok(scene)
}

/// Returns the values given, in order, or stiffnesses beside that of the wall.
fn values(scene: &Scene, varied: &Varied, given: &[f64]) -> Result<Vec<f64>, TieError> {
    let mut values = given.to_vec();
    if values.is_empty() && *varied == STIFFNESS {
        let wall = Wall::new(&Parameters { tie_stiffness: 1.0, ..scene.parameters.clone() })?;
        let unit = wall.body().geometric_stiffness / wall.ties().first().map_or(1.0, Tie::slope);
        values.push(0.0);
        values.extend((-8..=12).map(|exponent| unit * 10.0_f64.powf(f64::from(exponent) / 4.0)));
    }
    if values.is_empty() {
        return Err(TieError::NoValue { varied: varied.parameter });
    }
    values.sort_by(f64::total_cmp);
    values.dedup();
    Ok(values)
}

fn outcome(scene: &Scene) -> Result<Outcome, TieError> {
    let free = match scene.parameters.tie_side {
        TieSide::Positive => -1.0,
        TieSide::Negative => 1.0,
        TieSide::Both => 0.0,
    };
    let Response { summary, demands, residual, .. } = Response::of(scene)?;
    let tie = demands.ties.first();
    let Yielding { elongation, breaks } = tie.and_then(|tie| tie.yielding).unwrap_or_default();
    Ok(Outcome {
        force: tie.map_or(0.0, |TieDemands { force, .. }| force.value),
        u_ratio: summary.u_ratio_max,
        fate: summary.fate,
        away: summary.fate.falls() && residual * free > 0.0,
        reached: tie.is_some_and(|tie| tie.strength.is_some()),
        elongation: elongation.positive.max(elongation.negative),
        broken: breaks.iter().any(Option::is_some),
    })
}

impl Row {
    /// Returns median, 84 % fractile and largest of a quantity.
    pub fn of(&self, pick: fn(&Outcome) -> f64) -> [f64; 3] {
        let mut values = sorted(self.outcomes.iter().map(pick));
        let [upper, largest] = [UPPER, 1.0].map(|part| fractile(&values, part).unwrap_or(f64::NAN));
        [sample_median(&mut values), upper, largest]
    }
}
