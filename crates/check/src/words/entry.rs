//! What a code is called, and what tables and reports say of it.

use super::{Sentence, say};

/// A code among the others.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The value of `code` in `[check]`.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// Its source, for the head of a report.
    pub source: fn() -> Sentence,
    /// Symbol of the ratio of capacity to demand, which names columns: `zeta_E`.
    pub symbol: &'static str,
    /// g in which its ground accelerations are stated \[m/s²\].
    pub gravity: f64,
    /// Names of the checks that tables of walls show.
    pub checks: &'static [&'static str],
    /// The smallest table `[check]` that it takes, in one line.
    pub example: &'static str,
    /// Keys that a wall of a file of walls may state alone; of `a|b` one replaces the other.
    pub(crate) of_wall: &'static [&'static str],
}

impl Entry {
    /// The symbol for people.
    pub(crate) fn ratio(&self) -> Sentence {
        match self.symbol {
            "ratio" => say!("ratio", "rapporto"),
            "zeta_E" => Sentence::new("zeta_E", "ζ_E"),
            symbol => Sentence::same(symbol),
        }
    }
}
