//! Collects demands on each piece of a motion.
//!
//! Demands are found on the pieces, not at samples. A step without events whose ends show them needs no
//! search.

use oscillator::KinematicState;

use crate::wall::{Branch, Couple, Ends, Support, Tie, TieAction, TieMemory, Wall};

use super::demand::{Demands, Instant, TieDemands};
use super::event::{self, Ending, Piece, SearchExhausted};
use super::state::{Peaks, Segment};

mod carried;
mod search;
#[cfg(test)]
mod tests;

use carried::Carried;
pub use search::ACCURACY;
use search::{ExtremeSearch, Quantity};

/// Demands being collected over one segment.
pub(super) struct Watch<'a> {
    pub(super) demands: &'a mut Demands,
    pub(super) wall: &'a Wall,
    pub(super) segment: &'a Segment,
    /// Time at the start of the segment \[s\].
    pub(super) time: f64,
}

/// A piece of motion that has been followed.
pub(super) struct Followed<'a, P> {
    pub(super) piece: &'a P,
    /// Its branch.
    pub(super) branch: usize,
    /// Its start within the segment \[s\].
    pub(super) from: f64,
    /// How far it was followed \[s\].
    pub(super) length: f64,
    /// u at its end; where that is a corner, the corner's own displacement \[m\].
    pub(super) displacement: f64,
}

