//! Variables of a scene, computed by this library.

use rocking_wall::scene::{Scene, SceneError};
use rocking_wall::simulation::{Simulation, segment_of};
use rocking_wall::wall::{Fact, Support};

use super::error::VerificationError;
use super::scenes::Quantity;

/// Computes quantities of a scene, by the code that the FMU runs.
///
/// # Errors
/// [`VerificationError::Scene`] of a scene that cannot be run.
pub fn library(scene: &Scene, quantities: &[Quantity]) -> Result<Vec<Option<f64>>, VerificationError> {
    let motion = scene.support_motion()?;
    let motion = motion.as_deref();
    let support = |time: f64| segment_of(motion, time, 0.0).from;
    let mut simulation = Simulation::new(&scene.parameters, None, 0.0, support(0.0))?;
    let mut values = Vec::new();
    for &Quantity { name, time } in quantities {
        let next = |now: f64, _: f64| (segment_of(motion, now, time - now), time - now);
        simulation.advance_through(next, None).map_err(SceneError::from)?;
        simulation.set_time(time);
        values.push(value(&simulation, support(time), name));
    }
    Ok(values)
}

/// Returns a variable of the model description, or a fact of the wall, by its name.
fn value(simulation: &Simulation, support: Support, name: &str) -> Option<f64> {
    let outputs = simulation.outputs(support);
    Some(match name {
        "u" => outputs.displacement,
        "u_dot" => outputs.velocity,
        "u_ddot" => outputs.acceleration,
        "restoring_force" => outputs.restoring_force,
        "damping_force" => outputs.damping_force,
        "reaction_bottom" => outputs.reactions.bottom,
        "reaction_top" => outputs.reactions.top,
        "tie_force" => outputs.tie_force,
        "overturn_time" => simulation.progress().overturn_time.unwrap_or(-1.0),
        _ => {
            let facts = simulation.wall().facts();
            let Fact { value, .. } = facts.iter().find(|fact| fact.name == name)?;
            *value
        }
    })
}
