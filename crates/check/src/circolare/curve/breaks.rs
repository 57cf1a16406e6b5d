//! What a curve loses where its ties break, C8.7.1.2.1.6.

use rocking_wall::wall::Tie;

use super::{Curve, tie};

/// What a curve loses where a tie breaks, C8.7.1.2.1.6; a with FC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieBreak {
    /// The place of the tie among those of the side.
    pub tie: usize,
    /// u there \[m\].
    pub u: f64,
    /// a with the tie there \[m/s²\].
    pub before: f64,
    /// The largest a that the wall reaches from there on with the ties that hold \[m/s²\].
    pub after: f64,
    /// The largest a of the whole curve \[m/s²\].
    pub largest: f64,
    /// What is lost over the largest \[-\].
    pub loss: f64,
}

impl Curve {
    /// What the curve loses for good where each of its ties breaks, over its largest a up to there.
    pub(in crate::circolare) fn breaks(&self) -> Vec<TieBreak> {
        let broken = self.ties().enumerate();
        broken.filter_map(|(index, tie)| Some(self.broken_at(index, tie.fracture_displacement()?))).collect()
    }

    /// What it loses where its first tie breaks; `None` where that does not break.
    pub(in crate::circolare) fn tie_break(&self) -> Option<TieBreak> {
        self.breaks().into_iter().find(|broken| broken.tie == 0)
    }

    /// The first u below a limit up to which the breaks of ties have taken more than a share of the largest a
    /// for good \[m\].
    pub(in crate::circolare) fn lost_before(&self, limit: f64, share: f64) -> Option<f64> {
        let mut breaks = self.breaks();
        breaks.sort_by(|a, b| a.u.total_cmp(&b.u));
        let mut before = f64::NEG_INFINITY;
        let lost = breaks.into_iter().take_while(|broken| broken.u < limit).find(|broken| {
            before = before.max(broken.before);
            (before - broken.after) / broken.largest > share
        });
        Some(lost?.u)
    }

    fn broken_at(&self, tie: usize, u: f64) -> TieBreak {
        let before = self.tied(u);
        let after = if self.holding(u).next().is_none() {
            self.largest_own_from(u)
        } else {
            let later = self.places().into_iter().filter(|place| *place > u).map(|place| self.tied(place));
            later.fold(self.beyond(u), f64::max)
        };
        let reached = self.places().into_iter().filter(|place| *place <= u).map(|place| self.tied(place));
        let largest = reached.fold(before.max(after), f64::max);
        TieBreak { tie, u, before, after, largest, loss: ((before - after) / largest).max(0.0) }
    }

    /// The ties that hold beyond u.
    fn holding(&self, u: f64) -> impl Iterator<Item = &Tie> {
        self.ties().filter(move |tie| tie.fracture_displacement().is_none_or(|breaks| breaks > u))
    }

    /// a just beyond u, with the ties that hold, with FC \[m/s²\].
    pub(super) fn beyond(&self, u: f64) -> f64 {
        let pull = self.holding(u).map(|own| own.pull * tie::force(own, u)).fold(0.0, |sum, pull| sum + pull);
        self.of_force(self.own_force(u) + pull) / self.confidence_factor
    }
}
