//! The paper's tables and figures, computed now, beside its print.
//!
//! | module | holds |
//! |---|---|
//! | [`facts`] | what the paper prints |
//! | `formulas` | Tables 1 and 2 |
//! | [`tables`] | Tables 3, 4 and 5 |
//! | `rotations` | Figures 2 and 3: full rotations |
//! | `laws` | Figures 4 and 13: closed forms |
//! | `decays` | Figures 5, 6 and 7: free vibrations |
//! | `calibrated` | Figures 8 to 12: section 5 |
//! | `harmonic` | Figure 14: forced vibrations |
//! | [`collapse`] | Figure 15: incremental dynamic analyses |

mod calibrated;
pub mod collapse;
mod decays;
pub mod facts;
mod formulas;
mod harmonic;
mod laws;
mod rotations;
mod table;
pub mod tables;

use std::num::NonZeroUsize;

use crate::accuracy::AccuracyError;
use ground_motion::GroundMotionError;
use rocking_wall::response::{Response, Sample};
use rocking_wall::scene::{Scene, SceneError};
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::{ParameterError, Parameters};

use super::calibration::CalibrationError;
use super::chart::Chart;

pub use table::{Cell, Table, Value};

/// A figure of the paper, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its number.
    pub number: u8,
    /// What it shows.
    pub title: &'static str,
    /// What had to be assumed, what does not match.
    pub notes: Vec<String>,
    /// Its panels.
    pub charts: Vec<Chart>,
}

/// Everything, in the order of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// The tables; the last one gathers numbers from captions and text.
    pub tables: Vec<Table>,
    /// The figures.
    pub figures: Vec<Figure>,
}

/// Why the paper could not be reproduced.
#[derive(Debug, thiserror::Error)]
pub enum ReproductionError {
    /// A wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Full rotations.
    #[error(transparent)]
    Rotations(#[from] AccuracyError),
    /// A calibration.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// A motion.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
}

/// Computes every table and figure that needs no records on `threads` threads; [`collapse::figure_15`] is the one that does.
///
/// # Errors
/// [`ReproductionError`].
pub fn reproduce(threads: NonZeroUsize) -> Result<Reproduction, ReproductionError> {
    let [table_1, table_2] = formulas::tables_1_and_2()?;
    let section_5 = calibrated::Section5::new(threads)?;
    let tables = vec![
        table_1,
        table_2,
        tables::table_3(),
        tables::table_4(),
        tables::table_5()?,
        section_5.equations(),
        decays::captions(threads)?,
    ];
    let mut figures = vec![
        rotations::free_vibrations()?,
        rotations::periods()?,
        laws::figure_4()?,
        decays::figure_5()?,
        decays::figure_6()?,
        decays::figure_7()?,
    ];
    figures.extend(section_5.figures());
    figures.extend([laws::figure_13(), harmonic::figure_14()?]);
    Ok(Reproduction { tables, figures })
}

/// The history of a wall, free or shaken, at `step` up to `end` \[s\].
fn history(
    parameters: &Parameters,
    excitation: Option<Excitation>,
    [step, end]: [f64; 2],
) -> Result<Vec<Sample>, SceneError> {
    let scene = Scene {
        parameters: parameters.clone(),
        excitation,
        stop_time: end,
        output_step: step,
        ..Scene::default()
    };
    Ok(Response::of(&scene)?.samples)
}

/// `count` + 1 equally spaced values.
fn spaced([from, to]: [f64; 2], count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |index| from + (to - from) * f64::from(index) / f64::from(count))
}
