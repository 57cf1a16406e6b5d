//! A one-way tie, anchored to what moves with the supports of the wall.
//!
//! A tie at the height y, of stiffness K and slack g₀, that resists the side of σ = ±1 has the force N at the
//! elongation e = σ ℓ u of the wall there: ℓ = y/`z_G` of one body, in a rectangle 2y/h, and φ(y) of a strip:
//!
//! ```text
//! N = min(N_y, max(0, K (e − g₀ − p)))        F_tie(u) = σ ℓ N, of a strip 2 σ ℓ N
//! ```
//!
//! Its plastic elongation p grows with e while N = `N_y`, and never falls. The tie breaks for good where p
//! reaches `p_u`. Without `p_u` it stays elastic, and `N_y` is only a limit state.
//!
//! Yielding needs e = g₀ + p + `N_y`/K, so all that a tie remembers is the largest |u| at which it has
//! yielded ([`TieMemory`]): p and the fracture follow from it. As the tie is now, F has a corner more where
//! it begins to pull, where it yields and where it breaks ([`Hold`]). F₀, `u_ins`, ω₁ and secant damping stay
//! those of the wall alone.

use crate::choices::TieSide;

use super::error::ParameterError;
use super::force_law::Line;
use super::given::given;
use super::mechanism::Body;
use super::parameters::{Kinematics, Parameters};
use super::sides::Sides;
use super::tie_numbers::TieNumbers;
use super::trigonometric::conflict;

/// A tie; on both sides two ties of equal data.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// Stiffness K \[N/m\].
    pub stiffness: f64,
    /// Slack g₀ before it has yielded \[m\].
    pub slack: f64,
    /// The force it resists, `N_y` \[N\]; `None` where none is given.
    pub strength: Option<f64>,
    /// The plastic elongation at which it breaks, `p_u` \[m\]; `None` for a tie that stays elastic.
    pub ultimate: Option<f64>,
    /// The side it holds.
    pub side: TieSide,
    /// Height y above the base \[m\].
    pub height: f64,
    /// ℓ = de/du: y/`z_G`, in a rectangle 2y/h, and φ(y) of a strip.
    pub lever: f64,
    /// dF/dN: ℓ, and 2ℓ of a strip, since Eq. (12) of a strip is twice Lagrange's.
    pub pull: f64,
    /// |u| from which on the wall has left its supports, and the tie with them \[m\].
    departure: Sides,
    // The quotients are computed once, with the tie: where there is none, the compiler may divide by its
    // stiffness of 0 before it asks, which some hosts trap.
    /// |u| at which it first begins to pull \[m\].
    onset: f64,
    /// |u| at which its force first reaches its strength \[m\].
    yields: Option<f64>,
    /// |u| at which it breaks \[m\].
    breaks: Option<f64>,
}

/// What the ties of a wall remember.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TieMemory {
    /// The largest |u| at which the tie of each side has yielded, or at which it broke; 0 before \[m\].
    pub yielded: Sides,
    /// The wall has left its supports, and its ties with them.
    pub lost: bool,
}

/// A tie as it is now, on one side: the |u| at which it begins to pull, yields and breaks, infinite where it
/// never does \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// Where it begins to pull.
    pub onset: f64,
    /// Where it yields.
    pub yields: f64,
    /// Where it breaks; not below `yields`.
    pub breaks: f64,
    /// The elongation at which it begins to pull, g₀ + p.
    slack: f64,
}

/// What a tie does on a branch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum TieAction {
    /// It is slack or broken, or there is none.
    #[default]
    None,
    /// It pulls, and is elastic.
    Pulls,
    /// It yields under `N_y`.
    Yields,
}

impl Hold {
    /// Returns what the tie does at |u|, which is none of its corners.
    pub(super) fn action(&self, reach: f64) -> TieAction {
        if reach <= self.onset || reach >= self.breaks {
            TieAction::None
        } else if reach < self.yields {
            TieAction::Pulls
        } else {
            TieAction::Yields
        }
    }
}

impl Tie {
    /// Returns the tie that its numbers ask for; `None` for a stiffness of 0.
    ///
    /// # Errors
    /// [`ParameterError::Conflict`] in full rotations, [`ParameterError::TieHeight`],
    /// [`ParameterError::TieAtTop`] of a strip, [`ParameterError::NotGiven`].
    pub(super) fn new(
        numbers: &TieNumbers,
        parameters: &Parameters,
        body: &Body,
    ) -> Result<Option<Self>, ParameterError> {
        let TieNumbers { height: tie_height, stiffness, slack, strength, side, .. } = *numbers;
        let height = body.height;
        let ultimate = given("tie_ultimate", numbers.ultimate)?;
        if stiffness == 0.0 {
            return Ok(None);
        }
        if parameters.kinematics == Kinematics::Trigonometric {
            return Err(conflict(
                "tie_stiffness",
                &stiffness,
                "tie_stiffness = 0 (of a list: leave its ties out)",
            ));
        }
        if !(tie_height > 0.0 && tie_height <= height) {
            return Err(ParameterError::TieHeight { tie_height, height });
        }
        let strength = Some(strength).filter(|strength| *strength > 0.0);
        let ultimate = strength.and(ultimate);
        if body.is_strip() && tie_height == height {
            return Err(ParameterError::TieAtTop { tie_height });
        }
        let (lever, scale) = (body.lever(tie_height), if body.is_strip() { 2.0 } else { 1.0 });
        // the elongation under the strength; with no plastic elongation the tie breaks where it yields
        let elastic = strength.map(|strength| strength / stiffness + slack);
        Ok(Some(Self {
            stiffness,
            slack,
            strength,
            ultimate,
            side,
            height: tie_height,
            lever,
            pull: scale * lever,
            departure: body.departure,
            onset: slack / lever,
            yields: elastic.map(|elastic| elastic / lever),
            breaks: elastic.zip(ultimate).map(|(elastic, ultimate)| (elastic + ultimate) / lever),
        }))
    }

