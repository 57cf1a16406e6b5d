//! A floor in time: from corner to corner in closed form.
//!
//! ```
//! use rocking_floor::floor::{Floor, Parameters};
//! use rocking_floor::motion::{Load, FloorState};
//!
//! let undamped = Parameters { mass: 1e4, stiffness: 1e6, damping_ratio: 0.0, ..Parameters::default() };
//! let floor = Floor::new(&undamped)?;
//! let mut state = FloorState::new(&floor, 0.01, 0.0, Load::default());
//! // half a period later it is on the other side
//! state.advance(&floor, Load::default(), std::f64::consts::PI / floor.omega())?;
//! assert!((state.displacement + 0.01).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use oscillator::KinematicState;

use crate::floor::{Branch, Floor, Yielding};
use crate::piece::Piece;

/// State of a floor: plain data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorState {
    /// Displacement relative to the base \[m\].
    pub displacement: f64,
    /// Velocity relative to the base \[m/s\].
    pub velocity: f64,
    /// Displacement at which the elasto-plastic element is free of force \[m\].
    pub plastic: f64,
    /// Branch of the spring's law.
    pub branch: Branch,
    /// Energy lost by damping \[J\].
    pub damping_energy: f64,
    /// Energy lost by yielding \[J\].
    pub hysteretic_energy: f64,
}

/// Acceleration that the load alone gives the mass, linear in time: −`a_g` − Σ rᵢ/M.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// At the start \[m/s²\].
    pub value: f64,
    /// \[m/s³\]
    pub rate: f64,
}

/// A step that cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum MotionError {
    /// More spans of monotonic velocity in one step than the solver follows.
    #[error(
        "the floor turns more than {MOST_SPANS} times in one step of {duration} s; use smaller steps, or a \
         lower stiffness or a larger mass"
    )]
    TooManySpans { duration: f64 },
    /// The displacement or velocity has overflowed.
    #[error(
        "the motion is no longer finite; the inputs are too large for mass = {mass} kg: \
         reduce them or the step"
    )]
    NotFinite { mass: f64 },
}

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Corners of the hysteresis that were passed.
    pub corners: usize,
    /// Spans of monotonic velocity in which corners were looked for.
    pub spans: usize,
}

/// Most spans that are followed in one step.
///
/// A floor with a natural frequency of 1000 rad/s turns as often in 160 s. A span takes up to 5 µs, so that
/// no step takes half a second.
pub const MOST_SPANS: usize = 50_000;

/// By how much a spring may be beyond its limit before it yields, relative to the displacements.
///
/// They are rounded, so that at rest at the limit the two branches give accelerations of different signs:
/// without the slack a floor there would go from one branch to the other without end. The acceleration of the
/// elastic branch is then off by the spring's rate times some 3 ε of the displacements, and the spring swings
/// by twice that.
const SLACK: f64 = 16.0 * f64::EPSILON;

impl FloorState {
    /// Makes the state of a floor that has reached a displacement \[m\] by monotonic loading and has a
    /// velocity \[m/s\], under a load.
    pub fn new(floor: &Floor, displacement: f64, velocity: f64, load: Load) -> Self {
        let plastic = floor.yielding.map_or(0.0, |yielding| {
            displacement - displacement.clamp(-yielding.displacement, yielding.displacement)
        });
        let branch = Branch::Elastic;
        let mut state =
            Self { displacement, velocity, plastic, branch, damping_energy: 0.0, hysteretic_energy: 0.0 };
        state.branch = state.branch_ahead(floor, load);
        state
    }

    /// Computes the acceleration relative to the base \[m/s²\].
    // Not inlined: with a neighbouring division the compiler would form a vector division whose unused lane
    // is 0/0, and some hosts trap that.
    #[inline(never)]
    pub fn acceleration(&self, floor: &Floor, load: f64) -> f64 {
        load - (self.spring_force(floor) + floor.damping * self.velocity) / floor.mass
    }

    /// Computes the rate of the acceleration \[m/s³\] under a load of this rate.
    pub fn jerk(&self, floor: &Floor, load: Load) -> f64 {
        let acceleration = self.acceleration(floor, load.value);
        load.rate - (floor.tangent(self.branch) * self.velocity + floor.damping * acceleration) / floor.mass
    }

    /// Computes the force of the spring \[N\], positive towards −x.
    pub fn spring_force(&self, floor: &Floor) -> f64 {
        floor.spring_force(self.displacement, self.plastic, self.branch)
    }

