//! The way of a run through the record: stretch by stretch, then back to those in which an extreme may lie between samples.

use super::super::{Phase, State};
use super::lane::{BRAKING, Lane};
use super::{Forcing, Passage};

/// Samples for which P is taken together.
pub(super) const STRETCH: usize = 256;

/// Plain steps that are taken at once side by side.
pub(super) const AT_ONCE: usize = 4;
/// Most of the reach of f̂ over the largest |u| so far.
const FAR: f64 = 16.0;

/// Largest |p| over each stretch of a record, and the samples after it, to which plain steps taken at once may go.
pub(super) fn largest_forcing(forcing: &impl Forcing) -> Vec<f64> {
    let last = forcing.count().saturating_sub(1);
    let over = |stretch: usize| stretch * STRETCH..((stretch + 1) * STRETCH + AT_ONCE - 1).min(last) + 1;
    (0..last.div_ceil(STRETCH)).map(|stretch| forcing.largest(over(stretch))).collect()
}

/// A state and the sample at which it was.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) state: State,
    pub(super) index: usize,
}

/// A stretch gone through.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    began: Place,
    ended: usize,
    /// Extremes at the ends of its plain steps \[m\].
    highest: f64,
    lowest: f64,
    /// Of [`Lane`].
    largest_forcing: f64,
    driving: f64,
    growth: f64,
}

impl<F: Forcing> Lane<'_, F> {
    /// Puts the run at a place of the record.
    pub(super) fn place(&mut self, Place { state, index }: Place) {
        self.state = state;
        self.index = index;
        self.forcing_now = self.factor * self.forcing.at(index);
        self.load();
        self.open_stretch();
    }

    /// Takes up the forcing of the stretch the run is in.
    fn open_stretch(&mut self) {
        let stretch = self.index / STRETCH;
        let state = self.whole_state();
        self.state = state;
        self.until = if self.looks_back() { self.last } else { ((stretch + 1) * STRETCH).min(self.last) };
        self.largest_forcing = self.largest.get(stretch).map_or(0.0, |largest| largest * self.factor.abs());
        (self.driving, self.growth) = (0.0, self.plain.growth);
        self.began = Place { state, index: self.index };
        // the last plain steps may go beyond the stretch, but not beyond the pass
        self.limit = self.until.min((self.last + 1).saturating_sub(self.plain.steps));
        self.forget_nodes();
        // f̂ of the last stretch serves again where u is still far below the reach, yet not too far
        let step = self.solver.step;
        let largest = state.peaks.largest() + self.largest_forcing * step * step;
        if !self.looks_back() && 2.0 * largest < self.reach && self.reach < FAR * largest {
            self.brake();
        } else {
            self.measure();
        }
    }

    /// Keeps what is needed to look for extremes between the samples of a stretch.
    fn close_stretch(&mut self) {
        let (highest, lowest) = (self.highest, self.lowest);
        if highest < lowest {
            return;
        }
        self.take_in_nodes();
        self.forget_nodes();
        let Self { began, index: ended, largest_forcing, driving, growth, .. } = *self;
        let stretch = Stretch { began, ended, highest, lowest, largest_forcing, driving, growth };
        // f̂ was taken at least as far as u has gone
        if self.is_doubtful(&stretch, self.largest_force) {
            self.doubtful.push(stretch);
        }
    }

    /// Whether u may have gone beyond the extremes known between the samples of a stretch, where |f| is up to `force`.
    fn is_doubtful(&self, stretch: &Stretch, force: f64) -> bool {
        let Stretch { highest, lowest, largest_forcing, driving, growth, .. } = *stretch;
        let peaks = self.state.peaks;
        let most = growth * (largest_forcing + force + BRAKING * driving);
        let length = self.plain.steps as f64 * self.solver.step;
        let margin = 0.125 * length * length * most;
        highest + margin > peaks.positive || margin - lowest > peaks.negative
    }

    /// At the end of a stretch: takes up the next one, or one of those to look back at. What became of the run, if it is over.
    pub(super) fn turn_pages(&mut self, observe: &mut impl FnMut(usize, f64, f64)) -> Option<Passage> {
        if self.state.phase == Phase::Landed {
            self.lie(observe);
        }
        while self.index >= self.until {
            if let Some(passage) = self.turn_page() {
                return Some(passage);
            }
        }
        None
    }

    fn turn_page(&mut self) -> Option<Passage> {
        if !self.looks_back() {
            self.close_stretch();
            if self.index < self.last {
                self.open_stretch();
                return None;
            }
            let mut state = self.whole_state();
            state.peaks.include(state.displacement);
            self.state = state;
            // a plain step is one piece of motion
            let mut work = self.work;
            work.pieces += self.last as u64 - self.searched;
            let Self { overturning, stilled, .. } = *self;
            self.result = Some(Passage { state, overturning, work, stilled });
        }
        // the motion is the same again, but for rounding: only extremes are taken from it
        while let Some(stretch) = self.doubtful.pop() {
            if self.is_doubtful(&stretch, self.solver.largest_force(self.state.peaks.largest())) {
                let Stretch { began: Place { mut state, index }, ended, .. } = stretch;
                state.peaks = self.state.peaks;
                self.last = ended;
                self.place(Place { state, index });
                return None;
            }
        }
        let mut passage = self.result?;
        passage.state.peaks = self.state.peaks;
        Some(passage)
    }

    /// Lies until the record ends: nothing will ever happen.
    fn lie(&mut self, observe: &mut impl FnMut(usize, f64, f64)) {
        let [u, v] = self.now;
        if !self.looks_back() {
            self.close_stretch();
            (self.index + 1..=self.last).for_each(|index| observe(index, u, v));
        }
        (self.index, self.until) = (self.last, self.last);
    }

    /// Overturned in this step: stops after it, where asked to.
    pub(super) fn overturned(&mut self) {
        if self.until_overturning && !self.looks_back() {
            // the extremes of the step itself are known
            self.close_stretch();
            let end = self.index + 1;
            (self.last, self.until) = (end, end);
        }
    }
}
