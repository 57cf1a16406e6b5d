//! What acts on a wall at its place: motions of floors, and spectra given by points.

use ground_motion::{GroundMotion, GroundMotionError};
use rocking_wall::scene::{DEFAULT_TAIL, Floors, SceneError};
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::Wall;

/// Returns the motion that acts on a wall under a record: the record itself, or the motion of its floors,
/// those of a strip wall by their weights.
pub(crate) fn felt<E: From<SceneError> + From<GroundMotionError>>(
    record: GroundMotion,
    floors: Option<&Floors>,
    wall: &Wall,
) -> Result<GroundMotion, E> {
    let Some(floors) = floors else { return Ok(record) };
    let end = record.duration() + DEFAULT_TAIL;
    let motion = floors.motion(wall.body().mechanism, &Excitation::new(record, None), end)?;
    Ok(motion.effective(wall.body())?)
}

/// Returns `S_a` at a period of a spectrum given by points (T, `S_a`), straight between them; `None` beyond
/// its ends.
pub(crate) fn interpolated(points: &[(f64, f64)], period: f64) -> Option<f64> {
    let after = points.partition_point(|point| point.0 < period);
    let &(t1, s1) = points.get(after)?;
    if t1 == period {
        return Some(s1);
    }
    let &(t0, s0) = points.get(after.checked_sub(1)?)?;
    Some(s0 + (s1 - s0) * ((period - t0) / (t1 - t0)))
}
