//! Solvers: from a state and a segment of support motion to the state at its end.
//!
//! One loop serves all of them (`run`). It asks the method for the next piece of motion and follows it to its
//! end or to the first corner (`event`). The transition there is applied by `transition`. Where a tie yields,
//! unloads or breaks, the run goes on with the motion of the wall with its ties as they are then (`advance`).

mod adaptive;
mod advance;
mod calm;
mod demand;
mod event;
mod exact;
mod indicators;
mod memo;
mod motion;
mod run;
mod scaled;
pub mod secant;
mod state;
mod tolerances;
mod transition;
mod trigonometric;
mod watch;

pub(crate) use calm::Samples;
pub use demand::{Crossing, Demands, Extremes, Instant, TieDemands, Yielding};
pub use indicators::INDICATORS;
pub use memo::Memo;
pub use motion::{Method, Motion};
pub use state::{Peaks, Phase, Report, Segment, SolverError, State, Work, reported_peak};
pub use transition::Event;
pub use watch::ACCURACY;
