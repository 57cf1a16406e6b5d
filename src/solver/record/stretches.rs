//! The way of a run through the record: stretch by stretch, then back to those in which an extreme may lie between samples.

use super::super::event::Peaks;
use super::super::{Memo, Phase, SolverError, State, Work};
use super::lanes::{BRAKING, Lanes};
use super::{Forcing, Passage, Start};

/// Samples for which P is taken together.
pub(super) const STRETCH: usize = 256;

/// Largest |p| over each stretch of a record, and the sample after it, to which a pair of steps may go.
pub(super) fn largest_forcing(forcing: &impl Forcing) -> Vec<f64> {
    let last = forcing.count().saturating_sub(1);
    let over = |stretch: usize| stretch * STRETCH..((stretch + 1) * STRETCH + 1).min(last) + 1;
    (0..last.div_ceil(STRETCH)).map(|stretch| forcing.largest(over(stretch))).collect()
}

/// What a plain step does not touch.
pub(super) struct Lane {
    /// The run under way.
    run: Option<usize>,
    /// u and u̇ of this one are not kept up to date.
    pub(super) state: State,
    /// Samples at which this stretch and this pass through the record end.
    pub(super) until: usize,
    last: usize,
    /// P over this stretch \[m/s²\], f̂ \[m/s²\] and the |u| up to which f̂ is taken \[m\].
    pub(super) largest_forcing: f64,
    pub(super) largest_force: f64,
    pub(super) reach: f64,
    /// A h²/8 over one step and over two \[m\], and A h over one \[m/s\], on the present branch.
    pub(super) margins: [f64; 2],
    pub(super) slow: f64,
    /// The largest P + f̂ in this stretch, and A over P + c V + f̂.
    pub(super) driving: f64,
    pub(super) growth: f64,
    began: Place,
    /// Stretches in which u may have gone beyond the extremes known.
    doubtful: Vec<Stretch>,
    /// What became of the run, while the lane looks back at those.
    result: Option<Passage>,
    pub(super) overturning: Option<f64>,
    /// Work of the steps that were searched, and their number.
    pub(super) work: Work,
    pub(super) searched: u64,
    pub(super) stilled: bool,
    pub(super) memo: Memo,
}

/// A state and the sample at which it was.
#[derive(Clone, Copy)]
struct Place {
    state: State,
    index: usize,
}

/// A stretch gone through.
#[derive(Clone, Copy)]
struct Stretch {
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

impl Lane {
    pub(super) fn idle() -> Self {
        let state = State {
            displacement: 0.0,
            velocity: 0.0,
            branch: 0,
            phase: Phase::Moving,
            overturned: false,
            departed: false,
            peaks: Peaks { positive: 0.0, negative: 0.0 },
        };
        Self {
            run: None,
            state,
            until: 0,
            last: 0,
            largest_forcing: 0.0,
            largest_force: 0.0,
            reach: 0.0,
            margins: [0.0; 2],
            slow: 0.0,
            driving: 0.0,
            growth: 0.0,
            began: Place { state, index: 0 },
            doubtful: Vec::new(),
            result: None,
            overturning: None,
            work: Work::default(),
            searched: 0,
            stilled: false,
            memo: Memo::default(),
        }
    }

    pub(super) fn is_idle(&self) -> bool {
        self.run.is_none()
    }

    /// Whether the run is over but for its extremes.
    #[inline(always)]
    pub(super) fn looks_back(&self) -> bool {
        self.result.is_some()
    }
}

impl<F: Forcing, const N: usize> Lanes<'_, F, N> {
    /// Takes up the next run, or none; tells whether there was one.
    pub(super) fn begin(&mut self, i: usize) -> bool {
        let Some(&Start { state, factor }) = self.starts.get(self.next) else {
            self.rest[i] = Lane::idle();
            (self.pairs.index[i], self.limit[i], self.waits[i]) = (0, 0, true);
            return false;
        };
        // what the last run has grown is used again
        let doubtful = std::mem::take(&mut self.rest[i].doubtful);
        self.rest[i] = Lane {
            run: Some(self.next),
            last: self.forcing.count() - 1,
            overturning: state.overturned.then_some(0.0),
            doubtful,
            ..Lane::idle()
        };
        self.next += 1;
        self.factor[i] = factor;
        self.place(i, Place { state, index: 0 });
        true
    }

    /// Puts a lane at a place of the record.
    fn place(&mut self, i: usize, Place { state, index }: Place) {
        self.rest[i].state = state;
        self.pairs.index[i] = index;
        self.pairs.forcing_now[i] = self.factor[i] * self.forcing.at(index);
        self.load(i);
        self.open_stretch(i);
    }

