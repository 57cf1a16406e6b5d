//! Parts in which a study is kept and distributed.

use super::Study;

/// Work of about a second on one core: samples times runs.
const SECOND: f64 = 3e7;
/// A study of few combinations has this many parts, so that several machines can share it.
const FEWEST_PARTS: usize = 16;

impl Study {
    /// Returns the number of combinations of each part; the last part may have fewer. It depends on the study
    /// alone. A part is worth about a second of one core; a large one has all records of its walls and
    /// models, whose runs go together.
    pub fn part_size(&self) -> usize {
        let samples: usize = self.records().iter().map(|record| record.motion.samples().len()).sum();
        let samples = samples as f64 / self.records().len() as f64;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, and saturates")]
        let second = (SECOND / (samples * self.levels().expected_runs())) as usize;
        let size = self.count().div_ceil(FEWEST_PARTS).min(second).max(1);
        let records = self.records().len();
        if size > records { size - size % records } else { size }
    }
}
