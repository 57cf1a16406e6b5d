//! A block gone through, and the extremes of its plain steps.

use super::super::{Peaks, State};

/// The extremes of u at the ends of plain steps \[m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Nodes {
    pub(super) highest: f64,
    pub(super) lowest: f64,
}

impl Nodes {
    pub(super) const NONE: Self = Self { highest: f64::NEG_INFINITY, lowest: f64::INFINITY };

    #[inline(always)]
    pub(super) fn include(&mut self, u: f64) {
        self.highest = if u > self.highest { u } else { self.highest };
        self.lowest = if u < self.lowest { u } else { self.lowest };
    }

    pub(super) fn are_none(&self) -> bool {
        self.highest < self.lowest
    }

    #[inline(always)]
    pub(super) fn add_to(&self, peaks: &mut Peaks) {
        if !self.are_none() {
            peaks.include(self.highest);
            peaks.include(self.lowest);
        }
    }
}

/// A block: where the run entered it, the extremes of its plain steps and what bounds the motion between
/// them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub(super) start: State,
    pub(super) first: usize,
    pub(super) nodes: Nodes,
    /// P \[m/s²\].
    forcing: f64,
    /// The largest c V \[m/s²\], and the largest γ over the plain steps.
    damping: f64,
    growth: f64,
}

impl Block {
    /// Enters a block at a sample; `growth` is the least γ to reckon with.
    pub(super) fn enter(start: State, first: usize, forcing: f64, growth: f64) -> Self {
        Self { start, first, nodes: Nodes::NONE, forcing, damping: 0.0, growth }
    }

    /// Takes the c V and γ of more plain steps.
    #[inline(always)]
    pub(super) fn raise(&mut self, damping: f64, growth: f64) {
        self.damping = self.damping.max(damping);
        self.growth = self.growth.max(growth);
    }

    /// Tells whether u may have gone beyond the peaks between the ends of plain steps of a length \[s\], |f|
    /// being up to `force`.
    pub(super) fn may_exceed(&self, peaks: &Peaks, force: f64, length: f64) -> bool {
        // A L²/8, docs/record-path.md, §5
        let most = self.growth * (self.forcing + force + self.damping);
        let margin = 0.125 * length * length * most;
        self.nodes.highest + margin > peaks.positive || margin - self.nodes.lowest > peaks.negative
    }
}
