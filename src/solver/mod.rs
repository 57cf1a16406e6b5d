//! Solvers: from a state and a segment of support motion to the state at its end.
//!
//! One loop serves all of them. It asks the method for the next piece of motion, follows it to its end or to the first corner,
//! and applies what happens there: change of branch, impact, overturning, departure from the supports, landing.

mod adaptive;
mod demand;
mod event;
mod exact;
mod frozen;
mod newmark;
mod oscillator;
mod polynomial;
pub mod record;
mod run;
mod trigonometric;

use crate::variables::Solver;
use crate::wall::{BranchDamping, ParameterError, Parameters, Support, Wall};

use adaptive::Tolerances;
pub(crate) use demand::Start;
use demand::Watch;
pub use demand::{ACCURACY, Crossing, Demands, Extremes, Instant};
pub use event::Peaks;
pub use exact::Memo;
pub use frozen::{Event, INDICATORS};
use oscillator::Oscillator;
use run::Run;

/// A stretch of support motion, linear in time: one record sample or one communication step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Length \[s\].
    pub duration: f64,
    /// Supports at the start.
    pub from: Support,
    /// Supports at the end.
    pub to: Support,
}

/// Whether the wall moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It rocks or sways.
    Moving,
    /// A rigid wall stands still at u = 0.
    Resting,
    /// It lies at the end of its fall.
    Landed,
}

/// The state of a wall: plain data, copied to save it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Displacement u \[m\].
    pub displacement: f64,
    /// Velocity u̇ \[m/s\].
    pub velocity: f64,
    /// Index of the branch the wall is on; it tells the side at a corner.
    pub branch: usize,
    /// Whether the wall moves.
    pub phase: Phase,
    /// |u| has exceeded `u_ins` of its side.
    pub overturned: bool,
    /// The wall has left its supports.
    pub departed: bool,
    /// Extremes of u so far, turning points included.
    pub peaks: Peaks,
}

/// What a segment did besides changing the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Time of the first overturning after the start of the segment \[s\].
    pub overturning: Option<f64>,
    /// Time and velocity at which the wall left its supports in this segment \[s, m/s\].
    pub departure: Option<[f64; 2]>,
    /// ∫u dt while on the supports \[m s\]; only where asked for.
    pub displacement_integral: f64,
    /// The bound on impacts was reached and the wall put to rest.
    pub stilled: bool,
    /// Work done.
    pub work: Work,
}

/// Work counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Pieces of motion evaluated.
    pub pieces: u64,
    /// Changes of branch.
    pub corners: u64,
    /// Passages of u = 0 with restitution.
    pub impacts: u64,
}

impl Work {
    /// Adds the work of another stretch.
    pub fn add(&mut self, other: Self) {
        self.pieces += other.pieces;
        self.corners += other.corners;
        self.impacts += other.impacts;
    }
}

/// The motion could not be followed to the end of a segment; the state is as it was.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SolverError {
    /// Too many pieces in one segment.
    #[error(
        "gave up {reached} s into a step of {duration} s after {limit} pieces of motion (u = {displacement} m, \
         u_dot = {velocity} m/s); use smaller steps"
    )]
    TooManyPieces {
        /// Time reached \[s\].
        reached: f64,
        /// Length of the segment \[s\].
        duration: f64,
        /// The bound.
        limit: u32,
        /// Displacement reached \[m\].
        displacement: f64,
        /// Velocity reached \[m/s\].
        velocity: f64,
    },
    /// Overflow.
    #[error(
        "the motion left the range of numbers {reached} s into a step of {duration} s (u = {displacement} m, u_dot = \
         {velocity} m/s, forcing {forcing} m/s2); check the accelerations given"
    )]
    NotFinite {
        /// Time reached \[s\].
        reached: f64,
        /// Length of the segment \[s\].
        duration: f64,
        /// Displacement \[m\].
        displacement: f64,
        /// Velocity \[m/s\].
        velocity: f64,
        /// Forcing p \[m/s²\].
        forcing: f64,
    },
}

/// Part of the tolerance given to the terms a Taylor step leaves out: a run of 10⁴ steps then stays within it.
const LOCAL_SHARE: f64 = 1e-4;

/// How the motion between events is found.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Closed form on each branch.
    Exact,
    /// Closed form on the elastic branch, Taylor series elsewhere and for full rotations.
    Adaptive {
        /// Largest error of u/`u_ins` to aim at \[-\].
        tolerance: f64,
    },
    /// Newmark linear acceleration.
    Newmark {
        /// Step \[s\].
        step: f64,
    },
}

impl Method {
    /// The method the parameters ask for; `tolerance` is the tighter of theirs and the importer's.
    ///
    /// # Errors
    /// [`ParameterError::NotExact`] where the exact solver is asked for damping that varies on a branch.
    pub fn new(parameters: &Parameters, wall: &Wall, tolerance: f64) -> Result<Self, ParameterError> {
        let exact = wall.has_closed_form();
        match parameters.solver {
            Solver::Automatic | Solver::Exact if exact => Ok(Self::Exact),
            Solver::Exact => Err(ParameterError::NotExact { model: parameters.damping_model.name() }),
            Solver::Automatic | Solver::Adaptive => Ok(Self::Adaptive { tolerance }),
            Solver::Newmark => Ok(Self::Newmark { step: parameters.newmark_step }),
        }
    }
}

