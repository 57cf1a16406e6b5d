//! The ties of a wall, which act together.
//!
//! Each has its own law. All are stretched by the same u, so that the largest |u| at which any of them has
//! yielded is all that they remember ([`TieMemory`]): a tie whose first yield or fracture lies within it has
//! yielded to there, or has broken.

use std::ops::Deref;
use std::sync::Arc;

use super::error::ParameterError;
use super::force_law::{Line, RestoringForce};
use super::mechanism::Body;
use super::parameters::Parameters;
use super::sides::Sides;
use super::tie::{Hold, Tie, TieAction, TieMemory};

/// The ties of a wall, in the order in which they are given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ties(Arc<[Tie]>);

impl Deref for Ties {
    type Target = [Tie];

    fn deref(&self) -> &[Tie] {
        &self.0
    }
}

impl Ties {
    /// Returns the ties that the parameters ask for.
    ///
    /// # Errors
    /// Those of a tie: [`ParameterError::Conflict`], [`ParameterError::TieHeight`],
    /// [`ParameterError::TieAtTop`], [`ParameterError::NotGiven`], and those of a bar.
    pub(super) fn new(parameters: &Parameters, body: &Body) -> Result<Self, ParameterError> {
        let mut ties = Vec::new();
        for numbers in parameters.ties() {
            if let Some(bar) = numbers.bar {
                bar.tie(parameters.width)?;
            }
            ties.extend(Tie::new(&numbers, parameters, body)?);
        }
        Ok(Self(ties.into()))
    }

    /// Returns the ties that hold the side of `sign`.
    pub fn of_side(&self, sign: f64) -> impl Iterator<Item = &Tie> + Clone {
        self.iter().filter(move |tie| tie.holds(sign))
    }

    /// Returns the height of a tie by which a message tells it from the others; none of one alone \[m\].
    pub(super) fn told(&self, height: f64) -> Option<f64> {
        (self.len() > 1).then_some(height)
    }

    /// Returns the ties of the side of `sign` as they are with a memory, those that are left.
    pub(crate) fn holds(&self, sign: f64, memory: TieMemory) -> impl Iterator<Item = Hold> + Clone {
        self.iter().filter_map(move |tie| tie.hold(sign, &memory))
    }

    /// Returns the memory of ties whose wall has been pulled to a displacement \[m\].
    pub(crate) fn memory_at(&self, displacement: f64) -> TieMemory {
        let mut memory = TieMemory::default();
        self.stretch(&mut memory, displacement);
        memory
    }

    /// Enters in the memory that the wall has pulled its ties to a displacement \[m\], if one yields there;
    /// returns whether that breaks one.
    pub(crate) fn stretch(&self, memory: &mut TieMemory, displacement: f64) -> bool {
        let mut yielded = memory.yielded.of(displacement);
        let mut has_broken = false;
        for hold in self.holds(displacement, *memory) {
            let reached = displacement.abs().min(hold.breaks);
            if reached >= hold.yields {
                yielded = yielded.max(reached);
            }
            has_broken |= reached == hold.breaks;
        }
        *memory.yielded.of_mut(displacement) = yielded;
        has_broken
    }

    /// Returns whether a tie of the side of `sign` breaks at the |u| that the memory has.
    pub(crate) fn break_at_memory(&self, sign: f64, memory: &TieMemory) -> bool {
        let yielded = memory.yielded.of(sign);
        self.of_side(sign).any(|tie| tie.fracture_displacement() == Some(yielded))
    }

    /// Returns the most that any tie does between two displacements that no corner separates.
    pub(super) fn action(&self, lower: f64, upper: f64, memory: &TieMemory) -> TieAction {
        self.iter().map(|tie| tie.action(lower, upper, memory)).max().unwrap_or_default()
    }

    /// Adds the forces of the ties to the line of the wall alone between two displacements that no corner
    /// separates, both per unit effective mass `m` \[kg\].
    pub(super) fn added_to(&self, own: Line, [lower, upper]: [f64; 2], memory: &TieMemory, m: f64) -> Line {
        let add = |line: Line, tie: &Tie| {
            tie.added_to(line, tie.action(lower, upper, memory), 0.5 * (lower + upper), memory, m)
        };
        self.iter().fold(own, add)
    }

    /// Returns the part of |F| that the ties take at |u| on the side of `sign`, reached for the first time:
    /// Σ N dF/dN \[N\].
    pub fn pull(&self, sign: f64, u: f64) -> f64 {
        let force = |tie: &Tie| tie.pull * tie.force(u.copysign(sign));
        self.iter().map(force).fold(0.0, |sum, force| sum + force)
    }

    /// Returns the largest plastic elongation of the ties of each side with a memory \[m\].
    pub(super) fn elongation(&self, memory: &TieMemory) -> Sides {
        let of_each = self.iter().map(|tie| tie.elongations(memory));
        of_each.fold(Sides::default(), |most, of| Sides {
            positive: most.positive.max(of.positive),
            negative: most.negative.max(of.negative),
        })
    }

    /// Returns whether the ties pull the wall back even where the wall leaves its supports, so that no
    /// equilibrium is unstable beyond the wall's own.
    pub(super) fn steady(&self, force: &RestoringForce, body: &Body, sign: f64) -> bool {
        let end = body.departure.of(sign);
        let (mut pull, mut slope) = (0.0, 0.0);
        for tie in self.of_side(sign) {
            let Some(hold) = tie.hold(sign, &TieMemory::default()) else { continue };
            match hold.action(end) {
                TieAction::None => {}
                TieAction::Pulls => {
                    pull += tie.slope() * (end - hold.onset);
                    slope += tie.slope();
                }
                TieAction::Yields => pull += tie.pull * tie.strength.unwrap_or_default(),
            }
        }
        // under a constant pull the force falls up to there, so it is positive all the way
        let rises = |line: &Line| slope == 0.0 || line.slope + slope > 0.0;
        let reaches = |line: &Line| rises(line) && sign * line.at(sign * end) + pull > 0.0;
        pull > 0.0 && force.side(sign).lines.last().is_some_and(reaches)
    }
}
