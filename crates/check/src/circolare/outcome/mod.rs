//! The outcome of a check.

pub(crate) mod check;
mod loads;
mod ranges;
mod turns;
pub(crate) mod warnings;

use std::borrow::Cow;

use rocking_wall::wall::{Parameters, Wall};
use scene::Floors;
use serde::Serialize;

use super::checks::sides::{SideVerdict, SideVerdicts};
use super::runs::dynamic::DynamicCheck;
use super::statement::Statement;
use super::statement::table::Hinge;
use crate::ntc::demand::Demands;
use crate::words::Sentence;
use crate::words::names::{Deciding, Side, Sides};

/// A wall that was checked, with what it was checked by.
#[derive(Debug)]
pub struct Checked<'a> {
    pub(super) statement: &'a Statement,
    /// Its parameters as the check takes them, with the hinge of the side that governs.
    pub(super) parameters: Parameters,
    /// The place of the level in `hinge_levels` above which it turns.
    pub(super) level: usize,
    pub(super) floors: Option<Cow<'a, Floors>>,
    pub(super) wall: Wall,
    /// Where the hinge of a strip is.
    pub(super) rule: Option<Hinge>,
    /// Of SLD, SLV and SLC; `None` for one that is not stated.
    pub(super) demands: Demands,
    /// The outcome.
    pub outcome: Outcome,
    /// The bodies above the other levels, the lowest first.
    pub beside: Vec<Self>,
}

impl Checked<'_> {
    /// The bodies above all levels, the lowest first.
    pub(super) fn levels(&self) -> Vec<&Self> {
        let mut levels: Vec<&Self> = [self].into_iter().chain(&self.beside).collect();
        levels.sort_by_key(|checked| checked.level);
        levels
    }

    /// z/H of the table `[check.building]` \[-\].
    pub(super) fn height_ratio(&self) -> Option<f64> {
        self.statement.table.building.as_ref()?.height_ratio.as_ref()?.at(self.level)
    }

    /// The level above which the wall turns, where levels are stated \[m\].
    pub(super) fn stated_level(&self) -> Option<f64> {
        self.statement.stated_level(self.level)
    }

    /// The sides that differ.
    pub(super) fn sides(&self) -> impl Iterator<Item = (Side, &SideVerdict)> {
        self.outcome.sides.iter().take(if self.outcome.alike { 1 } else { 2 })
    }

    /// What a number of a side is of.
    pub(super) fn which(&self, side: Side) -> Sides {
        Sides::of(side, self.outcome.alike)
    }

    /// The side that governs.
    pub(super) fn governing(&self) -> Option<&SideVerdict> {
        self.outcome.sides.shown(self.outcome.governs.side)
    }
}

/// The outcome of a check. Serialized it is what `wall check --json` prints: SI units, `a_g` in g.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Name of the code.
    pub code: &'static str,
    /// Whether every limit state that decides holds on every side.
    pub passed: bool,
    /// `ζ_E` from which on a limit state holds, where it is not 1 \[-\].
    #[serde(skip_serializing_if = "is_one")]
    pub target: f64,
    /// What governs: the smallest `ζ_E` of those that decide.
    pub governs: Governs,
    /// Whether both sides are alike.
    #[serde(skip)]
    pub alike: bool,
    /// The sides to which the wall can rock.
    #[serde(skip)]
    pub sides: SideVerdicts,
    /// The dynamic check, where there are records for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dynamic: Option<DynamicCheck>,
    /// What the engineer should know; none of it stops the check.
    pub warnings: Vec<Sentence>,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_one(target: &f64) -> bool {
    *target == 1.0
}

/// What governs a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Governs {
    /// `positive` or `negative`; in the dynamic check the side of the largest response.
    pub side: Side,
    /// The limit state, and `SLV_q` for the linear check.
    pub limit_state: Deciding,
    /// Height above the base of the level above which the wall turns, where levels are stated \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level: Option<f64>,
    /// `ζ_E` \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: f64,
}
