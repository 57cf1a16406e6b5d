//! The state of a wall, the segments that change it, and what a segment did.

use crate::wall::{Sides, Support, TieMemory};

/// Support motion, linear in time: one record sample or one communication step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Length \[s\].
    pub duration: f64,
    /// Supports at the start.
    pub from: Support,
    /// Supports at the end.
    pub to: Support,
}

impl Segment {
    /// Returns the supports at a time after the start \[s\]; from the end on, those at the end.
    pub(super) fn support(&self, time: f64) -> Support {
        let share = time / self.duration;
        if share < 1.0 { self.from.towards(self.to, share) } else { self.to }
    }
}

/// Whether the wall moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// It rocks or sways.
    Moving,
    /// It stands still at u = 0, as a rigid wall or against transverse walls.
    Resting,
    /// It lies at the end of its fall.
    Landed,
}

/// The largest u and −u so far, neither negative \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Largest u.
    pub positive: f64,
    /// Largest −u.
    pub negative: f64,
}

impl Peaks {
    /// Returns the peaks of a wall that stands at `displacement`.
    pub fn at(displacement: f64) -> Self {
        Self { positive: displacement.max(0.0), negative: (-displacement).max(0.0) }
    }

    /// Returns the largest |u|/`u_ins`, each side by its own \[-\].
    pub fn ratio(&self, u_ins: Sides) -> f64 {
        (self.positive / u_ins.positive).max(self.negative / u_ins.negative)
    }

    /// Returns the largest |u| \[m\].
    pub fn largest(&self) -> f64 {
        self.positive.max(self.negative)
    }

    /// Returns the largest |u| on the side of `sign` \[m\].
    pub fn of(&self, sign: f64) -> f64 {
        if sign < 0.0 { self.negative } else { self.positive }
    }

    /// Raises the peaks to a displacement \[m\].
    pub fn include(&mut self, displacement: f64) {
        self.positive = self.positive.max(displacement);
        self.negative = self.negative.max(-displacement);
    }

    /// Returns whether the peaks cover a range of u.
    pub(super) fn cover(&self, lowest: f64, highest: f64) -> bool {
        highest <= self.positive && -lowest <= self.negative
    }
}

/// The state of a wall: plain data, copied to save it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Displacement u \[m\].
    pub displacement: f64,
    /// Velocity u̇ \[m/s\].
    pub velocity: f64,
    /// Index of the branch that the wall is on. At a corner it determines the side.
    pub branch: usize,
    /// Whether the wall moves.
    pub phase: Phase,
    /// |u| has exceeded `u_ins` of its side.
    pub overturned: bool,
    /// The wall has left its supports.
    pub departed: bool,
    /// Extremes of u so far, turning points included.
    pub peaks: Peaks,
    /// What the ties remember. `branch` is one of the wall with this memory.
    pub tie: TieMemory,
}

impl State {
    /// Returns the largest |u| and |u|/`u_ins` as results report them, see [`reported_peak`] \[m, -\].
    pub fn reported_peak(&self, u_ins: Sides, falls: bool) -> [f64; 2] {
        let peak = [self.peaks.largest(), self.peaks.ratio(u_ins)];
        reported_peak(peak, u_ins.of(self.displacement), falls)
    }
}

/// Returns the largest |u| and |u|/`u_ins` as results report them \[m, -\], from those of the motion: for a
/// wall that falls they are `u_ins` of its side and 1, because the displacement beyond does not measure the
/// motion (docs/model.md, Overturning).
pub fn reported_peak(peak: [f64; 2], u_ins: f64, falls: bool) -> [f64; 2] {
    if falls { [u_ins, 1.0] } else { peak }
}

/// What a segment did besides changing the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Time of the first overturning after the start of the segment \[s\].
    pub overturning: Option<f64>,
    /// Time and velocity at which the wall left its supports in this segment \[s, m/s\].
    pub departure: Option<[f64; 2]>,
    /// Times at which the tie of each side, u > 0 first, broke in this segment \[s\].
    pub fractures: [Option<f64>; 2],
    /// ∫G dt without the couple of a drift, while the wall is on its supports \[N s\]; 0 unless requested.
    pub couple_impulse: f64,
    /// The limit on impacts was reached, and the wall was put to rest.
    pub put_to_rest: bool,
    /// Work done.
    pub work: Work,
}

/// Work counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Work {
    /// Pieces of motion evaluated.
    pub pieces: u64,
    /// Changes of branch.
    pub corners: u64,
    /// Passages of u = 0 with restitution.
    pub impacts: u64,
}

impl Work {
    /// Adds further work.
    pub fn add(&mut self, other: Self) {
        self.pieces = self.pieces.saturating_add(other.pieces);
        self.corners = self.corners.saturating_add(other.corners);
        self.impacts = self.impacts.saturating_add(other.impacts);
    }
}

/// Integration failed inside a segment; the state is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum SolverError {
    /// Too many pieces in one segment, or a search without an end.
    #[error(
        "{fault} {reached:?} s into a step of {duration:?} s (u = {displacement:?} m, \
         u_dot = {velocity:?} m/s); use smaller steps (`output_step` of a scene), and check that the \
         accelerations and parameters are those meant"
    )]
    NotFollowed { fault: &'static str, reached: f64, duration: f64, displacement: f64, velocity: f64 },
    /// Overflow.
    #[error(
        "the motion exceeded the range of floating-point numbers {reached:?} s into a step of {duration:?} s \
         (u = {displacement:?} m, u_dot = {velocity:?} m/s, forcing {forcing:?} m/s2); \
         check the accelerations given"
    )]
    NotFinite { reached: f64, duration: f64, displacement: f64, velocity: f64, forcing: f64 },
}
