//! A wall and its records at the level of shaking of a limit state of a check.

use ground_motion::GroundMotion;
use scene::Scene;

use super::{Code, Subject};
use crate::error::CheckError;
use crate::file::site::Level;

/// What the runs of a check have at a limit state.
#[derive(Clone, Debug)]
pub struct AtLevel {
    /// The scene, with the tie and the building that the check has there.
    pub scene: Scene,
    /// The records of the check, scaled.
    pub motions: Vec<GroundMotion>,
    /// Their factors \[-\].
    pub factors: Vec<f64>,
    /// Whether the check runs each with both signs.
    pub both_signs: bool,
    /// What is to be known of the records and of their factors.
    pub warnings: Vec<String>,
}

impl AtLevel {
    /// A scene and records as they are given, without a check.
    pub fn as_given(scene: Scene, motions: Vec<GroundMotion>) -> Self {
        Self { scene, motions, factors: Vec::new(), both_signs: false, warnings: Vec::new() }
    }
}

/// Brings the records of a check to the level of a limit state, as its dynamic check does. `assumed` names
/// the parameters of the wall that nobody stated.
///
/// # Errors
/// [`CheckError`] of a code without runs, a limit state without a site, a check without records, or a wall
/// that cannot be checked.
pub fn at_level(
    code: &dyn Code,
    scene: &Scene,
    assumed: &[&'static str],
    state: &str,
) -> Result<AtLevel, CheckError> {
    let subject = Subject { assumed, ..scene.into() };
    let Some(Level { factors, floors, both_signs, warnings }) = code.level(subject, state)? else {
        return Err(CheckError::Wall {
            message: format!(
                "code = {:?} has no limit states with runs; use code = \"circolare-2019\", or scale the \
                 records",
                code.entry().name
            ),
        });
    };
    let records = code.records();
    let motions = records.named.iter().zip(&factors);
    let motions = motions.map(|(record, factor)| record.motion.checked_scaled(*factor));
    let motions = motions.collect::<Result<_, _>>()?;
    let mut scene = scene.clone();
    scene.parameters = code.prepared(&scene.parameters)?;
    scene.floors = floors;
    let warnings = records.warnings.iter().map(ToString::to_string).chain(warnings).collect();
    Ok(AtLevel { scene, motions, factors, both_signs, warnings })
}
