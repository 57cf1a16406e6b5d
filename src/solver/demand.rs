//! Demands on a wall: extremes with their times, first crossings of limit states, half cycles.
//!
//! They are found on each piece of the motion, not at samples. On a piece of length L every quantity g watched has a bound M on
//! |g̈|, so that between two instants δ apart g ≤ max(g₀, g₁) + M δ²/8. Intervals whose bound does not exceed the extreme
//! so far are dropped, the others halved, until the bound is met within [`ACCURACY`].

use crate::wall::{Body, Support, Wall};

use super::event::{self, Ending, Kinematics, Piece, SearchExhausted};
use super::state::{Peaks, Segment};

/// Error of an extreme over the size of the terms it is a sum of; its time is then good to about 1e-6 of the time scale of the
/// motion around it.
pub const ACCURACY: f64 = 1e-12;
/// Intervals of one search after which its tolerance doubles, each time again: hundreds of undamped oscillations in one step, all of
/// one height, are not worth twelve digits each.
const PATIENCE: u32 = 1 << 14;
/// Intervals of one search: by then the tolerance is a million times the value.
const MOST_INTERVALS: u32 = 60 * PATIENCE;
/// Intervals that wait for their turn at once.
const DEEPEST: usize = 64;

/// A value and when it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// The value, in SI units.
    pub value: f64,
    /// Time \[s\].
    pub time: f64,
}

/// The highest and the lowest value of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// The highest value.
    pub highest: Instant,
    /// The lowest value.
    pub lowest: Instant,
}

impl Extremes {
    fn at(value: f64, time: f64) -> Self {
        let instant = Instant { value, time };
        Self { highest: instant, lowest: instant }
    }

    /// The one of the larger size; the highest where both are alike.
    #[must_use]
    pub fn largest(&self) -> Instant {
        if self.lowest.value.abs() > self.highest.value.abs() { self.lowest } else { self.highest }
    }

    fn include(&mut self, value: f64, time: f64) {
        if value > self.highest.value {
            self.highest = Instant { value, time };
        }
        if value < self.lowest.value {
            self.lowest = Instant { value, time };
        }
    }
}

/// The first time |u| reaches a fraction of `u_ins` of its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Fraction of `u_ins` \[-\].
    pub fraction: f64,
    /// When, and u with its sign \[m\]; `None` if it never did.
    pub first: Option<Instant>,
}

/// What a motion asks of a wall, up to overturning.
#[derive(Clone, Debug, PartialEq)]
pub struct Demands {
    /// u \[m\].
    pub displacement: Extremes,
    /// u̇ \[m/s\].
    pub velocity: Extremes,
    /// ü \[m/s²\].
    pub acceleration: Extremes,
    /// Force of the bottom support on the wall \[N\].
    pub reaction_bottom: Extremes,
    /// Force of the top support on the wall \[N\]; 0 for a parapet.
    pub reaction_top: Extremes,
    /// First crossings, in the order of the fractions asked for.
    pub crossings: Vec<Crossing>,
    /// Rocking half cycles: excursions beyond the elastic branch with a passage of u = 0 between them; for the rigid-linear law
    /// each motion away from u = 0.
    pub half_cycles: u64,
    /// An excursion that u = 0 has not ended yet, by its sign.
    excursion: Option<f64>,
}

/// A state and the forces of the supports, where watching begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub(crate) time: f64,
    pub(crate) motion: [f64; 3],
    pub(crate) reactions: crate::wall::Ends,
}

impl Demands {
    /// Nothing but the start: `fractions` of `u_ins` whose first crossings are wanted.
    pub(crate) fn new(wall: &Wall, start: &Start, fractions: &[f64]) -> Self {
        let Start { time, motion: [displacement, velocity, acceleration], reactions } = *start;
        let reach = displacement.abs() / wall.body().instability.of(displacement);
        let crossing = |&fraction: &f64| Crossing {
            fraction,
            first: (reach >= fraction).then_some(Instant { value: displacement, time }),
        };
        Self {
            displacement: Extremes::at(displacement, time),
            velocity: Extremes::at(velocity, time),
            acceleration: Extremes::at(acceleration, time),
            reaction_bottom: Extremes::at(reactions.bottom, time),
            reaction_top: Extremes::at(reactions.top, time),
            crossings: fractions.iter().map(crossing).collect(),
            half_cycles: 0,
            excursion: None,
        }
    }
}

