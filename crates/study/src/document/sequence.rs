//! The table `[sequence]`.

use files::{FileError, Place, fraction, tables};
use toml::Spanned;

use crate::ida::{Levels, Scaled};

tables! {
    /// Sequences of records: what the levels scale, and fragilities by the state of the walls.
    #[derive(Debug)]
    pub(super) struct SequencesTable {
        /// What the levels scale: all shocks of a sequence, or the last one, the others being as they are.
        #[key(default = "all")]
        scale: Option<Scaled>,
        /// Fractions of `u_ins`: fragilities of the last shock are told for the walls whose |u| has exceeded
        /// each in the shocks before.
        #[key(items = fraction(), minItems = 1)]
        given: Option<Spanned<Vec<f64>>>,
    }
}

/// Reads the table: what the levels scale, and the fractions of `u_ins`.
pub(super) fn sequence(
    table: Option<&Spanned<SequencesTable>>,
    levels: &Levels,
    place: &Place<'_>,
) -> Result<(Scaled, Vec<f64>), FileError> {
    let Some(table) = table.map(Spanned::get_ref) else { return Ok((Scaled::All, Vec::new())) };
    let scaled = table.scale.unwrap_or_default();
    let Some(given) = &table.given else { return Ok((scaled, Vec::new())) };
    let refused = match (scaled, levels) {
        (Scaled::All, _) => {
            "the state before the last shock differs from level to level; add scale = \"last\""
        }
        (Scaled::Last, Levels::Cloud { .. }) => {
            "a cloud has too few runs in each state; give levels of another method, such as \"hunt\""
        }
        (Scaled::Last, _) => return Ok((scaled, given.get_ref().clone())),
    };
    Err(place.error(given.span(), format!("given: {refused}")))
}