    /// Returns whether the tie resists displacements of a sign.
    pub fn holds(&self, sign: f64) -> bool {
        self.side.holds(sign)
    }

    /// Returns the |u| at which the tie first begins to pull, g₀ over the lever \[m\].
    pub fn onset(&self) -> f64 {
        self.onset
    }

    /// Returns the |u| at which the force of the tie first reaches its strength \[m\]; `None` without a
    /// strength.
    pub fn strength_displacement(&self) -> Option<f64> {
        self.yields
    }

    /// Returns the |u| at which the tie breaks, wherever it has yielded before \[m\]; `None` for one that
    /// stays elastic.
    pub fn fracture_displacement(&self) -> Option<f64> {
        self.breaks
    }

    /// Returns the slope that the tie adds to F where it pulls, K ℓ dF/dN \[N/m\].
    pub fn slope(&self) -> f64 {
        self.stiffness * self.lever * self.pull
    }

    /// Returns the force N of the tie at a displacement reached for the first time \[N\].
    pub fn force(&self, displacement: f64) -> f64 {
        let Some(hold) = self.hold(displacement, &TieMemory::default()) else { return 0.0 };
        let reach = displacement.abs();
        let is_held = reach < hold.breaks && reach < self.departure.of(displacement);
        if is_held { self.tension(&hold, displacement) } else { 0.0 }
    }

    /// Returns the tie of the side of `sign` as it is with this memory; `None` on a side that it does not
    /// hold, once it has broken, and once the wall has left its supports.
    pub fn hold(&self, sign: f64, memory: &TieMemory) -> Option<Hold> {
        if !self.holds(sign) || memory.lost {
            return None;
        }
        let (Some(first), Some(breaks)) = (self.strength_displacement(), self.fracture_displacement()) else {
            let (onset, slack) = (self.onset(), self.slack);
            return Some(Hold { onset, yields: f64::INFINITY, breaks: f64::INFINITY, slack });
        };
        let yielded = memory.yielded.of(sign);
        if yielded >= breaks {
            return None;
        }
        // not from `yields` back by N_y/K: of a strong tie that would cancel all digits
        let slack = self.slack + self.lever * (yielded - first).max(0.0);
        Some(Hold { onset: slack / self.lever, yields: first.max(yielded), breaks, slack })
    }

    /// Returns whether the tie of the side of `sign` has broken with this memory.
    pub fn is_broken(&self, sign: f64, memory: &TieMemory) -> bool {
        let has_reached = |breaks| memory.yielded.of(sign) >= breaks;
        self.holds(sign) && self.fracture_displacement().is_some_and(has_reached)
    }

    /// Returns the plastic elongation p that belongs to the |u| at which the tie has yielded \[m\].
    pub fn elongation(&self, yielded: f64) -> f64 {
        let (Some(first), Some(ultimate)) = (self.strength_displacement(), self.ultimate) else { return 0.0 };
        if self.fracture_displacement().is_some_and(|breaks| yielded >= breaks) {
            return ultimate;
        }
        (self.lever * (yielded - first)).clamp(0.0, ultimate)
    }

    /// Returns the plastic elongations p of the tie of each side with a memory \[m\]; 0 on a side that it
    /// does not hold.
    pub fn elongations(&self, memory: &TieMemory) -> Sides {
        let of = |sign: f64| if self.holds(sign) { self.elongation(memory.yielded.of(sign)) } else { 0.0 };
        Sides { positive: of(1.0), negative: of(-1.0) }
    }

    /// Returns K (|e| − g₀ − p), the force of the tie where it pulls \[N\]. Of one that yields it is at most
    /// `N_y`, also to rounding.
    pub(super) fn tension(&self, hold: &Hold, displacement: f64) -> f64 {
        let force = (self.stiffness * (self.lever * displacement.abs() - hold.slack)).max(0.0);
        self.ultimate.and(self.strength).map_or(force, |most| force.min(most))
    }

    /// Returns what the tie does between two displacements that no corner separates.
    pub(super) fn action(&self, lower: f64, upper: f64, memory: &TieMemory) -> TieAction {
        let middle = 0.5 * (lower + upper);
        let within = middle.abs() < self.departure.of(middle);
        let hold = self.hold(middle, memory).filter(|_| within);
        hold.map_or(TieAction::None, |hold| hold.action(middle.abs()))
    }

    /// Adds the force of the tie to a line on the side of `sign`, both per unit effective mass `m` \[kg\].
    pub(super) fn added_to(
        &self,
        line: Line,
        action: TieAction,
        sign: f64,
        memory: &TieMemory,
        m: f64,
    ) -> Line {
        match (action, self.hold(sign, memory)) {
            (TieAction::Pulls, Some(hold)) => {
                let anchor = hold.onset.copysign(sign);
                Line { anchor, force: line.at(anchor), slope: line.slope + self.slope() / m }
            }
            (TieAction::Yields, _) => {
                let most = self.pull * self.strength.unwrap_or_default() / m;
                Line { force: line.force + most.copysign(sign), ..line }
            }
            _ => line,
        }
    }
}