/// Demands being collected over one segment.
pub(super) struct Watch<'a> {
    pub(super) demands: &'a mut Demands,
    pub(super) wall: &'a Wall,
    pub(super) segment: &'a Segment,
    /// Time at the start of the segment \[s\].
    pub(super) time: f64,
    /// Whether the couple of a drift acts.
    pub(super) drift: bool,
}

/// A piece of motion that has been followed to an end.
pub(super) struct Stretch<'a, P> {
    pub(super) piece: &'a P,
    /// Its branch.
    pub(super) branch: usize,
    /// Its start within the segment \[s\].
    pub(super) from: f64,
    /// How far it was followed \[s\].
    pub(super) length: f64,
    /// u there, at a corner that of the corner \[m\].
    pub(super) displacement: f64,
}

/// A quantity on a piece: how it follows from the motion, the bound on its second derivative, and the size of its terms.
struct Quantity<F> {
    value: F,
    curvature: f64,
    size: f64,
}

impl Watch<'_> {
    /// The supports at a time within the segment.
    fn support(&self, offset: f64) -> Support {
        let Segment { duration, from, to } = *self.segment;
        from.towards(to, if duration > 0.0 { (offset / duration).min(1.0) } else { 0.0 })
    }

    /// The wall stands still from one time within the segment to another: forces are linear in between.
    pub(super) fn rest(&mut self, from: f64, to: f64) {
        for offset in [from, to] {
            let (support, time) = (self.support(offset), self.time + offset);
            let reactions = self.wall.body().reactions(support, 0.0, 0.0, self.drift);
            self.demands.acceleration.include(0.0, time);
            self.demands.reaction_bottom.include(reactions.bottom, time);
            self.demands.reaction_top.include(reactions.top, time);
        }
    }

    /// A piece of motion.
    #[inline(never)]
    pub(super) fn piece<P: Piece>(&mut self, stretch: &Stretch<'_, P>) -> Result<(), SearchExhausted> {
        let &Stretch { piece, length, from, .. } = stretch;
        let search = Search::new(piece, length, [self.time, from]);
        let (acceleration, jerk) = piece.bounds(search.seen[0].1, length);
        let snap = piece.snap((acceleration, jerk));
        let demands = &mut *self.demands;
        let [u, v, a]: [fn(&Kinematics) -> f64; 3] = [|m| m.displacement, |m| m.velocity, |m| m.acceleration];
        for (extremes, pick, curvature) in [
            (&mut demands.displacement, u, acceleration),
            (&mut demands.velocity, v, jerk),
            (&mut demands.acceleration, a, snap),
        ] {
            let value = |_: f64, motion: &Kinematics| pick(motion);
            search.raise(extremes, &Quantity { value, curvature, size: search.largest(pick) })?;
        }
        self.forces(&search, acceleration, snap)?;
        self.cross(stretch)?;
        self.count(stretch)
    }

    /// Reactions over a piece, on which the accelerations of the supports are linear.
    fn forces<P: Piece>(
        &mut self,
        search: &Search<'_, P>,
        acceleration: f64,
        snap: f64,
    ) -> Result<(), SearchExhausted> {
        let (body, drift) = (self.wall.body(), self.drift);
        let Segment { duration, from, to } = *self.segment;
        let reactions = |offset: f64, motion: &Kinematics| {
            let part = if duration > 0.0 { ((search.from + offset) / duration).min(1.0) } else { 0.0 };
            body.reactions(from.towards(to, part), motion.acceleration, motion.displacement, drift)
        };
        let largest = |pick: fn(&Support) -> f64| pick(&from).abs().max(pick(&to).abs());
        let given = largest(|support| support.bottom) + largest(|support| support.top);
        let terms = Terms::of(body, drift);
        let [by_u, by_a] = [search.largest(|m| m.displacement), search.largest(|m| m.acceleration)];
        for (end, extremes) in
            [&mut self.demands.reaction_bottom, &mut self.demands.reaction_top].into_iter().enumerate()
        {
            let value = |offset: f64, motion: &Kinematics| {
                let forces = reactions(offset, motion);
                if end == 0 { forces.bottom } else { forces.top }
            };
            let (slope_a, slope_u) = (terms.acceleration[end], terms.displacement[end]);
            let curvature = slope_a * snap + slope_u * acceleration;
            let size = slope_a * (by_a + given) + slope_u * by_u;
            search.raise(extremes, &Quantity { value, curvature, size })?;
        }
        Ok(())
    }

    /// First crossings on a piece.
    fn cross<P: Piece>(&mut self, stretch: &Stretch<'_, P>) -> Result<(), SearchExhausted> {
        let start = self.time;
        let u_ins = self.wall.body().instability;
        let Demands { displacement: reached, crossings, .. } = &mut *self.demands;
        for crossing in crossings.iter_mut().filter(|crossing| crossing.first.is_none()) {
            let limits = [-crossing.fraction * u_ins.negative, crossing.fraction * u_ins.positive];
            let extremes = [reached.lowest.value, reached.highest.value];
            let is_end = stretch.displacement <= limits[0] || stretch.displacement >= limits[1];
            if extremes[0] > limits[0] && extremes[1] < limits[1] && !is_end {
                continue;
            }
            let mut peaks = Peaks::at(stretch.piece.start().displacement);
            let ending = event::follow(stretch.piece, limits, &mut peaks)?;
            let (offset, upwards) = match ending {
                Ending::Exit(exit) if exit.time <= stretch.length => (exit.time, exit.upwards),
                // at the end itself, within rounding
                _ => (stretch.length, stretch.displacement > 0.0),
            };
            crossing.first =
                Some(Instant { value: limits[usize::from(upwards)], time: start + (stretch.from + offset) });
        }
        Ok(())
    }

    /// Half cycles: an excursion begins where the motion leaves the elastic branch, and ends at u = 0.
    fn count<P: Piece>(&mut self, stretch: &Stretch<'_, P>) -> Result<(), SearchExhausted> {
        let branch = &self.wall.branches()[stretch.branch];
        let start = stretch.piece.start();
        let elastic = !self.wall.is_rigid() && branch.lower <= 0.0 && branch.upper >= 0.0;
        let demands = &mut *self.demands;
        if !elastic {
            if self.wall.is_rigid() && start.displacement == 0.0 {
                demands.excursion = None;
            }
            let sign = if branch.lower + branch.upper < 0.0 { -1.0 } else { 1.0 };
            if demands.excursion != Some(sign) {
                demands.excursion = Some(sign);
                demands.half_cycles += 1;
            }
            return Ok(());
        }
        let Some(sign) = demands.excursion else { return Ok(()) };
        if sign * start.displacement <= 0.0 || sign * stretch.displacement <= 0.0 {
            demands.excursion = None;
            return Ok(());
        }
        // there and back within one piece
        let limits = if sign > 0.0 { [0.0, f64::INFINITY] } else { [f64::NEG_INFINITY, 0.0] };
        let mut peaks = Peaks::at(start.displacement);
        if let Ending::Exit(exit) = event::follow(stretch.piece, limits, &mut peaks)?
            && exit.time <= stretch.length
        {
            demands.excursion = None;
        }
        Ok(())
    }
}

