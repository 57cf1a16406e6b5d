//! The response of a wall's branches to a record, taken once for all runs of a batch.
//!
//! Over some steps a branch is an affine map of (u, u̇) and of the forcing. The forcing's part, for a run's
//! factor s, is s times that of the record itself: a table of it, from each sample on, leaves a run two
//! products for each of u and u̇.

use crate::affine::{Affine, MOST_AT_ONCE};
use crate::forcing::{BLOCK, Forcing};
use crate::number::WIDTH;
use crate::solver::RecordSolver;

/// Rows that a lane may read from where it is: those of a block by four steps at once, and one more. By two
/// it is half a block, and lanes go on in the next round.
pub(crate) const ROWS_AHEAD: usize = BLOCK / MOST_AT_ONCE + 1;
/// Samples of a record up to which tables are made: 1 MB for each oscillator.
const MOST_SAMPLES: usize = 1 << 16;

/// For each oscillator its response to a record.
#[derive(Debug)]
pub(crate) struct Responses<'a> {
    /// The wall whose branches respond.
    pub(crate) solver: &'a RecordSolver<'a>,
    /// For each branch the first row of its response.
    starts: [usize; WIDTH],
    /// The response over plain steps at once, of u and u̇, for four: from samples 0, 4, 8, …, then from 1, 5,
    /// 9, …, and so on.
    rows: Vec<[f64; 2]>,
    /// Plain steps taken at once, and the rows from one offset on.
    at_once: usize,
    length: usize,
}

impl<'a> Responses<'a> {
    /// Prepares the responses of a wall with constant damping to a record; `None` for very many samples or
    /// many branches.
    pub(crate) fn new(solver: &'a RecordSolver<'a>, forcing: Forcing<'_>) -> Option<Self> {
        let RecordSolver { motion, table, .. } = solver;
        let count = forcing.count();
        if count > MOST_SAMPLES || table.steppings.len() > WIDTH {
            return None;
        }
        let at_once = table.at_once;
        let length = count / at_once + 1 + ROWS_AHEAD;
        let oscillators = motion.oscillators();
        let rows = Vec::with_capacity(oscillators.len() * at_once * length);
        let mut responses = Self { solver, starts: [0; WIDTH], rows, at_once, length };
        for (branch, oscillator) in oscillators.iter().enumerate() {
            let known = oscillators[..branch].iter().position(|known| known == oscillator);
            responses.starts[branch] = known.map_or(responses.rows.len(), |known| responses.starts[known]);
            if known.is_none() {
                responses.respond(&table.maps[branch], forcing);
            }
        }
        Some(responses)
    }

    /// Adds the response of an oscillator.
    fn respond(&mut self, map: &Affine, forcing: Forcing<'_>) {
        let Self { at_once, length, .. } = *self;
        for offset in 0..at_once {
            // all samples that count are within the record
            let count = (forcing.count() - offset).saturating_sub(MOST_AT_ONCE).div_ceil(at_once);
            let respond = |n| map.respond(forcing.from(offset + n * at_once, MOST_AT_ONCE + 1));
            self.rows.extend((0..count).map(respond).chain((count..length).map(|_| [0.0; 2])));
        }
    }

    /// Returns the rows of a branch from a sample on.
    #[inline(always)]
    pub(crate) fn ahead(&self, branch: usize, sample: usize) -> &[[f64; 2]] {
        // without a division, which would take as long as the steps
        let first = (sample & (self.at_once - 1)) * self.length + (sample >> self.at_once.trailing_zeros());
        &self.rows[self.starts[branch % WIDTH] + first..][..ROWS_AHEAD]
    }
}
