//! Errors of an incremental dynamic analysis.

use ground_motion::GroundMotionError;
use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;
use scene::SceneError;

/// Why a study cannot be run.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum IdaError {
    /// A list is empty.
    #[error("a study needs at least one {what}")]
    Empty { what: &'static str },
    /// A wall and a damping model do not go together.
    #[error("wall {wall:?} with the damping model {model:?}: {source}")]
    Parameters { wall: String, model: String, source: Box<ParameterError> },
    /// The intensity of a record cannot be computed.
    #[error("record {record:?}: {source}")]
    Record { record: String, source: Box<GroundMotionError> },
    /// A record whose intensity is zero or not finite.
    #[error("record {record:?} has the intensity {intensity} and cannot be scaled; leave it out")]
    Unscalable { record: String, intensity: String },
    /// A record of which no stripe has the list.
    #[error("record {record:?} is in the list of no stripe; name one that has it in [[levels.stripe]]")]
    NoStripe { record: String },
    /// A value of the levels is outside its limits.
    #[error("{name} of the levels is {value}; it must be {limit}")]
    Levels { name: &'static str, value: String, limit: String },
    /// The free vibration after a record is outside its limits.
    #[error("the tail is {value} s; it must be from 0 to {limit} s", limit = super::LONGEST_TAIL)]
    Tail { value: f64 },
    /// The last shock of a sequence cannot be scaled by itself.
    #[error(
        "{what}; scaled_shocks = \"last\" needs a pause of two steps, and a wall on the ground that stands \
         until then: scale the shocks before it down, or leave the record out"
    )]
    LastShock { what: String },
    /// The floors do not fit the wall (a strip wall needs two).
    #[error("wall {wall:?}, record {record:?}: {source}")]
    Floors { wall: String, record: String, source: Box<SceneError> },
    /// A run failed.
    #[error("wall {wall:?}, record {record:?}, damping model {model:?}, from the level {level} on: {source}")]
    Run { wall: String, record: String, model: String, level: String, source: Box<SolverError> },
}