/// A wall and the method that moves it, with all that both prepare once.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    wall: Wall,
    method: Method,
    oscillators: Vec<Oscillator>,
    tolerances: Tolerances,
    rest_band: [f64; 2],
    rest_speed: f64,
}

impl Motion {
    /// Prepares the motion of a wall.
    ///
    /// # Panics
    /// If a wall in full rotations is to move by another method than the adaptive one.
    #[must_use]
    pub fn new(wall: Wall, method: Method) -> Self {
        let adaptive = matches!(method, Method::Adaptive { .. });
        assert!(adaptive || wall.rotations().is_none(), "full rotations need the adaptive method");
        let constant = |damping| match damping {
            BranchDamping::Constant(c) => c,
            // never used: a curved branch has no closed form
            BranchDamping::SecantRatio(_) | BranchDamping::SecantStiffness(_) => 0.0,
        };
        let oscillators =
            wall.branches().iter().map(|b| Oscillator::new(constant(b.damping), b.stiffness)).collect();
        let local = match method {
            Method::Adaptive { tolerance } => LOCAL_SHARE * tolerance * wall.displacement_scale(),
            _ => 0.0,
        };
        let tolerances = Tolerances { displacement: local, velocity: local * wall.rocking_rate() };
        let (rest_band, rest_speed) = (wall.rest_band(), wall.rest_speed());
        Self { wall, method, oscillators, tolerances, rest_band, rest_speed }
    }

    /// The wall.
    #[must_use]
    pub fn wall(&self) -> &Wall {
        &self.wall
    }

    /// The method.
    #[must_use]
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// The state at the start, under the supports' motion at that instant.
    #[must_use]
    pub fn start(&self, displacement: f64, velocity: f64, support: Support) -> State {
        self.start_under(displacement, velocity, self.wall.body().forcing(support))
    }

    /// The state at the start, under a forcing p \[m/s²\].
    #[must_use]
    pub fn start_under(&self, displacement: f64, velocity: f64, forcing: f64) -> State {
        let wall = &self.wall;
        let overturned = displacement.abs() > wall.body().instability.of(displacement);
        let departed = displacement.abs() > wall.body().departure.of(displacement);
        let mut state = State {
            displacement,
            velocity,
            branch: 0,
            phase: Phase::Moving,
            overturned,
            departed,
            peaks: Peaks::at(displacement),
        };
        if wall.is_rigid() && displacement == 0.0 && velocity == 0.0 {
            self.settle(&mut state, forcing, 0.0);
        } else {
            // At a corner the motion chooses the side; the force is continuous there, but for the rigid one at u = 0.
            let outer = wall.branch_of(displacement, 0.0);
            let acceleration = wall.acceleration(outer, displacement, velocity, forcing);
            state.branch =
                wall.branch_of(displacement, if velocity == 0.0 { acceleration } else { velocity });
        }
        state
    }

    /// Moves `state` through a segment; `integral` asks for ∫u dt, `memo` remembers the propagator of a step.
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was.
    pub fn advance(
        &self,
        state: &mut State,
        segment: &Segment,
        integral: bool,
        memo: &mut Memo,
    ) -> Result<Report, SolverError> {
        self.advance_watched(state, segment, integral, memo, None)
    }

    /// [`Self::advance`], and the demands of the segment: `watch` holds those so far, the time at the start of the segment \[s\],
    /// and whether the couple of a drift acts.
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was, and the demands are those up to the failure.
    pub(crate) fn advance_watched(
        &self,
        state: &mut State,
        segment: &Segment,
        integral: bool,
        memo: &mut Memo,
        watch: Option<(&mut Demands, f64, bool)>,
    ) -> Result<Report, SolverError> {
        let body = self.wall.body();
        let (from, to) = (body.forcing(segment.from), body.forcing(segment.to));
        let watch =
            watch.map(|(demands, time, drift)| Watch { demands, wall: &self.wall, segment, time, drift });
        let run = Run::new(self, *state, segment.duration, [from, to], integral, memo).watched(watch);
        let (end, report) = run.finish()?;
        *state = end;
        Ok(report)
    }

    /// A rigid wall at u = 0 with next to no velocity: it rests inside the band of F₀, else it follows the forcing.
    fn settle(&self, state: &mut State, forcing: f64, forcing_rate: f64) {
        let [lowest, highest] = self.rest_band;
        let leaves_up = forcing > highest || (forcing == highest && forcing_rate > 0.0);
        let leaves_down = forcing < lowest || (forcing == lowest && forcing_rate < 0.0);
        state.velocity = 0.0;
        state.displacement = 0.0;
        state.phase = if leaves_up || leaves_down { Phase::Moving } else { Phase::Resting };
        state.branch = self.wall.branch_of(0.0, if leaves_down { -1.0 } else { 1.0 });
    }
}

fn is_constant(damping: BranchDamping) -> bool {
    matches!(damping, BranchDamping::Constant(_))
}
