//! What lanes do side by side: plain steps, four at once, and the steps of those that wait.

use super::super::Forcing;
use super::super::stretches::AT_ONCE;
use super::corners::{Arrival, Leaving};
use super::lanes::Lanes;
use super::responses::{By, ROWS_AHEAD};
use super::vector::{Row, Vector, WIDTH};

/// Lanes that go on by plain steps while the others wait, at most: a round of those that wait costs as much as some thirty of
/// plain steps, however few they are.
const FEW: u32 = 1;

impl<F: Forcing> Lanes<'_, F> {
    /// Lanes that are not worth going on for, of those that have a run.
    pub(super) fn few(&self) -> u32 {
        FEW.min(self.busy.count_ones().saturating_sub(1))
    }

    /// Where the lanes may go, and which of them may take plain steps.
    #[inline(always)]
    pub(super) fn measure_ranges<V: Vector>(&mut self) {
        let step = self.batch.solver.step;
        let rows = &mut self.rows;
        let branch = self.responses.of(V::load(&rows.branch));
        let driving = V::load(&rows.driving);
        let braked = driving + branch.by(By::Braking) * driving;
        let [most, most4] = [By::Growth, By::Growth4].map(|growth| branch.by(growth) * braked);
        let step4 = AT_ONCE as f64 * step;
        let (margin, margin4) =
            (V::splat(0.125 * step * step) * most, V::splat(0.125 * step4 * step4) * most4);
        let lower = branch.by(By::Lower).max(V::load(&rows.known[0]));
        let upper = branch.by(By::Upper).min(V::load(&rows.known[1]));
        let (low, high) = (lower + margin4, upper - margin4);
        let fastest = branch.by(By::Speed) * driving;
        (lower + margin).store(&mut rows.range[0]);
        (upper - margin).store(&mut rows.range[1]);
        low.store(&mut rows.range4[0]);
        high.store(&mut rows.range4[1]);
        fastest.store(&mut rows.fastest);
        (V::splat(step) * most).store(&mut rows.slow);
        let (u, speed) = (V::load(&rows.u), V::load(&rows.v).abs());
        let inside = low.at_most(u) & u.at_most(high);
        // as fast as that, u̇ keeps its sign over four steps: then u is between its values at their ends
        let steady = (V::splat(step4) * most4).at_most(speed) & lower.at_most(u) & u.at_most(upper);
        let ready = (inside | steady) & speed.at_most(fastest);
        let index = V::load(&rows.index);
        self.sort(u, index, ready);
    }

    /// Finds out which lanes may go on, and which wait for what.
    #[inline(always)]
    fn sort<V: Vector>(&mut self, u: V, index: V, ready: V::Mask) {
        let open = index.below(V::load(&self.rows.limit));
        self.ready = V::bits(ready & open) & self.busy;
        self.ended = V::bits(!open) & self.busy;
        self.grown = V::bits(V::load(&self.rows.half_reach).below(u.abs()));
    }

    /// Plain steps, four at once, until all lanes but a few wait.
    ///
    /// Lanes that wait are taken along, and what they come to is not kept: so no step waits for a comparison.
    #[inline(always)]
    pub(super) fn plain<V: Vector>(&mut self) {
        let responses = self.responses;
        let few = self.few();
        let rows = &mut self.rows;
        let branch = responses.of(V::load(&rows.branch));
        let start = V::load(&rows.index);
        let room = V::load(&rows.limit) - start;
        let (samples, first_rows) = (start.whole(), branch.by(By::Response).whole());
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers, none negative"
        )]
        let ahead: [&[[f64; 2]]; WIDTH] =
            std::array::from_fn(|i| responses.ahead(first_rows[i] as usize, samples[i] as usize));
        let (uu, uv, u_force) = (branch.by(By::UByU4), branch.by(By::UByV4), branch.by(By::UByForce4));
        let (vu, vv, v_force) = (branch.by(By::VByU4), branch.by(By::VByV4), branch.by(By::VByForce4));
        let factor = V::load(&rows.factor);
        let (low, high, fastest) =
            (V::load(&rows.range4[0]), V::load(&rows.range4[1]), V::load(&rows.fastest));
        let at_once = V::splat(AT_ONCE as f64);
        let mut goes = V::mask(self.ready);
        let (mut u, mut v) = (V::load(&rows.u), V::load(&rows.v));
        let (mut kept_u, mut kept_v, mut kept_gone) = (u, v, V::splat(0.0));
        let started = goes;
        let known_nodes = [V::load(&rows.highest), V::load(&rows.lowest)];
        let (mut highest, mut lowest) = (known_nodes[0].max(u), known_nodes[1].min(u));
        let mut gone = V::splat(0.0);
        #[allow(clippy::needless_range_loop, reason = "eight tables at once")]
        for row in 0..ROWS_AHEAD {
            let [of_u, of_v] = V::unzip(std::array::from_fn(|i| &ahead[i][row]));
            let next_u = u + ((factor * of_u + u_force) + (uu * u + uv * v));
            v = v + ((factor * of_v + v_force) + (vu * u + vv * v));
            u = next_u;
            goes = goes & low.at_most(u) & u.at_most(high) & v.abs().at_most(fastest) & gone.below(room);
            gone = gone + at_once;
            kept_u = V::choose(goes, u, kept_u);
            kept_v = V::choose(goes, v, kept_v);
            kept_gone = V::choose(goes, gone, kept_gone);
            highest = highest.max(kept_u);
            lowest = lowest.min(kept_u);
            if V::bits(goes).count_ones() <= few {
                break;
            }
        }
        kept_u.store(&mut rows.u);
        kept_v.store(&mut rows.v);
        V::choose(started, highest, known_nodes[0]).store(&mut rows.highest);
        V::choose(started, lowest, known_nodes[1]).store(&mut rows.lowest);
        let index = start + kept_gone;
        index.store(&mut rows.index);
        self.sort(kept_u, index, goes);
    }

    /// One to four steps of lanes that wait, plain ones and at last one that passes a corner; tells which made none.
    #[inline(always)]
    pub(super) fn step<V: Vector>(&mut self, waiting: u8) -> u8 {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let responses = self.responses;
        let rows = &mut self.rows;
        let branches = V::load(&rows.branch);
        let branch = responses.of(branches);
        let (uu, uv, u0, u1) =
            (branch.by(By::UByU), branch.by(By::UByV), branch.by(By::UByP0), branch.by(By::UByP1));
        let (vu, vv, v0, v1) =
            (branch.by(By::VByU), branch.by(By::VByV), branch.by(By::VByP0), branch.by(By::VByP1));
        let (lower, upper, force) = (branch.by(By::Lower), branch.by(By::Upper), branch.by(By::Force));
        let known = [V::load(&rows.known[0]), V::load(&rows.known[1])];
        let (low, high) = (V::load(&rows.range[0]), V::load(&rows.range[1]));
        let (fastest, slow) = (V::load(&rows.fastest), V::load(&rows.slow));
        let holds = |u: V, v: V| low.at_most(u) & u.at_most(high) & v.abs().at_most(fastest);
        let index = V::load(&rows.index);
        let samples = index.whole();
        // lanes that do not wait may be near the end
        let furthest = self.batch.forcing.count() - 1 - AT_ONCE;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers, none negative"
        )]
        let samples: [&[f64]; WIDTH] = std::array::from_fn(|i| {
            self.batch.forcing.from((samples[i] as usize).min(furthest), AT_ONCE + 1)
        });
        let factor = V::load(&rows.factor);
        let forcing = |n: usize| factor * V::load(&Row(std::array::from_fn(|i| samples[i][n])));

        let (mut u, mut v, mut count) = (V::load(&rows.u), V::load(&rows.v), zero);
        let (mut from, mut p0) = ([u, v], forcing(0));
        let mut from_holds = holds(u, v);
        let waits = V::mask(waiting);
        let mut goes = waits;
        let known_nodes = [V::load(&rows.highest), V::load(&rows.lowest)];
        let (mut highest, mut lowest) = (known_nodes[0].max(u), known_nodes[1].min(u));
        let mut leaving = V::mask(0);
        let (mut beyond, mut ends) = ([zero; 2], [zero; 2]);
        for n in 1..=AT_ONCE {
            let p1 = forcing(n);
            let (q0, q1) = (p0 - force, p1 - force);
            let to = [
                from[0] + ((u0 * q0 + u1 * q1) + (uu * from[0] + uv * from[1])),
                from[1] + ((v0 * q0 + v1 * q1) + (vu * from[0] + vv * from[1])),
            ];
            let to_holds = holds(to[0], to[1]);
            let inside = lower.below(to[0]) & to[0].below(upper);
            let (speed0, speed1) = (from[1].abs(), to[1].abs());
            let steady = zero.below(from[1] * to[1])
                & slow.below(speed0 + speed1)
                & speed0.max(speed1).at_most(fastest)
                & known[0].at_most(from[0].min(to[0]))
                & from[0].max(to[0]).at_most(known[1]);
            let stays = goes & ((from_holds & to_holds) | (inside & steady));
            let leaves = goes & !stays & !inside;
            leaving = leaving | leaves;
            beyond = [V::choose(leaves, to[0], beyond[0]), V::choose(leaves, to[1], beyond[1])];
            ends = [V::choose(leaves, p0, ends[0]), V::choose(leaves, p1, ends[1])];
            u = V::choose(stays, to[0], u);
            v = V::choose(stays, to[1], v);
            count = V::choose(stays, count + one, count);
            (highest, lowest) = (highest.max(u), lowest.min(u));
            goes = stays;
            if V::bits(goes) == 0 {
                break;
            }
            (from, p0, from_holds) = (to, p1, to_holds);
        }
        if V::bits(leaving) != 0 {
            let leaving = Leaving {
                lanes: leaving,
                branch: branches,
                from: [u, v],
                to: beyond,
                forcing: ends,
                largest_forcing: V::load(&rows.largest_forcing),
                known,
                step: V::splat(self.batch.solver.step),
                inverse_step: V::splat(1.0 / self.batch.solver.step),
            };
            let Arrival { lanes, end, branch } = leaving.pass(responses);
            u = V::choose(lanes, end[0], u);
            v = V::choose(lanes, end[1], v);
            count = V::choose(lanes, count + one, count);
            V::choose(lanes, branch, branches).store(&mut rows.branch);
            let corners = V::load(&rows.corners);
            V::choose(lanes, corners + one, corners).store(&mut rows.corners);
        }
        V::choose(waits, highest.max(u), known_nodes[0]).store(&mut rows.highest);
        V::choose(waits, lowest.min(u), known_nodes[1]).store(&mut rows.lowest);
        u.store(&mut rows.u);
        v.store(&mut rows.v);
        (index + count).store(&mut rows.index);
        V::bits(count.below(one)) & waiting
    }
}
