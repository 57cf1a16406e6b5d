//! Motion over a record: many steps of one length, of one run ([`RecordSolver::run`]) or of many ([`Batch`]).
//!
//! On a branch with constant damping a step is an affine map of (u, u̇) and of the forcing at its ends, made
//! once for each branch; so are two steps, or four. A *plain* step applies the map and checks that u at both
//! ends is so far from the corners that none can have been reached in between. A *careful* step passes an
//! ordinary corner or turning point; everything else is left to the general search for events.
//! docs/record-path.md has the bounds, their proofs and the way of a run.
#![allow(
    clippy::inline_always,
    reason = "measured: a step is one piece of straight code, its numbers in registers"
)]
#![cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "other processors have no wide vectors"))]

mod active_run;
mod batch;
mod block;
mod bounds;
mod forcing;
mod short;
mod single;
mod solver;
mod step_map;
mod step_part;

pub use batch::{Batch, LANES};
pub use forcing::Forcing;
pub use solver::{Outcome, RecordSolver, RunStart};
