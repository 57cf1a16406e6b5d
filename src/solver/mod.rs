//! Solvers: from a state and a segment of support motion to the state at its end.
//!
//! One loop serves all of them. It asks the method for the next piece of motion, follows it to its end or to the first corner,
//! and applies what happens there: change of branch, impact, overturning, departure from the supports, landing.

mod adaptive;
mod event;
mod exact;
mod newmark;

use crate::variables::Solver;
use crate::wall::{BranchDamping, ParameterError, Parameters, Support, Wall};

use adaptive::{Series, Tolerances};
pub use event::Peaks;
use event::{Ending, Exit, Kinematics, Piece};
pub use exact::Memo;
use exact::{ClosedForm, Oscillator, Quiet};

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

/// Pieces of motion in one segment.
const MOST_PIECES: u32 = 4_000_000;
/// Impacts in one segment, after which a wall that could rest is put to rest.
const MOST_IMPACTS: u64 = 1_000_000;
/// Part of the tolerance given to the terms a Taylor step leaves out: a run of 10⁴ steps then stays within it.
const LOCAL_SHARE: f64 = 1e-4;

/// How the motion between events is found.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Closed form on each branch.
    Exact,
    /// Closed form on the elastic branch, Taylor series elsewhere.
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
        let exact = wall.has_constant_damping();
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
    #[must_use]
    pub fn new(wall: Wall, method: Method) -> Self {
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
        let forcing = wall.body().forcing(support);
        if wall.is_rigid() && displacement == 0.0 && velocity == 0.0 {
            self.settle(&mut state, forcing, 0.0);
        } else {
            // At a corner the motion chooses the side; the force is continuous there, but for the rigid one at u = 0.
            let outer = &wall.branches()[wall.branch_of(displacement, 0.0)];
            let acceleration = outer.acceleration(displacement, velocity, forcing);
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
        let body = self.wall.body();
        let (from, to) = (body.forcing(segment.from), body.forcing(segment.to));
        let mut run = Run {
            motion: self,
            state: *state,
            time: 0.0,
            duration: segment.duration,
            forcing: from,
            rate: if segment.duration > 0.0 { (to - from) / segment.duration } else { 0.0 },
            integral,
            memo,
            report: Report::default(),
        };
        run.finish()?;
        *state = run.state;
        Ok(run.report)
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

/// A segment under way.
struct Run<'a> {
    motion: &'a Motion,
    state: State,
    time: f64,
    duration: f64,
    /// Forcing at the start of the segment \[m/s²\] and its rate \[m/s³\].
    forcing: f64,
    rate: f64,
    integral: bool,
    memo: &'a mut Memo,
    report: Report,
}

/// A piece of motion of one of the methods.
enum AnyPiece {
    Closed(ClosedForm),
    Series(Series),
}

impl Run<'_> {
    fn finish(&mut self) -> Result<(), SolverError> {
        for _ in 0..MOST_PIECES {
            if self.time >= self.duration {
                return self.check();
            }
            match self.state.phase {
                Phase::Landed => self.time = self.duration,
                Phase::Resting => self.rest(),
                Phase::Moving => {
                    self.report.work.pieces += 1;
                    match self.piece() {
                        AnyPiece::Closed(piece) => self.follow(&piece)?,
                        AnyPiece::Series(piece) => self.follow(&piece)?,
                    }
                }
            }
        }
        Err(self.exhausted())
    }

    fn forcing_now(&self) -> f64 {
        self.forcing + self.rate * self.time
    }

    /// Rest until the forcing leaves the band.
    fn rest(&mut self) {
        let [lowest, highest] = self.motion.rest_band;
        let now = self.forcing_now();
        // a rounding later than the edge of the band, so that the forcing there has left it
        let until = |edge: f64| ((edge - now).abs() + 2.0 * f64::EPSILON * edge.abs()) / self.rate.abs();
        let mut leaving = f64::INFINITY;
        if now > highest || now < lowest {
            leaving = self.time;
        } else if self.rate > 0.0 {
            leaving = self.time + until(highest);
        } else if self.rate < 0.0 {
            leaving = self.time + until(lowest);
        }
        if leaving >= self.duration {
            self.time = self.duration;
            return;
        }
        self.time = leaving.max(self.time);
        self.state.phase = Phase::Moving;
        let upwards = now > highest || (now >= lowest && self.rate > 0.0);
        self.state.branch = self.motion.wall.branch_of(0.0, if upwards { 1.0 } else { -1.0 });
    }

    /// The next piece of motion, from the current state.
    fn piece(&mut self) -> AnyPiece {
        let motion = self.motion;
        let wall = &motion.wall;
        let State { displacement, velocity, branch: index, .. } = self.state;
        let branch = &wall.branches()[index];
        let forcing = self.forcing_now();
        let start = Kinematics {
            displacement,
            velocity,
            acceleration: branch.acceleration(displacement, velocity, forcing),
        };
        let remaining = self.duration - self.time;
        match motion.method {
            Method::Exact => AnyPiece::Closed(self.closed_form(index, start, remaining)),
            Method::Adaptive { .. } if branch.stiffness > 0.0 && is_constant(branch.damping) => {
                AnyPiece::Closed(self.closed_form(index, start, remaining))
            }
            Method::Adaptive { .. } => AnyPiece::Series(Series::new(
                branch,
                start,
                [forcing, self.rate],
                remaining,
                motion.tolerances,
            )),
            Method::Newmark { step } => {
                // equal steps, none longer than asked for
                let steps = (remaining / step - 1e-9).ceil().max(1.0);
                let step = remaining / steps;
                AnyPiece::Series(newmark::step(branch, start, self.rate * step, step))
            }
        }
    }

    fn closed_form(&mut self, index: usize, start: Kinematics, remaining: f64) -> ClosedForm {
        let branch = &self.motion.wall.branches()[index];
        let quiet = Quiet { lower: branch.lower, upper: branch.upper, peaks: self.state.peaks };
        let piece = ClosedForm::new(self.motion.oscillators[index], start, self.rate, remaining, &quiet);
        // only whole segments come again
        if self.time == 0.0 && piece.horizon() == self.duration {
            piece.remembered(index, self.memo)
        } else {
            piece
        }
    }

    /// Follows a piece to its end or to the first corner.
    fn follow<P: Piece>(&mut self, piece: &P) -> Result<(), SolverError> {
        let bounds = self.bounds();
        let mut peaks = self.state.peaks;
        let places = bounds.map(|index| self.motion.wall.corners()[index].displacement);
        let ending = event::follow(piece, places, &mut peaks).map_err(|_| self.exhausted())?;
        self.state.peaks = peaks;
        let length = match ending {
            Ending::Horizon(_) => piece.horizon(),
            Ending::Exit(exit) => exit.time,
        };
        if self.integral && !self.state.departed {
            self.report.displacement_integral += piece.displacement_integral(length);
        }
        match ending {
            Ending::Horizon(end) => {
                let finished = self.time + length >= self.duration || length >= self.duration - self.time;
                self.time = if finished { self.duration } else { self.time + length };
                if length <= 0.0 {
                    return Err(self.exhausted());
                }
                self.state.displacement = end.displacement;
                self.state.velocity = end.velocity;
                if let Method::Newmark { .. } = self.motion.method {
                    self.state.branch = self.motion.wall.branch_of(end.displacement, end.velocity);
                }
            }
            Ending::Exit(Exit { time, velocity, upwards }) => {
                self.time += time;
                self.state.velocity = velocity;
                self.reach(bounds[usize::from(upwards)], upwards);
            }
        }
        if self.state.displacement.is_finite() && self.state.velocity.is_finite() {
            Ok(())
        } else {
            Err(self.not_finite())
        }
    }

    /// The corners between which the piece holds: those of the branch, for Newmark the next ones where something happens.
    fn bounds(&self) -> [usize; 2] {
        let (mut lower, mut upper) = (self.state.branch, self.state.branch + 1);
        if let Method::Newmark { .. } = self.motion.method {
            let corners = self.motion.wall.corners();
            while !corners[lower].is_marked() {
                lower -= 1;
            }
            while !corners[upper].is_marked() {
                upper += 1;
            }
        }
        [lower, upper]
    }

    /// Arrives at a corner and goes through it.
    fn reach(&mut self, index: usize, upwards: bool) {
        let wall = &self.motion.wall;
        let corner = wall.corners()[index];
        self.state.displacement = corner.displacement;
        self.state.peaks.include(corner.displacement);
        self.report.work.corners += 1;
        let outwards = upwards == (corner.displacement > 0.0);
        if corner.overturning && outwards && !self.state.overturned {
            self.state.overturned = true;
            self.report.overturning = Some(self.time);
        }
        if corner.departure && outwards && !self.state.departed {
            self.state.departed = true;
            self.report.departure = Some([self.time, self.state.velocity]);
        }
        if corner.landing {
            self.state.velocity = 0.0;
            self.state.phase = Phase::Landed;
            return;
        }
        // branch i lies between corners i and i + 1
        self.state.branch = if upwards { index } else { index - 1 };
        if corner.passage {
            self.pass_zero();
        }
    }

    /// A passage of u = 0: restitution, and rest for a rigid wall.
    fn pass_zero(&mut self) {
        let motion = self.motion;
        self.state.velocity *= motion.wall.passage_factor();
        self.report.work.impacts += 1;
        let forcing = self.forcing_now();
        if motion.wall.is_rigid() {
            let [lowest, highest] = motion.rest_band;
            let in_band = (lowest..=highest).contains(&forcing);
            let too_many = self.report.work.impacts >= MOST_IMPACTS && in_band;
            if self.state.velocity.abs() < motion.rest_speed || too_many {
                self.report.stilled |= too_many;
                motion.settle(&mut self.state, forcing, self.rate);
            }
        } else if self.state.velocity == 0.0 {
            // e = 0: it stops here and leaves with the forcing
            let direction = if forcing == 0.0 { self.rate } else { forcing };
            self.state.branch = motion.wall.branch_of(0.0, direction);
        }
    }

    fn check(&self) -> Result<(), SolverError> {
        let State { displacement, velocity, .. } = self.state;
        if displacement.is_finite() && velocity.is_finite() { Ok(()) } else { Err(self.not_finite()) }
    }

    fn not_finite(&self) -> SolverError {
        SolverError::NotFinite {
            reached: self.time,
            duration: self.duration,
            displacement: self.state.displacement,
            velocity: self.state.velocity,
            forcing: self.forcing_now(),
        }
    }

    fn exhausted(&self) -> SolverError {
        SolverError::TooManyPieces {
            reached: self.time,
            duration: self.duration,
            limit: MOST_PIECES,
            displacement: self.state.displacement,
            velocity: self.state.velocity,
        }
    }
}

fn is_constant(damping: BranchDamping) -> bool {
    matches!(damping, BranchDamping::Constant(_))
}
