//! A check of one side of a wall, as every code has it.

use report::number;

use crate::words::names::Sides;
use crate::words::{Sentence, shown};

/// A check of one side.
#[derive(Clone, Debug)]
pub struct Row {
    /// Name of the check, such as `SLV`.
    pub check: &'static str,
    /// The same for people.
    pub title: Sentence,
    /// The side.
    pub side: Sides,
    /// Height of the level above which the wall turns, where levels are stated \[m\].
    pub level: Option<f64>,
    /// Capacity over demand \[-\].
    pub zeta: f64,
    /// The same before a rule of the code replaces it by a larger one \[-\].
    pub ratio: f64,
    /// Whether it passes.
    pub passed: bool,
    /// Whether it decides; otherwise it informs.
    pub decides: bool,
    /// Ground acceleration that just passes, and that of the site, if the code has one \[g\].
    pub ground: Option<[f64; 2]>,
    /// Capacity and demand.
    pub ends: Ends,
    /// The capacity as u of the wall; `None` of a check of accelerations, and of runs \[m\].
    pub displacement: Option<f64>,
    /// Where the code has it.
    pub clause: &'static str,
    /// What is to be said beside the numbers; empty where nothing is.
    pub remark: Sentence,
}

impl Row {
    /// Makes a row of a check that informs, and passes from capacity over demand 1 on; the rest is empty.
    pub(crate) fn new(check: &'static str, title: Sentence, side: Sides, zeta: f64, ends: Ends) -> Self {
        let (passed, decides, ground, displacement) = (zeta >= 1.0, false, None, None);
        Self {
            check,
            title,
            side,
            level: None,
            zeta,
            ratio: zeta,
            passed,
            decides,
            ground,
            ends,
            displacement,
            clause: "",
            remark: Sentence::default(),
        }
    }
}

/// A capacity and its demand.
#[derive(Clone, Copy, Debug)]
pub enum Ends {
    /// Accelerations \[m/s²\].
    Accelerations([f64; 2]),
    /// Displacements \[m\].
    Displacements([f64; 2]),
}

impl Ends {
    /// Both in SI units.
    pub(super) fn values(self) -> [f64; 2] {
        let (Self::Accelerations(ends) | Self::Displacements(ends)) = self;
        ends
    }

    /// The SI unit.
    pub(super) fn unit(self) -> &'static str {
        if matches!(self, Self::Displacements(_)) { "m" } else { "m/s2" }
    }

    /// One of both as a report has it.
    pub(super) fn in_full(self, end: f64) -> String {
        let (factor, unit) =
            if matches!(self, Self::Displacements(_)) { (1e3, "mm") } else { (1.0, "m/s²") };
        format!("{} {unit}", shown(factor * end))
    }

    /// One of both for people.
    pub(super) fn shown(self, end: f64) -> String {
        let (factor, unit) =
            if matches!(self, Self::Displacements(_)) { (1e3, "mm") } else { (1.0, "m/s²") };
        format!("{} {unit}", number(factor * end, 4))
    }
}