/// |∂R/∂ü| and |∂R/∂u| of the bottom and the top reaction.
struct Terms {
    acceleration: [f64; 2],
    displacement: [f64; 2],
}

impl Terms {
    fn of(body: &Body, drift: bool) -> Self {
        let sizes = |acceleration: f64, displacement: f64| {
            let forces = body.reactions(Support::default(), acceleration, displacement, drift);
            [forces.bottom.abs(), forces.top.abs()]
        };
        Self { acceleration: sizes(1.0, 0.0), displacement: sizes(0.0, 1.0) }
    }
}

/// Instants of a piece looked at first: they tell the size of what varies on it.
const FIRST: usize = 5;

/// A piece to search up to a length; it starts `from` after the `time` of its segment.
struct Search<'a, P> {
    piece: &'a P,
    time: f64,
    from: f64,
    seen: [(f64, Kinematics); FIRST],
}

#[derive(Clone, Copy)]
struct Node {
    offset: f64,
    value: f64,
}

impl<'a, P: Piece> Search<'a, P> {
    fn new(piece: &'a P, length: f64, [time, from]: [f64; 2]) -> Self {
        let seen = std::array::from_fn(|index| match index {
            0 => (0.0, piece.start()),
            _ if index + 1 == FIRST => (length, piece.at(length)),
            _ => {
                let offset = length * (index as f64 / (FIRST - 1) as f64);
                (offset, piece.at(offset))
            }
        });
        Self { piece, time, from, seen }
    }

