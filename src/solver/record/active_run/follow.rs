//! Following a run: plain steps by pairs, and one by one what is not plain.

use super::super::super::SolverError;
use super::super::solver::Outcome;
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
            self.take_pairs(observe);
            if self.cursor.index < self.cursor.limit {
                self.step(observe)?;
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
                && self.range(map, 2).holds(self.now)
            {
                self.block.nodes.include(self.now[0]);
                return Ok(None);
            }
            self.step(observe)?;
        }
    }

    /// Takes plain steps, two at once, as long as there are.
    #[inline(always)]
    fn take_pairs(&mut self, observe: &mut impl FnMut(usize, f64, f64)) {
        let Some(map) = self.map else { return };
        let first = self.cursor.index;
        let pairs = self.cursor.limit.saturating_sub(first).div_ceil(2);
        let ahead = self.record.forcing.from(first + 1, 2 * pairs).as_chunks().0;
        let shows = !self.seeks_extremes();
        let range = self.range(map, 2);
        // apart from the rest, so that they stay in registers
        let (single, double, force_at_zero) = (map.single, map.double, map.force_at_zero);
        let (factor, mut now, mut nodes) = (self.factor, self.now, self.block.nodes);
        let mut q = self.cursor.forcing - force_at_zero;
        let mut taken = 0;
        for &[next, after] in ahead {
            let [next, after] = [next, after].map(|p: f64| factor * p - force_at_zero);
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
        self.move_one(p)?;
        self.cursor.index += 1;
        self.cursor.forcing = p[1];
        if !self.seeks_extremes() {
            let [u, v] = self.now;
            observe(self.cursor.index, u, v);
        }
        Ok(())
    }

    #[inline(always)]
    fn move_one(&mut self, p: [f64; 2]) -> Result<(), SolverError> {
        let Some(map) = self.map else { return self.search_step(p, None) };
        let start = self.now;
        let end = map.single.one_step(start, p.map(|p| p - map.force_at_zero));
        let range = self.range(map, 1);
        if range.holds(start) && range.holds(end) {
            self.now = end;
            self.block.nodes.include(start[0]);
            self.block.nodes.include(end[0]);
            return Ok(());
        }
        self.careful_step(map, p, end)
    }
}
