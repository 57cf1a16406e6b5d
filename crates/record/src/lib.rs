#![doc = include_str!("../README.md")]
//!
//! # How it works
//! [`RecordSolver::run`] moves one run, [`Batch`] many of one wall and record, [`run_together`] any.
//!
//! On a branch with constant damping a step is an affine map of (u, u̇) and of the forcing at its ends, made
//! once for each branch; so are several steps. A *plain* step applies the map and checks that u at both ends
//! is so far from the corners that none can have been reached in between. On a branch with secant damping
//! a step is a Taylor series. Ordinary corners and impacts are passed where u̇ keeps its sign up to them.
//! Everything else is left to the general search for events, the one of `wall.fmu`.
//!
//! One code serves a run by itself and eight side by side: a number is a vector of one lane.
//! docs/record-path.md has the bounds, their proofs and the course of a run.
//!
//! Each module uses only modules above it in this table, or before it in its row:
//!
//! | module | holds |
//! |---|---|
//! | `number`, `eight` | numbers of lanes, one by one and in vectors |
//! | `numbering`, `affine`, `forcing` | what numbers stand for; maps; samples |
//! | `table`, `solver` | the branches of a wall, prepared for a step |
//! | `responses`, `common`, `blocks`, `run` | a record, prepared; a run, its end and its outcome |
//! | `lanes`, `branches`, `line` | the runs in lanes, and the branches that they are on |
//! | `corners`, `turns`, `plain`, `regularised`, `curved` | the steps |
//! | `schedule`, `wide`, `together`, `batch` | which lane takes which step, which run which lane |
//! | `testing` | what the tests of runs side by side need |
#![allow(
    clippy::inline_always,
    reason = "measured: a step is one piece of straight code, its numbers in registers"
)]
#![cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "runs go side by side on x86-64 alone"))]

mod affine;
mod batch;
mod blocks;
mod branches;
mod common;
mod corners;
mod curved;
#[cfg(target_arch = "x86_64")]
mod eight;
mod forcing;
mod lanes;
mod line;
mod number;
mod numbering;
mod plain;
mod regularised;
mod responses;
mod run;
mod schedule;
mod solver;
mod table;
#[doc(hidden)]
pub mod testing;
mod together;
mod turns;
#[cfg(target_arch = "x86_64")]
mod wide;

pub use batch::{Batch, LANES};
pub use blocks::Blocks;
pub use forcing::Forcing;
pub use run::{BatchRun, Outcome, RunEnd, RunStart};
pub use solver::RecordSolver;
pub use together::run_together;