    /// Moves through a step and returns what that took.
    ///
    /// # Errors
    /// When the step has too many spans or the result is not finite; the state is then unusable.
    pub fn advance(&mut self, floor: &Floor, load: Load, duration: f64) -> Result<Work, MotionError> {
        let (mut done, mut work) = (0.0, Work::default());
        // inputs may have changed since the last step
        self.branch = self.branch_ahead(floor, load);
        loop {
            let now = Load { value: load.value + load.rate * done, rate: load.rate };
            let remaining = duration - done;
            let piece = self.piece(floor, now);
            let corner = self.corner(floor, &piece, remaining, &mut work.spans);
            if work.spans > MOST_SPANS {
                return Err(MotionError::TooManySpans { duration });
            }
            let length = corner.map_or(remaining, |corner| corner.after);
            self.move_along(floor, &piece, length);
            let Some(Corner { branch, .. }) = corner else {
                let finite = self.displacement.is_finite() && self.velocity.is_finite();
                return if finite { Ok(work) } else { Err(MotionError::NotFinite { mass: floor.mass }) };
            };
            if branch == Branch::Elastic {
                // unloading starts at zero velocity; remove the rounding error of the crossing
                self.velocity = 0.0;
            }
            self.branch = branch;
            done += length;
            work.corners += 1;
        }
    }

    fn piece(&self, floor: &Floor, load: Load) -> Piece {
        let (velocity, acceleration) = (self.velocity, self.acceleration(floor, load.value));
        let start = KinematicState { displacement: 0.0, velocity, acceleration };
        Piece { oscillator: floor.oscillator(self.branch), start, rate: load.rate }
    }

    /// Moves along a piece of motion on one branch for `length` \[s\], and adds up the energy lost.
    fn move_along(&mut self, floor: &Floor, piece: &Piece, length: f64) {
        let (point, loss) = piece.with_loss(length);
        self.displacement += point.displacement;
        self.velocity = point.velocity;
        self.damping_energy += floor.mass * loss;
        if let (Some(yielding), true) = (floor.yielding, self.branch != Branch::Elastic) {
            self.hysteretic_energy += yielding.force * point.displacement.abs();
            self.plastic = self.displacement - self.branch.sign() * yielding.displacement;
        }
    }

    /// Finds the branch on which the motion continues. At the yield force that depends on the direction of
    /// motion.
    pub(crate) fn branch_ahead(&self, floor: &Floor, load: Load) -> Branch {
        let Some(Yielding { displacement: limit, .. }) = floor.yielding else { return Branch::Elastic };
        let deformation = self.displacement - self.plastic;
        let sign = match self.branch {
            Branch::Elastic if deformation >= limit => 1.0,
            Branch::Elastic if deformation <= -limit => -1.0,
            Branch::Elastic => return Branch::Elastic,
            yielding => yielding.sign(),
        };
        // The first of velocity, acceleration and jerk that is not zero gives the direction. Where the
        // velocity is zero, both branches give the same acceleration and jerk.
        let heading = [self.velocity, self.acceleration(floor, load.value), self.jerk(floor, load)];
        match heading.into_iter().map(|rate| sign * rate).find(|rate| *rate != 0.0) {
            Some(outward) if outward > 0.0 && sign > 0.0 => Branch::YieldingUp,
            Some(outward) if outward > 0.0 => Branch::YieldingDown,
            _ => Branch::Elastic,
        }
    }

    /// Finds the first corner within `remaining`, if there is one, and adds the spans that it looks at to
    /// `spans`. With more than [`MOST_SPANS`] it gives up.
    fn corner(&self, floor: &Floor, piece: &Piece, remaining: f64, spans: &mut usize) -> Option<Corner> {
        let Yielding { displacement: limit, .. } = floor.yielding?;
        let slack = SLACK * (self.displacement.abs() + self.plastic.abs() + limit);
        // A start within rounding beyond the limit that moves inwards has not crossed it.
        let upper = (self.plastic + limit - self.displacement).max(0.0) + slack;
        let lower = (self.plastic - limit - self.displacement).min(0.0) - slack;
        let (mut from, mut velocity) = (0.0, piece.start.velocity);
        for to in piece.monotonic_until(remaining) {
            *spans += 1;
            if *spans > MOST_SPANS {
                return None;
            }
            let at_end = piece.at(to).velocity;
            let turns = velocity * at_end < 0.0;
            if self.branch == Branch::Elastic {
                let turn = if turns { piece.crossing(from, to, |point| point.velocity) } else { to };
                for (start, end) in [(from, turn), (turn, to)] {
                    if let Some(corner) = yield_point(piece, start, end, lower, upper) {
                        return Some(corner);
                    }
                }
            } else if self.branch.sign() * at_end < 0.0 {
                let after = if turns { piece.crossing(from, to, |point| point.velocity) } else { from };
                return Some(Corner { after, branch: Branch::Elastic });
            }
            (from, velocity) = (to, at_end);
        }
        None
    }
}

/// A corner of the hysteresis.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Time to it \[s\].
    after: f64,
    /// The branch behind it.
    branch: Branch,
}

/// Finds the corner at which an elastic motion leaves the elastic range, in a span of monotonic motion.
fn yield_point(piece: &Piece, start: f64, end: f64, lower: f64, upper: f64) -> Option<Corner> {
    let reached = piece.at(end).displacement;
    if reached > upper {
        let after = piece.crossing(start, end, |point| point.displacement - upper);
        return Some(Corner { after, branch: Branch::YieldingUp });
    }
    if reached < lower {
        let after = piece.crossing(start, end, |point| point.displacement - lower);
        return Some(Corner { after, branch: Branch::YieldingDown });
    }
    None
}