impl Watch<'_> {
    /// Returns what goes on with the wall as its ties are now.
    pub(super) fn of<'a>(&'a mut self, wall: &'a Wall) -> Watch<'a> {
        let Self { segment, time, .. } = *self;
        Watch { demands: self.demands, wall, segment, time }
    }

    /// Includes a motion on a branch over the whole segment by its ends, from bounds on |ü| and on the jerk,
    /// and on the second derivative of ü. Returns `false` where it has to be searched. What has been included
    /// by then is part of it.
    #[inline]
    pub(super) fn include_ends(
        &mut self,
        branch: &Branch,
        is_overturned: bool,
        [from, to]: [KinematicState; 2],
        bounds: [f64; 3],
    ) -> bool {
        if !self.demands.ties.is_empty() && branch.tie != TieAction::None {
            return false;
        }
        if is_overturned {
            return true;
        }
        let length = self.segment.duration;
        let sag = 0.125 * length * length * bounds[0];
        // no half cycle begins or ends
        let is_counted = match (self.demands.excursion, branch.is_elastic()) {
            (None, is_elastic) => is_elastic,
            (Some(side), true) => side * from.displacement > sag && side * to.displacement > sag,
            (Some(side), false) => {
                side == branch.side() && !(self.wall.is_rigid() && from.displacement == 0.0)
            }
        };
        if !is_counted || self.reaches(to.displacement) {
            return false;
        }
        let supports = [self.segment.from, self.segment.to];
        // what is followed by its ends has small rotations
        let carried = Carried { ends: [from.acceleration, to.acceleration], most: bounds[2] };
        self.include_extremes(branch.couple, [from, to], carried, supports, [0.0, length], bounds)
    }

    /// Includes the extremes of a motion by its ends, which it reaches `from` after the start of the segment
    /// and a length of time later \[s\]. Returns `false` where some have to be searched; others may have been
    /// included by then.
    #[inline]
    fn include_extremes(
        &mut self,
        couple: Couple,
        [start, end]: [KinematicState; 2],
        carried: Carried,
        supports: [Support; 2],
        [from, length]: [f64; 2],
        [most_acceleration, most_jerk, most_snap]: [f64; 3],
    ) -> bool {
        let (share, times) = (0.125 * length * length, [self.time + from, self.time + (from + length)]);
        let [by_a, by_u] = self.slopes(couple);
        let at = |support: Support, motion: &KinematicState, carried: f64| {
            self.wall.body().reactions(support, carried, couple.at(motion.displacement))
        };
        let reactions = [at(supports[0], &start, carried.ends[0]), at(supports[1], &end, carried.ends[1])];
        let above = |a: f64, u: f64| share * (u.abs() * most_acceleration + a.abs() * carried.most);
        let Demands { displacement, velocity, acceleration, reaction_bottom, reaction_top, .. } =
            &mut *self.demands;
        displacement.include_ends([start.displacement, end.displacement], share * most_acceleration, times)
            && velocity.include_ends([start.velocity, end.velocity], share * most_jerk, times)
            && acceleration.include_ends([start.acceleration, end.acceleration], share * most_snap, times)
            && reaction_bottom.include_ends(
                reactions.map(|ends| ends.bottom),
                above(by_a.bottom, by_u.bottom),
                times,
            )
            && reaction_top.include_ends(reactions.map(|ends| ends.top), above(by_a.top, by_u.top), times)
    }

    /// Returns whether a displacement reaches a limit state that was never reached before.
    #[inline]
    fn reaches(&self, displacement: f64) -> bool {
        let u_ins = self.wall.body().instability.of(displacement);
        let mut crossings = self.demands.crossings.iter();
        crossings.any(|crossing| crossing.first.is_none() && displacement.abs() >= crossing.fraction * u_ins)
    }

    /// Returns ∂R/∂ü and ∂R/∂u of both reactions.
    #[inline]
    fn slopes(&self, couple: Couple) -> [Ends; 2] {
        let (body, still) = (self.wall.body(), Support::default());
        [body.reaction_changes(still, 1.0, 0.0), body.reaction_changes(still, 0.0, couple.slope)]
    }

    /// Includes a rest between two times within the segment. Forces are linear in between, but where the
    /// couple of a strip bends.
    pub(super) fn rest(&mut self, from: f64, to: f64) {
        let body = self.wall.body();
        let [start, end] = [from, to].map(|offset| body.forcing(self.segment.support(offset)));
        let bend = (self.wall.bends_at_rest() && start * end < 0.0)
            .then(|| from + (to - from) * (start / (start - end)));
        for offset in [from].into_iter().chain(bend).chain([to]) {
            let (support, time) = (self.segment.support(offset), self.time + offset);
            let forcing = body.forcing(support);
            let reactions = body.reactions(support, 0.0, self.wall.couple_at_rest(forcing).at(forcing));
            self.demands.acceleration.include(0.0, time);
            self.demands.reaction_bottom.include(reactions.bottom, time);
            self.demands.reaction_top.include(reactions.top, time);
        }
    }

    /// Includes a piece of motion.
    #[inline(never)]
    pub(super) fn piece<P: Piece>(&mut self, followed: &Followed<'_, P>) -> Result<(), SearchExhausted> {
        let search = Self::search_of(self.segment, self.time, followed);
        let (from, length) = (search.from, search.length);
        let supports = [from, from + length].map(|offset| self.segment.support(offset));
        let branch = &self.wall.branches()[followed.branch];
        let carried = Carried::new(self.wall, branch, search.ends, search.length, search.bounds);
        if !self.include_extremes(
            branch.couple,
            search.ends,
            carried,
            supports,
            [from, length],
            search.bounds,
        ) {
            self.search(&search, branch)?;
        }
        self.cross(followed)?;
        self.count(followed)
    }

    /// Prepares the search of a piece, or of its first period where it then only repeats.
    fn search_of<'p, P: Piece>(
        segment: &Segment,
        time: f64,
        &Followed { piece, length, from, .. }: &Followed<'p, P>,
    ) -> ExtremeSearch<'p, P> {
        let is_still = segment.from == segment.to;
        let length = if is_still { length.min(piece.period()) } else { length };
        ExtremeSearch::new(piece, length, [time, from])
    }

    /// Searches a piece for the extremes that its ends do not show.
    fn search<P: Piece>(
        &mut self,
        search: &ExtremeSearch<'_, P>,
        branch: &Branch,
    ) -> Result<(), SearchExhausted> {
        let demands = &mut *self.demands;
        let [u, v, a]: [fn(&KinematicState) -> f64; 3] =
            [|m| m.displacement, |m| m.velocity, |m| m.acceleration];
        for (extremes, pick, curvature) in [
            (&mut demands.displacement, u, [1.0, 0.0, 0.0, 0.0]),
            (&mut demands.velocity, v, [0.0, 1.0, 0.0, 0.0]),
            (&mut demands.acceleration, a, [0.0, 0.0, 1.0, 0.0]),
        ] {
            let value = |_: f64, motion: &KinematicState| pick(motion);
            search.raise(extremes, &Quantity { value, curvature, size: || search.largest(pick) })?;
        }
        self.forces(search, branch)
    }

    /// Includes the reactions over a piece, on which the accelerations of the supports are linear.
    fn forces<P: Piece>(
        &mut self,
        search: &ExtremeSearch<'_, P>,
        branch: &Branch,
    ) -> Result<(), SearchExhausted> {
        let (wall, body, segment, couple) = (self.wall, self.wall.body(), self.segment, branch.couple);
        let [by_a, by_u] = self.slopes(couple);
        let carried = carried::curvature(wall, branch, search.ends, search.length, search.bounds[0]);
        let largest = |pick: fn(&Support) -> f64| pick(&segment.from).abs().max(pick(&segment.to).abs());
        let given = largest(|support| support.bottom) + largest(|support| support.top);
        let picks: [fn(Ends) -> f64; 2] = [|ends| ends.bottom, |ends| ends.top];
        let Demands { reaction_bottom, reaction_top, .. } = &mut *self.demands;
        for (extremes, pick) in [reaction_bottom, reaction_top].into_iter().zip(picks) {
            let value = |offset: f64, motion: &KinematicState| {
                let support = segment.support(search.from + offset);
                let carried = wall.carried(branch.side(), *motion);
                pick(body.reactions(support, carried, couple.at(motion.displacement)))
            };
            let (slope_a, slope_u) = (pick(by_a).abs(), pick(by_u).abs());
            let mut curvature = carried.map(|share| slope_a * share);
            curvature[0] += slope_u;
            let size = || {
                let [most_u, most_a] =
                    [search.largest(|m| m.displacement), search.largest(|m| m.acceleration)];
                slope_a * (most_a + given)
                    + slope_u * most_u
                    + couple.at_zero.abs()
                    + body.contact.thrust.abs()
            };
            search.raise(extremes, &Quantity { value, curvature, size })?;
        }
        Ok(())
    }

    /// Enters the time at which ties have broken, as far into the segment as `offset` \[s\].
    pub(super) fn fracture(&mut self, memory: &TieMemory, offset: f64) {
        for (tie, demands) in self.wall.ties().iter().zip(&mut self.demands.ties) {
            demands.break_with(tie, memory, self.time + offset);
        }
    }

    /// Includes the forces of the ties over a piece, on which they are linear in u.
    #[inline(never)]
    pub(super) fn ties<P: Piece>(&mut self, followed: &Followed<'_, P>) -> Result<(), SearchExhausted> {
        if self.wall.branches()[followed.branch].tie == TieAction::None {
            return Ok(());
        }
        for (number, tie) in self.wall.ties().iter().enumerate() {
            self.tie(followed, tie, number)?;
        }
        Ok(())
    }

    fn tie<P: Piece>(
        &mut self,
        followed: &Followed<'_, P>,
        tie: &Tie,
        number: usize,
    ) -> Result<(), SearchExhausted> {
        let &Followed { piece, branch, from, length, displacement } = followed;
        let action = self.wall.tie_action(tie, branch);
        if action == TieAction::None {
            return Ok(());
        }
        let search = Self::search_of(self.segment, self.time, followed);
        let TieDemands { force, strength, .. } = &mut self.demands.ties[number];
        let limit = tie.strength.unwrap_or(f64::INFINITY);
        let hold = tie.hold(displacement, self.wall.tie_memory());
        let reached = if action == TieAction::Yields {
            Some(from)
        } else {
            // to rounding the force there may be another
            hold.filter(|hold| displacement.abs() == hold.yields).map(|_| from + length)
        };
        if let Some(reached) = reached {
            let instant = Instant { value: limit, time: self.time + reached };
            *strength = strength.or(Some(instant));
            if force.value < limit {
                *force = instant;
            }
            return Ok(());
        }
        let value = |_: f64, motion: &KinematicState| self.wall.force_of(tie, branch, motion.displacement);
        let slope = self.wall.slope_of(tie, branch);
        let size = || slope * search.largest(|m| m.displacement);
        let quantity = Quantity { value, curvature: [slope, 0.0, 0.0, 0.0], size };
        let Some(largest) = search.highest(1.0, force.value, &quantity)? else { return Ok(()) };
        *force = largest;
        let Some(reach) = tie.strength_displacement() else { return Ok(()) };
        if strength.is_none() && largest.value >= limit {
            let time = match event::find_ending(piece, [-reach, reach], &mut Peaks::at(0.0))? {
                Ending::Exit(exit) if exit.time <= length => self.time + (from + exit.time),
                // at the turning point itself, within rounding
                _ => largest.time,
            };
            *strength = Some(Instant { value: limit, time });
        }
        Ok(())
    }

    /// Includes the first crossings of limit states on a piece.
    fn cross<P: Piece>(&mut self, followed: &Followed<'_, P>) -> Result<(), SearchExhausted> {
        let start = self.time;
        let u_ins = self.wall.body().instability;
        let Demands { displacement: reached, crossings, .. } = &mut *self.demands;
        for crossing in crossings.iter_mut().filter(|crossing| crossing.first.is_none()) {
            let limits = [-crossing.fraction * u_ins.negative, crossing.fraction * u_ins.positive];
            let extremes = [reached.lowest.value, reached.highest.value];
            let is_end = followed.displacement <= limits[0] || followed.displacement >= limits[1];
            if extremes[0] > limits[0] && extremes[1] < limits[1] && !is_end {
                continue;
            }
            let mut peaks = Peaks::at(followed.piece.start().displacement);
            let ending = event::find_ending(followed.piece, limits, &mut peaks)?;
            let (offset, upwards) = match ending {
                Ending::Exit(exit) if exit.time <= followed.length => (exit.time, exit.upwards),
                // at the end itself, within rounding
                _ => (followed.length, followed.displacement > 0.0),
            };
            crossing.first =
                Some(Instant { value: limits[usize::from(upwards)], time: start + (followed.from + offset) });
        }
        Ok(())
    }

    /// Counts half cycles: an excursion begins where the motion leaves the elastic branch, and ends at u = 0.
    fn count<P: Piece>(&mut self, followed: &Followed<'_, P>) -> Result<(), SearchExhausted> {
        let branch = &self.wall.branches()[followed.branch];
        let start = followed.piece.start();
        let demands = &mut *self.demands;
        if !branch.is_elastic() {
            if self.wall.is_rigid() && start.displacement == 0.0 {
                demands.excursion = None;
            }
            let sign = branch.side();
            if demands.excursion != Some(sign) {
                demands.excursion = Some(sign);
                demands.half_cycles += 1;
            }
            return Ok(());
        }
        let Some(sign) = demands.excursion else { return Ok(()) };
        if sign * start.displacement <= 0.0 || sign * followed.displacement <= 0.0 {
            demands.excursion = None;
            return Ok(());
        }
        // there and back within one piece
        let limits = if sign > 0.0 { [0.0, f64::INFINITY] } else { [f64::NEG_INFINITY, 0.0] };
        let mut peaks = Peaks::at(start.displacement);
        if let Ending::Exit(exit) = event::find_ending(followed.piece, limits, &mut peaks)?
            && exit.time <= followed.length
        {
            demands.excursion = None;
        }
        Ok(())
    }
}
