//! What a user gives of one tie.

use super::bar::{Bar, TiePart};
use super::error::ParameterError;
use super::usual::{FORCES, Usual};
use super::warning::Warning;
use crate::choices::TieSide;

/// The numbers of one tie: the parameters `tie_…` of the model description, without their prefix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TieNumbers {
    /// `tie_height` \[m\].
    pub height: f64,
    /// `tie_stiffness`, K \[N/m\]; 0 for no tie.
    pub stiffness: f64,
    /// `tie_slack`, g₀ \[m\].
    pub slack: f64,
    /// `tie_strength`, `N_y` \[N\]; 0 for none.
    pub strength: f64,
    /// `tie_ultimate`, `p_u` \[m\]; −1 for a tie that stays elastic.
    pub ultimate: f64,
    /// `tie_side`.
    pub side: TieSide,
    /// The bar that stiffness, strength and ultimate elongation follow from, if one is given.
    pub bar: Option<Bar>,
}

impl TieNumbers {
    /// Returns whether the tie holds the side of `sign`.
    pub fn holds(&self, sign: f64) -> bool {
        self.side.holds(sign)
    }

    /// Returns the numbers with those that follow from the bar, of a wall of a width \[m\].
    ///
    /// # Errors
    /// Those of [`Bar::tie`].
    pub fn with_bar(self, width: f64) -> Result<Self, ParameterError> {
        let Some(bar) = self.bar else { return Ok(self) };
        let tie = bar.tie(width)?;
        Ok(Self { stiffness: tie.stiffness, strength: tie.strength, ultimate: tie.ultimate, ..self })
    }

    /// Finds the numbers that are improbable: those of the bar, or else stiffness and strength.
    pub(super) fn unusual(&self) -> Vec<Warning> {
        let of_bar: Vec<_> = self.bar.iter().flat_map(Bar::warnings).collect();
        // of a bar with a number in another unit, stiffness and strength say nothing more
        if self.stiffness == 0.0 || !of_bar.is_empty() {
            return of_bar;
        }
        // a steel bar of 12 mm over 20 m has 1.2e6 N/m, two of 40 mm over 1 m have 5e8 N/m
        let others = &[("in kN/m", 1e3), ("in kN/mm", 1e6)];
        let stiffness = Usual { name: "tie_stiffness", unit: "N/m", range: [1e5, 1e9], others };
        // an anchor in poor masonry resists some kN, two steel bars of 40 mm 1.3e6 N
        let strength = Usual { name: "tie_strength", unit: "N", range: [1e3, 2e6], others: FORCES };
        let of_strength = (self.strength > 0.0).then(|| strength.warning(self.strength)).flatten();
        stiffness.warning(self.stiffness).into_iter().chain(of_strength).collect()
    }

    /// Returns which part of the tie gives way first; `None` for a tie that is given by its own numbers.
    pub fn weaker_part(&self, width: f64) -> Option<TiePart> {
        let tie = self.bar?.tie(width).ok()?;
        let is_own =
            [tie.stiffness, tie.strength, tie.ultimate] == [self.stiffness, self.strength, self.ultimate];
        is_own.then_some(tie.weaker)
    }
}
