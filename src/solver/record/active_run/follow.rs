//! Following a run: plain steps by pairs, and one by one what is not plain.

use super::super::super::secant::SecantBranch;
use super::super::super::{Phase, SolverError};
use super::super::solver::{Outcome, unseen};
use super::super::step_map::{AffineSteps, StepMap, Way};
use super::ActiveRun;

impl ActiveRun<'_> {
    /// Follows the run to its end; `observe` is shown u and u̇ at each sample after the first.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed.
    pub(in super::super) fn follow(
        &mut self,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<Outcome, SolverError> {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = fearless_simd::Level::new().as_avx2() {
            // its instructions take three operands; they round alike
            return fearless_simd::Simd::vectorize(
                avx2,
                #[inline(always)]
                || self.follow_steps(observe),
            );
        }
        self.follow_steps(observe)
    }

    #[inline(always)]
    fn follow_steps(&mut self, observe: &mut impl FnMut(usize, f64, f64)) -> Result<Outcome, SolverError> {
        loop {
            if let Some(outcome) = self.reach_plain_steps(observe)? {
                return Ok(outcome);
            }
            match self.map.map(|map| (map, &map.way)) {
                Some((map, Way::Affine(steps))) => self.take_pairs(map, steps, observe),
                Some((map, Way::Curved(secant))) if secant.is_ratio => {
                    self.take_curved::<true>(map, secant, observe);
                }
                Some((map, Way::Curved(secant))) => self.take_curved::<false>(map, secant, observe),
                None => {}
            }
            if self.cursor.index < self.cursor.limit {
                self.step(observe)?;
            }
        }
    }

    /// Follows the run until it is over or on a branch with secant damping, by one step at least if asked to;
    /// returns what became of it.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed.
    pub(in super::super) fn follow_to_curve(&mut self, step: bool) -> Result<Option<Outcome>, SolverError> {
        if step {
            self.step(&mut unseen)?;
        }
        loop {
            if let Some(outcome) = self.reach_plain_steps(&mut unseen)? {
                return Ok(Some(outcome));
            }
            match self.map.map(|map| (map, &map.way)) {
                Some((map, Way::Affine(steps))) => self.take_pairs(map, steps, &mut unseen),
                Some((_, Way::Curved(_))) => return Ok(None),
                None => {}
            }
            if self.cursor.index < self.cursor.limit {
                self.step(&mut unseen)?;
            }
        }
    }

    /// Goes on until plain steps may begin or the run is over; returns what became of it.
    #[inline(never)]
    fn reach_plain_steps(
        &mut self,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<Option<Outcome>, SolverError> {
        loop {
            if let Some(outcome) = self.next_block(observe) {
                return Ok(Some(outcome));
            }
            if let Some(map) = self.map
                && self.cursor.index < self.cursor.limit
                && (matches!(map.way, Way::Curved(_)) || self.range(map, 2).holds(self.now))
            {
                self.block.nodes.include(self.now[0]);
                return Ok(None);
            }
            self.step(observe)?;
        }
    }

    /// Takes plain steps, two at once, as long as there are.
    #[inline(always)]
    fn take_pairs(&mut self, map: &StepMap, steps: &AffineSteps, observe: &mut impl FnMut(usize, f64, f64)) {
        let first = self.cursor.index;
        let pairs = self.cursor.limit.saturating_sub(first).div_ceil(2);
        let ahead = self.record.forcing.from(first + 1, 2 * pairs).as_chunks().0;
        let shows = !self.seeks_extremes();
        let range = self.range(map, 2);
        // apart from the rest, so that they stay in registers
        let (single, double, force_at_zero) = (steps.single, steps.double, map.force_at_zero);
        let (factor, mut now, mut nodes) = (self.factor, self.now, self.block.nodes);
        let mut q = self.cursor.forcing - force_at_zero;
        let mut taken = 0;
        for &[next, after] in ahead {
            let [next, after] = [factor * next - force_at_zero, factor * after - force_at_zero];
            let end = double.two_steps(now, [q, next, after]);
            if !range.holds(end) {
                break;
            }
            if shows {
                let index = first + 2 * taken;
                let [u, v] = single.one_step(now, [q, next]);
                observe(index + 1, u, v);
                observe(index + 2, end[0], end[1]);
            }
            now = end;
            q = after;
            nodes.include(now[0]);
            taken += 1;
        }
        self.cursor.index = first + 2 * taken;
        self.cursor.forcing = factor * self.record.forcing.at(self.cursor.index);
        (self.now, self.block.nodes) = (now, nodes);
    }

    /// Takes plain steps on a branch with secant damping, one at a time, as long as there are.
    #[inline(always)]
    fn take_curved<const RATIO: bool>(
        &mut self,
        map: &StepMap,
        secant: &SecantBranch,
        observe: &mut impl FnMut(usize, f64, f64),
    ) {
        let step = self.solver.step;
        let (lengths, tolerances) = ([step, 1.0 / step], self.solver.motion.tolerances);
        let first = self.cursor.index;
        let ahead = self.record.forcing.from(first + 1, self.cursor.limit.saturating_sub(first));
        let shows = !self.seeks_extremes();
        // γ h²/2, by which A is multiplied to bound the way from a straight line
        let reach = 0.5 * map.growth[0] * step * step;
        let (driving, [lowest, highest]) = (self.bounds.driving(), self.limits());
        let (lowest, highest) = (map.corners[0].max(lowest), map.corners[1].min(highest));
        let secant = *secant;
        let (factor, mut now, mut nodes) = (self.factor, self.now, self.block.nodes);
        let (mut p, mut taken, mut fastest) = (self.cursor.forcing, 0, 0.0_f64);
        for &next in ahead {
            let next = factor * next;
            let [u, v] = now;
            let line = u + step * v;
            let driving = driving + map.damping * v.abs();
            let margin = reach * driving;
            // beyond that speed u̇ keeps its sign, so that u does not go back
            let steady = 2.0 * margin < step * v.abs();
            let low = if steady && v > 0.0 { u } else { u.min(line) - margin };
            let high = if steady && v < 0.0 { u } else { u.max(line) + margin };
            if !(low >= lowest && high <= highest) {
                break;
            }
            let end = secant.step::<RATIO>(now, [p, next], lengths, tolerances);
            let by_parts = || secant.step_by_parts::<RATIO>(now, [p, next], lengths, tolerances);
            let Some(end) = end.or_else(by_parts) else { break };
            taken += 1;
            if shows {
                observe(first + taken, end[0], end[1]);
            }
            fastest = fastest.max(v.abs());
            now = end;
            p = next;
            nodes.include(now[0]);
        }
        self.cursor.index = first + taken;
        self.cursor.forcing = p;
        (self.now, self.block.nodes) = (now, nodes);
        self.block.raise(map.damping * fastest, map.growth[0]);
    }

    /// Takes one step, plain or not.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed.
    #[inline(always)]
    pub(in super::super) fn step(
        &mut self,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<(), SolverError> {
        let p = [self.cursor.forcing, self.factor * self.record.forcing.at(self.cursor.index + 1)];
        let share = self.cursor.share;
        self.move_one(p)?;
        if self.cursor.share > share {
            // lanes take the rest of the step
            return Ok(());
        }
        self.cursor.index += 1;
        (self.cursor.forcing, self.cursor.share) = (p[1], 0.0);
        if !self.seeks_extremes() {
            let [u, v] = self.now;
            observe(self.cursor.index, u, v);
        }
        Ok(())
    }

    #[inline(always)]
    fn move_one(&mut self, p: [f64; 2]) -> Result<(), SolverError> {
        let Some(map) = self.map else {
            if self.state.phase == Phase::Resting && self.rests_under(p) {
                self.tally.steps += 1;
                return Ok(());
            }
            return self.search_step(p, None);
        };
        let steps = match &map.way {
            Way::Affine(steps) => steps,
            Way::Curved(_) => return self.curved_step(map, p),
        };
        let start = self.now;
        let end = steps.single.one_step(start, [p[0] - map.force_at_zero, p[1] - map.force_at_zero]);
        let range = self.range(map, 1);
        if range.holds(start) && range.holds(end) {
            self.now = end;
            self.block.nodes.include(start[0]);
            self.block.nodes.include(end[0]);
            return Ok(());
        }
        self.careful_step(map, steps, p, end)
    }
}
