//! Solvers: from a state and a segment of support motion to the state at its end.
//!
//! One loop serves all of them. It asks the method for the next piece of motion, follows it to its end or to the first corner,
//! and applies what happens there: change of branch, impact, overturning, departure from the supports, landing.

mod adaptive;
mod demand;
mod event;
mod exact;
mod indicators;
mod motion;
mod newmark;
mod oscillator;
mod polynomial;
pub mod record;
mod run;
mod state;
mod transition;
mod trigonometric;

pub(crate) use demand::Start;
pub use demand::{ACCURACY, Crossing, Demands, Extremes, Instant};
pub use exact::Memo;
pub use indicators::INDICATORS;
use motion::is_constant;
pub use motion::{Method, Motion};
pub use state::{Peaks, Phase, Report, Segment, SolverError, State, Work};
pub use transition::Event;