    fn largest(&self, pick: fn(&Kinematics) -> f64) -> f64 {
        self.seen.iter().map(|(_, motion)| pick(motion).abs()).fold(0.0, f64::max)
    }

    /// Takes up what exceeds the extremes so far.
    fn raise<F: Fn(f64, &Kinematics) -> f64>(
        &self,
        extremes: &mut Extremes,
        quantity: &Quantity<F>,
    ) -> Result<(), SearchExhausted> {
        if let Some(instant) = self.highest(1.0, extremes.highest.value, quantity)? {
            extremes.highest = instant;
        }
        if let Some(Instant { value, time }) = self.highest(-1.0, -extremes.lowest.value, quantity)? {
            extremes.lowest = Instant { value: -value, time };
        }
        Ok(())
    }

    /// The highest value of `sign` times a quantity, if it exceeds `best`.
    fn highest<F: Fn(f64, &Kinematics) -> f64>(
        &self,
        sign: f64,
        best: f64,
        quantity: &Quantity<F>,
    ) -> Result<Option<Instant>, SearchExhausted> {
        let node = |offset: f64, motion: &Kinematics| Node {
            offset,
            value: sign * (quantity.value)(offset, motion),
        };
        let mut found = Node { offset: f64::NAN, value: best };
        let mut left = node(0.0, &self.seen[0].1);
        // from right to left: the first interval is the last in
        let mut pending = [left; DEEPEST];
        for (place, (offset, motion)) in pending.iter_mut().zip(self.seen[1..].iter().rev()) {
            *place = node(*offset, motion);
        }
        let mut count = FIRST - 1;
        for node in [left].iter().chain(&pending[..count]) {
            if node.value > found.value {
                found = *node;
            }
        }
        for visited in 0..MOST_INTERVALS {
            let Some(index) = usize::checked_sub(count, 1) else {
                let time = self.time + (self.from + found.offset);
                return Ok((found.value > best).then_some(Instant { value: found.value, time }));
            };
            let right = pending[index];
            let width = right.offset - left.offset;
            let most = left.value.max(right.value) + 0.125 * width * width * quantity.curvature;
            // a sum that cancels is not worth more digits than its terms have
            let patience = 2.0_f64.powi((visited / PATIENCE).cast_signed());
            let tolerance = patience * ACCURACY * quantity.size.max(found.value.abs());
            if most <= found.value + tolerance || count == DEEPEST {
                (left, count) = (right, index);
                continue;
            }
            let offset = 0.5 * (left.offset + right.offset);
            let middle = node(offset, &self.piece.at(offset));
            if middle.value > found.value {
                found = middle;
            }
            pending[count] = middle;
            count += 1;
        }
        Err(SearchExhausted)
    }
}