    /// Takes up the forcing of the stretch a lane is in.
    fn open_stretch(&mut self, i: usize) {
        let index = self.pairs.index[i];
        let stretch = index / STRETCH;
        let state = self.whole_state(i);
        let lane = &mut self.rest[i];
        lane.state = state;
        lane.until = if lane.looks_back() { lane.last } else { ((stretch + 1) * STRETCH).min(lane.last) };
        lane.largest_forcing =
            self.largest.get(stretch).map_or(0.0, |largest| largest * self.factor[i].abs());
        (lane.driving, lane.growth) = (0.0, 0.0);
        lane.began = Place { state, index };
        // a pair may go one sample beyond the stretch, but not beyond the pass
        self.limit[i] = lane.until.min(lane.last.saturating_sub(1));
        self.forget_nodes(i);
        self.measure(i);
    }

    /// Keeps what is needed to look for extremes between the samples of a stretch.
    fn close_stretch(&mut self, i: usize) {
        let (highest, lowest) = (self.pairs.highest[i], self.pairs.lowest[i]);
        if highest < lowest {
            return;
        }
        self.take_in_nodes(i);
        self.forget_nodes(i);
        let Lane { began, largest_forcing, driving, growth, .. } = self.rest[i];
        let ended = self.pairs.index[i];
        let stretch = Stretch { began, ended, highest, lowest, largest_forcing, driving, growth };
        if self.is_doubtful(i, &stretch) {
            self.rest[i].doubtful.push(stretch);
        }
    }

    /// Whether u may have gone beyond the extremes known between the samples of a stretch.
    fn is_doubtful(&self, i: usize, stretch: &Stretch) -> bool {
        let Stretch { highest, lowest, largest_forcing, driving, growth, .. } = *stretch;
        let peaks = self.rest[i].state.peaks;
        let force = self.solver.largest_force(peaks.largest());
        let most = growth * (largest_forcing + force + BRAKING * driving);
        let margin = 0.5 * self.solver.step * self.solver.step * most;
        highest + margin > peaks.positive || margin - lowest > peaks.negative
    }

    /// At the end of a stretch: takes up the next one, or the next run. Tells whether there is one.
    pub(super) fn turn_page(&mut self, i: usize) -> bool {
        if !self.rest[i].looks_back() {
            self.close_stretch(i);
            if self.pairs.index[i] < self.rest[i].last {
                self.open_stretch(i);
                return true;
            }
            let mut state = self.whole_state(i);
            state.peaks.include(state.displacement);
            let lane = &mut self.rest[i];
            let Lane { overturning, mut work, searched, stilled, last, .. } = *lane;
            lane.state = state;
            // a plain step is one piece of motion
            work.pieces += last as u64 - searched;
            lane.result = Some(Passage { state, overturning, work, stilled });
            self.steps += last as u64;
            self.searched += searched;
        }
        // the motion is the same again, but for rounding: only extremes are taken from it
        while let Some(stretch) = self.rest[i].doubtful.pop() {
            if self.is_doubtful(i, &stretch) {
                let Stretch { began: Place { mut state, index }, ended, .. } = stretch;
                state.peaks = self.rest[i].state.peaks;
                self.rest[i].last = ended;
                self.place(i, Place { state, index });
                return true;
            }
        }
        let lane = &mut self.rest[i];
        if let (Some(run), Some(mut passage)) = (lane.run, lane.result.take()) {
            passage.state.peaks = lane.state.peaks;
            self.passages[run] = Some(passage);
        }
        let begun = self.begin(i);
        if !begun {
            self.running -= 1;
        }
        begun
    }

    /// Lies until the record ends: nothing will ever happen.
    pub(super) fn lie(&mut self, i: usize, observe: &mut impl FnMut(usize, f64, f64)) {
        let [u, v] = self.state(i);
        let last = self.rest[i].last;
        if !self.rest[i].looks_back() {
            self.close_stretch(i);
            (self.pairs.index[i] + 1..=last).for_each(|index| observe(index, u, v));
        }
        (self.pairs.index[i], self.rest[i].until) = (last, last);
    }

    /// Overturned in this step: stops after it, where asked to.
    pub(super) fn overturned(&mut self, i: usize) {
        if self.until_overturning && !self.rest[i].looks_back() {
            // the extremes of the step itself are known
            self.close_stretch(i);
            let end = self.pairs.index[i] + 1;
            (self.rest[i].last, self.rest[i].until) = (end, end);
        }
    }

    /// The motion could not be followed: gives the run up.
    pub(super) fn give_up(&mut self, i: usize, error: SolverError) {
        let index = self.pairs.index[i];
        let lane = &mut self.rest[i];
        let run = lane.run.unwrap_or(usize::MAX);
        if self.failure.as_ref().is_none_or(|(first, _)| run < *first) {
            self.failure = Some((run, error));
        }
        lane.doubtful.clear();
        (lane.last, lane.until) = (index, index);
    }
}
