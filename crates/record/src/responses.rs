//! The response of a wall's branches to a record, taken once for all runs of a batch.
//!
//! Over some steps a branch is an affine map of (u, u̇) and of the forcing. The forcing's part, for a run's
//! factor s, is s times that of the record itself: a table of it, from each sample on, leaves a run two
//! products for each of u and u̇.

use rocking_wall::solver::Motion;

use crate::affine::Affine;
use crate::forcing::{AT_ONCE, BLOCK, Forcing};
use crate::number::{BranchRow, WIDTH, index};
use crate::table::{LONGEST, Table, Way, get, set};

/// Rows that a lane may read from where it is: those of a block, and one more.
pub(crate) const ROWS_AHEAD: usize = BLOCK / AT_ONCE + 1;
/// Samples of a record up to which tables are made: 1 MB for each oscillator.
const MOST_SAMPLES: usize = 1 << 16;

/// For each oscillator its response to a record.
#[derive(Debug)]
pub(crate) struct Responses {
    /// For each branch the first row of its response.
    pub(crate) starts: BranchRow,
    /// The response over plain steps at once, of u and u̇, for four: from samples 0, 4, 8, …, then from 1, 5,
    /// 9, …, and so on.
    rows: Vec<[f64; 2]>,
    /// Rows of the response from one offset on, where two steps are taken at once and where four.
    lengths: [usize; 2],
}

impl Responses {
    /// Prepares the responses of a wall to a record; `None` where runs do not go side by side by affine maps:
    /// few or very many samples, many branches, steps without a map, or long beside the wall's period.
    pub(crate) fn new(motion: &Motion, table: &Table, forcing: Forcing<'_>) -> Option<Self> {
        let count = forcing.count();
        if !(4 * AT_ONCE..=MOST_SAMPLES).contains(&count)
            || table.ways.len() > WIDTH
            || table.longest > LONGEST
            || table.ways.iter().any(|way| *way != Way::Affine)
        {
            return None;
        }
        let lengths = [2, AT_ONCE].map(|at_once| count / at_once + 1 + ROWS_AHEAD);
        let mut responses = Self { starts: BranchRow::default(), rows: Vec::new(), lengths };
        let oscillators = motion.oscillators();
        for (branch, oscillator) in oscillators.iter().enumerate() {
            let known = oscillators[..branch].iter().position(|known| known == oscillator);
            let next = responses.rows.len() as f64;
            let start = known.map_or(next, |known| get(&responses.starts, known));
            set(&mut responses.starts, branch, start);
            if known.is_none() {
                responses.respond(&table.maps[branch], forcing, index(get(&table.at_once, branch)));
            }
        }
        Some(responses)
    }

    /// Adds the response of an oscillator.
    fn respond(&mut self, map: &Affine, forcing: Forcing<'_>, at_once: usize) {
        let (start, length) = (self.rows.len(), self.lengths[usize::from(at_once == AT_ONCE)]);
        self.rows.resize(start + at_once * length, [0.0; 2]);
        for (offset, rows) in self.rows[start..].chunks_exact_mut(length).enumerate() {
            // all samples that count are within the record
            let count = (forcing.count() - offset).saturating_sub(AT_ONCE).div_ceil(at_once);
            for (n, row) in rows.iter_mut().enumerate().take(count) {
                *row = map.respond(forcing.from(offset + n * at_once, AT_ONCE + 1));
            }
        }
    }

    /// Returns the rows from a sample on, of the response that starts at a row.
    #[inline(always)]
    pub(crate) fn ahead(&self, start: usize, sample: usize, at_once: usize) -> &[[f64; 2]] {
        // without divisions, which would take as long as the steps
        let four = usize::from(at_once == AT_ONCE);
        let first = (sample & (at_once - 1)) * self.lengths[four] + (sample >> (1 + four));
        &self.rows[start + first..][..ROWS_AHEAD]
    }
}
